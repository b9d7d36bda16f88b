//! Plate and shear tests of one soil as one experiment.
//!
//! Both parts of a bevameter's work speak of one soil: cohesion, friction angle and shear modulus
//! come from its shear tests, the moduli of pressure-sinkage from its plates, and in Reece's law
//! the plates know the cohesion too. So a soil is predicted as a whole, and both kinds of curves
//! are fitted together.

use super::experiment::{Channel, Experiment, Observation};
use super::plate_curve::{PlateCurve, PlatePoint};
use super::repeated_curves::{CurvePoint, MeanCurve, means, thinned};
use super::shear_test::{ShearCurve, ShearStrength};
use super::wheel_test::SoilOf;
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::soil::{Shear, Soil};

/// Curves of one soil, each the mean over its repeats.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BevameterCurves {
    /// Curves of plate tests, one for each width, narrow ones first.
    pub plates: Vec<PlateCurve>,
    /// Curves of shear tests, one for each normal stress, low ones first.
    pub shear: Vec<ShearCurve>,
    /// How many curves each of the plates' is the mean of; then of the shear curves.
    pub repeats: (Vec<usize>, Vec<usize>),
}

/// Normal stresses of repeats differ by at most this share [-]. Source: ours; a stand holds its
/// load to a few percent, and those of a series differ by much more.
pub const SAME_NORMAL_STRESS: f64 = 0.1;

impl BevameterCurves {
    /// Makes one curve of those that repeat each other, and a short one of each long one
    /// ([`repeated_curves`](super::repeated_curves)).
    ///
    /// * `plates`: those of one width repeat each other
    /// * `shear`: those of one normal stress, within [`SAME_NORMAL_STRESS`], repeat each other
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is wrong.
    pub fn of(plates: &[PlateCurve], shear: &[ShearCurve]) -> Result<Self, ParameterError> {
        plates.iter().try_for_each(check_plate)?;
        shear.iter().try_for_each(ShearCurve::check)?;
        let (plates, of_plates) = means_by(
            plates.iter().map(|it| (it.width, it.points.iter().map(of_plate).collect())),
            |one, other| one == other,
        );
        let (shear, of_shear) =
            means_by(shear.iter().map(|it| (it.normal_stress, it.points.clone())), |one, other| {
                (one - other).abs() <= SAME_NORMAL_STRESS * one
            });
        let plate = |(width, points): (f64, Vec<CurvePoint>)| PlateCurve {
            width,
            points: points.iter().map(to_plate).collect(),
        };
        let curve = |(normal_stress, points)| ShearCurve { normal_stress, points };
        Ok(Self {
            plates: plates.into_iter().map(plate).collect(),
            shear: shear.into_iter().map(curve).collect(),
            repeats: (of_plates, of_shear),
        })
    }

    /// How many widths of plates there are; two moduli need two.
    #[must_use]
    pub fn widths(&self) -> usize {
        self.plates.len()
    }

    /// How many normal stresses there are; cohesion and friction angle need two.
    #[must_use]
    pub fn normal_stresses(&self) -> usize {
        self.shear.len()
    }
}

/// The settings of some curves, rising, each with the mean over its curves; then the numbers of
/// these.
fn means_by(
    curves: impl Iterator<Item = (f64, Vec<CurvePoint>)>,
    is_same: impl Fn(f64, f64) -> bool,
) -> (Vec<(f64, Vec<CurvePoint>)>, Vec<usize>) {
    let mut curves: Vec<_> = curves.collect();
    // Stable: repeats keep their order.
    curves.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut settings: Vec<(Vec<f64>, Vec<Vec<CurvePoint>>)> = Vec::new();
    for (setting, points) in curves {
        let points = thinned(&points);
        match settings.last_mut().filter(|(all, _)| is_same(all[0], setting)) {
            Some((all, repeats)) => {
                all.push(setting);
                repeats.push(points);
            }
            None => settings.push((vec![setting], vec![points])),
        }
    }
    let (values, repeats): (Vec<_>, Vec<_>) = settings.into_iter().unzip();
    let mean = |all: &Vec<f64>| all.iter().sum::<f64>() / all.len() as f64;
    let (points, counts): (Vec<_>, Vec<_>) =
        means(&repeats).into_iter().map(|MeanCurve { points, repeats }| (points, repeats)).unzip();
    (values.iter().map(mean).zip(points).collect(), counts)
}

