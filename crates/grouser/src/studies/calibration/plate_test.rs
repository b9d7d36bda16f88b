//! Bevameter tests as an experiment: pressure under plates of several widths as they sink in.
//!
//! With one width alone the cohesive and the frictional modulus are not separately identifiable; a
//! calibration of such data reports it ([`identifiability`](super::identifiability)).

use super::experiment::{Channel, Experiment, Observation};
use super::plate_curve::{PlateCurve, PlatePoint};
use super::wong::{WongFit, WongPlate, straight_line};
use crate::elementary::wide::ln;
use crate::elementary::{exp, pow};
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::soil::{PressureSinkage, SinkageExponent};

/// The fitted law, and the properties of the soil that it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlateLaw {
    /// p = (k_c/b + k_φ) zⁿ.
    Bekker,
    /// p = (c k'_c + γ b k'_φ) (z/b)ⁿ.
    Reece {
        /// Cohesion, *c* [Pa].
        cohesion: f64,
        /// Unit weight, *γ* [N/m³].
        unit_weight: f64,
    },
}

impl PlateLaw {
    /// Names of the parameters, in the order of [`Experiment::predict`]'s values.
    pub const PARAMETERS: [&'static str; 3] = ["k_c", "k_phi", "n"];

    /// The law with values of its parameters: k_c, k_φ and n, of the law's own units.
    #[must_use]
    pub fn with(&self, [k_c, k_phi, n]: [f64; 3]) -> PressureSinkage {
        let exponent = SinkageExponent::constant(n);
        match self {
            Self::Bekker => PressureSinkage::Bekker { k_c, k_phi, exponent },
            Self::Reece { .. } => PressureSinkage::Reece { k_c, k_phi, exponent },
        }
    }

    /// k_c, k_φ and n near some curves, to search from: by Wong's procedure ([`WongFit`]), or, with
    /// one width, those of its own line with hardly a cohesive part.
    #[must_use]
    pub fn first_guess(&self, curves: &[PlateCurve]) -> [f64; 3] {
        match WongFit::of(curves) {
            Some(fit) => self.guess_of(&fit),
            None => self.guess_of_one_width(curves),
        }
    }

    /// How large k_c and k_φ could be at most, if one of them made up all the stiffness of the
    /// stiffest plate; nothing where no plate has a stiffness.
    #[must_use]
    pub fn largest_moduli(&self, curves: &[PlateCurve]) -> Option<[f64; 2]> {
        let fit = WongFit::of(curves)?;
        let largest =
            |of: &dyn Fn(&WongPlate) -> f64| fit.plates.iter().map(of).fold(0.0, f64::max);
        Some(match self {
            Self::Bekker => [largest(&|it| it.stiffness * it.width), largest(&|it| it.stiffness)],
            Self::Reece { cohesion, unit_weight } => {
                let at_width = |it: &WongPlate| it.stiffness * pow(it.width, fit.exponent);
                let cohesive = if *cohesion > 0.0 { *cohesion } else { 1.0 };
                [
                    largest(&|it| at_width(it) / cohesive),
                    largest(&|it| at_width(it) / (unit_weight * it.width)),
                ]
            }
        })
    }

    fn guess_of(&self, fit: &WongFit) -> [f64; 3] {
        let n = fit.exponent.clamp(LEAST_EXPONENT, MOST_EXPONENT);
        match *self {
            Self::Bekker => [fit.k_c, fit.k_phi, n],
            Self::Reece { cohesion, unit_weight } => {
                // K bⁿ = c k'_c + γ b k'_φ is a straight line over b.
                let line = fit.plates.iter().map(|it| (it.width, it.stiffness * pow(it.width, n)));
                let line = straight_line(&line.collect::<Vec<_>>());
                let (slope, at_zero) = line.unwrap_or((unit_weight, 0.0));
                let k_c = if cohesion > 0.0 { at_zero / cohesion } else { 1.0 };
                [k_c, slope / unit_weight, n]
            }
        }
    }

    fn guess_of_one_width(&self, curves: &[PlateCurve]) -> [f64; 3] {
        let widest = curves.iter().max_by(|one, other| one.width.total_cmp(&other.width));
        let points = widest.map_or(&[][..], |curve| curve.points.as_slice());
        let positive = points.iter().filter(|point| point.sinkage > 0.0 && point.pressure > 0.0);
        let logs: Vec<(f64, f64)> =
            positive.map(|point| (ln(point.sinkage), ln(point.pressure))).collect();
        let count = (logs.len() as f64).max(1.0);
        let (x, y) = logs.iter().fold((0.0, 0.0), |sum, log| (sum.0 + log.0, sum.1 + log.1));
        let n = straight_line(&logs).map_or(1.0, |(slope, _)| slope);
        let n = n.clamp(LEAST_EXPONENT, MOST_EXPONENT);
        let width = widest.map_or(1.0, |curve| curve.width);
        // Through the middle of the points.
        let stiffness = exp((y - n * x) / count);
        match self {
            Self::Bekker => [0.1 * stiffness * width, stiffness, n],
            Self::Reece { unit_weight, .. } => {
                [1.0, stiffness * pow(width, n) / (unit_weight * width), n]
            }
        }
    }
}

/// A search starts from an exponent between these [-]. Source: ours; published soils lie within.
const LEAST_EXPONENT: f64 = 0.4;
const MOST_EXPONENT: f64 = 2.5;

/// Curves of one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateTest {
    law: PlateLaw,
    curves: Vec<PlateCurve>,
    observations: Vec<Observation>,
}

