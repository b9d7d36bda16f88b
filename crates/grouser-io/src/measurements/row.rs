//! One row of a measurement file: its cells by the header's meanings, then in SI.

use std::ops::RangeInclusive;

use csv::StringRecord;

use super::super::check::nearest;
use super::super::columns::{OK, SIDE_FORCE};
use super::super::escape;
use super::super::unit::Unit;
use super::columns::{self, COLUMNS, Column, Meaning, OF_OPPOSING_SIDE_FORCES};
use super::condition::Condition;
use super::error::{MeasurementError, MeasurementProblem as Problem, QUOTED};
use super::table::other_delimiter;
use super::taken::{LeftOut, Row, Taken};
use crate::measurements::wheel_tests::{PerQuantity, Quantity, Reading};
use grouser_core::contact::Slip;
use grouser_core::elementary::wide;
use grouser_core::units::Vec2;

/// A slip in a column may differ from that of the speeds by this much [-]. Source: ours; rounding
/// and the drift of a speed within a trial make a few thousandths, another definition makes more.
const SLIP_TOLERANCE: f64 = 0.05;

/// What conditions call the line of a file in which a row stands: `line!=17` leaves out one trial. A
/// file's own column of this name comes first.
const LINE: &str = "line";

/// Two columns may have the load if they differ by no more than this share [-]. Source: ours; a
/// settled wheel's normal force is its load to a millionth, a stand's differs by several percent.
const LOAD_TOLERANCE: f64 = 0.01;

/// The header, understood.
pub(super) struct Header<'a> {
    label: &'a str,
    names: Vec<String>,
    /// The known column at each place.
    columns: Vec<Option<&'static Column>>,
    conditions: Vec<(usize, &'a Condition)>,
    /// Those on the lines in which rows stand.
    of_lines: Vec<&'a Condition>,
    side_force_opposes: bool,
}

impl<'a> Header<'a> {
    pub(super) fn new(
        label: &'a str,
        record: &StringRecord,
        conditions: &'a [Condition],
    ) -> Result<Self, MeasurementError> {
        let failed = |problem| MeasurementError::at(label, 1, problem);
        let names: Vec<String> = record.iter().map(name_of).collect();
        if names.iter().all(String::is_empty) {
            return Err(MeasurementError::whole(label, Problem::NoHeader));
        }
        let columns: Vec<_> = names.iter().map(|name| columns::known(name)).collect();
        for (place, name) in names.iter().enumerate() {
            if names[..place].contains(name) && !name.is_empty() {
                return Err(failed(Problem::RepeatedColumn(name.clone())));
            }
            let Some(column) = columns[place] else { continue };
            let rival =
                columns[..place].iter().flatten().find(|other| tell_the_same(other, column));
            if let Some(rival) = rival {
                let problem = Problem::CompetingColumns(rival.name.to_owned(), name.clone());
                return Err(failed(problem).with_hint("remove one of them".to_owned()));
            }
        }
        let is_of_lines = |it: &&Condition| it.column == LINE && !names.contains(&it.column);
        let (of_lines, others): (Vec<_>, Vec<_>) = conditions.iter().partition(is_of_lines);
        let conditions = places(label, &names, others)?;
        let side_force_opposes = names.iter().any(|name| name == OF_OPPOSING_SIDE_FORCES);
        let header = Self { label, names, columns, conditions, of_lines, side_force_opposes };
        header.check_complete()?;
        Ok(header)
    }

