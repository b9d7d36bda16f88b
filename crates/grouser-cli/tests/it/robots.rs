//! Twins of public robots: built after what is public of their dimensions and of how their
//! descriptions are written, each followed by a log with that robot's own names of joints.

use std::fmt::Write as _;

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

/// The parts of a description.
#[derive(Default)]
struct Parts(String);

impl Parts {
    /// A link with a mass [kg], whose inertia is that of a box [m], and with shapes.
    fn link(&mut self, name: &str, mass: f64, [a, b, c]: [f64; 3], shapes: &str) {
        let [x, y, z] = [b * b + c * c, a * a + c * c, a * a + b * b].map(|it| mass * it / 12.0);
        let inertial = format!(
            "<inertial><mass value=\"{mass}\"/><inertia ixx=\"{x}\" ixy=\"0\" ixz=\"0\" \
             iyy=\"{y}\" iyz=\"0\" izz=\"{z}\"/></inertial>"
        );
        let inertial = if mass > 0.0 { &*inertial } else { "" };
        let _ = write!(self.0, "<link name=\"{name}\">{inertial}{shapes}</link>");
    }

    /// * `kind`: with the axis behind a blank, as in `continuous 0 1 0`
    fn joint(&mut self, name: &str, kind: &str, [parent, child]: [&str; 2], [x, y, z]: [f64; 3]) {
        self.joint_with(name, kind, [parent, child], [x, y, z], "");
    }

    fn joint_with(
        &mut self,
        name: &str,
        kind: &str,
        [parent, child]: [&str; 2],
        [x, y, z]: [f64; 3],
        rest: &str,
    ) {
        let (kind, axis) = kind.split_once(' ').expect("an axis");
        let limit = match kind {
            "revolute" | "prismatic" => {
                "<limit lower=\"-0.5\" upper=\"0.5\" effort=\"9\" velocity=\"1\"/>"
            }
            _ => "",
        };
        // A joint that is turned over rolls as the others do.
        let (axis, turned) = match axis.strip_prefix("over ") {
            Some(axis) => (axis, "3.14159265 0 0"),
            None => (axis, "0 0 0"),
        };
        let _ = write!(
            self.0,
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child \
             link=\"{child}\"/><origin xyz=\"{x} {y} {z}\" rpy=\"{turned}\"/><axis \
             xyz=\"{axis}\"/>{limit}{rest}</joint>"
        );
    }

    fn robot(self, name: &str) -> String {
        format!("<?xml version=\"1.0\"?><robot name=\"{name}\">{}</robot>", self.0)
    }
}

const MESH: &str =
    "<visual><geometry><mesh filename=\"package://x/wheel.dae\"/></geometry></visual>";

/// A wheel that is seen as a mesh and touches as a cylinder [m].
fn rim(radius: f64, width: f64) -> String {
    format!(
        "{MESH}<collision><origin rpy=\"1.5708 0 0\"/><geometry><cylinder radius=\"{radius}\" \
         length=\"{width}\"/></geometry></collision>"
    )
}

const SIDES: [(&str, f64); 2] = [("left", 1.0), ("right", -1.0)];

/// Four wheels on a body, as skid-steered robots have them.
///
/// * `base`, `track`: distances of axles and of sides [m]
/// * `names`: of the joints, front left and right, then rear
/// * `right`: the axis of the right side's joints
fn skid(
    name: &str,
    (mass, wheel_mass): (f64, f64),
    (base, track): (f64, f64),
    (shape, height): (&str, f64),
    names: [&str; 4],
    right: &str,
) -> Parts {
    let mut parts = Parts::default();
    parts.link("base_footprint", 0.0, [0.0; 3], "");
    parts.joint("base", "fixed 0 0 0", ["base_footprint", "base_link"], [0.0, 0.0, 0.2]);
    parts.link("base_link", mass, [0.3, 0.3, 0.2], "");
    parts.link(&format!("{name}_lidar"), 0.1, [0.1; 3], "");
    let lidar = format!("{name}_lidar");
    parts.joint("lidar", "continuous 0 0 1", ["base_link", &lidar], [0.0, 0.0, 0.4]);
    for (place, joint) in names.iter().enumerate() {
        let (x, y) = (if place < 2 { 0.5 } else { -0.5 }, if place % 2 == 0 { 0.5 } else { -0.5 });
        let link = format!("{joint}_link");
        parts.link(&link, wheel_mass, [0.2, 0.1, 0.2], shape);
        let axis = if y < 0.0 { right } else { "0 1 0" };
        let kind = format!("continuous {axis}");
        parts.joint(joint, &kind, ["base_link", &link], [x * base, y * track, height]);
    }
    parts
}

