//! Logs that are written, read back. The readers of others are asked in
//! `crates/grouser-python/tests/test_logs.py`; the one below reads just enough.

mod reader;

use std::collections::BTreeMap;
use std::error::Error;
use std::f64::consts::PI;
use std::io::{self, Write};
use std::iter;

use grouser::studies::mission::DrivenMission;
use grouser::studies::replay::Replayer;
use grouser::studies::simulated_telemetry::truth;
use grouser_core::mission::{Leg, Limited, Manoeuvre, Mission, Stop};
use grouser_core::paper;
use grouser_core::simulation::{Record, Run, Scenario, Trajectory};
use grouser_core::terrain::Ground;
use grouser_core::terrain::surface::{Ripple, Surface};
use grouser_core::units::{Vec2, Vec3, deg};
use grouser_core::vehicle::{Battery, Motor, Mount, Rover, Winding};
use grouser_draw::motion::Follower;
use grouser_draw::rover::PlacedWheel;
use grouser_logs::{Level, Log, LogError, write_replay};
use reader::{Message, Summary};

use super::wire::{Encoded, Encoding};

type Outcomes = Result<(), Box<dyn Error>>;

fn run_of(scenario: &Scenario) -> Trajectory {
    Run::new(scenario).and_then(Run::to_end).expect("a run")
}

fn short() -> Scenario {
    Scenario { duration: 2.0, ..paper::traverse().expect("a scenario") }
}

fn log_of(scenario: &Scenario, records: &[Record]) -> Result<Vec<u8>, LogError> {
    let mut log = Log::begin(Vec::new(), "a run", scenario)?;
    log.append(records)?;
    log.finish()
}

/// The values of a message with the numbers of their fields, in the order of the numbers.
fn fields(bytes: &[u8]) -> Vec<(u64, Encoded<'_>)> {
    let mut rest = Encoding(bytes);
    let next = || rest.next().expect("a message");
    let mut all: Vec<_> = iter::from_fn(next).collect();
    all.sort_by_key(|(number, _)| *number);
    all
}

fn inner(bytes: &[u8], number: u64) -> Vec<Vec<u8>> {
    let found = fields(bytes).into_iter().filter(|(known, _)| *known == number);
    let bytes = |value| if let Encoded::Bytes(bytes) = value { bytes } else { &[] };
    found.map(|(_, value)| bytes(value).to_vec()).collect()
}

fn text(bytes: &[u8], number: u64) -> String {
    String::from_utf8(inner(bytes, number).concat()).expect("a text")
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    let double = |(_, value)| match value {
        Encoded::Eight(bytes) => Some(f64::from_le_bytes(bytes)),
        _ => None,
    };
    fields(bytes).into_iter().filter_map(double).collect()
}

/// The messages of a topic with their times [ns].
fn messages(file: &[u8], topic: &str) -> Vec<(u64, Vec<u8>)> {
    let all = reader::messages(file).into_iter().filter(|it| it.topic == topic);
    all.map(|it| (it.time, it.data)).collect()
}

fn counts(file: &[u8]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for Message { topic, .. } in reader::messages(file) {
        *counts.entry(topic).or_insert(0) += 1;
    }
    counts
}

#[test]
fn every_record_is_a_message_of_rover_wheels_and_transforms() -> Outcomes {
    let scenario = short();
    let run = run_of(&scenario);
    let file = log_of(&scenario, &run.records)?;
    let counts = counts(&file);
    let count = run.records.len();
    assert_eq!(count, 21);
    for topic in ["/rover", "/tf", "/scene/forces"] {
        assert_eq!(counts[topic], count, "{topic}");
    }
    for mount in scenario.rover.mounts() {
        assert_eq!(counts[&format!("/wheels/{}", mount.name)], count);
    }
    for topic in ["/tf_static", "/robot_description", "/scene/rover"] {
        assert_eq!(counts[topic], 1, "{topic}");
    }
    for ((time, message), record) in messages(&file, "/rover").iter().zip(&run.records) {
        let numbers = doubles(message);
        assert_eq!(numbers[..3], [record.time, record.state.position.x, record.state.position.y]);
        assert_eq!(numbers[3], record.state.yaw.to_degrees());
        assert!((*time as f64 - 1e9 * record.time).abs() <= 0.5);
    }
    for (place, mount) in scenario.rover.mounts().iter().enumerate() {
        let topic = format!("/wheels/{}", mount.name);
        for ((_, message), record) in messages(&file, &topic).iter().zip(&run.records) {
            let numbers = doubles(message);
            let wheel = &record.wheels[place];
            assert_eq!(numbers[..2], [wheel.wheel_speed, wheel.reaction.slip.ratio]);
            assert_eq!(numbers[5], 1e3 * wheel.reaction.settled.sinkage);
        }
    }
    let summary = Summary::of(&file);
    assert_eq!(summary.statistics.messages, counts.values().sum::<usize>() as u64);
    assert_eq!([summary.statistics.first, summary.statistics.last], [0, 2_000_000_000]);
    let wheel = summary.metadata("/wheels/front-left");
    assert_eq!(wheel["sinkage_mm"], "Sinkage of the grouser tips [mm]");
    assert_eq!(wheel["wheel"], "front-left");
    Ok(())
}

