//! What questions are asked of.

#[cfg(feature = "server")]
use crate::cards::CardMaker;
use crate::folder::ServedFolder;
#[cfg(feature = "server")]
use crate::maps::KeptOfMaps;

/// What questions are asked of.
pub(crate) struct Console {
    pub(crate) folder: ServedFolder,
    /// What was computed of maps.
    #[cfg(feature = "server")]
    pub(crate) kept: KeptOfMaps,
    /// What draws the operator's card.
    #[cfg(feature = "server")]
    pub(crate) card: Option<CardMaker>,
}