/// Two wheels on each of two rockers.
fn rockers(radius: f64, width: f64, mimic: bool) -> Parts {
    let mut parts = Parts::default();
    parts.link("base_link", 4.0, [0.3, 0.3, 0.2], "");
    for (side, sign) in [("L", 1.0), ("R", -1.0)] {
        let rocker = format!("rocker_{side}_link");
        parts.link(&rocker, 1.2, [0.3, 0.05, 0.05], "");
        let follows = mimic && side == "R";
        let rest = if follows { "<mimic joint=\"rocker_L_joint\" multiplier=\"-1\"/>" } else { "" };
        let joint = format!("rocker_{side}_joint");
        let ends = ["base_link", &*rocker];
        parts.joint_with(&joint, "revolute 0 1 0", ends, [0.0026, sign * 0.1417, -0.0473], rest);
        for (end, x) in [("F", 0.1526), ("R", -0.1526)] {
            let wheel = format!("wheel_{end}{side}_link");
            parts.link(&wheel, 0.28, [0.1, 0.07, 0.1], &rim(radius, width));
            let joint = format!("wheel_{end}{side}_joint");
            let at = [x, sign * 0.0821, -0.0895];
            parts.joint(&joint, "continuous 0 1 0", [&rocker, &wheel], at);
        }
    }
    parts
}

/// Six wheels on rockers and bogies, the four at the corners steered.
///
/// * `length`: from the middle axle to the others [m]
/// * `kind`: of the suspension's joints
fn six(mass: f64, (radius, width): (f64, f64), (length, track): (f64, f64), kind: &str) -> Parts {
    let mut parts = Parts::default();
    parts.link("base_link", mass, [0.8 * track, 0.6 * track, 0.3 * track], "");
    for (side, sign) in SIDES {
        let [rocker, bogie] = ["rocker", "bogie"].map(|it| format!("{it}_{side}"));
        for (link, parent, at) in [
            (&rocker, "base_link", [0.0, sign * 0.4 * track, 0.0]),
            (&bogie, &*rocker, [-0.5 * length, 0.0, -0.1]),
        ] {
            parts.link(link, 0.05 * mass, [0.3, 0.05, 0.05], "");
            parts.joint(&format!("{link}_joint"), kind, [parent, link], at);
        }
        for (name, parent, x, z) in [
            ("front", &rocker, length, -0.3),
            ("middle", &bogie, 0.5 * length, -0.2),
            ("rear", &bogie, -0.5 * length, -0.2),
        ] {
            let (wheel, corner) = (format!("{name}_wheel_{side}"), format!("{name}_steer_{side}"));
            let at = [x, sign * 0.1 * track, z];
            let mut hangs = (&**parent, at);
            if name != "middle" {
                parts.link(&corner, 0.01 * mass, [0.1; 3], "");
                let [x, y, z] = at;
                let joint = format!("{name}_corner_{side}_joint");
                parts.joint(&joint, "revolute 0 0 1", [parent, &corner], [x, y, z + 0.1]);
                hangs = (&corner, [0.0, 0.0, -0.1]);
            }
            parts.link(&wheel, 0.02 * mass, [0.1; 3], &rim(radius, width));
            let joint = format!("{wheel}_joint");
            parts.joint(&joint, "continuous 0 1 0", [hangs.0, &wheel], hangs.1);
        }
    }
    parts
}

