//! What a rover looks like: its wheels are those of its document, its body is a likeness.

use std::f64::consts::TAU;

use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::{Mount, Rover};
use grouser_core::wheel::Wheel;

use crate::motion::{Pose, WheelPose};

/// A box, parallel to the axes of the body frame [m].
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// The corner with the least coordinates.
    pub low: Vec3,
    /// The corner with the largest.
    pub high: Vec3,
}

impl Block {
    fn around(middle: Vec3, half: Vec3) -> Self {
        Self { low: middle - half, high: middle + half }
    }

    /// A corner: each of `of` chooses the low end or the high one.
    #[must_use]
    pub fn corner(&self, of: [bool; 3]) -> Vec3 {
        let at = |k: usize| if of[k] { self.high[k] } else { self.low[k] };
        Vec3::new(at(0), at(1), at(2))
    }
}

/// The parts of a rover's likeness, in the body frame.
#[derive(Clone, Debug)]
pub struct Likeness {
    /// The body.
    pub body: Block,
    /// What carries the head.
    pub mast: Block,
    /// A camera, towards the front.
    pub head: Block,
    /// For each wheel, where on the body its leg begins.
    pub legs: Vec<Vec3>,
    /// How far the rover reaches from its centre, seen from above [m].
    pub reach: f64,
}

impl Likeness {
    /// The body is the block of even density with the inertia of the rover's, held within the
    /// wheels. It has a camera on a mast, so that front and back differ.
    #[must_use]
    pub fn of(rover: &Rover) -> Self {
        let mounts = rover.mounts();
        let most = |of: &dyn Fn(&Mount) -> f64| mounts.iter().map(of).fold(0.0, f64::max);
        let wheel_radius = most(&Mount::shearing_radius);
        let length = most(&|mount| mount.position.x.abs());
        let track = most(&|mount| mount.position.y.abs());
        let inner = mounts
            .iter()
            .filter(|mount| mount.position.y.abs() > 0.3 * track)
            .map(|mount| mount.position.y.abs() - 0.5 * mount.unit.wheel.width)
            .fold(f64::INFINITY, f64::min);
        let axles = mounts.iter().map(|mount| mount.position.z).fold(f64::NEG_INFINITY, f64::max);
        let body = rover.body();
        let inertia = body.inertia;
        let side = |sum: f64| (6.0 * sum.max(0.0) / body.mass).sqrt();
        let [long, high] = [
            side(inertia.yy + inertia.zz - inertia.xx),
            side(inertia.xx + inertia.yy - inertia.zz),
        ];
        let half_length = (0.5 * long).clamp(0.6 * length, 1.1 * length + 0.3 * wheel_radius);
        let half_width = (0.82 * inner).max(0.2 * track);
        let height = high.clamp(0.8 * wheel_radius, 2.2 * wheel_radius);
        let bottom = (-0.5 * height).max(axles + 0.15 * wheel_radius);
        let body = Block {
            low: Vec3::new(-half_length, -half_width, bottom),
            high: Vec3::new(half_length, half_width, bottom + height),
        };
        let post = 0.09 * half_width;
        let rise = 0.9 * height + 0.4 * wheel_radius;
        let foot = Vec3::new(0.72 * half_length, 0.0, body.high.z);
        let mast = Block::around(
            foot + Vec3::new(0.0, 0.0, 0.5 * rise),
            Vec3::new(post, post, 0.5 * rise),
        );
        let head = Block::around(
            foot + Vec3::new(0.0, 0.0, rise),
            Vec3::new(1.4 * post, 3.6 * post, 1.9 * post),
        );
        let leg = |mount: &Mount| {
            let side = mount.position.y.signum() * half_width;
            let side = if mount.position.y.abs() > 0.3 * track { side } else { 0.0 };
            Vec3::new(0.35 * mount.position.x, side, bottom + 0.3 * height)
        };
        let reach = most(&|mount| mount.position.xy().norm() + mount.shearing_radius());
        Self { body, mast, head, legs: mounts.iter().map(leg).collect(), reach }
    }
}

/// Where a wheel is, in the slope frame.
#[derive(Clone, Copy, Debug)]
pub struct PlacedWheel {
    /// Its hub.
    pub hub: Vec3,
    /// Forward along the wheel; level.
    pub forward: Vec3,
    /// To its left, along the axle.
    pub left: Vec3,
}

impl PlacedWheel {
    /// * `lane`: where the run's origin is [m]
    #[must_use]
    pub fn of(mount: &Mount, wheel: &WheelPose, pose: &Pose, lane: Vec3) -> Self {
        let mount = &mount.at_angle(wheel.steering);
        let level = |vector: Vec2| {
            let turned = pose.slope_from_body(mount.body_from_wheel(vector));
            Vec3::new(turned.x, turned.y, 0.0)
        };
        let arm = pose.slope_from_body(mount.position.xy());
        let height = mount.shearing_radius() - wheel.sinkage;
        let hub = lane + Vec3::new(pose.centre.x + arm.x, pose.centre.y + arm.y, height);
        Self { hub, forward: level(Vec2::x()), left: level(Vec2::y()) }
    }

    /// A vector of the wheel frame, in the slope frame.
    #[must_use]
    pub fn slope_from_wheel(&self, vector: Vec3) -> Vec3 {
        self.forward * vector.x + self.left * vector.y + Vec3::new(0.0, 0.0, vector.z)
    }

    /// The point under the hub on the surface.
    #[must_use]
    pub fn foot(&self) -> Vec3 {
        Vec3::new(self.hub.x, self.hub.y, 0.0)
    }
}

/// What shows that a wheel turns: a spoke or a grouser, a block that turns with it.
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// Where it is around the axle, from straight up towards the front [rad].
    pub angle: f64,
    /// Its ends' distances from the axle [m].
    pub inner: f64,
    /// The other end's [m].
    pub outer: f64,
    /// Half of its size around the axle [m].
    pub half_thick: f64,
    /// Half of its size along the axle [m].
    pub half_wide: f64,
}

/// The spokes and grousers of a wheel. Height and number of the grousers are those of its document;
/// their thickness and the spokes are a likeness.
#[must_use]
pub fn bars_of(wheel: &Wheel) -> Vec<Bar> {
    const SPOKES: u32 = 5;
    let (radius, side) = (wheel.radius, 0.5 * wheel.width);
    let around = |place: u32, count: u32| TAU * f64::from(place) / f64::from(count);
    let spoke = |place: u32| Bar {
        angle: around(place, SPOKES),
        inner: 0.0,
        outer: 0.85 * radius,
        half_thick: 0.06 * radius,
        half_wide: 1.03 * side,
    };
    let mut bars: Vec<Bar> = (0..SPOKES).map(spoke).collect();
    if let Some(grousers) = wheel.grousers {
        let thickest = 0.1 * radius * TAU / f64::from(grousers.count);
        bars.extend((0..grousers.count).map(|place| Bar {
            angle: around(place, grousers.count),
            inner: radius,
            outer: wheel.shearing_radius(),
            half_thick: (0.15 * grousers.height).min(thickest),
            half_wide: side,
        }));
    }
    bars
}
