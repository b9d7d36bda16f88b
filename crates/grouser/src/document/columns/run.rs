//! A run: its records in time, each wheel's, and what became of the rover.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::super::table::ColumnKind;
use super::super::table::{Row, Table};
use super::super::unit::{A, DEG, DEG_S, J, M, M_S, ONE, V, W};
use super::ended::draws_ended;
use super::flags;
use super::heading::DRAWS;
use super::wheel::{MAX_NORMAL_STRESS, WHEEL};
use super::{
    CURRENT, Column, DRIFT, ENERGY, ENERGY_PER_METRE, LOAD, PITCH, POWER, PROBABILITY_COMPLETED,
    Quantity, ROLL, SINKAGE, SLIP_ANGLE, SLIP_RATIO, STEERING, TEMPERATURE, TIME, WHEEL_SPEED, X,
    Y, YAW, Z, number, quantity, text, whole,
};
use crate::contact::Settled;
use crate::contact::validity::Finding;
use crate::simulation::{OutcomeKind, Record, Scenario, Trajectory, WheelRecord};
use crate::studies::drive::Drive;
use crate::studies::traverse_band::{RunBand, TimeBand};
use crate::studies::validity::{Raised, RoverOnSlope};
use crate::vehicle::Mount;

/// Speed along the body.
pub const FORWARD_SPEED: Quantity = quantity("forward_speed_m_s", M_S);
/// Speed across the body, positive to the left.
pub const LATERAL_SPEED: Quantity = quantity("lateral_speed_m_s", M_S);
/// Yaw rate.
pub const YAW_RATE: Quantity = quantity("yaw_rate_deg_s", DEG_S);

/// The rover at one time. Positions are of the body's centre of mass, in the slope frame or on the
/// map; speeds in the body frame.
pub const RECORD: [Column<Record>; 12] = [
    TIME.number("Time", |it| it.time),
    X.number("Of the body's centre of mass: along the contour, or on a map", |it| it.place().x),
    Y.number("Uphill, or on a map", |it| it.place().y),
    YAW.number(
        "Yaw, positive where the nose points uphill; on a map from its x axis, to the left",
        |it| it.state.yaw,
    ),
    FORWARD_SPEED.number("Speed along the body", |it| it.state.velocity.x),
    LATERAL_SPEED.number("Speed across the body, positive to the left", |it| it.state.velocity.y),
    YAW_RATE.number("Yaw rate", |it| it.state.yaw_rate),
    POWER.number("Power of all motors", |it| it.wheels.iter().map(WheelRecord::power).sum()),
    ENERGY.number("Work of the motors so far", |it| it.energy.motors),
    number("soil_energy_j", J, "Work done on the soil so far", |it| it.energy.soil),
    number("kinetic_energy_j", J, "Kinetic energy", |it| it.energy.kinetic),
    number("potential_energy_j", J, "Potential energy, zero at the start's height", |it| {
        it.energy.potential
    }),
];

/// How the rover stands on ground with heights: beside [`RECORD`].
pub const STANDING: [Column<Record>; 5] = [
    Z.maybe("Height of the body's centre of mass", |it| Some(it.standing()?.height)),
    ROLL.maybe("Roll, positive with the right side down", |it| Some(it.standing()?.roll)),
    PITCH.maybe("Pitch, positive with the nose up", |it| Some(it.standing()?.pitch)),
    quantity("stability_margin_deg", DEG).maybe(
        "Force-angle margin: by how much the weight's direction may turn before the rover tips \
         over",
        |it| it.standing().and(it.stability_margin),
    ),
    BELLY_CLEARANCE.maybe(
        "Least height of the body's underside over the ground, where its belly clearance is given",
        |it| it.belly_clearance,
    ),
];

/// How the rover stands in a scenario: nothing on a plane, and no belly clearance where the rover's
/// is not given.
pub(in super::super) fn standing(
    scenario: &Scenario,
) -> impl Iterator<Item = &'static Column<Record>> + use<> {
    const ALL: &[Column<Record>] = &STANDING;
    let has_heights = !scenario.ground.is_plane();
    let has_belly = scenario.rover.parts().belly_clearance.is_some();
    ALL.iter().filter(move |it| has_heights && (has_belly || it.name != BELLY_CLEARANCE.name))
}

