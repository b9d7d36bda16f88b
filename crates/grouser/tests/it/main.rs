//! The claims of the library, tested from outside.

mod documents;
mod extended;
mod floors;
mod reference;
