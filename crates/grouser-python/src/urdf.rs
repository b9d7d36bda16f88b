//! Rovers from URDF.

use std::path::PathBuf;

use grouser::document::urdf::{self, Forward, UrdfOptions};
use grouser::document::{self, LoadedRover, Overrides, Source, file};
use pyo3::prelude::*;

use crate::descriptions::Document;
use crate::errors;

/// A rover's document of a file of URDF.
///
/// * `named`: patterns of the links that are wheels, and of links that roll and are not driven
/// * `sizes`: radius and width of the wheels [m]
/// * `has`: a differential between the rockers; a rigid rover
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
pub(crate) fn rover_of_urdf(
    path: PathBuf,
    named: [Vec<String>; 2],
    sizes: [Option<f64>; 2],
    forward: &str,
    has: [bool; 2],
) -> PyResult<Document> {
    let name = path.display().to_string();
    let bytes =
        file::read(&path, urdf::LARGEST_FILE).map_err(|error| errors::unread(&error, &name))?;
    let [wheels, passive] = named;
    let options = UrdfOptions {
        wheels,
        passive,
        wheel_radius: sizes[0],
        wheel_width: sizes[1],
        forward: along(forward)?,
        has_differential: has[0],
        is_rigid: has[1],
    };
    let found = urdf::import(bytes, &options, &urdf::meshes_beside(&path))
        .map_err(|error| errors::of_urdf(&error, &name))?;
    let source = Source::text(format!("the rover of {name}"), found.toml);
    let rover: LoadedRover = document::read_rover(&source, &Overrides::none())
        .map_err(|error| errors::of_document(&error, &[]))?;
    Ok(Document::of_rover(rover))
}

fn along(forward: &str) -> PyResult<Forward> {
    Forward::named(forward).ok_or_else(|| {
        let message = format!("forward is \"{forward}\", it must be x, y, -x or -y");
        errors::parameter(message, "forward", None, "x, y, -x or -y")
    })
}
