//! What a rover is made from: its body, and mounts with a wheel, a motor and a steering axis each
//! ([FourWheel], Tables 1 and 2).
//!
//! A mount may be turned by a fixed angle, or steered about an axis of its own.

use nalgebra::Rotation2;

use super::battery::Battery;
use super::motor::Motor;
use super::state::rotation;
use super::suspension::Suspension;
use crate::error::{ParameterError, finite, positive};
use crate::terrain::Footprint;
use crate::terrain::footprint::REACH;
use crate::units::{Vec2, Vec3};
use crate::wheel::Wheel;

/// Moments of inertia about the principal axes through a part's own centre of mass [kg·m²].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// About x, forward.
    pub xx: f64,
    /// About y, to the left: a wheel's axle.
    pub yy: f64,
    /// About z, up.
    pub zz: f64,
}

/// The body, without its wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about its centre of mass.
    pub inertia: Inertia,
}

/// A wheel with its motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelUnit {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about its hub.
    pub inertia: Inertia,
    /// Geometry.
    pub wheel: Wheel,
    /// Its motor, where that is known.
    pub motor: Option<Motor>,
}

/// The upright axis about which a wheel is steered, its kingpin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringAxis {
    /// How far the wheel turns to either side [rad], above 0 and at most a quarter turn.
    pub limit: f64,
    /// How fast it turns [rad/s].
    pub rate: f64,
    /// Kingpin offset, *k*: from the hub at a steering angle of zero to the axis, in the body frame
    /// [m].
    pub kingpin_offset: Vec2,
}

/// How fast a wheel is steered whose rate is not known [rad/s]: 10 °/s. Source: assumed; a quarter
/// turn in 9 s.
pub const USUAL_STEERING_RATE: f64 = 0.174_532_925_199_432_95;

impl SteeringAxis {
    /// How far the hub moves where the wheel is steered, in the body frame [m]:
    ///
    /// ```text
    /// d(δ) − d(0) = k − R(δ) k
    /// ```
    ///
    /// * `angle`: steering angle, *δ* [rad]
    #[must_use]
    pub fn hub_shift(&self, angle: f64) -> Vec2 {
        if angle == 0.0 || self.kingpin_offset == Vec2::zeros() {
            return Vec2::zeros();
        }
        self.kingpin_offset - rotation(angle) * self.kingpin_offset
    }

    /// The same axis seen in a mirror: left and right changed.
    pub(super) fn mirrored(self) -> Self {
        let Self { kingpin_offset, .. } = self;
        Self { kingpin_offset: Vec2::new(kingpin_offset.x, -kingpin_offset.y), ..self }
    }

    /// Checks that a wheel can have this axis and this steering angle.
    pub(super) fn check(&self, wheel: &str, angle: f64) -> Result<(), ParameterError> {
        use std::f64::consts::FRAC_PI_2;
        /// A quarter turn of a document is one but for its last digit.
        const ROUNDING: f64 = 1e-12;
        if !(self.limit > 0.0 && self.limit <= FRAC_PI_2 + ROUNDING) {
            let name = format!("steering limit of wheel {wheel} [rad]");
            return Err(ParameterError::new(name, self.limit, "above zero and at most π/2"));
        }
        positive(&format!("steering rate of wheel {wheel} [rad/s]"), self.rate)?;
        for (axis, value) in ["x", "y"].iter().zip(self.kingpin_offset.iter()) {
            finite(&format!("kingpin offset {axis} of wheel {wheel} [m]"), *value)?;
        }
        if angle.abs() <= self.limit + ROUNDING {
            return Ok(());
        }
        let limit = self.limit;
        let name = format!(
            "steering angle of wheel {wheel}, which turns by {limit:.3} to either side at most \
             [rad]"
        );
        Err(ParameterError::new(name, angle, "within that limit"))
    }
}

