//! The steps that every calibration takes: fit, sample, summarise.

use std::ops::ControlFlow;

use grouser::document::calibration::{ParameterRecord, channel_name, channel_unit, open_questions};
use grouser::studies::calibration::diagnostics::{Samples, Summary};
use grouser::studies::calibration::identifiability::Identifiability;
use grouser::studies::calibration::{
    Advanced, Calibration, CalibrationError, Fit, FitSettings, Parameter, SamplerSettings,
};
use serde::Serialize;

use super::checkpoint::Checkpoint;
use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::output;

/// The first half of the steps still knows where the walkers started.
const DISCARDED: f64 = 0.5;
/// Chains agree well enough below this R-hat [-]. Source: Gelman and others, Bayesian Data
/// Analysis, 3rd ed., section 11.5, ask for 1.1; Vehtari and others (2021) for 1.01.
const GOOD_R_HAT: f64 = 1.05;

/// What a calibration found.
pub(super) struct Solved {
    pub(super) fit: Fit,
    pub(super) records: Vec<ParameterRecord>,
    pub(super) discrepancies: Vec<DiscrepancyRecord>,
    /// Values of parameters and discrepancies; none without a posterior.
    pub(super) samples: Option<Samples>,
    pub(super) questions: Vec<String>,
    pub(super) sampler: Option<SamplerRecord>,
}

/// How far a theory is from measurements of one kind, beyond their scatter.
#[derive(Serialize)]
pub(super) struct DiscrepancyRecord {
    pub(super) channel: String,
    pub(super) fit: f64,
    pub(super) mean: Option<f64>,
    pub(super) std: Option<f64>,
}

/// How the posterior was sampled.
#[derive(Serialize)]
pub(super) struct SamplerRecord {
    pub(super) seed: u64,
    pub(super) ensembles: usize,
    pub(super) walkers: usize,
    pub(super) steps: u64,
    pub(super) acceptance: f64,
    pub(super) worst_r_hat: f64,
    pub(super) least_effective_samples: f64,
}

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Interrupted
            | CalibrationError::NoStart { .. }
            | CalibrationError::ForeignState { .. } => Self::Run(error.to_string()),
            _ => Self::Usage(error.to_string()),
        }
    }
}

/// The sampler's settings of the flags.
pub(super) fn sampler(args: &CalibrateArgs) -> SamplerSettings {
    let usual = SamplerSettings { seed: args.seed, ..SamplerSettings::default() };
    SamplerSettings { blocks: args.steps.div_ceil(usual.steps_per_block as u64), ..usual }
}

/// Least squares, with a bar.
pub(super) fn fit(calibration: &Calibration, settings: &FitSettings) -> Result<Fit, Failure> {
    let bar = output::progress_bar(settings.starts as u64);
    bar.set_message("least squares from several starts");
    let fit = calibration.fit(settings, &|| {
        bar.inc(1);
        ControlFlow::Continue(())
    })?;
    bar.finish_and_clear();
    if !fit.converged {
        output::tell("note: the best search had not settled when its evaluations were used up");
    }
    let agreeing = fit.searches.iter().filter(|search| search.agrees).count();
    if fit.searches.len() > 1 && agreeing < 2 {
        output::tell(&format!(
            "note: of {} searches from different starts none agrees with the best: there may be a \
             better fit; narrow the bounds, or fit fewer keys",
            fit.searches.len()
        ));
    }
    Ok(fit)
}

/// Samples unless told not to, and summarises.
///
/// * `parameters`: with the values from which the search set out
pub(super) fn solve(
    args: &CalibrateArgs,
    calibration: &Calibration,
    fit: Fit,
    parameters: &[Parameter],
    checkpoint: Option<&Checkpoint>,
) -> Result<Solved, Failure> {
    let (samples, sampler) = if args.point_fit {
        (None, None)
    } else {
        let (samples, sampler) = sample(args, calibration, &fit, checkpoint)?;
        (Some(samples), Some(sampler))
    };
    let summaries = samples.as_ref().map(Samples::summaries);
    let found = match &samples {
        Some(samples) => Identifiability::of_samples(calibration, samples),
        None => Identifiability::of_fit(calibration, &fit),
    };
    let deviations = fit.deviations(calibration.space());
    let summary = |place: usize| summaries.as_ref().and_then(|all: &Vec<Summary>| all.get(place));
    let record = |(place, parameter)| {
        ParameterRecord::new(parameter, place, &fit, deviations[place], summary(place), &found)
    };
    let channels = calibration.experiment().channels().iter().enumerate();
    let discrepancies = channels.map(|(place, channel)| {
        let (unit, summary) = (channel_unit(channel), summary(parameters.len() + place));
        DiscrepancyRecord {
            channel: channel_name(channel),
            fit: fit.discrepancies[place] * unit,
            mean: summary.map(|it| it.mean * unit),
            std: summary.map(|it| it.deviation * unit),
        }
    });
    Ok(Solved {
        discrepancies: discrepancies.collect(),
        records: parameters.iter().enumerate().map(record).collect(),
        questions: open_questions(parameters, &found),
        fit,
        samples,
        sampler,
    })
}

/// Walks until all steps are walked; after each block the state is kept.
fn sample(
    args: &CalibrateArgs,
    calibration: &Calibration,
    fit: &Fit,
    checkpoint: Option<&Checkpoint>,
) -> Result<(Samples, SamplerRecord), Failure> {
    let settings = sampler(args);
    let kept = checkpoint.and_then(Checkpoint::kept);
    let mut state = kept.unwrap_or_else(|| calibration.start_posterior(fit, &settings));
    let bar = output::progress_bar(settings.blocks);
    bar.set_message("blocks of the posterior");
    bar.set_position(state.blocks);
    let mut failure = None;
    let advanced = calibration.advance(&mut state, &settings, &mut |state| {
        bar.set_position(state.blocks);
        match checkpoint.map(|it| it.write(state)) {
            Some(Err(error)) => {
                failure = Some(error);
                ControlFlow::Break(())
            }
            _ => ControlFlow::Continue(()),
        }
    })?;
    bar.finish_and_clear();
    if let (Advanced::Stopped, Some(failure)) = (advanced, failure) {
        return Err(failure);
    }
    let samples = Samples::of(calibration, &state, DISCARDED);
    let summaries = samples.summaries();
    let worst = summaries.iter().map(|it| it.r_hat).fold(1.0, f64::max);
    let least = summaries.iter().map(|it| it.effective_samples).fold(f64::INFINITY, f64::min);
    if worst > GOOD_R_HAT {
        output::tell(&format!(
            "note: R-hat is {worst:.3} at worst, above {GOOD_R_HAT}: walk longer with --steps, or \
             fit fewer keys"
        ));
    }
    let record = SamplerRecord {
        seed: settings.seed,
        ensembles: settings.ensembles,
        walkers: settings.walkers_for(calibration.dimension()),
        steps: settings.blocks * settings.steps_per_block as u64,
        acceptance: state.acceptance(),
        worst_r_hat: worst,
        least_effective_samples: least,
    };
    Ok((samples, record))
}
