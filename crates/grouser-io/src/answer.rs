//! The answer of a study, as data: what it was computed from, tables, figures and sentences.
//!
//! A study declares its answer once. What writes one to a terminal, as JSON, CSV, a page or a folder
//! knows no study: it takes the parts in their order.

use std::borrow::Cow;
use std::sync::Arc;

use grouser_core::contact::validity::Finding;
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Map, Value, json};

use super::columns::Column;
use super::document::Document;
use super::figure::{Chart, Figure};
use super::given_file::GivenFile;
use super::loaded::Loaded;
use super::table::{Table, WithObject};
use super::tree::Companion;

/// What a study answers. As JSON it is an object: the schema, the version, the inputs, and the
/// results.
///
/// ```
/// use grouser_io::answer::{Answer, Member};
/// use grouser_io::table::Table;
///
/// let mut answer = Answer::new("heading", "Heading offset that holds the contour");
/// answer.input("slope_deg", [5.0, 10.0]);
/// answer.results.push(Member::rows("rows", Table::default()));
/// let json = serde_json::to_value(&answer)?;
/// assert_eq!(json["schema"], "grouser.heading.v1");
/// assert_eq!(json["inputs"]["slope_deg"][1], 10.0);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Answer {
    /// The name that its files have, and its schema if that has no other: `heading`.
    pub name: String,
    /// The name that its schema has, where it is another.
    pub schema: Option<String>,
    /// What it is about: the title of its page.
    pub title: String,
    /// What it was computed from, in the words and units of documents.
    pub inputs: Map<String, Value>,
    /// What is believed of the soil, as JSON has it: its name, the number of samples, and the models
    /// with their shares; `None` where it has no such key.
    pub belief: Option<Value>,
    /// The models of a band with their shares, as JSON has them; `None` where it has no such key.
    pub model_weights: Option<Value>,
    /// The results of JSON, in their order.
    pub results: Vec<Member>,
    /// Tables that are files of CSV, each with its name without the ending. The first is the answer
    /// where CSV is asked for.
    pub tables: Vec<(String, Arc<Table>)>,
    /// What a terminal shows, in its order.
    pub screen: Vec<Displayed>,
    /// What a page shows, in its order, before what all pages end with.
    pub page: Vec<PageBlock>,
    /// Where results are outside a domain; `None` where nobody looked.
    pub findings: Option<Vec<Finding>>,
    /// What the columns are.
    pub columns: Vec<ColumnMeaning>,
    /// The documents that it was computed from.
    pub documents: Vec<Attached>,
    /// What the files gave that it was computed from. As JSON they stand among the inputs.
    pub given: Vec<GivenFile>,
    /// Commands to go on with, typed in the folder of its page. A front end writes them: it alone
    /// knows its options.
    pub next: Vec<String>,
}

