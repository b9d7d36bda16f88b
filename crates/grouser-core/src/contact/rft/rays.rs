//! Radii of a wheel.

use crate::contact::lanes::Each;

/// Some radii of the wheel, side by side.
pub(super) struct Rays {
    /// Each stands for this angle [rad].
    pub(super) width: Each,
    /// From straight down [rad].
    pub(super) angle: Each,
    pub(super) sin: Each,
    pub(super) cos: Each,
}
