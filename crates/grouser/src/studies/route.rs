//! The cheapest way for a rover over ground with heights: in time, in work, or in what it risks.
//!
//! Ways lead over a lattice of the ground's points, in sixteen directions; a way over level ground is at most 2.8 %
//! longer than the straight line. What a metre costs comes from the [tables](super::mobility) of the steady motion that
//! holds its course: by how steeply the ground rises along the way and across it. Turns are made on the spot, and cost
//! what a turn on level ground does. No way leads where no heading holds the course, or where more of the samples than
//! the [`Limits`] allow say no-go.
//!
//! A way at the least *risk* is the one whose time is least in the worst tenth of the samples of soil and model: for each
//! metre the mean over those, the conditional value at risk, in which a sample that is stuck counts as a detour of
//! [`STUCK_WAY`]. That adds up along the way if one soil is the better one everywhere, as it is where the soil of the
//! whole ground is not known.

mod answer;
mod costs;
mod drive;
mod moves;
mod search;
mod seek;
mod study;

pub use self::answer::{Answer, Ends, MOST_CELLS, NoRoute, Route, RouteError};
pub use self::costs::{COURSES, RouteTables};
pub use self::drive::DrivenRoute;
pub use self::study::{Limits, Objective, RouteStudy, STUCK_WAY, WORST_SHARE};

#[cfg(test)]
mod tests;
