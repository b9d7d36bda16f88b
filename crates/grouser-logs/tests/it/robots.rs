//! Logs of robots: signs, times, names of joints, and what is ambiguous.

use serde_json::{Value, json};

use super::container::{Container, Packed};
use super::*;

const SECOND: u64 = 1_000_000_000;

/// A rotation by the right-hand rule about an axis, as ROS writes it.
fn about(axis: &str, degrees: f64) -> Value {
    let (sin, cos) = (0.5 * degrees.to_radians()).sin_cos();
    let mut quaternion = json!({"x": 0.0, "y": 0.0, "z": 0.0, "w": cos});
    quaternion[axis] = sin.into();
    quaternion
}

fn header(seconds: f64) -> Value {
    let nanoseconds = (seconds.fract() * 1e9).round();
    json!({"stamp": {"sec": seconds.trunc(), "nanosec": nanoseconds}, "frame_id": "odom"})
}

fn bytes(value: &Value) -> Vec<u8> {
    serde_json::to_vec(value).unwrap()
}

/// A rover that leans, turns and goes on: an IMU, odometry and joints, each with its own times.
fn robot(packed: Packed) -> Container {
    let mut log = Container::begin(packed);
    let imu = log.channel("/imu/data", "sensor_msgs/msg/Imu");
    let odometry = log.channel("/odom", "nav_msgs/msg/Odometry");
    let joints = log.channel("/joint_states", "sensor_msgs/msg/JointState");
    let picture = log.channel("/camera", "sensor_msgs/msg/Image");
    log.message(picture, SECOND, &[0; 5000]);
    // Nose up is a negative rotation about y to the left; the right side down a positive one about
    // x.
    for (time, axis, degrees) in [(1.0, "y", -10.0), (2.0, "x", 5.0)] {
        let message = json!({"header": header(time), "orientation": about(axis, degrees),
            "orientation_covariance": [0.1, 0.0]});
        log.message(imu, 5 * SECOND, &bytes(&message));
    }
    let unknown = json!({"header": header(3.0), "orientation": about("x", 0.0), "orientation_covariance": [-1.0]});
    log.message(imu, 5 * SECOND, &bytes(&unknown));
    log.end_chunk();
    // Two metres along an axis that is 90° to the left, then a turn of 20° to the left on the spot.
    for (time, y, yaw) in [(1.0, 0.0, 90.0), (2.0, 2.0, 90.0), (3.0, 2.0, 110.0)] {
        let pose =
            json!({"position": {"x": 7.0, "y": y, "z": 0.0}, "orientation": about("z", yaw)});
        let message = json!({"header": header(time), "pose": {"pose": pose}});
        log.message(odometry, 5 * SECOND, &bytes(&message));
    }
    let message = json!({"header": header(2.0),
        "name": ["FL_steer", "front_left_wheel", "front-right wheel joint", "rear_left", "arm"],
        "position": [0.1, 1.0, 1.0, 1.0, 0.0], "velocity": [0.0, 0.5, 0.25, -0.5, 9.0], "effort": [0.0, 0.2, 0.1]});
    log.message(joints, 5 * SECOND, &bytes(&message));
    log
}

#[test]
fn signs_of_ros_become_ours_whatever_the_compression() {
    for packed in [Packed::Not, Packed::Zstd, Packed::Lz4] {
        let (records, notes) = read(&robot(packed).finish(), None).unwrap();
        assert_eq!(records.iter().map(|it| it.time).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
        let [first, second, third] = &records[..] else { panic!("three records") };
        let check = |found: Option<f64>, expected: f64| {
            let found = found.expect("it was read");
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}, {packed:?}");
        };
        check(first.pitch, 10_f64.to_radians());
        check(first.roll, 0.0);
        check(second.roll, 5_f64.to_radians());
        assert_eq!((third.roll, first.displacement), (None, [None; 2]));
        check(second.displacement[0], 2.0);
        check(second.displacement[1], 0.0);
        check(second.rotation, 0.0);
        check(third.rotation, 20_f64.to_radians());
        check(third.displacement[0], 0.0);
        check(second.wheels[place("front-left")].speed, 0.5);
        check(second.wheels[place("front-right")].speed, 0.25);
        check(second.wheels[place("rear-left")].speed, -0.5);
        check(second.wheels[place("front-left")].torque, 0.2);
        assert_eq!(second.wheels[place("rear-right")].speed, None);
        assert!(notes.iter().any(|it| it.contains("/joint_states without a field")), "{notes:?}");
        assert!(!notes.iter().any(|it| it.contains("damaged") || it.contains("end")), "{notes:?}");
    }
}

