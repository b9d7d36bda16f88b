//! Campaigns: the bytes of a shard, and the folder that collects them.
//!
//! The Python package `grouser.campaign` decides which worker computes which shard: a worker gets a
//! study as a text and a shard's number, and returns the bytes of a Parquet file.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use grouser::document::campaign::{Campaign, Frequencies, QuantityStatistics};
use grouser::document::table::{BETWEEN_NAMES, Cell, Table, Values};
use grouser::document::{self, DocumentError, Kind, Overrides, Source};
use grouser::studies::ensemble::sensitivity::SobolIndex;
use grouser::studies::ensemble::statistics::{Estimate, Quantile, Summary};
use grouser_store::{ColumnRecord, Folder, Manifest, Part, StoreError, Study, merge, shard};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::threads::released;

/// A campaign that was read, and the study that identifies it in its folder.
pub(crate) struct LoadedCampaign {
    campaign: Arc<Campaign>,
    study: Study,
}

impl LoadedCampaign {
    pub(crate) fn read(source: &Source, overrides: &Overrides) -> Result<Self, DocumentError> {
        let campaign = document::read_campaign(source, overrides)?;
        let study = Study::of(&campaign);
        Ok(Self { campaign: Arc::new(campaign), study })
    }

    pub(crate) fn campaign(&self) -> &Campaign {
        &self.campaign
    }
}

/// Reads a campaign as the program does: a file or preset, and settings such as
/// `campaign.runs=100`.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a list comes from Python")]
pub(crate) fn find_campaign(study: &str, settings: Vec<String>) -> PyResult<Document> {
    let read = errors::caught(|| {
        let source = Source::find(Kind::Campaign, study)?;
        let overrides = Overrides::parse(&settings)?;
        Ok(Document::of_campaign(LoadedCampaign::read(&source, &overrides)?))
    })?;
    read.map_err(|error| errors::of_document(&error, &[]))
}

/// Facts that the study determines: numbers of runs and shards, columns, and its hash.
#[pyfunction]
pub(crate) fn campaign_facts<'py>(
    py: Python<'py>,
    campaign: &Document,
) -> PyResult<Bound<'py, PyDict>> {
    let LoadedCampaign { campaign, study, .. } = campaign.campaign()?;
    let dict = PyDict::new(py);
    dict.set_item("runs", campaign.runs())?;
    dict.set_item("shards", campaign.shards())?;
    dict.set_item("sha256", study.hash())?;
    dict.set_item("factors", campaign.factors())?;
    dict.set_item("words_of_legs", campaign.words_of_legs())?;
    let columns = campaign.columns().iter().map(ColumnRecord::from);
    let columns = columns.map(|it| (it.name, it.kind, it.role, it.unit));
    dict.set_item("columns", columns.collect::<Vec<_>>())?;
    Ok(dict)
}

/// The bytes of a shard's file.
///
/// * `threads`: 0 for all cores
#[pyfunction]
pub(crate) fn campaign_shard<'py>(
    py: Python<'py>,
    campaign: &Document,
    shard: u64,
    threads: usize,
) -> PyResult<Bound<'py, PyBytes>> {
    let campaign = Arc::clone(&campaign.campaign()?.campaign);
    let shards = campaign.shards();
    if shard >= shards {
        let message =
            format!("there is no shard {shard}: the campaign has shards 0 to {}", shards - 1);
        return Err(errors::parameter(message, "shard", None, format!("below {shards}")));
    }
    // Threads of its own for each shard: those of a pool would be gone in a process that was
    // forked.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let bytes = listening(py, move |cancelled| {
        pool.install(|| grouser_store::shard_bytes(&campaign, shard, &|| !cancelled.is_set()))
    })?;
    let bytes = bytes.map_err(|error| errors::of_store(&error))?;
    bytes.map(|bytes| PyBytes::new(py, &bytes)).ok_or_else(|| PyKeyboardInterrupt::new_err(()))
}

