//! What turns the wheels in a manoeuvre.
//!
//! A drive that holds nothing leaves the wheels to the leg's law of drive. All else is closed on
//! the yaw: a cascade of two proportional-integral laws, the outer from the distance to a line to
//! the yaw that is wanted, the inner from the yaw to the difference of speeds between the sides.
//!
//! ```text
//! γ_set = γ_0 + K_y e + I_y ∫ e dt        e: how far the line lies to the left of the rover's way
//! w     = w_ff + K_γ (γ_set − γ) + I_γ ∫ (γ_set − γ) dt
//! v_i   = ± v_drive,i − w y_i
//! ```
//!
//! Where the ground bends a contour leg follows the line of the height at which it began
//! ([`Contour`]), and γ_0 turns with it. Where wheels crab, the outer law sets their steering angle
//! δ in place of γ_set, and the inner one holds the yaw. On an arc with steered wheels *w* sets the
//! circle that their axles point to the centre of, and rims are as fast as the hubs on it.

use super::angles::{MOST_CROSS_YAW, near_enough, turned};
use super::contour::Contour;
use super::plan::{Heading, Leg, Manoeuvre, Steering};
use super::steering::{ackermann_angles, ackermann_motion, crab_angles, within_limits};
use super::turn::Turn;
use crate::elementary::wide;
use crate::elementary::wide::atan2;
use crate::simulation::{CONTROL_PERIOD, Controller, Observation, Scenario};
use crate::units::Vec2;
use crate::vehicle::drive::slip_limited;
use crate::vehicle::kinematics::{wheel_slips, wheel_velocity};
use crate::vehicle::{DriveLaw, Mount, RoverState};

/// Yaw rate that is asked for, per error of the yaw, *K_γ* [1/s]. Source: ours; a skid-steered
/// rover on sand turns with about half the rate that its sides would give on rigid ground, so an
/// error fades in some 4 s.
pub const YAW_GAIN: f64 = 0.5;
/// The same per error and time, *I_γ* [1/s²]. Source: ours, slow beside [`YAW_GAIN`].
pub const YAW_INTEGRAL: f64 = 0.05;
/// Yaw that is asked for, per distance from the line, *K_y* [rad/m]. Source: ours; at 5 cm/s a
/// distance fades in 10 s, more than twice slower than the yaw follows.
pub const CROSS_TRACK_GAIN: f64 = 2.0;
/// The same per distance and time, *I_y* [rad/(m s)]. Source: ours; with [`CROSS_TRACK_GAIN`] the
/// damping ratio at 5 cm/s, *K_y* √(*v* / *I_y*) / 2, is 1: what a slope asks for is learnt in half
/// a minute, without overshoot.
pub const CROSS_TRACK_INTEGRAL: f64 = 0.05;

/// The most that a side is slowed down or sped up on the way, over the speed of the rims [-].
/// Source: ours; wheels never turn backward in a drive.
const MOST_STEER: f64 = 0.75;

/// Turns the wheels in one manoeuvre.
#[derive(Clone, Debug)]
pub(super) struct Pilot {
    law: Law,
    drive: DriveLaw,
    /// 1 forward, -1 backward, 0 on the spot.
    direction: f64,
    path: Path,
    /// Steering angle of each wheel while nothing steers it [rad].
    straight: Vec<f64>,
    /// Yaw rate that was asked for at the last look [rad/s], and speed along the body [m/s].
    asked: (f64, f64),
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
    /// Nothing is held.
    Free,
    /// On the spot.
    Turn(Turn),
    /// A yaw is held [rad].
    Hold { yaw: f64 },
    /// The nose, or the tail, is held towards a place.
    Toward { place: Vec2 },
    /// A line is followed.
    Follow(Line),
    /// A contour line is followed.
    FollowContour(Contour),
    /// A circle is followed.
    Circle { yaw: f64, radius: f64, angle: f64, steering: Steering },
    /// A line is followed by the wheels' steering angle, from one [rad], and a yaw is held [rad].
    Crab { line: Line, yaw: f64, angle: f64 },
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
    Contour(Contour),
    /// Centre and radius [m], and which way round it is gone: 1 to the left, -1 to the right.
    Circle(Vec2, f64, f64),
}

