//! Theories beside measurements, in the words of tables, JSON and CSV.

use serde::Serialize;

use super::measurements::Measurements;
use super::study::OK;
use crate::studies::measurement::{PerQuantity, Quantity};
use crate::studies::validation::{CellComparison, Comparison, Errors, Group, Validation};

/// Factor from the SI unit of a quantity to the unit in its column's name.
fn from_si(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Sinkage => 1e3,
        Quantity::DrawbarPull | Quantity::SideForce | Quantity::Torque => 1.0,
    }
}

/// The name of a quantity's column.
#[must_use]
pub fn column_of(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::DrawbarPull => "drawbar_pull_n",
        Quantity::SideForce => "side_force_n",
        Quantity::Sinkage => "sinkage_mm",
        Quantity::Torque => "torque_nm",
    }
}

/// Errors of a group of cells; a quantity that was not measured is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupRecord {
    /// Slip angle of the cells [°]; null for all of them.
    pub slip_angle_deg: Option<f64>,
    /// `driven`, `skid`, or `all`.
    pub motion: &'static str,
    /// How many cells there are.
    pub cells: usize,
    /// How many trials they have.
    pub trials: usize,
    /// How many trials the soil cannot carry, says the theory; they are in no error.
    pub unsettled_trials: usize,
    /// Errors of the drawbar pull [N].
    pub drawbar_pull_n: Option<ErrorsRecord>,
    /// Errors of the side force [N].
    pub side_force_n: Option<ErrorsRecord>,
    /// Errors of the sinkage [mm].
    pub sinkage_mm: Option<ErrorsRecord>,
    /// Errors of the torque [N·m].
    pub torque_nm: Option<ErrorsRecord>,
}

/// Errors of one quantity, in its column's unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
}

impl ErrorsRecord {
    fn new(errors: &Errors, factor: f64) -> Self {
        Self {
            rmse: errors.rmse * factor,
            bias: errors.bias * factor,
            r2: errors.r2,
            repeatability: errors.repeatability.map(|deviation| deviation * factor),
            cells: errors.cells,
        }
    }
}

impl From<&Group> for GroupRecord {
    fn from(group: &Group) -> Self {
        let errors = PerQuantity::from_fn(|quantity| {
            group.errors[quantity].map(|errors| ErrorsRecord::new(&errors, from_si(quantity)))
        });
        Self {
            slip_angle_deg: group.slip_angle.map(whole_degrees),
            motion: motion(group.driven),
            cells: group.cells,
            trials: group.trials,
            unsettled_trials: group.unsettled,
            drawbar_pull_n: errors.drawbar_pull,
            side_force_n: errors.side_force,
            sinkage_mm: errors.sinkage,
            torque_nm: errors.torque,
        }
    }
}

impl GroupRecord {
    /// The errors of a quantity.
    #[must_use]
    pub fn errors(&self, quantity: Quantity) -> Option<&ErrorsRecord> {
        match quantity {
            Quantity::DrawbarPull => self.drawbar_pull_n.as_ref(),
            Quantity::SideForce => self.side_force_n.as_ref(),
            Quantity::Sinkage => self.sinkage_mm.as_ref(),
            Quantity::Torque => self.torque_nm.as_ref(),
        }
    }
}

fn motion(driven: Option<bool>) -> &'static str {
    match driven {
        Some(true) => "driven",
        Some(false) => "skid",
        None => "all",
    }
}

/// 15, not 14.999999999999998.
fn whole_degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9
}

/// A cell's means, measured and predicted; what was not measured is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CellRecord {
    /// Slip angle [°].
    pub slip_angle_deg: f64,
    /// `driven` or `skid`.
    pub motion: &'static str,
    /// Slip by the total speed [-].
    pub slip_ratio_total_speed: f64,
    /// Load, the mean over the trials [N].
    pub load_n: f64,
    /// Rim speed that was set [m/s].
    pub rim_speed_setting_m_s: Option<f64>,
    /// How many trials it has.
    pub trials: usize,
    /// How many of them the soil cannot carry, says the theory.
    pub unsettled_trials: usize,
    /// Measured drawbar pull [N].
    pub measured_drawbar_pull_n: Option<f64>,
    /// Standard deviation of the measured drawbar pull between the trials, or within a single one [N].
    pub drawbar_pull_std_n: Option<f64>,
    /// Predicted drawbar pull [N].
    pub drawbar_pull_n: Option<f64>,
    /// Measured side force [N].
    pub measured_side_force_n: Option<f64>,
    /// Standard deviation of the measured side force between the trials, or within a single one [N].
    pub side_force_std_n: Option<f64>,
    /// Predicted side force [N].
    pub side_force_n: Option<f64>,
    /// Measured sinkage [mm].
    pub measured_sinkage_mm: Option<f64>,
    /// Standard deviation of the measured sinkage between the trials, or within a single one [mm].
    pub sinkage_std_mm: Option<f64>,
    /// Predicted sinkage [mm].
    pub sinkage_mm: Option<f64>,
    /// Measured torque [N·m].
    pub measured_torque_nm: Option<f64>,
    /// Standard deviation of the measured torque between the trials, or within a single one [N·m].
    pub torque_std_nm: Option<f64>,
    /// Predicted torque [N·m].
    pub torque_nm: Option<f64>,
}

