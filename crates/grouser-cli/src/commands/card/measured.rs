//! Measured yaws of level traverses, to be held against the card.

use std::path::Path;

use grouser::document::card::{CardRecord, MeasuredRecord};
use grouser::document::escape;
use grouser::document::measurements::{self, Limits, TextTable};

use crate::failure::Failure;

/// A measured yaw.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) slope_deg: f64,
    /// The column without its unit: `initial_yaw`.
    pub(super) name: String,
    pub(super) yaw_deg: f64,
}

/// The column of slopes.
const SLOPE: &str = "slope_deg";
/// The end of a column that is a yaw.
const YAW: &str = "yaw_deg";
/// What a model says is not measured.
const NOT_MEASURED: &str = "model";
/// Measured yaws that are compared: every slope among them costs as much as one of the card's.
const MOST: usize = 10_000;
/// Characters of a cell that a message quotes.
const QUOTED: usize = 60;

/// Reads `slope_deg` and all columns of yaws, row by row; an empty field is no yaw.
pub(super) fn read(path: &Path, limits: Limits) -> Result<Vec<Measured>, Failure> {
    let TextTable { header, rows } = measurements::read_texts(path, limits)?;
    let wrong = |line: u64, what: String| {
        Failure::Usage(format!("--measured {}:{line}: {what}", escape::path(path)))
    };
    let place_of = |column: &str| header.iter().position(|name| name == column);
    let slope = place_of(SLOPE).ok_or_else(|| wrong(1, format!("there is no column {SLOPE}")))?;
    let is_yaw = |name: &str| name.ends_with(YAW) && !name.starts_with(NOT_MEASURED);
    let yaws: Vec<usize> = (0..header.len()).filter(|&place| is_yaw(&header[place])).collect();
    if yaws.is_empty() {
        return Err(wrong(1, format!("there is no column that ends in {YAW}")));
    }
    for &place in yaws.iter().chain([&slope]) {
        if place_of(&header[place]) != Some(place) {
            let name = escape::line(&header[place]);
            return Err(wrong(1, format!("the column {name} is there twice")));
        }
    }
    let mut all = Vec::new();
    for (line, row) in &rows {
        let number = |place: usize| {
            let number = row[place].parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| {
                let (name, text) = (&header[place], &row[place]);
                let [name, text] = [name, text].map(|text| escape::short_line(text, QUOTED));
                wrong(*line, format!("{name}: '{text}' is no number"))
            })
        };
        let slope_deg = number(slope)?;
        if !(0.0..=60.0).contains(&slope_deg) {
            return Err(wrong(*line, format!("{SLOPE} {slope_deg}: it must be from 0 to 60")));
        }
        for &place in yaws.iter().filter(|&&place| !row[place].is_empty()) {
            let name = header[place].trim_end_matches("_deg").to_owned();
            all.push(Measured { slope_deg, name, yaw_deg: number(place)? });
        }
        if all.len() > MOST {
            let what = format!("more than {MOST} yaws: each slope of theirs is computed");
            return Err(wrong(*line, what));
        }
    }
    Ok(all)
}

/// Each beside the row of its slope.
pub(super) fn beside(measured: &[Measured], rows: &[CardRecord]) -> Vec<MeasuredRecord> {
    let one = |point: &Measured| {
        // Both were this many degrees once, and came through radians.
        let row = rows.iter().find(|row| (row.slope_deg - point.slope_deg).abs() < 1e-9)?;
        Some(MeasuredRecord::new(row, &point.name, point.yaw_deg))
    };
    measured.iter().filter_map(one).collect()
}
