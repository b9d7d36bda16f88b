//! Arrows, arcs and symbols with an index, on a sheet.

use crate::sheet::{Anchor, Colour, Face, Place, Shape, Sheet, Stroke, Text};
use grouser_core::elementary::wide;
use grouser_core::vehicle::Rover;

use crate::style::{Ground, Role};

/// Height of letters [mm].
pub(super) const LETTERS: f64 = 3.6;
/// Height of the letters of an index [mm].
const INDEX: f64 = 2.5;
/// Length of an arrow's head [mm].
const HEAD: f64 = 2.6;

/// Draws on one sheet, in colours by role.
pub(super) struct Pen {
    pub(super) sheet: Sheet,
}

impl Pen {
    pub(super) fn new(title: &str, [width, height]: Place) -> Self {
        Self { sheet: Sheet::new(title, width, height).on(colour(Role::Paper)) }
    }

    pub(super) fn line(&mut self, points: impl IntoIterator<Item = Place>, role: Role, width: f64) {
        self.sheet.draw(Shape::line(points, Stroke::new(width, colour(role)).rounded()));
    }

    pub(super) fn dashed(&mut self, from: Place, to: Place, role: Role) {
        let stroke = Stroke::new(0.3, colour(role)).dashed(1.6, 1.2);
        self.sheet.draw(Shape::line([from, to], stroke));
    }

    pub(super) fn area(&mut self, points: impl IntoIterator<Item = Place>, role: Role) {
        self.sheet.draw(Shape::area(points, colour(role)));
    }

    pub(super) fn faint_area(&mut self, points: impl IntoIterator<Item = Place>, role: Role) {
        self.sheet.draw(Shape::area(points, colour(role).opacity(0.22)));
    }

    pub(super) fn outlined(
        &mut self,
        points: impl IntoIterator<Item = Place>,
        fill: Role,
        line: Role,
    ) {
        let stroke = Stroke::new(0.4, colour(line)).rounded();
        self.sheet.draw(Shape::area(points, colour(fill)).outlined(stroke));
    }

    /// The outline of a rover's body and its wheels.
    ///
    /// * `reach`: how far out the hubs are on paper [mm]
    /// * `at`: where a place of the body is on paper, by the scale [mm/m], x and y [m]
    pub(super) fn rover_from_above(
        &mut self,
        rover: &Rover,
        reach: f64,
        at: impl Fn(f64, f64, f64) -> Place,
    ) {
        let mounts = rover.mounts();
        let [long, wide] = [0, 1]
            .map(|k| mounts.iter().fold(0.0_f64, |most, mount| most.max(mount.position[k].abs())));
        let scale = reach / long.max(wide).max(1e-9);
        let at = |x: f64, y: f64| at(scale, x, y);
        let [x, y] = [0.9 * long, 0.6 * wide];
        self.outlined([at(-x, -y), at(x, -y), at(x, y), at(-x, y)], Role::BodyTop, Role::BodyDark);
        for mount in mounts {
            let (radius, half) = (mount.shearing_radius(), mount.unit.wheel.width / 2.0);
            let [x, y] = [mount.position.x, mount.position.y];
            let corners = [[-radius, -half], [radius, -half], [radius, half], [-radius, half]];
            self.outlined(corners.map(|[dx, dy]| at(x + dx, y + dy)), Role::Wheel, Role::Rim);
        }
    }

    /// An arrow, with a smaller head where it is short; nothing where it has no length.
    pub(super) fn arrow(&mut self, from: Place, to: Place, role: Role, width: f64) {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        if length < 0.05 {
            return;
        }
        let head = HEAD.min(0.6 * length);
        let [x, y] = [way[0] / length, way[1] / length];
        let neck = [to[0] - head * x, to[1] - head * y];
        let side = 0.36 * head;
        self.line([from, neck], role, width);
        self.area(
            [
                to,
                [neck[0] - side * y, neck[1] + side * x],
                [neck[0] + side * y, neck[1] - side * x],
            ],
            role,
        );
    }

    /// A line with an arrow at both ends.
    pub(super) fn dimension(&mut self, from: Place, to: Place) {
        let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
        self.arrow(middle, from, Role::Ink, 0.25);
        self.arrow(middle, to, Role::Ink, 0.25);
    }

    /// An arc around a centre, between two angles from straight down, positive to the right [rad].
    pub(super) fn arc(&mut self, centre: Place, radius: f64, [from, to]: [f64; 2], role: Role) {
        self.line(arc(centre, radius, [from, to]), role, 0.3);
    }

    pub(super) fn text(&mut self, content: &str, at: Place, anchor: Anchor) {
        self.sheet.text(Text::new(content, LETTERS).colour(colour(Role::Ink)).anchor(anchor), at);
    }

    pub(super) fn note(&mut self, content: &str, at: Place, anchor: Anchor) {
        self.sheet.text(Text::new(content, 3.0).colour(colour(Role::Faint)).anchor(anchor), at);
    }

    pub(super) fn heading(&mut self, content: &str, at: Place) {
        let text = Text::new(content, LETTERS).face(Face::Bold).colour(colour(Role::Ink));
        self.sheet.text(text, at);
    }

    /// A letter with an index, and what follows it: `("θ_f", " = 29°")`.
    pub(super) fn symbol(
        &mut self,
        symbol: &str,
        rest: &str,
        at: Place,
        anchor: Anchor,
        role: Role,
    ) {
        let (base, index) = symbol.split_once('_').unwrap_or((symbol, ""));
        let ink = colour(role);
        let parts = [
            Text::new(base, LETTERS).face(Face::Bold).colour(ink),
            Text::new(index, INDEX).colour(ink),
            Text::new(rest, LETTERS).colour(ink),
        ];
        let width: f64 = parts.iter().map(Text::width).sum();
        let mut left = at[0]
            - match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => width / 2.0,
                Anchor::End => width,
            };
        for (part, drop) in parts.into_iter().zip([0.0, 0.9, 0.0]) {
            let next = left + part.width();
            self.sheet.text(part, [left, at[1] + drop]);
            left = next;
        }
    }
}

pub(super) fn colour(role: Role) -> Colour {
    role.on(Ground::Light)
}

/// The place at an angle from straight down, positive to the right [rad].
pub(super) fn around(centre: Place, radius: f64, angle: f64) -> Place {
    let (sin, cos) = wide::sin_cos(angle);
    [centre[0] + radius * sin, centre[1] + radius * cos]
}

/// Points of an arc.
pub(super) fn arc(centre: Place, radius: f64, [from, to]: [f64; 2]) -> Vec<Place> {
    const STEPS: u32 = 48;
    let angle = |step: u32| from + (to - from) * f64::from(step) / f64::from(STEPS);
    (0..=STEPS).map(|step| around(centre, radius, angle(step))).collect()
}

/// A whole circle.
pub(super) fn circle(centre: Place, radius: f64) -> Vec<Place> {
    arc(centre, radius, [0.0, std::f64::consts::TAU])
}

/// An angle in degrees.
pub(super) fn degrees(angle: f64) -> String {
    format!("{:.1}°", angle.to_degrees()).replace('-', "−")
}
