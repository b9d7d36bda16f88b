//! `grouser schema [KIND]`: prints the JSON Schema of a kind of document.

use grouser::document::{self, Kind};
use grouser_telemetry::Mapping;

use crate::args::{SchemaArgs, SchemaChoice};
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &SchemaArgs) -> Result<(), Failure> {
    match args.kind {
        Some(SchemaChoice::Document(kind)) => output::print(&document::schema(kind.into())),
        Some(SchemaChoice::TelemetryMapping) => output::print(&Mapping::schema()),
        None => {
            let names = Kind::ALL.map(Kind::name).into_iter().chain([Mapping::KIND]);
            output::print(&names.map(|name| format!("{name}\n")).collect::<String>())
        }
    }
}
