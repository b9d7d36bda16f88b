//! Robots whose rovers are known, and invalid texts.

mod kinds;

use std::fmt::Write as _;

use super::{Forward, UrdfError, UrdfOptions, UrdfRover};
use crate::{LoadedRover, Overrides, Source, read_rover};

/// A link with mass and, where it is a wheel, a rim.
fn link(name: &str, mass: f64, rim: &str) -> String {
    format!(
        "<link name=\"{name}\"><inertial><mass value=\"{mass}\"/><inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"/></inertial>{rim}</link>\n"
    )
}

fn joint(name: &str, kind: &str, ends: [&str; 2], at: [f64; 3], axis: &str) -> String {
    let [parent, child] = ends;
    let [x, y, z] = at;
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"{x} {y} {z}\"/><axis xyz=\"{axis}\"/></joint>\n"
    )
}

const RIM: &str = "<collision><origin xyz=\"0 0.02 0\" rpy=\"1.570796326794897 0 0\"/>\
                   <geometry><cylinder radius=\"0.15\" length=\"0.1\"/></geometry></collision>";

fn robot(inner: &str) -> String {
    format!("<?xml version=\"1.0\"?><robot name=\"six\">{inner}</robot>")
}

/// Six wheels on rockers and bogies, the bogies at the front; the body's mass is 0.1 m before its
/// link's origin.
fn six(right_pivot: f64) -> String {
    let mut inner = "<link name=\"base\"><inertial><origin xyz=\"0.1 0 0.2\"/><mass value=\"20\"/>\
                     <inertia ixx=\"1\" iyy=\"2\" izz=\"3\"/></inertial></link>\n"
        .to_owned();
    for (side, y, pivot) in [("left", 0.4, 0.05), ("right", -0.4, right_pivot)] {
        let name = |part: &str| format!("{side}_{part}");
        let [rocker, bogie] = ["rocker", "bogie"].map(name);
        inner += &link(&rocker, 2.0, "");
        inner +=
            &joint(&name("rocker_joint"), "revolute", ["base", &rocker], [pivot, y, 0.1], "0 1 0");
        inner += &link(&bogie, 1.0, "");
        inner += &joint(
            &name("bogie_joint"),
            "continuous",
            [&rocker, &bogie],
            [0.25, 0.0, -0.1],
            "0 -1 0",
        );
        for (wheel, parent, at) in [
            ("front", &bogie, [0.2, 0.1, -0.2]),
            ("middle", &bogie, [-0.2, 0.1, -0.2]),
            ("rear", &rocker, [-0.5, 0.1, -0.3]),
        ] {
            let wheel = name(wheel);
            inner += &link(&wheel, 1.5, RIM);
            inner += &joint(&format!("{wheel}_axle"), "continuous", [parent, &wheel], at, "0 1 0");
        }
    }
    robot(&inner)
}

fn import(text: &str, options: &UrdfOptions) -> Result<UrdfRover, UrdfError> {
    super::import(text, options, &|_| None)
}

fn read(text: &str, options: &UrdfOptions) -> Result<LoadedRover, UrdfError> {
    let found = import(text, options)?;
    let rover = read_rover(&Source::text("found", found.toml.clone()), &Overrides::none());
    Ok(rover.unwrap_or_else(|error| panic!("{error}\n{}", found.toml)))
}

fn with_differential() -> UrdfOptions {
    UrdfOptions { has_differential: true, ..UrdfOptions::default() }
}

