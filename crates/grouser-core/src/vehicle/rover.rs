//! A rover: a body and three or more wheels, rigidly joined ([FourWheel], Tables 1 and 2).
//!
//! It is made from its [parts](super::parts).

use nalgebra::Rotation2;

use super::battery::Battery;
use super::parts::{
    Body, Inertia, Mount, MountParts, RoverParts, SteeringAxis, SteeringParts, WheelUnit,
};
use super::support_polygon::SupportPolygon;
use super::suspension::Suspension;
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::terrain::Footprint;
use crate::units::{Vec2, Vec3};

/// A rover that can stand and be moved: made by [`Rover::new`], then unchanged.
///
/// What do a body and four wheels of HAKUTO weigh together, and how high is their centre of mass?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::units::Vec3;
/// use grouser_core::vehicle::{Body, Inertia, Mount, Rover, WheelUnit};
///
/// let body = Body { mass: 5.24, inertia: Inertia { xx: 0.138, yy: 0.142, zz: 0.230 } };
/// let inertia = Inertia { xx: 0.00100, yy: 0.00154, zz: 0.00100 };
/// let unit = WheelUnit { mass: 0.422, inertia, wheel: paper::hakuto_wheel(), motor: None };
/// let mount = |(name, x, y): (&str, f64, f64)| Mount {
///     name: name.to_owned(),
///     joint: None,
///     position: Vec3::new(x, y, -0.06),
///     unit,
///     steering: 0.0,
///     steering_axis: None,
/// };
/// let left = [("front-left", 0.19, 0.24), ("rear-left", -0.17, 0.24)];
/// let right = [("rear-right", -0.17, -0.24), ("front-right", 0.19, -0.24)];
/// let rover = Rover::new(body, left.into_iter().chain(right).map(mount).collect())?;
///
/// assert_eq!(format!("{:.3} kg", rover.mass()), "6.928 kg");
/// assert_eq!(format!("{:.1} mm", 1e3 * rover.centre_height()), "155.4 mm");
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Rover {
    parts: RoverParts,
    mounts: Vec<Mount>,
    mass: f64,
    first_moment: Vec2,
    yaw_inertia: f64,
    centre_height: f64,
    load_arms: Vec<Vec2>,
    support_polygon: SupportPolygon,
}

/// Two rovers are one if they have the same body, and on it the same wheels.
impl PartialEq for Rover {
    fn eq(&self, other: &Self) -> bool {
        let (one, other_parts) = (&self.parts, &other.parts);
        one.body == other_parts.body
            && one.battery == other_parts.battery
            && one.suspension == other_parts.suspension
            && one.belly_clearance == other_parts.belly_clearance
            && self.mounts == other.mounts
    }
}

/// The lowest points of wheels may differ in height by this much [m] and still share one contact
/// plane.
const LEVEL: f64 = 1e-9;

impl Rover {
    /// A rover from its body and its wheels.
    ///
    /// # Errors
    /// [`ParameterError`] if a mass or an inertia is not positive, if there are fewer than three
    /// wheels, if they stand in one line, or if they do not reach down to one plane.
    pub fn new(body: Body, mounts: Vec<Mount>) -> Result<Self, ParameterError> {
        let Some(first) = mounts.first() else {
            return Err(ParameterError::new("the number of wheels", 0.0, "three or more"));
        };
        let wheel_unit = first.unit;
        let parts = |mount: Mount| {
            let Mount { name, joint, position, unit, steering, steering_axis } = mount;
            let shift = steering_axis.map_or(Vec2::zeros(), |axis| axis.hub_shift(steering));
            MountParts {
                name,
                joint,
                position: position - Vec3::new(shift.x, shift.y, 0.0),
                steering,
                steered: SteeringParts {
                    limit: steering_axis.map(|axis| axis.limit),
                    rate: steering_axis.map(|axis| axis.rate),
                },
                kingpin_offset: steering_axis.map_or(Vec2::zeros(), |axis| axis.kingpin_offset),
                wheel: (unit.wheel != wheel_unit.wheel).then_some(unit.wheel),
                mass: (unit.mass != wheel_unit.mass).then_some(unit.mass),
                inertia: (unit.inertia != wheel_unit.inertia).then_some(unit.inertia),
                motor: unit.motor.filter(|motor| Some(*motor) != wheel_unit.motor),
            }
        };
        let mounts = mounts.into_iter().map(parts).collect();
        let steering = SteeringParts::default();
        Self::draft(RoverParts {
            body,
            wheel_unit,
            steering,
            mounts,
            battery: None,
            suspension: None,
            belly_clearance: None,
        })
        .checked()
    }

