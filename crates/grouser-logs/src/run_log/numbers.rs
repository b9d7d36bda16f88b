//! The numbers of a rover and of its wheels as messages: a field for each column of results.

use std::fmt;

use grouser::document::columns::run::{
    BELLY_CLEARANCE, ELECTRICAL, ELECTRICAL_RECORD, RECORD, STANDING, STEERING_RECORD, WHEEL_RECORD,
};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{Column, TEMPERATURE};
use grouser_core::contact::Settled;
use grouser_core::simulation::{Record, WheelRecord};
use grouser_core::vehicle::{Motor, Rover};

use crate::mcap::write::SchemaOf;
use crate::protobuf::message::{Types, put_double};
use crate::run_log::error::LogError;

/// A column, wherever its number comes from.
struct Entry<R> {
    name: &'static str,
    symbol: &'static str,
    doc: &'static str,
    number: Box<dyn Fn(&R) -> f64>,
}

/// The columns of a type of rows as a type of messages.
pub(crate) struct Numbers<R> {
    schema: &'static str,
    entries: Vec<Entry<R>>,
}

fn entries<R: 'static, S: 'static>(
    columns: &'static [Column<S>],
    of: fn(&R) -> &S,
) -> impl Iterator<Item = Entry<R>> {
    columns.iter().map(move |column| Entry {
        name: column.name,
        symbol: column.unit.symbol,
        doc: column.doc,
        number: Box::new(move |row| column.number(of(row))),
    })
}

static RECORD_TAKEN: &[Column<Record>] = &ELECTRICAL_RECORD;
/// So many of them are of all motors; those after them are of the battery.
const OF_MOTORS: usize = 2;

/// The battery's: voltage and current at its terminals, and its state of charge.
pub(crate) fn of_battery() -> Numbers<Record> {
    let (_, battery) = RECORD_TAKEN.split_at(OF_MOTORS);
    Numbers { schema: "grouser.Battery", entries: entries(battery, |it| it).collect() }
}

/// How the rover stands on ground with heights, with its belly clearance where its document says
/// that.
pub(crate) fn of_standing(rover: &Rover) -> Numbers<Record> {
    static COLUMNS: &[Column<Record>] = &STANDING;
    let has_belly = rover.parts().belly_clearance.is_some();
    let is_known = |it: &Entry<Record>| it.name != BELLY_CLEARANCE.name || has_belly;
    let known = entries(COLUMNS, |it| it).filter(is_known);
    Numbers { schema: "grouser.Standing", entries: known.collect() }
}

/// The rover's, with what its motors take where that is known.
pub(crate) fn of_rover(rover: &Rover) -> Numbers<Record> {
    static COLUMNS: &[Column<Record>] = &RECORD;
    let taken = if rover.has_motors() { RECORD_TAKEN.split_at(OF_MOTORS).0 } else { &[] };
    let all = entries(COLUMNS, |it| it).chain(entries(taken, |it: &Record| it));
    Numbers { schema: "grouser.Rover", entries: all.collect() }
}

/// A wheel's, with what its motor takes and how warm that is, each where it is known of every
/// wheel, and its steering angle where some wheel is steered: all wheels have one type of messages.
pub(crate) fn of_wheel(rover: &Rover) -> Numbers<WheelRecord> {
    static MOTION: &[Column<WheelRecord>] = &WHEEL_RECORD;
    static SETTLED: &[Column<Settled>] = &WHEEL;
    let settled = entries(SETTLED, |it: &WheelRecord| &it.reaction.settled);
    static TAKEN: &[Column<WheelRecord>] = &ELECTRICAL;
    let all_have = |part: fn(&Motor) -> bool| {
        rover.mounts().iter().all(|mount| mount.unit.motor.as_ref().is_some_and(part))
    };
    let (has_motors, has_windings) = (all_have(|_| true), all_have(|it| it.winding.is_some()));
    let is_known =
        move |name: &str| if name == TEMPERATURE.name { has_windings } else { has_motors };
    let taken = entries(TAKEN, |it: &WheelRecord| it).filter(move |it| is_known(it.name));
    static ANGLE: &[Column<WheelRecord>] = &STEERING_RECORD;
    let steered = entries(if rover.is_steerable() { ANGLE } else { &[] }, |it: &WheelRecord| it);
    let all = entries(MOTION, |it| it).chain(settled).chain(taken).chain(steered);
    Numbers { schema: "grouser.Wheel", entries: all.collect() }
}

impl<R> fmt::Debug for Numbers<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.entries.iter().map(|it| it.name);
        f.debug_struct(self.schema).field("names", &names.collect::<Vec<_>>()).finish()
    }
}

impl<R> Numbers<R> {
    /// The type of the messages.
    pub(crate) fn schema(&self) -> SchemaOf<'static> {
        let data = Types::of_numbers(self.schema, self.entries.iter().map(|it| it.name));
        SchemaOf { name: self.schema, encoding: "protobuf", data, messages: "protobuf" }
    }

    /// What each field is, with its unit.
    pub(crate) fn described(&self) -> Vec<(String, String)> {
        let described = |it: &Entry<R>| (it.name.to_owned(), format!("{} [{}]", it.doc, it.symbol));
        self.entries.iter().map(described).collect()
    }

    /// A row as a message.
    ///
    /// * `whose`: the wheel, or the rover
    /// * `time`: [s]
    pub(crate) fn message(&self, row: &R, whose: &str, time: f64) -> Result<Vec<u8>, LogError> {
        let mut out = Vec::with_capacity(10 * self.entries.len());
        for (number, entry) in (1..).zip(&self.entries) {
            let value = (entry.number)(row);
            if !value.is_finite() {
                let (name, whose) = (entry.name, whose.to_owned());
                return Err(LogError::NotFinite { name, whose, time, value });
            }
            put_double(value, number, &mut out);
        }
        Ok(out)
    }
}
