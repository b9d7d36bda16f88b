//! Slips from currents, by what was learnt.

use grouser::answers::Sampling;
use grouser::answers::learn::{LearnQuestion, SlipsFromCurrents};
use grouser::document::learn::LearntSoil;
use grouser::studies::learn::{Drive, motor_log};
use grouser::studies::slip_from_current::{NoEstimator, SlipEstimator, SlipSettings};

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
    let Sampling { seed, count } = question.sampling;
    let (_, drawn) = LearntSoil::believed(&question.scenario, drive.learner(), (seed, count))?;
    let estimator = match SlipEstimator::new(scenario, drawn, SlipSettings::USUAL) {
        Ok(estimator) => estimator,
        Err(NoEstimator::NoMotor) => return Ok(None),
        Err(NoEstimator::Parameter(error)) => return Err(error.into()),
    };
    let estimates =
        sampling::with_bar(estimator.log_steps(&log), |go_on| estimator.of_log(&log, go_on));
    Ok(Some(SlipsFromCurrents { log, estimates: sampling::whole(estimates) }))
}
