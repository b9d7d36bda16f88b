//! The heading offset that holds the contour: on a slope, over slope and course, and over samples
//! of an uncertain soil.

use super::super::table::Table;
use super::super::unit::NM;
use super::flags::{self, FLAGS};
use super::verdict::{ADVICE, PROBABILITY_STUCK, REASON, VERDICT, YAW_AS_WRITTEN, YAWS_OF_MODELS};
use super::{
    COURSE, Column, ENERGY_PER_METRE, LIMIT_SLOPE, OK, POWER, PROBABILITY_LEVEL, Quantity, SINKAGE,
    SLIP_RATIO, SLOPE, STATUS, STEERING, TORQUE, YAW, quantity, text, whole,
};
use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::studies::ensemble::models::ACROSS;
use crate::studies::heading::{HeadingCurve, HeadingOffset, LimitedBy, NoHeading, Steering};
use crate::studies::heading_band::{HeadingBand, SlopeBand};
use crate::studies::heading_map::{HeadingMap, HeadingRow};
use crate::studies::verdict::Advice;
use crate::vehicle::Rover;

/// A rover that holds its course, as the rows of tables need it.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    /// Heading offset, slip and forces.
    pub heading: &'a HeadingOffset,
    /// The rover.
    pub rover: &'a Rover,
    /// Rim speed of all wheels, ω r_s [m/s]; missing where no power is asked for.
    pub rim_speed: Option<f64>,
}

/// The results of a rover that holds its course.
#[must_use]
pub const fn held<'a>() -> [Column<Held<'a>>; 7] {
    [
        YAW.number("Yaw that holds the course, positive uphill", |it| it.heading.yaw),
        SLIP_RATIO.number("Slip ratio of every wheel; with wheels steered, of these", |it| {
            it.heading.slip_ratio
        }),
        SINKAGE.number("Mean sinkage of the wheels", |it| it.heading.mean_sinkage()),
        TORQUE.number("Torque of all wheels together", |it| it.heading.torque()),
        POWER.maybe("Power of the motors at the rim speed of the map", |it| {
            it.rim_speed.map(|speed| it.heading.power(it.rover, speed))
        }),
        ENERGY_PER_METRE.number("Work of the wheels per metre along the course", |it| {
            it.heading.energy_per_metre(it.rover)
        }),
        YAW_MOMENT.number("Yaw moment left over; negative turns the nose downhill", |it| {
            it.heading.yaw_moment
        }),
    ]
}

/// What a rover has whose wheels are steered to hold its course, before the other results.
#[must_use]
pub const fn steered<'a>() -> [Column<Held<'a>>; 1] {
    [STEERING.maybe("Steering angle of every wheel that is steered, positive uphill", |it| {
        it.heading.steering
    })]
}

/// Yaw moment that is left over.
pub const YAW_MOMENT: Quantity = quantity("yaw_moment_nm", NM);

/// A slope of some soil and course, and the heading offset there.
#[derive(Clone, Copy, Debug)]
struct OnSlope<'a> {
    slope: f64,
    found: &'a Result<HeadingOffset, NoHeading>,
    findings: &'a [Finding],
    /// Name of the soil in a map; empty elsewhere.
    soil: &'a str,
    /// Row of the map; `None` elsewhere.
    row: Option<&'a HeadingRow>,
}

const fn slope<'a>() -> [Column<OnSlope<'a>>; 1] {
    [SLOPE.given("Slopes", |it| Some(it.slope))]
}

const fn status<'a>() -> [Column<OnSlope<'a>>; 2] {
    [
        text(STATUS, "`ok`, or why no heading offset holds the course", |it| {
            Some(it.found.as_ref().map_or_else(ToString::to_string, |_| OK.into()))
        }),
        flags::flags(|it| flags::names(it.findings)),
    ]
}

const SOIL: &str = "soil";

/// The columns of a map that tell rows apart.
pub const SETTINGS: [&str; 3] = [SOIL, COURSE.name, SLOPE.name];

/// Columns of a map before the results.
const fn place<'a>() -> [Column<OnSlope<'a>>; 2] {
    [
        text(SOIL, "The soils' names", |it| Some(it.soil.to_owned())),
        COURSE.given("Directions of travel from the contour, positive uphill", |it| {
            it.row.map(|row| row.course)
        }),
    ]
}

