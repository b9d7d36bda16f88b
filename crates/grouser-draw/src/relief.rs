//! Ground with heights and a rover's way over it: from above, obliquely, and cut along the way.

mod drawing;
mod labels;
mod moving;
mod profile;
mod rover;
mod surface;
mod view;

pub(crate) use moving::scene_of;
pub(crate) use surface::Surface;
pub use surface::shade_of;

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::simulation::{Record, Scenario};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::Posture;

use self::drawing::Drawing;
use self::labels::{ABOVE, BELOW, LEFT, WIDTH, multiples, name, number};
use self::profile::{Profile, Room};
use self::rover::{Drawn, Stance};
use self::view::View;
use crate::marks::{Line, Mark};
use crate::outline::reach;
use crate::scene::Label;
use crate::step::round_step;
use crate::style::{Ground, Role, on_both_grounds};

/// Width of the view from above, and the most that it is high [mm].
const COLUMN: f64 = 72.0;
/// About as many lines of contour, and numbers along an axis.
const CONTOURS: f64 = 10.0;
const NUMBERS: f64 = 4.0;
/// Rovers stand along the way no nearer to each other than so many times their reach.
const APART: f64 = 4.0;
/// At most as many of them.
const ROVERS: usize = 6;
/// How far the ground is drawn around a way, over the rover's reach.
const AROUND: f64 = 2.0;
/// Width of a way's line [mm].
const WAY: f64 = 0.6;

/// The ground around a way and the rover on it, to scale, as SVG; none for a run on a plane.
///
/// * `records`: in the order of time; the first is the start
#[must_use]
pub fn relief_of(title: &str, scenario: &Scenario, records: &[Record]) -> Option<String> {
    let ground = &scenario.ground;
    if ground.is_plane() {
        return None;
    }
    let places = records.iter().map(|record| record.state.position);
    let surface = Surface::around(ground, places, AROUND * reach(&scenario.rover));
    let way = way(records);
    let room = Room { across: WIDTH - LEFT - 8.0, highest: 34.0 };
    let profile = Profile::of(ground, &way, room);
    let (from_above, oblique, under) = views(&surface, 0.0, COLUMN, WIDTH);
    let still = [
        of_surface_from_above(&surface, ground.start, &from_above),
        of_surface_obliquely(&surface, &oblique, ""),
    ];
    let height = under + profile.height();
    let mut sheet = Sheet::new(title, WIDTH, height).on(Role::Paper.on(Ground::Light));
    let rover = Drawn::of(&scenario.rover);
    let stances = stances(scenario, records);
    for (still, view) in still.iter().zip([&from_above, &oblique]) {
        still.draw(&mut sheet);
        let line = Line::new(Role::Path, WAY);
        let way = Mark::line(way.iter().map(|point| view.place(*point)), line);
        way.draw(&mut sheet, Ground::Light);
        let mut all: Vec<&Stance> = stances.iter().collect();
        all.sort_by(|a, b| view.depth(a.centre).total_cmp(&view.depth(b.centre)));
        for mark in all.into_iter().flat_map(|stance| rover.marks(view, stance)) {
            mark.draw(&mut sheet, Ground::Light);
        }
    }
    let profile = profile.at([LEFT, under]);
    profile.ground().draw(&mut sheet);
    Mark::line(profile.way(), Line::new(Role::Path, WAY)).draw(&mut sheet, Ground::Light);
    Some(on_both_grounds(&sheet))
}

fn way(records: &[Record]) -> Vec<Vec3> {
    let place = |record: &Record| Some(record.state.position.push(record.standing()?.height));
    records.iter().filter_map(place).collect()
}

/// How the rover stands at the start, at the end and in some records between them.
fn stances(scenario: &Scenario, records: &[Record]) -> Vec<Stance> {
    let stance = |record: &Record| {
        let sinkages: Vec<f64> =
            record.wheels.iter().map(|wheel| wheel.reaction.settled.sinkage).collect();
        let angles: Vec<f64> = record.wheels.iter().map(|wheel| wheel.steering).collect();
        let rover = scenario.rover.steered(&angles).ok()?;
        let state = &record.state;
        let posture =
            Posture::of(&rover, &scenario.ground, state.position, state.yaw, &sinkages).ok()?;
        Some(Stance::of_posture(&posture))
    };
    let length: f64 = records
        .windows(2)
        .map(|pair| (pair[1].state.position - pair[0].state.position).norm())
        .sum();
    let apart = (APART * reach(&scenario.rover)).max(length / ROVERS as f64);
    let mut gone = 0.0;
    let mut next = 0.0;
    let mut chosen = Vec::new();
    for (place, record) in records.iter().enumerate() {
        if let Some(before) = place.checked_sub(1) {
            gone += (record.state.position - records[before].state.position).norm();
        }
        // The end stands for itself.
        let is_near_the_end = place > 0 && length - gone < 0.9 * apart;
        if gone >= next && !is_near_the_end {
            chosen.extend(stance(record));
            next = gone + apart;
        }
    }
    chosen.extend(records.iter().rev().find_map(stance));
    chosen
}

