//! Rovers from URDF, the format in which robots are described to ROS.
//!
//! Links that roll, reach the ground and come in pairs become wheels, and all other links the body.
//! Joints about an axis across the rover between the two are rockers and bogies, joints about an
//! upright axis steer; what slides is taken as it stands at zero. Lengths are metres, the root
//! link's x axis points forward unless a caller says otherwise, y to the left, z up (REP 103).
//!
//! Source of the format: "URDF XML Specification", wiki.ros.org/urdf/XML.

mod error;
mod found;
mod inertia;
mod links;
mod mesh;
mod options;
mod rover;
mod shapes;
mod suspension;
#[cfg(test)]
mod tests;
mod tree;
mod xml;

use std::borrow::Cow;

pub use error::UrdfError;
pub use found::FoundWheel;
pub use mesh::meshes_beside;
pub use options::{Forward, UrdfOptions};
pub use shapes::Meshes;

use self::rover::Found;
use self::tree::Robot;

/// The largest file of URDF [bytes]: meshes stand in files of their own.
pub const LARGEST_FILE: u64 = 16 << 20;

/// A rover that was found in URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfRover {
    /// Its document, `rover/1`.
    pub toml: String,
    /// What was taken for granted on the way, a sentence each.
    pub notes: Vec<String>,
    /// The wheels that were found.
    pub wheels: Vec<FoundWheel>,
}

/// Makes a rover's document of URDF.
///
/// How heavy is the body of a cart on three wheels?
///
/// ```
/// use grouser_io::{Overrides, Source, read_rover};
/// use grouser_io::urdf::{UrdfOptions, import};
///
/// let wheel = |name: &str, x: f64, y: f64| format!(
///     r#"<link name="{name}"><inertial><mass value="0.5"/>
///          <inertia ixx="2e-3" iyy="3e-3" izz="2e-3" ixy="0" ixz="0" iyz="0"/></inertial>
///          <collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.1" length="0.08"/></geometry></collision>
///        </link>
///        <joint name="{name}-axle" type="continuous"><parent link="body"/><child link="{name}"/>
///          <origin xyz="{x} {y} -0.1"/><axis xyz="0 1 0"/></joint>"#
/// );
/// let wheels = wheel("left", 0.2, 0.2) + &wheel("right", 0.2, -0.2) + &wheel("rear", -0.3, 0.0);
/// let robot = format!(
///     r#"<robot name="cart"><link name="body"><inertial><mass value="5"/>
///          <inertia ixx="0.1" iyy="0.1" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>{wheels}</robot>"#
/// );
/// let no_meshes = |_: &str| None;
/// let found = import(&robot, &UrdfOptions::default(), &no_meshes)?;
/// let rover = read_rover(&Source::text("cart", found.toml), &Overrides::none())?.value;
/// assert_eq!(rover.body().mass, 5.0);
/// assert_eq!(rover.mounts()[2].name, "rear");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// * `meshes`: looks up a mesh by its name in URDF, for the size of wheels
///
/// # Errors
/// [`UrdfError`], which names the link or the joint.
pub fn import(
    text: impl AsRef<[u8]>,
    options: &UrdfOptions,
    meshes: &Meshes<'_>,
) -> Result<UrdfRover, UrdfError> {
    let text = decoded(text.as_ref())?;
    let robot = Robot::read(&text, options.forward)?;
    let found = Found::of(&robot, options, meshes)?;
    let toml = found.to_toml(&robot.name);
    Ok(UrdfRover { toml, notes: found.notes, wheels: found.wheels })
}

/// UTF-8, or else Latin-1, whose letters stand in comments and names of authors.
fn decoded(bytes: &[u8]) -> Result<Cow<'_, str>, UrdfError> {
    if bytes.contains(&0) || bytes.starts_with(&[0xff, 0xfe]) {
        return Err(UrdfError::NoText);
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect::<String>().into(),
    })
}
