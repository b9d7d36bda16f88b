//! The state of learning in the output folder, from which the same command goes on.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use grouser::document::file::FileProblem;
use grouser::document::learn::{KeptDrive, LARGEST_STATE, state_text};
use grouser::document::{self, LoadedScenario, escape};
use grouser::studies::learn::Drive;

use crate::args::LearnArgs;
use crate::failure::Failure;
use crate::output::folder::{OldFiles, OutputFolder, make_folder};
use crate::output::{self, file};

/// The file of the state.
const FILE: &str = "learn-state.json";
/// A state is kept no more often than this.
const RHYTHM: Duration = Duration::from_secs(2);

/// The output folder: a new one, or one with a state to go on from.
pub(super) fn open_folder(args: &LearnArgs) -> Result<Option<OutputFolder>, Failure> {
    let Some(target) = &args.output.out else { return Ok(None) };
    let goes_on = target.join(FILE).is_file();
    let old_files = if args.output.force || goes_on { OldFiles::Replace } else { OldFiles::Keep };
    OutputFolder::open(target, old_files).map(Some)
}

/// A place for the state; nowhere without an output folder.
pub(super) struct StateFile<'a> {
    file: Option<PathBuf>,
    scenario: &'a LoadedScenario,
    slope_is_known: bool,
    kept: Option<Instant>,
}

impl<'a> StateFile<'a> {
    pub(super) fn of(args: &LearnArgs, scenario: &'a LoadedScenario) -> Self {
        let file = args.output.out.as_ref().map(|folder| folder.join(FILE));
        Self { file, scenario, slope_is_known: args.slope_deg.is_some(), kept: None }
    }

    /// The drive to go on with, if there is a state.
    ///
    /// * `is_anew`: whether an earlier state does not count
    pub(super) fn read(&self, is_anew: bool) -> Result<Option<Drive>, Failure> {
        let Some(file) = self.file.as_ref().filter(|_| !is_anew) else { return Ok(None) };
        let bytes = match document::file::read(file, LARGEST_STATE) {
            Ok(bytes) => bytes,
            Err(FileProblem::NoSuchFile) => return Ok(None),
            Err(problem) => {
                return Err(Failure::Run(format!("{}: {problem}", escape::path(file))));
            }
        };
        let text = String::from_utf8_lossy(&bytes);
        let kept = KeptDrive::read(&text);
        let drive = kept.and_then(|kept| kept.drive(self.scenario, self.slope_is_known));
        let drive = drive.map_err(|error| {
            Failure::Usage(format!(
                "{} cannot be gone on from: {error}\nhint: choose another folder, or add --force \
                 to start anew",
                escape::path(file)
            ))
        })?;
        output::message(&format!("going on after {} records of an earlier run", drive.records()));
        Ok(Some(drive))
    }

    /// Keeps the state, if the last one was kept some time ago.
    pub(super) fn keep_now_and_then(&mut self, drive: &Drive) -> Result<(), Failure> {
        match self.kept {
            Some(kept) if kept.elapsed() < RHYTHM => Ok(()),
            _ => self.keep(drive),
        }
    }

    /// Keeps the state: the earlier one stays until this one is whole.
    pub(super) fn keep(&mut self, drive: &Drive) -> Result<(), Failure> {
        let Some(file) = &self.file else { return Ok(()) };
        let folder = file.parent().unwrap_or(Path::new("."));
        make_folder(folder)?;
        let text = state_text(drive, self.scenario, self.slope_is_known);
        file::write(file, text.as_bytes())?;
        self.kept = Some(Instant::now());
        Ok(())
    }
}
