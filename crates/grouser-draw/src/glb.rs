//! A run as a scene in three dimensions: binary glTF 2.0, for Blender and browsers.
//!
//! Below the node `slope`, which turns the slope's plane by its inclination, everything is in the
//! slope frame [m]; over ground with heights it is below the node `map`, seen from the start of the
//! run. Source of the format: Khronos Group, "glTF 2.0 Specification" (2021).

mod arrow;
mod file;
mod solid;

use std::f64::consts::TAU;

use grouser_core::elementary::wide;
use grouser_core::units::Vec3;
use grouser_core::vehicle::Mount;
use grouser_core::wheel::Wheel;
use serde_json::json;

use self::arrow::ForceArrows;
use self::file::File;
use self::solid::Solid;
use crate::animation::Animation;
use crate::motion::{Pose, StandingWheel, quaternion_to, rotations};
use crate::relief::contour_step;
use crate::rover::{Block, PlacedWheel};
use crate::scene::{Actor, Around};
use crate::style::Role;

/// How far a wheel may turn between two samples [rad]: what turns by half a circle could turn back
/// as well.
const TURN: f64 = 1.0;
/// Samples of a run at most.
const MOST: usize = 20_000;
/// How many pieces tracks come in.
const PIECES: usize = 60;

impl Animation {
    /// The run as binary glTF 2.0: body, wheels with their grousers, the ground with contour lines,
    /// tracks that appear as they are made, and arrows for the soil's forces on the wheels. A
    /// second of it is a second of the run, or as many as `extras` of its animation says, which has
    /// the scale of the arrows, too.
    #[must_use]
    pub fn to_glb(&self) -> Vec<u8> {
        let mut file = File::new();
        let times = self.samples();
        let seconds: Vec<f64> = times.iter().map(|time| time / self.speed).collect();
        let input = file.numbers("SCALAR", &seconds, true, None);
        let pictures: Vec<f64> = self.times.iter().map(|time| time / self.speed).collect();
        let pictures = file.numbers("SCALAR", &pictures, true, None);
        // Arrows of rovers beside each other have one scale.
        let scales = self.actors.iter().map(Actor::newtons_per_metre);
        let newtons_per_metre = scales.fold(0.0, f64::max);
        let mut below = vec![self.ground(&mut file)];
        below.extend(self.tracks(&mut file));
        for (actor, row) in self.actors.iter().zip(&self.rows) {
            let at = |times: &[f64]| times.iter().map(|time| actor.motion.at(*time)).collect();
            let [poses, in_pictures]: [Vec<Pose>; 2] = [at(&times), at(&self.times)];
            let arrows = ForceArrows { poses: &in_pictures, input: pictures, newtons_per_metre };
            below.push(rover(&mut file, actor, &row.name, (&poses, input), &arrows));
        }
        let (name, slope) = match self.scene.ground {
            Around::Plane { slope, .. } => ("slope", slope),
            Around::Heights(_) => ("map", 0.0),
        };
        let [sin, cos] = half(slope - 0.25 * TAU);
        let root = file.node(json!({
            "name": name,
            "rotation": [sin, 0.0, 0.0, cos],
            "children": below,
        }));
        let extras = json!({
            "run_seconds_per_second": self.speed,
            "newtons_per_metre": newtons_per_metre,
        });
        file.finish(root, &self.title, &extras)
    }

    /// Times of the samples [s]: those of the pictures, and as many between them as the wheels'
    /// turning needs.
    fn samples(&self) -> Vec<f64> {
        let mut times = vec![self.times[0]];
        for pair in self.times.windows(2) {
            let turns = self.actors.iter().flat_map(|actor| {
                let [a, b] = [pair[0], pair[1]].map(|time| actor.motion.at(time).wheels);
                a.iter().zip(&b).map(|(a, b)| (b.turned - a.turned).abs()).collect::<Vec<_>>()
            });
            let steps = (turns.fold(0.0, f64::max) / TURN).ceil().max(1.0);
            let mut step = 1.0;
            while step <= steps && times.len() < MOST {
                times.push(pair[0] + (pair[1] - pair[0]) * step / steps);
                step += 1.0;
            }
        }
        times
    }

