//! Runs all checks: every step is taken, and the end shows all failures.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::workspace::Profile;
use crate::{
    c, changed, count, cpu, crates, engine, figures, fuzz, hashes, packages, pages, python,
    rustdoc, schema, texts, tools, wasm, workflows, workspace,
};

/// A step of the checks.
struct Step {
    name: &'static str,
    /// What its programs usually compute on a fresh checkout, on all cores together [s]. It is shown
    /// beside what they computed and fails nothing: machines differ by a factor of two, and so does
    /// one from hour to hour.
    usual: f64,
    /// Where a change begins that asks for it, as paths from the root; nothing: any change does.
    asks: &'static [&'static str],
    /// Whether only `ci --full` takes it.
    is_long: bool,
    take: Take,
}

/// How a step is taken.
enum Take {
    Here(fn(Extent) -> Result<Count>),
    /// By another process of this program, the chore whose words these are, beside the steps that
    /// follow: one core is enough for it.
    Beside(&'static [&'static str]),
    /// After all that was taken beside.
    Last(fn() -> Result<Count>),
}

/// All of them, the quick ones first. Those up to the documentation, the figures and the wheel
/// share one build.
const STEPS: [Step; 26] = {
    use Take::{Beside, Here, Last};
    const fn step(name: &'static str, usual: f64, take: Take) -> Step {
        Step { name, usual, asks: &[], is_long: false, take }
    }
    const PAGES: &[&str] =
        &["docs", "crates/grouser-cli", "crates/grouser-python", "crates/grouser-serve", "xtask"];
    const PACKED: &[&str] = &["Cargo", "crates/grouser-python", "xtask"];
    const OF_C: &[&str] =
        &["Cargo", "crates/grouser-c/", "crates/grouser-core", "crates/grouser-io", "xtask"];
    const COMPUTES: &[&str] = &["Cargo", "crates/", "xtask"];
    const COUNTED: &[&str] = &["Cargo", "crates/grouser/", "crates/grouser-core", "xtask"];
    [
        step("tools", 1.0, Here(|_| Ok(tools::check()))),
        step(
            "format",
            6.0,
            Here(|_| succeeds(workspace::cargo().args(["fmt", "--all", "--check"]))),
        ),
        step("texts", 1.0, Here(|_| texts::check().map(Count::one))),
        step("crates", 1.0, Here(|_| crates::check())),
        step("count", 2.0, Here(|_| count::check())),
        step("build", 1200.0, Here(|_| build())),
        step("wasm", 30.0, Here(|_| wasm::check())),
        step("tests", 570.0, Here(tests)),
        step("doctests", 12.0, Here(doctests)),
        step("documentation", 110.0, Here(|_| rustdoc::check().map(Count::one))),
        step("schemas", 1.0, Here(|_| schema::check().map(Count::one))),
        step("figures", 60.0, Here(|_| figures::check().map(Count::one))),
        step("fuzz", 80.0, Here(|extent| fuzz::check(&fuzz::Plan::of(extent)))),
        step("meaning", 22.0, Here(fuzz::meaning::check)),
        step("readers", 26.0, Here(|extent| fuzz::readers::check(fuzz::readers::Plan::of(extent)))),
        Step { asks: OF_C, ..step("c", 120.0, Here(|_| c::check())) },
        Step { asks: PACKED, ..step("packages", 10.0, Here(packages::check)) },
        step("wheel", 28.0, Here(|_| python::installed().map(|_| Count::one(true)))),
        Step { asks: COMPUTES, ..step("hashes", 10.0, Here(hashes::check)) },
        Step { asks: PAGES, ..step("site", 86.0, Beside(&["site", "--as-it-is"])) },
        Step { asks: COUNTED, ..step("instructions", 110.0, Beside(&["instructions", "--check"])) },
        step("python", 330.0, Here(python::check)),
        step("workflows", 1.0, Here(|_| workflows::check().map(Count::one))),
        Step { is_long: true, ..step("engine", 400.0, Last(engine::check)) },
        Step { asks: PAGES, ..step("pages", 300.0, Last(pages::check)) },
        Step { is_long: true, ..step("release", 600.0, Here(|_| release())) },
    ]
};

