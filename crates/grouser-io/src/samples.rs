//! A table of samples as CSV: the first line has keys, every other line a number for each.
//!
//! A column `model` says under which wheel–soil model each row is believed, and a column `weight`
//! how much the row counts. The rows of a model are samples in a random order that weigh the same.

use std::path::Path;
use std::sync::Arc;

use super::error::{DocumentError, Problem};
use super::given_file::{FileContent, GivenFile};
use super::lines::{cells, check_count, lines};
use super::source::read_file;
use super::tree::{Origin, Text};
use crate::statistics::Distribution;
use grouser_core::contact::Model;

/// A table of samples, with the spot of every cell.
#[derive(Debug)]
pub struct SampleTable {
    text: Arc<Text>,
    /// All columns of the file.
    names: Vec<String>,
    /// The keys.
    columns: Vec<String>,
    /// Which columns of the file the keys are.
    places: Vec<usize>,
    rows: Vec<Vec<f64>>,
    /// Of each row, where the file has it.
    models: Vec<Model>,
    weights: Vec<f64>,
    /// Where each line of the table starts and ends: first the header.
    lines: Vec<(usize, usize)>,
}

/// The samples of one wheel–soil model.
#[derive(Clone, Debug, PartialEq)]
pub struct RowsOfModel {
    /// The model.
    pub model: Model,
    /// How much is believed of it [-]; those of all models have the sum 1.
    pub share: f64,
    /// A number for each key.
    pub rows: Vec<Vec<f64>>,
}

