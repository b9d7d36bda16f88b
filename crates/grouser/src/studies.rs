//! Floor 4: questions about a wheel or a rover, answered with the floors below.
//!
//! [`wheel_test`] is the single-wheel test stand, [`attitude`] the yaw that keeps a traverse level,
//! [`attitude_band`] the same where the soil is uncertain, with what [`uncertainty`] knows of draws,
//! [`measurement`] what a real stand reads, [`comparison`] the metrics by which the source paper
//! judges a run, and [`reproduction`] runs the whole of its study again.

pub mod attitude;
pub mod attitude_band;
pub mod comparison;
pub mod measurement;
pub mod reproduction;
pub mod uncertainty;
pub mod wheel_test;
