//! Which links carry a wheel, and where its hub is when their joints turn.

use nalgebra::{Matrix3, Rotation3};

use super::parts::Mount;
use super::state::rotation;
use super::suspension::{End, Joints, Suspension};
use crate::error::{ParameterError, finite};
use crate::units::{Vec2, Vec3};

/// A joint between the body and a wheel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hinge {
    /// Which of the [`Joints`]: 0 for the rockers, 1 and 2 for the left and the right bogie.
    pub(super) joint: usize,
    /// By how much its front rises for a positive angle, 1 or −1.
    pub(super) sense: f64,
    /// A point of its axis beside the hub, in the body frame [m].
    pub(super) pivot: Vec3,
}

/// A hub, and the joints that carry it, where the joints have some angles.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    /// In the body frame [m].
    pub(super) hub: Vec3,
    /// Direction of the axle, to the left, in the body frame.
    pub(super) axle: Vec3,
    /// From the body out: none on a rigid rover.
    pub(super) hinges: Vec<Hinge>,
}

impl Suspension {
    /// Whether a wheel is on a bogie.
    ///
    /// * `mounts`: all of the rover's
    #[must_use]
    pub fn is_on_bogie(&self, mount: &Mount, mounts: &[Mount]) -> bool {
        let Some(bogie) = self.bogie else { return false };
        let is_beyond = |other: &&Mount| {
            is_left(other) == is_left(mount)
                && match bogie.end {
                    End::Front => other.position.x > mount.position.x,
                    End::Rear => other.position.x < mount.position.x,
                }
        };
        mounts.iter().filter(is_beyond).count() < 2
    }

    /// Checks that the suspension can carry these wheels.
    ///
    /// # Errors
    /// [`ParameterError`] for the first that is wrong.
    pub fn check(&self, mounts: &[Mount]) -> Result<(), ParameterError> {
        let pivots = std::iter::once(("rocker", self.pivot));
        for (link, pivot) in pivots.chain(self.bogie.map(|bogie| ("bogie", bogie.pivot))) {
            for (axis, value) in ["x", "z"].iter().zip(pivot.iter()) {
                finite(&format!("pivot {axis} of the {link} [m]"), *value)?;
            }
        }
        for (side, is_side) in [("left", true), ("right", false)] {
            let count = mounts.iter().filter(|mount| is_left(mount) == is_side).count();
            let (wanted, expected) = match self.bogie {
                None => (2, "two, as rockers without bogies have"),
                Some(_) => (3, "three, as rockers with bogies have"),
            };
            if count != wanted {
                let name = format!("the number of wheels on the {side}");
                return Err(ParameterError::new(name, count as f64, expected));
            }
            let wheels = mounts.iter().filter(|mount| is_left(mount) == is_side);
            self.check_levers(&wheels.collect::<Vec<_>>(), mounts)?;
        }
        mounts.iter().try_for_each(|mount| {
            let name = format!("position y of wheel {} [m]", mount.name);
            let expected = "to the left or the right of the middle, where the rockers are";
            if mount.position.y == 0.0 {
                Err(ParameterError::new(name, mount.position.y, expected))
            } else {
                Ok(())
            }
        })
    }

    /// Checks that each link reaches from what it carries on one side of its pivot to what it
    /// carries on the other.
    ///
    /// * `wheels`: of one side
    /// * `mounts`: all
    fn check_levers(&self, wheels: &[&Mount], mounts: &[Mount]) -> Result<(), ParameterError> {
        let (on_bogie, on_rocker): (Vec<&Mount>, Vec<&Mount>) =
            wheels.iter().copied().partition(|mount| self.is_on_bogie(mount, mounts));
        let seen = |mounts: &[&Mount]| -> Vec<Vec2> {
            mounts.iter().map(|mount| Vec2::new(mount.position.x, mount.position.z)).collect()
        };
        let mut carried = seen(&on_rocker);
        if let Some(bogie) = self.bogie {
            check_lever("bogie", bogie.pivot, &seen(&on_bogie), "between its two wheels")?;
            carried.push(bogie.pivot);
            check_lever(
                "rocker",
                self.pivot,
                &carried,
                "between its wheel and the pivot of its bogie",
            )
        } else {
            check_lever("rocker", self.pivot, &carried, "between its two wheels")
        }
    }

