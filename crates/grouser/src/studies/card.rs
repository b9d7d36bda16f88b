//! The operator's card: for each slope the heading to set, what instruments show at it, how often
//! it is to be set again, the readings at which to stop, and a verdict to go or not.
//!
//! Every number has a band over samples of soil and model, and a slope is judged by the share of
//! them in which a heading holds the contour at an acceptable slip. No slope is a go on a soil
//! whose uncertainty its document does not state, nor near the soil's friction angle, nor beyond
//! what the ground itself stands. The [`Rule`] is the caller's; a verdict never gets better on a
//! steeper slope.

pub mod courses;
mod driven;
pub mod drives;
mod rule;
mod slip_check;

use grouser_io::LoadedScenario;

use super::ensemble::models::{Question, answers};
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability};
use super::heading::{
    HeadingCurve, HeadingOffset, HeadingStudy, LimitedBy, NoHeading, STRAIGHT_DOWN, STUCK,
};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::error::ParameterError;
pub use driven::{DRIFT_WAY, Driven, DrivenMotion, HEADING_ERROR, SHORTEST_LEG};
pub(super) use rule::best_slopes;
pub use rule::{BELOW_FRICTION_ANGLE, Rule, STUCK_ON_GO, Verdict};
pub use slip_check::{MOST_CHECKED_SLIP, SOIL_LENGTH, STUCK_WITH_CHECKS, SlipCheck};

/// The inputs of a card.
#[derive(Clone, Debug, PartialEq)]
pub struct CardStudy {
    /// Rover, soil as its document has it, gravity, model and load transfer.
    pub heading: HeadingStudy,
    /// Rim speed ω r_s [m/s], for the power.
    pub rim_speed: f64,
    /// The limits of the verdicts.
    pub rule: Rule,
    /// Whether the soil's document states its uncertainty; priors do not count. If not, no slope is
    /// a go.
    pub is_uncertainty_stated: bool,
}

/// A side of the rover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left one, as in the paper.
    Left,
    /// The right one.
    Right,
}

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
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// On the soil as written; `None` where no heading holds the contour.
    pub level: Option<Level>,
    /// Heading of each of the other models on the soil as written, *γ* [rad]; `None` where none
    /// holds the contour.
    pub other_models: Vec<(Model, Option<f64>)>,
    /// Driven by the card's heading, the median over all samples, or on the soil as written where
    /// there are none; `None` where no heading holds the contour in half of them. Its motion is
    /// computed where the slope is no no-go.
    pub driven: Option<Driven>,
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
    /// Samples in which a heading holds the contour, of those for which that is known: power is
    /// over them.
    pub level: Probability,
    /// For how many samples the search for a heading gave up: they are in no band.
    pub not_found: usize,
    /// Yaw, *γ* [rad], over all samples: above every number where no heading holds the contour.
    pub yaw: Option<Band>,
    /// Slip ratio, *s* [-], over all samples: 1 where no heading holds the contour.
    pub slip_ratio: Option<Band>,
    /// Power of the motors [W].
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
    /// On each slope whether the search gave up.
    not_found: Vec<bool>,
    /// On each slope.
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

impl CardStudy {
    /// The study of a scenario, with its rim speed and [`Rule::DEFAULT`].
    ///
    /// * `uphill`: the side of the rover that is uphill
    #[must_use]
    pub fn of(scenario: &LoadedScenario, uphill: Side) -> Self {
        let mut heading = HeadingStudy::of(&scenario.value);
        if uphill == Side::Right {
            heading.rover = heading.rover.mirrored();
        }
        Self {
            heading,
            rim_speed: scenario.value.drive.nominal_rim_speed(),
            rule: Rule::DEFAULT,
            is_uncertainty_stated: scenario.stated_uncertainty().is_some(),
        }
    }

