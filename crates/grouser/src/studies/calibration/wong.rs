//! Moduli of Bekker's law from plates of several widths, by Wong's procedure (Wong 1980; Wong,
//! Theory of Ground Vehicles): the one that most published moduli come from, and a good place to
//! start a search from.
//!
//! Each plate has an exponent and a stiffness of its own, by a straight line of ln p over ln z in
//! which each reading weighs as the square of its pressure. The exponents are averaged; with their
//! mean each plate has a stiffness K = k_c/b + k_φ, and a straight line of K over 1/b, all plates
//! alike, has the moduli:
//!
//! ```text
//! n_j = Σ p² (ln p − ⟨ln p⟩)(ln z − ⟨ln z⟩) / Σ p² (ln z − ⟨ln z⟩)²,      n = mean n_j
//! ln K_j = Σ p² (ln p − n ln z) / Σ p²
//! ```
//!
//! Nothing keeps a modulus positive, and little keeps them certain: of plates whose exponents
//! differ, a percent in the pressures moves k_c by tens. A [`Calibration`](super::Calibration) says
//! how well they are known.

use super::plate_curve::PlateCurve;
use crate::elementary::exp;
use crate::elementary::wide::ln;

/// Moduli by Wong's procedure.
#[derive(Clone, Debug, PartialEq)]
pub struct WongFit {
    /// Cohesive modulus, *k_c* [N/m^(n+1)].
    pub k_c: f64,
    /// Frictional modulus, *k_φ* [N/m^(n+2)].
    pub k_phi: f64,
    /// Sinkage exponent, *n* [-].
    pub exponent: f64,
    /// Width [m] of each plate, its own exponent [-], and its stiffness K [N/m^(n+2)] with the mean
    /// exponent.
    pub plates: Vec<WongPlate>,
}

/// One plate in Wong's procedure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WongPlate {
    /// Width, *b* [m].
    pub width: f64,
    /// Its own exponent [-].
    pub exponent: f64,
    /// Its stiffness with the mean exponent, *K* [N/m^(n+2)].
    pub stiffness: f64,
}

impl WongFit {
    /// The moduli of some curves; `None` unless curves of two widths have two readings each of
    /// positive pressure at different positive sinkages. Other readings have no logarithm and do
    /// not count.
    #[must_use]
    pub fn of(curves: &[PlateCurve]) -> Option<Self> {
        let logs: Vec<LogCurve> = curves.iter().filter_map(LogCurve::of).collect();
        let exponent = logs.iter().map(|it| it.exponent).sum::<f64>() / logs.len() as f64;
        let plates = logs.iter().map(|it| WongPlate {
            width: it.width,
            exponent: it.exponent,
            stiffness: exp(it.pressure - exponent * it.sinkage),
        });
        let plates: Vec<WongPlate> = plates.collect();
        let line = plates.iter().map(|it| (1.0 / it.width, it.stiffness));
        let (k_c, k_phi) = straight_line(&line.collect::<Vec<_>>())?;
        Some(Self { k_c, k_phi, exponent, plates })
    }
}

/// Weighted means of a curve's logarithms, and the slope between them.
struct LogCurve {
    width: f64,
    sinkage: f64,
    pressure: f64,
    exponent: f64,
}

impl LogCurve {
    fn of(curve: &PlateCurve) -> Option<Self> {
        let positive = curve.points.iter().filter(|it| it.sinkage > 0.0 && it.pressure > 0.0);
        let logs = positive.map(|it| (ln(it.sinkage), ln(it.pressure), it.pressure.powi(2)));
        let logs: Vec<(f64, f64, f64)> = logs.collect();
        let weight: f64 = logs.iter().map(|it| it.2).sum();
        let mean = |of: fn(&(f64, f64, f64)) -> f64| {
            logs.iter().map(|it| it.2 * of(it)).sum::<f64>() / weight
        };
        let (sinkage, pressure) = (mean(|it| it.0), mean(|it| it.1));
        let (above, below) = logs.iter().fold((0.0, 0.0), |(above, below), (z, p, weight)| {
            let away = z - sinkage;
            (above + weight * away * (p - pressure), below + weight * away * away)
        });
        let width = curve.width;
        (below > 0.0).then(|| Self { width, sinkage, pressure, exponent: above / below })
    }
}

/// Slope and intercept of the straight line of least squares; `None` if all points are at one
/// place.
pub(super) fn straight_line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |sum, it| (sum.0 + it.0, sum.1 + it.1));
    let (x, y) = (x / count, y / count);
    let (above, below) = points
        .iter()
        .fold((0.0, 0.0), |sum, it| (sum.0 + (it.0 - x) * (it.1 - y), sum.1 + (it.0 - x).powi(2)));
    // Widths that differ by rounding alone are one.
    let is_spread = below > count * (1e-9 * x).powi(2);
    is_spread.then(|| (above / below, y - above / below * x))
}
