//! Arguments of all commands: what is shown on the terminal.

use std::ffi::OsString;

use clap::{Args, ColorChoice};

/// What is shown on the terminal.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Terminal")]
pub(crate) struct TerminalArgs {
    /// Colours: `auto` where there is a terminal and `NO_COLOR` is not set, `always` or `never`.
    #[arg(long, global = true, value_name = "WHEN", default_value_t, value_enum)]
    #[arg(hide_possible_values = true)]
    pub(crate) color: ColorChoice,
    /// No progress and no notes on the standard error; errors stay.
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Lay out tables for a terminal of so many characters, 20 to 1000; without it that of the
    /// terminal, and as wide as they are in a file or a pipe.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(20..=1000))]
    pub(crate) width: Option<u16>,
}

/// The colours that a command line asks for that cannot be parsed.
pub(crate) fn colours_of(mut words: impl Iterator<Item = OsString>) -> ColorChoice {
    let mut choice = ColorChoice::Auto;
    while let Some(word) = words.next() {
        let word = word.to_string_lossy().into_owned();
        let value = match word.strip_prefix("--color") {
            Some("") => words.next().map(|value| value.to_string_lossy().into_owned()),
            Some(value) => value.strip_prefix('=').map(str::to_owned),
            None if word == "--" => break,
            None => None,
        };
        choice = value.and_then(|value| value.parse().ok()).unwrap_or(choice);
    }
    choice
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_found_in_any_line() {
        let of = |line: &str| colours_of(line.split_whitespace().map(OsString::from));
        assert_eq!(of("card --color never --bad"), ColorChoice::Never);
        assert_eq!(of("--color=always card"), ColorChoice::Always);
        assert_eq!(of("card --color"), ColorChoice::Auto);
        assert_eq!(of("card --color red"), ColorChoice::Auto);
        assert_eq!(of("card -- --color never"), ColorChoice::Auto);
    }
}
