//! The path of a mission from above, to scale, leg by leg.

use crate::sheet::{Anchor, Colour, Place, Shape, Sheet, Stroke, Text};
use grouser_core::mission::MissionReport;
use grouser_core::simulation::{Record, Severity};
use grouser_core::units::Vec2;
use grouser_core::vehicle::{Rover, RoverState};

use crate::outline::{draw_nose, draw_outline, reach};
use crate::step::round_step;
use crate::style::{Ground, Role, series};

/// Width of the drawing, and the most that it is high [mm].
const WIDTH: f64 = 180.0;
const HIGHEST: f64 = 150.0;
/// Room around the path for numbers of the axes [mm].
const LEFT: f64 = 16.0;
const RIGHT: f64 = 6.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 14.0;
/// Size of letters [mm].
const LETTERS: f64 = 3.4;
/// About as many lines of the grid.
const LINES: f64 = 6.0;

/// What a mission drove, seen from above the slope, uphill at the top.
#[must_use]
pub fn path_of(title: &str, rover: &Rover, report: &MissionReport) -> Sheet {
    let map = Map::around(report, rover);
    let mut sheet = Sheet::new(title, WIDTH, map.height()).on(Role::Paper.on(Ground::Light));
    map.grid(&mut sheet);
    let at = |place: Vec2| map.at(place);
    let first = report.trajectory.records.first();
    if let Some(first) = first {
        let rover = as_steered(rover, Some(first));
        rover_at(&mut sheet, &first.state, &rover, &at, Role::Other.on(Ground::Light));
    }
    for (place, (leg, records)) in report.legs_with_records().into_iter().enumerate() {
        let colour = colour_of(place);
        let path = records.iter().map(|record| at(record.state.position));
        sheet.draw(Shape::line(path, Stroke::new(0.7, colour).rounded()));
        rover_at(&mut sheet, &leg.end, &as_steered(rover, records.last()), &at, colour);
        if leg.outcome.kind().row().severity != Severity::Good {
            cross(&mut sheet, at(leg.end.position));
        }
    }
    let ends: Vec<Vec2> = report.legs.iter().map(|leg| leg.end.position).collect();
    numbers(&mut sheet, &map, &ends);
    sheet
}

/// The rover with its wheels as a record has them steered.
fn as_steered(rover: &Rover, record: Option<&Record>) -> Rover {
    let wheels = record.map_or(&[][..], |record| &record.wheels);
    let angles: Vec<f64> = wheels.iter().map(|wheel| wheel.steering).collect();
    rover.steered(&angles).unwrap_or_else(|_| rover.clone())
}

/// Black is for text.
fn colour_of(place: usize) -> Colour {
    let colours = series(Ground::Light);
    colours[1 + place % (colours.len() - 1)]
}

fn rover_at(
    sheet: &mut Sheet,
    state: &RoverState,
    rover: &Rover,
    at: &dyn Fn(Vec2) -> Place,
    colour: Colour,
) {
    draw_outline(sheet, state, rover, at, Stroke::new(0.3, colour));
    draw_nose(sheet, state, rover, at, colour);
}

/// A cross where a leg did not end as it says.
fn cross(sheet: &mut Sheet, [x, y]: Place) {
    let arm = 2.0;
    let stroke = Stroke::new(0.8, Role::Message.on(Ground::Light)).rounded();
    sheet.draw(Shape::line([[x - arm, y - arm], [x + arm, y + arm]], stroke));
    sheet.draw(Shape::line([[x - arm, y + arm], [x + arm, y - arm]], stroke));
}

