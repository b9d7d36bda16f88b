//! A row of units below the header of a table: `s,m,deg`.

use csv::StringRecord;

use super::super::dimension::is_unit;
use super::super::error::MeasurementProblem as Problem;
use super::super::log_column::LogColumn;
use super::COLUMNS;
use super::cell::Cell;
use super::clock::{OTHER_TIMES, TIME_UNITS};

/// What the row of units makes of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OfUnit {
    /// Its name, with the unit that the numbers have after the factor.
    pub(super) name: String,
    pub(super) factor: f64,
}

/// The units of a row that has nothing else: no number, and at least one that is known.
pub(super) fn units_of(row: &StringRecord) -> Option<Vec<String>> {
    let units: Vec<String> = row.iter().map(plain).collect();
    let is_number = |cell: &str| matches!(Cell::of_text(cell), Cell::Number(_));
    let has_units = units.iter().any(|it| is_unit(it) || seconds_in(it).is_some());
    (has_units && !row.iter().any(is_number)).then_some(units)
}

/// A unit as this crate writes it, without brackets.
fn plain(cell: &str) -> String {
    let unit = cell.trim().trim_matches(['[', ']', '(', ')']).trim();
    let unit = unit.replace(['·', '*', ' '], "").replace('°', "deg").replace('µ', "u");
    match unit.as_str() {
        "degree" | "degrees" => "deg".to_owned(),
        "radian" | "radians" => "rad".to_owned(),
        "sec" | "second" | "seconds" => "s".to_owned(),
        _ => unit,
    }
}

/// The ending of the time's column in a unit.
fn seconds_in(unit: &str) -> Option<&'static str> {
    TIME_UNITS.into_iter().find(|it| *it == unit)
}

/// A column with the unit that stands below its name. What is not known stays as it is.
///
/// * `unit`: as [`units_of`] gives it; empty where there is none
/// * `own`: the column that the name alone means
///
/// # Errors
/// [`Problem::UnknownUnit`] for a unit that the column cannot have, or that is another than its name
/// says.
pub(super) fn column_in(
    name: &str,
    unit: &str,
    own: Option<&LogColumn>,
) -> Result<OfUnit, Problem> {
    let same = |name: &str| OfUnit { name: name.to_owned(), factor: 1.0 };
    let failed = |known: Vec<&'static str>| Problem::UnknownUnit {
        column: name.into(),
        unit: unit.into(),
        known: known.into(),
    };
    if unit.is_empty() {
        return Ok(same(name));
    }
    if name == "t" || name == "time_s" || OTHER_TIMES.iter().any(|(time, _)| *time == name) {
        let ending = seconds_in(unit).ok_or_else(|| failed(TIME_UNITS.to_vec()))?;
        let says = name.rsplit_once('_').map_or("", |(_, ending)| ending);
        return match seconds_in(says) {
            Some(other) if other != ending => Err(failed(vec![other])),
            _ => Ok(same(&format!("time_{ending}"))),
        };
    }
    let factor = |column: &LogColumn| -> Result<f64, Problem> {
        let size = column.dimension().size_of(unit).map_err(&failed)?;
        Ok(size / column.unit.to_si(1.0))
    };
    if let Some(column) = own {
        return match factor(column)? {
            1.0 => Ok(same(name)),
            _ => Err(failed(vec![column.unit.symbol])),
        };
    }
    match COLUMNS.iter().find_map(|column| Some((column, with_unit(name, column)?))) {
        Some((column, name)) => Ok(OfUnit { name, factor: factor(column)? }),
        None => Ok(same(name)),
    }
}

/// The name of a column with its unit, where it has none: `wheel_speed_front-left`.
fn with_unit(name: &str, column: &LogColumn) -> Option<String> {
    let base = column.base();
    if !column.is_of_wheel {
        return (name == base).then(|| column.name.to_owned());
    }
    let behind = || Some(format!("{}{}", column.name, name.strip_prefix(base)?));
    let before = || Some(format!("{}{}", name.strip_suffix(base)?, column.name));
    let has_wheel = |name: &String| name.len() > column.name.len() + 1;
    let is_behind = name.strip_prefix(base).is_some_and(|rest| rest.starts_with('_'));
    let is_before = name.strip_suffix(base).is_some_and(|rest| rest.ends_with('.'));
    let found = if is_behind {
        behind()
    } else if is_before {
        before()
    } else {
        None
    };
    found.filter(has_wheel)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &str) -> StringRecord {
        cells.split(',').collect()
    }

    #[test]
    fn a_row_of_units_has_no_number_and_a_unit() {
        assert_eq!(units_of(&row("[s],N·m,°")), Some(["s", "Nm", "deg"].map(str::to_owned).into()));
        for data in ["1,m,deg", "ok,,fine", ",,", "nan,nan,nan"] {
            assert_eq!(units_of(&row(data)), None, "{data}");
        }
    }

    #[test]
    fn units_are_applied_or_refused() {
        let column = |name: &str| COLUMNS.iter().find(|it| it.name == name);
        let found = |name: &str, unit: &str| column_in(name, unit, column(name)).ok();
        let in_unit = |name: &str, factor| Some(OfUnit { name: name.to_owned(), factor });
        assert_eq!(found("t", "ms"), in_unit("time_ms", 1.0));
        assert_eq!(found("time_s", "ms"), None, "another than the name says");
        assert_eq!(found("roll", "deg"), in_unit("roll_deg", 1.0));
        assert_eq!(found("vo_dx", "mm"), in_unit("vo_dx_m", 1e-3));
        let rpm = std::f64::consts::PI / 30.0;
        assert_eq!(found("wheel_speed_a", "rpm"), in_unit("wheel_speed_rad_s_a", rpm));
        assert_eq!(found("a.wheel_torque", "Nm"), in_unit("a.wheel_torque_nm", 1.0));
        assert_eq!(found("roll_deg", "rad"), None, "another than the name says");
        assert_eq!(found("roll", "m"), None, "no angle");
        assert_eq!(found("note", "m"), in_unit("note", 1.0), "not known");
    }
}
