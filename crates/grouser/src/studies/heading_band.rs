//! The heading offset where soil and model are uncertain: a curve for each sample, and quantiles
//! over them.
//!
//! The caller draws the [samples](super::ensemble::samples), and this study follows the curve of
//! [`heading`](super::heading) for each.
//!
//! Bands are over all samples. One in which no heading holds the course counts as slip 1, sunk to
//! the axle, with work per metre without a bound, and with a yaw above every number: it is not left
//! out, since what is left would be the strong soils alone. A sample for which the search for a
//! heading gave up says nothing about the soil: it is in no band and no probability, and how many
//! there are is counted.

use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability};
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy, LimitedBy, NoHeading, STUCK};
use super::verdict::{Advice, Holding, SlopeStudy};
use crate::error::ParameterError;
use crate::vehicle::Rover;

/// Heading offsets and the steepest slope, with quantiles over the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingBand {
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeBand>,
    /// Steepest slope on which a heading holds the course [rad]; 0 in a sample in which the rover
    /// cannot drive on level ground.
    pub limit: Option<Band>,
    /// In how many of the samples the rover can drive on level ground.
    pub mobile: Probability,
    /// In how many of the samples the search gave up before the end of the curve: their limits are
    /// not known.
    pub not_found: usize,
}

/// Heading offset, slip, sinkage and energy on one slope, with quantiles over the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeBand {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// In how many of the samples a heading holds the course, of those for which that is known.
    pub level: Probability,
    /// For how many samples the search gave up on this slope.
    pub not_found: usize,
    /// Yaw, *γ* [rad], positive uphill; above every number where no heading holds the course.
    pub yaw: Option<Band>,
    /// Slip ratio of every wheel, *s* [-]; 1 where no heading holds the course.
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m]; down to the axles where no heading holds the course.
    pub sinkage: Option<Band>,
    /// Work of the wheels per metre along the course [J/m]; infinite where no heading holds the
    /// course.
    pub energy_per_metre: Option<Band>,
    /// Course, *χ* [rad].
    course: f64,
    /// Whether each sample holds it.
    held: Vec<Holding>,
}

/// The numbers of a heading offset that the bands need.
#[derive(Clone, Copy)]
struct Kept {
    slip_ratio: f64,
    sinkage: f64,
    energy_per_metre: f64,
}

/// One sample: the numbers of its curve that the bands need.
#[derive(Clone)]
struct OfSample {
    /// 0 where the rover cannot drive on level ground; missing where the search gave up before the
    /// end.
    limit: Option<f64>,
    /// Missing where the search found no start.
    is_mobile: Option<bool>,
    /// Missing where the search gave up.
    on_slopes: Vec<Option<Kept>>,
    held: Vec<Holding>,
}

impl HeadingBand {
    /// Follows the curve of contour traverses of each sample; `study.soil` and `study.model` are
    /// not used. The samples are shared among threads and keep their order: the result is the same
    /// for any number of threads.
    ///
    /// Between which bounds is the heading offset that holds the contour on 10°, in sand that is
    /// known only roughly, if the source paper's model is right?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::ensemble::samples::BandInputs;
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::studies::heading_band::HeadingBand;
    /// use grouser::units::deg;
    ///
    /// let overrides =
    ///     Overrides::parse(["scenario.soil=toyoura-uncertain", "scenario.model=ishigami"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let samples = BandInputs::of_scenario(&scenario).samples(7, 50)?;
    /// let study = HeadingStudy::of(&scenario.value);
    /// let band = HeadingBand::of(&study, &samples, &[deg(10.0)], &|| true)?.expect("not stopped");
    /// let yaw = band.slopes[0].yaw.expect("some samples hold the contour");
    /// assert_eq!(format!("{:.1}°", yaw.low.to_degrees()), "2.1°");
    /// assert_eq!(format!("{:.1}°", yaw.high.to_degrees()), "14.0°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `samples`: at least one
    /// * `slopes`: [rad]
    /// * `go_on`: asked before each curve, from any thread; without it there is no result
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid soil.
    ///
    /// # Panics
    /// If there are no samples.
    pub fn of(
        study: &HeadingStudy,
        samples: &[Sample],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        Self::on_course(study, 0.0, samples, slopes, go_on)
    }

