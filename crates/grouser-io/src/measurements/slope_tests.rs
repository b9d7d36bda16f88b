//! Reads a rover's measured slip and yaw on slopes from CSV.
//!
//! A row has a slope, and the slip ratio at which the rover drives there, the yaw that holds its
//! course, or both. Rows of one slope and course, or with the same `cell`, repeat each other.
//! [`COLUMNS`] lists what the columns may be called.

use std::ops::RangeInclusive;

use csv::StringRecord;
use grouser_core::contact::Slip;
use grouser_core::units::Vec2;
use grouser_core::vehicle::Rover;

use super::super::check::nearest;
use super::super::columns::{COURSE, OK, Quantity, SLIP_RATIO, SLOPE, STATUS, YAW, quantity};
use super::super::escape;
use super::super::given_file::{FileContent, GivenFile};
use super::super::unit::{DEG, ONE, Unit};
use super::error::{MeasurementError, MeasurementProblem as Problem};
use super::row::{meets, name_of, number_of, places};
use super::taken::LeftOut;
use super::{Choice, table, why_there_are_none};

/// A rover's motion on slopes, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeTests {
    /// The means of the rows that repeat each other, in the order in which they begin.
    pub points: Vec<SlopePoint>,
    /// What the file gave.
    pub given: GivenFile,
    /// What was noticed and left.
    pub notes: Vec<String>,
}

/// A rover's measured motion on one slope and course.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopePoint {
    /// The line of the file in which its first row stands.
    pub line: u64,
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
    /// Slip ratio of the wheels, by Grouser's definition [-].
    pub slip_ratio: Option<Mean>,
    /// Yaw that holds the course, *γ* [rad], positive uphill.
    pub yaw: Option<Mean>,
}

/// A mean over rows that repeat each other, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Number of rows.
    pub rows: usize,
    /// Standard deviation between the rows; `None` for a single one.
    pub deviation: Option<f64>,
}

/// A column that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeColumn {
    /// Its name in the header.
    pub name: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What its values may be, in its own unit.
    pub range: RangeInclusive<f64>,
}

/// Slip by the speed ω r of the wheel's radius without its grousers.
pub const SLIP_WITHOUT_GROUSERS: Quantity = quantity("slip_ratio_without_grousers", ONE);
const INITIAL_YAW: Quantity = quantity("initial_yaw_deg", DEG);
const FINAL_YAW: Quantity = quantity("final_yaw_deg", DEG);
const CELL: &str = "cell";
const TRIAL: &str = "trial";

const SLIP: RangeInclusive<f64> = -2.0..=2.0;
const TURN: RangeInclusive<f64> = -180.0..=180.0;
const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// Every column that is known.
pub const COLUMNS: [SlopeColumn; 10] = [
    column(SLOPE, "slope of the ground", 0.0..=60.0),
    column(
        COURSE,
        "direction of travel from the contour, positive uphill; straight up the slope, 90°, if \
         there is no such column",
        -90.0..=90.0,
    ),
    column(
        SLIP_RATIO,
        "slip ratio by the speed of the tips of the grousers: Grouser's definition",
        SLIP,
    ),
    column(
        SLIP_WITHOUT_GROUSERS,
        "instead: slip ratio by the speed of the rim without its grousers, converted when it is \
         read",
        SLIP,
    ),
    column(YAW, "yaw at which the rover holds its course, positive uphill", TURN),
    column(INITIAL_YAW, "yaw at the start of a run: not used", TURN),
    column(FINAL_YAW, "yaw at its end: not used", TURN),
    column(quantity(CELL, ONE), "rows with the same label repeat each other", ANY),
    column(quantity(TRIAL, ONE), "number of the repeat: not used", ANY),
    column(quantity(STATUS, ONE), "rows with anything but `ok` or nothing here are left out", ANY),
];

const fn column(quantity: Quantity, doc: &'static str, range: RangeInclusive<f64>) -> SlopeColumn {
    SlopeColumn { name: quantity.name, doc, unit: quantity.unit, range }
}

