//! The prediction that the next runs should narrow, and the settings that the stand can run, parsed
//! from text.

use std::ops::RangeInclusive;

use super::super::columns::fit::column_of;
use super::super::columns::{LOAD, SLIP_ANGLE, SLIP_RATIO as SLIP};
use super::super::study::{LOAD_N, SLIP_ANGLE_DEG, SLIP_RATIO};
use crate::studies::calibration::design::{Aim, Setting, Target};
use crate::studies::measurement::{Quantity, Trial};

/// Settings that are compared: their covariances fill a table with this number squared.
pub const MOST_CANDIDATES: usize = 1000;

/// Inputs of the design of the next runs, as text.
#[derive(Clone, Debug, PartialEq)]
pub struct AimWords {
    /// The prediction to narrow: `side_force_n:load_n=17,slip_ratio=0.2,slip_angle_deg=15`.
    pub target: String,
    /// Number of runs to propose.
    pub propose: usize,
    /// Loads that the stand can run [N]; without them half, once and twice the tests' own.
    pub load_n: Option<Vec<f64>>,
    /// Slip ratios that it can run [-].
    pub slip_ratio: Vec<f64>,
    /// Slip angles that it can run [°].
    pub slip_angle_deg: Vec<f64>,
}

impl Default for AimWords {
    /// What is asked for where nobody says otherwise.
    fn default() -> Self {
        Self {
            target: Self::USUAL_TARGET.to_owned(),
            propose: Self::USUAL_PROPOSALS,
            load_n: None,
            slip_ratio: vec![-0.6, -0.3, 0.0, 0.3, 0.6, 0.9],
            slip_angle_deg: vec![0.0, 15.0, 30.0, 45.0],
        }
    }
}

/// An invalid aim.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AimError {
    /// The target cannot be parsed.
    #[error("{what}")]
    Target {
        /// What is wrong.
        what: String,
    },
    /// A setting that no stand runs.
    #[error("{value}: it must be from {least} to {most}")]
    Candidate {
        /// The key: `load_n`, `slip_ratio` or `slip_angle_deg`.
        key: &'static str,
        /// What was asked for.
        value: f64,
        /// The least that can be.
        least: f64,
        /// The most that can be.
        most: f64,
    },
    /// More settings than can be compared.
    #[error("{count} settings, it may be {MOST_CANDIDATES} at most")]
    TooManyCandidates {
        /// How many.
        count: usize,
    },
}

impl AimWords {
    /// The prediction that is narrowed where nobody asks for another one.
    pub const USUAL_TARGET: &str = "drawbar_pull_n:slip_ratio=0.2";
    /// How many runs are proposed then.
    pub const USUAL_PROPOSALS: usize = 3;

    /// Parses the aim.
    ///
    /// * `trials`: give the load where the text has none; at least one
    ///
    /// # Errors
    /// [`AimError`] for text that cannot be parsed.
    pub fn aim(&self, trials: &[Trial]) -> Result<Aim, AimError> {
        let median = median_load(trials);
        let (target, candidates) = (self.target(median)?, self.candidates(median)?);
        Ok(Aim { target, candidates, count: self.propose })
    }

    fn target(&self, median_load: f64) -> Result<Target, AimError> {
        let wrong = |what: String| AimError::Target { what };
        let (name, settings) = self.target.split_once(':').unwrap_or((&self.target, ""));
        let quantity = Quantity::ALL.into_iter().find(|one| column_of(*one).name == name);
        let quantity = quantity.ok_or_else(|| {
            let names = Quantity::ALL.map(|it| column_of(it).name).join(", ");
            wrong(format!("'{name}' is none of {names}"))
        })?;
        let mut setting = Setting { load: median_load, slip_ratio: 0.2, slip_angle: 0.0 };
        for part in settings.split(',').filter(|part| !part.is_empty()) {
            let (key, value) = part.split_once('=').ok_or_else(|| wrong(format!("'{part}'")))?;
            let value: f64 = value
                .trim()
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite())
                .ok_or_else(|| wrong(format!("'{value}' is not a number")))?;
            match key.trim() {
                key if key == LOAD.name && value > 0.0 => setting.load = value,
                key if key == SLIP.name && SLIP_RATIO.contains(&value) => {
                    setting.slip_ratio = value;
                }
                key if key == SLIP_ANGLE.name && SLIP_ANGLE_DEG.contains(&value) => {
                    setting.slip_angle = SLIP_ANGLE.unit.to_si(value);
                }
                _ => return Err(wrong(format!("'{part}' is not a setting of a test stand"))),
            }
        }
        Ok(Target { quantity, setting })
    }

    fn candidates(&self, median_load: f64) -> Result<Vec<Setting>, AimError> {
        let loads = match &self.load_n {
            Some(loads) => loads.clone(),
            None => vec![0.5 * median_load, median_load, 2.0 * median_load],
        };
        check(LOAD.name, &loads, &LOAD_N)?;
        check(SLIP.name, &self.slip_ratio, &SLIP_RATIO)?;
        check(SLIP_ANGLE.name, &self.slip_angle_deg, &SLIP_ANGLE_DEG)?;
        let count = loads.len() * self.slip_ratio.len() * self.slip_angle_deg.len();
        if count > MOST_CANDIDATES {
            return Err(AimError::TooManyCandidates { count });
        }
        let mut candidates = Vec::with_capacity(count);
        for &load in &loads {
            for &slip_ratio in &self.slip_ratio {
                for &angle in &self.slip_angle_deg {
                    candidates.push(Setting {
                        load,
                        slip_ratio,
                        slip_angle: SLIP_ANGLE.unit.to_si(angle),
                    });
                }
            }
        }
        Ok(candidates)
    }
}

fn check(key: &'static str, values: &[f64], allowed: &RangeInclusive<f64>) -> Result<(), AimError> {
    let (least, most) = (*allowed.start(), *allowed.end());
    match values.iter().find(|value| !allowed.contains(value)) {
        Some(&value) => Err(AimError::Candidate { key, value, least, most }),
        None => Ok(()),
    }
}

fn median_load(trials: &[Trial]) -> f64 {
    let mut loads: Vec<f64> = trials.iter().map(|trial| trial.load).collect();
    loads.sort_by(f64::total_cmp);
    loads[loads.len() / 2]
}
