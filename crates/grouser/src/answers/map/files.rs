//! What was made of a map: its files, and their numbers in all.

use crate::document::columns::{Column, maybe, text, whole};
use crate::document::unit::{ONE, Unit};
use crate::studies::mobility::MobilityMap;

/// A map that was made.
#[derive(Clone, Debug)]
pub struct MadeMap<'m> {
    /// Its tables.
    pub map: &'m MobilityMap,
    /// A file for each of its bands.
    pub files: &'m [MapFile],
    /// How many places have which verdict.
    pub verdicts: VerdictCounts,
    /// Where the areas are that nobody may go into, or why there is no such file.
    pub keep_out: Result<String, &'static str>,
    /// Where its page is.
    pub page: String,
}

/// The file of a band, and the band's numbers in all.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// The band's name.
    pub name: &'static str,
    /// The unit of its numbers.
    pub unit: Unit,
    /// What it is.
    pub about: &'static str,
    /// The least of its numbers, in its unit; NaN where no place has one.
    pub least: f64,
    /// Their mean.
    pub mean: f64,
    /// The largest.
    pub most: f64,
    /// How many places have a number.
    pub cells: u64,
    /// Where the file is.
    pub path: String,
}

/// How many places have which verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VerdictCounts {
    /// Drive.
    pub go: u64,
    /// Drive after a second check.
    pub caution: u64,
    /// Nobody can tell.
    pub cannot_tell: u64,
    /// Do not drive.
    pub no_go: u64,
    /// Places without a height.
    pub unknown: u64,
}

/// Each file in a row; its numbers have the unit of the row.
pub(super) const FILES: [Column<MapFile>; 8] = [
    text("name", "The band's name", |file| Some(file.name.to_owned())),
    text("unit", "The unit of its numbers", |file| Some(file.unit.symbol.to_owned())),
    text("about", "What it is", |file| Some(file.about.to_owned())),
    maybe("least", ONE, "The least of its numbers", |file| finite(file.least)),
    maybe("mean", ONE, "Their mean", |file| finite(file.mean)),
    maybe("most", ONE, "The largest", |file| finite(file.most)),
    whole("cells", "How many places have a number", |file| usize::try_from(file.cells).ok()),
    text("path", "Where the file is", |file| Some(file.path.clone())),
];

fn finite(number: f64) -> Option<f64> {
    Some(number).filter(|number| number.is_finite())
}

/// The columns for reading.
pub(super) fn brief() -> Vec<String> {
    ["name", "unit", "least", "mean", "most", "path"].map(String::from).into()
}
