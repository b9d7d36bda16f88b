//! What a forecast is made for.

use super::choices::{Choices, Ground};
use super::factor::{Factor, FactorKind};
use crate::studies::ensemble::NothingAccepted;
use crate::studies::ensemble::factorial::Factorial;
use crate::studies::ensemble::samples::{BandInputs, Sample};
use crate::studies::heading::HeadingStudy;

/// What a forecast is made for.
#[derive(Clone, Debug)]
pub struct ForecastStudy {
    /// Rover, soil as its document has it, gravity of the site, model and load transfer.
    pub heading: HeadingStudy,
    /// Gravity under which the soil's constants were measured, *g₀* [m/s²].
    pub measured_under: f64,
    /// Rim speed ω r_s [m/s], for the power.
    pub rim_speed: f64,
    /// Slip ratio of which a forecast says how probably it is exceeded [-].
    pub no_go_slip_ratio: f64,
    /// What no sample decides.
    pub choices: Choices,
    /// How many samples there are of the soil and, each with each, of what a model gets wrong.
    pub samples: [u32; 2],
    /// Seed of the samples.
    pub seed: u64,
}

impl ForecastStudy {
    /// Models, samples of the soil and of what a model gets wrong: one sample where there is
    /// nothing to draw.
    ///
    /// * `ground`: `None` where the soil was measured
    pub(super) fn sampled(&self, band: &BandInputs, ground: Option<&Ground>) -> [Factor; 3] {
        let [soils, discrepancies] = self.samples;
        let is_open = band.has_soils() || ground.is_some_and(Ground::is_uncertain);
        let soils = if is_open { soils } else { 1 };
        let discrepancies = if band.has_soils() { discrepancies } else { 1 };
        [
            Factor::of_models(band.models()),
            Factor::numbered(FactorKind::SoilParameters, soils),
            Factor::numbered(FactorKind::ModelDiscrepancy, discrepancies),
        ]
    }

    /// Model and soil at levels of model, soil and discrepancy, as under the gravity of the
    /// measurement.
    pub(super) fn sample(
        &self,
        band: &BandInputs,
        levels: &[usize],
    ) -> Result<Sample, NothingAccepted> {
        let (model, _) = &band.models().shares()[levels[0]];
        band.crossed(model.clone(), self.seed, [levels[1] as u64, levels[2] as u64])
    }
}

/// Every level of each factor with every level of the others.
pub(super) fn design_of(factors: &[Factor]) -> Factorial {
    Factorial::new(factors.iter().map(Factor::counts).collect())
}
