//! The list of commands in `grouser --help`, in groups by what one wants.

use clap::Command;

/// Headings with their commands; each command is in one group.
const GROUPS: [(&str, &[&str]); 7] = [
    ("Start", &["reproduce", "serve", "new", "presets", "help"]),
    ("One question", &["wheel-test", "heading", "heading-map", "traverse", "design", "draw"]),
    ("A site", &["terrain", "map", "route", "card", "forecast"]),
    ("A drive", &["mission", "import-telemetry", "slip-from-current", "learn", "replay"]),
    ("A laboratory", &["import", "calibrate"]),
    ("Doubt", &["validate", "campaign"]),
    ("Files", &["check", "schema", "import-urdf", "export-fmu", "completions", "man"]),
];

/// Characters in a line of help at the most.
pub(super) const WIDEST: usize = 100;

/// The program's command with a help that lists its commands in groups. The parser's own help has
/// one list: each group is rendered as if it were a program, and put into the template.
pub(crate) fn grouped(command: Command) -> Command {
    let help = Command::new("help").about("Print this message or the help of a command");
    let listed = |name: &&'static str| {
        let found = command.find_subcommand(name).or_else(|| (*name == "help").then_some(&help))?;
        let about = found.get_about().cloned().unwrap_or_default();
        Some(Command::new(*name).about(about))
    };
    let bare = || Command::new("grouser").max_term_width(WIDEST).disable_help_subcommand(true);
    let groups = GROUPS.iter().map(|(heading, names)| {
        let commands = names.iter().filter_map(listed);
        bare().disable_help_flag(true).subcommand_help_heading(*heading).subcommands(commands)
    });
    let options = bare().version("").args(command.get_arguments().cloned());
    let rendered = groups.chain([options]).map(|part| {
        let text = part.help_template("{all-args}").render_help().ansi().to_string();
        text.trim_end().to_owned()
    });
    let sections = rendered.collect::<Vec<_>>().join("\n\n");
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{sections}{{after-help}}"
    ))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;
    use crate::args::Cli;

    /// A new command that is in no group would be missing in the help.
    #[test]
    fn every_command_is_in_one_group() {
        let command = Cli::command();
        let shown = command.get_subcommands().filter(|it| !it.is_hide_set());
        let mut commands: Vec<_> = shown.map(Command::get_name).chain(["help"]).collect();
        let mut listed: Vec<_> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        commands.sort_unstable();
        listed.sort_unstable();
        assert_eq!(listed, commands);
    }
}
