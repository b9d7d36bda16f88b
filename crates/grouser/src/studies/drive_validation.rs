//! Errors of wheel–soil models against recorded drives.
//!
//! A drive is taken stretch by stretch of a decimetre or so ([`Stretch`]). Of each stretch a model
//! predicts slip, drift, yaw rate and power as [`replay`](super::replay) does in prescribed motion:
//! from the wheel speeds, the steering angles and the attitude that were read, and from nothing of
//! the motion. Stretches of like [`Conditions`] make a cell, those of one drive there a trial;
//! drives of one cell repeat each other, and every cell has the same weight, as in
//! [`slope_validation`](super::slope_validation).
//!
//! A hash of its readings puts each drive into the training or the test set ([`Split`]), so that
//! a soil can be fitted without the drives that it is judged on.

mod cells;
mod conditions;
mod quantity;
mod recorded;

use std::collections::BTreeMap;

use rayon::prelude::*;

pub use self::cells::{DriveCell, JudgedPrediction, Predictor};
use self::cells::{JudgedStretch, cells_of, judged};
pub use self::conditions::Conditions;
pub use self::quantity::{DriveQuantity, DriveValues};
pub use self::recorded::{DriveRecorder, RecordedDrive, Split};
use super::heading::HeadingStudy;
use super::learn::{NotUsed, Stretch, steady_attitude};
use super::replay::{Channel, Predicted, Situation, measured, wheel_speeds};
use crate::contact::Model;
use crate::simulation::Scenario;
use crate::studies::ensemble::samples::Sample;

/// Recorded drives, and the models to compare with them.
#[derive(Clone, Copy, Debug)]
pub struct DriveValidationStudy<'a> {
    /// The drives.
    pub drives: &'a [RecordedDrive],
    /// Its rover, soil, gravity and load transfer are used.
    pub scenario: &'a Scenario,
    /// The models, each with the scenario's soil.
    pub models: &'a [Model],
}

/// Predictions beside recorded drives.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveValidation {
    /// The cells of the training set, then those of the test set.
    pub cells: Vec<DriveCell>,
    /// The set on which models are ranked: the test set, or without a drive there the training set.
    pub judged_on: Split,
    /// Models and yardsticks on each set that has drives: those of the set that models are ranked
    /// on first, of each set models before yardsticks, best first.
    pub predictions: Vec<JudgedPrediction>,
    /// Stretches that were compared.
    pub compared: usize,
    /// Stretches that were not, by why.
    pub not_compared: BTreeMap<NotUsed, usize>,
}

impl DriveValidationStudy<'_> {
    /// Predicts every stretch, in parallel, and computes the errors.
    #[must_use]
    pub fn run(&self) -> DriveValidation {
        let study = HeadingStudy::of(self.scenario);
        let all = self.drives.iter().enumerate();
        let stretches: Vec<(usize, &Stretch)> =
            all.flat_map(|(drive, it)| it.stretches.iter().map(move |one| (drive, one))).collect();
        let read: Vec<Result<JudgedStretch, NotUsed>> =
            stretches.par_iter().map(|(drive, it)| self.reading(&study, *drive, it)).collect();
        let mut not_compared = BTreeMap::new();
        for why in read.iter().filter_map(|it| it.as_ref().err()) {
            *not_compared.entry(*why).or_default() += 1;
        }
        let readings: Vec<JudgedStretch> = read.into_iter().flatten().collect();
        let compared = readings.len();
        let cells = cells_of(readings, self.models.len());
        let has_test = cells.iter().any(|it| it.split == Split::Test);
        let judged_on = if has_test { Split::Test } else { Split::Training };
        let sets = [judged_on, Split::Training].into_iter().take(1 + usize::from(has_test));
        let predictions = sets.flat_map(|split| judged(&cells, self.models, split)).collect();
        DriveValidation { cells, judged_on, predictions, compared, not_compared }
    }

    fn reading(
        &self,
        study: &HeadingStudy,
        drive: usize,
        stretch: &Stretch,
    ) -> Result<JudgedStretch, NotUsed> {
        let situation = Situation::of(study, stretch)?;
        let rover = &situation.study.rover;
        let conditions = Conditions::of(rover, steady_attitude(stretch)?, &stretch.rim_speeds);
        let read =
            conditions.values(situation.yaw, |channel| measured(channel, stretch, &study.rover));
        if read.iter().all(Option::is_none) {
            return Err(NotUsed::NoMotion);
        }
        let speeds = wheel_speeds(stretch, rover);
        let predict = |model: &Model| {
            let sample = Sample { soil: study.soil, model: model.clone() };
            let motion = Predicted::of(&situation.on(&sample).motion(None)?);
            Some(conditions.values(situation.yaw, |channel| motion.of_channel(channel, &speeds)))
        };
        let predicted = self.models.iter().map(predict).collect();
        let split = self.drives[drive].split;
        Ok(JudgedStretch { drive, split, conditions, measured: read, predicted })
    }
}

impl Conditions {
    /// The quantities of a motion under these conditions.
    ///
    /// * `yaw`: as it was read [rad]
    /// * `of`: the value of a channel of it
    fn values(&self, yaw: f64, of: impl Fn(Channel) -> Option<f64>) -> DriveValues {
        DriveQuantity::ALL.map(|quantity| match quantity {
            DriveQuantity::SlipRatio => of(Channel::SlipRatio),
            DriveQuantity::Drift => {
                let velocity = of(Channel::ForwardSpeed).zip(of(Channel::LateralSpeed));
                velocity.and_then(|(forward, leftward)| self.drift(yaw, forward, leftward))
            }
            DriveQuantity::YawRate => of(Channel::YawRate),
            DriveQuantity::Power => of(Channel::Power),
        })
    }
}
