//! Arrays of wheels: each settles by itself, and has the bits that it has alone.

use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

use grouser::contact::validity::{Finding, Situation};
use grouser::contact::{Contact, SettleError, Settled, Slip, Theory, settle as settle_one};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{LOAD, SINKAGE, SLIP_ANGLE, SLIP_RATIO};
use grouser::document::study;
use grouser::soil::Soil;
use grouser::wheel::Wheel;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::columns::{NO_WHEEL, wheel_names, wheel_row};
use crate::descriptions::Document;
use crate::validity::bits;
use crate::{errors, threads};

/// Wheels between two checks for signals, to begin with: a part of a second for the slowest model.
const FIRST_BATCH: usize = 64;
/// As many at most: their rows stay in the processor's memory.
const LARGEST_BATCH: usize = 1 << 13;
/// How long a batch should take, at least and at most.
const BATCH_TIME: RangeInclusive<Duration> = Duration::from_millis(50)..=Duration::from_millis(200);

/// Wheels that a thread takes at once, at most; of a batch at least this many shares are made.
const SHARE: usize = 256;
const SHARES: usize = 32;

/// What all wheels share.
struct Stand {
    soils: Vec<(Soil, Theory)>,
    wheel: Wheel,
    gravity: f64,
}

/// What each wheel has of its own.
struct Inputs<'a> {
    /// Load [N], or sinkage [m].
    pressed: &'a [f64],
    slip_ratios: &'a [f64],
    slip_angles_deg: &'a [f64],
    soils: Option<&'a [i64]>,
}

impl Stand {
    /// * `setting`: a scenario that gives gravity, and a wheel–soil model where it names one
    fn new(soils: &[PyRef<'_, Document>], wheel: &Document, setting: &Document) -> PyResult<Self> {
        let soils = soils.iter().map(|soil| {
            let (theory, _) = model_and_gravity(soil, setting)?;
            Ok((soil.soil()?.value, theory))
        });
        let soils = soils.collect::<PyResult<Vec<_>>>()?;
        let gravity = setting.scenario()?.value.site.gravity;
        Ok(Self { soils, wheel: wheel.wheel()?.value, gravity })
    }

    fn contact(&self, inputs: &Inputs<'_>, place: usize) -> (Contact, Theory) {
        let soil = inputs.soils.map_or(0, |soils| usize::try_from(soils[place]).unwrap_or(0));
        let (soil, theory) = self.soils[soil];
        let angle = SLIP_ANGLE.unit.to_si(inputs.slip_angles_deg[place]);
        let slip = Slip::on_test_stand(inputs.slip_ratios[place], angle);
        (Contact { wheel: self.wheel, soil, slip, gravity: self.gravity }, theory)
    }
}

impl Inputs<'_> {
    /// Checks that all arrays are of one length and in their ranges.
    fn check(&self, soils: usize, name: &str, pressed: &RangeInclusive<f64>) -> PyResult<()> {
        let count = self.pressed.len();
        let lengths = [self.slip_ratios.len(), self.slip_angles_deg.len()];
        let indices = self.soils.map_or(count, <[i64]>::len);
        if lengths != [count, count] || indices != count {
            let message = "the arrays differ in length".to_owned();
            return Err(errors::parameter(message, name, None, "arrays of one length"));
        }
        let known = |index: &i64| usize::try_from(*index).is_ok_and(|index| index < soils);
        if soils == 0 || self.soils.is_some_and(|indices| !indices.iter().all(known)) {
            let message = "there is no soil for every wheel".to_owned();
            return Err(errors::parameter(message, "soil", None, "at least one soil"));
        }
        check(name, self.pressed, pressed)?;
        check(SLIP_RATIO.name, self.slip_ratios, &study::SLIP_RATIO)?;
        check(SLIP_ANGLE.name, self.slip_angles_deg, &study::SLIP_ANGLE_DEG)
    }
}

/// Checks that numbers are in their range; the error names the first that is not, by its place.
pub(crate) fn check(name: &str, values: &[f64], range: &RangeInclusive<f64>) -> PyResult<()> {
    let Some(place) = values.iter().position(|value| !range.contains(value)) else {
        return Ok(());
    };
    let expected = format!("from {} to {}", range.start(), range.end());
    let value = values[place];
    let at = if values.len() > 1 { format!(" (entry {place})") } else { String::new() };
    let message = format!("{name} is {value}{at}, it must be {expected}");
    Err(errors::parameter(message, name, Some(value), expected))
}

/// The wheel–soil model that a setting names, or else the soil's own; and the setting's gravity [m/s²].
pub(crate) fn model_and_gravity(soil: &Document, setting: &Document) -> PyResult<(Theory, f64)> {
    let setting = setting.scenario()?;
    let named = setting.document.theory().is_some().then_some(setting.value.theory);
    let theory = match named {
        Some(theory) => theory,
        None => soil.soil()?.document.usual_theory(""),
    };
    Ok((theory, setting.value.site.gravity))
}

/// A column for each of [`WHEEL`], then what one of them adds, and its flags as bits.
type Row = [f64; WHEEL.len() + 2];

fn row(results: &[f64; WHEEL.len()], last: f64, findings: &[Finding]) -> Row {
    let mut row = [last; WHEEL.len() + 2];
    row[..WHEEL.len()].copy_from_slice(results);
    row[WHEEL.len() + 1] = bits(findings);
    row
}

/// The flags of a wheel on a test stand.
fn findings(
    contact: &Contact,
    theory: Theory,
    load: f64,
    settled: Option<&Settled>,
) -> Vec<Finding> {
    let situation = Situation {
        theory,
        wheel: &contact.wheel,
        soil: &contact.soil,
        gravity: contact.gravity,
        slope: 0.0,
        load: Some(load),
        slip: Some(contact.slip),
        settled,
    };
    situation.findings()
}

