//! Plate-sinkage curves of a bevameter, from CSV.
//!
//! Columns: one of `plate_width_mm` (the smaller side of a rectangular plate), `plate_diameter_mm`
//! and `plate_radius_mm` (of a round one, for which *b* is the radius); `sinkage_mm`,
//! `pressure_kpa`; where they are known, `pressure_std_kpa`, and `repeat`, which tells curves of
//! one plate apart. Other columns are not used.
//!
//! Noise about zero is data: pressures below zero are kept, and refused where they are no noise.
//! Rows with a sinkage below zero, before the plate met the soil, have no place in a law of sinkage
//! and are left out.

use std::io::Read;
use std::path::Path;

use super::bevameter::{Rows, left_out_note};
use super::escape;
use super::given_file::{FileContent, GivenFile};
use super::measurements::bevameter_columns::{
    PLATE_COLUMNS, PLATE_DIAMETER, PLATE_RADIUS, PLATE_WIDTH, PRESSURE, PRESSURE_SCATTER, SINKAGE,
};
use super::measurements::{Limits, MeasurementError, read_bytes};
use crate::studies::calibration::PlateCurve;
use crate::studies::calibration::plate_curve::PlatePoint;

/// Columns of a plate's size, each with *b* over what stands there: for a round plate b is the
/// radius (Wong, Theory of Ground Vehicles).
const SIZES: [(&str, f64); 3] = [(PLATE_WIDTH, 1.0), (PLATE_DIAMETER, 0.5), (PLATE_RADIUS, 1.0)];

/// Curves that were read.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateMeasurements {
    /// A curve for each width and repeat, in the order in which they appear.
    pub curves: Vec<PlateCurve>,
    /// What the file gave.
    pub given: GivenFile,
    /// What was noticed and left: columns not used, rows left out, values that look like another
    /// unit's.
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
/// The same as [`read`].
pub fn read_from(
    label: &str,
    source: impl Read,
    limits: Limits,
) -> Result<PlateMeasurements, MeasurementError> {
    let sizes = SIZES.map(|(name, _)| name);
    let needed: [&[&str]; 3] = [&sizes, &[SINKAGE], &[PRESSURE]];
    let mut rows =
        Rows::open(label, source, limits, &PLATE_COLUMNS, "a column of plate tests", &needed)?;
    let (size, share) = SIZES.into_iter().find(|(name, _)| rows.has(name)).unwrap_or(SIZES[0]);
    let (mut curves, mut repeats) = (Vec::<PlateCurve>::new(), Vec::<String>::new());
    let mut before_contact = 0_usize;
    while rows.advance()? {
        let width = share * rows.number(size)?;
        let (sinkage, pressure) = (rows.number(SINKAGE)?, rows.number(PRESSURE)?);
        let point =
            PlatePoint { sinkage, pressure, scatter: rows.number_or_zero(PRESSURE_SCATTER)? };
        if sinkage < 0.0 {
            before_contact += 1;
            continue;
        }
        rows.see_stress(pressure);
        let repeat = rows.repeat();
        let mut known = curves.iter_mut().zip(&repeats);
        let same = known.find(|(curve, of)| curve.width == width && *of == repeat);
        if let Some((curve, _)) = same {
            curve.points.push(point);
        } else {
            curves.push(PlateCurve { width, points: vec![point] });
            repeats.push(repeat.to_owned());
        }
    }
    if curves.is_empty() {
        return Err(rows.no_rows());
    }
    rows.check_signs(PRESSURE)?;
    let mut notes = rows.unused_notes();
    notes.extend(left_out_note(before_contact, "their sinkage is below zero, before contact"));
    notes.extend(doubts(&curves));
    let given = rows.given(FileContent::PlateTests, before_contact as u64);
    Ok(PlateMeasurements { curves, given, notes })
}

/// What looks like another unit's.
fn doubts(curves: &[PlateCurve]) -> Vec<String> {
    /// Sinkages that are all below this were hardly read in millimetres [m]. Source: ours.
    const TINY: f64 = 2e-4;
    let mut notes = Vec::new();
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

    /// b is the radius of a round plate, and the smaller side of another.
    #[test]
    fn a_round_plate_s_width_is_its_radius() {
        for (column, size) in
            [("plate_width_mm", 38), ("plate_radius_mm", 38), ("plate_diameter_mm", 76)]
        {
            let text = format!("{column},sinkage_mm,pressure_kpa\n{size},1,2\n");
            let found = read_from("plates.csv", text.as_bytes(), Limits::default()).unwrap();
            assert!((found.curves[0].width - 0.038).abs() < 1e-15, "{column}");
        }
        let both = refusal("plate_width_mm,plate_radius_mm,sinkage_mm,pressure_kpa\n");
        assert!(both.contains("`plate_width_mm` and `plate_radius_mm`"), "{both}");
    }

    #[test]
    fn noise_about_zero_is_kept_and_what_was_before_contact_is_not() {
        let text = format!("{HEADER},repeat\n50,-1,-0.1,a\n50,0,-0.2,a\n50,1,2,a\n50,1,3,b\n");
        let found = read_from("plates.csv", text.as_bytes(), Limits::default()).unwrap();
        let [one, other] = &found.curves[..] else { panic!("two repeats: {found:?}") };
        assert_eq!((one.points.len(), one.points[0].pressure, other.points.len()), (2, -200.0, 1));
        let note = "1 row is left out: their sinkage is below zero, before contact";
        assert_eq!(found.notes, [note]);
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
            (format!("{HEADER}\n50,1,-2\n50,2,-4\n"), ["plates.csv:3: ", "sign another"]),
            (format!("{HEADER}\n50,1,20\n50,2,-4\n"), ["csv:3: `pressure_kpa` is -4", "-2 to"]),
            (HEADER.replace("width", "size"), ["plate_size_mm, sink", "a round one has its dia"]),
            (HEADER.replace(',', "|"), ["plates.csv:1: ", "in place of '|'"]),
            (format!("{HEADER},sinkage_mm\n50,1,2,3\n"), ["plates.csv:1: ", "twice"]),
        ] {
            let message = refusal(&text);
            assert!(parts.iter().all(|part| message.contains(part)), "{text}: {message}");
        }
    }
}
