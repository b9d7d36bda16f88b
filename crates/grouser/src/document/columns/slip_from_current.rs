//! Slip from currents: a row for each reading, and a row for each wheel.

use super::super::table::Table;
use super::super::unit::ONE;
use super::{
    CURRENT, Column, LOAD, Quantity, SLIP_ANGLE, SLIP_RATIO, STATUS, TIME, TORQUE, WHEEL_SPEED,
    quantity, text, whole,
};
use crate::studies::slip_from_current::{
    Agreement, MotorLog, MotorReading, SlipEstimate, SlipStatus,
};
use crate::vehicle::Rover;

/// The wheel of a row.
pub const WHEEL: &str = "wheel";
/// Slip measured by other means.
pub const TRUE_SLIP: Quantity = quantity("true_slip_ratio", ONE);
/// Median less measured slip.
pub const SLIP_ERROR: Quantity = quantity("slip_ratio_error", ONE);
/// Width of the interval.
pub const WIDTH: Quantity = quantity("slip_ratio_width", ONE);
/// What a status means.
const REASON: &str = "reason";

/// A reading and what it says.
#[derive(Clone, Copy, Debug)]
pub struct OfReading<'a> {
    time: f64,
    wheel: &'a str,
    reading: MotorReading,
    estimate: SlipEstimate,
}

impl OfReading<'_> {
    /// The median, and the slip that was measured.
    fn pair(&self) -> Option<(f64, f64)> {
        Some((self.estimate.slip_ratio?.median, self.reading.slip_ratio?))
    }
}

/// What was read, of every log.
#[must_use]
pub const fn of_reading<'a>() -> [Column<OfReading<'a>>; 4] {
    [
        TIME.number("Time of the reading", |it| it.time),
        text(WHEEL, "The wheel", |it| Some(it.wheel.to_owned())),
        CURRENT.number("Current of its motor, negative where it brakes", |it| it.reading.current),
        WHEEL_SPEED.number("Angular speed", |it| it.reading.wheel_speed),
    ]
}

/// What a current says of a wheel's slip.
pub const ESTIMATE: [Column<SlipEstimate>; 7] = [
    TORQUE.maybe("Torque on the wheel, from the current; none where it says nothing of it", |it| {
        it.torque
    }),
    LOAD.maybe("Load: as read, or from the load transfer", |it| it.load),
    SLIP_ANGLE.number("Slip angle: as read, or of the yaw against the course", |it| it.slip_angle),
    SLIP_RATIO.band("Slip ratio: the median and the ends of the 95 % interval", |it| it.slip_ratio),
    WIDTH.maybe("Width of that interval: `ill-posed` above 0.2", SlipEstimate::width),
    text(STATUS, "`ok`, `ill-posed`, or why the current does not say anything of the slip", |it| {
        Some(it.status.name().to_owned())
    }),
    text(REASON, "What the status means; none for `ok`", |it| {
        (it.status != SlipStatus::Ok).then(|| it.status.meaning().to_owned())
    }),
];

/// Those beside slip that was measured by other means.
#[must_use]
pub const fn of_truth<'a>() -> [Column<OfReading<'a>>; 3] {
    [
        TRUE_SLIP.maybe("Slip ratio measured by other means", |it| it.reading.slip_ratio),
        SLIP_ERROR
            .maybe("Median less that", |it| it.pair().map(|(found, measured)| found - measured)),
        text("is_in_interval", "`yes` where the interval holds it, or `no`", |it| {
            let holds = it.estimate.holds(it.reading.slip_ratio?)?;
            Some(if holds { "yes" } else { "no" }.to_owned())
        }),
    ]
}

/// A row for each reading. The last columns are there where slip was measured by other means.
#[must_use]
pub fn table(rover: &Rover, log: &MotorLog, estimates: &[Vec<Option<SlipEstimate>>]) -> Table {
    let rows = log.records.iter().zip(estimates).flat_map(|(record, estimates)| {
        let wheels = rover.mounts().iter().zip(&record.wheels).zip(estimates);
        wheels.filter_map(|((mount, reading), estimate)| {
            let (reading, estimate) = ((*reading)?, (*estimate)?);
            Some(OfReading { time: record.time, wheel: &mount.name, reading, estimate })
        })
    });
    let rows: Vec<OfReading<'_>> = rows.collect();
    let estimates: Vec<_> = rows.iter().map(|row| Some(&row.estimate)).collect();
    let table = Table::of(&of_reading(), &rows).and(&ESTIMATE, &estimates);
    if rows.iter().all(|row| row.reading.slip_ratio.is_none()) {
        return table;
    }
    table.and(&of_truth(), &rows.iter().map(Some).collect::<Vec<_>>())
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief(table: &Table) -> Vec<String> {
    let first = [TIME.name, WHEEL, CURRENT.name, TORQUE.name, LOAD.name].map(String::from);
    let last = [TRUE_SLIP.name, STATUS].map(String::from);
    let all = first.into_iter().chain(SLIP_RATIO.quantiles()).chain(last);
    all.filter(|name| table.column(name).is_some()).collect()
}

/// A wheel, or all of them.
struct OfWheel<'a> {
    wheel: &'a str,
    agreement: Agreement,
}

/// Share of the intervals that hold the slip that was measured.
pub const SHARE_HELD: Quantity = quantity("share_held", ONE);

const fn of_wheel<'a>() -> [Column<OfWheel<'a>>; 8] {
    [
        text(WHEEL, "The wheel, or `all`", |it| Some(it.wheel.to_owned())),
        whole("readings", "How many readings there are", |it| Some(it.agreement.readings)),
        whole("estimated", "How many have a slip ratio", |it| Some(it.agreement.estimated)),
        whole("ill_posed", "How many of these are ill-posed", |it| Some(it.agreement.ill_posed)),
        SLIP_RATIO.maybe("Mean of the medians", |it| it.agreement.slip_ratio),
        quantity("slip_ratio_bias", ONE).maybe("Mean error of the medians", |it| it.agreement.bias),
        quantity("slip_ratio_rmse", ONE)
            .maybe("Root of the mean squared error of the medians", |it| it.agreement.rmse),
        SHARE_HELD
            .maybe("Share of the intervals that hold the slip measured by other means", |it| {
                it.agreement.held.map(|held| held.estimate())
            }),
    ]
}

/// The word for all wheels.
const ALL: &str = "all";

/// A row for each wheel with readings, then one for all. The last columns are there where slip was
/// measured by other means.
#[must_use]
pub fn summary(rover: &Rover, log: &MotorLog, estimates: &[Vec<Option<SlipEstimate>>]) -> Table {
    let of = |wheel, place| OfWheel { wheel, agreement: Agreement::over(log, estimates, place) };
    let wheels = rover.mounts().iter().enumerate();
    let wheels = wheels.map(|(place, mount)| of(&mount.name, Some(place)));
    let mut rows: Vec<OfWheel<'_>> = wheels.filter(|it| it.agreement.readings > 0).collect();
    rows.push(of(ALL, None));
    let columns = of_wheel();
    let is_compared = rows.iter().any(|row| row.agreement.held.is_some());
    let columns = if is_compared { &columns[..] } else { &columns[..5] };
    Table::of(columns, &rows)
}
