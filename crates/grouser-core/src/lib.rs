//! The physics of Grouser: what loose soil does to a wheel, and how a rover on such wheels moves.
//!
//! Everything is in SI units and radians. There is no file, thread, clock or printing here: a
//! [`Scenario`](simulation::Scenario) alone determines its [`Trajectory`](simulation::Trajectory),
//! bit for bit. What a rover does is a value (it may get stuck, slide or tip over); what cannot be
//! computed is an error.
//!
//! A module uses those below it, never those above:
//!
//! | layer | modules | what they are about |
//! |---|---|---|
//! | mission | [`mission`] | legs, and limits at which to stop |
//! | simulation | [`simulation`] | a run, from its scenario to its trajectory |
//! | vehicle | [`vehicle`] | the rover: loads, motion, drives |
//! | contact | [`contact`] | what the soil does to one wheel |
//! | foundations | [`units`] [`error`] [`elementary`] [`root`] [`newton`] [`difference`] [`soil`] [`wheel`] [`terrain`] | numbers and things |
//!
//! The examples of the types take Toyoura sand and the HAKUTO rover from [`paper`], which makes
//! both value by value.
//!
//! Most users take the crate `grouser`, which has these modules too, and reads documents,
//! calibrates and studies. This crate is for those who bring their own of all that, for example
//! inside another simulator or in a browser.

pub mod contact;
pub mod difference;
pub mod elementary;
pub mod error;
mod lagrange;
pub mod mission;
pub mod newton;
pub mod paper;
mod peak;
mod random;
pub mod root;
pub mod simulation;
pub mod soil;
mod stored;
pub mod terrain;
pub mod units;
pub mod vehicle;
pub mod wheel;
