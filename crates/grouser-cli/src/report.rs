//! The report of `reproduce`: figures, tables and the page that holds them.

pub(crate) mod experiment;
pub(crate) mod figures;
pub(crate) mod outlines;
pub(crate) mod page;
pub(crate) mod tables;
