//! `--gradients`: derivatives beside the results, in every format, and what is refused.

use serde_json::Value;

use crate::program::{error_of, json_of, stdout_of};

const FRICTION: &str = "soil.friction_angle_deg";
const RADIUS: &str = "rover.wheel_unit.wheel.radius_m";

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name} in {row}"))
}
