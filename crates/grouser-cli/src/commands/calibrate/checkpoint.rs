//! The sampler's state on disk, from which an interrupted calibration continues.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::checkpoint::{LARGEST, from_bytes, to_bytes};
use grouser::document::file::FileProblem;
use grouser::document::{self, escape};
use grouser::studies::calibration::PosteriorState;

use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::output::folder::{OldFiles, OutputFolder, make_folder};
use crate::output::{self, file};

/// The file by which an unfinished calibration is known.
const FILE: &str = "unfinished-calibration";

/// A place for the sampler's state, beside the results to come.
pub(super) struct Checkpoint {
    file: PathBuf,
    identity: String,
    kept: Option<PosteriorState>,
}

/// The output folder of a calibration: new, or holding an unfinished one that is to be finished.
pub(super) fn open_folder(args: &CalibrateArgs) -> Result<Option<OutputFolder>, Failure> {
    let Some(target) = &args.output.out else { return Ok(None) };
    // A fit without samples finishes nothing: another one's state is not its to replace.
    let goes_on = !args.point_fit && target.join(FILE).is_file();
    let old_files = if args.output.force || goes_on { OldFiles::Replace } else { OldFiles::Keep };
    OutputFolder::open(target, old_files).map(Some)
}

impl Checkpoint {
    /// The checkpoint of a calibration, with the state to go on from if an earlier run was
    /// interrupted; `None` without a folder, or without samples.
    ///
    /// * `identity`: the inputs that identify this calibration
    pub(super) fn open(args: &CalibrateArgs, identity: String) -> Result<Option<Self>, Failure> {
        let Some(folder) = args.output.out.as_ref().filter(|_| !args.point_fit) else {
            return Ok(None);
        };
        let mut checkpoint = Self { file: folder.join(FILE), identity, kept: None };
        checkpoint.kept = checkpoint.read(args.output.force)?;
        Ok(Some(checkpoint))
    }

    /// The state to go on from.
    pub(super) fn kept(&self) -> Option<PosteriorState> {
        self.kept.clone()
    }

    fn read(&self, force: bool) -> Result<Option<PosteriorState>, Failure> {
        let shown = escape::path(&self.file);
        let bytes = match document::file::read(&self.file, LARGEST) {
            Ok(bytes) => bytes,
            Err(FileProblem::NoSuchFile) => return Ok(None),
            Err(problem) => return Err(Failure::Run(format!("{shown}: {problem}"))),
        };
        match from_bytes(&bytes, &self.identity) {
            Ok(state) => {
                let blocks = state.blocks;
                output::message(&format!("going on after block {blocks} of an interrupted run"));
                Ok(Some(state))
            }
            Err(_) if force => Ok(None),
            Err(error) => Err(Failure::Usage(format!(
                "{shown} cannot be gone on from: {error}\nhint: choose another folder, or add \
                 --force to start anew"
            ))),
        }
    }

    /// Keeps a state: the earlier one stays until this one is whole.
    pub(super) fn write(&self, state: &PosteriorState) -> Result<(), Failure> {
        let folder = self.file.parent().unwrap_or(Path::new("."));
        make_folder(folder)?;
        file::write(&self.file, &to_bytes(state, &self.identity))
    }

    /// Removes the state, once the results are in their place.
    pub(super) fn remove(&self) -> Result<(), Failure> {
        match fs::remove_file(&self.file) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(Failure::at("cannot remove", &self.file)(error))
            }
            _ => Ok(()),
        }
    }
}
