//! Poses of the rover's body as logs have them, and what telemetry says of them.
//!
//! Grouser's body has x forward, y to the left and z up; roll is positive with the right side down,
//! pitch with the nose up, yaw to the left. ROS has the same axes (REP 103), where a positive
//! rotation about y takes the nose *down*; what follows NED has y to the right and z down, where a
//! positive rotation about z is to the right.

use std::collections::BTreeMap;

use grouser_core::units::Vec3;
use grouser_io::telemetry_mapping::Axes;
use serde_json::Value;

/// A rotation, as a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation {
    w: f64,
    v: Vec3,
}

impl Rotation {
    pub(crate) const NONE: Self = Self { w: 1.0, v: Vec3::new(0.0, 0.0, 0.0) };

    /// Reads `x`, `y`, `z` and `w`; nothing for what is no unit quaternion, but for rounding.
    pub(crate) fn read(value: &Value) -> Option<Self> {
        /// How far its size may be from one.
        const ROUNDING: f64 = 0.05;
        let part = |name: &str| value.get(name)?.as_f64();
        let (w, v) = (part("w")?, Vec3::new(part("x")?, part("y")?, part("z")?));
        let size = (w * w + v.norm_squared()).sqrt();
        ((size - 1.0).abs() <= ROUNDING).then(|| Self { w: w / size, v: v / size })
    }

    /// Whether it is one about z alone, exactly.
    pub(crate) fn is_about_vertical(self) -> bool {
        self.v.x == 0.0 && self.v.y == 0.0
    }

    pub(crate) fn inverse(self) -> Self {
        Self { w: self.w, v: -self.v }
    }

    /// This rotation after another.
    pub(crate) fn after(self, other: Self) -> Self {
        let w = self.w * other.w - self.v.dot(&other.v);
        Self { w, v: self.w * other.v + other.w * self.v + self.v.cross(&other.v) }
    }

    /// A vector, turned.
    pub(crate) fn turn(self, vector: Vec3) -> Vec3 {
        let across = self.v.cross(&vector);
        vector + 2.0 * self.w * across + 2.0 * self.v.cross(&across)
    }

    /// Rotations about z, then y, then x that make it, each by the right-hand rule, as [x, y, z]
    /// [rad].
    pub(crate) fn about_axes(self) -> [f64; 3] {
        let (x, y) = (self.turn(Vec3::x()), self.turn(Vec3::y()));
        let z = x.cross(&y);
        [y.z.atan2(z.z), (-x.z).clamp(-1.0, 1.0).asin(), x.y.atan2(x.x)]
    }
}

/// Where the body is and how it is turned, in whatever frame and axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub(crate) position: Option<Vec3>,
    /// Into the frame from the body.
    pub(crate) rotation: Rotation,
}

impl Pose {
    /// Reads a pose (`position`, `orientation`) or a transform (`translation`, `rotation`).
    pub(crate) fn read(value: &Value) -> Option<Self> {
        let any = |names: [&str; 2]| names.into_iter().find_map(|name| value.get(name));
        Self::of_parts(any(["position", "translation"])?, any(["orientation", "rotation"])?)
    }

    /// Reads a position and a quaternion.
    pub(crate) fn of_parts(position: &Value, orientation: &Value) -> Option<Self> {
        let (position, rotation) = (vector(position)?, Rotation::read(orientation)?);
        Some(Self { position: Some(position), rotation })
    }

    /// A pose in a frame that is itself in another.
    fn within(self, parent: Self) -> Self {
        let turned = self.position.map(|position| parent.rotation.turn(position));
        let position = turned.zip(parent.position).map(|(own, parent)| own + parent);
        Self { position, rotation: parent.rotation.after(self.rotation) }
    }

    /// Roll, pitch and yaw in Grouser's signs [rad].
    pub(crate) fn attitude(&self, axes: Axes) -> [f64; 3] {
        let [about_x, about_y, about_z] = self.rotation.about_axes();
        match axes {
            Axes::Ros | Axes::Grouser => [about_x, -about_y, about_z],
            Axes::Ned => [about_x, about_y, -about_z],
        }
    }

    /// Way forward and to the left [m] and rotation to the left [rad] since an earlier pose: in the
    /// axes that the body has half way between the two.
    pub(crate) fn since(&self, earlier: &Self, axes: Axes) -> [Option<f64>; 3] {
        let back = earlier.rotation.inverse();
        let turned = back.after(self.rotation).about_axes()[2];
        let way = self.position.zip(earlier.position).map(|(now, then)| {
            let way = back.turn(now - then);
            let (sin, cos) = (0.5 * turned).sin_cos();
            [cos * way.x + sin * way.y, cos * way.y - sin * way.x]
        });
        let to_left = if axes == Axes::Ned { -1.0 } else { 1.0 };
        [way.map(|it| it[0]), way.map(|it| to_left * it[1]), Some(to_left * turned)]
    }
}

fn vector(value: &Value) -> Option<Vec3> {
    let part = |name: &str| value.get(name)?.as_f64();
    Some(Vec3::new(part("x")?, part("y")?, part("z").unwrap_or(0.0)))
}

/// Frames in each other, as transforms say it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames(BTreeMap<String, (String, Pose)>);

/// Frames that are kept, and that lie in each other, at most.
const MOST_FRAMES: usize = 1000;

