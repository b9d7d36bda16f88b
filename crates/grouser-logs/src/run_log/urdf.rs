//! A rover as URDF, the format in which robots are described to ROS: body and wheels with their
//! masses and inertias.
//!
//! Each wheel hangs on two joints: one that slides up as it sinks in, whose zero is the mount of
//! the document, and one that rolls. Source of the format: "URDF XML Specification",
//! wiki.ros.org/urdf/XML.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use grouser_core::vehicle::{Inertia, Rover};
use grouser_draw::rover::{Block, Likeness};
use grouser_draw::style::{Ground, Role};

use crate::run_log::frames::{BODY, WheelName};

/// The document.
///
/// * `title`: what the rover is called
pub(crate) fn of(title: &str, rover: &Rover, names: &[WheelName]) -> String {
    let likeness = Likeness::of(rover);
    let mut text = format!("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", escaped(title));
    for (name, role) in [("body", Role::BodyLit), ("wheel", Role::Wheel)] {
        let [r, g, b] = role.on(Ground::Light).parts();
        let _ = writeln!(
            text,
            "  <material name=\"{name}\"><color rgba=\"{r} {g} {b} 1\"/></material>"
        );
    }
    let body = rover.body();
    let _ = writeln!(text, "  <link name=\"{BODY}\">");
    inertial(&mut text, body.mass, body.inertia);
    for block in [&likeness.body, &likeness.mast, &likeness.head] {
        visual_of_block(&mut text, block);
    }
    text += "  </link>\n";
    for (mount, WheelName { frame, rim, .. }) in rover.mounts().iter().zip(names) {
        let (radius, width) = (mount.unit.wheel.radius, mount.unit.wheel.width);
        let [x, y, z] = [0, 1, 2].map(|axis| mount.position[axis]);
        let (steering, reach) = (mount.steering, mount.shearing_radius());
        let _ = writeln!(
            text,
            "  <link name=\"{frame}\"/>\n  <joint name=\"{frame}\" type=\"prismatic\">\
             <parent link=\"{BODY}\"/><child link=\"{frame}\"/><origin xyz=\"{x} {y} {z}\" rpy=\"0 0 {steering}\"/>\
             <axis xyz=\"0 0 1\"/><limit lower=\"-{reach}\" upper=\"{reach}\" effort=\"0\" velocity=\"0\"/></joint>"
        );
        let _ = writeln!(text, "  <link name=\"{rim}\">");
        inertial(&mut text, mount.unit.mass, mount.unit.inertia);
        // A cylinder of the format is about z, a wheel about y.
        let _ = writeln!(
            text,
            "    <visual><origin xyz=\"0 0 0\" rpy=\"{} 0 0\"/><geometry><cylinder radius=\"{radius}\" \
             length=\"{width}\"/></geometry><material name=\"wheel\"/></visual>\n  </link>",
            0.25 * TAU
        );
        let _ = writeln!(
            text,
            "  <joint name=\"{rim}\" type=\"continuous\"><parent link=\"{frame}\"/><child \
             link=\"{rim}\"/><axis xyz=\"0 1 0\"/></joint>"
        );
    }
    text + "</robot>\n"
}

fn inertial(text: &mut String, mass: f64, inertia: Inertia) {
    let Inertia { xx, yy, zz } = inertia;
    let _ = writeln!(
        text,
        "    <inertial><mass value=\"{mass}\"/><inertia ixx=\"{xx}\" iyy=\"{yy}\" izz=\"{zz}\" \
         ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
    );
}

fn visual_of_block(text: &mut String, block: &Block) {
    let (middle, size) = (0.5 * (block.low + block.high), block.high - block.low);
    let _ = writeln!(
        text,
        "    <visual><origin xyz=\"{} {} {}\"/><geometry><box size=\"{} {} \
         {}\"/></geometry><material name=\"body\"/></visual>",
        middle.x, middle.y, middle.z, size.x, size.y, size.z
    );
}

fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            // XML has no place for these.
            control if control.is_control() => safe.push(' '),
            other => safe.push(other),
        }
    }
    safe
}
