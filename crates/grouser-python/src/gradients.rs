//! Derivatives of settled wheels and of runs, for whole arrays.

use grouser::contact::gradient::WheelDerivative;
use grouser::contact::settle;
use grouser::difference::Derivative;
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{LOAD, SLIP_ANGLE};
use grouser::document::gradient::{
    ChangedKeys, GradientKeys, NoSuchKey, RunKeys, StandSetting, WheelKeys,
};
use grouser::document::study;
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::columns::wheel_names;
use crate::descriptions::Document;
use crate::wheels::{Inputs, Stand, inside, slips};
use crate::{errors, threads};

/// Derivatives with a row for each key and result, whether each differs from side to side, the keys
/// and the results.
pub(crate) type Gradients<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<bool>>, Vec<String>, Vec<&'static str>);

/// Wheels between two checks for signals: they take a small part of a second.
const BATCH: usize = 1024;

/// The derivatives of settled wheels by numbers of their documents and settings: rows of all
/// results by the first key, then by the next; NaN where there is none.
///
/// * `vary`: keys of soil and wheel, and `gravity_m_s2`, with a number for each wheel; emptied
/// * `keys`: the numbers, or `all` alone
/// * `outside_is_nan`: as of [`settle`](crate::wheels::settle)
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn settle_gradients<'py>(
    py: Python<'py>,
    soils: Vec<PyRef<'py, Document>>,
    wheel: PyRef<'py, Document>,
    setting: &Document,
    load_n: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    soil_index: Option<PyReadonlyArray1<'py, i64>>,
    vary: &Bound<'py, PyDict>,
    keys: Vec<String>,
    outside_is_nan: bool,
) -> PyResult<Gradients<'py>> {
    let pressed = inside(load_n.as_slice()?, &study::LOAD_N, outside_is_nan);
    let [slip_ratios, slip_angles_deg] = slips(&slip_ratio, &slip_angle_deg, outside_is_nan)?;
    let inputs = Inputs {
        quantity: LOAD,
        pressed: &pressed,
        slip_ratios: &slip_ratios,
        slip_angles_deg: &slip_angles_deg,
        soils: soil_index.as_ref().map(|index| index.as_slice()).transpose()?,
        wheels: None,
    };
    let count = inputs.pressed.len();
    let wheels = [wheel];
    let mut stand = Stand::new(&soils, &wheels, setting, vary, count, outside_is_nan)?;
    inputs.check(&stand, &study::LOAD_N)?;
    stand.check(py, &inputs)?;
    let keys = keys_of(&soils, &wheels[0], &keys)?;
    let names: Vec<String> = keys[0].names().map(str::to_owned).collect();
    let of_wheel = |place| of_wheel(&stand, &inputs, &keys, place);
    let mut found: Vec<_> = Vec::with_capacity(count);
    while found.len() < count {
        let places = found.len()..count.min(found.len() + BATCH);
        let batch = || places.into_par_iter().map(&of_wheel).collect::<Vec<_>>();
        found.extend(threads::detached(py, batch)?);
        py.check_signals()?;
    }
    let rows = names.len() * WHEEL.len();
    let values = PyArray2::<f64>::zeros(py, [rows, count], false);
    let one_sided = PyArray2::<bool>::zeros(py, [rows, count], false);
    {
        let (mut values, mut one_sided) = (values.readwrite(), one_sided.readwrite());
        let cells = values.as_slice_mut()?.chunks_mut(count.max(1));
        let cells = cells.zip(one_sided.as_slice_mut()?.chunks_mut(count.max(1)));
        for (row, (values, one_sided)) in cells.enumerate() {
            let (key, column) = (row / WHEEL.len(), &WHEEL[row % WHEEL.len()]);
            for (place, found) in found.iter().enumerate() {
                let derivative = found.get(key).and_then(Option::as_ref);
                let sides = derivative.map(|it| it.sides.each_ref().map(|it| column.number(it)));
                values[place] = derivative.map_or(f64::NAN, |it| column.number(&it.value));
                one_sided[place] = sides.is_some_and(|[below, above]| below != above);
            }
        }
    }
    Ok((values, one_sided, names, wheel_names().collect()))
}

#[allow(clippy::needless_pass_by_value, reason = "how errors are mapped")]
pub(crate) fn no_such_key(error: NoSuchKey) -> PyErr {
    errors::parameter(error.to_string(), "gradients", None, "the key of a number")
}

/// Derivatives of records of runs.
///
/// * `on_heights`: whether some ground has heights
/// * `count`: how many records there are
/// * `of`: that of a record by a key and of a result, by their places
pub(crate) fn of_records<'py>(
    py: Python<'py>,
    keys: &RunKeys,
    on_heights: bool,
    count: usize,
    of: impl Fn(usize, usize, usize) -> Option<Derivative>,
) -> PyResult<Gradients<'py>> {
    let names: Vec<String> = keys.names().map(str::to_owned).collect();
    let results = RunKeys::results(on_heights);
    let row = |row: usize| {
        let (key, result) = (row / results.len(), row % results.len());
        (0..count).map(|record| of(record, key, result)).collect::<Vec<_>>()
    };
    let rows: Vec<Vec<Option<Derivative>>> = (0..names.len() * results.len()).map(row).collect();
    let value = |it: &Option<Derivative>| it.map_or(f64::NAN, |it| it.value);
    let is_one_sided = |it: &Option<Derivative>| it.is_some_and(Derivative::is_one_sided);
    let values: Vec<Vec<f64>> = rows.iter().map(|it| it.iter().map(value).collect()).collect();
    let sides: Vec<Vec<bool>> =
        rows.iter().map(|it| it.iter().map(is_one_sided).collect()).collect();
    Ok((PyArray2::from_vec2(py, &values)?, PyArray2::from_vec2(py, &sides)?, names, results))
}

/// The keys in each of the soils; `all` are those of the first.
fn keys_of(
    soils: &[PyRef<'_, Document>],
    wheel: &Document,
    keys: &[String],
) -> PyResult<Vec<WheelKeys>> {
    let mut asked_for = GradientKeys::of(keys);
    let mut found = Vec::new();
    for soil in soils {
        let keys = WheelKeys::of(soil.soil()?, wheel.wheel()?, &asked_for).map_err(no_such_key)?;
        asked_for = GradientKeys::These(keys.names().map(str::to_owned).collect());
        found.push(keys);
    }
    Ok(found)
}

/// The derivatives of a wheel by each key; none of one that does not settle.
fn of_wheel(
    stand: &Stand,
    inputs: &Inputs<'_>,
    keys: &[WheelKeys],
    place: usize,
) -> Vec<Option<WheelDerivative>> {
    let Some((contact, model)) = stand.known_contact(inputs, place) else { return Vec::new() };
    let load = inputs.pressed[place];
    let Ok(settled) = settle(model.as_ref(), &contact, load) else { return Vec::new() };
    let setting = StandSetting {
        gravity: contact.gravity,
        load,
        slip_ratio: inputs.slip_ratios[place],
        slip_angle: SLIP_ANGLE.unit.to_si(inputs.slip_angles_deg[place]),
    };
    let [soil, wheel] = stand.changed(inputs, place);
    let changed = ChangedKeys { soil: &soil, wheel: &wheel };
    keys[inputs.soil_of(place)].of_wheel(&model, &setting, &changed, &settled)
}
