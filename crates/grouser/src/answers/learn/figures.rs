//! The figures of a drive: predictions before and after it, what stretches taught, and slips from
//! currents.

use crate::document::columns::learn::{
    BEFORE_SLIP, BEFORE_YAW, BY_ACROSS, BY_ALONG, BY_SINKAGE, BY_TORQUE, BY_TURNING, EXPECTED_SLIP,
    INFORMATION, WAY,
};
use crate::document::columns::slip_from_current::{TRUE_SLIP, WHEEL};
use crate::document::columns::{Quantity, SLIP_RATIO, SLOPE, TIME, YAW};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style, axis};
use crate::document::table::Table;
use crate::vehicle::Rover;

/// The colour of bands after the drive, among those of charts.
const AFTER: usize = 1;

/// Yaw and slip over the slope, before the drive and after it.
pub(super) fn predictions(table: &Table) -> Vec<Chart> {
    let band = |name: &str, colour: usize, quantity: Quantity| {
        let [low, _, high] = quantity.quantiles();
        Series::band(name, colour, table.edges(SLOPE, [&low, &high]))
    };
    let chart = |(after, before, title): (Quantity, Quantity, &str)| {
        let series = vec![
            band("before, 95 %", BAND_COLOUR, before),
            band("after, 95 %", AFTER, after),
            Series::new("after", Style::Line, 1, table.points(SLOPE.name, after.name)),
        ];
        Chart::new(title, (axis(SLOPE), axis(after)), series)
    };
    let both = [
        (YAW, BEFORE_YAW, "Heading that holds the contour"),
        (SLIP_RATIO, BEFORE_SLIP, "Slip ratio"),
    ];
    both.into_iter().map(chart).collect()
}

/// Slip over the way, as it was seen and as it was expected.
pub(super) fn over_way(lessons: &Table) -> Chart {
    let expected = lessons.points(WAY.name, EXPECTED_SLIP.name);
    let series = vec![
        Series::new("seen", Style::Line, 1, lessons.points(WAY.name, SLIP_RATIO.name)),
        Series::new("expected before", Style::Dashed, 2, expected),
    ];
    Chart::new("Slip ratio along the way", (axis(WAY), axis(SLIP_RATIO)), series)
}

/// What stretches taught over the way, whole and in parts.
pub(super) fn information(lessons: &Table) -> Chart {
    let parts = [
        (INFORMATION, "all"),
        (BY_ALONG, "force along the body"),
        (BY_ACROSS, "force across it"),
        (BY_TURNING, "yaw moment"),
        (BY_TORQUE, "torques"),
        (BY_SINKAGE, "sinkages"),
    ];
    let series = parts.into_iter().zip(1..).filter_map(|((quantity, name), colour)| {
        let points: Vec<_> = lessons.points(WAY.name, quantity.name).collect();
        let taught = points.iter().any(|(_, value)| *value != 0.0);
        taught.then(|| Series::new(name, Style::Line, colour, points))
    });
    let axes = (axis(WAY), axis(INFORMATION));
    Chart::new("Knowledge of the soil gained", axes, series.collect())
}

/// A chart for each wheel: the slip that its current gives, with the band, and the slip that was
/// seen.
pub(super) fn slips(rover: &Rover, rows: &Table) -> Vec<Chart> {
    let [low, median, high] = SLIP_RATIO.quantiles();
    let chart = |wheel: &String| {
        let names = rows.texts(WHEEL).iter().enumerate();
        let own = names.filter(|(_, name)| name.as_ref() == Some(wheel));
        let own = rows.rows_at(&own.map(|(place, _)| place).collect::<Vec<_>>());
        let edges = own.edges(TIME, [&low, &high]);
        let series = vec![
            Series::band("from its current, 95 %", AFTER, edges),
            Series::new("from its current", Style::Line, 1, own.points(TIME.name, &median)),
            Series::new("seen", Style::Dashed, 2, own.points(TIME.name, TRUE_SLIP.name)),
        ];
        Chart::new(wheel, (axis(TIME), axis(SLIP_RATIO)), series)
    };
    rover.mounts().iter().map(|mount| chart(&mount.name)).collect()
}