/// Height of a rover's underside over the ground.
pub const BELLY_CLEARANCE: Quantity = quantity("belly_clearance_m", M);

/// What motors take, of a rover whose motors are known: beside [`RECORD`].
pub const ELECTRICAL_RECORD: [Column<Record>; 5] = [
    ELECTRICAL_POWER.number("Electrical power of all motors, without the electronics", |it| {
        it.wheels.iter().filter_map(|wheel| Some(wheel.electrical?.power)).sum()
    }),
    BATTERY_ENERGY.number(
        "Electrical energy that motors, and with a battery the electronics, took so far",
        |it| it.energy.electrical,
    ),
    quantity("battery_voltage_v", V)
        .maybe("Voltage at the battery's terminals", |it| Some(it.battery?.terminals.voltage)),
    quantity("battery_current_a", A)
        .maybe("Current of the battery", |it| Some(it.battery?.terminals.current)),
    STATE_OF_CHARGE.maybe("State of charge of the battery", |it| Some(it.battery?.charge)),
];

/// What a wheel's motor takes, where that is known: beside [`WHEEL_RECORD`].
pub const ELECTRICAL: [Column<WheelRecord>; 4] = [
    CURRENT
        .maybe("Current of its motor, negative where it brakes", |it| Some(it.electrical?.current)),
    quantity("voltage_v", V)
        .maybe("Voltage of its motor, negative backward", |it| Some(it.electrical?.voltage)),
    ELECTRICAL_POWER.maybe("Electrical power of its motor, negative where it feeds back", |it| {
        Some(it.electrical?.power)
    }),
    TEMPERATURE.maybe("Temperature of its motor's winding", |it| it.temperature),
];

/// Electrical power of motors.
pub const ELECTRICAL_POWER: Quantity = quantity("electrical_power_w", W);
/// Electrical energy.
pub const BATTERY_ENERGY: Quantity = quantity("battery_energy_j", J);
/// State of charge of a battery.
pub const STATE_OF_CHARGE: Quantity = quantity("state_of_charge", ONE);

/// The steering angle of a wheel that is steered: beside [`WHEEL_RECORD`].
pub const STEERING_RECORD: [Column<WheelRecord>; 1] =
    [STEERING.number("Steering angle, positive to the left", |it| it.steering)];

/// A wheel at one time, beside its results ([`WHEEL`]).
pub const WHEEL_RECORD: [Column<WheelRecord>; 5] = [
    WHEEL_SPEED.number("Angular speed", |it| it.wheel_speed),
    SLIP_RATIO.number("Slip ratio", |it| it.reaction.slip.ratio),
    SLIP_ANGLE.number("Slip angle", |it| it.reaction.slip.angle),
    LOAD.number("Load", |it| it.reaction.load),
    POWER.number("Power of its motor", WheelRecord::power),
];

/// Error of the energy balance.
pub const ENERGY_ERROR: Quantity = quantity("energy_error_j", J);

/// Length of a way.
pub const DISTANCE: Quantity = quantity("distance_m", M);

/// The outcome of a run.
const RUN: [Column<Trajectory>; 6] = [
    text("outcome", "What became of the rover, by its name in the table of outcomes", |it| {
        Some(it.outcome.name().into())
    }),
    text("reason", "What that means here; none for a completed run", |it| it.outcome.reason()),
    text("simulation", "`dynamic`, `quasi-steady`, or `fell-back` to the first", |it| {
        Some(it.method.name().into())
    }),
    text("simulation_reason", "Since when and why it fell back", |it| it.method.reason()),
    ENERGY.number("Work of the motors over the run", |it| it.last().energy.motors),
    ENERGY_ERROR.number("Error of the energy balance", Trajectory::energy_error),
];

/// How a run was computed.
pub(super) const METHOD: &[Column<Trajectory>] = RUN.split_at(4).0.split_at(2).1;

/// A run in a few numbers, means over wheels and records: what a campaign keeps beside the end.
pub(in super::super) const DRIVE: [Column<Drive>; 7] = [
    DISTANCE.number("Length of the way", |it| it.distance),
    DRIFT.maybe("Drift per metre travelled, positive downhill", |it| it.drift),
    SLIP_RATIO.maybe("Mean slip ratio", |it| it.slip_ratio),
    SINKAGE.maybe("Mean sinkage", |it| it.sinkage),
    POWER.maybe("Mean power of all motors", |it| it.power),
    ENERGY.number("Work of the motors", |it| it.energy),
    ENERGY_PER_METRE.maybe("Work of the motors per metre travelled", |it| it.energy_per_metre),
];

