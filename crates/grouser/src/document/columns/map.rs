//! The bands of a mobility map.

use super::{COURSE, Column, DRIFT, POWER, Quantity, SINKAGE, SLIP_RATIO, SLOPE, quantity, whole};
use crate::document::unit::{DEG, ONE};
use crate::studies::mobility::CellMotion;
use crate::studies::verdict::{Advice, Verdict};

/// Where the nose points.
pub const HEADING: Quantity = quantity("heading_deg", DEG);
/// Share of the samples in which a place is a no-go.
pub const PROBABILITY_NO_GO: Quantity = quantity("probability_no_go", ONE);
pub use super::verdict::VERDICT;

/// What a map of one course has for each place; verdicts are [numbers](verdict_number).
#[must_use]
pub const fn bands() -> [Column<CellMotion>; 8] {
    [
        SLOPE.number("Slope of the ground over the rover's length", |it| it.slope),
        HEADING.maybe(
            "Yaw of the body that holds the course, on the map from east to the \
                       left",
            |it| it.heading,
        ),
        SLIP_RATIO.maybe("Slip ratio of every wheel", |it| it.motion.map(|it| it.slip_ratio)),
        DRIFT.maybe("Way downhill for a metre of way, with the nose along the course", |it| {
            it.motion.map(|it| it.drift)
        }),
        POWER.maybe("Power of the wheels", |it| it.motion.map(|it| it.power)),
        SINKAGE.maybe("Mean sinkage of the wheels", |it| it.motion.map(|it| it.sinkage)),
        whole(VERDICT, "Whether to drive there: 1 go, 2 caution, 3 no-go, 4 cannot tell", |it| {
            Some(verdict_number(it.verdict).into())
        }),
        PROBABILITY_NO_GO.number(
            "Share of the samples in which no heading holds the course, or it slips more than the \
             no-go limit",
            |it| it.probability_no_go,
        ),
    ]
}

/// A class of slopes of a map: those down to the one before.
pub const CLASS: [Column<Advice>; 2] = [
    SLOPE.given("The steepest slope of the class", |it| Some(it.slope)),
    COURSE.given("The course there: from the contour, positive uphill", |it| Some(it.course)),
];

/// What a map has as well where the course is chosen place by place.
#[must_use]
pub const fn chosen() -> [Column<CellMotion>; 1] {
    [COURSE
        .number("The course: from the contour with the hill on the left, positive uphill", |it| {
            it.course
        })]
}

/// The number of a verdict on a map: 1 go, 2 caution, 3 no-go, 4 cannot tell. Where no height is
/// known it is 0.
#[must_use]
pub const fn verdict_number(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Go => 1,
        Verdict::Caution => 2,
        Verdict::NoGo => 3,
        Verdict::CannotTell => 4,
    }
}
