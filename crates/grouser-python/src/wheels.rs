//! Arrays of wheels: each settles by itself, and has the bits that it has alone.

use std::borrow::Cow;
use std::ops::{Range, RangeInclusive};
use std::time::{Duration, Instant};

use grouser::contact::validity::{Finding, Situation};
use grouser::contact::{Contact, Model, SettleError, Settled, Slip, forces_many, settle_many};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{LOAD, Quantity, SINKAGE, SLIP_ANGLE, SLIP_RATIO};
use grouser::document::{Described, Kind, Misfit, range, study};
use grouser::error::ParameterError;
use grouser::soil::Soil;
use grouser::wheel::Wheel;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::columns::{NO_WHEEL, wheel_names, wheel_row};
use crate::descriptions::Document;
use crate::validity::bits;
use crate::varied::{self, Index, VariedKeys};
use crate::{errors, threads};

/// Wheels between two checks for signals, to begin with: a part of a second for the slowest model.
const FIRST_BATCH: usize = 64;
/// Wheels between two checks, at most: their rows stay in the processor's memory.
const LARGEST_BATCH: usize = 1 << 13;
/// How long a batch should take, at least and at most.
const BATCH_TIME: RangeInclusive<Duration> = Duration::from_millis(50)..=Duration::from_millis(200);

/// Wheels that a thread takes at once, at most; of a batch at least this many shares are made.
const SHARE: usize = 256;
const SHARES: usize = 32;

/// What all wheels share, and the keys of it that differ from wheel to wheel.
pub(crate) struct Stand {
    soils: Vec<(Soil, Model)>,
    wheels: Vec<Wheel>,
    gravity: f64,
    of_soils: VariedKeys,
    of_wheels: VariedKeys,
    gravities: Option<Vec<f64>>,
    /// Whether a number out of its range leaves its wheel without results, and is no error.
    outside_is_nan: bool,
}

/// What each wheel has of its own.
pub(crate) struct Inputs<'a> {
    /// What is in `pressed`: [`LOAD`] or [`SINKAGE`], in its unit.
    pub(crate) quantity: Quantity,
    pub(crate) pressed: &'a [f64],
    pub(crate) slip_ratios: &'a [f64],
    pub(crate) slip_angles_deg: &'a [f64],
    /// Which soil and which wheel each has, if there are several.
    pub(crate) soils: Option<&'a [i64]>,
    pub(crate) wheels: Option<&'a [i64]>,
}

/// The key of the gravity, beside those of soil and wheel.
const GRAVITY: &str = "gravity_m_s2";

