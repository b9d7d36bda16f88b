//! The attitude: the yaw that keeps a traverse level on a slope ([FourWheel], Fig. 10).
//!
//! A rover that crosses a slope along the contour needs a side force against the weight's pull. It
//! gets it by pointing its nose uphill: with yaw γ and all velocities along the contour, every
//! wheel has the slip angle β = −γ. All wheels turn alike and share one slip ratio s. Level means
//!
//! ```text
//! ΣF_x(s, γ) = W sin α sin γ        ΣF_y(s, γ) = W sin α cos γ
//! ```
//!
//! Wheels may differ: they still share one slip ratio, so that all rims turn at one speed. Steered
//! wheels have no slip angle in common, and no attitude here.
//!
//! The solutions (s, γ, α) form a curve that starts at γ = 0 on level ground. It rises to a
//! steepest slope, where turning further uphill costs as much thrust as it gains, and folds back.
//! The curve is followed by its arc length, so that the fold is a point like any other. The yaw
//! moment is not balanced: it is reported.
//!
//! A level traverse is one course among many. On a course χ, the direction of travel counted from
//! the contour and positive uphill, a rover crabs by c = γ − χ, its wheels have β = −c, and the
//! same two equations hold, at the yaw γ = χ + c. And a rover that does nothing against the slope,
//! with its nose along the contour, drifts: it holds γ = 0 instead of a course, and χ = −c is what
//! becomes of it.

mod path;

use nalgebra::Vector3;

use self::path::{Held, JUST_TURNED, Path, Place, Point};
use crate::contact::Theory;
use crate::elementary::wide;
use crate::error::{ParameterError, finite};
use crate::root;
use crate::simulation::Scenario;
use crate::site::Site;
use crate::soil::Soil;
use crate::vehicle::reaction::forces_of;
use crate::vehicle::{LoadSharing, Mount, OwnMoments, Rover, WheelReaction, dynamics};

/// A rover and its ground, on slopes yet to be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeStudy {
    /// The rover.
    pub rover: Rover,
    /// The soil.
    pub soil: Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The theory.
    pub theory: Theory,
    /// How the weight is shared.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
}

/// A balanced way along a course, level where that is 0: a point of the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Attitude {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: f64,
    /// Yaw moment left over about the common centre of mass [N·m]; negative turns the nose downhill.
    pub yaw_moment: f64,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
    /// How many wheels were settled to find it, beyond those of the curve.
    pub settled_wheels: u64,
}

impl Attitude {
    /// Mean sinkage of the wheels [m].
    #[must_use]
    pub fn mean_sinkage(&self) -> f64 {
        let sum: f64 = self.wheels.iter().map(|wheel| wheel.settled.sinkage).sum();
        sum / self.wheels.len() as f64
    }

    /// Torque of all wheels, ΣT [N·m].
    #[must_use]
    pub fn torque(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.settled.forces.torque).sum()
    }

    /// Work of the wheels per metre of way, ΣT cos c / [(1 − s) r_s] [J/m], and with 1 + s instead
    /// of the divisor for wheels that brake; c = γ − χ.
    #[must_use]
    pub fn energy_per_metre(&self, rover: &Rover) -> f64 {
        let s = self.slip_ratio;
        let rim_over_hub = if s >= 0.0 { 1.0 / (1.0 - s) } else { 1.0 + s };
        let crab = self.yaw - self.course;
        let thrust = || {
            let each = self.each_torque(rover);
            each.map(|(mount, torque)| torque / mount.shearing_radius()).sum()
        };
        let thrust: f64 =
            rover.common_radius().map_or_else(thrust, |radius| self.torque() / radius);
        thrust * wide::cos(crab) * rim_over_hub
    }

    /// Drift per metre travelled, −sin χ [m/m]: positive downhill, 0 on a level traverse.
    #[must_use]
    pub fn drift(&self) -> f64 {
        0.0 - wide::sin(self.course)
    }

    /// Power of the motors at one rim speed ω r_s of all wheels [m/s], ΣT ω [W].
    #[must_use]
    pub fn power(&self, rover: &Rover, rim_speed: f64) -> f64 {
        let of_each = || {
            let each = self.each_torque(rover);
            each.map(|(mount, torque)| torque * rim_speed / mount.shearing_radius()).sum()
        };
        rover.common_radius().map_or_else(of_each, |radius| self.torque() * rim_speed / radius)
    }

    /// The torque of each wheel [N·m].
    fn each_torque<'a>(&'a self, rover: &'a Rover) -> impl Iterator<Item = (&'a Mount, f64)> {
        let torques = self.wheels.iter().map(|wheel| wheel.settled.forces.torque);
        rover.mounts().iter().zip(torques)
    }
}

