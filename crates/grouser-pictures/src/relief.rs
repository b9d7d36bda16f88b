//! Ground with heights and a rover's way over it: from above, obliquely, and cut along the way.

mod labels;
mod profile;
mod rover;
mod surface;
mod view;

pub use surface::shade_of;

use grouser_core::simulation::{Record, Scenario};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::Posture;
use grouser_page::{Anchor, Place, Shape, Sheet, Stroke, Text};

use self::labels::{ABOVE, BELOW, LEFT, LETTERS, WIDTH, multiples, name, number};
use self::profile::Profile;
use self::surface::Surface;
use self::view::View;
use crate::outline::reach;
use crate::step::round_step;
use crate::style::{Ground, Role, on_both_grounds};

/// Width of either column, and the most that the view from above is high [mm].
const COLUMN: f64 = 72.0;
/// About as many lines of contour, and numbers along an axis.
const CONTOURS: f64 = 10.0;
const NUMBERS: f64 = 4.0;
/// Rovers stand along the way no nearer to each other than so many times their reach.
const APART: f64 = 4.0;
/// At most as many of them.
const ROVERS: usize = 6;

/// The ground around a way and the rover on it, to scale, as SVG; none for a run on a plane.
///
/// * `records`: in the order of time; the first is the start
#[must_use]
pub fn relief_of(title: &str, scenario: &Scenario, records: &[Record]) -> Option<String> {
    let ground = &scenario.ground;
    if ground.is_plane() {
        return None;
    }
    let surface = Surface::around(ground, records, 2.0 * reach(&scenario.rover));
    let standing = standing(scenario, records);
    let profile = Profile::of(ground, records);
    let drawn = Drawn { surface, origin: ground.start, way: way(records), standing, scenario };
    let (from_above, oblique, under) = drawn.views();
    let height = under + profile.height();
    let mut sheet = Sheet::new(title, WIDTH, height).on(Role::Paper.on(Ground::Light));
    drawn.draw_from_above(&mut sheet, &from_above);
    drawn.draw_obliquely(&mut sheet, &oblique);
    profile.draw(&mut sheet, [LEFT, under]);
    Some(on_both_grounds(&sheet))
}

/// What is drawn, in metres from the start; heights are those of the ground.
struct Drawn<'a> {
    surface: Surface,
    /// The start in the ground's coordinates.
    origin: Vec2,
    /// The body's centre of mass over time.
    way: Vec<Vec3>,
    /// Some postures along it.
    standing: Vec<Posture>,
    scenario: &'a Scenario,
}

fn way(records: &[Record]) -> Vec<Vec3> {
    let place = |record: &Record| Some(record.state.position.push(record.standing()?.height));
    records.iter().filter_map(place).collect()
}

/// Postures of the start, the end and some records between them.
fn standing(scenario: &Scenario, records: &[Record]) -> Vec<Posture> {
    let posture = |record: &Record| {
        let sinkages: Vec<f64> =
            record.wheels.iter().map(|wheel| wheel.reaction.settled.sinkage).collect();
        let angles: Vec<f64> = record.wheels.iter().map(|wheel| wheel.steering).collect();
        let rover = scenario.rover.steered(&angles).ok()?;
        let state = &record.state;
        Posture::of(&rover, &scenario.ground, state.position, state.yaw, &sinkages).ok()
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
            chosen.extend(posture(record));
            next = gone + apart;
        }
    }
    chosen.extend(records.iter().rev().find_map(posture));
    chosen
}

