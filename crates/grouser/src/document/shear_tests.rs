//! Shear tests of a bevameter, from CSV.
//!
//! Columns: `shear_displacement_mm`, `shear_stress_kpa`, `normal_stress_kpa`; where they are known,
//! `shear_stress_std_kpa`, and `repeat`, which tells tests under one normal stress apart. Other
//! columns are not used.
//!
//! Rows under nearly one normal stress, of one repeat, are a test; its normal stress is their mean.
//! Rows with a displacement below zero, before the patch moved, are left out; stresses below zero
//! are noise, and kept.

use std::io::Read;
use std::path::Path;

use super::bevameter::{Rows, left_out_note};
use super::escape;
use super::given_file::{FileContent, GivenFile};
use super::measurements::bevameter_columns::{
    NORMAL_STRESS, SHEAR_COLUMNS, SHEAR_DISPLACEMENT, SHEAR_STRESS, SHEAR_STRESS_SCATTER,
};
use super::measurements::{Limits, MeasurementError, read_bytes};
use crate::studies::calibration::ShearCurve;
use crate::studies::calibration::bevameter::SAME_NORMAL_STRESS;
use crate::studies::calibration::repeated_curves::CurvePoint;

/// Curves that were read.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearMeasurements {
    /// A curve for each normal stress and repeat, in the order in which they appear.
    pub curves: Vec<ShearCurve>,
    /// What the file gave.
    pub given: GivenFile,
    /// What was noticed and left: columns not used, rows left out.
    pub notes: Vec<String>,
}

/// Reads curves from a file.
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as it should be.
pub fn read(path: &Path) -> Result<ShearMeasurements, MeasurementError> {
    let limits = Limits::default();
    read_from(&escape::path(path), read_bytes(path, limits)?.as_slice(), limits)
}

/// A test whose rows are being read.
struct Growing {
    repeat: String,
    first_normal_stress: f64,
    normal_stresses: f64,
    points: Vec<CurvePoint>,
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
) -> Result<ShearMeasurements, MeasurementError> {
    let needed: [&[&str]; 3] = [&[SHEAR_DISPLACEMENT], &[SHEAR_STRESS], &[NORMAL_STRESS]];
    let mut rows =
        Rows::open(label, source, limits, &SHEAR_COLUMNS, "a column of shear tests", &needed)?;
    let (mut tests, mut before_contact) = (Vec::<Growing>::new(), 0_usize);
    while rows.advance()? {
        let (at, value) = (rows.number(SHEAR_DISPLACEMENT)?, rows.number(SHEAR_STRESS)?);
        let normal_stress = rows.number(NORMAL_STRESS)?;
        let point = CurvePoint { at, value, scatter: rows.number_or_zero(SHEAR_STRESS_SCATTER)? };
        if at < 0.0 {
            before_contact += 1;
            continue;
        }
        rows.see_stress(value);
        let repeat = rows.repeat();
        let is_same = |test: &&mut Growing| {
            let first = test.first_normal_stress;
            test.repeat == repeat && (normal_stress - first).abs() <= SAME_NORMAL_STRESS * first
        };
        match tests.iter_mut().find(is_same) {
            Some(test) => {
                test.normal_stresses += normal_stress;
                test.points.push(point);
            }
            None => tests.push(Growing {
                repeat: repeat.to_owned(),
                first_normal_stress: normal_stress,
                normal_stresses: normal_stress,
                points: vec![point],
            }),
        }
    }
    if tests.is_empty() {
        return Err(rows.no_rows());
    }
    rows.check_signs(SHEAR_STRESS)?;
    let curve = |test: Growing| ShearCurve {
        normal_stress: test.normal_stresses / test.points.len() as f64,
        points: test.points,
    };
    let mut notes = rows.unused_notes();
    notes
        .extend(left_out_note(before_contact, "their displacement is below zero, before shearing"));
    let given = rows.given(FileContent::ShearTests, before_contact as u64);
    Ok(ShearMeasurements { curves: tests.into_iter().map(curve).collect(), given, notes })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "shear_displacement_mm,shear_stress_kpa,normal_stress_kpa";

    #[test]
    fn rows_under_nearly_one_normal_stress_are_a_test() {
        let text = format!(
            "{HEADER},repeat\n-1,0,10,a\n0,-0.1,10,a\n1,2,10.4,a\n1,2,10,b\n1,4,20,a\n2,5,20,a\n"
        );
        let found = read_from("shear.csv", text.as_bytes(), Limits::default()).unwrap();
        let stresses: Vec<f64> = found.curves.iter().map(|it| it.normal_stress).collect();
        assert_eq!(stresses, [10_200.0, 10_000.0, 20_000.0]);
        assert_eq!(found.curves[0].points[0].value, -100.0);
        assert_eq!(found.notes.len(), 1);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, parts) in [
            (HEADER.to_owned(), ["shear.csv: ", "no rows"]),
            (format!("{HEADER}\n1,2,0\n"), ["shear.csv:2: ", "in kilopascals"]),
            (
                "shear_displacement_mm,tau\n".to_owned(),
                ["`shear_stress_kpa`", "columns are shear_disp"],
            ),
        ] {
            let found = read_from("shear.csv", text.as_bytes(), Limits::default());
            let message = found.unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)), "{text}: {message}");
        }
    }
}
