//! Drives without a fault, of every rover: on level ground, on one slope and over several.

use std::error::Error;
use std::fs;
use std::path::Path;

use grouser::document::{Kind, LoadedScenario, presets};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::learn::TelemetryRecord;
use grouser::studies::simulated_telemetry::SensorModels;
use grouser_io::measurements::telemetry::{csv_header, csv_line};

use super::coverage::LEGS;
use super::drive::{Drive, Leg, scenario};

/// The sand on which they drive.
pub(crate) const SAND: &str = "toyoura-uncertain";

/// Where a drive goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Course {
    OneSlope,
    Level,
    Slopes,
}

impl Course {
    fn legs(self) -> Vec<Leg> {
        match self {
            Self::OneSlope => vec![(8.0, 5.0, 2.0)],
            Self::Level => vec![(0.0, 0.0, 2.0)],
            Self::Slopes => LEGS.to_vec(),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::OneSlope => "one slope",
            Self::Level => "level ground",
            Self::Slopes => "several slopes",
        }
    }

    /// That of a drive: each rover has all of them in turn.
    pub(crate) fn of(number: u64) -> Self {
        match (number + number / rovers().len() as u64) % 3 {
            0 => Self::OneSlope,
            1 => Self::Level,
            _ => Self::Slopes,
        }
    }
}

fn rovers() -> Vec<&'static str> {
    presets(Kind::Rover).map(|it| it.name).collect()
}

/// The rover of a drive.
pub(crate) fn rover(number: u64) -> &'static str {
    let rovers = rovers();
    let count = rovers.len() as u64;
    let mut all = (0..count).zip(rovers);
    all.find(|(place, _)| *place == number % count).expect("a rover").1
}

/// The rover of a drive on a soil of which little is known.
pub(crate) fn prior(number: u64) -> LoadedScenario {
    let [soil, rover] = [("soil", SAND), ("rover", rover(number))]
        .map(|(key, name)| format!("scenario.{key}={name}"));
    scenario(&[&soil, "scenario.model=ishigami", &rover])
}

/// A drive on a soil of the prior, over ground that is uneven; nothing where the rover cannot move.
pub(crate) fn drive(prior: &LoadedScenario, course: Course, number: u64) -> Option<Drive> {
    /// Over so much time a rover may have turned unseen [s].
    const PAUSE: f64 = 60.0;
    let drawn = BandInputs::of_scenario(prior).samples(1000 + number, 1);
    let mut truth = drawn.expect("a soil is drawn").remove(0);
    // A discrepancy would pull a rover that no wheel drives, and no real ground does.
    truth.soil.discrepancy = None;
    let truth = &truth;
    let begin = || {
        let mut drive = Drive::uneven(prior, truth, number);
        drive.reads_sinkages = number.is_multiple_of(2);
        drive
    };
    let (mut drive, mut begun) = (begin(), 0.0);
    for leg in course.legs() {
        let mut part = begin();
        part.leg(leg)?;
        let end = begun + part.time();
        let later =
            part.records.into_iter().map(|it| TelemetryRecord { time: begun + it.time, ..it });
        drive.records.extend(later);
        begun = end + PAUSE;
    }
    Some(drive)
}

/// What usual instruments make of it.
pub(crate) fn seen(drive: &Drive, number: u64) -> Vec<TelemetryRecord> {
    drive.seen(SensorModels::USUAL, number)
}

/// Writes the telemetry of some drives into a folder, and prints a row for each: the file, the rover
/// and where it goes. On a soil that is too weak for the rover there is no drive; the next is taken.
pub(crate) fn write(folder: &Path, count: u64) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let mut written = 0;
    for number in 0.. {
        if written == count {
            break;
        }
        let (prior, course) = (prior(number), Course::of(number));
        let Some(drive) = drive(&prior, course, number) else { continue };
        let lines: String = seen(&drive, number).iter().map(csv_line).collect();
        let file = format!("drive-{written:02}.csv");
        fs::write(folder.join(&file), csv_header(&prior.value.rover) + &lines)?;
        println!("{file}\t{}\t{}", rover(number), course.name());
        written += 1;
    }
    Ok(())
}
