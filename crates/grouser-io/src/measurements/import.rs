//! Converts CSV files of other laboratories: names, units, signs and definitions of slip.

use std::io::Read;

use csv::{StringRecord, Writer};

use super::super::check::nearest;
use super::super::escape;
use super::bevameter_columns::{PLATE_COLUMNS, SHEAR_COLUMNS};
use super::columns::{self, COLUMNS, Column, Meaning};
use super::dimension::{Dimension, is_unit};
use super::error::{MeasurementError, MeasurementProblem as Problem, QUOTED};
use super::limits::Limits;
use super::row::name_of;
use super::table::{LineEnds, Table, other_delimiter};

/// How a column of ours is made from one of theirs.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapping {
    column: &'static Column,
    theirs: String,
    /// From their unit to ours, with the sign.
    factor: f64,
}

/// How another laboratory defines its slip ratio, with the rim's speed ω r and the hub's v.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SlipDefinition {
    /// (ω r − v)/max(ω r, v): ours, −1 to 1.
    #[default]
    Larger,
    /// 1 − v/(ω r): below −1 in hard braking.
    Rim,
    /// ω r/v − 1: above 1 in hard driving.
    Hub,
}

impl SlipDefinition {
    /// The ratio in our definition [-].
    ///
    /// ```text
    /// Rim, s < 0:  s/(1 − s)        Hub, s > 0:  s/(1 + s)        otherwise they agree
    /// ```
    #[must_use]
    pub fn to_ours(self, ratio: f64) -> f64 {
        match self {
            Self::Rim if ratio < 0.0 => ratio / (1.0 - ratio),
            Self::Hub if ratio > 0.0 => ratio / (1.0 + ratio),
            _ => ratio,
        }
    }
}

/// How the other file is written.
#[derive(Clone, Debug)]
pub struct Layout {
    /// What stands between two fields.
    pub delimiter: u8,
    /// Whether decimals are written with a comma.
    pub decimal_comma: bool,
    /// Lines before the header.
    pub skipped_lines: usize,
    /// How its slip is defined.
    pub slip: SlipDefinition,
    /// How much of it is read.
    pub limits: Limits,
}

impl Default for Layout {
    fn default() -> Self {
        Self {
            delimiter: b',',
            decimal_comma: false,
            skipped_lines: 0,
            slip: SlipDefinition::default(),
            limits: Limits::default(),
        }
    }
}

fn dimension(column: &Column) -> Dimension {
    use crate::measurements::wheel_tests::Quantity;
    match column.meaning {
        Meaning::SlipRatio | Meaning::TotalSlip | Meaning::PullOverLoad => Dimension::Share,
        Meaning::SlipAngle => Dimension::Angle,
        Meaning::TravelSpeed | Meaning::RimSpeed | Meaning::RimSpeedSetting => Dimension::Speed,
        Meaning::Reading(Quantity::Sinkage)
        | Meaning::Scatter(Quantity::Sinkage)
        | Meaning::BevameterLength => Dimension::Length,
        Meaning::BevameterStress => Dimension::Stress,
        Meaning::Reading(Quantity::Torque) | Meaning::Scatter(Quantity::Torque) => {
            Dimension::Moment
        }
        Meaning::Load
        | Meaning::LoadSetting
        | Meaning::OpposingSideForce
        | Meaning::Reading(_)
        | Meaning::Scatter(_) => Dimension::Force,
        Meaning::Wheel | Meaning::Trial | Meaning::Cell | Meaning::Status | Meaning::Unused => {
            Dimension::Text
        }
    }
}

/// The columns of plate and shear tests.
fn of_bevameters() -> impl Iterator<Item = &'static Column> + Clone {
    PLATE_COLUMNS.iter().chain(&SHEAR_COLUMNS)
}

/// A column of wheel, plate or shear tests.
fn known(name: &str) -> Option<&'static Column> {
    columns::known(name).or_else(|| of_bevameters().find(|column| column.name == name))
}

