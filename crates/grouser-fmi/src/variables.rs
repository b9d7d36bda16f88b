//! What an FMU says and takes: its variables, each with its unit and where its value comes from.
//!
//! Outputs are the columns of a trajectory, parameters the numbers of the document, both with the
//! names that they have there.

use std::collections::BTreeSet;

use grouser::contact::Settled;
use grouser::document::columns::run::{
    ELECTRICAL, ELECTRICAL_RECORD, RECORD, STANDING, STEERING_RECORD, WHEEL_RECORD,
};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{Column, TIME, WHEEL_SPEED};
use grouser::document::unit::{ONE, S};
use grouser::document::varied::Key;
use grouser::document::{Kind, Unit, meaning, unit_of};
use grouser::simulation::{OutcomeKind, Record, Scenario, WheelRecord};

use crate::drive::Drive;

/// A variable. Its reference is its place in the list.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name, with its unit at its end as in documents and results.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
    /// What it is: a sentence without its full stop.
    pub sentence: String,
    /// Where its value comes from, or what it changes.
    pub role: Role,
}

/// Where a variable's value comes from, or what it changes.
#[derive(Clone, Copy, Debug)]
pub enum Role {
    /// The time of the importer.
    Time,
    /// The speed that is commanded of a wheel.
    Input {
        /// The wheel's place.
        wheel: usize,
    },
    /// A number of the document.
    Parameter {
        /// Its place among all of them.
        place: usize,
    },
    /// A result.
    ResultOf(ResultOf),
    /// What became of the rover, by its number.
    Outcome,
    /// Why, in words.
    Reason,
    /// The number of a mission's leg.
    Leg,
}