/// Four wheels, each on a link of its own below the body.
///
/// * `kind`: of the joint that leads to it, with its axis
fn corners(mass: f64, (radius, width): (f64, f64), at: [f64; 3], kind: &str) -> Parts {
    let mut parts = Parts::default();
    parts.link("base_link", mass, [1.0, 0.8, 0.5], "");
    for (end, forward) in [("front", 1.0), ("back", -1.0)] {
        for (side, leftward) in SIDES {
            let [unit, wheel] = ["unit", "wheel"].map(|it| format!("{end}_{side}_{it}"));
            parts.link(&unit, 0.02 * mass, [0.1; 3], "");
            let [x, y, z] = at;
            let place = [forward * x, leftward * y, z];
            parts.joint(&format!("{unit}_joint"), kind, ["base_link", &unit], place);
            parts.link(&wheel, 0.02 * mass, [0.2, 0.1, 0.2], &rim(radius, width));
            let joint = format!("{wheel}_joint");
            parts.joint(&joint, "continuous 0 1 0", [&unit, &wheel], [0.0, 0.0, -0.1]);
        }
    }
    parts
}

/// A rover with drums to dig at both ends, which roll as its wheels do.
fn drums() -> Parts {
    let names = ["left_wheel_1", "right_wheel_1", "left_wheel_2", "right_wheel_2"];
    let shape = rim(0.18, 0.1);
    let mut parts = skid("ezrassor", (12.0, 1.0), (0.4, 0.57), (&shape, 0.0), names, "0 1 0");
    for (end, x) in [("front", 0.28), ("back", -0.28)] {
        let [arm, drum] = ["arm", "drum"].map(|it| format!("{it}_{end}"));
        parts.link(&arm, 1.0, [0.3, 0.1, 0.1], "");
        parts.joint(&format!("{arm}_joint"), "revolute 0 1 0", ["base_link", &arm], [x, 0.0, 0.1]);
        parts.link(&drum, 1.0, [0.3; 3], &rim(0.15, 0.35));
        let joint = format!("{drum}_joint");
        parts.joint(&joint, "continuous 0 1 0", [&arm, &drum], [x, 0.0, 0.15]);
    }
    parts
}

/// Two wheels and a caster.
fn two_wheels() -> Parts {
    let mut parts = Parts::default();
    parts.link("base_link", 1.0, [0.1; 3], "");
    for (side, sign) in SIDES {
        let wheel = format!("wheel_{side}_link");
        parts.link(&wheel, 0.03, [0.06, 0.02, 0.06], &rim(0.033, 0.018));
        let joint = format!("wheel_{side}_joint");
        parts.joint(&joint, "continuous 0 1 0", ["base_link", &wheel], [0.0, sign * 0.08, 0.0]);
    }
    parts.link("caster", 0.005, [0.02; 3], "");
    parts.joint("caster_joint", "fixed 0 0 0", ["base_link", "caster"], [-0.08, 0.0, -0.01]);
    parts
}

/// A twin: its name, its description, the flag that it needs, the radius of its wheels [m], and how
/// many they are.
type Twin = (&'static str, String, &'static str, f64, usize);

