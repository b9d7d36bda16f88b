//! Everything that is checked, in one run: every step is taken, and the end shows all failures.

use std::io::{BufRead, BufReader};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use crate::libtest::Count;
use crate::{figures, instructions, python, rustdoc, schema, site, texts, workspace};

/// How much is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// All but the tests marked `#[ignore]`.
    Usual,
    /// Those too.
    Full,
}

/// A step that was taken.
struct Step {
    name: &'static str,
    count: Count,
    duration: Duration,
}

/// Takes every step and prints a summary, the closing line last; whether nothing failed.
///
/// The quick steps come first. All but the last seven share the build of the dev profile; the
/// program is built once, in the release profile.
pub(crate) fn run(extent: Extent) -> bool {
    let steps = [
        step("tools", || Ok(Count::one(tools()))),
        step("format", || succeeds(workspace::cargo().args(["fmt", "--all", "--check"]))),
        step("texts", || texts::check().map(Count::one)),
        step("lints", || {
            let lint = ["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"];
            succeeds(workspace::cargo().args(lint))
        }),
        step("tests", || {
            let kinds = ["--lib", "--bins", "--tests", "--examples"];
            tests(
                workspace::cargo().args(["test", "--workspace", "--no-fail-fast"]).args(kinds),
                extent,
            )
        }),
        step("doctests", || {
            tests(
                workspace::cargo().args(["test", "--workspace", "--no-fail-fast", "--doc"]),
                extent,
            )
        }),
        step("documentation", || rustdoc::check().map(Count::one)),
        step("program", || workspace::build_program().map(|_| Count::one(true))),
        step("schemas", || schema::check().map(Count::one)),
        step("figures", || figures::check().map(Count::one)),
        step("python", python::check),
        step("site", || site::build().map(Count::one)),
        step("instructions", || instructions::check().map(Count::one)),
    ];
    let mut total = Count::default();
    println!("\n{:<14} {:>7} {:>7} {:>9}", "step", "passed", "failed", "seconds");
    for Step { name, count, duration } in steps {
        let Count { passed, failed } = count;
        println!("{name:<14} {passed:>7} {failed:>7} {:>9.1}", duration.as_secs_f64());
        total += count;
    }
    println!("\n{} passed, {} failed", total.passed, total.failed);
    total.failed == 0
}

/// Takes a step. One that cannot be taken has failed; the next ones are taken all the same.
fn step(name: &'static str, take: impl FnOnce() -> Result<Count>) -> Step {
    println!("\n── {name} ──");
    let start = Instant::now();
    let count = take().unwrap_or_else(|error| {
        println!("{error:#}");
        Count::one(false)
    });
    Step { name, count, duration: start.elapsed() }
}

/// Whether all that the other steps need is here, after fetching what is not: the place for
/// whatever a check needs and the toolchain does not bring.
fn tools() -> bool {
    let mut complete = true;
    for (component, subcommand) in [("rustfmt", "fmt"), ("clippy", "clippy")] {
        let present = || {
            let mut probe = workspace::cargo();
            probe.args([subcommand, "--version"]).stdout(Stdio::null()).stderr(Stdio::null());
            probe.status().is_ok_and(|status| status.success())
        };
        if !present() {
            println!("{component} is missing, trying to add it to the toolchain");
            // Without rustup this fails, and the second look says so.
            let _ = Command::new("rustup").args(["component", "add", component]).status();
        }
        let found = present();
        println!("{component}: {}", if found { "found" } else { "missing" });
        complete &= found;
    }
    complete & valgrind() & renderer()
}

/// Whether instructions can be counted, after fetching what counts them.
fn valgrind() -> bool {
    from_system("valgrind", &["valgrind"], || {
        let mut probe = Command::new("valgrind");
        probe.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
        probe.status().is_ok_and(|status| status.success())
    })
}

/// Whether MuJoCo can draw without a display, after fetching what draws. Elsewhere than on Linux the
/// system does.
fn renderer() -> bool {
    from_system("renderer (Mesa's EGL)", &["libegl1", "libegl-mesa0", "libgl1-mesa-dri"], || {
        let libraries = Command::new("/sbin/ldconfig").arg("-p").output();
        let listed =
            |output: Output| String::from_utf8_lossy(&output.stdout).contains("libEGL_mesa.so");
        !cfg!(target_os = "linux") || libraries.is_ok_and(listed)
    })
}

/// Whether something of the system's is there, after trying to install its packages.
fn from_system(what: &str, packages: &[&str], present: impl Fn() -> bool) -> bool {
    if !present() {
        println!("{what} is missing, trying to install it");
        for arguments in [&["update"][..], &[&["install", "--yes"], packages].concat()] {
            let mut install = Command::new("apt-get");
            install.args(["--quiet=2"]).args(arguments).stdout(Stdio::null());
            // Where it fails, the second look says so.
            let _ = install.status();
        }
    }
    let found = present();
    println!("{what}: {}", if found { "found" } else { "missing: install it" });
    found
}

fn succeeds(command: &mut Command) -> Result<Count> {
    let status = command.status().context("cargo did not start")?;
    Ok(Count::one(status.success()))
}

/// Runs test programs, shows what they print, and counts their results.
fn tests(command: &mut Command, extent: Extent) -> Result<Count> {
    if extent == Extent::Full {
        command.args(["--", "--include-ignored"]);
    }
    let mut child = command.stdout(Stdio::piped()).spawn().context("cargo did not start")?;
    let mut output = String::new();
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).split(b'\n') {
            let line = String::from_utf8_lossy(&line?).into_owned();
            println!("{line}");
            output.push_str(&line);
            output.push('\n');
        }
    }
    Ok(Count::of_run(&output, child.wait()?.success()))
}
