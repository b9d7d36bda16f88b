//! Small charts side by side.

use super::axis::Axis;
use super::frame::{Frame, LINE, height_below, lines, width_beside, write};
use super::panel::{Panel, Weight};
use super::{Chart, Drawable, EDGE, Grid, TITLE, sheet};
use crate::sheet::Sheet;
use crate::style::Role;

/// Width and height of a chart within its axes [mm].
const FRAME: [f64; 2] = [38.0, 32.0];
/// Height of letters [mm].
const SIZE: f64 = 2.7;
/// Intervals between numbers along a horizontal axis, at most.
const INTERVALS: usize = 3;
/// Between charts, and room for the half of a number that stands under the last one's edge [mm].
const APART: f64 = 3.5;
const OVER: f64 = 7.0;

/// A chart with its axes, and its place in the grid.
struct Cell<'c> {
    chart: &'c Chart,
    row: usize,
    column: usize,
    x: Axis,
    y: Axis,
}

impl Drawable for Grid {
    fn sheet(&self) -> Sheet {
        let cells = cells_of(self);
        let (rows, columns) =
            (self.cells.len(), self.cells.iter().map(Vec::len).max().unwrap_or(0));
        let most = |of: &dyn Fn(&Cell) -> f64, is_in: &dyn Fn(&Cell) -> bool| {
            cells.iter().filter(|cell| is_in(cell)).map(of).fold(0.0, f64::max)
        };
        let label = |text: &str| lines(text, SIZE, FRAME[0]);
        let above = |row| {
            let height = |cell: &Cell| label(&cell.chart.y_label).len() as f64 * LINE * SIZE;
            most(&height, &|cell| cell.row == row)
        };
        let below = |row| {
            let height = |cell: &Cell| {
                let lines = label(&cell.chart.x_label).len();
                if has_numbers(cell, &cells) { height_below(lines, SIZE) } else { 0.0 }
            };
            most(&height, &|cell| cell.row == row)
        };
        let beside =
            |column| most(&|cell| width_beside(&cell.y, SIZE), &|cell| cell.column == column);
        let title = lines(&self.title, TITLE, 100.0);
        let start = EDGE + title.len() as f64 * LINE * TITLE + 1.0;
        let (mut lefts, mut right) = (Vec::new(), EDGE);
        for column in 0..columns {
            lefts.push(right + beside(column));
            right += beside(column) + FRAME[0] + APART;
        }
        let (mut tops, mut bottom) = (Vec::new(), start);
        for row in 0..rows {
            tops.push(bottom + above(row) + 0.5);
            bottom += above(row) + 0.5 + FRAME[1] + below(row) + APART;
        }
        let mut sheet = sheet(&self.title, [(right + OVER).max(60.0), bottom.max(20.0)]);
        write(&mut sheet, &title, [EDGE, EDGE], TITLE, Role::Ink);
        for cell in &cells {
            let (left, top) = (lefts[cell.column], tops[cell.row]);
            draw(&mut sheet, cell, Frame { left, top, width: FRAME[0], height: FRAME[1] }, &cells);
        }
        sheet
    }
}

/// The charts with their axes.
fn cells_of(grid: &Grid) -> Vec<Cell<'_>> {
    let mut cells = Vec::new();
    for (row, charts) in grid.cells.iter().enumerate() {
        for (column, chart) in charts.iter().enumerate() {
            let Some(chart) = chart else { continue };
            let x = Panel::x_axis(chart, INTERVALS, FRAME[0], SIZE);
            let y = Panel::y_axis(chart, FRAME[1], 1.4 * SIZE);
            cells.push(Cell { chart, row, column, x, y });
        }
    }
    cells
}

/// Whether a chart has numbers under it: none has them where the next one below has the same.
fn has_numbers(cell: &Cell, cells: &[Cell]) -> bool {
    let next = cells.iter().filter(|it| it.column == cell.column && it.row > cell.row);
    next.min_by_key(|it| it.row).is_none_or(|next| next.x != cell.x)
}

fn draw(sheet: &mut Sheet, cell: &Cell, frame: Frame, cells: &[Cell]) {
    let Cell { chart, x, y, .. } = cell;
    let panel = Panel { chart, x: x.clone(), y: y.clone(), frame, weight: Weight::Thin };
    panel.draw(sheet);
    if has_numbers(cell, cells) {
        frame.numbers_below(sheet, x, SIZE);
        frame.label_below(sheet, &lines(&chart.x_label, SIZE, FRAME[0]), SIZE);
    }
    frame.numbers_beside(sheet, y, SIZE);
    let name = lines(&chart.y_label, SIZE, FRAME[0]);
    let height = name.len() as f64 * LINE * SIZE;
    write(sheet, &name, [frame.left, frame.top - height - 0.5], SIZE, Role::Ink);
}
