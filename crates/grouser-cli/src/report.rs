//! Reports: one HTML page for each output folder, and what the report of `reproduce` is made of.

pub(crate) mod answer;
pub(crate) mod experiment;
pub(crate) mod figures;
pub(crate) mod outlines;
pub(crate) mod page;
pub(crate) mod tables;

/// The name of the page in an output folder.
pub(crate) const REPORT: &str = "report.html";
