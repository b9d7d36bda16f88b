//! Grouser predicts how a wheeled rover moves on loose soil: sinkage, slip, drift on slopes, the
//! heading that holds the contour line, and energy.
//!
//! It grows from one paper, the dynamics simulator of HAKUTO's four-wheel micro rover, which the
//! documentation calls [FourWheel].
//!
//! # The layers
//!
//! A module uses those below it, never those above. The lower four come from the crate
//! `grouser-core`; [`document`] has all of the crate `grouser-io`, and the documents and results of
//! studies.
//!
//! | layer | modules | contents |
//! |---|---|---|
//! | answers | [`answers`] | questions with their answers: tables, figures and sentences |
//! | documents | [`document`] | documents with units in their names, presets, results as tables |
//! | studies | [`studies`] | wheel tests, heading offsets, calibration, campaigns, the paper's comparison |
//! | simulation | [`simulation`] | a run, from its scenario to its trajectory |
//! | vehicle | [`vehicle`] | the rover: loads, motion, drives |
//! | contact | [`contact`] | what the soil does to one wheel |
//! | foundations | [`units`] [`error`] [`soil`] [`wheel`] [`terrain`] | what things are |
//!
//! Inside, everything is in SI units and radians; [`document`] converts. There is no file, clock or
//! printing in the physics: a [`Scenario`](simulation::Scenario) alone determines its
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
//! let attitude = HeadingStudy::of(&scenario).curve()?.at(deg(10.0))?;
//! assert!((attitude.yaw - deg(5.03)).abs() < deg(0.01));
//!
//! let start = Start { yaw: attitude.yaw, ..scenario.start };
//! let run = Run::new(&Scenario { start, ..scenario })?.to_end()?;
//! assert_eq!(run.outcome, Outcome::Completed);
//! // The moment that is left over turns the nose downhill by 1.2°: a tenth of the drift remains.
//! assert!(run.last().state.position.y.abs() < 0.015);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The folder `examples` has programs to start from: a wheel on sand, a heading on a slope, a rover
//! of your own, a controller that holds the contour, and the band of an uncertain soil.

pub use grouser_core::{
    contact, difference, error, mission, paper, simulation, soil, terrain, units, vehicle, wheel,
};
use grouser_core::{elementary, newton, root};

pub mod answers;
pub mod document;
pub mod studies;
