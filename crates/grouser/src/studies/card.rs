//! The operator's card: for each slope the heading to set, what instruments show at it, how often
//! it is to be set again, the readings at which to stop, and a verdict to go or not.
//!
//! Heading and verdict are the [`Advice`] that every study gives for a slope; every other number
//! has a band over samples of soil and model. A verdict depends on its slope alone; corrections and
//! looks at the slip are never rarer on a steeper slope.

pub mod courses;
pub mod drives;
mod stops;

pub use stops::CardStops;

use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability};
use super::heading::{HeadingCurve, HeadingOffset, LimitedBy, STRAIGHT_DOWN};
use super::verdict::{Advice, DrivenMotion, Holding, SlopeStudy};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::error::ParameterError;

/// The card's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// On each slope that was asked for, in that order.
    pub rows: Vec<CardRow>,
    /// Steepest slope on which a heading holds the contour on the soil as written [rad], and what
    /// ends it; `Err` with the reason where the rover cannot move.
    pub limit: Result<(f64, String), String>,
    /// The same over the samples; 0 where the rover cannot move.
    pub limit_band: Option<Band>,
    /// Number of samples; `None` if there are none.
    pub draws: Option<usize>,
    /// Whether the rover's motors are known, and with them their currents.
    pub has_motors: bool,
}

/// One slope of the card.
#[derive(Clone, Debug, PartialEq)]
pub struct CardRow {
    /// The heading to set, what becomes of a rover that is driven by it, and the verdict.
    pub advice: Advice,
    /// On the soil as written; `None` where no heading holds the contour.
    pub level: Option<Level>,
    /// Heading of each of the other models on the soil as written, *γ* [rad]; `None` where none
    /// holds the contour.
    pub other_models: Vec<(Model, Option<f64>)>,
    /// Why no heading holds the contour on the soil as written; nothing where one does.
    pub refusal: Option<String>,
    /// Drift on the soil as written, way downhill for a metre along the contour with the nose on
    /// the contour [-]; `None` where the rover slides.
    pub drift: Option<f64>,
    /// Over the samples; `None` if there are none.
    pub bands: Option<CardBands>,
    /// The flags of the contour traverse on the soil as written.
    pub findings: Vec<Finding>,
}

/// A contour traverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: f64,
    /// Power of the motors [W].
    pub power: f64,
}

/// One slope over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CardBands {
    /// Slip ratio, *s* [-], over all samples: 1 where no heading holds the contour.
    pub slip_ratio: Option<Band>,
    /// Power of the motors [W], over the samples in which a heading holds the contour.
    pub power: Option<Band>,
    /// Samples in which the rover does not slide with the nose on the contour.
    pub held: Probability,
    /// Drift [-], over all samples: 1, straight downhill, where the rover slides.
    pub drift: Option<Band>,
}

/// One sample: the numbers that the card needs.
#[derive(Clone)]
struct Draw {
    limit: Result<(f64, String), String>,
    /// Whether the limit is one, and not only the last slope before the search gave up.
    is_limit_known: bool,
    /// On each slope.
    held: Vec<Holding>,
    levels: Vec<Option<Level>>,
    refusals: Vec<Option<String>>,
    drifts: Vec<DrawnDrift>,
}

/// The drift of a sample on a slope.
#[derive(Clone, Copy)]
enum DrawnDrift {
    Holds(f64),
    Slides,
    /// The search gave up.
    NotFound,
}

impl DrawnDrift {
    fn at(curve: &HeadingCurve, slope: f64) -> Self {
        match curve.at(slope) {
            Ok(heading) => Self::Holds(heading.drift()),
            Err(none) if none.is_not_found() => Self::NotFound,
            Err(_) => Self::Slides,
        }
    }

    /// Per metre travelled, where the rover does not slide [m/m].
    fn held(self) -> Option<f64> {
        if let Self::Holds(drift) = self { Some(drift) } else { None }
    }

    fn is_known(self) -> bool {
        !matches!(self, Self::NotFound)
    }
}

impl SlopeStudy {
    /// Computes the card; `None` if `go_on` was false before the end. Samples are shared among
    /// threads and keep their order: the result is the same for any number of threads.
    ///
    /// Go or no-go on 5°, 10° and 20°, if the soil is just as written?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::verdict::{SlopeStudy, Verdict};
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?;
    /// let study = SlopeStudy { is_uncertainty_stated: true, ..SlopeStudy::of(&scenario) };
    /// let card = study.card(&[], &[5.0, 10.0, 20.0].map(deg), &|| true)?.expect("not stopped");
    /// let verdicts = card.rows.iter().map(|row| row.advice.judgement.verdict);
    /// let verdicts: Vec<Verdict> = verdicts.collect();
    /// assert_eq!(verdicts, [Verdict::Go, Verdict::Go, Verdict::Caution]);
    /// let level = card.rows[1].level.expect("10° can be crossed");
    /// assert_eq!(format!("{:.2} W", level.power), "0.40 W");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `samples`: of soil and model; with none there are no bands
    /// * `slopes`: [rad], rising
    /// * `go_on`: asked before each sample, from any thread, and before each slope that is driven;
    ///   samples that are alike are one
    ///
    /// # Errors
    /// [`ParameterError`] for a rule or a rim speed out of range, slopes that do not rise, and the
    /// first invalid soil.
    pub fn card(
        &self,
        samples: &[Sample],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Card>, ParameterError> {
        self.check()?;
        if let Some(pair) = slopes.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(ParameterError::new("slope [rad]", pair[1], "above the one before it"));
        }
        let nominal = self.draw(&self.nominal(), slopes)?;
        let curve = self.heading.curve()?;
        let draws = outputs_of_samples(samples, go_on, |sample| self.draw(sample, slopes));
        let Some(draws) = draws else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let draws: Vec<Draw> = draws.into_iter().collect::<Result<_, ParameterError>>()?;
        let found = Found {
            curve,
            others: self.other_models(slopes.iter().copied().fold(0.0, f64::max))?,
            nominal: &nominal,
            draws: &draws,
        };
        let limit_of = |draw: &Draw| draw.limit.as_ref().map_or(0.0, |(slope, _)| *slope);
        Ok(self.rows(slopes, samples, &found, go_on).map(|rows| Card {
            rows,
            limit_band: Band::of(draws.iter().filter(|draw| draw.is_limit_known).map(limit_of)),
            draws: (!draws.is_empty()).then_some(draws.len()),
            limit: nominal.limit.clone(),
            has_motors: self.heading.rover.has_motors(),
        }))
    }