    /// A rover of which nothing but the parts is known: to be filled in, and then
    /// [`checked`](Self::checked).
    #[must_use]
    pub const fn draft(parts: RoverParts) -> Self {
        Self {
            parts,
            mounts: Vec::new(),
            mass: 0.0,
            first_moment: Vec2::new(0.0, 0.0),
            yaw_inertia: 0.0,
            centre_height: 0.0,
            load_arms: Vec::new(),
            support_polygon: SupportPolygon::NONE,
        }
    }

    /// The parts that it is made from.
    #[must_use]
    pub fn parts(&self) -> &RoverParts {
        &self.parts
    }

    /// The parts, to be changed; the rover has to be [`checked`](Self::checked) after that.
    pub fn parts_mut(&mut self) -> &mut RoverParts {
        &mut self.parts
    }

    /// The rover that its parts make.
    ///
    /// # Errors
    /// The same as [`new`](Self::new).
    pub fn checked(self) -> Result<Self, ParameterError> {
        let parts = self.parts;
        let mounts = parts.complete_mounts();
        let body = parts.body;
        let alike = alike(&mounts);
        positive("body mass [kg]", body.mass)?;
        for (unit, _) in &alike {
            positive("wheel unit mass [kg]", unit.mass)?;
        }
        let inertias = alike.iter().map(|(unit, _)| ("wheel unit", unit.inertia));
        for (part, inertia) in std::iter::once(("body", body.inertia)).chain(inertias) {
            for (axis, value) in [("xx", inertia.xx), ("yy", inertia.yy), ("zz", inertia.zz)] {
                positive(&format!("{part} inertia {axis} [kg·m²]"), value)?;
            }
        }
        for (unit, _) in &alike {
            unit.wheel.check()?;
            unit.motor.map_or(Ok(()), |motor| motor.check())?;
        }
        if let Some(battery) = parts.battery {
            battery.check()?;
            if mounts.iter().all(|mount| mount.unit.motor.is_none()) {
                let expected =
                    "left out, or one that feeds known motors: what they draw is not known";
                return Err(ParameterError::new("battery", battery.capacity, expected));
            }
        }
        check_stance(&mounts)?;
        parts.suspension.map_or(Ok(()), |suspension| suspension.check(&mounts))?;
        parts.check_axes(&mounts)?;
        parts.belly_clearance.map_or(Ok(()), |it| not_negative("belly clearance [m]", it))?;

        let (mut mass, mut yaw_inertia) = (body.mass, body.inertia.zz);
        for (unit, positions) in &alike {
            mass += positions.len() as f64 * unit.mass;
        }
        let (mut first_moment, mut centre) = (Vec2::zeros(), Vec3::zeros());
        for (unit, positions) in &alike {
            let count = positions.len() as f64;
            let sum: Vec3 = positions.iter().sum();
            let spread: f64 = positions.iter().map(|position| position.xy().norm_squared()).sum();
            first_moment += sum.xy() * unit.mass;
            centre += sum * (unit.mass / mass);
            yaw_inertia = yaw_inertia + count * unit.inertia.zz + unit.mass * spread;
        }
        let plane = mounts.iter().map(|mount| mount.position.xy());
        let load_arms: Vec<Vec2> = plane.map(|position| position - centre.xy()).collect();
        Ok(Self {
            mass,
            first_moment,
            yaw_inertia,
            centre_height: mounts[0].shearing_radius() + centre.z - mounts[0].position.z,
            support_polygon: SupportPolygon::of(&load_arms),
            load_arms,
            mounts,
            parts,
        })
    }

    /// The same rover with all masses and inertias of its parts times a factor: heavier or lighter,
    /// of one shape.
    ///
    /// # Errors
    /// [`ParameterError`] if the factor is not above zero.
    pub fn with_mass_factor(&self, factor: f64) -> Result<Self, ParameterError> {
        positive("mass factor", factor)?;
        let scaled = |inertia: Inertia| Inertia {
            xx: factor * inertia.xx,
            yy: factor * inertia.yy,
            zz: factor * inertia.zz,
        };
        let mut rover = self.clone();
        let RoverParts { body, wheel_unit, mounts, .. } = &mut rover.parts;
        *body = Body { mass: factor * body.mass, inertia: scaled(body.inertia) };
        wheel_unit.mass *= factor;
        wheel_unit.inertia = scaled(wheel_unit.inertia);
        for mount in mounts {
            mount.mass = mount.mass.map(|mass| factor * mass);
            mount.inertia = mount.inertia.map(scaled);
        }
        rover.checked()
    }

