//! `grouser check FILE…`: checks documents.

use std::fmt::Write as _;
use std::path::Path;

use grouser::document::reading::four_digits;
use grouser::document::{self, Assumed, Checked, Source, escape};

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    if args.flags {
        return output::print(&document::validity::list());
    }
    let mut good = String::new();
    let mut worst: Option<Failure> = None;
    for path in &args.files {
        let source = Source::file(path);
        match document::checked(&source).and_then(|it| Ok((it, document::doubts(&source)?))) {
            Ok((Checked { kind, assumed }, doubts)) => {
                // Writing to a string does not fail.
                let _ = writeln!(good, "{}: a valid {kind} document", escape::path(path));
                for Assumed { key, prior, value } in assumed {
                    let value =
                        value.map_or(String::new(), |value| format!(" = {}", four_digits(value)));
                    let prior = escape::line(&prior);
                    let _ = writeln!(good, "  not stated: {key}{value}, from \"{prior}\"");
                }
                for doubt in doubts {
                    let _ = writeln!(good, "  note: {}", escape::line(&doubt));
                }
            }
            Err(error) => {
                let failure = of_table(path, Failure::from(error));
                worst = Some(match worst {
                    None => failure,
                    Some(before) => {
                        output::report(&before);
                        if before.code() > failure.code() {
                            Failure::Usage(failure.to_string())
                        } else {
                            failure
                        }
                    }
                });
            }
        }
    }
    output::print(&good)?;
    worst.map_or(Ok(()), Err)
}

/// The failure to read a table of measurements as a document, with the command that reads it.
fn of_table(path: &Path, failure: Failure) -> Failure {
    let is_table = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    if !is_table || !path.is_file() {
        return failure;
    }
    Failure::Usage(format!(
        "{}: a table, no document\n\
         hint: `check` reads documents (TOML); `grouser validate --data FILE.csv` reads and checks wheel tests, and \
         `grouser import` turns tables of others into ours",
        escape::path(path)
    ))
}
