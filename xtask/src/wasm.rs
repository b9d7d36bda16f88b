//! Whether the physics compiles for a browser: without files, threads and a system's clock.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result};

use crate::libtest::Count;
use crate::workspace;

const TARGET: &str = "wasm32-unknown-unknown";

/// Checks `grouser-core` for the target. Skipped where the target's standard library is not
/// installed.
pub(crate) fn check() -> Result<Count> {
    if !is_installed(TARGET)? {
        println!(
            "the target {TARGET} is missing, so the build of grouser-core for browsers is skipped; \
             with rustup: rustup target add {TARGET}"
        );
        return Ok(Count::skipped());
    }
    let arguments = ["check", "-p", "grouser-core", "--target", TARGET];
    let status = workspace::cargo().args(arguments).status().context("cargo did not start")?;
    Ok(Count::one(status.success()))
}

/// Whether the toolchain has a target's standard library.
pub(crate) fn is_installed(target: &str) -> Result<bool> {
    let arguments = ["--print", "target-libdir", "--target", target];
    let printed = Command::new("rustc")
        .args(arguments)
        .current_dir(workspace::root())
        .output()
        .context("rustc did not start")?;
    let folder = String::from_utf8_lossy(&printed.stdout);
    Ok(printed.status.success() && Path::new(folder.trim()).is_dir())
}
