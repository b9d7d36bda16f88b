//! A table of samples as CSV: the first line has keys, every other line a number for each.

use std::path::Path;
use std::sync::Arc;

use super::error::{DocumentError, Problem};
use super::lines::{cells, check_count, lines};
use super::source::read_file;
use super::tree::{Origin, Text};

/// A table of samples, with the spot of every cell.
#[derive(Debug)]
pub struct SampleTable {
    text: Arc<Text>,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    /// Where each line of the table starts and ends: first the header.
    lines: Vec<(usize, usize)>,
}

/// The largest file that is read [bytes]: some 10⁵ samples of ten numbers.
const LARGEST_TABLE: u64 = 1 << 25;

impl SampleTable {
    /// Reads the file that a document names.
    ///
    /// * `origin`: where it does
    pub fn read(name: &str, origin: &Origin) -> Result<Self, DocumentError> {
        if let Some(beside) = origin.text.beside.files.iter().find(|it| it.name == name) {
            let (label, content) = (name.to_owned(), beside.content.clone());
            return Self::parse(Arc::new(Text { label, content, ..Text::default() }));
        }
        let path = origin.text.folder.join(name);
        let label = path.display().to_string();
        let content = read_file(&path, LARGEST_TABLE).map_err(|problem| {
            let is_whole = origin.text.folder == Path::new("");
            let hint = (!is_whole).then(|| format!("looked for {label}"));
            match problem {
                Problem::NoSuchFile | Problem::Folder => {
                    DocumentError::at(origin, Problem::NoSamples { name: label.clone() })
                        .with_hint(hint)
                }
                Problem::TooLarge { .. } => DocumentError::whole(&label, problem)
                    .with_hint("keep every n-th sample: ten thousand are plenty".to_owned()),
                problem => DocumentError::whole(&label, problem),
            }
            .named_by(origin)
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Self::parse(Arc::new(Text { label, content, folder, ..Text::default() }))
            .map_err(|error| error.named_by(origin))
    }

    /// The same of a text in memory.
    ///
    /// * `label`: what messages call it
    pub fn of_text(label: String, content: String) -> Result<Self, DocumentError> {
        Self::parse(Arc::new(Text { label, content, ..Text::default() }))
    }

    fn parse(text: Arc<Text>) -> Result<Self, DocumentError> {
        let mut table = Self { text, columns: Vec::new(), rows: Vec::new(), lines: Vec::new() };
        let text = table.text.clone();
        for (from, line) in lines(&text.content) {
            let until = from + line.len();
            table.lines.push((from, until));
            if table.lines.len() == 1 {
                table.columns = cells(line).map(|(_, cell)| cell.to_owned()).collect();
            } else {
                let row = table.row(from, until)?;
                table.rows.push(row);
            }
        }
        if table.rows.len() < 2 {
            let found =
                format!("it has {} rows of numbers, it needs two or more", table.rows.len());
            let problem = Problem::NoTable(found);
            return Err(DocumentError::whole(&table.text.label, problem)
                .with_hint("the first line names keys, every other is a sample".to_owned()));
        }
        Ok(table)
    }

    fn row(&self, from: usize, until: usize) -> Result<Vec<f64>, DocumentError> {
        let line = &self.text.content[from..until];
        let names = (self.columns.len(), "columns");
        check_count(line, names, &self.origin(from, until), Problem::NoTable)?;
        let number = |(column, (offset, cell)): (usize, (usize, &str))| {
            let at = from + offset;
            let origin = self.origin(at, at + cell.len());
            let key = || self.columns[column].clone();
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                Ok(value) => {
                    let problem = Problem::NotFinite { key: key(), value, range: String::new() };
                    Err(DocumentError::at(&origin, problem))
                }
                Err(_) => {
                    let found = if cell.is_empty() {
                        "missing".to_owned()
                    } else {
                        format!(
                            "the text \"{}\"",
                            cell.chars().take(40).collect::<String>().escape_debug()
                        )
                    };
                    let expected = "a number".to_owned();
                    let problem = Problem::WrongType { key: key(), found, expected };
                    Err(DocumentError::at(&origin, problem))
                }
            }
        };
        cells(line).enumerate().map(number).collect()
    }

    /// The table as CSV, with something before each of its keys.
    pub fn prefixed(&self, prefix: &str) -> String {
        let keys: Vec<String> = self.columns.iter().map(|key| format!("{prefix}{key}")).collect();
        let (_, end) = self.lines[0];
        format!("{}{}", keys.join(","), &self.text.content[end..])
    }

    /// The keys of the first line.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// A number for each column, all finite.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Where a column has its name.
    pub fn column_origin(&self, column: usize) -> Origin {
        self.cell_of_line(0, column)
    }

    /// Where a row has its number for a column.
    pub fn cell_origin(&self, row: usize, column: usize) -> Origin {
        self.cell_of_line(row + 1, column)
    }

    /// Where a row is.
    pub fn row_origin(&self, row: usize) -> Origin {
        let (from, until) = self.lines[row + 1];
        self.origin(from, until)
    }

    /// The file as it was read.
    pub fn into_content(self) -> String {
        self.text.content.clone()
    }

    fn cell_of_line(&self, line: usize, column: usize) -> Origin {
        let (from, until) = self.lines[line];
        let cell = cells(&self.text.content[from..until]).nth(column);
        let (offset, length) =
            cell.map_or((0, until - from), |(offset, cell)| (offset, cell.len()));
        self.origin(from + offset, from + offset + length)
    }

    fn origin(&self, from: usize, until: usize) -> Origin {
        Origin { text: self.text.clone(), span: from..until }
    }
}
