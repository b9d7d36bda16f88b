//! Gives damaged files of every kind to the readers of all crates, in one process on all cores.
//!
//! ```text
//! cargo xtask fuzz readers [--cases N] [--seed N] [--only N]
//! ```
//!
//! Case *i* depends on the seed and *i* alone: one of the [readers], one of its files, and damage at
//! one to three places of that. A fault is a panic that leaves the reader, more than a second of the
//! processor or 200 MB of memory, or a number that was read and is not finite. What was read then is
//! kept in a folder; so is the number of the case that each thread is at, for what ends the whole
//! process.
//!
//! The arguments are a folder, a seed, the first case and how many there are.

#![expect(unsafe_code, reason = "an allocator that counts, and the clock of a thread")]

#[expect(dead_code, reason = "the tests use all of it")]
#[path = "../../tests/it/container.rs"]
mod container;
mod corpus;
#[path = "../../../../xtask/src/fuzz/damage.rs"]
mod damage;
mod finite;
#[expect(dead_code, reason = "the crate uses all of it")]
#[path = "../../src/mcap/format.rs"]
mod format;
mod measure;
mod readers;
mod report;

use std::cell::RefCell;
use std::error::Error;
use std::fs::{self, File};
use std::io::{Seek as _, Write as _};
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use fastrand::Rng;
use measure::{Counting, Taken, measured};
use readers::{Outcome, Reader, Stage};
use report::Tally;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most that reading may take of a processor.
const MOST_TIME: Duration = Duration::from_secs(1);
/// The most memory that it may take [bytes].
const MOST_MEMORY: usize = 200_000_000;
/// Time of day after which a case is taken to have no end.
const NO_END: Duration = Duration::from_secs(60);
/// Faults after which a run ends.
const ENOUGH: usize = 20;

