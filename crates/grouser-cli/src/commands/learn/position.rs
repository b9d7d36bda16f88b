//! Where in a log a drive goes on: after the records that were learnt from.

use grouser::document::measurements::telemetry::{Lost, TelemetryRecord};
use grouser::studies::learn::{Drive, RecordDigest};

use crate::failure::Failure;

/// Passes over the records of a log that were learnt from before.
pub(super) struct Position {
    /// What messages call the log.
    label: String,
    kind: Kind,
}

enum Kind {
    /// All records are new.
    New,
    /// A file is read from its start: its first records have to be those that were learnt from.
    File { left: u64, digest: RecordDigest, expected: RecordDigest, records: u64 },
    /// Standard input goes on, or begins again: records up to a time were learnt from.
    Stream { last: f64, earlier: Lost, before: Lost },
}

impl Position {
    /// The position after the records of a drive.
    pub(super) fn after(drive: &Drive, label: &str, is_stream: bool) -> Self {
        let records = drive.records();
        let kind = match drive.last_time() {
            Some(last) if is_stream => {
                Kind::Stream { last, earlier: drive.lost().clone(), before: Lost::default() }
            }
            Some(_) => Kind::File {
                left: records,
                digest: RecordDigest::default(),
                expected: drive.digest(),
                records,
            },
            None => Kind::New,
        };
        Self { label: label.to_owned(), kind }
    }

    /// Whether a record is new.
    ///
    /// * `lost`: what was left out of the log up to it
    pub(super) fn is_new(
        &mut self,
        record: &TelemetryRecord,
        lost: &Lost,
    ) -> Result<bool, Failure> {
        let is_other = match &mut self.kind {
            Kind::New | Kind::File { left: 0, .. } => return Ok(true),
            Kind::Stream { last, .. } if record.time > *last => return Ok(true),
            Kind::Stream { before, .. } => {
                before.clone_from(lost);
                return Ok(false);
            }
            Kind::File { left, digest, expected, .. } => {
                *left -= 1;
                *digest = digest.and(record);
                *left == 0 && digest != expected
            }
        };
        if is_other { Err(self.is_another()) } else { Ok(false) }
    }

    /// What was left out of the drive.
    ///
    /// * `lost`: what was left out of the log since it was opened
    pub(super) fn lost(&self, lost: Lost) -> Lost {
        match &self.kind {
            Kind::Stream { earlier, before, .. } => earlier.and(&lost.since(before)),
            Kind::New | Kind::File { .. } => lost,
        }
    }

    /// Checks, at the end of the log, that it has all records that were learnt from.
    pub(super) fn check_end(&self) -> Result<(), Failure> {
        match &self.kind {
            Kind::File { left, .. } if *left > 0 => Err(self.is_another()),
            _ => Ok(()),
        }
    }

    fn is_another(&self) -> Failure {
        let Kind::File { records, .. } = self.kind else { unreachable!("only files are compared") };
        Failure::Usage(format!(
            "{}: it does not begin with the {records} records that were learnt from before: it is another log, or was \
             changed\nhint: choose another folder, or add --force to learn from all of it anew",
            self.label
        ))
    }
}