/// Robots that steer by skidding.
fn skid_steered() -> Vec<Twin> {
    const NAMES: [&str; 4] =
        ["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"];
    const SHORT: [&str; 4] =
        ["fl_wheel_joint", "fr_wheel_joint", "rl_wheel_joint", "rr_wheel_joint"];
    const LETTERS: [&str; 4] = ["wheel_FL", "wheel_FR", "wheel_RL", "wheel_RR"];
    const PIONEER: [&str; 4] =
        ["p3at_front_left", "p3at_front_right", "p3at_back_left", "p3at_back_right"];
    // Masses of body and wheel [kg], base, track, radius, width and height [m].
    let four = |name, masses, sizes, (radius, width), height, names, right| {
        let parts = skid(name, masses, sizes, (&rim(radius, width), height), names, right);
        (name, parts.robot(name), "", radius, 4)
    };
    let left = "0 1 0";
    let given = "--wheel-radius-m 0.111 --wheel-width-m 0.08";
    let pioneer = skid("p3at", (12.0, 1.0), (0.268, 0.4), (MESH, -0.05), PIONEER, left);
    let scout = (0.16459, 0.1165);
    vec![
        four("husky", (46.0, 2.6), (0.512, 0.571), (0.1651, 0.1143), 0.033, NAMES, left),
        four("jackal", (16.5, 0.48), (0.262, 0.376), (0.098, 0.04), 0.0345, NAMES, left),
        four("panther", (50.0, 1.5), (0.44, 0.697), (0.1825, 0.1), 0.0, SHORT, left),
        four("rosbot", (2.0, 0.1), (0.105, 0.186), (0.0425, 0.03), 0.02, SHORT, left),
        four("scout", (40.0, 8.0), (0.498, 0.583), scout, -0.07, NAMES, "over 0 -1 0"),
        four("leo", (6.0, 0.28), (0.305, 0.448), (0.057, 0.07), -0.09, LETTERS, left),
        // Its right joints turn about axes to the right: forward is a negative speed of theirs.
        four("outward", (20.0, 1.0), (0.4, 0.5), (0.12, 0.08), 0.0, SHORT, "0 -1 0"),
        ("pioneer", pioneer.robot("pioneer"), given, 0.111, 4),
        ("ez-rassor", drums().robot("ezrassor"), "", 0.18, 4),
        ("turtlebot", two_wheels().robot("burger"), "", 0.033, 2),
    ]
}

/// Robots whose wheels hang on rockers, springs or links that steer them.
fn suspended() -> Vec<Twin> {
    let hinge = "revolute 0 1 0";
    let curiosity = |mass: f64| six(mass, (0.25, 0.4), (1.1, 2.3), hinge);
    let osr = six(12.0, (0.075, 0.085), (0.28, 0.5), hinge);
    let sawppy = six(4.0, (0.06, 0.06), (0.25, 0.45), hinge);
    let exomy = six(2.0, (0.05, 0.05), (0.14, 0.3), "fixed 0 0 0");
    let perseverance = six(900.0, (0.2625, 0.4), (1.12, 2.4), hinge);
    let springs = corners(100.0, (0.11, 0.09), [0.25, 0.3, 0.0], "prismatic 0 0 1");
    let viper = corners(430.0, (0.25, 0.2), [0.75, 0.75, -0.4], "revolute 0 0 1");
    vec![
        ("leo-rockers", rockers(0.0625, 0.07, true).robot("leo"), "", 0.0625, 4),
        ("leo-alone", rockers(0.0625, 0.07, false).robot("leo"), "--rigid", 0.0625, 4),
        ("warthog", rockers(0.3, 0.25, true).robot("warthog"), "", 0.3, 4),
        ("osr", osr.robot("osr"), "--rigid", 0.075, 6),
        ("sawppy", sawppy.robot("sawppy"), "--differential", 0.06, 6),
        ("exomy", exomy.robot("exomy"), "", 0.05, 6),
        ("curiosity", curiosity(800.0).robot("curiosity"), "--differential", 0.25, 6),
        ("curiosity-demo", curiosity(700.0).robot("demo"), "--rigid", 0.25, 6),
        ("perseverance", perseverance.robot("m2020"), "--rigid", 0.2625, 6),
        ("summit-xl", springs.robot("summit"), "", 0.11, 4),
        ("viper", viper.robot("viper"), "", 0.25, 4),
    ]
}

