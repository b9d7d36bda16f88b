//! Where the workspace is, what belongs to it, and the program that it builds.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn root() -> PathBuf {
    let manifest_dir = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    manifest_dir.parent().map_or(manifest_dir.clone(), Path::to_path_buf)
}

/// Cargo itself, to be run at the root.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(cargo_program());
    command.current_dir(root()).stdin(Stdio::null());
    // What `cargo run` told this program about its own package must not leak into other builds.
    for (name, _) in std::env::vars_os() {
        if name.to_string_lossy().starts_with("CARGO_PKG_") {
            command.env_remove(&name);
        }
    }
    command.env_remove("CARGO_MANIFEST_DIR").env_remove("CARGO_MANIFEST_PATH");
    command
}

fn cargo_program() -> PathBuf {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()).into()
}

/// Cargo with the linter for our crates' compiler, see `with_lints`.
pub(crate) fn linting_cargo() -> Command {
    let mut command = cargo();
    with_lints(&mut command);
    command
}

/// Has the linter compile our crates, each lint an error, so that compiling once does for both.
/// What it compiles is kept apart from what cargo compiles for somebody at work here, and is not
/// incremental, which takes longer the first time and computes slower.
pub(crate) fn with_lints(command: &mut Command) {
    command.env("RUSTC_WORKSPACE_WRAPPER", cargo_program().with_file_name("clippy-driver"));
    // How the linter takes its arguments from cargo: each with this word after it.
    command.env("CLIPPY_ARGS", "--deny__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__");
    command.env("CARGO_INCREMENTAL", "0");
}

/// Files of the repository, as paths from its root: those under version control and new ones
/// that are not ignored.
pub(crate) fn files() -> Result<Vec<String>> {
    let output = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output()
        .context("`git ls-files` did not start")?;
    ensure!(output.status.success(), "`git ls-files` failed: {}", lossy(&output.stderr));
    let root = root();
    Ok(lossy(&output.stdout)
        .split('\0')
        .filter(|path| !path.is_empty() && root.join(path).is_file())
        .map(String::from)
        .collect())
}

/// Whether a file's name has this extension.
pub(crate) fn has_extension(path: &str, extension: &str) -> bool {
    Path::new(path).extension().is_some_and(|found| found == extension)
}

/// The repository's files with this extension, and their text.
pub(crate) fn texts_with_extension(extension: &str) -> Result<Vec<(String, String)>> {
    let mut texts = Vec::new();
    for path in files()? {
        if has_extension(&path, extension) {
            let text = std::fs::read_to_string(root().join(&path))
                .with_context(|| format!("{path} cannot be read"))?;
            texts.push((path, text));
        }
    }
    Ok(texts)
}

/// What is built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Profile {
    /// The tests, and all that is checked: what computes long is optimised.
    Dev,
    /// Users, and what is timed.
    Release,
}

/// Builds the program `grouser` as the tests use it, and returns its path.
pub(crate) fn build_program() -> Result<PathBuf> {
    build("grouser", Profile::Dev)
}

/// Builds the program that does what is counted and measured, and returns its path.
pub(crate) fn build_work(profile: Profile) -> Result<PathBuf> {
    build("work", profile)
}

/// Builds all that is measured and shown, at once: alone, the units of work would choose other
/// features of the libraries that they share with the program.
pub(crate) fn build(program: &str, profile: Profile) -> Result<PathBuf> {
    let (mut command, more, folder) = match profile {
        Profile::Dev => (linting_cargo(), None, "debug"),
        Profile::Release => (cargo(), Some("--release"), "release"),
    };
    command.args(["build", "--bins", "-p", "grouser-cli", "-p", "grouser-bench"]).args(more);
    let status = command.status().context("cargo did not start")?;
    ensure!(status.success(), "`{program}` does not build");
    Ok(target().join(folder).join(format!("{program}{}", std::env::consts::EXE_SUFFIX)))
}

/// Builds an example as a build of all tests does, and returns its path: alone it would choose other
/// features of the libraries that it shares with them.
pub(crate) fn build_example(name: &str) -> Result<PathBuf> {
    let mut command = linting_cargo();
    let status = command.args(["build", "--workspace", "--example", name]).status();
    ensure!(status.context("cargo did not start")?.success(), "`{name}` does not build");
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    Ok(target().join("debug/examples").join(file))
}

/// The folder that cargo builds into.
pub(crate) fn target() -> PathBuf {
    let folder =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    root().join(folder)
}

/// Runs the program at the root and returns what it prints.
pub(crate) fn output_of(program: &Path, arguments: &[String]) -> Result<String> {
    let command = || format!("`grouser {}`", arguments.join(" "));
    let output = Command::new(program)
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::null())
        .env("NO_COLOR", "1")
        .output()
        .with_context(|| format!("{} did not start", command()))?;
    ensure!(
        output.status.success(),
        "{} ended with {}: {}",
        command(),
        output.status,
        lossy(&output.stderr).trim_end()
    );
    String::from_utf8(output.stdout).with_context(|| format!("{} printed no text", command()))
}

fn lossy(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
