//! The claims of the library, tested from outside.

mod floors;
mod reference;
