//! The claims of the library, tested from outside.

mod documents;
mod extended;
mod floors;
mod given;
mod laws;
mod million;
mod paper;
mod reference;
mod rft;
mod rover;
mod runs;