/// Columns of a map after the results.
const fn limit<'a>() -> [Column<OnSlope<'a>>; 2] {
    [
        LIMIT_SLOPE
            .maybe("The steepest slope of the soil and course, the same on every slope", |it| {
                it.row?.limit.as_ref().ok().map(|(slope, _)| *slope)
            }),
        text(LIMITED_BY, WHAT_LIMITS, |it| it.row?.limited_by.map(|by| by.name().to_owned())),
    ]
}

/// The flags on each slope [rad].
#[must_use]
pub fn findings(curve: &HeadingCurve, slopes: &[f64]) -> Vec<Vec<Finding>> {
    slopes.iter().map(|slope| curve.findings(*slope, &curve.at(*slope))).collect()
}

/// A row for each slope [rad]. Results are missing where `status` is not `ok`.
#[must_use]
pub fn table(curve: &HeadingCurve, rover: &Rover, slopes: &[f64]) -> Table {
    let found: Vec<_> = slopes.iter().map(|slope| curve.at(*slope)).collect();
    let pairs = slopes.iter().zip(&found);
    let findings: Vec<_> = pairs.map(|(slope, found)| curve.findings(*slope, found)).collect();
    let rows = slopes.iter().zip(&found).zip(&findings);
    let rows = rows.map(|((slope, found), findings)| OnSlope {
        slope: *slope,
        found,
        findings,
        soil: "",
        row: None,
    });
    found_table(Table::default(), &rows.collect::<Vec<_>>(), rover, None, curve.steering())
}

