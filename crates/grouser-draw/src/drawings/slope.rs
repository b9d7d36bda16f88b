//! A rover on its slope, from the side and from above.

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::elementary::wide;

use super::pen::{Pen, circle, degrees};
use super::subject::Crossing;
use crate::style::Role;

const SIZE: Place = [190.0, 100.0];

pub(super) fn sheet(crossing: &Crossing<'_>) -> Sheet {
    let mut pen = Pen::new("A rover that holds the contour", SIZE);
    from_the_side(&mut pen, crossing);
    from_above(&mut pen, crossing, [136.0, 52.0]);
    pen.sheet
}

/// Looking along the contour: uphill is to the right.
fn from_the_side(pen: &mut Pen, crossing: &Crossing<'_>) {
    let (sin, cos) = wide::sin_cos(crossing.slope);
    let foot = [8.0, 84.0];
    let along =
        |way: f64, up: f64| [foot[0] + way * cos - up * sin, foot[1] - way * sin - up * cos];
    pen.heading("seen along the contour", [8.0, 8.0]);
    pen.area([foot, along(78.0, 0.0), [along(78.0, 0.0)[0], foot[1]]], Role::Soil);
    pen.line([foot, along(78.0, 0.0)], Role::SoilEdge, 0.6);
    pen.line([foot, [along(78.0, 0.0)[0], foot[1]]], Role::Faint, 0.3);
    let arc = (0..=16).map(|step| {
        let (sin, cos) = wide::sin_cos(crossing.slope * f64::from(step) / 16.0);
        [foot[0] + 24.0 * cos, foot[1] - 24.0 * sin]
    });
    pen.line(arc.collect::<Vec<_>>(), Role::Ink, 0.3);
    let text = format!(" = {}", degrees(crossing.slope));
    pen.symbol("α", &text, [foot[0] + 20.0, foot[1] + 6.0], Anchor::Start, Role::Ink);
    let mounts = crossing.rover.mounts();
    let half = mounts.iter().fold(1e-9_f64, |most, mount| most.max(mount.position.y.abs()));
    let scale = 14.0 / half;
    let middle = 44.0;
    let height = scale * crossing.rover.centre_height();
    for mount in mounts {
        let (radius, width) = (mount.shearing_radius(), mount.unit.wheel.width / 2.0);
        let (at, radius, width) =
            (middle + scale * mount.position.y, scale * radius, scale * width);
        let corners = [
            along(at - width, 0.0),
            along(at + width, 0.0),
            along(at + width, 2.0 * radius),
            along(at - width, 2.0 * radius),
        ];
        pen.outlined(corners, Role::Wheel, Role::Rim);
    }
    let centre = along(middle, height);
    let body = [
        along(middle - 9.0, height - 5.0),
        along(middle + 9.0, height - 5.0),
        along(middle + 9.0, height + 5.0),
        along(middle - 9.0, height + 5.0),
    ];
    pen.outlined(body, Role::BodyTop, Role::BodyDark);
    pen.area(circle(centre, 1.2), Role::Ink);
    let weight = 30.0;
    let down = [centre[0], centre[1] + weight];
    pen.arrow(centre, down, Role::Weight, 0.7);
    let newtons = crossing.rover.mass() * crossing.gravity;
    let pull = [centre[0] - weight * sin * cos, centre[1] + weight * sin * sin];
    pen.arrow(centre, pull, Role::Force, 0.7);
    let pressed = [centre[0] + weight * cos * sin, centre[1] + weight * cos * cos];
    pen.arrow(centre, pressed, Role::Normal, 0.7);
    let named = [
        ("W", newtons, Role::Weight),
        ("W sin α", newtons * sin, Role::Force),
        ("W cos α", newtons * cos, Role::Normal),
    ];
    for (line, (symbol, force, role)) in (0_u8..).zip(named) {
        let at = [8.0, 18.0 + 7.0 * f64::from(line)];
        pen.symbol(symbol, &format!(" = {force:.1} N"), at, Anchor::Start, role);
    }
    pen.dashed(pull, down, Role::Faint);
    pen.dashed(pressed, down, Role::Faint);
}

/// Looking at the slope from above it: the contour runs to the right, uphill is up.
fn from_above(pen: &mut Pen, crossing: &Crossing<'_>, centre: Place) {
    let (sin, cos) = wide::sin_cos(crossing.yaw);
    pen.heading("seen from above the slope", [98.0, 8.0]);
    pen.area([[98.0, 14.0], [186.0, 14.0], [186.0, 92.0], [98.0, 92.0]], Role::Soil);
    for line in 1..6 {
        let y = 14.0 + 13.0 * f64::from(line);
        pen.line([[98.0, y], [186.0, y]], Role::Contour, 0.2);
    }
    pen.arrow([103.0, 34.0], [103.0, 20.0], Role::Ink, 0.4);
    pen.note("uphill", [105.0, 26.0], Anchor::Start);
    pen.rover_from_above(crossing.rover, 16.0, |scale, x, y| {
        [centre[0] + scale * (x * cos - y * sin), centre[1] - scale * (x * sin + y * cos)]
    });
    pen.area(circle(centre, 1.0), Role::Ink);
    // Where the nose points, and where the rover goes.
    let nose = [centre[0] + 38.0 * cos, centre[1] - 38.0 * sin];
    pen.arrow(centre, nose, Role::Thrust, 0.6);
    pen.symbol("x_b", "", [nose[0] - 2.0, nose[1] - 2.5], Anchor::End, Role::Thrust);
    let ahead = [centre[0] + 44.0, centre[1]];
    pen.arrow(centre, ahead, Role::Ink, 0.8);
    pen.symbol("v", "", [ahead[0] - 1.0, ahead[1] + 5.0], Anchor::End, Role::Ink);
    let turn = (0..=16).map(|step| {
        let (sin, cos) = wide::sin_cos(crossing.yaw * f64::from(step) / 16.0);
        [centre[0] + 30.0 * cos, centre[1] - 30.0 * sin]
    });
    pen.line(turn.collect::<Vec<_>>(), Role::Thrust, 0.4);
    let beta = crossing.wheels.first().map_or(-crossing.yaw, |wheel| wheel.slip.angle);
    let text = format!(" = {}   ", degrees(crossing.yaw));
    pen.symbol("γ", &text, [100.0, 89.0], Anchor::Start, Role::Thrust);
    pen.symbol(
        "β",
        &format!(" = {}, the slip angle of a wheel", degrees(beta)),
        [122.0, 89.0],
        Anchor::Start,
        Role::Ink,
    );
    let pull = [centre[0], centre[1] + 26.0];
    pen.arrow(centre, pull, Role::Force, 0.7);
    pen.symbol("W sin α", "", [pull[0] + 2.0, pull[1] - 1.0], Anchor::Start, Role::Force);
}
