//! Floor 4: questions about a wheel or a rover, answered with the floors below.
//!
//! [`wheel_test`] is the single-wheel test stand, [`attitude`] the yaw that keeps a traverse level,
//! [`measurement`] what a real stand reads, [`comparison`] the metrics by which the source paper
//! judges a run, [`validation`] judges a theory by measured wheel tests, [`simulated_test`] makes
//! such tests with a known truth, and [`reproduction`] runs the whole of the paper's study again.

pub mod attitude;
pub mod comparison;
pub mod measurement;
pub mod reproduction;
pub mod simulated_test;
pub mod validation;
pub mod wheel_test;