/// A replayed drive has both sides under the same names, with the times of the telemetry.
#[test]
fn a_replay_is_logged_measured_beside_predicted() -> Outcomes {
    let scenario = Scenario { duration: 10.0, ..paper::traverse()? };
    let mut replayer = Replayer::new(&scenario, None);
    for record in truth(&run_of(&scenario), &scenario) {
        replayer.update(record);
    }
    let replay = replayer.finish(&[], &|| true)?.ok_or("it was not stopped")?;
    let documents = [("scenario.toml".to_owned(), b"slope_deg = 10".to_vec())];
    let file = write_replay(Vec::new(), "a drive", (&replay, &scenario.rover), &documents)?;
    let summary = Summary::of(&file);
    for side in ["measured", "predicted"] {
        for topic in ["motion", "power", "pose", "wheels/front-left", "wheels/rear-right"] {
            let topic = format!("/{side}/{topic}");
            let found = messages(&file, &topic);
            assert_eq!(found.len(), replay.stretches.len(), "{topic}");
            assert_eq!(doubles(&found[0].1).len(), summary.metadata(&topic).len(), "{topic}");
        }
    }
    let speed = |side: &str| doubles(&messages(&file, &format!("/{side}/motion"))[3].1)[0];
    let value = &replay.stretches[3].values[0];
    assert_eq!(Some(speed("measured")), value.measured);
    assert_eq!(Some(speed("predicted")), value.predicted);
    Ok(())
}

/// Each frame in its parent, in the order of the message: place and quaternion (x, y, z, w).
fn transforms(message: &[u8]) -> Vec<([String; 2], Vec3, [f64; 4])> {
    let of = |it: &Vec<u8>| {
        let place = doubles(&inner(it, 4).concat());
        let turn = doubles(&inner(it, 5).concat());
        let turn = [turn[0], turn[1], turn[2], turn[3]];
        ([text(it, 2), text(it, 3)], Vec3::new(place[0], place[1], place[2]), turn)
    };
    inner(message, 1).iter().map(of).collect()
}

/// v' = v + 2 w (u × v) + 2 u × (u × v), with q = (u, w).
fn turned([x, y, z, w]: [f64; 4], v: Vec3) -> Vec3 {
    let u = Vec3::new(x, y, z);
    let across = u.cross(&v);
    v + 2.0 * w * across + 2.0 * u.cross(&across)
}

/// Six wheels, four of them steered; names that readers could take for something else.
fn six() -> Rover {
    let four = paper::hakuto().expect("a rover");
    let unit = four.mounts()[0].unit;
    let names = ["body", "a b", "a/b", "räder<&>", "front-left", "front-left_rim"];
    let mounts = names.iter().enumerate().map(|(place, name)| {
        let (row, side) = (place / 2, if place % 2 == 0 { 1.0 } else { -1.0 });
        let x = 0.25 * (1.0 - row as f64);
        let steering = side * deg(10.0) * (1.0 - row as f64);
        Mount {
            name: (*name).into(),
            joint: None,
            position: Vec3::new(x, 0.24 * side, -0.06),
            unit,
            steering,
            steering_axis: None,
        }
    });
    Rover::new(*four.body(), mounts.collect()).expect("a rover")
}

