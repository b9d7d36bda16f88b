//! Readings of several topics, put in the order of time and joined to rows.
//!
//! Readings wait for those of earlier times that come later, as long as the window says. A clock
//! that leaps ahead once is an error of the clock; the time is believed when the reading after it
//! has it too.

use std::collections::BTreeMap;

use grouser_io::measurements::telemetry::Cell;
use grouser_io::telemetry_mapping::RowRule;

use crate::mapping::pose::Pose;
use crate::mapping::turning::{Angle, Turned};

/// A leap ahead that a single reading is not believed [ns]: ten minutes.
const LEAP: i64 = 600 * 1_000_000_000;
/// Readings that wait at most; more are passed on before their window ends.
const MOST_WAITING: usize = 100_000;

/// What was read at one time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Readings {
    /// Cells, each with the place of its column.
    pub(crate) cells: Vec<(usize, Cell)>,
    /// Poses, each with its slot.
    pub(crate) poses: Vec<(usize, Pose)>,
    /// Angles of wheels, each with its slot.
    pub(crate) angles: Vec<(usize, Angle)>,
    /// Whether a row ends here, where a topic says when.
    pub(crate) ends_row: bool,
}

impl Readings {
    /// Takes in what was read at the same time.
    fn join(&mut self, other: Self) {
        for (column, cell) in other.cells {
            set(&mut self.cells, column, cell);
        }
        for (slot, pose) in other.poses {
            set(&mut self.poses, slot, pose);
        }
        for (slot, angle) in other.angles {
            set(&mut self.angles, slot, angle);
        }
        self.ends_row |= other.ends_row;
    }

    /// Takes in what was read later, within the same row: ways add up, all else is the newest.
    ///
    /// * `is_way`: whether a column is one of ways, or rotations, since the last
    fn go_on(&mut self, later: Self, is_way: impl Fn(usize) -> bool) {
        for (column, cell) in later.cells {
            let before = self.cells.iter().find(|(known, _)| *known == column).map(|it| it.1);
            let cell = match (before, cell) {
                (Some(Cell::Number(before)), Cell::Number(now)) if is_way(column) => {
                    Cell::Number(before + now)
                }
                (_, cell) => cell,
            };
            set(&mut self.cells, column, cell);
        }
        for (slot, pose) in later.poses {
            set(&mut self.poses, slot, pose);
        }
        for (slot, angle) in later.angles {
            set(&mut self.angles, slot, angle);
        }
    }
}

fn set<V>(all: &mut Vec<(usize, V)>, place: usize, value: V) {
    match all.iter_mut().find(|(known, _)| *known == place) {
        Some((_, known)) => *known = value,
        None => all.push((place, value)),
    }
}

/// Readings on their way to rows.
#[derive(Clone, Debug)]
pub(crate) struct Merge {
    window: i64,
    rule: RowRule,
    /// Whether each column is one of ways, or rotations, since the last.
    ways: Vec<bool>,
    turning: Turned,
    waiting: BTreeMap<i64, Readings>,
    newest: Option<i64>,
    /// The time of the last reading, if it leapt ahead and is not believed.
    leapt: Option<i64>,
    /// All up to here has been passed on [ns].
    passed: Option<i64>,
    row: Option<(i64, Readings)>,
    has_ended: bool,
    /// Whether ways, or rotations, were among the readings that were left out lately.
    has_lost_ways: bool,
    /// Readings that came in all.
    all: u64,
    /// Readings that came after their window.
    pub(crate) late: u64,
    /// Readings whose time leapt ahead.
    pub(crate) leaps: u64,
}

impl Merge {
    pub(crate) fn new(window: i64, rule: RowRule, ways: Vec<bool>, turning: Turned) -> Self {
        Self {
            window,
            rule,
            ways,
            turning,
            waiting: BTreeMap::new(),
            newest: None,
            leapt: None,
            passed: None,
            row: None,
            has_ended: false,
            has_lost_ways: false,
            all: 0,
            late: 0,
            leaps: 0,
        }
    }

