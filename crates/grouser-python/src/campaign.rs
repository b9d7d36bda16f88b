//! Campaigns: shards as bytes, and the folder that takes them in.
//!
//! Who computes which shard where is for `grouser/campaign` to say: a worker gets a study as a text and
//! a number, and gives back the bytes of a Parquet file.

use std::path::PathBuf;
use std::sync::Arc;

use grouser::document::campaign::{Campaign, Cell, Values};
use grouser::document::{self, DocumentError, Kind, Overrides, Source};
use grouser::studies::campaign::sensitivity::{Sensitivity, SobolIndex};
use grouser::studies::campaign::summary::{Convergence, Estimate, Quantile, Summary};
use grouser::studies::uncertainty::Probability;
use grouser_store::{ColumnRecord, Folder, Manifest, Part, StoreError, Study, merge, shard};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;

/// A campaign that was read, and what its folder knows it by.
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

/// A campaign as the program is asked for it: a file or preset, and settings such as
/// `campaign.runs=100`.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a list comes from Python")]
pub(crate) fn find_campaign(study: &str, settings: Vec<String>) -> PyResult<Document> {
    let found = Source::find(Kind::Campaign, study);
    let read = found.and_then(|source| {
        let overrides = Overrides::parse(&settings)?;
        Ok(Document::of_campaign(LoadedCampaign::read(&source, &overrides)?))
    });
    read.map_err(|error| errors::of_document(&error, &[]))
}

/// What is fixed by the study: numbers of runs and shards, columns, and what names it.
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
    // Threads of its own for each shard: those of a pool would be gone in a process that was forked.
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
        }
    }
    Ok(dict)
}

/// That bytes are those of a shard, to the last bit.
#[pyfunction]
pub(crate) fn check_shard(
    py: Python<'_>,
    campaign: &Document,
    shard: u64,
    data: &[u8],
) -> PyResult<()> {
    let study = &campaign.campaign()?.study;
    let checked = py.detach(|| shard::check(study, shard, data));
    checked.map_err(|fault| errors::of_store(&StoreError::Shard { shard, fault }))
}

