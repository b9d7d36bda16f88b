//! A rover as it stands: its wheels, and a block for its body.

use std::f64::consts::TAU;

use grouser_core::elementary::wide;
use grouser_core::units::Vec3;
use grouser_core::vehicle::{Mount, Posture, Rover};
use grouser_page::{Place, Shape, Sheet, Stroke};

use super::view::View;
use crate::marks::hull;
use crate::rover::{Block, Likeness};
use crate::style::{Ground, Role};

/// Points around a wheel.
const ROUND: u32 = 20;
/// Width of edges [mm].
const EDGE: f64 = 0.15;

/// Draws a rover, what is farther from the eye first.
pub(super) fn draw(sheet: &mut Sheet, view: &View, posture: &Posture, rover: &Rover) {
    let likeness = Likeness::of(rover);
    let centre = view.depth(posture.place);
    let mut wheels: Vec<(f64, Vec<Place>)> = Vec::new();
    for (mount, wheel) in rover.mounts().iter().zip(&posture.wheels) {
        let hub = posture.place + wheel.hub;
        wheels.push((view.depth(hub), outline(view, mount, hub, wheel.axle)));
    }
    wheels.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (behind, before): (Vec<_>, Vec<_>) = wheels.into_iter().partition(|it| it.0 < centre);
    let edge = Stroke::new(EDGE, Role::Edge.on(Ground::Light));
    let tyre = |sheet: &mut Sheet, points: Vec<Place>| {
        sheet.draw(Shape::area(points, Role::Wheel.on(Ground::Light)).outlined(edge));
    };
    for (_, points) in behind {
        tyre(sheet, points);
    }
    for block in [&likeness.body, &likeness.mast, &likeness.head] {
        draw_block(sheet, view, posture, block, edge);
    }
    for (_, points) in before {
        tyre(sheet, points);
    }
}

/// The faces of a block that are seen.
fn draw_block(sheet: &mut Sheet, view: &View, posture: &Posture, block: &Block, edge: Stroke) {
    let turned = |vector: Vec3| posture.ground_from_body * vector;
    for axis in 0..3 {
        for is_high in [false, true] {
            let mut normal = Vec3::zeros();
            normal[axis] = if is_high { 1.0 } else { -1.0 };
            if !view.sees(turned(normal)) {
                continue;
            }
            let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
            let corners = [(false, false), (true, false), (true, true), (false, true)];
            let corner = |(a, b): (bool, bool)| {
                let mut of = [is_high; 3];
                of[one] = a;
                of[other] = b;
                view.place(posture.place + turned(block.corner(of)))
            };
            let role = [Role::BodyDark, Role::BodyLit, Role::BodyTop][axis];
            let face = Shape::area(corners.map(corner), role.on(Ground::Light));
            sheet.draw(face.outlined(edge));
        }
    }
}

/// A wheel's outline: both its rims.
///
/// * `axle`: its direction
fn outline(view: &View, mount: &Mount, hub: Vec3, axle: Vec3) -> Vec<Place> {
    let (radius, half) = (mount.shearing_radius(), 0.5 * mount.unit.wheel.width);
    let across = axle.cross(&Vec3::z()).try_normalize(0.0).unwrap_or_else(Vec3::x);
    let upright = across.cross(&axle);
    let rim = |side: f64| {
        (0..ROUND).map(move |point| {
            let (sin, cos) = wide::sin_cos(TAU * f64::from(point) / f64::from(ROUND));
            hub + side * half * axle + radius * (cos * across + sin * upright)
        })
    };
    hull(rim(-1.0).chain(rim(1.0)).map(|point| view.place(point)).collect())
}