fn check_plate(curve: &PlateCurve) -> Result<(), ParameterError> {
    positive("plate width [m]", curve.width)?;
    for point in &curve.points {
        not_negative("plate sinkage [m]", point.sinkage)?;
        finite("plate pressure [Pa]", point.pressure)?;
        not_negative("scatter of a plate pressure [Pa]", point.scatter)?;
    }
    Ok(())
}

fn of_plate(point: &PlatePoint) -> CurvePoint {
    CurvePoint { at: point.sinkage, value: point.pressure, scatter: point.scatter }
}

fn to_plate(point: &CurvePoint) -> PlatePoint {
    PlatePoint { sinkage: point.at, pressure: point.value, scatter: point.scatter }
}

/// What shears a soil beneath a plate that moves straight ahead.
#[must_use]
pub fn shear_strength(soil: &Soil) -> ShearStrength {
    let modulus = match soil.shear {
        Shear::Isotropic { modulus } => modulus,
        Shear::Anisotropic { longitudinal, .. } => longitudinal,
    };
    ShearStrength {
        cohesion: soil.cohesion,
        friction_angle: soil.friction_angle,
        modulus: modulus.at(0.0),
    }
}

/// Curves of a soil, and how a soil is made of parameter values.
pub struct BevameterTest<'a> {
    curves: BevameterCurves,
    gravity: f64,
    soil_of: &'a SoilOf<'a>,
    observations: Vec<Observation>,
}

impl<'a> BevameterTest<'a> {
    /// The experiment of some curves.
    ///
    /// * `gravity`: *g* where they were measured [m/s²], which Reece's law reads
    /// * `soil_of`: makes a soil of parameter values
    ///
    /// # Errors
    /// [`ParameterError`] for a gravity that is not above zero.
    pub fn new(
        curves: BevameterCurves,
        gravity: f64,
        soil_of: &'a SoilOf<'a>,
    ) -> Result<Self, ParameterError> {
        positive("gravity [m/s²]", gravity)?;
        let pressures = curves.plates.iter().flat_map(|curve| curve.points.iter().map(of_plate));
        let stresses = curves.shear.iter().flat_map(|curve| curve.points.iter().copied());
        let observation = |(point, channel): (CurvePoint, usize)| Observation {
            value: point.value,
            scatter: point.scatter,
            channel,
        };
        let shear_channel = usize::from(!curves.plates.is_empty());
        let observations = pressures
            .map(|point| (point, 0))
            .chain(stresses.map(|point| (point, shear_channel)))
            .map(observation)
            .collect();
        Ok(Self { curves, gravity, soil_of, observations })
    }
}

/// Pressures [Pa] of a soil at the points of some plates.
fn pressures<'c>(
    soil: &Soil,
    gravity: f64,
    plates: &'c [PlateCurve],
) -> Result<impl Iterator<Item = f64> + 'c, ParameterError> {
    /// A plate does not slip.
    const SLIP_RATIO: f64 = 0.0;
    let (law, cohesion, weight) = (soil.pressure_sinkage, soil.cohesion, soil.unit_weight(gravity));
    for plate in plates {
        law.check_width(plate.width, cohesion, weight)?;
    }
    Ok(plates.iter().flat_map(move |plate| {
        let stiffness = law.stiffness(plate.width, cohesion, weight, SLIP_RATIO);
        plate.points.iter().map(move |point| stiffness.pressure(point.sinkage))
    }))
}

impl Experiment for BevameterTest<'_> {
    fn channels(&self) -> &[Channel] {
        const BOTH: [Channel; 2] = [Channel::PlatePressure, Channel::ShearStress];
        match (self.curves.plates.is_empty(), self.curves.shear.is_empty()) {
            (false, false) => &BOTH,
            (false, true) => &BOTH[..1],
            (true, _) => &BOTH[1..],
        }
    }

    fn observations(&self) -> &[Observation] {
        &self.observations
    }

    fn predict(&self, values: &[f64], predictions: &mut [f64]) -> Result<(), ParameterError> {
        let soil = (self.soil_of)(values)?;
        let strength = shear_strength(&soil);
        let stresses = self.curves.shear.iter().flat_map(|curve| {
            curve.points.iter().map(move |it| strength.stress(curve.normal_stress, it.at))
        });
        let all = pressures(&soil, self.gravity, &self.curves.plates)?.chain(stresses);
        for (prediction, value) in predictions.iter_mut().zip(all) {
            *prediction = value;
        }
        Ok(())
    }
}
