//! Kinds of robots among public descriptions, each as a small robot of our own.

use super::{
    CYLINDER, box_of_stl, cart, found, import, joint, link, read, robot, rockers, with_differential,
};
use crate::urdf::{UrdfError, UrdfOptions, UrdfRover};

fn default(text: &str) -> UrdfRover {
    found(text, &UrdfOptions::default())
}

fn refused(text: &str) -> UrdfError {
    import(text, &UrdfOptions::default()).expect_err("it is no rover")
}

fn links(rover: &UrdfRover) -> Vec<&str> {
    rover.wheels.iter().map(|it| &*it.link).collect()
}

fn check_says(rover: &UrdfRover, expected: &str) {
    assert!(rover.notes.iter().any(|it| it.contains(expected)), "{expected}: {:?}", rover.notes);
}

/// A wheel on a body, with the type and the axis of its joint.
fn wheel(name: &str, kind: &str, [x, y, z]: [f64; 3]) -> String {
    link(name, 0.5, CYLINDER)
        + &joint(&format!("{name}_joint"), kind, ["body", name], [x, y, z], "0 1 0")
}

/// Two driven wheels, and two on forks that turn freely about upright axes.
///
/// * `trail`: from a fork's axis back to its wheel [m]
/// * `name`: of forks
fn on_forks(trail: f64, name: &str) -> String {
    let mut inner = link("body", 6.0, "");
    for (side, y) in [("left", 0.2), ("right", -0.2)] {
        inner += &wheel(side, "continuous", [0.2, y, -0.1]);
        let [fork, rear] = [name, "rear"].map(|it| format!("{it}_{side}"));
        inner += &(link(&fork, 0.1, "") + &link(&rear, 0.2, CYLINDER));
        let turn = format!("{fork}_turn");
        inner += &joint(&turn, "continuous", ["body", &fork], [-0.2, y, 0.0], "0 0 1");
        let axle = format!("{rear}_axle");
        inner += &joint(&axle, "continuous", [&fork, &rear], [-trail, 0.0, -0.1], "0 1 0");
    }
    robot(&inner)
}

#[test]
fn casters_trail_or_are_called_so() {
    for (trail, name) in [(0.05, "fork"), (0.0, "Caster")] {
        let refused = refused(&on_forks(trail, name)).to_string();
        assert!(refused.contains("has 2 wheels (left, right)"), "{refused}");
    }
    // A wheel that is steered all round, as those of some robots are, stands below its axis.
    let rover = default(&on_forks(0.0, "fork"));
    assert_eq!(rover.wheels.iter().filter(|it| it.steered_by.is_some()).count(), 2);
    let four = cart(CYLINDER, "")
        .replace("</robot>", &(wheel("caster", "continuous", [-0.3, 0.0, -0.1]) + "</robot>"));
    let rover = default(&four);
    assert_eq!(links(&rover), ["fl", "fr", "rl", "rr"]);
    check_says(&rover, "no driven wheels: caster");
}

/// A tracked vehicle, with sprockets and idlers above its rollers, is refused; with its wheels named
/// by the caller it is read.
#[test]
fn tracks_are_refused_by_name() {
    let mut upper = String::new();
    for (name, x) in [("sprocket", 0.4), ("idler", -0.4)] {
        for (side, y) in [("left", 0.2), ("right", -0.2)] {
            upper += &wheel(&format!("{name}_{side}"), "continuous", [x, y, 0.05]);
        }
    }
    let text = cart(CYLINDER, &upper);
    let refused = refused(&text);
    assert!(matches!(refused, UrdfError::Tracks { .. }), "{refused}");
    assert!(refused.to_string().contains("sprocket_left, sprocket_right, idler_left"), "{refused}");
    let named = UrdfOptions { wheels: vec!["f*".into(), "r?".into()], ..UrdfOptions::default() };
    assert!(matches!(import(&text, &named), Err(UrdfError::NoSuchWheel { .. })));
    let named = UrdfOptions { wheels: vec!["f*".into(), "r*".into()], ..UrdfOptions::default() };
    assert_eq!(found(&text, &named).wheels.len(), 4);
}

