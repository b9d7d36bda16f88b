//! What a rover does at a place of a map.

use super::choice::{Choice, CourseChoice};
use super::table::{Mobility, MobilityStudy, MobilityTable, OnSlope};
use crate::elementary::wide::{atan2, sin_cos};
use crate::error::ParameterError;
use crate::studies::card::Verdict;
use crate::studies::ensemble::samples::Sample;
use crate::units::Vec2;

/// Motions of a rover at any place of ground with one soil, from the gradient there.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilityMap {
    tables: Vec<MobilityTable>,
    choice: Choice,
}

/// What a rover does at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellMotion {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Course, *χ* [rad]: counted from the contour with the hill on the left, positive uphill.
    pub course: f64,
    /// Where the nose points to hold the course [rad]: from the map's x axis to the left, of the
    /// horizontal projection; none on level ground, which has no contour, and where no heading
    /// holds the course.
    pub heading: Option<f64>,
    /// The motion, if a heading holds the course.
    pub motion: Option<Mobility>,
    /// Whether to drive there.
    pub verdict: Verdict,
    /// In which share of the samples the place is a no-go [-].
    pub probability_no_go: f64,
}

impl MobilityMap {
    /// Makes the tables; `None` if `go_on` was false before the end.
    ///
    /// * `samples`: of soil and model; with none the soil as written is judged by
    /// * `go_on`: asked before each sample of each course, from any thread
    ///
    /// # Errors
    /// The same as [`MobilityStudy::table`].
    pub fn of(
        study: &MobilityStudy,
        choice: CourseChoice,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        let table = |course: f64| study.table(course, samples, go_on);
        let tables =
            choice.courses().into_iter().map(table).collect::<Result<Option<Vec<_>>, _>>()?;
        Ok(tables.map(|tables| Self { choice: Choice::of(choice, &tables), tables }))
    }

    /// The tables, one for each course that is compared.
    #[must_use]
    pub fn tables(&self) -> &[MobilityTable] {
        &self.tables
    }

    /// The largest differences of all tables from their curves.
    #[must_use]
    pub fn largest_errors(&self) -> Mobility {
        let errors = self.tables.iter().map(MobilityTable::largest_errors);
        errors.fold(Mobility::default(), |worst, it| worst.with(it, f64::max))
    }

    /// What the rover does where the ground rises by a gradient, to the map's x and y [m/m].
    #[must_use]
    pub fn at(&self, gradient: Vec2) -> CellMotion {
        let slope = atan2(gradient.norm(), 1.0);
        let table = &self.tables[self.choice.at(slope)];
        let OnSlope { motion, verdict, probability_no_go } = table.at(slope);
        let course = table.course();
        let heading = motion.filter(|_| is_inclined(gradient)).map(|motion| {
            let along = atan2(-gradient.x, gradient.y);
            projected(along, slope, course + motion.crab)
        });
        CellMotion { slope, course, heading, motion, verdict, probability_no_go }
    }
}

/// Whether there is a contour.
pub(super) fn is_inclined(gradient: Vec2) -> bool {
    /// Slope that rounding may leave on level ground [m/m].
    const LEVEL: f64 = 1e-9;
    gradient.norm() > LEVEL
}

/// The direction on the map of one on a slope [rad], −π to π.
///
/// * `along`: the direction of the contour with the hill on the left [rad]
/// * `yaw`: on the slope, from the contour, positive uphill [rad]
pub(super) fn projected(along: f64, slope: f64, yaw: f64) -> f64 {
    let (sin, cos) = sin_cos(yaw);
    let (uphill, forward) = (sin * sin_cos(slope).1, cos);
    let (sin_along, cos_along) = sin_cos(along);
    atan2(sin_along * forward + cos_along * uphill, cos_along * forward - sin_along * uphill)
}
