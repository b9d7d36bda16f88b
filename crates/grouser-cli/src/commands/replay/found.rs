//! A drive that was replayed.

use grouser::document::table::Table;
use grouser::studies::replay::Replay;

/// A drive that was replayed, as tables and sentences.
pub(super) struct Found {
    pub(super) replay: Replay,
    pub(super) over_time: Table,
    pub(super) channels: Table,
    pub(super) findings: Table,
    /// What the differences point to.
    pub(super) sentences: Vec<String>,
    pub(super) notes: Vec<String>,
}
