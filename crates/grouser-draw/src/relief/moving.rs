//! Runs over ground with heights in motion: the drawing of a way, with the rover at each time and
//! its way behind it.
//!
//! One run has the view from above, the oblique one and the cut along its way. Several have an
//! oblique view each, to one scale where they are on the same ground, and then one from above for
//! all ways.

use std::f64::consts::TAU;

use crate::sheet::Place;
use grouser_core::elementary::wide;
use grouser_core::terrain;
use grouser_core::units::{Vec2, Vec3};

use super::drawing::Drawing;
use super::labels::{ABOVE, BELOW, LEFT, name};
use super::profile::{Profile, Room};
use super::rover::{Drawn, Stance};
use super::view::View;
use super::{
    AROUND, Surface, WAY, from_above_in, of_surface_from_above, of_surface_obliquely, views,
};
use crate::marks::{Line, Mark};
use crate::motion::Pose;
use crate::outline::reach;
use crate::scene::{Actor, Around, Frame, Scene};
use crate::shown::{Shown, TOP, WIDTH};
use crate::step::round_step;
use crate::style::Role;

/// Width of the view from above where there is one run, and the most that it is high [mm].
const COLUMN: f64 = 58.0;
/// Width of a view where there are several runs, and the most that it is high [mm].
const CELL: Place = [72.0, 46.0];
/// How high the cut along a way is at most [mm].
const CUT: f64 = 20.0;
/// Rovers that would be shorter on the picture are drawn larger than they are [mm]. Source: ours;
/// about two letters.
const SHORTEST: f64 = 7.0;
/// Pieces of a way are no shorter on the picture [mm].
const PIECE: f64 = 0.4;
/// Radius of the mark on the cut [mm].
const MARK: f64 = 1.2;
/// The ways' colours, where there are several.
const WAYS: [Role; 5] = [Role::Path, Role::Force, Role::Side, Role::Normal, Role::Ink];

/// The pictures of runs over ground with heights.
///
/// * `actors`: the runs, in the same order
/// * `times`: of the frames [s]
pub(crate) fn scene_of(actors: &[Actor], runs: &[Shown<'_>], times: &[f64]) -> Scene {
    let poses_at = |actor: &Actor| times.iter().map(|time| actor.motion.at(*time)).collect();
    let poses: Vec<Vec<Pose>> = actors.iter().map(poses_at).collect();
    let mut stage = Stage::default();
    let surfaces = surfaces(actors, runs);
    if let ([run], [surface]) = (runs, &surfaces[..]) {
        stage.one(run, surface, &poses[0]);
    } else {
        stage.several(runs, &surfaces, &poses);
    }
    stage.left.sort_by_key(|(frame, _)| *frame);
    let (width, height) = (WIDTH, stage.height);
    Scene {
        still: stage.still.marks,
        window: vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]],
        left: stage.left,
        frames: stage.frames,
        labels: stage.still.labels,
        height,
        ground: Around::Heights(surfaces),
        arrow: None,
    }
}

/// The ground around all ways, or around each where runs are on different ground.
fn surfaces(actors: &[Actor], runs: &[Shown<'_>]) -> Vec<Surface> {
    let margin = runs.iter().map(|run| reach(&run.scenario.rover)).fold(0.0, f64::max);
    let places = |actor: &'_ Actor| -> Vec<Vec2> {
        actor.motion.poses().iter().map(|pose| pose.centre.xy()).collect()
    };
    let around = |run: &Shown<'_>, places: Vec<Vec2>| {
        Surface::around(&run.scenario.ground, places.into_iter(), AROUND * margin)
    };
    let (first, others) = (&runs[0].scenario.ground, &runs[1..]);
    let is_same =
        |ground: &terrain::Ground| ground.shape == first.shape && ground.start == first.start;
    if others.iter().all(|run| is_same(&run.scenario.ground)) {
        return vec![around(&runs[0], actors.iter().flat_map(places).collect())];
    }
    runs.iter().zip(actors).map(|(run, actor)| around(run, places(actor))).collect()
}

/// What is drawn, by when.
#[derive(Default)]
struct Stage {
    still: Drawing,
    left: Vec<(usize, Mark)>,
    frames: Vec<Frame>,
    /// Where the drawing ends [mm].
    height: f64,
}

impl Stage {
    fn one(&mut self, run: &Shown<'_>, surface: &Surface, poses: &[Pose]) {
        let ground = &run.scenario.ground;
        let (from_above, oblique, under) = views(surface, TOP, COLUMN, WIDTH);
        let times = enlargement(&[run], &oblique);
        self.add(of_surface_from_above(surface, ground.start, &from_above));
        self.add(of_surface_obliquely(surface, &oblique, &note(times)));
        for view in [&from_above, &oblique] {
            self.drive(view, run, poses, (Role::Path, times));
        }
        let way: Vec<Vec3> = poses.iter().map(|pose| pose.centre).collect();
        let room = Room { across: WIDTH - LEFT - 6.0, highest: CUT };
        let profile = Profile::of(ground, &way, room).at([LEFT, under]);
        self.add(profile.ground());
        let way = profile.way();
        self.way(&way, Role::Path);
        for (frame, place) in self.frames.iter_mut().zip(way) {
            frame.marks.push(dot(place));
        }
        self.height = under + profile.height();
    }

