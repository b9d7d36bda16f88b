//! The tables of the report: our heading offsets and runs beside the paper's model and
//! measurements.

use grouser::document::columns::{SINKAGE, SLIP_RATIO, SLOPE, YAW};
use grouser::document::reading::rounded_down;
use grouser::document::unit::MM;
use grouser::studies::comparison::{Levelness, MeasuredTraverse, yaw_error};
use grouser::studies::reproduction::{Reproduction, SlopeRuns};
use serde_json::{Map, Value, json};

use crate::output::rows::{Rows, aligned};
use crate::output::text::Text;

/// A table: words for people, keys for files.
pub(crate) struct Table {
    /// A line above the table.
    pub(crate) caption: &'static str,
    /// Name of its CSV file, without ending.
    pub(crate) file: &'static str,
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Map<String, Value>>,
}

/// A column: key in files, header for people, decimals.
pub(super) struct Column {
    key: &'static str,
    header: &'static str,
    decimals: usize,
}

pub(super) const fn column(key: &'static str, header: &'static str, decimals: usize) -> Column {
    Column { key, header, decimals }
}

impl Table {
    /// The headers.
    pub(crate) fn header(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.header.to_owned()).collect()
    }

    /// The cells, rounded for reading; what does not exist is a dash.
    pub(crate) fn cells(&self) -> Vec<Vec<String>> {
        let cell = |row: &Map<String, Value>, column: &Column| match row.get(column.key) {
            Some(Value::Number(number)) => {
                number.as_f64().map_or("-".into(), |value| format!("{value:.*}", column.decimals))
            }
            Some(Value::String(text)) => text.clone(),
            _ => "-".into(),
        };
        let cells_of = |row| self.columns.iter().map(|column| cell(row, column)).collect();
        self.rows.iter().map(cells_of).collect()
    }

    /// For a terminal.
    pub(crate) fn to_text(&self) -> Text {
        aligned(&self.header(), &self.cells())
    }

    /// For a file: every digit.
    pub(crate) fn to_rows(&self) -> Rows {
        Rows::from_maps(self.rows.clone())
    }
}

pub(super) fn row_of(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        other => unreachable!("a row is an object, not {other}"),
    }
}

