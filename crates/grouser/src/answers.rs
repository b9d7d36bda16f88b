//! Questions with their answers: from the documents that a question is about to the tables, figures
//! and sentences that the program shows.

pub mod design;
pub mod forecast;
pub mod gradient;
pub mod heading;
pub mod heading_map;
pub mod learn;
pub mod map;
pub mod replay;
pub mod route;
mod samples;
pub mod slip_from_current;
pub mod traverse;
pub mod validation;
pub mod wheel_test;

use std::path::Path;

use grouser_raster::Raster;

use crate::contact::validity::Finding;
use crate::document::Document;
use crate::document::columns;
use crate::document::given_file::{FileContent, GivenFile};
use crate::document::gradient::NoSuchKey;
use crate::document::reading;
use crate::document::statistics::NothingAccepted;
use crate::document::table::Table;
use crate::document::validity::OutsideDomain;
use crate::error::ParameterError;
use crate::studies::heading::HeadingStudy;

pub use self::samples::{Sampling, weights};
pub use grouser_io::answer::*;

/// Whether an answer has a page, refuses flags, and whom it asks on its way.
#[derive(Clone, Copy)]
pub struct AnswerOptions<'a> {
    /// Whether it has figures and a page: their curves need more points than the rows.
    pub has_page: bool,
    /// Whether a flag of validity is an error.
    pub is_strict: bool,
    /// Asked with every sample, from any thread, whether to go on.
    pub go_on: &'a (dyn Fn() -> bool + Sync),
}

impl AnswerOptions<'_> {
    /// The rows and sentences alone, flags among them, all samples.
    pub const ROWS: AnswerOptions<'static> =
        AnswerOptions { has_page: false, is_strict: false, go_on: &|| true };

    /// Checks that no row carries a flag, if that is asked for: [`check_flags`].
    fn check<'f>(
        &self,
        rows: impl IntoIterator<Item = &'f [Finding]>,
        table: &Table,
        settings: &[&str],
    ) -> Result<(), OutsideDomain> {
        if self.is_strict { check_flags(rows, table, settings) } else { Ok(()) }
    }
}

/// Checks that no row carries a flag.
///
/// * `rows`: the flags of each row
/// * `table`: the same rows
/// * `settings`: the columns that tell rows apart
///
/// # Errors
/// [`OutsideDomain`] with the flags and their first rows.
pub fn check_flags<'f>(
    rows: impl IntoIterator<Item = &'f [Finding]>,
    table: &Table,
    settings: &[&str],
) -> Result<(), OutsideDomain> {
    let named = |place: usize| {
        let row = table.select(settings, &[place]);
        format!("row {} ({})", place + 1, reading::row_in_words(&row.row(0)))
    };
    OutsideDomain::check(rows, named)
}

/// What a map of heights gave.
fn given_heights(file: &Path, raster: &Raster) -> GivenFile {
    let known = raster.heights.iter().filter(|it| it.is_finite()).count();
    let name = file.display().to_string();
    GivenFile::new(name, FileContent::Heights, raster.heights.len() as u64, known as u64)
}

/// The flags of steady motions on the soil as written: on each of some courses [rad], and on each
/// degree of the slopes up to the steepest [rad]; `None` where no course has a curve.
fn findings_up_to(
    study: &HeadingStudy,
    courses: impl IntoIterator<Item = f64>,
    steepest: f64,
) -> Option<Vec<Finding>> {
    const DEGREE: f64 = std::f64::consts::PI / 180.0;
    let degrees = (0_u8..).map(|degree| f64::from(degree) * DEGREE);
    let slopes: Vec<f64> = degrees.take_while(|it| *it < steepest).chain([steepest]).collect();
    let curves = courses.into_iter().filter_map(|course| study.curve_on(course).ok());
    let found = curves.map(|curve| columns::heading::findings(&curve, &slopes).concat());
    found.reduce(|all, more| [all, more].concat())
}

/// What a scenario is about, a line each: rover, soil and gravity.
fn setting(scenario: &Document) -> Vec<String> {
    let gravity = scenario.get("gravity_m_s2").map(|it| format!("gravity: {it} m/s²"));
    let parts = ["rover", "soil"].map(|part| format!("{part}: {}", scenario.name_of(part)));
    parts.into_iter().chain(gravity).collect()
}

/// What stands for every model, in inputs and as a choice.
pub const EVERY_MODEL: &str = "all";

/// Why a question has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnswerError {
    /// A value that physics does not have.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A flag of validity, where none is accepted.
    #[error(transparent)]
    OutsideDomain(#[from] OutsideDomain),
    /// The soil's uncertainty reaches beyond the ranges of its keys.
    #[error(transparent)]
    Samples(#[from] NothingAccepted),
    /// A list that is asked about is empty.
    #[error("there are no {0} to answer for")]
    Empty(&'static str),
    /// Measurements of which nothing can be compared with what is predicted, and why.
    #[error("nothing of the {0} can be compared: {1}")]
    NotCompared(&'static str, String),
    /// Two choices that have no answer together.
    #[error("{0} and {1} have no answer together")]
    Together(&'static str, &'static str),
    /// There is no design, and why.
    #[error("{0}")]
    Design(String),
    /// A number to differentiate by that is not there.
    #[error(transparent)]
    Key(#[from] NoSuchKey),
    /// It was stopped on the way.
    #[error("it was stopped before its end")]
    Stopped,
}

impl AnswerError {
    /// Checks that no two choices are made that have no answer together.
    ///
    /// * `choices`: each with whether it is made
    fn check_together(choices: &[(&'static str, bool)]) -> Result<(), Self> {
        let mut chosen = choices.iter().filter(|(_, is_chosen)| *is_chosen);
        match (chosen.next(), chosen.next()) {
            (Some((one, _)), Some((other, _))) => Err(Self::Together(one, other)),
            _ => Ok(()),
        }
    }
}
