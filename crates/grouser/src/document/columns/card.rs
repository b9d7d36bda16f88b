//! The operator's card: of each slope the advice, the soil as written, and the bands over samples of
//! it.

use super::super::table::{Table, Values};
use super::super::unit::{DEG, DEG_PER_M, M, M_PER_M, ONE};
use super::flags::{self, FLAGS};
use super::gradient;
use super::heading::{DRAWS, DRAWS_LEVEL};
use super::verdict::ADVICE;
pub use super::verdict::{
    PROBABILITY_STUCK, PROBABILITY_STUCK_WITHOUT_CHECKS, REASON, VERDICT, YAW_AS_WRITTEN,
    YAWS_OF_MODELS,
};
use super::{
    CURRENT, Column, LIMIT_SLOPE, OK, PITCH, POWER, PROBABILITY_LEVEL, Quantity, ROLL, SINKAGE,
    SLIP_RATIO, SLOPE, STATUS, TORQUE, YAW, quantity, text, whole,
};
use crate::document::LoadedScenario;
use crate::document::gradient::{GradientKeys, HeadingKeys};
use crate::studies::card::{Card, CardRow};
use crate::studies::verdict::{Advice, Driven, DrivenMotion, Side, SlopeStudy};

/// Drift at yaw 0.
pub const DRIFT: Quantity = quantity("downhill_m_per_m", M_PER_M);
/// Pitch with the nose too low by what a driver sets it to, and too high.
pub const PITCH_ENDS: [Quantity; 2] =
    [quantity("pitch_least_deg", DEG), quantity("pitch_most_deg", DEG)];
/// Way after which the nose is to be set again.
pub const CORRECT_EVERY: Quantity = quantity("correct_every_m", M);
/// By how much the nose falls over the way.
pub const HEADING_FALL: Quantity = quantity("heading_fall_deg_per_m", DEG_PER_M);
/// Drift by the card's heading.
pub use super::DRIFT as DRIVEN_DRIFT;
/// Slip by the card's heading.
pub const DRIVEN_SLIP: Quantity = quantity("driven_slip_ratio", ONE);
/// Way of the rims for a metre of ground.
pub const RIM_WAY: Quantity = quantity("rim_way_m_per_m", M_PER_M);
/// How much steeper the slope could be before the rover tips over.
pub const TIPPING_MARGIN: Quantity = quantity("tipping_margin_deg", DEG);
/// The slip above which to turn back where the slip is looked at.
pub const SLIP_LIMIT: Quantity = quantity("slip_limit", ONE);
/// Way between two looks at the slip.
pub const SLIP_CHECK_EVERY: Quantity = quantity("slip_check_every_m", M);
struct OnCard<'a> {
    row: &'a CardRow,
    card: &'a Card,
}

impl OnCard<'_> {
    fn driven(&self) -> Option<&Driven> {
        self.row.advice.driven.as_ref()
    }

    fn motion(&self) -> Option<&DrivenMotion> {
        self.driven()?.motion.as_ref()
    }

    /// The heading of a model on the soil as written, which is that of the row for the card's own
    /// model.
    fn yaw_of(&self, place: usize) -> Option<f64> {
        let (model, _) = &YAWS_OF_MODELS[place];
        match self.row.other_models.iter().find(|(it, _)| it == model) {
            Some((_, yaw)) => *yaw,
            None => self.row.level.map(|level| level.yaw),
        }
    }
}