impl Stand {
    /// * `setting`: a scenario that gives gravity, and a wheel–soil model where it names one
    /// * `vary`: keys of soil and wheel, and the gravity, with a number for each wheel
    pub(crate) fn new(
        soils: &[PyRef<'_, Document>],
        wheels: &[PyRef<'_, Document>],
        setting: &Document,
        vary: &Bound<'_, PyDict>,
        count: usize,
        outside_is_nan: bool,
    ) -> PyResult<Self> {
        let loaded = soils.iter().map(|soil| soil.soil()).collect::<PyResult<Vec<_>>>()?;
        let documents: Vec<_> = loaded.iter().map(|soil| varied::parts(soil)).collect();
        let of_soils = VariedKeys::taken(vary, "soil.", &documents, count)?;
        let wheels = wheels.iter().map(|wheel| wheel.wheel()).collect::<PyResult<Vec<_>>>()?;
        let documents: Vec<_> = wheels.iter().map(|wheel| varied::parts(wheel)).collect();
        let of_wheels = VariedKeys::taken(vary, "wheel.", &documents, count)?;
        let gravities = if vary.contains(GRAVITY)? {
            let gravities = varied::numbers(vary, GRAVITY, count)?;
            vary.del_item(GRAVITY)?;
            let allowed = range(Kind::Scenario, GRAVITY).unwrap_or(f64::MIN..=f64::MAX);
            let gravities = inside(&gravities, &allowed, outside_is_nan).into_owned();
            check_or_nan(GRAVITY, &gravities, &allowed)?;
            Some(gravities)
        } else {
            None
        };
        varied::check_taken(
            vary,
            "a key such as soil.cohesion_kpa, wheel.radius_m or gravity_m_s2",
        )?;
        let soils = soils.iter().map(|soil| {
            let (model, _) = model_and_gravity(soil, setting)?;
            Ok((soil.soil()?.value, model))
        });
        let soils = soils.collect::<PyResult<Vec<_>>>()?;
        let gravity = setting.scenario()?.value.gravity;
        let wheels: Vec<Wheel> = wheels.iter().map(|wheel| wheel.value).collect();
        if let ([wheel], true) = (&*wheels, of_soils.is_empty() && of_wheels.is_empty())
            && gravities.is_none()
        {
            soils.iter().try_for_each(|(soil, _)| check_under(soil, wheel, gravity))?;
        }
        Ok(Self { soils, wheels, gravity, of_soils, of_wheels, gravities, outside_is_nan })
    }

    /// The keys of a wheel's soil, and of the wheel, that have a number of their own.
    pub(crate) fn changed(&self, inputs: &Inputs<'_>, place: usize) -> [Vec<(&str, f64)>; 2] {
        let soil = self.of_soils.at(inputs.soil_of(place), place).collect();
        [soil, self.of_wheels.at(inputs.wheel_of(place), place).collect()]
    }

    /// Whether anything of it differs from wheel to wheel.
    fn is_varied(&self) -> bool {
        let keys = !self.of_soils.is_empty() || !self.of_wheels.is_empty();
        keys || self.gravities.is_some() || self.wheels.len() > 1
    }

    /// A wheel's contact and model.
    ///
    /// # Errors
    /// [`ParameterError`] if its numbers do not go together.
    fn contact(
        &self,
        inputs: &Inputs<'_>,
        place: usize,
    ) -> Result<(Contact, Model), ParameterError> {
        let of = inputs.soil_of(place);
        let &(mut soil, ref model) = &self.soils[of];
        let mut wheel = self.wheels[inputs.wheel_of(place)];
        if !self.of_soils.is_empty() {
            soil = soil.with(self.of_soils.at(of, place)).map_err(Misfit::of_numbers)?;
        }
        if !self.of_wheels.is_empty() {
            let keys = self.of_wheels.at(inputs.wheel_of(place), place);
            wheel = wheel.with(keys).map_err(Misfit::of_numbers)?;
        }
        let gravity = self.gravities.as_ref().map_or(self.gravity, |all| all[place]);
        soil.check_under(&wheel, gravity)?;
        let angle = SLIP_ANGLE.unit.to_si(inputs.slip_angles_deg[place]);
        let slip = Slip::on_test_stand(inputs.slip_ratios[place], angle);
        Ok((Contact { wheel, soil, slip, gravity }, model.clone()))
    }

    /// The same of a wheel whose numbers are all there and go together.
    pub(crate) fn known_contact(
        &self,
        inputs: &Inputs<'_>,
        place: usize,
    ) -> Option<(Contact, Model)> {
        let contact = self.contact(inputs, place).ok();
        contact.filter(|_| !self.is_missing(inputs, place))
    }

    /// The wheels of a share by their models, each with its load [N] or sinkage [m]. One whose
    /// numbers are not all there, or do not go together, has no results.
    ///
    /// * `last`: what is written of it in their place
    fn by_model(
        &self,
        inputs: &Inputs<'_>,
        share: &mut Share<'_>,
        last: impl Fn(usize) -> f64,
    ) -> Vec<OfModel> {
        let mut by_model = Vec::new();
        for place in share.places.clone() {
            match self.known_contact(inputs, place) {
                Some((contact, model)) => {
                    let pressed = inputs.quantity.unit.to_si(inputs.pressed[place]);
                    OfModel::add(&mut by_model, model, place, (contact, pressed));
                }
                None => share.write(place, &NO_WHEEL, last(place), &[]),
            }
        }
        by_model
    }

    /// Whether one of a wheel's numbers is NaN.
    fn is_missing(&self, inputs: &Inputs<'_>, place: usize) -> bool {
        let Inputs { pressed, slip_ratios, slip_angles_deg, .. } = inputs;
        let gravity = self.gravities.as_ref().map_or(self.gravity, |all| all[place]);
        let own = [pressed[place], slip_ratios[place], slip_angles_deg[place], gravity];
        own.iter().any(|number| number.is_nan())
            || self.of_soils.missing(place).is_some()
            || self.of_wheels.missing(place).is_some()
    }

    /// Checks that the numbers that differ from wheel to wheel are in their ranges, and that those
    /// of each wheel go together.
    pub(crate) fn check(&mut self, py: Python<'_>, inputs: &Inputs<'_>) -> PyResult<()> {
        if !self.is_varied() {
            return Ok(());
        }
        if self.outside_is_nan {
            self.of_soils.leave_out(|place| inputs.soil_of(place));
            self.of_wheels.leave_out(|place| inputs.wheel_of(place));
            return Ok(());
        }
        self.of_soils.check(|place| inputs.soil_of(place))?;
        self.of_wheels.check(|place| inputs.wheel_of(place))?;
        let misfit = |place: usize| {
            let error =
                self.contact(inputs, place).err().filter(|_| !self.is_missing(inputs, place))?;
            Some((place, error))
        };
        let count = inputs.pressed.len();
        let places = (0..count).into_par_iter().with_min_len(SHARE);
        let found = threads::detached(py, || places.find_map_first(misfit))?;
        found.map_or(Ok(()), |(place, error)| Err(errors::misfit_at(place, count, &error.into())))
    }
}

impl Inputs<'_> {
    /// Which soil a wheel has.
    pub(crate) fn soil_of(&self, place: usize) -> usize {
        self.soils.map_or(0, |soils| usize::try_from(soils[place]).unwrap_or(0))
    }

    /// Which wheel it is.
    pub(crate) fn wheel_of(&self, place: usize) -> usize {
        self.wheels.map_or(0, |wheels| usize::try_from(wheels[place]).unwrap_or(0))
    }

    /// Checks that all arrays are of one length and in their ranges.
    pub(crate) fn check(&self, stand: &Stand, pressed: &RangeInclusive<f64>) -> PyResult<()> {
        let (name, count) = (self.quantity.name, self.pressed.len());
        let lengths = [self.slip_ratios.len(), self.slip_angles_deg.len()];
        if lengths != [count, count] {
            let message = "the arrays differ in length".to_owned();
            return Err(errors::parameter(message, name, None, "arrays of one length"));
        }
        for (name, indices, known) in
            [("soil", self.soils, stand.soils.len()), ("wheel", self.wheels, stand.wheels.len())]
        {
            let is_known = |index: &i64| usize::try_from(*index).is_ok_and(|index| index < known);
            let fits = |all: &[i64]| all.len() == count && all.iter().all(is_known);
            if known == 0 || !indices.is_none_or(fits) {
                let message = format!("there is no {name} for each entry");
                return Err(errors::parameter(message, name, None, format!("at least one {name}")));
            }
        }
        check_or_nan(name, self.pressed, pressed)?;
        check_or_nan(SLIP_RATIO.name, self.slip_ratios, &study::SLIP_RATIO)?;
        check_or_nan(SLIP_ANGLE.name, self.slip_angles_deg, &study::SLIP_ANGLE_DEG)
    }
}

/// Checks that numbers are in their range; the error names the first that is not, by its place.
pub(crate) fn check(name: &str, values: &[f64], range: &RangeInclusive<f64>) -> PyResult<()> {
    first_outside(name, values, range, |value| range.contains(value))
}

/// Numbers with NaN in the place of those that are out of range, where that is asked for; they are
/// for [`check_or_nan`] otherwise.
pub(crate) fn inside<'a>(
    values: &'a [f64],
    range: &RangeInclusive<f64>,
    outside_is_nan: bool,
) -> Cow<'a, [f64]> {
    if !outside_is_nan || values.iter().all(|value| range.contains(value)) {
        return Cow::Borrowed(values);
    }
    values.iter().map(|value| if range.contains(value) { *value } else { f64::NAN }).collect()
}