/// What motors and battery took over a run, of a rover whose motors are known: beside [`DRIVE`].
pub(in super::super) const ELECTRICAL_DRIVE: [Column<Drive>; 2] = [
    BATTERY_ENERGY
        .maybe("Electrical energy that motors, and with a battery the electronics, took", |it| {
            it.battery_energy
        }),
    CURRENT.maybe("Largest current of a motor, driving or braking", |it| it.current),
];

/// The end of a run: columns of a campaign.
pub(in super::super) const END: &[Column<Record>] = RECORD.split_at(4).0;

/// Why a record is an extrapolation.
const FLAGS: [Column<Vec<Finding>>; 1] = [flags::flags(|it| flags::names(it))];

/// When a flag was raised first in a run.
const RAISED: [Column<Raised>; 2] = [
    text("flag", "Name of the flag", |it| Some(it.finding.flag.name().into())),
    TIME.number("Time since the start at which it was raised first", |it| it.time),
];

/// The flags of each record.
#[must_use]
pub fn each_findings(run: &Trajectory, scenario: &Scenario) -> Vec<Vec<Finding>> {
    let rover = RoverOnSlope::of(scenario);
    run.records.iter().map(|record| rover.at(record)).collect()
}

/// The flags that a run raises, each with the time at which it was raised first.
#[must_use]
pub fn raised(run: &Trajectory, scenario: &Scenario) -> Table {
    Table::of(&RAISED, &RoverOnSlope::of(scenario).over(run))
}

/// A row for each record. The columns of a wheel start with its name, as in
/// `front-left.slip_ratio`; they are empty where the rover has just tipped over or sunk, and left
/// out where no sample has any.
#[must_use]
pub fn table(run: &Trajectory, scenario: &Scenario) -> Table {
    let rover = &scenario.rover;
    let mut table = Table::of(&RECORD, &run.records);
    if !scenario.ground.is_plane() {
        table = table.and(&STANDING, &run.records.iter().map(Some).collect::<Vec<_>>());
    }
    if rover.has_motors() {
        table = table.and(&ELECTRICAL_RECORD, &run.records.iter().map(Some).collect::<Vec<_>>());
    }
    let findings = each_findings(run, scenario);
    table = table.and(&FLAGS, &findings.iter().map(Some).collect::<Vec<_>>());
    let wheels = run.records.iter().map(|record| record.wheels.len()).max().unwrap_or(0);
    for (place, mount) in rover.mounts().iter().take(wheels).enumerate() {
        let wheels: Vec<_> = run.records.iter().map(|record| record.wheels.get(place)).collect();
        let settled: Vec<Option<&Settled>> =
            wheels.iter().map(|wheel| Some(&(*wheel)?.reaction.settled)).collect();
        let prefix = format!("{}.", mount.name);
        // The largest stress stands first: readers of such files may know columns by their places.
        let (first, results): (Vec<_>, Vec<_>) =
            WHEEL.iter().partition(|column| column.name == MAX_NORMAL_STRESS.name);
        table = table.and_named(&prefix, first, &settled);
        table = table.and_named(&prefix, &WHEEL_RECORD, &wheels);
        table = table.and_named(&prefix, results, &settled);
        if mount.unit.motor.is_some() {
            table = table.and_named(&prefix, &ELECTRICAL, &wheels);
        }
        if mount.steering_axis.is_some() {
            table = table.and_named(&prefix, &STEERING_RECORD, &wheels);
        }
    }
    table
}

/// The rover at one time over samples of soil and model, and which of them ended early until then.
/// What such a sample counts as from then on is said by the table of outcomes.
pub const TIME_BAND: [Column<TimeBand>; 10] = [
    TIME.number("Time", |it| it.time),
    X.band("Along the contour", |it| it.x),
    Y.band("Uphill", |it| it.y),
    YAW.band("Yaw, positive where the nose points uphill", |it| it.yaw),
    SLIP_RATIO.band("Mean slip ratio of the wheels", |it| it.slip_ratio),
    SINKAGE.band("Mean sinkage of the wheels", |it| it.sinkage),
    ENERGY.band("Work of the motors so far", |it| it.energy),
    whole(DRAWS_IN_BAND, "Samples that are in the band", |it| Some(it.ends.in_band())),
    SHARE_EARLY.number("Share of all samples that ended early", |it| it.ends.share_early()),
    text(ENDED_EARLY, "How these ended, with the share of each way", |it| it.ends.in_words()),
];