/// The views from above and, beside it, obliquely; and how far down they reach [mm].
///
/// * `top`: how far down the room for them begins [mm]
/// * `column`: width of the view from above, and the most that it is high [mm]
/// * `width`: of the sheet [mm]
fn views(surface: &Surface, top: f64, column: f64, width: f64) -> (View, View, f64) {
    let top = top + ABOVE;
    let from_above = from_above_in(surface, [LEFT, top], [column, column]);
    let high = from_above.length(surface.size().y).max(0.5 * column);
    let beside = LEFT + column + 10.0;
    let size = [width - beside - 4.0, high + 0.5 * BELOW];
    let oblique = View::oblique().framing(&surface.corners(), [beside, top], size);
    (from_above, oblique, top + high + BELOW)
}

/// The view from above in a rectangle, at its upper edge [mm].
fn from_above_in(surface: &Surface, [left, top]: Place, most: Place) -> View {
    let size = surface.size();
    let scale = (most[0] / size.x).min(most[1] / size.y);
    let corner = [left + 0.5 * (most[0] - scale * size.x), top];
    View::from_above(scale).with(surface.low + Vec2::new(0.0, size.y), corner)
}

/// The ground with contour lines, and coordinates of the map along two sides.
///
/// * `origin`: the start in the ground's coordinates [m]
fn of_surface_from_above(surface: &Surface, origin: Vec2, view: &View) -> Drawing {
    let low = surface.low;
    let size = surface.size();
    let [left, top] = view.place(Vec3::new(low.x, low.y + size.y, 0.0));
    let mut drawing = Drawing {
        marks: shades(surface, view),
        labels: vec![name("from above, north up", left, top - 3.0)],
    };
    let step = contour_step(surface);
    let line = Line::new(Role::Print, 0.2);
    let contours = surface.contours(step).into_iter();
    drawing.marks.extend(contours.map(|ends| Mark::line(ends.map(|at| view.place(at)), line)));
    numbers(&mut drawing, surface, origin, view);
    let [_, under] = view.place(low.push(0.0));
    let text = format!("contours every {step} m of height");
    let at = [left, under + BELOW - 2.0];
    drawing.labels.push(Label::new(text, at, Anchor::Start).coloured(Role::Faint));
    drawing
}

/// From contour line to contour line [m].
pub(crate) fn contour_step(surface: &Surface) -> f64 {
    let [bottom, highest] = surface.heights_between();
    round_step(((highest - bottom) / CONTOURS).max(1e-3))
}

/// Coordinates of the map along two sides.
fn numbers(drawing: &mut Drawing, surface: &Surface, origin: Vec2, view: &View) {
    let (low, high) = (surface.low, surface.low + surface.size());
    let step = round_step((high - low).max() / NUMBERS);
    let tick = Line::new(Role::Faint, 0.2);
    let at = |axis: usize| multiples(step, (low + origin)[axis], (high + origin)[axis]);
    for x in at(0) {
        let [x_mm, y_mm] = view.place(Vec3::new(x - origin.x, low.y, 0.0));
        drawing.marks.push(Mark::line([[x_mm, y_mm], [x_mm, y_mm + 1.2]], tick));
        drawing.labels.push(number(x, [x_mm, y_mm + 4.8], Anchor::Middle));
    }
    for y in at(1) {
        let [x_mm, y_mm] = view.place(Vec3::new(low.x, y - origin.y, 0.0));
        drawing.marks.push(Mark::line([[x_mm - 1.2, y_mm], [x_mm, y_mm]], tick));
        drawing.labels.push(number(y, [x_mm - 1.8, y_mm + 1.1], Anchor::End));
    }
    let [right, under] = view.place(Vec3::new(high.x, low.y, 0.0));
    let unit = Label::new("m", [right + 1.5, under + 4.8], Anchor::Start);
    drawing.labels.push(unit.coloured(Role::Faint));
}

/// The ground from the south-east.
///
/// * `note`: after the name of the view
fn of_surface_obliquely(surface: &Surface, view: &View, note: &str) -> Drawing {
    let [left, top] = view.corner;
    let name = name(format!("from the south-east{note}"), left, top - 3.0);
    Drawing { marks: shades(surface, view), labels: vec![name] }
}

/// The ground's cells in their shades, without gaps between them.
fn shades(surface: &Surface, view: &View) -> Vec<Mark> {
    let area = |(points, role)| Mark::area(points, role).outlined(Line::new(role, 0.1));
    surface.shades(view).map(area).collect()
}
