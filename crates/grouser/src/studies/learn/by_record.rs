//! What records show before they are stretches: ways that are lost, and an attitude that no sensor
//! measures.

use super::archive::{Archive, named, numbers};
use super::straight_line::StraightLine;
use super::stretch::GAP;
use grouser_io::measurements::telemetry::TelemetryRecord;

/// What records have shown so far.
#[derive(Clone, Debug, Default)]
pub(super) struct ByRecord {
    /// Way forward over the time since the last one [m, s].
    ways: StraightLine,
    /// The first times between ways, in their order by size [s].
    times: Vec<f64>,
    /// When a way was last read [s].
    last_way: Option<f64>,
    zeros: Zeros,
    still: Still,
}

/// Ways of exactly 0 between others.
#[derive(Clone, Debug, Default)]
struct Zeros {
    /// Those of 0, the others, the small ones of these, and those behind one of 0, with their sum.
    none: f64,
    some: f64,
    small: f64,
    behind: f64,
    /// Sums of the sizes of some, and of those behind one of 0 [m].
    way: f64,
    way_behind: f64,
    /// Some different ways [m].
    different: Vec<f64>,
    /// Whether the last was 0: 1 if it was.
    was_none: f64,
}

/// Roll and pitch that stay exactly the same while ways scatter.
#[derive(Clone, Debug, Default)]
struct Still {
    /// Roll and pitch [rad], since so many records, over which ways turned around so often.
    roll: Option<f64>,
    pitch: Option<f64>,
    records: f64,
    turns: f64,
    /// The last way, and its last change [m].
    way: f64,
    change: f64,
}

impl ByRecord {
    /// Looks at the way that a record has since the last one, and at its attitude.
    pub(super) fn read(&mut self, record: &TelemetryRecord) {
        if record.is_way_incomplete {
            self.last_way = None;
        }
        self.still.read(record);
        let Some(way) = record.displacement[0] else { return };
        let turns = record.wheels.iter().any(|it| it.speed.is_some_and(|it| it != 0.0));
        if turns {
            self.zeros.read(way.abs());
        }
        let since = self.last_way.replace(record.time).map(|last| record.time - last);
        if let Some(since) = since.filter(|since| *since <= GAP) {
            self.take_way(since, way.abs());
        }
    }

    /// Takes a way that is as long as usual ones in time, or a whole number of times as long: times
    /// that scatter tell nothing. Neither does a way that is wrong by far.
    fn take_way(&mut self, since: f64, way: f64) {
        /// Times by which the usual one is known, and its place among them: most may be long.
        const FIRST: usize = 21;
        const PLACE: usize = 1;
        if self.times.len() < FIRST {
            self.times.push(since);
            self.times.sort_by(f64::total_cmp);
            return;
        }
        let usual = self.times[PLACE].max(f64::MIN_POSITIVE);
        let is_whole = |time: f64| {
            let number = time / usual;
            number > 0.9 && (number - number.round()).abs() < 0.1
        };
        let are_whole = self.times.iter().filter(|it| is_whole(**it)).count() + 1 >= FIRST;
        let mean = self.ways.y / self.ways.count.max(1.0);
        if are_whole && is_whole(since) && (self.ways.count < 10.0 || way < 4.0 * mean) {
            self.ways.add(since, way);
        }
    }

    /// The share of the ways that is left, where some are lost with the rows, or the readings, that
    /// had them [-].
    pub(super) fn share_of_ways(&self) -> Option<f64> {
        self.zeros.lost().or_else(|| self.growth())
    }

    /// Ways that do not grow with the time since the last one: by which share of it they do.
    fn growth(&self) -> Option<f64> {
        /// Fewer ways tell little.
        const FEW: f64 = 60.0;
        /// Times that scatter by less than this over their mean do not, either [-].
        const SCATTERS: f64 = 0.2;
        /// Ways grow in proportion to the time: by more than this of it [-].
        const GROWS: f64 = 0.4;
        let StraightLine { count, x, y, xx, xy, .. } = self.ways;
        if count < FEW || y <= 0.0 {
            return None;
        }
        let (time, way) = (x / count, y / count);
        let variance = xx / count - time * time;
        if variance < (SCATTERS * time).powi(2) {
            return None;
        }
        let grows = (xy / count - time * way) / variance * time / way;
        (grows < GROWS).then_some(grows)
    }

