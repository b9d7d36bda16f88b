//! Drives by the card in time, on soils that it has not seen.
//!
//! The card's numbers are of steady motions at one yaw. Here a driver follows it: the nose is set
//! to the row's heading, off by what a driver misses it by, a [`Run`] with the complete loads takes
//! the rover as far as the card says (or farther, for one who corrects late), the nose is set
//! again, and so on over a way. How many stay within the drift that the card states, and how many
//! get stuck?
//!
//! Runs may be quasi-steady: velocities settle within milliseconds, legs take seconds, and where
//! that does not hold they go on dynamically. [`CardDrives::approach`] makes all of them dynamic,
//! to check that. The nose is set at once: what turning does to the ground is left out, as on the
//! first page of the card.

use rayon::prelude::*;

use super::super::heading::STRAIGHT_DOWN;
use super::super::verdict::{
    DRIFT_WAY, HEADING_ERROR, SlopeStudy, Verdict, heading_error, settings,
};
use super::CardRow;
use crate::error::{ParameterError, positive};
use crate::simulation::{
    Approach, LEAST_STEP, MOST_SLIP, Motion, Numerics, PrescribedYaw, Run, RunError, Scatter,
    Scenario, Start,
};
use crate::studies::ensemble::samples::Sample;
use crate::studies::ensemble::{Band, Probability};
use crate::studies::random;
use crate::units::Vec2;
use crate::vehicle::{ByWheel, DriveLaw, Ruts};

/// Drives by the rows of a card.
#[derive(Clone, Copy, Debug)]
pub struct CardDrives<'a> {
    /// The study that the card is of: its rover, gravity, load transfer and rim speed.
    pub study: &'a SlopeStudy,
    /// The driver corrects after so many times the way that the card says [-]: 1 as it says.
    pub lateness: f64,
    /// How the runs are computed.
    pub approach: Approach,
    /// Seed of the driver's errors.
    pub seed: u64,
}

/// The drives on one slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowDrives {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The card's verdict.
    pub verdict: Verdict,
    /// Way between two corrections, over that of the card [-].
    pub lateness: f64,
    /// The way that is driven [m].
    pub way: f64,
    /// Drift that the card states [-]: in 97.5 % of the samples it is less; 1 where it states none.
    pub stated_drift: f64,
    /// Share that is stuck by the card's samples.
    pub stated_stuck: Probability,
    /// Drift of the drives over the whole way [-]: 1 where the rover gets stuck.
    pub drift: Option<Band>,
    /// Drives that drift by no more than stated and do not get stuck.
    pub within: Probability,
    /// Drives that get stuck.
    pub stuck: Probability,
}

impl CardDrives<'_> {
    /// Drives every sample on a row of the card; `None` if the card says not to drive there.
    ///
    /// * `samples`: others than the card's own, at least one
    /// * `done`: called after each drive, from any thread
    ///
    /// # Errors
    /// [`RunError`] for a driver who never corrects late or otherwise, and of the first sample that
    /// cannot be computed.
    pub fn on(
        &self,
        row: &CardRow,
        samples: &[Sample],
        done: &(dyn Fn() + Sync),
    ) -> Result<Option<RowDrives>, RunError> {
        positive("lateness of the driver [-]", self.lateness)?;
        if samples.is_empty() {
            return Err(ParameterError::new("samples to drive", 0.0, "one at least").into());
        }
        let Some((driven, motion)) = row.advice.driven.and_then(|it| Some((it, it.motion?))) else {
            return Ok(None);
        };
        let course = Course {
            slope: row.advice.slope,
            yaw: driven.yaw,
            leg: motion.correct_every.unwrap_or(DRIFT_WAY) * self.lateness,
            is_held: self.study.holds_heading,
        };
        let drive = |(index, sample): (usize, &Sample)| {
            let drift = self.drive(&course, sample, index as u64);
            done();
            drift
        };
        let drifts: Result<Vec<Option<f64>>, RunError> =
            samples.par_iter().enumerate().map(drive).collect::<Vec<_>>().into_iter().collect();
        let drifts = drifts?;
        let trials = drifts.len();
        let stated = motion.drift.map_or(STRAIGHT_DOWN, |band| band.high);
        let within = drifts.iter().flatten().filter(|drift| **drift <= stated).count();
        let stuck = drifts.iter().filter(|drift| drift.is_none()).count();
        Ok(Some(RowDrives {
            slope: row.advice.slope,
            verdict: row.advice.judgement.verdict,
            lateness: self.lateness,
            way: course.legs() as f64 * course.leg,
            stated_drift: stated,
            stated_stuck: motion.stuck,
            drift: Band::of(drifts.iter().map(|drift| drift.unwrap_or(STRAIGHT_DOWN))),
            within: Probability { successes: within, trials },
            stuck: Probability { successes: stuck, trials },
        }))
    }

    /// Drift over the whole way [-]; nothing if the rover gets stuck on it.
    fn drive(&self, course: &Course, sample: &Sample, index: u64) -> Result<Option<f64>, RunError> {
        let legs = Legs::run(&self.scenario(course, sample), course)?;
        let mut errors = random::generator(self.seed, STREAMS | index);
        let mut gone = Vec2::zeros();
        for _ in 0..course.legs() {
            match legs.from(heading_error(&mut errors)) {
                Some(way) => gone += way,
                None => return Ok(None),
            }
        }
        Ok(Some(-gone.y / gone.norm()))
    }

    fn scenario(&self, course: &Course, sample: &Sample) -> Scenario {
        let study = self.study.heading.of_sample(sample);
        let start = Start { yaw: course.yaw, motion: Motion::Rolling };
        Scenario {
            ground: study.plane(course.slope),
            gravity: study.gravity,
            rover: study.rover,
            model: study.model,
            sharing: study.sharing,
            own_moments: study.own_moments,
            by_wheel: ByWheel::ALIKE,
            scatter: Scatter::NONE,
            ruts: Ruts::Fresh,
            drive: DriveLaw::Constant(self.study.rim_speed),
            yaw: None,
            stability: study.stability,
            start,
            duration: slowest(course.leg, self.study.rim_speed),
            numerics: Numerics { approach: self.approach, ..Numerics::DEFAULT },
        }
    }
}

