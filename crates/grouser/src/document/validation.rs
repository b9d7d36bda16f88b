//! Errors of models against measurements, as records for JSON and tables.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::columns::fit::{GROUP, column_of, motion};
use super::columns::{SLIP_ANGLE, SLIP_RATIO, YAW};
use super::unit::Unit;
use crate::studies::measurement::Quantity;
use crate::studies::slope_validation::{SlopeReference, SlopeValidation};
use crate::studies::validation::{Errors, Group, Reference};

/// A group of cells with its errors. As JSON an object with an object for each quantity; null for
/// one that was not measured.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupRecord(pub Group);

impl From<&Group> for GroupRecord {
    fn from(group: &Group) -> Self {
        Self(group.clone())
    }
}

impl Serialize for GroupRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        GROUP.iter().try_for_each(|column| column.write(&mut map, &self.0))?;
        for quantity in Quantity::ALL {
            map.serialize_entry(column_of(quantity).name, &self.errors(quantity))?;
        }
        map.end()
    }
}

impl GroupRecord {
    /// The slip angle of the cells, in the unit of its column; none for all of them.
    #[must_use]
    pub fn slip_angle(&self) -> Option<f64> {
        self.0.slip_angle.map(|angle| SLIP_ANGLE.unit.as_given(angle))
    }

    /// `driven`, `skid`, or `all`.
    #[must_use]
    pub fn motion(&self) -> &'static str {
        motion(self.0.driven)
    }

    /// The errors of a quantity.
    #[must_use]
    pub fn errors(&self, quantity: Quantity) -> Option<ErrorsRecord> {
        let unit = column_of(quantity).unit;
        self.0.errors[quantity].as_ref().map(|errors| ErrorsRecord::new(errors, unit))
    }
}

/// Errors of one quantity, in its column's unit.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ErrorsRecord {
    /// Root mean square error over the cells.
    pub rmse: f64,
    /// Mean error, prediction minus measurement.
    pub bias: f64,
    /// Coefficient of determination [-]; null where the measured values do not differ.
    pub r2: Option<f64>,
    /// Standard deviation between repeated trials; null without repeats.
    pub repeatability: Option<f64>,
    /// How many cells have the quantity.
    pub cells: usize,
    /// The largest measured value, without its sign.
    pub largest_measured: f64,
    /// The root mean square error over that [-].
    pub rmse_share: Option<f64>,
    /// The mean error over that [-].
    pub bias_share: Option<f64>,
    /// The largest error that is within the aim; null where there is no aim.
    pub aim: Option<f64>,
    /// Whether the aim is met, with a prediction for every trial; null where there is no aim.
    pub within_aim: Option<bool>,
}

impl ErrorsRecord {
    /// The errors in a unit.
    #[must_use]
    pub fn new(errors: &Errors, unit: Unit) -> Self {
        Self {
            rmse: unit.from_si(errors.rmse),
            bias: unit.from_si(errors.bias),
            r2: errors.r2,
            repeatability: errors.repeatability.map(|deviation| unit.from_si(deviation)),
            cells: errors.cells,
            largest_measured: unit.from_si(errors.largest),
            rmse_share: errors.rmse_share(),
            bias_share: errors.bias_share(),
            aim: errors.aim.map(|aim| unit.from_si(aim.limit)),
            within_aim: errors.aim.map(|aim| aim.is_met),
        }
    }
}

/// Errors of a prediction without physics.
#[derive(Clone, Debug, serde::Serialize)]
pub struct ReferenceRecord<O> {
    /// How it was predicted: `mean`, `interpolation` or `angle-left-out`.
    pub yardstick: &'static str,
    /// Errors of the driven cells; null where there are none, and for rovers.
    pub driven: Option<GroupRecord>,
    /// Errors of all cells.
    pub overall: O,
}

impl<O> ReferenceRecord<O> {
    /// The same with its errors in another form.
    #[must_use]
    pub fn map<P>(self, form: impl Fn(O) -> P) -> ReferenceRecord<P> {
        let Self { yardstick, driven, overall } = self;
        ReferenceRecord { yardstick, driven, overall: form(overall) }
    }
}

