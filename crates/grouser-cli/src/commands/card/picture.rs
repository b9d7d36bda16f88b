//! The rover from above, its nose turned uphill of the way it goes.

use grouser::vehicle::Rover;
use grouser_draw::{Anchor, BLACK, Face, Place, Shape, Sheet, Stroke, WHITE};

use super::layout::shown;
use crate::args::SideChoice;

/// The rover as it is: its wheels at their mounts, to scale.
pub(super) struct Picture {
    wheels: Vec<Wheel>,
    /// 1 with uphill on its left, and −1 on its right: then the page shows it going to the left.
    side: f64,
}

/// A wheel from above, in the body frame [m].
struct Wheel {
    forward: f64,
    left: f64,
    length: f64,
    width: f64,
}

impl Picture {
    pub(super) fn of(rover: &Rover, uphill: SideChoice) -> Self {
        let side = if uphill == SideChoice::Left { 1.0 } else { -1.0 };
        let wheel = |mount: &grouser::vehicle::Mount| Wheel {
            forward: mount.position.x,
            left: mount.position.y,
            length: 2.0 * mount.shearing_radius(),
            width: mount.unit.wheel.width,
        };
        Self { wheels: rover.mounts().iter().map(wheel).collect(), side }
    }

    /// Least and greatest of what the wheels have.
    fn span(&self, of: impl Fn(&Wheel, f64) -> f64) -> [f64; 2] {
        let ends = self.wheels.iter().flat_map(|wheel| [of(wheel, -0.5), of(wheel, 0.5)]);
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], it| {
            [least.min(it), most.max(it)]
        })
    }

    /// Draws it around a place.
    pub(super) fn draw(&self, sheet: &mut Sheet, centre: Place) {
        /// Room for the rover [mm].
        const LENGTH: f64 = 20.0;
        const WIDTH: f64 = 17.0;
        let page = Page { centre, side: self.side };
        way(sheet, &page);
        let along = self.span(|wheel, end| wheel.forward + end * wheel.length);
        let across = self.span(|wheel, end| wheel.left + end * wheel.width);
        let size = |[least, most]: [f64; 2]| (most - least).max(f64::MIN_POSITIVE);
        let scale = (LENGTH / size(along)).min(WIDTH / size(across));
        let middle = [along, across].map(|[least, most]| f64::midpoint(least, most));
        let on_page = |forward: f64, left: f64| {
            page.turned((forward - middle[0]) * scale, (left - middle[1]) * scale * page.side)
        };
        let outline = |at: [f64; 2], [length, width]: [f64; 2]| {
            let ends = [(0.5, 0.5), (0.5, -0.5), (-0.5, -0.5), (-0.5, 0.5)];
            ends.map(|(x, y)| on_page(at[0] + x * length, at[1] + y * width))
        };
        let hubs = self.span(|wheel, _| wheel.left);
        let body = [0.8 * size(along), 0.7 * size(hubs)];
        sheet.draw(Shape::area(outline(middle, body), WHITE).outlined(Stroke::black(0.5)));
        for wheel in &self.wheels {
            let corners = outline([wheel.forward, wheel.left], [wheel.length, wheel.width]);
            sheet.draw(Shape::area(corners, BLACK));
        }
        nose(sheet, &page);
    }
}

/// Where things are on the page.
struct Page {
    centre: Place,
    side: f64,
}

/// The angle that is drawn [°].
const HEADING_DEG: f64 = 20.0;

impl Page {
    /// A place along the way and uphill of it [mm].
    fn at(&self, along: f64, uphill: f64) -> Place {
        [self.centre[0] + self.side * along, self.centre[1] - uphill]
    }

    /// A place before the rover and to its uphill side [mm].
    fn turned(&self, forward: f64, aside: f64) -> Place {
        let (sin, cos) = HEADING_DEG.to_radians().sin_cos();
        self.at(forward * cos - aside * sin, forward * sin + aside * cos)
    }

    /// Anchors of text that ends towards where the rover goes.
    fn end(&self) -> Anchor {
        if self.side > 0.0 { Anchor::End } else { Anchor::Start }
    }
}

/// The contour with the way along it, and where uphill is.
fn way(sheet: &mut Sheet, page: &Page) {
    let line = |ends: [Place; 2], stroke: Stroke| Shape::line(ends, stroke);
    sheet
        .draw(line([page.at(-16.0, 0.0), page.at(22.0, 0.0)], Stroke::black(0.5).dashed(1.6, 1.0)));
    sheet.draw(arrow_head(page.at(25.5, 0.0), [page.side, 0.0], 3.5));
    sheet.text(shown("travel", 3.2).anchor(page.end()), page.at(25.0, -4.6));
    let foot = page.at(-20.0, -9.0);
    let top = [foot[0], foot[1] - 14.0];
    sheet.draw(line([foot, top], Stroke::black(0.9)));
    sheet.draw(arrow_head([top[0], top[1] - 3.8], [0.0, -1.0], 3.8));
    sheet.text(shown("UPHILL", 3.2).face(Face::Bold).upright(), [foot[0] - 1.6, foot[1]]);
}

/// The nose, and the angle that is asked for.
fn nose(sheet: &mut Sheet, page: &Page) {
    let (sin, cos) = HEADING_DEG.to_radians().sin_cos();
    let ends = [page.turned(11.0, 0.0), page.turned(21.0, 0.0)];
    sheet.draw(Shape::line(ends, Stroke::black(0.8)));
    let tip = page.turned(24.5, 0.0);
    sheet.draw(arrow_head(tip, [page.side * cos, -sin], 3.5));
    let text = shown("nose", 3.2).face(Face::Bold).anchor(page.end());
    sheet.text(text, [tip[0] - page.side * 3.0, tip[1] - 1.4]);
    let arc = (0..=10).map(|step| {
        let angle = (HEADING_DEG * f64::from(step) / 10.0).to_radians();
        page.at(17.5 * angle.cos(), 17.5 * angle.sin())
    });
    sheet.draw(Shape::line(arc, Stroke::black(0.5)));
}

/// An arrow's head.
///
/// * `way`: unit vector that it points along
fn arrow_head(tip: Place, way: Place, length: f64) -> Shape {
    let back = [tip[0] - way[0] * length, tip[1] - way[1] * length];
    let aside = [way[1] * length * 0.42, -way[0] * length * 0.42];
    let ends =
        [tip, [back[0] + aside[0], back[1] + aside[1]], [back[0] - aside[0], back[1] - aside[1]]];
    Shape::area(ends, BLACK)
}
