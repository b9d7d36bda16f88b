//! What a posterior sample hands on to predictions: the soil's constants, and the model's
//! discrepancy as it is known after the measurements.
//!
//! A sample has constants, standard deviations and correlation lengths. Given those, the
//! discrepancy is a Gaussian process of which the residuals were read, with their scatter, at the
//! settings of the tests. One function is drawn from it, at the slips and slip angles where a
//! soil's [`Discrepancy`] has values: near the measurements it is about what they leave
//! unexplained, far from them it is as wide as δ.

use rayon::prelude::*;

use super::errors::{Errors, Lengths};
use super::experiment::{Channel, Experiment, Regime, Site};
use super::wheel_test::{WheelTestExperiment, sideways};
use super::{Calibration, ensemble};
use crate::error::ParameterError;
use crate::soil::discrepancy::{LARGEST, SLIP_ANGLES, SLIPS, VALUES};
use crate::soil::{Discrepancy, Soil};
use crate::studies::measurement::{DRIVEN_FROM, Quantity};

/// Streams of random numbers that no walker has.
const STREAMS: u64 = 0xFF << 56;

/// Mean of (1 − u)² + u² and of 2 u (1 − u) for u = 3t² − 2t³, t from 0 to 1: variance of a blend
/// of two values, of their own and by their correlation [-].
const BLENDED: [f64; 2] = [26.0 / 35.0, 9.0 / 35.0];

/// The discrepancies that go with posterior samples, drawn with the sampler's seed.
///
/// * `rows`: values of the parameters, then what describes the discrepancies
#[must_use]
pub fn discrepancies(
    calibration: &Calibration,
    experiment: &WheelTestExperiment,
    rows: &[&[f64]],
    seed: u64,
) -> Vec<Discrepancy> {
    let one = |(number, row): (usize, &&[f64])| {
        let count = Quantity::ALL.len() * VALUES;
        let numbers = ensemble::normal_numbers(seed, STREAMS | number as u64, count);
        discrepancy(calibration, experiment, row, &numbers)
    };
    rows.par_iter().enumerate().map(one).collect()
}

/// The soils of posterior samples with their discrepancies. Samples that are no valid soil are left
/// out; the sampler keeps none of them.
#[must_use]
pub fn soils(
    experiment: &WheelTestExperiment,
    rows: &[&[f64]],
    discrepancies: &[Discrepancy],
) -> Vec<Soil> {
    let soil = |(row, discrepancy): (&&[f64], &Discrepancy)| -> Result<Soil, ParameterError> {
        Ok(Soil { discrepancy: Some(*discrepancy), ..experiment.soil(row)? })
    };
    rows.iter().zip(discrepancies).filter_map(|pair| soil(pair).ok()).collect()
}

fn discrepancy(
    calibration: &Calibration,
    experiment: &WheelTestExperiment,
    row: &[f64],
    numbers: &[f64],
) -> Discrepancy {
    let (values, found) = row.split_at(calibration.space().len());
    let observations = experiment.observations();
    let mut predictions = vec![0.0; observations.len()];
    let mut drawn = Discrepancy::NONE;
    if experiment.predict(values, &mut predictions).is_err() {
        return drawn;
    }
    let read = calibration.errors().residuals(observations, &predictions);
    for (numbers, quantity) in numbers.chunks(VALUES).zip(Quantity::ALL) {
        let of = Quantified { errors: calibration.errors(), experiment, quantity, found };
        let Some(values) = of.values(&read, numbers) else { continue };
        match quantity {
            Quantity::DrawbarPull => drawn.drawbar_pull.copy_from_slice(&values),
            Quantity::SideForce => drawn.side_force.copy_from_slice(&values),
            Quantity::Sinkage => drawn.sinkage.copy_from_slice(&values),
            Quantity::Torque => drawn.torque.copy_from_slice(&values),
        }
    }
    drawn
}

/// The discrepancy of one quantity.
struct Quantified<'a> {
    errors: &'a Errors,
    experiment: &'a WheelTestExperiment<'a>,
    quantity: Quantity,
    found: &'a [f64],
}

impl Quantified<'_> {
    /// Its values, if it was measured.
    fn values(&self, read: &[f64], numbers: &[f64]) -> Option<Vec<f64>> {
        let first = self.experiment.sources().iter().position(|one| one.0 == self.quantity)?;
        let family = self.experiment.places()[first].family;
        let is_side = self.quantity == Quantity::SideForce;
        let angles = if is_side { &SLIP_ANGLES[1..] } else { &SLIP_ANGLES[..] };
        let at = |&slip_angle: &f64| SLIPS.map(|slip| Site { slip, slip_angle });
        let sites: Vec<Site> = angles.iter().flat_map(at).collect();
        let drawn = self.errors.drawn(family, &sites, read, self.found, numbers);
        let spread = spread_by_blending(&self.errors.lengths_in(self.found)).sqrt();
        let value = |(place, site): (usize, &Site)| {
            let value = drawn.mean[place] + spread * drawn.deviation[place];
            (self.deviation(site) * value).clamp(-LARGEST, LARGEST)
        };
        Some(sites.iter().enumerate().map(value).collect())
    }

    /// Standard deviation at a site, in the soil's measure: shares of load, or of sinkage.
    fn deviation(&self, site: &Site) -> f64 {
        let driven = site.slip >= DRIVEN_FROM;
        let of = |wanted: &dyn Fn(Regime) -> bool| {
            self.experiment.channels().iter().position(|channel| {
                let Channel::Wheel { quantity, regime } = channel else { return false };
                *quantity == self.quantity && wanted(*regime)
            })
        };
        let is_own = |regime| match regime {
            Regime::Any => true,
            Regime::Driven => driven,
            Regime::Skid => !driven,
        };
        let channel = of(&is_own).or_else(|| of(&|_| true));
        let size = match self.quantity {
            Quantity::SideForce => sideways(site.slip_angle),
            _ => 1.0,
        };
        let share = |channel: usize| self.found[channel] / self.errors.usual_weight(channel);
        size * channel.map_or(0.0, share)
    }
}

/// By how much the variance between the places of values falls short of that at them, on average;
/// its inverse [-]. What is drawn is spread by it, so that the function is as wide as the process.
fn spread_by_blending(lengths: &Lengths) -> f64 {
    let [own, common] = BLENDED;
    let kept = |correlation: f64| own + common * correlation;
    let site = |slip: f64, slip_angle: f64| Site { slip, slip_angle };
    let along = kept(lengths.correlation(&site(SLIPS[0], 0.0), &site(SLIPS[1], 0.0)));
    let pairs = SLIP_ANGLES.windows(2);
    let across: f64 =
        pairs.map(|pair| kept(lengths.correlation(&site(0.0, pair[0]), &site(0.0, pair[1])))).sum();
    1.0 / (along * across / (SLIP_ANGLES.len() - 1) as f64)
}