#[test]
fn a_mapping_says_units_signs_and_axes() {
    let mut log = Container::begin(Packed::Not);
    let channel = log.channel("/hk/FRONT_LEFT", "housekeeping");
    let pose = log.channel("/nav", "navigation");
    log.message(
        channel,
        SECOND,
        &bytes(&json!({"motor": [{"rpm": -60.0}], "sag": 1.5, "pitch": 0.1, "steer": 90})),
    );
    log.message(pose, SECOND, &bytes(&json!({"q": about("z", 10.0), "t": 1.0})));
    log.message(
        pose,
        SECOND + 400,
        &bytes(&json!({"q": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 0.0}})),
    );
    let mapping = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\nrow_interval_s = 0.1\n\
        [[reading]]\ntopic = \"/hk/{wheel}\"\nfield = \"motor[0].rpm\"\nunit = \"rpm\"\nsign = -1\nscale = 0.5\ncolumn = \"wheel_speed_rad_s_{wheel}\"\n\
        [[reading]]\ntopic = \"/hk/{wheel}\"\nfield = \"sag\"\nunit = \"cm\"\ncolumn = \"sinkage_mm_{wheel}\"\n\
        [[reading]]\ntopic = \"/hk/{wheel}\"\nfield = \"steer\"\naxes = \"ned\"\noffset = 1.0\ncolumn = \"steering_deg_{wheel}\"\n\
        [[reading]]\ntopic = \"/hk/front-left\"\nfield = \"pitch\"\nunit = \"rad\"\naxes = \"ros\"\ncolumn = \"pitch_deg\"\n\
        [[reading]]\nmessage = \"navigation\"\nattitude = \"q\"\naxes = \"ned\"\ncolumns = [\"yaw_deg\"]\n";
    let (records, notes) = read(&log.finish(), Some(mapping)).unwrap();
    let [record] = &records[..] else { panic!("one record: {records:?}") };
    let wheel = &record.wheels[place("front-left")];
    let close = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs() < 1e-12;
    assert!(close(wheel.speed, std::f64::consts::PI) && close(wheel.sinkage, 0.015));
    assert!(close(wheel.steering, (-89_f64).to_radians()) && close(record.pitch, -0.1));
    // A quaternion of zeros is damage, which is counted.
    assert!(close(record.yaw, (-10_f64).to_radians()), "{:?}", record.yaw);
    assert!(
        notes.iter().any(|it| it.starts_with("1 readings of /nav are no numbers or no rotations")),
        "{notes:?}"
    );
}

