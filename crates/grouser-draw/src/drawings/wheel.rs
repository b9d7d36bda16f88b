//! A wheel in its soil, from its left side: it rolls to the right.

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::contact::stress::{RimStress, StressField};
use grouser_core::elementary::wide;
use grouser_core::wheel::Wheel;

use super::pen::{Pen, arc, around, circle, degrees};
use super::subject::WheelInSoil;
use crate::style::Role;

/// Shearing radius on paper [mm].
const RADIUS: f64 = 44.0;
const HUB: Place = [78.0, 60.0];
const SIZE: Place = [190.0, 132.0];
/// The longest arrow of the normal stress [mm].
const LONGEST: f64 = 17.0;
/// The longest arrow of the shear stress [mm].
const LONGEST_SHEAR: f64 = 9.0;
/// Arrows of each stress.
const ARROWS: u32 = 14;

pub(super) fn sheet(wheel: &WheelInSoil<'_>) -> Sheet {
    let (contact, settled) = (wheel.contact, wheel.settled);
    let field = StressField::new(contact, settled.sinkage);
    let mut pen = Pen::new("A wheel in its soil", SIZE);
    ground(&mut pen, &field, wheel);
    rim(&mut pen, wheel);
    stresses(&mut pen, &field);
    angles(&mut pen, &field);
    sinkage(&mut pen, wheel);
    forces(&mut pen, wheel);
    legend(&mut pen, wheel, &field);
    pen.sheet
}

fn surface(wheel: &WheelInSoil<'_>) -> f64 {
    HUB[1] + RADIUS * (1.0 - wheel.settled.sinkage / wheel.contact.wheel.shearing_radius())
}

fn ground(pen: &mut Pen, field: &StressField, wheel: &WheelInSoil<'_>) {
    let level = surface(wheel);
    let (entry, exit) = (field.patch.entry, field.patch.exit);
    let rut = around(HUB, RADIUS, exit)[1];
    let mut points = vec![[SIZE[0], level]];
    points.extend(arc(HUB, RADIUS, [entry, exit]));
    points.extend([[0.0, rut], [0.0, SIZE[1]], [SIZE[0], SIZE[1]]]);
    pen.area(points, Role::Soil);
    let edge = [around(HUB, RADIUS, entry), around(HUB, RADIUS, exit)];
    pen.line([[SIZE[0], level], edge[0]], Role::SoilEdge, 0.6);
    pen.line([edge[1], [0.0, rut]], Role::SoilEdge, 0.6);
}

fn rim(pen: &mut Pen, wheel: &WheelInSoil<'_>) {
    let shape = &wheel.contact.wheel;
    let inner = RADIUS * shape.radius / shape.shearing_radius();
    from_its_side(pen, shape, HUB, RADIUS, 0.9);
    // The sense of rotation.
    let turn = [3.6, 2.65];
    pen.arc(HUB, 0.8 * inner, turn, Role::Ink);
    let tip = around(HUB, 0.8 * inner, turn[1]);
    pen.arrow(around(HUB, 0.8 * inner, turn[1] + 0.12), tip, Role::Ink, 0.3);
    pen.symbol("ω", "", [HUB[0], HUB[1] - 0.8 * inner + 5.0], Anchor::Middle, Role::Ink);
}

/// A wheel with its grousers and its hub.
///
/// * `reach`: its shearing radius on paper [mm]
/// * `dot`: radius of the hub on paper [mm]
pub(super) fn from_its_side(pen: &mut Pen, shape: &Wheel, hub: Place, reach: f64, dot: f64) {
    let inner = reach * shape.radius / shape.shearing_radius();
    if let Some(grousers) = shape.grousers {
        for bar in 0..grousers.count {
            let angle = std::f64::consts::TAU * f64::from(bar) / f64::from(grousers.count);
            let ends = [inner, reach].map(|radius| around(hub, radius, angle));
            pen.line(ends, Role::Grouser, 0.5);
        }
    }
    pen.outlined(circle(hub, inner), Role::Paper, Role::Rim);
    pen.area(circle(hub, dot), Role::Ink);
}

fn stresses(pen: &mut Pen, field: &StressField) {
    let (entry, exit) = (field.patch.entry, field.patch.exit);
    let most = field.max_normal();
    let at = |step: u32, of: u32| exit + (entry - exit) * f64::from(step) / f64::from(of);
    let length = |stress: f64| LONGEST * stress / most;
    let most_shear = most_shear(field);
    // The outline of the normal stress, outside the rim.
    let outline = (0..=80).map(|step| {
        let angle = at(step, 80);
        around(HUB, RADIUS + length(field.at(angle).normal), angle)
    });
    let outline: Vec<Place> = outline.collect();
    pen.faint_area(outline.iter().copied().chain(arc(HUB, RADIUS, [entry, exit])), Role::Force);
    pen.line(outline, Role::Force, 0.35);
    for step in 1..ARROWS {
        let angle = at(step, ARROWS);
        let RimStress { normal, longitudinal, .. } = field.at(angle);
        let rim = around(HUB, RADIUS, angle);
        pen.arrow(around(HUB, RADIUS + length(normal), angle), rim, Role::Force, 0.35);
        // Along the rim, onward where it is positive; drawn inside so that the arrows are apart.
        let (sin, cos) = wide::sin_cos(angle);
        let from = around(HUB, 0.93 * RADIUS, angle);
        let way = LONGEST_SHEAR * longitudinal / most_shear.max(1e-9);
        pen.arrow(from, [from[0] + way * cos, from[1] - way * sin], Role::Thrust, 0.45);
    }
}

