//! Drives whose telemetry is off by one thing, replayed: that thing is named, and nothing where
//! nothing is off.

use crate::learn::drive::{Drive, Leg, scenario};
use grouser::document::LoadedScenario;
use grouser::document::columns::replay::sentences;
use grouser::simulation::Run;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::learn::TelemetryRecord;
use grouser::studies::replay::{
    Attribution, Cause, Channel, Finding, NothingToReplay, Parameter, Part, Replay, Replayer,
};
use grouser::studies::simulated_telemetry::{SensorModels, truth};
use grouser::units::deg;
use grouser::vehicle::{roll_and_pitch, slope_and_yaw};

/// Slopes crossed at several headings, 4.8 m.
const LEGS: [Leg; 6] = [
    (0.0, 0.0, 0.8),
    (5.0, 3.0, 0.8),
    (6.0, 40.0, 0.8),
    (8.0, -30.0, 0.8),
    (9.0, 5.0, 0.8),
    (4.0, 150.0, 0.8),
];
/// The same on slopes without level ground, which have a direction.
const SLOPES: [Leg; 5] = [LEGS[1], LEGS[2], LEGS[3], LEGS[4], LEGS[5]];
/// Steeper and longer, 12 m there and back: a yaw of the sensor turns a pull that is no more than
/// the slope's.
const STEEP: [Leg; 4] =
    [(14.0, 8.0, 3.0), (14.0, 172.0, 3.0), (12.0, 40.0, 3.0), (12.0, 140.0, 3.0)];

const MODEL: &str = "scenario.model=ishigami";

/// The telemetry of a drive over legs, with the rover and on the soil of settings.
fn telemetry(settings: &[&str], legs: &[Leg], models: SensorModels) -> Vec<TelemetryRecord> {
    let truth = scenario(&[&[MODEL], settings].concat());
    let sample = Sample { soil: truth.value.ground.soil, model: truth.value.model };
    driven(&settings_of(settings), &sample, legs, models, 11)
}

fn settings_of<'s>(settings: &[&'s str]) -> Vec<&'s str> {
    [&[MODEL], settings].concat()
}

fn driven(
    settings: &[&str],
    sample: &Sample,
    legs: &[Leg],
    models: SensorModels,
    seed: u64,
) -> Vec<TelemetryRecord> {
    let mut drive = Drive::new(&scenario(settings), sample);
    for leg in legs {
        drive.leg(*leg).expect("the rover drives there");
    }
    drive.seen(models, seed)
}

/// A replay with the rover and soil as they are documented.
fn replay(records: Vec<TelemetryRecord>) -> Replay {
    replay_with(&scenario(&[MODEL]), records, &[])
}

fn replay_with(
    assumed: &LoadedScenario,
    records: Vec<TelemetryRecord>,
    samples: &[Sample],
) -> Replay {
    let mut replayer = Replayer::new(&assumed.value, None);
    for record in records {
        replayer.update(record);
    }
    replayer.finish(samples, &|| true).unwrap().unwrap()
}

/// A replay of a part of a drive.
fn replay_part(
    records: &[TelemetryRecord],
    [from, to]: [f64; 2],
) -> Result<Replay, NothingToReplay> {
    let part = Part::new(Some(from), Some(to)).unwrap();
    let mut replayer = Replayer::new(&scenario(&[MODEL]).value, None).within(part);
    for record in records {
        replayer.update(record.clone());
    }
    Ok(replayer.finish(&[], &|| true)?.unwrap())
}