/// A part of the results.
#[derive(Clone, Debug)]
pub enum Member {
    /// A list of rows under a key.
    Rows(&'static str, Arc<Table>),
    /// The same, each row with an object under a key of its own.
    With(&'static str, Arc<Table>, &'static str, Table),
    /// The row of a table that has one, under a key; without one its entries stand in the answer
    /// itself.
    Row(Option<&'static str>, Table),
    /// Anything else, under a key.
    Value(&'static str, Value),
    /// Entries that stand in the answer itself.
    Entries(Map<String, Value>),
}

/// Something that a terminal shows.
#[derive(Clone, Debug)]
pub enum Displayed {
    /// Columns of a table, by their names.
    Rows(Arc<Table>, Vec<String>),
    /// The same, in the width of a terminal as tables of two columns against each other.
    Crossed {
        /// All rows.
        table: Arc<Table>,
        /// The columns where no terminal is.
        columns: Vec<String>,
        /// How they are set against each other.
        crossing: CrossTable,
    },
    /// Columns of some of many rows, as far apart as each other.
    Excerpt {
        /// All rows.
        table: Arc<Table>,
        /// The columns.
        columns: Vec<String>,
        /// How many rows at the most.
        most: usize,
        /// What the rows are.
        what: &'static str,
    },
    /// Words, with the line ends that they need.
    Words(String),
}

/// Tables of two columns against each other: one goes down, one across.
#[derive(Clone, Debug)]
pub struct CrossTable {
    /// What each block of rows is of; all blocks have as many rows.
    pub titles: Vec<String>,
    /// The column that goes down.
    pub down: &'static str,
    /// How many values it has.
    pub rows_down: usize,
    /// The column that goes across; its values change slowest.
    pub across: &'static str,
    /// What goes across, for reading.
    pub across_label: String,
    /// The columns that stand in cells, a table for each.
    pub cells: Vec<String>,
}

/// A block of a page.
#[derive(Clone, Debug)]
pub enum PageBlock {
    /// A sentence that answers the question.
    Verdict(String),
    /// A heading.
    Heading(String),
    /// A paragraph.
    Words(String),
    /// A list.
    List(Vec<String>),
    /// Columns of a table, by their names, under a caption.
    Rows {
        /// What the rows are.
        caption: &'static str,
        /// All columns.
        table: Arc<Table>,
        /// The columns for reading.
        columns: Vec<String>,
    },
    /// A figure.
    Figure {
        /// What is drawn.
        figure: Figure,
        /// What it shows.
        caption: String,
        /// The name of its file in a folder, without the ending, if it has one.
        file: Option<String>,
    },
    /// Small charts side by side.
    Charts(Vec<Chart>),
    /// What stands after all else, shown when a reader asks for it.
    Folded {
        /// What it is.
        title: String,
        /// In their order; none is folded once more.
        blocks: Vec<PageBlock>,
    },
    /// A picture of what no figure has, which the front end draws.
    Picture {
        /// The name of its file.
        file: String,
        /// What it shows.
        caption: String,
    },
}

/// A column's name, unit and meaning, for readers.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnMeaning {
    /// Its name; several of quantiles are one text.
    pub name: String,
    /// Symbol of its unit.
    pub unit: &'static str,
    /// What it is.
    pub doc: &'static str,
}

/// A document that an answer was computed from.
#[derive(Clone, Debug)]
pub struct Attached {
    /// The name of its file.
    pub file: String,
    /// Its complete text.
    pub toml: String,
    /// The files that it names.
    pub companions: Vec<Companion>,
    /// What it assumes.
    pub assumptions: Vec<String>,
}

impl Answer {
    /// An answer without content.
    ///
    /// * `name`: of its schema and files
    /// * `title`: of its page
    pub fn new(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self { name: name.into(), title: title.into(), ..Self::default() }
    }

    /// The same with a schema that has another name than its files.
    #[must_use]
    pub fn with_schema(self, name: impl Into<String>) -> Self {
        Self { schema: Some(name.into()), ..self }
    }

    /// Adds an input, in the words and units of documents.
    pub fn input(&mut self, key: &str, value: impl Into<Value>) {
        self.inputs.insert(key.to_owned(), value.into());
    }

    /// Adds the values of some keys of a document; null where it has none.
    pub fn inputs_of<'k>(&mut self, document: &Document, keys: impl IntoIterator<Item = &'k str>) {
        for key in keys {
            self.input(key, document.get(key).cloned().unwrap_or_default());
        }
    }

    /// Adds a document by the name of its file, and what the files gave that it names.
    pub fn attach<V>(&mut self, file: impl Into<String>, document: &Loaded<V>) {
        self.documents.push(Attached {
            file: file.into(),
            toml: document.to_toml(),
            companions: document.companions.clone(),
            assumptions: document.assumptions.clone(),
        });
        self.given.extend(document.given.iter().cloned());
    }

    /// Adds a figure to the page.
    ///
    /// * `file`: its name without the ending, if it is a file too
    pub fn figure(
        &mut self,
        file: Option<&str>,
        figure: impl Into<Figure>,
        caption: impl Into<String>,
    ) {
        let file = file.map(str::to_owned);
        self.page.push(PageBlock::Figure { figure: figure.into(), caption: caption.into(), file });
    }

    /// Adds columns of a table to the page.
    pub fn rows(&mut self, caption: &'static str, table: &Arc<Table>, columns: Vec<String>) {
        self.page.push(PageBlock::Rows { caption, table: Arc::clone(table), columns });
    }

    /// Adds a sentence that answers the question to the page.
    pub fn verdict(&mut self, text: impl Into<String>) {
        self.page.push(PageBlock::Verdict(text.into()));
    }

    /// Adds a list to the page.
    pub fn list(&mut self, items: impl IntoIterator<Item = String>) {
        self.page.push(PageBlock::List(items.into_iter().collect()));
    }

    /// Adds small charts side by side to the page.
    pub fn charts(&mut self, charts: Vec<Chart>) {
        self.page.push(PageBlock::Charts(charts));
    }

    /// Adds what stands after all else on the page, shown when a reader asks for it.
    ///
    /// * `add`: adds its blocks
    pub fn folded(&mut self, title: impl Into<String>, add: impl FnOnce(&mut Self)) {
        let before = std::mem::take(&mut self.page);
        add(self);
        let blocks = std::mem::replace(&mut self.page, before);
        self.page.push(PageBlock::Folded { title: title.into(), blocks });
    }

    /// All blocks of the page, those that are folded too.
    pub fn blocks(&self) -> impl Iterator<Item = &PageBlock> {
        self.page.iter().flat_map(|block| match block {
            PageBlock::Folded { blocks, .. } => blocks.iter(),
            one => std::slice::from_ref(one).iter(),
        })
    }

    /// Adds a paragraph to the page.
    pub fn words(&mut self, text: impl Into<String>) {
        self.page.push(PageBlock::Words(text.into()));
    }

    /// Adds a heading to the page.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.page.push(PageBlock::Heading(text.into()));
    }

