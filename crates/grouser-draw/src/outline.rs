//! A rover from above, to scale: its wheels, and the rectangle that their hubs span.

use crate::sheet::{Colour, Place, Shape, Sheet, Stroke, WHITE};
use grouser_core::units::Vec2;
use grouser_core::vehicle::{Mount, Rover, RoverState};

/// Draws a rover.
///
/// * `at`: where a place on the slope [m] is on the sheet
pub fn draw_outline(
    sheet: &mut Sheet,
    state: &RoverState,
    rover: &Rover,
    at: &dyn Fn(Vec2) -> Place,
    stroke: Stroke,
) {
    let turned = state.slope_from_body();
    let place = |of_body: Vec2| at(state.position + turned * of_body);
    let half = half_span(rover);
    let body = CORNERS.map(|(x, y)| place(Vec2::new(x * half.x, y * half.y)));
    sheet.draw(Shape::area(body, WHITE).unfilled().outlined(stroke));
    for mount in rover.mounts() {
        let half = Vec2::new(mount.shearing_radius(), 0.5 * mount.unit.wheel.width);
        let corner = |(x, y): (f64, f64)| {
            let of_wheel = mount.body_from_wheel(Vec2::new(x * half.x, y * half.y));
            place(mount.position.xy() + of_wheel)
        };
        sheet.draw(Shape::area(CORNERS.map(corner), stroke.colour));
    }
}

/// Draws a nose on a rover's outline: a triangle before its front hubs.
pub(crate) fn draw_nose(
    sheet: &mut Sheet,
    state: &RoverState,
    rover: &Rover,
    at: &dyn Fn(Vec2) -> Place,
    colour: Colour,
) {
    let (turned, half) = (state.slope_from_body(), half_span(rover));
    let nose = [(1.0, 0.5), (1.0 + half.y / half.x.max(1e-9), 0.0), (1.0, -0.5)];
    let place =
        |(x, y): (f64, f64)| at(state.position + turned * Vec2::new(x * half.x, y * half.y));
    sheet.draw(Shape::area(nose.map(place), colour));
}

/// Half the room that a rover needs around its centre [m].
#[must_use]
pub fn reach(rover: &Rover) -> f64 {
    let corner = |mount: &Mount| {
        mount.position.xy().norm() + mount.shearing_radius() + 0.5 * mount.unit.wheel.width
    };
    rover.mounts().iter().map(corner).fold(0.0, f64::max)
}

const CORNERS: [(f64, f64); 4] = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];

/// Half the rectangle that the hubs span [m].
fn half_span(rover: &Rover) -> Vec2 {
    rover.mounts().iter().fold(Vec2::zeros(), |most: Vec2, mount| {
        Vec2::new(most.x.max(mount.position.x.abs()), most.y.max(mount.position.y.abs()))
    })
}
