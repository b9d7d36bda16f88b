//! The columns of a rover on slopes: slip and yaw, measured and predicted.

use super::super::table::Table;
use super::flags::{self, FLAGS};
use super::{COURSE, Column, OK, SLIP_RATIO, SLOPE, STATUS, YAW, text, whole};
use crate::studies::slope_tests::Mean;
use crate::studies::slope_validation::SlopeComparison;

const COLUMNS: [Column<SlopeComparison>; 7] = [
    SLOPE.given("Slopes", |it| Some(it.point.slope)),
    COURSE.given("Directions of travel from the contour, positive uphill", |it| {
        Some(it.point.course)
    }),
    whole("trials", "How many rows were averaged", |it| {
        let means = [it.point.slip_ratio, it.point.yaw];
        means.into_iter().flatten().map(|mean| mean.rows).max()
    }),
    SLIP_RATIO
        .compared("Slip ratio; 1 where no heading holds a course along or up the slope", |it| {
            beside(it.point.slip_ratio, it.slip_ratio)
        }),
    YAW.compared("Yaw that holds the course", |it| beside(it.point.yaw, it.yaw)),
    text(STATUS, "`ok`, or why no heading holds the course", |it| {
        Some(it.not_held.clone().unwrap_or_else(|| OK.to_owned()))
    }),
    flags::flags(|it| flags::names(&it.findings)),
];

/// The columns that tell slopes apart.
pub const SETTINGS: [&str; 2] = [COURSE.name, SLOPE.name];

fn beside(measured: Option<Mean>, predicted: Option<f64>) -> [Option<f64>; 3] {
    [measured.map(|mean| mean.value), measured.and_then(|mean| mean.deviation), predicted]
}

/// A row for each slope and course. Predictions of what was not measured are there too.
#[must_use]
pub fn slopes(points: &[SlopeComparison]) -> Table {
    Table::of(&COLUMNS, points)
}

/// The columns of [`slopes`] for reading: only quantities that were measured.
#[must_use]
pub fn brief(points: &[SlopeComparison]) -> Vec<String> {
    let is_measured =
        |of: fn(&SlopeComparison) -> Option<Mean>| points.iter().any(|it| of(it).is_some());
    let slip = is_measured(|it| it.point.slip_ratio).then_some(SLIP_RATIO);
    let yaw = is_measured(|it| it.point.yaw).then_some(YAW);
    let measured = [slip, yaw].into_iter().flatten();
    let pairs = measured.flat_map(|it| [it.measurement(), it.name.to_owned()]);
    let place = [SLOPE, COURSE].map(|it| it.name.to_owned());
    place.into_iter().chain(pairs).chain([STATUS, FLAGS].map(str::to_owned)).collect()
}
