//! The second page of the card: the other courses on each of its slopes, to get there and to get
//! out.
//!
//! Each is the steady motion at one yaw, with all rims at one speed forwards or backwards, or the
//! two sides against each other to turn. Straight up and down have the verdict that every study
//! gives; a turn on the spot has that of how many samples get stuck in it; on the others it is that
//! of the first page's rule for the size of the slip, which is negative where a rover runs ahead of
//! its rims. None is better than on a gentler slope.

use std::f64::consts::{FRAC_PI_2, PI};

use super::super::ensemble::samples::{Sample, outputs_of_places};
use super::super::ensemble::{Band, Probability};
use super::super::heading::{STRAIGHT_DOWN, STRAIGHT_UP, STUCK};
use super::super::verdict::{
    Advice, Driven, DrivenMotion, Holding, Judgement, Reason, STUCK_ON_GO, SlopeStudy, SpotTurn,
    Verdict, largest_current, largest_torque, moving_slip,
};
use super::CardRow;
use crate::elementary::wide::sin;
use crate::error::ParameterError;
use crate::simulation::{Seeking, SteadyMotion};
use crate::vehicle::Rover;

/// A way to drive on a slope, other than along the contour with the nose in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// Straight up, nose in front.
    Up,
    /// Straight down, nose in front.
    Down,
    /// Straight down again, backwards: out of a way up.
    BackDown,
    /// Straight up again, backwards: out of a way down.
    BackUp,
    /// Along the contour, backwards: out of a traverse. The rear is uphill by as much as the card
    /// turns the nose.
    BackAcross,
    /// Turning the nose uphill on the way, from the heading of the card: uphill wheels at half the
    /// speed.
    Turn,
    /// Turning it uphill on the spot: uphill wheels backwards, downhill wheels forwards.
    TurnOnTheSpot,
}

impl Course {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Up,
        Self::BackDown,
        Self::Down,
        Self::BackUp,
        Self::BackAcross,
        Self::Turn,
        Self::TurnOnTheSpot,
    ];

    /// The yaw that it is driven at [rad].
    ///
    /// * `contour`: the card's heading on that slope [rad]
    fn yaw(self, contour: f64) -> f64 {
        match self {
            Self::Up | Self::BackDown => FRAC_PI_2,
            Self::Down | Self::BackUp => -FRAC_PI_2,
            Self::BackAcross => -contour,
            Self::Turn | Self::TurnOnTheSpot => contour,
        }
    }

    /// The course that advice is given on, from the contour [rad].
    fn advised(self) -> Option<f64> {
        match self {
            Self::Up => Some(STRAIGHT_UP),
            Self::Down => Some(-STRAIGHT_UP),
            _ => None,
        }
    }

    /// Whether the rover is to turn.
    fn turns(self) -> bool {
        matches!(self, Self::Turn | Self::TurnOnTheSpot)
    }

    /// The rims' speeds [m/s], for uphill on the left.
    fn rim_speeds(self, rover: &Rover, rim_speed: f64) -> Vec<f64> {
        // Of the wheels uphill, the others, and one on the middle line.
        let [uphill, downhill] = match self {
            Self::Up | Self::Down => [rim_speed; 2],
            Self::BackDown | Self::BackUp | Self::BackAcross => [-rim_speed; 2],
            Self::Turn => [0.5 * rim_speed, rim_speed],
            Self::TurnOnTheSpot => return SpotTurn::rim_speeds(rover, rim_speed),
        };
        let of_mount = |left: f64| match left {
            left if left > 0.0 => uphill,
            left if left < 0.0 => downhill,
            _ => f64::midpoint(uphill, downhill),
        };
        rover.mounts().iter().map(|mount| of_mount(mount.position.y)).collect()
    }
}

/// A course on one slope of the card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseRow {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The course.
    pub course: Course,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// The verdict.
    pub judgement: Judgement,
    /// By how much the slope could be steeper before the rover tips over, at rest [rad].
    pub tipping_margin: f64,
    /// Over the samples; `None` where the first page says no-go, or they were not asked for.
    pub motion: Option<CourseMotion>,
}