impl Path {
    /// Returns the path of a leg's manoeuvre that begins here.
    fn of_leg(leg: &Leg, scenario: &Scenario, state: &RoverState) -> Self {
        if leg.heading == Heading::Contour
            && matches!(leg.manoeuvre, Manoeuvre::Drive { .. })
            && let Some(contour) = Contour::of_leg(leg, scenario, state)
        {
            return Self::Contour(contour);
        }
        let Manoeuvre::Arc { radius, angle, reverse } = leg.manoeuvre else {
            return Self::Line(line_of(leg, scenario, state));
        };
        let (sin, cos) = wide::sin_cos(state.yaw);
        // Backward the same turn of the nose lies on the other side.
        let side = if reverse { -angle.signum() } else { angle.signum() };
        let centre = state.position + side * radius * Vec2::new(-sin, cos);
        Self::Circle(centre, radius, angle.signum())
    }

    /// Straight ahead of the nose.
    fn ahead(state: &RoverState) -> Self {
        let (sin, cos) = wide::sin_cos(state.yaw);
        Self::Line(Line { from: state.position, along: Vec2::new(cos, sin), yaw: state.yaw })
    }

    /// Its direction beside a rover, of length 1.
    fn along(&self, scenario: &Scenario, state: &RoverState) -> Vec2 {
        match self {
            Self::Line(line) => line.along,
            Self::Contour(contour) => contour.along(scenario, state),
            Self::Circle(centre, _, side) => {
                let out = (state.position - centre).try_normalize(0.0).unwrap_or_else(Vec2::x);
                *side * Vec2::new(-out.y, out.x)
            }
        }
    }