/// Why no yaw keeps a traverse level on a slope.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoAttitude {
    /// The rover cannot even drive on level ground.
    #[error("the wheels cannot move the rover on level ground: {0}")]
    CannotMove(String),
    /// The slope is above the steepest that can be crossed.
    /// (The slope is rounded down: one that is rounded up has no attitude.)
    #[error(
        "no {}: the steepest slope is {:.2}°, {reason}",
        if *.course == 0.0 { "level attitude" } else { "attitude on this course" },
        (.limit.to_degrees() * 100.0).floor() / 100.0
    )]
    TooSteep {
        /// The course [rad]: 0 for a level one.
        course: f64,
        /// The steepest slope [rad].
        limit: f64,
        /// What ends the curve there.
        reason: String,
    },
}

/// All attitudes of a course from level ground to the steepest slope.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeCurve {
    study: AttitudeStudy,
    held: Held,
    /// Points of the branch, rising; empty if the rover cannot move.
    points: Vec<Point>,
    /// Below this slope the flank holds the rover without any crab [rad]; 0 for smooth soils' laws.
    held_below: f64,
    end: String,
    settled_wheels: u64,
}

/// The steepest slope that is looked at [rad]: 60°. Source: the documents' range.
const STEEPEST: f64 = std::f64::consts::FRAC_PI_3;

/// The farthest course from the contour [rad]: straight up or down the slope. Beyond it a rover
/// travels the other way, and is its own mirror image.
pub const STRAIGHT_UP: f64 = std::f64::consts::FRAC_PI_2;

impl AttitudeStudy {
    /// The study of a scenario's rover and soil, whatever its slope and drive.
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        Self {
            rover: scenario.rover.clone(),
            soil: scenario.site.terrain.soil,
            gravity: scenario.site.gravity,
            theory: scenario.theory,
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
        }
    }

    /// Follows the curve of level traverses from level ground to its end.
    ///
    /// # Errors
    /// [`ParameterError`] if soil or gravity are no such things, or a wheel is steered.
    pub fn curve(&self) -> Result<AttitudeCurve, ParameterError> {
        self.curve_on(0.0)
    }

    /// Follows the curve of another course, *χ* [rad], −π/2 to π/2, positive uphill.
    ///
    /// # Errors
    /// As [`curve`](Self::curve), and for a course out of its range.
    pub fn curve_on(&self, course: f64) -> Result<AttitudeCurve, ParameterError> {
        finite("course [rad]", course)?;
        if course.abs() > STRAIGHT_UP {
            return Err(ParameterError::new("course [rad]", course, "−π/2 to π/2"));
        }
        self.follow(Held::Course(course), STEEPEST)
    }

    /// The level attitude on one slope [rad]: the curve is followed as far as that slope and no
    /// further. Next to the fold, where a curve's last points are those that it was closed in on
    /// with, the answer may differ from the whole curve's by round-off.
    ///
    /// # Errors
    /// [`ParameterError`] if soil or gravity are no such things; [`NoAttitude`] within if no yaw
    /// keeps a traverse level there.
    pub fn on_slope(&self, slope: f64) -> Result<Result<Attitude, NoAttitude>, ParameterError> {
        Ok(self.follow(Held::Course(0.0), slope.min(STEEPEST))?.at(slope))
    }

    /// Follows the curve of drift: the nose stays along the contour, γ = 0, and the course turns
    /// downhill with the slope. It ends where no drift holds the rover any more.
    ///
    /// # Errors
    /// As [`curve`](Self::curve).
    pub fn drift_curve(&self) -> Result<AttitudeCurve, ParameterError> {
        self.follow(Held::Yaw(0.0), STEEPEST)
    }

    /// The curve of what is held, as far as its first point that is not below a slope, or to its
    /// end.
    fn follow(&self, held: Held, slope: f64) -> Result<AttitudeCurve, ParameterError> {
        Site::plane(self.soil, 0.0, self.gravity).check()?;
        for mount in self.rover.mounts() {
            if mount.steering != 0.0 {
                let name = format!("steering of wheel {} [rad]", mount.name);
                let expected = "0 where all wheels are to share one slip ratio and one slip angle";
                return Err(ParameterError::new(name, mount.steering, expected));
            }
        }
        let path = Path::new(self, held);
        let (mut points, mut held_below) = (Vec::new(), 0.0);
        let end = match path.start() {
            Err(reason) => reason,
            Ok(start) => {
                held_below = start.place.z;
                points.push(start);
                path.follow(&mut points, slope)
            }
        };
        let settled_wheels = path.settled_wheels();
        Ok(AttitudeCurve { study: self.clone(), held, points, held_below, end, settled_wheels })
    }
}

