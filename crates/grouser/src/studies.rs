//! Layer 4, studies: computations for engineers, made of the wheel–soil models and runs of the
//! layers below.
//!
//! | study | computes |
//! |---|---|
//! | [`wheel_test`] | forces and sinkage on a single-wheel test stand |
//! | [`design`] | numbers of a rover that are found: the least of an aim under limits |
//! | [`wheel_test_band`] | the same where soil and model are uncertain |
//! | [`heading`] | the heading offset that holds the contour on a slope |
//! | [`heading_map`], [`heading_band`] | the same for other courses and soils, and where soil and model are uncertain |
//! | [`mobility`] | the same as tables over slope, to read maps and routes from |
//! | [`route`] | the cheapest way over ground with heights: in time, work or risk |
//! | [`wheel_speeds`] | contour traverses with wheels at speeds of their own |
//! | [`verdict`] | what to do on a slope: the heading to set, go or no-go, and why |
//! | [`card`] | the operator's card: that on every slope, with slip, drift and power |
//! | [`forecast`] | slip, drift, heading and steepest slope under another gravity, with one error budget |
//! | [`simulated_telemetry`] | what instruments with their faults say of a drive |
//! | [`measurement`], [`simulated_test`] | measured wheel tests, and simulated ones whose soil is known |
//! | [`validation`], [`slope_validation`], [`drive_validation`] | the errors of wheel–soil models against measured wheels, a measured rover on slopes, and recorded drives |
//! | [`evidence`] | what the models have achieved, and the weights that follow |
//! | [`calibration`] | soil parameters, with confidence intervals, from measurements |
//! | [`ensemble`] | Monte Carlo: samples of uncertain inputs, and statistics of the results |
//! | [`drive`], [`comparison`] | a traverse in a few numbers, and the source paper's metrics of one |
//! | [`traverse_band`] | a traverse where soil and model are uncertain |
//! | [`slip_from_current`] | each wheel's slip from its motor's current and speed |
//! | [`learn`] | what driving tells of a soil: slip and heading of the next slopes, from telemetry |
//! | [`replay`] | a drive that was measured beside the one that is predicted, and what their differences point to |
//! | [`mission`] | missions and their alternatives, leg by leg |
//! | [`validity`] | the flags of a rover on a slope and over a run |
//! | [`lost_yaw`] | the yaw lost on the way: by loads, and by soil and motors that scatter |
//! | [`reproduction`] | the whole of the paper's study |

pub mod calibration;
pub mod card;
pub mod comparison;
pub mod completion;
pub mod design;
pub mod drive;
pub mod drive_validation;
pub mod ensemble;
pub mod evidence;
pub mod forecast;
pub mod heading;
pub mod heading_band;
pub mod heading_map;
pub mod learn;
pub mod lost_yaw;
pub mod mission;
pub mod mobility;
pub mod replay;
pub mod reproduction;
pub mod route;
pub mod simulated_telemetry;
pub mod simulated_test;
pub mod slip_from_current;
pub mod slope_validation;
pub mod traverse_band;
pub mod validation;
pub mod validity;
pub mod verdict;
pub mod wheel_speeds;
pub mod wheel_test;
pub mod wheel_test_band;
pub mod zones_met;

pub use grouser_io::measurements::{slope_tests, wheel_tests as measurement};
use grouser_io::statistics::random;
