//! Shear displacement and stresses along the arc in contact.

use crate::sheet::{Anchor, Place, Sheet};
use grouser_core::contact::stress::StressField;

use super::pen::{Pen, degrees};
use super::subject::WheelInSoil;
use crate::style::Role;

const SIZE: Place = [190.0, 92.0];
const LEFT: f64 = 26.0;
const RIGHT: f64 = 138.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 74.0;
/// Points of a curve.
const POINTS: u32 = 120;

pub(super) fn sheet(wheel: &WheelInSoil<'_>) -> Sheet {
    let field = StressField::new(wheel.contact, wheel.settled.sinkage);
    let (entry, exit) = (field.patch.entry, field.patch.exit);
    let mut pen = Pen::new("Shear along the arc in contact", SIZE);
    let angle = |point: u32| entry + (exit - entry) * f64::from(point) / f64::from(POINTS);
    let curve =
        |of: &dyn Fn(f64) -> f64| (0..=POINTS).map(|it| of(angle(it))).collect::<Vec<f64>>();
    let normal = curve(&|at| field.at(at).normal);
    let shear = curve(&|at| field.at(at).longitudinal);
    let way = curve(&|at| field.shear_displacement(at)[0]);
    let largest = |values: &[f64]| values.iter().fold(1e-12_f64, |most, it| most.max(it.abs()));
    // Both stresses on one scale, the displacement on its own.
    let stress = field.max_normal().max(largest(&shear));
    let length = largest(&way);
    let lowest =
        |values: &[f64], most: f64| values.iter().fold(0.0_f64, |low, it| low.min(it / most));
    let lowest = lowest(&shear, stress).min(lowest(&way, length));
    let zero = if lowest < -0.02 { f64::midpoint(TOP, BOTTOM) } else { BOTTOM };
    let place = |point: usize, share: f64| {
        let x = LEFT + (RIGHT - LEFT) * point as f64 / f64::from(POINTS);
        [x, zero - (zero - TOP) * share]
    };
    for share in [0.25, 0.5, 0.75, 1.0] {
        pen.line([place(0, share), place(POINTS as usize, share)], Role::Grid, 0.2);
    }
    pen.line([[LEFT, TOP], [LEFT, BOTTOM]], Role::Faint, 0.3);
    pen.line([[LEFT, zero], [RIGHT, zero]], Role::Faint, 0.3);
    let curves = [
        ("σ", format!(" up to {:.1} kPa", stress / 1e3), &normal, stress, Role::Force),
        ("τ_x", " on the same scale".to_owned(), &shear, stress, Role::Thrust),
        ("j_x", format!(" up to {:.1} mm", 1e3 * length), &way, length, Role::Side),
    ];
    let mut labels: Vec<(f64, &str, String, Role)> = Vec::new();
    for (symbol, rest, values, most, role) in curves {
        let points: Vec<Place> =
            values.iter().enumerate().map(|(at, value)| place(at, value / most)).collect();
        labels.push((points[POINTS as usize][1], symbol, rest, role));
        pen.line(points, role, 0.6);
    }
    // From the lowest up, each at its curve's end as far as those below leave room.
    labels.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut highest = BOTTOM + 6.5;
    for (y, symbol, rest, role) in labels {
        let at = y.min(highest - 6.5);
        pen.line([[RIGHT, y], [RIGHT + 3.0, at]], Role::Faint, 0.2);
        pen.symbol(symbol, &rest, [RIGHT + 4.5, at + 1.2], Anchor::Start, role);
        highest = at;
    }
    pen.symbol(
        "θ_f",
        &format!(" = {}", degrees(entry)),
        [LEFT, BOTTOM + 7.0],
        Anchor::Middle,
        Role::Ink,
    );
    pen.symbol(
        "θ_r",
        &format!(" = {}", degrees(exit)),
        [RIGHT, BOTTOM + 7.0],
        Anchor::Middle,
        Role::Ink,
    );
    let middle = f64::midpoint(LEFT, RIGHT);
    pen.note("the rim enters here, and leaves there", [middle, BOTTOM + 13.0], Anchor::Middle);
    pen.arrow([middle - 22.0, BOTTOM + 5.0], [middle + 22.0, BOTTOM + 5.0], Role::Faint, 0.3);
    pen.sheet
}
