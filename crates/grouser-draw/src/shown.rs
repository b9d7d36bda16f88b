//! Runs that are to be shown, and the frame of their pictures.

use grouser_core::simulation::{Scenario, Trajectory};

/// Width of the picture [mm].
pub(crate) const WIDTH: f64 = 160.0;
/// Height of the lines of text above it [mm].
pub(crate) const TOP: f64 = 12.0;

/// A run to be shown.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// What it is called where there are several.
    pub name: &'a str,
    /// The run.
    pub run: &'a Trajectory,
    /// What determined it.
    pub scenario: &'a Scenario,
}
