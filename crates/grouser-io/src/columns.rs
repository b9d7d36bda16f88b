//! The columns of results: name, unit, description and source of a result are declared in one
//! [`Column`] and nowhere else.
//!
//! A column leads to a number in SI; its unit makes of that what leaves. Tables on a terminal, CSV,
//! JSON, Parquet, Arrow and the arrays of Python are made from these columns, by way of a
//! [`Table`](super::table::Table) or number by number. A quantity with a band over samples is one
//! column too: the table has a column for each of its quantiles.

pub mod flags;
pub mod wheel;

use serde::ser::SerializeMap;

use super::cell::{Cell, ColumnKind};
use super::unit::{
    A, DEG, DEG_C, J, J_PER_M, M, M_PER_M, M_S, MM, N, NM, ONE, QUANTILES, RAD_S, S, UNITS, Unit, W,
};
use crate::statistics::{Band, Probability};

/// A result, or a setting beside results, of rows of one type.
///
/// What is a wheel's sinkage called outside the library, and in which unit is it? And a column of
/// your own: at which lever would the load make the torque?
///
/// ```
/// use grouser_core::contact::{Settled, WheelForces};
/// use grouser_io::columns::wheel::WHEEL;
/// use grouser_io::columns::{Column, number};
/// use grouser_io::unit::MM;
///
/// assert_eq!((WHEEL[0].name, WHEEL[0].unit.symbol), ("sinkage_mm", "mm"));
///
/// let lever: Column<Settled> = number("torque_lever_mm", MM, "Torque over load", |it| {
///     it.forces.torque / it.forces.normal_force
/// });
/// let forces = WheelForces { torque: 0.68, normal_force: 17.0, ..WheelForces::default() };
/// let settled = Settled { sinkage: 0.013, forces, evaluations: 1 };
/// assert_eq!(format!("{:.1} {}", lever.number(&settled), lever.unit.symbol), "40.0 mm");
/// ```
#[derive(Debug)]
pub struct Column<R> {
    /// With its unit: `sinkage_mm`.
    pub name: &'static str,
    /// Unit of the number that leaves.
    pub unit: Unit,
    /// What it is: a sentence without its unit and full stop.
    pub doc: &'static str,
    value: Value<R>,
}

/// Where a column's value comes from, in SI.
#[derive(Debug)]
enum Value<R> {
    Number(fn(&R) -> f64),
    /// A number that came in with the column's unit, and leaves as it was written.
    Given(fn(&R) -> Option<f64>),
    Maybe(fn(&R) -> Option<f64>),
    /// A reading of a stand, rounded to a ten-thousandth of its unit.
    Reading(fn(&R) -> Option<f64>),
    /// Three columns: the quantiles of a band over samples; one that is infinite is not there.
    Band(fn(&R) -> Option<Band>),
    /// Three columns: a probability and its 95 % confidence interval.
    Probability(fn(&R) -> Option<Probability>),
    /// Three columns: an estimate and its 95 % confidence interval.
    Estimate(fn(&R) -> [f64; 3]),
    /// Two columns: measured and predicted.
    Measured(fn(&R) -> [Option<f64>; 2]),
    /// Three columns: measured, its standard deviation, and predicted.
    Compared(fn(&R) -> [Option<f64>; 3]),
    /// Three columns: measured, predicted, and the residual: measured less predicted.
    Replayed(fn(&R) -> [Option<f64>; 3]),
    Whole(fn(&R) -> Option<usize>),
    Text(fn(&R) -> Option<String>),
    Words(fn(&R) -> Vec<&'static str>),
}

/// A name with a unit that columns of several tables have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// With its unit: `yaw_deg`.
    pub name: &'static str,
    /// Unit of the number that leaves.
    pub unit: Unit,
}

