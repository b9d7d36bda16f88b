//! Rovers on loose soil as FMUs (functional mock-up units), FMI 3.0 for co-simulation: what other
//! simulation tools load. `docs/guide/fmi.md` explains it.
//!
//! One library serves all FMUs. What rover it is, on which ground, is said by the document in an
//! FMU's `resources`: a scenario or a mission, read as the program and Python read it. The program
//! writes the FMU around it, with the description that [`variables`] and this library's functions
//! agree on because both are made of the same list.
//!
//! | module | contents |
//! |---|---|
//! | [`drive`] | who turns the wheels |
//! | [`model`] | a document as a model: who turns the wheels, parameters, variables |
//! | [`variables`] | what an FMU says and takes, each with its unit and where it comes from |
//! | [`description`] | `modelDescription.xml` |
//! | [`contents`] | the files of an FMU |
//! | `motion` | the rover on its way |
//! | `instance` | an instance's phase, values and motion; saved as a value, and as bytes |
//! | [`functions`] | FMI's functions by their names, and the one place where panics end |

#![allow(
    unsafe_code,
    reason = "FMI's functions are exported by name and take pointers; `functions` checks them"
)]
#![allow(
    clippy::missing_safety_doc,
    reason = "what pointers must be is said by FMI, whose functions these are"
)]

pub mod contents;
pub mod description;
pub mod drive;
pub mod functions;
mod handles;
mod instance;
pub mod model;
mod motion;
mod units;
pub mod variables;
