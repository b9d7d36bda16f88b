//! Frames and their names, and how they lie in each other.
//!
//! `world` is level, `slope` lies in it turned about x by the inclination, `body` moves in that. On
//! ground with heights `world` has its origin on the ground where the run starts, `body` moves in
//! it, and `map` has the map's coordinates. Each wheel has two: its own, at its hub, turned by its
//! steering, which does not roll; and the rim's, which rolls in it.

use grouser_core::elementary::wide;
use grouser_core::units::Vec3;
use grouser_core::vehicle::Mount;
use grouser_draw::motion::{Pose as RoverPose, StandingWheel, quaternion_to};

use crate::foxglove::{FrameTransform, Pose, Quaternion, Timestamp, Vector3};

/// The level frame, z up.
pub(crate) const WORLD: &str = "world";
/// The slope's: x along the contour, y uphill, z out of the ground.
pub(crate) const SLOPE: &str = "slope";
/// The frame of ground with heights: x east, y north, z up, from the map's origin.
pub(crate) const MAP: &str = "map";
/// The body's: x forward, y left.
pub(crate) const BODY: &str = "body";

/// The names of a wheel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct WheelName {
    /// In the document.
    pub(crate) own: String,
    /// Its frame, and the end of its topic.
    pub(crate) frame: String,
    /// The frame of its rim.
    pub(crate) rim: String,
}

impl WheelName {
    /// The names of all wheels. Frames and topics have letters, digits, `_` and `-`, which no
    /// reader takes for something else, and no two are alike.
    pub(crate) fn all(mounts: &[Mount]) -> Vec<Self> {
        let mut taken: Vec<String> = [WORLD, SLOPE, MAP, BODY].map(String::from).into();
        let mut all = Vec::new();
        for mount in mounts {
            let is_plain = |c: &char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
            let plain: String =
                mount.name.chars().map(|c| if is_plain(&c) { c } else { '_' }).collect();
            let numbered = (2..).map(|number| format!("{plain}-{number}"));
            let of = |frame: String| Self {
                own: mount.name.clone(),
                rim: format!("{frame}_rim"),
                frame,
            };
            let names = std::iter::once(plain.clone())
                .chain(numbered)
                .map(of)
                .find(|it| !taken.contains(&it.frame) && !taken.contains(&it.rim));
            if let Some(name) = names {
                taken.extend([name.frame.clone(), name.rim.clone()]);
                all.push(name);
            }
        }
        all
    }
}

impl Quaternion {
    /// No rotation.
    pub(crate) const NONE: Self = Self { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };

    /// A rotation about an axis of the coordinates.
    ///
    /// * `axis`: a unit vector
    /// * `angle`: by the right-hand rule [rad]
    pub(crate) fn about(axis: Vec3, angle: f64) -> Self {
        let (sin, cos) = wide::sin_cos(0.5 * angle);
        Self { x: sin * axis.x, y: sin * axis.y, z: sin * axis.z, w: cos }
    }

    /// The rotation that takes the coordinates' axes into these.
    ///
    /// * `axes`: unit vectors, at right angles
    pub(crate) fn to_axes(axes: [Vec3; 3]) -> Self {
        let [x, y, z, w] = quaternion_to(axes);
        Self { x, y, z, w }
    }

    /// A rotation that takes x into a direction.
    ///
    /// * `direction`: a unit vector
    pub(crate) fn to(direction: Vec3) -> Self {
        let axis = Vec3::x().cross(&direction);
        let w = 1.0 + direction.x;
        let size = (axis.norm_squared() + w * w).sqrt();
        // Straight back, every axis across x will do.
        if size < 1e-9 {
            return Self::about(Vec3::z(), std::f64::consts::PI);
        }
        Self { x: axis.x / size, y: axis.y / size, z: axis.z / size, w: w / size }
    }
}

impl Pose {
    /// A place that is not turned.
    pub(crate) fn at(position: Vec3) -> Self {
        Self { position: position.into(), orientation: Quaternion::NONE }
    }
}

/// A frame in its parent.
fn transform(
    time: u64,
    [parent, child]: [&str; 2],
    translation: Vec3,
    rotation: Quaternion,
) -> FrameTransform {
    FrameTransform {
        timestamp: Timestamp::of(time),
        parent_frame_id: parent.to_owned(),
        child_frame_id: child.to_owned(),
        translation: Vector3::from(translation),
        rotation,
    }
}