/// Time since the start.
pub const TIME: Quantity = quantity("time_s", S);
/// Along the contour.
pub const X: Quantity = quantity("x_m", M);
/// Uphill.
pub const Y: Quantity = quantity("y_m", M);
/// Height on a map.
pub const Z: Quantity = quantity("z_m", M);
/// Roll of the body, positive with its right side down.
pub const ROLL: Quantity = quantity("roll_deg", DEG);
/// Pitch of the body, positive with its nose up.
pub const PITCH: Quantity = quantity("pitch_deg", DEG);
/// Slope of the ground.
pub const SLOPE: Quantity = quantity("slope_deg", DEG);
/// The steepest slope.
pub const LIMIT_SLOPE: Quantity = quantity("limit_slope_deg", DEG);
/// Direction of travel from the contour.
pub const COURSE: Quantity = quantity("course_deg", DEG);
/// Yaw of the body.
pub const YAW: Quantity = quantity("yaw_deg", DEG);
/// Steering angle of a wheel, positive to the left.
pub const STEERING: Quantity = quantity("steering_deg", DEG);
/// Load on a wheel.
pub const LOAD: Quantity = quantity("load_n", N);
/// Slip ratio.
pub const SLIP_RATIO: Quantity = quantity("slip_ratio", ONE);
/// Slip angle.
pub const SLIP_ANGLE: Quantity = quantity("slip_angle_deg", DEG);
/// Angular speed of a wheel.
pub const WHEEL_SPEED: Quantity = quantity("wheel_speed_rad_s", RAD_S);
/// Sinkage.
pub const SINKAGE: Quantity = quantity("sinkage_mm", MM);
/// Drift per metre travelled.
pub const DRIFT: Quantity = quantity("drift_m_per_m", M_PER_M);
/// Force along a wheel.
pub const DRAWBAR_PULL: Quantity = quantity("drawbar_pull_n", N);
/// Force across a wheel.
pub const SIDE_FORCE: Quantity = quantity("side_force_n", N);
/// Torque.
pub const TORQUE: Quantity = quantity("torque_nm", NM);
/// Current of a motor.
pub const CURRENT: Quantity = quantity("current_a", A);
/// Temperature of a motor's winding.
pub const TEMPERATURE: Quantity = quantity("winding_temperature_degc", DEG_C);
/// Power of motors.
pub const POWER: Quantity = quantity("power_w", W);
/// Work of motors.
pub const ENERGY: Quantity = quantity("energy_j", J);
/// Work of motors per metre of way.
pub const ENERGY_PER_METRE: Quantity = quantity("energy_j_per_m", J_PER_M);
/// Slip by the total speed.
pub const TOTAL_SLIP: Quantity = quantity("slip_ratio_total_speed", ONE);
/// Rim speed that was set.
pub const RIM_SPEED_SETTING: Quantity = quantity("rim_speed_setting_m_s", M_S);
/// The probability that a heading offset holds the contour.
pub const PROBABILITY_LEVEL: Quantity = quantity("probability_level", ONE);
/// The probability that the soil carries a wheel.
pub const PROBABILITY_CARRIED: Quantity = quantity("probability_carried", ONE);
/// The probability that a run is completed.
pub const PROBABILITY_COMPLETED: Quantity = quantity("probability_completed", ONE);

/// Ends of the names of a probability and its confidence interval.
const INTERVAL: [&str; 3] = ["", "_low", "_high"];

/// The wheel–soil model of a row, where there is a row for each model.
pub const MODEL: &str = "model";

/// How many samples a band is of.
pub const DRAWS: &str = "draws";

/// The status of rows, with a result or without.
pub const STATUS: &str = "status";

/// Status of a row that has its results.
pub const OK: &str = "ok";

/// A quantity of this name, which ends with its unit.
#[must_use]
pub const fn quantity(name: &'static str, unit: Unit) -> Quantity {
    Quantity { name, unit }
}

impl Quantity {
    /// Numbers that were given in its unit, in SI.
    #[must_use]
    pub fn in_si(self, given: &[f64]) -> Vec<f64> {
        given.iter().map(|number| self.unit.to_si(*number)).collect()
    }

    /// The names of the three quantiles: 2.5 %, 50 % and 97.5 %.
    #[must_use]
    pub fn quantiles(self) -> [String; 3] {
        QUANTILES.map(|end| format!("{}{end}", self.name))
    }

    /// The names of a probability and of the ends of its 95 % confidence interval.
    #[must_use]
    pub fn interval(self) -> [String; 3] {
        INTERVAL.map(|end| format!("{}{end}", self.name))
    }

    /// The name of the measured value beside the predicted one.
    #[must_use]
    pub fn measurement(self) -> String {
        format!("measured_{}", self.name)
    }

    /// The name of what was measured less what was predicted.
    #[must_use]
    pub fn residual(self) -> String {
        format!("residual_{}", self.name)
    }