const MOTOR: Motor = Motor {
    resistance: 10.0,
    torque_constant: 0.01,
    gear_ratio: 250.0,
    efficiency: 0.6,
    friction: 1e-3,
    is_self_locking: false,
    feeds_back: false,
    control: None,
    winding: None,
};

/// What motors take stands behind the other numbers: of wheels where all have a motor, of the rover
/// where one has.
#[test]
fn what_motors_take_is_logged() -> Outcomes {
    for (place, has_all) in [(None, true), (Some(2), false)] {
        let mut parts = paper::hakuto().expect("a rover").parts().clone();
        match place {
            None => parts.wheel_unit.motor = Some(MOTOR),
            Some(place) => parts.mounts[place].motor = Some(MOTOR),
        }
        let rover = Rover::draft(parts).checked().expect("a rover");
        let scenario = Scenario { rover, ..short() };
        let run = run_of(&scenario);
        let file = log_of(&scenario, &run.records)?;
        let last = |topic: &str| {
            let all = messages(&file, topic);
            doubles(&all.last().expect("a record").1)
        };
        let end = run.last();
        assert_eq!(last("/rover").last(), Some(&end.energy.electrical));
        let wheel = last("/wheels/rear-right");
        let power = end.wheels[2].electrical.expect("a motor").power;
        assert_eq!(wheel.last() == Some(&power), has_all);
    }
    Ok(())
}

/// The battery has a topic of its own, and each wheel how warm its motor is.
#[test]
fn battery_and_windings_are_logged() -> Outcomes {
    let winding = Winding {
        thermal_resistance: 20.0,
        heat_capacity: 2.0,
        surroundings: 20.0,
        highest: 125.0,
        derated_from: None,
    };
    let battery = Battery {
        capacity: 72e3,
        full_voltage: 8.4,
        empty_voltage: 6.4,
        resistance: 0.3,
        cutoff_voltage: 5.5,
        electronics: 3.0,
        charge: 0.9,
    };
    let mut parts = paper::hakuto().expect("a rover").parts().clone();
    parts.wheel_unit.motor = Some(Motor { winding: Some(winding), ..MOTOR });
    parts.battery = Some(battery);
    let rover = Rover::draft(parts).checked().expect("a rover");
    let scenario = Scenario { rover, ..short() };
    let run = run_of(&scenario);
    let file = log_of(&scenario, &run.records)?;
    let all = messages(&file, "/rover/battery");
    assert_eq!(all.len(), run.records.len());
    for ((time, message), record) in all.iter().zip(&run.records) {
        let seen = record.battery.expect("a battery");
        let expected = [seen.terminals.voltage, seen.terminals.current, seen.charge];
        assert_eq!(doubles(message), expected);
        assert!((*time as f64 - 1e9 * record.time).abs() <= 0.5);
    }
    let metadata = Summary::of(&file).metadata("/rover/battery");
    assert_eq!(metadata["battery_voltage_v"], "Voltage at the battery's terminals [V]");
    for (place, mount) in scenario.rover.mounts().iter().enumerate() {
        let wheels = messages(&file, &format!("/wheels/{}", mount.name));
        for ((_, message), record) in wheels.iter().zip(&run.records) {
            let wheel = &record.wheels[place];
            let taken = wheel.electrical.expect("a motor");
            let numbers = doubles(message);
            let [current, voltage, power, temperature] = *numbers.last_chunk().expect("four");
            assert_eq!([current, voltage, power], [taken.current, taken.voltage, taken.power]);
            assert_eq!(Some(temperature), wheel.temperature);
        }
    }
    Ok(())
}

