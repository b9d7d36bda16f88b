//! A rover as it stands: its wheels, and a block for its body.

use std::f64::consts::TAU;

use crate::sheet::Place;
use grouser_core::elementary::wide;
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::{Mount, Posture, Rover};

use super::view::View;
use crate::marks::{Line, Mark, hull};
use crate::motion::Pose;
use crate::rover::{Block, Likeness};
use crate::style::Role;

/// Points around a wheel.
const ROUND: u32 = 20;
/// Spokes that show a wheel's turning.
const SPOKES: u32 = 5;
/// Width of edges [mm].
const EDGE: f64 = 0.15;

/// How a rover stands, in the coordinates of the ground.
#[derive(Clone, Debug)]
pub(super) struct Stance {
    /// The body's centre of mass [m].
    pub(super) centre: Vec3,
    /// The body's axes.
    axes: [Vec3; 3],
    wheels: Vec<Wheel>,
}

/// A wheel of a rover that stands.
#[derive(Clone, Copy, Debug)]
struct Wheel {
    /// Its hub, from the body's centre [m].
    hub: Vec3,
    /// Along its axle, to the left.
    axle: Vec3,
    /// Where it is shown how far it has turned: forward along it, and how far that is [rad].
    turned: Option<(Vec3, f64)>,
}

impl Stance {
    pub(super) fn of_posture(posture: &Posture) -> Self {
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| posture.ground_from_body * axis);
        let wheels = posture.wheels.iter();
        let wheels = wheels.map(|it| Wheel { hub: it.hub, axle: it.axle, turned: None });
        Self { centre: posture.place, axes, wheels: wheels.collect() }
    }

    pub(super) fn of_pose(pose: &Pose, mounts: &[Mount]) -> Self {
        let axes = pose.axes();
        let turned = |vector: Vec3| axes[0] * vector.x + axes[1] * vector.y + axes[2] * vector.z;
        let wheel = |(index, mount): (usize, &Mount)| {
            let [forward, axle] = pose.wheel_in_body(mount, index).map(turned);
            let hub = turned(pose.hub_in_body(mount, index));
            Wheel { hub, axle, turned: Some((forward, pose.wheels[index].turned)) }
        };
        let wheels = mounts.iter().enumerate().map(wheel).collect();
        Self { centre: pose.centre, axes, wheels }
    }

    fn turned(&self, vector: Vec3) -> Vec3 {
        let [forward, left, up] = self.axes;
        forward * vector.x + left * vector.y + up * vector.z
    }
}

/// What a rover's drawing is made of.
pub(super) struct Drawn<'a> {
    mounts: &'a [Mount],
    likeness: Likeness,
    /// How many times its size the rover is drawn.
    times: f64,
}

impl<'a> Drawn<'a> {
    pub(super) fn of(rover: &'a Rover) -> Self {
        Self { mounts: rover.mounts(), likeness: Likeness::of(rover), times: 1.0 }
    }

    /// The same so many times its size, about the point of the ground that it stands on.
    pub(super) fn enlarged(self, times: f64) -> Self {
        Self { times, ..self }
    }

    /// The rover as it stands, what is farther from the eye first.
    pub(super) fn marks(&self, view: &View, stance: &Stance) -> Vec<Mark> {
        let stance = self.grown(stance);
        let centre = view.depth(stance.centre);
        let mut order: Vec<(f64, usize)> = stance
            .wheels
            .iter()
            .enumerate()
            .map(|(index, wheel)| (view.depth(stance.centre + wheel.hub), index))
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wheel = |&(_, index): &(f64, usize)| self.wheel(view, &stance, index);
        let behind = order.iter().take_while(|it| it.0 < centre);
        let before = order.iter().skip_while(|it| it.0 < centre);
        let mut marks: Vec<Mark> = behind.flat_map(wheel).collect();
        for block in [&self.likeness.body, &self.likeness.mast, &self.likeness.head] {
            marks.extend(self.block(view, &stance, block));
        }
        marks.extend(before.flat_map(wheel));
        marks
    }

