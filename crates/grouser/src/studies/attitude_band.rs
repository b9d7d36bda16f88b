//! The attitude on an uncertain soil: a curve for each of many soils, and what they say together.
//!
//! The soils come from outside, one for each draw: whoever knows the distribution (a document, a
//! posterior) makes them, and this study only asks [`attitude`](super::attitude) of each. They are
//! plain values, drawn before anything is computed, so that a draw that fails is told at once.

use super::attitude::{Attitude, AttitudeCurve, AttitudeStudy, NoAttitude};
use super::ensemble::{Band, Probability, outputs_while};
use crate::error::ParameterError;
use crate::soil::Soil;

/// What the draws say of the attitude.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeBand {
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeBand>,
    /// Steepest slope with a level attitude [rad], over the draws on which the rover can drive at
    /// all.
    pub limit: Option<Band>,
    /// The number of those draws among all.
    pub mobile: Probability,
}

/// What the draws say of one slope. Bands are over the draws that have a level attitude there.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeBand {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// How many of the draws have a level attitude.
    pub level: Probability,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: Option<Band>,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m].
    pub sinkage: Option<Band>,
    /// Work of the wheels per metre along the contour [J/m].
    pub energy_per_metre: Option<Band>,
}

/// What is kept of an attitude.
#[derive(Clone, Copy)]
struct Kept {
    yaw: f64,
    slip_ratio: f64,
    sinkage: f64,
    energy_per_metre: f64,
}

/// What is kept of a curve.
struct Draw {
    limit: Option<f64>,
    on_slopes: Vec<Option<Kept>>,
}

impl AttitudeBand {
    /// Follows the curve of each soil; `study.soil` is not used. The draws are shared among
    /// threads and keep their order: the result is the same for any number of threads.
    ///
    /// Between which bounds is the heading offset that holds the contour on 10°, in sand that is known
    /// only roughly?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::attitude::AttitudeStudy;
    /// use grouser::studies::attitude_band::AttitudeBand;
    /// use grouser::units::deg;
    ///
    /// let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let soils = scenario.uncertain.expect("it is uncertain").draws(7, 50)?;
    /// let study = AttitudeStudy::of(&scenario.value);
    /// let band = AttitudeBand::of(&study, &soils, &[deg(10.0)], &|| true)?.expect("not stopped");
    /// let yaw = band.slopes[0].yaw.expect("some samples hold the contour");
    /// assert_eq!(format!("{:.1}°", yaw.low.to_degrees()), "2.2°");
    /// assert_eq!(format!("{:.1}°", yaw.high.to_degrees()), "11.4°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `soils`: one for each draw; at least one
    /// * `slopes`: [rad]
    /// * `go_on`: asked before each soil, from any thread; without it there is no result
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil.
    ///
    /// # Panics
    /// If there are no soils.
    pub fn of(
        study: &AttitudeStudy,
        soils: &[Soil],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        assert!(!soils.is_empty(), "a band needs draws");
        let one = |soil: &Soil| {
            let curve = AttitudeStudy { soil: *soil, ..study.clone() }.curve()?;
            Ok(Draw::of(&curve, study, slopes))
        };
        let Some(draws) = outputs_while(soils, go_on, one) else { return Ok(None) };
        // Collected in order, so that the error is always that of the first soil.
        let draws = draws.into_iter().collect::<Result<Vec<Draw>, ParameterError>>()?;
        Ok(Some(Self::over(&draws, slopes)))
    }

    fn over(draws: &[Draw], slopes: &[f64]) -> Self {
        let limits: Vec<f64> = draws.iter().filter_map(|draw| draw.limit).collect();
        let slopes = slopes.iter().enumerate().map(|(place, slope)| {
            let kept: Vec<Kept> = draws.iter().filter_map(|draw| draw.on_slopes[place]).collect();
            let band = |quantity: fn(&Kept) -> f64| Band::of(kept.iter().map(quantity));
            SlopeBand {
                slope: *slope,
                level: Probability { successes: kept.len(), trials: draws.len() },
                yaw: band(|kept| kept.yaw),
                slip_ratio: band(|kept| kept.slip_ratio),
                sinkage: band(|kept| kept.sinkage),
                energy_per_metre: band(|kept| kept.energy_per_metre),
            }
        });
        Self {
            slopes: slopes.collect(),
            mobile: Probability { successes: limits.len(), trials: draws.len() },
            limit: Band::of(limits),
        }
    }
}

impl Draw {
    fn of(curve: &AttitudeCurve, study: &AttitudeStudy, slopes: &[f64]) -> Self {
        let keep = |attitude: Attitude| Kept {
            yaw: attitude.yaw,
            slip_ratio: attitude.slip_ratio,
            sinkage: attitude.mean_sinkage(),
            energy_per_metre: attitude.energy_per_metre(&study.rover),
        };
        let on_slope = |slope: &f64| match curve.at(*slope) {
            Ok(attitude) => Some(keep(attitude)),
            Err(NoAttitude::CannotMove(_) | NoAttitude::TooSteep { .. }) => None,
        };
        Self {
            limit: curve.limit().ok().map(|(slope, _)| slope),
            on_slopes: slopes.iter().map(on_slope).collect(),
        }
    }
}
