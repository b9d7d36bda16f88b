//! Grouser predicts how a wheeled rover moves on loose soil: sinkage, slip, drift on slopes, the heading
//! that holds the contour line, and energy.
//!
//! It grows from one paper, the dynamics simulator of HAKUTO's four-wheel micro rover, which the
//! documentation calls [FourWheel].
//!
//! # The layers
//!
//! A module may use those below it, never those above:
//!
//! | layer | modules | contents |
//! |---|---|---|
//! | 5 I/O | [`document`] | documents with units in their names, presets, results as tables |
//! | 4 studies | [`studies`] | wheel tests, heading offsets, calibration, campaigns, the paper's comparison |
//! | 3 simulation | [`simulation`] | a run, from its scenario to its trajectory |
//! | 2 vehicle | [`vehicle`] | the rover: loads, motion, drives |
//! | 1 contact | [`contact`] | what the soil does to one wheel |
//! | 0 foundations | [`units`] [`error`] [`soil`] [`wheel`] [`terrain`] [`site`] | what things are |
//!
//! Inside, everything is in SI units and radians; [`document`] converts. Below it there is no
//! file, no clock and no printing: a [`Scenario`](simulation::Scenario) alone determines its
//! [`Trajectory`](simulation::Trajectory), bit for bit. What a rover does is a value (it may get
//! stuck, slide or tip over); what cannot be computed is an error.
//!
//! # An example
//!
//! The heading that holds the HAKUTO rover on the contour of a 10° slope, and a run with it:
//!
//! ```
//! use grouser::document::{self, Overrides, Source};
//! use grouser::simulation::{Outcome, Run, Scenario, Start};
//! use grouser::studies::heading::HeadingStudy;
//! use grouser::units::deg;
//!
//! // The default scenario: the paper's rover on Toyoura sand, on 10°, nose along the contour.
//! let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
//! let drift = Run::new(&scenario)?.to_end()?.last().state.position.y;
//! assert!(drift < -0.09); // 9 cm downhill in 20 s
//!
//! let attitude = HeadingStudy::of(&scenario).curve()?.at(scenario.site.terrain.slope)?;
//! assert!((attitude.yaw - deg(5.04)).abs() < deg(0.01));
//!
//! let start = Start { yaw: attitude.yaw, ..scenario.start };
//! let run = Run::new(&Scenario { start, ..scenario })?.to_end()?;
//! assert_eq!(run.outcome, Outcome::Completed);
//! assert!(run.last().state.position.y.abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The folder `examples` has programs to start from: a wheel on sand, a heading on a slope, a rover of your own, a
//! controller that holds the contour, and the band of an uncertain soil.

pub use grouser_core::{contact, error, simulation, site, soil, terrain, units, vehicle, wheel};
use grouser_core::{elementary, newton, root};

pub mod document;
pub mod studies;
