//! Text for reading: words and tables in turn.
//!
//! Written to a file or a pipe it is [plain](std::fmt::Display), the same everywhere; a terminal
//! gets it from [`super::screen`], in its width and its colours.

use std::fmt;
use std::ops::Add;

use grouser::document::escape;

/// Words and tables, in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Text(pub(crate) Vec<Part>);

#[derive(Clone, Debug)]
pub(crate) enum Part {
    Words(String),
    Grid(Grid),
}

/// Cells under headers.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
    /// The columns whose long cells stand under the table on a terminal, once each.
    pub(super) reasons: Vec<usize>,
    /// The column of names that [`notes`](Self::notes) explain.
    pub(super) names: Option<usize>,
    /// Names and what they mean.
    pub(crate) notes: Vec<(String, String)>,
}

impl Grid {
    /// Columns under their headers, each cell on its line.
    pub(crate) fn new(header: &[String], rows: &[Vec<String>]) -> Self {
        let shown = |cells: &[String]| -> Vec<String> {
            cells.iter().map(|cell| escape::line(cell).into_owned()).collect()
        };
        Self {
            header: shown(header),
            rows: rows.iter().map(|row| shown(row)).collect(),
            reasons: Vec::new(),
            names: None,
            notes: Vec::new(),
        }
    }

    /// With columns whose long cells a terminal shows once.
    pub(crate) fn with_reasons(mut self, columns: impl IntoIterator<Item = usize>) -> Self {
        self.reasons.extend(columns);
        self
    }

    /// With what the names of a column mean, a line each under the table.
    pub(crate) fn with_notes(mut self, column: usize, notes: Vec<(String, String)>) -> Self {
        (self.names, self.notes) = (Some(column), notes);
        self
    }

    /// Whether a column has numbers alone.
    pub(super) fn is_numeric(&self, column: usize) -> bool {
        self.rows.iter().all(|row| row[column] == "-" || row[column].parse::<f64>().is_ok())
    }

    /// The characters that a column needs.
    pub(super) fn width(&self, column: usize) -> usize {
        let cells = self.rows.iter().map(|row| row[column].chars().count());
        cells.chain([self.header[column].chars().count()]).max().unwrap_or(0)
    }
}

/// Numbers to the right, words to the left.
impl fmt::Display for Grid {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = 0..self.header.len();
        let widths: Vec<usize> = columns.clone().map(|column| self.width(column)).collect();
        let numeric: Vec<bool> = columns.map(|column| self.is_numeric(column)).collect();
        for cells in std::iter::once(&self.header).chain(&self.rows) {
            let padded = cells.iter().enumerate().map(|(column, cell)| {
                let width = widths[column];
                if numeric[column] { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
            });
            writeln!(out, "{}", padded.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        self.notes.iter().try_for_each(|(name, meaning)| writeln!(out, "{name}: {meaning}"))
    }
}

impl fmt::Display for Text {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|part| match part {
            Part::Words(words) => out.write_str(words),
            Part::Grid(grid) => grid.fmt(out),
        })
    }
}

impl Text {
    /// Blocks with an empty line between them.
    pub(crate) fn blocks(blocks: impl IntoIterator<Item = Self>) -> Self {
        let mut text = Self::default();
        for block in blocks {
            if !text.0.is_empty() {
                text = text + "\n";
            }
            text = text + block;
        }
        text
    }
}

impl From<String> for Text {
    fn from(words: String) -> Self {
        Self(vec![Part::Words(words)])
    }
}

impl From<&str> for Text {
    fn from(words: &str) -> Self {
        words.to_owned().into()
    }
}

impl From<&String> for Text {
    fn from(words: &String) -> Self {
        words.clone().into()
    }
}

impl From<&Text> for Text {
    fn from(text: &Text) -> Self {
        text.clone()
    }
}

impl From<Grid> for Text {
    fn from(grid: Grid) -> Self {
        Self(vec![Part::Grid(grid)])
    }
}

impl<T: Into<Text>> Add<T> for Text {
    type Output = Self;

    fn add(mut self, more: T) -> Self {
        self.0.extend(more.into().0);
        self
    }
}

impl<T: Into<Text>> FromIterator<T> for Text {
    fn from_iter<I: IntoIterator<Item = T>>(parts: I) -> Self {
        parts.into_iter().fold(Self::default(), |text, part| text + part)
    }
}
