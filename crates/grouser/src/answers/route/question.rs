//! What is asked of ways.

use std::path::Path;

use grouser_raster::Raster;

use super::super::Sampling;
use crate::document::LoadedScenario;
use crate::document::given_file::GivenFile;
use crate::studies::mobility::Ground;
use crate::studies::route::{Ends, Line, RouteError, RouteStudy};

/// The question.
#[derive(Clone, Copy, Debug)]
pub struct RouteQuestion<'q> {
    /// The file of the heights.
    pub dem: &'q Path,
    /// The heights.
    pub raster: &'q Raster,
    /// The scenario of rover, soil, gravity and model.
    pub scenario: &'q LoadedScenario,
    /// Its study.
    pub study: &'q RouteStudy,
    /// What is asked.
    pub asked: &'q Asked,
    /// The file of the line, if one is given.
    pub along: Option<&'q Path>,
    /// The file of the areas where nobody may go, if there are any.
    pub keep_out: Option<&'q Path>,
    /// What the files gave of that line and these areas.
    pub given: &'q [GivenFile],
    /// The samples of soil and model.
    pub sampling: Sampling,
}

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub enum Asked {
    /// A way between two places.
    Between(Ends),
    /// What a line takes.
    Along(Line),
}

impl Asked {
    /// Checks that the ground has what is asked about.
    ///
    /// # Errors
    /// [`RouteError`] for places that are not on the map, and too many of them.
    pub fn check(&self, ground: Ground<'_>) -> Result<(), RouteError> {
        match self {
            Self::Between(ends) => ends.check(ground),
            Self::Along(line) => line.check(ground),
        }
    }

    /// The straight line from start to target [m].
    #[must_use]
    pub fn straight(&self) -> f64 {
        match self {
            Self::Between(ends) => ends.distance(),
            Self::Along(line) => line.straight(),
        }
    }
}

impl RouteQuestion<'_> {
    /// Whether a line is asked about, and no way is sought.
    pub(super) fn has_line(&self) -> bool {
        matches!(self.asked, Asked::Along(_))
    }
}
