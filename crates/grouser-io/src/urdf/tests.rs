//! Robots whose rovers are known, and invalid texts.

use std::fmt::Write as _;

use super::{UrdfError, UrdfOptions, import};
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
    let rover = read(&text, &UrdfOptions { wheels, has_differential: false }).expect("it").value;
    // Logs have the names of joints, which are kept where those of the links differ.
    let joints: Vec<_> = rover.mounts().iter().map(|it| it.joint.as_deref()).collect();
    assert_eq!(joints, ["wheel_a1_axle", "wheel_a2_axle", "wheel_a3_axle", "b4_axle"].map(Some));
    let axis = rover.mounts()[0].steering_axis.expect("it is steered");
    assert!((axis.limit - 0.5).abs() < 1e-6);
    let options =
        UrdfOptions { wheels: vec!["wheel_*".into(), "b4".into()], has_differential: false };
    let notes = import(&text, &options).expect("it is a rover").notes;
    assert!(notes.iter().any(|it| it.contains("wheel_a1_steering steers from -28.")), "{notes:?}");
    let refused =
        import(&text, &UrdfOptions { wheels: vec!["c*".to_owned()], has_differential: false });
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
            UrdfOptions { wheels: vec!["left_front".into()], has_differential: true },
            "link left_front is a wheel, but its geometry is a mesh",
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
                has_differential: true,
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
    let refused = import(&robot(&inner), &UrdfOptions::default()).expect_err("too many");
    assert!(matches!(refused, UrdfError::TooManyWheels { count: 3999, .. }), "{refused}");
    let mut links = String::new();
    for place in 0..20_000 {
        let _ = write!(links, "<link name=\"l{place}\"/>");
    }
    let refused = import(&robot(&links), &UrdfOptions::default()).expect_err("too many");
    assert!(matches!(refused, UrdfError::TooMany(_)), "{refused}");
}