/// The slope in the world.
///
/// * `slope`: its inclination [rad]
pub(crate) fn slope_in_world(slope: f64) -> FrameTransform {
    transform(0, [WORLD, SLOPE], Vec3::zeros(), Quaternion::about(Vec3::x(), slope))
}

/// The map in the world.
///
/// * `start`: where the run starts, in the map's coordinates [m]
pub(crate) fn map_in_world(start: Vec3) -> FrameTransform {
    transform(0, [WORLD, MAP], -start, Quaternion::NONE)
}

/// The body and its wheels.
///
/// * `time`: in nanoseconds
/// * `base`: of ground with heights, that where the run starts [m]
pub(crate) fn of_rover(
    time: u64,
    pose: &RoverPose,
    mounts: &[Mount],
    names: &[WheelName],
    base: Option<f64>,
) -> Vec<FrameTransform> {
    let body = if let Some(base) = base {
        let centre = pose.centre - Vec3::new(0.0, 0.0, base);
        transform(time, [WORLD, BODY], centre, Quaternion::to_axes(pose.axes()))
    } else {
        let yaw = Quaternion::about(Vec3::z(), pose.yaw);
        transform(time, [SLOPE, BODY], pose.centre, yaw)
    };
    let mut all = vec![body];
    for (index, (mount, name)) in mounts.iter().zip(names).enumerate() {
        let hub = pose.hub_in_body(mount, index);
        let wheel = &pose.wheels[index];
        let steering = match wheel.standing {
            Some(StandingWheel { forward, axle, .. }) => {
                let upright = forward.cross(&axle);
                Quaternion::to_axes([forward, axle, upright])
            }
            None => Quaternion::about(Vec3::z(), wheel.steering),
        };
        all.push(transform(time, [BODY, &name.frame], hub, steering));
        // Rolling forward is turning about the axle, to the left, by the right-hand rule.
        let rolling = Quaternion::about(Vec3::y(), pose.wheels[index].turned);
        all.push(transform(time, [&name.frame, &name.rim], Vec3::zeros(), rolling));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v' = v + 2 w (u × v) + 2 u × (u × v), with q = (u, w).
    fn turned(q: &Quaternion, v: Vec3) -> Vec3 {
        let u = Vec3::new(q.x, q.y, q.z);
        let across = u.cross(&v);
        v + 2.0 * q.w * across + 2.0 * u.cross(&across)
    }

    /// Axes turned by three angles one after the other.
    fn turned_axes([roll, pitch, yaw]: [f64; 3]) -> [Vec3; 3] {
        let about = |axis: Vec3, angle: f64| Quaternion::about(axis, angle);
        let turns = [about(Vec3::x(), roll), about(Vec3::y(), pitch), about(Vec3::z(), yaw)];
        [Vec3::x(), Vec3::y(), Vec3::z()]
            .map(|axis| turns.iter().fold(axis, |vector, turn| turned(turn, vector)))
    }

    #[test]
    fn rotations_take_vectors_where_they_should() {
        let down = turned(&Quaternion::about(Vec3::y(), 0.5 * std::f64::consts::PI), Vec3::x());
        assert!((down + Vec3::z()).norm() < 1e-15, "rolling forward, what was ahead goes down");
        for [roll, pitch, yaw] in
            [[0.0, 0.0, 0.0], [0.3, -0.2, 3.0], [-0.4, 1.2, -2.0], [3.1, 0.1, 0.5]]
        {
            let turn = turned_axes([roll, pitch, yaw]);
            let q = Quaternion::to_axes(turn);
            for (axis, to) in [Vec3::x(), Vec3::y(), Vec3::z()].into_iter().zip(turn) {
                assert!((turned(&q, axis) - to).norm() < 1e-14, "{roll} {pitch} {yaw}");
            }
        }
        for direction in [Vec3::x(), -Vec3::x(), Vec3::z(), Vec3::new(0.6, 0.0, -0.8)] {
            assert!((turned(&Quaternion::to(direction), Vec3::x()) - direction).norm() < 1e-15);
        }
    }
}
