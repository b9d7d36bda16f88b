//! What a file calls a zone.

use std::fmt;

/// What a file calls a zone.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ZoneKey {
    /// A class number.
    Class(i64),
    /// A name.
    Name(String),
}

impl fmt::Display for ZoneKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Characters of a name that are shown.
        const LONGEST: usize = 60;
        match self {
            Self::Class(number) => write!(f, "{number}"),
            Self::Name(name) => {
                let shown: String =
                    name.chars().filter(|c| !c.is_control()).take(LONGEST).collect();
                write!(f, "\"{shown}\"")
            }
        }
    }
}

/// Keys for a message: the first few.
pub(crate) fn listed(keys: &[ZoneKey]) -> String {
    const SHOWN: usize = 20;
    let mut shown: Vec<String> = keys.iter().take(SHOWN).map(ToString::to_string).collect();
    if keys.len() > SHOWN {
        shown.push(format!("and {} more", keys.len() - SHOWN));
    }
    shown.join(", ")
}