/// The same of numbers that may be NaN, for what has no value then.
pub(crate) fn check_or_nan(
    name: &str,
    values: &[f64],
    range: &RangeInclusive<f64>,
) -> PyResult<()> {
    first_outside(name, values, range, |value| value.is_nan() || range.contains(value))
}

fn first_outside(
    name: &str,
    values: &[f64],
    range: &RangeInclusive<f64>,
    is_fit: impl Fn(&f64) -> bool,
) -> PyResult<()> {
    let misfit = values.iter().position(|value| !is_fit(value));
    let error =
        |place: usize| errors::out_of_range(name, values[place], place, values.len(), range);
    misfit.map_or(Ok(()), |place| Err(error(place)))
}

/// Checks that a soil resists a wheel of this width.
pub(crate) fn check_under(soil: &Soil, wheel: &Wheel, gravity: f64) -> PyResult<()> {
    soil.check_under(wheel, gravity).map_err(|error| errors::of_parameter(&error))
}

/// The wheel–soil model that a setting names, or else the soil's own; and the setting's gravity
/// [m/s²].
pub(crate) fn model_and_gravity(soil: &Document, setting: &Document) -> PyResult<(Model, f64)> {
    let setting = setting.scenario()?;
    let named = setting.document.model().is_some().then_some(setting.value.model.clone());
    let model = match named {
        Some(model) => model,
        None => soil.soil()?.document.usual_model(""),
    };
    Ok((model, setting.value.gravity))
}