/// A step that computes this many times what is usual is named at the end [-].
const NAMED_FROM: f64 = 2.0;
/// Steps that compute for less are not [s].
const SHORT: f64 = 20.0;

/// A step that was taken.
struct Taken {
    step: &'static Step,
    count: Count,
    duration: Duration,
    /// What the step's programs computed, on all cores together: on a busy machine the number that
    /// repeats.
    computed: Option<Duration>,
}

/// Takes every step that is asked for, and prints a summary, the closing line last; whether nothing
/// failed.
pub(crate) fn run(extent: Extent) -> bool {
    // Fetching packages waits for the network more than it computes.
    std::thread::spawn(python::environment);
    let changed = if extent == Extent::Full { None } else { changed::files() };
    let steps = STEPS.iter().filter(|step| extent == Extent::Full || !step.is_long);
    let (asked, left): (Vec<&Step>, Vec<&Step>) =
        steps.partition(|step| step.is_asked(changed.as_deref()));
    let (mut taken, mut beside) = (Vec::new(), Vec::new());
    for step in asked {
        match step.take {
            Take::Here(take) => taken.push(step.taken(|| take(extent))),
            Take::Beside(arguments) => beside.push(Beside::start(step, arguments)),
            Take::Last(take) => {
                taken.extend(beside.drain(..).map(Beside::end));
                taken.push(step.taken(take));
            }
        }
    }
    taken.extend(beside.drain(..).map(Beside::end));
    close(&taken, &left)
}

impl Step {
    /// Whether some changed file asks for the step.
    ///
    /// * `changed`: paths from the root; nothing: all steps are taken
    fn is_asked(&self, changed: Option<&[String]>) -> bool {
        let asks = |file: &String| self.asks.iter().any(|start| file.starts_with(start));
        self.asks.is_empty() || changed.is_none_or(|files| files.iter().any(asks))
    }

    /// Takes a step. One that cannot be taken has failed; the next ones are taken all the same.
    fn taken(&'static self, take: impl FnOnce() -> Result<Count>) -> Taken {
        println!("\n── {} ──", self.name);
        let (start, before) = (Instant::now(), cpu::of_children());
        let count = take().unwrap_or_else(|error| {
            println!("{error:#}");
            Count::one(false)
        });
        let after = cpu::of_children();
        let computed = after.zip(before).map(|(after, before)| after.saturating_sub(before));
        Taken { step: self, count, duration: start.elapsed(), computed }
    }
}

impl Taken {
    /// What is said of a step beside its numbers: nothing, or that it computed for long.
    fn remark(&self) -> &'static str {
        let computed = self.computed.unwrap_or_default().as_secs_f64();
        let is_much = computed > SHORT && computed > NAMED_FROM * self.step.usual;
        if is_much { "  <- more than usual" } else { "" }
    }
}

/// Prints a row for each step, what was not checked, and the closing line; whether nothing failed.
fn close(taken: &[Taken], left: &[&Step]) -> bool {
    let mut total = Count::default();
    let heads = ["passed", "failed", "skipped"].map(|head| format!(" {head:>7}")).concat();
    println!("\n{:<14}{heads} {:>9} {:>9} {:>9}", "step", "seconds", "CPU s", "usual");
    for taken in taken {
        let Count { passed, failed, skipped } = taken.count;
        let numbers = [passed, failed, skipped].map(|number| format!(" {number:>7}")).concat();
        let computed = taken.computed.map_or("-".into(), |it| format!("{:.1}", it.as_secs_f64()));
        let (name, usual) = (taken.step.name, taken.step.usual);
        let seconds = taken.duration.as_secs_f64();
        let remark = taken.remark();
        println!("{name:<14}{numbers} {seconds:>9.1} {computed:>9} {usual:>9.0}{remark}");
        total += taken.count;
    }
    for step in left {
        println!("not checked: {}, since nothing that it looks at was changed", step.name);
        total += Count::skipped();
    }
    for taken in taken.iter().filter(|taken| taken.count.passed == 0 && taken.count.skipped > 0) {
        println!("not checked: {}, for want of a tool", taken.step.name);
    }
    println!("\n{total}");
    total.failed == 0
}

