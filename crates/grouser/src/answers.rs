//! Questions with their answers: from the documents that a question is about to the tables, figures
//! and sentences that every front end shows.

pub mod forecast;
pub mod heading;
pub mod heading_map;
pub mod replay;
mod samples;
pub mod slip_from_current;
pub mod wheel_test;

use crate::contact::validity::Finding;
use crate::document::reading;
use crate::document::statistics::NothingAccepted;
use crate::document::table::Table;
use crate::document::validity::OutsideDomain;
use crate::error::ParameterError;

pub use self::samples::{Sampling, weights};
pub use grouser_io::answer::*;

/// How far an answer goes, and what it asks on its way.
#[derive(Clone, Copy)]
pub struct Depth<'a> {
    /// Whether it has figures and a page: their curves need more points than the rows.
    pub has_page: bool,
    /// Whether a flag of validity is an error.
    pub is_strict: bool,
    /// Asked with every sample, from any thread, whether to go on.
    pub go_on: &'a (dyn Fn() -> bool + Sync),
}

impl Depth<'_> {
    /// The rows and sentences alone, flags among them, all samples.
    pub const ROWS: Depth<'static> = Depth { has_page: false, is_strict: false, go_on: &|| true };

    /// Checks that no row carries a flag, if that is asked for.
    ///
    /// * `rows`: the flags of each row
    /// * `table`: the same rows
    /// * `settings`: the columns that tell rows apart
    fn check<'f>(
        &self,
        rows: impl IntoIterator<Item = &'f [Finding]>,
        table: &Table,
        settings: &[&str],
    ) -> Result<(), OutsideDomain> {
        if !self.is_strict {
            return Ok(());
        }
        let named = |place: usize| {
            let row = table.select(settings, &[place]);
            format!("row {} ({})", place + 1, reading::row_in_words(&row.row(0)))
        };
        OutsideDomain::check(rows, named)
    }
}

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
    /// It was stopped on the way.
    #[error("it was stopped before its end")]
    Stopped,
}