    /// The ground and its contour lines.
    fn ground(&self, file: &mut File) -> usize {
        /// How far lines are above the ground, so that they are seen [m].
        const LIFT: f64 = 1e-3;
        let mut ground = Solid::default();
        let lines: Vec<Vec3> = match &self.scene.ground {
            Around::Plane { whole, contours, .. } => {
                ground.face(&whole.corners(), Vec3::z());
                let line = |y: &f64| [whole.low.x, whole.high.x].map(|x| Vec3::new(x, *y, 0.0));
                contours.iter().flat_map(line).collect()
            }
            Around::Heights(surfaces) => {
                // Runs on different ground are in one place: the first one's is shown.
                let surface = &surfaces[0];
                surface.cells().for_each(|cell| ground.cell(&cell));
                surface.contours(contour_step(surface)).into_iter().flatten().collect()
            }
        };
        let lines: Vec<Vec3> = lines.iter().map(|at| at + Vec3::new(0.0, 0.0, LIFT)).collect();
        let ground = file.mesh("ground", &ground, Role::Soil);
        let mut children = Vec::new();
        if !lines.is_empty() {
            let mesh = file.lines("contour lines", &lines, Role::Contour);
            children.push(file.node(json!({ "name": "contour lines", "mesh": mesh })));
        }
        let mut node = json!({ "name": "ground", "mesh": ground });
        if !children.is_empty() {
            node["children"] = children.into();
        }
        file.node(node)
    }

    /// The tracks in pieces, each of which appears when it has been made.
    fn tracks(&self, file: &mut File) -> Vec<usize> {
        let mut nodes = Vec::new();
        let last = self.times.len() - 1;
        let pieces = last.min(PIECES);
        for piece in 0..pieces {
            let frames = piece * last / pieces..(piece + 1) * last / pieces;
            let mut strips = Solid::default();
            for actor in &self.actors {
                for frame in frames.clone() {
                    let poses = [frame, frame + 1].map(|it| actor.motion.at(self.times[it]));
                    strip(&mut strips, actor, &poses, frame);
                }
            }
            if strips.places.is_empty() {
                continue;
            }
            let mesh = file.mesh("track", &strips, Role::Track);
            let node = file.node(json!({ "name": format!("track {}", piece + 1), "mesh": mesh }));
            let end = self.times[frames.end] / self.speed;
            let input = file.numbers("SCALAR", &[0.0, end], true, None);
            let shown = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
            let output = file.numbers("VEC3", &shown, false, None);
            file.channel(node, "scale", [input, output], "STEP");
            nodes.push(node);
        }
        nodes
    }
}

/// What a wheel leaves between two poses, a little above the plane, the later the higher: faces in
/// one plane would flicker.
fn strip(strips: &mut Solid, actor: &Actor, poses: &[Pose; 2], frame: usize) {
    let lift = Vec3::new(0.0, 0.0, 1e-3 + 1e-6 * frame as f64);
    for (index, mount) in actor.mounts().iter().enumerate() {
        let [a, b] = poses.each_ref().map(|pose| {
            let (foot, left) = footing(actor, pose, mount, index);
            let half = 0.5 * mount.unit.wheel.width * left;
            [foot - half + lift, foot + half + lift]
        });
        if (a[0] - b[0]).norm().max((a[1] - b[1]).norm()) > 1e-6 {
            // A wheel that goes back leaves its strip the other way round.
            let is_back = (b[0] - a[0]).cross(&(a[1] - a[0])).z < 0.0;
            let (from, to) = if is_back { (b, a) } else { (a, b) };
            strips.face(&[from[0], to[0], to[1], from[1]], Vec3::z());
        }
    }
}

/// The point of the ground under a wheel, and the direction of its axle.
fn footing(actor: &Actor, pose: &Pose, mount: &Mount, index: usize) -> (Vec3, Vec3) {
    let wheel = &pose.wheels[index];
    if wheel.standing.is_none() {
        let wheel = PlacedWheel::of(mount, wheel, pose, actor.lane());
        return (wheel.foot(), wheel.left);
    }
    let [x, y, z] = pose.axes();
    let turned = |vector: Vec3| x * vector.x + y * vector.y + z * vector.z;
    let [forward, axle] = pose.wheel_in_body(mount, index);
    let below = (mount.shearing_radius() - wheel.sinkage) * forward.cross(&axle);
    let foot = pose.centre + turned(pose.hub_in_body(mount, index) - below);
    (foot, turned(axle))
}

