//! The documentation site, from the Markdown files of `docs/`: its reference is made from the
//! installed package, the program and the schemas, and its notebooks are run.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result};

use crate::libtest::Count;
use crate::tools::RENDERER;
use crate::{engine, python, workspace};

/// Builds the site into `target/site`, and counts it; without a renderer the notebook that draws
/// MuJoCo's models is not run, and counted as skipped.
///
/// A link or a name that leads nowhere, an error in a cell, anything else that Sphinx warns of: all
/// are shown, and each fails the build.
///
/// * `python`: that of an environment with the package installed
/// * `has_engine`: whether the console comes along, with its engine; skipped without the tools for it
pub(crate) fn build(python: &Path, has_engine: bool) -> Result<Count> {
    let mut count = Count::default();
    let program = workspace::build_program()?;
    let (docs, site) = (workspace::root().join("docs"), workspace::target().join("site"));
    if site.exists() {
        fs::remove_dir_all(&site).context("the old site")?;
    }
    let mut sphinx = Command::new(python);
    // A fresh start each time, so that every cell is run.
    sphinx.args(["-m", "sphinx", "--builder", "html", "--quiet", "--fresh-env"]);
    sphinx.args(["--fail-on-warning", "--keep-going", "--nitpicky"]);
    sphinx.arg("--conf-dir").arg(docs.join("site"));
    sphinx.arg("--doctree-dir").arg(workspace::target().join("site-doctrees"));
    sphinx.arg(&docs).arg(&site).env("GROUSER_PROGRAM", program).stdin(Stdio::null());
    if !RENDERER.is_here() {
        println!("{}", RENDERER.missing());
        sphinx.envs(python::WITHOUT_RENDERER);
        count += Count::skipped();
    }
    count += Count::one(sphinx.status().context("Sphinx did not start")?.success());
    let is_whole = has_engine && engine::into(&site)?;
    if !is_whole {
        engine::leave_out(&site)?;
    }
    if has_engine {
        count += if is_whole { Count::one(true) } else { Count::skipped() };
    }
    println!("{}", site.join("index.html").display());
    Ok(count)
}