    /// Adds what was read at a time [ns].
    pub(crate) fn add(&mut self, time: i64, readings: Readings) {
        self.all += 1;
        let near = |other: i64| time.saturating_sub(other) <= LEAP;
        if self.newest.is_some_and(|newest| !near(newest)) {
            let is_confirmed =
                self.leapt.is_some_and(|leapt| time.saturating_sub(leapt).saturating_abs() <= LEAP);
            self.leapt = Some(time);
            if !is_confirmed {
                self.leaps += 1;
                self.leave_out(&readings);
                return;
            }
        }
        if self.passed.is_some_and(|passed| time <= passed) {
            self.late += 1;
            self.leave_out(&readings);
            return;
        }
        self.leapt = None;
        self.newest = self.newest.max(Some(time));
        self.waiting.entry(time).or_default().join(readings);
    }

    fn leave_out(&mut self, readings: &Readings) {
        let is_way = |(column, _): &(usize, Cell)| self.ways.get(*column) == Some(&true);
        self.has_lost_ways |= readings.cells.iter().any(is_way);
    }

    /// The latest time of which there was a reading [ns].
    pub(crate) fn newest(&self) -> Option<i64> {
        self.newest
    }

    /// The share of the readings that were not left out; 1 before the first.
    pub(crate) fn share_used(&self) -> f64 {
        let left_out = self.late + self.leaps;
        if self.all == 0 { 1.0 } else { 1.0 - left_out as f64 / self.all as f64 }
    }

    /// Whether ways, or rotations, were left out since this was last asked.
    pub(crate) fn take_lost_ways(&mut self) -> bool {
        std::mem::take(&mut self.has_lost_ways)
    }

    /// No more comes: all that waits is passed on.
    pub(crate) fn end(&mut self) {
        self.has_ended = true;
    }

    /// The next row that is complete, with its time [ns].
    pub(crate) fn next_row(&mut self) -> Option<(i64, Readings)> {
        while let Some((time, readings)) = self.next_in_order() {
            self.passed = Some(time);
            if let Some(row) = self.add_to_row(time, readings) {
                return Some(row);
            }
        }
        // What comes after the last message of the topic that ends rows is no row.
        let is_row = self.has_ended && !matches!(self.rule, RowRule::Topic(_));
        if is_row { self.row.take() } else { None }
    }

    /// The earliest reading, if no earlier one can come any more.
    fn next_in_order(&mut self) -> Option<(i64, Readings)> {
        let (first, newest) = (*self.waiting.first_key_value()?.0, self.newest?);
        let is_due = self.has_ended
            || newest.saturating_sub(first) > self.window
            || self.waiting.len() > MOST_WAITING;
        let (time, mut readings) = is_due.then(|| self.waiting.pop_first()).flatten()?;
        self.turning.go_on(time, &mut readings.angles);
        Some((time, readings))
    }