/// How the rover stands at one time on ground with heights, over samples of soil and model: beside
/// [`TIME_BAND`].
pub const STANDING_BAND: [Column<TimeBand>; 3] = [
    Z.band("Height of the body's centre of mass", |it| it.height),
    ROLL.band("Roll, positive with the right side down", |it| it.roll),
    PITCH.band("Pitch, positive with the nose up", |it| it.pitch),
];

/// How the rover stands at the end on ground with heights, over samples of soil and model: beside
/// [`RUN_BAND`].
pub const RUN_STANDING_BAND: [Column<RunBand>; 3] = [
    Z.band("Height of the body's centre of mass, at the end", |it| it.height),
    ROLL.band("Roll at the end, positive with the right side down", |it| it.roll),
    PITCH.band("Pitch at the end, positive with the nose up", |it| it.pitch),
];

/// The bands at some times.
#[must_use]
pub fn time_bands(bands: &[TimeBand], scenario: &Scenario) -> Table {
    Table::of(&TIME_BAND, bands)
        .and(standing_band(scenario), &bands.iter().map(Some).collect::<Vec<_>>())
}

/// The band of a whole run: one row.
#[must_use]
pub fn run_band(band: &RunBand, scenario: &Scenario) -> Table {
    with_run_band(Table::default(), band, scenario)
}

/// One row about a run, with its band.
#[must_use]
pub fn with_run_band(table: Table, band: &RunBand, scenario: &Scenario) -> Table {
    let standing = RUN_STANDING_BAND.iter().filter(|_| !scenario.ground.is_plane());
    table.and(&RUN_BAND, &[Some(band)]).and(standing, &[Some(band)])
}

fn standing_band(scenario: &Scenario) -> impl Iterator<Item = &'static Column<TimeBand>> + use<> {
    const ALL: &[Column<TimeBand>] = &STANDING_BAND;
    let has_heights = !scenario.ground.is_plane();
    ALL.iter().filter(move |_| has_heights)
}

/// A run in a few numbers over samples of soil and model. Means of a sample are over the scenario's
/// whole duration, or over its time in the band.
pub const RUN_BAND: [Column<RunBand>; 19] = [
    X.band("Along the contour, at the end", |it| it.x),
    Y.band("Uphill, at the end", |it| it.y),
    YAW.band("Yaw at the end", |it| it.yaw),
    DISTANCE.band("Length of the way", |it| it.distance),
    SLIP_RATIO.band("Mean slip ratio; 1 from where a rover gets stuck", |it| it.slip_ratio),
    SINKAGE.band("Mean sinkage; down to the axles from where a rover gets stuck", |it| it.sinkage),
    ENERGY.band("Work of the motors", |it| it.energy),
    ENERGY_PER_METRE.band(
        "Work of the motors per metre travelled, without a bound where a rover gets stuck",
        |it| it.energy_per_metre,
    ),
    PROBABILITY_COMPLETED.probability(
        "Probability that the run is completed: the share of the samples in which it is",
        |it| Some(it.completed),
    ),
    draws_ended::<{ OutcomeKind::Immobilised as usize }>(),
    draws_ended::<{ OutcomeKind::Sliding as usize }>(),
    draws_ended::<{ OutcomeKind::TippedOver as usize }>(),
    draws_ended::<{ OutcomeKind::BrownOut as usize }>(),
    draws_ended::<{ OutcomeKind::OffTheMap as usize }>(),
    draws_ended::<{ OutcomeKind::HighCentred as usize }>(),
    whole(DRAWS_IN_BAND, "Samples that are in the band at the end", |it| Some(it.ends.in_band())),
    SHARE_EARLY.number("Share of all samples that ended early", |it| it.ends.share_early()),
    text(ENDED_EARLY, "How these ended, with the share of each way", |it| it.ends.in_words()),
    whole(DRAWS, "All samples", |it| Some(it.completed.trials)),
];

