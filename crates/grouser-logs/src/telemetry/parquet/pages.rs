//! Pages of a column, unpacked within limits.
//!
//! The library is made to believe that columns are not compressed: it then hands over pages as they
//! are stored, which are unpacked here, by libraries without native code. Source: "Parquet:
//! Compression" of the Apache Parquet format.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::Compression;
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::file::reader::{ChunkReader, Length};
use parquet::file::serialized_reader::SerializedPageReader;

/// The largest page, stored or unpacked [bytes]; writers make them of one MiB.
const MOST: usize = 64 << 20;

/// A file of which no more is read than there is, and not too much at once.
pub(super) struct Bounded {
    file: File,
    length: u64,
}

impl Bounded {
    pub(super) fn new(file: File) -> Result<Self> {
        let length = file.metadata()?.len();
        Ok(Self { file, length })
    }
}

impl Length for Bounded {
    fn len(&self) -> u64 {
        self.length
    }
}

impl ChunkReader for Bounded {
    type T = BufReader<File>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        let mut file = self.file.try_clone()?;
        file.seek(SeekFrom::Start(start))?;
        Ok(BufReader::new(file))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        let is_there = start.checked_add(length as u64).is_some_and(|end| end <= self.length);
        if length > MOST || !is_there {
            let why = format!("{length} bytes at {start} are asked for, of {} in all", self.length);
            return Err(ParquetError::EOF(why));
        }
        let mut bytes = Vec::with_capacity(length);
        self.get_read(start)?.take(length as u64).read_to_end(&mut bytes)?;
        if bytes.len() < length {
            return Err(ParquetError::EOF("the file became shorter while it was read".into()));
        }
        Ok(bytes.into())
    }
}

/// How pages are packed.
#[derive(Clone, Copy, Debug)]
enum Packing {
    None,
    Snappy,
    Gzip,
    Zstd,
}

/// The pages of a column in a group of rows.
pub(super) struct Pages {
    stored: SerializedPageReader<Bounded>,
    packing: Packing,
}

impl Pages {
    /// # Errors
    /// For a packing that is not read here.
    pub(super) fn new(
        file: Arc<Bounded>,
        chunk: &ColumnChunkMetaData,
        rows: usize,
    ) -> Result<Self> {
        let packing = match chunk.compression() {
            Compression::UNCOMPRESSED => Packing::None,
            Compression::SNAPPY => Packing::Snappy,
            Compression::GZIP(_) => Packing::Gzip,
            Compression::ZSTD(_) => Packing::Zstd,
            other => {
                let why = format!(
                    "its columns are compressed by {other}; read are none, snappy, gzip and zstd"
                );
                return Err(ParquetError::NYI(why));
            }
        };
        check_place(chunk, file.length)?;
        let as_stored = chunk.clone().into_builder().set_compression(Compression::UNCOMPRESSED);
        let stored = SerializedPageReader::new(file, &as_stored.build()?, rows, None)?;
        Ok(Self { stored, packing })
    }

    fn unpacked(&self, page: Page) -> Result<Page> {
        Ok(match page {
            Page::DataPage {
                buf,
                num_values,
                encoding,
                def_level_encoding,
                rep_level_encoding,
                statistics,
            } => Page::DataPage {
                buf: self.packing.unpack(&buf, Vec::new())?,
                num_values,
                encoding,
                def_level_encoding,
                rep_level_encoding,
                statistics,
            },
            Page::DictionaryPage { buf, num_values, encoding, is_sorted } => {
                let buf = self.packing.unpack(&buf, Vec::new())?;
                Page::DictionaryPage { buf, num_values, encoding, is_sorted }
            }
            Page::DataPageV2 {
                buf,
                num_values,
                encoding,
                num_nulls,
                num_rows,
                def_levels_byte_len,
                rep_levels_byte_len,
                is_compressed,
                statistics,
            } => {
                // Levels stand before the values, and are never packed.
                let levels =
                    (def_levels_byte_len as usize).saturating_add(rep_levels_byte_len as usize);
                let parts = buf.split_at_checked(levels);
                let (levels, values) = parts
                    .ok_or_else(|| ParquetError::EOF("a page is shorter than its levels".into()))?;
                let is_packed = is_compressed && !values.is_empty();
                let buf =
                    if is_packed { self.packing.unpack(values, levels.to_vec())? } else { buf };
                Page::DataPageV2 {
                    buf,
                    num_values,
                    encoding,
                    num_nulls,
                    num_rows,
                    def_levels_byte_len,
                    rep_levels_byte_len,
                    is_compressed: false,
                    statistics,
                }
            }
        })
    }
}

/// Checks that a column is within its file: the library takes that for granted.
fn check_place(chunk: &ColumnChunkMetaData, length: u64) -> Result<()> {
    let start = chunk.dictionary_page_offset().unwrap_or_else(|| chunk.data_page_offset());
    let end = u64::try_from(start).ok().zip(u64::try_from(chunk.compressed_size()).ok());
    let end = end.and_then(|(start, size)| start.checked_add(size));
    if end.is_some_and(|end| end <= length) && chunk.data_page_offset() >= 0 {
        return Ok(());
    }
    Err(ParquetError::EOF("a column would be outside of its file".into()))
}

impl Packing {
    /// The content of packed bytes, behind what is there already.
    fn unpack(self, packed: &[u8], mut into: Vec<u8>) -> Result<Bytes> {
        let damaged =
            |why: String| ParquetError::General(format!("a page cannot be unpacked: {why}"));
        let mut all: Box<dyn Read + '_> = match self {
            Self::None => {
                into.extend_from_slice(packed);
                return Ok(into.into());
            }
            Self::Snappy => {
                let size =
                    snap::raw::decompress_len(packed).map_err(|it| damaged(it.to_string()))?;
                if size > MOST {
                    return Err(damaged(format!("it would have {size} bytes")));
                }
                let start = into.len();
                into.resize(start + size, 0);
                let mut decoder = snap::raw::Decoder::new();
                decoder
                    .decompress(packed, &mut into[start..])
                    .map_err(|it| damaged(it.to_string()))?;
                return Ok(into.into());
            }
            Self::Gzip => Box::new(flate2::read::MultiGzDecoder::new(packed)),
            Self::Zstd => {
                let decoder = ruzstd::decoding::StreamingDecoder::new(packed);
                Box::new(decoder.map_err(|it| damaged(it.to_string()))?)
            }
        };
        let most = MOST as u64 + 1;
        (&mut all).take(most).read_to_end(&mut into).map_err(|it| damaged(it.to_string()))?;
        if into.len() > MOST {
            return Err(damaged(format!("it has more than {MOST} bytes")));
        }
        Ok(into.into())
    }
}

impl Iterator for Pages {
    type Item = Result<Page>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Pages {
    fn get_next_page(&mut self) -> Result<Option<Page>> {
        let page = self.stored.get_next_page()?;
        page.map(|page| self.unpacked(page)).transpose()
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.stored.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.stored.skip_next_page()
    }
}