/// Messages of ROS 2 and ROS 1 as their recorders write them, of a robot that lost its power: all
/// that was written is read.
#[test]
fn messages_of_ros_are_read_to_the_end_of_a_log_that_is_cut() {
    let (types, separator) = ("builtin_interfaces/Time stamp\nfloat64 roll\n", "=".repeat(80));
    let types =
        format!("{types}{separator}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
    let log = |messages: &str, described: &str| {
        let mut log = Container::begin(Packed::Lz4);
        let channel = log.channel_of("/roll", "ours/msg/Roll", messages, (described, &types));
        for second in 1..61_u32 {
            let header: &[u8] = if messages == "cdr" { &[0, 1, 0, 0] } else { &[] };
            let stamp = [second.to_le_bytes(), [0; 4]].concat();
            let roll = f64::from(second).to_le_bytes();
            log.message(channel, SECOND, &[header, &stamp, &roll].concat());
            if second % 10 == 0 {
                log.end_chunk();
            }
        }
        log.message(channel, SECOND, &[0, 1, 0, 0, 1]);
        log
    };
    let mapping = ROLL.replacen("[[reading]]", "time = \"stamp\"\n[[reading]]", 1);
    for (messages, described) in [("cdr", "ros2msg"), ("ros1", "ros1msg")] {
        let whole = log(messages, described).finish_with_index();
        let (records, notes) = read(&whole, Some(&mapping)).unwrap();
        assert_eq!(records.len(), 60, "{notes:?}");
        let rolls = records.iter().map(|it| it.roll.unwrap().to_degrees() - it.time);
        assert!(rolls.into_iter().all(|away| away.abs() < 1e-9), "{records:?}");
        assert!(notes.iter().any(|it| it.starts_with("1 messages cannot be decoded")), "{notes:?}");
        let cut = log(messages, described).cut();
        let (records, notes) = read(&cut[..3 * cut.len() / 4], Some(&mapping)).unwrap();
        assert!((20..60).contains(&records.len()), "{}", records.len());
        assert!(notes.iter().any(|it| it.contains("without its end")), "{notes:?}");
    }
}

const ROLL: &str = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\n[[reading]]\ntopic = \"/roll\"\nfield = \"roll\"\ncolumn = \"roll_deg\"\n";

/// Times before the window has passed are put in order, those after it counted: stamps are not what
/// an index has.
#[test]
fn messages_out_of_order_are_put_in_order() {
    let mut log = Container::begin(Packed::Not);
    let channel = log.channel("/roll", "roll");
    for (place, time) in (1..).zip([1.0, 1.2, 1.1, 3.0, 0.5, 3.1]) {
        log.message(channel, place * SECOND, &bytes(&json!({"roll": 1.0, "stamp": time})));
    }
    let mapping = ROLL.replacen("[[reading]]", "time = \"stamp\"\n[[reading]]", 1);
    let (records, notes) = read(&log.finish(), Some(&mapping)).unwrap();
    let times: Vec<f64> = records.iter().map(|it| it.time).collect();
    assert_eq!(times, [1.0, 1.1, 1.2, 3.0, 3.1]);
    assert!(
        notes.iter().any(|it| it.starts_with("1 readings came more than 1 s too late")),
        "{notes:?}"
    );
}

#[test]
fn what_cannot_be_meant_is_an_error_that_names_the_choices() {
    let mut log = Container::begin(Packed::Not);
    for topic in ["/imu/left", "/imu/right"] {
        let channel = log.channel(topic, "sensor_msgs/Imu");
        let degrees = if topic.ends_with("left") { 3.0 } else { 4.0 };
        log.message(
            channel,
            SECOND,
            &bytes(&json!({"header": header(1.0), "orientation": about("x", degrees)})),
        );
    }
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("log.mcap");
    fs::write(&path, log.finish()).unwrap();
    let error = read_file(&path, None, &[]).unwrap_err();
    assert!(error.to_string().contains("/imu/left, /imu/right"), "{error}");
    assert_eq!(error.remedy(), Some(Remedy::Topic("sensor_msgs/Imu", "/imu/left")));
    let (records, _) = read_file(&path, None, &[("sensor_msgs/Imu", "/imu/right")]).unwrap();
    assert!((records[0].roll.unwrap() - 4_f64.to_radians()).abs() < 1e-12);

    let check = |topic: &str, message: &str, (encoding, schema), part: &str, remedy| {
        let mut log = Container::begin(Packed::Not);
        log.channel_of(topic, message, encoding, (schema, "module ours {};"));
        let error = read(&log.finish(), None).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
        assert_eq!(error.remedy(), Some(remedy));
    };
    let by_python = Remedy::Python;
    check(
        "/lidar",
        "sensor_msgs/PointCloud2",
        ("json", "jsonschema"),
        "none of its topics, which are /lidar (sensor_msgs/PointCloud2)",
        Remedy::Mapping,
    );
    let idl = "/imu are encoded as cdr with a schema in ros2idl";
    check("/imu", "sensor_msgs/msg/Imu", ("cdr", "ros2idl"), idl, by_python);
    let cbor = "/imu are encoded as cbor; JSON, Protocol";
    check("/imu", "sensor_msgs/Imu", ("cbor", ""), cbor, by_python);
    for (start, part, line) in [
        (&b"#ROSBAG V2.0\n"[..], "a bag of ROS 1", None),
        (b"SQLite format 3\0", "a bag of ROS 2", None),
        (b"FEA1\0\0\0\0", "Feather, version 1", Some("read_feather('LOG')")),
    ] {
        let error = read(start, None).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
        let is_meant = match error.remedy() {
            Some(Remedy::Parquet(found)) => line.is_some_and(|part| found.contains(part)),
            found => found == Some(by_python) && line.is_none(),
        };
        assert!(is_meant, "{error}: {:?}", error.remedy());
    }
}

/// Topic after topic, each in chunks of its own, or all in one: the index, and a chunk, have the
/// order of time.
#[test]
fn topics_may_be_written_one_after_another() {
    let log = |chunk: usize, is_indexed: bool| {
        let mut log = Container::begin(Packed::Zstd);
        let topics = ["/pitch", "/roll"].map(|topic| log.channel(topic, "angle"));
        for channel in topics {
            for (place, second) in (1..60).enumerate() {
                if place % chunk == chunk - 1 {
                    log.end_chunk();
                }
                log.message(channel, second * SECOND, &bytes(&json!({"angle": second})));
            }
        }
        if is_indexed { log.finish_with_index() } else { log.finish() }
    };
    let mapping = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\n[[reading]]\ntopic = \"/roll\"\nfield = \"angle\"\ncolumn = \"roll_deg\"\n[[reading]]\ntopic = \"/pitch\"\nfield = \"angle\"\ncolumn = \"pitch_deg\"\n";
    for (chunk, is_indexed) in [(7, true), (1000, true), (1000, false)] {
        let (records, notes) = read(&log(chunk, is_indexed), Some(mapping)).unwrap();
        let times: Vec<f64> = records.iter().map(|it| it.time).collect();
        assert_eq!(times, (1..60).map(f64::from).collect::<Vec<_>>(), "{chunk}, {notes:?}");
        assert!(records.iter().all(|it| it.roll.is_some() && it.roll == it.pitch), "{records:?}");
    }
}

/// A simulation whose clock begins at 0, recorded by a clock of today: messages without a stamp, and
/// the one of 0 s, take their place among the others.
#[test]
fn a_log_has_one_clock() {
    let mut log = Container::begin(Packed::Not);
    let imu = log.channel("/imu", "sensor_msgs/msg/Imu");
    let odometry = log.channel("/odom", "nav_msgs/msg/Odometry");
    let today = 1_700_000_000 * SECOND;
    for step in 0..40_i32 {
        let seconds = 0.1 * f64::from(step);
        let recorded = today + u64::from(step.unsigned_abs()) * SECOND / 10;
        let leans = json!({"header": header(seconds), "orientation": about("x", 5.0)});
        log.message(imu, recorded, &bytes(&leans));
        let pose =
            json!({"position": {"x": seconds, "y": 0.0, "z": 0.0}, "orientation": about("z", 0.0)});
        log.message(odometry, recorded + SECOND / 20, &bytes(&json!({"pose": {"pose": pose}})));
    }
    let (records, notes) = read(&log.finish(), None).unwrap();
    let places = |read: &dyn Fn(&TelemetryRecord) -> bool| -> Vec<f64> {
        records.iter().filter(|it| read(it)).map(|it| it.time).collect()
    };
    let leans = places(&|it| it.roll.is_some());
    assert_eq!(leans.len(), 40, "{notes:?}");
    // Rows have the time of the last reading within a tenth of a second.
    let is_near = |time: f64, step: i32| (-1e-6..0.06).contains(&(time - 0.1 * f64::from(step)));
    assert!(leans.iter().zip(0..).all(|(time, step)| is_near(*time, step)), "{leans:?}");
    let ways: Vec<f64> = records.iter().filter_map(|it| it.displacement[0]).collect();
    assert!(ways.len() == 39 && ways.iter().all(|way| (way - 0.1).abs() < 1e-9), "{ways:?}");
    let moved = places(&|it| it.displacement[0].is_some());
    assert!((moved[0] - 0.15).abs() < 1e-6 && !notes.iter().any(|it| it.contains("late")));
}

/// Speeds of a wheel, row by row.
fn speeds(records: &[TelemetryRecord], wheel: usize) -> Vec<Option<f64>> {
    records.iter().map(|it| it.wheels[wheel].speed).collect()
}

fn check_speeds(found: &[Option<f64>], expected: &[Option<f64>]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found_one, expected) in found.iter().zip(expected) {
        let away = found_one.zip(*expected).map_or(0.0, |(one, other)| (one - other).abs());
        let is_it = found_one.is_some() == expected.is_some() && away < 1e-9;
        assert!(is_it, "{found:?}");
    }
}