/// The row of a run, computed anew.
#[pyfunction]
pub(crate) fn campaign_row<'py>(
    py: Python<'py>,
    campaign: &Document,
    run: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let campaign = Arc::clone(&campaign.campaign()?.campaign);
    let runs = campaign.runs();
    if run >= runs {
        return Err(errors::of_store(&StoreError::NoRun { run, runs }));
    }
    let names: Vec<String> = campaign.columns().iter().map(|it| it.name.clone()).collect();
    let row = listening(py, move |_| campaign.run(run))?;
    let dict = PyDict::new(py);
    for (name, cell) in names.iter().zip(row) {
        match cell {
            Cell::Float(value) => dict.set_item(name, value)?,
            Cell::Whole(value) => dict.set_item(name, value)?,
            Cell::Text(value) => dict.set_item(name, value)?,
            Cell::Words(names) => dict.set_item(name, names)?,
        }
    }
    Ok(dict)
}

/// Checks that bytes are those of a shard, to the last bit.
#[pyfunction]
pub(crate) fn check_shard(
    py: Python<'_>,
    campaign: &Document,
    shard: u64,
    data: &[u8],
) -> PyResult<()> {
    let study = &campaign.campaign()?.study;
    let checked = released(py, || shard::check(study, shard, data))?;
    checked.map_err(|fault| errors::of_store(&StoreError::Shard { shard, fault }))
}

/// The most bytes that the file of a shard may have.
#[pyfunction]
pub(crate) fn most_shard_bytes(campaign: &Document, shard: u64) -> PyResult<u64> {
    Ok(campaign.campaign()?.study.identity(shard).most_bytes())
}

/// The file of the manifest of a campaign of which nothing is computed yet.
#[pyfunction]
pub(crate) fn campaign_manifest(campaign: &Document, part: Option<(u64, u64)>) -> PyResult<String> {
    Ok(Manifest::new(&campaign.campaign()?.study, part_of(part)?).to_text())
}

/// The file of a changed manifest, with its new hash of itself.
///
/// * `manifest`: as JSON
#[pyfunction]
pub(crate) fn seal_manifest(manifest: &str) -> PyResult<String> {
    let manifest: Result<Manifest, _> = serde_json::from_str(manifest);
    let manifest = manifest.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(manifest.to_text())
}

/// A sentence on the keys in which two resolved studies differ.
#[pyfunction]
pub(crate) fn study_difference(theirs: &str, ours: &str) -> String {
    grouser_store::difference(theirs, ours)
}

/// The manifest of a folder or URL, whose hash of itself was checked: shards are checked against
/// it.
#[pyclass(module = "grouser._core", frozen)]
pub(crate) struct CampaignManifest {
    manifest: Manifest,
}

#[pymethods]
impl CampaignManifest {
    /// * `file`: its name in messages
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
    fn new(data: &[u8], file: PathBuf) -> PyResult<Self> {
        let manifest = Manifest::parse(data, &file);
        Ok(Self { manifest: manifest.map_err(|error| errors::of_store(&error))? })
    }

    /// Checks that a resolved study is the one whose runs are here.
    #[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
    fn check_study(&self, study: &[u8], file: PathBuf) -> PyResult<()> {
        if grouser_store::sha256(study) == self.manifest.study_sha256 {
            return Ok(());
        }
        Err(errors::of_store(&StoreError::StudyChanged(file)))
    }

    /// Checks that the manifest has what this version would write for a campaign.
    ///
    /// * `file`: its name in messages
    #[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
    fn check_campaign(&self, campaign: &Document, file: PathBuf) -> PyResult<()> {
        let study = &campaign.campaign()?.study;
        if self.manifest.is_of(study, self.manifest.part) {
            return Ok(());
        }
        let problem = "it does not say what the study and this version say".to_owned();
        Err(errors::of_store(&StoreError::Manifest { file, problem }))
    }

    /// The shard that a file is named for, if it belongs here.
    fn shard_of(&self, name: &str) -> Option<u64> {
        shard::number_of(name).filter(|shard| self.manifest.has(*shard))
    }

    /// How many shards belong here.
    fn shards(&self) -> u64 {
        self.manifest.own_count()
    }

