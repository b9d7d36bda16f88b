//! A way, as it is shown.

use grouser::document::route::RouteRecord;
use grouser::units::Vec2;

/// A way that was found or given, or why there is none.
pub(super) struct Way {
    pub(super) record: RouteRecord,
    /// None where none was found [m].
    pub(super) places: Vec<Vec2>,
}