impl From<&CellComparison> for CellRecord {
    fn from(cell: &CellComparison) -> Self {
        let value = |quantity: Quantity, of: fn(&Comparison) -> Option<f64>| {
            let value = cell.quantities[quantity].as_ref().and_then(of);
            value.map(|value| value * from_si(quantity))
        };
        let measured = |quantity| value(quantity, |it| Some(it.measured));
        let deviation = |quantity| value(quantity, |it| it.repeatability.or(it.scatter));
        let predicted = |quantity| value(quantity, |it| Some(it.predicted));
        Self {
            slip_angle_deg: whole_degrees(cell.slip_angle),
            motion: motion(Some(cell.driven)),
            slip_ratio_total_speed: cell.total_slip,
            load_n: cell.load,
            rim_speed_setting_m_s: cell.rim_speed,
            trials: cell.trials,
            unsettled_trials: cell.unsettled,
            measured_drawbar_pull_n: measured(Quantity::DrawbarPull),
            drawbar_pull_std_n: deviation(Quantity::DrawbarPull),
            drawbar_pull_n: predicted(Quantity::DrawbarPull),
            measured_side_force_n: measured(Quantity::SideForce),
            side_force_std_n: deviation(Quantity::SideForce),
            side_force_n: predicted(Quantity::SideForce),
            measured_sinkage_mm: measured(Quantity::Sinkage),
            sinkage_std_mm: deviation(Quantity::Sinkage),
            sinkage_mm: predicted(Quantity::Sinkage),
            measured_torque_nm: measured(Quantity::Torque),
            torque_std_nm: deviation(Quantity::Torque),
            torque_nm: predicted(Quantity::Torque),
        }
    }
}

/// A trial and what the theory makes of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TrialRecord {
    /// The line of the measurement file.
    pub line: u64,
    /// Slip angle [°].
    pub slip_angle_deg: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Load [N].
    pub load_n: f64,
    /// Measured drawbar pull [N].
    pub measured_drawbar_pull_n: Option<f64>,
    /// Predicted drawbar pull [N].
    pub drawbar_pull_n: Option<f64>,
    /// Measured side force [N].
    pub measured_side_force_n: Option<f64>,
    /// Predicted side force [N].
    pub side_force_n: Option<f64>,
    /// Measured sinkage [mm].
    pub measured_sinkage_mm: Option<f64>,
    /// Predicted sinkage [mm].
    pub sinkage_mm: Option<f64>,
    /// Measured torque [N·m].
    pub measured_torque_nm: Option<f64>,
    /// Predicted torque [N·m].
    pub torque_nm: Option<f64>,
    /// `ok`, or why there is no prediction.
    pub status: String,
}

/// Every trial with its prediction, in the order of the file.
#[must_use]
pub fn trials(measurements: &Measurements, validation: &Validation) -> Vec<TrialRecord> {
    let trials = measurements.tests.trials.iter().zip(&measurements.lines);
    let record = |((trial, line), prediction): ((_, &u64), &Result<_, _>)| {
        let trial: &crate::studies::measurement::Trial = trial;
        let measured = |quantity: Quantity| {
            trial.readings[quantity].map(|reading| reading.value * from_si(quantity))
        };
        let settled: Option<&crate::contact::Settled> = prediction.as_ref().ok();
        let predicted =
            |quantity: Quantity| settled.map(|settled| quantity.of(settled) * from_si(quantity));
        TrialRecord {
            line: *line,
            slip_angle_deg: trial.slip.angle.to_degrees(),
            slip_ratio: trial.slip.ratio,
            load_n: trial.load,
            measured_drawbar_pull_n: measured(Quantity::DrawbarPull),
            drawbar_pull_n: predicted(Quantity::DrawbarPull),
            measured_side_force_n: measured(Quantity::SideForce),
            side_force_n: predicted(Quantity::SideForce),
            measured_sinkage_mm: measured(Quantity::Sinkage),
            sinkage_mm: predicted(Quantity::Sinkage),
            measured_torque_nm: measured(Quantity::Torque),
            torque_nm: predicted(Quantity::Torque),
            status: match prediction {
                Ok(_) => OK.to_owned(),
                Err(error) => crate::contact::SettleError::to_string(error),
            },
        }
    };
    trials.zip(&validation.predictions).map(record).collect()
}