/// The motion on a course, over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseMotion {
    /// Mean slip ratio of the wheels, positive where rims outrun the rover, either way [-]: 1 where
    /// it is stuck.
    pub slip_ratio: Option<Band>,
    /// Largest torque of a wheel [N·m], over the samples that move.
    pub torque: Option<Band>,
    /// Largest current of a motor [A], driving or braking, likewise; of a rover whose motors are
    /// known.
    pub current: Option<Band>,
    /// Drift of a way along the contour [-], over all samples: 1 where the rover is stuck.
    pub drift: Option<Band>,
    /// Way in which the nose turns uphill by [`TURN`] [m], over the samples that turn.
    pub turn_way: Option<Band>,
    /// Way downhill meanwhile [m], likewise.
    pub turn_downhill: Option<Band>,
    /// Samples in which the rover is stuck, or its nose does not turn uphill; of a turn on the spot
    /// of those for which that is known.
    pub stuck: Probability,
    /// Share of ways of 10 m on which it gets stuck between two looks at the slip [-]; straight up
    /// and down.
    pub stuck_with_checks: Option<f64>,
}

/// The turn that ways are given for [rad]: 10°.
pub const TURN: f64 = PI / 18.0;

impl SlopeStudy {
    /// The other courses on each slope that the card does not call a no-go, course by course;
    /// `None` if `go_on` was false before the end.
    ///
    /// * `samples`: those of the card; with none there is the soil as written alone
    /// * `go_on`: asked after each slope, and with samples, from any thread
    ///
    /// # Errors
    /// The same as [`card`](Self::card).
    pub fn courses(
        &self,
        rows: &[CardRow],
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<CourseRow>>, ParameterError> {
        let driven = rows.iter().filter(|row| row.advice.judgement.verdict != Verdict::NoGo);
        let driven = driven.filter_map(|row| Some((row.advice.slope, row.advice.heading()?)));
        let driven: Vec<(f64, f64)> = driven.collect();
        let slopes: Vec<f64> = driven.iter().map(|(slope, _)| *slope).collect();
        let mut all = Vec::new();
        for course in Course::ALL {
            let rows = match course.advised() {
                Some(advised) => {
                    let advice = self.advice(advised, &slopes, samples, go_on)?;
                    advice.map(|it| it.iter().map(|it| CourseRow::of(course, it)).collect())
                }
                None => self.on_course(course, &driven, samples, go_on),
            };
            let Some(rows) = rows else { return Ok(None) };
            all.extend::<Vec<CourseRow>>(rows);
        }
        Ok(Some(all))
    }

    /// One course: never better on a steeper slope.
    ///
    /// * `driven`: slopes, and the heading that holds the contour on each [rad]
    fn on_course(
        &self,
        course: Course,
        driven: &[(f64, f64)],
        samples: &[Sample],
        go_on: &dyn Fn() -> bool,
    ) -> Option<Vec<CourseRow>> {
        let as_written = [self.nominal()];
        let samples = if samples.is_empty() { &as_written } else { samples };
        let mut worst = Judgement::GO;
        let mut before: Vec<Option<SteadyMotion>> = vec![None; samples.len()];
        let rim_speeds = course.rim_speeds(&self.heading.rover, self.rim_speed);
        let on_slope = |(slope, contour): &(f64, f64)| {
            let (slope, yaw) = (*slope, course.yaw(*contour));
            let at_rest = Driven::at_rest(&self.heading, slope, yaw);
            worst = worst.or(self.at_rest(slope, Some(&at_rest)));
            let mut motion = None;
            if worst.verdict != Verdict::NoGo {
                let steady = self.motions(course, (slope, yaw, &rim_speeds), samples, &before);
                let rover = &self.heading.rover;
                let on_course = |it: &SteadyMotion| OnCourse::of(course, rover, it, &rim_speeds);
                // A rover that accelerates straight ahead digs in or slides; nothing says so of a
                // turn whose steady motion was not found.
                let is_known =
                    |it: &&Option<SteadyMotion>| it.is_some() || course != Course::TurnOnTheSpot;
                let known = steady.iter().filter(is_known);
                let all: Vec<Option<OnCourse>> = known.map(|it| on_course(it.as_ref()?)).collect();
                let held =
                    |it: &Option<OnCourse>| Holding::of_motion(yaw, it.map(|it| it.slip_ratio));
                let unknown = std::iter::repeat_n(Holding::Unknown, steady.len() - all.len());
                let held: Vec<Holding> = all.iter().map(held).chain(unknown).collect();
                worst = worst.or(self.judgement_of_course(course, &held));
                motion = Some(CourseMotion::over(course, &all));
                before = steady;
            }
            let tipping_margin = at_rest.tipping_margin;
            let row = CourseRow { slope, course, yaw, judgement: worst, tipping_margin, motion };
            go_on().then_some(row)
        };
        driven.iter().map(on_slope).collect()
    }

    fn judgement_of_course(&self, course: Course, held: &[Holding]) -> Judgement {
        if course == Course::TurnOnTheSpot {
            return self.of_turns(held);
        }
        let stuck = held.iter().filter(|it| **it == Holding::Not).count();
        let share = stuck as f64 / held.len() as f64;
        let mut found = self.rule.on_slips(held);
        found.add(share > STUCK_ON_GO, Verdict::Caution, Reason::Stuck);
        found
    }

    /// The motion in each sample, if there is a steady one.
    ///
    /// * `before`: those on the slope before, from which they are sought
    fn motions(
        &self,
        course: Course,
        (slope, yaw, rim_speeds): (f64, f64, &[f64]),
        samples: &[Sample],
        before: &[Option<SteadyMotion>],
    ) -> Vec<Option<SteadyMotion>> {
        let seeking = Seeking { near: None, is_held: self.holds_heading && !course.turns() };
        let motion = |place: usize| {
            let study = self.heading.of_sample(&samples[place]);
            match &before[place] {
                Some(near) => study.steady_motion_of_near(near, slope, yaw, rim_speeds),
                None => study.motion_sought(slope, yaw, rim_speeds, seeking),
            }
        };
        outputs_of_places(samples, &|| true, |place| motion(place).ok()).unwrap_or_default()
    }
}

impl CourseRow {
    /// A course that every study gives advice on.
    fn of(course: Course, advice: &Advice) -> Self {
        let (yaw, driven) = (advice.course, advice.driven);
        let over = |motion: DrivenMotion| CourseMotion {
            slip_ratio: motion.slip_ratio,
            torque: motion.torque,
            current: motion.current,
            drift: None,
            turn_way: None,
            turn_downhill: None,
            stuck: motion.stuck,
            stuck_with_checks: Some(motion.slip_check.stuck),
        };
        Self {
            slope: advice.slope,
            course,
            yaw: driven.map_or(yaw, |it| it.yaw),
            judgement: advice.judgement,
            tipping_margin: driven.map_or(f64::NAN, |it| it.tipping_margin),
            motion: driven.and_then(|it| it.motion).map(over),
        }
    }
}

/// One sample on a course.
#[derive(Clone, Copy)]
struct OnCourse {
    slip_ratio: f64,
    torque: f64,
    current: Option<f64>,
    drift: f64,
    turn_way: f64,
}

impl OnCourse {
    fn of(
        course: Course,
        rover: &Rover,
        motion: &SteadyMotion,
        rim_speeds: &[f64],
    ) -> Option<Self> {
        let sense = if course.turns() { 1.0 } else { 0.0 };
        let slip_ratio = moving_slip(motion, rim_speeds, sense)?;
        let drift = -sin(motion.course());
        let turn_way = TURN / motion.turning();
        let torque = largest_torque(motion);
        let current = largest_current(rover, motion, rim_speeds);
        Some(Self { slip_ratio, torque, current, drift, turn_way })
    }
}

impl CourseMotion {
    fn over(course: Course, motions: &[Option<OnCourse>]) -> Self {
        let moving = || motions.iter().flatten();
        let all = |of: fn(&OnCourse) -> f64, stuck: f64| {
            Band::of(motions.iter().map(|it| it.as_ref().map_or(stuck, of)))
        };
        let of_turn = |of: fn(&OnCourse) -> f64| {
            if course.turns() { Band::of(moving().map(of)) } else { None }
        };
        let drift = || all(|it| it.drift, STRAIGHT_DOWN);
        let stuck = motions.iter().filter(|it| it.is_none()).count();
        Self {
            slip_ratio: all(|it| it.slip_ratio, STUCK),
            torque: Band::of(moving().map(|it| it.torque)),
            current: Band::of(moving().filter_map(|it| it.current)),
            drift: if course == Course::BackAcross { drift() } else { None },
            turn_way: of_turn(|it| it.turn_way),
            turn_downhill: of_turn(|it| it.turn_way * it.drift),
            stuck: Probability { successes: stuck, trials: motions.len() },
            stuck_with_checks: None,
        }
    }
}