/// The way from the slope to each hub by transforms, and by what the pictures draw.
#[test]
fn transforms_lead_to_the_wheels_of_the_pictures() -> Outcomes {
    let scenario = Scenario { rover: six(), ..short() };
    let run = run_of(&scenario);
    let file = log_of(&scenario, &run.records)?;
    let all = messages(&file, "/tf");
    assert_eq!(all.len(), run.records.len());
    let mut follower = Follower::new(&scenario.rover);
    for ((_, message), record) in all.iter().zip(&run.records) {
        let pose = follower.pose(&scenario, record);
        let transforms = transforms(message);
        assert_eq!(transforms.len(), 13);
        let ([parent, child], centre, yaw) = &transforms[0];
        assert_eq!([parent.as_str(), child], ["slope", "body"]);
        for (place, mount) in scenario.rover.mounts().iter().enumerate() {
            let placed = PlacedWheel::of(mount, &pose.wheels[place], &pose, Vec3::zeros());
            let ([parent, frame], hub, steering) = &transforms[1 + 2 * place];
            let ([in_frame, _], none, rolling) = &transforms[2 + 2 * place];
            assert_eq!((parent.as_str(), in_frame), ("body", frame));
            let hub = centre + turned(*yaw, *hub);
            assert!((hub - placed.hub).norm() < 1e-12, "{hub} {}", placed.hub);
            let forward = turned(*yaw, turned(*steering, Vec3::x()));
            assert!((forward - placed.forward).norm() < 1e-12);
            assert_eq!(*none, Vec3::zeros());
            // What was on top has gone forward.
            let top = turned(*rolling, Vec3::z());
            let angle = pose.wheels[place].turned;
            assert!((top - Vec3::new(angle.sin(), 0.0, angle.cos())).norm() < 1e-12);
        }
    }
    let last = transforms(&all[all.len() - 1].1);
    assert!(last[2].2[1] > 0.1, "the wheels have turned");
    Ok(())
}

/// On ground with heights the body leans, its hubs are a wheel's radius over the ground less what
/// they sink, and the map's frame has the map's coordinates.
#[test]
fn transforms_lead_to_the_ground_of_a_map() -> Outcomes {
    let ripple = Ripple { amplitude: 0.03, wavelength: 1.0, across: 0.3, phase: 0.0 };
    let surface = Surface::Ripple(ripple);
    let mut scenario = short();
    let start = Vec2::new(1234.5, -77.0);
    scenario.ground = Ground::formula(scenario.ground.soil, surface).starting_at(start);
    let run = run_of(&scenario);
    let file = log_of(&scenario, &run.records)?;
    let base = surface.height(start);
    let fixed = transforms(&messages(&file, "/tf_static")[0].1);
    assert_eq!(fixed[0].0, ["world", "map"]);
    assert!((fixed[0].1 + start.push(base)).norm() < 1e-6, "{}", fixed[0].1);
    for ((_, message), record) in messages(&file, "/tf").iter().zip(&run.records) {
        let all = transforms(message);
        let ([parent, child], centre, leaning) = &all[0];
        assert_eq!([parent.as_str(), child], ["world", "body"]);
        let standing = record.standing().expect("it stands");
        assert!((turned(*leaning, Vec3::x()).z - standing.pitch.sin()).abs() < 1e-12);
        for (place, mount) in scenario.rover.mounts().iter().enumerate() {
            let hub = centre + turned(*leaning, all[1 + 2 * place].1);
            let under = surface.height(start + hub.xy()) - base;
            let sinkage = record.wheels[place].reaction.settled.sinkage;
            // But for the slope under it, by whose cosine the way straight down is longer, and the
            // bend of its footprint.
            let gap = hub.z - under - (mount.shearing_radius() - sinkage);
            assert!((-3e-3..6e-3).contains(&gap), "{gap}");
        }
    }
    assert_eq!(messages(&file, "/rover/standing").len(), run.records.len());
    assert!(!messages(&file, "/scene/ground").is_empty());
    Ok(())
}

/// Messages have the belly clearance of a rover whose document says it, and none of another's.
#[test]
fn a_log_has_the_belly_clearance_where_that_is_known() -> Outcomes {
    let mut scenario = short();
    let surface =
        Surface::Ripple(Ripple { amplitude: 0.03, wavelength: 1.0, across: 0.3, phase: 0.0 });
    scenario.ground = Ground::formula(scenario.ground.soil, surface);
    for (clearance, fields) in [(None, 4), (Some(0.2), 5)] {
        scenario.rover.parts_mut().belly_clearance = clearance;
        scenario.rover = scenario.rover.clone().checked()?;
        let run = run_of(&scenario);
        let file = log_of(&scenario, &run.records)?;
        let standing = messages(&file, "/rover/standing");
        assert_eq!(standing.len(), run.records.len());
        // Each field is a tag of a byte and a number of eight.
        assert!(standing.iter().all(|(_, message)| message.len() == 9 * fields));
        let last = standing.last().expect("a message").1.last_chunk::<8>().expect("a number");
        let belly = run.last().belly_clearance;
        assert!(belly.is_none_or(|belly| f64::from_le_bytes(*last) == belly));
    }
    Ok(())
}

