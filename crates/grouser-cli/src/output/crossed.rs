//! Rows as tables of two of their columns against each other: one goes down, one across.

use grouser::answers::CrossTable;
use grouser::contact::validity::Flag;
use grouser::document::columns::flags::FLAGS;
use grouser::document::columns::{OK, STATUS};
use grouser::document::table::Table;

use super::text::{Grid, Text};
use grouser::document::reading::four_digits;

/// A table for each block of rows and each column that stands in cells; then the reasons where
/// there is no number, and the flags that any row has.
pub(super) fn text(table: &Table, crossing: &CrossTable) -> Text {
    let mut reasons = Reasons::default();
    let count = table.rows() / crossing.titles.len().max(1);
    let parts = crossing.titles.iter().enumerate().map(|(place, title)| {
        let rows: Vec<usize> = (place * count..(place + 1) * count).collect();
        let part = table.rows_at(&rows);
        Text::blocks(crossing.cells.iter().map(|name| {
            let (down, across) = (crossing.down, &crossing.across_label);
            let title = format!("{title}: {name} by {down} (down) and {across}\n");
            Text::from(title) + grid(&part, name, crossing, &mut reasons)
        }))
    });
    let tables = Text::blocks(parts);
    tables + reasons.lines() + flag_lines(table)
}

/// Why there are no numbers, each reason once.
#[derive(Default)]
struct Reasons(Vec<String>);

impl Reasons {
    /// What stands for a reason in the cells.
    fn mark(&mut self, reason: &str) -> String {
        let known = self.0.iter().position(|known| known == reason);
        let place = known.unwrap_or_else(|| {
            self.0.push(reason.to_owned());
            self.0.len() - 1
        });
        format!("[{}]", place + 1)
    }

    fn lines(&self) -> String {
        let lines = self.0.iter().enumerate();
        lines.map(|(place, reason)| format!("[{}] {reason}\n", place + 1)).collect()
    }
}

/// The cells of a column; where there is no number, the mark of the reason.
///
/// * `part`: a block, in which the value of the column across changes slowest
fn grid(part: &Table, name: &str, crossing: &CrossTable, reasons: &mut Reasons) -> Grid {
    let numbers = part.numbers(name);
    let statuses = part.texts(STATUS);
    let mut cell = |place: usize| match (numbers[place], statuses[place].as_deref()) {
        (Some(number), _) => three_digits(number),
        (None, Some(reason)) if reason != OK => reasons.mark(reason),
        (None, _) => "-".to_owned(),
    };
    let all = |name: &str| part.numbers(name).iter().map(|it| it.unwrap_or(f64::NAN));
    let rows = crossing.rows_down.max(1);
    let across: Vec<f64> = all(crossing.across).step_by(rows).collect();
    let first = std::iter::once(crossing.down.to_owned());
    let header: Vec<String> = first.chain(across.iter().map(|it| four_digits(*it))).collect();
    let row = |(place, down): (usize, f64)| {
        let mut cells = vec![four_digits(down)];
        cells.extend((0..across.len()).map(|column| cell(column * rows + place)));
        cells
    };
    let cells: Vec<Vec<String>> = all(crossing.down).take(rows).enumerate().map(row).collect();
    Grid::new(&header, &cells)
}

/// A number with three significant digits: many stand side by side.
fn three_digits(value: f64) -> String {
    four_digits(format!("{value:.2e}").parse().unwrap_or(value))
}

/// The flags of a table, a line each: how many of its rows have them, and what they mean.
fn flag_lines(table: &Table) -> String {
    let all = table.words(FLAGS);
    let line = |flag: Flag| {
        let count = all.iter().filter(|names| names.iter().any(|it| it == flag.name())).count();
        let meaning = flag.rule().meaning;
        (count > 0)
            .then(|| format!("{} ({count} of {} places): {meaning}\n", flag.name(), all.len()))
    };
    Flag::ALL.into_iter().filter_map(line).collect()
}

#[cfg(test)]
mod tests {
    use grouser::document::columns::{COURSE, SLOPE, YAW};
    use grouser::document::table::Values;

    use super::*;

    #[test]
    fn every_column_of_a_repeated_value_has_its_own_cells() {
        let column = |name: &str, numbers: &[f64]| {
            (name.to_owned(), Values::Float(numbers.iter().copied().map(Some).collect()))
        };
        let status = Values::Text(vec![Some(OK.to_owned()); 6]);
        let table = Table {
            columns: vec![
                column(COURSE.name, &[0.0, 0.0, 0.0, 0.0, 30.0, 30.0]),
                column(SLOPE.name, &[5.0, 10.0, 5.0, 10.0, 5.0, 10.0]),
                column(YAW.name, &[1.0, 2.0, 1.0, 2.0, 31.0, 32.0]),
                (STATUS.to_owned(), status),
            ],
        };
        let crossing = CrossTable {
            titles: vec!["sand".into()],
            down: SLOPE.name,
            rows_down: 2,
            across: COURSE.name,
            across_label: "course".into(),
            cells: vec![YAW.name.into()],
        };
        let shown = text(&table, &crossing).to_string();
        let rows: Vec<Vec<&str>> =
            shown.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(rows[1], ["slope_deg", "0", "0", "30"]);
        assert_eq!(rows[2], ["5", "1", "1", "31"]);
        assert_eq!(rows[3], ["10", "2", "2", "32"]);
    }
}
