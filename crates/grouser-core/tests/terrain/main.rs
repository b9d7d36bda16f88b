//! What the ground of elevation models and of formulas repeats.

mod elevation;
mod lunar;
mod surface;
mod zones;

#[path = "../../examples/by_hand/hakuto.rs"]
#[allow(dead_code, unused_imports, reason = "of the rover only its sand is needed here")]
mod hakuto;
