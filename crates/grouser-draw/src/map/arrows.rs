//! Directions on a map, as arrows on a coarse grid.

use grouser_core::elementary::wide;
use grouser_core::terrain::ElevationGrid;

use super::{OfPlace, Window};
use crate::sheet::{Colour, Place, Shape, Sheet, Stroke};
use crate::style::{Ground, Role};

/// Arrows along the longer side, at most.
const ARROWS: usize = 24;
/// Length of an arrow over the side of its square, and the most that it is long [mm].
const LENGTH: f64 = 0.8;
const LONGEST: f64 = 9.0;

/// The squares that have an arrow each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrows {
    cells: [usize; 2],
    /// Cells of a square, to the east and to the north.
    square: [usize; 2],
}

impl Arrows {
    /// Squares on the ground, as far as whole cells make them.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells of a grid")]
    pub(super) fn on(grid: &ElevationGrid) -> Self {
        let cells = [grid.columns, grid.rows];
        let sides = [grid.spacing.x, grid.spacing.y];
        let longer = f64::max(cells[0] as f64 * sides[0], cells[1] as f64 * sides[1]);
        let side = longer / ARROWS as f64;
        let square = [0, 1].map(|k| ((side / sides[k]).ceil() as usize).clamp(1, cells[k]));
        Self { cells, square }
    }

    /// How many cells a square has.
    pub(super) fn in_words(self) -> String {
        let [east, north] = self.square;
        format!("{east} × {north} cells")
    }

    /// The cell in the middle of each square.
    fn middles(self) -> impl Iterator<Item = [usize; 2]> {
        let [columns, rows] = [0, 1].map(|k| {
            let (all, each) = (self.cells[k], self.square[k]);
            (each / 2..all).step_by(each)
        });
        rows.flat_map(move |row| columns.clone().map(move |column| [column, row]))
    }

    /// * `direction`: from the east to the left [°]
    pub(super) fn draw(self, sheet: &mut Sheet, window: &Window, direction: &OfPlace<'_>) {
        let size = window.size();
        let side = (0..2).map(|k| size[k] * self.square[k] as f64 / self.cells[k] as f64);
        let length = (LENGTH * side.fold(f64::INFINITY, f64::min)).min(LONGEST);
        for [column, row] in self.middles() {
            let Some(angle) = direction(column, row).filter(|angle| angle.is_finite()) else {
                continue;
            };
            let at = [0, 1].map(|k| size[k] / self.cells[k] as f64);
            let east = (column as f64 + 0.5) * at[0];
            let north = (row as f64 + 0.5) * at[1];
            let middle = [super::CORNER[0] + east, super::CORNER[1] + size[1] - north];
            draw_arrow(sheet, middle, angle.to_radians(), length);
        }
    }
}

/// A dark arrow with a light edge, so that it is seen on ground in the shade.
///
/// * `angle`: from the east to the left [rad]
/// * `length`: from end to tip [mm]
fn draw_arrow(sheet: &mut Sheet, [x, y]: Place, angle: f64, length: f64) {
    let (sin, cos) = (wide::sin(angle), wide::cos(angle));
    let at = |ahead: f64, left: f64| {
        [x + length * (ahead * cos - left * sin), y - length * (ahead * sin + left * cos)]
    };
    let (ink, halo) = (Role::Ink.on(Ground::Light), Colour::grey(1.0).opacity(0.7));
    let width = (0.09 * length).max(0.2);
    for (colour, more) in [(halo, 2.2), (ink, 1.0)] {
        let stroke = Stroke::new(width * more, colour);
        sheet.draw(Shape::line([at(-0.5, 0.0), at(0.2, 0.0)], stroke));
        let wide = 0.2 + 0.04 * (more - 1.0);
        let tip = 0.5 + 0.06 * (more - 1.0);
        sheet.draw(Shape::area([at(tip, 0.0), at(0.12, wide), at(0.12, -wide)], colour));
    }
}

#[cfg(test)]
mod tests {
    use grouser_core::units::Vec2;

    use super::*;

    #[test]
    fn arrows_stand_on_squares_of_the_ground() {
        let (south_west, spacing) = (Vec2::zeros(), Vec2::new(1.0, 2.0));
        let grid = ElevationGrid { columns: 480, rows: 120, south_west, spacing };
        let arrows = Arrows::on(&grid);
        assert_eq!(arrows.square, [20, 10]);
        let middles: Vec<_> = arrows.middles().collect();
        assert_eq!((middles.len(), middles[0], middles[1]), (24 * 12, [10, 5], [30, 5]));
    }

    #[test]
    fn a_small_map_has_an_arrow_for_each_cell() {
        let (south_west, spacing) = (Vec2::zeros(), Vec2::new(1.0, 1.0));
        let arrows = Arrows::on(&ElevationGrid { columns: 3, rows: 2, south_west, spacing });
        assert_eq!(arrows.middles().count(), 6);
    }
}
