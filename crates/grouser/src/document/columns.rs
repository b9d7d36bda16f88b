//! The columns of results: those of `grouser-io`, and those of studies.

pub mod advice;
pub mod card;
pub mod card_courses;
pub mod card_days;
pub mod card_drives;
pub mod completion;
pub mod design;
pub mod drives;
mod ended;
pub mod fit;
pub mod forecast;
pub mod gradient;
pub mod heading;
pub mod learn;
pub mod map;
pub mod mission;
pub mod replay;
pub mod roughness;
pub mod route;
pub mod run;
pub mod slip_from_current;
pub mod slope;
pub mod stand;
pub mod verdict;
pub mod wheel_speeds;
pub mod wheel_test;

pub use grouser_io::columns::*;