    /// The same rover with its wheels steered: each turned about its kingpin, so that the hub of
    /// one whose kingpin is beside it moves.
    ///
    /// Four wheels that turn up to 30° to either side crab by 12°:
    ///
    /// ```
    /// use grouser_core::paper;
    /// use grouser_core::units::{Vec2, deg};
    /// use grouser_core::vehicle::{Rover, SteeringAxis};
    ///
    /// let rover = paper::hakuto()?;
    /// let axis = SteeringAxis { limit: deg(30.0), rate: deg(10.0), kingpin_offset: Vec2::zeros() };
    /// let mut mounts = rover.mounts().to_vec();
    /// mounts.iter_mut().for_each(|mount| mount.steering_axis = Some(axis));
    /// let rover = Rover::new(*rover.body(), mounts)?;
    ///
    /// assert_eq!(rover.steered(&[deg(12.0); 4])?.steering_angles(), [deg(12.0); 4]);
    /// let message = rover.steered(&[0.0, 0.0, 0.0, deg(40.0)]).expect_err("too far").to_string();
    /// assert!(message.starts_with(
    ///     "steering angle of wheel front-right, which turns by 0.524 to either side at most [rad] is 0.698"
    /// ));
    /// # Ok::<(), grouser_core::error::ParameterError>(())
    /// ```
    ///
    /// * `angles`: steering angle of each wheel, *δ* [rad], in the mounts' order
    ///
    /// # Errors
    /// [`ParameterError`] for another number of angles than wheels, for one beyond its wheel's
    /// limit, and for another angle of a wheel that is not steered than it has.
    pub fn steered(&self, angles: &[f64]) -> Result<Self, ParameterError> {
        self.check_steering(angles)?;
        if self.mounts.iter().zip(angles).all(|(mount, angle)| mount.steering == *angle) {
            return Ok(self.clone());
        }
        let mut rover = self.clone();
        for (mount, angle) in rover.parts.mounts.iter_mut().zip(angles) {
            mount.steering = *angle;
        }
        rover.checked()
    }

    /// Checks that wheels can have these steering angles.
    ///
    /// # Errors
    /// The same as [`steered`](Self::steered).
    pub fn check_steering(&self, angles: &[f64]) -> Result<(), ParameterError> {
        if angles.len() != self.mounts.len() {
            let (count, expected) = (angles.len() as f64, "one for each wheel of the rover");
            return Err(ParameterError::new("the number of steering angles", count, expected));
        }
        for (mount, angle) in self.mounts.iter().zip(angles) {
            finite(&format!("steering angle of wheel {} [rad]", mount.name), *angle)?;
            match &mount.steering_axis {
                Some(axis) => axis.check(&mount.name, *angle)?,
                None if mount.steering != *angle => {
                    let name = format!("steering angle of wheel {} [rad]", mount.name);
                    let expected = "left as it is: the wheel has no `steering_limit_deg`";
                    return Err(ParameterError::new(name, *angle, expected));
                }
                None => {}
            }
        }
        Ok(())
    }

    /// Steering angle of each wheel, *δ* [rad], in the mounts' order.
    #[must_use]
    pub fn steering_angles(&self) -> Vec<f64> {
        self.mounts.iter().map(|mount| mount.steering).collect()
    }

    /// Whether some wheel is steered.
    #[must_use]
    pub fn is_steerable(&self) -> bool {
        self.mounts.iter().any(|mount| mount.steering_axis.is_some())
    }