#[test]
fn rockers_and_bogies_are_found() {
    let rover = read(&six(0.05), &with_differential()).expect("a rover").value;
    // The base with both rockers and bogies: 20 kg at 0.1 m, 2 · 2 kg at 0.05 m, 2 · 1 kg at 0.3 m.
    let body = rover.body();
    let centre = (20.0 * 0.1 + 4.0 * 0.05 + 2.0 * 0.3) / 26.0;
    let height = (20.0 * 0.2 + 4.0 * 0.1 + 2.0 * 0.0) / 26.0;
    assert!((body.mass - 26.0).abs() < 1e-6);
    // About x: of the parts, and of their ways from the centre across x.
    let away = |y: f64, z: f64| y * y + (z - height).powi(2);
    let about_x =
        1.0 + 4.0 * 0.1 + 20.0 * away(0.0, 0.2) + 4.0 * away(0.4, 0.1) + 2.0 * away(0.4, 0.0);
    assert!((body.inertia.xx - about_x).abs() < 1e-6, "{} {about_x}", body.inertia.xx);
    let suspension = rover.suspension().expect("rockers");
    assert!((suspension.pivot.x - (0.05 - centre)).abs() < 1e-6);
    assert!((suspension.pivot.y - (0.1 - height)).abs() < 1e-6);
    let bogie = suspension.bogie.expect("a bogie");
    assert_eq!(bogie.end, grouser_core::vehicle::End::Front);
    assert!((bogie.pivot.x - (0.3 - centre)).abs() < 1e-6);
    let front = rover.mounts().iter().find(|mount| mount.name == "left_front").expect("it");
    // The rim is 0.02 m to the left of its link.
    assert!((front.position.y - 0.52).abs() < 1e-6, "{}", front.position);
    assert!((front.position.x - (0.5 - centre)).abs() < 1e-6);
    assert_eq!((front.unit.wheel.radius, front.unit.wheel.width), (0.15, 0.1));
    assert!((front.unit.inertia.xx - (0.1 + 1.5 * 0.02 * 0.02)).abs() < 1e-6);
}

#[test]
fn steering_is_found_and_patterns_name_wheels() {
    let mut inner = link("base", 10.0, "");
    for (name, x, y) in [
        ("wheel_a1", 0.3, 0.3),
        ("wheel_a2", -0.3, 0.3),
        ("wheel_a3", -0.3, -0.3),
        ("b4", 0.3, -0.3),
    ] {
        let fork = format!("fork_of_{name}");
        inner += &link(&fork, 0.2, "");
        let steering =
            joint(&format!("{name}_steering"), "revolute", ["base", &fork], [x, y, 0.0], "0 0 1");
        let limits = "<limit lower=\"-0.5\" upper=\"0.6\" effort=\"1\" velocity=\"1\"/></joint>";
        inner += &steering.replace("</joint>", limits);
        inner += &link(name, 1.0, RIM);
        inner += &joint(
            &format!("{name}_axle"),
            "continuous",
            [&fork, name],
            [0.05, 0.0, -0.2],
            "0 1 0",
        );
    }
    let wheels = vec!["wheel_*".to_owned(), "b4".to_owned()];
    let text = robot(&inner);
    let rover = read(&text, &UrdfOptions { wheels, ..UrdfOptions::default() }).expect("it").value;
    // Logs have the names of joints, which are kept where those of the links differ.
    let joints: Vec<_> = rover.mounts().iter().map(|it| it.joint.as_deref()).collect();
    assert_eq!(joints, ["wheel_a1_axle", "wheel_a2_axle", "wheel_a3_axle", "b4_axle"].map(Some));
    let axis = rover.mounts()[0].steering_axis.expect("it is steered");
    assert!((axis.limit - 0.5).abs() < 1e-6);
    let options =
        UrdfOptions { wheels: vec!["wheel_*".into(), "b4".into()], ..UrdfOptions::default() };
    let notes = import(&text, &options).expect("it is a rover").notes;
    assert!(notes.iter().any(|it| it.contains("wheel_a1_steering steers from -28.")), "{notes:?}");
    let refused =
        import(&text, &UrdfOptions { wheels: vec!["c*".to_owned()], ..UrdfOptions::default() });
    assert!(
        refused
            .expect_err("no such link")
            .to_string()
            .contains("the links are base, fork_of_wheel_a1")
    );
}

