//! The ground cut along a way: heights over the distance travelled.

use crate::sheet::{Anchor, Place};
use grouser_core::elementary::wide::hypot;
use grouser_core::terrain::{Footprint, Terrain};
use grouser_core::units::{Vec2, Vec3};

use super::drawing::Drawing;
use super::labels::{ABOVE, BELOW, multiples, name, number};
use crate::marks::{Line, Mark};
use crate::step::round_step;
use crate::style::Role;

/// Heights are stretched by one of these.
const STRETCHES: [f64; 6] = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0];
/// Half the side of what a height is the mean of [m].
const POINT: f64 = 1e-3;
/// Least distance of numbers one above the other [mm].
const APART: f64 = 5.0;
/// About as many numbers along either axis.
const NUMBERS: [f64; 2] = [8.0, 5.0];

/// The room for a cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// Its width [mm].
    pub(super) across: f64,
    /// The most that it is high [mm].
    pub(super) highest: f64,
}

/// Heights along a way.
pub(super) struct Profile {
    /// How far the rover has come, the ground's height there, and the body's [m].
    points: Vec<[f64; 3]>,
    /// [mm/m]
    scale: f64,
    /// By how much heights are stretched [-].
    stretch: f64,
    /// Its upper left corner on the sheet [mm].
    corner: Place,
}

impl Profile {
    /// * `way`: of the body's centre of mass [m]
    pub(super) fn of(terrain: &dyn Terrain, way: &[Vec3], room: Room) -> Self {
        let footprint = Footprint { forward: Vec2::x(), half_length: POINT, half_width: POINT };
        let mut points: Vec<[f64; 3]> = Vec::new();
        let mut last: Option<Vec2> = None;
        for body in way {
            let at = body.xy();
            let step = last.map_or(0.0, |last| hypot(at.x - last.x, at.y - last.y));
            let gone = points.last().map_or(0.0, |point| point[0]) + step;
            points.push([gone, terrain.patch(at, footprint).height, body.z]);
            last = Some(at);
        }
        let mut profile = Self { points, scale: 1.0, stretch: 1.0, corner: [0.0, 0.0] };
        profile.scale = room.across / profile.length().max(1e-9);
        let [low, high] = profile.ends();
        let fits = |stretch: &f64| stretch * profile.scale * (high - low) <= room.highest;
        profile.stretch = STRETCHES.into_iter().find(fits).unwrap_or(1.0);
        // Steep ways are higher than they are long: then it is the height that decides.
        profile.scale = profile.scale.min(room.highest / (high - low).max(1e-9));
        profile
    }

    /// The same with its corner at a place of the sheet [mm].
    pub(super) fn at(self, corner: Place) -> Self {
        Self { corner, ..self }
    }

    fn length(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }

    /// The least height of the ground, and the largest of the body [m].
    fn ends(&self) -> [f64; 2] {
        let ends =
            self.points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| {
                [low.min(it[1]), high.max(it[2])]
            });
        if ends[0] <= ends[1] { ends } else { [0.0, 0.0] }
    }

    /// With its name and numbers [mm].
    pub(super) fn height(&self) -> f64 {
        let [low, high] = self.ends();
        ABOVE + self.stretch * self.scale * (high - low) + 4.0 + BELOW
    }

    /// Where a height [m] at a distance along the way [m] is on the sheet.
    fn place(&self, along: f64, height: f64) -> Place {
        let ([_, high], [left, top]) = (self.ends(), self.corner);
        let upright = self.stretch * self.scale;
        [left + self.scale * along, top + ABOVE + upright * (high - height)]
    }

    /// Where the body is on the sheet, along the way.
    pub(super) fn way(&self) -> Vec<Place> {
        self.points.iter().map(|it| self.place(it[0], it[2])).collect()
    }

    /// The ground that is cut, with numbers along both sides.
    pub(super) fn ground(&self) -> Drawing {
        let [low, high] = self.ends();
        let [left, top] = self.corner;
        let stretched = if self.stretch > 1.0 {
            format!(", heights {} times", self.stretch)
        } else {
            String::new()
        };
        let [first, last] = [0.0, self.length()];
        let under = self.place(first, low)[1] + 4.0;
        let ground: Vec<Place> = self.points.iter().map(|it| self.place(it[0], it[1])).collect();
        let ends = [last, first].map(|along| [self.place(along, low)[0], under]);
        let mut marks = vec![
            Mark::area(ground.iter().copied().chain(ends), Role::Soil),
            Mark::line(ground, Line::new(Role::Print, 0.3)),
        ];
        let mut labels = vec![
            name(format!("along the way{stretched}"), left, top + ABOVE - 3.0),
            name("distance and height [m]", left, under + BELOW - 4.0),
        ];
        let tick = Line::new(Role::Faint, 0.2);
        for along in multiples(round_step(last / NUMBERS[0]), first, last) {
            let [x, _] = self.place(along, low);
            marks.push(Mark::line([[x, under], [x, under + 1.2]], tick));
            labels.push(number(along, [x, under + 4.8], Anchor::Middle));
        }
        let apart = APART / (self.stretch * self.scale);
        let step = round_step(((high - low).max(1e-3) / NUMBERS[1]).max(apart));
        for height in multiples(step, low, high) {
            let [x, y] = self.place(0.0, height);
            marks.push(Mark::line([[x - 1.2, y], [x, y]], tick));
            labels.push(number(height, [x - 1.8, y + 1.1], Anchor::End));
        }
        Drawing { marks, labels }
    }
}
