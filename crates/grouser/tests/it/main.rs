//! The claims of the library, tested from outside.

mod documents;
mod floors;
mod reference;
