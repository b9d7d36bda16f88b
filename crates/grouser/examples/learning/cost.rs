//! What an update costs, on one thread.

use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

use grouser::studies::learn::Learner;

use super::coverage::{LEGS, Trial};
use super::drive::{Drive, INSTRUMENTS, learner, scenario};

/// What a drive cost.
pub(crate) struct Cost {
    pub(crate) wheels: usize,
    pub(crate) models: usize,
    pub(crate) stretches: u64,
    pub(crate) records: usize,
    /// Processor time [s].
    pub(crate) time: f64,
}

/// A rover of four wheels and one of six, with one model and with those of a soil that leaves the
/// model open.
pub(crate) fn costs(trial: &Trial<'_>) -> Vec<Cost> {
    let six = "scenario.rover=sojourner";
    let soil = "scenario.soil=toyoura-uncertain";
    let one = "scenario.model=ishigami";
    let all: [&[&str]; 4] = [&[soil, one], &[soil], &[soil, one, six], &[soil, six]];
    all.into_iter().filter_map(|settings| cost(trial, settings)).collect()
}

fn cost(trial: &Trial<'_>, settings: &[&str]) -> Option<Cost> {
    let prior = scenario(settings);
    let mut learner: Learner = learner(&prior);
    let truth = &learner.samples(trial.seed, 1).ok()?[0].sample;
    let mut drive = Drive::uneven(&prior, truth, trial.seed);
    for leg in LEGS {
        drive.leg(leg)?;
    }
    let records = drive.seen(INSTRUMENTS, trial.seed);
    let start = processor_time();
    let count = records.len();
    for record in records {
        learner.update(record);
    }
    Some(Cost {
        wheels: drive.study().rover.wheel_count(),
        models: learner.models().shares().len(),
        stretches: learner.learnt().stretches,
        records: count,
        time: processor_time() - start,
    })
}

/// Processor time of this thread [s]; where the system does not tell it, time.
fn processor_time() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|it| it.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| START.elapsed().as_secs_f64(), |it| 1e-9 * it)
}
