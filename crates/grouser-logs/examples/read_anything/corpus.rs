//! What is damaged: short files of every kind, most of which the program's own cases have too.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::container::{Container, Packed};

/// A file of the program's cases.
macro_rules! case {
    ($name:literal) => {
        include_str!(concat!("../../../../xtask/src/fuzz/corpus/", $name))
    };
}

pub(crate) const SAMPLED_SOIL: &str = case!("sampled.toml");
pub(crate) const SAMPLES: &str = case!("samples.csv");
pub(crate) const SCENARIOS: [&str; 2] = [case!("scenario.toml"), case!("cone.toml")];
pub(crate) const LIMITS: &str = case!("limits.toml");
pub(crate) const SETTINGS: &str = case!("settings.txt");
pub(crate) const LEGS: &str = case!("legs.csv");
pub(crate) const PLACES: &str = case!("places.geojson");
pub(crate) const LINE: &str = case!("line.geojson");
pub(crate) const ZONES: &str = case!("zones.geojson");
pub(crate) const POINTS: &str = case!("points.xyz");
pub(crate) const POINTS_OF_CLASSES: &str = case!("classes.xyz");
pub(crate) const WHEEL_TESTS: &str = case!("wheel_tests.csv");
pub(crate) const SLOPE_TESTS: &str = case!("climbs.csv");
pub(crate) const PLATE_TESTS: &str = case!("plates.csv");
pub(crate) const SHEAR_TESTS: &str = case!("shear.csv");
pub(crate) const MOTOR_LOG: &str = case!("motor_log.csv");
pub(crate) const OTHER_TABLE: &str = case!("lab.csv");
pub(crate) const DRIVE: &str = case!("drive.csv");
pub(crate) const PLOTTED: &str = case!("plotted.csv");
pub(crate) const ROBOT: &str = case!("robot.urdf");
/// `ENDING` stands for the ending of a mesh.
pub(crate) const ROBOT_OF_MESHES: &str = case!("cart.urdf");
pub(crate) const OBJ: &str = case!("wheel.obj");
pub(crate) const COLLADA: &str = case!("wheel.dae");

/// A mapping for [`mcap_of_ros`].
pub(crate) const ROLL: &str = "schema = \"telemetry-mapping/1\"\nname = \"ours\"\ntime = \"stamp\"\n\
    [[reading]]\ntopic = \"/roll\"\nfield = \"roll\"\ncolumn = \"roll_deg\"\n";

