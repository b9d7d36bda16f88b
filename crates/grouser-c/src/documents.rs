//! Documents as texts, read as the program and Python read them.

use grouser_io::{DocumentError, Kind, Overrides, Source};

/// The source that a text names: a document of TOML, or else a preset or a file.
///
/// A document has at least one line break, or an equals sign; names of presets have neither, and
/// files whose names do are for the caller to read.
///
/// # Errors
/// [`DocumentError`] if there is no such preset or file.
pub(crate) fn source(kind: Kind, text: &str) -> Result<Source, DocumentError> {
    if text.contains(['\n', '=']) {
        return Ok(Source::text(format!("the {kind} document"), text));
    }
    Source::find(kind, text)
}

/// Changes of single values, one a line, each as the program's `--set` has it.
///
/// # Errors
/// [`DocumentError`] for a line that is not written so, or of a document that the call does not
/// read.
///
/// * `kinds`: the documents that it reads
pub(crate) fn changes(text: Option<&str>, kinds: &[Kind]) -> Result<Overrides, DocumentError> {
    let lines = text.unwrap_or_default().lines().map(str::trim);
    let changes = Overrides::parse(lines.filter(|line| !line.is_empty()))?;
    changes.check_kinds(kinds)?;
    Ok(changes)
}