    /// The stance of the enlarged rover.
    fn grown(&self, stance: &Stance) -> Stance {
        let count = stance.wheels.len().max(1) as f64;
        let hubs: Vec3 = stance.wheels.iter().map(|wheel| wheel.hub).sum();
        let radii: f64 = self.mounts.iter().map(Mount::shearing_radius).sum();
        let up = stance.axes[2];
        let foot = stance.centre + (hubs - radii * up) / count;
        let mut grown = stance.clone();
        grown.centre = foot + self.times * (stance.centre - foot);
        for wheel in &mut grown.wheels {
            wheel.hub *= self.times;
        }
        grown
    }

    /// The faces of a block that are seen.
    fn block(&self, view: &View, stance: &Stance, block: &Block) -> Vec<Mark> {
        let mut faces = Vec::new();
        for axis in 0..3 {
            for is_high in [false, true] {
                let mut normal = Vec3::zeros();
                normal[axis] = if is_high { 1.0 } else { -1.0 };
                if !view.sees(stance.turned(normal)) {
                    continue;
                }
                let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
                let corners = [(false, false), (true, false), (true, true), (false, true)];
                let corner = |(a, b): (bool, bool)| {
                    let mut of = [is_high; 3];
                    of[one] = a;
                    of[other] = b;
                    view.place(stance.centre + stance.turned(self.times * block.corner(of)))
                };
                let role = [Role::BodyDark, Role::BodyLit, Role::BodyTop][axis];
                let face = Mark::area(corners.map(corner), role);
                faces.push(face.outlined(Line::new(Role::Edge, EDGE)));
            }
        }
        faces
    }

    /// A wheel: the outline of both its rims and, where its turning is shown, the spokes on the
    /// side that is seen.
    fn wheel(&self, view: &View, stance: &Stance, index: usize) -> Vec<Mark> {
        /// Sides that are seen less than this are not drawn [-]. Source: ours; their spokes would
        /// lie on one line.
        const SEEN: f64 = 0.2;
        let (Wheel { hub, axle, turned }, mount) = (stance.wheels[index], &self.mounts[index]);
        let hub = stance.centre + hub;
        let half = 0.5 * self.times * mount.unit.wheel.width;
        let radius = self.times * mount.shearing_radius();
        let edge = Line::new(Role::Edge, EDGE);
        let outline = outline(view, hub, axle, Vec2::new(radius, half));
        let mut marks = vec![Mark::area(outline, Role::Wheel).outlined(edge)];
        let Some((forward, turned)) = turned else { return marks };
        let facing = view.depth(axle);
        if facing.abs() < SEEN {
            return marks;
        }
        let middle = hub + facing.signum() * half * axle;
        let upright = forward.cross(&axle);
        let spoke = |place: u32| {
            let (sin, cos) = wide::sin_cos(turned + TAU * f64::from(place) / f64::from(SPOKES));
            let end = middle + 0.85 * radius * (sin * forward + cos * upright);
            Mark::line([middle, end].map(|point| view.place(point)), Line::new(Role::BodyLit, 0.25))
        };
        marks.extend((0..SPOKES).map(spoke));
        marks
    }
}

/// A wheel's outline: both its rims.
///
/// * `axle`: its direction
/// * `size`: radius and half of the width [m]
fn outline(view: &View, hub: Vec3, axle: Vec3, size: Vec2) -> Vec<Place> {
    let across = axle.cross(&Vec3::z()).try_normalize(0.0).unwrap_or_else(Vec3::x);
    let upright = across.cross(&axle);
    let rim = |side: f64| {
        (0..ROUND).map(move |point| {
            let (sin, cos) = wide::sin_cos(TAU * f64::from(point) / f64::from(ROUND));
            hub + side * size.y * axle + size.x * (cos * across + sin * upright)
        })
    };
    hull(rim(-1.0).chain(rim(1.0)).map(|point| view.place(point)).collect())
}