/// Slope, results, status and flags.
fn found_table(
    table: Table,
    rows: &[OnSlope<'_>],
    rover: &Rover,
    rim_speed: Option<f64>,
    steering: Steering,
) -> Table {
    let all = rows.iter().map(|row| {
        let heading = row.found.as_ref().ok()?;
        Some(Held { heading, rover, rim_speed })
    });
    let all: Vec<Option<Held<'_>>> = all.collect();
    let all: Vec<Option<&Held<'_>>> = all.iter().map(Option::as_ref).collect();
    let rows: Vec<Option<&OnSlope<'_>>> = rows.iter().map(Some).collect();
    let (power, results): (Vec<_>, Vec<_>) =
        held().into_iter().partition(|column| column.name == POWER.name);
    let table = table.and(&slope(), &rows);
    let table = if steering == Steering::Crab { table.and(&steered(), &all) } else { table };
    let table = table.and(&results, &all).and(&status(), &rows);
    if rim_speed.is_some() { table.and(&power, &all) } else { table }
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief(steering: Steering) -> Vec<String> {
    let [.., yaw_moment] = held();
    let names = [SLOPE, turned(steering), SLIP_RATIO, SINKAGE, ENERGY_PER_METRE].map(|it| it.name);
    names.into_iter().chain([yaw_moment.name, STATUS, FLAGS]).map(String::from).collect()
}

/// The angle that holds the course: of the body, or of its wheels.
#[must_use]
pub const fn turned(steering: Steering) -> Quantity {
    match steering {
        Steering::None => YAW,
        Steering::Crab => STEERING,
    }
}

/// The angle that holds the course over the slope, as points of a chart.
#[must_use]
pub fn curve(curve: &HeadingCurve) -> Table {
    let points: [Column<HeadingOffset>; 2] = [
        SLOPE.number("Slopes", |it| it.slope),
        turned(curve.steering()).number("The angle that holds the course, positive uphill", |it| {
            it.steering.unwrap_or(it.yaw)
        }),
    ];
    Table::of(&points, &curve.headings())
}

/// The steepest slope, and what ends the curve there: one row.
#[must_use]
pub fn steepest(curve: &HeadingCurve) -> Table {
    type Limit = (Result<(f64, String), String>, Option<LimitedBy>);
    const LIMIT: [Column<Limit>; 3] = [
        LIMIT_SLOPE.maybe("The steepest slope on which a heading holds the course", |(it, _)| {
            it.as_ref().ok().map(|(slope, _)| *slope)
        }),
        text(LIMIT_REASON, "What ends the curve there", |(it, _)| {
            Some(it.as_ref().map_or_else(Clone::clone, |(_, reason)| reason.clone()))
        }),
        text(LIMITED_BY, WHAT_LIMITS, |(_, by)| by.map(|by| by.name().to_owned())),
    ];
    let limit = match curve.limit() {
        Ok((slope, reason)) => Ok((slope, reason.to_owned())),
        Err(NoHeading::CannotMove(reason) | NoHeading::TooSteep { reason, .. }) => Err(reason),
        Err(other @ (NoHeading::GroundStrength { .. } | NoHeading::NotFound { .. })) => {
            Err(other.to_string())
        }
    };
    Table::of(&LIMIT, &[(limit, curve.limited_by())])
}

/// What ends a curve.
pub const LIMIT_REASON: &str = "limit_reason";
/// The same as one of a few words.
pub const LIMITED_BY: &str = "limited_by";
const WHAT_LIMITS: &str = "What ends the curve there: the `wheels`, the ground's own strength \
     (`ground-strength`), the `range` of slopes, or the search, which gave up (`not-found`)";

/// A row for each soil, course and slope of a map.
///
/// * `soils`: the name of each study's soil
/// * `rim_speed`: for the power [m/s]
#[must_use]
pub fn map_table(map: &HeadingMap, soils: &[String], rover: &Rover, rim_speed: f64) -> Table {
    let places = map.rows.iter().flat_map(|row| (0..map.slopes.len()).map(move |at| (row, at)));
    let rows = places.map(|(row, at)| OnSlope {
        slope: map.slopes[at],
        found: &row.cells[at],
        findings: &row.findings[at],
        soil: &soils[row.study],
        row: Some(row),
    });
    let rows: Vec<OnSlope<'_>> = rows.collect();
    let all: Vec<Option<&OnSlope<'_>>> = rows.iter().map(Some).collect();
    let table = Table::default().and(&place(), &all);
    let table = found_table(table, &rows, rover, Some(rim_speed), Steering::None);
    table.and(&limit(), &all)
}

/// The columns of [`map_table`] for reading.
#[must_use]
pub fn map_brief() -> Vec<String> {
    let numbers = [COURSE, SLOPE, YAW, SLIP_RATIO, SINKAGE, ENERGY_PER_METRE, POWER];
    let names = numbers.map(|it| it.name);
    [SOIL].into_iter().chain(names).chain([STATUS, FLAGS]).map(String::from).collect()
}

/// Quantiles and probabilities on one slope over samples of soil and model. A sample in which no
/// heading holds the course counts as slip 1, sunk to the axles, and with yaw and work without a
/// bound, whose quantiles are missing. A sample for which the search gave up counts as
/// nothing: it is in no quantile and no probability.
pub const BAND: [Column<SlopeBand>; 7] = [
    YAW.band("Yaw, positive uphill; an end is missing where no heading holds it", |it| it.yaw),
    SLIP_RATIO.band("Slip ratio", |it| it.slip_ratio),
    SINKAGE.band("Mean sinkage of the wheels", |it| it.sinkage),
    ENERGY_PER_METRE
        .band("Work of the wheels per metre along the course", |it| it.energy_per_metre),
    PROBABILITY_LEVEL.probability(
        "Probability that a heading holds the course: the share of the samples that have one",
        |it| Some(it.level),
    ),
    whole(DRAWS_LEVEL, "Samples with a heading that holds the course", |it| {
        Some(it.level.successes)
    }),
    whole(DRAWS, "Samples for which it is known whether one does", |it| Some(it.level.trials)),
];

/// How many samples have a heading that holds the contour.
pub(super) const DRAWS_LEVEL: &str = "draws_level";
pub use super::DRAWS;
/// How many samples let the rover move on level ground.
pub const DRAWS_MOBILE: &str = "draws_mobile";

/// Quantiles of the steepest slope over samples.
pub const BAND_LIMIT: [Column<HeadingBand>; 3] = [
    LIMIT_SLOPE
        .band("The steepest slope; 0 in a sample in which the rover cannot move", |it| it.limit),
    whole(DRAWS_MOBILE, "Samples on which the rover can move on level ground", |it| {
        Some(it.mobile.successes)
    }),
    whole(DRAWS, "Samples for which it is known whether it can", |it| Some(it.mobile.trials)),
];

/// The heading of a model on the soil as written [rad]; `None` where none holds the course.
pub type ModelYaw = (Model, Option<f64>);

/// A table with a row for each slope, the advice for it, the columns of [`BAND`], and the headings
/// of the models on the soil as written.
///
/// * `table`: of the soil as written, whose yaw is [`YAW_AS_WRITTEN`] here
/// * `of_models`: on each slope, the soil's own model among them
#[must_use]
pub fn advised(
    table: Table,
    advice: &[Advice],
    bands: &[SlopeBand],
    of_models: &[Vec<ModelYaw>],
) -> Table {
    let mut written = table.columns.into_iter().map(|(name, values)| {
        let is_yaw = name == YAW.name;
        (if is_yaw { YAW_AS_WRITTEN.name.to_owned() } else { name }, values)
    });
    let all: Vec<Option<&Advice>> = advice.iter().map(Some).collect();
    let mut table = Table { columns: written.next().into_iter().collect() }.and(&ADVICE, &all);
    table.columns.extend(written);
    let bands: Vec<_> = bands.iter().map(Some).collect();
    let models: Vec<_> = of_models.iter().map(Some).collect();
    // Bands of the yaw are among the advice.
    let of_band = BAND.iter().filter(|column| column.name != YAW.name);
    table.and(of_band, &bands).and(&OF_MODELS, &models)
}

/// The headings of the models on the soil as written.
const OF_MODELS: [Column<Vec<ModelYaw>>; ACROSS] = {
    const DOC: &str = "Heading of this model on the soil as written";
    [
        YAWS_OF_MODELS[0].1.maybe(DOC, |it| yaw_of(it, 0)),
        YAWS_OF_MODELS[1].1.maybe(DOC, |it| yaw_of(it, 1)),
        YAWS_OF_MODELS[2].1.maybe(DOC, |it| yaw_of(it, 2)),
    ]
};

fn yaw_of(all: &[ModelYaw], place: usize) -> Option<f64> {
    all.iter().find(|(model, _)| *model == YAWS_OF_MODELS[place].0)?.1
}

/// The columns of [`advised`] for reading.
#[must_use]
pub fn advised_brief() -> Vec<String> {
    let [low, _, high] = YAW.quantiles();
    let [_, _, slip] = SLIP_RATIO.quantiles();
    let advice = [SLOPE.name, VERDICT, REASON, PROBABILITY_STUCK.name, YAW.name, &low, &high];
    let models = YAWS_OF_MODELS.iter().map(|(_, quantity)| quantity.name);
    let rest = [PROBABILITY_LEVEL.name, &slip].into_iter().chain(models).chain([FLAGS]);
    advice.into_iter().chain(rest).map(String::from).collect()
}

/// A table with a row for each slope, and the columns of [`BAND`] added.
#[must_use]
pub fn with_bands(table: Table, bands: &[SlopeBand]) -> Table {
    table.and(&BAND, &bands.iter().map(Some).collect::<Vec<_>>())
}

/// The columns of [`BAND`] over the slope.
#[must_use]
pub fn bands(bands: &[SlopeBand]) -> Table {
    const PLACE: [Column<SlopeBand>; 1] = [SLOPE.number("Slopes", |it| it.slope)];
    with_bands(Table::of(&PLACE, bands), bands)
}

/// A map's table with the columns of [`BAND`] and those of [`BAND_LIMIT`] added.
///
/// * `bands`: of each row of the map
#[must_use]
pub fn map_with_bands(table: Table, bands: &[HeadingBand]) -> Table {
    let slopes: Vec<_> = bands.iter().flat_map(|band| band.slopes.iter().map(Some)).collect();
    let limits = bands.iter().flat_map(|band| band.slopes.iter().map(move |_| Some(band)));
    // How many samples there are stands in the row already.
    let of_limit = BAND_LIMIT.iter().filter(|column| column.name != DRAWS);
    table.and(&BAND, &slopes).and(of_limit, &limits.collect::<Vec<_>>())
}

/// The columns of [`map_with_bands`] for reading.
#[must_use]
pub fn map_bands_brief() -> Vec<String> {
    let place = [SOIL, COURSE.name].map(String::from);
    place.into_iter().chain(bands_brief()).collect()
}

/// Quantiles of the steepest slope over samples: one row.
#[must_use]
pub fn band_limit(band: &HeadingBand) -> Table {
    Table::of(&BAND_LIMIT, std::slice::from_ref(band))
}

/// The columns of [`with_bands`] for reading.
#[must_use]
pub fn bands_brief() -> Vec<String> {
    let [yaw_low, _, yaw_high] = YAW.quantiles();
    let [slip_low, _, slip_high] = SLIP_RATIO.quantiles();
    let name = |it: &str| it.to_owned();
    vec![
        name(SLOPE.name),
        name(YAW.name),
        yaw_low,
        yaw_high,
        name(SLIP_RATIO.name),
        slip_low,
        slip_high,
        name(PROBABILITY_LEVEL.name),
        name(DRAWS_LEVEL),
        name(STATUS),
        name(FLAGS),
    ]
}
