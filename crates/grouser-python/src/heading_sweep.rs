//! Headings of many scenarios: numbers that vary from entry to entry.

use std::collections::HashMap;

use grouser::document::columns::SLOPE;
use grouser::document::columns::heading::{steepest, table};
use grouser::document::table::Table;
use grouser::error::ParameterError;
use grouser::studies::ensemble::outputs_while;
use grouser::studies::heading::{HeadingStudy, Steering};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::rollouts::{Index, Runs};

/// The rows of a curve, a row for each of its entries, and its end; why there is none where numbers do
/// not go together.
type Found = Result<(Table, Table), ParameterError>;

/// Headings of many scenarios on their own slopes, on all cores: rows and steepest slopes in the order
/// of the second list, with which row of the steepest slopes each has, and which entries have none and
/// why. Entries that differ in their slopes alone share a curve.
///
/// * `soils`: in the place of the scenarios' own; none, to leave those
/// * `varied`: an array of `count` numbers for each argument and key that varies; emptied
/// * `outside_is_nan`: whether an entry with a number out of its range has no row, and is no error
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
#[allow(clippy::type_complexity, reason = "what Python unpacks at once")]
pub(crate) fn heading_sweep<'py>(
    py: Python<'py>,
    scenario: PyRef<'py, Document>,
    soils: Vec<PyRef<'py, Document>>,
    soil_index: Index<'py>,
    varied: &Bound<'py, PyDict>,
    count: usize,
    steering: &str,
    outside_is_nan: bool,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>, Vec<[usize; 2]>, Vec<(usize, String)>)> {
    scenario.scenario_on_planes(py)?;
    let scenarios = [scenario];
    let runs = Runs::new(&scenarios, &None, &soils, &soil_index, varied, count, outside_is_nan)?;
    let steering = Steering::ALL.into_iter().find(|it| it.name() == steering).unwrap_or_default();
    let mut missing: Vec<(usize, String)> = Vec::new();
    let mut entries: HashMap<Vec<u64>, usize> = HashMap::new();
    let mut curves: Vec<Vec<usize>> = Vec::new();
    for place in 0..count {
        if let Some(why) = runs.why_none(place) {
            missing.push((place, why));
            continue;
        }
        let curve = *entries.entry(runs.bits_but_for(place, SLOPE.name)).or_insert(curves.len());
        if curve == curves.len() {
            curves.push(Vec::new());
        }
        curves[curve].push(place);
    }
    let places = curves.clone();
    let found = listening(py, move |cancelled| {
        if let Some(misfit) = runs.first_misfit().filter(|_| !outside_is_nan) {
            return Err(misfit);
        }
        let of_curve = |places: &Vec<usize>| -> Found {
            let study = HeadingStudy { steering, ..HeadingStudy::of(&runs.scenario(places[0])?) };
            let curve = study.curve()?;
            let slope = |place: &usize| runs.number(*place, SLOPE.name).unwrap_or_default();
            let slopes = SLOPE.in_si(&places.iter().map(slope).collect::<Vec<f64>>());
            Ok((table(&curve, &study.rover, &slopes), steepest(&curve)))
        };
        let found = outputs_while(curves, &|| !cancelled.is_set(), |it| of_curve(&it));
        Ok(found.unwrap_or_default())
    })?;
    let found = found.map_err(|(place, error)| errors::misfit_at(place, count, &error))?;
    let (mut rows, mut ends, mut order, mut curves) =
        (Table::default(), Table::default(), Vec::new(), 0);
    for (places, found) in places.into_iter().zip(found) {
        match found {
            Ok((own, end)) => {
                rows.append(own);
                ends.append(end);
                order.extend(places.into_iter().map(|place| [place, curves]));
                curves += 1;
            }
            Err(why) if outside_is_nan => {
                missing.extend(places.into_iter().map(|place| (place, why.to_string())));
            }
            Err(error) => return Err(errors::misfit_at(places[0], count, &error)),
        }
    }
    Ok((table_to_python(py, rows)?, table_to_python(py, ends)?, order, missing))
}
