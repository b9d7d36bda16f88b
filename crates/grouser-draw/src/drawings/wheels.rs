//! Wheels in their soil beside each other, to one scale: each from its left side, and below that from
//! behind.

use std::f64::consts::TAU;

use grouser_core::elementary::wide;
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
struct RowOfWheels {
    column: f64,
    scale: f64,
    /// The level of the soil in the two views, from the top of the sheet.
    levels: [f64; 2],
    /// Where the soil of the two views ends.
    bottoms: [f64; 2],
}

impl RowOfWheels {
    fn of(row: &WheelRow) -> Self {
        let most = |of: fn(&WheelShape) -> f64| {
            row.wheels.iter().map(of).fold(f64::MIN_POSITIVE, f64::max)
        };
        let high = most(|it| 2.0 * it.wheel.shearing_radius());
        let widest = most(|it| it.wheel.width).max(high);
        let column = (WIDTH - 2.0 * EDGE) / row.wheels.len().max(1) as f64;
        let scale = (FILLED * column / widest).min(HIGHEST / high);
        let over = scale * most(|it| 2.0 * it.wheel.shearing_radius() - it.sinkage);
        let under = scale * most(|it| it.sinkage) + BELOW;
        let levels = [TOP + over, TOP + over + under + EDGE + over];
        Self { column, scale, levels, bottoms: levels.map(|it| it + under) }
    }

    /// The shearing radius of a wheel on paper.
    fn reach(&self, shape: &WheelShape) -> f64 {
        self.scale * shape.wheel.shearing_radius()
    }

    /// The hub of a wheel over the level of its soil.
    fn hub(&self, shape: &WheelShape, x: f64, level: f64) -> Place {
        [x, level - self.reach(shape) + self.scale * shape.sinkage]
    }
}

pub(crate) fn sheet(row: &WheelRow) -> Sheet {
    let layout = RowOfWheels::of(row);
    let lines = row.wheels.iter().map(|it| it.lines.len()).max().unwrap_or_default();
    let texts = layout.bottoms[1] + LINE;
    let height = texts + LINE * lines as f64 + EDGE;
    let mut pen = Pen::new(&row.title, [WIDTH, height]);
    pen.heading(&row.title, [EDGE, 7.0]);
    for (level, bottom) in layout.levels.into_iter().zip(layout.bottoms) {
        soil(&mut pen, level, bottom);
    }
    for (place, shape) in row.wheels.iter().enumerate() {
        let middle = EDGE + layout.column * (place as f64 + 0.5);
        let [side, behind] = layout.levels.map(|level| layout.hub(shape, middle, level));
        from_its_side(&mut pen, &shape.wheel, side, layout.reach(shape), 0.5);
        from_behind(&mut pen, shape, behind, &layout);
        for (number, line) in shape.lines.iter().enumerate() {
            pen.note(line, [middle, texts + LINE * number as f64], Anchor::Middle);
        }
    }
    pen.sheet
}

/// The soil under all wheels, up to its level.
fn soil(pen: &mut Pen, level: f64, bottom: f64) {
    let [left, right] = [EDGE, WIDTH - EDGE];
    pen.area([[left, level], [right, level], [right, bottom], [left, bottom]], Role::Soil);
    pen.line([[left, level], [right, level]], Role::SoilEdge, 0.5);
}

/// The rim as wide as it is, and the grousers that are seen from behind.
fn from_behind(pen: &mut Pen, shape: &WheelShape, [x, hub]: Place, layout: &RowOfWheels) {
    let (wheel, reach) = (&shape.wheel, layout.reach(shape));
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
