//! What to do on a slope: the heading to set, and whether to drive there. Every study that says so
//! asks here: headings, the card, maps, routes, missions and what was learnt.
//!
//! A [`SlopeStudy`] and samples of soil and model give one [`Advice`] for each slope and course. It
//! depends on that slope and course alone, so that all who ask for them get the same. The heading
//! is the median over all samples, where one that no heading holds counts above every number; what
//! becomes of a rover that is driven by it is computed for each sample ([`DrivenMotion`]). Each
//! condition that is not met has a [`Verdict`], and the worst is that of the slope, with the first
//! [`Reason`] for it.

mod driven;
mod held;
mod reason;
mod rule;
mod slip_check;
mod spot_turn;

pub use self::driven::{DRIFT_WAY, Driven, DrivenMotion, HEADING_ERROR, SHORTEST_LEG};
pub(super) use self::driven::{heading_error, largest_current, largest_torque, settings};
pub(super) use self::held::Holding;
pub use self::reason::{Judgement, Reason, Shortfall, Verdict};
pub use self::rule::{BELOW_FRICTION_ANGLE, Rule, SLIDES_ON_NO_GO, STUCK_ON_GO};
pub use self::slip_check::{MOST_CHECKED_SLIP, SOIL_LENGTH, STUCK_WITH_CHECKS, SlipCheck};
pub(super) use self::spot_turn::{SpotTurn, SpotTurns, moving_slip};
use super::ensemble::models::{Question, answers};
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability, outputs};
use super::heading::{HeadingCurve, HeadingStudy};
use crate::contact::Model;
use crate::error::{ParameterError, positive};
use crate::soil::SlopeStability;
use grouser_io::LoadedScenario;

/// What advice is about: a rover on a soil, and the limits of the verdicts.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeStudy {
    /// Rover, soil as its document has it, gravity, model and load transfer.
    pub heading: HeadingStudy,
    /// Rim speed ω r_s of all wheels [m/s], for power and time.
    pub rim_speed: f64,
    /// The limits of the verdicts.
    pub rule: Rule,
    /// Whether the soil's document states its uncertainty; priors do not count. If not, nobody can
    /// tell whether a slope is a go.
    pub is_uncertainty_stated: bool,
    /// Whether the rover holds its heading by itself. Then nobody sets it again on the way, and its
    /// nose does not fall.
    pub holds_heading: bool,
}

/// A side of the rover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left one, as in the paper.
    Left,
    /// The right one.
    Right,
}

/// What to do on a slope along a course.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Course, *χ* [rad], from the contour, positive uphill; 0 of a turn on the spot.
    pub course: f64,
    /// The verdict, and what decides it.
    pub judgement: Judgement,
    /// Samples in which a heading holds the course, of those for which that is known.
    pub level: Probability,
    /// Samples for which the search for a heading gave up.
    pub not_found: usize,
    /// Headings that hold the course, *γ* [rad], over all samples: above every number where none
    /// does. `None` without samples.
    pub yaw: Option<Band>,
    /// Driven by the median of these; `None` where no heading holds the course in half of the
    /// samples. Its motion is computed where nothing before makes the slope a no-go.
    pub driven: Option<Driven>,
    /// Of a turn on the spot: samples in which the rover gets stuck in it, of those for which that
    /// is known.
    pub stuck_in_turn: Option<Probability>,
}

impl SlopeStudy {
    /// The study of a scenario, with its rim speed and [`Rule::DEFAULT`].
    #[must_use]
    pub fn of(scenario: &LoadedScenario) -> Self {
        Self {
            heading: HeadingStudy::of(&scenario.value),
            rim_speed: scenario.value.drive.nominal_rim_speed(),
            rule: Rule::DEFAULT,
            is_uncertainty_stated: scenario.stated_uncertainty().is_some(),
            holds_heading: false,
        }
    }

    /// The same with uphill on a side of the rover.
    #[must_use]
    pub fn with_uphill(mut self, uphill: Side) -> Self {
        if uphill == Side::Right {
            self.heading.rover = self.heading.rover.mirrored();
        }
        self
    }

