//! The attitude over slope, course and soil: a curve for each course and soil, asked on each slope.
//!
//! Attitude, slip, sinkage and energy come by continuation along each curve, not by runs in time.
//! The level traverse is the row with course 0.

use rayon::prelude::*;

use super::attitude::{Attitude, AttitudeCurve, AttitudeStudy, NoAttitude};
use crate::error::ParameterError;

/// Attitudes over slope, course and soil.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeMap {
    /// Slopes, *α* [rad]: of the cells of each row.
    pub slopes: Vec<f64>,
    /// One for each soil and course: all courses of the first soil, then those of the next.
    pub rows: Vec<AttitudeRow>,
}

/// Attitudes of one course on one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeRow {
    /// Which of the studies, by its place.
    pub study: usize,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
    /// The steepest slope that has an attitude [rad], and what ends the curve there.
    pub limit: Result<(f64, String), NoAttitude>,
    /// The attitude on each slope, or why there is none.
    pub cells: Vec<Result<Attitude, NoAttitude>>,
    /// How many wheels were settled for the row.
    pub settled_wheels: u64,
}

impl AttitudeMap {
    /// Follows the curve of each course on each soil. Rows are shared among threads and keep their
    /// order: the result is the same for any number of threads.
    ///
    /// Which heading offsets hold courses of 15° downhill, the contour, and 15° uphill, on a slope of 10°?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::attitude::AttitudeStudy;
    /// use grouser::studies::attitude_map::AttitudeMap;
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    /// let courses = [-15.0, 0.0, 15.0].map(deg);
    /// let map = AttitudeMap::of(&[AttitudeStudy::of(&scenario)], &courses, &[deg(10.0)])?;
    /// let crab = |place: usize| match &map.rows[place].cells[0] {
    ///     Ok(heading) => format!("{:.2}°", (heading.yaw - heading.course).to_degrees()),
    ///     Err(reason) => reason.to_string(),
    /// };
    /// assert_eq!(crab(0), "4.60°");
    /// assert_eq!(crab(1), "5.04°");
    /// assert_eq!(crab(2), "5.07°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `studies`: one for each soil
    /// * `courses`: *χ* [rad], −π/2 to π/2
    /// * `slopes`: *α* [rad]
    ///
    /// # Errors
    /// [`ParameterError`] for the first soil or course that is none.
    pub fn of(
        studies: &[AttitudeStudy],
        courses: &[f64],
        slopes: &[f64],
    ) -> Result<Self, ParameterError> {
        let places = (0..studies.len()).flat_map(|study| courses.iter().map(move |c| (study, *c)));
        let places: Vec<(usize, f64)> = places.collect();
        let one = |&(study, course): &(usize, f64)| {
            let curve = studies[study].curve_on(course)?;
            Ok(AttitudeRow::of(study, &curve, slopes))
        };
        let all: Vec<Result<AttitudeRow, ParameterError>> = places.par_iter().map(one).collect();
        // Collected in order, so that the error is always that of the first row.
        let rows = all.into_iter().collect::<Result<Vec<AttitudeRow>, ParameterError>>()?;
        Ok(Self { slopes: slopes.to_vec(), rows })
    }
}

impl AttitudeRow {
    fn of(study: usize, curve: &AttitudeCurve, slopes: &[f64]) -> Self {
        let cells: Vec<_> = slopes.iter().map(|slope| curve.at(*slope)).collect();
        let asked: u64 = cells.iter().flatten().map(|attitude| attitude.settled_wheels).sum();
        Self {
            study,
            course: curve.course(),
            limit: curve.limit().map(|(slope, reason)| (slope, reason.to_owned())),
            cells,
            settled_wheels: curve.settled_wheels() + asked,
        }
    }
}
