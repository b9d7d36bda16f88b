//! The map of costs: counted by the units of work, and written into its document.

use std::fs;
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
    let (path, map) = (workspace::root().join(FILE), String::from_utf8(output.stdout)?);
    let text = fs::read_to_string(&path).context(FILE)?;
    let text = markers::with_content_by(&text, MAP, &map).context(FILE)?;
    print!("{map}");
    fs::write(&path, text).context(FILE)
}
