//! Advice after a drive: what to do on each slope, and which test drives would tell most of them.

use super::super::table::Table;
use super::super::unit::{DEG, M_S, ONE, S};
use super::card::{DRIFT, SLIP_CHECK_EVERY, SLIP_LIMIT};
use super::learn::{INFORMATION, WAY};
use super::verdict::{PROBABILITY_STUCK, PROBABILITY_STUCK_WITHOUT_CHECKS};
use super::{Column, ENERGY, POWER, Quantity, SLIP_RATIO, SLOPE, YAW, quantity, text};
use crate::studies::learn::advice::{AdvisedHeading, DriveAdvice, SlopeAdvice, TestDrive};

/// The heading that holds the contour.
pub const CONTOUR_YAW: Quantity = quantity("contour_yaw_deg", DEG);
/// The steepest heading that keeps the limit of slip.
pub const STEEPEST_YAW: Quantity = quantity("steepest_yaw_deg", DEG);
/// The probability that the slip keeps its limit.
pub const PROBABILITY_WITHIN: Quantity = quantity("probability_within_limit", ONE);
/// The rim speed to set.
pub const RIM_SPEED: Quantity = quantity("rim_speed_m_s", M_S);
/// The probability that a look at the slip ends a drive for nothing.
pub const PROBABILITY_FALSE_STOP: Quantity = quantity("probability_false_stop", ONE);
/// The probability of getting stuck by the practice of Opportunity's drivers.
pub const PROBABILITY_STUCK_PRACTICE: Quantity = quantity("probability_stuck_in_practice", ONE);
/// Time between two looks at the slip.
pub const BLIND_TIME: Quantity = quantity("blind_s", S);
/// Width of the 95 % band of the heading.
pub const HEADING_WIDTH: Quantity = quantity("heading_width_deg", DEG);
/// The same before.
pub const HEADING_WIDTH_BEFORE: Quantity = quantity("heading_width_before_deg", DEG);
/// Width of the 95 % band of the slip.
pub const SLIP_WIDTH: Quantity = quantity("slip_width", ONE);
/// The same before.
pub const SLIP_WIDTH_BEFORE: Quantity = quantity("slip_width_before", ONE);
/// Information for work.
pub const PER_JOULE: Quantity = quantity("information_nat_per_joule", ONE);
/// Information for way.
pub const PER_METRE: Quantity = quantity("information_nat_per_metre", ONE);
/// What a test drive narrows most.
pub const NARROWS: &str = "narrows";
/// What to do, in words.
pub const SENTENCE: &str = "advice";

fn heading(advice: &SlopeAdvice) -> Option<&AdvisedHeading> {
    advice.heading.advised.as_ref()
}

