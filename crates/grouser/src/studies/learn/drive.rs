//! A drive that is learnt from: the learner, what it found on the way, and how far in the log it
//! is.

use super::archive::{Archive, items};
use super::warnings::Warning;
use super::{Learner, Lesson, NotUsed, TelemetryRecord, WheelTelemetry};
use grouser_io::fnv_1a;
use grouser_io::measurements::telemetry::Lost;
use grouser_io::reading::counted;

/// Lessons that are kept at most: of a longer drive every n-th.
const MOST_LESSONS: usize = 5000;

/// Learns from a drive and keeps what it found, in memory that does not grow with the drive.
#[derive(Clone, Debug)]
pub struct Drive {
    learner: Learner,
    lessons: Vec<Lesson>,
    warnings: Vec<Warning>,
    last_time: Option<f64>,
    records_seen: RecordDigest,
    lost: Lost,
}

/// A number by which records are known again, one after the other: FNV-1a of 64 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RecordDigest(u64);

impl RecordDigest {
    /// With one more record.
    #[must_use]
    pub fn and(self, record: &TelemetryRecord) -> Self {
        let TelemetryRecord {
            time,
            roll,
            pitch,
            yaw,
            displacement,
            rotation,
            position,
            wheels,
            // What it tells is in the stretches.
            is_way_incomplete: _,
        } = record;
        let [forward, leftward] = *displacement;
        let [x, y] = *position;
        let of_rover =
            [Some(*time), *roll, *pitch, *yaw, forward, leftward, *rotation, x, y].into_iter();
        let of_wheels = wheels.iter().flat_map(|it| {
            let WheelTelemetry { speed, torque, current, steering, sinkage } = *it;
            [speed, torque, current, steering, sinkage]
        });
        // No reading is NaN: its bits stand for a gap.
        let bits = of_rover.chain(of_wheels).map(|it| it.unwrap_or(f64::NAN).to_bits());
        Self(fnv_1a(self.0.to_le_bytes().into_iter().chain(bits.flat_map(u64::to_le_bytes))))
    }

    /// The number.
    #[must_use]
    pub const fn hash(self) -> u64 {
        self.0
    }
}

impl Learner {
    /// Why stretches of the drive taught nothing, and how many readings are left out, a sentence
    /// each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let sentence = |why: NotUsed| {
            let count = self.learnt.not_used.get(&why)?;
            let stretches = counted(*count, "stretch", "stretches");
            Some(format!("{stretches} taught nothing: {}", why.meaning()))
        };
        let outliers = self.learnt.outliers;
        let left_out = (outliers > 0)
            .then(|| format!("{outliers} readings far from those around them are left out"));
        NotUsed::ALL.into_iter().filter_map(sentence).chain(left_out).collect()
    }
}

impl Drive {
    /// A drive that is about to begin.
    #[must_use]
    pub fn new(learner: Learner) -> Self {
        let (lessons, warnings) = (Vec::new(), Vec::new());
        let (records_seen, lost) = (RecordDigest::default(), Lost::default());
        Self { learner, lessons, warnings, last_time: None, records_seen, lost }
    }

    /// Takes the next record; what was learnt, where it completes a stretch that teaches something.
    pub fn update(&mut self, record: TelemetryRecord) -> Option<&Lesson> {
        self.last_time = Some(record.time);
        self.records_seen = self.records_seen.and(&record);
        let lesson = self.learner.update(record)?;
        Some(self.keep(lesson))
    }

    /// Notes what was left out of the telemetry so far.
    pub fn note_lost(&mut self, lost: Lost) {
        self.lost = lost;
    }

    /// What was left out of the telemetry.
    #[must_use]
    pub fn lost(&self) -> &Lost {
        &self.lost
    }

    /// The drive as if it ended here: the records that are too few for a stretch of their own
    /// count, too.
    #[must_use]
    pub fn finished(&self) -> Self {
        let mut finished = self.clone();
        if let Some(lesson) = finished.learner.finish() {
            finished.keep(lesson);
        }
        finished.warnings.extend(finished.learner.take_pending());
        finished
    }

