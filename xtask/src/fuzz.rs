//! Damaged and hostile input for every command of the program, under limits of memory and time.
//!
//! A [`Subject`] is a command line with the files that it reads. Each case takes one,
//! [mutates](mutation) a file or the line, runs the program in a folder of its own and asks for a
//! [`Fault`](verdict::Fault): a panic, a signal, a limit that was hit, an exit code or an output
//! that no program of ours may have. Damage inside a campaign's folder must moreover be refused, or
//! leave the answer as it was.
//!
//! Case *i* depends on the seed and *i* alone, so that one that fails can be run again by its
//! number; its folder is kept below `target/fuzz`.

mod damage;
mod maps;
pub(crate) mod meaning;
mod mutation;
pub(crate) mod readers;
mod subjects;
mod verdict;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context, Result, bail};

use crate::cores;
use crate::extent::Extent;
use crate::libtest::Count;
use crate::workspace;
use subjects::Subject;
use verdict::Limits;

/// Cases of a usual run: about a minute on two cores.
const USUAL: u64 = 2_000;
/// Cases of a full run.
const FULL: u64 = 60_000;
/// Faults after which a run ends.
const ENOUGH: usize = 20;

/// What is to be tried.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    seed: u64,
    first: u64,
    cases: u64,
    /// Another program than that of this checkout.
    program: Option<PathBuf>,
    limits: Limits,
}

impl Plan {
    pub(crate) fn of(extent: Extent) -> Self {
        match extent {
            Extent::Usual => Self::usual(),
            Extent::Full => Self::full(),
        }
    }

    /// The cases of `cargo xtask ci`.
    fn usual() -> Self {
        Self { seed: 1, first: 0, cases: USUAL, program: None, limits: Limits::GENEROUS }
    }

    /// Those of `cargo xtask ci --full`.
    fn full() -> Self {
        Self { seed: 2, cases: FULL, ..Self::usual() }
    }

    /// Reads `--cases N`, `--seed N`, `--only N` and `--program FILE`, in any order.
    pub(crate) fn parse(arguments: &[&str]) -> Result<Self> {
        let mut plan = Self::usual();
        for pair in arguments.chunks(2) {
            let [name, value] = *pair else { bail!("{} needs a value", pair[0]) };
            if name == "--program" {
                plan.program = Some(std::path::absolute(value)?);
                continue;
            }
            let number = value.parse().with_context(|| format!("{name} {value}"))?;
            match name {
                "--cases" => plan.cases = number,
                "--seed" => plan.seed = number,
                "--only" => (plan.first, plan.cases) = (number, 1),
                _ => {
                    bail!("fuzz takes --cases N, --seed N, --only N and --program FILE, not {name}")
                }
            }
        }
        Ok(plan)
    }
}

/// A case that found a fault.
#[derive(Debug)]
struct Finding {
    case: u64,
    subject: &'static str,
    line: String,
    fault: String,
}

/// Tries the program of this checkout; counts one check for each subject.
pub(crate) fn check(plan: &Plan) -> Result<Count> {
    if !cfg!(unix) {
        println!(
            "limits of memory and time are set by a POSIX shell, which is not here: nothing was \
             tried"
        );
        return Ok(Count::skipped());
    }
    let program = match &plan.program {
        Some(program) => program.clone(),
        None => workspace::build_program()?,
    };
    let subjects = subjects::all(&program)?;
    let kept = workspace::target().join("fuzz");
    let mut findings = run(&program, &subjects, plan, &kept)?;
    findings.sort_by_key(|finding| finding.case);
    for Finding { case, subject, line, fault } in &findings {
        println!("case {case}, {subject}: {fault}\n  $ {line}");
    }
    let failed = subjects
        .iter()
        .filter(|subject| findings.iter().any(|finding| finding.subject == subject.name))
        .count() as u64;
    println!(
        "{} cases of {} subjects, seed {}: {} with a fault",
        plan.cases,
        subjects.len(),
        plan.seed,
        findings.len()
    );
    if !findings.is_empty() {
        println!(
            "their folders are in {}; `cargo xtask fuzz --seed {} --only CASE` runs one again",
            kept.display(),
            plan.seed
        );
    }
    Ok(Count { passed: subjects.len() as u64 - failed, failed, ..Count::default() })
}