/// The column that names the model of each row.
pub const MODEL: &str = "model";
/// The column that says how much each row counts.
pub const WEIGHT: &str = "weight";

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
        let path =
            origin.text.path_of(name).map_err(|why| DocumentError::at(origin, why.into()))?;
        let label = path.display().to_string();
        let content = read_file(&path, origin.text.within(), LARGEST_TABLE).map_err(|problem| {
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

    /// What it gave.
    pub(super) fn given(&self) -> GivenFile {
        let rows = self.rows.len() as u64;
        GivenFile::new(self.text.label.clone(), FileContent::Samples, rows, rows)
    }

    fn parse(text: Arc<Text>) -> Result<Self, DocumentError> {
        let mut table = Self {
            text,
            names: Vec::new(),
            columns: Vec::new(),
            places: Vec::new(),
            rows: Vec::new(),
            models: Vec::new(),
            weights: Vec::new(),
            lines: Vec::new(),
        };
        let text = table.text.clone();
        for (from, line) in lines(&text.content) {
            let until = from + line.len();
            table.lines.push((from, until));
            if table.lines.len() == 1 {
                table.names = cells(line).map(|(_, cell)| cell.to_owned()).collect();
                let is_key = |name: &str| name != MODEL && name != WEIGHT;
                let keys = || table.names.iter().enumerate().filter(|(_, name)| is_key(name));
                (table.places, table.columns) = keys().map(|(at, it)| (at, it.clone())).unzip();
            } else {
                table.add_row(from, until)?;
            }
        }
        if table.rows.len() < 2 {
            let found =
                format!("it has {} rows of numbers, it needs two or more", table.rows.len());
            let problem = Problem::NoTable(found);
            return Err(DocumentError::whole(&table.text.label, problem)
                .with_hint("the first line names keys, every other is a sample".to_owned()));
        }
        table.check_models()?;
        Ok(table)
    }

    fn add_row(&mut self, from: usize, until: usize) -> Result<(), DocumentError> {
        let text = Arc::clone(&self.text);
        let line = &text.content[from..until];
        let names = (self.names.len(), "columns");
        check_count(line, names, &self.origin(from, until), Problem::NoTable)?;
        let mut row = Vec::with_capacity(self.columns.len());
        for (column, (offset, cell)) in cells(line).enumerate() {
            let at = from + offset;
            let name = &self.names[column];
            let refused = |problem| DocumentError::at(&self.origin(at, at + cell.len()), problem);
            match &**name {
                MODEL => self.models.push(model(cell).map_err(refused)?),
                WEIGHT => self.weights.push(weight(cell).map_err(refused)?),
                name => row.push(number(name, cell).map_err(refused)?),
            }
        }
        self.rows.push(row);
        Ok(())
    }

    /// Checks that weights go with models, that there is a sum of them, and that the rows of a
    /// model weigh the same.
    fn check_models(&self) -> Result<(), DocumentError> {
        let Some(column) = self.names.iter().position(|it| it == WEIGHT) else { return Ok(()) };
        let refused = |text: &str| {
            let problem = Problem::NoTable(text.to_owned());
            Err(DocumentError::at(&self.cell_of_line(0, column), problem))
        };
        if self.models.is_empty() {
            return refused("a column `weight` goes with a column `model`");
        }
        if self.weights.iter().sum::<f64>() <= 0.0 {
            return refused("no row has a weight above 0");
        }
        for (model, weight) in self.models.iter().zip(&self.weights) {
            let first = self.models.iter().position(|it| it == model).unwrap_or_default();
            if (weight - self.weights[first]).abs() > 1e-6 * weight.abs() {
                return refused("the rows of one model do not all weigh the same");
            }
        }
        Ok(())
    }

    /// The rows of each model that has a share above 0; none in a table that names no models.
    #[must_use]
    pub fn by_model(&self) -> Vec<RowsOfModel> {
        let weight = |row: usize| self.weights.get(row).copied().unwrap_or(1.0);
        let sum: f64 = (0..self.models.len()).map(weight).sum();
        let of_model = |model: Model| {
            let own = || (0..self.models.len()).filter(|row| self.models[*row] == model);
            let share = own().map(weight).sum::<f64>() / sum;
            let rows = own().map(|row| self.rows[row].clone()).collect();
            RowsOfModel { model, share, rows }
        };
        let all = Model::ALL.into_iter().map(of_model);
        all.filter(|it| it.share > 0.0).collect()
    }

    /// The distribution of which each sample is one of the rows, by their weights.
    #[must_use]
    pub fn distribution(&self) -> Distribution {
        if self.weights.is_empty() {
            return Distribution::of_samples(self.rows.clone());
        }
        let weighted = self.rows.iter().cloned().zip(self.weights.iter().copied());
        Distribution::of_weighted_samples(weighted.collect())
    }

    /// The table as CSV, with something before each of its keys.
    pub fn prefixed(&self, prefix: &str) -> String {
        let named = |(place, name): (usize, &String)| {
            if self.places.contains(&place) { format!("{prefix}{name}") } else { name.clone() }
        };
        let keys: Vec<String> = self.names.iter().enumerate().map(named).collect();
        let (_, end) = self.lines[0];
        format!("{}{}", keys.join(","), &self.text.content[end..])
    }

    /// The keys of the first line, without the model and the weight of a row.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// A number for each key, all finite.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Where a column has its name.
    pub fn column_origin(&self, column: usize) -> Origin {
        self.cell_of_line(0, self.places[column])
    }

    /// Where a row has its number for a column.
    pub fn cell_origin(&self, row: usize, column: usize) -> Origin {
        self.cell_of_line(row + 1, self.places[column])
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

/// A number of a row.
fn number(key: &str, cell: &str) -> Result<f64, Problem> {
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(Problem::NotFinite { key: key.to_owned(), value, range: String::new() }),
        Err(_) => Err(not(key, cell, "a number")),
    }
}

/// The weight of a row.
fn weight(cell: &str) -> Result<f64, Problem> {
    let value = number(WEIGHT, cell)?;
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Problem::OutOfRange { key: WEIGHT.to_owned(), value, range: "0 or more".to_owned() })
}

/// The model of a row.
fn model(cell: &str) -> Result<Model, Problem> {
    let names: Vec<&str> = Model::ALL.iter().map(Model::name).collect();
    let found = Model::ALL.into_iter().find(|model| model.name() == cell);
    found.ok_or_else(|| not(MODEL, cell, &names.join(", ")))
}

fn not(key: &str, cell: &str, expected: &str) -> Problem {
    let found = if cell.is_empty() {
        "missing".to_owned()
    } else {
        format!("the text \"{}\"", cell.chars().take(40).collect::<String>().escape_debug())
    };
    Problem::WrongType { key: key.to_owned(), found, expected: expected.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<SampleTable, DocumentError> {
        SampleTable::of_text("samples".to_owned(), text.to_owned())
    }

    #[test]
    fn rows_stand_under_their_models() {
        let found =
            table("weight,n,model,k\n3,1,rft,2\n1,3,ishigami,4\n3,5,rft,6\n1,7,ishigami,8\n");
        let found = found.unwrap();
        assert_eq!(found.columns(), ["n", "k"]);
        assert_eq!(found.rows()[1], [3.0, 4.0]);
        let [one, other] = &found.by_model()[..] else { panic!("two models") };
        assert_eq!((one.model.name(), one.share), ("ishigami", 0.25));
        assert_eq!(one.rows, [[3.0, 4.0], [7.0, 8.0]]);
        assert_eq!((other.model.name(), other.share), ("rft", 0.75));
        assert!(found.prefixed("soil.").starts_with("weight,soil.n,model,soil.k\n3,1,rft,2\n"));
        let point = |place: f64| found.distribution().at(&[place])[0];
        assert_eq!([0.1, 0.4, 0.6, 0.9].map(point), [1.0, 3.0, 5.0, 7.0]);
        let plain = table("n\n1\n2\n").unwrap();
        assert!(plain.by_model().is_empty());
    }

    #[test]
    fn models_and_weights_that_cannot_be_are_refused() {
        for (text, words) in [
            ("n,model\n1,rft\n2,reft\n", "the text \"reft\""),
            ("n,weight\n1,1\n2,1\n", "goes with a column `model`"),
            ("n,model,weight\n1,rft,1\n2,rft,2\n", "weigh the same"),
            ("n,model,weight\n1,rft,0\n2,rft,0\n", "weight above 0"),
            ("n,model,weight\n1,rft,-1\n2,rft,-1\n", "weight"),
        ] {
            let error = table(text).unwrap_err().to_string();
            assert!(error.contains(words), "{words} in {error}");
        }
    }
}
