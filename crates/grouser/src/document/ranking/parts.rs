//! The data sets that models are ranked on, and their parts.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::contact::Model;
use crate::document::measurements::{self, MeasurementError};
use crate::document::{
    DataSetCase, DocumentError, Kind, LoadedDataSet, LoadedRover, LoadedSoil, Overrides, Source,
    check, place_of, presets, read_data_set,
};
use crate::error::ParameterError;
use crate::simulation::Scenario;
use crate::studies::heading::HeadingStudy;

/// Models cannot be ranked.
#[derive(Debug, thiserror::Error)]
pub enum RankingError {
    /// A folder that is not there.
    #[error("{}: there is no such folder", .0.display())]
    NoSuchFolder(PathBuf),
    /// A folder that cannot be read.
    #[error("cannot look into {}: {error}", folder.display())]
    Unreadable {
        /// The folder.
        folder: PathBuf,
        /// The system's error.
        error: std::io::Error,
    },
    /// A document that names a file which is not there.
    #[error("{} names a file that is not there: {}", document.display(), file.display())]
    NoSuchFile {
        /// The document.
        document: PathBuf,
        /// The file.
        file: PathBuf,
    },
    /// Nothing in the folder is known.
    #[error("no known data set in {} (known: {})", folder.display(), known.join(", "))]
    NoDataSet {
        /// The folder.
        folder: PathBuf,
        /// The data sets that are presets.
        known: Vec<&'static str>,
    },
    /// A document that cannot be used.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// A file of measurements that cannot be used.
    #[error(transparent)]
    Measurements(#[from] MeasurementError),
    /// A rover that cannot be compared on slopes, such as one with steered wheels.
    #[error(transparent)]
    Rover(#[from] ParameterError),
}

/// A data set, and where its rows are.
pub(super) struct DataSet {
    pub(super) set: LoadedDataSet,
    pub(super) rows: measurements::Source,
    /// Where a document of the folder names the file; presets are no files to look at.
    pub(super) named_at: Option<String>,
}

pub(super) fn data_sets_of_the_program() -> Result<Vec<DataSet>, RankingError> {
    let mut sets = Vec::new();
    for preset in presets(Kind::DataSet) {
        if let Some(rows) = measurements::Source::preset(preset.name) {
            let set = read_data_set(&Source::Preset(preset), &Overrides::none())?;
            sets.push(DataSet { set, rows, named_at: None });
        }
    }
    Ok(sets)
}

/// The data sets whose files are in a folder: those that documents in the folder describe, and
/// those of the program of whose file a copy is there that no document claims.
pub(super) fn data_sets_in(folder: &Path) -> Result<Vec<DataSet>, RankingError> {
    let mut own = Vec::new();
    for document in documents_in(folder)? {
        let set = read_data_set(&Source::file(&document), &Overrides::none())?;
        own.push(beside_its_document(set, &document)?);
    }
    let mut sets = Vec::new();
    for preset in presets(Kind::DataSet) {
        let set = read_data_set(&Source::Preset(preset), &Overrides::none())?;
        let file = folder.join(&set.value.file);
        let is_there = file.symlink_metadata().is_ok();
        let rows = measurements::Source::File(file);
        let is_claimed = own.iter().any(|claimed| claimed.rows == rows);
        if is_there && !is_claimed {
            sets.push(DataSet { set, rows, named_at: None });
        }
    }
    sets.extend(own);
    if sets.is_empty() {
        let known = presets(Kind::DataSet).map(|preset| preset.name).collect();
        return Err(RankingError::NoDataSet { folder: folder.to_owned(), known });
    }
    Ok(sets)
}

/// A data set whose file of measurements is where its document is.
pub(super) fn beside_its_document(
    set: LoadedDataSet,
    document: &Path,
) -> Result<DataSet, RankingError> {
    let file = document.with_file_name(&set.value.file);
    // Of a link to nothing the reading says so.
    if file.symlink_metadata().is_err() {
        return Err(RankingError::NoSuchFile { document: document.to_owned(), file });
    }
    let named_at = Some(place_of(&Source::file(document), "file")?.to_string());
    Ok(DataSet { set, rows: measurements::Source::File(file), named_at })
}

/// The documents of data sets in a folder, and those that may be meant as such, by name.
fn documents_in(folder: &Path) -> Result<Vec<PathBuf>, RankingError> {
    if !folder.is_dir() {
        return Err(RankingError::NoSuchFolder(folder.to_owned()));
    }
    let unreadable = |error| RankingError::Unreadable { folder: folder.to_owned(), error };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let files = entries.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = files.collect::<Result<_, _>>().map_err(unreadable)?;
    files.sort();
    let is_data_set =
        |path: &PathBuf| matches!(check(&Source::file(path)), Ok(Kind::DataSet) | Err(_));
    files.retain(|path| path.extension() == Some(OsStr::new("toml")) && is_data_set(path));
    Ok(files)
}

/// A part of a data set.
pub(super) struct Part<'a> {
    pub(super) set: &'a LoadedDataSet,
    pub(super) case: &'a DataSetCase,
}

/// The study of a rover on a soil, with the load transfer that the program's commands have by
/// default.
pub(super) fn heading_study(
    usual: &Scenario,
    rover: &LoadedRover,
    soil: &LoadedSoil,
    model: Model,
    gravity: f64,
) -> HeadingStudy {
    let (rover, soil) = (rover.value.clone(), soil.value);
    HeadingStudy { rover, soil, gravity, model, ..HeadingStudy::of(usual) }
}