/// Runs the cases of a plan on all cores.
///
/// * `kept`: where the folders of cases with faults go
fn run(program: &Path, subjects: &[Subject], plan: &Plan, kept: &Path) -> Result<Vec<Finding>> {
    let next = AtomicU64::new(plan.first);
    let findings = Mutex::new(Vec::new());
    let lock = || findings.lock().unwrap_or_else(PoisonError::into_inner);
    cores::on_each(|| {
        loop {
            let case = next.fetch_add(1, Ordering::Relaxed);
            if case >= plan.first + plan.cases || lock().len() >= ENOUGH {
                return Ok(());
            }
            if let Some(finding) = try_case(program, subjects, plan, case, kept)? {
                lock().push(finding);
            }
        }
    })?;
    Ok(findings.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Makes a case, runs it, and keeps its folder if there is a fault.
fn try_case(
    program: &Path,
    subjects: &[Subject],
    plan: &Plan,
    case: u64,
    kept: &Path,
) -> Result<Option<Finding>> {
    // The cases of two seeds have nothing in common but their subjects.
    let mut dice = fastrand::Rng::with_seed(plan.seed ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let subject = &subjects[usize::try_from(case).unwrap_or(0) % subjects.len()];
    let mut trial = subject.clone();
    mutation::mutate(&mut trial, &mut dice);
    let folder = tempfile::tempdir().context("a folder for a case")?;
    trial.write(folder.path())?;
    let answer = verdict::run(program, &trial.words, folder.path(), plan.limits)?;
    let Some(fault) = verdict::fault(&trial, &answer, folder.path())? else { return Ok(None) };
    let place = kept.join(format!("case-{case}"));
    keep(folder.path(), &place, &answer)?;
    let line = trial.line();
    Ok(Some(Finding { case, subject: subject.name, line, fault: fault.to_string() }))
}

/// Copies a case's folder, with what the program printed.
fn keep(folder: &Path, place: &Path, answer: &verdict::Answer) -> Result<()> {
    let _ = fs::remove_dir_all(place);
    for file in files_below(folder)? {
        let target = place.join(file.strip_prefix(folder)?);
        if let Some(parent) = target.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::copy(&file, &target)?;
    }
    fs::create_dir_all(place)?;
    fs::write(place.join("stdout.txt"), &answer.stdout)?;
    fs::write(place.join("stderr.txt"), &answer.stderr)?;
    Ok(())
}

/// The plain files of a folder and of those in it.
fn files_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let (path, kind) = entry.and_then(|entry| Ok((entry.path(), entry.file_type()?)))?;
        if kind.is_dir() {
            files.extend(files_below(&path)?);
        } else if kind.is_file() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::subjects::Oracle;
    use super::*;

    /// A program of a few shell lines, and a subject that reads a file.
    fn findings(script: &str, oracle: Oracle) -> Vec<Finding> {
        let place = tempfile::tempdir().unwrap();
        let program = place.path().join("program");
        fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        let subject = Subject {
            name: "stand-in",
            words: vec!["read".into(), "numbers.csv".into(), "--format".into(), "table".into()],
            files: vec![("numbers.csv".into(), b"name,load_n\nsand,17.0\nclay,20.5\n".to_vec())],
            oracle,
        };
        let mut limits = Limits::GENEROUS;
        limits.processor_s = 1;
        let plan = Plan { seed: 3, first: 0, cases: 200, program: None, limits };
        run(&program, &[subject], &plan, &place.path().join("kept")).unwrap()
    }

    /// The faults that a fuzzer is there to find, each put into a program.
    #[test]
    fn a_fault_that_was_put_in_is_found() {
        for (script, fault) in [
            // Ends by a signal where a number is too large for it.
            ("grep -q 1e400 numbers.csv && kill -SEGV $$; exit 0", "signal"),
            (
                "grep -q -- '-1' numbers.csv && echo \"thread 'main' panicked at x\" >&2; exit 0",
                "panic",
            ),
            // Hands control characters on to the terminal.
            ("cat numbers.csv", "control character"),
            ("grep -q nan numbers.csv && exit 77; exit 0", "exit code 77"),
            ("grep -q nan numbers.csv && exit 2; exit 0", "without saying why"),
            // Takes a second of a processor, over and over.
            ("grep -q 1e308 numbers.csv && while :; do :; done; exit 0", "limit of time"),
        ] {
            let found = findings(script, Oracle::Sane);
            let expected = found.iter().any(|finding| finding.fault.contains(fault));
            assert!(expected, "{script}: {found:?}");
        }
    }

    #[test]
    fn a_program_without_a_fault_passes() {
        let found = findings(
            "grep -q 'nan' numbers.csv && { echo 'error: no number' >&2; exit 2; }; exit 0",
            Oracle::Sane,
        );
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn damage_that_changes_an_answer_is_found_and_damage_that_is_refused_is_none() {
        let oracle = || Oracle::Unchanged { stdout: "37.5\n".into() };
        let sum = "awk -F, 'NR > 1 { sum += $2 } END { print sum }' numbers.csv";
        assert!(!findings(sum, oracle()).is_empty());
        let checked = format!(
            "[ \"$(cksum < numbers.csv)\" = '2780361304 32' ] || {{ echo 'error: damaged' >&2; \
             exit 2; }}; {sum}"
        );
        let found = findings(&checked, oracle());
        assert!(found.is_empty(), "{found:?}");
    }
}
