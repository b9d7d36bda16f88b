//! Rovers on their slope as lines and areas: what stays, what is left behind, and what moves.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::sheet::{Anchor, Place};
use grouser_core::elementary::wide;
use grouser_core::simulation::Scenario;
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::Mount;

use crate::camera::Camera;
use crate::forces::newtons_per_metre;
use crate::marks::{Line, Mark, arrow, hull, over_ground};
use crate::motion::{Motion, Pose};
use crate::relief::Surface;
use crate::rover::{Block, Likeness, PlacedWheel};
use crate::style::Role;

/// Points around a wheel.
const ROUND: u32 = 28;
/// Paths of up to this many times a rover's reach are shown whole; along longer ones the view goes
/// with the rover.
const WHOLE: [f64; 2] = [7.0, 5.0];
/// The longest arrow over a rover's reach.
const LONGEST_ARROW: f64 = 1.1;
/// Width of an arrow [mm].
const ARROW: f64 = 0.75;

/// A run with what is needed to draw it.
#[derive(Clone, Debug)]
pub(crate) struct Actor {
    pub(crate) motion: Motion,
    mounts: Vec<Mount>,
    likeness: Likeness,
    /// Where its origin is in the slope frame [m].
    lane: Vec3,
    /// Newtons of a metre of arrow in three dimensions [N/m].
    newtons_per_metre: f64,
}

impl Actor {
    pub(crate) fn new(motion: Motion, scenario: &Scenario) -> Self {
        let rover = &scenario.rover;
        let likeness = Likeness::of(rover);
        Self {
            motion,
            mounts: rover.mounts().to_vec(),
            likeness,
            lane: Vec3::zeros(),
            newtons_per_metre: newtons_per_metre(scenario),
        }
    }

    /// The places that it visits, of its centre [m].
    fn range(&self) -> [Vec2; 2] {
        let centres = self.motion.poses().iter().map(|pose| pose.centre.xy() + self.lane.xy());
        let far = Vec2::repeat(f64::INFINITY);
        centres.fold([far, -far], |[low, high], at| [low.inf(&at), high.sup(&at)])
    }

    pub(crate) fn mounts(&self) -> &[Mount] {
        &self.mounts
    }

    pub(crate) fn likeness(&self) -> &Likeness {
        &self.likeness
    }

    pub(crate) fn lane(&self) -> Vec3 {
        self.lane
    }

    pub(crate) fn newtons_per_metre(&self) -> f64 {
        self.newtons_per_metre
    }

    fn wheels<'a>(&'a self, pose: &'a Pose) -> impl Iterator<Item = PlacedWheel> + 'a {
        let wheels = self.mounts.iter().zip(&pose.wheels);
        wheels.map(|(mount, wheel)| PlacedWheel::of(mount, wheel, pose, self.lane))
    }

    /// A point of the body frame, in the slope frame.
    fn of_body(&self, pose: &Pose, point: Vec3) -> Vec3 {
        let turned = pose.slope_from_body(point.xy());
        self.lane + pose.centre + Vec3::new(turned.x, turned.y, point.z)
    }
}

/// Text on the scene.
#[derive(Clone, Debug)]
pub(crate) struct Label {
    pub(crate) text: String,
    /// On its base line [mm].
    pub(crate) at: Place,
    pub(crate) anchor: Anchor,
    pub(crate) role: Role,
}

impl Label {
    pub(crate) fn new(text: impl Into<String>, at: Place, anchor: Anchor) -> Self {
        Self { text: text.into(), at, anchor, role: Role::Ink }
    }

    pub(crate) fn coloured(self, role: Role) -> Self {
        Self { role, ..self }
    }
}

/// What is drawn, from back to front: `still`, then `left` inside of `window`, then a frame's
/// marks, then `labels`.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) still: Vec<Mark>,
    /// The part of the slope's surface that is seen.
    pub(crate) window: Vec<Place>,
    /// What is on the surface, each from which frame on.
    pub(crate) left: Vec<(usize, Mark)>,
    pub(crate) frames: Vec<Frame>,
    pub(crate) labels: Vec<Label>,
    /// Where it ends on the picture, at its lower edge [mm].
    pub(crate) height: f64,
    /// The ground around all that is visited.
    pub(crate) ground: Around,
    /// The force [N] of the arrow in the legend, and its length [mm].
    pub(crate) arrow: Option<(f64, f64)>,
}