    /// The first run of a shard, and the one after its last.
    fn runs_of(&self, shard: u64) -> (u64, u64) {
        let runs = self.manifest.runs_of(shard);
        (runs.start, runs.end)
    }

    /// The most bytes that a shard's file may have.
    fn most_bytes(&self, shard: u64) -> u64 {
        self.manifest.identity(shard).most_bytes()
    }

    /// Columns of a shard that is as it was written: numbers as arrays, with NaN where there is
    /// none; texts as lists.
    ///
    /// * `file`: its name in messages
    #[allow(clippy::needless_pass_by_value, reason = "how lists and paths come from Python")]
    fn read<'py>(
        &self,
        py: Python<'py>,
        shard: u64,
        data: &[u8],
        columns: Vec<String>,
        file: PathBuf,
    ) -> PyResult<Bound<'py, PyDict>> {
        let identity = self.manifest.identity(shard);
        let data = data.to_vec();
        let names: Vec<&str> = columns.iter().map(String::as_str).collect();
        let table = released(py, || {
            let checked = shard::Checked::open(&identity, data.into());
            checked.map_err(|fault| damaged(&file, fault))?.table(&names)
        })?;
        columns_of(py, table.map_err(|error| errors::of_store(&error))?)
    }
}

fn damaged(file: &Path, fault: grouser_store::ShardFault) -> StoreError {
    StoreError::Damaged { file: file.to_owned(), fault }
}

fn columns_of(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    for (name, values) in table.columns {
        match values {
            Values::Float(values) => {
                let values = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
                dict.set_item(name, PyArray1::from_iter(py, values))?;
            }
            // Runs and points are numbered; each has a number.
            Values::Whole(values) => {
                let values =
                    values.into_iter().map(|value| value.unwrap_or_default().cast_signed());
                dict.set_item(name, PyArray1::from_iter(py, values))?;
            }
            Values::Text(values) => dict.set_item(name, PyList::new(py, values)?)?,
            Values::Words(values) => {
                let texts = values.iter().map(|names| names.join(BETWEEN_NAMES));
                dict.set_item(name, PyList::new(py, texts.collect::<Vec<_>>())?)?;
            }
        }
    }
    Ok(dict)
}

fn part_of(part: Option<(u64, u64)>) -> PyResult<Option<Part>> {
    let Some((index, of)) = part else { return Ok(None) };
    if index < 1 || index > of {
        let message = format!("there is no part {index} of {of}: parts are counted from 1");
        return Err(errors::parameter(message, "part", None, "(i, n) with 1 ≤ i ≤ n"));
    }
    Ok(Some(Part { index, of }))
}

// ---- The folder ----

/// A campaign's folder, open for writing and locked.
#[pyclass(module = "grouser._core")]
pub(crate) struct CampaignFolder {
    /// None once it is closed.
    folder: Option<Folder>,
}