/// The columns of [`slopes`].
pub const SLOPE_COLUMNS: [Column<SlopeAdvice>; 20] = [
    SLOPE.given("Slope", |it| Some(it.heading.slope)),
    YAW.maybe(
        "Heading to set, positive uphill: that which holds the contour, or the steepest that keeps \
         the limit of slip where that is less; missing where there is none",
        |it| heading(it).map(|it| it.yaw),
    ),
    CONTOUR_YAW.maybe(
        "Heading that holds the contour: the median; missing where none does in half of the \
         samples",
        |it| it.heading.contour.map(|it| it.median),
    ),
    CONTOUR_YAW.band("The same over the samples that hold the contour", |it| it.heading.contour),
    STEEPEST_YAW.maybe(
        "Steepest heading, 0° to 90°, at which the slip keeps its limit in as many samples as it \
         must; missing where it does not with the nose on the contour",
        |it| it.heading.steepest,
    ),
    PROBABILITY_WITHIN
        .probability("Probability that the slip keeps its limit at the heading to set", |it| {
            heading(it).map(|it| it.within)
        }),
    SLIP_RATIO.maybe("Slip ratio at that heading: the median; 1 where the rover is stuck", |it| {
        heading(it).map(|it| it.slip_ratio.median)
    }),
    SLIP_RATIO.band("The same over all samples", |it| heading(it).map(|it| it.slip_ratio)),
    DRIFT.band("Drift at that heading, way downhill for a metre travelled", |it| {
        heading(it).map(|it| it.drift)
    }),
    RIM_SPEED.maybe("Rim speed to set", |it| it.rim_speed),
    POWER
        .band("Power of the motors then, over the samples in which the rover is not stuck", |it| {
            heading(it)?.power(it.rim_speed?)
        }),
    SLIP_CHECK_EVERY.maybe(
        "Way of the rims after which to look at the slip; missing where no interval is known to be \
         safe enough",
        |it| it.check?.check.map(|it| it.every),
    ),
    SLIP_LIMIT.maybe("Slip ratio over that way above which to go no further", |it| {
        it.check?.check.map(|it| it.limit)
    }),
    BLIND_TIME.maybe("Time between two looks", |it| Some(it.check?.check?.every / it.rim_speed?)),
    PROBABILITY_STUCK.probability(
        "Probability of getting stuck over 10 m of the rims' way with these looks; where no \
         interval is safe enough with the shortest",
        |it| it.check.map(|it| it.check.unwrap_or(it.closest).stuck),
    ),
    PROBABILITY_FALSE_STOP.probability(
        "Probability that a look ends a way on which the rover would not have got stuck",
        |it| it.check.and_then(|it| it.check.unwrap_or(it.closest).false_stops),
    ),
    PROBABILITY_STUCK_WITHOUT_CHECKS
        .probability("Probability of getting stuck over 10 m without a look", |it| {
            it.check.map(|it| it.unchecked)
        }),
    PROBABILITY_STUCK_PRACTICE.probability(
        "Probability of getting stuck with a look every 5 m against a limit of 40 %, as \
         Opportunity's drivers had it",
        |it| it.check.map(|it| it.practice.stuck),
    ),
    super::maybe(
        "probability_false_stop_in_practice",
        ONE,
        "Probability that such a look ends a way on which the rover would not have got stuck",
        |it| it.check?.practice.false_stops.map(|it| it.estimate()),
    ),
    text(SENTENCE, "What to do, in words", |it| Some(sentence(it))),
];

/// A row for each slope.
#[must_use]
pub fn slopes(advice: &DriveAdvice) -> Table {
    Table::of(&SLOPE_COLUMNS, &advice.slopes)
}

/// The columns of [`slopes`] for reading.
#[must_use]
pub fn slopes_brief() -> Vec<String> {
    [
        SLOPE,
        YAW,
        STEEPEST_YAW,
        PROBABILITY_WITHIN,
        RIM_SPEED,
        SLIP_CHECK_EVERY,
        SLIP_LIMIT,
        PROBABILITY_STUCK,
        PROBABILITY_FALSE_STOP,
    ]
    .map(|it| it.name.to_owned())
    .into()
}

/// What to do on a slope, in words.
#[must_use]
pub fn sentence(advice: &SlopeAdvice) -> String {
    let degrees = |angle: f64| format!("{:.1}°", SLOPE.unit.from_si(angle));
    let slope = degrees(advice.heading.slope);
    let Some(set) = heading(advice) else {
        return match (&advice.heading.contour, advice.heading.steepest) {
            (None, _) => {
                format!("{slope}: no such heading: none holds the contour in half of the samples")
            }
            _ => format!("{slope}: no such heading: none keeps the slip within its limit"),
        };
    };
    let lower = advice.heading.contour.is_some_and(|it| set.yaw < it.median);
    let heading = match (lower, &advice.heading.contour) {
        (true, Some(contour)) => format!(
            "{slope}: set the heading to {}, not to the {} that hold the contour: the slip would \
             not keep its limit",
            degrees(set.yaw),
            degrees(contour.median)
        ),
        _ => format!("{slope}: set the heading to {}", degrees(set.yaw)),
    };
    format!("{heading}; {}", look(advice))
}