impl Mapping {
    /// Reads `ours=theirs`, `ours=theirs:unit` or, with the other sign, `ours=-theirs:unit`.
    ///
    /// Without a unit their column is in the one that its name ends with in brackets, `W [kgf]`, else
    /// in that of our column's name.
    ///
    /// # Errors
    /// A sentence: not written so, no such column of ours, a unit of something else.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (ours, theirs) = text
            .split_once('=')
            .ok_or_else(|| format!("'{text}' is not of the form our_column=their column[:unit]"))?;
        let ours = ours.trim();
        let column = known(ours).ok_or_else(|| {
            let names = COLUMNS.iter().chain(of_bevameters()).map(|column| column.name);
            let all: Vec<&str> = names.clone().collect();
            nearest(ours, names).map_or_else(
                || format!("`{ours}` is not a column of measurements; they are {}", all.join(", ")),
                |name| format!("`{ours}` is not a column of measurements, did you mean `{name}`?"),
            )
        })?;
        let (sign, theirs) = match theirs.trim().strip_prefix('-') {
            Some(theirs) => (-1.0, theirs.trim()),
            None => (1.0, theirs.trim()),
        };
        let (theirs, size) = match theirs.rsplit_once(':') {
            Some((name, unit)) => (name.trim(), factor_of(unit.trim(), column)?),
            None => (theirs, own_unit(theirs, column)?),
        };
        if theirs.is_empty() {
            return Err(format!("'{text}' names no column of the file"));
        }
        Ok(Self { column, theirs: theirs.to_owned(), factor: sign * size })
    }
}

/// The factor to ours from the unit in brackets at the end of a name, if there is one.
fn own_unit(theirs: &str, column: &Column) -> Result<f64, String> {
    let inside = theirs.strip_suffix([']', ')']).and_then(|it| it.rsplit_once(['[', '(']));
    let unit = inside.map(|(_, unit)| unit.trim()).filter(|_| dimension(column) != Dimension::Text);
    match unit.map(|unit| (factor_of(unit, column), is_unit(unit))) {
        Some((Ok(factor), _)) => Ok(factor),
        Some((Err(other), true)) => Err(other),
        _ => Ok(1.0),
    }
}

/// The factor from a unit to ours, if it measures what the column holds.
fn factor_of(unit: &str, column: &Column) -> Result<f64, String> {
    let size = dimension(column).size_of(unit);
    size.map(|size| size / column.unit.to_si(1.0)).map_err(|fitting| {
        if fitting.is_empty() {
            format!("`{}` is taken as it is and has no unit", column.name)
        } else {
            format!("'{unit}' is not a unit for `{}`; known: {}", column.name, fitting.join(", "))
        }
    })
}

/// Rewrites another file as one of ours, which [`read_from`](super::read_from) then checks.
///
/// Columns that are called as ours are taken along; all others need a mapping or are left out.
/// Texts are written as [`escape::cell`] says, so that no spreadsheet computes them.
///
/// # Errors
/// [`MeasurementError`] for a file that is no table, a column that is not there, or a value that
/// is no number.
pub fn import(
    label: &str,
    source: impl Read,
    mappings: &[Mapping],
    layout: &Layout,
) -> Result<Imported, MeasurementError> {
    let mut bytes = Vec::new();
    LineEnds::of(source, layout.limits)
        .read_to_end(&mut bytes)
        .map_err(|error| MeasurementError::io(label, &error, 1))?;
    let mut skipped = 0;
    for _ in 0..layout.skipped_lines {
        let rest = &bytes[skipped..];
        skipped += rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |end| end + 1);
    }
    let mut table = Table::new(label, &bytes[skipped..], layout.delimiter, layout.limits);
    let header = table.header()?;
    let plan = plan(label, &header, mappings)?;
    let is_left_out = |place: &usize| plan.iter().all(|(_, taken)| taken != place);
    let left_out = (0..header.len()).filter(is_left_out).map(|place| name_of(&header[place]));
    let left_out = left_out.filter(|name| !name.is_empty()).collect();
    // Writing to memory does not fail.
    let failed = |error: csv::Error| MeasurementError::csv(label, &error, 1);
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(plan.iter().map(|(mapping, _)| mapping.column.name)).map_err(failed)?;
    let mut record = StringRecord::new();
    while table.next_row(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line) + layout.skipped_lines as u64;
        let fields = plan.iter().map(|(mapping, place)| {
            let text = &record[*place];
            field(text, mapping, layout).map_err(|problem| {
                let comma = !layout.decimal_comma && text.contains(',');
                let hint = comma.then(|| "are decimals written with a comma?".to_owned());
                MeasurementError::at(label, line, problem).with_hint(hint)
            })
        });
        writer.write_record(fields.collect::<Result<Vec<_>, _>>()?).map_err(failed)?;
    }
    let bytes =
        writer.into_inner().map_err(|error| MeasurementError::io(label, error.error(), 1))?;
    Ok(Imported { text: String::from_utf8_lossy(&bytes).into_owned(), left_out })
}

