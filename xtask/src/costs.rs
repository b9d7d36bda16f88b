//! The map of costs: counted by the units of work, and written into its document.

use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::{markers, workspace};

/// The file with the map.
const FILE: &str = "docs/performance.md";
/// Its block.
const MAP: &str = "made by: cargo xtask costs";

/// Counts the looks of all wheels of the map, and writes it.
pub(crate) fn write() -> Result<()> {
    let mut command = Command::new(workspace::build_work(workspace::Profile::Dev)?);
    let output = command.arg("costs").stderr(Stdio::inherit()).output().context("the map")?;
    ensure!(output.status.success(), "the costs cannot be counted");
    markers::write_content_by(FILE, MAP, &String::from_utf8(output.stdout)?)
}
