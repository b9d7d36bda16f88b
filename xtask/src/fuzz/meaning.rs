//! Faults of meaning: good drives, damaged in the ways in which logs are, are refused, warned of or
//! noted, or teach what the good ones teach.
//!
//! The drives are those of the example `learning`: of every rover, on level ground, on one slope and
//! over several.

mod faults;
mod table;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;

use crate::extent::Extent;
use crate::libtest::Count;
use crate::{cores, markers, workspace};
use faults::Fault;
use table::Table;

/// Drives in all, and those that a usual run damages.
const DRIVES: usize = 20;
const USUAL: [usize; 2] = [1, 5];
/// Where the table of all drives stands.
const FILE: &str = "docs/guide/telemetry.md";
const BLOCK: &str = "measured by: cargo xtask fuzz --meaning";

/// A good drive.
struct Drive {
    rover: String,
    course: String,
    table: Table,
    learnt: Learnt,
}

/// What the program makes of a log.
#[derive(Debug)]
struct Learnt {
    code: Option<i32>,
    /// Quantiles of slip and heading that it predicts for each slope, 2.5, 50 and 97.5 %; nothing
    /// where it is no number.
    predicted: Vec<Option<[f64; 3]>>,
    warnings: Vec<String>,
    notes: BTreeSet<String>,
}

/// What becomes of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Nothing is learnt, or the exit code is not 0.
    Refused,
    /// There are warnings, or what is learnt is said to contradict what was known.
    WarnedOf,
    /// There are notes that the good drive has not.
    Noted,
    /// What is predicted lies in the bands of the good drive.
    Harmless,
    /// It does not, but its own bands hold what the good drive predicts.
    LessSure,
    /// None of these.
    Silent,
}

impl Outcome {
    const ALL: [(Self, &str); 6] = [
        (Self::Refused, "refused"),
        (Self::WarnedOf, "warned of"),
        (Self::Noted, "noted"),
        (Self::Harmless, "harmless"),
        (Self::LessSure, "less sure"),
        (Self::Silent, "silent"),
    ];
}

/// Damages some drives, or all; counts a check for each fault: it fails where more drives say nothing
/// of it than the guide's table has.
pub(crate) fn check(extent: Extent) -> Result<Count> {
    let drives: &[usize] = match extent {
        Extent::Usual => &USUAL,
        Extent::Full => &std::array::from_fn::<usize, DRIVES, _>(|place| place),
    };
    let known = documented()?;
    let mut count = Count::default();
    for (fault, outcomes) in examine(drives)? {
        let silent = outcomes.iter().filter(|it| **it == Some(Outcome::Silent)).count();
        let most = known.get(fault).with_context(|| format!("`{fault}` is not in {FILE}"))?;
        count += Count::one(silent <= *most);
    }
    Ok(count)
}

/// The drives that say nothing of a fault, by the guide's table.
fn documented() -> Result<BTreeMap<String, usize>> {
    let guide = fs::read_to_string(workspace::root().join(FILE)).context(FILE)?;
    let rows = markers::content_by(&guide, BLOCK)?.lines().filter(|it| it.starts_with("| "));
    let row = |row: &str| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let silent = cells[cells.len() - 2];
        Some((cells[1].to_owned(), if silent.is_empty() { 0 } else { silent.parse().ok()? }))
    };
    Ok(rows.filter_map(row).collect())
}

/// Damages all drives, and writes the table into the guide.
pub(crate) fn write() -> Result<Count> {
    let drives: Vec<usize> = (0..DRIVES).collect();
    let found = examine(&drives)?;
    markers::write_content_by(FILE, BLOCK, &lines(&found))?;
    Ok(Count { passed: found.len() as u64, ..Count::default() })
}

/// What becomes of each fault, by drives.
type Outcomes = Vec<(&'static str, Vec<Option<Outcome>>)>;

/// Damages drives in all ways.
fn examine(numbers: &[usize]) -> Result<Outcomes> {
    let program = workspace::build_program()?;
    let folder = tempfile::tempdir().context("a folder for drives")?;
    let drives = drives(&program, folder.path(), numbers)?;
    let faults = faults::all();
    let cases: Vec<(usize, usize)> = (0..faults.len())
        .flat_map(|fault| (0..drives.len()).map(move |drive| (fault, drive)))
        .collect();
    let outcomes = Mutex::new(vec![vec![None; drives.len()]; faults.len()]);
    let next = AtomicUsize::new(0);
    cores::on_each(|| {
        while let Some((fault, drive)) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            let outcome = outcome(&program, &faults[*fault], &drives[*drive])?;
            outcomes.lock().unwrap_or_else(PoisonError::into_inner)[*fault][*drive] = outcome;
        }
        Ok(())
    })?;
    let outcomes = outcomes.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(faults.iter().map(|it| it.name).zip(outcomes).collect())
}