/// The ground around all that is visited.
#[derive(Clone, Debug)]
pub(crate) enum Around {
    /// A plane.
    Plane {
        whole: Patch,
        /// Its contour lines: how far uphill each is [m].
        contours: Vec<f64>,
        /// Its inclination [rad].
        slope: f64,
    },
    /// Ground with heights: of each run, or the one of all.
    Heights(Vec<Surface>),
}

/// What moves, at one time.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    /// How far what is on the surface has moved on the picture [mm].
    pub(crate) offset: Place,
    pub(crate) marks: Vec<Mark>,
}

/// A rectangle of the slope [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    pub(crate) low: Vec2,
    pub(crate) high: Vec2,
}

impl Patch {
    fn size(&self) -> Vec2 {
        self.high - self.low
    }

    /// Its corners: downhill left, downhill right, uphill right, uphill left.
    pub(crate) fn corners(&self) -> [Vec3; 4] {
        let (low, high) = (self.low, self.high);
        [[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]]
            .map(|[x, y]| Vec3::new(x, y, 0.0))
    }
}

/// What is seen: a patch, and where its middle is at a time.
struct View {
    patch: Patch,
    goes_along: bool,
}

impl Scene {
    /// * `times`: of the frames [s]
    /// * `area`: upper left corner and size of where it is drawn [mm]
    pub(crate) fn of(actors: &mut [Actor], slope: f64, times: &[f64], area: [Place; 2]) -> Self {
        let reach = actors.iter().map(|actor| actor.likeness.reach).fold(0.0, f64::max);
        spread(actors);
        let view = view(actors, reach, times);
        let thickness = 0.3 * reach;
        let camera = Camera::over(slope);
        let ends = extent(&camera, &view, actors, reach, thickness);
        let camera = camera.framing(&ends, area[0], area[1]);
        let painter = Painter { camera, reach };
        let force = actors
            .iter()
            .flat_map(|actor| actor.motion.poses().iter().flat_map(|pose| &pose.wheels))
            .map(|wheel| wheel.force.norm())
            .fold(0.0, f64::max);
        let per_newton = if force > 0.0 { LONGEST_ARROW * reach / force } else { 0.0 };
        let whole = whole(&view.patch, actors);
        let mut left = painter.lines(&view.patch, &whole, actors, slope);
        for actor in actors.iter() {
            left.extend(painter.tracks(actor, times));
        }
        left.sort_by_key(|(frame, _)| *frame);
        let window = hull(view.patch.corners().map(|corner| camera.place(corner)).to_vec());
        let frames = times.iter().map(|&time| {
            let Frame { offset, marks } = painter.frame(actors, &view, time, per_newton);
            // Shade beyond the edge falls on nothing.
            let inside = |mark: Mark| match mark.fill {
                Some(Role::Shade) => mark.within(&window),
                _ => vec![mark],
            };
            Frame { offset, marks: marks.into_iter().flat_map(inside).collect() }
        });
        let arrow = (force > 0.0).then(|| {
            let shown = nice(0.45 * force);
            (shown, camera.scale * per_newton * shown)
        });
        Self {
            frames: frames.collect(),
            window: window.clone(),
            still: painter.slab(&view.patch, slope, thickness),
            left,
            labels: painter.labels(&view.patch, slope),
            height: area[0][1] + area[1][1] + 2.0,
            ground: Around::Plane {
                contours: steps(contour_step(&view.patch), whole.low.y, whole.high.y).collect(),
                whole,
                slope,
            },
            arrow,
        }
    }
}

/// Puts each rover on a lane of its own, the first uphill of the others, so that they do not meet.
fn spread(actors: &mut [Actor]) {
    let mut below = f64::INFINITY;
    for actor in actors {
        let [low, high] = actor.range();
        let reach = actor.likeness.reach;
        if below.is_finite() {
            actor.lane.y = below - 1.15 * reach - high.y;
        }
        below = actor.lane.y + low.y - 1.15 * reach;
    }
}