/// The streams of the drivers' errors begin here: samples of soils have those below.
const STREAMS: u64 = 0xFC << 56;

/// What a driver keeps to.
struct Course {
    slope: f64,
    yaw: f64,
    /// Way between two corrections [m].
    leg: f64,
    /// Whether the rover holds its heading by itself.
    is_held: bool,
}

impl Course {
    /// How often the nose is set over the way that the card's drift is over.
    fn legs(&self) -> usize {
        settings(self.leg)
    }
}

/// Headings from which legs are run, evenly over what a driver misses by.
const HEADINGS: usize = 5;

/// Where legs lead [m] that begin with the headings around the card's.
///
/// On an even slope a leg depends on the heading alone that it begins with: those between are
/// interpolated.
struct Legs([Option<Vec2>; HEADINGS]);

impl Legs {
    fn run(scenario: &Scenario, course: &Course) -> Result<Self, RunError> {
        let mut ways = [None; HEADINGS];
        for (place, way) in ways.iter_mut().enumerate() {
            let share = 2.0 * place as f64 / (HEADINGS - 1) as f64 - 1.0;
            let yaw = course.yaw + share * HEADING_ERROR;
            let start = Start { yaw, motion: Motion::Rolling };
            let held = course.is_held.then(|| PrescribedYaw { points: vec![(0.0, yaw)] });
            *way = leg(&Scenario { start, yaw: held, ..scenario.clone() }, course.leg)?;
        }
        Ok(Self(ways))
    }

    /// The leg that begins with a heading which is off by an error [rad]; nothing if the rover gets
    /// stuck on one of those beside it.
    fn from(&self, error: f64) -> Option<Vec2> {
        let place = 0.5 * (error / HEADING_ERROR + 1.0) * (HEADINGS - 1) as f64;
        let below = random::place_below(place, HEADINGS - 1);
        let share = place - below as f64;
        Some(self.0[below]? * (1.0 - share) + self.0[below + 1]? * share)
    }
}

/// The time after which a rover that has not gone a way is stuck [s].
fn slowest(way: f64, rim_speed: f64) -> f64 {
    way / ((1.0 - MOST_SLIP) * rim_speed)
}

/// Where a run leads over a way [m]; nothing if the rover gets stuck on it.
fn leg(scenario: &Scenario, way: f64) -> Result<Option<Vec2>, RunError> {
    /// A run ends this near to its way [-]. The rest is as the way was on average: the nose falls
    /// by 2° on all of it, so that the end is right to a thousandth.
    const NEAR: f64 = 0.05;
    let rim_speed = scenario.drive.nominal_rim_speed();
    let rim_speeds = vec![rim_speed; scenario.rover.wheel_count()];
    let mut run = Run::new(scenario)?;
    loop {
        let now = run.now();
        let (gone, length) = (now.state.position, now.state.position.norm());
        if length >= (1.0 - NEAR) * way {
            return Ok(Some(gone * (way / length)));
        }
        let time_left = scenario.duration - now.time;
        if run.outcome().is_some() || time_left <= 0.0 {
            return Ok(None);
        }
        let speed = now.state.velocity.norm().max((1.0 - MOST_SLIP) * rim_speed);
        let span = ((way - length) / speed).min(time_left);
        run.step(&rim_speeds, span.max(LEAST_STEP))?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::heading::HeadingStudy;
    use crate::studies::verdict::Rule;
    use crate::units::deg;
    use grouser_io::{Overrides, Source, read_scenario};

    /// A leg that was run is the one between two others, to a thousandth of its way.
    #[test]
    fn legs_between_headings_are_interpolated() {
        let scenario = read_scenario(&Source::default_scenario(), &Overrides::none());
        let heading = HeadingStudy::of(&scenario.expect("a preset").value);
        let sample = Sample { soil: heading.soil, model: heading.model.clone() };
        let (rim_speed, rule) = (0.06, Rule::DEFAULT);
        let study = SlopeStudy {
            heading,
            rim_speed,
            rule,
            is_uncertainty_stated: true,
            holds_heading: false,
        };
        let drives =
            CardDrives { study: &study, lateness: 1.0, approach: Approach::QuasiSteady, seed: 1 };
        for (slope, yaw, way) in [(3.0, 1.3, 2.0), (12.0, 6.3, 0.3), (17.0, 12.0, 0.2)] {
            let course = Course { slope: deg(slope), yaw: deg(yaw), leg: way, is_held: false };
            let scenario = drives.scenario(&course, &sample);
            let legs = Legs::run(&scenario, &course).expect("runs");
            for error in [-1.3, 0.4, 1.7].map(deg) {
                let start = Start { yaw: course.yaw + error, motion: Motion::Rolling };
                let run = leg(&Scenario { start, ..scenario.clone() }, way).expect("a run");
                let (run, between) = (run.expect("it moves"), legs.from(error).expect("as well"));
                assert!((run - between).norm() < 1e-3 * way, "{slope}°: {run} and {between}");
            }
        }
    }
}