    /// The joints that carry a wheel, where they have some angles.
    fn carry(&self, mount: &Mount, mounts: &[Mount], joints: &Joints) -> Carried {
        let beside = |pivot: Vec2| Vec3::new(pivot.x, mount.position.y, pivot.y);
        let (side, sense) = if is_left(mount) { (0, 1.0) } else { (1, -1.0) };
        let rocker = Hinge { joint: 0, sense, pivot: beside(self.pivot) };
        let (mut hub, mut turned) = (mount.position, sense * joints.rocker);
        let mut hinges = vec![rocker];
        if let Some(bogie) = self.bogie.filter(|_| self.is_on_bogie(mount, mounts)) {
            let (pivot, angle) = (beside(bogie.pivot), joints.bogies[side]);
            hub = pivot + front_up(angle) * (hub - pivot);
            turned += angle;
            let pivot = rocker.pivot + front_up(sense * joints.rocker) * (pivot - rocker.pivot);
            hinges.push(Hinge { joint: 1 + side, sense: 1.0, pivot });
        }
        hub = rocker.pivot + front_up(sense * joints.rocker) * (hub - rocker.pivot);
        Carried { hub, axle: front_up(turned) * axle(mount), hinges }
    }
}

/// Checks that a pivot is between the two points that its link carries, and no further above or
/// below them than they are apart.
///
/// * `carried`: two points, (x, z) [m]
/// * `between`: where the pivot has to be
fn check_lever(
    link: &str,
    pivot: Vec2,
    carried: &[Vec2],
    between: &'static str,
) -> Result<(), ParameterError> {
    let span = |axis: usize| {
        let of = carried.iter().map(move |at| at[axis]);
        of.fold((f64::INFINITY, -f64::INFINITY), |(low, high), it| (low.min(it), high.max(it)))
    };
    let ((rear, front), (low, high)) = (span(0), span(1));
    if pivot.x <= rear || pivot.x >= front {
        return Err(ParameterError::new(format!("pivot x of the {link} [m]"), pivot.x, between));
    }
    let reach = front - rear;
    if pivot.y < low - reach || pivot.y > high + reach {
        let expected = "no further above or below what it carries than that is apart";
        return Err(ParameterError::new(format!("pivot z of the {link} [m]"), pivot.y, expected));
    }
    Ok(())
}

impl Carried {
    /// A wheel of a rover, whatever joins it to the body.
    pub(super) fn of(
        suspension: Option<&Suspension>,
        mount: &Mount,
        mounts: &[Mount],
        joints: &Joints,
    ) -> Self {
        match suspension {
            Some(suspension) => suspension.carry(mount, mounts, joints),
            None => Self { hub: mount.position, axle: axle(mount), hinges: Vec::new() },
        }
    }
}

fn is_left(mount: &Mount) -> bool {
    mount.position.y > 0.0
}

/// Direction of a wheel's axle, to the left, in the frame of the link that carries it.
fn axle(mount: &Mount) -> Vec3 {
    let left = mount.body_from_wheel(Vec2::y());
    Vec3::new(left.x, left.y, 0.0)
}

/// The rotation about the axis across the body that lifts its front [rad].
fn front_up(angle: f64) -> Rotation3<f64> {
    let turn = rotation(angle);
    let (cos, sin) = (turn[(0, 0)], turn[(1, 0)]);
    Rotation3::from_matrix_unchecked(Matrix3::new(
        cos, 0.0, -sin, //
        0.0, 1.0, 0.0, //
        sin, 0.0, cos,
    ))
}