impl From<&Reference> for ReferenceRecord<GroupRecord> {
    fn from(reference: &Reference) -> Self {
        Self {
            yardstick: reference.yardstick.name(),
            driven: reference.driven.as_ref().map(GroupRecord::from),
            overall: GroupRecord::from(&reference.overall),
        }
    }
}

impl From<&SlopeReference> for ReferenceRecord<SlopeErrorsRecord> {
    fn from(reference: &SlopeReference) -> Self {
        let SlopeReference { yardstick, slip_ratio, yaw } = reference;
        let cells = [slip_ratio, yaw].into_iter().flatten().map(|errors| errors.cells);
        let overall = SlopeErrorsRecord {
            cells: cells.max().unwrap_or(0),
            not_held: 0,
            no_prediction: 0,
            slip_ratio: slip_record(slip_ratio.as_ref()),
            yaw: yaw_record(yaw.as_ref()),
        };
        Self { yardstick: yardstick.name(), driven: None, overall }
    }
}

/// Errors of a rover on slopes. As JSON it has the quantities of wheels too, as null, so that rows
/// of wheels and rovers can be read alike.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeErrorsRecord {
    /// Number of slopes.
    pub cells: usize,
    /// Number of slopes on which no heading holds the course, by the model.
    pub not_held: usize,
    /// Number of slopes on which something was measured that is not predicted, and is in no error.
    pub no_prediction: usize,
    /// Errors of the slip ratio.
    pub slip_ratio: Option<ErrorsRecord>,
    /// Errors of the yaw.
    pub yaw: Option<ErrorsRecord>,
}

impl SlopeErrorsRecord {
    /// Errors of no slope.
    pub const NONE: Self =
        Self { cells: 0, not_held: 0, no_prediction: 0, slip_ratio: None, yaw: None };
}

impl From<&SlopeValidation> for SlopeErrorsRecord {
    fn from(validation: &SlopeValidation) -> Self {
        Self {
            cells: validation.points.len(),
            not_held: validation.not_held,
            no_prediction: validation.no_prediction(),
            slip_ratio: slip_record(validation.slip_ratio.as_ref()),
            yaw: yaw_record(validation.yaw.as_ref()),
        }
    }
}

impl Serialize for SlopeErrorsRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("cells", &self.cells)?;
        map.serialize_entry("not_held", &self.not_held)?;
        map.serialize_entry("no_prediction", &self.no_prediction)?;
        for quantity in Quantity::ALL {
            map.serialize_entry(column_of(quantity).name, &None::<ErrorsRecord>)?;
        }
        map.serialize_entry(SLIP_RATIO.name, &self.slip_ratio)?;
        map.serialize_entry(YAW.name, &self.yaw)?;
        map.end()
    }
}

fn slip_record(errors: Option<&Errors>) -> Option<ErrorsRecord> {
    errors.map(|errors| ErrorsRecord::new(errors, SLIP_RATIO.unit))
}

fn yaw_record(errors: Option<&Errors>) -> Option<ErrorsRecord> {
    errors.map(|errors| ErrorsRecord::new(errors, YAW.unit))
}

/// The errors of a part of a data set: of a wheel, or of a rover.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum PartErrors {
    /// Errors of a wheel on a test stand.
    Wheel(GroupRecord),
    /// Errors of a rover on slopes.
    Slope(SlopeErrorsRecord),
}

impl PartErrors {
    /// The errors of the quantities that were measured, each with its column.
    #[must_use]
    pub fn measured(&self) -> Vec<(super::columns::Quantity, ErrorsRecord)> {
        match self {
            Self::Wheel(group) => {
                let of = |quantity| Some((column_of(quantity), group.errors(quantity)?));
                Quantity::ALL.into_iter().filter_map(of).collect()
            }
            Self::Slope(slope) => {
                let all = [(SLIP_RATIO, slope.slip_ratio), (YAW, slope.yaw)];
                all.into_iter().filter_map(|(column, errors)| Some((column, errors?))).collect()
            }
        }
    }
}
