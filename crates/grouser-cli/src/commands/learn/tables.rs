//! The tables of a drive: what stretches taught, warnings, and slips from currents beside those
//! that were seen.

use grouser::document::LoadedScenario;
use grouser::document::columns::{learn as columns, slip_from_current};
use grouser::document::table::Table;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::motor_log;
use grouser::studies::slip_from_current::{NoEstimator, SlipEstimator, SlipSettings};

use super::found::Found;
use super::samples::samples;
use crate::args::LearnArgs;
use crate::commands::sampling;
use crate::failure::Failure;

/// The tables of a drive.
pub(super) struct Tables {
    pub(super) lessons: Table,
    pub(super) warnings: Table,
    /// Nothing without currents, or of a rover whose motors are not known.
    pub(super) slips: Option<Slips>,
}

/// Slips from currents, by what was learnt.
pub(super) struct Slips {
    /// A row for each stretch and wheel.
    pub(super) rows: Table,
    /// A row for each wheel, and one for all.
    pub(super) wheels: Table,
}

impl Tables {
    pub(super) fn of(
        args: &LearnArgs,
        scenario: &LoadedScenario,
        found: &Found,
    ) -> Result<Self, Failure> {
        Ok(Self {
            lessons: columns::lessons(found.drive.lessons()),
            warnings: columns::warnings(found.drive.warnings()),
            slips: slips(args, scenario, found)?,
        })
    }
}

fn slips(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    found: &Found,
) -> Result<Option<Slips>, Failure> {
    let rover = &scenario.value.rover;
    let Some(log) = motor_log(found.drive.lessons(), rover) else { return Ok(None) };
    let drawn: Vec<Sample> =
        samples(args, found.drive.learner())?.into_iter().map(|it| it.sample).collect();
    let estimator = match SlipEstimator::new(&scenario.value, drawn, SlipSettings::USUAL) {
        Ok(estimator) => estimator,
        Err(NoEstimator::NoMotor) => return Ok(None),
        Err(NoEstimator::Parameter(error)) => return Err(error.into()),
    };
    let estimates =
        sampling::with_bar(estimator.log_steps(&log), |go_on| estimator.of_log(&log, go_on));
    let estimates = sampling::whole(estimates);
    Ok(Some(Slips {
        rows: slip_from_current::table(rover, &log, &estimates),
        wheels: slip_from_current::summary(rover, &log, &estimates),
    }))
}