    /// Whether roll and pitch are no readings.
    pub(super) fn is_attitude_still(&self) -> bool {
        /// Records with one attitude, and ways that turned around meanwhile.
        const LONG: f64 = 60.0;
        const SCATTER: f64 = 15.0;
        self.still.records >= LONG && self.still.turns >= SCATTER
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { ways, times, last_way, zeros, still } = self;
        ways.walk("ways", archive);
        numbers(archive, "times", times);
        archive.maybe("last_way", last_way);
        archive.group("zeros");
        let Zeros { none, some, small, behind, way, way_behind, different, was_none } = zeros;
        named(archive, [("none", none), ("some", some), ("small", small), ("behind", behind)]);
        named(archive, [("way", way), ("way_behind", way_behind), ("was_none", was_none)]);
        numbers(archive, "different", different);
        archive.end();
        archive.group("still");
        let Still { roll, pitch, records, turns, way, change } = still;
        archive.maybe("roll", roll);
        archive.maybe("pitch", pitch);
        named(archive, [("records", records), ("turns", turns), ("way", way), ("change", change)]);
        archive.end();
    }
}

impl Zeros {
    /// Different ways that are remembered: what is rounded coarsely has fewer.
    const DIFFERENT: usize = 8;

    fn read(&mut self, way: f64) {
        if way == 0.0 {
            self.none += 1.0;
            self.was_none = 1.0;
            return;
        }
        self.some += 1.0;
        self.way += way;
        // Less than three tenths of the mean.
        self.small += f64::from(u8::from(way * self.some < 0.3 * self.way));
        if self.was_none > 0.0 {
            self.behind += 1.0;
            self.way_behind += way;
        }
        self.was_none = 0.0;
        if self.different.len() < Self::DIFFERENT && !self.different.contains(&way) {
            self.different.push(way);
        }
    }

    /// The share of ways that are left, where those behind one of 0 are no longer than others, which
    /// are no ways that come to 0 by their noise.
    fn lost(&self) -> Option<f64> {
        /// So many of 0 are no chance, nor is such a share of all.
        const FEW: f64 = 10.0;
        const SHARE: f64 = 0.03;
        /// Ways that were not lost add up: those behind one of 0 are longer than this over others
        /// [-].
        const LONGER: f64 = 1.3;
        let all = self.none + self.some;
        let is_seen = self.none >= FEW && self.none > SHARE * all && self.behind >= 0.5 * FEW;
        let is_noise = 3.0 * self.small > self.none || self.different.len() < Self::DIFFERENT;
        let others = (self.way - self.way_behind) / (self.some - self.behind);
        let is_longer = self.way_behind > LONGER * others * self.behind;
        // Behind each a longer one: no others to compare with.
        let has_others = self.some - self.behind > self.behind;
        (is_seen && !is_noise && has_others && !is_longer).then(|| self.some / all)
    }
}

impl Still {
    fn read(&mut self, record: &TelemetryRecord) {
        /// A change that is no rounding of the computer's, over the way [-].
        const CHANGE: f64 = 1e-4;
        if record.roll.is_some() && record.pitch.is_some() {
            if (self.roll, self.pitch) != (record.roll, record.pitch) {
                (self.records, self.turns) = (0.0, 0.0);
                (self.roll, self.pitch) = (record.roll, record.pitch);
            }
            self.records += 1.0;
        }
        let Some(way) = record.displacement[0] else { return };
        let change = way - self.way;
        if change.abs() > CHANGE * way.abs() {
            self.turns += f64::from(u8::from(change * self.change < 0.0));
            self.change = change;
        }
        self.way = way;
    }
}
