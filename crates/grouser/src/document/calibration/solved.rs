//! Results that every calibration has: parameters, discrepancies, sampler, unidentifiable
//! parameters.

use nalgebra::DMatrix;
use serde::Serialize;

use super::super::columns::{SLIP_ANGLE, TOTAL_SLIP};
use super::super::reading::four_digits;
use super::{ParameterRecord, channel_name, channel_unit, unidentifiable};
use crate::studies::calibration::diagnostics::correlations_of;
use crate::studies::calibration::solution::GOOD_R_HAT;
use crate::studies::calibration::{
    Fit, Parameter, Posterior, PosteriorState, SamplerSettings, Sampling, Solution,
};

/// Discrepancy between a model and measurements of one kind, beyond their scatter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiscrepancyRecord {
    /// The measured quantity, and driven or skid.
    pub channel: String,
    /// With the fit, in the unit of the quantity.
    pub fit: f64,
    /// Mean of the posterior.
    pub mean: Option<f64>,
    /// Its standard deviation.
    pub std: Option<f64>,
}

/// The distance over which discrepancies stay alike.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LengthRecord {
    /// What the distance is in: a column of wheel tests, in whose unit all values are.
    pub along: &'static str,
    /// With the fit.
    pub fit: f64,
    /// Mean of the posterior.
    pub mean: Option<f64>,
    /// Its standard deviation.
    pub std: Option<f64>,
}

/// How the posterior was sampled.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplerRecord {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Independent ensembles.
    pub ensembles: usize,
    /// Walkers of each.
    pub walkers: usize,
    /// Steps of each walker.
    pub steps: u64,
    /// Share of the proposed moves that were made [-].
    pub acceptance: f64,
    /// The largest R-hat [-].
    pub worst_r_hat: f64,
    /// The smallest effective sample size [-].
    pub least_effective_samples: f64,
}

impl From<&Posterior> for SamplerRecord {
    fn from(posterior: &Posterior) -> Self {
        let settings = &posterior.settings;
        Self {
            seed: settings.seed,
            ensembles: settings.ensembles,
            walkers: posterior.walkers,
            steps: settings.blocks * settings.steps_per_block as u64,
            acceptance: posterior.acceptance,
            worst_r_hat: posterior.worst_r_hat(),
            least_effective_samples: posterior.least_effective_samples(),
        }
    }
}

/// A solution with its records.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The solution itself.
    pub solution: Solution,
    /// A record for each parameter.
    pub records: Vec<ParameterRecord>,
    /// And for each channel.
    pub discrepancies: Vec<DiscrepancyRecord>,
    /// Correlation lengths of the discrepancies, in slip and in slip angle; none where they are
    /// independent.
    pub correlation_lengths: Vec<LengthRecord>,
    /// Unidentifiable parameters and combinations, a sentence for each.
    pub unidentifiable: Vec<String>,
    /// How the posterior was sampled, if it was.
    pub sampler: Option<SamplerRecord>,
}

impl Solved {
    /// * `parameters`: with the values from which the search set out
    #[must_use]
    pub fn new(parameters: &[Parameter], solution: Solution) -> Self {
        let summary = |place: usize| solution.posterior.as_ref()?.summaries.get(place);
        let fit = &solution.fit;
        let record = |(place, parameter)| {
            let deviation = solution.deviations[place];
            let found = &solution.identifiability;
            ParameterRecord::new(parameter, place, fit, deviation, summary(place), found)
        };
        let discrepancy = |(place, channel)| {
            let (unit, summary) = (channel_unit(channel), summary(parameters.len() + place));
            DiscrepancyRecord {
                channel: channel_name(channel),
                fit: fit.discrepancies[place] * unit,
                mean: summary.map(|it| it.mean * unit),
                std: summary.map(|it| it.deviation * unit),
            }
        };
        let channels = solution.channels.len();
        let length = |(place, &fit): (usize, &f64)| {
            let column = [TOTAL_SLIP, SLIP_ANGLE][place];
            let summary = summary(parameters.len() + channels + place);
            LengthRecord {
                along: column.name,
                fit: column.unit.from_si(fit),
                mean: summary.map(|it| column.unit.from_si(it.mean)),
                std: summary.map(|it| column.unit.from_si(it.deviation)),
            }
        };
        Self {
            correlation_lengths: fit.discrepancies[channels..]
                .iter()
                .enumerate()
                .map(length)
                .collect(),
            records: parameters.iter().enumerate().map(record).collect(),
            discrepancies: solution.channels.iter().enumerate().map(discrepancy).collect(),
            unidentifiable: unidentifiable(parameters, &solution.identifiability),
            sampler: solution.posterior.as_ref().map(SamplerRecord::from),
            solution,
        }
    }

    /// Correlation of each fitted key with each other [-]: of the posterior, or else of least
    /// squares to first order.
    #[must_use]
    pub fn correlations(&self) -> DMatrix<f64> {
        match &self.solution.posterior {
            Some(posterior) => posterior.samples.correlations(),
            None => correlations_of(&self.solution.fit.covariance),
        }
    }

