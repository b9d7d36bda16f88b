//! The soil that a side wall pushes, seen from behind the wheel.

use std::f64::consts::FRAC_PI_4;

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::contact::bulldozing::WallResistance;
use grouser_core::elementary::wide;

use super::pen::{Pen, degrees};
use super::subject::WheelInSoil;
use crate::style::Role;

const SIZE: Place = [190.0, 96.0];
/// The side wall that pushes.
const WALL: f64 = 78.0;
const LEVEL: f64 = 44.0;
/// Depth of the wheel on paper [mm].
const DEPTH: f64 = 30.0;

pub(super) fn sheet(wheel: &WheelInSoil<'_>) -> Sheet {
    let contact = wheel.contact;
    let mut pen = Pen::new("Soil pushed aside by a side wall", SIZE);
    let friction = contact.soil.friction_angle;
    let failure = FRAC_PI_4 - friction / 2.0;
    let reach = DEPTH / wide::tan(failure);
    let bottom = LEVEL + DEPTH;
    pen.area([[0.0, LEVEL], [SIZE[0], LEVEL], [SIZE[0], SIZE[1]], [0.0, SIZE[1]]], Role::Soil);
    pen.faint_area([[WALL, LEVEL], [WALL, bottom], [WALL + reach, LEVEL]], Role::Force);
    // Soil piled up ahead of the wall at its friction angle.
    let heap = reach * wide::tan(friction);
    let top = (LEVEL - heap).max(8.0);
    pen.faint_area([[WALL, LEVEL], [WALL, top], [WALL + reach, LEVEL]], Role::Track);
    pen.line([[WALL, top], [WALL + reach, LEVEL]], Role::Track, 0.4);
    pen.line([[0.0, LEVEL], [SIZE[0], LEVEL]], Role::SoilEdge, 0.6);
    pen.line([[WALL, bottom], [WALL + reach, LEVEL]], Role::Force, 0.6);
    // The wheel, cut along its axle.
    let width = (DEPTH * contact.wheel.width / wheel.settled.sinkage.max(1e-6)).min(44.0);
    pen.outlined(
        [[WALL - width, 4.0], [WALL, 4.0], [WALL, bottom], [WALL - width, bottom]],
        Role::Wheel,
        Role::Rim,
    );
    pen.arrow([WALL - width / 2.0 - 8.0, 16.0], [WALL - width / 2.0 + 8.0, 16.0], Role::Paper, 0.6);
    pen.symbol("v_y", "", [WALL - width / 2.0, 13.0], Anchor::Middle, Role::Paper);
    // The resistance grows from the surface down.
    let resistance = WallResistance::new(&contact.soil, contact.soil.unit_weight(contact.gravity));
    let most = resistance.at(wheel.settled.sinkage);
    for step in 1..=6 {
        let share = f64::from(step) / 6.0;
        let length = 16.0 * resistance.at(share * wheel.settled.sinkage) / most.max(1e-12);
        let y = LEVEL + share * DEPTH - 2.0;
        pen.arrow([WALL + length, y], [WALL, y], Role::Force, 0.4);
    }
    let at = bottom + 4.5;
    pen.symbol(
        "R_b",
        &format!("(h) = {most:.0} N/m"),
        [WALL + 2.0, at],
        Anchor::Start,
        Role::Force,
    );
    let tip = [WALL + reach, LEVEL];
    pen.symbol(
        "X_c",
        &format!(" = 45° − φ/2 = {}", degrees(failure)),
        [tip[0] - 10.0, LEVEL + 14.0],
        Anchor::Start,
        Role::Ink,
    );
    pen.line([[tip[0] - 12.0, LEVEL], along(tip, -12.0, failure)], Role::Ink, 0.3);
    pen.symbol(
        "φ",
        &format!(" = {}", degrees(friction)),
        [tip[0] - 6.0, LEVEL - 6.0],
        Anchor::Start,
        Role::Ink,
    );
    pen.dimension([8.0, LEVEL], [8.0, bottom]);
    pen.dashed([6.0, bottom], [WALL - width, bottom], Role::Faint);
    let text = format!(" = {:.1} mm", 1e3 * wheel.settled.sinkage);
    pen.symbol("h", &text, [10.5, f64::midpoint(LEVEL, bottom) + 1.2], Anchor::Start, Role::Ink);
    pen.sheet
}

/// A place along a line that falls to the left from a tip.
fn along([x, y]: Place, way: f64, angle: f64) -> Place {
    let (sin, cos) = wide::sin_cos(angle);
    [x + way * cos, y - way * sin]
}
