//! How many instructions the units of work take: unlike time, a count that repeats.
//!
//! `crates/grouser-bench/instructions.txt` keeps the counts, so that a slow-down shows as a
//! difference. They belong to a compiler, an instruction set and a processor, which the file names;
//! with others the counts are shown and not judged.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::libtest::Count;
use crate::tools::VALGRIND;
use crate::workspace;

const FILE: &str = "crates/grouser-bench/instructions.txt";
/// The units that are counted: what a single core does.
const UNITS: [&str; 14] = [
    "force_ns_batched",
    "settle_ns_batched",
    "rft_settle_us",
    "settle_ns_overloaded",
    "rover_rhs_us",
    "traverse_dynamic_ms",
    "traverse_quasi_steady_ms",
    "traverse_dynamic_outcome_ms",
    "traverse_quasi_steady_outcome_ms",
    "control_step_us",
    "control_step_quasi_steady_us",
    "random_step_us",
    "stop_and_go_step_us",
    "attitude_curve_ms",
];
/// Counts this near to each other are the same: addresses move a few.
const SAME: f64 = 0.02;

/// What was counted, under what circumstances.
struct Counts {
    circumstances: String,
    units: Vec<(String, f64)>,
}

/// Writes the counts.
pub(crate) fn write() -> Result<bool> {
    fs::write(workspace::root().join(FILE), count()?.to_text())?;
    println!("{FILE} written");
    Ok(true)
}

/// Whether the counts are those of the file; prints both. Skipped where nothing can count, and
/// where the counts of the file belong to another machine.
pub(crate) fn check() -> Result<Count> {
    if !VALGRIND.is_here() {
        println!("{}", VALGRIND.missing());
        return Ok(Count::skipped());
    }
    let text = fs::read_to_string(workspace::root().join(FILE)).context(FILE)?;
    let kept = Counts::of_text(&text)?;
    let now = count()?;
    let judged = kept.circumstances == now.circumstances;
    if !judged {
        println!("not judged: kept with {}, now {}", kept.circumstances, now.circumstances);
    }
    let mut same = true;
    for (key, count) in &now.units {
        let before = kept.units.iter().find(|unit| unit.0 == *key).map_or(f64::NAN, |unit| unit.1);
        let change = count / before - 1.0;
        let fits = change.abs() <= SAME;
        same &= fits;
        let verdict = if fits { "" } else { "  <- `cargo xtask instructions` refreshes the file" };
        println!("{key:<26} {before:>12.0} {count:>12.0} {:>+7.1} %{verdict}", 100.0 * change);
    }
    Ok(if judged { Count::one(same) } else { Count::skipped() })
}

impl Counts {
    fn to_text(&self) -> String {
        let mut text = format!("# {}\n", self.circumstances);
        for (key, count) in &self.units {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{key} {count:.0}");
        }
        text
    }

    fn of_text(text: &str) -> Result<Self> {
        let mut lines = text.lines();
        let circumstances = lines.next().and_then(|line| line.strip_prefix("# "));
        let unit = |line: &str| {
            let (key, count) = line.split_once(' ').context("a key and a count")?;
            Ok((key.to_owned(), count.trim().parse()?))
        };
        Ok(Self {
            circumstances: circumstances.context("the first line tells the compiler")?.to_owned(),
            units: lines.map(unit).collect::<Result<_>>()?,
        })
    }
}

fn count() -> Result<Counts> {
    let program = workspace::build_work(workspace::Profile::Dev)?;
    let units = UNITS.iter().map(|key| {
        // What is prepared, and what the first time alone takes, is in both.
        let (once, done_once) = instructions(&program, key, 1)?;
        let (twice, done_twice) = instructions(&program, key, 2)?;
        let (more, done) = (twice - once, done_twice - done_once);
        Ok(((*key).to_owned(), more as f64 / done as f64))
    });
    Ok(Counts { units: units.collect::<Result<_>>()?, circumstances: circumstances(&program)? })
}

/// Compiler, instruction set and processor, in one line: the system's own functions, too, are
/// chosen by the processor.
fn circumstances(program: &PathBuf) -> Result<String> {
    let compiler = Command::new("rustc").arg("--version").output().context("rustc")?;
    let set = under_valgrind(program, &["set"])?.1;
    let compiler = String::from_utf8_lossy(&compiler.stdout);
    let processors = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find_map(|line| line.strip_prefix("model name"));
    let model = model.map_or("processor unknown", |rest| rest.trim_start_matches([' ', '\t', ':']));
    Ok(format!("{}, {}, {model}", compiler.trim(), set.trim()))
}

/// Instructions of a unit done so many times, and how often that is in its own count.
fn instructions(program: &PathBuf, key: &str, times: u32) -> Result<(u64, u64)> {
    let (report, printed) = under_valgrind(program, &[key, &times.to_string()])?;
    let collected = report.lines().find_map(|line| line.split_once("Collected : "));
    let count = collected.context("valgrind collected nothing")?.1.trim().parse()?;
    Ok((count, printed.trim().parse()?))
}

/// The output of valgrind and of the program.
fn under_valgrind(program: &PathBuf, arguments: &[&str]) -> Result<(String, String)> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .context("valgrind did not start")?;
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() {
        bail!("under valgrind the program failed:\n{message}");
    }
    Ok((message, String::from_utf8_lossy(&output.stdout).into_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_as_they_are_written() {
        let counts =
            Counts { circumstances: "rustc 1, avx2".into(), units: vec![("force".into(), 812.0)] };
        let read = Counts::of_text(&counts.to_text()).expect("what was written");
        assert_eq!((read.circumstances, read.units), (counts.circumstances, counts.units));
        assert!(Counts::of_text("force 812\n").is_err());
    }
}