/// A step that another process of this program takes, while we take others.
struct Beside {
    step: &'static Step,
    start: Instant,
    /// The process, and the file that it prints to.
    running: Result<(Child, PathBuf)>,
}

impl Beside {
    /// * `arguments`: the chore, whose last line is its counts
    fn start(step: &'static Step, arguments: &[&str]) -> Self {
        let run = || {
            let folder = workspace::target().join("xtask");
            fs::create_dir_all(&folder)?;
            let path = folder.join(format!("{}.txt", step.name));
            let file = fs::File::create(&path)?;
            let mut chore = Command::new(std::env::current_exe()?);
            chore.args(arguments).stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
            Ok((chore.spawn()?, path))
        };
        Self { step, start: Instant::now(), running: run() }
    }

    /// Waits for the step and shows what it printed.
    fn end(self) -> Taken {
        let Self { step, start, running } = self;
        let end = || {
            let (mut child, path) = running?;
            child.wait()?;
            let printed = fs::read_to_string(path)?;
            print!("{printed}");
            Ok(Count::of_closing_line(&printed))
        };
        let ended = step.taken(end);
        Taken { duration: start.elapsed(), ..ended }
    }
}

fn succeeds(command: &mut Command) -> Result<Count> {
    let status = command.status().context("cargo did not start")?;
    Ok(Count::one(status.success()))
}

/// Compiles everything with its tests, and lints it on the way.
fn build() -> Result<Count> {
    succeeds(workspace::linting_cargo().args(["test", "--workspace", "--all-targets", "--no-run"]))
}

/// Whether the program that users have says what the one of the tests says, bit for bit.
fn release() -> Result<Count> {
    let question = ["heading", "--slope-deg", "0:20:1", "--uncertainty", "--format", "csv"];
    let question = question.map(String::from);
    let programs = [Profile::Dev, Profile::Release].map(|it| workspace::build("grouser", it));
    let [tested, used] = programs.map(|it| workspace::output_of(&it?, &question));
    Ok(Count::one(tested? == used?))
}

fn tests(extent: Extent) -> Result<Count> {
    let kinds = ["--lib", "--bins", "--tests", "--examples"];
    run_tests(&kinds, extent)
}

fn doctests(extent: Extent) -> Result<Count> {
    run_tests(&["--doc"], extent)
}

/// Runs test programs, shows what they print, and counts their results.
fn run_tests(kinds: &[&str], extent: Extent) -> Result<Count> {
    let mut command = workspace::linting_cargo();
    command.args(["test", "--workspace", "--no-fail-fast"]).args(kinds);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_waits_where_nothing_that_it_looks_at_changed() {
        let step = |name: &str| STEPS.iter().find(|step| step.name == name).expect("a step");
        let of_core = ["crates/grouser-core/src/soil.rs".to_owned()];
        let of_docs = ["docs/start.md".to_owned()];
        assert!(step("tests").is_asked(Some(&of_core)) && step("tests").is_asked(Some(&of_docs)));
        assert!(!step("site").is_asked(Some(&of_core)) && step("site").is_asked(Some(&of_docs)));
        assert!(step("site").is_asked(None));
    }

    #[test]
    fn a_step_that_computes_for_long_is_named_and_does_not_fail() {
        let step = STEPS.iter().find(|step| step.name == "tests").expect("a step");
        let taken = |share: f64| Taken {
            step,
            count: Count::one(true),
            duration: Duration::ZERO,
            computed: Some(Duration::from_secs_f64(share * step.usual)),
        };
        assert!(taken(1.2).remark().is_empty() && !taken(2.1).remark().is_empty());
        assert!(close(&[taken(30.0)], &[]));
        assert!(!close(&[Taken { count: Count::one(false), ..taken(1.0) }], &[]));
    }
}