    /// The name of its standard deviation: `drawbar_pull_std_n`.
    #[must_use]
    pub fn deviation(self) -> String {
        let (stem, end) = self.name.split_at(self.stem().len());
        format!("{stem}_std{end}")
    }

    /// The name in words: `drawbar pull`.
    #[must_use]
    pub fn label(self) -> String {
        self.stem().replace('_', " ")
    }

    /// The name without its unit.
    fn stem(self) -> &'static str {
        UNITS.iter().find_map(|(end, _)| self.name.strip_suffix(end)).unwrap_or(self.name)
    }

    const fn column<R>(self, doc: &'static str, value: Value<R>) -> Column<R> {
        Column { name: self.name, unit: self.unit, doc, value }
    }

    /// A column of this quantity that every row has.
    pub const fn number<R>(self, doc: &'static str, of: fn(&R) -> f64) -> Column<R> {
        self.column(doc, Value::Number(of))
    }

    /// A column of settings, written as they were given: 15°, not 14.999999999999998°.
    pub const fn given<R>(self, doc: &'static str, of: fn(&R) -> Option<f64>) -> Column<R> {
        self.column(doc, Value::Given(of))
    }

    /// A column of this quantity that some rows do not have.
    pub const fn maybe<R>(self, doc: &'static str, of: fn(&R) -> Option<f64>) -> Column<R> {
        self.column(doc, Value::Maybe(of))
    }

    /// A column of readings of a test stand, rounded to a ten-thousandth of the unit.
    pub const fn reading<R>(self, doc: &'static str, of: fn(&R) -> Option<f64>) -> Column<R> {
        self.column(doc, Value::Reading(of))
    }

    /// Three columns: the 2.5 %, 50 % and 97.5 % quantiles of this quantity over samples.
    pub const fn band<R>(self, doc: &'static str, of: fn(&R) -> Option<Band>) -> Column<R> {
        self.column(doc, Value::Band(of))
    }

    /// Two columns: the measured and the predicted value.
    pub const fn measured<R>(self, doc: &'static str, of: fn(&R) -> [Option<f64>; 2]) -> Column<R> {
        self.column(doc, Value::Measured(of))
    }

    /// Three columns: the measured value, its standard deviation, and the predicted value.
    pub const fn compared<R>(self, doc: &'static str, of: fn(&R) -> [Option<f64>; 3]) -> Column<R> {
        self.column(doc, Value::Compared(of))
    }

    /// Three columns: measured, predicted, and measured less predicted.
    pub const fn replayed<R>(self, doc: &'static str, of: fn(&R) -> [Option<f64>; 3]) -> Column<R> {
        self.column(doc, Value::Replayed(of))
    }

    /// Three columns: a probability and the ends of its 95 % confidence interval.
    pub const fn probability<R>(
        self,
        doc: &'static str,
        of: fn(&R) -> Option<Probability>,
    ) -> Column<R> {
        self.column(doc, Value::Probability(of))
    }

    /// Three columns: an estimate and the ends of its 95 % confidence interval.
    pub const fn estimate<R>(self, doc: &'static str, of: fn(&R) -> [f64; 3]) -> Column<R> {
        self.column(doc, Value::Estimate(of))
    }
}

/// A column of numbers.
pub const fn number<R>(
    name: &'static str,
    unit: Unit,
    doc: &'static str,
    of: fn(&R) -> f64,
) -> Column<R> {
    quantity(name, unit).number(doc, of)
}

/// A column of numbers some of which are not there.
pub const fn maybe<R>(
    name: &'static str,
    unit: Unit,
    doc: &'static str,
    of: fn(&R) -> Option<f64>,
) -> Column<R> {
    quantity(name, unit).maybe(doc, of)
}

/// A column of counts.
pub const fn whole<R>(
    name: &'static str,
    doc: &'static str,
    of: fn(&R) -> Option<usize>,
) -> Column<R> {
    quantity(name, ONE).column(doc, Value::Whole(of))
}

/// A column of words or sentences.
pub const fn text<R>(
    name: &'static str,
    doc: &'static str,
    of: fn(&R) -> Option<String>,
) -> Column<R> {
    quantity(name, ONE).column(doc, Value::Text(of))
}