fn view(actors: &[Actor], reach: f64, times: &[f64]) -> View {
    let far = Vec2::repeat(f64::INFINITY);
    let around = |ranges: &mut dyn Iterator<Item = [Vec2; 2]>| {
        ranges.fold([far, -far], |[low, high], range| [low.inf(&range[0]), high.sup(&range[1])])
    };
    let [low, high] = around(&mut actors.iter().map(Actor::range));
    let size = high - low;
    let margin = Vec2::new(1.45 * reach, 1.4 * reach);
    let lanes = actors.len() as f64 - 1.0;
    if size.x <= WHOLE[0] * reach && size.y <= (WHOLE[1] + 3.0 * lanes) * reach {
        return View { patch: Patch { low: low - margin, high: high + margin }, goes_along: false };
    }
    let around_middle = times.iter().map(|&time| {
        let middle = middle(actors, time);
        let at = |actor: &Actor| actor.motion.at(time).centre.xy() + actor.lane.xy() - middle;
        let places: Vec<Vec2> = actors.iter().map(at).collect();
        around(&mut places.iter().map(|place| [*place, *place]))
    });
    let [low, high] = around(&mut around_middle.collect::<Vec<_>>().into_iter());
    let start = middle(actors, 0.0);
    let margin = Vec2::new(3.0 * reach, 2.2 * reach);
    View {
        patch: Patch { low: start + low - margin, high: start + high + margin },
        goes_along: true,
    }
}

/// The middle of the rovers at a time, on the slope [m].
fn middle(actors: &[Actor], time: f64) -> Vec2 {
    let sum: Vec2 =
        actors.iter().map(|actor| actor.motion.at(time).centre.xy() + actor.lane.xy()).sum();
    sum / actors.len() as f64
}

/// Points that have to be on the picture.
fn extent(camera: &Camera, view: &View, actors: &[Actor], reach: f64, thickness: f64) -> Vec<Vec3> {
    let corners = view.patch.corners();
    let mut ends = corners.to_vec();
    ends.extend(corners.iter().map(|corner| based(camera, &corners, *corner, thickness)));
    ends.extend(corners.iter().map(|corner| corner - Vec3::new(0.2 * reach, 0.0, 0.0)));
    for actor in actors {
        let high = actor.likeness.head.high.z + 0.1 * actor.likeness.reach;
        let poses = actor.motion.poses();
        let shown = if view.goes_along { &poses[..1] } else { poses };
        ends.extend(shown.iter().map(|pose| actor.lane + pose.centre + Vec3::new(0.0, 0.0, high)));
    }
    ends
}

/// The point of the base under a point of the surface.
fn based(camera: &Camera, corners: &[Vec3; 4], point: Vec3, thickness: f64) -> Vec3 {
    let lowest = corners.iter().map(|corner| camera.vertical.dot(corner));
    let base = lowest.fold(f64::INFINITY, f64::min) - thickness;
    point + (base - camera.vertical.dot(&point)) * camera.vertical
}

/// The slope around all that is visited, with as much around it as is seen at once.
fn whole(patch: &Patch, actors: &[Actor]) -> Patch {
    let ends = actors.iter().map(Actor::range);
    let ends = ends.fold([patch.low, patch.high], |[low, high], [a, b]| {
        [low.inf(&(a - 0.5 * patch.size())), high.sup(&(b + 0.5 * patch.size()))]
    });
    Patch { low: ends[0], high: ends[1] }
}

/// From contour line to contour line, along the slope [m].
fn contour_step(patch: &Patch) -> f64 {
    nice(patch.size().y / 6.0)
}

/// Multiples of a step between two ends.
fn steps(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let first = (from / step).ceil();
    (0..).map(move |k| (first + f64::from(k)) * step).take_while(move |at| *at <= to)
}

/// The largest of 1, 2 and 5 times a power of ten that is not above a number.
pub(crate) fn nice(most: f64) -> f64 {
    let mut power = 1.0_f64;
    while power > most {
        power /= 10.0;
    }
    while 10.0 * power <= most {
        power *= 10.0;
    }
    [5.0, 2.0].into_iter().map(|step| step * power).find(|it| *it <= most).unwrap_or(power)
}

struct Painter {
    camera: Camera,
    /// How far the largest rover reaches from its centre, seen from above [m].
    reach: f64,
}

impl Painter {
    fn places(&self, points: &[Vec3]) -> Vec<Place> {
        points.iter().map(|point| self.camera.place(*point)).collect()
    }

