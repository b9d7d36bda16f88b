//! Ranks every wheel–soil model on every data set: those that come with the program, or those of a folder.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::measurements::{self, Choice, Limits, MeasurementError};
use super::validation::GroupRecord;
use super::{
    DataSetCase, DocumentError, Kind, LoadedDataSet, Overrides, Source, check, place_of, presets,
    read_data_set,
};
use crate::contact::Theory;
use crate::soil::SmallWheel;
use crate::studies::measurement::Quantity;
use crate::studies::validation::{Validation, ValidationStudy};

/// A wheel–soil model with a soil on a part of a data set.
#[derive(Clone, Debug, Serialize)]
pub struct RankedTheory {
    /// The data set's name.
    pub data_set: String,
    /// Its part.
    pub case: String,
    /// Place among the models of the part, from 1.
    pub rank: usize,
    /// The model's name.
    pub model: &'static str,
    /// The soil's name.
    pub soil: String,
    /// Root mean square error over the standard deviation of what was measured, averaged over
    /// the measured quantities [-]: 0 is perfect, 1 no better than a constant.
    pub score: Option<f64>,
    /// Trials without a prediction: the soil cannot carry the wheel.
    pub unsettled_trials: usize,
    /// Errors of the driven cells.
    pub driven: Option<GroupRecord>,
    /// Errors of all cells.
    pub overall: GroupRecord,
    /// All errors.
    #[serde(skip)]
    pub validation: Validation,
}

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
}

/// Ranks every model on every data set of a folder, or without a folder on those that come with the
/// program: data set by data set and part by part, best first.
///
/// * `limits`: how much of each file is read
///
/// # Errors
/// [`RankingError`] for a folder, a document or a file that cannot be used.
pub fn rank_all(folder: Option<&Path>, limits: Limits) -> Result<Vec<RankedTheory>, RankingError> {
    let sets = match folder {
        Some(folder) => data_sets_in(folder)?,
        None => data_sets_of_the_program()?,
    };
    let mut all = Vec::new();
    for DataSet { set, rows, named_at } in sets {
        for case in &set.value.cases {
            let ranked = rank(&set, case, &rows, limits);
            all.extend(ranked.map_err(|error| match &named_at {
                Some(place) => error.named_at(place.clone()),
                None => error,
            })?);
        }
    }
    Ok(all)
}

/// A data set, and where its rows are.
struct DataSet {
    set: LoadedDataSet,
    rows: measurements::Source,
    /// Where a document of the folder names the file; presets are no files to look at.
    named_at: Option<String>,
}

fn data_sets_of_the_program() -> Result<Vec<DataSet>, RankingError> {
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
fn data_sets_in(folder: &Path) -> Result<Vec<DataSet>, RankingError> {
    let mut own = Vec::new();
    for document in documents_in(folder)? {
        let source = Source::file(&document);
        let set = read_data_set(&source, &Overrides::none())?;
        let file = folder.join(&set.value.file);
        // Of a link to nothing the reading says so.
        if file.symlink_metadata().is_err() {
            return Err(RankingError::NoSuchFile { document, file });
        }
        let named_at = Some(place_of(&source, "file")?.to_string());
        own.push(DataSet { set, rows: measurements::Source::File(file), named_at });
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

/// Every model with the soils of a part, best first.
fn rank(
    set: &LoadedDataSet,
    case: &DataSetCase,
    rows: &measurements::Source,
    limits: Limits,
) -> Result<Vec<RankedTheory>, MeasurementError> {
    let choice = Choice { conditions: case.conditions.clone(), wheel: None, limits };
    let measured = rows.read(&choice)?;
    let mut all = Vec::new();
    for (name, soil) in &case.soils {
        for theory in Theory::ALL {
            let for_another = soil.document.theory().is_some_and(|own| own != theory);
            // Without its terms the small-wheel model is the classical one.
            let same = theory == Theory::SmallWheel && soil.value.small_wheel == SmallWheel::OFF;
            if for_another || same {
                continue;
            }
            let study = ValidationStudy {
                tests: &measured.tests,
                wheel: case.wheel.value,
                soil: soil.value,
                theory,
                gravity: set.value.gravity,
            };
            let validation = study.run();
            all.push(RankedTheory {
                data_set: set.document.name().to_owned(),
                case: case.name.clone(),
                rank: 0,
                model: theory.name(),
                soil: name.clone(),
                score: score(&validation),
                unsettled_trials: validation.overall.unsettled,
                driven: validation.driven.as_ref().map(GroupRecord::from),
                overall: GroupRecord::from(&validation.overall),
                validation,
            });
        }
    }
    // What has no prediction for a trial ranks below whatever has one for each.
    let key = |one: &RankedTheory| (one.unsettled_trials, one.score.unwrap_or(f64::INFINITY));
    all.sort_by(|one, other| {
        let ((unsettled, score), (others, other_score)) = (key(one), key(other));
        unsettled.cmp(&others).then(score.total_cmp(&other_score))
    });
    for (place, one) in all.iter_mut().enumerate() {
        one.rank = place + 1;
    }
    Ok(all)
}

/// √(1 − R²), averaged over the measured quantities.
fn score(validation: &Validation) -> Option<f64> {
    let of = |quantity| validation.overall.errors[quantity]?.r2;
    let shares: Vec<f64> =
        Quantity::ALL.into_iter().filter_map(of).map(|r2| (1.0 - r2).max(0.0).sqrt()).collect();
    (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64)
}