    /// The same on another course, *χ* [rad], −π/2 to π/2, positive uphill.
    ///
    /// # Errors
    /// The same as [`of`](Self::of), and [`ParameterError`] for a course out of its range.
    ///
    /// # Panics
    /// The same as [`of`](Self::of).
    pub fn on_course(
        study: &HeadingStudy,
        course: f64,
        samples: &[Sample],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        assert!(!samples.is_empty(), "a band needs samples");
        let one = |sample: &Sample| {
            let curve = study.of_sample(sample).curve_on(course)?;
            Ok(OfSample::of(&curve, &study.rover, slopes))
        };
        let Some(all) = outputs_of_samples(samples, go_on, one) else { return Ok(None) };
        // Collected in order, so that the error is always that of the first soil.
        let all = all.into_iter().collect::<Result<Vec<OfSample>, ParameterError>>()?;
        Ok(Some(Self::over(&all, slopes, course)))
    }

    fn over(samples: &[OfSample], slopes: &[f64], course: f64) -> Self {
        let slopes = slopes.iter().enumerate().map(|(place, slope)| {
            let kept = || samples.iter().filter_map(|sample| sample.on_slopes[place].as_ref());
            let trials = kept().count();
            let held: Vec<Holding> = samples.iter().map(|sample| sample.held[place]).collect();
            let successes = held.iter().filter(|it| it.is_held()).count();
            SlopeBand {
                slope: *slope,
                level: Probability { successes, trials },
                not_found: samples.len() - trials,
                yaw: Band::of(held.iter().filter_map(|it| it.yaw())),
                slip_ratio: Band::of(kept().map(|kept| kept.slip_ratio)),
                sinkage: Band::of(kept().map(|kept| kept.sinkage)),
                energy_per_metre: Band::of(kept().map(|kept| kept.energy_per_metre)),
                course,
                held,
            }
        });
        let mobile = || samples.iter().filter_map(|sample| sample.is_mobile);
        let successes = mobile().filter(|is_mobile| *is_mobile).count();
        let limits: Vec<f64> = samples.iter().filter_map(|sample| sample.limit).collect();
        Self {
            slopes: slopes.collect(),
            mobile: Probability { successes, trials: mobile().count() },
            not_found: samples.len() - limits.len(),
            limit: Band::of(limits),
        }
    }
}

impl SlopeBand {
    /// What to do there.
    ///
    /// * `study`: of the same rover, gravity and load transfer
    /// * `samples`: that the band is over
    #[must_use]
    pub fn advice(&self, study: &SlopeStudy, samples: &[Sample]) -> Advice {
        study.judged((self.slope, self.course), &self.held, samples)
    }
}

impl HeadingStudy {
    /// The study with a sample's soil and model.
    #[must_use]
    pub fn of_sample(&self, sample: &Sample) -> Self {
        Self { soil: sample.soil, model: sample.model.clone(), ..self.clone() }
    }
}

impl OfSample {
    fn of(curve: &HeadingCurve, rover: &Rover, slopes: &[f64]) -> Self {
        let found: Vec<_> = slopes.iter().map(|slope| curve.at(*slope)).collect();
        let on_slope = |found: &Result<HeadingOffset, NoHeading>| match found {
            Ok(heading) => Some(Kept::of(heading, rover)),
            Err(
                NoHeading::CannotMove(_)
                | NoHeading::TooSteep { .. }
                | NoHeading::GroundStrength { .. },
            ) => Some(Kept::stuck(rover)),
            Err(NoHeading::NotFound { .. }) => None,
        };
        let limit = match curve.limit() {
            Ok((slope, _)) => (curve.limited_by() != Some(LimitedBy::NotFound)).then_some(slope),
            Err(none) => (!none.is_not_found()).then_some(0.0),
        };
        let is_mobile = curve
            .limit()
            .map_or_else(|none| (!none.is_not_found()).then_some(false), |_| Some(true));
        let held = found.iter().map(|it| Holding::of(curve, it)).collect();
        Self { limit, is_mobile, on_slopes: found.iter().map(on_slope).collect(), held }
    }
}

impl Kept {
    fn of(heading: &HeadingOffset, rover: &Rover) -> Self {
        Self {
            slip_ratio: heading.slip_ratio,
            sinkage: heading.mean_sinkage(),
            energy_per_metre: heading.energy_per_metre(rover),
        }
    }

    /// No heading holds the course: the wheels turn on the spot, and dig in down to their axles.
    fn stuck(rover: &Rover) -> Self {
        let sinkage = rover.mean_axle_height();
        Self { slip_ratio: STUCK, sinkage, energy_per_metre: f64::INFINITY }
    }
}
