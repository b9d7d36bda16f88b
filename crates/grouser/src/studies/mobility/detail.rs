//! How much a table has.

/// How much a table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::studies) enum Detail {
    /// All: for maps.
    Full,
    /// Fewer nodes, no drift, steepest slopes of the samples from the points of their curves, and
    /// no errors: for routes, which have many courses.
    Rough,
}

impl Detail {
    /// Intervals between nodes.
    pub(super) fn intervals(self) -> usize {
        match self {
            Self::Full => 2048,
            Self::Rough => 64,
        }
    }
}