/// A column for each of [`WHEEL`], then what one of them adds, and its flags as bits.
const COLUMNS: usize = WHEEL.len() + 2;

/// Some neighbouring wheels, and the cells of their results: a part of each column.
struct Share<'a> {
    places: Range<usize>,
    columns: Vec<&'a mut [f64]>,
}

impl Share<'_> {
    /// Writes a wheel's results, and what one of the columns adds.
    fn write(
        &mut self,
        place: usize,
        results: &[f64; WHEEL.len()],
        last: f64,
        findings: &[Finding],
    ) {
        let cell = place - self.places.start;
        for (column, result) in self.columns.iter_mut().zip(results) {
            column[cell] = *result;
        }
        self.columns[WHEEL.len()][cell] = last;
        self.columns[WHEEL.len() + 1][cell] = bits(findings);
    }
}

/// Wheels of one model, each with its load [N] or sinkage [m], and their places.
struct OfModel {
    model: Model,
    places: Vec<usize>,
    wheels: Vec<(Contact, f64)>,
}

impl OfModel {
    /// Adds a wheel to those of its model.
    fn add(all: &mut Vec<Self>, model: Model, place: usize, wheel: (Contact, f64)) {
        let known = all.iter().position(|it| it.model == model).unwrap_or_else(|| {
            all.push(Self { model, places: Vec::new(), wheels: Vec::new() });
            all.len() - 1
        });
        all[known].places.push(place);
        all[known].wheels.push(wheel);
    }
}

/// The flags of a wheel on a test stand, in place of those that are in `found`.
fn find_flags(
    found: &mut Vec<Finding>,
    contact: &Contact,
    model: &Model,
    load: f64,
    settled: Option<&Settled>,
) {
    let situation = Situation {
        model,
        wheel: &contact.wheel,
        soil: &contact.soil,
        gravity: contact.gravity,
        slope: 0.0,
        load: Some(load),
        slip: Some(contact.slip),
        settled,
    };
    found.clear();
    situation.add_to(found);
}

