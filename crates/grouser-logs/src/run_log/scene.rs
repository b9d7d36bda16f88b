//! What a viewer draws: the rover's likeness, the ground as far as it is needed, the path, and the
//! soil's forces.
//!
//! A viewer that jumps in time asks for the last message of each topic only. So each topic's
//! message is complete: ground and path are written anew whenever they grow, by ever larger pieces,
//! so that the file grows with the way and not with its square.

use grouser_core::elementary::wide;
use grouser_core::simulation::Scenario;
use grouser_core::terrain::{Footprint, Terrain};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::{Mount, Rover};
use grouser_draw::motion::Pose as RoverPose;
use grouser_draw::rover::{Bar, Block, Likeness, bars_of};
use grouser_draw::style::{Ground as Paper, Role};
use grouser_draw::{newtons_per_metre, round_step, shade_of};

use crate::foxglove::{
    ArrowPrimitive, Color, CubePrimitive, CylinderPrimitive, KeyValuePair, LinePrimitive, LineType,
    Point3, Pose, Quaternion, SceneEntity, SceneUpdate, Timestamp, TriangleListPrimitive, Vector3,
};
use crate::run_log::frames::{BODY, SLOPE, WORLD, WheelName};

/// How far lines lie over the plane [m]: faces in one plane would flicker.
const LIFT: f64 = 2e-3;
/// Width of the path, in pixels.
const PATH: f64 = 3.0;
/// The most points that a path has; a longer one has points further apart.
const POINTS: usize = 256;

fn color(role: Role) -> Color {
    let [r, g, b] = role.on(Paper::Light).parts();
    Color { r, g, b, a: 1.0 }
}

fn entity(time: u64, frame: &str, name: &str) -> SceneEntity {
    SceneEntity {
        timestamp: Timestamp::of(time),
        frame_id: frame.to_owned(),
        id: name.to_owned(),
        // It stays with its frame, for ever.
        frame_locked: true,
        ..SceneEntity::default()
    }
}

fn update(entities: Vec<SceneEntity>) -> SceneUpdate {
    SceneUpdate { entities, ..SceneUpdate::default() }
}

fn cube(block: &Block, role: Role) -> CubePrimitive {
    let (middle, size) = (0.5 * (block.low + block.high), block.high - block.low);
    CubePrimitive { pose: Pose::at(middle), size: size.into(), color: color(role) }
}

/// The body's likeness in the body's frame, and each wheel in its rim's.
pub(crate) fn of_rover(rover: &Rover, names: &[WheelName]) -> SceneUpdate {
    let likeness = Likeness::of(rover);
    let blocks = [
        (&likeness.body, Role::BodyLit),
        (&likeness.mast, Role::BodyDark),
        (&likeness.head, Role::BodyDark),
    ];
    let cubes = blocks.map(|(block, role)| cube(block, role)).into();
    let mut entities = vec![SceneEntity { cubes, ..entity(0, BODY, BODY) }];
    for (mount, name) in rover.mounts().iter().zip(names) {
        let wheel = &mount.unit.wheel;
        let rim = CylinderPrimitive {
            // A cylinder is about z, a wheel about y.
            pose: Pose {
                position: Vector3::default(),
                orientation: Quaternion::about(Vec3::x(), 0.5 * std::f64::consts::PI),
            },
            size: Vector3 { x: 2.0 * wheel.radius, y: 2.0 * wheel.radius, z: wheel.width },
            bottom_scale: 1.0,
            top_scale: 1.0,
            color: color(Role::Wheel),
        };
        entities.push(SceneEntity {
            cylinders: vec![rim],
            cubes: bars_of(wheel).iter().map(bar).collect(),
            metadata: vec![KeyValuePair { key: "wheel".into(), value: name.own.clone() }],
            ..entity(0, &name.rim, &name.frame)
        });
    }
    update(entities)
}

/// A spoke or a grouser.
fn bar(bar: &Bar) -> CubePrimitive {
    let orientation = Quaternion::about(Vec3::y(), bar.angle);
    let (sin, cos) = wide::sin_cos(bar.angle);
    let middle = 0.5 * (bar.inner + bar.outer);
    CubePrimitive {
        pose: Pose { position: Vector3 { x: middle * sin, y: 0.0, z: middle * cos }, orientation },
        size: Vector3 { x: 2.0 * bar.half_thick, y: 2.0 * bar.half_wide, z: bar.outer - bar.inner },
        color: color(Role::Grouser),
    }
}

/// The piece of the slope's plane that is drawn, a rectangle in the slope frame [m].
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    ends: Option<[Vec2; 2]>,
    /// How far it reaches around the rover's start, and beyond its edge where it grows.
    margin: f64,
}