    fn check_complete(&self) -> Result<(), MeasurementError> {
        let has = |meaning| self.columns.iter().flatten().any(|column| column.meaning == meaning);
        let missing = |what, meanings: &[Meaning]| {
            let names = COLUMNS.iter().filter(|column| meanings.contains(&column.meaning));
            let names: Vec<String> = names.map(|column| format!("`{}`", column.name)).collect();
            let problem = Problem::MissingColumn { what, expected: names.join(", ") };
            let hint = self.hint_of_missing(meanings);
            MeasurementError::at(self.label, 1, problem).with_hint(hint)
        };
        if let Some(column) = self.names.iter().find(|name| columns::is_of_time(name)) {
            let problem = Problem::TimeSeries { column: column.clone() };
            let hint = "average each run over its steady part, from where slip and sinkage stay \
                        within their scatter; one row for each run, without the time";
            return Err(MeasurementError::at(self.label, 1, problem).with_hint(hint.to_owned()));
        }
        if !has(Meaning::Load) {
            return Err(missing("the load", &[Meaning::Load]));
        }
        let speeds = has(Meaning::TravelSpeed) && has(Meaning::RimSpeed);
        if !speeds && !has(Meaning::SlipRatio) && !has(Meaning::TotalSlip) {
            let meanings =
                [Meaning::SlipRatio, Meaning::TotalSlip, Meaning::TravelSpeed, Meaning::RimSpeed];
            return Err(missing("the slip (or both speeds)", &meanings));
        }
        let read = Quantity::ALL.iter().any(|&quantity| has(Meaning::Reading(quantity)));
        let others = [Meaning::OpposingSideForce, Meaning::PullOverLoad];
        if !read && !others.into_iter().any(has) {
            let meanings = Quantity::ALL.map(Meaning::Reading);
            return Err(missing("every reading", &meanings));
        }
        Ok(())
    }

    /// How to correct a header that lacks some columns.
    fn hint_of_missing(&self, meanings: &[Meaning]) -> String {
        if let Some(delimiter) = other_delimiter(&self.names) {
            return format!(
                "fields are parted by commas here; an import with the delimiter {delimiter} makes \
                 it so"
            );
        }
        let named = self.names.iter().zip(&self.columns).filter(|(name, _)| !name.is_empty());
        let unknown: Vec<&str> =
            named.filter(|(_, known)| known.is_none()).map(|(name, _)| name.as_str()).collect();
        let near = unknown.iter().find_map(|name| {
            let candidates = COLUMNS.iter().filter(|column| meanings.contains(&column.meaning));
            nearest(name, candidates.map(|column| column.name)).map(|known| (name, known))
        });
        match near {
            Some((name, known)) => format!("is `{name}` meant as `{known}`?"),
            None if unknown.is_empty() => {
                "an import turns files with other columns into this layout".to_owned()
            }
            None => format!(
                "not known are {}; an import turns files with other columns into this layout",
                shown(&unknown)
            ),
        }
    }

    /// Notes on columns of readings that are there, but empty.
    ///
    /// * `was_read`: whether a row has a quantity
    pub(super) fn empty_readings(&self, was_read: impl Fn(Quantity) -> bool) -> Vec<String> {
        let empty = |column: &&Column| match column.meaning {
            Meaning::Reading(quantity) => !was_read(quantity),
            Meaning::OpposingSideForce => !was_read(Quantity::SideForce),
            Meaning::PullOverLoad => !was_read(Quantity::DrawbarPull),
            _ => false,
        };
        let columns = self.columns.iter().flatten().copied().filter(empty);
        columns.map(|column| format!("column `{}` has no value in any row", column.name)).collect()
    }

    /// What is worth knowing about the header.
    pub(super) fn notes(&self) -> Vec<String> {
        // Spreadsheets leave columns without names behind the last one that was used.
        let named = self.names.iter().zip(&self.columns).filter(|(name, _)| !name.is_empty());
        let unknown =
            named.filter(|(name, column)| column.is_none() && !columns::is_of_a_band(name));
        let mut notes: Vec<String> = unknown
            .map(|(name, _)| match nearest(name, COLUMNS.iter().map(|column| column.name)) {
                Some(known) => format!("column `{name}` is not used; is `{known}` meant?"),
                None => format!("column `{name}` is not used"),
            })
            .collect();
        if self.side_force_opposes && self.names.iter().any(|name| name == SIDE_FORCE.name) {
            notes.push(format!(
                "`side_force_n` beside `{OF_OPPOSING_SIDE_FORCES}` counts as positive where it \
                 opposes the sideways motion; Grouser's sign is the other one"
            ));
        }
        notes
    }

