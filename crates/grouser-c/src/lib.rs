//! The C interface of Grouser: wheels, rovers and missions on loose soil for programs in any
//! language. `include/grouser.h` is made of this crate by `cargo xtask c --header`, `docs/guide/c.md`
//! explains it.
//!
//! It computes nothing: documents are read by `grouser-io`, as the program and Python read them, and
//! all else is `grouser-core`'s. Numbers are in SI units and radians, each with its unit in its
//! name.
//!
//! | module | contents |
//! |---|---|
//! | [`wheel_test`] | a wheel on a soil: forces and sinkage of arrays of wheels |
//! | [`time_step`] | the soil's reaction over a time step of another engine |
//! | [`ground`] | the planes under the wheels of another engine |
//! | [`run`] | a rover step by step, its state saved and restored |
//! | [`mission`] | a mission leg by leg |
//! | [`values`] | the structs that C reads |
//! | [`status`] | codes, the last error, and the one place where panics end |
//! | `handles`, `pointers` | what C hands over, checked before it is used |

#![allow(
    unsafe_code,
    reason = "functions for C are exported by name and take pointers; `pointers` checks them"
)]
#![allow(
    clippy::missing_safety_doc,
    clippy::missing_errors_doc,
    reason = "the doc comments are the header's, whose first lines have the rules for all functions"
)]

mod documents;
pub mod ground;
mod handles;
pub mod mission;
mod pointers;
pub mod run;
pub mod status;
pub mod time_step;
pub mod values;
pub mod wheel_test;