    /// The same rover seen in a mirror: left and right changed. A traverse with the uphill side on
    /// the right is that of the mirrored rover with the uphill side on the left.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        for mount in &mut mirrored.parts.mounts {
            mount.position.y = -mount.position.y;
            mount.steering = -mount.steering;
            mount.kingpin_offset.y = -mount.kingpin_offset.y;
        }
        for mount in &mut mirrored.mounts {
            mount.position.y = -mount.position.y;
            mount.steering = -mount.steering;
            mount.steering_axis = mount.steering_axis.map(SteeringAxis::mirrored);
        }
        for arm in &mut mirrored.load_arms {
            arm.y = -arm.y;
        }
        mirrored.support_polygon = SupportPolygon::of(&mirrored.load_arms);
        mirrored.first_moment.y = -mirrored.first_moment.y;
        mirrored
    }

    /// Whether the rover is its own mirror image: then headings hold either way.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        /// Hubs may be off by this much [m], and steering angles [rad]: a tenth of a millimetre
        /// turns no rover.
        const SAME: f64 = 1e-4;
        self.mounts.iter().all(|mount| {
            let image = Vec2::new(mount.position.x, -mount.position.y);
            self.mounts.iter().any(|other| {
                (other.position.xy() - image).amax() <= SAME
                    && (other.steering + mount.steering).abs() <= SAME
                    && other.unit == mount.unit
                    && other.steering_axis == mount.steering_axis.map(SteeringAxis::mirrored)
            })
        })
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.parts.body
    }

    /// The mounts with their wheels, in the order of every per-wheel list.
    #[must_use]
    pub fn mounts(&self) -> &[Mount] {
        &self.mounts
    }

    /// Mean height of the axles over the lowest points of their wheels [m]: the sinkage of a rover
    /// whose wheels are all sunk to the axle.
    #[must_use]
    pub fn mean_axle_height(&self) -> f64 {
        let radii = self.mounts.iter().map(Mount::shearing_radius);
        radii.sum::<f64>() / self.mounts.len() as f64
    }

    /// The battery, where that is known.
    #[must_use]
    pub fn battery(&self) -> Option<&Battery> {
        self.parts.battery.as_ref()
    }

    /// What joins the wheels to the body; a rigid rover has none.
    #[must_use]
    pub fn suspension(&self) -> Option<&Suspension> {
        self.parts.suspension.as_ref()
    }

    /// The same rover with its wheels on rockers.
    ///
    /// # Errors
    /// [`ParameterError`] where it cannot have them.
    pub fn on_rockers(&self, suspension: Suspension) -> Result<Self, ParameterError> {
        let mut rover = self.clone();
        rover.parts.suspension = Some(suspension);
        rover.checked()
    }

    /// Whether more of its power is known than what motors take: its battery, or how warm motors
    /// become.
    #[must_use]
    pub fn has_supply(&self) -> bool {
        let warms = |mount: &Mount| mount.unit.motor.is_some_and(|motor| motor.winding.is_some());
        self.battery().is_some() || self.mounts.iter().any(warms)
    }

    /// Whether some wheel's motor is known.
    #[must_use]
    pub fn has_motors(&self) -> bool {
        self.mounts.iter().any(|mount| mount.unit.motor.is_some())
    }

    /// Whether the speed of some wheel depends on its load: its motor has a
    /// [speed controller](super::SpeedControl).
    #[must_use]
    pub fn has_droop(&self) -> bool {
        self.mounts
            .iter()
            .any(|mount| mount.unit.motor.is_some_and(|motor| motor.control.is_some()))
    }

    /// How many wheels there are.
    #[must_use]
    pub fn wheel_count(&self) -> usize {
        self.mounts.len()
    }

    /// Where ground counts for the rover: as far as its hubs.
    ///
    /// * `slope_from_body`: its rotation
    #[must_use]
    pub fn footprint(&self, slope_from_body: &Rotation2<f64>) -> Footprint {
        let hubs = self.mounts.iter().map(|mount| mount.position);
        let [half_length, half_width] =
            hubs.fold([0.0, 0.0], |[x, y]: [f64; 2], hub| [x.max(hub.x.abs()), y.max(hub.y.abs())]);
        Footprint { forward: slope_from_body * Vec2::x(), half_length, half_width }
    }

    /// The shearing radius that all wheels have, if they do and point straight ahead [m]: then one
    /// lever and one axis serve them all.
    #[must_use]
    pub fn common_radius(&self) -> Option<f64> {
        let radius = self.mounts.first()?.shearing_radius();
        let is_common = |mount: &Mount| mount.shearing_radius() == radius && mount.steering == 0.0;
        self.mounts.iter().all(is_common).then_some(radius)
    }

    /// Angular speeds of the wheels, *ω* [rad/s], that turn at these rim speeds, *ω r_s* [m/s].
    pub fn wheel_speeds<'a>(&'a self, rim_speeds: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        rim_speeds.iter().zip(&self.mounts).map(|(speed, mount)| speed / mount.shearing_radius())
    }

    /// Mass of body and wheels, *m* [kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// First moment of the wheels about the body's centre of mass, *S* = Σ m_w d, in the body
    /// frame [kg·m]. ([FourWheel], Eqs 8-9, calls its components I_xz and I_yz.)
    #[must_use]
    pub fn first_moment(&self) -> Vec2 {
        self.first_moment
    }

    /// Moment of inertia in yaw about the body's centre of mass, *I_zz* [kg·m²]
    /// ([FourWheel], Eq. 10).
    #[must_use]
    pub fn yaw_inertia(&self) -> f64 {
        self.yaw_inertia
    }

    /// Centre of mass of body and wheels, in the body frame, seen from above [m].
    #[must_use]
    pub fn centre_of_mass(&self) -> Vec2 {
        self.first_moment / self.mass
    }

    /// Height of that centre of mass over the grouser tips of wheels on hard ground, *H* [m].
    #[must_use]
    pub fn centre_height(&self) -> f64 {
        self.centre_height
    }

    /// Hubs seen from the common centre of mass, in the body frame, from above [m].
    #[must_use]
    pub fn load_arms(&self) -> &[Vec2] {
        &self.load_arms
    }

    /// The polygon that the rover stands on, seen from the common centre of mass, in the body
    /// frame.
    #[must_use]
    pub fn support_polygon(&self) -> &SupportPolygon {
        &self.support_polygon
    }
}