/// What is wrong, with the link or joint that it is in.
#[test]
fn robots_that_are_no_rovers_are_refused() {
    let differ = six(0.07);
    let six = six(0.05);
    let base = link("base", 1.0, "");
    let loops = base.clone()
        + &link("a", 1.0, "")
        + &link("b", 1.0, "")
        + &joint("ab", "fixed", ["a", "b"], [0.0; 3], "0 0 1")
        + &joint("ba", "fixed", ["b", "a"], [0.0; 3], "0 0 1");
    let deep = "<a>".repeat(100_000);
    for (text, options, expected) in [
        (six.clone(), UrdfOptions::default(), "joint left_rocker_joint is a rocker"),
        (differ, with_differential(), "rockers are not alike on both sides"),
        (
            six.replace("radius=\"0.15\"", "radius=\"nan\""),
            with_differential(),
            "radius is \"nan\"",
        ),
        (
            six.replace("mass value=\"20\"", "mass value=\"-20\""),
            with_differential(),
            "link base: value",
        ),
        (
            six.replace("<cylinder radius=\"0.15\" length=\"0.1\"/>", "<mesh filename=\"x\"/>"),
            UrdfOptions {
                wheels: vec!["*front".into(), "*middle".into(), "*rear".into()],
                ..with_differential()
            },
            "link left_rear is a wheel, but its geometry is a mesh",
        ),
        (
            six.replace("xyz=\"0 -1 0\"", "xyz=\"1 0 0\""),
            with_differential(),
            "joint left_bogie_joint turns about an axis",
        ),
        (
            six.replace("child link=\"left_front\"", "child link=\"nowhere\""),
            with_differential(),
            "leads to link nowhere",
        ),
        (
            six.replace("child link=\"left_front\"", "child link=\"left_rear\""),
            with_differential(),
            "left_rear hangs on two joints",
        ),
        (
            six.replace("name=\"left_front\"", "name=\"left_rear\""),
            with_differential(),
            "link left_rear stands there twice",
        ),
        (robot(&loops), UrdfOptions::default(), "hangs on itself"),
        (
            six.replacen("type=\"revolute\"", "type=\"floating\"", 1),
            with_differential(),
            "joint left_rocker_joint has the type floating",
        ),
        (
            six.replacen("rpy=\"1.570796326794897 0 0\"", "rpy=\"0 0 0\"", 1),
            with_differential(),
            "the axis of its cylinder is not across",
        ),
        (
            six.replace("</robot>", "")
                + &link("left_front_tyre", 0.1, RIM)
                + &joint("tyre", "fixed", ["left_front", "left_front_tyre"], [0.0; 3], "0 0 1")
                + "</robot>",
            UrdfOptions {
                wheels: vec!["*front*".into(), "*middle".into(), "*rear".into()],
                ..with_differential()
            },
            "links left_front and left_front_tyre turn about the same axle",
        ),
        (robot(&base), UrdfOptions::default(), "no wheels were found"),
        (
            robot(&(base.clone() + &link("other", 1.0, ""))),
            UrdfOptions::default(),
            "base and other hang on nothing",
        ),
        (robot(""), UrdfOptions::default(), "none of the others has a mass"),
        ("<sdf/>".to_owned(), UrdfOptions::default(), "its root is <sdf>"),
        ("wheel".to_owned(), UrdfOptions::default(), "is no XML"),
        (String::new(), UrdfOptions::default(), "is no XML"),
        (deep, UrdfOptions::default(), "is no XML"),
        (
            "<robot xmlns:xacro=\"urn:xacro\"><xacro:wheel/></robot>".to_owned(),
            UrdfOptions::default(),
            "xacro FILE.xacro",
        ),
    ] {
        let refused = import(&text, &options).expect_err(expected).to_string();
        assert!(refused.contains(expected), "{expected}: {refused}");
    }
}

/// A chain of thousands of links, and thousands of wheels, are read or refused without waiting.
#[test]
fn large_robots_are_bounded() {
    let mut inner = link("l0", 1.0, "");
    for place in 1..4000 {
        inner += &link(&format!("l{place}"), 1.0, RIM);
        let ends = [format!("l{}", place - 1), format!("l{place}")];
        inner +=
            &joint(&format!("j{place}"), "continuous", [&ends[0], &ends[1]], [0.0; 3], "0 1 0");
    }
    let all = UrdfOptions { wheels: vec!["l*".to_owned()], ..UrdfOptions::default() };
    let refused = import(&robot(&inner), &all).expect_err("too many");
    assert!(matches!(refused, UrdfError::TooManyWheels { count: 4000, .. }), "{refused}");
    let refused = import(&robot(&inner), &UrdfOptions::default()).expect_err("no pairs");
    assert!(matches!(refused, UrdfError::NoWheels { .. }), "{refused}");
    let mut links = String::new();
    for place in 0..20_000 {
        let _ = write!(links, "<link name=\"l{place}\"/>");
    }
    let refused = import(&robot(&links), &UrdfOptions::default()).expect_err("too many");
    assert!(matches!(refused, UrdfError::TooMany(_)), "{refused}");
}

