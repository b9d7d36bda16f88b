//! Checks the texts of the repository, whatever language they are in.

use std::process::Command;

use anyhow::{Context, Result};

use crate::flaw::Flaw;
use crate::{address, cited, hygiene, links, vendored, workspace};

/// Whether every text is in order; prints what is not.
pub(crate) fn check() -> Result<bool> {
    let mut flaws = Vec::new();
    let mut texts = Vec::new();
    for path in workspace::files()? {
        // Files that are no text, such as films, and those of others hold no words to check, but
        // links may lead to them.
        if let Ok(bytes) = std::fs::read(workspace::root().join(&path)) {
            let is_ours = !path.starts_with(vendored::FOLDER);
            let text = is_ours.then(|| String::from_utf8(bytes).unwrap_or_default());
            texts.push((path, text.unwrap_or_default()));
        }
    }
    let own_host = address::of(&texts).map_or("", address::host);
    for (path, text) in &texts {
        flaws.extend(hygiene::flaws(path, text, own_host));
    }
    flaws.extend(address::flaws(&texts));
    flaws.extend(links::flaws(&texts));
    flaws.extend(cited::flaws(&texts));
    for Flaw { path, line, what } in &flaws {
        println!("{path}:{line}: {what}");
    }
    println!("{} texts, {} flaws", texts.len(), flaws.len());
    let is_wrapped = is_wrapped()?;
    Ok(flaws.is_empty() && is_wrapped)
}

/// Whether the prose of every Markdown file is wrapped at one width; names the files that are not.
fn is_wrapped() -> Result<bool> {
    let mut wrap = Command::new("python3");
    wrap.args(["docs/site/wrap.py", "--check"]).current_dir(workspace::root());
    Ok(wrap.status().context("python3 did not start")?.success())
}