/// The numbers of legs, each beside the place where the leg ended, those of one place one below the
/// other.
fn numbers(sheet: &mut Sheet, map: &Map, ends: &[Vec2]) {
    let mut taken: Vec<Place> = Vec::new();
    for (number, end) in ends.iter().enumerate() {
        let [x, mut y] = map.at(*end);
        let x = x + map.scale * map.reach + 1.0;
        let is_taken = |y: f64, other: &Place| {
            (other[0] - x).abs() < 1.5 * LETTERS && (other[1] - y).abs() < 1.2 * LETTERS
        };
        while taken.iter().any(|other| is_taken(y, other)) {
            y += 1.2 * LETTERS;
        }
        taken.push([x, y]);
        let text = Text::new((number + 1).to_string(), LETTERS).colour(colour_of(number));
        sheet.text(text, [x, y + 0.35 * LETTERS]);
    }
}

/// Where places on the slope are on the sheet.
struct Map {
    least: Vec2,
    most: Vec2,
    /// [mm/m]
    scale: f64,
    /// Half the room that the rover needs [m].
    reach: f64,
}

impl Map {
    fn around(report: &MissionReport, rover: &Rover) -> Self {
        let reach = reach(rover);
        let places = report.trajectory.records.iter().map(|record| record.state.position);
        let places = places.chain(report.legs.iter().map(|leg| leg.end.position));
        let (mut least, mut most) = (Vec2::zeros(), Vec2::zeros());
        for place in places {
            least = least.inf(&place);
            most = most.sup(&place);
        }
        // The rover, its nose, and the number of the leg.
        let room = Vec2::repeat(1.3 * reach);
        let (least, most) = (least - room, most + room);
        let size = most - least;
        let scale = ((WIDTH - LEFT - RIGHT) / size.x).min((HIGHEST - TOP - BOTTOM) / size.y);
        Self { least, most, scale, reach }
    }

    fn height(&self) -> f64 {
        TOP + BOTTOM + self.scale * (self.most.y - self.least.y)
    }

    fn at(&self, place: Vec2) -> Place {
        let spare = WIDTH - LEFT - RIGHT - self.scale * (self.most.x - self.least.x);
        [
            LEFT + 0.5 * spare + self.scale * (place.x - self.least.x),
            TOP + self.scale * (self.most.y - place.y),
        ]
    }

    /// Lines at whole numbers of a round distance, with what they mean.
    fn grid(&self, sheet: &mut Sheet) {
        let size = self.most - self.least;
        let step = round_step(size.x.max(size.y) / LINES);
        let lines = |from: f64, to: f64| {
            let first = (from / step).ceil();
            let numbers = std::iter::successors(Some(first), |line| Some(line + 1.0));
            numbers.map(move |line| line * step).take_while(move |at| *at <= to)
        };
        let [grid, faint, ink] =
            [Role::Grid, Role::Faint, Role::Ink].map(|role| role.on(Ground::Light));
        let stroke = |value: f64| {
            if value == 0.0 {
                Stroke::new(0.35, faint).dashed(2.0, 1.2)
            } else {
                Stroke::new(0.2, grid)
            }
        };
        let number = |value: f64| {
            Text::new(format!("{}", (value * 1e6).round() / 1e6 + 0.0), LETTERS).colour(faint)
        };
        let [left, top] = self.at(Vec2::new(self.least.x, self.most.y));
        let [right, bottom] = self.at(Vec2::new(self.most.x, self.least.y));
        for x in lines(self.least.x, self.most.x) {
            let [at, _] = self.at(Vec2::new(x, 0.0));
            sheet.draw(Shape::line([[at, top], [at, bottom]], stroke(x)));
            sheet.text(number(x).anchor(Anchor::Middle), [at, bottom + 4.5]);
        }
        for y in lines(self.least.y, self.most.y) {
            let [_, at] = self.at(Vec2::new(0.0, y));
            sheet.draw(Shape::line([[left, at], [right, at]], stroke(y)));
            sheet.text(number(y).anchor(Anchor::End), [left - 1.5, at + 1.2]);
        }
        let name = |text: &str| Text::new(text, LETTERS).colour(ink);
        sheet.text(
            name("along the contour, x [m]").anchor(Anchor::Middle),
            [0.5 * (left + right), bottom + 10.0],
        );
        sheet.text(name("uphill, y [m]"), [left - LEFT + 1.0, TOP - 3.0]);
    }
}