    /// Takes away the rows that conditions on lines leave out, and says how many there were.
    pub(super) fn leave_out_lines(&self, rows: &mut Vec<Row>) -> Option<String> {
        let all = rows.len();
        let conditions: Vec<_> = self.of_lines.iter().map(|it| it.of_numbers()).collect();
        rows.retain(|row| conditions.iter().all(|is_met| is_met(row.line as f64)));
        let left_out = all - rows.len();
        (left_out > 0).then(|| format!("without {left_out} of {all} trials, by their lines"))
    }

    /// What becomes of a row.
    pub(super) fn row(&self, record: &StringRecord) -> Result<Taken, MeasurementError> {
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().map(escape::plain).eq(self.names.iter().map(String::as_str)) {
            return Err(MeasurementError::at(self.label, line, Problem::RepeatedHeader));
        }
        if !meets(record, &self.conditions) {
            return Ok(Taken::Unwanted);
        }
        let cells = Cells { header: self, record, line };
        match cells.text(Meaning::Status) {
            Some((_, status)) if !status.eq_ignore_ascii_case(OK) => {
                Ok(Taken::NotOk(LeftOut::first(line, status)))
            }
            _ => cells.row().map(Taken::Row),
        }
    }
}

/// The place of each condition's column.
pub(super) fn places<'c>(
    label: &str,
    names: &[String],
    conditions: impl IntoIterator<Item = &'c Condition>,
) -> Result<Vec<(usize, &'c Condition)>, MeasurementError> {
    let place_of = |condition: &'c Condition| {
        let place = names.iter().position(|name| *name == condition.column);
        place.map(|place| (place, condition)).ok_or_else(|| {
            let meant = nearest(&condition.column, names.iter().map(String::as_str));
            let hint = meant.map_or_else(
                || format!("the columns are {}", names.join(", ")),
                |name| format!("did you mean `{name}`?"),
            );
            let problem = Problem::NoSuchColumn(condition.column.clone());
            MeasurementError::at(label, 1, problem).with_hint(hint)
        })
    };
    conditions.into_iter().map(place_of).collect()
}

/// Whether a row meets all conditions, each at its place.
pub(super) fn meets(record: &StringRecord, conditions: &[(usize, &Condition)]) -> bool {
    conditions.iter().all(|(place, condition)| condition.is_met_by(escape::plain(&record[*place])))
}

/// A number in SI that stands in a cell. An empty cell and `nan` are a missing value.
///
/// * `range`: what it may be, in the column's own unit
pub(super) fn number_of(
    (label, line): (&str, u64),
    (name, unit, range): (&str, Unit, &RangeInclusive<f64>),
    text: &str,
) -> Result<Option<f64>, MeasurementError> {
    if text.is_empty() {
        return Ok(None);
    }
    let failed = |problem| MeasurementError::at(label, line, problem);
    let column = name.to_owned();
    let value: f64 = text.parse().map_err(|_| {
        let hint = if text.contains(',') {
            Some("write decimals with a point, and thousands without a comma".to_owned())
        } else {
            (line == 2).then(|| {
                "is this a line of units? rows of numbers follow the header at once".to_owned()
            })
        };
        let value = escape::short_line(text, QUOTED);
        failed(Problem::NotANumber { column: column.clone(), value }).with_hint(hint)
    })?;
    if value.is_nan() {
        return Ok(None);
    }
    if !range.contains(&value) {
        let (least, most) = (*range.start(), *range.end());
        return Err(failed(Problem::OutOfRange { column, value, least, most }));
    }
    Ok(Some(unit.to_si(value)))
}

/// A column's name: without the mark that some programs begin a text with, and without the
/// apostrophe that keeps a spreadsheet from computing it.
pub(super) fn name_of(cell: &str) -> String {
    escape::plain(cell.trim_start_matches('\u{feff}')).to_owned()
}

fn tell_the_same(one: &Column, other: &Column) -> bool {
    let side = |meaning| {
        matches!(meaning, Meaning::OpposingSideForce | Meaning::Reading(Quantity::SideForce))
    };
    // Two loads may agree, row by row.
    !matches!(one.meaning, Meaning::Unused | Meaning::Load)
        && (one.meaning == other.meaning || (side(one.meaning) && side(other.meaning)))
}

