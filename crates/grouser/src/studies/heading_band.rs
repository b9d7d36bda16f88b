//! The heading offset on an uncertain soil: a curve for each sampled soil, and quantiles over them.
//!
//! The caller samples the soils from their distribution (of a document, or a posterior), and this study follows
//! the curve of [`heading`](super::heading) for each. They are sampled before anything is computed, so that a
//! sample that fails is reported at once.

use super::ensemble::{Band, Probability, outputs_while};
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy, NoHeading};
use crate::error::ParameterError;
use crate::soil::Soil;

/// Heading offsets and the steepest slope, with quantiles over the sampled soils.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingBand {
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeBand>,
    /// Steepest slope on which a heading holds the contour [rad], over the samples on which the rover can
    /// drive on level ground.
    pub limit: Option<Band>,
    /// The number of those samples among all.
    pub mobile: Probability,
}

/// Heading offset, slip, sinkage and energy on one slope, with quantiles over the samples on which a heading holds
/// the contour there.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeBand {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// How many of the samples have a heading that holds the contour.
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

/// The numbers of a heading offset that the bands need.
#[derive(Clone, Copy)]
struct Kept {
    yaw: f64,
    slip_ratio: f64,
    sinkage: f64,
    energy_per_metre: f64,
}

/// One sample: the numbers of its curve that the bands need.
struct Sample {
    limit: Option<f64>,
    on_slopes: Vec<Option<Kept>>,
}

impl HeadingBand {
    /// Follows the curve of each soil; `study.soil` is not used. The samples are shared among
    /// threads and keep their order: the result is the same for any number of threads.
    ///
    /// Between which bounds is the heading offset that holds the contour on 10°, in sand that is known
    /// only roughly?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::studies::heading_band::HeadingBand;
    /// use grouser::units::deg;
    ///
    /// let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let soils = scenario.uncertain.expect("it is uncertain").draws(7, 50)?;
    /// let study = HeadingStudy::of(&scenario.value);
    /// let band = HeadingBand::of(&study, &soils, &[deg(10.0)], &|| true)?.expect("not stopped");
    /// let yaw = band.slopes[0].yaw.expect("some samples hold the contour");
    /// assert_eq!(format!("{:.1}°", yaw.low.to_degrees()), "2.2°");
    /// assert_eq!(format!("{:.1}°", yaw.high.to_degrees()), "11.4°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `soils`: one for each sample; at least one
    /// * `slopes`: [rad]
    /// * `go_on`: asked before each soil, from any thread; without it there is no result
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil.
    ///
    /// # Panics
    /// If there are no soils.
    pub fn of(
        study: &HeadingStudy,
        soils: &[Soil],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        assert!(!soils.is_empty(), "a band needs samples");
        let one = |soil: &Soil| {
            let curve = HeadingStudy { soil: *soil, ..study.clone() }.curve()?;
            Ok(Sample::of(&curve, study, slopes))
        };
        let Some(samples) = outputs_while(soils, go_on, one) else { return Ok(None) };
        // Collected in order, so that the error is always that of the first soil.
        let samples = samples.into_iter().collect::<Result<Vec<Sample>, ParameterError>>()?;
        Ok(Some(Self::over(&samples, slopes)))
    }

    fn over(samples: &[Sample], slopes: &[f64]) -> Self {
        let limits: Vec<f64> = samples.iter().filter_map(|sample| sample.limit).collect();
        let slopes = slopes.iter().enumerate().map(|(place, slope)| {
            let kept: Vec<Kept> =
                samples.iter().filter_map(|sample| sample.on_slopes[place]).collect();
            let band = |quantity: fn(&Kept) -> f64| Band::of(kept.iter().map(quantity));
            SlopeBand {
                slope: *slope,
                level: Probability { successes: kept.len(), trials: samples.len() },
                yaw: band(|kept| kept.yaw),
                slip_ratio: band(|kept| kept.slip_ratio),
                sinkage: band(|kept| kept.sinkage),
                energy_per_metre: band(|kept| kept.energy_per_metre),
            }
        });
        Self {
            slopes: slopes.collect(),
            mobile: Probability { successes: limits.len(), trials: samples.len() },
            limit: Band::of(limits),
        }
    }
}

impl Sample {
    fn of(curve: &HeadingCurve, study: &HeadingStudy, slopes: &[f64]) -> Self {
        let keep = |heading: HeadingOffset| Kept {
            yaw: heading.yaw,
            slip_ratio: heading.slip_ratio,
            sinkage: heading.mean_sinkage(),
            energy_per_metre: heading.energy_per_metre(&study.rover),
        };
        let on_slope = |slope: &f64| match curve.at(*slope) {
            Ok(heading) => Some(keep(heading)),
            Err(
                NoHeading::CannotMove(_)
                | NoHeading::TooSteep { .. }
                | NoHeading::GroundStrength { .. },
            ) => None,
        };
        Self {
            limit: curve.limit().ok().map(|(slope, _)| slope),
            on_slopes: slopes.iter().map(on_slope).collect(),
        }
    }
}
