//! Benchmarks: units of work that measure Grouser's speed, each with the accuracy that it reaches.
//!
//! One home for what the program `grouser-bench` measures, `cargo bench` compares and the count of
//! instructions watches. Everything is fixed: the same wheels, rovers and soils at every call, so
//! that two measurements differ by the code and the machine alone. There is no clock here.

mod accuracy;
mod arrays;
pub mod costs;
mod fixtures;
mod unit;

pub use accuracy::Accuracy;
pub use arrays::Arrays;
pub use fixtures::Fixtures;
pub use unit::{Done, OPERATIONS_OF_A_FORCE, StepCommands, Unit, controlled};

/// Threads that [`Unit::Campaign`] uses.
#[must_use]
pub fn threads() -> usize {
    rayon::current_num_threads()
}