/// Evaluates every wheel in order, batch by batch, into an array with a row for each result.
fn evaluate(
    py: Python<'_>,
    count: usize,
    one: impl Fn(usize) -> Row + Sync,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let results = PyArray2::<f64>::zeros(py, [WHEEL.len() + 2, count], false);
    {
        let mut results = results.readwrite();
        let cells = results.as_slice_mut()?;
        let (mut start, mut batch) = (0, FIRST_BATCH);
        while start < count {
            let end = (start + batch).min(count);
            let share = (batch / SHARES).clamp(1, SHARE);
            let begun = Instant::now();
            threads::detached(py, || {
                let places = (start..end).into_par_iter().with_min_len(share);
                let rows: Vec<Row> = places.map(&one).collect();
                cells.par_chunks_mut(count).enumerate().for_each(|(column, cells)| {
                    for (cell, row) in cells[start..end].iter_mut().zip(&rows) {
                        *cell = row[column];
                    }
                });
            })?;
            if begun.elapsed() < *BATCH_TIME.start() {
                batch = (2 * batch).min(LARGEST_BATCH);
            } else if begun.elapsed() > *BATCH_TIME.end() {
                batch = (batch / 2).max(SHARES);
            }
            py.check_signals()?;
            start = end;
        }
    }
    Ok(results)
}

/// What `settle` returns: results by rows, the names of the rows, and whether each wheel is carried.
type Answer<'py> = (Bound<'py, PyArray2<f64>>, Vec<&'static str>);

fn names(last: &'static str) -> Vec<&'static str> {
    wheel_names().chain([last, "flag_bits"]).collect()
}

/// The sinkages at which wheels carry their loads, and the forces there. A row that is NaN but for
/// `capacity_n` and the flags' bits, its last two, is a wheel that the soil does not carry.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn settle<'py>(
    py: Python<'py>,
    soils: Vec<PyRef<'py, Document>>,
    wheel: &Document,
    setting: &Document,
    load_n: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    soil_index: Option<PyReadonlyArray1<'py, i64>>,
) -> PyResult<Answer<'py>> {
    let stand = Stand::new(&soils, wheel, setting)?;
    let inputs = Inputs {
        pressed: load_n.as_slice()?,
        slip_ratios: slip_ratio.as_slice()?,
        slip_angles_deg: slip_angle_deg.as_slice()?,
        soils: soil_index.as_ref().map(|index| index.as_slice()).transpose()?,
    };
    inputs.check(stand.soils.len(), LOAD.name, &study::LOAD_N)?;
    let one = |place: usize| {
        let (contact, theory) = stand.contact(&inputs, place);
        let load = inputs.pressed[place];
        let found = settle_one(theory.model(), &contact, load);
        let flags = findings(&contact, theory, load, found.as_ref().ok());
        match found {
            Ok(settled) => row(&wheel_row(&settled), f64::NAN, &flags),
            Err(SettleError::SunkToAxle { capacity, .. }) => row(&NO_WHEEL, capacity, &flags),
            // Loads were checked.
            Err(SettleError::BadLoad { .. }) => row(&NO_WHEEL, f64::NAN, &flags),
        }
    };
    Ok((evaluate(py, inputs.pressed.len(), one)?, names("capacity_n")))
}

/// The forces on wheels at given sinkages. Its last rows are that sinkage once more, and no flags.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn wheel_forces<'py>(
    py: Python<'py>,
    soils: Vec<PyRef<'py, Document>>,
    wheel: &Document,
    setting: &Document,
    sinkage_mm: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    soil_index: Option<PyReadonlyArray1<'py, i64>>,
) -> PyResult<Answer<'py>> {
    let stand = Stand::new(&soils, wheel, setting)?;
    let inputs = Inputs {
        pressed: sinkage_mm.as_slice()?,
        slip_ratios: slip_ratio.as_slice()?,
        slip_angles_deg: slip_angle_deg.as_slice()?,
        soils: soil_index.as_ref().map(|index| index.as_slice()).transpose()?,
    };
    let deepest = SINKAGE.unit.from_si(stand.wheel.shearing_radius());
    inputs.check(stand.soils.len(), SINKAGE.name, &(0.0..=deepest))?;
    let one = |place: usize| {
        let (contact, theory) = stand.contact(&inputs, place);
        let sinkage = SINKAGE.unit.to_si(inputs.pressed[place]);
        let forces = theory.model().forces(&contact, sinkage);
        let settled = Settled { sinkage, forces, evaluations: 1 };
        // Forces at a given depth are no equilibrium: they carry no flags.
        row(&wheel_row(&settled), inputs.pressed[place], &[])
    };
    Ok((evaluate(py, inputs.pressed.len(), one)?, names("given_sinkage_mm")))
}

/// The library's messages for wheels that the soil does not carry.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn not_carried(
    load_n: PyReadonlyArray1<'_, f64>,
    capacity_n: PyReadonlyArray1<'_, f64>,
) -> PyResult<Vec<String>> {
    let pairs = load_n.as_slice()?.iter().zip(capacity_n.as_slice()?);
    let error = |(load, capacity): (&f64, &f64)| SettleError::SunkToAxle {
        load: *load,
        capacity: *capacity,
    };
    Ok(pairs.map(error).map(|error| error.to_string()).collect())
}

/// Numbers as a column.
pub(crate) fn column(
    py: Python<'_>,
    numbers: impl IntoIterator<Item = f64>,
) -> Bound<'_, PyArray1<f64>> {
    PyArray1::from_vec(py, numbers.into_iter().collect())
}