/// Reads a rover's measured motion on slopes.
///
/// * `label`: what messages call the source
/// * `rover`: the rover that was tested, whose grousers convert the slip
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as [`COLUMNS`] says, and if no row
/// is left.
pub fn read_slopes(
    label: &str,
    bytes: &[u8],
    choice: &Choice,
    rover: &Rover,
) -> Result<SlopeTests, MeasurementError> {
    let mut table = table::Table::new(label, bytes, b',', choice.limits);
    let names: Vec<String> = table.header()?.iter().map(name_of).collect();
    let header = Header::new(label, names, rover)?;
    let conditions = places(label, &header.names, &choice.conditions)?;
    let (mut rows, mut left_out) = (Vec::new(), None::<LeftOut>);
    let mut record = StringRecord::new();
    while table.next_row(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().map(escape::plain).eq(header.names.iter().map(String::as_str)) {
            return Err(MeasurementError::at(label, line, Problem::RepeatedHeader));
        }
        if !meets(&record, &conditions) {
            continue;
        }
        match header.text(&record, STATUS) {
            "" => {}
            status if status.eq_ignore_ascii_case(OK) => {}
            status => {
                let first = || LeftOut::first(line, status);
                left_out = Some(left_out.map_or_else(first, LeftOut::and_another));
                continue;
            }
        }
        rows.push(header.row(&record, line)?);
    }
    if rows.is_empty() {
        return Err(MeasurementError::whole(label, why_there_are_none(choice, left_out)));
    }
    if rows.iter().all(|row| row.slip_ratio.is_none() && row.yaw.is_none()) {
        return Err(MeasurementError::whole(label, Problem::NoSlopeReadings));
    }
    let notes = header.notes().into_iter().chain(left_out.iter().map(LeftOut::note));
    let notes = notes.map(|note| escape::line(&note).into_owned()).collect();
    let given = GivenFile::new(label, FileContent::SlopeTests, table.rows(), rows.len() as u64);
    Ok(SlopeTests { points: points(&rows), given, notes })
}

/// The header, understood.
struct Header<'a> {
    label: &'a str,
    names: Vec<String>,
    /// Radius without the grousers over that of their tips, of all wheels; `None` if they differ.
    radius_share: Option<f64>,
}

/// A row, in SI.
struct Row {
    line: u64,
    cell: String,
    slope: f64,
    course: f64,
    slip_ratio: Option<f64>,
    yaw: Option<f64>,
}

impl<'a> Header<'a> {
    fn new(label: &'a str, names: Vec<String>, rover: &Rover) -> Result<Self, MeasurementError> {
        let failed = |problem| MeasurementError::at(label, 1, problem);
        if names.iter().all(String::is_empty) {
            return Err(MeasurementError::whole(label, Problem::NoHeader));
        }
        let repeated = names
            .iter()
            .enumerate()
            .find(|(place, name)| !name.is_empty() && names[..*place].contains(name));
        if let Some((_, name)) = repeated {
            return Err(failed(Problem::RepeatedColumn(name.clone())));
        }
        let has = |quantity: Quantity| names.iter().any(|name| name == quantity.name);
        if has(SLIP_RATIO) && has(SLIP_WITHOUT_GROUSERS) {
            let [one, other] = [SLIP_RATIO, SLIP_WITHOUT_GROUSERS].map(|it| it.name.to_owned());
            let error = failed(Problem::CompetingColumns(one, other));
            return Err(error.with_hint("remove one of them".to_owned()));
        }
        let missing = |what, all: &[Quantity]| {
            let expected: Vec<String> = all.iter().map(|it| format!("`{}`", it.name)).collect();
            let near = names.iter().find_map(|name| {
                let meant = nearest(name, all.iter().map(|it| it.name))?;
                Some(format!("is `{name}` meant as `{meant}`?"))
            });
            let hint = table::delimiter_hint(&names).or(near);
            failed(Problem::MissingColumn { what, expected: expected.join(", ") }).with_hint(hint)
        };
        if !has(SLOPE) {
            return Err(missing("the slope", &[SLOPE]));
        }
        let readings = [SLIP_RATIO, SLIP_WITHOUT_GROUSERS, YAW];
        if !readings.into_iter().any(has) {
            return Err(missing("every reading", &readings));
        }
        let radius_share = radius_share(rover);
        if has(SLIP_WITHOUT_GROUSERS) && radius_share.is_none() {
            return Err(failed(Problem::WheelsDiffer { column: SLIP_WITHOUT_GROUSERS.name }));
        }
        Ok(Self { label, names, radius_share })
    }

