//! Recorded drives of a folder, each of a log of its own.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grouser::studies::drive_validation::{DriveRecorder, RecordedDrive};
use grouser_core::simulation::Scenario;
use grouser_io::escape;
use grouser_io::given_file::{FileContent, GivenFile};

use crate::error::TelemetryError;
use crate::telemetry::TelemetryLog;
use crate::telemetry::mcap::McapFile;
use crate::telemetry::options::LogOptions;

/// Recorded drives, and what reading their logs gave.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct DriveFolder {
    /// The drives, in the order of their logs' paths, folder by folder.
    pub drives: Vec<RecordedDrive>,
    /// What each log gave, and a mapping of the user's.
    pub given: Vec<GivenFile>,
    /// What was noticed, and which logs are left out: a sentence each.
    pub notes: Vec<String>,
    /// The share of all rows that was used [-].
    pub share_used: f64,
}

/// Why there are no drives.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DriveFolderError {
    /// There is no such folder.
    #[error("{}: there is no such folder", escape::path(.0))]
    NoFolder(PathBuf),
    /// It has no file whose name is that of a log.
    #[error("{}: no log in it or below, among {others} files", escape::path(.folder))]
    NoLog {
        /// The folder.
        folder: PathBuf,
        /// How many other files there are.
        others: usize,
    },
    /// A folder cannot be looked into.
    #[error("cannot look into {}: {error}", escape::path(.folder))]
    Unreadable {
        /// The folder.
        folder: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// No log is telemetry of the rover: what is wrong with the first.
    #[error(transparent)]
    Log(#[from] TelemetryError),
}

impl DriveFolder {
    /// What the names of logs end with.
    pub const ENDINGS: [&str; 7] = ["csv", "gz", "parquet", "arrow", "arrows", "feather", "mcap"];

    /// Reads a log of each drive, in folders of any depth. Files of MCAP in one folder that share no
    /// topic are one drive, a sensor each; every other file is a drive.
    ///
    /// * `scenario`: its rover and gravity are used
    /// * `options`: how logs are read
    ///
    /// # Errors
    /// [`DriveFolderError`] where there is no folder, no log in it, or none that can be read; one that
    /// cannot be read beside others is left out with a note.
    pub fn read(
        folder: &Path,
        scenario: &Scenario,
        options: &LogOptions,
    ) -> Result<Self, DriveFolderError> {
        let (mut found, mut notes) = (Self::default(), Notes::default());
        let (mut first_error, mut rows, mut used) = (None, 0.0, 0.0);
        for files in logs_of_drives(&logs_below(folder)?, options) {
            let name = name_of(&files, folder);
            match drive(&files, &name, scenario, options) {
                Ok((drive, log)) => {
                    rows += drive.records as f64;
                    used += log.share_used() * drive.records as f64;
                    log.notes().into_iter().for_each(|note| notes.add(&name, note));
                    found.give(&name, log.given());
                    found.drives.push(drive);
                }
                Err(error) => {
                    notes.add(&name, left_out(&error));
                    first_error = first_error.or(Some(error));
                }
            }
        }
        if let (true, Some(error)) = (found.drives.is_empty(), first_error) {
            return Err(error.into());
        }
        found.notes = notes.sentences();
        found.share_used = if rows > 0.0 { used / rows } else { 1.0 };
        Ok(found)
    }

    /// Takes in what the files of a drive gave; logs of many drives may have one mapping.
    fn give(&mut self, name: &str, mut files: Vec<GivenFile>) {
        let mut logs = files.iter_mut().filter(|it| it.content == FileContent::Telemetry);
        if let (Some(log), None) = (logs.next(), logs.next()) {
            name.clone_into(&mut log.file);
        }
        let new: Vec<GivenFile> = files.into_iter().filter(|it| !self.given.contains(it)).collect();
        self.given.extend(new);
    }
}

/// A drive, and its log, read to its end.
fn drive(
    files: &[PathBuf],
    name: &str,
    scenario: &Scenario,
    options: &LogOptions,
) -> Result<(RecordedDrive, TelemetryLog), TelemetryError> {
    let mut log = TelemetryLog::open_all(files, &scenario.rover, options)?;
    let mut recorder = DriveRecorder::new(scenario);
    while let Some(record) = log.next_record()? {
        recorder.update(record);
    }
    Ok((recorder.finish(name.to_owned()), log))
}

/// Why a log is left out, without its name, which stands before every note.
fn left_out(error: &TelemetryError) -> String {
    let text = error.to_string();
    let why = text.lines().next().unwrap_or_default();
    let after = why.strip_prefix(error.label()).and_then(|it| it.split_once(": "));
    format!("left out: {}", after.map_or(why, |(_, why)| why))
}

/// What answers call a drive: its log within the folder, or the folder of its logs.
fn name_of(files: &[PathBuf], folder: &Path) -> String {
    let first = files.first().map_or(folder, PathBuf::as_path);
    let own = match files {
        [_] => first,
        _ => first.parent().filter(|it| *it != folder).unwrap_or(first),
    };
    own.strip_prefix(folder).unwrap_or(own).to_string_lossy().into_owned()
}

/// The logs below a folder, folder by folder.
fn logs_below(folder: &Path) -> Result<Vec<PathBuf>, DriveFolderError> {
    if !folder.is_dir() {
        return Err(DriveFolderError::NoFolder(folder.to_owned()));
    }
    let (mut logs, mut folders, mut others) = (Vec::new(), vec![folder.to_owned()], 0);
    while let Some(folder) = folders.pop() {
        let failed = |error| DriveFolderError::Unreadable { folder: folder.clone(), error };
        for entry in fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let ending = entry.path().extension().map(|it| it.to_string_lossy().to_lowercase());
            // A link to a folder may lead back here.
            if entry.file_type().map_err(failed)?.is_dir() {
                folders.push(entry.path());
            } else if ending.is_some_and(|it| DriveFolder::ENDINGS.contains(&it.as_str())) {
                logs.push(entry.path());
            } else {
                others += 1;
            }
        }
    }
    if logs.is_empty() {
        return Err(DriveFolderError::NoLog { folder: folder.to_owned(), others });
    }
    logs.sort_by(|one, other| (one.parent(), one).cmp(&(other.parent(), other)));
    Ok(logs)
}

