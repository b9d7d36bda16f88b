//! Drives whose telemetry is off by one thing, replayed: that thing is named.

use crate::learn::twin::{Drive, Leg, scenario};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::learn::TelemetryRecord;
use grouser::studies::replay::{Cause, Replay, Replayer, Verdict};
use grouser::studies::simulated_telemetry::SensorModels;
use grouser::units::deg;
use grouser::vehicle::{roll_and_pitch, slope_and_yaw};

/// Slopes crossed at several headings.
const LEGS: [Leg; 6] = [
    (0.0, 0.0, 0.8),
    (5.0, 3.0, 0.8),
    (6.0, 40.0, 0.8),
    (8.0, -30.0, 0.8),
    (9.0, 5.0, 0.8),
    (4.0, 150.0, 0.8),
];

const MODEL: &str = "scenario.model=ishigami";

/// The telemetry of a drive over legs, with the rover and on the soil of settings.
fn telemetry(settings: &[&str], legs: &[Leg], seed: u64) -> Vec<TelemetryRecord> {
    let truth = scenario(&[&[MODEL], settings].concat());
    let sample = Sample { soil: truth.value.site.terrain.soil, theory: truth.value.theory };
    let mut drive = Drive::new(&truth, &sample);
    for leg in legs {
        drive.leg(*leg).expect("the rover drives there");
    }
    drive.seen(SensorModels::USUAL, seed)
}

fn replay(records: Vec<TelemetryRecord>) -> Replay {
    let assumed = scenario(&[MODEL]);
    let mut replayer = Replayer::new(&assumed.value, None);
    for record in records {
        replayer.update(record);
    }
    replayer.finish(&[], &|| true).unwrap().unwrap()
}

/// Roll and pitch with an error of the slope and yaw that they tell.
fn misread(records: &mut [TelemetryRecord], error: impl Fn([f64; 2]) -> [f64; 2]) {
    for record in records {
        if let (Some(roll), Some(pitch)) = (record.roll, record.pitch) {
            let [slope, yaw] = error(slope_and_yaw(roll, pitch));
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            (record.roll, record.pitch) = (Some(roll), Some(pitch));
        }
    }
}

/// The causes that are pointed to.
fn pointed(replay: &Replay) -> Vec<Cause> {
    let points = |it: &&grouser::studies::replay::Finding| it.verdict != Verdict::Nothing;
    let mut causes: Vec<Cause> =
        replay.findings.iter().filter(points).map(|it| it.parameter.cause()).collect();
    causes.dedup();
    causes
}

#[test]
fn explore() {
    for (name, settings) in [
        ("healthy", vec![]),
        ("healthy2", vec![]),
        ("soil shear", vec!["soil.shear.lateral_m=0.022", "soil.shear.longitudinal_m=0.05"]),
        ("soil friction", vec!["soil.friction_angle_deg=33"]),
        ("radius", vec!["wheel.radius_m=0.1155"]),
        ("slope", vec![]),
        ("yaw", vec![]),
        ("pitch", vec![]),
        ("rollpitch", vec![]),
        ("encoder", vec![]),
        ("torque", vec![]),
    ] {
        let seed = name.len() as u64;
        let mut records = telemetry(&settings, &LEGS, seed);
        match name {
            "slope" => misread(&mut records, |[slope, yaw]| [slope - deg(2.0), yaw]),
            "yaw" => misread(&mut records, |[slope, yaw]| [slope, yaw + deg(3.0)]),
            "pitch" => {
                records.iter_mut().for_each(|it| it.pitch = it.pitch.map(|it| it + deg(3.0)))
            }
            "encoder" => records
                .iter_mut()
                .flat_map(|it| &mut it.wheels)
                .for_each(|it| it.speed = it.speed.map(|it| it / 1.05)),
            "torque" => records
                .iter_mut()
                .flat_map(|it| &mut it.wheels)
                .for_each(|it| it.torque = it.torque.map(|it| it * 1.25)),
            _ => {}
        }
        let time = std::time::Instant::now();
        let found = replay(records);
        println!(
            "== {name} {:?} {} of {} stretches, {:?}, {:?}",
            time.elapsed(),
            found.explained_stretches,
            found.stretches.len(),
            pointed(&found),
            found.free_run.ended
        );
        for it in &found.findings {
            println!(
                "  {:?} {:.4} +- {:.4} share {:.3} lnB {:.1} {:?}",
                it.parameter, it.estimate, it.deviation, it.share, it.evidence, it.verdict
            );
        }
        for it in &found.channels {
            println!(
                "  {:?} n {} means {:.4?} bias {:.5} rms {:.5}",
                it.channel, it.count, it.means, it.bias, it.rms
            );
        }
    }
}