/// The largest shear stress along the rim [Pa].
fn most_shear(field: &StressField) -> f64 {
    let (entry, exit) = (field.patch.entry, field.patch.exit);
    let at = |step: u32| field.at(exit + (entry - exit) * f64::from(step) / 200.0);
    (0..=200).map(|step| at(step).longitudinal.abs()).fold(0.0, f64::max)
}

fn angles(pen: &mut Pen, field: &StressField) {
    let patch = &field.patch;
    pen.dashed(HUB, [HUB[0], HUB[1] + RADIUS], Role::Faint);
    let beside = [patch.entry, patch.max_stress, patch.exit];
    for (symbol, angle, share) in
        [("θ_f", beside[0], 0.5), ("θ_m", beside[1], 0.32), ("θ_r", beside[2], 0.5)]
    {
        pen.dashed(HUB, around(HUB, RADIUS, angle), Role::Faint);
        pen.arc(HUB, share * RADIUS, [0.0, angle], Role::Ink);
        // Beyond the outer line, so that no line crosses the text.
        let outer = if angle < 0.0 { patch.exit } else { patch.entry };
        let y = around(HUB, share * RADIUS, angle)[1];
        let x = HUB[0] + (y - HUB[1]) * wide::tan(outer);
        let (side, anchor) = if angle < 0.0 { (-2.0, Anchor::End) } else { (2.0, Anchor::Start) };
        pen.symbol(symbol, &format!(" = {}", degrees(angle)), [x + side, y], anchor, Role::Ink);
    }
}

fn sinkage(pen: &mut Pen, wheel: &WheelInSoil<'_>) {
    let (level, bottom) = (surface(wheel), HUB[1] + RADIUS);
    let left = HUB[0] + RADIUS + 20.0;
    pen.dashed([HUB[0], bottom], [left + 3.0, bottom], Role::Faint);
    pen.dimension([left, level], [left, bottom]);
    let text = format!(" = {:.1} mm", 1e3 * wheel.settled.sinkage);
    pen.symbol(
        "h",
        &text,
        [left + 3.0, f64::midpoint(level, bottom) + 1.2],
        Anchor::Start,
        Role::Ink,
    );
}

fn forces(pen: &mut Pen, wheel: &WheelInSoil<'_>) {
    let forces = &wheel.settled.forces;
    // The load is as long as this.
    let per_newton = 24.0 / wheel.load.max(1e-9);
    let load = [HUB[0], HUB[1] - per_newton * wheel.load];
    pen.arrow(load, HUB, Role::Weight, 0.7);
    pen.symbol(
        "W",
        &format!(" = {:.1} N", wheel.load),
        [load[0] + 2.0, load[1] + 3.0],
        Anchor::Start,
        Role::Ink,
    );
    let pull = per_newton * forces.drawbar_pull;
    pen.arrow(HUB, [HUB[0] + pull, HUB[1]], Role::Thrust, 0.9);
    let (at, anchor) =
        if pull < 0.0 { (pull - 1.5, Anchor::End) } else { (pull + 1.5, Anchor::Start) };
    let text = format!(" = {:.1} N", forces.drawbar_pull);
    pen.symbol("F_x", &text, [HUB[0] + at, HUB[1] - 1.5], anchor, Role::Thrust);
}

fn legend(pen: &mut Pen, wheel: &WheelInSoil<'_>, field: &StressField) {
    let left = HUB[0] + RADIUS + 16.0;
    let most = field.max_normal() / 1e3;
    pen.arrow([left, 10.0], [left + 8.0, 10.0], Role::Force, 0.35);
    pen.symbol(
        "σ",
        &format!(" up to {most:.1} kPa"),
        [left + 10.0, 11.2],
        Anchor::Start,
        Role::Ink,
    );
    pen.arrow([left, 17.0], [left + 8.0, 17.0], Role::Thrust, 0.45);
    let shear = most_shear(field) / 1e3;
    pen.symbol(
        "τ_x",
        &format!(" up to {shear:.1} kPa"),
        [left + 10.0, 18.2],
        Anchor::Start,
        Role::Ink,
    );
    let slip = wheel.contact.slip.ratio;
    pen.symbol("s", &format!(" = {slip:.2}"), [left, 26.0], Anchor::Start, Role::Ink);
    let torque = wheel.settled.forces.torque;
    pen.symbol("T", &format!(" = {torque:.2} N·m"), [left, 33.0], Anchor::Start, Role::Ink);
    let radius = 1e3 * wheel.contact.wheel.shearing_radius();
    pen.symbol("r_s", &format!(" = {radius:.0} mm"), [left, 40.0], Anchor::Start, Role::Ink);
    pen.arrow([left, 48.0], [left + 14.0, 48.0], Role::Ink, 0.4);
    pen.symbol("v_x", "", [left + 16.0, 49.2], Anchor::Start, Role::Ink);
}