/// A wheel in its place.
///
/// How does a front wheel see the rover's motion at 5 cm/s straight ahead, if it is steered by 10°
/// to the left?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::units::{Vec2, deg};
/// use grouser_core::vehicle::Mount;
///
/// let front_left = Mount { steering: deg(10.0), ..paper::hakuto()?.mounts()[0].clone() };
/// let velocity = front_left.wheel_from_body(Vec2::new(0.05, 0.0));
/// assert_eq!(format!("{:.1} mm/s forward", 1e3 * velocity.x), "49.2 mm/s forward");
/// assert_eq!(format!("{:.1} mm/s to the left", 1e3 * velocity.y), "-8.7 mm/s to the left");
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// The wheel's name, such as `front-left`.
    pub name: String,
    /// What the robot's logs call the joint that turns it, if that is another name; with a minus
    /// before it where positive speeds roll the wheel backward.
    pub joint: Option<String>,
    /// Its hub, in the body frame [m], with the wheel steered as it is.
    pub position: Vec3,
    /// The wheel with its motor.
    pub unit: WheelUnit,
    /// Steering angle, *δ* [rad]: the wheel is turned to the left by this much; for good, if it has
    /// no axis.
    pub steering: f64,
    /// The axis about which it is steered; without one it keeps its angle.
    pub steering_axis: Option<SteeringAxis>,
}

impl Mount {
    /// Shearing radius of the wheel, *r_s* [m].
    #[must_use]
    pub fn shearing_radius(&self) -> f64 {
        self.unit.wheel.shearing_radius()
    }

    /// A vector of the body frame, in the wheel's.
    #[must_use]
    pub fn wheel_from_body(&self, vector: Vec2) -> Vec2 {
        match self.turn() {
            None => vector,
            Some(turn) => turn.inverse_transform_vector(&vector),
        }
    }

    /// A vector of the wheel's frame, in the body's.
    #[must_use]
    pub fn body_from_wheel(&self, vector: Vec2) -> Vec2 {
        self.turn().map_or(vector, |turn| turn * vector)
    }

    /// The same mount with its wheel steered, whatever its limit; a wheel without an axis is turned
    /// about its hub.
    ///
    /// * `angle`: steering angle, *δ* [rad]
    #[must_use]
    pub fn at_angle(&self, angle: f64) -> Self {
        let shift = |angle| self.steering_axis.map_or(Vec2::zeros(), |axis| axis.hub_shift(angle));
        let way = shift(angle) - shift(self.steering);
        let position = self.position + Vec3::new(way.x, way.y, 0.0);
        Self { position, steering: angle, ..self.clone() }
    }

    /// Where ground counts for the wheel.
    ///
    /// * `slope_from_body`: the rover's rotation
    #[must_use]
    pub fn footprint(&self, slope_from_body: &Rotation2<f64>) -> Footprint {
        let Wheel { width, .. } = self.unit.wheel;
        Footprint {
            forward: slope_from_body * self.body_from_wheel(Vec2::x()),
            half_length: REACH * self.shearing_radius(),
            half_width: 0.5 * width,
        }
    }

    /// The rotation from the body's frame to the wheel's; none for a wheel that points straight
    /// ahead.
    fn turn(&self) -> Option<Rotation2<f64>> {
        (self.steering != 0.0).then(|| rotation(self.steering))
    }
}

/// What a rover is made from: a wheel unit for all mounts, and what single mounts have instead.
#[derive(Clone, Debug, PartialEq)]
pub struct RoverParts {
    /// The body, without its wheels.
    pub body: Body,
    /// The wheel with its motor of every mount that has no other.
    pub wheel_unit: WheelUnit,
    /// How every wheel is steered whose mount says nothing else.
    pub steering: SteeringParts,
    /// Where the wheels sit.
    pub mounts: Vec<MountParts>,
    /// Its battery, where that is known.
    pub battery: Option<Battery>,
    /// What joins the wheels to the body; a rigid rover has none.
    pub suspension: Option<Suspension>,
    /// Height of the [underside](super::belly) over level hard ground on which the wheels stand
    /// [m], where that is known.
    pub belly_clearance: Option<f64>,
}

