//! How each reader fared.

use std::time::Duration;

use crate::Tried;
use crate::readers::Reader;

/// What all cases of a reader took.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    cases: u64,
    read: u64,
    bytes: u64,
    time: Duration,
    slowest: Duration,
    largest: usize,
}

impl Tally {
    pub(crate) fn add(&mut self, tried: &Tried) {
        self.and(&Self {
            cases: 1,
            read: u64::from(tried.is_read),
            bytes: tried.input.len() as u64,
            time: tried.taken.time,
            slowest: tried.taken.time,
            largest: tried.taken.memory,
        });
    }

    pub(crate) fn and(&mut self, other: &Self) {
        self.cases += other.cases;
        self.read += other.read;
        self.bytes += other.bytes;
        self.time += other.time;
        self.slowest = self.slowest.max(other.slowest);
        self.largest = self.largest.max(other.largest);
    }
}

/// Prints a row for each reader.
pub(crate) fn print(readers: &[Reader], tallies: &[Tally]) {
    println!(
        "{:<28}{:>9}{:>9}{:>11}{:>12}{:>12}{:>10}",
        "reader", "inputs", "read", "bytes each", "inputs/CPU s", "slowest, ms", "most, MB"
    );
    let mut all = Tally::default();
    let row = |name: &str, tally: &Tally| {
        let count = tally.cases.max(1) as f64;
        let share = format!("{:.0} %", 100.0 * tally.read as f64 / count);
        let (bytes, speed) = (tally.bytes as f64 / count, count / tally.time.as_secs_f64());
        let (slowest, largest) = (1e3 * tally.slowest.as_secs_f64(), tally.largest as f64 / 1e6);
        println!(
            "{name:<28}{:>9}{share:>9}{bytes:>11.0}{speed:>12.0}{slowest:>12.0}{largest:>10.1}",
            tally.cases
        );
    };
    for (reader, tally) in readers.iter().zip(tallies) {
        all.and(tally);
        row(reader.name, tally);
    }
    row("all", &all);
}