/// Number of samples that have not left a band.
const DRAWS_IN_BAND: &str = "draws_in_band";
/// Share of the samples that ended early.
const SHARE_EARLY: Quantity = quantity("share_ended_early", ONE);
/// How samples ended early.
const ENDED_EARLY: &str = "ended_early";

/// Records with the bands at the same times, and at those after them.
///
/// * `bands`: at least as many as the table has rows
#[must_use]
pub fn with_bands(table: Table, bands: &[TimeBand], scenario: &Scenario) -> Table {
    let mut table = table.padded(bands.len());
    let [time, results @ ..] = &TIME_BAND;
    let rows: Vec<_> = bands.iter().map(Some).collect();
    let times = Table::default().and([time], &rows);
    for (name, values) in &mut table.columns {
        if let Some(times) = times.column(name) {
            *values = times.clone();
        }
    }
    table.and(results, &rows).and(standing_band(scenario), &rows)
}

/// The columns of [`time_bands`] for reading.
#[must_use]
pub fn bands_brief(scenario: &Scenario) -> Vec<String> {
    let height = (!scenario.ground.is_plane()).then_some(Z);
    let quantities = [X, Y].into_iter().chain(height).chain([YAW, SLIP_RATIO, SINKAGE]);
    let ends = quantities.flat_map(|it| {
        let [low, _, high] = it.quantiles();
        [low, high]
    });
    std::iter::once(TIME.name.to_owned()).chain(ends).collect()
}

/// The end of a run and its means: one row.
#[must_use]
pub fn summary(run: &Trajectory, scenario: &Scenario) -> Table {
    let over = RoverOnSlope::of(scenario).over(run);
    let findings: Vec<Finding> = over.iter().map(|raised| raised.finding).collect();
    let outcome = RUN.iter().filter(|column| column.kind() == ColumnKind::Text);
    let (run_row, end, drive) = ([Some(run)], [Some(run.last())], Drive::of(run, scenario));
    let has_motors = scenario.rover.has_motors();
    Table::default()
        .and(outcome, &run_row)
        .and(END, &end)
        .and(STANDING.iter().filter(|_| !scenario.ground.is_plane()), &end)
        .and(&DRIVE, &[Some(&drive)])
        .and(ELECTRICAL_DRIVE.iter().filter(|_| has_motors), &[Some(&drive)])
        .and(&FLAGS, &[Some(&findings)])
}

/// The columns of [`summary`] for reading.
#[must_use]
pub fn summary_brief() -> Vec<String> {
    let numbers = [TIME, X, Y, YAW, SLIP_RATIO, SINKAGE, ENERGY].map(|it| it.name);
    ["outcome"].into_iter().chain(numbers).chain([flags::FLAGS]).map(String::from).collect()
}

/// The columns of [`summary`] with those of [`RUN_BAND`] for reading.
#[must_use]
pub fn summary_bands_brief() -> Vec<String> {
    let results = [X, Y, YAW, SLIP_RATIO, SINKAGE, ENERGY].map(|it| {
        let [low, _, high] = it.quantiles();
        [it.name.to_owned(), low, high]
    });
    let first = ["outcome", TIME.name].map(String::from);
    let last = [PROBABILITY_COMPLETED.name, flags::FLAGS].map(String::from);
    first.into_iter().chain(results.into_iter().flatten()).chain(last).collect()
}

/// The means over a record's wheels; missing where the rover has just tipped over or sunk.
const MEANS: [Column<Record>; 3] = [
    SLIP_RATIO.maybe("Mean slip ratio", |it| mean(it, |wheel| wheel.reaction.slip.ratio)),
    SLIP_ANGLE.maybe("Mean slip angle", |it| mean(it, |wheel| wheel.reaction.slip.angle)),
    SINKAGE.maybe("Mean sinkage", |it| mean(it, |wheel| wheel.reaction.settled.sinkage)),
];

fn mean(record: &Record, of: fn(&WheelRecord) -> f64) -> Option<f64> {
    let count = record.wheels.len();
    (count > 0).then(|| record.wheels.iter().map(of).sum::<f64>() / count as f64)
}

