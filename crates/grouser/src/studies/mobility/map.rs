//! What a rover does at a place of a map.

use super::choice::CourseChoice;
use super::classes::{class_of, classes};
use super::table::{Mobility, MobilityTable, OnSlope};
use crate::elementary::wide::{atan2, sin_cos};
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::verdict::{Advice, SlopeStudy, Verdict};
use crate::units::Vec2;

/// Motions of a rover at any place of ground with one soil, from the gradient there.
#[derive(Clone, Debug, PartialEq)]
pub struct MobilityMap {
    tables: Vec<MobilityTable>,
    /// For each class of slopes the number of its table.
    choice: Vec<usize>,
    advice: Vec<Advice>,
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
    /// Makes the tables and the advice; `None` if `go_on` was false before the end.
    ///
    /// * `steepest`: slope of the ground [rad]
    /// * `samples`: of soil and model; with none the soil as written is judged by
    /// * `go_on`: asked before each sample of each course, from any thread
    ///
    /// # Errors
    /// The same as [`SlopeStudy::table`].
    pub fn of(
        study: &SlopeStudy,
        choice: CourseChoice,
        steepest: f64,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        let table = |course: f64| study.table(course, samples, go_on);
        let tables =
            choice.courses().into_iter().map(table).collect::<Result<Option<Vec<_>>, _>>()?;
        let Some(tables) = tables else { return Ok(None) };
        let by_class = choice.by_class(&tables);
        let course = |class: usize| tables[by_class[class]].course();
        let slopes = classes().take(class_of(steepest) + 1).enumerate();
        let places: Vec<_> = slopes.map(|(class, slope)| (slope, course(class))).collect();
        let Some(mut advice) = study.advice_at(&places, samples, go_on)? else { return Ok(None) };
        if choice == CourseChoice::Best {
            // Who drives down what he cannot climb does not come back.
            let back: Vec<_> = places.iter().map(|(slope, course)| (*slope, -*course)).collect();
            let Some(back) = study.advice_at(&back, samples, go_on)? else { return Ok(None) };
            for (there, back) in advice.iter_mut().zip(back) {
                there.judgement = there.judgement.or(back.judgement);
            }
        }
        Ok(Some(Self { choice: by_class, tables, advice }))
    }

    /// Advice for each class of slopes of the map: for whole degrees from level ground up, each for
    /// all slopes down to the one before.
    #[must_use]
    pub fn advice(&self) -> &[Advice] {
        &self.advice
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
        let class = class_of(slope);
        let table = &self.tables[self.choice[class]];
        let OnSlope { motion, probability_no_go } = table.at(slope);
        // Steeper than the ground is said to be: nobody looked.
        let advice = self.advice.get(class);
        let verdict = advice.map_or(Verdict::CannotTell, |it| it.judgement.verdict);
        let course = table.course();
        let heading = motion.filter(|_| is_inclined(gradient)).map(|motion| {
            let along = atan2(-gradient.x, gradient.y);
            projected(along, slope, course + motion.crab)
        });
        CellMotion { slope, course, heading, motion, verdict, probability_no_go }
    }
}

impl CellMotion {
    /// Where the rover goes [rad]: from the map's x axis to the left, of the horizontal projection;
    /// none on level ground, which has no contour, and where no heading holds the course.
    ///
    /// * `gradient`: of the place [m/m]
    #[must_use]
    pub fn travel(&self, gradient: Vec2) -> Option<f64> {
        self.motion.filter(|_| is_inclined(gradient)).map(|_| {
            let along = atan2(-gradient.x, gradient.y);
            projected(along, self.slope, self.course)
        })
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
