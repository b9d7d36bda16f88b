//! Measured yaws of level traverses, to be held against the card.

use std::path::Path;

use grouser::document::card::{CardRecord, MeasuredRecord};

use crate::failure::Failure;

/// A measured yaw.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) slope_deg: f64,
    /// The column without its unit: `initial_yaw`.
    pub(super) name: String,
    pub(super) yaw_deg: f64,
}

/// The end of a column that is a yaw.
const YAW: &str = "yaw_deg";
/// What a model says is not measured.
const NOT_MEASURED: &str = "model";

/// Reads `slope_deg` and all columns of yaws, row by row; an empty field is no yaw.
pub(super) fn read(path: &Path) -> Result<Vec<Measured>, Failure> {
    let shown = path.display();
    let text = std::fs::read_to_string(path).map_err(Failure::at("cannot read", path))?;
    let wrong = |what: String| Failure::Usage(format!("--measured {shown}: {what}"));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().map_err(|error| wrong(error.to_string()))?.clone();
    let slope = header
        .iter()
        .position(|column| column.trim() == "slope_deg")
        .ok_or_else(|| wrong("there is no column slope_deg".to_owned()))?;
    let is_yaw = |name: &str| name.ends_with(YAW) && !name.starts_with(NOT_MEASURED);
    let yaws: Vec<(usize, &str)> =
        header.iter().map(str::trim).enumerate().filter(|(_, name)| is_yaw(name)).collect();
    if yaws.is_empty() {
        return Err(wrong(format!("there is no column that ends in {YAW}")));
    }
    let mut all = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        let number = |place: usize| {
            let field = record.get(place).unwrap_or_default().trim();
            let (row, column) = (index + 2, &header[place]);
            let number = field.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| wrong(format!("line {row}, {column}: '{field}' is no number")))
        };
        let slope_deg = number(slope)?;
        if !(0.0..=60.0).contains(&slope_deg) {
            return Err(wrong(format!("slope_deg {slope_deg}: it must be from 0 to 60")));
        }
        for (place, name) in &yaws {
            if record.get(*place).is_some_and(|field| !field.trim().is_empty()) {
                let name = name.trim_end_matches("_deg").to_owned();
                all.push(Measured { slope_deg, name, yaw_deg: number(*place)? });
            }
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