/// Joints with angles and no velocities: how far each turned since the row before, over the time
/// between the two, by the messages' own times.
#[test]
fn wheels_without_speeds_are_read_by_their_angles() {
    let mut log = Container::begin(Packed::Not);
    let joints = log.channel("/joint_states", "sensor_msgs/msg/JointState");
    let imu = log.channel("/imu", "sensor_msgs/msg/Imu");
    for (time, angle) in [(1.0, 6.0), (1.25, 6.5), (1.5, 6.25), (2.0, 6.25)] {
        let message = json!({"header": header(time), "name": ["front_left_wheel"],
            "position": [angle], "velocity": [], "effort": []});
        log.message(joints, SECOND, &bytes(&message));
        let leans = json!({"header": header(time + 0.03), "orientation": about("x", 5.0)});
        log.message(imu, SECOND, &bytes(&leans));
    }
    let (records, notes) = read(&log.finish(), None).unwrap();
    let found = speeds(&records, place("front-left"));
    check_speeds(&found, &[None, Some(2.0), Some(-1.0), Some(0.0)]);
    let of_front = |it: &String| it.starts_with("4 readings of /joint_states without a field");
    assert!(!notes.iter().any(of_front), "{notes:?}");
}

/// Ticks of an encoder that counts to 1000 and begins again, between a motor and a gear of 2, and
/// angles that begin again at a turn.
#[test]
fn ticks_and_turns_that_begin_again_go_on() {
    let mut log = Container::begin(Packed::Not);
    let wheels = log.channel("/wheels", "wheels");
    for (time, ticks, degrees) in [(0, 900, 350.0), (1, 50, 10.0), (2, 950, 340.0), (4, 0, 340.0)] {
        let message = json!({"ticks": ticks, "degrees": degrees});
        log.message(wheels, time * SECOND, &bytes(&message));
    }
    let mapping = mapping(
        "[[reading]]\ntopic = \"/wheels\"\nfield = \"ticks\"\nposition = true\nticks_per_turn = 100\nwrap_ticks = 1000\nscale = 0.5\nsign = -1\ncolumn = \"wheel_speed_rad_s_front-left\"\n\
         [[reading]]\ntopic = \"/wheels\"\nfield = \"degrees\"\nposition = true\nunit = \"deg\"\nwrap_rad = 6.283185307179586\ncolumn = \"wheel_speed_rad_s_rear-left\"\n",
    );
    let (records, _) = read(&log.finish(), Some(&mapping)).unwrap();
    let turn = std::f64::consts::TAU;
    let front = speeds(&records, place("front-left"));
    check_speeds(&front, &[None, Some(-0.75 * turn), Some(0.5 * turn), Some(-0.125 * turn)]);
    let rear = speeds(&records, place("rear-left"));
    check_speeds(&rear, &[None, Some(turn / 18.0), Some(-turn / 12.0), Some(0.0)]);
}

