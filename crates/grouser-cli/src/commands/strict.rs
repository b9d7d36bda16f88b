//! Flags as errors, where `--strict` asks for it.

use grouser::contact::validity::Finding;
use grouser::document::reading::row_in_words;
use grouser::document::table::Table;
use grouser::document::validity::OutsideDomain;

use crate::args::StrictArgs;
use crate::failure::Failure;

/// Checks, if that is asked for, that no row carries a flag.
///
/// * `rows`: the flags of each row
/// * `table`: the same rows
/// * `settings`: the columns that tell rows apart
pub(crate) fn check<'f>(
    args: &StrictArgs,
    rows: impl IntoIterator<Item = &'f [Finding]>,
    table: &Table,
    settings: &[&str],
) -> Result<(), Failure> {
    if !args.strict {
        return Ok(());
    }
    let named = |place: usize| {
        let row = table.select(settings, &[place]);
        format!("row {} ({})", place + 1, row_in_words(&row.row(0)))
    };
    Ok(OutsideDomain::check(rows, named)?)
}
