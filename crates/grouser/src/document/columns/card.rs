//! The operator's card: of each slope its verdict, the soil as written, and the bands over samples of it.

use super::super::table::{Table, Values};
use super::super::unit::{DEG, M_PER_M};
use super::flags::{self, FLAGS};
use super::heading::{DRAWS, DRAWS_LEVEL};
use super::{
    Column, LIMIT_SLOPE, OK, POWER, PROBABILITY_LEVEL, Quantity, SLIP_RATIO, SLOPE, STATUS, YAW,
    quantity, text, whole,
};
use crate::studies::card::{Card, CardRow, Verdict};

/// Drift at yaw 0.
pub const DRIFT: Quantity = quantity("downhill_m_per_m", M_PER_M);
/// The verdict on a slope: go, caution or no-go.
pub const VERDICT: &str = "verdict";

/// The keyword of a verdict.
#[must_use]
pub const fn name_of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Go => "go",
        Verdict::Caution => "caution",
        Verdict::NoGo => "no-go",
    }
}

struct OnCard<'a> {
    row: &'a CardRow,
    card: &'a Card,
}

const fn columns<'a>() -> [Column<OnCard<'a>>; 16] {
    [
        SLOPE.given("Slope", |it| Some(it.row.slope)),
        text(VERDICT, "`go`, `caution` or `no-go`", |it| Some(name_of(it.row.verdict).into())),
        YAW.maybe("Yaw that holds the contour, positive uphill", |it| {
            it.row.level.map(|level| level.yaw)
        }),
        YAW.band("The same over the samples", |it| it.row.bands.as_ref()?.yaw),
        SLIP_RATIO.maybe("Slip ratio of every wheel at that yaw", |it| {
            it.row.level.map(|level| level.slip_ratio)
        }),
        SLIP_RATIO.band("The same over the samples; 1 where no heading holds the contour", |it| {
            it.row.bands.as_ref()?.slip_ratio
        }),
        POWER.maybe("Power of the motors at that yaw", |it| it.row.level.map(|level| level.power)),
        POWER.band("The same over the samples", |it| it.row.bands.as_ref()?.power),
        DRIFT.maybe("Drift per metre travelled at yaw 0, positive downhill", |it| it.row.drift),
        DRIFT.band("The same over the samples", |it| it.row.bands.as_ref()?.drift),
        PROBABILITY_LEVEL
            .probability("Share of the samples with a heading that holds the contour", |it| {
                it.row.bands.as_ref().map(|bands| bands.level)
            }),
        whole(
            DRAWS_LEVEL,
            "Samples with a heading that holds the contour: yaw and power are over them",
            |it| it.row.bands.as_ref().map(|bands| bands.level.successes),
        ),
        whole(
            "draws_held",
            "Samples in which the rover does not slide at yaw 0; in others the drift counts as 1",
            |it| it.row.bands.as_ref().map(|bands| bands.held.successes),
        ),
        whole(DRAWS, "All samples", |it| it.card.draws),
        text(STATUS, "`ok`, or why no heading holds the contour on the soil as written", |it| {
            Some(status(it))
        }),
        flags::flags(|it| flags::names(&it.row.findings)),
    ]
}

/// Why no heading holds the contour on the soil as written.
fn status(it: &OnCard<'_>) -> String {
    it.row.refusal.clone().unwrap_or_else(|| OK.to_owned())
}

/// A row for each slope. Columns without a band are of the soil as its document has it; bands are over the samples, and
/// missing where there are none.
#[must_use]
pub fn table(card: &Card) -> Table {
    let rows: Vec<OnCard<'_>> = card.rows.iter().map(|row| OnCard { row, card }).collect();
    Table::of(&columns(), &rows)
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    [SLOPE.name, VERDICT, YAW.name, SLIP_RATIO.name, DRIFT.name, POWER.name, FLAGS]
        .map(String::from)
        .into()
}

/// The same, with the bands over samples.
#[must_use]
pub fn bands_brief() -> Vec<String> {
    let [yaw_low, yaw_median, yaw_high] = YAW.quantiles();
    let [slip, drift, power] = [SLIP_RATIO, DRIFT, POWER].map(|it| {
        let [.., high] = it.quantiles();
        high
    });
    let [slope, verdict, level] = [SLOPE.name, VERDICT, PROBABILITY_LEVEL.name].map(String::from);
    let flags = FLAGS.to_owned();
    vec![slope, verdict, yaw_median, yaw_low, yaw_high, slip, drift, power, level, flags]
}

/// How many samples the card has, and the steepest slope: one row.
#[must_use]
pub fn steepest(card: &Card) -> Table {
    const LIMIT: [Column<Card>; 3] = [
        whole(DRAWS, "All samples", |it| it.draws),
        LIMIT_SLOPE.maybe("The steepest slope on which a heading holds the contour", |it| {
            it.limit.as_ref().ok().map(|(limit, _)| *limit)
        }),
        LIMIT_SLOPE.band("The same over the samples", |it| it.limit_band),
    ];
    Table::of(&LIMIT, std::slice::from_ref(card))
}

/// A measured yaw, in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredYaw {
    /// The slope [°].
    pub slope: f64,
    /// The name of its column.
    pub name: String,
    /// The yaw [°], positive uphill.
    pub yaw: f64,
}

const MEASURED_YAW: Quantity = quantity("measured_yaw_deg", DEG);
const MEASURED: &str = "measured";
const PLACE: &str = "place";

/// Measured yaws, each beside the card's numbers on its slope, and whether it lies `below`, `inside` or `above`
/// the band over samples.
#[must_use]
pub fn beside(card: &Table, measured: &[MeasuredYaw]) -> Table {
    let slopes = card.numbers(SLOPE.name);
    let pairs = measured.iter().filter_map(|point| {
        // Both were this many degrees once, and came through radians.
        let is_there =
            |slope: &Option<f64>| slope.is_some_and(|it| (it - point.slope).abs() < 1e-9);
        Some((point, slopes.iter().position(is_there)?))
    });
    let (points, rows): (Vec<&MeasuredYaw>, Vec<usize>) = pairs.unzip();
    let [low, _, high] = YAW.quantiles();
    let ends = (card.numbers(&low), card.numbers(&high));
    let place = |(point, row): (&&MeasuredYaw, &usize)| {
        let (low, high) = ends.0[*row].zip(ends.1[*row])?;
        let is_below = point.yaw < low;
        let is_above = point.yaw > high;
        let word = if is_below {
            "below"
        } else if is_above {
            "above"
        } else {
            "inside"
        };
        Some(word.to_owned())
    };
    let names = points.iter().map(|point| Some(point.name.clone())).collect();
    let yaws = points.iter().map(|point| Some(point.yaw)).collect();
    let places = points.iter().zip(&rows).map(place).collect();
    let beside = |names: &[&str]| card.select(names, &rows);
    let mut table = beside(&[SLOPE.name]);
    table.columns.push((MEASURED.into(), Values::Text(names)));
    table.columns.push((MEASURED_YAW.name.into(), Values::Float(yaws)));
    table.columns.extend(beside(&[YAW.name, &low, &high, PROBABILITY_LEVEL.name]).columns);
    table.columns.push((PLACE.into(), Values::Text(places)));
    table
}

/// The columns of [`beside`] for reading.
#[must_use]
pub fn beside_brief() -> Vec<String> {
    let [low, _, high] = YAW.quantiles();
    let [slope, measured, yaw] = [SLOPE.name, MEASURED, MEASURED_YAW.name].map(String::from);
    vec![slope, measured, yaw, low, high, PROBABILITY_LEVEL.name.into(), PLACE.into()]
}
