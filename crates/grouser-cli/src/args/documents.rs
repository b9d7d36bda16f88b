//! Arguments of commands on documents.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, PossibleValuesParser};
use clap::{Args, ValueEnum};
use clap_complete::Shell;
use grouser::document::{GRAVITIES, Kind};

use crate::output::Format;

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Documents to check: soils, wheels, motors, rovers, scenarios, data sets, campaigns, priors
    /// or mappings of telemetry, each by its `schema`.
    #[arg(required_unless_present = "flags", value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Print the list of flags of validity, with meanings and rules, instead.
    #[arg(long, conflicts_with = "files")]
    pub(crate) flags: bool,
}

/// The worlds that presets are of.
const WORLDS: [&str; GRAVITIES.len()] = [GRAVITIES[0].0, GRAVITIES[1].0, GRAVITIES[2].0];

#[derive(Debug, Args)]
#[command(
    after_help = "On a terminal, and with a filter, the list has advice in place of sources: what \
                        a soil or a rover is for, and how well it is known."
)]
pub(crate) struct PresetsArgs {
    /// The preset to print as TOML; where kinds share its name, --kind says which. The name of a
    /// kind, such as `soils`, lists its presets.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) name: Option<String>,
    /// Only presets of this kind.
    #[arg(long, value_enum)]
    pub(crate) kind: Option<KindChoice>,
    /// Only soils and rovers of this world; a simulant is of the Earth.
    #[arg(long = "for", value_name = "WORLD", value_parser = PossibleValuesParser::new(WORLDS))]
    pub(crate) world: Option<String>,
    /// Only presets with this text in their name, title, source, notes or advice.
    #[arg(long, value_name = "TEXT", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) search: Option<String>,
    /// Form of the list.
    #[arg(long, value_enum, default_value_t, conflicts_with = "name")]
    pub(crate) format: Format,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// The kind of document; without it, the names of all kinds.
    #[arg(value_enum)]
    pub(crate) kind: Option<KindChoice>,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell.
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// The command, and a command within it; without one, the program.
    #[arg(value_name = "COMMAND")]
    pub(crate) command: Vec<String>,
}

/// A kind of document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KindChoice {
    Soil,
    Wheel,
    Motor,
    Rover,
    Scenario,
    Mission,
    DataSet,
    Campaign,
    Design,
    Prior,
    TelemetryMapping,
}

impl From<KindChoice> for Kind {
    fn from(word: KindChoice) -> Self {
        match word {
            KindChoice::Soil => Self::Soil,
            KindChoice::Wheel => Self::Wheel,
            KindChoice::Motor => Self::Motor,
            KindChoice::Rover => Self::Rover,
            KindChoice::Scenario => Self::Scenario,
            KindChoice::Mission => Self::Mission,
            KindChoice::DataSet => Self::DataSet,
            KindChoice::Campaign => Self::Campaign,
            KindChoice::Design => Self::Design,
            KindChoice::Prior => Self::Prior,
            KindChoice::TelemetryMapping => Self::TelemetryMapping,
        }
    }
}