/// How often to look at the slip, in words.
fn look(advice: &SlopeAdvice) -> String {
    let Some(checks) = advice.check else { return "no look at the slip is advised".to_owned() };
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    match checks.check {
        Some(check) => format!(
            "look at the slip every {} m, and go no further above {:.2}",
            check.every, check.limit
        ),
        None if checks.closest.stuck.successes == 0 => format!(
            "no look at the slip is known to be safe enough: none of {} ways has a stuck rover, \
             which shows a probability of less than {} and no more",
            checks.closest.stuck.trials,
            percent(checks.closest.stuck.interval().1)
        ),
        None => format!(
            "no look at the slip is known to be safe enough: every {} m the rover gets stuck on {} \
             of the ways",
            checks.closest.every,
            percent(checks.closest.stuck.estimate())
        ),
    }
}

/// The columns of [`test_drives`].
pub const TEST_COLUMNS: [Column<TestDrive>; 14] = [
    SLOPE.given("Slope of the leg", |it| Some(it.leg.slope)),
    YAW.given("Yaw from the contour, positive uphill", |it| Some(it.leg.yaw)),
    WAY.given("Way of the rims", |it| Some(it.leg.way)),
    SLIP_RATIO.number("Mean slip ratio of the wheels that is expected", |it| it.slip_ratio),
    PROBABILITY_WITHIN
        .probability("Probability that the slip keeps its limit", |it| Some(it.within)),
    ENERGY.number(
        "Work of the wheels that pull, and that by which height is won back that is lost on the \
         leg",
        |it| it.energy,
    ),
    HEADING_WIDTH_BEFORE.number(
        "Width of the 95 % band of tomorrow's heading on the slope where it is least certain, \
         before the leg",
        |it| it.widths[0],
    ),
    HEADING_WIDTH.number("The same after it, as it is to be expected", |it| it.widths[1]),
    SLIP_WIDTH_BEFORE
        .number("Width of the 95 % band of the slip there before the leg", |it| it.slip_widths[0]),
    SLIP_WIDTH.number("The same after it, as it is to be expected", |it| it.slip_widths[1]),
    INFORMATION
        .number("What the leg tells of the headings and slips of the slopes", |it| it.information),
    PER_JOULE.number("The same for its work", |it| it.information / it.energy),
    PER_METRE.number("The same for its way", |it| it.information / it.leg.way),
    text(NARROWS, "What it narrows most of the soil, with what is left of its uncertainty", |it| {
        Some(narrows(it))
    }),
];

/// A row for each leg.
#[must_use]
pub fn test_drives(drives: &[TestDrive]) -> Table {
    Table::of(&TEST_COLUMNS, drives)
}

/// The numbers of [`test_drives`] for reading.
#[must_use]
pub fn legs_brief() -> Vec<String> {
    let before = HEADING_WIDTH_BEFORE;
    [SLOPE, YAW, WAY, ENERGY, before, HEADING_WIDTH, INFORMATION, PER_JOULE]
        .map(|it| it.name.to_owned())
        .into()
}

/// The same with what legs narrow most.
#[must_use]
pub fn tests_brief() -> Vec<String> {
    legs_brief().into_iter().chain([NARROWS.to_owned()]).collect()
}

/// The soil's numbers that a leg narrows most, two at most.
fn narrows(drive: &TestDrive) -> String {
    const MOST: usize = 2;
    const LEFT: f64 = 0.95;
    let mut left: Vec<_> = drive.left.iter().filter(|it| it.1 < LEFT).collect();
    left.sort_by(|one, other| one.1.total_cmp(&other.1));
    let words = left.iter().take(MOST).map(|(key, left)| format!("{key} to {:.0} %", 100.0 * left));
    words.collect::<Vec<_>>().join(", ")
}
