//! `grouser completions SHELL`: prints a completion script.

use clap::builder::PossibleValuesParser;
use clap::{Command, CommandFactory as _};
use grouser::contact::Model;
use grouser::document::{Kind, presets};

use crate::args::{Cli, CompletionsArgs};
use crate::failure::Failure;
use crate::output;

/// Arguments that take a preset or a file, and the kind of preset.
const PRESETS: [(&str, Kind); 11] = [
    ("soil", Kind::Soil),
    ("prior", Kind::Soil),
    ("ground", Kind::Soil),
    ("rover", Kind::Rover),
    ("wheel", Kind::Wheel),
    ("scenario", Kind::Scenario),
    ("mission", Kind::Mission),
    ("study", Kind::Campaign),
    ("design", Kind::Design),
    ("data", Kind::DataSet),
    ("mapping", Kind::TelemetryMapping),
];

pub(crate) fn run(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    let mut command = with_names(Cli::command());
    clap_complete::generate(args.shell, &mut command, "grouser", &mut script);
    output::print(&with_files(&String::from_utf8_lossy(&script)))
}

/// The command with the names of presets and of models as values of its arguments. The program
/// itself takes files as well: only scripts are made of it.
fn with_names(command: Command) -> Command {
    let named = command.mut_args(|argument| {
        let is_it = |(name, _): &&(&str, Kind)| argument.get_id() == *name;
        match PRESETS.iter().find(is_it) {
            Some((_, kind)) => argument.value_parser(PossibleValuesParser::new(names(*kind))),
            None if argument.get_id() == "model" => {
                argument.value_parser(PossibleValuesParser::new(Model::ALL.map(|it| it.name())))
            }
            None => argument,
        }
    });
    named.mut_subcommands(with_names)
}

fn names(kind: Kind) -> Vec<&'static str> {
    presets(kind).map(|preset| preset.name).collect()
}

/// The script with files beside presets. Bash offers them where no preset begins as typed; the
/// scripts for zsh and fish have words that end with the list.
fn with_files(script: &str) -> String {
    PRESETS.iter().fold(script.to_owned(), |script, (_, kind)| {
        let names = names(*kind);
        let (zsh, fish) = (names.join(" "), names.join("\\t''\\n"));
        script
            .replace(&format!(":({zsh})"), &format!(":{{compadd -- {zsh}; _files}}"))
            .replace(&format!("-f -a \"{fish}\\t''\""), &format!("-F -a \"{fish}\\t''\""))
    })
}
