//! Rows and columns of a campaign's results.

/// What a row has at one place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// As documents and results name it: `sinkage_mm`, or an input's key.
    pub name: String,
    /// What stands in it.
    pub kind: ColumnKind,
    /// What it tells of a run.
    pub role: Role,
}

/// What stands in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// Numbers.
    Float,
    /// Whole numbers that are not negative.
    Whole,
    /// Words and sentences.
    Text,
}

/// What a column tells of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Which run it is.
    Index,
    /// What was drawn for it.
    Input,
    /// Whether it has an answer, and what became of it.
    Status,
    /// The answer.
    Result,
}

impl Column {
    pub(super) fn new(name: impl Into<String>, kind: ColumnKind, role: Role) -> Self {
        Self { name: name.into(), kind, role }
    }

    /// Its unit, by the end of its name; none for a number without and for texts.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        (self.kind == ColumnKind::Float).then(|| unit(&self.name)).flatten()
    }
}

/// Ends of keys and columns, and the units that they stand for, longer ends first: `_m_per_m` is no
/// `_m`. The table of the Python package is this one; a test compares them, and the table of
/// `docs/conventions.md`.
pub const UNITS: [(&str, &str); 24] = [
    ("_m_per_m", "m/m"),
    ("_j_per_m", "J/m"),
    ("_per_rad2_m", "m/rad²"),
    ("_per_rad_m", "m/rad"),
    ("_kg_m2.xx", "kg·m²"),
    ("_kg_m2.yy", "kg·m²"),
    ("_kg_m2.zz", "kg·m²"),
    ("_kg_m2", "kg·m²"),
    ("_kg_m3", "kg/m³"),
    ("_m_s2", "m/s²"),
    ("_rad_s", "rad/s"),
    ("_deg_s", "°/s"),
    ("_m_s", "m/s"),
    ("_s_m", "s/m"),
    ("_deg", "°"),
    ("_kpa", "kPa"),
    ("_kg", "kg"),
    ("_mm", "mm"),
    ("_nm", "N·m"),
    ("_n", "N"),
    ("_m", "m"),
    ("_s", "s"),
    ("_w", "W"),
    ("_j", "J"),
];

/// The unit that a key or a column ends with.
#[must_use]
pub fn unit(name: &str) -> Option<&'static str> {
    // An entry of a list has its list's unit.
    let name = match name.rsplit_once('.') {
        Some((list, place)) if place.parse::<usize>().is_ok() => list,
        _ => name,
    };
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| *unit)
}

/// What a row says at one place.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number.
    Float(Option<f64>),
    /// A whole number.
    Whole(Option<u64>),
    /// A word or a sentence.
    Text(Option<String>),
}

impl Cell {
    pub(super) fn text(text: impl Into<String>) -> Self {
        Self::Text(Some(text.into()))
    }

    /// Nothing.
    pub(super) fn none(kind: ColumnKind) -> Self {
        match kind {
            ColumnKind::Float => Self::Float(None),
            ColumnKind::Whole => Self::Whole(None),
            ColumnKind::Text => Self::Text(None),
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
}

impl Values {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn of(kind: ColumnKind, length: usize) -> Self {
        match kind {
            ColumnKind::Float => Self::Float(Vec::with_capacity(length)),
            ColumnKind::Whole => Self::Whole(Vec::with_capacity(length)),
            ColumnKind::Text => Self::Text(Vec::with_capacity(length)),
        }
    }

    fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Float(values), Cell::Float(value)) => values.push(value),
            (Self::Whole(values), Cell::Whole(value)) => values.push(value),
            (Self::Text(values), Cell::Text(value)) => values.push(value),
            _ => unreachable!("a cell is of its column's kind"),
        }
    }
}

/// Rows by their columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names and values, in the order of the campaign's columns.
    pub columns: Vec<(String, Values)>,
}

impl Table {
    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
    }

    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Values> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, values)| values)
    }

    pub(super) fn of(columns: &[Column], rows: Vec<Vec<Cell>>) -> Self {
        let empty = |column: &Column| (column.name.clone(), Values::of(column.kind, rows.len()));
        let mut table = Self { columns: columns.iter().map(empty).collect() };
        for row in rows {
            for ((_, values), cell) in table.columns.iter_mut().zip(row) {
                values.push(cell);
            }
        }
        table
    }
}
