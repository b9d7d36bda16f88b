//! Checks the texts of the repository, whatever language they are in.

use anyhow::Result;

use crate::flaw::Flaw;
use crate::{cited, hygiene, links, workspace};

/// Whether every text is in order; prints what is not.
pub(crate) fn check() -> Result<bool> {
    let mut flaws = Vec::new();
    let mut texts = Vec::new();
    for path in workspace::files()? {
        // Files that are no text hold no words to check.
        if let Ok(text) = std::fs::read_to_string(workspace::root().join(&path)) {
            texts.push((path, text));
        }
    }
    for (path, text) in &texts {
        flaws.extend(hygiene::flaws(path, text));
    }
    flaws.extend(links::flaws(&texts));
    flaws.extend(cited::flaws(&texts));
    for Flaw { path, line, what } in &flaws {
        println!("{path}:{line}: {what}");
    }
    println!("{} texts, {} flaws", texts.len(), flaws.len());
    Ok(flaws.is_empty())
}