/// The heading offset that holds the contour: ours, that of the paper's model, and the measured
/// starts.
pub(crate) fn headings(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let heading = runs.heading.as_ref().ok();
        row_of(json!({
            (SLOPE.name): printed(runs.measured.slope),
            (YAW.name): heading.map(|a| YAW.unit.from_si(a.yaw)),
            (SLIP_RATIO.name): heading.map(|a| a.slip_ratio),
            (SINKAGE.name): heading.map(|a| SINKAGE.unit.from_si(a.mean_sinkage())),
            "paper_model_yaw_deg": printed(runs.measured.model_yaw),
            "measured_initial_yaw_deg": printed(runs.measured.initial_yaw),
            "measured_final_yaw_deg": printed(runs.measured.final_yaw),
        }))
    };
    Table {
        caption: "Heading offset that holds the contour (the paper's attitude), in degrees",
        file: "attitudes",
        columns: vec![
            column(SLOPE.name, "slope", 0),
            column(YAW.name, "Grouser", 2),
            column(SLIP_RATIO.name, "slip ratio", 3),
            column(SINKAGE.name, "sinkage [mm]", 1),
            column("paper_model_yaw_deg", "paper's model", 1),
            column("measured_initial_yaw_deg", "measured, start", 2),
            column("measured_final_yaw_deg", "measured, end", 2),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// Table 4: the experiment against the paper's model, as printed, and against ours.
pub(crate) fn table_4(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let MeasuredTraverse { slope, model_yaw, initial_yaw, final_yaw, .. } = runs.measured;
        let ours = runs.heading.as_ref().ok().map(|heading| heading.yaw);
        let percent = |measured: f64, predicted: f64| 100.0 * yaw_error(measured, predicted);
        let run = Levelness::of(&runs.from_measured_yaw);
        row_of(json!({
            (SLOPE.name): printed(slope),
            "initial_error_percent": ours.map(|ours| percent(initial_yaw, ours)),
            "final_error_percent": ours.map(|ours| percent(final_yaw, ours)),
            "rms_distance_error_percent": 100.0 * run.rms_distance_error,
            "final_distance_error_m": run.final_distance_error,
            "paper_initial_error_percent": 100.0 * runs.measured.initial_yaw_error,
            "paper_final_error_percent": 100.0 * runs.measured.final_yaw_error,
            "paper_initial_error_recomputed_percent": percent(initial_yaw, model_yaw),
            "paper_final_error_recomputed_percent": percent(final_yaw, model_yaw),
            "paper_rms_distance_error_percent": 100.0 * runs.measured.rms_distance_error,
            "paper_final_distance_error_m": runs.measured.final_distance_error,
        }))
    };
    Table {
        caption: "Table 4 of the paper, beside the same errors against Grouser's heading offset",
        file: "table4",
        columns: vec![
            column(SLOPE.name, "slope [°]", 0),
            column("paper_initial_error_percent", "initial yaw, paper [%]", 2),
            column("initial_error_percent", "initial yaw, Grouser [%]", 2),
            column("paper_final_error_percent", "final yaw, paper [%]", 2),
            column("final_error_percent", "final yaw, Grouser [%]", 2),
            column("paper_rms_distance_error_percent", "rms distance, measured [%]", 2),
            column("rms_distance_error_percent", "rms distance, simulated [%]", 2),
            column("paper_final_distance_error_m", "final distance, measured [m]", 3),
            column("final_distance_error_m", "final distance, simulated [m]", 3),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// Yaw lost during the runs: measured, and with three laws of load transfer.
pub(crate) fn yaw_loss(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let loss = |run| YAW.unit.from_si(Levelness::of(run).yaw_loss);
        row_of(json!({
            (SLOPE.name): printed(runs.measured.slope),
            "measured_yaw_loss_deg": printed(runs.measured.yaw_loss()),
            "quasi_static_yaw_loss_deg": loss(&runs.from_measured_yaw),
            "quasi_static_torque_yaw_loss_deg": loss(&runs.from_measured_yaw_with_torque),
            "complete_yaw_loss_deg": loss(&runs.from_measured_yaw_complete),
        }))
    };
    Table {
        caption: "Yaw lost on the way from the measured start, in degrees",
        file: "yaw-loss",
        columns: vec![
            column(SLOPE.name, "slope", 0),
            column("measured_yaw_loss_deg", "measured", 2),
            column("quasi_static_yaw_loss_deg", "load transfer quasi-static", 2),
            column("quasi_static_torque_yaw_loss_deg", "load transfer quasi-static-torque", 2),
            column("complete_yaw_loss_deg", "load transfer complete", 2),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// Our heading offset beside the mean of the measured yaw.
pub(crate) fn mean_yaw(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let ours = runs.heading.as_ref().ok().map(|heading| heading.yaw);
        let mean = runs.measured.mean_yaw();
        row_of(json!({
            (SLOPE.name): printed(runs.measured.slope),
            (YAW.name): ours.map(|yaw| YAW.unit.from_si(yaw)),
            "measured_mean_yaw_deg": printed(mean),
            "difference_deg": ours.map(|yaw| YAW.unit.from_si(yaw - mean)),
        }))
    };
    Table {
        caption: "Heading offset that holds the contour, beside the mean of the measured yaw, in \
                  degrees",
        file: "mean-yaw",
        columns: vec![
            column(SLOPE.name, "slope", 0),
            column(YAW.name, "Grouser", 2),
            column("measured_mean_yaw_deg", "measured, mean", 2),
            column("difference_deg", "difference", 2),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// Where the runs end that are held at the measured yaw.
pub(crate) fn measured_yaw_drift(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let end = runs.at_measured_yaw.last().state.position;
        row_of(json!({
            (SLOPE.name): printed(runs.measured.slope),
            "measured_initial_yaw_deg": printed(runs.measured.initial_yaw),
            "measured_final_yaw_deg": printed(runs.measured.final_yaw),
            "paper_final_distance_error_mm": MM.from_si(runs.measured.final_distance_error),
            "end_y_mm": MM.from_si(end.y),
        }))
    };
    Table {
        caption: "Drift at the end of a run held at the measured yaw, in millimetres, uphill \
                  positive",
        file: "measured-yaw-drift",
        columns: vec![
            column(SLOPE.name, "slope [°]", 0),
            column("measured_initial_yaw_deg", "measured yaw, start [°]", 2),
            column("measured_final_yaw_deg", "measured yaw, end [°]", 2),
            column("paper_final_distance_error_mm", "measured, unsigned [mm]", 0),
            column("end_y_mm", "Grouser [mm]", 0),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// Drift of the runs without compensation, and what compensation leaves of it.
pub(crate) fn drift(study: &Reproduction) -> Table {
    let row = |runs: &SlopeRuns| {
        let end = |run: &grouser::simulation::Trajectory| run.last().state.position;
        let compensated = runs.compensated.as_ref();
        row_of(json!({
            (SLOPE.name): printed(runs.measured.slope),
            "uncompensated_x_m": end(&runs.uncompensated).x,
            "uncompensated_y_m": end(&runs.uncompensated).y,
            "compensated_x_m": compensated.map(|run| end(run).x),
            "compensated_y_m": compensated.map(|run| end(run).y),
            "uncompensated_energy_j": runs.uncompensated.last().energy.motors,
            "compensated_energy_j": compensated.map(|run| run.last().energy.motors),
        }))
    };
    Table {
        caption: "Where the runs end",
        file: "drift",
        columns: vec![
            column(SLOPE.name, "slope [°]", 0),
            column("uncompensated_x_m", "x nose level [m]", 3),
            column("uncompensated_y_m", "y nose level [m]", 4),
            column("compensated_x_m", "x with heading offset [m]", 3),
            column("compensated_y_m", "y with heading offset [m]", 4),
            column("uncompensated_energy_j", "energy nose level [J]", 2),
            column("compensated_energy_j", "energy with heading offset [J]", 2),
        ],
        rows: study.slopes.iter().map(row).collect(),
    }
}

/// The limit slope in a sentence.
pub(crate) fn limit_sentence(study: &Reproduction) -> String {
    match study.headings.limit() {
        Ok((slope, reason)) => format!(
            "The steepest slope on which a heading holds the contour is {}°, {reason}.",
            rounded_down(SLOPE.unit.from_si(slope))
        ),
        Err(error) => format!("{error}."),
    }
}

/// Degrees as the paper prints them: 3.31, not 3.3100000000000001.
pub(super) fn printed(angle: f64) -> f64 {
    (YAW.unit.from_si(angle) * 1e6).round() / 1e6
}
