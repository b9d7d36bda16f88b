//! What turns the wheels in a manoeuvre.
//!
//! A drive that holds nothing keeps one speed. All else is closed on the yaw: a cascade of two proportional-integral
//! laws, the outer from the distance to a line to the yaw that is wanted, the inner from the yaw to the difference of
//! speeds between the sides.
//!
//! ```text
//! γ_set = γ_0 + K_y e + I_y ∫ e dt        e: how far the line lies to the left of the rover's way
//! w     = w_ff + K_γ (γ_set − γ) + I_γ ∫ (γ_set − γ) dt
//! v_i   = ± v − w y_i
//! ```

use super::plan::{Heading, Leg, Manoeuvre};
use super::turn::Turn;
use crate::elementary::wide;
use crate::elementary::wide::atan2;
use crate::simulation::{CONTROL_PERIOD, Controller, Observation};
use crate::units::Vec2;
use crate::vehicle::{Mount, RoverState};

/// Yaw rate that is asked for, per error of the yaw, *K_γ* [1/s]. Source: ours; a skid-steered rover on sand turns with
/// about half the rate that its sides would give on rigid ground, so an error fades in some 4 s.
pub const YAW_GAIN: f64 = 0.5;
/// The same per error and time, *I_γ* [1/s²]. Source: ours, slow beside [`YAW_GAIN`].
pub const YAW_INTEGRAL: f64 = 0.05;
/// Yaw that is asked for, per distance from the line, *K_y* [rad/m]. Source: ours; at 5 cm/s a distance fades in 10 s, more
/// than twice slower than the yaw follows.
pub const CROSS_TRACK_GAIN: f64 = 2.0;
/// The same per distance and time, *I_y* [rad/(m s)]. Source: ours; with [`CROSS_TRACK_GAIN`] the damping ratio at 5 cm/s,
/// *K_y* √(*v* / *I_y*) / 2, is 1: what a slope asks for is learnt in half a minute, without overshoot.
pub const CROSS_TRACK_INTEGRAL: f64 = 0.05;
/// The most yaw by which a rover is turned towards its line [rad]: 45°. Source: ours.
pub const MOST_CROSS_YAW: f64 = std::f64::consts::FRAC_PI_4;

/// The most that a side is slowed down or sped up on the way, over the speed of the rims [-]. Source: ours; wheels never
/// turn backward in a drive.
const MOST_STEER: f64 = 0.75;

/// Turns the wheels in one manoeuvre.
#[derive(Clone, Debug)]
pub(super) struct Pilot {
    law: Law,
    /// Speed of the rims [m/s], above 0.
    speed: f64,
    /// 1 forward, -1 backward.
    direction: f64,
    /// Pose and velocities, as the rover knows them.
    pub(super) seen: RoverState,
    /// Way over the ground since the manoeuvre began [m], as the rover knows it.
    pub(super) gone: f64,
    /// Integrals of the errors of yaw [rad s] and of the distance to the line [m s].
    yaw_integral: f64,
    cross_integral: f64,
}

#[derive(Clone, Copy, Debug)]
enum Law {
    /// All rims at one speed.
    Steady,
    /// On the spot.
    Turn(Turn),
    /// A yaw is held [rad].
    Hold { yaw: f64 },
    /// The nose, or the tail, is held towards a place.
    Toward { place: Vec2 },
    /// A line is followed.
    Follow(Line),
    /// A circle is followed.
    Circle { yaw: f64, radius: f64, angle: f64 },
}

/// A line on the ground, and the yaw with which a rover sets out along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// A place on it.
    from: Vec2,
    /// Its direction, of length 1.
    along: Vec2,
    /// Yaw [rad].
    yaw: f64,
}

/// What a rover is meant to stay on.
#[derive(Clone, Copy, Debug)]
pub(super) enum Path {
    Line(Line),
    /// Centre and radius [m].
    Circle(Vec2, f64),
}

impl Path {
    /// Of the manoeuvre of a leg that begins here.
    pub(super) fn of_leg(leg: &Leg, state: &RoverState) -> Self {
        let Manoeuvre::Arc { radius, angle, reverse } = leg.manoeuvre else {
            return Self::Line(line_of(leg, state));
        };
        let (sin, cos) = wide::sin_cos(state.yaw);
        // Backward the same turn of the nose lies on the other side.
        let side = if reverse { -angle.signum() } else { angle.signum() };
        Self::Circle(state.position + side * radius * Vec2::new(-sin, cos), radius)
    }

    /// How far a place lies off it [m].
    pub(super) fn off(&self, place: Vec2) -> f64 {
        match self {
            Self::Line(line) => line.left_of(place).abs(),
            Self::Circle(centre, radius) => ((place - centre).norm() - radius).abs(),
        }
    }
}

impl Line {
    /// The yaw with which a rover sets out [rad].
    pub(super) fn yaw(&self) -> f64 {
        self.yaw
    }

    /// How far a place is along the line [m].
    pub(super) fn along(&self, place: Vec2) -> f64 {
        (place - self.from).dot(&self.along)
    }

    /// How far the line lies to the left of a place, for one who looks along it [m].
    pub(super) fn left_of(&self, place: Vec2) -> f64 {
        -self.along.perp(&(place - self.from))
    }
}

impl Pilot {
    fn new(law: Law, speed: f64, direction: f64, seen: &RoverState) -> Self {
        let (gone, yaw_integral, cross_integral) = (0.0, 0.0, 0.0);
        Self { law, speed, direction, seen: *seen, gone, yaw_integral, cross_integral }
    }