/// A rover with its wheels, their motion, and the arrows of the forces on them.
///
/// * `motion`: the rover in each sample, and the accessor of the samples' times
fn rover(
    file: &mut File,
    actor: &Actor,
    name: &str,
    (poses, input): (&[Pose], usize),
    arrows: &ForceArrows<'_>,
) -> usize {
    let likeness = actor.likeness();
    let mut body = Solid::default();
    for block in [&likeness.body, &likeness.mast, &likeness.head] {
        body.block(block);
    }
    let body = file.mesh("body", &body, Role::BodyLit);
    let mut panel = Solid::default();
    let (low, high) = (likeness.body.low, likeness.body.high);
    let size = high - low;
    panel.block(&Block {
        low: Vec3::new(low.x + 0.08 * size.x, low.y + 0.1 * size.y, high.z),
        high: Vec3::new(low.x + 0.7 * size.x, high.y - 0.1 * size.y, high.z + 0.02 * size.z),
    });
    let panel = file.mesh("panel", &panel, Role::Panel);
    let panel = file.node(json!({ "name": "panel", "mesh": panel }));
    let mut children = vec![panel];
    let mut known: Vec<(Wheel, [usize; 2])> = Vec::new();
    for (index, mount) in actor.mounts().iter().enumerate() {
        let wheel = mount.unit.wheel;
        let found = known.iter().find(|(other, _)| *other == wheel).map(|(_, meshes)| *meshes);
        let [mesh, arrow] = found.unwrap_or_else(|| {
            let arrow = Solid::arrow(wheel.radius);
            let meshes = [file.wheel(&wheel), file.mesh("force", &arrow, Role::Force)];
            known.push((wheel, meshes));
            meshes
        });
        let turned = poses.iter().flat_map(|pose| {
            // Turning forward is turning about the axle, to the left, by the right-hand rule.
            let [sin, cos] = half(pose.wheels[index].turned);
            [0.0, sin, 0.0, cos]
        });
        let spinning = file.node(json!({ "name": format!("{} wheel", mount.name), "mesh": mesh }));
        let output = file.numbers("VEC4", &turned.collect::<Vec<_>>(), false, None);
        file.channel(spinning, "rotation", [input, output], "LINEAR");
        let arrow = arrows.node(file, arrow, mount, index);
        let mut steered = json!({ "name": mount.name, "children": [spinning, arrow] });
        // Over ground with heights the axle goes with the suspension.
        let is_still = mount.steering_axis.is_none() && poses[0].wheels[index].standing.is_none();
        if is_still {
            let [sin, cos] = half(mount.steering);
            steered["rotation"] = json!([0.0, 0.0, sin, cos]);
        }
        let steered = file.node(steered);
        let places = poses.iter().flat_map(|pose| {
            let hub = pose.hub_in_body(mount, index);
            [hub.x, hub.y, hub.z]
        });
        let output = file.numbers("VEC3", &places.collect::<Vec<_>>(), false, None);
        file.channel(steered, "translation", [input, output], "LINEAR");
        if !is_still {
            let wheel = |pose: &Pose| pose.wheels[index];
            let angles = rotations(poses, |pose| match wheel(pose).standing {
                Some(StandingWheel { forward, axle, .. }) => {
                    quaternion_to([forward, axle, forward.cross(&axle)])
                }
                None => about_z(wheel(pose).steering),
            });
            let output = file.numbers("VEC4", &angles, false, None);
            file.channel(steered, "rotation", [input, output], "LINEAR");
        }
        children.push(steered);
    }
    let node = file.node(json!({ "name": name, "mesh": body, "children": children }));
    let places = poses.iter().flat_map(|pose| {
        let centre = actor.lane() + pose.centre;
        [centre.x, centre.y, centre.z]
    });
    let output = file.numbers("VEC3", &places.collect::<Vec<_>>(), false, None);
    file.channel(node, "translation", [input, output], "LINEAR");
    let rotations = rotations(poses, |pose| match pose.leaning {
        Some(_) => quaternion_to(pose.axes()),
        None => about_z(pose.yaw),
    });
    let output = file.numbers("VEC4", &rotations, false, None);
    file.channel(node, "rotation", [input, output], "LINEAR");
    node
}

/// A rotation about z, as a quaternion.
fn about_z(angle: f64) -> [f64; 4] {
    let [sin, cos] = half(angle);
    [0.0, 0.0, sin, cos]
}

/// Sine and cosine of half an angle: the parts of a quaternion.
fn half(angle: f64) -> [f64; 2] {
    let (sin, cos) = wide::sin_cos(0.5 * angle);
    [sin, cos]
}