#[pymethods]
impl CampaignFolder {
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        campaign: &Document,
        part: Option<(u64, u64)>,
    ) -> PyResult<Self> {
        let (study, part) = (&campaign.campaign()?.study, part_of(part)?);
        let folder = released(py, || Folder::open(&path, study, part))?;
        Ok(Self { folder: Some(folder.map_err(|error| errors::of_store(&error))?) })
    }

    /// Shards that are not there yet, in order: first, step and how many, for each run of them.
    fn missing(&self) -> PyResult<Vec<(u64, u64, u64)>> {
        Ok(self.open()?.missing().progressions().collect())
    }

    /// How many shards are not there yet.
    fn missing_count(&self) -> PyResult<u64> {
        Ok(self.open()?.missing().len())
    }

    /// Shards that were there and are damaged, each with what is wrong.
    fn faults(&self) -> PyResult<Vec<(u64, String)>> {
        let fault = |(shard, fault): &(u64, grouser_store::ShardFault)| (*shard, fault.to_string());
        Ok(self.open()?.faults().iter().map(fault).collect())
    }

    /// Runs that are done, and all that belong here.
    fn runs(&self) -> PyResult<(u64, u64)> {
        let folder = self.open()?;
        Ok((folder.runs_done(), folder.runs()))
    }

    /// Adds a shard.
    fn accept(&mut self, py: Python<'_>, shard: u64, data: &[u8]) -> PyResult<()> {
        let folder = self.open_mut()?;
        released(py, || folder.accept(shard, data))?.map_err(|error| errors::of_store(&error))
    }

    /// Counts a shard that a worker has written to its place.
    fn adopt(&mut self, py: Python<'_>, shard: u64) -> PyResult<()> {
        let folder = self.open_mut()?;
        released(py, || folder.adopt(shard))?.map_err(|error| errors::of_store(&error))
    }

    /// Writes the session to the manifest.
    fn pause(&mut self, py: Python<'_>) -> PyResult<()> {
        let folder = self.open_mut()?;
        released(py, || folder.pause())?.map_err(|error| errors::of_store(&error))
    }

    /// The digest of all shards, how many there are, and their bytes.
    fn finish(&mut self, py: Python<'_>) -> PyResult<(String, u64, u64)> {
        let folder = self.open_mut()?;
        let finished =
            released(py, || folder.finish())?.map_err(|error| errors::of_store(&error))?;
        Ok((finished.digest, finished.shards, finished.bytes))
    }

    /// Unlocks the folder.
    fn close(&mut self) {
        self.folder = None;
    }
}

impl CampaignFolder {
    fn open(&self) -> PyResult<&Folder> {
        self.folder.as_ref().ok_or_else(closed)
    }

    fn open_mut(&mut self) -> PyResult<&mut Folder> {
        self.folder.as_mut().ok_or_else(closed)
    }
}

fn closed() -> PyErr {
    PyValueError::new_err("the folder is closed")
}

/// Brings the parts of an array of jobs together: digest, shards, bytes.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths come from Python")]
pub(crate) fn merge_campaign(
    py: Python<'_>,
    target: PathBuf,
    campaign: &Document,
    folders: Vec<PathBuf>,
) -> PyResult<(String, u64, u64)> {
    let study = campaign.campaign()?.study.clone();
    let merged = listening(py, move |_| merge(&target, &study, &folders, &mut |_, _| {}))?;
    let merged = merged.map_err(|error| errors::of_store(&error))?;
    Ok((merged.digest, merged.shards, merged.bytes))
}

// ---- Statistics over the runs ----

/// How often statuses and outcomes are among the independent samples.
///
/// * `runs`: first and one after the last, in order
/// * `statuses`, `outcomes`: theirs; no outcomes for studies that have none
/// * `of_legs`: columns of words about legs, and theirs
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn campaign_frequencies<'py>(
    py: Python<'py>,
    campaign: &Document,
    runs: Vec<(u64, u64)>,
    statuses: Vec<Option<String>>,
    outcomes: Vec<Option<String>>,
    of_legs: Vec<(String, Vec<Option<String>>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let campaign = campaign.campaign()?.campaign();
    let mut frequencies = Frequencies::default();
    let mut start = 0;
    for (first, end) in runs {
        let stop = start + usize::try_from(end - first)?;
        let part = |texts: &[Option<String>]| -> Vec<Option<String>> {
            texts.get(start..stop).map(<[_]>::to_vec).unwrap_or_default()
        };
        frequencies.add(campaign, first..end, &part(&statuses), &part(&outcomes));
        for (column, words) in &of_legs {
            frequencies.add_of_leg(campaign, first..end, column, &part(words));
        }
        start = stop;
    }
    let dict = PyDict::new(py);
    dict.set_item("samples", frequencies.samples)?;
    let shares_of = |counts: &BTreeMap<String, usize>| {
        let shares = PyDict::new(py);
        for (word, count) in counts {
            let Some(probability) = frequencies.probability(*count) else { continue };
            let (low, high) = probability.interval();
            shares.set_item(word, (*count, probability.estimate(), low, high))?;
        }
        PyResult::Ok(shares)
    };
    dict.set_item("status", shares_of(&frequencies.statuses)?)?;
    dict.set_item("outcome", shares_of(&frequencies.outcomes)?)?;
    let legs = PyDict::new(py);
    for (column, counts) in &frequencies.legs {
        legs.set_item(column, shares_of(counts)?)?;
    }
    dict.set_item("legs", legs)?;
    Ok(dict)
}

