//! What a rover knows of where it is: the truth, or what its sensors make of it.
//!
//! With [`Sensors`] a rover knows three things. Its heading, measured once in a while, late and
//! with noise. The turns of its rims. And how far it came since the last fix of visual odometry,
//! one of which it takes whenever the rims have gone so far. Between two fixes it reckons on: that
//! a metre of its rims brings it as far along and across its nose as before.
//!
//! A fix over a way *d* errs by *q d* along it and as much across it, and is turned by the error of
//! the heading, *σ_γ*. Errors of fixes add up and nothing takes them back, so that after a way *L*
//! the place is uncertain across it by
//!
//! ```text
//! σ(L) = √(L d (q² + σ_γ²))
//! ```

use std::collections::VecDeque;

use super::odometer::mean_speed;
use crate::elementary::wide;
use crate::error::{ParameterError, not_negative, positive};
use crate::random::{LARGEST_SEED, Random};
use crate::simulation::{SAME_TIME, Scenario};
use crate::units::Vec2;
use crate::vehicle::RoverState;
use crate::vehicle::kinematics::rolling_velocity;
use crate::vehicle::state::rotation;

/// Sensors of a rover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensors {
    /// Standard deviation of a measured heading, *σ_γ* [rad].
    pub heading_deviation: f64,
    /// Time between two headings [s].
    pub heading_interval: f64,
    /// How old a heading is when it is known [s].
    pub heading_delay: f64,
    /// Standard deviation of a fix along the way since the last one, and across it, over that way,
    /// *q* [-].
    pub odometry_deviation: f64,
    /// Way of the rims between two fixes [m].
    pub odometry_interval: f64,
    /// Which realisation of the errors.
    pub seed: u64,
}

/// A fix of visual odometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fix {
    /// Time since the start [s].
    pub time: f64,
    /// Where the rover takes itself to be [m].
    pub estimate: Vec2,
    /// Where it is [m].
    pub truth: Vec2,
}

/// What a rover knows of its motion.
#[derive(Clone, Debug)]
pub(super) struct Navigator {
    /// Pose and velocities, as it knows them.
    seen: RoverState,
    /// Way over the ground since the start, as it knows it [m].
    ground: f64,
    /// Where it really was at the last look, and when [m], [s].
    last: (Vec2, f64),
    sensed: Option<Sensed>,
}

/// What sensors have said so far.
#[derive(Clone, Debug)]
struct Sensed {
    sensors: Sensors,
    random: Random,
    /// Real yaws that are not yet known, with their times [s], [rad].
    coming: VecDeque<(f64, f64)>,
    /// When the next heading is measured [s], and the error of the last one [rad].
    next_heading: f64,
    heading_error: f64,
    /// The last fix, and the way over the ground as it was known then [m].
    fix: Fix,
    ground: f64,
    /// Since the last fix: way of the rims, whichever way they turn, and forward [m]; and the place
    /// by reckoning.
    rims: f64,
    forward: f64,
    reckoned: Vec2,
    /// How far a metre of the rims brings the rover along and across its nose [-].
    per_rim: Vec2,
    fixes: Vec<Fix>,
}

/// A shorter way of the rims since a fix says nothing of what they bring [m]. Source: ours; a turn
/// on the spot.
const SAYS_NOTHING: f64 = 0.05;

impl Sensors {
    /// Standard deviation across a way of what the rover knows of its place after it [m]: the
    /// closed form.
    ///
    /// * `way`: *L* [m]
    #[must_use]
    pub fn deviation_after(&self, way: f64) -> f64 {
        let each = wide::hypot(self.odometry_deviation, self.heading_deviation);
        (way * self.odometry_interval).sqrt() * each
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        not_negative("standard deviation of the heading [rad]", self.heading_deviation)?;
        not_negative("delay of the heading [s]", self.heading_delay)?;
        positive("time between two headings [s]", self.heading_interval)?;
        not_negative("standard deviation of odometry [-]", self.odometry_deviation)?;
        positive("way between two fixes [m]", self.odometry_interval)?;
        if self.seed > LARGEST_SEED {
            let expected = "at most 2^53 - 1";
            return Err(ParameterError::new("seed of the sensors", self.seed as f64, expected));
        }
        Ok(())
    }
}

impl Navigator {
    /// At the start of a mission, where a rover knows its place.
    pub(super) fn new(sensors: Option<Sensors>, state: &RoverState) -> Self {
        let sensed = sensors.map(|sensors| Sensed::new(sensors, state));
        Self { seen: *state, ground: 0.0, last: (state.position, 0.0), sensed }
    }

    /// Pose and velocities, as the rover knows them.
    pub(super) fn seen(&self) -> &RoverState {
        &self.seen
    }

    /// Way over the ground since the start, as the rover knows it [m].
    pub(super) fn ground(&self) -> f64 {
        self.ground
    }

    /// Whether the last look gave a fix.
    pub(super) fn is_fixed(&self) -> bool {
        let last = self.sensed.as_ref().and_then(|sensed| sensed.fixes.last());
        last.is_some_and(|fix| fix.time == self.last.1)
    }

    /// The fixes so far; none of a rover that knows where it is.
    pub(super) fn into_fixes(self) -> Vec<Fix> {
        self.sensed.map_or(Vec::new(), |sensed| sensed.fixes)
    }

