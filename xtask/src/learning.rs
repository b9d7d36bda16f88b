//! What learning from a drive is worth: measured by the example `learning`, and written into the
//! guide.

use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::{markers, workspace};

/// The file with the tables.
const FILE: &str = "docs/guide/learn.md";
/// The example's studies: each has a block.
const STUDIES: [&str; 6] = ["coverage", "heading", "change", "entrapment", "alarms", "cost"];

/// Measures everything anew, or one study, and writes it.
pub(crate) fn write(only: Option<&str>) -> Result<()> {
    if let Some(only) = only {
        ensure!(STUDIES.contains(&only), "`{only}` is none of {}", STUDIES.join(", "));
    }
    for study in STUDIES.into_iter().filter(|it| only.is_none_or(|only| only == *it)) {
        let output = workspace::cargo()
            .args(["run", "--release", "-p", "grouser", "--example", "learning", "--", study])
            .stderr(Stdio::inherit())
            .output()
            .context("cargo did not start")?;
        ensure!(output.status.success(), "{study} cannot be measured");
        let block = format!("measured by: cargo xtask learning {study}");
        markers::write_content_by(FILE, &block, &String::from_utf8(output.stdout)?)?;
    }
    Ok(())
}
