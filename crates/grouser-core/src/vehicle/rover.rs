//! A rover: a body and three or more equal wheels, rigidly joined ([FourWheel], Tables 1 and 2).

use crate::error::{ParameterError, finite, positive};
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

/// A wheel with its motor; every wheel of a rover is the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelUnit {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about its hub.
    pub inertia: Inertia,
    /// Geometry.
    pub wheel: Wheel,
}

/// Where a wheel sits.
#[derive(Clone, Debug, PartialEq)]
pub struct Mount {
    /// The wheel's name, such as `front-left`.
    pub name: String,
    /// Its hub, in the body frame [m].
    pub position: Vec3,
}

/// What a rover is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct RoverParts {
    /// The body, without its wheels.
    pub body: Body,
    /// A wheel with its motor; all are the same.
    pub wheel_unit: WheelUnit,
    /// Where the wheels sit.
    pub mounts: Vec<Mount>,
}

/// A rover that can stand and be moved: made by [`Rover::new`], then unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Rover {
    parts: RoverParts,
    mass: f64,
    first_moment: Vec2,
    yaw_inertia: f64,
    centre_height: f64,
    load_arms: Vec<Vec2>,
}

/// Hubs may differ in height by this much [m] and still share one contact plane.
const LEVEL: f64 = 1e-9;

impl Rover {
    /// A rover from its parts.
    ///
    /// # Errors
    /// [`ParameterError`] if a mass or an inertia is not positive, if there are fewer than three
    /// wheels, if they stand in one line, or if their hubs differ in height.
    pub fn new(
        body: Body,
        wheel_unit: WheelUnit,
        mounts: Vec<Mount>,
    ) -> Result<Self, ParameterError> {
        Self::draft(RoverParts { body, wheel_unit, mounts }).checked()
    }

    /// A rover of which nothing but the parts is known: to be filled in, and then
    /// [`checked`](Self::checked).
    #[must_use]
    pub const fn draft(parts: RoverParts) -> Self {
        Self {
            parts,
            mass: 0.0,
            first_moment: Vec2::new(0.0, 0.0),
            yaw_inertia: 0.0,
            centre_height: 0.0,
            load_arms: Vec::new(),
        }
    }

    /// The parts, to be changed; the rover has to be [`checked`](Self::checked) after that.
    pub fn parts_mut(&mut self) -> &mut RoverParts {
        &mut self.parts
    }

    /// The rover that its parts make.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn checked(self) -> Result<Self, ParameterError> {
        let parts = self.parts;
        let RoverParts { body, wheel_unit, ref mounts } = parts;
        positive("body mass [kg]", body.mass)?;
        positive("wheel unit mass [kg]", wheel_unit.mass)?;
        for (part, inertia) in [("body", body.inertia), ("wheel unit", wheel_unit.inertia)] {
            for (axis, value) in [("xx", inertia.xx), ("yy", inertia.yy), ("zz", inertia.zz)] {
                positive(&format!("{part} inertia {axis} [kg·m²]"), value)?;
            }
        }
        wheel_unit.wheel.check()?;
        check_stance(mounts)?;

        let count = mounts.len() as f64;
        let mass = body.mass + count * wheel_unit.mass;
        let sum: Vec3 = mounts.iter().map(|mount| mount.position).sum();
        let centre = sum * (wheel_unit.mass / mass);
        let plane = mounts.iter().map(|mount| mount.position.xy());
        let spread: f64 = plane.clone().map(|position| position.norm_squared()).sum();
        Ok(Self {
            mass,
            first_moment: sum.xy() * wheel_unit.mass,
            yaw_inertia: body.inertia.zz + count * wheel_unit.inertia.zz + wheel_unit.mass * spread,
            centre_height: wheel_unit.wheel.shearing_radius() + centre.z - mounts[0].position.z,
            load_arms: plane.map(|position| position - centre.xy()).collect(),
            parts,
        })
    }

    /// The same rover seen in a mirror: left and right changed. A traverse with the uphill side on
    /// the right is that of the mirrored rover with the uphill side on the left.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut mirrored = self.clone();
        for mount in &mut mirrored.parts.mounts {
            mount.position.y = -mount.position.y;
        }
        for arm in &mut mirrored.load_arms {
            arm.y = -arm.y;
        }
        mirrored.first_moment.y = -mirrored.first_moment.y;
        mirrored
    }

    /// Whether the rover is its own mirror image: then headings hold either way.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        /// Hubs may be off by this much [m]: a tenth of a millimetre turns no rover.
        const SAME: f64 = 1e-4;
        self.parts.mounts.iter().all(|mount| {
            let image = Vec2::new(mount.position.x, -mount.position.y);
            self.parts.mounts.iter().any(|other| (other.position.xy() - image).amax() <= SAME)
        })
    }

    /// The body.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.parts.body
    }

    /// The wheel unit.
    #[must_use]
    pub fn wheel_unit(&self) -> &WheelUnit {
        &self.parts.wheel_unit
    }

    /// The wheel's geometry.
    #[must_use]
    pub fn wheel(&self) -> &Wheel {
        &self.parts.wheel_unit.wheel
    }

    /// The mounts, in the order of every per-wheel list.
    #[must_use]
    pub fn mounts(&self) -> &[Mount] {
        &self.parts.mounts
    }

    /// How many wheels there are.
    #[must_use]
    pub fn wheel_count(&self) -> usize {
        self.parts.mounts.len()
    }

    /// Mass of body and wheels, *m* [kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// First moment of the wheels about the body's centre of mass, *S* = m_w Σ d, in the body
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
        if (mount.position.z - mounts[0].position.z).abs() > LEVEL {
            let name = format!("height z of wheel {} [m]", mount.name);
            let expected = "that of the other wheels: all stand on one plane";
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

    /// The rover of [FourWheel], Tables 1 and 2, its centre of mass as derived there.
    #[test]
    fn composite_mass_properties_of_tables_1_and_2() {
        let inertia = Inertia { xx: 0.138, yy: 0.142, zz: 0.230 };
        let wheel_inertia = Inertia { xx: 0.001, yy: 0.001_54, zz: 0.001 };
        let wheel = Wheel { radius: 0.11, width: 0.08, grousers: None };
        let mounts = [(0.19, 0.24), (-0.17, 0.24), (-0.17, -0.24), (0.19, -0.24)]
            .map(|(x, y)| Mount { name: format!("{x},{y}"), position: Vec3::new(x, y, -0.06) });
        let rover = Rover::new(
            Body { mass: 5.24, inertia },
            WheelUnit { mass: 0.422, inertia: wheel_inertia, wheel },
            mounts.to_vec(),
        )
        .expect("a rover that stands");
        assert!((rover.mass() - 6.928).abs() < 1e-12);
        assert!((rover.yaw_inertia() - (0.230 + 0.004 + 0.422 * 0.3604)).abs() < 1e-12);
        assert!((rover.centre_of_mass().x - 0.0024).abs() < 5e-5);
        assert!(rover.centre_of_mass().y.abs() < 1e-15);
        assert!((rover.centre_height() - (0.11 + 0.0454)).abs() < 5e-5);
    }
}