impl AttitudeCurve {
    /// The course, *χ* [rad]; of a curve of drift the one it has on level ground.
    #[must_use]
    pub fn course(&self) -> f64 {
        self.held.course(0.0)
    }

    /// How many wheels were settled to follow the curve.
    #[must_use]
    pub fn settled_wheels(&self) -> u64 {
        self.settled_wheels
    }

    /// The steepest slope that has an attitude [rad], and what ends the curve there.
    ///
    /// # Errors
    /// [`NoAttitude::CannotMove`] if there is none.
    pub fn limit(&self) -> Result<(f64, &str), NoAttitude> {
        match self.points.last() {
            Some(last) => Ok((last.place.z.min(STEEPEST), &self.end)),
            None => Err(NoAttitude::CannotMove(self.end.clone())),
        }
    }

    /// The attitude on a slope [rad].
    ///
    /// # Errors
    /// [`NoAttitude`] if no yaw keeps the course there, or no drift holds the rover.
    pub fn at(&self, slope: f64) -> Result<Attitude, NoAttitude> {
        let (limit, reason) = self.limit()?;
        if slope > limit {
            let reason = reason.into();
            return Err(NoAttitude::TooSteep { course: self.course(), limit, reason });
        }
        let path = Path::new(&self.study, self.held);
        let point = if slope <= self.held_below {
            let slip_ratio = path.slip_at(0.0, slope).map_err(NoAttitude::CannotMove)?;
            let place = Place::new(slip_ratio, 0.0, slope);
            path.point(place).map_err(|error| NoAttitude::CannotMove(error.to_string()))?
        } else {
            let above = self.points.partition_point(|point| point.place.z < slope).max(1);
            let high = &self.points[above.min(self.points.len() - 1)];
            Self::settle_on(&path, slope, &self.points[above - 1], high)
        };
        Ok(self.attitude(&point, path.settled_wheels()))
    }

    /// The curve's point on a slope, between two known ones.
    fn settle_on(path: &Path<'_>, slope: f64, below: &Point, above: &Point) -> Point {
        let (low, high) = (below.place, above.place);
        let share = if high.z > low.z { (slope - low.z) / (high.z - low.z) } else { 1.0 };
        let rise = high.z - low.z;
        let guess = match (Path::per_slope(below), Path::per_slope(above)) {
            (Some(at_low), Some(at_high)) => {
                // The cubic with these ends and slopes (Hermite).
                let (t, u) = (share, 1.0 - share);
                low * (u * u * (1.0 + 2.0 * t))
                    + high * (t * t * (1.0 + 2.0 * u))
                    + (at_low * u - at_high * t) * (rise * t * u)
            }
            _ => low + (high - low) * share,
        };
        let level = Vector3::z();
        let on_slope = Place::new(guess.x, guess.y, slope);
        if let Some(point) = path.correct(&on_slope, &level, &above.gradients) {
            let inside = point.place.y >= low.y.min(high.y) - 1e-9
                && point.place.y <= low.y.max(high.y) + 1e-9;
            if inside {
                return point;
            }
        }
        // Close to the fold the slope no longer tells the point: go by the distance along the curve.
        let Some(chord) = (high - low).try_normalize(f64::MIN_POSITIVE) else {
            return above.clone();
        };
        let along =
            |share: f64| path.correct(&(low + (high - low) * share), &chord, &below.gradients);
        let rise = |share: f64| along(share).map_or(-1.0, |point| point.place.z - slope);
        let nearest = if share < 0.5 { below } else { above };
        along(root::between(rise, 0.0, 1.0, 1e-13)).unwrap_or_else(|| nearest.clone())
    }

    /// Points along the curve, from level ground to the steepest slope.
    #[must_use]
    pub fn attitudes(&self) -> Vec<Attitude> {
        self.points.iter().map(|point| self.attitude(point, 0)).collect()
    }

    fn attitude(&self, point: &Point, settled_wheels: u64) -> Attitude {
        let study = &self.study;
        let Point { place, wheels, .. } = point;
        let forces = forces_of(wheels);
        let (force, moment) = dynamics::soil_resultant(&study.rover, forces, study.own_moments);
        let crab = if place.y <= JUST_TURNED { 0.0 } else { place.y };
        Attitude {
            slope: place.z,
            course: self.held.course(crab),
            yaw: self.held.yaw(crab),
            slip_ratio: place.x,
            yaw_moment: moment - study.rover.centre_of_mass().perp(&force),
            wheels: wheels.clone(),
            settled_wheels,
        }
    }
}
