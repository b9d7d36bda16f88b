//! What all connections share.

use std::sync::Arc;

use tokio::sync::Semaphore;

use crate::access::Access;
use crate::folder::ServedFolder;
use crate::limits::Limits;
use crate::maps::KeptOfMaps;
use crate::runs::RunPlaces;

/// What all connections share.
pub(crate) struct Console {
    pub(crate) access: Access,
    pub(crate) folder: ServedFolder,
    pub(crate) runs: RunPlaces,
    /// One list is made at a time: files are read for it.
    pub(crate) lists: Arc<Semaphore>,
    /// What was computed of maps.
    pub(crate) kept: KeptOfMaps,
    pub(crate) limits: Limits,
}