impl Ground {
    pub(crate) fn of(rover: &Rover) -> Self {
        Self { ends: None, margin: 4.0 * Likeness::of(rover).reach }
    }

    /// Grows so that the rover stands well within; whether it had to.
    pub(crate) fn grow(&mut self, position: Vec2) -> bool {
        let margin = self.margin;
        let Some([low, high]) = &mut self.ends else {
            let around = Vec2::new(margin, margin);
            self.ends = Some([position - around, position + around]);
            return true;
        };
        let mut has_grown = false;
        for axis in 0..2 {
            // Every time by its own size, so that it has to grow but a few times.
            let step = high[axis] - low[axis];
            if position[axis] < low[axis] + 0.5 * margin {
                low[axis] = (low[axis] - step).min(position[axis] - margin);
                has_grown = true;
            }
            if position[axis] > high[axis] - 0.5 * margin {
                high[axis] = (high[axis] + step).max(position[axis] + margin);
                has_grown = true;
            }
        }
        has_grown
    }

    /// The piece of ground with heights, in the world's frame.
    ///
    /// * `base`: height of the world's origin [m]
    pub(crate) fn relief(&self, time: u64, relief: &dyn Terrain, base: f64) -> SceneUpdate {
        /// Points along a side.
        const SIDE: usize = 64;
        let [low, high] = self.ends.unwrap_or_default();
        let step = (high - low) / (SIDE - 1) as f64;
        let footprint =
            Footprint { forward: Vec2::x(), half_length: 0.1 * step.x, half_width: 0.1 * step.y };
        let (mut points, mut colors, mut is_known) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column) in (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column))) {
            let at = low + Vec2::new(column as f64 * step.x, row as f64 * step.y);
            let patch = relief.patch(at, footprint);
            points.push(Point3::from(at.push(patch.height - base)));
            colors.push(color(shade_of(patch.normal)));
            is_known.push(relief.covers(at, footprint));
        }
        let cells = (0..SIDE - 1).flat_map(|row| (0..SIDE - 1).map(move |it| row * SIDE + it));
        let corners = cells.map(|first| [first, first + 1, first + 1 + SIDE, first + SIDE]);
        let known = corners.filter(|corners| corners.iter().all(|corner| is_known[*corner]));
        let indices = known.flat_map(|[a, b, c, d]| [a, b, c, a, c, d]);
        let ground = TriangleListPrimitive {
            pose: Pose::at(Vec3::zeros()),
            points,
            color: color(Role::Soil),
            colors,
            indices: indices.filter_map(|index| u32::try_from(index).ok()).collect(),
        };
        update(vec![SceneEntity { triangles: vec![ground], ..entity(time, WORLD, "ground") }])
    }

    /// The plane and its grid: lines across the slope are contour lines.
    pub(crate) fn scene(&self, time: u64) -> SceneUpdate {
        let [low, high] = self.ends.unwrap_or_default();
        let corner = |x: f64, y: f64| Point3::from(Vec3::new(x, y, 0.0));
        let plane = TriangleListPrimitive {
            pose: Pose::at(Vec3::zeros()),
            points: vec![
                corner(low.x, low.y),
                corner(high.x, low.y),
                corner(high.x, high.y),
                corner(low.x, high.y),
            ],
            color: color(Role::Soil),
            colors: Vec::new(),
            indices: vec![0, 1, 2, 0, 2, 3],
        };
        let step = spacing(high - low);
        let at = |low: f64, high: f64| {
            let first = (low / step).ceil();
            (0..)
                .map(move |k| (first + f64::from(k)) * step)
                .take_while(move |place| *place <= high)
        };
        let point = |x: f64, y: f64| Point3::from(Vec3::new(x, y, LIFT));
        let contours =
            at(low.y, high.y).flat_map(|y| [point(low.x, y), point(high.x, y)]).collect();
        let down = at(low.x, high.x).flat_map(|x| [point(x, low.y), point(x, high.y)]).collect();
        let lines = vec![grid(contours, Role::Contour), grid(down, Role::Grid)];
        let about = KeyValuePair { key: "grid_m".into(), value: step.to_string() };
        let ground = entity(time, SLOPE, "ground");
        update(vec![SceneEntity { triangles: vec![plane], lines, metadata: vec![about], ..ground }])
    }
}

fn grid(points: Vec<Point3>, role: Role) -> LinePrimitive {
    LinePrimitive {
        r#type: LineType::List,
        pose: Pose::at(Vec3::zeros()),
        thickness: 1.0,
        scale_invariant: true,
        points,
        color: color(role),
        ..LinePrimitive::default()
    }
}

/// A distance of lines [m], for about twenty of them on the longer side.
fn spacing(size: Vec2) -> f64 {
    round_step(size.max() / 20.0)
}