/// A velocity stands before an angle, message by message.
#[test]
fn an_angle_stands_in_where_there_is_no_velocity() {
    let mut log = Container::begin(Packed::Not);
    let joints = log.channel("/joint_states", "sensor_msgs/msg/JointState");
    for (time, velocity) in [(1.0, json!([7.0])), (2.0, json!([null])), (3.0, json!([]))] {
        let message = json!({"header": header(time), "name": ["front_left_wheel"],
            "position": [2.0 * time], "velocity": velocity});
        log.message(joints, SECOND, &bytes(&message));
    }
    let (records, _) = read(&log.finish(), None).unwrap();
    let found = speeds(&records, place("front-left"));
    check_speeds(&found, &[Some(7.0), None, Some(2.0)]);
}

/// A log has the names of joints; the rover keeps them beside its own, or has those of links.
#[test]
fn wheels_are_found_by_the_names_of_their_joints() {
    let of_joints = ["axle_7", "fl_roll", "front_left_wheel", "x"];
    let own = ["first", "second", "front_left_wheel_link", "x"];
    let joints = [Some("axle_7"), Some("fl_roll"), None, None];
    let mounts = rover().mounts().to_vec().into_iter().zip(own).zip(joints);
    let mounts = mounts.map(|((mount, name), joint)| grouser::vehicle::Mount {
        name: name.to_owned(),
        joint: joint.map(str::to_owned),
        ..mount
    });
    let rover = Rover::new(*rover().body(), mounts.collect()).unwrap();
    let mut log = Container::begin(Packed::Not);
    let channel = log.channel("/joint_states", "sensor_msgs/msg/JointState");
    let message =
        json!({"header": header(1.0), "name": of_joints, "velocity": [1.0, 2.0, 3.0, 4.0]});
    log.message(channel, SECOND, &bytes(&message));
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("log");
    fs::write(&path, log.finish()).unwrap();
    let (records, notes) = read_of(&rover, &path, None, &[], Some(Odometry::Visual)).unwrap();
    let found = records[0].wheels.iter().map(|it| it.speed.unwrap()).collect::<Vec<_>>();
    assert_eq!(found, [1.0, 2.0, 3.0, 4.0], "{notes:?}");
}