    /// How far a rover is off it [m].
    pub(super) fn off(&self, scenario: &Scenario, state: &RoverState) -> f64 {
        match self {
            Self::Line(line) => line.left_of(state.position).abs(),
            Self::Contour(contour) => contour.left_of(scenario, state).abs(),
            Self::Circle(centre, radius, _) => ((state.position - centre).norm() - radius).abs(),
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
    /// * `path`: what it is meant to stay on
    /// * `straight`: steering angle of each wheel while nothing steers it [rad]
    fn new(
        law: Law,
        drive: DriveLaw,
        direction: f64,
        path: Path,
        seen: &RoverState,
        straight: &[f64],
    ) -> Self {
        let speed = drive.nominal_rim_speed().abs();
        let rate = match law {
            Law::Circle { radius, angle, .. } => angle.signum() * speed / radius,
            _ => 0.0,
        };
        Self {
            law,
            drive,
            direction,
            path,
            straight: straight.to_vec(),
            asked: (rate, direction * speed),
            seen: *seen,
            gone: 0.0,
            yaw_integral: 0.0,
            cross_integral: 0.0,
        }
    }

    /// For the manoeuvre of a leg that begins here.
    pub(super) fn of_leg(
        leg: &Leg,
        scenario: &Scenario,
        state: &RoverState,
        straight: &[f64],
    ) -> Self {
        let (direction, yaw) = (leg.manoeuvre.direction(), state.yaw);
        let path = Path::of_leg(leg, scenario, state);
        let law = match (leg.manoeuvre, leg.heading) {
            (Manoeuvre::Turn { angle }, _) => Law::Turn(Turn::new(yaw + angle, state)),
            (Manoeuvre::Arc { radius, angle, .. }, _) => {
                Law::Circle { yaw, radius, angle, steering: leg.steering }
            }
            (Manoeuvre::Goto { .. }, Heading::Crab { angle }) => {
                let line = line_of(leg, scenario, state);
                Law::Crab { line, yaw, angle: angle + turned(line.yaw - yaw) }
            }
            (_, Heading::Crab { angle }) => {
                Law::Crab { line: line_of(leg, scenario, state), yaw, angle }
            }
            (Manoeuvre::Goto { .. }, _) => Law::Follow(line_of(leg, scenario, state)),
            (_, Heading::Contour) => match path {
                Path::Contour(contour) => Law::FollowContour(contour),
                _ => Law::Follow(line_of(leg, scenario, state)),
            },
            (_, Heading::Hold) => Law::Hold { yaw },
            (_, Heading::Toward(place)) => Law::Toward { place },
            (_, Heading::Free) => Law::Free,
        };
        Self::new(law, leg.drive.clone(), direction, path, state, straight)
    }

    /// For a turn on the spot to a yaw [rad].
    pub(super) fn to_yaw(yaw: f64, state: &RoverState, speed: f64, straight: &[f64]) -> Self {
        let (law, path) = (Law::Turn(Turn::new(yaw, state)), Path::ahead(state));
        Self::new(law, DriveLaw::Constant(speed), 0.0, path, state, straight)
    }

    /// For a way straight on, with all rims at one speed.
    pub(super) fn ahead(speed: f64, direction: f64, state: &RoverState, straight: &[f64]) -> Self {
        let (drive, path) = (DriveLaw::Constant(speed), Path::ahead(state));
        Self::new(Law::Free, drive, direction, path, state, straight)
    }

    /// What the rover is meant to stay on.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Speed of the fastest rims [m/s], above 0.
    fn speed(&self) -> f64 {
        self.drive.nominal_rim_speed().abs()
    }

    /// Whether the rims keep their speeds.
    pub(super) fn is_steady(&self) -> bool {
        matches!(self.law, Law::Free) && !self.drive.varies()
    }

    /// Yaw rate that the sides would give on rigid ground [rad/s], and speed along the body's x
    /// axis [m/s].
    fn rate_and_speed(
        &mut self,
        scenario: &Scenario,
        state: &RoverState,
        reach: f64,
    ) -> (f64, f64) {
        let speed = self.speed();
        let forward = self.direction * speed;
        let (yaw, ahead) = match &mut self.law {
            Law::Free => return (0.0, forward),
            Law::Turn(turn) => {
                let (lie, _) = scenario.ground_under(state);
                let level = scenario.ground.is_plane().then_some(0.0);
                let contour = lie.contour().or(level);
                return turn.steer(state, lie.steepness(), contour, [speed, reach]);
            }
            Law::Hold { yaw } | Law::Crab { yaw, .. } => (*yaw, 0.0),
            Law::Toward { place } => (yaw_towards(*place, state, self.direction), 0.0),
            Law::Follow(line) => {
                let line = *line;
                (line.yaw + self.towards(line.left_of(state.position)), 0.0)
            }
            Law::FollowContour(contour) => {
                let left = contour.look(scenario, state);
                let yaw = contour.yaw();
                (yaw + self.towards(left), 0.0)
            }
            Law::Circle { yaw, radius, angle, .. } => {
                // Beyond its own way, an arc goes on to its yaw.
                let turn = (self.gone / *radius).min(angle.abs());
                (*yaw + angle.signum() * turn, angle.signum() * speed / *radius)
            }
        };
        let most = MOST_STEER * speed / reach;
        let error = yaw - state.yaw;
        self.yaw_integral += CONTROL_PERIOD * error;
        self.yaw_integral = self.yaw_integral.clamp(-most / YAW_INTEGRAL, most / YAW_INTEGRAL);
        let rate = ahead + YAW_GAIN * error + YAW_INTEGRAL * self.yaw_integral;
        (rate.clamp(-most, most), forward)
    }

    /// Slip ratio of each wheel as the rover knows it [-].
    fn slip_ratios(&self, seen: &Observation<'_>) -> Vec<f64> {
        if self.seen == *seen.rover() {
            return seen.slip_ratios().to_vec();
        }
        let slips = wheel_slips(&seen.scenario().rover, &self.seen, seen.rim_speeds());
        slips.map(|slip| slip.ratio).collect()
    }

    /// How far the nose, backward the tail, is turned off the path [rad].
    fn crab(&self, scenario: &Scenario, state: &RoverState) -> f64 {
        let along = self.direction * self.path.along(scenario, state);
        turned(state.yaw - atan2(along.y, along.x))
    }

    /// How far nose or wheels are to be turned to the left to lead back to a line [rad].
    ///
    /// * `left`: how far it lies to the left [m]
    fn towards(&mut self, left: f64) -> f64 {
        let most = MOST_CROSS_YAW / CROSS_TRACK_INTEGRAL;
        self.cross_integral = (self.cross_integral + CONTROL_PERIOD * left).clamp(-most, most);
        let yaw = CROSS_TRACK_GAIN * left + CROSS_TRACK_INTEGRAL * self.cross_integral;
        yaw.clamp(-MOST_CROSS_YAW, MOST_CROSS_YAW)
    }
}

impl Controller for Pilot {
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]) {
        let rover = &seen.scenario().rover;
        let (mounts, state) = (rover.mounts(), self.seen);
        let (rate, forward) = self.rate_and_speed(seen.scenario(), &state, reach(mounts));
        self.asked = (rate, forward);
        let turned_by = |mount: &Mount| {
            let arm = mount.position.xy();
            -mount.wheel_from_body(rate * Vec2::new(-arm.y, arm.x)).x
        };
        // With axles that point to one centre, a rim is as fast as its hub about it.
        let motion = match self.law {
            Law::Circle { steering: Steering::Ackermann, .. } => {
                Some(ackermann_motion(rover, [forward, rate]))
            }
            _ => None,
        };
        let rolled = |mount: &Mount, commanded: f64| {
            motion.as_ref().map(|motion| commanded * (wheel_velocity(motion, mount).x / forward))
        };
        match &self.drive {
            _ if self.direction == 0.0 => {
                for (rim, mount) in rim_speeds.iter_mut().zip(mounts) {
                    *rim = forward - turned_by(mount);
                }
            }
            DriveLaw::SlipLimiting(limit) => {
                let each = rim_speeds.iter_mut().zip(mounts).zip(self.slip_ratios(seen));
                for (wheel, ((rim, mount), slip_ratio)) in each.enumerate() {
                    let commanded = self.direction * limit.speed.of(wheel);
                    let wanted = rolled(mount, commanded).unwrap_or(commanded - turned_by(mount));
                    *rim = slip_limited(wanted, *rim, slip_ratio, limit.slip_ratio);
                }
            }
            law => {
                // The law speaks of a drive forward.
                let slip_ratios: Vec<f64> =
                    self.slip_ratios(seen).iter().map(|slip| self.direction * slip).collect();
                law.rim_speeds(rover, self.crab(seen.scenario(), &state), &slip_ratios, rim_speeds);
                for (rim, mount) in rim_speeds.iter_mut().zip(mounts) {
                    let commanded = self.direction * *rim;
                    *rim = rolled(mount, commanded).unwrap_or(commanded - turned_by(mount));
                }
            }
        }
    }