/// The way of the body's centre of mass so far.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    points: Vec<Vec3>,
    /// How far apart its points are [m].
    spacing: f64,
}

impl Path {
    pub(crate) fn of(rover: &Rover) -> Self {
        Self { points: Vec::new(), spacing: 0.1 * Likeness::of(rover).reach }
    }

    /// Whether there is a new line to be drawn.
    pub(crate) fn grow(&mut self, position: Vec3) -> bool {
        let is_far = |last: &Vec3| (position - last).norm() >= self.spacing;
        if !self.points.last().is_none_or(is_far) {
            return false;
        }
        self.points.push(position);
        if self.points.len() > POINTS {
            self.points = self.points.iter().copied().step_by(2).collect();
            self.spacing *= 2.0;
        }
        self.points.len() > 1
    }

    /// * `frame`: that of its points
    pub(crate) fn scene(&self, time: u64, frame: &str) -> SceneUpdate {
        let point = |at: &Vec3| Point3::from(at + Vec3::new(0.0, 0.0, 2.0 * LIFT));
        let line = LinePrimitive {
            r#type: LineType::Strip,
            thickness: PATH,
            points: self.points.iter().map(point).collect(),
            ..grid(Vec::new(), Role::Path)
        };
        update(vec![SceneEntity { lines: vec![line], ..entity(time, frame, "path") }])
    }
}

/// The soil's forces on the wheels, as arrows in the wheels' frames that begin below the hubs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forces {
    /// Newtons of a metre of arrow.
    newtons_per_metre: f64,
}

impl Forces {
    pub(crate) fn of(scenario: &Scenario) -> Self {
        Self { newtons_per_metre: newtons_per_metre(scenario) }
    }

    pub(crate) fn scene(
        self,
        time: u64,
        pose: &RoverPose,
        mounts: &[Mount],
        names: &[WheelName],
    ) -> SceneUpdate {
        let all = pose.wheels.iter().zip(mounts).zip(names).map(|((wheel, mount), name)| {
            let length = wheel.force.norm() / self.newtons_per_metre;
            let thick = 0.1 * mount.unit.wheel.radius;
            let arrow = |direction: Vec3| ArrowPrimitive {
                pose: Pose {
                    position: Vector3 {
                        x: 0.0,
                        y: 0.0,
                        z: wheel.sinkage - mount.shearing_radius(),
                    },
                    orientation: Quaternion::to(direction),
                },
                shaft_length: 0.8 * length,
                shaft_diameter: thick,
                head_length: 0.2 * length,
                head_diameter: 2.0 * thick,
                color: color(Role::Force),
            };
            // A wheel that bears nothing has no arrow.
            let direction = wheel.force_in_wheel().try_normalize(1e-9);
            let about =
                KeyValuePair { key: "n_per_m".into(), value: self.newtons_per_metre.to_string() };
            let arrows = direction.map(arrow).into_iter().collect();
            SceneEntity { arrows, metadata: vec![about], ..entity(time, &name.frame, &name.frame) }
        });
        update(all.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a way of a thousand times its margin the ground grows ten times, and always has the rover
    /// within.
    #[test]
    fn the_ground_grows_seldom_and_holds_the_rover() {
        let mut ground = Ground { ends: None, margin: 2.0 };
        let places = (0..20_000).map(|k| Vec2::new(0.1 * f64::from(k), -0.03 * f64::from(k)));
        let mut grown = 0;
        for place in places {
            grown += u32::from(ground.grow(place));
            let [low, high] = ground.ends.expect("some ground");
            let inside =
                |axis: usize| low[axis] + 1.0 <= place[axis] && place[axis] <= high[axis] - 1.0;
            assert!(inside(0) && inside(1), "{place}");
        }
        assert!((8..30).contains(&grown), "{grown}");
    }

    #[test]
    fn a_path_has_few_points_and_begins_where_it_began() {
        let mut path = Path { points: Vec::new(), spacing: 0.1 };
        let mut lines = 0;
        for k in 0..100_000 {
            lines += u32::from(path.grow(Vec3::new(0.01 * f64::from(k), 0.0, 0.0)));
            assert!(path.points.len() <= POINTS);
        }
        assert_eq!(path.points[0], Vec3::zeros());
        // A line for each new point: the fewer, the longer the path is.
        assert!(path.points.len() > POINTS / 2 - 2 && lines < 10 * 256, "{lines}");
        let even: Vec<f64> =
            path.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        assert!(even.iter().all(|gap| (gap - path.spacing).abs() < 0.1 * path.spacing), "{even:?}");
    }

    #[test]
    fn grids_have_round_steps() {
        assert_eq!(spacing(Vec2::new(3.0, 1.0)), 0.2);
        assert_eq!(spacing(Vec2::new(3.0, 40.0)), 2.0);
    }
}
