//! `grouser man [COMMAND]`: prints a manual page.

use clap::{Command, CommandFactory as _};
use clap_mangen::Man;
use grouser::document;

use crate::args::{Cli, ManArgs};
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &ManArgs) -> Result<(), Failure> {
    let mut whole = Cli::command();
    // Every command with the flags of all, and its whole name.
    whole.build();
    let command = args.command.iter().try_fold(&whole, |command, word| within(command, word))?;
    let mut page = Vec::new();
    Man::new(command.clone())
        .render(&mut page)
        .map_err(|error| Failure::Usage(format!("a manual page cannot be written: {error}")))?;
    output::print(&String::from_utf8_lossy(&page))
}

fn within<'a>(command: &'a Command, word: &str) -> Result<&'a Command, Failure> {
    command.find_subcommand(word).ok_or_else(|| {
        let names = || command.get_subcommands().map(Command::get_name);
        let hint = match document::nearest(word, names()) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!(
                "`{} --help` lists what there is",
                command.get_display_name().unwrap_or("grouser")
            ),
        };
        Failure::Usage(format!("there is no command `{}`\nhint: {hint}", word.escape_debug()))
    })
}