/// Ten metres straight on at 0.1 m/s of the rims with a slip of a tenth, with columns as a plotter
/// exports the messages of ROS.
fn log(joints: &[&str], radius: f64) -> String {
    const SPEED: f64 = 0.1;
    const SLIP: f64 = 0.1;
    let pose = [
        "position/x",
        "position/y",
        "orientation/x",
        "orientation/y",
        "orientation/z",
        "orientation/w",
    ];
    let mut text = "__time".to_owned();
    let columns = pose.iter().map(|it| format!("odom/pose/pose/{it}"));
    let columns = columns.chain(pose[2..].iter().map(|it| format!("imu/data/{it}")));
    let name = |it: &&str| format!("joint_states/{}/velocity", it.trim_start_matches('-'));
    for column in columns.chain(joints.iter().map(name)) {
        let _ = write!(text, ",/{column}");
    }
    let speed = |it: &&str| if it.starts_with('-') { -SPEED } else { SPEED } / radius;
    let speeds: Vec<String> = joints.iter().map(|it| format!("{:.6}", speed(it))).collect();
    let speeds = speeds.join(",");
    for step in 0..1000 {
        let time = 0.1 * f64::from(step);
        let way = SPEED * (1.0 - SLIP) * time;
        // A constant is no sensor.
        let pitch = 0.5 * (-0.02 + 1e-3 * time.sin());
        let (y, w) = (pitch.sin(), pitch.cos());
        let _ = write!(text, "\n{time:.1},{way:.5},0,0,0,0,1,0,{y:.6},0,{w:.6},{speeds}");
    }
    text
}

/// All but the one with two wheels are rovers, all but one of these without a flag or with one; the log of each is
/// read by its own names, with the slip that it has.
#[test]
fn twins_of_public_robots_are_rovers_and_their_logs_fit() {
    let place = Place::new();
    let (mut rovers, mut easy) = (0, 0);
    for (name, urdf, flags, radius, wheels) in skid_steered().into_iter().chain(suspended()) {
        place.write(&format!("{name}.urdf"), urdf);
        let line = format!("import-urdf {name}.urdf {flags} --out {name}.toml");
        let imported = place.line(&line);
        if wheels < 3 {
            let refused = check_is_refusal(&imported, 2);
            assert!(refused.contains("three wheels at least"), "{refused}");
            continue;
        }
        assert_eq!(imported.code(), 0, "{name}: {}", imported.stderr);
        rovers += 1;
        easy += usize::from(flags.matches("--").count() < 2);
        let document = place.read(&format!("{name}.toml"));
        assert!(document.contains(&format!("radius_m = {radius}")), "{name}: {document}");
        let key = |line: &'static str| document.lines().filter_map(move |it| it.strip_prefix(line));
        let joints: Vec<&str> = key("joint = ").map(|it| it.trim_matches('"')).collect();
        assert_eq!(joints.len(), wheels, "{name}: {joints:?}");
        let reversed = joints.iter().filter(|it| it.starts_with('-')).count();
        assert_eq!(reversed, if name == "outward" { 2 } else { 0 }, "{name}: {joints:?}");
        place.write(&format!("{name}.csv"), log(&joints, radius));
        let with = format!("--mapping ros --odometry visual --rover {name}.toml");
        let table = format!("import-telemetry {name}.csv {with} --out {name}-table.csv");
        let table = place.line(&table);
        assert_eq!(table.code(), 0, "{name}: {}", table.stderr);
        let replayed = place.json(&format!("replay {name}.csv {with} --soil toyoura"));
        let stretches = replayed["stretches"].as_array().expect("stretches");
        let slips = stretches.iter().map(|it| number(&it["measured_slip_ratio"]));
        let [least, most] = [f64::min, f64::max].map(|of| slips.clone().reduce(of).expect("some"));
        assert!(least > 0.09 && most < 0.11, "{name}: {least} to {most}");
        assert!(number(&replayed["replayed"]["compared_stretches"]) > 50.0, "{name}");
    }
    assert_eq!((rovers, easy), (20, 19));
}
