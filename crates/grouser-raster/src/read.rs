//! Files of any format.

use std::fs;
use std::io::Read;

use crate::error::{Fault, RasterError};
use crate::{MapPath, Raster, ReadOptions, geotiff, npy, xyz};

/// What other formats of heights start with, which begin as text: labels of PDS and ISIS, grids of
/// Esri.
const LABELS: [&[u8]; 6] = [b"PDS_VERSION_ID", b"CCSD", b"Object", b"<?xml", b"ncols", b"NCOLS"];

/// Reads a file of any of the formats, which its content tells.
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do.
pub fn read<'p>(
    path: impl Into<MapPath<'p>>,
    options: &ReadOptions,
) -> Result<Raster, RasterError> {
    let path = path.into();
    let start = start_of(path).map_err(|fault| RasterError::new(path.path, fault))?;
    if geotiff::starts_so(&start) {
        geotiff::read(path, options)
    } else if npy::starts_so(&start) {
        npy::read(path, options)
    } else if start.contains(&0) || LABELS.iter().any(|label| start.starts_with(label)) {
        // Text has no zero bytes.
        Err(RasterError::new(path.path, Fault::UnknownFormat))
    } else {
        xyz::read(path, options)
    }
}

/// The first bytes of a file. A pipe without a writer would be waited for.
pub(crate) fn start_of(path: MapPath<'_>) -> Result<Vec<u8>, Fault> {
    const BYTES: u64 = 64;
    let kind = fs::metadata(path.path)?.file_type();
    if !kind.is_file() && !kind.is_dir() {
        return Err(Fault::NoFile);
    }
    let mut start = Vec::new();
    path.opened()?.take(BYTES).read_to_end(&mut start)?;
    if start.is_empty() { Err(Fault::Empty) } else { Ok(start) }
}