/// A table in our columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Imported {
    /// The table, as CSV.
    pub text: String,
    /// The names of the columns that were not taken.
    pub left_out: Vec<String>,
}

/// Our columns, each with the place of theirs.
fn plan(
    label: &str,
    header: &StringRecord,
    mappings: &[Mapping],
) -> Result<Vec<(Mapping, usize)>, MeasurementError> {
    let names: Vec<String> = header.iter().map(name_of).collect();
    let mut plan = Vec::new();
    for mapping in mappings {
        let place = names.iter().position(|name| *name == mapping.theirs);
        let place = place.ok_or_else(|| {
            let hint = format!("its columns are {}", names.join(", "));
            MeasurementError::whole(label, Problem::NoSuchColumn(mapping.theirs.clone()))
                .with_hint(hint)
        })?;
        plan.push((mapping.clone(), place));
    }
    for (place, name) in names.iter().enumerate() {
        let is_ours = |(mapping, of): &(Mapping, usize)| {
            *of == place || (mapping.column.name == name && mapping.theirs != *name)
        };
        if let Some(column) = known(name)
            && !plan.iter().any(is_ours)
        {
            plan.push((Mapping { column, theirs: name.clone(), factor: 1.0 }, place));
        }
    }
    // Which of two columns of one name is meant, nobody can say.
    for (mapping, place) in &plan {
        if names.iter().enumerate().any(|(other, name)| other != *place && *name == mapping.theirs)
        {
            let problem = Problem::RepeatedColumn(mapping.theirs.clone());
            return Err(MeasurementError::whole(label, problem)
                .with_hint("rename one of them, or remove it".to_owned()));
        }
    }
    if !plan.is_empty() {
        return Ok(plan);
    }
    if header.iter().all(str::is_empty) {
        return Err(MeasurementError::whole(label, Problem::NoHeader));
    }
    let nameless = names.iter().filter(|name| name.is_empty()).count();
    let hint = match other_delimiter(&names) {
        Some(delimiter) => format!("are fields parted by the delimiter {delimiter}?"),
        None if 2 * nameless > names.len() => "does the header stand further down?".to_owned(),
        None => format!("its columns are {}; say which of them is which of ours", names.join(", ")),
    };
    Err(MeasurementError::whole(label, Problem::NothingToImport).with_hint(hint))
}

fn field(text: &str, mapping: &Mapping, layout: &Layout) -> Result<String, Problem> {
    if dimension(mapping.column) == Dimension::Text || text.is_empty() {
        return Ok(escape::cell(escape::plain(text)).into_owned());
    }
    let number = if layout.decimal_comma { text.replace(',', ".") } else { text.to_owned() };
    let value: f64 = number.parse().map_err(|_| Problem::NotANumber {
        column: mapping.theirs.clone(),
        value: escape::short_line(text, QUOTED),
    })?;
    if value.is_nan() {
        return Ok(String::new());
    }
    let ours = if mapping.factor == 1.0 { value } else { without_noise(value * mapping.factor) };
    let is_slip = matches!(mapping.column.meaning, Meaning::SlipRatio | Meaning::TotalSlip);
    Ok(if is_slip { layout.slip.to_ours(ours) } else { ours }.to_string())
}

