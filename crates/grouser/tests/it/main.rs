//! The claims of the library, tested from outside.

mod documents;
mod extended;
mod floors;
mod given;
mod laws;
mod measured;
mod measurements;
mod million;
mod paper;
mod reference;
mod rover;
mod runs;
mod simulated;