/// A column of results.
#[derive(Clone, Copy, Debug)]
pub enum ResultOf {
    /// Of the rover.
    Rover(&'static Column<Record>),
    /// Of a wheel, by its place.
    Wheel(usize, &'static Column<WheelRecord>),
    /// Of the soil below a wheel, by its place.
    Soil(usize, &'static Column<Settled>),
}

impl Variable {
    /// What it is to an importer, by FMI's word for it.
    #[must_use]
    pub fn causality(&self) -> &'static str {
        match self.role {
            Role::Time => "independent",
            Role::Input { .. } => "input",
            Role::Parameter { .. } => "parameter",
            Role::ResultOf(_) | Role::Outcome | Role::Reason | Role::Leg => "output",
        }
    }

    /// The place of the wheel whose variable it is, if it is one's.
    #[must_use]
    pub fn wheel(&self) -> Option<usize> {
        match self.role {
            Role::Input { wheel }
            | Role::ResultOf(ResultOf::Wheel(wheel, _) | ResultOf::Soil(wheel, _)) => Some(wheel),
            _ => None,
        }
    }
}

impl ResultOf {
    /// The number of a record, in the column's unit; NaN where there is none.
    pub(crate) fn number(self, record: &Record) -> f64 {
        let wheel = |place: usize| record.wheels.get(place);
        match self {
            Self::Rover(column) => column.number(record),
            Self::Wheel(place, column) => wheel(place).map_or(f64::NAN, |it| column.number(it)),
            Self::Soil(place, column) => {
                wheel(place).map_or(f64::NAN, |it| column.number(&it.reaction.settled))
            }
        }
    }
}

/// The number of a rover that is under way, beside those of [`OutcomeKind`], which are one higher
/// than their places: the numbers of the C interface.
pub(crate) const UNDER_WAY: i64 = 0;

/// The number of an outcome.
pub(crate) fn number_of(kind: OutcomeKind) -> i64 {
    let each = (UNDER_WAY + 1..).zip(OutcomeKind::ALL);
    each.into_iter().find(|(_, it)| *it == kind).map_or(UNDER_WAY, |(number, _)| number)
}

/// All variables of a model.
///
/// # Errors
/// The name that two of them would have.
pub(crate) fn variables(
    kind: Kind,
    scenario: &Scenario,
    drive: Drive,
    parameters: &[Key],
) -> Result<Vec<Variable>, String> {
    let mut all = vec![Variable {
        name: "time".to_owned(),
        unit: S,
        sentence: "Time".to_owned(),
        role: Role::Time,
    }];
    let mounts = scenario.rover.mounts();
    for (wheel, mount) in mounts.iter().enumerate().filter(|_| drive == Drive::Inputs) {
        all.push(Variable {
            name: format!("{}.commanded_{}", mount.name, WHEEL_SPEED.name),
            unit: WHEEL_SPEED.unit,
            sentence: "Angular speed that is commanded".to_owned(),
            role: Role::Input { wheel },
        });
    }
    all.extend(parameters.iter().enumerate().map(|(place, key)| Variable {
        name: key.path.clone(),
        unit: unit_of(&key.path).unwrap_or(ONE),
        sentence: meaning(kind, &key.path).unwrap_or_default().trim_end_matches('.').to_owned(),
        role: Role::Parameter { place },
    }));
    let named = |prefix: &str, name: &str, unit, doc: &str, output| Variable {
        name: format!("{prefix}{name}"),
        unit,
        sentence: doc.to_owned(),
        role: Role::ResultOf(output),
    };
    for column in of_rover(scenario) {
        all.push(named("", column.name, column.unit, column.doc, ResultOf::Rover(column)));
    }
    const SOIL: &[Column<Settled>] = &WHEEL;
    for (place, mount) in mounts.iter().enumerate() {
        let prefix = format!("{}.", mount.name);
        for column in of_wheel(mount.unit.motor.is_some(), mount.steering_axis.is_some()) {
            let output = ResultOf::Wheel(place, column);
            all.push(named(&prefix, column.name, column.unit, column.doc, output));
        }
        for column in SOIL {
            let output = ResultOf::Soil(place, column);
            all.push(named(&prefix, column.name, column.unit, column.doc, output));
        }
    }
    let mut text = |name: &str, sentence: &str, role| {
        all.push(Variable {
            name: name.to_owned(),
            unit: ONE,
            sentence: sentence.to_owned(),
            role,
        });
    };
    text("outcome", "What became of the rover, or of the leg of its mission", Role::Outcome);
    text("reason", "What that means here; empty while it is under way", Role::Reason);
    if kind == Kind::Mission {
        text("leg", "Number of the leg that is driven, counted from 1", Role::Leg);
    }
    let mut names = BTreeSet::new();
    match all.iter().find(|variable| !names.insert(&*variable.name)) {
        Some(variable) => Err(variable.name.clone()),
        None => Ok(all),
    }
}

/// The columns of a rover; its time is the importer's.
fn of_rover(scenario: &Scenario) -> impl Iterator<Item = &'static Column<Record>> {
    const ALWAYS: &[Column<Record>] = &RECORD;
    const WITH_HEIGHTS: &[Column<Record>] = &STANDING;
    const WITH_MOTORS: &[Column<Record>] = &ELECTRICAL_RECORD;
    let (heights, motors) = (!scenario.ground.is_plane(), scenario.rover.has_motors());
    let always = ALWAYS.iter().filter(|column| column.name != TIME.name);
    let with_heights = WITH_HEIGHTS.iter().filter(move |_| heights);
    always.chain(with_heights).chain(WITH_MOTORS.iter().filter(move |_| motors))
}

/// The columns of a wheel.
fn of_wheel(motor: bool, steered: bool) -> impl Iterator<Item = &'static Column<WheelRecord>> {
    const ALWAYS: &[Column<WheelRecord>] = &WHEEL_RECORD;
    const WITH_MOTOR: &[Column<WheelRecord>] = &ELECTRICAL;
    const STEERED: &[Column<WheelRecord>] = &STEERING_RECORD;
    let with_motor = WITH_MOTOR.iter().filter(move |_| motor);
    ALWAYS.iter().chain(with_motor).chain(STEERED.iter().filter(move |_| steered))
}
