//! The pixels of a map: how many there are, and which cells each of them shows.

use grouser_core::terrain::ElevationGrid;

/// Pixels along the longer side: a larger map is thinned to them, a smaller one has several for a
/// cell.
const PIXELS: usize = 800;

/// The pixels of a map, row by row from the north-west. Each shows whole cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixels {
    /// Columns and rows.
    pub(super) size: [usize; 2],
    cells: [usize; 2],
}

impl Pixels {
    pub(super) fn of(grid: &ElevationGrid) -> Self {
        let cells = [grid.columns, grid.rows];
        let longer = grid.columns.max(grid.rows);
        let size = if longer > PIXELS {
            cells.map(|count| (count * PIXELS).div_ceil(longer))
        } else {
            cells.map(|count| count * (PIXELS / longer))
        };
        Self { size, cells }
    }

    /// How many cells a pixel shows, to the east and to the north, at most.
    pub(super) fn cells_of_each(&self) -> [usize; 2] {
        [0, 1].map(|k| self.cells[k].div_ceil(self.size[k]))
    }

    /// The cells of a pixel: first and one after the last, of columns and of rows from the south.
    pub(super) fn cells(&self, x: usize, y: usize) -> [[usize; 2]; 2] {
        let [columns, below] = [x, y].map(|place| [place, place + 1]);
        let edge = |k: usize, place: usize| place * self.cells[k] / self.size[k];
        let span = |k: usize, [first, end]: [usize; 2]| {
            let first = edge(k, first);
            [first, edge(k, end).max(first + 1)]
        };
        let [first, end] = span(1, below);
        [span(0, columns), [self.cells[1] - end, self.cells[1] - first]]
    }

    /// The cell in a pixel's middle.
    pub(super) fn nearest(&self, x: usize, y: usize) -> [usize; 2] {
        self.cells(x, y).map(|[first, end]| usize::midpoint(first, end - 1))
    }

    /// The four cells around a pixel's middle, each with its share of it.
    ///
    /// * `cells`: columns and rows of the grid
    pub(super) fn around(&self, x: usize, y: usize, cells: [usize; 2]) -> [([usize; 2], f64); 4] {
        let of = |k: usize, place: usize| {
            let share = (place as f64 + 0.5) / self.size[k] as f64;
            let at = (share * cells[k] as f64 - 0.5).clamp(0.0, (cells[k] - 1) as f64);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
            let low = at.floor() as usize;
            ([low, (low + 1).min(cells[k] - 1)], at - low as f64)
        };
        let ((columns, east), (rows, south)) = (of(0, x), of(1, y));
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(a, b)| {
            let share = |on: usize, share: f64| if on == 1 { share } else { 1.0 - share };
            ([columns[a], cells[1] - 1 - rows[b]], share(a, east) * share(b, south))
        })
    }
}

#[cfg(test)]
mod tests {
    use grouser_core::units::Vec2;

    use super::*;

    fn of(columns: usize, rows: usize) -> Pixels {
        let (south_west, spacing) = (Vec2::zeros(), Vec2::new(1.0, 1.0));
        Pixels::of(&ElevationGrid { columns, rows, south_west, spacing })
    }

    #[test]
    fn a_small_map_has_several_pixels_for_a_cell() {
        let pixels = of(300, 100);
        assert_eq!((pixels.size, pixels.cells_of_each()), ([600, 200], [1, 1]));
        assert_eq!(pixels.cells(0, 0), [[0, 1], [99, 100]], "the north-west");
        assert_eq!(pixels.cells(599, 199), [[299, 300], [0, 1]]);
        assert_eq!(pixels.nearest(5, 4), [2, 97]);
    }

    /// Every cell of a large map is in one pixel.
    #[test]
    fn a_large_map_is_thinned_to_pixels_that_show_every_cell() {
        let pixels = of(2000, 901);
        assert_eq!((pixels.size, pixels.cells_of_each()), ([800, 361], [3, 3]));
        for k in [0, 1] {
            let mut next = 0;
            for place in 0..pixels.size[k] {
                // Rows are counted from the south, pixels from the north.
                let at = if k == 0 { [place, 0] } else { [0, pixels.size[1] - 1 - place] };
                let [first, end] = pixels.cells(at[0], at[1])[k];
                assert_eq!(first, next, "{k} {place}");
                next = end;
            }
            assert_eq!(next, [2000, 901][k]);
        }
    }
}