/// A number without the last digits, which a change of units makes: 1.38 cm are 13.8 mm, not
/// 13.799999999999999.
fn without_noise(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn imported(text: &str, mappings: &[&str], layout: &Layout) -> String {
        let mappings: Vec<Mapping> =
            mappings.iter().map(|text| Mapping::parse(text).unwrap()).collect();
        import("theirs.csv", text.as_bytes(), &mappings, layout).unwrap().text
    }

    #[test]
    fn names_units_and_signs_become_ours() {
        let text = "\"Fx, kN\",z (m),load_n,lab\n0.005,0.02,24,a\n";
        let mappings = ["drawbar_pull_n=-Fx, kN:kN", "sinkage_mm=z (m):m"];
        let ours = imported(text, &mappings, &Layout::default());
        assert_eq!(ours, "drawbar_pull_n,sinkage_mm,load_n\n-5,20,24\n");
    }

    #[test]
    fn plate_and_shear_tests_have_their_own_units() {
        let text = "D (in),psi,z\n2,1,0.5\n";
        let mappings = ["plate_diameter_mm=D (in):in", "pressure_kpa=psi:psi", "sinkage_mm=z:cm"];
        let ours = imported(text, &mappings, &Layout::default());
        assert_eq!(ours, "plate_diameter_mm,pressure_kpa,sinkage_mm\n50.8,6.89475729316836,5\n");
        let text = "j,tau,sigma,repeat\n1,-2,3,a\n";
        let mappings = [
            "shear_displacement_mm=j:cm",
            "shear_stress_kpa=-tau:Pa",
            "normal_stress_kpa=sigma:bar",
        ];
        let ours = imported(text, &mappings, &Layout::default());
        let header = "shear_displacement_mm,shear_stress_kpa,normal_stress_kpa,repeat";
        assert_eq!(ours, format!("{header}\n10,0.002,300,a\n"));
    }

    /// In binary 1.38 times 10 is not 13.8.
    #[test]
    fn a_change_of_units_adds_no_digits() {
        let ours = imported("cm\n1.38\n", &["sinkage_mm=cm:cm"], &Layout::default());
        assert_eq!(ours, "sinkage_mm\n13.8\n");
    }

    #[test]
    fn semicolons_commas_percent_and_a_preamble() {
        let layout = Layout {
            delimiter: b';',
            decimal_comma: true,
            skipped_lines: 2,
            slip: SlipDefinition::Hub,
            ..Layout::default()
        };
        let text = "Laboratory\n2026\nslip;W;h\n100;24,5;\n-50;24,5;12,5\n";
        let mappings = ["slip_ratio=slip:%", "load_n=W", "sinkage_mm=h"];
        let ours = imported(text, &mappings, &layout);
        assert_eq!(ours, "slip_ratio,load_n,sinkage_mm\n0.5,24.5,\n-0.5,24.5,12.5\n");
    }

    /// All definitions from one pair of speeds.
    #[test]
    fn definitions_of_slip_agree_on_the_motion() {
        for (rim, hub) in [(1.0, 0.2), (1.0, 1.0), (0.4, 1.0), (0.05, 1.0)] {
            let ours: f64 = (rim - hub) / f64::max(rim, hub);
            assert!((SlipDefinition::Rim.to_ours(1.0 - hub / rim) - ours).abs() < 1e-12);
            assert!((SlipDefinition::Hub.to_ours(rim / hub - 1.0) - ours).abs() < 1e-12);
            assert_eq!(SlipDefinition::Larger.to_ours(ours), ours);
        }
    }

    /// Spreadsheets write lines that end with both characters.
    #[test]
    fn a_value_that_is_wrong_has_its_line() {
        let text = "Laboratory\r\n2026\r\nW\r\n20\r\nx\r\n";
        let layout = Layout { skipped_lines: 2, ..Layout::default() };
        let factor = |text: &str| Mapping::parse(text).map(|it| it.factor);
        assert_eq!(factor("load_n=W [kgf]"), Ok(9.806_65));
        assert_eq!(factor("torque_nm=-T (kgf·cm)"), Ok(-9.806_65e-2));
        assert_eq!(factor("load_n=W [scale 2]"), Ok(1.0));
        for unit in ["Nm", "N·m", "kgf·cm", "cm-kgf"] {
            let refused = factor(&format!("load_n=T [{unit}]"));
            assert!(refused.is_err_and(|it| it.contains("is not a unit for `load_n`")), "{unit}");
        }
        let mapping = Mapping::parse("load_n=W").unwrap();
        let error = import("a.csv", text.as_bytes(), &[mapping], &layout).unwrap_err();
        assert_eq!(error.line(), Some(5));
    }

    #[test]
    fn wrong_mappings_say_what_is_right() {
        for (text, part) in [
            ("drawbar=Fx", "drawbar_pull_n"),
            ("sinkage_mm=z:N", "known: m, cm, mm"),
            ("sinkage_mm", "form"),
            ("wheel=w:m", "has no unit"),
            ("load_n=-", "names no column"),
        ] {
            let error = Mapping::parse(text).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
        let mapping = Mapping::parse("load_n=Fz").unwrap();
        let mappings = [Mapping::parse("load_n=W").unwrap()];
        let some = import(
            "a.csv",
            &b"W,Load,sinkage_mm,note\n1,2,3,x\n"[..],
            &mappings,
            &Layout::default(),
        );
        let Imported { text, left_out } = some.unwrap();
        assert_eq!(
            (text.as_str(), left_out.join(" ")),
            ("load_n,sinkage_mm\n1,3\n", "Load note".into())
        );
        let error = import("a.csv", &b"Fx,W\n1,2\n"[..], &[mapping], &Layout::default());
        assert!(error.unwrap_err().to_string().contains("its columns are Fx, W"));
    }
}