    /// The piece of ground: its surface, and its sides that are seen.
    fn slab(&self, patch: &Patch, slope: f64, thickness: f64) -> Vec<Mark> {
        let corners = patch.corners();
        let base = corners.map(|corner| based(&self.camera, &corners, corner, thickness));
        let side = |a: usize, b: usize, role| {
            Mark::area(self.places(&[corners[a], corners[b], base[b], base[a]]), role)
        };
        let mut marks = vec![
            Mark::area(self.places(&corners), Role::Soil),
            side(0, 1, Role::SoilEdge),
            side(1, 2, Role::SoilSide),
        ];
        let line = Line::new(Role::Ink, 0.35);
        let (start, length) = Self::length(patch);
        let end = start + length * Vec3::x();
        marks.push(Mark::line(self.places(&[start, end]), line));
        for end in [start, end] {
            let [x, y] = self.camera.place(end);
            marks.push(Mark::line([[x, y - 0.9], [x, y + 0.9]], line));
        }
        if slope > 0.0 {
            let ([corner, end], radius) = self.angle(patch);
            let line = Line::new(Role::Ink, 0.3);
            marks.push(Mark::line(self.places(&[corner, end]), line.dashed()));
            let arc = (0..=12).map(|step| {
                let (sin, cos) = wide::sin_cos(slope * f64::from(step) / 12.0);
                corner + radius * (cos * self.camera.horizontal + sin * self.camera.vertical)
            });
            marks.push(Mark::line(self.places(&arc.collect::<Vec<_>>()), line));
            let [tail, tip] = self.uphill(patch);
            let way = self.camera.way(tip - tail);
            marks.extend(arrow(self.camera.place(tail), way, Role::Faint, 0.6));
        }
        marks
    }

    /// The horizontal line from which the slope's angle is shown, and the radius of the arc [m].
    fn angle(&self, patch: &Patch) -> ([Vec3; 2], f64) {
        let corner = patch.corners()[1];
        let radius = 0.5 * patch.size().y;
        ([corner, corner + 1.25 * radius * self.camera.horizontal], radius)
    }

    /// The arrow that points uphill, beside the patch.
    fn uphill(&self, patch: &Patch) -> [Vec3; 2] {
        let x = patch.low.x - 0.2 * self.reach;
        let at = |share: f64| Vec3::new(x, patch.low.y + share * patch.size().y, 0.0);
        [at(0.4), at(0.75)]
    }

    /// Where the length that is written on the downhill edge starts, and the length [m].
    fn length(patch: &Patch) -> (Vec3, f64) {
        let (low, size) = (patch.low, patch.size());
        let inside = Vec3::new(0.05 * size.x, 0.06 * size.y, 0.0);
        (Vec3::new(low.x, low.y, 0.0) + inside, nice(0.35 * size.x))
    }

    fn labels(&self, patch: &Patch, slope: f64) -> Vec<Label> {
        let below = |point: Vec3, by: f64| {
            let [x, y] = self.camera.place(point);
            [x, y + by]
        };
        let label = |text: String, at: Place| Label::new(text, at, Anchor::Middle);
        let (start, length) = Self::length(patch);
        let [x, y] = self.camera.place(start + length * Vec3::x());
        let mut labels = vec![label(format!("{length} m"), [x + 6.0, y + 2.6])];
        if slope > 0.0 {
            let [_, tip] = self.uphill(patch);
            let [x, y] = self.camera.place(tip);
            let at = [x - 2.0, y + 0.6];
            labels.push(Label::new("uphill", at, Anchor::End));
            let ([corner, _], radius) = self.angle(patch);
            let at = corner + 0.75 * radius * self.camera.horizontal;
            let degrees = (10.0 * slope.to_degrees()).round() / 10.0;
            labels.push(label(format!("{degrees}°"), below(at, 5.2)));
        }
        labels
    }

    /// Contour lines, or on level ground a grid; the contours through the starts, with a tick every
    /// so often; the length that is written on the edge.
    fn lines(
        &self,
        patch: &Patch,
        whole: &Patch,
        actors: &[Actor],
        slope: f64,
    ) -> Vec<(usize, Mark)> {
        let Patch { low, high } = *whole;
        let step = contour_step(patch);
        let thin = Line::new(Role::Contour, 0.25);
        let line = |a: [f64; 2], b: [f64; 2], line| {
            let ends = [a, b].map(|[x, y]| self.camera.place(Vec3::new(x, y, 0.0)));
            (0, Mark::line(ends, line))
        };
        let mut marks = Vec::new();
        marks.extend(steps(step, low.y, high.y).map(|y| line([low.x, y], [high.x, y], thin)));
        if slope <= 0.0 {
            marks.extend(steps(step, low.x, high.x).map(|x| line([x, low.y], [x, high.y], thin)));
        }
        for actor in actors {
            let y = actor.motion.start().centre.y + actor.lane.y;
            let tick = 0.05 * self.reach;
            let bold = Line::new(Role::Ink, 0.35);
            marks.push(line([low.x, y], [high.x, y], bold.dashed()));
            let ticks = steps(step, low.x, high.x);
            marks.extend(ticks.map(|x| line([x, y - tick], [x, y + tick], bold)));
        }
        marks
    }