    /// For the manoeuvre of a leg that begins here.
    pub(super) fn of_leg(leg: &Leg, state: &RoverState) -> Self {
        let (direction, yaw) = (leg.manoeuvre.direction(), state.yaw);
        let law = match (leg.manoeuvre, leg.heading) {
            (Manoeuvre::Turn { angle }, _) => Law::Turn(Turn::new(yaw + angle, state)),
            (Manoeuvre::Arc { radius, angle, .. }, _) => Law::Circle { yaw, radius, angle },
            (Manoeuvre::Goto { .. }, _) | (_, Heading::Contour) => Law::Follow(line_of(leg, state)),
            (_, Heading::Hold) => Law::Hold { yaw },
            (_, Heading::Toward(place)) => Law::Toward { place },
            (_, Heading::Free) => Law::Steady,
        };
        Self::new(law, leg.speed, direction, state)
    }

    /// For a turn on the spot to a yaw [rad].
    pub(super) fn to_yaw(yaw: f64, state: &RoverState, speed: f64) -> Self {
        Self::new(Law::Turn(Turn::new(yaw, state)), speed, 0.0, state)
    }

    /// For a way straight on, with all rims at one speed.
    pub(super) fn straight(speed: f64, direction: f64, state: &RoverState) -> Self {
        Self::new(Law::Steady, speed, direction, state)
    }

    /// Whether the rims keep their speeds.
    pub(super) fn is_steady(&self) -> bool {
        matches!(self.law, Law::Steady)
    }

    /// Yaw rate that the sides would give on rigid ground [rad/s], and speed along the body's x axis [m/s].
    fn steer(&mut self, state: &RoverState, slope: f64, reach: f64) -> (f64, f64) {
        let forward = self.direction * self.speed;
        let (yaw, ahead) = match &mut self.law {
            Law::Steady => return (0.0, forward),
            Law::Turn(turn) => return turn.steer(state, slope, [self.speed, reach]),
            Law::Hold { yaw } => (*yaw, 0.0),
            Law::Toward { place } => (yaw_towards(*place, state, self.direction), 0.0),
            Law::Follow(line) => {
                let line = *line;
                (self.follow(&line, state), 0.0)
            }
            Law::Circle { yaw, radius, angle } => {
                (*yaw + angle.signum() * self.gone / *radius, angle.signum() * self.speed / *radius)
            }
        };
        let most = MOST_STEER * self.speed / reach;
        let error = yaw - state.yaw;
        self.yaw_integral += CONTROL_PERIOD * error;
        self.yaw_integral = self.yaw_integral.clamp(-most / YAW_INTEGRAL, most / YAW_INTEGRAL);
        let rate = ahead + YAW_GAIN * error + YAW_INTEGRAL * self.yaw_integral;
        (rate.clamp(-most, most), forward)
    }

    /// The yaw that leads back to a line [rad].
    fn follow(&mut self, line: &Line, state: &RoverState) -> f64 {
        let left = line.left_of(state.position);
        let most = MOST_CROSS_YAW / CROSS_TRACK_INTEGRAL;
        self.cross_integral = (self.cross_integral + CONTROL_PERIOD * left).clamp(-most, most);
        let yaw = CROSS_TRACK_GAIN * left + CROSS_TRACK_INTEGRAL * self.cross_integral;
        line.yaw + yaw.clamp(-MOST_CROSS_YAW, MOST_CROSS_YAW)
    }
}

impl Controller for Pilot {
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]) {
        let mounts = seen.scenario().rover.mounts();
        let slope = seen.scenario().site.terrain.slope;
        let rover = self.seen;
        let (rate, forward) = self.steer(&rover, slope, reach(mounts));
        for (rim_speed, mount) in rim_speeds.iter_mut().zip(mounts) {
            *rim_speed = forward - rate * mount.position.y;
        }
    }

    fn period(&self) -> Option<f64> {
        (!self.is_steady()).then_some(CONTROL_PERIOD)
    }
}

/// The line of a leg that begins here.
pub(super) fn line_of(leg: &Leg, state: &RoverState) -> Line {
    let from = state.position;
    let (direction, yaw) = (leg.manoeuvre.direction(), state.yaw);
    if let Manoeuvre::Goto { place, .. } = leg.manoeuvre {
        let along = (place - from).try_normalize(0.0).unwrap_or_else(Vec2::x);
        return Line { from, along, yaw: yaw_towards(place, state, direction) };
    }
    let (sin, cos) = wide::sin_cos(yaw);
    let ahead = if direction < 0.0 { -Vec2::new(cos, sin) } else { Vec2::new(cos, sin) };
    let along = match leg.heading {
        Heading::Contour => Vec2::new(if ahead.x < 0.0 { -1.0 } else { 1.0 }, 0.0),
        _ => ahead,
    };
    Line { from, along, yaw }
}

/// The yaw, less than half a turn away, at which the nose points to a place, or the tail where the direction is -1 [rad].
fn yaw_towards(place: Vec2, state: &RoverState, direction: f64) -> f64 {
    let ahead = direction * (place - state.position);
    state.yaw + turned(atan2(ahead.y, ahead.x) - state.yaw)
}

/// The outermost wheel's distance from the middle [m].
pub(super) fn reach(mounts: &[Mount]) -> f64 {
    mounts.iter().map(|mount| mount.position.y.abs()).fold(f64::MIN_POSITIVE, f64::max)
}

/// An angle less its whole turns, from -π to π [rad].
pub(super) fn turned(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    angle - TAU * ((angle + PI) / TAU).floor()
}
