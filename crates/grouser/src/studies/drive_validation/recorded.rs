//! A drive as it is kept for comparison: its stretches, with what instruments cannot have read left
//! out.

use crate::simulation::Scenario;
use crate::studies::learn::{
    Gatherer, GrossFault, GrossFaults, RecordDigest, Stretch, TelemetryRecord,
};

/// Which of two sets of drives one belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Split {
    /// Free to fit a soil or a model to.
    Training,
    /// Models are ranked on it.
    Test,
}

impl Split {
    /// One word: `training`, `test`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Training => "training",
            Self::Test => "test",
        }
    }

    /// The first bit of the hash of all readings decides: not the name, nor the drives beside it.
    const fn of(digest: RecordDigest) -> Self {
        if digest.hash() >> 63 == 0 { Self::Training } else { Self::Test }
    }
}

/// A drive that was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedDrive {
    /// What answers call it.
    pub name: String,
    /// The set that it belongs to.
    pub split: Split,
    /// How many records it has.
    pub records: usize,
    /// Its stretches, without what gross faults are of.
    pub stretches: Vec<Stretch>,
    /// Gross faults of its telemetry.
    pub gross_faults: Vec<GrossFault>,
}

/// Takes a drive record by record.
#[derive(Clone, Debug)]
pub struct DriveRecorder<'s> {
    scenario: &'s Scenario,
    gatherer: Gatherer,
    gross: GrossFaults,
    digest: RecordDigest,
    records: usize,
    stretches: Vec<Stretch>,
}

impl<'s> DriveRecorder<'s> {
    /// * `scenario`: its rover and gravity are used
    #[must_use]
    pub fn new(scenario: &'s Scenario) -> Self {
        Self {
            scenario,
            gatherer: Gatherer::new(&scenario.rover, None),
            gross: GrossFaults::default(),
            digest: RecordDigest::default(),
            records: 0,
            stretches: Vec::new(),
        }
    }

    /// Takes a record.
    pub fn update(&mut self, record: TelemetryRecord) {
        self.records += 1;
        self.digest = self.digest.and(&record);
        self.gross.read(&record);
        let complete = self.gatherer.push(record);
        self.take(complete);
    }

    fn take(&mut self, stretch: Option<Stretch>) {
        let Some(stretch) = stretch else { return };
        self.gross.look(&stretch, &self.scenario.rover, self.scenario.gravity);
        self.stretches.push(stretch);
    }

    /// The drive that was taken.
    #[must_use]
    pub fn finish(mut self, name: String) -> RecordedDrive {
        let last = self.gatherer.take();
        self.take(last);
        let Self { gross, digest, records, mut stretches, .. } = self;
        for stretch in &mut stretches {
            gross.leave_out(stretch);
        }
        let gross_faults = gross.found().to_vec();
        RecordedDrive { name, split: Split::of(digest), records, stretches, gross_faults }
    }
}
