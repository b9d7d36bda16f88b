//! How fast the heading is learnt where the soil is not the one that was expected: its shear moduli
//! are half as large again, or smaller by as much.

use grouser::studies::ensemble::Band;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading::HeadingStudy;
use grouser::units::deg;
use rayon::prelude::*;

use super::change::scaled;
use super::coverage::{NEXT, Predicted, Trial, taught};
use super::drive::{Leg, learner};

/// The way over which the heading is to be learnt: 2 m of the wheels.
const LEGS: [Leg; 2] = [(5.0, 3.0, 1.0), (8.0, 5.0, 1.0)];
/// By how much the shear moduli of the hidden soil are off.
const FACTORS: [f64; 2] = [1.5, 1.0 / 1.5];

/// The error of the heading for the next slope, before the drive and after it, of many hidden soils
/// [rad].
pub(crate) fn errors(trial: &Trial<'_>, repeats: u32) -> Vec<[f64; 2]> {
    let study = HeadingStudy::of(&trial.prior.value);
    let samples = learner(trial.prior).samples(trial.seed, trial.samples);
    let before = yaw(&Predicted::of(&study, &samples.expect("soils are drawn")));
    let one = |index: u64| {
        let soil = scaled(&study.soil, FACTORS[(index % 2) as usize]);
        let seed = 1000 * trial.seed + index;
        let mut drive = trial.drive(&Sample { soil, model: study.model.clone() }, seed);
        for leg in LEGS {
            drive.leg(leg)?;
        }
        let truth = drive.study().curve().ok()?.at(deg(NEXT)).ok()?.yaw;
        let samples = taught(learner(trial.prior), &drive, seed).samples(seed, trial.samples);
        let after = yaw(&Predicted::of(drive.study(), &samples.expect("soils are drawn")));
        Some([before, after].map(|it| (it - truth).abs()))
    };
    (0..u64::from(repeats)).into_par_iter().filter_map(one).collect()
}

/// The median of the yaws [rad].
fn yaw(predicted: &Predicted) -> f64 {
    Band::of(predicted.yaws.iter().copied()).expect("some hold the contour").median
}
