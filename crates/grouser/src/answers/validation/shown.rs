//! What is shown of errors: words, and tables of words for reading.

use std::sync::Arc;

use super::super::{Answer, Displayed};
use crate::document::reading::{four_digits, sentence};
use crate::document::table::{Cell, ColumnKind, Table};

/// Something that is shown.
#[derive(Clone, Debug)]
pub(super) enum Shown {
    /// A title, on a line of its own.
    Title(String),
    /// Words, with the line ends that they need.
    Words(String),
    /// All columns of a table, under a caption where there is a page.
    Rows(&'static str, Arc<Table>),
}

/// What stands together.
pub(super) type Block = Vec<Shown>;

/// Rows of words under their headers.
pub(super) fn table(header: &[String], rows: Vec<Vec<String>>) -> Arc<Table> {
    let columns = header.iter().map(|name| (name.as_str(), ColumnKind::Text));
    let cells = |row: Vec<String>| -> Vec<Cell> { row.into_iter().map(Cell::text).collect() };
    Arc::new(Table::of_cells(columns, rows.into_iter().map(cells).collect()))
}

/// Blocks on a terminal, with an empty line between them.
pub(super) fn on_screen(blocks: &[Block]) -> Vec<Displayed> {
    let mut screen = Vec::new();
    for block in blocks {
        if !screen.is_empty() {
            screen.push(Displayed::Words("\n".to_owned()));
        }
        screen.extend(block.iter().map(|shown| match shown {
            Shown::Title(title) => Displayed::Words(format!("{title}\n")),
            Shown::Words(words) => Displayed::Words(words.clone()),
            Shown::Rows(_, table) => Displayed::Rows(Arc::clone(table), table.names()),
        }));
    }
    screen
}

/// The same on a page.
pub(super) fn on_page(blocks: Vec<Block>, answer: &mut Answer) {
    for shown in blocks.into_iter().flatten() {
        match shown {
            Shown::Title(title) => answer.heading(title),
            Shown::Words(words) => answer.words(sentence(words.trim())),
            Shown::Rows(caption, table) => answer.rows(caption, &table, table.names()),
        }
    }
}

/// A number for reading, or a dash.
pub(super) fn number(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), four_digits)
}

/// Whether an aim is met, or a dash where there is no aim.
pub(super) fn yes_or_no(is_met: Option<bool>) -> String {
    is_met.map_or("-", |is_met| if is_met { "yes" } else { "no" }).to_owned()
}