/// Writes the drives, and learns from each as it is.
fn drives(program: &Path, folder: &Path, numbers: &[usize]) -> Result<Vec<Drive>> {
    let example = workspace::build_example("learning")?;
    let last = numbers.iter().max().map_or(0, |last| last + 1);
    let written = Command::new(example)
        .arg("drives")
        .arg(folder)
        .arg(last.to_string())
        .output()
        .context("the example `learning` did not start")?;
    ensure!(written.status.success(), "drives: {}", String::from_utf8_lossy(&written.stderr));
    let rows = String::from_utf8(written.stdout)?;
    let rows: Vec<&str> = rows.lines().collect();
    let drive = |number: &usize| {
        let mut row = rows[*number].split('\t').map(str::to_owned);
        let (Some(file), Some(rover), Some(course)) = (row.next(), row.next(), row.next()) else {
            bail!("a drive has no file, rover and course: {}", rows[*number]);
        };
        let table = Table::read(&folder.join(file))?;
        let learnt = Learnt::of(program, &table, &rover)?;
        let is_good = learnt.code == Some(0) && learnt.warnings.is_empty();
        ensure!(is_good, "{rover} on {course} is good: {learnt:?}");
        Ok(Drive { rover, course, table, learnt })
    };
    numbers.iter().map(drive).collect()
}

/// What becomes of a fault of a drive; nothing where the drive has nothing that it could be of.
fn outcome(program: &Path, fault: &Fault, drive: &Drive) -> Result<Option<Outcome>> {
    let mut table = drive.table.clone();
    fault.damage(&mut table);
    if table == drive.table {
        return Ok(None);
    }
    let found = Learnt::of(program, &table, &drive.rover)?;
    let outcome = found.outcome(&drive.learnt);
    if outcome == Outcome::Silent {
        println!(
            "{}, {} on {}: {:.3?} for {:.3?}",
            fault.name, drive.rover, drive.course, found.predicted, drive.learnt.predicted
        );
    }
    Ok(Some(outcome))
}

impl Learnt {
    fn of(program: &Path, table: &Table, rover: &str) -> Result<Self> {
        let folder = tempfile::tempdir().context("a folder for a log")?;
        fs::write(folder.path().join("drive.csv"), table.text())?;
        let line = "learn drive.csv --prior toyoura-uncertain --model ishigami --format json \
                    --predict-slope-deg 5,10,15 --samples 20 --rover";
        let output = Command::new(program)
            .args(line.split_whitespace().chain([rover]))
            .current_dir(folder.path())
            .output()
            .context("the program did not start")?;
        let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        let texts = |key: &str| {
            let all = found[key].as_array().into_iter().flatten();
            all.map(|it| it.as_str().map_or_else(|| it.to_string(), str::to_owned))
        };
        Ok(Self {
            code: output.status.code(),
            predicted: found["predictions"]
                .as_array()
                .into_iter()
                .flatten()
                .flat_map(bands)
                .collect(),
            warnings: texts("warnings").chain(texts("contradictions")).collect(),
            notes: texts("notes")
                .map(|it| it.replace(|it: char| it.is_ascii_digit(), ""))
                .collect(),
        })
    }

    fn outcome(&self, good: &Self) -> Outcome {
        type Band = Option<[f64; 3]>;
        let all = |holds: fn(&[f64; 3], &[f64; 3]) -> bool| {
            let mut pairs = self.predicted.iter().zip(&good.predicted);
            pairs.all(|(found, good): (&Band, &Band)| match (found, good) {
                (Some(found), Some(good)) => holds(good, found),
                (found, good) => found.is_none() && good.is_none(),
            })
        };
        let holds = |band: &[f64; 3], of: &[f64; 3]| (band[0]..=band[2]).contains(&of[1]);
        if self.code != Some(0) {
            Outcome::Refused
        } else if !self.warnings.is_empty() {
            Outcome::WarnedOf
        } else if !self.notes.is_subset(&good.notes) {
            Outcome::Noted
        } else if all(holds) {
            Outcome::Harmless
        } else if all(|good, found| (found[0]..=found[2]).contains(&good[1])) {
            Outcome::LessSure
        } else {
            Outcome::Silent
        }
    }
}

/// The bands of slip and heading of a prediction.
fn bands(prediction: &Value) -> [Option<[f64; 3]>; 2] {
    let band = |name: &str, unit: &str| {
        let number = |quantile: &str| prediction[format!("{name}{unit}{quantile}")].as_f64();
        Some([number("_p2_5")?, number("")?, number("_p97_5")?])
    };
    [band("slip_ratio", ""), band("yaw", "_deg")]
}

/// A row for each fault, with the number of drives by outcome.
fn lines(found: &Outcomes) -> String {
    let names = Outcome::ALL.map(|(_, name)| name).join(" | ");
    let mut lines = format!("| fault | {names} |\n|---|---|---|---|---|---|---|\n");
    for (fault, outcomes) in found {
        let counts = Outcome::ALL.map(|(kind, _)| {
            match outcomes.iter().filter(|it| **it == Some(kind)).count() {
                0 => String::new(),
                count => count.to_string(),
            }
        });
        let _ = writeln!(lines, "| {fault} | {} |", counts.join(" | "));
    }
    lines
}
