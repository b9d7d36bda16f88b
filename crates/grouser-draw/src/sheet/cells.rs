//! Grids of cells in colours.

use super::{Colour, Place};

/// A grid of cells, row by row from the top, some of which are empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    pub(crate) place: Place,
    pub(crate) size: [f64; 2],
    pub(crate) columns: usize,
    pub(crate) colours: Vec<Option<Colour>>,
}

/// Cells of one colour beside each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) row: usize,
    pub(crate) first: usize,
    pub(crate) count: usize,
    pub(crate) colour: Colour,
}

impl Cells {
    /// * `place`: upper left corner
    /// * `size`: width and height of the whole grid [mm]
    /// * `columns`: cells of a row; what is left over at the end, less than a row, is not drawn
    pub fn new(
        place: Place,
        size: [f64; 2],
        columns: usize,
        colours: impl IntoIterator<Item = Option<Colour>>,
    ) -> Self {
        let mut colours: Vec<_> = colours.into_iter().collect();
        colours.truncate(colours.len() / columns.max(1) * columns);
        Self { place, size, columns: columns.max(1), colours }
    }

    pub(crate) fn rows(&self) -> usize {
        self.colours.len() / self.columns
    }

    /// Whether documents have it as one picture of pixels, and not as shapes: shapes in such a number are
    /// slow to draw, and viewers leave seams between them.
    pub(crate) fn is_picture(&self) -> bool {
        /// Shapes, at most.
        const SHAPES: usize = 4096;
        self.colours.len() > SHAPES
    }

    /// Width and height of a cell [mm].
    pub(crate) fn cell(&self) -> [f64; 2] {
        [self.size[0] / self.columns as f64, self.size[1] / self.rows().max(1) as f64]
    }

    pub(crate) fn runs(&self) -> impl Iterator<Item = Run> {
        self.colours.chunks(self.columns).enumerate().flat_map(|(row, cells)| {
            let mut first = 0;
            cells.chunk_by(|one, other| one == other).filter_map(move |run| {
                let start = first;
                first += run.len();
                run[0].map(|colour| Run { row, first: start, count: run.len(), colour })
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::{BLACK, WHITE};

    #[test]
    fn runs_cover_each_cell_that_is_not_empty_once() {
        let (b, w) = (Some(BLACK), Some(WHITE));
        let cells = Cells::new([0.0; 2], [3.0, 2.0], 3, [b, b, None, w, b, b, w]);
        let runs = cells.runs().map(|run| (run.row, run.first, run.count, run.colour));
        let all: Vec<_> = runs.collect();
        assert_eq!(all, [(0, 0, 2, BLACK), (1, 0, 1, WHITE), (1, 1, 2, BLACK)]);
        assert_eq!((cells.rows(), cells.cell()), (2, [1.0, 1.0]));
    }
}