/// The wheel units of a rover, each with the hubs that have it [m].
fn alike(mounts: &[Mount]) -> Vec<(WheelUnit, Vec<Vec3>)> {
    let mut alike: Vec<(WheelUnit, Vec<Vec3>)> = Vec::new();
    for mount in mounts {
        match alike.iter_mut().find(|(unit, _)| *unit == mount.unit) {
            Some((_, positions)) => positions.push(mount.position),
            None => alike.push((mount.unit, vec![mount.position])),
        }
    }
    alike
}

fn check_stance(mounts: &[Mount]) -> Result<(), ParameterError> {
    if mounts.len() < 3 {
        let count = mounts.len() as f64;
        return Err(ParameterError::new("the number of wheels", count, "three or more"));
    }
    for mount in mounts {
        for (axis, value) in ["x", "y", "z"].iter().zip(mount.position.iter()) {
            finite(&format!("position {axis} of wheel {} [m]", mount.name), *value)?;
        }
        finite(&format!("steering of wheel {} [rad]", mount.name), mount.steering)?;
        mount.steering_axis.map_or(Ok(()), |axis| axis.check(&mount.name, mount.steering))?;
        let larger = mount.shearing_radius() - mounts[0].shearing_radius();
        if (mount.position.z - mounts[0].position.z - larger).abs() > LEVEL {
            let name = format!("height z of wheel {} [m]", mount.name);
            let expected = if larger == 0.0 {
                "that of the other wheels: all stand on one plane"
            } else {
                "its radius over the lowest points of the other wheels: all stand on one plane"
            };
            return Err(ParameterError::new(name, mount.position.z, expected));
        }
    }
    /// The stance must be wider than this share of its length [-].
    const THIN: f64 = 1e-6;
    let positions: Vec<Vec2> = mounts.iter().map(|mount| mount.position.xy()).collect();
    let from_first = positions.iter().map(|position| position - positions[0]);
    let longest = from_first
        .clone()
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
        .unwrap_or_default();
    let width = from_first.map(|arm| longest.perp(&arm).abs()).fold(0.0, f64::max)
        / longest.norm().max(f64::MIN_POSITIVE);
    if width > THIN * longest.norm() {
        Ok(())
    } else {
        let expected = "above zero: the wheels must not stand in one line";
        Err(ParameterError::new("the width of the stance [m]", width, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wheel::Wheel;

    /// The rover of [FourWheel], Tables 1 and 2, its centre of mass as derived there.
    #[test]
    fn composite_mass_properties_of_tables_1_and_2() {
        let inertia = Inertia { xx: 0.138, yy: 0.142, zz: 0.230 };
        let wheel_inertia = Inertia { xx: 0.001, yy: 0.001_54, zz: 0.001 };
        let wheel = Wheel { radius: 0.11, width: 0.08, grousers: None };
        let unit = WheelUnit { mass: 0.422, inertia: wheel_inertia, wheel, motor: None };
        let mounts = [(0.19, 0.24), (-0.17, 0.24), (-0.17, -0.24), (0.19, -0.24)].map(|(x, y)| {
            let (name, position) = (format!("{x},{y}"), Vec3::new(x, y, -0.06));
            Mount { name, joint: None, position, unit, steering: 0.0, steering_axis: None }
        });
        let rover =
            Rover::new(Body { mass: 5.24, inertia }, mounts.to_vec()).expect("a rover that stands");
        assert!((rover.mass() - 6.928).abs() < 1e-12);
        assert!((rover.yaw_inertia() - (0.230 + 0.004 + 0.422 * 0.3604)).abs() < 1e-12);
        assert!((rover.centre_of_mass().x - 0.0024).abs() < 5e-5);
        assert!(rover.centre_of_mass().y.abs() < 1e-15);
        assert!((rover.centre_height() - (0.11 + 0.0454)).abs() < 5e-5);
    }
}
