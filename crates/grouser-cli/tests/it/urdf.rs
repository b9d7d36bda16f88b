//! `import-urdf`: kinds of descriptions that went wrong, each with its value, message or exit code.

use crate::bad_input::check_is_refusal;
use crate::program::Place;

const AXIS: &str = "<axis xyz=\"0 1 0\"/>";

fn link(name: &str, mass: f64, inertia: f64, shapes: &str) -> String {
    format!(
        "<link name=\"{name}\"><inertial><mass value=\"{mass}\"/><inertia ixx=\"{inertia}\" \
         iyy=\"{inertia}\" izz=\"{inertia}\"/></inertial>{shapes}</link>"
    )
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], at: &str, rest: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child \
         link=\"{child}\"/><origin xyz=\"{at}\"/>{rest}</joint>"
    )
}

/// A cylinder that lies across [m].
fn rim(radius: f64, width: f64) -> String {
    format!(
        "<collision><origin rpy=\"1.5707963 0 0\"/><geometry><cylinder radius=\"{radius}\" \
         length=\"{width}\"/></geometry></collision>"
    )
}

/// Four wheels on a body, and what else there is.
fn cart(shapes: &str, rest: &str) -> String {
    let mut text = link("body", 6.0, 0.2, "");
    for (name, at) in [
        ("fl", "0.2 0.2 -0.1"),
        ("fr", "0.2 -0.2 -0.1"),
        ("rl", "-0.2 0.2 -0.1"),
        ("rr", "-0.2 -0.2 -0.1"),
    ] {
        text += &link(name, 0.5, 0.002, shapes);
        text += &joint(&format!("{name}_joint"), "continuous", ["body", name], at, AXIS);
    }
    text + rest
}

/// Four wheels on two rockers, the right one of which turns so far for a turn of the left one.
fn rockers(multiplier: &str) -> String {
    let mut text = link("body", 6.0, 0.2, "");
    for (side, y) in [("left", 0.2), ("right", -0.2)] {
        let rocker = format!("{side}_rocker");
        text += &link(&rocker, 0.4, 0.01, "");
        let limit = "<limit lower=\"-0.3\" upper=\"0.3\"/>";
        let mimic = format!("<mimic joint=\"left_rocker_joint\" multiplier=\"{multiplier}\"/>");
        let rest = format!("{AXIS}{limit}{}", if side == "right" { &*mimic } else { "" });
        let at = format!("0 {y} 0");
        text += &joint(&format!("{rocker}_joint"), "revolute", ["body", &rocker], &at, &rest);
        for (end, at) in [("front", "0.2 0 -0.1"), ("rear", "-0.2 0 -0.1")] {
            let wheel = format!("{side}_{end}");
            text += &link(&wheel, 0.5, 0.002, &rim(0.1, 0.08));
            let name = format!("{wheel}_joint");
            text += &joint(&name, "continuous", [&rocker, &wheel], at, AXIS);
        }
    }
    text
}

fn drums() -> String {
    let drum = |name: &str, at: &str| {
        link(name, 0.5, 0.002, &rim(0.12, 0.5))
            + &joint(&format!("{name}_joint"), "continuous", ["body", name], at, AXIS)
    };
    drum("drum_front", "0.4 0 -0.05") + &drum("drum_back", "-0.4 0 -0.05")
}

/// Wheels on sliding struts.
fn sprung() -> String {
    let struts: String = ["fl", "fr", "rl", "rr"]
        .iter()
        .map(|name| {
            let strut = format!("{name}_strut");
            let axis = "<axis xyz=\"0 0 1\"/>";
            let sus = format!("{name}_sus");
            link(&strut, 0.1, 1e-4, "") + &joint(&sus, "prismatic", ["body", &strut], "0 0 0", axis)
        })
        .collect();
    let mut text = cart(&rim(0.1, 0.08), &struts);
    for name in ["fl", "fr", "rl", "rr"] {
        let [old, new] = ["body".to_owned(), format!("{name}_strut")]
            .map(|it| format!("<parent link=\"{it}\"/><child link=\"{name}\"/>"));
        text = text.replace(&old, &new);
    }
    text
}

/// Tracks: sprockets and idlers above the rollers on the ground.
fn tracks() -> String {
    let upper = |name: &str, at: &str| {
        link(name, 0.5, 0.002, &rim(0.1, 0.08))
            + &joint(&format!("{name}_joint"), "continuous", ["body", name], at, AXIS)
    };
    let upper = upper("sprocket_l", "0.4 0.2 0.05")
        + &upper("sprocket_r", "0.4 -0.2 0.05")
        + &upper("idler_l", "-0.4 0.2 0.05")
        + &upper("idler_r", "-0.4 -0.2 0.05");
    cart(&rim(0.1, 0.08), &upper)
}

/// What a description, with flags, becomes.
fn import(robot: &str, flags: &str) -> (Place, crate::program::Answer) {
    let place = Place::new();
    place.write("robot.urdf", format!("<?xml version=\"1.0\"?><robot name=\"it\">{robot}</robot>"));
    let answer = place.line(&format!("import-urdf robot.urdf {flags} --out rover.toml"));
    (place, answer)
}

