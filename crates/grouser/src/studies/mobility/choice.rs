//! Which course is looked at, slope by slope.

use super::table::{MobilityTable, OnSlope};
use crate::studies::heading::STRAIGHT_UP;
use crate::units::STEEPEST_SLOPE;

/// The direction of travel that a map is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CourseChoice {
    /// This one, *χ* [rad], counted from the contour, positive uphill.
    Fixed(f64),
    /// On each slope the one that is least often a no-go, and of several the one with the least
    /// slip, up or down.
    Best,
    /// The one that is most often a no-go, and of several the one with the most slip.
    Worst,
}

impl CourseChoice {
    /// The courses that are compared where none is fixed [rad]: straight down to straight up, 15°
    /// apart.
    #[must_use]
    pub fn courses(self) -> Vec<f64> {
        match self {
            Self::Fixed(course) => vec![course],
            Self::Best | Self::Worst => {
                (-6_i8..=6).map(|step| f64::from(step) / 6.0 * STRAIGHT_UP).collect()
            }
        }
    }
}

/// The chosen one of several tables, by slope.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Choice {
    /// For each interval of slopes the number of a table.
    tables: Vec<usize>,
}

/// Width of an interval of slopes [rad]: a twentieth of a degree.
const WIDTH: f64 = std::f64::consts::PI / 3600.0;

impl Choice {
    /// * `tables`: at least one
    pub(super) fn of(choice: CourseChoice, tables: &[MobilityTable]) -> Self {
        if let CourseChoice::Fixed(_) = choice {
            return Self { tables: vec![0] };
        }
        let middles = (0..).map(|interval| (f64::from(interval) + 0.5) * WIDTH);
        let chosen = middles.take_while(|slope| *slope < STEEPEST_SLOPE).map(|slope| {
            let worse = |one: &usize, other: &usize| {
                let [one, other] = [one, other].map(|it| rank(&tables[*it].at(slope)));
                one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1]))
            };
            let all = 0..tables.len();
            let found = match choice {
                CourseChoice::Worst => all.max_by(worse),
                CourseChoice::Best | CourseChoice::Fixed(_) => all.min_by(worse),
            };
            found.unwrap_or(0)
        });
        Self { tables: chosen.collect() }
    }

    /// The number of the table for a slope [rad].
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a slope is not negative, and the last interval is open"
    )]
    pub(super) fn at(&self, slope: f64) -> usize {
        self.tables[((slope / WIDTH) as usize).min(self.tables.len() - 1)]
    }
}

/// How bad a motion is: by how often it fails, then by its slip.
fn rank(found: &OnSlope) -> [f64; 2] {
    [found.probability_no_go, found.motion.map_or(f64::INFINITY, |motion| motion.slip_ratio.abs())]
}