/// What the driver sets, reads and may not exceed.
const fn driven<'a>() -> [Column<OnCard<'a>>; 20] {
    const MODEL: &str = "Heading of this model on the soil as written";
    [
        ROLL.maybe("Roll that instruments show then, positive with the uphill side higher", |it| {
            it.driven().map(|it| it.roll)
        }),
        PITCH.maybe("Pitch that they show, positive with the nose higher", |it| {
            it.driven().map(|it| it.pitch)
        }),
        PITCH_ENDS[0].maybe("The same with the nose 2° too low", |it| {
            it.driven().map(|it| it.pitch_range[0])
        }),
        PITCH_ENDS[1].maybe("The same with the nose 2° too high", |it| {
            it.driven().map(|it| it.pitch_range[1])
        }),
        CORRECT_EVERY.maybe(
            "Way after which the heading is to be set again; missing where the rover holds it by \
             itself, and on slopes that are a no-go without driving, as all that is driven",
            |it| it.motion()?.correct_every,
        ),
        HEADING_FALL.band(
            "By how much the nose falls over the way, over the samples that move; missing \
                 where the rover holds it",
            |it| it.motion()?.heading_fall,
        ),
        DRIVEN_DRIFT.band(
            "Drift per metre travelled over 10 m when driven so by a driver who sets the heading \
             to 2°, positive downhill; 1 where the rover is stuck",
            |it| it.motion()?.drift,
        ),
        DRIVEN_SLIP
            .band("Mean slip ratio of the wheels when driven so; 1 where it is stuck", |it| {
                it.motion()?.slip_ratio
            }),
        SINKAGE.band("Mean sinkage of the wheels, over the samples that move", |it| {
            it.motion()?.sinkage
        }),
        TORQUE.band("Largest torque of a wheel, likewise", |it| it.motion()?.torque),
        CURRENT.band(
            "Largest current of a motor, driving or braking, likewise; of a rover whose motors are \
             known",
            |it| it.motion()?.current,
        ),
        RIM_WAY.band("Way of the rims for a metre of ground, likewise", |it| it.motion()?.rim_way),
        PROBABILITY_STUCK_WITHOUT_CHECKS
            .probability("Share of the samples that are stuck when driven so", |it| {
                it.motion().map(|it| it.stuck)
            }),
        SLIP_LIMIT.maybe("Slip above which to turn back at a look", |it| {
            it.motion().map(|it| it.slip_check.limit)
        }),
        SLIP_CHECK_EVERY.maybe(
            "Way between two looks at the slip; missing where the shortest that is tried is too \
             long",
            |it| it.motion()?.slip_check.every,
        ),
        TIPPING_MARGIN.maybe(
            "How much steeper the slope could be before the rover at rest tips over",
            |it| it.driven().map(|it| it.tipping_margin),
        ),
        YAW_AS_WRITTEN.maybe("Heading that holds the contour on the soil as written", |it| {
            it.row.level.map(|level| level.yaw)
        }),
        YAWS_OF_MODELS[0].1.maybe(MODEL, |it| it.yaw_of(0)),
        YAWS_OF_MODELS[1].1.maybe(MODEL, |it| it.yaw_of(1)),
        YAWS_OF_MODELS[2].1.maybe(MODEL, |it| it.yaw_of(2)),
    ]
}