/// The cells of one row.
struct Cells<'a> {
    header: &'a Header<'a>,
    record: &'a StringRecord,
    line: u64,
}

impl Cells<'_> {
    fn row(&self) -> Result<Row, MeasurementError> {
        let (_, load) = self.needed(Meaning::Load, "a trial needs the load it was run at")?;
        self.check_loads()?;
        let slip_angle = self.number(Meaning::SlipAngle)?.map_or(0.0, |(_, angle)| angle);
        let slip = self.slip(slip_angle)?;
        let side_sign = match slip_angle {
            angle if angle < 0.0 => 1.0,
            _ => -1.0,
        };
        let mut readings = PerQuantity::default();
        for quantity in Quantity::ALL {
            let scatter = self.number(Meaning::Scatter(quantity))?.map(|(_, value)| value);
            let reading = self.number(Meaning::Reading(quantity))?;
            readings[quantity] = reading.map(|(_, value)| Reading { value, scatter });
        }
        if readings.drawbar_pull.is_none()
            && let Some((_, share)) = self.number(Meaning::PullOverLoad)?
        {
            readings.drawbar_pull = Some(Reading { value: share * load, scatter: None });
        }
        if let Some((_, value)) = self.number(Meaning::OpposingSideForce)? {
            let scatter = self.number(Meaning::Scatter(Quantity::SideForce))?.map(|(_, it)| it);
            readings.side_force = Some(Reading { value: side_sign * value, scatter });
        } else if self.header.side_force_opposes
            && let Some(reading) = &mut readings.side_force
        {
            reading.value *= side_sign;
        }
        let rim_speed_setting = self.number(Meaning::RimSpeedSetting)?.map(|(_, speed)| speed);
        Ok(Row {
            line: self.line,
            wheel: self.text(Meaning::Wheel).map(|(_, wheel)| wheel.to_owned()),
            cell: self.cell(),
            slip,
            slip_angle,
            rim_speed_setting,
            load,
            readings,
        })
    }

    /// Checks that all columns of the load agree.
    fn check_loads(&self) -> Result<(), MeasurementError> {
        let mut loads = Vec::new();
        for (column, text) in self.texts(Meaning::Load) {
            loads.extend(self.number_in(column, text)?.map(|load| (column, load)));
        }
        match &loads[..] {
            [(one, load), (other, another)]
                if (load - another).abs() > LOAD_TOLERANCE * load.max(*another) =>
            {
                let (column, other) = (one.name, other.name);
                let problem =
                    Problem::LoadsDiffer { column, value: *load, other, other_value: *another };
                let hint = "keep the one that the wheel carried; call the one that was set \
                            `load_setting_n`";
                let error = MeasurementError::at(self.header.label, self.line, problem);
                Err(error.with_hint(hint.to_owned()))
            }
            _ => Ok(()),
        }
    }

    /// The motion, from the best that the row has.
    fn slip(&self, slip_angle: f64) -> Result<Slip, MeasurementError> {
        let ratio = self.number(Meaning::SlipRatio)?;
        let total = self.number(Meaning::TotalSlip)?;
        let speeds = (self.number(Meaning::RimSpeed)?, self.number(Meaning::TravelSpeed)?);
        if let (Some((_, rim)), Some((_, travel))) = speeds {
            let (sin, cos) = wide::sin_cos(slip_angle);
            let slip = Slip::of_motion(rim, Vec2::new(travel * cos, travel * sin));
            self.check_slip(ratio, slip.ratio)?;
            self.check_slip(total, slip.total())?;
            return Ok(slip);
        }
        if let Some((_, ratio)) = ratio {
            return Ok(Slip::on_test_stand(ratio, slip_angle));
        }
        let why = "a trial needs its slip, or the speeds of rim and hub";
        let (_, total) = self.needed(Meaning::TotalSlip, why)?;
        let (rim, travel) = if total >= 0.0 { (1.0, 1.0 - total) } else { (1.0 + total, 1.0) };
        let (sin, cos) = wide::sin_cos(slip_angle);
        Ok(Slip::of_motion(rim, Vec2::new(travel * cos, travel * sin)))
    }

    fn check_slip(
        &self,
        written: Option<(&'static Column, f64)>,
        of_speeds: f64,
    ) -> Result<(), MeasurementError> {
        match written {
            Some((column, value)) if (value - of_speeds).abs() > SLIP_TOLERANCE => {
                let column = column.name.to_owned();
                let problem = Problem::SlipAgainstSpeeds { column, value, of_speeds };
                Err(MeasurementError::at(self.header.label, self.line, problem).with_hint(
                    "is it another definition of slip, or are the speeds in different units?"
                        .to_owned(),
                ))
            }
            _ => Ok(()),
        }
    }

    /// What rows that repeat each other have in common, as it is written.
    fn cell(&self) -> String {
        let written = |meaning| self.text(meaning).map_or("", |(_, text)| text);
        if let Some((_, cell)) = self.text(Meaning::Cell) {
            return cell.to_owned();
        }
        let mut meanings = vec![Meaning::Wheel, Meaning::SlipAngle, Meaning::LoadSetting];
        if self.text(Meaning::RimSpeedSetting).is_some() {
            meanings.push(Meaning::RimSpeedSetting);
        } else {
            let motion = [
                Meaning::SlipRatio,
                Meaning::TotalSlip,
                Meaning::RimSpeed,
                Meaning::TravelSpeed,
                Meaning::Load,
            ];
            meanings.extend(motion);
        }
        meanings.into_iter().map(written).collect::<Vec<_>>().join("|")
    }

    /// A number in SI that a row cannot do without.
    fn needed(
        &self,
        meaning: Meaning,
        why: &'static str,
    ) -> Result<(&'static Column, f64), MeasurementError> {
        self.number(meaning)?.ok_or_else(|| {
            let column = self.header.columns.iter().flatten().find(|it| it.meaning == meaning);
            let column = column.map_or("slip_ratio", |column| column.name).to_owned();
            let problem = Problem::MissingValue { column, why };
            MeasurementError::at(self.header.label, self.line, problem)
        })
    }

    /// A number in SI, where the row has one. An empty cell and `nan` are a missing value.
    fn number(&self, meaning: Meaning) -> Result<Option<(&'static Column, f64)>, MeasurementError> {
        let Some((column, text)) = self.text(meaning) else { return Ok(None) };
        Ok(self.number_in(column, text)?.map(|value| (column, value)))
    }

    fn number_in(&self, column: &Column, text: &str) -> Result<Option<f64>, MeasurementError> {
        let found = number_of(
            (self.header.label, self.line),
            (column.name, column.unit, &column.range),
            text,
        );
        found.map_err(|error| match error.problem() {
            Problem::OutOfRange { .. } => error.with_hint(hint_of_unit(column)),
            _ => error,
        })
    }

    /// A cell that is not empty.
    fn text(&self, meaning: Meaning) -> Option<(&'static Column, &str)> {
        self.texts(meaning).next()
    }

    /// All cells of a meaning that are not empty.
    fn texts(&self, meaning: Meaning) -> impl Iterator<Item = (&'static Column, &str)> {
        let columns = self.header.columns.iter().zip(self.record.iter());
        let known =
            columns.filter_map(|(column, text)| column.map(|column| (column, escape::plain(text))));
        known.filter(move |(column, text)| column.meaning == meaning && !text.is_empty())
    }
}

/// Names in a row, as many as a message bears.
fn shown(names: &[&str]) -> String {
    const MOST: usize = 6;
    let first: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > MOST { " …" } else { "" };
    format!("{}{more}", first.join(", "))
}

fn hint_of_unit(column: &Column) -> Option<String> {
    match column.meaning {
        Meaning::SlipRatio | Meaning::TotalSlip => {
            Some("a slip ratio is a share: 0.2, not 20 (percent)".to_owned())
        }
        Meaning::Load => Some("a load presses down and counts as positive, in newtons".to_owned()),
        Meaning::Reading(_) | Meaning::TravelSpeed | Meaning::RimSpeed => {
            Some("is it in the unit of the column's name?".to_owned())
        }
        _ => None,
    }
}
