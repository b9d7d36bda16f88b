//! Slips from currents, by what was learnt.

use grouser::answers::learn::{LearnQuestion, SlipsFromCurrents};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::{Drive, motor_log};
use grouser::studies::slip_from_current::{NoEstimator, SlipEstimator, SlipSettings};

use super::samples::samples;
use crate::commands::sampling;
use crate::failure::Failure;

/// What the motors say on the stretches of a drive; nothing without currents, or of a rover whose
/// motors are not known.
pub(super) fn of(
    question: &LearnQuestion,
    drive: &Drive,
) -> Result<Option<SlipsFromCurrents>, Failure> {
    let scenario = &question.scenario.value;
    let Some(log) = motor_log(drive.lessons(), &scenario.rover) else { return Ok(None) };
    let drawn = samples(question.sampling, drive.learner())?;
    let drawn: Vec<Sample> = drawn.into_iter().map(|it| it.sample).collect();
    let estimator = match SlipEstimator::new(scenario, drawn, SlipSettings::USUAL) {
        Ok(estimator) => estimator,
        Err(NoEstimator::NoMotor) => return Ok(None),
        Err(NoEstimator::Parameter(error)) => return Err(error.into()),
    };
    let estimates =
        sampling::with_bar(estimator.log_steps(&log), |go_on| estimator.of_log(&log, go_on));
    Ok(Some(SlipsFromCurrents { log, estimates: sampling::whole(estimates) }))
}