impl PlateTest {
    /// The experiment of some curves.
    ///
    /// # Errors
    /// [`ParameterError`] for an invalid width, sinkage or pressure.
    pub fn new(law: PlateLaw, curves: Vec<PlateCurve>) -> Result<Self, ParameterError> {
        if let PlateLaw::Reece { cohesion, unit_weight } = law {
            not_negative("cohesion [Pa]", cohesion)?;
            positive("unit weight [N/m³]", unit_weight)?;
        }
        let mut observations = Vec::new();
        for curve in &curves {
            positive("plate width [m]", curve.width)?;
            for point in &curve.points {
                not_negative("plate sinkage [m]", point.sinkage)?;
                finite("plate pressure [Pa]", point.pressure)?;
                not_negative("scatter of a plate pressure [Pa]", point.scatter)?;
                let PlatePoint { pressure: value, scatter, .. } = *point;
                observations.push(Observation { value, scatter, channel: 0 });
            }
        }
        Ok(Self { law, curves, observations })
    }

    /// The law that is fitted.
    #[must_use]
    pub fn law(&self) -> PlateLaw {
        self.law
    }

    /// How many widths of plates there are; two moduli need two.
    #[must_use]
    pub fn widths(&self) -> usize {
        let mut widths: Vec<f64> = self.curves.iter().map(|curve| curve.width).collect();
        widths.sort_by(f64::total_cmp);
        widths.dedup();
        widths.len()
    }
}

impl Experiment for PlateTest {
    fn channels(&self) -> &[Channel] {
        &[Channel::PlatePressure]
    }

    fn observations(&self) -> &[Observation] {
        &self.observations
    }

    fn predict(&self, values: &[f64], predictions: &mut [f64]) -> Result<(), ParameterError> {
        let &[k_c, k_phi, n] = values else {
            let expected = "three: k_c, k_phi, n";
            let count = values.len() as f64;
            return Err(ParameterError::new("number of plate parameters", count, expected));
        };
        let (cohesion, unit_weight) = match self.law {
            // Bekker's moduli contain both.
            PlateLaw::Bekker => (0.0, 0.0),
            PlateLaw::Reece { cohesion, unit_weight } => (cohesion, unit_weight),
        };
        let law = self.law.with([k_c, k_phi, n]);
        /// A plate does not slip.
        const SLIP_RATIO: f64 = 0.0;
        let pressures = self.curves.iter().flat_map(|curve| {
            let stiffness = law.stiffness(curve.width, cohesion, unit_weight, SLIP_RATIO);
            curve.points.iter().map(move |point| stiffness.pressure(point.sinkage))
        });
        for (prediction, pressure) in predictions.iter_mut().zip(pressures) {
            *prediction = pressure;
        }
        Ok(())
    }
}