/// Telemetry whose roll and pitch tell another slope and yaw.
fn misread(
    mut records: Vec<TelemetryRecord>,
    error: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<TelemetryRecord> {
    for record in &mut records {
        if let (Some(roll), Some(pitch)) = (record.roll, record.pitch) {
            let [slope, yaw] = error(slope_and_yaw(roll, pitch));
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            (record.roll, record.pitch) = (Some(roll), Some(pitch));
        }
    }
    records
}

/// The causes that are pointed to, alone or with others.
fn pointed(replay: &Replay) -> Vec<Cause> {
    let points = |it: &&Finding| {
        matches!(it.verdict, Attribution::PointsTo | Attribution::Underdetermined(_))
    };
    let mut causes: Vec<Cause> =
        replay.findings.iter().filter(points).map(|it| it.parameter.cause()).collect();
    causes.dedup();
    causes
}

fn finding(replay: &Replay, parameter: Parameter) -> &Finding {
    replay.findings.iter().find(|it| it.parameter == parameter).unwrap()
}

/// One cause is named, and how far off it is: within three of its standard deviations.
fn check_named(replay: &Replay, parameter: Parameter, size: f64) {
    assert_eq!(pointed(replay), [parameter.cause()], "{:#?}", replay.findings);
    let found = finding(replay, parameter);
    assert_eq!(found.verdict, Attribution::PointsTo);
    assert!((found.estimate - size).abs() < 3.0 * found.deviation, "{found:?}");
    assert!(found.deviation < 0.4 * size, "{found:?}");
}

#[test]
fn where_nothing_is_off_nothing_is_pointed_to() {
    let nominal = scenario(&[MODEL]);
    let sample = Sample { soil: nominal.value.ground.soil, model: nominal.value.model };
    for (seed, outliers) in [(1, 0.0), (2, 0.0), (3, 0.05)] {
        let models = SensorModels { outliers, ..SensorModels::USUAL };
        let found = replay(driven(&[MODEL], &sample, &LEGS, models, seed));
        assert_eq!(pointed(&found), [], "{:#?}", found.findings);
        assert!(found.explained_stretches > 40, "{}", found.explained_stretches);
    }
}

/// A sensor of the attitude that slips halfway: each half of the drive is judged by itself, as if
/// the log had no other, and of too little nothing is said.
#[test]
fn a_part_of_a_drive_is_explained_by_itself() {
    let mut records = telemetry(&[], &LEGS, SensorModels::USUAL);
    let late = records.split_off(records.len() / 2);
    let half = late[0].time;
    records.extend(misread(late, |[slope, yaw]| [slope - deg(3.0), yaw]));
    let [start, end] = [records[0].time, records[records.len() - 1].time];
    let early = replay_part(&records, [start, half - 0.05]).unwrap();
    assert_eq!((pointed(&early), early.best_causes().len()), (Vec::new(), 0), "{early:#?}");
    let late = replay_part(&records, [half, end]).unwrap();
    let best = late.best_causes();
    assert_eq!(best[0].0, Cause::Slope, "{best:?}");
    assert!(best[0].1 > 0.3 && best.len() <= 3, "{best:?}");
    assert!(best.windows(2).all(|pair| pair[0].1 >= pair[1].1 - 0.1), "{best:?}");
    // The same records alone have the same answer.
    let alone = records.iter().filter(|it| it.time >= half).cloned().collect();
    let alone = Replay { part: late.part, ..replay(alone) };
    assert_eq!(alone, late);
    // One record has no stretch.
    let none = replay_part(&records, [half, half + 0.01]).unwrap_err();
    assert_eq!(none, NothingToReplay { records: 1 });
    assert!(none.to_string().starts_with("nothing can be told from 1 record:"));
    assert!(Part::new(Some(2.0), Some(2.0)).is_err());
}

/// A log of attitude and wheel speeds alone is compared with nothing: that is no agreement. With
/// torques the soil shows, and what odometry alone would show does not.
#[test]
fn what_nothing_was_read_of_cannot_be_told() {
    let records = telemetry(&[], &LEGS, SensorModels::USUAL);
    let without = |keeps_torques: bool| {
        let mut records = records.clone();
        for record in &mut records {
            record.displacement = [None; 2];
            record.position = [None; 2];
            (record.rotation, record.yaw) = (None, None);
            for wheel in &mut record.wheels {
                (wheel.sinkage, wheel.current) = (None, None);
                wheel.torque = wheel.torque.filter(|_| keeps_torques);
            }
        }
        replay(records)
    };
    let blind = without(false);
    assert!(blind.explained_stretches > 0 && !blind.findings.is_empty());
    for finding in &blind.findings {
        assert_eq!(finding.verdict, Attribution::CannotTell, "{finding:?}");
    }
    assert_eq!(
        sentences(&blind),
        [
            "cannot tell: the log has no velocities of the body, no yaw rate, no torques, no sinkages"
        ]
    );
    let by_torques = without(true);
    let verdict = |parameter| &finding(&by_torques, parameter).verdict;
    assert_eq!(*verdict(Parameter::Odometry), Attribution::CannotTell);
    assert_eq!(*verdict(Parameter::YawRate), Attribution::CannotTell);
    assert_eq!(*verdict(Parameter::Torque), Attribution::Nothing, "{:#?}", by_torques.findings);
    let said = sentences(&by_torques);
    assert!(said[0].contains("point to nothing"), "{said:?}");
    assert!(
        said[1].starts_with("cannot tell of ") && said[1].contains("as uncertain as before"),
        "{said:?}"
    );
}

/// Slip and torques are off together.
#[test]
fn another_soil_is_named() {
    let soft = ["soil.shear.lateral_m=0.022", "soil.shear.longitudinal_m=0.05"];
    let found = replay(telemetry(&soft, &LEGS, SensorModels::USUAL));
    assert_eq!(pointed(&found), [Cause::Soil], "{:#?}", found.findings);
}

/// The shearing radius is 0.11 m in the rover's document.
#[test]
fn wheels_that_are_5_percent_larger_are_named() {
    let found = replay(telemetry(&["wheel.radius_m=0.1055"], &LEGS, SensorModels::USUAL));
    check_named(&found, Parameter::Speed, 0.05);
}

#[test]
fn a_slope_that_is_2_degrees_steeper_is_named() {
    let records = telemetry(&[], &SLOPES, SensorModels::USUAL);
    let found = replay(misread(records, |[slope, yaw]| [slope - deg(2.0), yaw]));
    check_named(&found, Parameter::Slope, deg(2.0));
}

#[test]
fn a_sensor_that_is_mounted_3_degrees_off_is_named() {
    let records = || telemetry(&[], &LEGS, SensorModels::USUAL);
    let mut rolled = records();
    for record in &mut rolled {
        record.roll = record.roll.map(|roll| roll + deg(3.0));
    }
    check_named(&replay(rolled), Parameter::Roll, deg(3.0));
    let mut pitched = records();
    for record in &mut pitched {
        record.pitch = record.pitch.map(|pitch| pitch + deg(3.0));
    }
    check_named(&replay(pitched), Parameter::Pitch, deg(3.0));
    let mut seen_askew = records();
    for record in &mut seen_askew {
        if let [Some(forward), Some(leftward)] = record.displacement {
            let (sin, cos) = deg(3.0).sin_cos();
            let turned = [cos * forward + sin * leftward, cos * leftward - sin * forward];
            record.displacement = turned.map(Some);
        }
    }
    check_named(&replay(seen_askew), Parameter::Odometry, deg(3.0));
}

#[test]
fn a_sensor_that_is_turned_by_3_degrees_is_named_on_steep_slopes() {
    let records = telemetry(&[], &STEEP, SensorModels::USUAL);
    let found = replay(misread(records, |[slope, yaw]| [slope, yaw + deg(3.0)]));
    check_named(&found, Parameter::Yaw, deg(3.0));
}

/// Along the contour a slope that is steeper and a sensor with a roll do the same.
#[test]
fn what_a_drive_does_not_tell_apart_is_said() {
    let records = telemetry(&[], &[(8.0, 0.0, 1.5), (10.0, 0.0, 1.5)], SensorModels::USUAL);
    let found = replay(misread(records, |[slope, yaw]| [slope - deg(3.0), yaw]));
    let causes = pointed(&found);
    assert!(causes.contains(&Cause::Slope) && causes.contains(&Cause::RollMounting), "{causes:?}");
    let verdict = &finding(&found, Parameter::Slope).verdict;
    let Attribution::Underdetermined(rivals) = verdict else { panic!("{verdict:?}") };
    assert!(rivals.contains(&Cause::RollMounting), "{rivals:?}");
}

/// A run's own telemetry leads a free run over its way, and has its velocities and torques.
#[test]
fn a_run_replays_itself() {
    let run = [MODEL, "scenario.slope_deg=8", "scenario.start.yaw_deg=4", "scenario.duration_s=40"];
    let loaded = scenario(&run);
    let trajectory = Run::new(&loaded.value).unwrap().to_end().unwrap();
    let found = replay(truth(&trajectory, &loaded.value));
    let rms = |channel: Channel| {
        found.channels.iter().find(|it| it.channel == channel).map(|it| it.rms).unwrap()
    };
    assert!((found.free_run.slope - deg(8.0)).abs() < 1e-3, "{}", found.free_run.slope);
    // Means over a stretch of what changes little: a hundredth of a millimetre of 2.2 m of way.
    assert!(rms(Channel::X) < 1e-4 && rms(Channel::Y) < 1e-4, "{:?}", found.channels);
    assert!(rms(Channel::Yaw) < 1e-4, "{:?}", found.channels);
    assert!(rms(Channel::ForwardSpeed) < 1e-5 && rms(Channel::Torque(0)) < 1e-4);
    let [measured, predicted] = found.energy.unwrap();
    assert!((measured / predicted - 1.0).abs() < 1e-3, "{measured} {predicted}");
    assert_eq!(pointed(&found), []);
}

/// A soil drawn from an uncertain one is mostly within the bands over its samples; samples depend
/// on the seed alone.
#[test]
fn bands_hold_a_soil_of_the_prior() {
    let prior = scenario(&[MODEL, "scenario.soil=toyoura-uncertain"]);
    let inputs = BandInputs::of_scenario(&prior);
    let sample = inputs.sample(77, 3).unwrap();
    let settings = [MODEL, "scenario.soil=toyoura-uncertain"];
    let records = driven(&settings, &sample, &LEGS[1..3], SensorModels::PERFECT, 1);
    let samples = inputs.samples(5, 10).unwrap();
    let banded = || replay_with(&prior, records.clone(), &samples);
    let found = banded();
    for channel in [Channel::ForwardSpeed, Channel::LateralSpeed, Channel::Torque(1)] {
        let summary = found.channels.iter().find(|it| it.channel == channel).unwrap();
        assert!(summary.within.unwrap().estimate() > 0.6, "{summary:?}");
    }
    assert_eq!(found, banded());
}

/// Ten times the telemetry keeps no more stretches.
#[test]
fn memory_does_not_grow_with_the_drive() {
    let records = telemetry(&[], &LEGS, SensorModels::PERFECT);
    let span = records.last().unwrap().time;
    let mut replayer = Replayer::new(&scenario(&[MODEL]).value, None);
    for lap in 0..20_u32 {
        for record in &records {
            let time = record.time + f64::from(lap) * span;
            replayer.update(TelemetryRecord { time, ..record.clone() });
        }
    }
    let found = replayer.finish(&[], &|| true).unwrap().unwrap();
    assert!(found.taken.stretches > 800 && found.stretches.len() <= 400, "{:?}", found.taken);
    assert!(found.every >= 2 && found.stretches.len() >= 200);
}

#[test]
fn telemetry_without_wheel_speeds_is_refused() {
    let replayer = Replayer::new(&scenario(&[MODEL]).value, None);
    assert!(replayer.finish(&[], &|| true).is_err());
}
