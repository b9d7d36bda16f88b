//! The workflows of the code host, which runs them only after a push.

use std::process::Command;

use anyhow::{Context, Result};

use crate::{python, tools, workspace};

const FOLDER: &str = ".github/workflows/";
/// What looks at them, in the language whose parser of YAML is at hand.
const CHECKER: &str = include_str!("workflows.py");

/// Whether all workflows are in order; prints what is not. Where actionlint is installed, it looks too.
pub(crate) fn check() -> Result<bool> {
    let workflows: Vec<String> =
        workspace::files()?.into_iter().filter(|path| path.starts_with(FOLDER)).collect();
    let mut command = Command::new(python::environment()?);
    command.args(["-c", CHECKER]).args(&workflows).current_dir(workspace::root());
    let good = command.status().context("Python did not start")?.success();
    if !tools::runs("actionlint", &["-version"]) {
        return Ok(good);
    }
    let linted = Command::new("actionlint").current_dir(workspace::root()).status()?.success();
    Ok(good && linted)
}
