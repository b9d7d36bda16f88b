//! Wheels in their soil beside each other, to one scale: each from its left side, and below that from
//! behind.

use std::f64::consts::TAU;

use grouser_core::elementary::wide;
use grouser_core::wheel::Wheel;
use grouser_io::figure::{WheelRow, WheelShape};

use super::pen::Pen;
use super::wheel::from_its_side;
use crate::sheet::{Anchor, Place, Sheet};
use crate::style::Role;

/// Width of the sheet [mm].
const WIDTH: f64 = 190.0;
/// At its edges, and between views [mm].
const EDGE: f64 = 4.0;
/// Below the title [mm].
const TOP: f64 = 12.0;
/// The largest wheel is no higher [mm].
const HIGHEST: f64 = 40.0;
/// The share of its column that the largest wheel takes [-].
const FILLED: f64 = 0.9;
/// Between lines of text [mm].
const LINE: f64 = 4.2;
/// Height of the soil that is drawn below wheels [mm].
const BELOW: f64 = 3.0;

/// How a row of wheels lies on its sheet [mm], and its scale [mm/m].
struct Layout {
    column: f64,
    scale: f64,
    /// Height of the hubs in the two views.
    hubs: [f64; 2],
    /// Where the soil of the two views ends.
    bottoms: [f64; 2],
}

impl Layout {
    fn of(row: &WheelRow) -> Self {
        let most = |of: fn(&Wheel) -> f64| {
            row.wheels.iter().map(|it| of(&it.wheel)).fold(f64::MIN_POSITIVE, f64::max)
        };
        let reach = most(Wheel::shearing_radius);
        let column = (WIDTH - 2.0 * EDGE) / row.wheels.len().max(1) as f64;
        let widest = most(|wheel| wheel.width).max(2.0 * reach);
        let scale = (FILLED * column / widest).min(HIGHEST / (2.0 * reach));
        let high = 2.0 * scale * reach + BELOW;
        let tops = [TOP, TOP + high + EDGE];
        let (hubs, bottoms) = (tops.map(|it| it + scale * reach), tops.map(|it| it + high));
        Self { column, scale, hubs, bottoms }
    }
}

pub(crate) fn sheet(row: &WheelRow) -> Sheet {
    let layout = Layout::of(row);
    let lines = row.wheels.iter().map(|it| it.lines.len()).max().unwrap_or_default();
    let texts = layout.bottoms[1] + LINE;
    let height = texts + LINE * lines as f64 + EDGE;
    let mut pen = Pen::new(&row.title, [WIDTH, height]);
    pen.heading(&row.title, [EDGE, 7.0]);
    for (place, shape) in row.wheels.iter().enumerate() {
        let middle = EDGE + layout.column * (place as f64 + 0.5);
        let [side, behind] = layout.hubs.map(|hub| [middle, hub]);
        soil(&mut pen, shape, side, &layout, layout.bottoms[0]);
        from_its_side(&mut pen, &shape.wheel, side, reach(shape, &layout), 0.5);
        soil(&mut pen, shape, behind, &layout, layout.bottoms[1]);
        from_behind(&mut pen, shape, behind, &layout);
        for (number, line) in shape.lines.iter().enumerate() {
            pen.note(line, [middle, texts + LINE * number as f64], Anchor::Middle);
        }
    }
    pen.sheet
}

fn reach(shape: &WheelShape, layout: &Layout) -> f64 {
    layout.scale * shape.wheel.shearing_radius()
}

/// The soil around a wheel, up to its level.
fn soil(pen: &mut Pen, shape: &WheelShape, [x, hub]: Place, layout: &Layout, bottom: f64) {
    let half = 0.5 * layout.column;
    let level = hub + reach(shape, layout) - layout.scale * shape.sinkage;
    let [left, right] = [x - half, x + half];
    pen.area([[left, level], [right, level], [right, bottom], [left, bottom]], Role::Soil);
    pen.line([[left, level], [right, level]], Role::SoilEdge, 0.5);
}

/// The rim as wide as it is, and the grousers that are seen from behind.
fn from_behind(pen: &mut Pen, shape: &WheelShape, [x, hub]: Place, layout: &Layout) {
    let (wheel, reach) = (&shape.wheel, reach(shape, layout));
    let (half, rim) = (layout.scale * wheel.width / 2.0, layout.scale * wheel.radius);
    let corners = |high: f64| {
        [[-half, -high], [half, -high], [half, high], [-half, high]]
            .map(|[dx, dy]| [x + dx, hub + dy])
    };
    pen.outlined(corners(rim), Role::Paper, Role::Rim);
    let Some(grousers) = wheel.grousers else { return };
    for bar in 0..grousers.count {
        let (sin, cos) = wide::sin_cos(TAU * f64::from(bar) / f64::from(grousers.count));
        // Those on the far side are hidden by the rim.
        if sin >= -1e-9 || (reach * cos).abs() > rim {
            let y = hub + reach * cos;
            pen.line([[x - half, y], [x + half, y]], Role::Grouser, 0.5);
        }
    }
}