thread_local! {
    /// The last panic of this thread, with its place.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// What is to be tried, and where its traces go.
struct Plan {
    folder: PathBuf,
    seed: u64,
    first: u64,
    cases: u64,
}

impl Plan {
    /// Keeps what a case reads.
    fn keep(&self, case: u64, input: &[u8]) {
        let _ = fs::write(self.folder.join(format!("case-{case}")), input);
    }
}

/// A case that found a fault.
struct Finding {
    case: u64,
    reader: &'static str,
    fault: String,
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, seed, first, cases] = &arguments[..] else {
        return Err("the arguments are a folder, a seed, the first case and their number".into());
    };
    let plan = Plan {
        folder: folder.into(),
        seed: seed.parse()?,
        first: first.parse()?,
        cases: cases.parse()?,
    };
    fs::create_dir_all(&plan.folder)?;
    panic::set_hook(Box::new(|about| PANIC.set(about.to_string().replace('\n', " "))));
    let readers = readers::all()?;
    check_whole(&readers)?;
    let (tallies, findings) = run(&plan, &readers)?;
    report::print(&readers, &tallies);
    for Finding { case, reader, fault } in &findings {
        println!("case {case}, {reader}: {fault}");
    }
    println!("{} cases, seed {}: {} with a fault", plan.cases, plan.seed, findings.len());
    Ok(if findings.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Checks that every reader reads some of its files as long as they are whole: behind a refusal
/// there is nothing to find.
fn check_whole(readers: &[Reader]) -> Result<(), Box<dyn Error>> {
    let stage = Stage::new()?;
    for Reader { name, files, read, .. } in readers {
        let refusal = |file: &Vec<u8>| match read(file, &stage) {
            Outcome::Read => None,
            Outcome::Refused(why) | Outcome::Wrong(why) => Some(why),
        };
        let refusals: Option<Vec<String>> = files.iter().map(refusal).collect();
        if let Some(why) = refusals.as_ref().and_then(|it| it.first()) {
            return Err(format!("{name}: no file is read, the first since {why}").into());
        }
    }
    Ok(())
}

/// Runs the cases of a plan on all cores; how each reader fared, and what was found.
fn run(plan: &Plan, readers: &[Reader]) -> Result<(Vec<Tally>, Vec<Finding>), Box<dyn Error>> {
    let next = AtomicU64::new(plan.first);
    let findings = Mutex::new(Vec::new());
    let lock = || findings.lock().unwrap_or_else(PoisonError::into_inner);
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let at: Vec<AtomicU64> = (0..workers).map(|_| AtomicU64::new(u64::MAX)).collect();
    let is_done = AtomicBool::new(false);
    let work = |number: usize| -> Result<Vec<Tally>, String> {
        let told = |error: std::io::Error| error.to_string();
        let stage = Stage::new().map_err(told)?;
        let mut place = File::create(plan.folder.join(format!("worker-{number}"))).map_err(told)?;
        let mut tallies = vec![Tally::default(); readers.len()];
        loop {
            let case = next.fetch_add(1, Ordering::Relaxed);
            if case >= plan.first + plan.cases || lock().len() >= ENOUGH {
                at[number].store(u64::MAX, Ordering::Relaxed);
                return Ok(tallies);
            }
            at[number].store(case, Ordering::Relaxed);
            place.rewind().and_then(|()| writeln!(place, "{case:<20}")).map_err(told)?;
            let tried = try_case(plan, readers, &stage, case);
            tallies[tried.reader].add(&tried);
            if let Some(fault) = tried.fault {
                let reader = readers[tried.reader].name;
                plan.keep(case, &tried.input);
                lock().push(Finding { case, reader, fault });
            }
        }
    };
    let mut sums = vec![Tally::default(); readers.len()];
    thread::scope(|scope| -> Result<(), Box<dyn Error>> {
        let watch = scope.spawn(|| watch(&at, &is_done));
        let handles: Vec<_> =
            (0..workers).map(|number| scope.spawn(move || work(number))).collect();
        let ended: Vec<_> = handles.into_iter().map(ScopedJoinHandle::join).collect();
        is_done.store(true, Ordering::Relaxed);
        for tallies in ended {
            let tallies = tallies.map_err(|_| "a worker panicked")??;
            sums.iter_mut().zip(&tallies).for_each(|(sum, tally)| sum.and(tally));
        }
        watch.join().map_err(|_| "the watch panicked".into())
    })?;
    let mut findings = findings.into_inner().unwrap_or_else(PoisonError::into_inner);
    findings.sort_by_key(|finding| finding.case);
    Ok((sums, findings))
}

/// Ends the process where a case has no end.
fn watch(at: &[AtomicU64], is_done: &AtomicBool) {
    let mut seen: Vec<(u64, Instant)> = at.iter().map(|_| (u64::MAX, Instant::now())).collect();
    while !is_done.load(Ordering::Relaxed) {
        thread::sleep(Duration::from_millis(20));
        for (seen, at) in seen.iter_mut().zip(at) {
            let case = at.load(Ordering::Relaxed);
            if case != seen.0 {
                *seen = (case, Instant::now());
            } else if case != u64::MAX && seen.1.elapsed() > NO_END {
                println!("case {case}: it has no end");
                std::process::exit(1);
            }
        }
    }
}

/// A case that was tried.
struct Tried {
    /// Which of the readers.
    reader: usize,
    input: Vec<u8>,
    taken: Taken,
    /// Whether something was read, and not refused.
    is_read: bool,
    fault: Option<String>,
}

fn try_case(plan: &Plan, readers: &[Reader], stage: &Stage, case: u64) -> Tried {
    // The cases of two seeds have nothing in common, as those of the program.
    let mut dice = Rng::with_seed(plan.seed ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let (place, input) = input(readers, &mut dice);
    let reader = &readers[place];
    if plan.cases == 1 {
        // Reading it may end the process.
        plan.keep(case, &input);
    }
    let read = || panic::catch_unwind(AssertUnwindSafe(|| (reader.read)(&input, stage)));
    let (outcome, taken) = measured(read);
    let mut is_read = false;
    let fault = match outcome {
        Err(_) => Some(format!("panic: {}", PANIC.take())),
        Ok(Outcome::Wrong(what)) => Some(format!("what was read is {what}")),
        Ok(outcome) => {
            is_read = matches!(outcome, Outcome::Read);
            too_much(taken)
        }
    };
    Tried { reader: place, input, taken, is_read, fault }
}

/// What was taken too much of.
fn too_much(taken: Taken) -> Option<String> {
    let megabytes = taken.memory as f64 / 1e6;
    if taken.memory > MOST_MEMORY {
        Some(format!("it takes {megabytes:.0} MB"))
    } else if taken.time > MOST_TIME {
        Some(format!("it takes {:.1} s", taken.time.as_secs_f64()))
    } else {
        None
    }
}

/// A reader, in proportion to its share, and a damaged file for it.
fn input(readers: &[Reader], dice: &mut Rng) -> (usize, Vec<u8>) {
    /// Most cases are no longer than this, so that there can be many [bytes].
    const SHORT: usize = 1 << 13;
    /// One of so many is long.
    const LONG: u16 = 1 << 6;
    let shares: u32 = readers.iter().map(|reader| reader.share).sum();
    let mut rest = dice.u32(..shares);
    let is_it = |reader: &Reader| match rest.checked_sub(reader.share) {
        Some(less) => {
            rest = less;
            false
        }
        None => true,
    };
    let place = readers.iter().position(is_it).unwrap_or(0);
    let Reader { files, mend, .. } = &readers[place];
    let mut input = files[dice.usize(..files.len())].clone();
    let short = input.len().max(SHORT);
    for _ in 0..=dice.usize(..4) / 2 {
        damage::damage(&mut input, dice);
    }
    if dice.u16(..LONG) == 0 {
        grow(&mut input, dice);
    } else {
        input.truncate(short);
    }
    if let Some(mend) = mend.filter(|_| dice.bool()) {
        mend(&mut input);
    }
    (place, input)
}

/// Repeats some bytes, or some lines, of a content until it is long: what is nested then is nested
/// deeply, and what costs the square of a length shows.
fn grow(content: &mut Vec<u8>, dice: &mut Rng) {
    let start = dice.usize(..=content.len());
    let end = (start + (1 << dice.u8(..10))).min(content.len());
    let piece = content[start..end].to_vec();
    let times = (1_usize << dice.u8(12..20)) / piece.len().max(1);
    content.splice(start..start, piece.repeat(times));
}

/// Where files of this repository are that tests of other crates have.
fn beside(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}
