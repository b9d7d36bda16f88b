//! What the standard output and the standard error can show, as the caller asks.

use std::io::{IsTerminal as _, stderr, stdout};
use std::sync::OnceLock;

use anstream::AutoStream;
use terminal_size::terminal_size_of;

use super::screen::Screen;

/// What the caller asks for, before any command.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Settings {
    /// Neither progress nor notes.
    pub(crate) is_quiet: bool,
    /// Characters in a line, whatever the standard output is.
    pub(crate) width: Option<u16>,
}

static SETTINGS: OnceLock<Settings> = OnceLock::new();

/// Sets what the caller asks for, once.
///
/// * `colours`: where the caller says so; else the streams, `NO_COLOR` and `CLICOLOR_FORCE` decide
pub(crate) fn set(settings: Settings, colours: clap::ColorChoice) {
    set_colours(colours);
    // It fails only if there are settings already: those of the caller stay.
    let _ = SETTINGS.set(settings);
}

/// Sets whether there are colours.
pub(crate) fn set_colours(choice: clap::ColorChoice) {
    let choice = match choice {
        clap::ColorChoice::Auto => anstream::ColorChoice::Auto,
        clap::ColorChoice::Always => anstream::ColorChoice::Always,
        clap::ColorChoice::Never => anstream::ColorChoice::Never,
    };
    choice.write_global();
}

fn settings() -> Settings {
    SETTINGS.get().copied().unwrap_or_default()
}

/// Whether neither progress nor notes are wanted.
pub(crate) fn is_quiet() -> bool {
    settings().is_quiet
}

/// Whether progress is drawn, and it is said what was written where.
pub(crate) fn has_progress() -> bool {
    !is_quiet() && stderr().is_terminal()
}

/// The characters in a line for which results are laid out; none where they go to a file or a pipe.
pub(crate) fn width() -> Option<usize> {
    let width = settings().width.or_else(|| {
        let stdout = stdout();
        let size = if stdout.is_terminal() { terminal_size_of(&stdout) } else { None };
        // A terminal that does not know its size has no columns.
        size.map(|(width, _)| width.0).filter(|width| *width > 0)
    });
    width.map(usize::from)
}

pub(super) fn stdout_screen() -> Screen {
    let choice = AutoStream::choice(&stdout());
    Screen { width: width(), has_colours: choice != anstream::ColorChoice::Never }
}

pub(super) fn stderr_screen() -> Screen {
    let choice = AutoStream::choice(&stderr());
    Screen { width: None, has_colours: choice != anstream::ColorChoice::Never }
}
