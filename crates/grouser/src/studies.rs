//! Layer 4, studies: questions about a wheel or a rover, answered with the layers below.
//!
//! [`wheel_test`] is the single-wheel test stand, [`attitude`] the yaw that keeps a traverse level,
//! [`attitude_map`] the same for other courses and several soils, [`attitude_band`] where the soil is uncertain,
//! [`card`] what an operator needs of all that, with go and no-go,
//! [`measurement`] what a real stand reads, [`simulated_test`] makes such readings with a known
//! truth, [`validation`] judges a theory by them, [`calibration`] finds the soil that they speak
//! for, [`ensemble`] computes many cases over what is not known exactly and has their statistics, [`drive`] is what is
//! kept of a traverse, [`comparison`] has the metrics by which the source paper judges a run, and
//! [`reproduction`] runs the whole of the paper's study again.

pub mod attitude;
pub mod attitude_band;
pub mod attitude_map;
pub mod calibration;
pub mod card;
pub mod comparison;
pub mod drive;
pub mod ensemble;
pub mod reproduction;
pub mod simulated_test;
pub mod validation;
pub mod wheel_test;

pub use grouser_io::measurements::wheel_tests as measurement;
use grouser_io::statistics::random;
