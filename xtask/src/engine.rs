//! The console without a server: its engine as WebAssembly, and the page that asks it, as a folder of
//! the documentation site.
//!
//! The engine is compiled by the toolchain, where it has the target, or else by Debian's compiler of
//! Rust, which has the sources of its standard library.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Result, ensure};

use crate::libtest::Count;
use crate::tools::{self, CHROMIUM, ENGINE, NODE};
use crate::{pages, python, wasm, workspace};

/// What the engine is compiled for: libraries take the other one for that of a page with their own
/// scripts, `wasm32-unknown-unknown`.
const TARGET: &str = "wasm32-wasip1";
/// Vectors of two numbers, which browsers have; the bits are the same.
const VECTORS: &str = "-Ctarget-feature=+simd128";

/// Where Debian has the library of that system, which is older than its compiler: what it lacks the
/// page's script has.
const DEBIAN: &str = " -Lnative=/usr/lib/wasm32-wasi -Clink-arg=--allow-undefined";

/// The folder of the page in the site.
const FOLDER: &str = "console";
/// The scripts that take the place of those which ask a server.
const SCRIPTS: &str = "crates/grouser-serve/without-server";
/// The page of the console.
const PAGE: &str = "crates/grouser-serve/page";
/// What stands in the folder where the engine was not compiled.
const ABSENT: &str = include_str!("engine/absent.html");

/// What asks the engine in node, and the program, and compares.
const ASKER: &str = include_str!("engine/compare.mjs");
/// What uses the page, with what uses the console of a server.
const USERS: [(&str, &str); 2] =
    [("without_server.py", include_str!("engine/without_server.py")), ("console.py", pages::USER)];

/// Our packages that read, write and draw: of these the smallest code will do.
const SMALL: [&str; 4] = ["grouser-serve", "grouser-io", "grouser-draw", "grouser-raster"];

/// Compiles the engine, puts the page into the site, and compares both with the program: each line in
/// node, what the page shows in Chromium. What cannot be done for want of a tool counts as skipped.
pub(crate) fn check() -> Result<Count> {
    let site = workspace::target().join("site");
    if !into(&site)? {
        return Ok(Count::skipped());
    }
    let program = workspace::build_program()?;
    let mut count = compared(&site, &program)?;
    count += used(&site, &program)?;
    Ok(count)
}

/// Puts the page with its engine into a site; whether there are the tools for it.
pub(crate) fn into(site: &Path) -> Result<bool> {
    if !wasm::is_installed(TARGET)? && !ENGINE.is_here_or_installed() {
        return Ok(false);
    }
    let engine = compiled()?;
    let folder = emptied(site)?;
    for from in [PAGE, SCRIPTS] {
        // The second folder's `engine.js` takes the place of the first one's.
        for entry in fs::read_dir(workspace::root().join(from))? {
            let path = entry?.path();
            let is_locked = path.ends_with("locked.html");
            if let (true, false, Some(name)) = (path.is_file(), is_locked, path.file_name()) {
                fs::copy(&path, folder.join(name))?;
            }
        }
    }
    fs::copy(&engine, folder.join("engine.wasm"))?;
    println!("{}", folder.join("index.html").display());
    Ok(true)
}

/// Says in a site that its console was left out.
pub(crate) fn leave_out(site: &Path) -> Result<()> {
    Ok(fs::write(emptied(site)?.join("index.html"), ABSENT)?)
}

fn emptied(site: &Path) -> Result<PathBuf> {
    let folder = site.join(FOLDER);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// The engine, compiled.
fn compiled() -> Result<PathBuf> {
    let folder = workspace::target().join("xtask/engine");
    let mut cargo = workspace::cargo();
    cargo.args(["rustc", "-p", "grouser-serve", "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--no-default-features", "--release", "--target", TARGET]);
    for package in SMALL {
        cargo.arg("--config").arg(format!("profile.release.package.{package}.opt-level=\"s\""));
    }
    cargo.env("CARGO_TARGET_DIR", &folder).env("CARGO_INCREMENTAL", "0");
    let mut flags = VECTORS.to_owned();
    if !wasm::is_installed(TARGET)? {
        flags += DEBIAN;
        cargo.arg("-Zbuild-std=std,panic_abort");
        cargo.env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1");
        cargo.env("CARGO_TARGET_WASM32_WASIP1_LINKER", "wasm-ld");
    }
    cargo.env("CARGO_TARGET_WASM32_WASIP1_RUSTFLAGS", flags);
    // Names of functions are a fifth of the file.
    cargo.args(["--", "-Clink-arg=--strip-all"]);
    ensure!(cargo.status()?.success(), "the engine does not build for {TARGET}");
    Ok(folder.join(TARGET).join("release/grouser_serve.wasm"))
}

/// Asks the engine in node what the program is asked, too, and compares each line.
fn compared(site: &Path, program: &Path) -> Result<Count> {
    if !NODE.is_here_or_installed() {
        return Ok(Count::skipped());
    }
    let mut node = Command::new("node");
    node.args(["--input-type=module", "--eval", ASKER]);
    node.arg("--").arg(site.join(FOLDER)).arg(program);
    counted(&mut node, "the engine was not compared")
}

/// Uses the page in Chromium.
fn used(site: &Path, program: &Path) -> Result<Count> {
    let Some(browser) = tools::browser() else {
        println!("{}", CHROMIUM.missing());
        return Ok(Count::skipped());
    };
    let python = python::environment()?;
    let folder = workspace::target().join("xtask/engine");
    for (name, script) in USERS {
        fs::write(folder.join(name), script)?;
    }
    let mut look = Command::new(&python);
    look.arg(folder.join(USERS[0].0)).arg(browser).arg(pages::rules_of_axe(&python)?);
    counted(look.arg(program).arg(site), "the page without a server was not tried")
}

/// Runs what prints counts in its last line.
fn counted(command: &mut Command, failed: &str) -> Result<Count> {
    let output = command.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    print!("{printed}");
    ensure!(output.status.success() || printed.contains(" failed"), "{failed}");
    Ok(Count::of_closing_line(&printed))
}
