//! Elements and attributes of URDF, with what is wrong with them.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::error::UrdfError;

pub(super) fn child<'a, 'input>(node: Node<'a, 'input>, tag: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|node| node.has_tag_name(tag))
}

pub(super) fn attribute<'a>(
    node: Node<'a, '_>,
    what: &str,
    name: &'static str,
) -> Result<&'a str, UrdfError> {
    node.attribute(name).ok_or_else(|| UrdfError::Lacks { what: what.to_owned(), lacks: name })
}

/// The error of a text that is not what is expected; of an expression of xacro it names the program
/// that expands it.
fn not_expected(
    what: &str,
    attribute: &'static str,
    written: &str,
    expected: &'static str,
) -> UrdfError {
    const XACRO: &str =
        "a number\nhint: that is xacro: xacro FILE > FILE.urdf writes numbers for ${…} and $(…)";
    let is_expression = written.contains("${") || written.contains("$(");
    UrdfError::Number {
        what: what.to_owned(),
        attribute,
        written: written.chars().take(40).collect(),
        expected: if is_expression { XACRO } else { expected },
    }
}

pub(super) fn number(
    node: Node<'_, '_>,
    what: &str,
    name: &'static str,
    may_be: impl Fn(f64) -> bool,
    expected: &'static str,
) -> Result<f64, UrdfError> {
    /// What is larger is no rover's, in any unit of URDF.
    const LARGEST: f64 = 1e9;
    let written = attribute(node, what, name)?;
    let number = written.trim().parse().ok();
    let number = number.filter(|it: &f64| it.abs() <= LARGEST && may_be(*it));
    number.ok_or_else(|| not_expected(what, name, written, expected))
}

pub(super) fn triple(
    node: Node<'_, '_>,
    what: &str,
    name: &'static str,
) -> Result<Vector3<f64>, UrdfError> {
    let Some(written) = node.attribute(name) else { return Ok(Vector3::zeros()) };
    let parts: Vec<f64> = written
        .split_whitespace()
        .filter_map(|part| part.parse().ok())
        .filter(|part: &f64| part.is_finite() && part.abs() <= 1e9)
        .collect();
    let is_whole = written.split_whitespace().count() == 3;
    match parts[..] {
        [x, y, z] if is_whole => Ok(Vector3::new(x, y, z)),
        _ => Err(not_expected(what, name, written, "three numbers")),
    }
}

/// The `<origin>` in an element: a place, and roll, pitch and yaw about fixed axes.
pub(super) fn origin(node: Node<'_, '_>, what: &str) -> Result<Isometry3<f64>, UrdfError> {
    let Some(origin) = child(node, "origin") else { return Ok(Isometry3::identity()) };
    let (place, turned) = (triple(origin, what, "xyz")?, triple(origin, what, "rpy")?);
    let rotation = UnitQuaternion::from_euler_angles(turned.x, turned.y, turned.z);
    Ok(Isometry3::from_parts(Translation3::from(place), rotation))
}
