//! Does work and nothing else: what a counter of instructions is pointed at, and what Python's
//! calls are measured against.
//!
//! `work set` prints the instruction set, `work costs` the map of costs. `work KEY TIMES` does a
//! unit of work; with TIMES 0 it prepares and does nothing, which is the count to subtract.
//! `work wheels`, `work forces`, `work quasi-steady` and `work dynamic` read rows of numbers, eight
//! bytes each, from the standard input, and print the seconds that all of them take on all cores.

use std::error::Error;
use std::hint::black_box;
use std::io::Read as _;
use std::process::ExitCode;
use std::time::Instant;

use grouser::contact::InstructionSet;
use grouser::simulation::Approach;
use grouser_bench::costs::CostMap;
use grouser_bench::{Arrays, Fixtures, Unit};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["set"] => println!("{}", InstructionSet::best().name()),
        ["costs"] => print!("{}", CostMap::new()?),
        ["wheels"] => println!("{}", seconds(&Arrays::wheels(&rows()?)?)?),
        ["forces"] => println!("{}", seconds(&Arrays::sunk(&rows()?)?)?),
        ["quasi-steady"] => {
            println!("{}", seconds(&Arrays::traverses(Approach::QuasiSteady, &rows()?)?)?);
        }
        ["dynamic"] => println!("{}", seconds(&Arrays::traverses(Approach::Dynamic, &rows()?)?)?),
        [key, times] => {
            let unit = Unit::ALL.into_iter().find(|unit| unit.key() == key).ok_or_else(usage)?;
            println!("{}", count(unit, times.parse()?)?);
        }
        _ => return Err(usage().into()),
    }
    Ok(ExitCode::SUCCESS)
}

fn usage() -> String {
    let keys: Vec<&str> = Unit::ALL.into_iter().map(Unit::key).collect();
    format!(
        "usage: work set | work costs | work KEY TIMES | work wheels | work forces | work quasi-steady | work dynamic\n\
         keys: {}",
        keys.join(", ")
    )
}

/// How often a unit was done in some looks at the clock.
fn count(unit: Unit, times: u32) -> Result<usize, Box<dyn Error>> {
    let fixtures = Fixtures::new()?;
    Ok((0..times).map(|_| black_box(fixtures.work(unit)).count).sum())
}

/// Rows of numbers from the standard input.
fn rows<const N: usize>() -> Result<Vec<[f64; N]>, Box<dyn Error>> {
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes)?;
    let (numbers, rest) = bytes.as_chunks::<8>();
    let numbers: Vec<f64> = numbers.iter().map(|number| f64::from_le_bytes(*number)).collect();
    let (rows, incomplete) = numbers.as_chunks::<N>();
    if rest.is_empty() && incomplete.is_empty() && !rows.is_empty() {
        Ok(rows.to_vec())
    } else {
        Err(format!("{} bytes are no rows of {N} numbers", bytes.len()).into())
    }
}

/// How long the work takes [s]; an error if none of it has a result.
fn seconds(arrays: &Arrays) -> Result<f64, Box<dyn Error>> {
    let start = Instant::now();
    let done = arrays.compute();
    let seconds = start.elapsed().as_secs_f64();
    if done == 0 { Err("nothing of it has a result".into()) } else { Ok(seconds) }
}