    /// What the wheels leave in the soil: strips, and a line where each grouser was lowest.
    fn tracks(&self, actor: &Actor, times: &[f64]) -> Vec<(usize, Mark)> {
        /// Strips and lines nearer than this [mm] are not drawn apart.
        const APART: f64 = 0.7;
        let mut marks = Vec::new();
        for (index, mount) in actor.mounts.iter().enumerate() {
            let across = |time: f64| {
                let pose = actor.motion.at(time);
                let wheel = PlacedWheel::of(mount, &pose.wheels[index], &pose, actor.lane);
                let half = 0.5 * mount.unit.wheel.width * wheel.left;
                ([wheel.foot() - half, wheel.foot() + half], pose.wheels[index].turned)
            };
            let count = mount.unit.wheel.grousers.map_or(0, |grousers| grousers.count);
            let pitch = if count > 0 { TAU / f64::from(count) } else { f64::INFINITY };
            let far = |a: [Vec3; 2], b: [Vec3; 2]| {
                let moved = self.camera.scale * (a[0] - b[0]).norm().max((a[1] - b[1]).norm());
                moved >= APART
            };
            let (mut last, mut turned) = across(times[0]);
            let (mut print, mut before) = (last, last);
            for (frame, pair) in times.windows(2).enumerate() {
                let (here, now) = across(pair[1]);
                let lines = (now / pitch).floor() - (turned / pitch).floor();
                if lines != 0.0 {
                    // The last of the lines between two frames: those are not far from each other.
                    let share = ((now / pitch).floor() * pitch - turned) / (now - turned);
                    let time = pair[0] + share.clamp(0.0, 1.0) * (pair[1] - pair[0]);
                    let (at, _) = across(time);
                    if far(at, print) {
                        let line = Line::new(Role::Print, 0.3);
                        marks.push((frame + 1, Mark::line(self.places(&at), line)));
                        print = at;
                    }
                }
                turned = now;
                let is_last = frame + 2 == times.len();
                if far(here, last) || is_last {
                    // Each begins with the one before, so that there is no seam between them.
                    let strip = [before[0], before[1], here[1], here[0]];
                    marks.push((frame + 1, Mark::area(self.places(&strip), Role::Track)));
                    before = last;
                    last = here;
                }
            }
        }
        // A line lies on its strip, which is drawn up to a frame later.
        marks.sort_by_key(|(frame, mark)| (*frame, mark.fill.is_none()));
        marks
    }

    fn frame(&self, actors: &[Actor], view: &View, time: f64, per_newton: f64) -> Frame {
        let moved = if view.goes_along {
            middle(actors, time) - middle(actors, 0.0)
        } else {
            Vec2::zeros()
        };
        let offset = self.camera.way(Vec3::new(-moved.x, -moved.y, 0.0));
        let mut marks = Vec::new();
        // The first is the farthest uphill, behind the others.
        for actor in actors {
            let pose = actor.motion.at(time);
            self.rover(&mut marks, actor, &pose);
            self.forces(&mut marks, actor, &pose, per_newton);
        }
        let marks = marks.into_iter().map(|mark| mark.moved(offset)).collect();
        Frame { offset, marks }
    }

