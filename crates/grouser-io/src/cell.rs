//! What stands in a table of results: a cell, and a column of them.

use std::borrow::Cow;

use serde::ser::{Serialize, SerializeMap, Serializer};

/// The kind of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// Numbers.
    Float,
    /// Whole numbers that are not negative.
    Whole,
    /// Words and sentences.
    Text,
    /// Names, as many as there are.
    Words,
}

/// The value of a row in one column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number.
    Float(Option<f64>),
    /// A whole number.
    Whole(Option<u64>),
    /// A word or a sentence.
    Text(Option<String>),
    /// Names, as many as there are.
    Words(Vec<Cow<'static, str>>),
}

impl Cell {
    /// A cell with a text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(Some(text.into()))
    }

    /// Nothing.
    #[must_use]
    pub fn none(kind: ColumnKind) -> Self {
        match kind {
            ColumnKind::Float => Self::Float(None),
            ColumnKind::Whole => Self::Whole(None),
            ColumnKind::Text => Self::Text(None),
            ColumnKind::Words => Self::Words(Vec::new()),
        }
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Float(value) => value.serialize(serializer),
            Self::Whole(value) => value.serialize(serializer),
            Self::Text(value) => value.serialize(serializer),
            Self::Words(value) => value.serialize(serializer),
        }
    }
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Float(Vec<Option<f64>>),
    /// Whole numbers.
    Whole(Vec<Option<u64>>),
    /// Words and sentences.
    Text(Vec<Option<String>>),
    /// Lists of names.
    Words(Vec<Vec<Cow<'static, str>>>),
}

/// Between names where a list has to be one text.
pub const BETWEEN_NAMES: &str = ";";

impl Values {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Text(values) => values.len(),
            Self::Words(values) => values.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn of(kind: ColumnKind, length: usize) -> Self {
        match kind {
            ColumnKind::Float => Self::Float(Vec::with_capacity(length)),
            ColumnKind::Whole => Self::Whole(Vec::with_capacity(length)),
            ColumnKind::Text => Self::Text(Vec::with_capacity(length)),
            ColumnKind::Words => Self::Words(Vec::with_capacity(length)),
        }
    }

    /// Some of them, by their places.
    pub(super) fn select(&self, rows: &[usize]) -> Self {
        match self {
            Self::Float(values) => Self::Float(rows.iter().map(|row| values[*row]).collect()),
            Self::Whole(values) => Self::Whole(rows.iter().map(|row| values[*row]).collect()),
            Self::Text(values) => Self::Text(rows.iter().map(|row| values[*row].clone()).collect()),
            Self::Words(values) => {
                Self::Words(rows.iter().map(|row| values[*row].clone()).collect())
            }
        }
    }

    /// Adds what is missing to so many, without a value.
    pub(super) fn pad(&mut self, length: usize) {
        let length = length.max(self.len());
        match self {
            Self::Float(values) => values.resize(length, None),
            Self::Whole(values) => values.resize(length, None),
            Self::Text(values) => values.resize(length, None),
            Self::Words(values) => values.resize(length, Vec::new()),
        }
    }

    pub(super) fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Float(values), Self::Float(more)) => values.extend(more),
            (Self::Whole(values), Self::Whole(more)) => values.extend(more),
            (Self::Text(values), Self::Text(more)) => values.extend(more),
            (Self::Words(values), Self::Words(more)) => values.extend(more),
            _ => unreachable!("both are of one column"),
        }
    }

    pub(super) fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Float(values), Cell::Float(value)) => values.push(value),
            (Self::Whole(values), Cell::Whole(value)) => values.push(value),
            (Self::Text(values), Cell::Text(value)) => values.push(value),
            (Self::Words(values), Cell::Words(value)) => values.push(value),
            _ => unreachable!("a cell is of its column's kind"),
        }
    }

    /// Writes one of them as the value of a key.
    pub(super) fn write<M: SerializeMap>(
        &self,
        map: &mut M,
        name: &str,
        row: usize,
    ) -> Result<(), M::Error> {
        match self {
            Self::Float(values) => map.serialize_entry(name, &values[row]),
            Self::Whole(values) => map.serialize_entry(name, &values[row]),
            Self::Text(values) => map.serialize_entry(name, &values[row]),
            Self::Words(values) => map.serialize_entry(name, &values[row]),
        }
    }
}