    /// Adds readings to the row, which is returned if that ends it or if they begin another one.
    fn add_to_row(&mut self, time: i64, readings: Readings) -> Option<(i64, Readings)> {
        let ends_row = readings.ends_row || self.rule == RowRule::EachTime;
        let is_same = |row_time: i64| match self.rule {
            RowRule::EachTime => false,
            RowRule::Interval(interval) => {
                row_time.div_euclid(interval.max(1)) == time.div_euclid(interval.max(1))
            }
            RowRule::Topic(_) => true,
        };
        let ways = &self.ways;
        let is_way = |column: usize| ways.get(column).copied().unwrap_or(false);
        let complete = match self.row.take() {
            Some((row_time, mut row)) if is_same(row_time) => {
                row.go_on(readings, is_way);
                self.row = Some((time, row));
                None
            }
            other => {
                self.row = Some((time, readings));
                other
            }
        };
        if ends_row { self.row.take() } else { complete }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: i64 = 1_000_000_000;

    fn reading(column: usize, value: f64) -> Readings {
        Readings { cells: vec![(column, Cell::Number(value))], ..Readings::default() }
    }

    /// Times [s] and cells of all rows.
    fn rows(merge: &mut Merge) -> Vec<(f64, Vec<(usize, Cell)>)> {
        std::iter::from_fn(|| merge.next_row())
            .map(|(time, readings)| (time as f64 / 1e9, readings.cells))
            .collect()
    }

    #[test]
    fn readings_out_of_order_come_in_order_and_what_is_too_late_is_counted() {
        let mut merge = Merge::new(SECOND, RowRule::EachTime, vec![], Turned::default());
        let mut found = Vec::new();
        for (time, column) in [(10, 1), (12, 1), (11, 2), (11, 1), (20, 1), (15, 2), (12, 2)] {
            merge.add(time * SECOND / 10, reading(column, 1.0));
            found.extend(rows(&mut merge));
        }
        // Ten waits for what comes within a second; 1.2 s came after 2.0 s, when it could still
        // wait.
        merge.add(40 * SECOND / 10, reading(1, 1.0));
        found.extend(rows(&mut merge));
        merge.add(14 * SECOND / 10, reading(1, 1.0));
        merge.end();
        found.extend(rows(&mut merge));
        let times: Vec<f64> = found.iter().map(|it| it.0).collect();
        assert_eq!(times, [1.0, 1.1, 1.2, 1.5, 2.0, 4.0]);
        assert_eq!(found[1].1.len(), 2, "what has one time is one row");
        assert_eq!(merge.late, 1);
    }

    /// One message of a clock that leapt would make all others late.
    #[test]
    fn a_leap_is_believed_when_it_is_repeated() {
        let mut merge = Merge::new(SECOND, RowRule::EachTime, vec![], Turned::default());
        for time in [1, 2, 9_000_000, 3, 4, 5000, 5001, 5002] {
            merge.add(time * SECOND, reading(1, 1.0));
        }
        merge.end();
        let times: Vec<f64> = rows(&mut merge).into_iter().map(|it| it.0).collect();
        assert_eq!(times, [1.0, 2.0, 3.0, 4.0, 5001.0, 5002.0]);
        assert_eq!((merge.leaps, merge.late), (2, 0));
    }

    #[test]
    fn an_interval_has_the_newest_of_each_column_and_the_sum_of_ways() {
        let mut merge =
            Merge::new(0, RowRule::Interval(SECOND), vec![false, false, true], Turned::default());
        for (time, column, value) in
            [(1, 1, 5.0), (2, 2, 0.1), (8, 1, 6.0), (9, 2, 0.25), (11, 1, 7.0)]
        {
            merge.add(time * SECOND / 10, reading(column, value));
        }
        merge.end();
        let found = rows(&mut merge);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], (0.9, vec![(1, Cell::Number(6.0)), (2, Cell::Number(0.35))]));
    }

    #[test]
    fn a_topic_ends_rows() {
        let mut merge = Merge::new(0, RowRule::Topic("/clock".into()), vec![], Turned::default());
        let end = || Readings { ends_row: true, ..reading(2, 0.0) };
        for (time, readings) in [
            (1, reading(1, 1.0)),
            (2, end()),
            (3, reading(1, 3.0)),
            (3, end()),
            (4, reading(1, 9.0)),
        ] {
            merge.add(time * SECOND, readings);
        }
        merge.end();
        let found = rows(&mut merge);
        assert_eq!(found.iter().map(|it| it.0).collect::<Vec<_>>(), [2.0, 3.0]);
        assert!(found.iter().all(|(_, cells)| cells.len() == 2));
    }

    #[test]
    fn memory_does_not_grow_with_what_waits() {
        let mut merge = Merge::new(i64::MAX, RowRule::EachTime, vec![], Turned::default());
        let mut found = 0;
        for time in 0..i64::try_from(MOST_WAITING).unwrap() + 50 {
            merge.add(time, reading(1, 1.0));
            found += rows(&mut merge).len();
        }
        assert_eq!(found, 50);
    }
}