// ---- Robots as they are ----

const CYLINDER: &str = "<collision><origin rpy=\"1.5707963 0 0\"/><geometry>\
                        <cylinder radius=\"0.1\" length=\"0.08\"/></geometry></collision>";
const MESH: &str = "<collision><geometry><mesh filename=\"package://cart/wheel.stl\" \
                    scale=\"0.001 0.001 0.001\"/></geometry></collision>";

/// A body with four wheels of a shape, and what else there is.
fn cart(wheel: &str, rest: &str) -> String {
    let mut inner = link("body", 6.0, "");
    for (name, x, y) in [("fl", 0.2, 0.2), ("fr", 0.2, -0.2), ("rl", -0.2, 0.2), ("rr", -0.2, -0.2)]
    {
        inner += &link(name, 0.5, wheel);
        inner +=
            &joint(&format!("{name}_joint"), "continuous", ["body", name], [x, y, -0.1], "0 1 0");
    }
    robot(&(inner + rest))
}

fn found(text: &str, options: &UrdfOptions) -> UrdfRover {
    import(text, options).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn what_does_not_count_is_not_read() {
    let mast = link("mast", 0.1, "")
        .replace("<inertial>", "<visual><geometry><cylinder/></geometry></visual><inertial>")
        + &joint("mast_joint", "fixed", ["body", "mast"], [0.1, 0.0, 0.3], "0 0 0")
        + "<gazebo><sensor:camera name=\"c\"/><plugin lib:file=\"x\"/></gazebo>";
    let rover = found(&cart(CYLINDER, &mast), &UrdfOptions::default());
    assert_eq!(rover.wheels.len(), 4);
    assert!(rover.wheels.iter().all(|it| it.radius == 0.1 && it.width == 0.08));
    // Latin-1: a name in a comment.
    let latin = cart(CYLINDER, "<!-- J~rg -->").replace('~', "\u{f6}");
    let latin: Vec<u8> =
        latin.chars().map(|letter| u8::try_from(letter).expect("Latin-1")).collect();
    assert!(std::str::from_utf8(&latin).is_err());
    super::import(latin, &UrdfOptions::default(), &|_| None).expect("Latin-1");
    let utf16: Vec<u8> = "<robot/>".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let refused = super::import(utf16, &UrdfOptions::default(), &|_| None).expect_err("UTF-16");
    assert_eq!(refused, UrdfError::NoText);
}

#[test]
fn the_largest_of_several_shapes_is_the_rim() {
    let hub = CYLINDER.replace("0.1\"", "0.09\"");
    let rover = found(&cart(&(hub + CYLINDER), ""), &UrdfOptions::default());
    assert!(rover.wheels.iter().all(|it| it.radius == 0.1), "{:?}", rover.wheels);
    assert!(
        rover.notes.iter().any(|it| it.contains("the largest of 0.09, 0.1 m")),
        "{:?}",
        rover.notes
    );
    // What is seen counts where nothing collides, and not beside it.
    let seen = CYLINDER.replace("collision", "visual").replace("0.1\"", "0.3\"");
    assert_eq!(
        found(&cart(&(seen.clone() + CYLINDER), ""), &UrdfOptions::default()).wheels[0].radius,
        0.1
    );
    assert_eq!(found(&cart(&seen, ""), &UrdfOptions::default()).wheels[0].radius, 0.3);
}

/// A cube of STL that reaches so far along each axis.
fn box_of_stl([x, y, z]: [f64; 3]) -> Vec<u8> {
    format!("solid\nvertex {} {} {}\nvertex {x} {y} {z}\n", -x, -y, -z).into_bytes()
}

#[test]
fn meshes_tell_radius_and_width_where_they_are_there() {
    let text = cart(MESH, "");
    let refused = import(&text, &UrdfOptions::default()).expect_err("no mesh").to_string();
    assert!(refused.contains("link fl is a wheel, but its geometry is a mesh"), "{refused}");
    let sized =
        UrdfOptions { wheel_radius: Some(0.11), wheel_width: Some(0.05), ..UrdfOptions::default() };
    assert!(found(&text, &sized).wheels.iter().all(|it| it.radius == 0.11 && it.width == 0.05));
    let mesh = |name: &str| {
        assert_eq!(name, "package://cart/wheel.stl");
        Some(box_of_stl([90.0, 30.0, 90.0]))
    };
    let rover = super::import(&text, &UrdfOptions::default(), &mesh).expect("by its mesh");
    let wheel = &rover.wheels[0];
    assert!((wheel.radius - 0.09).abs() < 1e-9 && (wheel.width - 0.06).abs() < 1e-9, "{wheel:?}");
    assert!(rover.notes.iter().any(|it| it.contains("by the extent of package://")));
    let flat = |_: &str| Some(box_of_stl([90.0, 30.0, 20.0]));
    assert!(super::import(&text, &UrdfOptions::default(), &flat).is_err());
}

/// Drums roll as wheels do, and have no partner on the other side; a caster beside two wheels
/// carries no rover of ours; what reaches higher than the wheels is none.
#[test]
fn wheels_reach_the_ground_and_come_in_pairs() {
    let drum = CYLINDER.replace("0.1\"", "0.12\"").replace("0.08", "0.5");
    let drums: String = [("drum_front", 0.4), ("drum_back", -0.4)]
        .iter()
        .map(|(name, x)| {
            link(name, 0.8, &drum)
                + &joint(
                    &format!("{name}_j"),
                    "continuous",
                    ["body", name],
                    [*x, 0.0, -0.05],
                    "0 1 0",
                )
        })
        .collect();
    let rover = found(&cart(CYLINDER, &drums), &UrdfOptions::default());
    let names: Vec<&str> = rover.wheels.iter().map(|it| &*it.link).collect();
    assert_eq!(names, ["fl", "fr", "rl", "rr"]);
    assert!(
        rover
            .notes
            .iter()
            .any(|it| it == "not taken as wheels, though they roll: drum_front, drum_back")
    );
    let arms: String = [("reel_left", 0.3), ("reel_right", -0.3)]
        .iter()
        .map(|(name, y)| {
            link(name, 0.1, CYLINDER)
                + &joint(
                    &format!("{name}_j"),
                    "continuous",
                    ["body", name],
                    [0.0, *y, 0.3],
                    "0 1 0",
                )
        })
        .collect();
    assert_eq!(found(&cart(CYLINDER, &arms), &UrdfOptions::default()).wheels.len(), 4);

    let mut two = link("body", 6.0, "")
        + &link(
            "caster",
            0.1,
            "<collision><geometry><sphere radius=\"0.05\"/></geometry></collision>",
        );
    two += &joint("cj", "fixed", ["body", "caster"], [-0.2, 0.0, -0.15], "0 0 1");
    for (name, y) in [("left", 0.2), ("right", -0.2)] {
        two += &link(name, 0.5, CYLINDER);
        two += &joint(&format!("{name}_j"), "continuous", ["body", name], [0.0, y, -0.1], "0 1 0");
    }
    let refused = import(&robot(&two), &UrdfOptions::default()).expect_err("two").to_string();
    assert!(refused.contains("2 wheels (left, right) and a sphere of link caster"), "{refused}");
    // Three: a pair, and one in the middle.
    two += &link("rear", 0.5, CYLINDER);
    two += &joint("rear_j", "continuous", ["body", "rear"], [-0.3, 0.0, -0.1], "0 1 0");
    assert_eq!(found(&robot(&two), &UrdfOptions::default()).wheels.len(), 3);
    let passive = UrdfOptions { passive: vec!["rear".to_owned()], ..UrdfOptions::default() };
    let refused = import(&robot(&two), &passive).expect_err("two").to_string();
    assert!(refused.contains("2 wheels"), "{refused}");
}

#[test]
fn rovers_may_face_along_y() {
    let text = cart(CYLINDER, "")
        .replace("xyz=\"0 1 0\"", "xyz=\"1 0 0\"")
        .replace("rpy=\"1.5707963 0 0\"", "rpy=\"0 1.5707963 0\"");
    let refused = import(&text, &UrdfOptions::default()).expect_err("none across").to_string();
    assert!(refused.contains("4 links roll about axes along x"), "{refused}");
    for (forward, [x, y]) in [(Forward::Y, [0.2, -0.2]), (Forward::MinusY, [-0.2, 0.2])] {
        let rover = found(&text, &UrdfOptions { forward, ..UrdfOptions::default() });
        let [fl_x, fl_y, _] = rover.wheels[0].position;
        assert!((fl_x - x).abs() < 1e-9 && (fl_y - y).abs() < 1e-9, "{forward:?} {fl_x} {fl_y}");
    }
    let back = UrdfOptions { forward: Forward::MinusX, ..UrdfOptions::default() };
    let rover = found(&cart(CYLINDER, ""), &back);
    assert!((rover.wheels[0].position[0] + 0.2).abs() < 1e-9, "{:?}", rover.wheels[0]);
}

/// Four wheels on rockers that turn with or against each other.
fn rockers(multiplier: &str, right_axis: &str) -> String {
    let mut inner = link("body", 6.0, "");
    for (side, y) in [("left", 0.2), ("right", -0.2)] {
        let rocker = format!("{side}_rocker");
        inner += &link(&rocker, 0.4, "");
        let is_right = side == "right";
        let axis = if is_right { right_axis } else { "0 1 0" };
        let hinge =
            joint(&format!("{rocker}_joint"), "revolute", ["body", &rocker], [0.0, y, 0.0], axis);
        let mimic = format!("<mimic joint=\"left_rocker_joint\"{multiplier}/></joint>");
        inner += &if is_right { hinge.replace("</joint>", &mimic) } else { hinge };
        for (end, x) in [("front", 0.2), ("rear", -0.2)] {
            let wheel = format!("{side}_{end}");
            inner += &link(&wheel, 0.5, CYLINDER);
            inner += &joint(
                &format!("{wheel}_joint"),
                "continuous",
                [&rocker, &wheel],
                [x, 0.0, -0.1],
                "0 1 0",
            );
        }
    }
    robot(&inner)
}

#[test]
fn a_mimic_between_rockers_is_a_differential() {
    for (multiplier, axis) in [(" multiplier=\"-1\"", "0 1 0"), ("", "0 -1 0")] {
        let rover =
            read(&rockers(multiplier, axis), &UrdfOptions::default()).expect("a differential");
        assert!(rover.value.suspension().is_some());
    }
    // The same way is none, whatever a caller says.
    for options in [UrdfOptions::default(), with_differential()] {
        let refused = import(&rockers("", "0 1 0"), &options).expect_err("no differential");
        assert!(
            refused
                .to_string()
                .contains("left_rocker_joint and right_rocker_joint turn the same way"),
            "{refused}"
        );
    }
    let half = rockers(" multiplier=\"-0.5\"", "0 1 0");
    let refused = import(&half, &UrdfOptions::default()).expect_err("unequal").to_string();
    assert!(refused.contains("right_rocker_joint turns 0.500 times as far"), "{refused}");
    let rigid = UrdfOptions { is_rigid: true, ..UrdfOptions::default() };
    let rover = read(&rockers("", "0 1 0"), &rigid).expect("rigid").value;
    assert!(rover.suspension().is_none() && rover.mounts().len() == 4);
}

#[test]
fn springs_and_placeholders_are_said() {
    let sprung =
        cart(CYLINDER, "").replace("<parent link=\"body\"/>", "<parent link=\"strut\"/>").replace(
            "</robot>",
            &(link("strut", 0.1, "")
                + &joint("spring", "prismatic", ["body", "strut"], [0.0; 3], "0 0 1")
                + "</robot>"),
        );
    let rover = found(&sprung, &UrdfOptions::default());
    assert!(
        rover.notes.iter().any(|it| it.contains("joint spring slides") && it.contains("rigid"))
    );
    let heavy = cart(CYLINDER, "")
        .replace("ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"", "ixx=\"1\" iyy=\"1\" izz=\"1\"");
    let notes = found(&heavy, &UrdfOptions::default()).notes;
    let doubts: Vec<_> = notes.iter().filter(|it| it.contains("placeholder")).collect();
    assert!(
        doubts.len() == 2
            && doubts[0].contains("the body")
            && doubts[1].contains("fl and 3 others"),
        "{notes:?}"
    );
    let points = cart(CYLINDER, "")
        .replace("ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"", "ixx=\"1e-9\" iyy=\"1e-9\" izz=\"1e-9\"");
    let notes = found(&points, &UrdfOptions::default()).notes;
    assert_eq!(notes.iter().filter(|it| it.contains("far smaller than")).count(), 2, "{notes:?}");
    let light = cart(CYLINDER, "").replace(
        "ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"",
        "ixx=\"0.002\" iyy=\"0.003\" izz=\"0.002\"",
    );
    assert!(
        !found(&light, &UrdfOptions::default()).notes.iter().any(|it| it.contains("placeholder"))
    );
}

/// Names of joints are no names of links, and lengths in millimetres are none in metres.
#[test]
fn other_names_and_units_are_named() {
    let passive = UrdfOptions { passive: vec!["caster".to_owned()], ..UrdfOptions::default() };
    let joints = UrdfOptions { wheels: vec!["*_joint".to_owned()], ..UrdfOptions::default() };
    let large = CYLINDER.replace("0.1\"", "100\"").replace("0.08", "80");
    for (text, options, expected) in [
        (cart(CYLINDER, ""), passive, "no link is called caster\nhint: the links are body, fl"),
        (cart(CYLINDER, ""), joints, "joint fl_joint, which leads to link fl, is called so"),
        (cart(&large, ""), UrdfOptions::default(), "look like millimetres"),
        (
            cart(CYLINDER, "").replace("mass value=\"", "mass value=\"1000"),
            UrdfOptions::default(),
            "looks like grams",
        ),
    ] {
        let refused = import(&text, &options).expect_err(expected).to_string();
        assert!(refused.contains(expected), "{refused}");
    }
}

/// Masses without an inertia are uniform bodies, and rigid rovers stand on one plane.
#[test]
fn what_robots_leave_out_is_estimated_and_said() {
    let bare = cart(CYLINDER, "").replace("<inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"/>", "");
    let rover = read(&bare, &UrdfOptions::default()).expect("a rover").value;
    let wheel = &rover.mounts()[0].unit;
    assert!((wheel.inertia.yy - 0.5 * 0.5 * 0.01).abs() < 1e-9, "{:?}", wheel.inertia);
    // 0.4 m long and wide, 0.2 m high.
    assert!((rover.body().inertia.zz - 6.0 * 0.32 / 12.0).abs() < 1e-9);
    let notes = found(&bare, &UrdfOptions::default()).notes;
    assert_eq!(notes.iter().filter(|it| it.contains("not stated")).count(), 5, "{notes:?}");
    let askew = cart(CYLINDER, "").replacen("-0.1\"/>", "-0.12\"/>", 1);
    let rover = found(&askew, &UrdfOptions::default());
    assert!(
        rover.notes.iter().any(|it| it.contains("0.015 m higher or lower")),
        "{:?}",
        rover.notes
    );
    let level = read(&cart(CYLINDER, ""), &UrdfOptions::default()).expect("a rover").value;
    let raised = read(&askew, &UrdfOptions::default()).expect("all wheels on one plane").value;
    assert_eq!(raised.mounts()[0].unit.inertia, level.mounts()[0].unit.inertia);
}

/// Two tyres on one axle are one wheel between them, in whichever order the file has them.
#[test]
fn tyres_side_by_side_are_one_wheel() {
    let tyre = |y: &str| {
        CYLINDER.replace("0.08", "0.04").replace("<origin ", &format!("<origin xyz=\"0 {y} 0\" "))
    };
    let one = found(&cart(CYLINDER, ""), &UrdfOptions::default());
    for [first, second] in [["0.05", "-0.05"], ["-0.05", "0.05"]] {
        let rover = found(&cart(&(tyre(first) + &tyre(second)), ""), &UrdfOptions::default());
        for (twin, wheel) in rover.wheels.iter().zip(&one.wheels) {
            assert!((twin.width - 0.08).abs() < 1e-12, "{twin:?}");
            assert!((twin.position[1] - wheel.position[1]).abs() < 1e-12, "{twin:?} {wheel:?}");
        }
        let said = "2 tyres side by side, together 0.08 m wide";
        assert!(rover.notes.iter().any(|it| it.contains(said)), "{:?}", rover.notes);
    }
    // A cylinder that stands there twice is one.
    let twice = found(&cart(&(CYLINDER.to_owned() + CYLINDER), ""), &UrdfOptions::default());
    assert_eq!(twice.wheels, one.wheels);
}
