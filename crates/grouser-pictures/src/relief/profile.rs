//! The ground cut along a way: heights over the distance travelled.

use grouser_core::elementary::wide::hypot;
use grouser_core::simulation::Record;
use grouser_core::terrain::{Footprint, Terrain};
use grouser_core::units::Vec2;
use grouser_page::{Anchor, Place, Shape, Sheet, Stroke};

use super::labels::{ABOVE, BELOW, LEFT, WIDTH, multiples, name, number};
use crate::step::round_step;
use crate::style::{Ground, Role};

/// Width of the cut, and the most that it is high [mm].
const ACROSS: f64 = WIDTH - LEFT - 8.0;
const HIGHEST: f64 = 34.0;
/// Heights are stretched by one of these.
const STRETCHES: [f64; 6] = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0];
/// Half the side of what a height is the mean of [m].
const POINT: f64 = 1e-3;
/// About as many numbers along either axis.
const NUMBERS: [f64; 2] = [8.0, 5.0];

/// Heights along a way.
pub(super) struct Profile {
    /// How far the rover has come, the ground's height there, and the body's [m].
    points: Vec<[f64; 3]>,
    /// [mm/m]
    scale: f64,
    /// By how much heights are stretched [-].
    stretch: f64,
}

impl Profile {
    pub(super) fn of(terrain: &dyn Terrain, records: &[Record]) -> Self {
        let footprint = Footprint { forward: Vec2::x(), half_length: POINT, half_width: POINT };
        let mut points: Vec<[f64; 3]> = Vec::new();
        let mut last: Option<Vec2> = None;
        for record in records {
            let Some(standing) = record.standing() else { continue };
            let at = record.state.position;
            let step = last.map_or(0.0, |last| hypot(at.x - last.x, at.y - last.y));
            let gone = points.last().map_or(0.0, |point| point[0]) + step;
            points.push([gone, terrain.patch(at, footprint).height, standing.height]);
            last = Some(at);
        }
        let mut profile = Self { points, scale: 1.0, stretch: 1.0 };
        profile.scale = ACROSS / profile.length().max(1e-9);
        let [low, high] = profile.ends();
        let fits = |stretch: &f64| stretch * profile.scale * (high - low) <= HIGHEST;
        profile.stretch = STRETCHES.into_iter().find(fits).unwrap_or(1.0);
        // Steep ways are higher than they are long: then it is the height that decides.
        profile.scale = profile.scale.min(HIGHEST / (high - low).max(1e-9));
        profile
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

    /// * `left`, `top`: its corner on the sheet [mm]
    pub(super) fn draw(&self, sheet: &mut Sheet, [left, top]: Place) {
        let [low, high] = self.ends();
        let upright = self.stretch * self.scale;
        let base = top + ABOVE + upright * (high - low);
        let place =
            |along: f64, height: f64| [left + self.scale * along, base - upright * (height - low)];
        let stretched = if self.stretch > 1.0 {
            format!(", heights {} times", self.stretch)
        } else {
            String::new()
        };
        name(sheet, &format!("along the way{stretched}"), [left, top + ABOVE - 3.0]);
        let [first, last] = [0.0, self.length()];
        let under = base + 4.0;
        let ground = self.points.iter().map(|it| place(it[0], it[1]));
        let ends = [last, first].map(|along| [place(along, low)[0], under]);
        let edge = Stroke::new(0.3, Role::Print.on(Ground::Light));
        sheet.draw(Shape::area(ground.clone().chain(ends), Role::Soil.on(Ground::Light)));
        sheet.draw(Shape::line(ground, edge));
        let way = Stroke::new(0.6, Role::Path.on(Ground::Light)).rounded();
        sheet.draw(Shape::line(self.points.iter().map(|it| place(it[0], it[2])), way));
        let tick = Stroke::new(0.2, Role::Faint.on(Ground::Light));
        for along in multiples(round_step(last / NUMBERS[0]), first, last) {
            let [x, _] = place(along, low);
            sheet.draw(Shape::line([[x, under], [x, under + 1.2]], tick));
            sheet.text(number(along).anchor(Anchor::Middle), [x, under + 4.8]);
        }
        for height in multiples(round_step((high - low).max(1e-3) / NUMBERS[1]), low, high) {
            let [x, y] = place(0.0, height);
            sheet.draw(Shape::line([[x - 1.2, y], [x, y]], tick));
            sheet.text(number(height).anchor(Anchor::End), [x - 1.8, y + 1.1]);
        }
        name(sheet, "distance and height [m]", [left, under + BELOW - 4.0]);
    }
}
