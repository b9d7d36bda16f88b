//! `grouser check FILE…`: checks documents.

use std::fmt::Write as _;

use grouser::document::{self, Source, escape};

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let mut good = String::new();
    let mut worst: Option<Failure> = None;
    for path in &args.files {
        let source = Source::file(path);
        match document::check(&source).and_then(|kind| Ok((kind, document::doubts(&source)?))) {
            Ok((kind, doubts)) => {
                // Writing to a string does not fail.
                let _ = writeln!(good, "{}: a valid {kind} document", escape::path(path));
                for doubt in doubts {
                    let _ = writeln!(good, "  note: {}", escape::line(&doubt));
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
