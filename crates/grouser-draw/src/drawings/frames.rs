//! The frames of slope and body.

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::elementary::wide;

use super::pen::{Pen, degrees};
use super::subject::Crossing;
use crate::style::Role;

const SIZE: Place = [190.0, 120.0];
const ORIGIN: Place = [96.0, 72.0];
/// Length of the axes of the frames [mm].
const AXIS: f64 = 44.0;
/// The view is turned by this much from straight uphill, and looks down by the other [rad].
const VIEW: [f64; 2] = [0.55, 0.5];

/// Directions of the slope on paper.
struct View {
    slope: f64,
}

impl View {
    /// On paper of a vector of the slope frame.
    fn place(&self, [x, y, z]: [f64; 3]) -> Place {
        let (sin, cos) = wide::sin_cos(self.slope);
        // In the horizon's frame: along the contour, horizontally uphill, upright.
        let level = [x, y * cos - z * sin, y * sin + z * cos];
        let [(sin_a, cos_a), (sin_e, cos_e)] = VIEW.map(wide::sin_cos);
        let right = level[0] * cos_a + level[1] * sin_a;
        let deep = -level[0] * sin_a + level[1] * cos_a;
        let up = deep * sin_e + level[2] * cos_e;
        [ORIGIN[0] + right, ORIGIN[1] - up]
    }
}

pub(super) fn sheet(crossing: &Crossing<'_>) -> Sheet {
    let mut pen = Pen::new("The frames", SIZE);
    let view = View { slope: crossing.slope };
    let level = View { slope: 0.0 };
    let corners = [[-62.0, -30.0, 0.0], [62.0, -30.0, 0.0], [62.0, 46.0, 0.0], [-62.0, 46.0, 0.0]];
    pen.outlined(corners.map(|corner| view.place(corner)), Role::Soil, Role::SoilEdge);
    for contour in [-15.0, 0.0, 15.0, 30.0] {
        let ends = [[-62.0, contour, 0.0], [62.0, contour, 0.0]].map(|end| view.place(end));
        pen.line(ends, Role::Contour, 0.25);
    }
    // The inclination, at the foot of the slope.
    let foot = view.place([62.0, -30.0, 0.0]);
    let beside = |v: [f64; 3], view: &View| {
        let [x, y] = view.place(v);
        [foot[0] + x - ORIGIN[0], foot[1] + y - ORIGIN[1]]
    };
    pen.dashed(foot, beside([0.0, 42.0, 0.0], &level), Role::Faint);
    let steps = (0..=16).map(|step| {
        let part = View { slope: crossing.slope * f64::from(step) / 16.0 };
        beside([0.0, 30.0, 0.0], &part)
    });
    pen.line(steps.collect::<Vec<_>>(), Role::Ink, 0.3);
    let middle = beside([0.0, 34.0, 0.0], &View { slope: crossing.slope / 2.0 });
    pen.symbol(
        "α",
        &format!(" = {}", degrees(crossing.slope)),
        [middle[0] + 1.5, middle[1] + 1.0],
        Anchor::Start,
        Role::Ink,
    );
    body(&mut pen, crossing, &view);
    let axes = [([AXIS, 0.0, 0.0], "x_s"), ([0.0, AXIS, 0.0], "y_s"), ([0.0, 0.0, AXIS], "z_s")];
    for (axis, name) in axes {
        arrow(&mut pen, &view, axis, name, Role::Ink);
    }
    let (sin, cos) = wide::sin_cos(crossing.yaw);
    let long = 0.82 * AXIS;
    for (axis, name) in
        [([long * cos, long * sin, 0.0], "x_b"), ([-long * sin, long * cos, 0.0], "y_b")]
    {
        arrow(&mut pen, &view, axis, name, Role::Thrust);
    }
    let turn = (0..=16).map(|step| {
        let (sin, cos) = wide::sin_cos(crossing.yaw * f64::from(step) / 16.0);
        view.place([0.6 * AXIS * cos, 0.6 * AXIS * sin, 0.0])
    });
    pen.line(turn.collect::<Vec<_>>(), Role::Thrust, 0.4);
    let (sin, cos) = wide::sin_cos(crossing.yaw / 2.0);
    let at = view.place([0.66 * AXIS * cos, 0.66 * AXIS * sin, 0.0]);
    pen.symbol("γ", "", [at[0], at[1] + 1.2], Anchor::Start, Role::Thrust);
    pen.symbol(
        "γ",
        &format!(" = {}, the yaw, positive uphill", degrees(crossing.yaw)),
        [8.0, SIZE[1] - 6.0],
        Anchor::Start,
        Role::Thrust,
    );
    pen.sheet
}

/// The outline of the body and the wheels on the slope.
fn body(pen: &mut Pen, crossing: &Crossing<'_>, view: &View) {
    let (sin, cos) = wide::sin_cos(crossing.yaw);
    // The hubs are this far out [mm].
    pen.rover_from_above(crossing.rover, 17.0, |scale, x, y| {
        view.place([scale * (x * cos - y * sin), scale * (x * sin + y * cos), 0.0])
    });
}

fn arrow(pen: &mut Pen, view: &View, axis: [f64; 3], name: &str, role: Role) {
    let (from, to) = (view.place([0.0; 3]), view.place(axis));
    pen.arrow(from, to, role, 0.6);
    let side = if to[0] < from[0] { -1.0 } else { 1.0 };
    let anchor = if side < 0.0 { Anchor::End } else { Anchor::Start };
    pen.symbol(name, "", [to[0] + 1.5 * side, to[1] - 0.5], anchor, role);
}
