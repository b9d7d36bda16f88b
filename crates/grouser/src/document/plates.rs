//! Plate-sinkage curves of a bevameter, from CSV.
//!
//! Columns: `plate_width_mm` (the smaller side, or the diameter of a disc), `sinkage_mm`,
//! `pressure_kpa`, and, where it is known, `pressure_std_kpa`. Other columns are not used.

use std::io::Read;
use std::path::Path;

use super::escape;
use super::measurements::table::{Table, other_delimiter};
use super::measurements::{Limits, MeasurementError, MeasurementProblem as Problem, read_bytes};
use crate::studies::calibration::PlateCurve;
use crate::studies::calibration::plate_test::PlatePoint;

/// A number of a plate test.
struct Column {
    name: &'static str,
    to_si: f64,
    /// What it may be, in its own unit.
    least: f64,
    most: f64,
}

/// No plate is narrower than a millimetre: one that is was written in another unit.
const COLUMNS: [Column; 4] = [
    Column { name: "plate_width_mm", to_si: 1e-3, least: 1.0, most: 1e4 },
    Column { name: "sinkage_mm", to_si: 1e-3, least: 0.0, most: 1e4 },
    Column { name: "pressure_kpa", to_si: 1e3, least: 0.0, most: 1e5 },
    Column { name: "pressure_std_kpa", to_si: 1e3, least: 0.0, most: 1e5 },
];

/// The columns that must be there, first of all.
const NEEDED: usize = 3;

/// Curves that were read.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateMeasurements {
    /// A curve for each width, in the order in which the widths appear.
    pub curves: Vec<PlateCurve>,
    /// What was noticed and left: columns not used, values that look like another unit's.
    pub notes: Vec<String>,
}

/// Reads curves from a file.
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as it should be.
pub fn read(path: &Path) -> Result<PlateMeasurements, MeasurementError> {
    let limits = Limits::default();
    read_from(&escape::path(path), read_bytes(path, limits)?.as_slice(), limits)
}

/// Reads curves from anywhere.
///
/// * `label`: what messages call the source
/// * `limits`: how much of it is read
///
/// # Errors
/// As for [`read`].
pub fn read_from(
    label: &str,
    source: impl Read,
    limits: Limits,
) -> Result<PlateMeasurements, MeasurementError> {
    let mut table = Table::new(label, source, b',', limits);
    let header: Vec<String> = table.header()?.iter().map(str::to_owned).collect();
    let places = places(label, &header)?;
    let mut curves: Vec<PlateCurve> = Vec::new();
    let mut record = csv::StringRecord::new();
    while table.next_row(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        let wrong = |problem| MeasurementError::at(label, line, problem);
        if record.iter().eq(header.iter().map(String::as_str)) {
            return Err(wrong(Problem::RepeatedHeader));
        }
        let number = |column: usize| {
            let text = places[column].map_or("", |place| &record[place]);
            // What is not needed may be unknown.
            if text.is_empty() && column >= NEEDED {
                return Ok(0.0);
            }
            number(&COLUMNS[column], text).map_err(|problem| {
                let is_width = matches!(problem, Problem::OutOfRange { .. }) && column == 0;
                let hint = is_width.then(|| "is it in millimetres?".to_owned());
                wrong(problem).with_hint(hint)
            })
        };
        let [width, sinkage, pressure, scatter] = [number(0)?, number(1)?, number(2)?, number(3)?];
        let point = PlatePoint { sinkage, pressure, scatter };
        match curves.iter_mut().find(|curve| curve.width == width) {
            Some(curve) => curve.points.push(point),
            None => curves.push(PlateCurve { width, points: vec![point] }),
        }
    }
    if curves.is_empty() {
        return Err(MeasurementError::whole(label, Problem::NoRows));
    }
    let notes = notes(&header, &curves);
    Ok(PlateMeasurements { curves, notes })
}

