//! Parts of an array of jobs.

use serde::{Deserialize, Serialize};

/// A part of an array of jobs: the shards whose number, divided by `of`, leaves `index` − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Part {
    /// From 1 to `of`.
    pub index: u64,
    /// How many parts there are.
    pub of: u64,
}

impl Part {
    /// Whether a shard belongs to it.
    #[must_use]
    pub fn has(self, shard: u64) -> bool {
        shard % self.of == self.index - 1
    }
}

/// A part is written as on the command line.
impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}