impl Drawn<'_> {
    /// The views from above and, beside it, obliquely; and how far down they reach [mm].
    fn views(&self) -> (View, View, f64) {
        let size = self.surface.size();
        let scale = (COLUMN / size.x).min(COLUMN / size.y);
        let corner = [LEFT + 0.5 * (COLUMN - scale * size.x), ABOVE];
        let north_west = self.surface.low + Vec2::new(0.0, size.y);
        let from_above = View::from_above(scale).with(north_west, corner);
        let high = (scale * size.y).max(0.5 * COLUMN);
        let beside = LEFT + COLUMN + 10.0;
        let oblique = View::oblique().framing(
            &self.surface.corners(),
            [beside, ABOVE],
            [WIDTH - beside - 4.0, high + 0.5 * BELOW],
        );
        (from_above, oblique, ABOVE + high + BELOW)
    }

    fn draw_from_above(&self, sheet: &mut Sheet, view: &View) {
        let Surface { low, .. } = self.surface;
        let size = self.surface.size();
        let high = low + size;
        let [left, top] = view.place(Vec3::new(low.x, high.y, 0.0));
        name(sheet, "from above, north up", [left, top - 3.0]);
        for (points, role) in self.surface.shades(view) {
            fill(sheet, points, role);
        }
        let [bottom, highest] = self.surface.heights_between();
        let step = round_step(((highest - bottom) / CONTOURS).max(1e-3));
        let stroke = Stroke::new(0.2, Role::Print.on(Ground::Light));
        for line in self.surface.contours(step) {
            sheet.draw(Shape::line(line.map(|at| view.place(at.push(0.0))), stroke));
        }
        self.numbers(sheet, view);
        self.path(sheet, view);
        self.rovers(sheet, view);
        let text = format!("contours every {step} m of height");
        let faint = Role::Faint.on(Ground::Light);
        let [_, under] = view.place(low.push(0.0));
        sheet.text(Text::new(text, LETTERS).colour(faint), [left, under + BELOW - 2.0]);
    }

    /// Coordinates of the map along two sides.
    fn numbers(&self, sheet: &mut Sheet, view: &View) {
        let (low, high) = (self.surface.low, self.surface.low + self.surface.size());
        let step = round_step((high - low).max() / NUMBERS);
        let faint = Role::Faint.on(Ground::Light);
        let tick = Stroke::new(0.2, faint);
        let at =
            |axis: usize| multiples(step, (low + self.origin)[axis], (high + self.origin)[axis]);
        for x in at(0) {
            let [x_mm, y_mm] = view.place(Vec3::new(x - self.origin.x, low.y, 0.0));
            sheet.draw(Shape::line([[x_mm, y_mm], [x_mm, y_mm + 1.2]], tick));
            sheet.text(number(x).anchor(Anchor::Middle), [x_mm, y_mm + 4.8]);
        }
        for y in at(1) {
            let [x_mm, y_mm] = view.place(Vec3::new(low.x, y - self.origin.y, 0.0));
            sheet.draw(Shape::line([[x_mm - 1.2, y_mm], [x_mm, y_mm]], tick));
            sheet.text(number(y).anchor(Anchor::End), [x_mm - 1.8, y_mm + 1.1]);
        }
        let [right, under] = view.place(Vec3::new(high.x, low.y, 0.0));
        sheet.text(Text::new("m", LETTERS).colour(faint), [right + 1.5, under + 4.8]);
    }

    fn draw_obliquely(&self, sheet: &mut Sheet, view: &View) {
        let [left, top] = view.corner;
        name(sheet, "from the south-east", [left, top - 3.0]);
        for (points, role) in self.surface.shades(view) {
            fill(sheet, points, role);
        }
        self.path(sheet, view);
        self.rovers(sheet, view);
    }

    fn path(&self, sheet: &mut Sheet, view: &View) {
        let stroke = Stroke::new(0.6, Role::Path.on(Ground::Light)).rounded();
        sheet.draw(Shape::line(self.way.iter().map(|point| view.place(*point)), stroke));
    }

    fn rovers(&self, sheet: &mut Sheet, view: &View) {
        let mut all: Vec<&Posture> = self.standing.iter().collect();
        all.sort_by(|a, b| view.depth(a.place).total_cmp(&view.depth(b.place)));
        for posture in all {
            rover::draw(sheet, view, posture, &self.scenario.rover);
        }
    }
}

/// An area without gaps to its neighbours.
fn fill(sheet: &mut Sheet, points: Vec<Place>, role: Role) {
    let colour = role.on(Ground::Light);
    sheet.draw(Shape::area(points, colour).outlined(Stroke::new(0.1, colour)));
}