/// Rockers that turn without end and reach as low as wheels are not taken as wheels.
#[test]
fn links_that_carry_wheels_are_not_wheels() {
    let text = rockers(" multiplier=\"-1\"", "0 1 0").replace("revolute", "continuous");
    let low = CYLINDER.replace("<origin", "<origin xyz=\"0 0 -0.1\"");
    let [left, right] = ["left", "right"].map(|it| format!("<link name=\"{it}_rocker\">"));
    let shaped = |text: String, link: &str| text.replacen(link, &format!("{link}{low}"), 1);
    let text = shaped(shaped(text, &left), &right);
    assert_eq!(links(&default(&text)), ["left_front", "left_rear", "right_front", "right_rear"]);
}

/// Two pairs that do not match are not three wheels.
#[test]
fn a_single_wheel_is_in_the_middle() {
    let mut inner = link("body", 6.0, "");
    for (name, at) in [
        ("front_left", [0.2, 0.2, 0.1]),
        ("front_right", [0.2, -0.2, -0.1]),
        ("rear_left", [-0.2, 0.18, -0.1]),
        ("rear_right", [-0.2, -0.18, -0.1]),
    ] {
        inner += &wheel(name, "continuous", at);
    }
    let refused = refused(&robot(&inner)).to_string();
    assert!(refused.contains("has 2 wheels (rear_left, rear_right)"), "{refused}");
    // The number of wheels is checked before their size.
    let mesh = "<visual><geometry><mesh filename=\"lost.stl\"/></geometry></visual>";
    let two = inner.replace(CYLINDER, mesh);
    let two = two.split("<link name=\"rear").next().unwrap_or_default();
    let two = two.replace("0.2 0.2 0.1", "0.2 0.2 -0.1");
    let refused = import(&robot(&two), &UrdfOptions::default()).expect_err("two").to_string();
    assert!(refused.contains("has 2 wheels (front_left, front_right)"), "{refused}");
}

/// Limits that exporters write for want of others: the joint stays where it is, unless a caller
/// speaks of rockers.
#[test]
fn joints_whose_limits_are_one_angle_stand_still() {
    let locked = "<limit lower=\"0\" upper=\"0\" effort=\"9\" velocity=\"1\"/></joint>";
    let text =
        rockers("", "0 1 0")
            .replace("<mimic joint=\"left_rocker_joint\"/></joint>", "</joint>")
            .split_inclusive("</joint>")
            .map(|part| {
                if part.contains("revolute") {
                    part.replace("</joint>", locked)
                } else {
                    part.into()
                }
            })
            .collect::<String>();
    let rover = default(&text);
    assert!(rover.wheels.iter().all(|it| it.hangs_on.is_empty()), "{:?}", rover.wheels);
    check_says(&rover, "joint left_rocker_joint cannot turn by its limits");
    let rover = read(&text, &with_differential()).expect("with rockers").value;
    assert!(rover.suspension().is_some());
    // A steering joint that turns to one side alone has its zero at an end.
    let one_sided = on_forks(0.0, "fork").replace(
        "<parent link=\"body\"/><child link=\"fork",
        "<limit lower=\"0\" upper=\"0.6\"/><parent link=\"body\"/><child link=\"fork",
    );
    let one_sided = one_sided
        .replace("name=\"fork_left_turn\" type=\"continuous\"", "name=\"l\" type=\"revolute\"")
        .replace("name=\"fork_right_turn\" type=\"continuous\"", "name=\"r\" type=\"revolute\"");
    let rover = read(&one_sided, &UrdfOptions::default()).expect("a rover").value;
    assert!(rover.mounts().iter().all(|it| it.steering_axis.is_none()));
}

/// A robot hangs on its world by a joint that floats, and what has no end is written as the largest
/// number; both stand beside what matters.
#[test]
fn a_floating_robot_and_endless_limits_are_read() {
    let world = "<link name=\"world\"/>".to_owned()
        + &joint("root", "floating", ["world", "body"], [0.0, 0.0, 0.3], "0 0 1");
    let mast = link("mast", 0.1, "")
        + &joint("mast_joint", "revolute", ["body", "mast"], [0.0; 3], "0 0 1").replace(
            "</joint>",
            "<limit lower=\"-1.79769e+308\" upper=\"1.79769e+308\" effort=\"1\" velocity=\"1\"/>\
             </joint>",
        );
    assert_eq!(default(&cart(CYLINDER, &(world + &mast))).wheels.len(), 4);
    let ball = cart(CYLINDER, "").replacen("continuous", "ball", 1);
    assert_eq!(links(&default(&cart(CYLINDER, ""))).len(), 4);
    let refused = refused(&ball).to_string();
    assert!(refused.contains("has 2 wheels"), "{refused}");
}

