//! What the ground of elevation models and of formulas repeats.

mod elevation;
mod lunar;
mod surface;
mod zones;
