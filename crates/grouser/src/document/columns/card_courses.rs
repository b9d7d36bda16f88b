//! The second page of the operator's card: the other courses on its slopes.

use super::super::table::Table;
use super::super::unit::M;
use super::card::{DRIVEN_DRIFT, TIPPING_MARGIN};
use super::verdict::{PROBABILITY_STUCK, PROBABILITY_STUCK_WITHOUT_CHECKS, REASON, VERDICT};
use super::{CURRENT, Column, Quantity, SLIP_RATIO, SLOPE, TORQUE, YAW, quantity, text};
use crate::studies::card::courses::{Course, CourseMotion, CourseRow};

/// A way to drive.
pub const COURSE: &str = "course";
/// Way in which the nose turns.
pub const TURN_WAY: Quantity = quantity("turn_way_m", M);
/// Way downhill meanwhile.
pub const TURN_DOWNHILL: Quantity = quantity("turn_downhill_m", M);

/// The keyword of a course.
#[must_use]
pub const fn name_of_course(course: Course) -> &'static str {
    match course {
        Course::Up => "up",
        Course::Down => "down",
        Course::BackDown => "back-down",
        Course::BackUp => "back-up",
        Course::BackAcross => "back-across",
        Course::Turn => "turn",
        Course::TurnOnTheSpot => "turn-on-the-spot",
    }
}

const COURSES: [Column<CourseRow>; 14] = [
    SLOPE.given("Slope", |it| Some(it.slope)),
    text(
        COURSE,
        "`up`, `back-down` (out of a way up), `down`, `back-up` (out of a way down), `back-across` \
         (along the contour backwards, the rear uphill), `turn` (the nose uphill, uphill wheels at \
         half speed) or `turn-on-the-spot`",
        |it| Some(name_of_course(it.course).into()),
    ),
    text(VERDICT, "Whether to drive there: `go`, `caution`, `cannot_tell` or `no_go`", |it| {
        Some(it.judgement.verdict.name().to_owned())
    }),
    text(REASON, "What decides the verdict, in a word", |it| {
        Some(it.judgement.reason.name().to_owned())
    }),
    PROBABILITY_STUCK.maybe(
        "Share of ways of 10 m on which the rover gets stuck between two looks at the slip; \
         straight up and down",
        |it| motion(it)?.stuck_with_checks,
    ),
    YAW.number("Yaw, positive where the nose points uphill", |it| it.yaw),
    SLIP_RATIO.band(
        "Mean slip ratio of the wheels, negative where the rover runs ahead of its rims, either \
         way; 1 where it is stuck; missing on no-go slopes, as all that is driven",
        |it| motion(it)?.slip_ratio,
    ),
    TORQUE.band("Largest torque of a wheel, over the samples that move", |it| motion(it)?.torque),
    CURRENT.band(
        "Largest current of a motor, driving or braking, likewise; of a rover whose motors are \
         known",
        |it| motion(it)?.current,
    ),
    DRIVEN_DRIFT.band("Drift per metre travelled of the way backwards along the contour", |it| {
        motion(it)?.drift
    }),
    TURN_WAY.band("Way in which the nose turns uphill by 10°, over the samples that turn", |it| {
        motion(it)?.turn_way
    }),
    TURN_DOWNHILL.band("Way downhill meanwhile", |it| motion(it)?.turn_downhill),
    PROBABILITY_STUCK_WITHOUT_CHECKS
        .probability("Share of the samples that are stuck, or do not turn uphill", |it| {
            motion(it).map(|it| it.stuck)
        }),
    TIPPING_MARGIN
        .number("How much steeper the slope could be before the rover at rest tips over", |it| {
            it.tipping_margin
        }),
];

fn motion(row: &CourseRow) -> Option<&CourseMotion> {
    row.motion.as_ref()
}

/// A row for each course and slope.
#[must_use]
pub fn table(rows: &[CourseRow]) -> Table {
    let has_current = |it: &CourseRow| motion(it).is_some_and(|it| it.current.is_some());
    let has_motors = rows.iter().any(has_current);
    let columns = COURSES.iter().filter(|it| has_motors || it.name != CURRENT.name);
    Table::default().and(columns, &rows.iter().map(Some).collect::<Vec<_>>())
}