/// An orientation that nobody measured is none.
#[test]
fn an_identity_is_no_orientation() {
    let mut log = Container::begin(Packed::Not);
    let imu = log.channel("/imu", "sensor_msgs/msg/Imu");
    for (time, degrees) in [(1.0, 0.0), (2.0, 3.0), (3.0, 0.0)] {
        let message = json!({"header": header(time), "orientation": about("x", degrees)});
        log.message(imu, 5 * SECOND, &bytes(&message));
    }
    let (records, notes) = read(&log.finish(), None).unwrap();
    assert!(records.len() == 1 && records[0].time == 2.0, "{records:?}");
    let note = "2 readings of /imu are exactly the identity";
    assert!(notes.iter().any(|it| it.starts_with(note)), "{notes:?}");
}

/// What measured the way of a rover is stated, or the log is refused: the name of a topic says
/// nothing of it.
#[test]
fn odometry_is_stated_or_refused() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("log.mcap");
    fs::write(&path, robot(Packed::Not).finish()).unwrap();
    let error = read_measured(&path, None, &[], None).unwrap_err();
    for part in ["/odom", "mapping ros"] {
        assert!(error.to_string().contains(part), "{error}");
    }
    assert_eq!(error.remedy(), Some(Remedy::Odometry));
    let moves = |records: &[TelemetryRecord]| {
        records.iter().any(|it| it.displacement[0].is_some() || it.rotation.is_some())
    };
    let leans = |records: &[TelemetryRecord]| records.iter().any(|it| it.roll.is_some());
    for (name, odometry, _) in Odometry::ALL {
        let (records, notes) = read_measured(&path, None, &[], Some(odometry)).unwrap();
        assert_eq!(moves(&records), odometry != Odometry::Wheels, "{name}");
        assert!(leans(&records), "{name}");
        let is_noted = notes.iter().any(|it| it.contains("wheels"));
        assert_eq!(is_noted, matches!(odometry, Odometry::Wheels | Odometry::Fused), "{notes:?}");
    }
    // What the mapping states counts, and the option before it.
    let ours = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\ntime = \"header.stamp\"\n\
        odometry = \"wheels\"\nrow_interval_s = 0.1\n\
        [[reading]]\nmessage = \"nav_msgs/Odometry\"\npose = \"pose.pose\"\n\
        [[reading]]\nmessage = \"sensor_msgs/Imu\"\nattitude = \"orientation\"\n";
    let (records, _) = read_measured(&path, Some(ours), &[], None).unwrap();
    assert!(!moves(&records) && leans(&records));
    let (records, _) = read_measured(&path, Some(ours), &[], Some(Odometry::Visual)).unwrap();
    assert!(moves(&records));
}

/// A pose on a plane says nothing of how the ground leans.
#[test]
fn a_pose_on_a_plane_has_no_roll_and_no_pitch() {
    for (axis, expected) in [("z", None), ("x", Some(30_f64.to_radians()))] {
        let mut log = Container::begin(Packed::Not);
        let odometry = log.channel("/odom", "nav_msgs/msg/Odometry");
        let pose =
            json!({"position": {"x": 7.0, "y": 0.0, "z": 0.0}, "orientation": about(axis, 30.0)});
        let message = json!({"header": header(1.0), "pose": {"pose": pose}});
        log.message(odometry, 5 * SECOND, &bytes(&message));
        let read = read(&log.finish(), None);
        let Some(expected) = expected else {
            assert!(read.unwrap().1.iter().any(|it| it.contains("about the vertical alone")));
            continue;
        };
        let (records, _) = read.unwrap();
        assert!((records[0].roll.unwrap() - expected).abs() < 1e-12, "{records:?}");
    }
}
