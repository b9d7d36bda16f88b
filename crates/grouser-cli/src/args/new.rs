//! Arguments of `new`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use grouser::document::Kind;

#[derive(Debug, Args)]
#[command(
    after_help = "On a terminal it asks; elsewhere, and with --yes, what --set does not answer has \
                        its usual value, and the output says which. `grouser new rover \
                        --questions` lists the questions."
)]
pub(crate) struct NewArgs {
    /// The kind of document.
    #[arg(value_enum)]
    pub(crate) kind: DraftChoice,
    /// What people call it; the file is named for it.
    pub(crate) name: Option<String>,
    /// Answer a question, such as `total_mass_kg=12.5`; can be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) answers: Vec<String>,
    /// Ask nothing: what is not answered by --set has its usual value.
    #[arg(long, short)]
    pub(crate) yes: bool,
    /// List the questions with units, ranges and usual values, and write nothing.
    #[arg(long, conflicts_with_all = ["yes", "out"])]
    pub(crate) questions: bool,
    /// The file to write; without it, NAME.toml in this folder.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there.
    #[arg(long)]
    pub(crate) force: bool,
}

/// A kind of document that is made from answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DraftChoice {
    Rover,
    Wheel,
    Soil,
    Scenario,
    Mission,
}

impl From<DraftChoice> for Kind {
    fn from(choice: DraftChoice) -> Self {
        match choice {
            DraftChoice::Rover => Self::Rover,
            DraftChoice::Wheel => Self::Wheel,
            DraftChoice::Soil => Self::Soil,
            DraftChoice::Scenario => Self::Scenario,
            DraftChoice::Mission => Self::Mission,
        }
    }
}