    /// # Errors
    /// [`ParameterError`] for a rule or a rim speed out of range.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.rule.check()?;
        positive("rim speed [m/s]", self.rim_speed)
    }

    /// Advice on some slopes along a course; `None` if `go_on` was false before the end. The result
    /// is the same for any number of threads.
    ///
    /// Which heading holds the contour of 10°, if sand and model are uncertain, and may one drive?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::ensemble::samples::BandInputs;
    /// use grouser::studies::verdict::{SlopeStudy, Verdict};
    /// use grouser::units::deg;
    ///
    /// let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let samples = BandInputs::of_scenario(&scenario).samples(1, 40)?;
    /// let study = SlopeStudy::of(&scenario);
    /// let advice = study.advice(0.0, &[deg(5.0), deg(28.0)], &samples, &|| true)?;
    /// let advice = advice.expect("not stopped");
    /// let yaw = advice[0].driven.expect("a heading holds the contour").yaw;
    /// assert!(yaw > deg(1.0) && yaw < deg(3.0));
    /// assert_eq!(advice[0].judgement.verdict, Verdict::Go);
    /// assert_eq!(advice[1].judgement.verdict, Verdict::NoGo);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `course`: *χ* [rad], −π/2 to π/2, positive uphill
    /// * `slopes`: [rad]
    /// * `samples`: of soil and model; with none there is the soil as written alone
    /// * `go_on`: asked before each sample, from any thread
    ///
    /// # Errors
    /// [`ParameterError`] for a rule, a rim speed or a course out of range, and the first invalid
    /// soil.
    pub fn advice(
        &self,
        course: f64,
        slopes: &[f64],
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Advice>>, ParameterError> {
        self.check()?;
        let as_written = [self.nominal()];
        let all = if samples.is_empty() { &as_written } else { samples };
        let steepest = slopes.iter().copied().fold(0.0, f64::max);
        let one = |sample: &Sample| {
            let curve = self.heading.of_sample(sample).curve_to_slope(course, steepest)?;
            Ok(slopes.iter().map(|it| Holding::of(&curve, &curve.at(*it))).collect())
        };
        let Some(found) = outputs_of_samples(all, go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let found = found.into_iter().collect::<Result<Vec<Vec<Holding>>, ParameterError>>()?;
        let on_slope = |(place, slope): (usize, &f64)| {
            if !go_on() {
                return None;
            }
            let held: Vec<Holding> = found.iter().map(|held| held[place]).collect();
            Some(self.judged((*slope, course), &held, samples))
        };
        Ok(slopes.iter().enumerate().map(on_slope).collect())
    }

    /// Advice for some places, each a slope and a course [rad], in their order; `None` if `go_on` was
    /// false before the end. Places that are alike are one.
    ///
    /// # Errors
    /// The same as [`advice`](Self::advice).
    pub fn advice_at(
        &self,
        places: &[(f64, f64)],
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Advice>>, ParameterError> {
        let mut known: Vec<Advice> = Vec::new();
        for (_, course) in places {
            if known.iter().any(|it| it.course == *course) {
                continue;
            }
            let on_course = places.iter().filter(|place| place.1 == *course);
            let mut slopes: Vec<f64> = on_course.map(|place| place.0).collect();
            slopes.sort_by(f64::total_cmp);
            slopes.dedup();
            let Some(found) = self.advice(*course, &slopes, samples, go_on)? else {
                return Ok(None);
            };
            known.extend(found);
        }
        let of =
            |place: &(f64, f64)| known.iter().find(|it| (it.slope, it.course) == *place).cloned();
        Ok(places.iter().map(of).collect())
    }

    /// Contour traverses on the soil as written up to a slope [rad], by the models that it is not
    /// computed with.
    ///
    /// # Errors
    /// The same as [`HeadingStudy::curve`].
    pub fn other_models(
        &self,
        steepest: f64,
    ) -> Result<Vec<(Model, HeadingCurve)>, ParameterError> {
        let is_other =
            |model: &Model| answers(model, Question::Across) && *model != self.heading.model;
        let curve = |model: Model| {
            let study = HeadingStudy { model: model.clone(), ..self.heading.clone() };
            Ok((model, study.curve_to_slope(0.0, steepest)?))
        };
        let others: Vec<Model> = Model::ALL.into_iter().filter(is_other).collect();
        outputs(others, curve).into_iter().collect()
    }

    /// Soil and model without uncertainty.
    pub(super) fn nominal(&self) -> Sample {
        Sample { soil: self.heading.soil, model: self.heading.model.clone() }
    }

    /// Advice on a slope and course [rad] where it is known which samples hold it.
    ///
    /// * `held`: of each sample; without samples of the soil as written
    pub(super) fn judged(
        &self,
        (slope, course): (f64, f64),
        held: &[Holding],
        samples: &[Sample],
    ) -> Advice {
        let as_written = [self.nominal()];
        let all = if samples.is_empty() { &as_written } else { samples };
        let yaw = Band::of(held.iter().filter_map(|it| it.yaw()));
        let heading = yaw.map(|it| it.median).filter(|yaw| yaw.is_finite());
        let mut driven = heading.map(|yaw| Driven::at_rest(&self.heading, slope, yaw));
        let mut judgement = self.before_driving(slope, held, driven.as_ref());
        if let Some(driven) = driven.as_mut().filter(|_| judgement.verdict != Verdict::NoGo) {
            let limit = SlipCheck::limit(held.iter().filter_map(|it| it.slip_ratio()));
            let place = (slope, course, driven.yaw);
            let own = (self.rim_speed, self.holds_heading);
            driven.motion = DrivenMotion::of(&self.heading, own, (all, held), place, limit);
            judgement = judgement.or(self.when_driven(driven.motion.as_ref()));
        }
        let known = held.iter().filter(|it| **it != Holding::Unknown).count();
        let successes = held.iter().filter(|it| it.is_held()).count();
        Advice {
            slope,
            course,
            judgement,
            level: Probability { successes, trials: known },
            not_found: held.len() - known,
            yaw: yaw.filter(|_| !samples.is_empty()),
            driven,
            stuck_in_turn: None,
        }
    }

    /// What can be said of a slope before the rover is driven on it.
    fn before_driving(&self, slope: f64, held: &[Holding], driven: Option<&Driven>) -> Judgement {
        let mut found = Judgement::GO;
        let without = held.iter().filter(|it| **it == Holding::Not).count();
        let is_without = driven.is_none() && 2 * without >= held.len();
        found.add(is_without, Verdict::NoGo, Reason::NoHeading);
        found = found.or(self.rule.on_slips(held)).or(self.at_rest(slope, driven));
        let holding = || held.iter().filter(|it| it.is_held());
        let outside = holding().filter(|it| matches!(it, Holding::At { is_outside: true, .. }));
        let is_outside = driven.is_some() && 2 * outside.count() >= holding().count();
        found.add(is_outside, Verdict::CannotTell, Reason::OutsideDomain);
        found
    }

    /// What can be said of a slope [rad] where wheels do not count: of the ground, of the rover at
    /// rest, and of how well the soil is known.
    pub(super) fn at_rest(&self, slope: f64, driven: Option<&Driven>) -> Judgement {
        let HeadingStudy { soil, gravity, .. } = &self.heading;
        let mut found = Judgement::GO;
        let is_near_friction = slope >= soil.friction_angle - BELOW_FRICTION_ANGLE;
        found.add(is_near_friction, Verdict::NoGo, Reason::FrictionMargin);
        let is_too_steep = slope > self.heading.ground_limit();
        found.add(is_too_steep, Verdict::NoGo, Reason::FactorOfSafety);
        let tips = driven.is_some_and(|it| it.tipping_margin <= 0.0);
        found.add(tips, Verdict::NoGo, Reason::TipsOver);
        found.add(!self.is_uncertainty_stated, Verdict::CannotTell, Reason::NoStatedUncertainty);
        let usual = soil.stable_slope(*gravity, SlopeStability::USUAL);
        found.add(slope > usual, Verdict::Caution, Reason::FactorOfSafety);
        found
    }

    /// What can be said of a rover that is driven by the heading.
    fn when_driven(&self, motion: Option<&DrivenMotion>) -> Judgement {
        let mut found = Judgement::GO;
        let Some(motion) = motion else {
            found.add(true, Verdict::NoGo, Reason::HeadingFalls);
            return found;
        };
        // Who turns back at every look does not get stuck, and does not get anywhere.
        let stuck = motion.stuck.estimate().max(motion.slip_check.stuck);
        found.add(stuck >= self.rule.no_go_probability, Verdict::NoGo, Reason::Stuck);
        let slides = motion.slides.estimate() >= SLIDES_ON_NO_GO;
        found.add(slides, Verdict::NoGo, Reason::Slides);
        found.add(stuck > STUCK_ON_GO, Verdict::Caution, Reason::Stuck);
        let drift = motion.drift.is_none_or(|drift| drift.high > self.rule.go_drift_m_per_m);
        found.add(drift, Verdict::Caution, Reason::Drift);
        found
    }
}

impl Advice {
    /// Heading to set, *γ* [rad], positive uphill; `None` where no heading holds the course in half
    /// of the samples.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        self.driven.map(|driven| driven.yaw)
    }

    /// Share of ways of [`DRIFT_WAY`] on which a rover that is driven and looked after as the card
    /// says gets stuck all the same [-], or share of the samples that get stuck in a turn on the
    /// spot; `None` where it is not driven.
    #[must_use]
    pub fn probability_stuck(&self) -> Option<f64> {
        let on_way = || Some(self.driven?.motion?.slip_check.stuck);
        self.stuck_in_turn.map_or_else(on_way, |it| (it.trials > 0).then(|| it.estimate()))
    }

    /// Whether it is about a turn on the spot, and not about a course.
    #[must_use]
    pub fn is_of_turn(&self) -> bool {
        self.stuck_in_turn.is_some()
    }
}