    /// Keeps a lesson, the last of those that the learner has counted.
    fn keep(&mut self, lesson: Lesson) -> &Lesson {
        self.warnings.extend(lesson.warnings.iter().cloned());
        make_room(&mut self.lessons, self.learner.learnt().stretches, MOST_LESSONS as u64);
        self.lessons.push(lesson);
        &self.lessons[self.lessons.len() - 1]
    }

    /// The learner.
    #[must_use]
    pub fn learner(&self) -> &Learner {
        &self.learner
    }

    /// What stretches taught: all of them, or every n-th of a long drive and the last one.
    #[must_use]
    pub fn lessons(&self) -> &[Lesson] {
        &self.lessons
    }

    /// All warnings.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Time of the last record [s].
    #[must_use]
    pub fn last_time(&self) -> Option<f64> {
        self.last_time
    }

    /// How many records were taken.
    #[must_use]
    pub fn records(&self) -> u64 {
        self.learner.learnt.records
    }

    /// The number by which the records that were taken are known again.
    #[must_use]
    pub fn digest(&self) -> RecordDigest {
        self.records_seen
    }

    /// Writes its state.
    pub fn write_state(&self, archive: &mut dyn Archive) {
        self.clone().walk(archive);
        archive.group("learner");
        self.learner.write_state(archive);
        archive.end();
    }

    /// Goes on from a state, as [`Learner::read_state`].
    pub fn read_state(&mut self, archive: &mut dyn Archive) -> bool {
        self.walk(archive);
        archive.group("learner");
        let is_whole = self.learner.read_state(archive);
        archive.end();
        is_whole
    }

    fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { learner: _, lessons, warnings, last_time, records_seen, lost } = self;
        archive.maybe("last_time", last_time);
        archive.count("digest", &mut records_seen.0);
        items(archive, "lessons", lessons, Lesson::default, Lesson::walk);
        items(archive, "warnings", warnings, Warning::blank, Warning::walk);
        archive.group("lost");
        walk_lost(lost, archive);
        archive.end();
    }
}

/// Makes room for the next of many, of which every n-th is kept and the last one.
///
/// * `count`: how many there are with it
fn make_room<T>(kept: &mut Vec<T>, count: u64, most: u64) {
    let every = |count: u64| count.div_ceil(most).next_power_of_two();
    let before = count.saturating_sub(1);
    if !before.is_multiple_of(every(before)) {
        kept.pop();
    }
    if every(count) > every(before) {
        let mut place = 0;
        kept.retain(|_| {
            place += 1;
            place % 2 == 0
        });
    }
}

fn walk_lost(lost: &mut Lost, archive: &mut dyn Archive) {
    let Lost {
        damaged_rows,
        rows_without_time,
        rows_out_of_order,
        rows_without_torque,
        frozen,
        cells,
    } = lost;
    archive.count("damaged_rows", damaged_rows);
    archive.count("rows_without_time", rows_without_time);
    archive.count("rows_out_of_order", rows_out_of_order);
    archive.count("rows_without_torque", rows_without_torque);
    for (name, counts) in [("cells", cells), ("frozen", frozen)] {
        let mut of_columns: Vec<(String, u64)> = std::mem::take(counts).into_iter().collect();
        let blank = || (String::new(), 0);
        items(archive, name, &mut of_columns, blank, |(column, count), archive| {
            archive.word("column", column);
            archive.count("count", count);
        });
        *counts = of_columns.into_iter().collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_every_nth_is_kept_and_the_last() {
        const MOST: u64 = 8;
        let mut kept = Vec::new();
        for count in 1..=1000 {
            make_room(&mut kept, count, MOST);
            kept.push(count);
            let every = kept[0];
            assert!(every.is_power_of_two() && every < 2 * count.div_ceil(MOST), "{kept:?}");
            let mut expected: Vec<u64> = (1..=count / every).map(|place| place * every).collect();
            expected.extend((count % every != 0).then_some(count));
            assert_eq!(kept, expected);
            assert!(kept.len() as u64 <= MOST + 1, "{kept:?}");
        }
    }
}