/// The files of each drive.
///
/// * `logs`: folder by folder
fn logs_of_drives(logs: &[PathBuf], options: &LogOptions) -> Vec<Vec<PathBuf>> {
    let mut drives = Vec::new();
    for of_folder in logs.chunk_by(|one, other| one.parent() == other.parent()) {
        let is_mcap =
            |it: &PathBuf| it.extension().is_some_and(|it| it.eq_ignore_ascii_case("mcap"));
        let (mcap, others): (Vec<PathBuf>, Vec<PathBuf>) =
            of_folder.iter().cloned().partition(is_mcap);
        drives.extend(others.into_iter().map(|it| vec![it]));
        if mcap.len() > 1 && McapFile::share_no_topic(&mcap, options) {
            drives.push(mcap);
        } else {
            drives.extend(mcap.into_iter().map(|it| vec![it]));
        }
    }
    drives
}

/// Notes on logs: what is the same of many is one note.
#[derive(Default)]
struct Notes(Vec<(String, String, usize)>);

impl Notes {
    fn add(&mut self, log: &str, note: String) {
        match self.0.iter_mut().find(|(_, known, _)| *known == note) {
            Some((.., more)) => *more += 1,
            None => self.0.push((log.to_owned(), note, 0)),
        }
    }

    fn sentences(self) -> Vec<String> {
        let sentence = |(log, note, more): (String, String, usize)| match more {
            0 => format!("{log}: {note}"),
            more => format!("{log} and {more} more: {note}"),
        };
        self.0.into_iter().map(sentence).collect()
    }
}
