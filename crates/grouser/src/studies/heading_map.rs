//! The heading offset over slope, course and soil: a curve for each course and soil, read on each
//! slope.
//!
//! Heading offset, slip, sinkage and energy come by continuation along each curve, not by runs in
//! time. The contour traverse is the row with course 0.

use rayon::prelude::*;

use super::ensemble::samples::Sample;
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy, LimitedBy, NoHeading};
use super::heading_band::HeadingBand;
use crate::contact::validity::Finding;
use crate::error::ParameterError;

/// Heading offsets over slope, course and soil.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingMap {
    /// Slopes, *α* [rad]: of the cells of each row.
    pub slopes: Vec<f64>,
    /// One for each soil and course: all courses of the first soil, then those of the next.
    pub rows: Vec<HeadingRow>,
}

/// Heading offsets of one course on one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingRow {
    /// Which of the studies, by its place.
    pub study: usize,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
    /// The steepest slope on which a heading holds the course [rad], and what ends the curve there.
    pub limit: Result<(f64, String), NoHeading>,
    /// Whether the wheels or the ground end the curve; nothing where the rover cannot move.
    pub limited_by: Option<LimitedBy>,
    /// The heading offset on each slope, or why no heading holds the course.
    pub cells: Vec<Result<HeadingOffset, NoHeading>>,
    /// The flags of each.
    pub findings: Vec<Vec<Finding>>,
    /// How many wheels were settled for the row.
    pub settled_wheels: u64,
}

impl HeadingMap {
    /// Follows the curve of each course on each soil. Rows are shared among threads and keep their
    /// order: the result is the same for any number of threads.
    ///
    /// Which heading offsets hold courses of 15° downhill, the contour, and 15° uphill, on a slope
    /// of 10°?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::studies::heading_map::HeadingMap;
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    /// let courses = [-15.0, 0.0, 15.0].map(deg);
    /// let map = HeadingMap::of(&[HeadingStudy::of(&scenario)], &courses, &[deg(10.0)])?;
    /// let crab = |place: usize| match &map.rows[place].cells[0] {
    ///     Ok(heading) => format!("{:.2}°", (heading.yaw - heading.course).to_degrees()),
    ///     Err(reason) => reason.to_string(),
    /// };
    /// assert_eq!(crab(0), "4.60°");
    /// assert_eq!(crab(1), "5.03°");
    /// assert_eq!(crab(2), "5.06°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `studies`: one for each soil
    /// * `courses`: *χ* [rad], −π/2 to π/2
    /// * `slopes`: *α* [rad]
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil or course.
    pub fn of(
        studies: &[HeadingStudy],
        courses: &[f64],
        slopes: &[f64],
    ) -> Result<Self, ParameterError> {
        let places = (0..studies.len()).flat_map(|study| courses.iter().map(move |c| (study, *c)));
        let places: Vec<(usize, f64)> = places.collect();
        let one = |&(study, course): &(usize, f64)| {
            let curve = studies[study].curve_on(course)?;
            Ok(HeadingRow::of(study, &curve, slopes))
        };
        let all: Vec<Result<HeadingRow, ParameterError>> = places.par_iter().map(one).collect();
        // Collected in order, so that the error is always that of the first row.
        let rows = all.into_iter().collect::<Result<Vec<HeadingRow>, ParameterError>>()?;
        Ok(Self { slopes: slopes.to_vec(), rows })
    }
}

impl HeadingMap {
    /// Bands of each row over the samples of its soil, in the order of the rows; `None` if `go_on`
    /// was false before the end.
    ///
    /// * `samples`: of each study, at least one
    /// * `go_on`: asked before each curve, from any thread
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil.
    ///
    /// # Panics
    /// If a study has no samples.
    pub fn bands(
        &self,
        studies: &[HeadingStudy],
        samples: &[Vec<Sample>],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<HeadingBand>>, ParameterError> {
        let band = |row: &HeadingRow| {
            let (study, samples) = (&studies[row.study], &samples[row.study]);
            HeadingBand::on_course(study, row.course, samples, &self.slopes, go_on)
        };
        self.rows.iter().map(band).collect::<Result<Option<Vec<_>>, _>>()
    }
}

impl HeadingRow {
    fn of(study: usize, curve: &HeadingCurve, slopes: &[f64]) -> Self {
        let cells: Vec<_> = slopes.iter().map(|slope| curve.at(*slope)).collect();
        let findings = slopes.iter().zip(&cells).map(|(slope, cell)| curve.findings(*slope, cell));
        let findings = findings.collect();
        let asked: u64 = cells.iter().flatten().map(|heading| heading.settled_wheels).sum();
        Self {
            study,
            course: curve.course(),
            limit: curve.limit().map(|(slope, reason)| (slope, reason.to_owned())),
            limited_by: curve.limited_by(),
            cells,
            findings,
            settled_wheels: curve.settled_wheels() + asked,
        }
    }
}
