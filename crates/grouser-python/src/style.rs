//! The colours of pictures, and where names of curves find room.

use grouser_draw::Colour;
use grouser_draw::labels;
use grouser_draw::style::{Ground, Role, series};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Codes of colours by what they stand for.
#[pyfunction]
pub(crate) fn style_colours(py: Python<'_>, dark: bool) -> PyResult<Bound<'_, PyDict>> {
    let ground = if dark { Ground::Dark } else { Ground::Light };
    let dict = PyDict::new(py);
    dict.set_item("series", series(ground).map(Colour::code))?;
    let roles =
        [("ink", Role::Ink), ("paper", Role::Paper), ("faint", Role::Faint), ("grid", Role::Grid)];
    for (name, role) in roles {
        dict.set_item(name, [role.on(ground).code()])?;
    }
    Ok(dict)
}

/// Middles of names as near to the wanted ones as their heights allow.
///
/// * `wanted`: ascending
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn spread_labels(wanted: Vec<f64>, heights: Vec<f64>, room: (f64, f64)) -> Vec<f64> {
    labels::spread(&wanted, &heights, [room.0, room.1])
}
