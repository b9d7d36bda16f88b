//! Bevameter tests as an experiment: pressure under plates of several widths as they sink in.
//!
//! With one width alone the cohesive and the frictional modulus are not separately identifiable; a calibration of
//! such data reports it ([`identifiability`](super::identifiability)).

use super::experiment::{Channel, Experiment, Observation};
use crate::elementary::wide::ln;
use crate::elementary::{exp, pow};
use crate::error::{ParameterError, not_negative, positive};
use crate::soil::{PressureSinkage, SinkageExponent};

/// A plate pressed into the soil.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateCurve {
    /// The plate's smaller dimension, *b* [m].
    pub width: f64,
    /// Sinkage [m] and pressure [Pa], as they were read.
    pub points: Vec<PlatePoint>,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatePoint {
    /// Sinkage, *z* [m].
    pub sinkage: f64,
    /// Pressure, *p* [Pa].
    pub pressure: f64,
    /// Standard deviation of the pressure; 0 where it is unknown.
    pub scatter: f64,
}

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

    /// k_c, k_φ and n near some curves, to search from: the slope of log pressure over log sinkage
    /// of the widest plate, with hardly a cohesive part.
    #[must_use]
    pub fn first_guess(&self, curves: &[PlateCurve]) -> [f64; 3] {
        let widest = curves.iter().max_by(|one, other| one.width.total_cmp(&other.width));
        let points = widest.map_or(&[][..], |curve| curve.points.as_slice());
        let positive = points.iter().filter(|point| point.sinkage > 0.0 && point.pressure > 0.0);
        let logs: Vec<(f64, f64)> =
            positive.map(|point| (ln(point.sinkage), ln(point.pressure))).collect();
        let count = logs.len().max(1) as f64;
        let (x, y) = logs.iter().fold((0.0, 0.0), |sum, log| (sum.0 + log.0, sum.1 + log.1));
        let (x, y) = (x / count, y / count);
        let (above, below) = logs.iter().fold((0.0, 0.0), |sum, log| {
            (sum.0 + (log.0 - x) * (log.1 - y), sum.1 + (log.0 - x).powi(2))
        });
        let slope = if below > 0.0 { above / below } else { 1.0 };
        let n = slope.clamp(LEAST_EXPONENT, MOST_EXPONENT);
        let width = widest.map_or(1.0, |curve| curve.width);
        let stiffness = exp(y - n * x);
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
                not_negative("plate pressure [Pa]", point.pressure)?;
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
