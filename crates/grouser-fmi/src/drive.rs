//! Who turns the wheels of an FMU's rover.

/// Who turns the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// The importer, by the inputs.
    Inputs,
    /// The document: a scenario's drive or a mission's legs.
    Document,
}

impl Drive {
    /// Both, by the words that say them.
    pub const ALL: [(&'static str, Self); 2] =
        [("inputs", Self::Inputs), ("document", Self::Document)];

    /// The word that says it.
    pub(crate) fn word(self) -> &'static str {
        let [inputs, document] = Self::ALL.map(|(word, _)| word);
        if self == Self::Inputs { inputs } else { document }
    }
}
