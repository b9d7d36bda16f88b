//! The soil's forces on the wheels as arrows, which turn and grow from picture to picture.

use grouser_core::units::Vec3;
use grouser_core::vehicle::Mount;
use serde_json::json;

use super::file::File;
use super::solid::Solid;
use crate::motion::{Pose, quaternion_to, rotations};

/// Half the thickness of an arrow over the wheel's radius; the head is twice as thick.
const THICK: f64 = 0.05;

/// What the arrows of a rover have in common.
pub(super) struct ForceArrows<'a> {
    /// The rover in each picture.
    pub(super) poses: &'a [Pose],
    /// The accessor of the pictures' times.
    pub(super) input: usize,
    /// Newtons of a metre of arrow [N/m].
    pub(super) newtons_per_metre: f64,
}

impl ForceArrows<'_> {
    /// The node of a wheel's contact, in the frame of its mount, with the arrow of the force there:
    /// from the surface under the hub. Without a force the arrow has no size.
    ///
    /// * `mesh`: an arrow of 1 m
    pub(super) fn node(&self, file: &mut File, mesh: usize, mount: &Mount, index: usize) -> usize {
        let node = file.node(json!({ "name": format!("force {}", mount.name), "mesh": mesh }));
        let wheels = || self.poses.iter().map(|pose| pose.wheels[index]);
        let sizes = wheels().flat_map(|wheel| {
            let length = wheel.force.norm() / self.newtons_per_metre;
            if length > 0.0 { [1.0, 1.0, length] } else { [0.0; 3] }
        });
        let sizes: Vec<f64> = sizes.collect();
        let turns = rotations(self.poses, |pose| from_z_to(pose.wheels[index].force));
        self.moves(file, node, "scale", &sizes);
        self.moves(file, node, "rotation", &turns);
        let contact = json!({ "name": format!("contact {}", mount.name), "children": [node] });
        let contact = file.node(contact);
        let tails = wheels().flat_map(|it| [0.0, 0.0, it.sinkage - mount.shearing_radius()]);
        self.moves(file, contact, "translation", &tails.collect::<Vec<_>>());
        if wheels().any(|it| it.standing.is_some()) {
            // Where the ground falls across the wheel, the force is of its frame.
            let leans = rotations(self.poses, |pose| {
                let standing = pose.wheels[index].standing;
                standing.map_or(UPRIGHT, |it| quaternion_to(it.ground_in_wheel()))
            });
            self.moves(file, contact, "rotation", &leans);
        }
        contact
    }

    fn moves(&self, file: &mut File, node: usize, path: &str, values: &[f64]) {
        let shape = if path == "rotation" { "VEC4" } else { "VEC3" };
        let output = file.numbers(shape, values, false, None);
        file.channel(node, path, [self.input, output], "LINEAR");
    }
}

/// No rotation, as a quaternion.
const UPRIGHT: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// The shortest rotation from the z axis to a direction, as a quaternion.
fn from_z_to(vector: Vec3) -> [f64; 4] {
    let Some(way) = vector.try_normalize(0.0) else { return UPRIGHT };
    let size = (2.0 + 2.0 * way.z).max(0.0).sqrt();
    // Straight down, each axis across serves.
    if size < 1e-6 {
        [1.0, 0.0, 0.0, 0.0]
    } else {
        [-way.y, way.x, 0.0, 1.0 + way.z].map(|it| it / size)
    }
}

impl Solid {
    /// An arrow from the origin to 1 m along z, its head a fifth of it.
    ///
    /// * `radius`: of the wheel that it is for [m]
    pub(super) fn arrow(radius: f64) -> Self {
        /// Flat faces around it.
        const ROUND: u32 = 10;
        const NECK: f64 = 0.8;
        let thin = THICK * radius;
        let at = |k: u32, far: f64, high: f64| Self::around(k, ROUND) * far + Vec3::z() * high;
        let mut arrow = Self::default();
        for k in 0..ROUND {
            let out = (Self::around(k, ROUND) + Self::around(k + 1, ROUND)).normalize();
            let side =
                [at(k, thin, 0.0), at(k + 1, thin, 0.0), at(k + 1, thin, NECK), at(k, thin, NECK)];
            arrow.face(&side, out);
            let wide = 2.0 * thin;
            arrow.face(&[at(k, wide, NECK), at(k + 1, wide, NECK), Vec3::z()], out);
        }
        for (far, high) in [(thin, 0.0), (2.0 * thin, NECK)] {
            let end: Vec<Vec3> = (0..ROUND).rev().map(|k| at(k, far, high)).collect();
            arrow.face(&end, -Vec3::z());
        }
        arrow
    }
}
