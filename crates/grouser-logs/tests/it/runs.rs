//! A simulated run is the same telemetry, whatever it is written as.

use std::path::Path;

use grouser::simulation::{Run, Scenario, Trajectory};
use grouser::studies::simulated_telemetry::truth;
use grouser_core::paper;
use grouser_logs::Log;
use grouser_logs::TelemetryWriter;

use super::*;

fn run() -> (Scenario, Trajectory) {
    let scenario = Scenario { duration: 2.0, ..paper::traverse().expect("a scenario") };
    let run = Run::new(&scenario).and_then(Run::to_end).expect("a run");
    (scenario, run)
}

fn close(found: Option<f64>, expected: Option<f64>) -> bool {
    match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
        (None, None) => true,
        _ => false,
    }
}

#[test]
fn a_table_is_read_as_it_was_written() {
    let (scenario, run) = run();
    let truth = truth(&run, &scenario);
    for name in ["drive.csv", "drive.parquet"] {
        let mut writer = TelemetryWriter::begin(Path::new(name), Vec::new(), &rover()).unwrap();
        for record in &truth {
            writer.write(record).unwrap();
        }
        let (records, notes) = read(&writer.finish().unwrap(), None).unwrap();
        assert!(notes.is_empty(), "{notes:?}");
        assert_eq!(records.len(), truth.len(), "{name}");
        for (found, record) in records.iter().zip(&truth) {
            assert!((found.time - record.time).abs() < 1e-12);
            for (found, expected) in [
                (found.roll, record.roll),
                (found.pitch, record.pitch),
                (found.yaw, record.yaw),
                (found.displacement[0], record.displacement[0]),
                (found.displacement[1], record.displacement[1]),
                (found.rotation, record.rotation),
            ] {
                assert!(close(found, expected), "{name}: {found:?} {expected:?}");
            }
            check_wheels(found, record);
        }
    }
}

/// Places stand in for odometry.
#[test]
fn a_log_of_our_own_is_telemetry() {
    let (scenario, run) = run();
    let mut log = Log::begin(Vec::new(), "a run", &scenario).unwrap();
    log.append(&run.records).unwrap();
    let bytes = log.finish().unwrap();
    let (records, notes) = read(&bytes, None).unwrap();
    assert_eq!(
        notes,
        ["the mapping 'logs of Grouser' has 25 columns of telemetry"],
        "none is lost"
    );
    let truth = truth(&run, &scenario);
    assert_eq!(records.len(), truth.len());
    for ((found, expected), record) in records.iter().zip(&truth).zip(&run.records) {
        // Logs count nanoseconds.
        assert!((found.time - expected.time).abs() < 1e-9);
        for (found, expected) in [
            (found.roll, expected.roll),
            (found.pitch, expected.pitch),
            (found.yaw, expected.yaw),
            (found.position[0], Some(record.state.position.x)),
            (found.position[1], Some(record.state.position.y)),
        ] {
            assert!(close(found, expected), "{found:?} {expected:?} at {}", record.time);
        }
        check_wheels(found, expected);
    }
    // Without its last quarter it is read as far as it is there.
    let (part, notes) = read(&bytes[..3 * bytes.len() / 4], None).unwrap();
    assert!(part.len() > records.len() / 2 && part.len() < records.len(), "{}", part.len());
    // Of the last record some readings are missing.
    assert_eq!(part[..part.len() - 1], records[..part.len() - 1]);
    assert!(notes[0].contains("without its end"), "{notes:?}");
}

fn check_wheels(found: &TelemetryRecord, expected: &TelemetryRecord) {
    assert_eq!(found.wheels.len(), expected.wheels.len());
    for (found, expected) in found.wheels.iter().zip(&expected.wheels) {
        assert!(close(found.speed, expected.speed), "{found:?} {expected:?}");
        assert!(close(found.torque, expected.torque), "{found:?} {expected:?}");
        assert!(close(found.sinkage, expected.sinkage), "{found:?} {expected:?}");
    }
}
