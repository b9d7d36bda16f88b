//! How a file is to be read.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;

/// The most cells that are read if nothing else is asked for: 2²⁸, such as 16 384 × 16 384, which
/// take 1 GiB.
pub const CELLS: u64 = 1 << 28;
/// Cells that are read however small the file is if nothing else is asked for: 64 MiB.
const CELLS_OF_ANY_FILE: u64 = 1 << 24;
/// Cells for each byte of a file likewise. Compressed heights take a quarter of a byte and more; a
/// file of which each byte stands for more is empty ground, or made to fill the memory.
const CELLS_PER_BYTE: u64 = 32;

/// How a file is to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadOptions {
    /// Where a grid lies whose file does not say so: `.npy`, or a TIFF without a georeference.
    pub placement: Option<Placement>,
    /// Which band of a GeoTIFF has the heights or classes, from 1; needed where it has several.
    pub band: Option<usize>,
    /// A height that stands for a missing one, beside those that the file declares [m].
    pub missing: Option<f64>,
    /// The most cells that are read; `None` for what a file of its size has ([`CELLS`] at most).
    pub cells: Option<u64>,
    /// What the cells are.
    pub content: Content,
}

/// What the cells of a file are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Content {
    /// Heights [m].
    #[default]
    Heights,
    /// Class numbers, which may be those of a palette.
    Classes,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { placement: None, band: None, missing: None, cells: None, content: Content::Heights }
    }
}

impl ReadOptions {
    /// The most cells that are read of a file.
    ///
    /// * `length`: of the file [bytes]
    pub(crate) fn most_cells(&self, length: u64) -> u64 {
        let of_file = length.saturating_mul(CELLS_PER_BYTE).max(CELLS_OF_ANY_FILE);
        self.cells.unwrap_or(of_file.min(CELLS))
    }
}

/// Where a grid lies on the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The point farthest to the south and west: the middle of its cell [m].
    pub south_west: Vec2,
    /// Distance between neighbours to the east and to the north [m].
    pub spacing: Vec2,
    /// Which row comes first.
    pub rows: RowOrder,
}

/// Which row of an array comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowOrder {
    /// The northern one, as in pictures, GeoTIFF and rasterio.
    NorthFirst,
    /// The southern one, as in plots with the origin below.
    SouthFirst,
}

impl Placement {
    /// Square cells in rows from north to south.
    ///
    /// * `south_west`: the middle of the cell farthest to the south and west [m]
    /// * `cell_size`: distance between neighbours [m]
    #[must_use]
    pub fn north_first(south_west: Vec2, cell_size: f64) -> Self {
        let spacing = Vec2::new(cell_size, cell_size);
        Self { south_west, spacing, rows: RowOrder::NorthFirst }
    }

    pub(crate) fn grid(&self, columns: usize, rows: usize) -> ElevationGrid {
        ElevationGrid { columns, rows, south_west: self.south_west, spacing: self.spacing }
    }
}
