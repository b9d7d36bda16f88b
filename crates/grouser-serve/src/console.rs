//! What questions are asked of.

use crate::folder::ServedFolder;
#[cfg(feature = "server")]
use crate::maps::KeptOfMaps;

/// What questions are asked of.
pub(crate) struct Console {
    pub(crate) folder: ServedFolder,
    /// What was computed of maps.
    #[cfg(feature = "server")]
    pub(crate) kept: KeptOfMaps,
}