/// Statistics of quantities over runs: a dictionary for each.
///
/// * `runs`: first and one after the last, in order
/// * `columns`: values of these runs, NaN where there is none
/// * `statuses`: of these runs
/// * `shares`: of the quantiles [-]
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn campaign_summary<'py>(
    py: Python<'py>,
    campaign: &Document,
    runs: Vec<(u64, u64)>,
    columns: Vec<(String, PyReadonlyArray1<'py, f64>)>,
    statuses: Vec<Option<String>>,
    shares: Vec<f64>,
) -> PyResult<Bound<'py, PyList>> {
    let campaign = Arc::clone(&campaign.campaign()?.campaign);
    let factors = campaign.factors().to_vec();
    let runs: Vec<Range<u64>> = runs.into_iter().map(|(first, end)| first..end).collect();
    let mut quantities = Vec::new();
    for (name, values) in &columns {
        let value = |value: &f64| (!value.is_nan()).then_some(*value);
        quantities.push((name.clone(), values.as_slice()?.iter().map(value).collect::<Vec<_>>()));
    }
    let all = listening(py, move |_| {
        let of = |(name, values): &(String, Vec<Option<f64>>)| {
            let counted = campaign.counted(name, &runs, values, &statuses);
            (name.clone(), QuantityStatistics::of(&campaign, &runs, &counted, &shares))
        };
        quantities.par_iter().map(of).collect::<Vec<_>>()
    })?;
    let list = PyList::empty(py);
    for (name, found) in all {
        list.append(quantity_of(py, &name, &found, &factors)?)?;
    }
    Ok(list)
}

fn quantity_of<'py>(
    py: Python<'py>,
    name: &str,
    found: &QuantityStatistics,
    factors: &[String],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("quantity", name)?;
    dict.set_item("missing", found.samples)?;
    if let Some(summary) = &found.summary {
        dict.update(summary_of(py, summary)?.as_mapping())?;
    }
    let convergence = PyList::empty(py);
    for step in &found.convergence {
        let row = match &step.summary {
            Some(summary) => summary_of(py, summary)?,
            None => PyDict::new(py),
        };
        row.set_item("runs", step.runs)?;
        convergence.append(row)?;
    }
    dict.set_item("convergence", convergence)?;
    let indices = PyList::empty(py);
    if let Some(sensitivity) = &found.sensitivity {
        for (factor, SobolIndex { first, total }) in factors.iter().zip(&sensitivity.indices) {
            let row = PyDict::new(py);
            row.set_item("input", factor)?;
            set_estimate(&row, "first", first)?;
            set_estimate(&row, "total", total)?;
            row.set_item("points", sensitivity.points)?;
            row.set_item("points_missing", sensitivity.missing)?;
            indices.append(row)?;
        }
    }
    dict.set_item("sensitivity", indices)?;
    Ok(dict)
}

fn summary_of<'py>(py: Python<'py>, summary: &Summary) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("count", summary.count)?;
    dict.set_item("missing", summary.missing)?;
    set_estimate(&dict, "mean", &summary.mean)?;
    dict.set_item("standard_deviation", summary.deviation)?;
    dict.set_item("least", summary.least)?;
    dict.set_item("most", summary.most)?;
    let quantiles = PyList::empty(py);
    for Quantile { share, value, low, high } in &summary.quantiles {
        quantiles.append((*share, *value, *low, *high))?;
    }
    dict.set_item("quantiles", quantiles)?;
    Ok(dict)
}

fn set_estimate(dict: &Bound<'_, PyDict>, name: &str, estimate: &Estimate) -> PyResult<()> {
    dict.set_item(name, estimate.value)?;
    dict.set_item(format!("{name}_low"), estimate.low)?;
    dict.set_item(format!("{name}_high"), estimate.high)
}
