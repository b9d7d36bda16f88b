//! Damaged files for every reader, in one process: `crates/grouser-logs/examples/read_anything`.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::workspace;

/// The program that has all readers.
const PROGRAM: &str = "read_anything";
/// Cases of a usual run: some seconds on two cores.
const USUAL: u64 = 30_000;
/// Cases of a full run: the better part of an hour.
const FULL: u64 = 10_000_000;

/// What is to be tried.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    seed: u64,
    first: u64,
    cases: u64,
}

impl Plan {
    pub(crate) fn of(extent: Extent) -> Self {
        match extent {
            Extent::Usual => Self { seed: 1, first: 0, cases: USUAL },
            Extent::Full => Self { seed: 2, first: 0, cases: FULL },
        }
    }

    /// Reads `--cases N`, `--seed N` and `--only N`, in any order.
    pub(crate) fn parse(arguments: &[&str]) -> Result<Self> {
        let mut plan = Self::of(Extent::Usual);
        for pair in arguments.chunks(2) {
            let [name, value] = *pair else { bail!("{} needs a value", pair[0]) };
            let number = value.parse().with_context(|| format!("{name} {value}"))?;
            match name {
                "--cases" => plan.cases = number,
                "--seed" => plan.seed = number,
                "--only" => (plan.first, plan.cases) = (number, 1),
                _ => bail!("fuzz readers takes --cases N, --seed N and --only N, not {name}"),
            }
        }
        Ok(plan)
    }
}

/// Tries the readers of this checkout.
pub(crate) fn check(plan: Plan) -> Result<Count> {
    let program = workspace::build_example(PROGRAM)?;
    let kept = workspace::target().join("fuzz/readers");
    let _ = fs::remove_dir_all(&kept);
    let mut readers = Command::new(program);
    readers.arg(&kept).args([plan.seed, plan.first, plan.cases].map(|it| it.to_string()));
    let status = readers.stdin(Stdio::null()).status().context("the readers did not start")?;
    if !status.success() {
        if status.code() != Some(1) {
            println!("the readers ended with {status}, at one of the cases {}", at(&kept));
        }
        println!(
            "what was read is in {}; `cargo xtask fuzz readers --seed {} --only CASE` reads it \
             again",
            kept.display(),
            plan.seed
        );
    }
    Ok(Count::one(status.success()))
}

/// The case that each thread was at.
fn at(kept: &Path) -> String {
    let of = |number: usize| fs::read_to_string(kept.join(format!("worker-{number}"))).ok();
    let cases: Vec<String> = (0..).map_while(of).map(|case| case.trim().to_owned()).collect();
    cases.join(", ")
}
