//! Two cards beside each other: of the soil as it was known yesterday, and as it is known today.

use super::super::table::Table;
use super::super::unit::ONE;
use super::card::SLIP_LIMIT;
use super::learn::BEFORE_YAW;
use super::verdict::VERDICT;
use super::{Column, Quantity, SLIP_RATIO, SLOPE, YAW, quantity, text};
use crate::studies::card::{Card, CardRow};

/// Slip by yesterday's card.
pub const BEFORE_SLIP: Quantity = quantity("before_slip_ratio", ONE);
/// The slip above which yesterday's card turns back.
pub const BEFORE_SLIP_LIMIT: Quantity = quantity("before_slip_limit", ONE);
/// Yesterday's verdict.
pub const BEFORE_VERDICT: &str = "before_verdict";

/// A slope of both cards.
struct Days<'a> {
    before: &'a CardRow,
    after: &'a CardRow,
}

/// The heading that a card sets [rad].
fn yaw(row: &CardRow) -> Option<f64> {
    row.advice.heading()
}

/// Its verdict.
fn verdict(row: &CardRow) -> String {
    row.advice.judgement.verdict.name().to_owned()
}

/// The slip at which it turns back [-].
fn slip_limit(row: &CardRow) -> Option<f64> {
    Some(row.advice.driven?.motion?.slip_check.limit)
}

const fn columns<'a>() -> [Column<Days<'a>>; 11] {
    [
        SLOPE.given("Slope", |it| Some(it.after.advice.slope)),
        text(VERDICT, "Today's verdict", |it| Some(verdict(it.after))),
        text(BEFORE_VERDICT, "Yesterday's verdict", |it| Some(verdict(it.before))),
        YAW.maybe("Heading that today's card sets", |it| yaw(it.after)),
        YAW.band("Headings that hold the contour, over today's samples", |it| it.after.advice.yaw),
        BEFORE_YAW.maybe("Heading that yesterday's card set", |it| yaw(it.before)),
        BEFORE_YAW.band("Headings that hold the contour, over yesterday's samples", |it| {
            it.before.advice.yaw
        }),
        SLIP_RATIO
            .band("Slip ratio over today's samples", |it| it.after.bands.as_ref()?.slip_ratio),
        BEFORE_SLIP
            .band("Slip ratio over yesterday's samples", |it| it.before.bands.as_ref()?.slip_ratio),
        SLIP_LIMIT.maybe("Slip above which today's card turns back", |it| slip_limit(it.after)),
        BEFORE_SLIP_LIMIT
            .maybe("Slip above which yesterday's card turned back", |it| slip_limit(it.before)),
    ]
}

/// A row for each slope that both cards have.
#[must_use]
pub fn table(before: &Card, after: &Card) -> Table {
    let pairs = before.rows.iter().zip(&after.rows);
    let rows: Vec<_> = pairs.map(|(before, after)| Days { before, after }).collect();
    Table::of(&columns(), &rows)
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    let ends = |quantity: Quantity| {
        let [low, _, high] = quantity.quantiles();
        [low, high]
    };
    let name = |quantity: Quantity| quantity.name.to_owned();
    let [yaw, before_yaw] = [ends(YAW), ends(BEFORE_YAW)];
    let first = vec![name(SLOPE), VERDICT.to_owned(), BEFORE_VERDICT.to_owned(), name(YAW)];
    let last = vec![name(SLIP_LIMIT), name(BEFORE_SLIP_LIMIT)];
    [first, yaw.into(), vec![name(BEFORE_YAW)], before_yaw.into(), last].concat()
}