/// The places of the start and of some more records up to the end.
///
/// * `lines`: how many besides the start, at most
#[must_use]
pub fn brief_places(run: &Trajectory, lines: usize) -> Vec<usize> {
    let last = run.records.len() - 1;
    let lines = lines.min(last);
    (0..=lines).map(|line| line * last / lines.max(1)).collect()
}

/// The start and some more records up to the end, with the means of their wheels: for reading.
///
/// * `lines`: how many besides the start, at most
#[must_use]
pub fn brief(run: &Trajectory, scenario: &Scenario, lines: usize) -> Table {
    let rows = brief_places(run, lines).into_iter().map(|it| Some(&run.records[it]));
    let rows: Vec<_> = rows.collect();
    let power = RECORD.iter().position(|it| it.name == POWER.name).unwrap_or(0);
    Table::default()
        .and(END, &rows)
        .and(standing(scenario), &rows)
        .and(&MEANS, &rows)
        .and(&RECORD[power..=power], &rows)
}

/// A run with its records as one object of JSON: what became of the rover, `final`, and `samples`.
#[derive(Clone, Copy, Debug)]
pub struct RunObject<'a> {
    /// The run.
    pub run: &'a Trajectory,
    /// What was run.
    pub scenario: &'a Scenario,
    /// Derivatives, where some are asked for: a row for each record.
    pub derivatives: Option<&'a Table>,
}

impl Serialize for RunObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let record = |(place, record)| RecordObject {
            record,
            scenario: self.scenario,
            derivatives: self.derivatives.map(|it| it.row(place)),
        };
        let mut map = serializer.serialize_map(None)?;
        RUN.iter().try_for_each(|column| column.write(&mut map, self.run))?;
        if self.scenario.rover.has_motors() {
            let [_, energy, ..] = &ELECTRICAL_RECORD;
            energy.write(&mut map, self.run.last())?;
        }
        let over = RoverOnSlope::of(self.scenario).over(self.run);
        let findings: Vec<Finding> = over.iter().map(|raised| raised.finding).collect();
        FLAGS.iter().try_for_each(|column| column.write(&mut map, &findings))?;
        map.serialize_entry("flags_raised", &Table::of(&RAISED, &over))?;
        let records: Vec<RecordObject<'_>> =
            self.run.records.iter().enumerate().map(record).collect();
        map.serialize_entry("final", &records.last())?;
        map.serialize_entry("samples", &records)?;
        map.end()
    }
}

struct RecordObject<'a> {
    record: &'a Record,
    scenario: &'a Scenario,
    derivatives: Option<Row<'a>>,
}

impl Serialize for RecordObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        RECORD.iter().try_for_each(|column| column.write(&mut map, self.record))?;
        if !self.scenario.ground.is_plane() {
            STANDING.iter().try_for_each(|column| column.write(&mut map, self.record))?;
        }
        if self.scenario.rover.has_motors() {
            ELECTRICAL_RECORD.iter().try_for_each(|column| column.write(&mut map, self.record))?;
        }
        if let Some(derivatives) = &self.derivatives {
            derivatives.write(&mut map)?;
        }
        let findings = RoverOnSlope::of(self.scenario).at(self.record);
        FLAGS.iter().try_for_each(|column| column.write(&mut map, &findings))?;
        let wheels = self.record.wheels.iter().zip(self.scenario.rover.mounts());
        let wheels: Vec<_> = wheels.map(|(wheel, mount)| WheelObject { mount, wheel }).collect();
        map.serialize_entry("wheels", &wheels)?;
        map.end()
    }
}

struct WheelObject<'a> {
    mount: &'a Mount,
    wheel: &'a WheelRecord,
}

impl Serialize for WheelObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("wheel", &self.mount.name)?;
        WHEEL_RECORD.iter().try_for_each(|column| column.write(&mut map, self.wheel))?;
        let settled = &self.wheel.reaction.settled;
        WHEEL.iter().try_for_each(|column| column.write(&mut map, settled))?;
        if self.wheel.electrical.is_some() {
            ELECTRICAL.iter().try_for_each(|column| column.write(&mut map, self.wheel))?;
        }
        if self.mount.steering_axis.is_some() {
            STEERING_RECORD.iter().try_for_each(|column| column.write(&mut map, self.wheel))?;
        }
        map.end()
    }
}