    fn steer(&mut self, seen: &Observation<'_>, angles: &mut [f64]) {
        let rover = &seen.scenario().rover;
        let (rate, forward) = self.asked;
        let mut wanted = match self.law {
            Law::Crab { line, angle, .. } => {
                let left = line.left_of(self.seen.position);
                crab_angles(rover, angle + self.towards(left))
            }
            Law::Circle { steering: Steering::Ackermann, .. } => {
                ackermann_angles(rover, [forward, rate])
            }
            _ => self.straight.clone(),
        };
        within_limits(rover, &mut wanted);
        angles.copy_from_slice(&wanted);
    }

    fn period(&self) -> Option<f64> {
        (!self.is_steady()).then_some(CONTROL_PERIOD)
    }
}

/// The line of a leg that begins here.
pub(super) fn line_of(leg: &Leg, scenario: &Scenario, state: &RoverState) -> Line {
    let from = state.position;
    let (direction, yaw) = (leg.manoeuvre.direction(), state.yaw);
    if let Manoeuvre::Goto { place, .. } = leg.manoeuvre {
        let along = (place - from).try_normalize(0.0).unwrap_or_else(Vec2::x);
        return Line { from, along, yaw: yaw_towards(place, state, direction) };
    }
    let (sin, cos) = wide::sin_cos(yaw);
    let ahead = if direction < 0.0 { -Vec2::new(cos, sin) } else { Vec2::new(cos, sin) };
    if leg.heading != Heading::Contour || !scenario.ground.is_plane() {
        return Line { from, along: ahead, yaw };
    }
    let along = Vec2::new(if ahead.x < 0.0 { -1.0 } else { 1.0 }, 0.0);
    let nose = if direction * along.x < 0.0 { std::f64::consts::PI } else { 0.0 };
    Line { from, along, yaw: near_enough(yaw, nose) }
}

/// The yaw, less than half a turn away, at which the nose points to a place, or the tail where the
/// direction is -1 [rad].
fn yaw_towards(place: Vec2, state: &RoverState, direction: f64) -> f64 {
    let ahead = direction * (place - state.position);
    state.yaw + turned(atan2(ahead.y, ahead.x) - state.yaw)
}

/// The outermost wheel's distance from the middle [m].
pub(super) fn reach(mounts: &[Mount]) -> f64 {
    mounts.iter().map(|mount| mount.position.y.abs()).fold(f64::MIN_POSITIVE, f64::max)
}