/// An inertia that no body can have is replaced by an estimate, and a mass outside of a document's
/// range is refused with its link.
#[test]
fn inertias_of_no_body_are_estimated() {
    let text = cart(CYLINDER, "").replace(
        "<mass value=\"0.5\"/><inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.3\"/>",
        "<mass value=\"0.5\"/><inertia ixx=\"0.0008\" iyy=\"0.0044\" izz=\"0.0008\"/>",
    );
    let rover = read(&text, &UrdfOptions::default()).expect("a rover").value;
    assert!((rover.mounts()[0].unit.inertia.yy - 0.5 * 0.5 * 0.01).abs() < 1e-9);
    check_says(&default(&text), "link fl: its inertia is that of no body");
    let text = cart(CYLINDER, "").replacen("ixx=\"0.1\"", "ixx=\"5\"", 1);
    check_says(&default(&text), "the body's inertia is that of no body");
    read(&text, &UrdfOptions::default()).expect("a rover");
    let light = refused(&cart(CYLINDER, "").replacen("\"0.5\"", "\"0.005\"", 1)).to_string();
    assert!(light.contains("link fl, a wheel: mass is \"0.005\""), "{light}");
}

#[test]
fn a_centre_of_mass_to_one_side_is_doubted() {
    let place = |y: &str, x: &str| {
        let origin = format!("<inertial><origin xyz=\"{x} {y} 0\"/><mass value=\"6\"/>");
        cart(CYLINDER, "").replace("<inertial><mass value=\"6\"/>", &origin)
    };
    check_says(&default(&place("-0.085", "0")), "0.085 m to the right of the middle");
    check_says(&default(&place("0.1", "0")), "0.1 m to the left");
    check_says(&default(&place("0", "0.3")), "before all wheels");
    let notes = default(&place("0.01", "0.05")).notes;
    assert!(!notes.iter().any(|it| it.contains("centre of mass")), "{notes:?}");
}

#[test]
fn expressions_of_xacro_in_numbers_are_named() {
    for written in ["$(optenv IMU 0 0 1)", "${x} 0 0"] {
        let text = cart(CYLINDER, "").replacen("0.2 0.2 -0.1", written, 1);
        let refused = refused(&text).to_string();
        assert!(
            refused.contains("joint fl_joint: xyz") && refused.contains("xacro FILE"),
            "{refused}"
        );
    }
}

/// Wheels on rockers stand on one plane too, however their rockers stand at zero.
#[test]
fn wheels_on_rockers_are_put_on_one_plane() {
    let text = rockers(" multiplier=\"-1\"", "0 1 0").replace("-0.2 0 -0.1", "-0.2 0 -0.102");
    check_says(&default(&text), "0.001 m higher or lower");
    assert!(read(&text, &UrdfOptions::default()).expect("rockers").value.suspension().is_some());
}

/// A wheel may stand turned about its axle by any angle.
#[test]
fn meshes_may_be_turned_about_their_axles() {
    let shape = |turned: &str| {
        format!(
            "<collision><origin rpy=\"{turned}\"/><geometry><mesh filename=\"a.stl\"/></geometry>\
             </collision>"
        )
    };
    let mesh = |_: &str| Some(box_of_stl([0.09, 0.03, 0.09]));
    let read = |turned: &str| {
        crate::urdf::import(cart(&shape(turned), ""), &UrdfOptions::default(), &mesh)
    };
    let wheel = &read("0 0.7 0").expect("a wheel").wheels[0];
    assert!((wheel.radius - 0.09).abs() < 1e-9 && (wheel.width - 0.06).abs() < 1e-9, "{wheel:?}");
    // Its axle points up, and forward.
    assert!(read("1.5708 0 0").is_err() && read("0 0 1.5708").is_err());
}