    fn several(&mut self, runs: &[Shown<'_>], surfaces: &[Surface], poses: &[Vec<Pose>]) {
        let role_of = |index: usize| WAYS[index % WAYS.len()];
        let all: Vec<&Shown<'_>> = runs.iter().collect();
        // Views are no higher than the highest needs to be.
        let needed = surfaces.iter().map(height_in_cell).fold(0.0, f64::max);
        let size = [CELL[0], CELL[1].min(needed)];
        let mut cells = Cells { next: 0, high: size[1], top: TOP, lowest: TOP };
        let oblique =
            |surface: &Surface, corner| View::oblique().framing(&surface.corners(), corner, size);
        if let [surface] = surfaces {
            let [left, top] = cells.corner(BELOW);
            let view = from_above_in(surface, [left + LEFT, top], [size[0] - LEFT - 4.0, size[1]]);
            self.add(of_surface_from_above(surface, runs[0].scenario.ground.start, &view));
            let times = enlargement(&all, &oblique(surface, [0.0, 0.0]));
            for (index, run) in runs.iter().enumerate() {
                self.drive(&view, run, &poses[index], (role_of(index), times));
            }
        }
        for (index, run) in runs.iter().enumerate() {
            let surface = surfaces.get(index).unwrap_or(&surfaces[0]);
            let corner = cells.corner(3.0);
            let view = oblique(surface, corner);
            let times = enlargement(&all, &view);
            let mut ground = of_surface_obliquely(surface, &view, "");
            let title = format!("{}{}", run.name, note(times));
            let [x, y] = corner;
            ground.labels = vec![name(title, x, y - 3.0)];
            self.add(ground);
            self.drive(&view, run, &poses[index], (role_of(index), times));
        }
        self.height = cells.lowest + 2.0;
    }

    fn add(&mut self, drawing: Drawing) {
        self.still.marks.extend(drawing.marks);
        self.still.labels.extend(drawing.labels);
    }

    /// A rover in a view, and its way behind it.
    ///
    /// * `look`: colour of the way, and how many times its size the rover is drawn
    fn drive(&mut self, view: &View, run: &Shown<'_>, poses: &[Pose], look: (Role, f64)) {
        let (role, times) = look;
        let way: Vec<Place> = poses.iter().map(|pose| view.place(pose.centre)).collect();
        self.way(&way, role);
        let rover = Drawn::of(&run.scenario.rover).enlarged(times);
        let mounts = run.scenario.rover.mounts();
        self.frames.resize_with(poses.len(), || Frame { offset: [0.0, 0.0], marks: Vec::new() });
        for (frame, pose) in self.frames.iter_mut().zip(poses) {
            frame.marks.extend(rover.marks(view, &Stance::of_pose(pose, mounts)));
        }
    }

    /// A way in pieces, each of which is there once the rover has come so far.
    ///
    /// * `way`: its place in each frame
    fn way(&mut self, way: &[Place], role: Role) {
        let mut from = 0;
        for (frame, place) in way.iter().enumerate().skip(1) {
            let [x, y] = [0, 1].map(|axis| place[axis] - way[from][axis]);
            if wide::hypot(x, y) >= PIECE || frame + 1 == way.len() {
                let piece = way[from..=frame].iter().copied();
                self.left.push((frame, Mark::line(piece, Line::new(role, WAY))));
                from = frame;
            }
        }
    }
}

/// How high an oblique view is that is as wide as there is room [mm].
fn height_in_cell(surface: &Surface) -> f64 {
    let corners = surface.corners();
    let view = View::oblique().framing(&corners, [0.0, 0.0], [CELL[0], 10.0 * CELL[0]]);
    let ends = corners.iter().map(|corner| view.place(*corner)[1]);
    let [low, high] = ends
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
    high - low
}

/// Rooms for views, two in a row.
struct Cells {
    next: usize,
    /// How high views are [mm].
    high: f64,
    /// Where the row begins [mm].
    top: f64,
    /// How far down the views so far reach [mm].
    lowest: f64,
}

impl Cells {
    /// The upper left corner of the next view.
    ///
    /// * `below`: room that it needs below [mm]
    fn corner(&mut self, below: f64) -> Place {
        let is_first = self.next.is_multiple_of(2);
        if is_first {
            self.top = self.lowest;
        }
        self.next += 1;
        let top = self.top + ABOVE;
        self.lowest = self.lowest.max(top + self.high + below);
        [if is_first { 4.0 } else { WIDTH - 4.0 - CELL[0] }, top]
    }
}

/// How many times their size rovers are drawn, so that they are seen.
fn enlargement(runs: &[&Shown<'_>], view: &View) -> f64 {
    let longest = runs.iter().map(|run| reach(&run.scenario.rover)).fold(0.0, f64::max);
    let length = view.length(2.0 * longest);
    if length >= SHORTEST { 1.0 } else { round_step(SHORTEST / length) }
}

/// The enlargement, for the name of a view.
fn note(times: f64) -> String {
    if times > 1.0 { format!(", rover × {times}") } else { String::new() }
}

/// Where the rover is on the cut.
fn dot(at: Place) -> Mark {
    /// Corners of the round mark.
    const CORNERS: u32 = 12;
    let corner = |place: u32| {
        let (sin, cos) = wide::sin_cos(TAU * f64::from(place) / f64::from(CORNERS));
        [at[0] + MARK * cos, at[1] + MARK * sin]
    };
    let mark = Mark::area((0..CORNERS).map(corner), Role::Path);
    mark.outlined(Line::new(Role::Halo, 0.3))
}