/// Where each of the columns stands.
fn places(label: &str, header: &[String]) -> Result<[Option<usize>; 4], MeasurementError> {
    if header.iter().all(String::is_empty) {
        return Err(MeasurementError::whole(label, Problem::NoHeader));
    }
    let mut places = [None; COLUMNS.len()];
    for (place, Column { name, .. }) in places.iter_mut().zip(&COLUMNS) {
        let mut own = (0..header.len()).filter(|place| header[*place] == *name);
        *place = own.next();
        if own.next().is_some() {
            let problem = Problem::RepeatedColumn((*name).to_owned());
            return Err(MeasurementError::at(label, 1, problem));
        }
    }
    if let Some(missing) = places[..NEEDED].iter().position(Option::is_none) {
        let expected = format!("`{}`", COLUMNS[missing].name);
        let problem = Problem::MissingColumn { what: "a column of plate tests", expected };
        let hint = match other_delimiter(header) {
            Some(_) => "part the fields with commas, and write decimals with a point".to_owned(),
            None => format!("the columns are {}", header.join(", ")),
        };
        return Err(MeasurementError::at(label, 1, problem).with_hint(hint));
    }
    Ok(places)
}

/// A number in SI.
fn number(column: &Column, text: &str) -> Result<f64, Problem> {
    let Column { name, to_si, least, most } = *column;
    let column = name.to_owned();
    let Ok(value) = text.parse::<f64>() else {
        return Err(Problem::NotANumber { column, value: escape::short_line(text, 60) });
    };
    if !(least..=most).contains(&value) {
        return Err(Problem::OutOfRange { column, value, least, most });
    }
    Ok(value * to_si)
}

fn notes(header: &[String], curves: &[PlateCurve]) -> Vec<String> {
    /// Sinkages that are all below this were hardly read in millimetres [m]. Source: ours.
    const TINY: f64 = 2e-4;
    let known = |name: &String| name.is_empty() || COLUMNS.iter().any(|it| it.name == name);
    let unknown = header.iter().filter(|name| !known(name));
    let mut notes: Vec<String> =
        unknown.map(|name| format!("column `{}` is not used", escape::line(name))).collect();
    let points = || curves.iter().flat_map(|curve| &curve.points);
    if points().all(|point| point.sinkage < TINY) {
        notes.push("all sinkages are below 0.2 mm: are they in metres?".to_owned());
    }
    if points().all(|point| point.pressure == 0.0) {
        notes.push("all pressures are zero: nothing can be learnt of them".to_owned());
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "plate_width_mm,sinkage_mm,pressure_kpa";

    fn refusal(text: &str) -> String {
        read_from("plates.csv", text.as_bytes(), Limits::default()).unwrap_err().to_string()
    }

    #[test]
    fn curves_are_read_in_si_width_by_width() {
        let text =
            format!("{HEADER},pressure_std_kpa,by\r\n50,1,2,,a\r\n100,3,4,0.5,b\r\n50,2,3,,c");
        let found = read_from("plates.csv", text.as_bytes(), Limits::default()).unwrap();
        let [narrow, wide] = &found.curves[..] else { panic!("{found:?}") };
        assert_eq!((narrow.width, narrow.points.len(), wide.points.len()), (0.05, 2, 1));
        assert_eq!((wide.points[0].sinkage, wide.points[0].pressure), (0.003, 4000.0));
        assert_eq!((narrow.points[0].scatter, wide.points[0].scatter), (0.0, 500.0));
        assert_eq!(found.notes, ["column `by` is not used"]);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, parts) in [
            (String::new(), ["plates.csv: ", "no header"]),
            (HEADER.to_owned(), ["plates.csv: ", "no rows"]),
            (HEADER.replace(',', ";"), ["plates.csv:1: ", "with commas"]),
            ("plate_width_mm,z,p\n".to_owned(), ["`sinkage_mm`", "columns are plate_width_mm, z"]),
            (format!("{HEADER}\n50,1,2\n{HEADER}\n"), ["plates.csv:3: ", "again"]),
            (format!("{HEADER}\n0.05,1,2\n"), ["plates.csv:2: ", "in millimetres"]),
            (format!("{HEADER}\n50,1,\n"), ["plates.csv:2: ", "must be a number"]),
            (format!("{HEADER}\n50,1,nan\n"), ["plates.csv:2: ", "`pressure_kpa`"]),
            (format!("{HEADER},sinkage_mm\n50,1,2,3\n"), ["plates.csv:1: ", "twice"]),
        ] {
            let message = refusal(&text);
            assert!(parts.iter().all(|part| message.contains(part)), "{text}: {message}");
        }
    }
}