impl Frames {
    /// Takes in the transforms of a message of ROS (`tf2_msgs/TFMessage`) or Foxglove
    /// (`foxglove.FrameTransform`, `foxglove.FrameTransforms`); the names of the frames that moved,
    /// each with its transform.
    pub(crate) fn take<'v>(&mut self, tree: &'v Value) -> Vec<(&'v str, &'v Value)> {
        let list = tree.get("transforms").and_then(Value::as_array);
        let all = list.map_or(std::slice::from_ref(tree), Vec::as_slice);
        let mut moved = Vec::new();
        for transform in all {
            let name = |path: &str| frame_name(transform, path);
            let child = name("child_frame_id");
            let parent = name("parent_frame_id").or_else(|| name("header.frame_id"));
            let pose = Pose::read(transform.get("transform").unwrap_or(transform));
            let (Some(child), Some(parent), Some(pose)) = (child, parent, pose) else { continue };
            if self.0.len() < MOST_FRAMES || self.0.contains_key(child) {
                self.0.insert(child.to_owned(), (parent.to_owned(), pose));
                moved.push((child, transform));
            }
        }
        moved
    }

    /// The pose of a frame in another, if transforms lead from the one to the other.
    pub(crate) fn pose(&self, child: &str, parent: &str) -> Option<Pose> {
        let (mut at, mut pose) =
            (child, Pose { position: Some(Vec3::zeros()), rotation: Rotation::NONE });
        for _ in 0..MOST_FRAMES {
            if at == parent {
                return Some(pose);
            }
            let (next, own) = self.0.get(at)?;
            pose = pose.within(*own);
            at = next;
        }
        None
    }

    /// Whether a frame lies between the two, or is the lower of them.
    pub(crate) fn is_between(&self, frame: &str, child: &str, parent: &str) -> bool {
        let mut at = child;
        for _ in 0..MOST_FRAMES {
            if at == frame {
                return true;
            }
            match self.0.get(at) {
                Some((next, _)) if at != parent => at = next,
                _ => return false,
            }
        }
        false
    }
}

/// The name of a frame; those of ROS 1 may begin with a stroke.
fn frame_name<'v>(transform: &'v Value, path: &str) -> Option<&'v str> {
    let value = path.split('.').try_fold(transform, |value, name| value.get(name))?;
    value.as_str().map(|name| name.trim_start_matches('/'))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A rotation by the right-hand rule, as ROS writes it.
    fn about(axis: &str, angle: f64) -> Value {
        let (sin, cos) = (0.5 * angle).sin_cos();
        let mut quaternion = json!({"x": 0.0, "y": 0.0, "z": 0.0, "w": cos});
        quaternion[axis] = sin.into();
        quaternion
    }

    fn attitude(quaternion: &Value, axes: Axes) -> [f64; 3] {
        let rotation = Rotation::read(quaternion).unwrap();
        Pose { position: None, rotation }.attitude(axes)
    }

    fn check(found: [f64; 3], expected: [f64; 3]) {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
    }

    #[test]
    fn signs_of_ros_and_ned_become_ours() {
        // By the right-hand rule: about x forward the right side goes down, about y to the left the
        // nose.
        check(attitude(&about("x", 0.1), Axes::Ros), [0.1, 0.0, 0.0]);
        check(attitude(&about("y", 0.1), Axes::Ros), [0.0, -0.1, 0.0]);
        check(attitude(&about("z", 0.1), Axes::Ros), [0.0, 0.0, 0.1]);
        // About y to the right the nose goes up, about z down it goes to the right.
        check(attitude(&about("x", 0.1), Axes::Ned), [0.1, 0.0, 0.0]);
        check(attitude(&about("y", 0.1), Axes::Ned), [0.0, 0.1, 0.0]);
        check(attitude(&about("z", 0.1), Axes::Ned), [0.0, 0.0, -0.1]);
    }

    /// Along an arc to the left the way is straight ahead of the middle.
    #[test]
    fn ways_are_in_the_axes_half_way() {
        let pose = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let position = json!({"x": 2.0 * sin, "y": 2.0 * (1.0 - cos), "z": 0.3});
            Pose::read(&json!({"position": position, "orientation": about("z", angle)})).unwrap()
        };
        let [forward, leftward, turned] =
            pose(1.2).since(&pose(1.0), Axes::Ros).map(Option::unwrap);
        check([forward, leftward, turned], [4.0 * 0.1_f64.sin(), 0.0, 0.2]);
    }

    #[test]
    fn frames_lead_from_one_to_the_other() {
        let mut frames = Frames::default();
        let at = |x: f64, rotation: Value| json!({"translation": {"x": x, "y": 0.0, "z": 0.0}, "rotation": rotation});
        frames.take(&json!({"transforms": [
            {"parent_frame_id": "world", "child_frame_id": "slope",
             "translation": {"x": 1.0, "y": 0.0, "z": 0.0}, "rotation": about("x", 0.2)},
            {"header": {"frame_id": "/slope"}, "child_frame_id": "body", "transform": at(2.0, about("z", 0.5))},
        ]}));
        let pose = frames.pose("body", "world").unwrap();
        assert!((pose.position.unwrap() - Vec3::new(3.0, 0.0, 0.0)).norm() < 1e-12);
        let [roll, pitch] = grouser_core::vehicle::roll_and_pitch(0.2, 0.5);
        let found = pose.attitude(Axes::Ros);
        assert!((found[0] - roll).abs() < 1e-12 && (found[1] - pitch).abs() < 1e-12, "{found:?}");
        assert!(frames.is_between("slope", "body", "world"));
        assert_eq!(frames.pose("wheel", "world"), None);
    }

    /// Frames in a circle lead nowhere, and end.
    #[test]
    fn frames_in_a_circle_are_no_way() {
        let mut frames = Frames::default();
        for (parent, child) in [("a", "b"), ("b", "a")] {
            frames.take(&json!({"parent_frame_id": parent, "child_frame_id": child,
                "translation": {"x": 1.0, "y": 0.0}, "rotation": about("z", 0.1)}));
        }
        assert_eq!(frames.pose("a", "world"), None);
        assert!(!frames.is_between("c", "a", "world"));
    }
}
