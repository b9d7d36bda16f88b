//! Mobility maps: what a rover does at every point of a map of heights.

use grouser::answers::Sampling;
use grouser::document::columns::map::{CLASS, bands, chosen};
use grouser::document::columns::verdict::{ADVICE, ADVICE_OBJECT};
use grouser::document::columns::{COURSE, Column, LIMIT_SLOPE, POWER, SINKAGE, SLIP_RATIO, YAW};
use grouser::document::study::{COURSE_DEG, MAP_SPEED_M_S};
use grouser::document::table::Table;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mobility::{CellMotion, CourseChoice, Ground, MobilityMap, MobilityTable};
use grouser::studies::verdict::SlopeStudy;
use grouser_raster::Raster;
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::studies::{Problem, SAMPLES};
use crate::terrain::Terrain;
use crate::wheels::check;

/// Bands by name, each with its unit, what it is, and its numbers in rows from north to south; then
/// x of the columns and y of the rows [m]; then how far the numbers are from those of the curves at
/// most, other numbers of the map, and the `advice` for each class of slopes.
type Parts<'py> = (
    Vec<(&'static str, &'static str, &'static str, Bound<'py, PyAny>)>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyDict>,
);

/// * `course`: an angle [°], or `best` or `worst`
#[pyfunction]
#[pyo3(signature = (scenario, terrain, course, rim_speed_m_s, samples, seed))]
pub(crate) fn mobility_map<'py>(
    py: Python<'py>,
    scenario: &Document,
    terrain: &Terrain,
    course: &Bound<'py, PyAny>,
    rim_speed_m_s: Option<f64>,
    samples: u32,
    seed: u64,
) -> PyResult<Parts<'py>> {
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    let course = choice(course)?;
    let scenario = scenario.scenario()?;
    let mut study = SlopeStudy::of(scenario);
    if let Some(speed) = rim_speed_m_s {
        check("rim_speed_m_s", &[speed], &MAP_SPEED_M_S)?;
        study.rim_speed = speed;
    }
    let inputs = BandInputs::of_scenario(scenario);
    let raster = raster_of(terrain);
    let mut columns: Vec<Column<CellMotion>> = bands().into();
    if !matches!(course, CourseChoice::Fixed(_)) {
        columns.extend(chosen());
    }
    let grid = raster.grid;
    let found = listening(py, move |cancelled| {
        let go_on = || !cancelled.is_set();
        let sampling = Sampling { count: samples, seed };
        let samples = sampling.draw_if_uncertain(&inputs).map_err(Problem::Sampling)?;
        let ground = Ground::under(&study.heading.rover, &raster);
        let map = MobilityMap::of(&study, course, ground.steepest(), &samples, &go_on)
            .map_err(Problem::Parameter)?;
        let numbers = map.map(|map| (numbers(ground, &map, &columns), map));
        Ok((numbers, columns, ground.slope_length()))
    })?;
    let (found, columns, slope_length) = found.map_err(|problem: Problem| problem.raised())?;
    // A map that was stopped raises the signal before its numbers are asked for.
    let (numbers, map) = found.unwrap_or_else(|| unreachable!("it was not stopped"));
    let shape = [grid.rows, grid.columns];
    let bands = columns.iter().zip(numbers).map(|(column, numbers)| {
        let array = PyArray1::from_vec(py, numbers).reshape(shape)?;
        Ok((column.name, column.unit.symbol, column.doc, array.into_any()))
    });
    let bands = bands.collect::<PyResult<Vec<_>>>()?;
    let x = (0..grid.columns).map(|column| grid.point(column, 0).x);
    let y = (0..grid.rows).rev().map(|row| grid.point(0, row).y);
    Ok((
        bands,
        PyArray1::from_iter(py, x),
        PyArray1::from_iter(py, y),
        about(py, &map, slope_length)?,
    ))
}

/// Heights with the system of their coordinates.
pub(crate) fn raster_of(terrain: &Terrain) -> Raster {
    let model = &terrain.map.model;
    Raster {
        grid: *model.grid(),
        base: model.base(),
        heights: model.heights_above_base().collect(),
        coordinates: terrain.map.system.clone().unwrap_or_default(),
        remarks: Vec::new(),
    }
}

fn choice(course: &Bound<'_, PyAny>) -> PyResult<CourseChoice> {
    match course.extract::<String>().as_deref() {
        Ok("best") => return Ok(CourseChoice::Best),
        Ok("worst") => return Ok(CourseChoice::Worst),
        Ok(other) => {
            let message =
                format!("course_deg is {other:?}, it must be an angle, 'best' or 'worst'");
            return Err(errors::parameter(
                message,
                COURSE.name,
                None,
                "an angle, 'best' or 'worst'",
            ));
        }
        Err(_) => (),
    }
    let degrees: f64 = course.extract()?;
    check(COURSE.name, &[degrees], &COURSE_DEG)?;
    Ok(CourseChoice::Fixed(COURSE.unit.to_si(degrees)))
}

/// The numbers of each band, in rows from north to south; NaN where there is none.
fn numbers(ground: Ground<'_>, map: &MobilityMap, columns: &[Column<CellMotion>]) -> Vec<Vec<f32>> {
    let grid = ground.raster().grid;
    let cells = grid.columns * grid.rows;
    let band = |column: &Column<CellMotion>| {
        let number = |place: usize| {
            let row = grid.rows - 1 - place / grid.columns;
            let cell = ground.at(map, place % grid.columns, row);
            #[expect(
                clippy::cast_possible_truncation,
                reason = "seven digits are more than are known"
            )]
            cell.map_or(f32::NAN, |cell| column.number(&cell) as f32)
        };
        (0..cells).into_par_iter().map(number).collect()
    };
    columns.iter().map(band).collect()
}

/// Numbers of the map as a whole.
fn about<'py>(
    py: Python<'py>,
    map: &MobilityMap,
    slope_length: [f64; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let about = PyDict::new(py);
    let errors = map.largest_errors();
    let stated = [
        (grouser::document::columns::map::HEADING, YAW.unit.from_si(errors.crab)),
        (SLIP_RATIO, errors.slip_ratio),
        (POWER, errors.power),
        (SINKAGE, SINKAGE.unit.from_si(errors.sinkage)),
    ];
    for (quantity, error) in stated {
        about.set_item(format!("interpolation_error_{}", quantity.name), error)?;
    }
    let limits = map.tables().iter().filter_map(MobilityTable::limit);
    let limit = limits.reduce(f64::max).map(|limit| LIMIT_SLOPE.unit.from_si(limit));
    about.set_item(LIMIT_SLOPE.name, limit.unwrap_or(f64::NAN))?;
    about.set_item("slope_length_m", slope_length.to_vec())?;
    let advice: Vec<_> = map.advice().iter().map(Some).collect();
    let advice = Table::default().and(&CLASS, &advice).and(&ADVICE, &advice);
    about.set_item(ADVICE_OBJECT, table_to_python(py, advice)?)?;
    Ok(about)
}
