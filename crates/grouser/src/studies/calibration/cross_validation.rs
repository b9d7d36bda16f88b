//! Cross-validation: the errors of a fit at slip angles that it has not seen, each left out in turn.

use std::ops::ControlFlow;

use super::wheel_test::{Setup, WheelTestExperiment};
use super::{Calibration, CalibrationError, Fit, FitSettings, ParameterSpace};
use crate::contact::{SettleError, Settled};
use crate::studies::measurement::WheelTests;

/// A fit without the cells of one slip angle, and its predictions of them.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The slip angle that was left out [rad].
    pub slip_angle: f64,
    /// The fit to all others.
    pub fit: Fit,
    /// The trials left out, by their places, each predicted at its own load and motion.
    pub predictions: Vec<(usize, Result<Settled, SettleError>)>,
}

/// Slip angles of a test series, in the order of its cells.
#[must_use]
pub fn slip_angles(tests: &WheelTests) -> Vec<f64> {
    let mut angles: Vec<f64> = Vec::new();
    for cell in &tests.cells {
        if !angles.contains(&cell.slip_angle) {
            angles.push(cell.slip_angle);
        }
    }
    angles
}

/// The tests without the cells of a slip angle. Trials keep their places.
#[must_use]
pub fn without(tests: &WheelTests, slip_angle: f64) -> WheelTests {
    let cells = tests.cells.iter().filter(|cell| cell.slip_angle != slip_angle).cloned();
    WheelTests { trials: tests.trials.clone(), cells: cells.collect() }
}

/// Fits without each slip angle in turn.
///
/// * `observer`: called whenever a search of a fit has ended; it can stop the work
///
/// # Errors
/// As [`Calibration::new`] and [`Calibration::fit`], of the first fit that fails.
pub fn leave_one_angle_out(
    tests: &WheelTests,
    setup: Setup,
    space: &ParameterSpace,
    settings: &FitSettings,
    observer: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<Vec<LeftOut>, CalibrationError> {
    let one_angle = |slip_angle: f64| {
        let experiment = WheelTestExperiment::new(&without(tests, slip_angle), setup)?;
        let fit = Calibration::new(&experiment, space.clone())?.fit(settings, observer)?;
        let soil = experiment.soil(&fit.values)?;
        let cells = tests.cells.iter().filter(|cell| cell.slip_angle == slip_angle);
        let predict = |&trial: &usize| {
            let settled =
                tests.trials[trial].predict(setup.theory, &setup.wheel, &soil, setup.gravity);
            (trial, settled)
        };
        let predictions = cells.flat_map(|cell| &cell.trials).map(predict).collect();
        Ok(LeftOut { slip_angle, fit, predictions })
    };
    slip_angles(tests).into_iter().map(one_angle).collect()
}