/// A column of names of a closed list.
pub const fn words<R>(
    name: &'static str,
    doc: &'static str,
    of: fn(&R) -> Vec<&'static str>,
) -> Column<R> {
    quantity(name, ONE).column(doc, Value::Words(of))
}

impl<R> Column<R> {
    /// Its names in a table: one, or one for each quantile.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let quantity = quantity(self.name, self.unit);
        match self.value {
            Value::Band(_) => quantity.quantiles().into(),
            Value::Probability(_) | Value::Estimate(_) => quantity.interval().into(),
            Value::Measured(_) => vec![quantity.measurement(), self.name.into()],
            Value::Compared(_) => {
                vec![quantity.measurement(), quantity.deviation(), self.name.into()]
            }
            Value::Replayed(_) => {
                vec![quantity.measurement(), self.name.into(), quantity.residual()]
            }
            _ => vec![self.name.into()],
        }
    }

    /// How many names it has.
    fn ends(&self) -> usize {
        match self.value {
            Value::Band(_)
            | Value::Probability(_)
            | Value::Estimate(_)
            | Value::Compared(_)
            | Value::Replayed(_) => 3,
            Value::Measured(_) => 2,
            _ => 1,
        }
    }

    /// What stands in it.
    #[must_use]
    pub fn kind(&self) -> ColumnKind {
        match self.value {
            Value::Whole(_) => ColumnKind::Whole,
            Value::Text(_) => ColumnKind::Text,
            Value::Words(_) => ColumnKind::Words,
            _ => ColumnKind::Float,
        }
    }

    /// The number of a row, in the column's unit; NaN, as in arrays, if there is no number.
    #[must_use]
    pub fn number(&self, row: &R) -> f64 {
        match self.value {
            Value::Number(of) => self.unit.from_si(of(row)),
            _ => match self.cell(Some(row), 0) {
                Cell::Float(value) => value.unwrap_or(f64::NAN),
                Cell::Whole(value) => value.map_or(f64::NAN, |count| count as f64),
                Cell::Text(_) | Cell::Words(_) => f64::NAN,
            },
        }
    }

    /// What a row has under one of the [`names`](Self::names); nothing if there is no row.
    pub(crate) fn cell(&self, row: Option<&R>, end: usize) -> Cell {
        let Some(row) = row else { return Cell::none(self.kind()) };
        let unit = self.unit;
        let float = |value: Option<f64>| Cell::Float(value.map(|value| unit.from_si(value)));
        match self.value {
            Value::Number(of) => float(Some(of(row))),
            Value::Given(of) => Cell::Float(of(row).map(|value| unit.as_given(value))),
            Value::Maybe(of) => float(of(row)),
            Value::Reading(of) => Cell::Float(of(row).map(|value| rounded(unit.from_si(value)))),
            Value::Band(of) => {
                let quantile = of(row).map(|it| [it.low, it.median, it.high][end]);
                float(quantile.filter(|value| value.is_finite()))
            }
            Value::Probability(of) => float(of(row).map(|it| {
                let (low, high) = it.interval();
                [it.estimate(), low, high][end]
            })),
            Value::Estimate(of) => float(Some(of(row)[end])),
            Value::Measured(of) => float(of(row)[end]),
            Value::Compared(of) | Value::Replayed(of) => float(of(row)[end]),
            Value::Whole(of) => Cell::Whole(of(row).map(|count| count as u64)),
            Value::Text(of) => Cell::Text(of(row)),
            Value::Words(of) => Cell::Words(of(row).into_iter().map(Into::into).collect()),
        }
    }

    /// Writes a row's value as an entry of an object of JSON, or several.
    ///
    /// # Errors
    /// The serializer's.
    pub fn write<M: SerializeMap>(&self, map: &mut M, row: &R) -> Result<(), M::Error> {
        if self.ends() == 1 {
            return map.serialize_entry(self.name, &self.cell(Some(row), 0));
        }
        let mut names = self.names().into_iter().enumerate();
        names.try_for_each(|(end, name)| map.serialize_entry(&name, &self.cell(Some(row), end)))
    }

    /// The cells of a row under all its names.
    pub fn cells<'r>(&'r self, row: &'r R) -> impl Iterator<Item = Cell> + 'r {
        (0..self.ends()).map(|end| self.cell(Some(row), end))
    }
}

/// To a ten-thousandth: finer than any stand reads, coarse enough for the same file on every
/// machine. Zero has no sign.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}