/// Evaluates all wheels, batch by batch and share by share, into an array with a row for each
/// result.
fn evaluate(
    py: Python<'_>,
    count: usize,
    compute: impl Fn(Share<'_>) + Sync,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let results = PyArray2::<f64>::zeros(py, [COLUMNS, count], false);
    {
        let mut results = results.readwrite();
        let cells = results.as_slice_mut()?;
        let (mut start, mut batch) = (0, FIRST_BATCH);
        while start < count {
            let end = (start + batch).min(count);
            let size = (batch / SHARES).clamp(1, SHARE);
            let begun = Instant::now();
            let mut shares = shares(cells, count, start..end, size);
            // A single wheel is settled before a thread has woken up.
            if shares.len() == 1 {
                errors::caught(|| shares.into_iter().for_each(&compute))?;
            } else {
                threads::detached(py, || shares.par_drain(..).for_each(&compute))?;
            }
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

/// A batch of wheels in shares of one size, in order.
///
/// * `cells`: of all columns, each of `count` wheels
fn shares(cells: &mut [f64], count: usize, batch: Range<usize>, size: usize) -> Vec<Share<'_>> {
    let share = |first: usize| Share {
        places: first..(first + size).min(batch.end),
        columns: Vec::with_capacity(COLUMNS),
    };
    let mut shares: Vec<_> = batch.clone().step_by(size).map(share).collect();
    for column in cells.chunks_mut(count) {
        let parts = column[batch.clone()].chunks_mut(size);
        shares.iter_mut().zip(parts).for_each(|(share, part)| share.columns.push(part));
    }
    shares
}

/// What `settle` returns: results by rows, the names of the rows, and whether each wheel is
/// carried.
type Answer<'py> = (Bound<'py, PyArray2<f64>>, Vec<&'static str>);

fn names(last: &'static str) -> Vec<&'static str> {
    wheel_names().chain([last, "flag_bits"]).collect()
}

/// The sinkages at which wheels carry their loads, and the forces there. A row that is NaN but for
/// `capacity_n` and the flags' bits, its last two, is a wheel that the soil does not carry; one
/// that is all NaN but for the bits has an input that is.
///
/// * `vary`: keys of soil and wheel, and `gravity_m_s2`, with a number for each wheel; emptied
/// * `outside_is_nan`: whether a wheel with a number out of its range has no results, and is no
///   error
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn settle<'py>(
    py: Python<'py>,
    soils: Vec<PyRef<'py, Document>>,
    wheels: Vec<PyRef<'py, Document>>,
    setting: &Document,
    load_n: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    soil_index: Index<'py>,
    wheel_index: Index<'py>,
    vary: &Bound<'py, PyDict>,
    outside_is_nan: bool,
) -> PyResult<Answer<'py>> {
    let pressed = inside(load_n.as_slice()?, &study::LOAD_N, outside_is_nan);
    let [slip_ratios, slip_angles_deg] = slips(&slip_ratio, &slip_angle_deg, outside_is_nan)?;
    let inputs = Inputs {
        quantity: LOAD,
        pressed: &pressed,
        slip_ratios: &slip_ratios,
        slip_angles_deg: &slip_angles_deg,
        soils: soil_index.as_ref().map(|index| index.as_slice()).transpose()?,
        wheels: wheel_index.as_ref().map(|index| index.as_slice()).transpose()?,
    };
    let count = inputs.pressed.len();
    let mut stand = Stand::new(&soils, &wheels, setting, vary, count, outside_is_nan)?;
    inputs.check(&stand, &study::LOAD_N)?;
    stand.check(py, &inputs)?;
    let compute = |mut share: Share<'_>| {
        let mut flags = Vec::new();
        for OfModel { model, places, wheels } in stand.by_model(&inputs, &mut share, |_| f64::NAN) {
            let found = settle_many(model.as_ref(), &wheels);
            for ((place, (contact, load)), found) in places.into_iter().zip(&wheels).zip(found) {
                find_flags(&mut flags, contact, &model, *load, found.as_ref().ok());
                match found {
                    Ok(settled) => share.write(place, &wheel_row(&settled), f64::NAN, &flags),
                    Err(SettleError::SunkToAxle { capacity, .. }) => {
                        share.write(place, &NO_WHEEL, capacity, &flags);
                    }
                    // Loads were checked.
                    Err(SettleError::BadLoad { .. }) => {
                        share.write(place, &NO_WHEEL, f64::NAN, &flags);
                    }
                }
            }
        }
    };
    Ok((evaluate(py, inputs.pressed.len(), compute)?, names("capacity_n")))
}

/// The forces on wheels at given sinkages. Its last rows are that sinkage once more, and no flags.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn wheel_forces<'py>(
    py: Python<'py>,
    soils: Vec<PyRef<'py, Document>>,
    wheels: Vec<PyRef<'py, Document>>,
    setting: &Document,
    sinkage_mm: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    soil_index: Index<'py>,
    wheel_index: Index<'py>,
    vary: &Bound<'py, PyDict>,
    outside_is_nan: bool,
) -> PyResult<Answer<'py>> {
    let count = sinkage_mm.as_slice()?.len();
    let mut stand = Stand::new(&soils, &wheels, setting, vary, count, outside_is_nan)?;
    let depth = |wheel: &Wheel| SINKAGE.unit.from_si(wheel.shearing_radius());
    let deepest = match &*stand.wheels {
        [wheel] if stand.of_wheels.is_empty() => depth(wheel),
        _ => f64::MAX,
    };
    let pressed = inside(sinkage_mm.as_slice()?, &(0.0..=deepest), outside_is_nan);
    let [slip_ratios, slip_angles_deg] = slips(&slip_ratio, &slip_angle_deg, outside_is_nan)?;
    let inputs = Inputs {
        quantity: SINKAGE,
        pressed: &pressed,
        slip_ratios: &slip_ratios,
        slip_angles_deg: &slip_angles_deg,
        soils: soil_index.as_ref().map(|index| index.as_slice()).transpose()?,
        wheels: wheel_index.as_ref().map(|index| index.as_slice()).transpose()?,
    };
    inputs.check(&stand, &(0.0..=deepest))?;
    stand.check(py, &inputs)?;
    if deepest == f64::MAX && !outside_is_nan {
        for (place, sinkage) in inputs.pressed.iter().enumerate() {
            let Ok((contact, _)) = stand.contact(&inputs, place) else { continue };
            let range = 0.0..=depth(&contact.wheel);
            // NaN is not deeper than anything.
            if sinkage > range.end() {
                return Err(errors::out_of_range(
                    SINKAGE.name,
                    *sinkage,
                    place,
                    inputs.pressed.len(),
                    &range,
                ));
            }
        }
    }
    let compute = |mut share: Share<'_>| {
        let given = |place: usize| inputs.pressed[place];
        for OfModel { model, places, wheels } in stand.by_model(&inputs, &mut share, given) {
            let found = forces_many(model.as_ref(), &wheels);
            for ((place, (contact, sinkage)), forces) in places.into_iter().zip(&wheels).zip(found)
            {
                // Where that is an error, it was refused before.
                if outside_is_nan && given(place) > depth(&contact.wheel) {
                    share.write(place, &NO_WHEEL, given(place), &[]);
                    continue;
                }
                let settled = Settled { sinkage: *sinkage, forces, evaluations: 1 };
                // Forces at a given depth are no equilibrium: they carry no flags.
                share.write(place, &wheel_row(&settled), given(place), &[]);
            }
        }
    };
    Ok((evaluate(py, inputs.pressed.len(), compute)?, names("given_sinkage_mm")))
}

/// Slip ratios and slip angles, as [`inside`] their ranges.
pub(crate) fn slips<'a>(
    slip_ratio: &'a PyReadonlyArray1<'_, f64>,
    slip_angle_deg: &'a PyReadonlyArray1<'_, f64>,
    outside_is_nan: bool,
) -> PyResult<[Cow<'a, [f64]>; 2]> {
    Ok([
        inside(slip_ratio.as_slice()?, &study::SLIP_RATIO, outside_is_nan),
        inside(slip_angle_deg.as_slice()?, &study::SLIP_ANGLE_DEG, outside_is_nan),
    ])
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
