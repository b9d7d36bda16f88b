//! Heights as they come in, row by row.

use grouser_core::terrain::elevation::{above, round_base};
use grouser_core::terrain::{ElevationError, ElevationGrid};

use crate::degrees::check_grid;
use crate::error::Fault;
use crate::{Content, CoordinateSystem, Raster, RowOrder, remarks};

/// Heights from here on are missing [m]: planetary formats write special values of that size.
pub const BEYOND: f64 = 1e30;

/// Heights above the first one, rounded.
#[derive(Debug)]
pub(crate) struct Heights {
    base: Option<f64>,
    above: Vec<f32>,
    /// How many there will be.
    cells: usize,
    content: Content,
}

impl Heights {
    pub(crate) fn new(cells: usize, content: Content) -> Self {
        Self { base: None, above: Vec::new(), cells, content }
    }

    /// Takes memory for that many more: with what is read, not with what is promised.
    pub(crate) fn reserve(&mut self, more: usize) -> Result<(), Fault> {
        // Doubling costs copies; but the last time there is no need for more than the rest.
        let rest = self.cells.saturating_sub(self.above.len());
        let wanted = more.max(self.above.len()).min(rest.max(more));
        if self.above.capacity() - self.above.len() >= more {
            return Ok(());
        }
        self.above.try_reserve_exact(wanted).map_err(|_| Fault::Memory { cells: self.cells })
    }

    /// All of them as missing, to be set out of order.
    pub(crate) fn fill(&mut self) -> Result<(), Fault> {
        self.reserve(self.cells)?;
        self.above.resize(self.cells, f32::NAN);
        Ok(())
    }

    /// The next height [m]; what is not finite, or far beyond any, is missing.
    pub(crate) fn push(&mut self, height: f64) {
        let height = self.kept(height);
        self.above.push(height);
    }

    /// The height of one cell of those that were filled.
    pub(crate) fn set(&mut self, cell: usize, height: f64) {
        self.above[cell] = self.kept(height);
    }

    fn kept(&mut self, height: f64) -> f32 {
        if height.abs() < BEYOND {
            above(height, *self.base.get_or_insert_with(|| round_base(height)))
        } else {
            f32::NAN
        }
    }

    /// The raster of them.
    ///
    /// * `order`: of the rows in which they came
    pub(crate) fn raster(
        mut self,
        grid: ElevationGrid,
        order: RowOrder,
        coordinates: CoordinateSystem,
    ) -> Result<Raster, Fault> {
        let Some(base) = self.base else {
            return Err(ElevationError::NothingKnown { points: self.above.len() }.into());
        };
        if !coordinates.is_known() {
            check_grid(&grid)?;
        }
        if order == RowOrder::NorthFirst {
            turn_over(&mut self.above, grid.columns);
        }
        let remarks = match self.content {
            Content::Heights => remarks(&grid, base, &self.above),
            // Class numbers jump as they like.
            Content::Classes => Vec::new(),
        };
        Ok(Raster { grid, base, heights: self.above, coordinates, remarks })
    }
}

/// Puts the last row first.
fn turn_over(heights: &mut [f32], columns: usize) {
    let rows = heights.len() / columns;
    for row in 0..rows / 2 {
        let (front, back) = heights.split_at_mut((rows - 1 - row) * columns);
        front[row * columns..(row + 1) * columns].swap_with_slice(&mut back[..columns]);
    }
}

/// How many cells a grid has, if those are read.
pub(crate) fn checked_cells(columns: u64, rows: u64, limit: u64) -> Result<usize, Fault> {
    let cells = columns.checked_mul(rows).filter(|cells| *cells <= limit);
    cells.and_then(|cells| usize::try_from(cells).ok()).ok_or(Fault::TooLarge {
        columns,
        rows,
        limit,
    })
}
