//! `grouser check FILE…`: checks documents.

use std::fmt::Write as _;

use grouser::document::{self, Assumed, Checked, Source, escape};

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let mut good = String::new();
    let mut worst: Option<Failure> = None;
    for path in &args.files {
        match document::checked(&Source::file(path)) {
            Ok(Checked { kind, assumed }) => {
                // Writing to a string does not fail.
                let _ = writeln!(good, "{}: a valid {kind} document", escape::path(path));
                for Assumed { key, prior, value } in assumed {
                    let value = value.map_or(String::new(), |value| format!(" = {value}"));
                    let prior = escape::line(&prior);
                    let _ = writeln!(good, "  not stated: {key}{value}, from \"{prior}\"");
                }
            }
            Err(error) => {
                let failure = Failure::from(error);
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
