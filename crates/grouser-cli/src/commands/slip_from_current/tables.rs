//! The readings and wheels of an answer, as text.

use grouser::document::columns::STATUS;
use grouser::document::columns::slip_from_current as columns;
use grouser::document::table::Table;
use grouser::studies::slip_from_current::SlipStatus;

use crate::output::rows::Rows;
use crate::output::text::Text;

/// The readings, and what they come to for each wheel.
pub(super) struct Tables {
    pub(super) rows: Table,
    pub(super) wheels: Table,
}

impl Tables {
    /// For reading: some of the readings, then each wheel.
    pub(super) fn text(&self, notes: &[String]) -> Text {
        let rows = self.rows.rows();
        let shown: Vec<usize> =
            (0..rows.min(ROWS)).map(|row| row * rows / rows.min(ROWS)).collect();
        let some = Rows::of_table(&self.rows.rows_at(&shown));
        let left = if rows > ROWS {
            format!("{ROWS} of {rows} readings; --format csv prints all\n")
        } else {
            String::new()
        };
        let names: Vec<&String> = self.wheels.columns.iter().map(|(name, _)| name).collect();
        let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
        some.to_table(&columns::brief(&self.rows))
            + left
            + meanings(&self.rows)
            + "\n"
            + Rows::of_table(&self.wheels).to_table(&names)
            + format!("\n{notes}")
    }
}

/// Readings that a terminal shows: of four wheels at three times.
const ROWS: usize = 12;

/// What the words in the column of states mean, a line for each that is not `ok`.
pub(super) fn meanings(rows: &Table) -> String {
    let states = rows.texts(STATUS);
    let is_there =
        |status: &SlipStatus| states.iter().any(|name| name.as_deref() == Some(status.name()));
    let others = SlipStatus::ALL.into_iter().filter(|status| *status != SlipStatus::Ok);
    let lines = others.filter(is_there);
    lines.map(|status| format!("{}: {}\n", status.name(), status.meaning())).collect()
}