    fn rover(&self, marks: &mut Vec<Mark>, actor: &Actor, pose: &Pose) {
        let Likeness { body, mast, head, legs, .. } = &actor.likeness;
        marks.extend(self.shade(actor, pose, body));
        let wheels: Vec<PlacedWheel> = actor.wheels(pose).collect();
        let mut order: Vec<usize> = (0..wheels.len()).collect();
        let depth = |index: &usize| self.camera.towards.dot(&wheels[*index].hub);
        order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        // A wheel beside the body is before it, if the eye is on that side.
        let left = pose.slope_from_body(Vec2::y());
        let eye = self.camera.towards.xy().dot(&left);
        let is_near = |index: &usize| {
            let across = actor.mounts[*index].position.y;
            across.abs() > body.high.y && across * eye > 0.0
        };
        let [near, away]: [Vec<usize>; 2] = {
            let (near, away) = order.iter().partition(|index| is_near(index));
            [near, away]
        };
        for index in &away {
            self.wheel(marks, actor, pose, *index, &wheels[*index]);
        }
        let leg = |index: &usize| {
            let ends = [actor.of_body(pose, legs[*index]), wheels[*index].hub];
            let width = (0.09 * self.camera.scale * self.reach).clamp(0.5, 1.6);
            Mark::line(self.places(&ends), Line::new(Role::Rim, width))
        };
        marks.extend(away.iter().map(leg));
        self.block(marks, actor, pose, body);
        marks.extend(self.panel(actor, pose, body));
        self.block(marks, actor, pose, mast);
        self.block(marks, actor, pose, head);
        marks.extend(near.iter().map(leg));
        for index in &near {
            self.wheel(marks, actor, pose, *index, &wheels[*index]);
        }
    }

    /// The body's shade: the sun is overhead, somewhat from behind on the left.
    fn shade(&self, actor: &Actor, pose: &Pose, body: &Block) -> Option<Mark> {
        let sun = self.camera.vertical + Vec3::new(-0.25, 0.3, 0.0);
        let fall = |corner: Vec3| {
            let point = actor.of_body(pose, corner);
            self.camera.place(point - sun * (point.z / sun.z))
        };
        (sun.z > 0.1).then(|| Mark::area(hull(corners(body).map(fall).to_vec()), Role::Shade))
    }

    fn block(&self, marks: &mut Vec<Mark>, actor: &Actor, pose: &Pose, block: &Block) {
        let axes = [(0, Role::BodyDark), (1, Role::BodyLit), (2, Role::BodyTop)];
        for (axis, role) in axes {
            for is_high in [false, true] {
                let sign = if is_high { 1.0 } else { -1.0 };
                let mut normal = Vec3::zeros();
                normal[axis] = sign;
                let turned = pose.slope_from_body(normal.xy());
                let normal = Vec3::new(turned.x, turned.y, normal.z);
                if normal.dot(&self.camera.towards) <= 0.0 {
                    continue;
                }
                let ends = [[false, false], [true, false], [true, true], [false, true]];
                let face = ends.map(|[a, b]| {
                    let mut of = [is_high; 3];
                    of[(axis + 1) % 3] = a;
                    of[(axis + 2) % 3] = b;
                    actor.of_body(pose, block.corner(of))
                });
                let face = Mark::area(self.places(&over_ground(&face)), role);
                marks.push(face.outlined(Line::new(Role::Edge, 0.25)));
            }
        }
    }

    /// The solar panel on the body, in two rows of cells.
    fn panel(&self, actor: &Actor, pose: &Pose, body: &Block) -> Vec<Mark> {
        let size = body.high - body.low;
        let at = |x: f64, y: f64| {
            let along = Vec3::new(x * size.x, y * size.y, size.z);
            self.camera.place(actor.of_body(pose, body.low + along))
        };
        let line = Line::new(Role::BodyTop, 0.3);
        let (back, front) = (0.08, 0.7);
        let outline = [at(back, 0.1), at(front, 0.1), at(front, 0.9), at(back, 0.9)];
        let mut marks = vec![Mark::area(outline, Role::Panel)];
        marks.push(Mark::line([at(back, 0.5), at(front, 0.5)], line));
        let rows = (1..4).map(|k| back + (front - back) * f64::from(k) / 4.0);
        marks.extend(rows.map(|x| Mark::line([at(x, 0.1), at(x, 0.9)], line)));
        marks
    }