    /// Looks at a rover whose rims had the same speeds since the last look [m/s]; how far it really
    /// came [m].
    pub(super) fn look(
        &mut self,
        time: f64,
        state: &RoverState,
        scenario: &Scenario,
        rim_speeds: &[f64],
    ) -> f64 {
        let (place, before) = self.last;
        self.last = (state.position, time);
        let gone = scenario.way_from(place, state);
        match &mut self.sensed {
            None => {
                self.seen = *state;
                self.ground += gone;
            }
            Some(sensed) => {
                sensed.turn(time, state.yaw);
                let rolling = rolling_velocity(scenario.rover.mounts(), rim_speeds);
                sensed.reckon(time - before, rolling, rim_speeds, self.seen.yaw);
                let yaw = sensed.yaw(time);
                if sensed.rims >= sensed.sensors.odometry_interval {
                    sensed.take_fix(time, state.position, yaw);
                }
                self.seen = RoverState {
                    position: sensed.reckoned,
                    yaw,
                    velocity: rolling.x * sensed.per_rim,
                    yaw_rate: state.yaw_rate,
                };
                self.ground = sensed.ground + sensed.forward.abs() * sensed.per_rim.norm();
            }
        }
        gone
    }
}

impl Sensed {
    fn new(sensors: Sensors, state: &RoverState) -> Self {
        let start = Fix { time: 0.0, estimate: state.position, truth: state.position };
        Self {
            sensors,
            random: Random::stream(sensors.seed, SENSORS),
            coming: VecDeque::from([(0.0, state.yaw)]),
            next_heading: 0.0,
            heading_error: 0.0,
            fix: start,
            ground: 0.0,
            rims: 0.0,
            forward: 0.0,
            reckoned: state.position,
            per_rim: Vec2::x(),
            fixes: vec![start],
        }
    }

    /// Measures the heading where that is due.
    fn turn(&mut self, time: f64, yaw: f64) {
        self.coming.push_back((time, yaw));
        if time >= self.next_heading {
            self.heading_error = self.sensors.heading_deviation * self.random.normal();
            self.next_heading = time + self.sensors.heading_interval - SAME_TIME;
        }
    }

    /// The heading as it is known [rad]: of a while ago, and with the error of the last
    /// measurement.
    fn yaw(&mut self, time: f64) -> f64 {
        let known = time - self.sensors.heading_delay;
        while self.coming.get(1).is_some_and(|(of, _)| *of <= known) {
            self.coming.pop_front();
        }
        self.coming.front().map_or(0.0, |(_, yaw)| *yaw) + self.heading_error
    }

    /// Reckons on from the last place that was known.
    ///
    /// * `rolling`: velocity of the rover if no wheel slipped, in the body frame [m/s]
    fn reckon(&mut self, span: f64, rolling: Vec2, rim_speeds: &[f64], yaw: f64) {
        let forward = span * rolling.x;
        self.rims += span * mean_speed(rim_speeds);
        self.forward += forward;
        self.reckoned += rotation(yaw) * (forward * self.per_rim);
    }

    /// Measures how far the rover came since the last fix.
    fn take_fix(&mut self, time: f64, truth: Vec2, yaw: f64) {
        let way = truth - self.fix.truth;
        let turned = rotation(self.sensors.heading_deviation * self.random.normal());
        // Along the way and to its left, so that a turned drive has the turned errors.
        let noise = self.random.normal() * way + self.random.normal() * Vec2::new(-way.y, way.x);
        let measured = turned * way + self.sensors.odometry_deviation * noise;
        self.ground += measured.norm();
        if self.forward.abs() > SAYS_NOTHING {
            self.per_rim = rotation(yaw).transpose() * measured / self.forward;
        }
        self.fix = Fix { time, estimate: self.fix.estimate + measured, truth };
        self.fixes.push(self.fix);
        (self.rims, self.forward, self.reckoned) = (0.0, 0.0, self.fix.estimate);
    }
}

/// The stream of random numbers for sensors: those of beds and motors have others.
const SENSORS: u64 = 0x5E_0501;

#[cfg(test)]
mod tests {
    use super::*;

    const SENSORS: Sensors = Sensors {
        heading_deviation: 0.0175,
        heading_interval: 1.0,
        heading_delay: 0.0,
        odometry_deviation: 0.02,
        odometry_interval: 0.5,
        seed: 7,
    };

    /// Closed form, over a thousand realisations of a straight way of 50 m with a tenth of slip.
    #[test]
    fn places_scatter_as_the_closed_form_says() {
        let across = (0..1000).map(|seed| {
            let start = RoverState::default();
            let mut navigator = Navigator::new(Some(Sensors { seed, ..SENSORS }), &start);
            let sensed = navigator.sensed.as_mut().expect("it has sensors");
            for fix in 1..=100_u32 {
                sensed.take_fix(f64::from(fix), Vec2::new(0.5 * f64::from(fix), 0.0), 0.0);
            }
            sensed.fix.estimate.y
        });
        let across: Vec<f64> = across.collect();
        let variance = across.iter().map(|y| y * y).sum::<f64>() / across.len() as f64;
        let expected = SENSORS.deviation_after(50.0);
        let off = variance.sqrt() / expected - 1.0;
        assert!(off.abs() < 0.08, "{off}: {} m for {expected} m", variance.sqrt());
    }
}