    /// * `go_on`: asked before each slope that is driven
    fn rows(
        &self,
        slopes: &[f64],
        samples: &[Sample],
        found: &Found<'_>,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<CardRow>> {
        let mut gentler: Option<DrivenMotion> = None;
        let row = |(place, slope): (usize, &f64)| {
            if !go_on() {
                return None;
            }
            let held: Vec<Holding> = found.judged().iter().map(|draw| draw.held[place]).collect();
            let mut advice = self.judged((*slope, 0.0), &held, samples);
            if let Some(driven) = &mut advice.driven {
                driven.motion = driven.motion.map(|it| it.no_laxer_than(gentler.as_ref()));
                gentler = driven.motion.or(gentler);
            }
            Some(found.row(place, advice))
        };
        slopes.iter().enumerate().map(row).collect()
    }

    fn draw(&self, sample: &Sample, slopes: &[f64]) -> Result<Draw, ParameterError> {
        let study = self.heading.of_sample(sample);
        let (level, drift) = (study.curve()?, study.drift_curve()?);
        let keep = |heading: &HeadingOffset| Level {
            yaw: heading.yaw,
            slip_ratio: heading.slip_ratio,
            power: heading.power(&study.rover, self.rim_speed),
        };
        let found: Vec<_> = slopes.iter().map(|slope| level.at(*slope)).collect();
        Ok(Draw {
            is_limit_known: match level.limit() {
                Ok(_) => level.limited_by() != Some(LimitedBy::NotFound),
                Err(none) => !none.is_not_found(),
            },
            held: found.iter().map(|it| Holding::of(&level, it)).collect(),
            limit: level
                .limit()
                .map(|(slope, reason)| (slope, reason.to_owned()))
                .map_err(|error| error.to_string()),
            refusals: found.iter().map(|it| Some(it.as_ref().err()?.to_string())).collect(),
            levels: found.iter().map(|it| it.as_ref().ok().map(keep)).collect(),
            drifts: slopes.iter().map(|slope| DrawnDrift::at(&drift, *slope)).collect(),
        })
    }
}

/// What rows are made of.
struct Found<'a> {
    /// On the soil as written, and those of the other models.
    curve: HeadingCurve,
    others: Vec<(Model, HeadingCurve)>,
    nominal: &'a Draw,
    draws: &'a [Draw],
}

impl Found<'_> {
    /// By what slopes are judged: the samples, or the soil as written where there are none.
    fn judged(&self) -> &[Draw] {
        if self.draws.is_empty() { std::slice::from_ref(self.nominal) } else { self.draws }
    }

    fn row(&self, place: usize, advice: Advice) -> CardRow {
        let (nominal, draws, slope) = (self.nominal, self.draws, advice.slope);
        let yaw = |(model, curve): &(Model, HeadingCurve)| (model.clone(), yaw_on(curve, slope));
        CardRow {
            advice,
            level: nominal.levels[place],
            other_models: self.others.iter().map(yaw).collect(),
            refusal: nominal.refusals[place].clone(),
            drift: nominal.drifts[place].held(),
            bands: (!draws.is_empty()).then(|| CardBands::over(draws, place)),
            findings: self.curve.findings(slope, &self.curve.at(slope)),
        }
    }
}

/// The heading on a slope, if one holds the course.
fn yaw_on(curve: &HeadingCurve, slope: f64) -> Option<f64> {
    curve.at(slope).ok().map(|heading| heading.yaw)
}

impl CardBands {
    fn over(draws: &[Draw], place: usize) -> Self {
        let drifts = || draws.iter().map(|draw| draw.drifts[place]).filter(|it| it.is_known());
        let levels = draws.iter().filter_map(|draw| draw.levels[place]);
        Self {
            slip_ratio: Band::of(draws.iter().filter_map(|draw| draw.held[place].slip_ratio())),
            power: Band::of(levels.map(|level| level.power)),
            held: Probability {
                successes: drifts().filter_map(DrawnDrift::held).count(),
                trials: drifts().count(),
            },
            drift: Band::of(drifts().map(|drift| drift.held().unwrap_or(STRAIGHT_DOWN))),
        }
    }
}
