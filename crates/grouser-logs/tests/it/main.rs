//! Logs of every kind, read as telemetry. Logs that the libraries of others write are read in
//! `crates/grouser-python/tests/test_telemetry.py`.

mod arrow;
mod container;
#[expect(dead_code, reason = "the crate uses all of it")]
#[path = "../../src/mcap/format.rs"]
mod format;
mod hostile;
mod robots;
mod runs;
mod several;
mod tables;
#[expect(dead_code, reason = "the crate uses all of it")]
#[path = "../../src/protobuf/wire.rs"]
mod wire;
mod written;

use std::fs;
use std::path::Path;

use grouser::document::measurements::telemetry::{Odometry, TelemetryRecord, WheelTelemetry};
use grouser::vehicle::Rover;
use grouser_core::paper;
use grouser_logs::{
    DriveFolder, LogOptions, Mapping, Problem, Remedy, TelemetryError, TelemetryLog, TopicChoices,
};
use tempfile::TempDir;

/// All records of a log, and its notes.
type Read = Result<(Vec<TelemetryRecord>, Vec<String>), TelemetryError>;

fn rover() -> Rover {
    paper::traverse().expect("a scenario").rover
}

fn read_file(path: &Path, mapping: Option<&str>, choices: &[(&str, &str)]) -> Read {
    read_of(&rover(), path, mapping, choices, Some(Odometry::Visual))
}

fn read_measured(
    path: &Path,
    mapping: Option<&str>,
    choices: &[(&str, &str)],
    odometry: Option<Odometry>,
) -> Read {
    read_of(&rover(), path, mapping, choices, odometry)
}

fn read_of(
    rover: &Rover,
    path: &Path,
    mapping: Option<&str>,
    choices: &[(&str, &str)],
    odometry: Option<Odometry>,
) -> Read {
    let mapping = mapping.map(|text| Mapping::parse("mapping.toml", text)).transpose()?;
    let own = |(what, topic): &(&str, &str)| ((*what).to_owned(), (*topic).to_owned());
    let choices: TopicChoices = choices.iter().map(own).collect();
    let options = LogOptions::default().with_mapping(mapping).with_topics(choices);
    let mut log = TelemetryLog::open(path, rover, &options.with_odometry(odometry))?;
    let mut records = Vec::new();
    while let Some(record) = log.next_record()? {
        records.push(record);
    }
    Ok((records, log.notes()))
}

/// A mapping with these readings.
fn mapping(readings: &str) -> String {
    format!("schema = \"telemetry-mapping/1\"\nname = \"ours\"\n{readings}")
}

fn place(wheel: &str) -> usize {
    rover().mounts().iter().position(|mount| mount.name == wheel).unwrap()
}

fn read(bytes: &[u8], mapping: Option<&str>) -> Read {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("log");
    fs::write(&path, bytes).unwrap();
    read_file(&path, mapping, &[])
}