/// Each is a rover, of which its document or the notes say something.
#[test]
fn kinds_that_are_rovers() {
    let wheel = rim(0.1, 0.08);
    let mesh = "<collision><geometry><mesh filename=\"wheel.dae\"/></geometry></collision>";
    let sized = "--wheel-radius-m 0.1 --wheel-width-m 0.08";
    let mast = link("mast", 0.3, 0.001, "")
        + &joint("mast_joint", "fixed", ["body", "mast"], "0.1 0 0.3", "<axis xyz=\"0 0 0\"/>");
    let undeclared =
        "<gazebo><sensor:camera name=\"c\"><update>1</update></sensor:camera></gazebo>";
    let placeholder = cart(&wheel, "").replace("0.002", "1").replace("\"0.2\"", "\"1\"");
    let turned = cart(&wheel.replace("1.5707963 0 0", "0 1.5707963 0"), "")
        .replace(AXIS, "<axis xyz=\"1 0 0\"/>");
    let world = "<link name=\"world\"/>".to_owned()
        + &joint("root", "floating", ["world", "body"], "0 0 0.3", "");
    for (robot, flags, expected) in [
        (cart(&wheel, &mast), "", "mass_kg = 6.3"),
        (cart(&(rim(0.09, 0.08) + &rim(0.1, 0.05)), ""), "", "the largest of 0.09, 0.1 m"),
        (cart(&(rim(0.09, 0.08) + &rim(0.1, 0.05)), ""), "", "radius_m = 0.1, width_m = 0.05"),
        (cart(mesh, ""), sized, "radius_m = 0.1, width_m = 0.08"),
        (cart(mesh, &drums()), sized, "though they roll: drum_front, drum_back"),
        (rockers("-1"), "", "[suspension]"),
        (rockers("1"), "--rigid", "the rover is rigid"),
        (sprung(), "", "joint fl_sus slides, as springs do: the rover is taken as rigid"),
        (cart(&wheel, undeclared), "", "joint = \"fl_joint\""),
        (placeholder, "", "looks like a placeholder"),
        (turned, "--forward y", "position_m = [0.2, -0.2, -0.1]"),
        (cart(&wheel, &world), "", "mass_kg = 6.0"),
        (tracks(), "--wheels f* --wheels r*", "mass_kg = 8.0"),
    ] {
        let (place, answer) = import(&robot, flags);
        assert_eq!(answer.code(), 0, "{expected}: {}", answer.stderr);
        let document = place.read("rover.toml");
        assert!(document.contains(expected), "{expected}: {document}");
        assert_eq!(place.line("check rover.toml").code(), 0, "{expected}");
    }
}

/// Each is refused with what is wrong by the names of its links and joints, and what helps.
#[test]
fn kinds_that_are_refused() {
    let wheel = rim(0.1, 0.08);
    let mesh = "<collision><geometry><mesh filename=\"wheel.dae\"/></geometry></collision>";
    let turned = cart(&wheel.replace("1.5707963 0 0", "0 1.5707963 0"), "")
        .replace(AXIS, "<axis xyz=\"1 0 0\"/>");
    let caster = "<link name=\"caster\"><collision><geometry><sphere radius=\"0.05\"/></geometry>\
                  </collision></link>"
        .to_owned()
        + &joint("cj", "fixed", ["body", "caster"], "-0.2 0 -0.15", "");
    let two = link("body", 6.0, 0.2, "")
        + &link("left", 0.5, 0.002, &wheel)
        + &joint("left_joint", "continuous", ["body", "left"], "0 0.2 -0.1", AXIS)
        + &link("right", 0.5, 0.002, &wheel)
        + &joint("right_joint", "continuous", ["body", "right"], "0 -0.2 -0.1", AXIS)
        + &caster;
    let free = rockers("1").replace("<mimic joint=\"left_rocker_joint\" multiplier=\"1\"/>", "");
    for (robot, flags, message, help) in [
        (cart(mesh, ""), "", "link fl is a wheel", "--wheel-radius-m R --wheel-width-m B"),
        (two, "", "2 wheels (left, right) and a sphere of link caster", "three wheels at least"),
        (turned, "", "4 links roll about axes along x", "--forward y"),
        (rockers("1"), "", "left_rocker_joint and right_rocker_joint turn the same way", "--rigid"),
        (rockers("1"), "--differential", "turn the same way", "--rigid"),
        (free, "", "joint left_rocker_joint is a rocker", "--differential"),
        (tracks(), "", "looks like a tracked vehicle", "--wheels LINK"),
        (cart(&wheel, "<xacro:x/>"), "", "is xacro", "xacro FILE.xacro"),
        (cart(&wheel, "").replacen("0.2 0.2", "${x} 0.2", 1), "", "joint fl_joint", "xacro FILE"),
    ] {
        let (_, answer) = import(&robot, flags);
        let refused = check_is_refusal(&answer, 2);
        assert!(refused.contains(message) && refused.contains(help), "{message}: {refused}");
        assert!(!refused.contains("the rover of"), "{refused}");
    }
}

/// A file beside its meshes' folder, by its name alone.
#[test]
fn meshes_are_found_from_the_folder_of_the_file() {
    let mesh = "<collision><geometry><mesh filename=\"package://it/meshes/a.stl\"/></geometry>\
                </collision>";
    let place = Place::new();
    for folder in ["it/urdf", "it/meshes"] {
        std::fs::create_dir_all(place.file(folder)).expect("a folder");
    }
    place.write("it/urdf/robot.urdf", format!("<robot name=\"it\">{}</robot>", cart(mesh, "")));
    place.write("it/meshes/a.stl", "solid\nvertex -0.1 -0.04 -0.1\nvertex 0.1 0.04 0.1\n");
    let answer = place.shell("cd it/urdf && grouser import-urdf robot.urdf");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(answer.stdout.contains("radius_m = 0.1, width_m = 0.08"), "{}", answer.stdout);
}