    /// The assumptions of all its documents, each once.
    #[must_use]
    pub fn assumptions(&self) -> Vec<&str> {
        let mut all: Vec<&str> = Vec::new();
        for assumption in self.documents.iter().flat_map(|it| &it.assumptions) {
            if !all.contains(&assumption.as_str()) {
                all.push(assumption);
            }
        }
        all
    }
}

/// Inputs with what files gave, where there are any.
#[must_use]
pub fn with_files<'i>(
    inputs: &'i Map<String, Value>,
    given: &[GivenFile],
) -> Cow<'i, Map<String, Value>> {
    if given.is_empty() {
        return Cow::Borrowed(inputs);
    }
    let mut inputs = inputs.clone();
    inputs.insert("files".to_owned(), json!(given));
    Cow::Owned(inputs)
}

impl Member {
    /// Rows under a key.
    pub fn rows(key: &'static str, table: impl Into<Arc<Table>>) -> Self {
        Self::Rows(key, table.into())
    }
}

/// What columns are; those of several quantiles are one each.
#[must_use]
pub fn meanings<R>(columns: &[Column<R>]) -> Vec<ColumnMeaning> {
    let each = |column: &Column<R>| {
        let name = column.names().join(", ");
        ColumnMeaning { name, unit: column.unit.symbol, doc: column.doc }
    };
    columns.iter().map(each).collect()
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        let schema = self.schema.as_ref().unwrap_or(&self.name);
        map.serialize_entry("schema", &format!("grouser.{schema}.v1"))?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("inputs", &with_files(&self.inputs, &self.given))?;
        if let Some(belief) = &self.belief {
            map.serialize_entry("belief", belief)?;
        }
        if let Some(weights) = &self.model_weights {
            map.serialize_entry("model_weights", weights)?;
        }
        for part in &self.results {
            match part {
                Member::Rows(key, table) => map.serialize_entry(key, &**table)?,
                Member::With(key, rows, name, of) => {
                    map.serialize_entry(key, &WithObject { rows, name, of })?;
                }
                Member::Row(Some(key), table) => map.serialize_entry(key, &table.row(0))?,
                Member::Row(None, table) => table.row(0).write(&mut map)?,
                Member::Value(key, value) => map.serialize_entry(key, value)?,
                Member::Entries(entries) => {
                    for (key, value) in entries {
                        map.serialize_entry(key, value)?;
                    }
                }
            }
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::Values;

    #[test]
    fn json_has_its_parts_in_their_order() {
        let table = |name: &str, number: f64| Table {
            columns: vec![(name.to_owned(), Values::Float(vec![Some(number), None]))],
        };
        let mut answer = Answer::new("heading", "A heading");
        answer.input("slope_deg", 5.0);
        answer.results = vec![
            Member::Row(None, table("limit_slope_deg", 20.0)),
            Member::Row(Some("work"), table("energy_j", 3.0)),
            Member::rows("rows", table("yaw_deg", 1.5)),
            Member::Value("notes", json!(["one"])),
        ];
        let text = serde_json::to_string(&answer).unwrap();
        let keys: Vec<String> = serde_json::from_str::<Map<String, Value>>(&text)
            .unwrap()
            .into_iter()
            .map(|(key, _)| key)
            .collect();
        let expected = ["schema", "version", "inputs", "limit_slope_deg", "work", "rows", "notes"];
        assert_eq!(keys, expected);
        assert!(
            text.contains(r#""work":{"energy_j":3.0},"rows":[{"yaw_deg":1.5},{"yaw_deg":null}]"#)
        );
    }
}
