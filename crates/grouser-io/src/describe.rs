//! The tables of each kind of document: the one place where a number of a document is declared.

pub mod campaign;
pub mod data_set;
pub mod rover;
pub mod scenario;
pub mod soil;
pub mod uncertainty;
pub mod wheel;

use super::Kind;
use super::field::{
    Field, Fill, M_S2, Reach, Rows, Shape, Word, day, field, note, nothing, number, texts, word,
    words,
};
use grouser_core::contact::Theory;
use grouser_core::units::EARTH_GRAVITY;

/// What a kind of document may say.
pub fn rows(kind: Kind) -> &'static dyn Rows {
    match kind {
        Kind::Soil => &soil::SOIL,
        Kind::Wheel => &wheel::WHEEL,
        Kind::Rover => &rover::ROVER,
        Kind::Scenario => &scenario::SCENARIO,
        Kind::DataSet => &data_set::DATA_SET,
        Kind::Campaign => &campaign::CAMPAIGN,
    }
}

/// Which kind of document it is, and of which version.
const fn schema<T>(tag: &'static str) -> Field<T> {
    field("schema", "Kind and version of this document.", Shape::Tag).otherwise(Fill::Word(tag))
}

/// What people call it.
const fn name<T>() -> Field<T> {
    note("name", "What people call it.").otherwise(UNNAMED)
}

/// What a run is there to show.
const fn purpose<T>() -> Field<T> {
    note("name", "What it is there to show.").otherwise(UNNAMED)
}

const UNNAMED: Fill = Fill::Word("unnamed");

/// Where the values come from.
const fn source<T>() -> Field<T> {
    note("source", "Where the values come from.").otherwise(NOT_STATED)
}

/// What a document says of its own source when it says nothing.
const NOT_STATED: Fill = Fill::Word("not stated");

/// Anything else.
const fn notes<T>() -> Field<T> {
    note("notes", "Anything else worth knowing.").optional()
}

/// What was assumed.
const fn assumed<T>() -> Field<T> {
    texts("assumed", "Values that the source does not give, each as `key: why this value`.")
}

/// The day on which the soil was as it is.
const fn date<T>() -> Field<T> {
    day(
        "date",
        "The day on which the soil was measured or observed to be like this, as 2026-11-20.",
    )
}

/// A wheel-soil model, by its name.
const fn model<T>(doc: &'static str) -> Field<T> {
    words("model", doc, Theories::<T>::WORDS).optional()
}

struct Theories<T>(std::marker::PhantomData<T>);

impl<T: 'static> Theories<T> {
    const WORDS: &'static [Word<T>] = &[
        word(Theory::Ishigami.name(), "Stresses along the arc (Ishigami et al. 2007).", nothing),
        word(Theory::Bekker.name(), "Bekker's closed form.", nothing),
        word(
            Theory::SmallWheel.name(),
            "Stresses along the arc, with the terms that small wheels need.",
            nothing,
        )
        .formerly("extended"),
        word(Theory::Rft.name(), "Resistive force theory on the wheel's facets.", nothing),
    ];
}

/// Gravity, that of Earth if nothing is said.
const fn gravity<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    number("gravity_m_s2", M_S2, 0.01..=30.0, doc, reach).or(EARTH_GRAVITY)
}
