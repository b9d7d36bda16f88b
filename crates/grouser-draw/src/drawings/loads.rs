//! How the wheels share the load.

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::elementary::wide;

use super::pen::{Pen, circle, degrees};
use super::subject::Crossing;
use crate::style::Role;

const SIZE: Place = [190.0, 100.0];
const CENTRE: Place = [78.0, 52.0];
/// Radius of a disc of the mean load [mm].
const DISC: f64 = 10.0;

pub(super) fn sheet(crossing: &Crossing<'_>) -> Sheet {
    let mut pen = Pen::new("How the wheels share the load", SIZE);
    let (sin, cos) = wide::sin_cos(crossing.yaw);
    pen.area([[4.0, 6.0], [152.0, 6.0], [152.0, 96.0], [4.0, 96.0]], Role::Soil);
    for line in 1..6 {
        let y = 6.0 + 15.0 * f64::from(line);
        pen.line([[4.0, y], [152.0, y]], Role::Contour, 0.2);
    }
    let mounts = crossing.rover.mounts();
    let reach = mounts
        .iter()
        .fold(1e-9_f64, |most, mount| most.max(mount.position.x.abs()).max(mount.position.y.abs()));
    let scale = 30.0 / reach;
    let at = |x: f64, y: f64| {
        [CENTRE[0] + scale * (x * cos - y * sin), CENTRE[1] - scale * (x * sin + y * cos)]
    };
    let total: f64 = crossing.wheels.iter().map(|wheel| wheel.load).sum();
    let mean = total / crossing.wheels.len().max(1) as f64;
    let [long, wide] = [0, 1]
        .map(|k| mounts.iter().fold(0.0_f64, |most, mount| most.max(mount.position[k].abs())));
    let [x, y] = [0.9 * long, 0.55 * wide];
    pen.outlined([at(-x, -y), at(x, -y), at(x, y), at(-x, y)], Role::BodyTop, Role::BodyDark);
    for (mount, wheel) in mounts.iter().zip(crossing.wheels) {
        let place = at(mount.position.x, mount.position.y);
        pen.faint_area(circle(place, DISC * (wheel.load / mean).sqrt()), Role::Normal);
        pen.line(circle(place, DISC * (wheel.load / mean).sqrt()), Role::Normal, 0.5);
        pen.text(&format!("{:.1} N", wheel.load), [place[0], place[1] + 1.3], Anchor::Middle);
        pen.note(&mount.name, [place[0], place[1] + 5.0], Anchor::Middle);
    }
    let centre = crossing.rover.centre_of_mass();
    pen.area(circle(at(centre.x, centre.y), 1.4), Role::Ink);
    let right = 156.0;
    pen.symbol(
        "α",
        &format!(" = {}", degrees(crossing.slope)),
        [right, 14.0],
        Anchor::Start,
        Role::Ink,
    );
    pen.symbol(
        "γ",
        &format!(" = {}", degrees(crossing.yaw)),
        [right, 21.0],
        Anchor::Start,
        Role::Ink,
    );
    pen.symbol("ΣW", &format!(" = {total:.1} N"), [right, 28.0], Anchor::Start, Role::Ink);
    pen.area(circle([right + 1.4, 35.0], 1.4), Role::Ink);
    pen.note("centre of mass", [right + 4.5, 36.0], Anchor::Start);
    pen.arrow([right + 3.0, 62.0], [right + 3.0, 46.0], Role::Ink, 0.4);
    pen.note("uphill", [right + 6.0, 55.0], Anchor::Start);
    pen.sheet
}
