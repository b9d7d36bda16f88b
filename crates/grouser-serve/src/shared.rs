//! What all connections share.

use std::sync::Arc;

use tokio::sync::Semaphore;

use crate::access::Access;
use crate::console::Console;
use crate::limits::Limits;
use crate::runs::RunPlaces;

/// What all connections share.
pub(crate) struct Shared {
    pub(crate) access: Access,
    pub(crate) console: Console,
    pub(crate) runs: RunPlaces,
    /// One list is made at a time: files are read for it.
    pub(crate) lists: Arc<Semaphore>,
    pub(crate) limits: Limits,
}
