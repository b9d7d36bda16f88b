//! Archives (zip) with the same bytes for the same files: without times, compressed by deflate.
//!
//! Source: PKWARE, APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::DeflateEncoder;

/// The first of 1980, when the format begins: day 1 of month 1.
const NO_DATE: u16 = 1 << 5 | 1;
/// Names are UTF-8.
const UTF8: u16 = 1 << 11;
const DEFLATED: u16 = 8;
/// What reads them: version 2.0; and what wrote them: the same, on Unix.
const VERSION: u16 = 20;
const ON_UNIX: u16 = 3 << 8 | VERSION;
/// An ordinary file that all may read.
const MODE: u32 = 0o100_644 << 16;

/// An archive of files; none if it would have to be larger than the format without extensions.
///
/// * `files`: their paths, with slashes, and what is in them
pub(crate) fn archive(files: &[(String, Vec<u8>)]) -> Option<Vec<u8>> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let offset = u32::try_from(archive.len()).ok()?;
        let mut deflate = DeflateEncoder::new(Vec::new(), Compression::default());
        // Writing to memory does not fail.
        let compressed = deflate.write_all(content).and_then(|()| deflate.finish()).ok()?;
        let mut entry = Vec::new();
        for number in [VERSION, UTF8, DEFLATED, 0, NO_DATE] {
            entry.extend(number.to_le_bytes());
        }
        entry.extend(crc32fast::hash(content).to_le_bytes());
        for size in [compressed.len(), content.len()] {
            entry.extend(u32::try_from(size).ok()?.to_le_bytes());
        }
        entry.extend(u16::try_from(name.len()).ok()?.to_le_bytes());
        entry.extend([0; 2]);
        archive.extend(b"PK\x03\x04");
        archive.extend(&entry);
        archive.extend(name.as_bytes());
        archive.extend(compressed);
        directory.extend(b"PK\x01\x02");
        directory.extend(ON_UNIX.to_le_bytes());
        directory.extend(&entry);
        // No comment, on disk 0, no text.
        directory.extend([0; 6]);
        directory.extend(MODE.to_le_bytes());
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let count = u16::try_from(files.len()).ok()?;
    let place = u32::try_from(archive.len()).ok()?;
    let size = u32::try_from(directory.len()).ok()?;
    archive.extend(directory);
    archive.extend(b"PK\x05\x06\0\0\0\0");
    for number in [count, count] {
        archive.extend(number.to_le_bytes());
    }
    for number in [size, place] {
        archive.extend(number.to_le_bytes());
    }
    archive.extend([0; 2]);
    Some(archive)
}