#[test]
fn names_of_frames_are_plain_and_differ_and_the_model_has_them() -> Outcomes {
    let scenario = Scenario { rover: six(), ..short() };
    let file = log_of(&scenario, &run_of(&scenario).records)?;
    let transforms = transforms(&messages(&file, "/tf")[0].1);
    let mut frames: Vec<String> = transforms.iter().map(|it| it.0[1].clone()).collect();
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
    assert!(frames.iter().all(|frame| frame.chars().all(plain)), "{frames:?}");
    let (_, model) = &messages(&file, "/robot_description")[0];
    assert_eq!(model[..4], [0, 1, 0, 0]);
    let size = u32::from_le_bytes(model[4..8].try_into()?) as usize;
    assert_eq!((model.len(), model.last()), (8 + size, Some(&0)));
    let model = String::from_utf8(model[8..model.len() - 1].into())?;
    let model = roxmltree::Document::parse(&model)?;
    let links = model.descendants().filter(|node| node.has_tag_name("link"));
    let links: Vec<&str> = links.filter_map(|node| node.attribute("name")).collect();
    assert_eq!(links, frames);
    frames.sort();
    frames.dedup();
    assert_eq!(frames.len(), 13);
    // The wheels' own names are kept.
    let summary = Summary::of(&file);
    let has =
        |own: &str| summary.channels.iter().flat_map(|it| &it.metadata).any(|(_, it)| it == own);
    assert!(scenario.rover.mounts().iter().all(|mount| has(&mount.name)));
    Ok(())
}

/// What is appended record by record is written as if it came at once, in chunks that a reader
/// finds.
#[test]
fn a_long_log_is_written_in_pieces() -> Outcomes {
    let scenario = short();
    let run = run_of(&scenario);
    let mut records = run.records.clone();
    for round in 1..60 {
        let later = |record: &Record| {
            let time = record.time + f64::from(round) * 2.1;
            Record { time, ..record.clone() }
        };
        records.extend(run.records.iter().map(later));
    }
    let file = log_of(&scenario, &records)?;
    let mut log = Log::begin(Vec::new(), "a run", &scenario)?;
    for batch in records.chunks(7) {
        log.append(batch)?;
    }
    assert!(log.finish()? == file, "batches make no difference");
    assert_eq!(counts(&file)["/rover"], records.len());
    let summary = Summary::of(&file);
    assert!(summary.chunks.len() > 2, "{}", summary.chunks.len());
    // The index leads to a chunk, and the chunk's to its messages.
    let last = summary.chunks.last().expect("a chunk");
    let found = summary.messages(last, &file);
    assert!(found.len() > 10, "{}", found.len());
    let ends = [found.iter().map(|it| it.time).min(), found.iter().map(|it| it.time).max()];
    assert_eq!(ends, [Some(last.first), Some(last.last)]);
    Ok(())
}

/// No wheel turns by more than a radian between two transforms, however far apart records are.
#[test]
fn fast_wheels_have_transforms_between_records() -> Outcomes {
    let scenario = short();
    let mut records: Vec<Record> = run_of(&scenario).records.into_iter().step_by(10).collect();
    for record in &mut records {
        record.wheels.iter_mut().for_each(|wheel| wheel.wheel_speed = 8.0);
    }
    let file = log_of(&scenario, &records)?;
    let angles: Vec<f64> = messages(&file, "/tf")
        .iter()
        .map(|(_, message)| {
            let [_, y, _, w] = transforms(message)[2].2;
            2.0 * y.atan2(w)
        })
        .collect();
    assert!(angles.len() > 2 * records.len());
    for pair in angles.windows(2) {
        let step = (pair[1] - pair[0] + PI).rem_euclid(2.0 * PI) - PI;
        assert!((0.0..1.0 + 1e-9).contains(&step.abs()), "{step}");
    }
    assert_eq!(counts(&file)["/rover"], records.len());
    Ok(())
}

