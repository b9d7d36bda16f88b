//! What is asked of a drive, and what it taught.

use std::collections::BTreeMap;

use super::super::Sampling;
use super::advice::AdviceQuestion;
use crate::document::LoadedScenario;
use crate::document::columns::SLOPE;
use crate::document::given_file::GivenFile;
use crate::studies::heading_band::HeadingBand;
use crate::studies::learn::Drive;
use crate::studies::learn::advice::{AdviceSettings, DriveAdvice};
use crate::studies::slip_from_current::{MotorLog, SlipEstimate};
use crate::studies::verdict::Advice;

/// The question.
#[derive(Clone, Debug)]
pub struct LearnQuestion {
    /// The log's name.
    pub log: String,
    /// The scenario that is learnt in, with the soil as it is known before the drive.
    pub scenario: LoadedScenario,
    /// Whether the scenario's slope is that of the drive.
    pub has_slope: bool,
    /// Slopes for which heading and slip are predicted [°], as they were given.
    pub slopes_deg: Vec<f64>,
    /// The samples of predictions.
    pub sampling: Sampling,
    /// What advice is asked for, if any is.
    pub advice: Option<AdviceQuestion>,
    /// Where the document of the soil that is learnt is written, if it is.
    pub soil_file: Option<String>,
}

/// What a drive taught.
#[derive(Clone, Debug)]
pub struct LearntDrive {
    /// The drive, to its end.
    pub drive: Drive,
    /// Heading and slip of the next slopes as they were predicted before the drive.
    pub before: HeadingBand,
    /// The same after it.
    pub after: HeadingBand,
    /// Heading and verdict for the same slopes after it.
    pub verdicts: Vec<Advice>,
    /// What to do tomorrow, if that is asked for.
    pub advice: Option<DriveAdvice>,
    /// What is left of the uncertainty of each of the soil's keys [-].
    pub narrowed: BTreeMap<String, f64>,
    /// What the motors' currents say; nothing without currents, of a rover whose motors are not
    /// known, or where nobody asks for it.
    pub slips: Option<SlipsFromCurrents>,
    /// What the log gave; nothing where nobody knows.
    pub given: Vec<GivenFile>,
    /// What was left out of the telemetry, a sentence each.
    pub notes: Vec<String>,
}

/// Slips from currents, by the soil that was learnt.
#[derive(Clone, Debug, PartialEq)]
pub struct SlipsFromCurrents {
    /// What the motors said on the stretches of the drive.
    pub log: MotorLog,
    /// What that says of each wheel, for each record of the log.
    pub estimates: Vec<Vec<Option<SlipEstimate>>>,
}

impl LearnQuestion {
    /// Slopes for which heading and slip are predicted [rad].
    #[must_use]
    pub fn slopes(&self) -> Vec<f64> {
        SLOPE.in_si(&self.slopes_deg)
    }

    /// The settings of the advice that is asked for, if any is.
    ///
    /// * `drive`: its last lesson has what is read on a drive
    #[must_use]
    pub fn advice_settings(&self, drive: &Drive) -> Option<AdviceSettings> {
        let (rover, seed) = (&self.scenario.value.rover, self.sampling.seed);
        Some(self.advice.as_ref()?.after(drive, rover, seed))
    }
}
