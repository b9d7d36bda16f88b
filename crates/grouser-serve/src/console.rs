//! What all connections share.

use crate::access::Access;
use crate::folder::ServedFolder;
use crate::limits::Limits;
use crate::runs::RunPlaces;

/// What all connections share.
pub(crate) struct Console {
    pub(crate) access: Access,
    pub(crate) folder: ServedFolder,
    pub(crate) runs: RunPlaces,
    pub(crate) limits: Limits,
}
