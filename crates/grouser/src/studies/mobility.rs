//! What a rover does on any slope of a soil, as tables that millions of places are read from.
//!
//! A [`MobilityTable`] has one course: a direction of travel, counted from the contour and positive uphill. Its
//! numbers are those of the [heading offset](super::heading) that holds the course, at nodes that lie closer the
//! nearer the steepest slope is. There slip and crab angle rise with a vertical tangent, like a square root; over
//!
//! ```text
//! v = 1 − √(1 − α/α_max)        α = α_max v (2 − v)
//! ```
//!
//! they have none, and straight lines between nodes meet them closely. How closely is measured while the table is
//! made, half-way between nodes, and stated with it ([`MobilityTable::largest_errors`]).
//!
//! How likely a slope is a no-go comes from samples of soil and model: each has a steepest slope on which a heading
//! holds the course and slips no more than the [`Rule`] allows, and the probability at a slope is the share of the
//! samples whose steepest is below it. No curve in between is stored: the steepest slopes, sorted, say it exactly.

mod choice;
mod detail;
mod ground;
mod map;
mod table;
mod thresholds;

pub use self::choice::CourseChoice;
pub(super) use self::detail::Detail;
pub use self::ground::Ground;
pub use self::map::{CellMotion, MobilityMap};
pub use self::table::{Mobility, MobilityStudy, MobilityTable, OnSlope};

#[cfg(test)]
mod tests;
