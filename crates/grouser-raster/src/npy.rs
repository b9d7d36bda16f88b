//! Heights as NumPy's `.npy` files: a header of text, then the numbers.
//!
//! Format: NumPy enhancement proposal 1, versions 1.0 to 3.0. The array has two axes, rows and
//! columns; its first row is the northern one unless [`Placement::rows`](crate::Placement::rows)
//! says otherwise. NaN is a missing height.

mod header;

use std::io::{BufReader, Read};

use crate::error::{Fault, RasterError};
use crate::heights::{Heights, checked_cells};
use crate::{CoordinateSystem, MapPath, Raster, ReadOptions};
use header::{Header, MAGIC};

pub(crate) fn starts_so(start: &[u8]) -> bool {
    start.starts_with(MAGIC)
}

/// Reads a file.
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do.
pub fn read<'p>(
    path: impl Into<MapPath<'p>>,
    options: &ReadOptions,
) -> Result<Raster, RasterError> {
    let path = path.into();
    let raster = || {
        let file = path.opened()?;
        let length = file.metadata()?.len();
        raster_of(&mut BufReader::new(file), length, options)
    };
    raster().map_err(|fault| RasterError::new(path.path, fault))
}

/// Reads what a file holds.
///
/// # Errors
/// [`Fault`] if it is no array of heights.
pub fn decode(mut bytes: &[u8], options: &ReadOptions) -> Result<Raster, Fault> {
    let length = bytes.len() as u64;
    raster_of(&mut bytes, length, options)
}

fn raster_of(file: &mut impl Read, length: u64, options: &ReadOptions) -> Result<Raster, Fault> {
    let Header { kind, little_endian, by_columns, rows, columns, bytes: start } =
        Header::read(file, length)?;
    let cells = checked_cells(columns, rows, options.most_cells(length))?;
    let promised = cells as u64 * kind.bytes() as u64;
    if length < start + promised {
        return Err(Fault::Truncated { promised, found: length });
    }
    let placement = options.placement.ok_or(Fault::NotPlaced)?;
    // Both are at most as many as the cells.
    let grid = placement.grid(usize_of(columns, cells), usize_of(rows, cells));
    let (lines, line) =
        if by_columns { (grid.columns, grid.rows) } else { (grid.rows, grid.columns) };
    let mut heights = Heights::new(cells, options.content);
    heights.fill()?;
    let mut bytes = vec![0; line * kind.bytes()];
    for start in 0..lines {
        file.read_exact(&mut bytes)?;
        for (at, sample) in bytes.chunks_exact(kind.bytes()).enumerate() {
            let height = kind.value(sample, little_endian);
            let cell = if by_columns { at * grid.columns + start } else { start * line + at };
            if Some(height) != options.missing {
                heights.set(cell, height);
            }
        }
    }
    heights.raster(grid, placement.rows, CoordinateSystem::default())
}

/// A count that is not above another one.
fn usize_of(count: u64, most: usize) -> usize {
    usize::try_from(count).unwrap_or(most)
}
