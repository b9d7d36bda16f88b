//! Flags as errors, where `--strict` asks for it.

use grouser::answers::check_flags;
use grouser::contact::validity::Finding;
use grouser::document::table::Table;

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
    if args.strict { Ok(check_flags(rows, table, settings)?) } else { Ok(()) }
}
