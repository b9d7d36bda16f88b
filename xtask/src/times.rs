//! The times of units of work, written into their document.

use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::workspace::Profile;
use crate::{markers, workspace};

/// The file that says what takes how long.
const PERFORMANCE: &str = "docs/performance.md";
/// Its block.
const TIMES: &str = "measured by: cargo xtask times";

/// Measures them with the program that users build.
pub(crate) fn write() -> Result<()> {
    let mut program = Command::new(workspace::build("grouser-bench", Profile::Release)?);
    let output = program.stderr(Stdio::inherit()).output().context("the program did not start")?;
    ensure!(output.status.success(), "the times cannot be measured");
    markers::write_content_by(PERFORMANCE, TIMES, &String::from_utf8(output.stdout)?)
}