#[test]
fn a_rover_that_tips_over_has_no_wheels_in_its_last_record() -> Outcomes {
    let scenario = short();
    let mut records = run_of(&scenario).records;
    records.last_mut().expect("a record").wheels.clear();
    let file = log_of(&scenario, &records)?;
    let counts = counts(&file);
    assert_eq!(counts["/wheels/front-left"], records.len() - 1);
    assert_eq!(counts["/tf"], records.len());
    let forces = messages(&file, "/scene/forces");
    let arrows =
        |message: &[u8]| inner(message, 2).iter().map(|it| inner(it, 7).len()).sum::<usize>();
    assert_eq!([arrows(&forces[0].1), arrows(&forces[forces.len() - 1].1)], [4, 0]);
    Ok(())
}

/// One record, and none at all.
#[test]
fn the_shortest_logs_can_be_read() -> Outcomes {
    let scenario = short();
    let records = run_of(&scenario).records;
    assert_eq!(counts(&log_of(&scenario, &records[..1])?)["/tf"], 1);
    assert_eq!(counts(&log_of(&scenario, &[])?)["/tf_static"], 1);
    Ok(())
}

#[test]
fn what_a_log_cannot_have_is_an_error() {
    let scenario = short();
    let records = run_of(&scenario).records;
    for value in [f64::NAN, f64::INFINITY] {
        let mut broken = records.clone();
        broken[3].wheels[1].reaction.settled.sinkage = value;
        let error = log_of(&scenario, &broken).expect_err("no number").to_string();
        let expected = format!("sinkage_mm of rear-left is {value} at 0.3");
        assert!(error.starts_with(&expected), "{error}");
        broken = records.clone();
        broken[3].time = value;
        assert!(matches!(
            log_of(&scenario, &broken),
            Err(LogError::NotFinite { name: "time_s", .. })
        ));
    }
    let mut turned_round = records;
    turned_round.reverse();
    assert!(matches!(log_of(&scenario, &turned_round), Err(LogError::OutOfOrder { .. })));
    let mut log = Log::begin(Vec::new(), "", &scenario).expect("a log");
    for time in [-1.0, f64::NAN, 1e11] {
        assert!(matches!(log.event(time, Level::Info, "", ""), Err(LogError::NoTime { .. })));
    }
}

/// A disk that is full after some bytes.
#[derive(Debug)]
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error() -> Outcomes {
    let scenario = short();
    let mut log = Log::begin(Full(10_000), "a run", &scenario)?;
    log.append(&run_of(&scenario).records)?;
    assert!(matches!(log.finish(), Err(LogError::Write(_))));
    Ok(())
}

#[test]
fn a_mission_says_what_becomes_of_its_legs() -> Outcomes {
    let limit = Stop::above(Limited::Time, 2.0);
    let legs = vec![
        Leg::new(Manoeuvre::drive(0.1)),
        Leg { stops: vec![limit], ..Leg::new(Manoeuvre::Turn { angle: deg(90.0) }) },
    ];
    let mission = Mission { scenario: short(), legs, stops: Vec::new(), sensors: None };
    let driven = DrivenMission::drive("", &mission)?;
    let records = driven.report.trajectory.records.len();
    let mut log = Log::begin(Vec::new(), "a mission", &mission.scenario)?;
    log.mission(&driven)?;
    let file = log.finish()?;
    assert_eq!(counts(&file)["/rover"], records);
    let events: Vec<(String, String)> =
        messages(&file, "/events").iter().map(|(_, it)| (text(it, 4), text(it, 3))).collect();
    let (flags, events): (Vec<_>, Vec<_>) =
        events.into_iter().partition(|(name, _)| name == "validity");
    let mut names: Vec<&str> = flags.iter().filter_map(|it| it.1.split(':').next()).collect();
    names.sort_unstable();
    names.dedup();
    // Each flag is raised once.
    assert!(names.len() == flags.len() && names.contains(&"slip-outside"), "{flags:?}");
    let begins = |place: usize, from: &str, words: &str| {
        let (name, text) = &events[place];
        assert!(name == from && text.starts_with(words), "{name}: {text}");
    };
    begins(0, "leg 1", "began: drive 0.1 m");
    begins(1, "leg 1", "completed; 0.1");
    begins(2, "leg 2", "began: turn 90° left");
    begins(3, "leg 2", "stopped: not done within 2 s, after");
    begins(4, "mission", "stopped");
    Ok(())
}