    /// What stands in a column, if it is there.
    fn text<'r>(&self, record: &'r StringRecord, name: &str) -> &'r str {
        let place = self.names.iter().position(|known| known == name);
        place.and_then(|place| record.get(place)).map_or("", escape::plain)
    }

    /// The number of a column in SI, if the row has one.
    fn number(
        &self,
        record: &StringRecord,
        line: u64,
        quantity: Quantity,
    ) -> Result<Option<f64>, MeasurementError> {
        let column = COLUMNS.iter().find(|column| column.name == quantity.name);
        let range = column.map_or(&ANY, |column| &column.range);
        let text = self.text(record, quantity.name);
        number_of((self.label, line), (quantity.name, quantity.unit, range), text)
    }

    fn row(&self, record: &StringRecord, line: u64) -> Result<Row, MeasurementError> {
        let number = |quantity| self.number(record, line, quantity);
        let slope = number(SLOPE)?.ok_or_else(|| {
            let why = "a row needs the slope that it was driven on";
            let problem = Problem::MissingValue { column: SLOPE.name.to_owned(), why };
            MeasurementError::at(self.label, line, problem)
        })?;
        let slip_ratio = match (number(SLIP_RATIO)?, number(SLIP_WITHOUT_GROUSERS)?) {
            (None, Some(slip)) => self.radius_share.map(|share| at_the_tips(slip, share)),
            (slip, _) => slip,
        };
        let cell = match self.text(record, CELL) {
            "" => [SLOPE, COURSE].map(|it| self.text(record, it.name)).join("|"),
            cell => cell.to_owned(),
        };
        let course = number(COURSE)?.unwrap_or(std::f64::consts::FRAC_PI_2);
        Ok(Row { line, cell, slope, course, slip_ratio, yaw: number(YAW)? })
    }

    /// Notes on columns that are not known.
    fn notes(&self) -> Vec<String> {
        let is_known = |name: &String| COLUMNS.iter().any(|column| column.name == name);
        let unknown = self.names.iter().filter(|name| !name.is_empty() && !is_known(name));
        let note = |name: &String| match nearest(name, COLUMNS.iter().map(|column| column.name)) {
            Some(known) => format!("column `{name}` is not used; is `{known}` meant?"),
            None => format!("column `{name}` is not used"),
        };
        unknown.map(note).collect()
    }
}

/// The radius without the grousers over that of their tips [-], if it is the same for all wheels.
fn radius_share(rover: &Rover) -> Option<f64> {
    let shares = rover.mounts().iter().map(|mount| {
        let wheel = &mount.unit.wheel;
        wheel.radius / wheel.shearing_radius()
    });
    let shares: Vec<f64> = shares.collect();
    shares.iter().all(|share| share == &shares[0]).then(|| shares[0])
}

/// The slip ratio by the speed of the grousers' tips, from that by the speed of the rim without
/// them.
///
/// ```text
/// driving: v = ω r (1 − s)        braking: ω r = v (1 + s)
/// ```
///
/// * `share`: r/r_s [-]
fn at_the_tips(slip: f64, share: f64) -> f64 {
    let (rim, hub) = if slip >= 0.0 { (1.0, 1.0 - slip) } else { (1.0 + slip, 1.0) };
    Slip::of_motion(rim / share, Vec2::new(hub, 0.0)).ratio
}

/// The means of the rows that repeat each other.
fn points(rows: &[Row]) -> Vec<SlopePoint> {
    let mut cells: Vec<Vec<&Row>> = Vec::new();
    let mut places = std::collections::HashMap::new();
    for row in rows {
        let place = *places.entry(&row.cell).or_insert(cells.len());
        match cells.get_mut(place) {
            Some(cell) => cell.push(row),
            None => cells.push(vec![row]),
        }
    }
    let point = |cell: &Vec<&Row>| {
        let first = cell[0];
        SlopePoint {
            line: first.line,
            slope: first.slope,
            course: first.course,
            slip_ratio: Mean::of(cell.iter().filter_map(|row| row.slip_ratio)),
            yaw: Mean::of(cell.iter().filter_map(|row| row.yaw)),
        }
    };
    cells.iter().map(point).collect()
}

impl Mean {
    /// The mean of some values; `None` if there are no values.
    fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.collect();
        let rows = values.len();
        let value = values.iter().sum::<f64>() / rows as f64;
        let squares: f64 = values.iter().map(|it| (it - value).powi(2)).sum();
        let deviation = (rows > 1).then(|| (squares / (rows as f64 - 1.0)).sqrt());
        (rows > 0).then_some(Self { value, rows, deviation })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rim of 0.25 m that drives at slip 0.04 moves 0.96 of its way, which is 0.873 of that of
    /// tips at 0.275 m; a wheel that neither drives nor brakes at the rim drives at the tips.
    #[test]
    fn slip_at_the_tips_is_that_of_the_same_motion() {
        let share = 0.25 / 0.275;
        for (rim, tips) in [
            (0.04, 1.0 - 0.96 * share),
            (0.0, 1.0 - share),
            (1.0, 1.0),
            (1.2, 1.0 + 0.2 * share),
            (-1.0, -1.0),
            (-0.5, 0.5 / share - 1.0),
            (-0.05, 1.0 - share / 0.95),
        ] {
            let found = at_the_tips(rim, share);
            assert!((found - tips).abs() < 1e-12, "{rim}: {found}, not {tips}");
            assert!((at_the_tips(rim, 1.0) - rim).abs() < 1e-12, "{rim}: without grousers");
        }
    }

    #[test]
    fn a_mean_has_its_deviation() {
        let mean = Mean::of([0.1, 0.3].into_iter()).expect("two");
        assert_eq!((mean.value, mean.rows), (0.2, 2));
        assert!((mean.deviation.expect("two rows") - 0.02_f64.sqrt()).abs() < 1e-15);
        assert_eq!(Mean::of([0.1].into_iter()).expect("one").deviation, None);
        assert_eq!(Mean::of(std::iter::empty()), None);
    }
}
