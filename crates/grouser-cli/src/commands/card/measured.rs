//! Measured yaws of contour traverses, to compare with the card.

use std::path::Path;

use grouser::document::columns::card::MeasuredYaw;
use grouser::document::columns::{SLOPE, YAW};
use grouser::document::escape;
use grouser::document::measurements::{self, Limits, TextTable};

use crate::failure::Failure;

/// What a model says is not measured.
const NOT_MEASURED: &str = "model";
/// Measured yaws that are compared: every slope among them costs as much as one of the card's.
const MOST: usize = 10_000;
/// Characters of a cell that a message quotes.
const QUOTED: usize = 60;

/// Reads `slope_deg` and all columns of yaws, row by row; an empty field is no yaw.
pub(super) fn read(path: &Path, limits: Limits) -> Result<Vec<MeasuredYaw>, Failure> {
    let TextTable { header, rows } = measurements::read_texts(path, limits)?;
    let wrong = |line: u64, what: String| {
        Failure::Usage(format!("--measured {}:{line}: {what}", escape::path(path)))
    };
    let place_of = |column: &str| header.iter().position(|name| name == column);
    let slope = place_of(SLOPE.name)
        .ok_or_else(|| wrong(1, format!("there is no column {}", SLOPE.name)))?;
    let is_yaw = |name: &str| name.ends_with(YAW.name) && !name.starts_with(NOT_MEASURED);
    let yaws: Vec<usize> = (0..header.len()).filter(|&place| is_yaw(&header[place])).collect();
    if yaws.is_empty() {
        return Err(wrong(1, format!("there is no column that ends in {}", YAW.name)));
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
                wrong(*line, format!("{name}: '{text}' is not a number"))
            })
        };
        let slope_deg = number(slope)?;
        if !(0.0..=60.0).contains(&slope_deg) {
            return Err(wrong(
                *line,
                format!("{} {slope_deg}: it must be from 0 to 60", SLOPE.name),
            ));
        }
        for &place in yaws.iter().filter(|&&place| !row[place].is_empty()) {
            let name = header[place].trim_end_matches("_deg").to_owned();
            all.push(MeasuredYaw { slope: slope_deg, name, yaw: number(place)? });
        }
        if all.len() > MOST {
            let what = format!("more than {MOST} yaws: each slope of theirs is computed");
            return Err(wrong(*line, what));
        }
    }
    Ok(all)
}
