//! A drive as a table of texts.

use std::path::Path;

use anyhow::{Context, Result};

/// Names of columns, and rows of as many cells.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn read(path: &Path) -> Result<Self> {
        let mut reader =
            csv::Reader::from_path(path).with_context(|| path.display().to_string())?;
        let cells = |row: &csv::StringRecord| row.iter().map(str::to_owned).collect();
        let names = cells(reader.headers()?);
        let rows = reader.records().map(|row| Ok(cells(&row?))).collect::<Result<_>>()?;
        Ok(Self { names, rows })
    }

    pub(super) fn text(&self) -> String {
        let lines = std::iter::once(&self.names).chain(&self.rows);
        lines.map(|cells| cells.join(",") + "\n").collect()
    }

    /// Places of the columns whose names begin so.
    pub(super) fn columns(&self, start: &str) -> Vec<usize> {
        (0..self.names.len()).filter(|place| self.names[*place].starts_with(start)).collect()
    }

    /// Changes each number of the columns whose names begin so; it is given with its row.
    pub(super) fn change(&mut self, start: &str, change: impl Fn(usize, f64) -> f64) {
        for place in self.columns(start) {
            for (row, cells) in self.rows.iter_mut().enumerate() {
                if let Ok(number) = cells[place].parse::<f64>() {
                    cells[place] = change(row, number).to_string();
                }
            }
        }
    }

    pub(super) fn scale(&mut self, start: &str, factor: f64) {
        self.change(start, |_, number| factor * number);
    }

    /// Another text in some rows of the columns whose names begin so.
    pub(super) fn put(&mut self, start: &str, text: &str, is_put: impl Fn(usize) -> bool) {
        for place in self.columns(start) {
            let rows = self.rows.iter_mut().enumerate().filter(|(row, _)| is_put(*row));
            rows.for_each(|(_, cells)| text.clone_into(&mut cells[place]));
        }
    }

    /// From a row on, what the columns have there.
    pub(super) fn freeze(&mut self, start: &str, from: usize) {
        for place in self.columns(start) {
            let text = self.rows[from][place].clone();
            for cells in &mut self.rows[from..] {
                cells[place].clone_from(&text);
            }
        }
    }

    /// What the columns have this many rows later than they had it.
    pub(super) fn delay(&mut self, start: &str, by: usize) {
        for place in self.columns(start) {
            for row in (0..self.rows.len()).rev() {
                let text = row.checked_sub(by).map(|from| self.rows[from][place].clone());
                self.rows[row][place] = text.unwrap_or_default();
            }
        }
    }

    /// One word in the names exchanged for the other, and the other for the one.
    pub(super) fn exchange(&mut self, one: &str, other: &str) {
        for name in &mut self.names {
            let parts = name.split(one).map(|part| part.replace(other, one));
            *name = parts.collect::<Vec<_>>().join(other);
        }
    }

    pub(super) fn keep_rows(&mut self, is_kept: impl Fn(usize) -> bool) {
        let mut row = 0;
        self.rows.retain(|_| {
            row += 1;
            is_kept(row - 1)
        });
    }
}