    /// Computes the card; `None` if `go_on` was false before the end. Samples are shared among
    /// threads and keep their order: the result is the same for any number of threads.
    ///
    /// Go or no-go on 5°, 10° and 20°, if the soil is just as written?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::card::{CardStudy, Side, Verdict};
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?;
    /// let study = CardStudy { is_uncertainty_stated: true, ..CardStudy::of(&scenario, Side::Left) };
    /// let card = study.card(&[], &[5.0, 10.0, 20.0].map(deg), &|| true)?.expect("not stopped");
    /// let verdicts: Vec<Verdict> = card.rows.iter().map(|row| row.verdict).collect();
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
        self.rule.check()?;
        crate::error::positive("rim speed [m/s]", self.rim_speed)?;
        if let Some(pair) = slopes.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(ParameterError::new("slope [rad]", pair[1], "above the one before it"));
        }
        let nominal = self.draw(&self.nominal(), slopes)?;
        let curve = self.heading.curve()?;
        let draws = outputs_of_samples(samples, go_on, |sample| self.draw(sample, slopes));
        let Some(draws) = draws else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let draws: Vec<Draw> = draws.into_iter().collect::<Result<_, ParameterError>>()?;
        let found = Found { curve, others: self.other_curves()?, nominal: &nominal, draws: &draws };
        let limit_of = |draw: &Draw| draw.limit.as_ref().map_or(0.0, |(slope, _)| *slope);
        Ok(self.rows(slopes, samples, &found, go_on).map(|rows| Card {
            rows,
            limit_band: Band::of(draws.iter().filter(|draw| draw.is_limit_known).map(limit_of)),
            draws: (!draws.is_empty()).then_some(draws.len()),
            limit: nominal.limit.clone(),
            has_motors: self.heading.rover.has_motors(),
        }))
    }

    /// Soil and model without uncertainty.
    fn nominal(&self) -> Sample {
        Sample { soil: self.heading.soil, model: self.heading.model.clone() }
    }

    /// The contour traverses of the models that the soil as written is not computed with.
    fn other_curves(&self) -> Result<Vec<(Model, HeadingCurve)>, ParameterError> {
        let is_other =
            |model: &Model| answers(model, Question::Across) && *model != self.heading.model;
        let curve = |model: Model| {
            let study = HeadingStudy { model: model.clone(), ..self.heading.clone() };
            Ok((model, study.curve()?))
        };
        Model::ALL.into_iter().filter(is_other).map(curve).collect()
    }

    /// * `go_on`: asked before each slope that is driven
    fn rows(
        &self,
        slopes: &[f64],
        samples: &[Sample],
        found: &Found<'_>,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<CardRow>> {
        let as_written = [self.nominal()];
        let samples = if samples.is_empty() { &as_written } else { samples };
        let mut worst = Verdict::Go;
        let mut gentler: Option<DrivenMotion> = None;
        let row = |(place, slope): (usize, &f64)| {
            let mut driven = self.driven(found.judged(), place, *slope);
            let slips = slips_at(found.judged(), place);
            let by_slips = self.rule.verdict(&slips, found.judged().len() - slips.len());
            worst = worst.max(by_slips).max(self.best_verdict(*slope, driven.as_ref()));
            if let Some(driven) = driven.as_mut().filter(|_| worst != Verdict::NoGo) {
                if !go_on() {
                    return None;
                }
                let course = (*slope, driven.yaw);
                let motion = DrivenMotion::of(&self.heading, samples, self.rim_speed, course);
                driven.motion = motion.map(|motion| motion.no_laxer_than(gentler.as_ref()));
                gentler = driven.motion.or(gentler);
                worst = worst.max(verdict_of(driven.motion.as_ref()));
            }
            Some(found.row(place, *slope, (worst, driven)))
        };
        slopes.iter().enumerate().map(row).collect()
    }

    /// The card's heading on a slope, if there is one, and what the rover does at it without
    /// moving.
    fn driven(&self, draws: &[Draw], place: usize, slope: f64) -> Option<Driven> {
        let yaw = yaws_at(draws, place)?.median;
        yaw.is_finite().then(|| Driven::at_rest(&self.heading, slope, yaw))
    }

    /// The best verdict that a slope can have, whatever the samples say: that of [`best_slopes`],
    /// and no rover that tips over is to be driven.
    fn best_verdict(&self, slope: f64, driven: Option<&Driven>) -> Verdict {
        let (go, caution) = best_slopes(&self.heading, self.is_uncertainty_stated);
        if slope > caution || driven.is_some_and(|it| it.tipping_margin <= 0.0) {
            Verdict::NoGo
        } else if go.is_none_or(|go| slope > go) {
            Verdict::Caution
        } else {
            Verdict::Go
        }
    }

    fn draw(&self, sample: &Sample, slopes: &[f64]) -> Result<Draw, ParameterError> {
        let study = self.heading.of_sample(sample);
        let (level, drift) = (study.curve()?, study.drift_curve()?);
        let keep = |heading: &HeadingOffset| Level {
            yaw: heading.yaw,
            slip_ratio: heading.slip_ratio,
            power: heading.power(&study.rover, self.rim_speed),
        };
        let held: Vec<_> = slopes.iter().map(|slope| level.at(*slope)).collect();
        Ok(Draw {
            is_limit_known: match level.limit() {
                Ok(_) => level.limited_by() != Some(LimitedBy::NotFound),
                Err(none) => !none.is_not_found(),
            },
            not_found: held
                .iter()
                .map(|it| it.as_ref().is_err_and(NoHeading::is_not_found))
                .collect(),
            limit: level
                .limit()
                .map(|(slope, reason)| (slope, reason.to_owned()))
                .map_err(|error| error.to_string()),
            refusals: held.iter().map(|it| Some(it.as_ref().err()?.to_string())).collect(),
            levels: held.iter().map(|it| it.as_ref().ok().map(keep)).collect(),
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

    fn row(
        &self,
        place: usize,
        slope: f64,
        (verdict, driven): (Verdict, Option<Driven>),
    ) -> CardRow {
        let (nominal, draws) = (self.nominal, self.draws);
        CardRow {
            slope,
            verdict,
            level: nominal.levels[place],
            other_models: self
                .others
                .iter()
                .map(|(it, curve)| (it.clone(), yaw_on(curve, slope)))
                .collect(),
            driven,
            refusal: nominal.refusals[place].clone(),
            drift: nominal.drifts[place].held(),
            bands: (!draws.is_empty()).then(|| CardBands::over(draws, place)),
            findings: self.curve.findings(slope, &self.curve.at(slope)),
        }
    }
}

/// The best verdict that the motion by the card's heading allows.
fn verdict_of(motion: Option<&DrivenMotion>) -> Verdict {
    match motion {
        Some(motion) if motion.stuck.estimate() <= STUCK_ON_GO => Verdict::Go,
        Some(_) => Verdict::Caution,
        None => Verdict::NoGo,
    }
}

/// Yaws of all samples on one of the slopes: above every number where no heading holds the contour.
fn yaws_at(draws: &[Draw], place: usize) -> Option<Band> {
    let yaw = |level: Option<Level>| level.map_or(f64::INFINITY, |level| level.yaw);
    Band::of(known_at(draws, place).map(yaw))
}

/// The contour traverses on one of the slopes, of the samples for which it is known whether there
/// is one.
fn known_at(draws: &[Draw], place: usize) -> impl Iterator<Item = Option<Level>> {
    draws.iter().filter(move |draw| !draw.not_found[place]).map(move |draw| draw.levels[place])
}

/// The heading on a slope, if one holds the course.
fn yaw_on(curve: &HeadingCurve, slope: f64) -> Option<f64> {
    curve.at(slope).ok().map(|heading| heading.yaw)
}

/// Slip ratios of the contour traverses on one of the slopes.
fn slips_at(draws: &[Draw], place: usize) -> Vec<Option<f64>> {
    known_at(draws, place).map(|level| level.map(|level| level.slip_ratio)).collect()
}

impl CardBands {
    fn over(draws: &[Draw], place: usize) -> Self {
        let levels: Vec<Level> = draws.iter().filter_map(|draw| draw.levels[place]).collect();
        let drifts = || draws.iter().map(|draw| draw.drifts[place]).filter(|it| it.is_known());
        let slips = slips_at(draws, place);
        let (known, trials) = (slips.len(), draws.len());
        let slips = slips.into_iter().map(|slip| slip.unwrap_or(STUCK));
        Self {
            level: Probability { successes: levels.len(), trials: known },
            not_found: trials - known,
            yaw: yaws_at(draws, place),
            slip_ratio: Band::of(slips),
            power: Band::of(levels.iter().map(|level| level.power)),
            held: Probability {
                successes: drifts().filter_map(DrawnDrift::held).count(),
                trials: drifts().count(),
            },
            drift: Band::of(drifts().map(|drift| drift.held().unwrap_or(STRAIGHT_DOWN))),
        }
    }
}