/// The manifest of a campaign of which nothing is computed yet, as JSON.
#[pyfunction]
pub(crate) fn campaign_manifest(campaign: &Document, part: Option<(u64, u64)>) -> PyResult<String> {
    let manifest = Manifest::new(&campaign.campaign()?.study, part_of(part)?);
    serde_json::to_string(&manifest).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Which keys of two resolved studies differ, in words.
#[pyfunction]
pub(crate) fn study_difference(theirs: &str, ours: &str) -> String {
    grouser_store::difference(theirs, ours)
}

/// Columns of a shard: numbers as arrays, with NaN where there is none; texts as lists.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn read_shard<'py>(
    py: Python<'py>,
    data: &[u8],
    columns: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let data = data.to_vec();
    let names: Vec<&str> = columns.iter().map(String::as_str).collect();
    let table = py.detach(|| shard::read_bytes(data, &names));
    let table = table.map_err(|error| errors::of_store(&error))?;
    let dict = PyDict::new(py);
    for (name, values) in table.columns {
        match values {
            Values::Float(values) => {
                let values = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
                dict.set_item(name, PyArray1::from_iter(py, values))?;
            }
            // Runs and points are numbered; none is without its number.
            Values::Whole(values) => {
                let values =
                    values.into_iter().map(|value| value.unwrap_or_default().cast_signed());
                dict.set_item(name, PyArray1::from_iter(py, values))?;
            }
            Values::Text(values) => dict.set_item(name, PyList::new(py, values)?)?,
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
        let folder = py.detach(|| Folder::open(&path, study, part));
        Ok(Self { folder: Some(folder.map_err(|error| errors::of_store(&error))?) })
    }

    /// Shards that are not there yet, in order.
    fn missing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        Ok(PyArray1::from_vec(py, self.open()?.missing()))
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

    /// Takes in a shard.
    fn accept(&mut self, py: Python<'_>, shard: u64, data: &[u8]) -> PyResult<()> {
        let folder = self.open_mut()?;
        py.detach(|| folder.accept(shard, data)).map_err(|error| errors::of_store(&error))
    }

    /// Takes in a shard that a worker has put in its place.
    fn adopt(&mut self, py: Python<'_>, shard: u64) -> PyResult<()> {
        let folder = self.open_mut()?;
        py.detach(|| folder.adopt(shard)).map_err(|error| errors::of_store(&error))
    }

    /// Writes down what was done.
    fn pause(&mut self, py: Python<'_>) -> PyResult<()> {
        let folder = self.open_mut()?;
        py.detach(|| folder.pause()).map_err(|error| errors::of_store(&error))
    }

    /// The digest of all shards, how many there are, and their bytes.
    fn finish(&mut self, py: Python<'_>) -> PyResult<(String, u64, u64)> {
        let folder = self.open_mut()?;
        let finished = py.detach(|| folder.finish()).map_err(|error| errors::of_store(&error))?;
        Ok((finished.digest, finished.shards, finished.bytes))
    }

    /// Lets others have the folder.
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

// ---- What the runs say together ----

/// What is said of one quantity.
struct Said {
    summary: Option<Summary>,
    convergence: Vec<Convergence>,
    sensitivity: Option<Sensitivity>,
}

/// What runs say of quantities: a dictionary for each.
///
/// * `columns`: their values in the order of the runs, NaN where there is none
/// * `shares`: of the quantiles [-]
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn campaign_summary<'py>(
    py: Python<'py>,
    campaign: &Document,
    columns: Vec<(String, PyReadonlyArray1<'py, f64>)>,
    counts: Vec<(usize, usize)>,
    shares: Vec<f64>,
) -> PyResult<(Bound<'py, PyList>, Bound<'py, PyList>)> {
    let LoadedCampaign { campaign, .. } = campaign.campaign()?;
    let factors = campaign.factors().to_vec();
    let inputs = campaign.is_sensitivity().then_some(factors.len());
    let seed = campaign.seed();
    let mut quantities = Vec::new();
    for (name, values) in &columns {
        let draw = |value: &f64| (!value.is_nan()).then_some(*value);
        quantities.push((name.clone(), values.as_slice()?.iter().map(draw).collect::<Vec<_>>()));
    }
    let said = listening(py, move |_| {
        let say = |(name, draws): &(String, Vec<Option<f64>>)| {
            let said = Said {
                summary: Summary::of(draws, &shares),
                convergence: Convergence::of(draws, &shares),
                sensitivity: inputs.and_then(|inputs| Sensitivity::of(draws, inputs, seed)),
            };
            (name.clone(), said)
        };
        quantities.par_iter().map(say).collect::<Vec<_>>()
    })?;
    let all = PyList::empty(py);
    for (name, said) in said {
        all.append(said.to_python(py, &name, &factors)?)?;
    }
    let probabilities = PyList::empty(py);
    for (successes, trials) in counts {
        let probability = Probability { successes, trials };
        let (low, high) = probability.interval();
        probabilities.append((probability.estimate(), low, high))?;
    }
    Ok((all, probabilities))
}

impl Said {
    fn to_python<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        factors: &[String],
    ) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("quantity", name)?;
        if let Some(summary) = &self.summary {
            dict.update(summary_of(py, summary)?.as_mapping())?;
        }
        let convergence = PyList::empty(py);
        for step in &self.convergence {
            let row = match &step.summary {
                Some(summary) => summary_of(py, summary)?,
                None => PyDict::new(py),
            };
            row.set_item("runs", step.runs)?;
            convergence.append(row)?;
        }
        dict.set_item("convergence", convergence)?;
        let indices = PyList::empty(py);
        if let Some(sensitivity) = &self.sensitivity {
            for (factor, SobolIndex { first, total }) in factors.iter().zip(&sensitivity.indices) {
                let row = PyDict::new(py);
                row.set_item("input", factor)?;
                set_estimate(&row, "first", first)?;
                set_estimate(&row, "total", total)?;
                indices.append(row)?;
            }
        }
        dict.set_item("sensitivity", indices)?;
        Ok(dict)
    }
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
