//! Every theory on every data set in a folder, best first.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::measurements::{self, Choice, MeasurementError};
use super::validation::GroupRecord;
use super::{
    DataSetCase, DocumentError, Kind, LoadedDataSet, Overrides, Source, check, presets,
    read_data_set,
};
use crate::contact::Theory;
use crate::soil::Extended;
use crate::studies::measurement::Quantity;
use crate::studies::validation::{Validation, ValidationStudy};

/// A theory with a soil on a part of a data set.
#[derive(Clone, Debug, Serialize)]
pub struct RankedTheory {
    /// The data set's name.
    pub data_set: String,
    /// Its part.
    pub case: String,
    /// Place among the theories of the part, from 1.
    pub rank: usize,
    /// The theory's name.
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

/// Why theories cannot be ranked.
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
        /// What the system says.
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

/// Every theory on every data set in a folder: data set by data set and part by part, best first.
///
/// # Errors
/// [`RankingError`] for a folder, a document or a file that cannot be used.
pub fn rank_all(folder: &Path) -> Result<Vec<RankedTheory>, RankingError> {
    let mut all = Vec::new();
    for (set, file) in data_sets(folder)? {
        for case in &set.value.cases {
            all.extend(rank(&set, case, &file)?);
        }
    }
    Ok(all)
}

/// The data sets whose files are in a folder: those that are presets, and those that documents in
/// the folder describe.
fn data_sets(folder: &Path) -> Result<Vec<(LoadedDataSet, PathBuf)>, RankingError> {
    if !folder.is_dir() {
        return Err(RankingError::NoSuchFolder(folder.to_owned()));
    }
    let unreadable = |error| RankingError::Unreadable { folder: folder.to_owned(), error };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let files = entries.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = files.collect::<Result<_, _>>().map_err(unreadable)?;
    files.sort();
    let documents = files.into_iter().filter(|path| path.extension() == Some(OsStr::new("toml")));
    let is_data_set =
        |path: &PathBuf| matches!(check(&Source::file(path)), Ok(Kind::DataSet) | Err(_));
    let mut sources: Vec<Source> = presets(Kind::DataSet).map(Source::Preset).collect();
    sources.extend(documents.filter(is_data_set).map(Source::File));
    let mut sets = Vec::new();
    for source in sources {
        let set = read_data_set(&source, &Overrides::none())?;
        let file = folder.join(&set.value.file);
        if file.exists() {
            sets.push((set, file));
        } else if let Source::File(document) = source {
            return Err(RankingError::NoSuchFile { document, file });
        }
    }
    if sets.is_empty() {
        let known = presets(Kind::DataSet).map(|preset| preset.name).collect();
        return Err(RankingError::NoDataSet { folder: folder.to_owned(), known });
    }
    Ok(sets)
}

/// Every theory with the soils of a part, best first.
fn rank(
    set: &LoadedDataSet,
    case: &DataSetCase,
    file: &Path,
) -> Result<Vec<RankedTheory>, MeasurementError> {
    let choice = Choice { conditions: case.conditions.clone(), wheel: None };
    let measured = measurements::read(file, &choice)?;
    let mut all = Vec::new();
    for (name, soil) in &case.soils {
        for theory in Theory::ALL {
            let for_another = soil.document.theory().is_some_and(|own| own != theory);
            // Without its terms the extended theory is the classical one.
            let same = theory == Theory::Extended && soil.value.extended == Extended::OFF;
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
