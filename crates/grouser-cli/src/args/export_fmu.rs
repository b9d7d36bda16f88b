//! Arguments of `export-fmu`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ValueEnum};
use grouser_fmi::drive::Drive;

use super::SettingArgs;

#[derive(Debug, Args)]
pub(crate) struct ExportFmuArgs {
    /// File or preset of a scenario or a mission.
    #[arg(value_name = "DOCUMENT", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) document: String,
    /// The file to write, whose name ends in `.fmu`. Without it, list the variables that the FMU
    /// would have.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
    /// Who turns the wheels. Without it the inputs in a scenario, and the document in a mission.
    #[arg(long, value_enum, value_name = "WHO")]
    pub(crate) driven_by: Option<DrivenBy>,
    /// The library that the FMU carries, if it does not lie beside the program.
    #[arg(long, value_name = "FILE", requires = "out")]
    pub(crate) library: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
}

/// Who turns the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DrivenBy {
    /// The tool, by an input for each wheel.
    Inputs,
    /// The scenario's drive, or the mission's legs.
    Document,
}

impl From<DrivenBy> for Drive {
    fn from(choice: DrivenBy) -> Self {
        match choice {
            DrivenBy::Inputs => Self::Inputs,
            DrivenBy::Document => Self::Document,
        }
    }
}
