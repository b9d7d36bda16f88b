//! How far the underside of a rover is over uneven ground: its belly clearance.
//!
//! The underside is a flat plate fixed to the body, as long and as wide as the rectangle around the
//! wheels' hubs, so high over level hard ground as the rover's document says. It is compared with
//! the ground at nine times nine points, an eighth of its length and of its width apart, its
//! corners and edges included:
//!
//! ```text
//! c = min_ij (P_ij · e_up − z(P_ij)) (e_z · e_up)
//! ```
//!
//! with a point of the plate *P*, the height of the ground below it *z*, and the body's axis *e_z*:
//! the height over the ground times the cosine of the body's tilt. Where the ground is a plane this
//! is the distance from it, on any slope; it is zero where the plate touches, whatever the ground's
//! shape. Ground narrower than the points' spacing may pass between them.
//!
//! Source: ours.

use super::posture::Posture;
use super::rover::Rover;
use crate::terrain::{Ground, Terrain};
use crate::units::{Vec2, Vec3};

/// How many points lie along the plate, and as many across it.
pub const POINTS: u32 = 9;

/// The point of a rover's underside that is nearest to the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BellyPoint {
    /// How far it is over the ground [m]; negative below its surface.
    pub clearance: f64,
    /// Where it is, in the coordinates of the ground [m].
    pub place: Vec2,
}

/// The flat underside of a rover, in the body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Underside {
    /// The corner at the right of the rear [m].
    rear_right: Vec3,
    /// Its length and its width [m].
    size: Vec2,
}

impl Underside {
    /// Returns the underside of a rover whose belly clearance is known. Wheels that are steered do
    /// not move it.
    #[must_use]
    pub fn of(rover: &Rover) -> Option<Self> {
        let clearance = rover.parts().belly_clearance?;
        let first = rover.mounts().first()?;
        let lowest = first.position.z - first.shearing_radius();
        let hubs = rover.parts().mounts.iter().map(|mount| mount.position.xy());
        let (low, high) = hubs.fold(
            (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)),
            |(low, high), hub| (low.inf(&hub), high.sup(&hub)),
        );
        let rear_right = Vec3::new(low.x, low.y, lowest + clearance);
        Some(Self { rear_right, size: high - low })
    }

    /// Its points, from the rear to the front and from the right to the left.
    pub fn points(self) -> impl Iterator<Item = Vec3> {
        let last = f64::from(POINTS - 1);
        let Self { rear_right, size } = self;
        let point = move |along: u32, aside: u32| {
            let share = Vec2::new(f64::from(along), f64::from(aside)) / last;
            rear_right + Vec3::new(share.x * size.x, share.y * size.y, 0.0)
        };
        (0..POINTS).flat_map(move |along| (0..POINTS).map(move |aside| point(along, aside)))
    }

    /// Its point that is nearest to the ground.
    ///
    /// * `posture`: of the rover, with its wheels sunk, seen from the start on the ground
    #[must_use]
    pub fn nearest(self, posture: &Posture, ground: &Ground) -> BellyPoint {
        let body = posture.ground_from_body;
        let level = (body * Vec3::z()).z;
        let each = self.points().map(|point| {
            let point = posture.place + body * point;
            let height = point.z - ground.height_from(Vec2::zeros(), point.xy());
            BellyPoint { clearance: level * height, place: ground.start + point.xy() }
        });
        let none =
            BellyPoint { clearance: f64::INFINITY, place: ground.start + posture.place.xy() };
        each.fold(none, |least, one| if one.clearance < least.clearance { one } else { least })
    }
}
