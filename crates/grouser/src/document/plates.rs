//! Plate-sinkage curves of a bevameter, from CSV.
//!
//! Columns: `plate_width_mm` (the smaller side, or the diameter of a disc), `sinkage_mm`,
//! `pressure_kpa`, and, where it is known, `pressure_std_kpa`.

use std::fs::File;
use std::path::Path;

use super::measurements::{MeasurementError, MeasurementProblem as Problem};
use crate::studies::calibration::PlateCurve;
use crate::studies::calibration::plate_test::PlatePoint;

/// The columns, with factors to SI and the most that they may be.
const COLUMNS: [(&str, f64, f64); 4] = [
    ("plate_width_mm", 1e-3, 1e4),
    ("sinkage_mm", 1e-3, 1e4),
    ("pressure_kpa", 1e3, 1e5),
    ("pressure_std_kpa", 1e3, 1e5),
];

/// Reads curves, one for each width, in the order in which the widths appear.
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as it should be.
pub fn read(path: &Path) -> Result<Vec<PlateCurve>, MeasurementError> {
    let label = path.display().to_string();
    if path.is_dir() {
        return Err(MeasurementError::whole(&label, Problem::Folder));
    }
    let file = File::open(path).map_err(|error| MeasurementError::io(&label, &error))?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
    let failed = |error: csv::Error| MeasurementError::csv(&label, &error);
    let header = reader.headers().map_err(failed)?.clone();
    let places = COLUMNS.map(|(name, ..)| header.iter().position(|column| column == name));
    if let Some(missing) = places[..3].iter().position(Option::is_none) {
        let expected = format!("`{}`", COLUMNS[missing].0);
        let problem = Problem::MissingColumn { what: "a column of plate tests", expected };
        return Err(MeasurementError::at(&label, 1, problem));
    }
    let mut curves: Vec<PlateCurve> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(failed)?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| -> Result<f64, MeasurementError> {
            let (name, to_si, most) = COLUMNS[column];
            let Some(text) = places[column].map(|place| &record[place]) else { return Ok(0.0) };
            let column = name.to_owned();
            let wrong = |problem| MeasurementError::at(&label, line, problem);
            let value: f64 = text.parse().map_err(|_| {
                wrong(Problem::NotANumber { column: column.clone(), value: text.to_owned() })
            })?;
            if !(0.0..=most).contains(&value) {
                return Err(wrong(Problem::OutOfRange { column, value, least: 0.0, most }));
            }
            Ok(value * to_si)
        };
        let [width, sinkage, pressure, scatter] = [number(0)?, number(1)?, number(2)?, number(3)?];
        let point = PlatePoint { sinkage, pressure, scatter };
        match curves.iter_mut().find(|curve| curve.width == width) {
            Some(curve) => curve.points.push(point),
            None => curves.push(PlateCurve { width, points: vec![point] }),
        }
    }
    if curves.is_empty() {
        return Err(MeasurementError::whole(&label, Problem::NoRows));
    }
    Ok(curves)
}
