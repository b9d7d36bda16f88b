//! Tables in colours.

use super::axis::{Axis, is_drawn, range};
use super::colour_bar::{colour_bar, colour_bar_width};
use super::frame::{Frame, LINE, colour, height_below, lines, width_beside, write};
use super::{Drawable, EDGE, HeatMap, LETTERS, PAGE, TITLE, sheet};
use crate::scale::Scale;
use crate::sheet::{Cells, Face, Sheet, width};
use crate::style::Role;

/// From the table to the colours of its numbers [mm].
const GAP: f64 = 5.0;

impl Drawable for HeatMap {
    fn sheet(&self) -> Sheet {
        let [title, y_label] = [(&self.title, TITLE), (&self.y_label, LETTERS)]
            .map(|(text, size)| lines(text, size, PAGE[0] - 2.0 * EDGE));
        let x_label = lines(&self.x_label, LETTERS, 0.6 * PAGE[0]);
        let under_title = EDGE + title.len() as f64 * LINE * TITLE;
        let top = under_title + y_label.len() as f64 * LINE * LETTERS + 2.0;
        let height = PAGE[1] - top - height_below(x_label.len(), LETTERS) - EDGE;
        let values = self.values.iter().flatten().flatten().copied();
        let [low, high] = Axis::linear(range(values), 6).ends();
        let scale = Scale::ramp(low, high);
        let [x, y] = [&self.columns, &self.rows].map(|numbers| of_cells(numbers));
        let y = thinned(y, height, |_| 1.2 * LETTERS);
        let left = EDGE + width_beside(&y, LETTERS);
        let bar = GAP + colour_bar_width(&scale, height, LETTERS);
        let across = PAGE[0] - left - bar - EDGE;
        let x = thinned(x, across, |label| width(label, Face::Regular, LETTERS) + 1.5);
        let frame = Frame { left, top, width: across, height };

        let mut sheet = sheet(&self.title, PAGE);
        write(&mut sheet, &title, [EDGE, EDGE], TITLE, Role::Ink);
        write(&mut sheet, &y_label, [EDGE, under_title], LETTERS, Role::Ink);
        table(self, &mut sheet, &scale, &frame);
        frame.edges(&mut sheet);
        frame.numbers_below(&mut sheet, &x, LETTERS);
        frame.numbers_beside(&mut sheet, &y, LETTERS);
        frame.label_below(&mut sheet, &x_label, LETTERS);
        colour_bar(&mut sheet, &scale, [frame.right() + GAP, top], height, LETTERS);
        sheet
    }
}

/// The cells in their colours.
fn table(map: &HeatMap, sheet: &mut Sheet, scale: &Scale, frame: &Frame) {
    let of_value = |value: Option<f64>| match value {
        Some(value) if is_drawn(value) => scale.colour(value),
        _ => colour(Role::Grid),
    };
    let (columns, rows) = (map.columns.len(), map.rows.len());
    // Cells are listed from the top.
    let value = |row: usize, column: usize| *map.values.get(row)?.get(column)?;
    let cells = (0..rows)
        .rev()
        .flat_map(|row| (0..columns).map(move |column| Some(of_value(value(row, column)))));
    let (place, size) = ([frame.left, frame.top], [frame.width, frame.height]);
    sheet.cells(Cells::new(place, size, columns, cells));
}

/// Names of cells, which are as wide as each other whatever their numbers are.
fn of_cells(numbers: &[f64]) -> Axis {
    Axis::named(numbers.iter().map(|number| number.to_string().replace('-', "−")))
}

/// Every second, third, … tick, as many as have room.
///
/// * `length`: of the axis [mm]
/// * `room`: what a label needs along it [mm]
fn thinned(mut axis: Axis, length: f64, room: impl Fn(&str) -> f64) -> Axis {
    let apart = length / axis.ticks.len().max(1) as f64;
    let widest = axis.ticks.iter().map(|tick| room(&tick.label)).fold(0.0, f64::max);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number")]
    let stride = ((widest / apart).ceil() as usize).max(1);
    axis.ticks = axis.ticks.into_iter().step_by(stride).collect();
    axis
}
