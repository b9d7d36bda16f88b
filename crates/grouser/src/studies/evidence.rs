//! What the wheel–soil models have achieved: predictions of measured wheels and rovers, sample by
//! sample, the weights that follow from them, and how good a band of these weights is.
//!
//! Each part of a data set is a wheel or a rover on a soil with the constants that its source
//! prints; nothing was fitted to its rows. Every model predicts every answer of it with the same
//! samples of the soil, with what its source leaves open. [`stacked`] finds the weights under which
//! the mixture of all models gives what was measured the highest probability; a set is judged by
//! weights that were found without it ([`judged`]).

mod answer;
mod density;
mod stacking;

use grouser_io::statistics::NothingAccepted;

pub use self::answer::{Answer, AnswerKind, Evidence};
pub use self::stacking::{Judged, SHRINKAGE, Shares, judged, stacked, without};
use super::ensemble::models::Question;
use super::ensemble::samples::{BandInputs, Sample};
use super::heading::HeadingStudy;
use super::measurement::{Quantity, WheelTests};
use super::slope_tests::SlopeTests;
use super::slope_validation::{SlopeComparison, SlopeValidationStudy};
use super::validation::{CellComparison, ValidationStudy, measured_alone};
use crate::contact::Model;
use crate::error::ParameterError;
use crate::wheel::Wheel;

/// A wheel's measured trials, or a rover's slopes, with the soil as its document has it.
#[derive(Clone, Debug)]
pub struct Tested<'a> {
    /// The soil, with what its document leaves open.
    pub soil: &'a BandInputs,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// Samples of each model.
    pub samples: u64,
    /// The seed.
    pub seed: u64,
}

impl Tested<'_> {
    fn draw(&self, model: &Model) -> Result<Vec<Sample>, NothingAccepted> {
        (0..self.samples)
            .map(|index| self.soil.crossed(model.clone(), self.seed, [index, index]))
            .collect()
    }

    /// The answers of a wheel's driven cells: pull and sinkage, and at slip angles the side force.
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn of_wheel(
        &self,
        wheel: Wheel,
        tests: &WheelTests,
    ) -> Result<Vec<Answer>, NothingAccepted> {
        let measured: Vec<_> = tests.cells.iter().map(|cell| measured_alone(tests, cell)).collect();
        let mut answers = Vec::new();
        for (place, model) in Model::ALL.into_iter().enumerate() {
            for Sample { soil, model } in self.draw(&model)? {
                let gravity = self.gravity;
                let study = ValidationStudy { tests, wheel, soil, model, gravity };
                let cells = study.run().cells;
                let driven = cells.iter().zip(&measured).filter(|(cell, _)| cell.driven);
                let found = driven.flat_map(|(cell, alone)| of_cell(cell, alone, &wheel)).collect();
                add(&mut answers, place, found);
            }
        }
        Ok(answers)
    }

    /// The answers of a rover on slopes: its slip, and the yaw that holds its course.
    ///
    /// * `usual`: the study of the rover; its soil and model are not used
    ///
    /// # Errors
    /// [`ParameterError`] for a rover that cannot be compared. `Ok(None)` if no soil can be drawn.
    pub fn of_rover(
        &self,
        usual: &HeadingStudy,
        tests: &SlopeTests,
    ) -> Result<Option<Vec<Answer>>, ParameterError> {
        let mut answers = Vec::new();
        for (place, model) in Model::ALL.into_iter().enumerate() {
            let Ok(samples) = self.draw(&model) else { return Ok(None) };
            for Sample { soil, model } in samples {
                let heading = HeadingStudy { soil, model, ..usual.clone() };
                let study = SlopeValidationStudy { tests, heading: &heading };
                let found = study.run()?.points.iter().flat_map(of_slope).collect();
                add(&mut answers, place, found);
            }
        }
        Ok(Some(answers))
    }
}

/// What is kept of a number in one sample.
struct Found {
    kind: AnswerKind,
    question: Question,
    measured: f64,
    predicted: f64,
}

/// Puts a sample's predictions to their answers.
fn add(answers: &mut Vec<Answer>, model: usize, found: Vec<Found>) {
    if answers.is_empty() {
        *answers = found
            .iter()
            .map(|&Found { kind, question, measured, .. }| Answer {
                kind,
                question,
                measured,
                predicted: Default::default(),
            })
            .collect();
    }
    for (answer, found) in answers.iter_mut().zip(found) {
        answer.predicted[model].push(found.predicted);
    }
}

/// The numbers of a cell. Where the soil carries no trial of it the wheel counts as sunk to its
/// axle.
///
/// * `measured`: the cell with what was measured in all of its trials
fn of_cell(cell: &CellComparison, measured: &CellComparison, wheel: &Wheel) -> Vec<Found> {
    let r = wheel.shearing_radius();
    let question = Question::at_slip_angle(cell.slip_angle);
    let kinds = [
        (AnswerKind::Pull, Quantity::DrawbarPull, cell.load, -cell.load),
        (AnswerKind::SideForce, Quantity::SideForce, cell.load, 0.0),
        (AnswerKind::Sinkage, Quantity::Sinkage, r, r),
    ];
    let one = |(kind, quantity, scale, sunk): (AnswerKind, Quantity, f64, f64)| {
        let is_asked = kind != AnswerKind::SideForce || question == Question::Across;
        let measured = measured.quantities[quantity].filter(|_| is_asked)?.measured;
        let predicted = cell.quantities[quantity].map_or(sunk, |it| it.predicted);
        Some(Found { kind, question, measured: measured / scale, predicted: predicted / scale })
    };
    kinds.into_iter().filter_map(one).collect()
}

/// The numbers of a slope. Where no heading holds the course the rover digs in, and its nose would
/// have to point farther uphill than every number: straight up.
fn of_slope(it: &SlopeComparison) -> Vec<Found> {
    const STRAIGHT_UP: f64 = std::f64::consts::FRAC_PI_2;
    let question = Question::on_course(it.point.course);
    let slip = it.point.slip_ratio.map(|measured| Found {
        kind: AnswerKind::Slip,
        question,
        measured: measured.value,
        predicted: it.slip_ratio.unwrap_or(1.0),
    });
    let yaw = it.point.yaw.map(|measured| Found {
        kind: AnswerKind::Heading,
        question,
        measured: measured.value,
        predicted: it.yaw.unwrap_or(STRAIGHT_UP),
    });
    slip.into_iter().chain(yaw).collect()
}