/// How sure that is, and contour traverses by each sample's own heading.
const fn held<'a>() -> [Column<OnCard<'a>>; 12] {
    [
        SLIP_RATIO
            .maybe("Slip ratio of every wheel on the soil as written, by its heading", |it| {
                it.row.level.map(|level| level.slip_ratio)
            }),
        SLIP_RATIO.band(
            "The same over the samples, by the heading of each; 1 where no heading holds the \
             contour",
            |it| it.row.bands.as_ref()?.slip_ratio,
        ),
        POWER.maybe("Mechanical power of the motors on the soil as written, likewise", |it| {
            it.row.level.map(|level| level.power)
        }),
        POWER.band("The same over the samples", |it| it.row.bands.as_ref()?.power),
        DRIFT.maybe("Drift per metre travelled at yaw 0, positive downhill", |it| it.row.drift),
        DRIFT.band("The same over the samples", |it| it.row.bands.as_ref()?.drift),
        PROBABILITY_LEVEL
            .probability("Share of the samples with a heading that holds the contour", |it| {
                it.row.bands.as_ref().map(|_| it.row.advice.level)
            }),
        whole(
            DRAWS_LEVEL,
            "Samples with a heading that holds the contour: power is over them",
            |it| it.row.bands.as_ref().map(|_| it.row.advice.level.successes),
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

const SLOPES: [Column<Advice>; 1] = [SLOPE.given("Slope", |it| Some(it.slope))];

/// Why no heading holds the contour on the soil as written.
fn status(it: &OnCard<'_>) -> String {
    it.row.refusal.clone().unwrap_or_else(|| OK.to_owned())
}

/// A row for each slope: what the driver sets and reads, then contour traverses, each with the
/// heading of its own soil. Bands are over the samples, and missing where there are none; where the
/// motion by the card's heading has a band all the same, its ends are the soil as written.
#[must_use]
pub fn table(card: &Card) -> Table {
    let rows: Vec<OnCard<'_>> = card.rows.iter().map(|row| OnCard { row, card }).collect();
    let all: Vec<Option<&OnCard<'_>>> = rows.iter().map(Some).collect();
    let advice: Vec<Option<&Advice>> = card.rows.iter().map(|row| Some(&row.advice)).collect();
    let driven = driven();
    let driven = driven.iter().filter(|it| card.has_motors || it.name != CURRENT.name);
    let table = Table::default().and(&SLOPES, &advice).and(&ADVICE, &advice);
    table.and(driven, &all).and(&held(), &all)
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    let before = [SLOPE.name, VERDICT, REASON, PROBABILITY_STUCK.name, YAW.name].map(String::from);
    before.into_iter().chain(brief_of_driven()).chain([FLAGS.to_owned()]).collect()
}

/// The same, with the bands over samples.
#[must_use]
pub fn bands_brief() -> Vec<String> {
    let [low, _, high] = YAW.quantiles();
    let advice = [SLOPE.name, VERDICT, REASON, PROBABILITY_STUCK.name, YAW.name, &low, &high];
    let before = advice.map(String::from);
    let after = [PROBABILITY_LEVEL.name, FLAGS].map(String::from);
    before.into_iter().chain(brief_of_driven()).chain(after).collect()
}

/// What instruments show, and the readings at which to stop.
fn brief_of_driven() -> impl Iterator<Item = String> {
    let [.., drift] = DRIVEN_DRIFT.quantiles();
    let names = [ROLL, PITCH, CORRECT_EVERY, SLIP_LIMIT].map(|it| it.name.to_owned());
    names.into_iter().chain([drift])
}

/// The numbers that the card says what they are worth: the ground's strength, and the rover's mass.
pub const WORTH: [&str; 3] = ["soil.friction_angle_deg", "soil.cohesion_kpa", "rover.body.mass_kg"];

/// How many samples the card has, and the steepest slope: one row. It has what [`WORTH`] numbers
/// are worth, too: derivatives of the steepest slope on the soil as written, by its own model.
///
/// * `study`, `uphill`: what the card is of
#[must_use]
pub fn steepest(card: &Card, scenario: &LoadedScenario, study: &SlopeStudy, uphill: Side) -> Table {
    const LIMIT: [Column<Card>; 3] = [
        whole(DRAWS, "All samples", |it| it.draws),
        LIMIT_SLOPE.maybe("The steepest slope on which a heading holds the contour", |it| {
            it.limit.as_ref().ok().map(|(limit, _)| *limit)
        }),
        LIMIT_SLOPE.band("The same over the samples", |it| it.limit_band),
    ];
    let table = Table::of(&LIMIT, std::slice::from_ref(card));
    let asked = GradientKeys::These(WORTH.map(str::to_owned).into());
    let keys = HeadingKeys::of(scenario, study.heading.steering, &asked);
    match (keys, study.heading.curve()) {
        (Ok(keys), Ok(curve)) => {
            let keys = keys.with_uphill(uphill);
            gradient::of_limit(table, &keys, &keys.of_limit(&curve))
        }
        _ => table,
    }
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

/// Measured yaws, each beside the card's numbers on its slope, and whether it lies `below`,
/// `inside` or `above` the band over samples.
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
        let is_below = point.yaw < ends.0[*row]?;
        // An upper end that no number reaches is missing.
        let is_above = ends.1[*row].is_some_and(|high| point.yaw > high);
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