    fn wheel(
        &self,
        marks: &mut Vec<Mark>,
        actor: &Actor,
        pose: &Pose,
        index: usize,
        at: &PlacedWheel,
    ) {
        let (wheel, turned) = (&actor.mounts[index].unit.wheel, pose.wheels[index].turned);
        let (radius, tips, width) = (wheel.radius, wheel.shearing_radius(), wheel.width);
        let eye = self.camera.towards;
        let near = if eye.dot(&at.left) >= 0.0 { 0.5 * width } else { -0.5 * width };
        // From straight up, forward.
        let out = |angle: f64| {
            let (sin, cos) = wide::sin_cos(angle);
            at.forward * sin + Vec3::new(0.0, 0.0, cos)
        };
        let point =
            |angle: f64, radius: f64, across: f64| at.hub + across * at.left + radius * out(angle);
        // The hole that the wheel stands in.
        let half = (tips * tips - at.hub.z * at.hub.z).max(0.0).sqrt();
        if half > 0.0 {
            let corner = |along: f64, across: f64| {
                at.foot() + along * half * at.forward + across * 0.5 * width * at.left
            };
            let hole = [corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0), corner(-1.0, 1.0)];
            marks.push(Mark::area(self.places(&hole), Role::Shade));
        }
        let above = |points: Vec<Vec3>| self.places(&over_ground(&points));
        let grousers: Vec<f64> = wheel.grousers.map_or(Vec::new(), |grousers| {
            let step = TAU / f64::from(grousers.count.max(1));
            (0..grousers.count).map(|k| turned + step * f64::from(k)).collect()
        });
        let bar = |angle: f64| {
            let points = [
                point(angle, radius, near),
                point(angle, tips, near),
                point(angle, tips, -near),
                point(angle, radius, -near),
            ];
            Mark::area(above(points.to_vec()), Role::Grouser)
                .outlined(Line::new(Role::Grouser, 0.2))
        };
        let faces = |angle: &f64| out(*angle).dot(&eye) > 0.0;
        let is_drawn = |mark: &Mark| mark.points.len() > 2;
        marks.extend(
            grousers.iter().filter(|angle| !faces(angle)).map(|it| bar(*it)).filter(is_drawn),
        );
        // Half of the rim faces the eye.
        let top = wide::atan2(at.forward.dot(&eye), eye.z);
        let half_round = ROUND / 2;
        let angle = |k: u32| top - FRAC_PI_2 + PI * f64::from(k) / f64::from(half_round);
        let mut rim: Vec<Vec3> = (0..=half_round).map(|k| point(angle(k), radius, near)).collect();
        rim.extend((0..=half_round).rev().map(|k| point(angle(k), radius, -near)));
        marks.push(Mark::area(above(rim), Role::Rim));
        marks.extend(grousers.iter().filter(|angle| faces(angle)).map(|it| bar(*it)));
        let disc = |radius: f64, count: u32| {
            let turn = TAU / f64::from(count);
            above((0..count).map(|k| point(turn * f64::from(k), radius, near)).collect())
        };
        marks.push(Mark::area(disc(radius, ROUND), Role::Rim));
        marks.push(Mark::area(disc(0.84 * radius, ROUND), Role::Wheel));
        const SPOKES: u32 = 5;
        for spoke in 0..SPOKES {
            let angle = turned + TAU * f64::from(spoke) / f64::from(SPOKES);
            let side = 0.075 * radius;
            let (out, along) = (out(angle), out(angle + FRAC_PI_2));
            let centre = at.hub + near * at.left;
            let corners = [
                centre + 0.1 * radius * out + side * along,
                centre + 0.84 * radius * out + side * along,
                centre + 0.84 * radius * out - side * along,
                centre + 0.1 * radius * out - side * along,
            ];
            let mark = Mark::area(above(corners.to_vec()), Role::Rim);
            marks.extend(Some(mark).filter(is_drawn));
        }
        marks.push(Mark::area(disc(0.2 * radius, 10), Role::Rim));
    }

    /// Under each wheel the soil's force on it, and its part along the slope.
    fn forces(&self, marks: &mut Vec<Mark>, actor: &Actor, pose: &Pose, per_newton: f64) {
        for (at, wheel) in actor.wheels(pose).zip(&pose.wheels) {
            let force = per_newton * at.slope_from_wheel(wheel.force);
            let along = Vec3::new(force.x, force.y, 0.0);
            for (way, role) in [(force, Role::Force), (along, Role::Thrust)] {
                let (tail, way) = (self.camera.place(at.foot()), self.camera.way(way));
                // A light edge, so that it is seen before a dark wheel.
                let shaft = arrow(tail, way, Role::Paper, ARROW);
                marks.extend(shaft.into_iter().map(|mark| {
                    let width = mark.line.map_or(0.0, |line| line.width) + 0.7;
                    mark.outlined(Line::new(Role::Halo, width))
                }));
                marks.extend(arrow(tail, way, role, ARROW));
            }
        }
    }
}

fn corners(block: &Block) -> [Vec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|k: u8| block.corner([k & 1 > 0, k & 2 > 0, k & 4 > 0]))
}
