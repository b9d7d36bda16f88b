//! Advice on a slope: whether to drive there and why, the heading to set, and how often a rover
//! gets stuck by it.

use super::super::reading::four_digits;
use super::super::table::Table;
use super::super::unit::{DEG, ONE};
use super::{Column, Quantity, YAW, quantity, text};
use crate::contact::Model;
use crate::studies::ensemble::models::ACROSS;
use crate::studies::verdict::{Advice, Verdict};

/// The verdict on a slope.
pub const VERDICT: &str = "verdict";
/// What decides it.
pub const REASON: &str = "reason";
/// The share of ways on which a rover gets stuck although its slip is looked at.
pub const PROBABILITY_STUCK: Quantity = quantity("probability_stuck", ONE);
/// The share of the samples that are stuck, whoever looks.
pub const PROBABILITY_STUCK_WITHOUT_CHECKS: Quantity =
    quantity("probability_stuck_without_checks", ONE);
/// The heading on the soil as written.
pub const YAW_AS_WRITTEN: Quantity = quantity("yaw_deg_as_written", DEG);
/// The headings of the models that know forces across a wheel, on the soil as written.
pub const YAWS_OF_MODELS: [(Model, Quantity); ACROSS] = [
    (Model::Ishigami, quantity("yaw_deg_ishigami", DEG)),
    (Model::SmallWheel, quantity("yaw_deg_small_wheel", DEG)),
    (Model::Rft, quantity("yaw_deg_rft", DEG)),
];
/// The object of JSON that has these columns.
pub const ADVICE_OBJECT: &str = "advice";

/// Advice.
pub const ADVICE: [Column<Advice>; 5] = [
    text(VERDICT, "Whether to drive there: `go`, `caution`, `cannot_tell` or `no_go`", |it| {
        Some(it.judgement.verdict.name().to_owned())
    }),
    text(REASON, "What decides the verdict, in a word", |it| {
        Some(it.judgement.reason.name().to_owned())
    }),
    PROBABILITY_STUCK.maybe(
        "Share of ways of 10 m on which a rover that is driven by this heading gets stuck, although \
         its slip is looked at as often as the card says; missing where it is not driven. Of a turn \
         on the spot the share of the samples that get stuck in it",
        Advice::probability_stuck,
    ),
    YAW.maybe(
        "Heading that is set, positive uphill: the median over all samples; missing where no \
         heading holds the course in half of them, and of a turn on the spot",
        Advice::heading,
    ),
    YAW.band(
        "Headings that hold the course, over all samples; an end is missing where none does",
        |it| it.yaw,
    ),
];

/// Slope and course that it is about, or a turn on the spot: `slope 5°, course 90°`.
#[must_use]
pub fn subject(advice: &Advice) -> String {
    let deg = |angle: f64| four_digits(DEG.from_si(angle));
    let course = match advice.stuck_in_turn {
        Some(_) => "turn on the spot".to_owned(),
        None => format!("course {}°", deg(advice.course)),
    };
    format!("slope {}°, {course}", deg(advice.slope))
}

/// What to do on each of several slopes along one course: the verdict, the heading to set or why
/// there is no go.
#[must_use]
pub fn in_words(all: &[Advice]) -> String {
    let deg = |angle: f64| four_digits(DEG.as_given(angle));
    let words = all.iter().map(|advice| {
        let verdict = advice.judgement.verdict;
        let yaw = advice.heading().filter(|_| verdict != Verdict::NoGo);
        let nose =
            yaw.map_or_else(String::new, |yaw| format!(", nose at {:.1}°", DEG.from_si(yaw)));
        let why = match verdict {
            Verdict::Go => String::new(),
            _ => format!(" ({})", advice.judgement.meaning()),
        };
        format!("{}° {}{nose}{why}", deg(advice.slope), verdict.in_words())
    });
    words.collect::<Vec<_>>().join("; ")
}

/// A row for each advice.
#[must_use]
pub fn advice(all: &[Advice]) -> Table {
    Table::of(&ADVICE, all)
}