/// A wheel of radius 1 and width 0.8 as STL, as bytes and as text.
pub(crate) fn stl() -> Vec<Vec<u8>> {
    let corners: [[f32; 3]; 6] = [
        [1.0, -0.4, 0.0],
        [0.0, -0.4, 1.0],
        [-1.0, 0.4, 0.0],
        [0.0, 0.4, -1.0],
        [1.0, 0.4, 0.0],
        [-1.0, -0.4, 0.0],
    ];
    let mut bytes = vec![b' '; 80];
    bytes.extend(2_u32.to_le_bytes());
    let mut text = String::from("solid wheel\n");
    for triangle in corners.chunks(3) {
        bytes.extend([0; 12]);
        text += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in triangle {
            bytes.extend([x, y, z].iter().flat_map(|it| it.to_le_bytes()));
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        bytes.extend([0; 2]);
        text += "endloop\nendfacet\n";
    }
    vec![bytes, (text + "endsolid wheel\n").into_bytes()]
}

/// Heights as NumPy writes them, in bytes of either order.
pub(crate) fn arrays() -> Vec<Vec<u8>> {
    vec![
        array("<f4", "False", |cell| (0.05 * f32::from(cell)).to_le_bytes().to_vec()),
        array(">f8", "True", |cell| (0.05 * f64::from(cell)).to_be_bytes().to_vec()),
    ]
}

/// Class numbers as NumPy writes them.
pub(crate) fn array_of_classes() -> Vec<u8> {
    array("|u1", "False", |cell| vec![cell % 3])
}

/// Five rows of four.
fn array(kind: &str, is_fortran: &str, cell: fn(u8) -> Vec<u8>) -> Vec<u8> {
    let header =
        format!("{{'descr': '{kind}', 'fortran_order': {is_fortran}, 'shape': (5, 4), }}\n");
    let mut array = b"\x93NUMPY\x01\0".to_vec();
    array.extend([u8::try_from(header.len()).unwrap_or_default(), 0]);
    array.extend(header.into_bytes());
    array.extend((0..20).flat_map(cell));
    array
}

const SECOND: u64 = 1_000_000_000;

/// Logs of a robot whose messages are JSON, packed in every way.
pub(crate) fn mcap_of_json() -> Vec<Vec<u8>> {
    [Packed::Not, Packed::Zstd, Packed::Lz4].map(robot).into()
}

fn robot(packed: Packed) -> Vec<u8> {
    let mut log = Container::begin(packed);
    let imu = log.channel("/imu/data", "sensor_msgs/msg/Imu");
    let odometry = log.channel("/odom", "nav_msgs/msg/Odometry");
    let joints = log.channel("/joint_states", "sensor_msgs/msg/JointState");
    for second in 1..5_u32 {
        let time = u64::from(second) * SECOND;
        let header = json!({"stamp": {"sec": second, "nanosec": 5000}, "frame_id": "odom"});
        let turn = json!({"x": 0.0, "y": -0.0872, "z": 0.0, "w": 0.9962});
        let send = |log: &mut Container, channel, message: &Value| {
            log.message(channel, time, message.to_string().as_bytes());
        };
        send(&mut log, imu, &json!({"header": header, "orientation": turn}));
        let place = json!({"x": 7.0, "y": 0.1 * f64::from(second), "z": 0.0});
        let pose = json!({"position": place, "orientation": turn});
        send(&mut log, odometry, &json!({"header": header, "pose": {"pose": pose}}));
        let names = ["front_left_wheel", "front_right_wheel", "rear_left_wheel"];
        let message = json!({"header": header, "name": names, "position": [0.1, 1.0, 1.0],
            "velocity": [0.5, 0.25, -0.5], "effort": [0.2, 0.1, 0.1]});
        send(&mut log, joints, &message);
        if second == 2 {
            log.end_chunk();
        }
    }
    log.finish_with_index()
}

/// Logs of messages as ROS 2 and ROS 1 write them.
pub(crate) fn mcap_of_ros() -> Vec<Vec<u8>> {
    let types = "builtin_interfaces/Time stamp\nstring[] names\nfloat64[2] pair\nfloat64 roll\n";
    let separator = "=".repeat(80);
    let types =
        format!("{types}{separator}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
    let log = |messages: &str, described: &str, packed| {
        let mut log = Container::begin(packed);
        let channel = log.channel_of("/roll", "ours/msg/Roll", messages, (described, &types));
        let is_cdr = messages == "cdr";
        for second in 1..9_u32 {
            let header: &[u8] = if is_cdr { &[0, 1, 0, 0] } else { &[] };
            let stamp = [second.to_le_bytes(), [0; 4]].concat();
            // One name; where numbers are aligned and texts end with a zero there is more of it.
            let name: &[u8] = if is_cdr { b"\x04\0\0\0abc\0" } else { b"\x03\0\0\0abc" };
            let names = [&1_u32.to_le_bytes()[..], name].concat();
            let mut message = [header, &stamp, &names].concat();
            let after_header = message.len() - header.len();
            message.resize(
                if is_cdr {
                    header.len() + after_header.next_multiple_of(8)
                } else {
                    message.len()
                },
                0,
            );
            for number in [0.5, 1.5, f64::from(second)] {
                message.extend(number.to_le_bytes());
            }
            log.message(channel, SECOND, &message);
        }
        log.finish_with_index()
    };
    vec![
        log("cdr", "ros2msg", Packed::Not),
        log("cdr", "ros2msg", Packed::Lz4),
        log("ros1", "ros1msg", Packed::Not),
    ]
}
