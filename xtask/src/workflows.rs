//! What the code host reads, and checks only after a push: its workflows, and how to cite the
//! software.

use std::process::Command;

use anyhow::{Context, Result};

use crate::{python, tools, workspace};

const FOLDER: &str = ".github/workflows/";
/// What looks at them, in the language whose parser of YAML is at hand.
const CHECKER: &str = include_str!("workflows.py");

/// How to cite the software.
const CITATION: &str = "CITATION.cff";
/// The check of its form, by the schema of the format.
const CITATION_CHECK: [&str; 4] =
    ["-m", "check_jsonschema", "--builtin-schema", "vendor.citation-file-format"];

/// Whether workflows and citation are in order; prints what is not. Where actionlint is installed,
/// it looks too.
pub(crate) fn check() -> Result<bool> {
    let workflows: Vec<String> =
        workspace::files()?.into_iter().filter(|path| path.starts_with(FOLDER)).collect();
    let mut command = Command::new(python::environment()?);
    command.args(["-c", CHECKER]).args(&workflows).current_dir(workspace::root());
    let mut good = command.status().context("Python did not start")?.success();
    let mut citation = Command::new(python::environment()?);
    citation.args(CITATION_CHECK).arg(CITATION).current_dir(workspace::root());
    good &= citation.status().context("Python did not start")?.success();
    good &= is_of_this_version()?;
    if !tools::runs("actionlint", &["-version"]) {
        return Ok(good);
    }
    let linted = Command::new("actionlint").current_dir(workspace::root()).status()?.success();
    Ok(good && linted)
}

/// Whether the citation names the workspace's version; says so if not.
fn is_of_this_version() -> Result<bool> {
    let text = std::fs::read_to_string(workspace::root().join(CITATION)).context(CITATION)?;
    let version = env!("CARGO_PKG_VERSION");
    let same = text.lines().any(|line| line == format!("version: {version}"));
    if !same {
        println!("{CITATION}: the version is {version}");
    }
    Ok(same)
}
