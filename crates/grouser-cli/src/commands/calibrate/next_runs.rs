//! The runs that a calibration proposes: what they are to make sure of, and what the stand can do.

use std::ops::RangeInclusive;

use grouser::document::calibration::ProposalRecord;
use grouser::document::validation::column_of;
use grouser::studies::calibration::design::{Outlook, Setting, Target};
use grouser::studies::calibration::{Experiment as _, WheelTestExperiment};
use grouser::studies::measurement::{PerQuantity, Quantity, Trial};

use super::solve::Solved;
use crate::args::CalibrateArgs;
use crate::failure::Failure;

/// Samples that the design of the next runs looks at.
const DESIGN_SAMPLES: usize = 200;

/// Settings that are compared: their covariances fill a table with this number squared.
const MOST_CANDIDATES: usize = 1000;

/// What the next runs should make sure of, and the settings that the stand can run.
pub(super) struct Aim {
    target: Target,
    candidates: Vec<Setting>,
    count: usize,
}

impl Aim {
    /// The aim of the flags.
    ///
    /// * `trials`: where the flags say no load, theirs is meant
    pub(super) fn of(args: &CalibrateArgs, trials: &[Trial]) -> Result<Self, Failure> {
        let (target, candidates) = (target(args, trials)?, candidates(args, trials)?);
        Ok(Self { target, candidates, count: args.propose })
    }

    /// The runs, the best first; none without samples.
    pub(super) fn proposals(
        &self,
        experiment: &WheelTestExperiment,
        solved: &Solved,
    ) -> Vec<ProposalRecord> {
        let Some(samples) = &solved.samples else { return Vec::new() };
        let noise = noise(experiment, solved);
        let rows = samples.thinned(DESIGN_SAMPLES);
        let outlook =
            Outlook::of_wheel_test(experiment, &rows, &self.target, &self.candidates, &noise);
        let unit = if self.target.quantity == Quantity::Sinkage { 1e3 } else { 1.0 };
        let proposals = outlook.propose(self.count);
        proposals.iter().map(|it| ProposalRecord::new(it, &self.candidates, unit)).collect()
    }
}

fn target(args: &CalibrateArgs, trials: &[Trial]) -> Result<Target, Failure> {
    let wrong = |what: String| {
        Failure::Usage(format!(
            "--target {}: {what}\nhint: such as drawbar_pull_n:load_n=17,slip_ratio=0.2",
            args.target
        ))
    };
    let (name, settings) = args.target.split_once(':').unwrap_or((&args.target, ""));
    let quantity = Quantity::ALL.into_iter().find(|one| column_of(*one) == name);
    let quantity = quantity.ok_or_else(|| {
        let names = Quantity::ALL.map(column_of).join(", ");
        wrong(format!("'{name}' is none of {names}"))
    })?;
    let mut setting = Setting { load: median_load(trials), slip_ratio: 0.2, slip_angle: 0.0 };
    for part in settings.split(',').filter(|part| !part.is_empty()) {
        let (key, value) = part.split_once('=').ok_or_else(|| wrong(format!("'{part}'")))?;
        let value: f64 = value
            .trim()
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| wrong(format!("'{value}' is no number")))?;
        match key.trim() {
            "load_n" if value > 0.0 => setting.load = value,
            "slip_ratio" if value.abs() <= 2.0 => setting.slip_ratio = value,
            "slip_angle_deg" if value.abs() <= 90.0 => setting.slip_angle = value.to_radians(),
            _ => return Err(wrong(format!("'{part}' is no setting of a test stand"))),
        }
    }
    Ok(Target { quantity, setting })
}

fn candidates(args: &CalibrateArgs, trials: &[Trial]) -> Result<Vec<Setting>, Failure> {
    let median = median_load(trials);
    let loads = match &args.candidate_load_n {
        Some(loads) => loads.0.clone(),
        None => vec![0.5 * median, median, 2.0 * median],
    };
    let (ratios, angles) = (&args.candidate_slip_ratio.0, &args.candidate_slip_angle_deg.0);
    check_candidates("--candidate-load-n", &loads, 0.0..=1e5)?;
    check_candidates("--candidate-slip-ratio", ratios, -2.0..=2.0)?;
    check_candidates("--candidate-slip-angle-deg", angles, -90.0..=90.0)?;
    let count = loads.len() * ratios.len() * angles.len();
    if count > MOST_CANDIDATES {
        return Err(Failure::Usage(format!(
            "the flags --candidate-… make {count} settings, it may be {MOST_CANDIDATES} at most"
        )));
    }
    let mut candidates = Vec::with_capacity(count);
    for &load in &loads {
        for &slip_ratio in ratios {
            for &angle in angles {
                candidates.push(Setting { load, slip_ratio, slip_angle: angle.to_radians() });
            }
        }
    }
    Ok(candidates)
}

fn check_candidates(
    flag: &str,
    values: &[f64],
    allowed: RangeInclusive<f64>,
) -> Result<(), Failure> {
    let (least, most) = (allowed.start(), allowed.end());
    match values.iter().find(|value| !allowed.contains(value)) {
        Some(value) => {
            Err(Failure::Usage(format!("{flag} {value}: it must be from {least} to {most}")))
        }
        None => Ok(()),
    }
}

fn median_load(trials: &[Trial]) -> f64 {
    let mut loads: Vec<f64> = trials.iter().map(|trial| trial.load).collect();
    loads.sort_by(f64::total_cmp);
    loads[loads.len() / 2]
}

/// How far a reading of a new run may be from the theory: mean scatter and model discrepancy.
fn noise(experiment: &WheelTestExperiment, solved: &Solved) -> PerQuantity<Option<f64>> {
    PerQuantity::from_fn(|quantity| {
        let own = experiment.sources().iter().zip(experiment.observations());
        let own = own.filter(|((source, _), _)| *source == quantity);
        let variances: Vec<f64> = own
            .map(|(_, it)| it.scatter.powi(2) + solved.fit.discrepancies[it.channel].powi(2))
            .collect();
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        (!variances.is_empty()).then(|| mean.sqrt())
    })
}
