//! Runs all checks: every step is taken, and the end shows all failures.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::{
    count, cpu, crates, figures, fuzz, packages, pages, python, rustdoc, schema, texts, tools,
    wasm, workflows, workspace,
};

/// A step that was taken.
struct Step {
    name: &'static str,
    count: Count,
    duration: Duration,
    /// What the step's programs computed, on all cores together: on a busy machine the number that repeats.
    computed: Option<Duration>,
}

/// Takes every step and prints a summary, the closing line last; whether nothing failed.
///
/// The quick steps come first. Those up to the documentation share the build of the dev profile, the
/// others that of the release profile, which is made beside the tests.
pub(crate) fn run(extent: Extent) -> bool {
    // Fetching packages waits for the network more than it computes.
    std::thread::spawn(python::environment);
    let mut steps = vec![
        step("tools", || Ok(tools::check())),
        step("format", || succeeds(workspace::cargo().args(["fmt", "--all", "--check"]))),
        step("texts", || texts::check().map(Count::one)),
        step("crates", crates::check),
        step("count", count::check),
        step("lints", || {
            let lint = ["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"];
            succeeds(workspace::cargo().args(lint))
        }),
        step("wasm", wasm::check),
    ];
    // Both profiles compile their largest crates on one core, and the longest tests run on one: together they need
    // less time than one after the other. The profiles have folders of their own, so neither waits for the other.
    let program = Beside::start("program", &["program"]);
    steps.extend([
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
    ]);
    steps.push(program.end());
    steps.extend([
        step("schemas", || schema::check().map(Count::one)),
        step("figures", || figures::check().map(Count::one)),
        step("fuzz", || fuzz::check(&fuzz::Plan::of(extent))),
        step("packages", || packages::check(extent)),
        step("wheel", || python::installed().map(|_| Count::one(true))),
    ]);
    // Each of these computes on one core for most of its time.
    let site = Beside::start("site", &["site", "--as-it-is"]);
    let instructions = Beside::start("instructions", &["instructions", "--check"]);
    steps.push(step("python", || python::check(extent)));
    steps.push(step("workflows", || workflows::check().map(Count::one)));
    steps.extend([site.end(), instructions.end()]);
    steps.push(step("pages", pages::check));
    let mut total = Count::default();
    let heads = ["passed", "failed", "skipped"].map(|head| format!(" {head:>7}")).concat();
    println!("\n{:<14}{heads} {:>9} {:>9}", "step", "seconds", "CPU s");
    for Step { name, count, duration, computed } in steps {
        let Count { passed, failed, skipped } = count;
        let numbers = [passed, failed, skipped].map(|number| format!(" {number:>7}")).concat();
        let computed = computed.map_or("-".into(), |time| format!("{:.1}", time.as_secs_f64()));
        println!("{name:<14}{numbers} {:>9.1} {computed:>9}", duration.as_secs_f64());
        total += count;
    }
    println!("\n{total}");
    total.failed == 0
}

/// Takes a step. One that cannot be taken has failed; the next ones are taken all the same.
fn step(name: &'static str, take: impl FnOnce() -> Result<Count>) -> Step {
    println!("\n── {name} ──");
    let (start, before) = (Instant::now(), cpu::of_children());
    let count = take().unwrap_or_else(|error| {
        println!("{error:#}");
        Count::one(false)
    });
    let computed = cpu::of_children().zip(before).map(|(now, before)| now.saturating_sub(before));
    Step { name, count, duration: start.elapsed(), computed }
}

/// A step that another process of this program takes, while we take others.
struct Beside {
    name: &'static str,
    start: Instant,
    /// The process, and the file that it prints to.
    running: Result<(Child, PathBuf)>,
}

impl Beside {
    /// * `arguments`: the chore, whose last line is its counts
    fn start(name: &'static str, arguments: &[&str]) -> Self {
        let run = || {
            let folder = workspace::target().join("xtask");
            fs::create_dir_all(&folder)?;
            let path = folder.join(format!("{name}.txt"));
            let file = fs::File::create(&path)?;
            let mut chore = Command::new(std::env::current_exe()?);
            chore.args(arguments).stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
            Ok((chore.spawn()?, path))
        };
        Self { name, start: Instant::now(), running: run() }
    }

    /// Waits for the step and shows what it printed.
    fn end(self) -> Step {
        let Self { name, start, running } = self;
        let end = || {
            let (mut child, path) = running?;
            child.wait()?;
            let printed = fs::read_to_string(path)?;
            print!("{printed}");
            Ok(Count::of_closing_line(&printed))
        };
        let ended = step(name, end);
        Step { duration: start.elapsed(), ..ended }
    }
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
