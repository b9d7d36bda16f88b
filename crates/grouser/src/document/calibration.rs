//! Results of a calibration as records for tables, JSON and CSV.

mod aim;
mod bevameter;
mod corner;
mod handed_on;
mod left_out;
mod solved;
mod wheel;

use serde::Serialize;

pub use aim::{AimError, AimWords, MOST_CANDIDATES};
pub use bevameter::{
    BevameterFound, BevameterProblem, BevameterResults, BevameterTests, PlateRecord, ShearRecord,
};
pub use corner::Corner;
pub use handed_on::samples_csv;
pub use left_out::{CoverageRecord, LeftOutRecord};
pub use solved::{
    DiscrepancyRecord, LengthRecord, STEPS, SamplerRecord, Solved, USUAL_STEPS, fit_notes, sampling,
};
pub use wheel::{WheelFound, WheelInputs, WheelProblem, WheelResults};

use super::columns::fit::column_of;
use crate::studies::calibration::design::{Proposal, Setting};
use crate::studies::calibration::diagnostics::Summary;
use crate::studies::calibration::identifiability::{Combination, Identifiability, Pair};
use crate::studies::calibration::{Channel, Fit, Parameter, Regime};
use crate::studies::measurement::Quantity;

/// A calibrated parameter. Posterior values are null without a posterior.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterRecord {
    /// Its key, in whose unit all values are.
    pub key: String,
    /// The document's value.
    pub start: f64,
    /// Lower bound of the search.
    pub lower: f64,
    /// Upper bound of the search.
    pub upper: f64,
    /// Least squares.
    pub fit: f64,
    /// Standard deviation of the fit, to first order; not known at a bound.
    pub fit_std: Option<f64>,
    /// Mean of the posterior.
    pub mean: Option<f64>,
    /// Its standard deviation.
    pub std: Option<f64>,
    /// 2.5 % of the samples lie below.
    pub p2_5: Option<f64>,
    /// Median.
    pub p50: Option<f64>,
    /// 2.5 % of the samples lie above.
    pub p97_5: Option<f64>,
    /// R-hat, agreement of the chains [-]: 1 is perfect.
    pub r_hat: Option<f64>,
    /// Effective sample size: independent samples with the same standard error [-].
    pub effective_samples: Option<f64>,
    /// Posterior contraction: standard deviation over that of the prior [-]; near 1 the data do not
    /// constrain it.
    pub posterior_contraction: Option<f64>,
}

impl ParameterRecord {
    /// * `place`: of the parameter
    #[must_use]
    pub fn new(
        parameter: &Parameter,
        place: usize,
        fit: &Fit,
        fit_std: f64,
        summary: Option<&Summary>,
        found: &Identifiability,
    ) -> Self {
        let of = |value: fn(&Summary) -> f64| summary.map(value);
        Self {
            key: parameter.name.clone(),
            start: parameter.start,
            lower: parameter.lower,
            upper: parameter.upper,
            fit: fit.values[place],
            fit_std: (!parameter.is_at_bound(fit.values[place])).then_some(fit_std),
            mean: of(|it| it.mean),
            std: of(|it| it.deviation),
            p2_5: of(|it| it.lower),
            p50: of(|it| it.median),
            p97_5: of(|it| it.upper),
            r_hat: of(|it| it.r_hat),
            effective_samples: of(|it| it.effective_samples),
            posterior_contraction: found.contraction.get(place).copied(),
        }
    }
}

/// The name of a channel of observations: `drawbar_pull_n, driven`.
#[must_use]
pub fn channel_name(channel: &Channel) -> String {
    match channel {
        Channel::Wheel { quantity, regime } => {
            let regime = match regime {
                Regime::Any => "",
                Regime::Driven => ", driven",
                Regime::Skid => ", skid",
            };
            format!("{}{regime}", column_of(*quantity).name)
        }
        Channel::PlatePressure => "pressure_kpa".to_owned(),
        Channel::ShearStress => "shear_stress_kpa".to_owned(),
        Channel::Other => "other".to_owned(),
    }
}

/// Factor from a channel's SI unit to the unit in its name.
#[must_use]
pub fn channel_unit(channel: &Channel) -> f64 {
    match channel {
        Channel::Wheel { quantity: Quantity::Sinkage, .. } => 1e3,
        Channel::PlatePressure | Channel::ShearStress => 1e-3,
        Channel::Wheel { .. } | Channel::Other => 1.0,
    }
}

/// Unidentifiable parameters and combinations, a sentence for each.
#[must_use]
pub fn unidentifiable(parameters: &[Parameter], found: &Identifiability) -> Vec<String> {
    let combinations = found
        .unidentifiable
        .iter()
        .map(|combination| combination_sentence(parameters, combination));
    let pairs = found.pairs.iter().map(|pair| pair_sentence(parameters, pair));
    combinations.chain(pairs).collect()
}

fn combination_sentence(parameters: &[Parameter], combination: &Combination) -> String {
    let left = 100.0 * combination.contraction.min(1.0);
    if let [(only, _)] = combination.shares[..] {
        let name = &parameters[only].name;
        return format!("{name} is underdetermined: posterior {left:.0} % as wide as the prior");
    }
    let term = |(place, share): &(usize, f64)| {
        let sign = if *share < 0.0 { "−" } else { "+" };
        format!("{sign}{:.2} {}", share.abs(), parameters[*place].name)
    };
    let terms: Vec<String> = combination.shares.iter().map(term).collect();
    let terms = terms.join(" ");
    format!(
        "the combination {terms} is underdetermined: posterior {left:.0} % as wide as the prior"
    )
}

fn pair_sentence(parameters: &[Parameter], pair: &Pair) -> String {
    let [one, other] = pair.parameters.map(|place| &parameters[place].name);
    let correlation = pair.correlation;
    let how = if correlation < 0.0 {
        "a larger value of one compensates for a smaller one of the other"
    } else {
        "a larger value of one compensates for a larger one of the other"
    };
    format!(
        "{one} and {other} are not separately identifiable (correlation {correlation:.2}): {how}"
    )
}

/// A proposed run and the standard deviation that it leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ProposalRecord {
    /// Load [N].
    pub load_n: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Slip angle [°].
    pub slip_angle_deg: f64,
    /// Standard deviation of the prediction before the run, in the target's unit.
    pub std_before: f64,
    /// The same after it, as expected.
    pub std_after: f64,
}

impl ProposalRecord {
    /// * `candidates`: those among which the proposal chose
    /// * `unit`: factor from SI to the target's unit
    #[must_use]
    pub fn new(proposal: &Proposal, candidates: &[Setting], unit: f64) -> Self {
        let Setting { load, slip_ratio, slip_angle } = candidates[proposal.candidate];
        Self {
            load_n: load,
            slip_ratio,
            slip_angle_deg: (slip_angle.to_degrees() * 1e9).round() / 1e9,
            std_before: proposal.before * unit,
            std_after: proposal.after * unit,
        }
    }
}
