//! `grouser schema [KIND]`: prints the JSON Schema of a kind of document.

use grouser::document::{self, Kind};

use crate::args::SchemaArgs;
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &SchemaArgs) -> Result<(), Failure> {
    match args.kind {
        Some(kind) => output::print(&document::schema(kind.into())),
        None => output::print(&Kind::ALL.map(|kind| format!("{kind}\n")).concat()),
    }
}
