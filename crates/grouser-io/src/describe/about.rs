//! Rows that documents of all kinds, or of several, have: their names, sources and notes, the model
//! and gravity.

use super::super::field::{
    Field, Fill, Keyword, M_S2, Reach, Shape, day, field, note, nothing, number, texts, word, words,
};
use grouser_core::contact::Model;
use grouser_core::units::EARTH_GRAVITY;

/// Which kind of document it is, and of which version.
pub(super) const fn schema<T>(tag: &'static str) -> Field<T> {
    field("schema", "Kind and version of this document.", Shape::Tag).otherwise(Fill::Keyword(tag))
}

/// The document's name.
pub(super) const fn name<T>() -> Field<T> {
    note("name", "What people call it.").otherwise(UNNAMED)
}

/// The purpose of a run.
pub(super) const fn purpose<T>() -> Field<T> {
    note("name", "What it is there to show.").otherwise(UNNAMED)
}

const UNNAMED: Fill = Fill::Keyword("unnamed");

/// Where the values come from.
pub(super) const fn source<T>() -> Field<T> {
    note("source", "Where the values come from.").otherwise(NOT_STATED)
}

/// The source of a document that states none.
pub(super) const NOT_STATED: Fill = Fill::Keyword("not stated");

/// Anything else.
pub(super) const fn notes<T>() -> Field<T> {
    note("notes", "Anything else worth knowing.").optional()
}

/// What was assumed.
pub(super) const fn assumed<T>() -> Field<T> {
    texts("assumed", "Values that the source does not give, each as `key: why this value`.")
}

/// The day on which the soil was as it is.
pub(super) const fn date<T>() -> Field<T> {
    day(
        "date",
        "The day on which the soil was measured or observed to be like this, as 2026-11-20.",
    )
}

/// A wheel-soil model, by its name.
pub(super) const fn model<T>(doc: &'static str) -> Field<T> {
    words("model", doc, &Models::<T>::WORDS).optional()
}

struct Models<T>(std::marker::PhantomData<T>);

impl<T: 'static> Models<T> {
    const WORDS: [Keyword<T>; Model::COUNT] = [
        word(Model::Ishigami.name(), "Stresses along the arc (Ishigami et al. 2007).", nothing),
        word(Model::Bekker.name(), "Bekker's closed form.", nothing),
        word(
            Model::SmallWheel.name(),
            "Stresses along the arc, with the terms that small wheels need.",
            nothing,
        ),
        word(Model::Rft.name(), "Resistive force theory on the wheel's facets.", nothing),
    ];
}

/// Gravity; without the key, that of Earth.
pub(super) const fn gravity<T>(doc: &'static str, reach: Reach<T>) -> Field<T> {
    number("gravity_m_s2", M_S2, 0.01..=30.0, doc, reach).or(EARTH_GRAVITY)
}