    /// The outcome: `determined`; `underdetermined`, if the measurements do not determine a
    /// parameter or a combination; `not_converged`, if least squares or the sampler has not
    /// converged.
    #[must_use]
    pub fn outcome(&self) -> &'static str {
        let worst = self.sampler.as_ref().map_or(1.0, |sampler| sampler.worst_r_hat);
        if !self.solution.fit.converged || worst > GOOD_R_HAT {
            "not_converged"
        } else if self.unidentifiable.is_empty() {
            "determined"
        } else {
            "underdetermined"
        }
    }

    /// What to know of the solution, a sentence each: keys that end at a bound, a sampler that has
    /// not converged, a value of least squares that the samples contradict.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let of_values = self.bound_notes().into_iter().chain(self.convergence_note());
        of_values.chain(self.contradiction_notes()).collect()
    }

    /// Notes on keys whose least-squares value is outside the interval of the samples.
    fn contradiction_notes(&self) -> Vec<String> {
        let note = |record: &ParameterRecord| {
            // Samples lie within the bounds, and so around no fit that ends at one.
            let ParameterRecord {
                key,
                fit,
                fit_std: Some(_),
                p2_5: Some(low),
                p97_5: Some(high),
                ..
            } = record
            else {
                return None;
            };
            let [fit_text, low_text, high_text] = [*fit, *low, *high].map(four_digits);
            (!(*low..=*high).contains(fit)).then(|| {
                format!(
                    "{key}: the least-squares value, {fit_text}, is outside the interval of 95 % of \
                     the samples, {low_text} to {high_text}: the model misses these tests by more \
                     than their scatter; check that soil and wheel are those of the tests"
                )
            })
        };
        self.records.iter().filter_map(note).collect()
    }

    /// Notes on keys whose fit ends at a bound, where their standard deviation is not known.
    fn bound_notes(&self) -> Vec<String> {
        let remedy = match self.sampler {
            None => "widen the bounds, fit fewer keys, or sample the posterior",
            Some(_) => "widen the bounds, or fit fewer keys",
        };
        let note = |record: &ParameterRecord| {
            let ParameterRecord { key, lower, upper, fit, fit_std, .. } = record;
            let bound = if fit - lower < upper - fit { lower } else { upper };
            fit_std.is_none().then(|| {
                format!(
                    "{key} ends at its bound, {bound}: its standard deviation is not known there; \
                     {remedy}"
                )
            })
        };
        self.records.iter().filter_map(note).collect()
    }

    /// A note if the sampler has not converged.
    fn convergence_note(&self) -> Option<String> {
        let worst = self.sampler.as_ref()?.worst_r_hat;
        (worst > GOOD_R_HAT).then(|| {
            format!(
                "the sampler has not converged: R-hat is {worst:.3} at worst, of {}, above \
                 {GOOD_R_HAT}: quantiles are not to be relied on; walk more steps, or fit fewer \
                 keys",
                self.worst_mixed()
            )
        })
    }

    /// The sampled value with the largest R-hat, in words.
    fn worst_mixed(&self) -> String {
        let summaries = self.solution.posterior.iter().flat_map(|posterior| &posterior.summaries);
        let worst =
            summaries.enumerate().max_by(|one, other| one.1.r_hat.total_cmp(&other.1.r_hat));
        let keys = self.records.iter().map(|it| it.key.clone());
        let channels =
            self.discrepancies.iter().map(|it| format!("the discrepancy of {}", it.channel));
        let lengths = self.correlation_lengths.iter();
        let lengths = lengths.map(|it| format!("the correlation length along {}", it.along));
        let mut names = keys.chain(channels).chain(lengths);
        worst.and_then(|(place, _)| names.nth(place)).unwrap_or_default()
    }
}

/// Notes if a fit has not converged, or searches disagree.
#[must_use]
pub fn fit_notes(fit: &Fit) -> Vec<String> {
    let mut notes = Vec::new();
    if !fit.converged {
        let text = "the best search had not converged when its evaluations were used up";
        notes.push(text.to_owned());
    }
    let agreeing = fit.searches.iter().filter(|search| search.agrees).count();
    if fit.searches.len() > 1 && agreeing < 2 {
        notes.push(format!(
            "of {} searches from different starts one alone comes to the best fit: there may be a \
             better one; narrow the bounds, or fit fewer keys",
            fit.searches.len()
        ));
    }
    notes
}

/// Permitted numbers of steps of each walker.
pub const STEPS: std::ops::Range<u64> = 100..1_000_000;

/// Steps of each walker where nobody says how many.
pub const USUAL_STEPS: u64 = 400;

/// How a posterior is sampled with a seed and a number of steps, rounded up to whole blocks.
#[must_use]
pub fn sampling(seed: u64, steps: u64, kept: Option<PosteriorState>) -> Sampling {
    let usual = SamplerSettings { seed, ..SamplerSettings::default() };
    let blocks = steps.div_ceil(usual.steps_per_block as u64);
    Sampling { settings: SamplerSettings { blocks, ..usual }, kept }
}