/// How far and how fast wheels are steered, as far as that is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SteeringParts {
    /// How far a wheel turns to either side [rad]; 0 for one that is not steered.
    pub limit: Option<f64>,
    /// How fast it turns [rad/s]; if nothing is known, [`USUAL_STEERING_RATE`].
    pub rate: Option<f64>,
}

/// Where a wheel sits, and what it has instead of the common wheel unit.
#[derive(Clone, Debug, PartialEq)]
pub struct MountParts {
    /// The wheel's name, such as `front-left`.
    pub name: String,
    /// What the robot's logs call the joint that turns it, if that is another name.
    pub joint: Option<String>,
    /// Its hub at a steering angle of zero, in the body frame [m].
    pub position: Vec3,
    /// Steering angle, *δ* [rad], positive to the left.
    pub steering: f64,
    /// How far and how fast it is steered, where that is not the rover's.
    pub steered: SteeringParts,
    /// Kingpin offset, *k*, of a wheel that is steered: from the hub at a steering angle of zero to
    /// the axis, in the body frame [m].
    pub kingpin_offset: Vec2,
    /// A wheel of its own.
    pub wheel: Option<Wheel>,
    /// A mass of its own [kg].
    pub mass: Option<f64>,
    /// An inertia of its own.
    pub inertia: Option<Inertia>,
    /// A motor of its own.
    pub motor: Option<Motor>,
}

impl RoverParts {
    /// Each mount with all that it has.
    #[must_use]
    pub fn complete_mounts(&self) -> Vec<Mount> {
        let common = self.wheel_unit;
        let complete = |mount: &MountParts| {
            let steering_axis = self.steering_axis(mount);
            let shift = steering_axis.map_or(Vec2::zeros(), |axis| axis.hub_shift(mount.steering));
            Mount {
                name: mount.name.clone(),
                joint: mount.joint.clone(),
                position: mount.position + Vec3::new(shift.x, shift.y, 0.0),
                unit: WheelUnit {
                    mass: mount.mass.unwrap_or(common.mass),
                    inertia: mount.inertia.unwrap_or(common.inertia),
                    wheel: mount.wheel.unwrap_or(common.wheel),
                    motor: mount.motor.or(common.motor),
                },
                steering: mount.steering,
                steering_axis,
            }
        };
        self.mounts.iter().map(complete).collect()
    }

    /// Checks that only wheels that are steered have a rate or a kingpin of their own.
    pub(super) fn check_axes(&self, complete: &[Mount]) -> Result<(), ParameterError> {
        for (parts, mount) in self.mounts.iter().zip(complete) {
            let own = parts.kingpin_offset.norm();
            let rate = parts.steered.rate.unwrap_or(0.0);
            let of_none = [("kingpin offset", "m", own), ("steering rate", "rad/s", rate)];
            for (what, unit, value) in of_none {
                if mount.steering_axis.is_none() && value != 0.0 {
                    let name = format!("{what} of wheel {} [{unit}]", mount.name);
                    let expected = "left out for a wheel that has no `steering_limit_deg`";
                    return Err(ParameterError::new(name, value, expected));
                }
            }
        }
        Ok(())
    }

    /// The axis about which a mount's wheel is steered, if it is.
    fn steering_axis(&self, mount: &MountParts) -> Option<SteeringAxis> {
        let limit = mount.steered.limit.or(self.steering.limit)?;
        let rate = mount.steered.rate.or(self.steering.rate).unwrap_or(USUAL_STEERING_RATE);
        let axis = SteeringAxis { limit, rate, kingpin_offset: mount.kingpin_offset };
        (limit != 0.0).then_some(axis)
    }
}
