//! A number of each place of a map in colours.

use grouser_core::terrain::ElevationGrid;

use super::{CORNER, LETTERS, Window};
use crate::chart::colour_bar;
use crate::scale::Scale;
use crate::sheet::{Cells, Shape, Stroke};
use crate::style::{Ground, Role, on_both_grounds};

/// Cells along the longer side, at most.
const CELLS: usize = 200;
/// Shades of colours that are mixed.
const SHADES: usize = 48;

/// A number of each place as a stand-alone SVG document: the map north up, its corners, and the
/// scale of its colours. Where nothing is known the picture is empty.
///
/// * `number`: by column and row of the grid; `None` or NaN where it is not known
/// * `scale`: from the least to the largest number
#[must_use]
pub fn map_picture(
    title: &str,
    grid: &ElevationGrid,
    number: &dyn Fn(usize, usize) -> Option<f64>,
    scale: &Scale,
) -> String {
    let window = Window::new(grid, [0, 0], [grid.columns - 1, grid.rows - 1], CELLS);
    let extent = grid.extent();
    let mut sheet = window.sheet(title, [extent.south_west, extent.north_east]);
    let size = window.size();
    let colour = |[column, row]: [usize; 2]| {
        let number = number(column, row).filter(|number| !number.is_nan())?;
        Some(scale.colour(shade(scale, number)))
    };
    let colours = window.places().map(colour);
    sheet.cells(Cells::new(CORNER, size, window.cells()[0], colours));
    let edge = Stroke::new(0.25, Role::Faint.on(Ground::Light));
    sheet.draw(Shape::rectangle(CORNER, size, edge.colour).unfilled().outlined(edge));
    let beside = [CORNER[0] + size[0] + 5.0, CORNER[1]];
    colour_bar(&mut sheet, scale, beside, size[1], LETTERS);
    on_both_grounds(&sheet)
}

/// The middle of the shade that a number has.
fn shade(scale: &Scale, number: f64) -> f64 {
    if scale.is_of_words() {
        return number;
    }
    let [low, high] = scale.ends();
    let place = ((number - low) / (high - low) * SHADES as f64).floor();
    let place = place.clamp(0.0, SHADES as f64 - 1.0);
    low + (place + 0.5) / SHADES as f64 * (high - low)
}
