//! `grouser traverse`

use grouser::document::escape;
use grouser::document::trajectory::{SampleRecord, TrajectoryRecord};
use grouser::simulation::Run;
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::Answer;
use crate::args::TraverseArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, csv, four_digits};
use crate::output::{self, Format};

/// Columns of the table on a terminal.
const COLUMNS: [&str; 8] =
    ["time_s", "x_m", "y_m", "yaw_deg", "slip_ratio", "slip_angle_deg", "sinkage_mm", "power_w"];
/// The outcome of a run that came to its end.
const COMPLETED: &str = "completed";
/// Lines of that table, besides the start.
const LINES: usize = 10;

pub(crate) fn run(args: &TraverseArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::traverse(args)?;
    let run = Run::new(&scenario.value)?.to_end()?;
    let record = TrajectoryRecord::new(&run, &scenario.value.rover);
    let answer = Answer::new("traverse", json!({ "scenario": scenario.document }), &record);
    if let Some(mut folder) = folder {
        folder.add("traverse.json", answer.to_text());
        folder.add("traverse.csv", sample_csv(&record.samples)?);
        folder.add("traverse.svg", chart(&record).to_svg());
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&table(&record)),
        Format::Csv => {
            tell_end(&record);
            output::print(&sample_csv(&record.samples)?)
        }
        Format::Json => output::print_json(&answer),
    }
}

/// Rows of numbers do not say that a run ended early, or why.
fn tell_end(record: &TrajectoryRecord) {
    if record.outcome != COMPLETED {
        let (outcome, time) = (record.outcome, four_digits(record.end.time_s));
        let reason = reason(record);
        output::tell(&format!("note: {outcome} after {time} s{reason}"));
    }
}

/// Why a run ended as it did, after a colon, on one line whatever its wheels are called.
fn reason(record: &TrajectoryRecord) -> String {
    record.reason.as_ref().map_or(String::new(), |reason| format!(": {}", escape::line(reason)))
}

fn object(record: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(record) {
        Ok(Value::Object(map)) => map,
        other => unreachable!("a record is an object, not {other:?}"),
    }
}

/// CSV with a row for each sample; the columns of a wheel start with its name, as in
/// `front-left.slip_ratio`. A rover that has just tipped over has empty ones.
pub(crate) fn sample_csv(samples: &[SampleRecord]) -> Result<String, Failure> {
    let fullest = samples.iter().max_by_key(|sample| sample.wheels.len());
    let columns: Vec<String> =
        fullest.map_or(Vec::new(), |sample| sample_row(sample).keys().cloned().collect());
    csv(&columns, samples.iter().map(sample_row))
}

fn sample_row(sample: &SampleRecord) -> Map<String, Value> {
    let mut row = object(sample);
    row.remove("wheels");
    for wheel in &sample.wheels {
        let mut columns = object(wheel);
        columns.remove("wheel");
        row.extend(
            columns.into_iter().map(|(key, value)| (format!("{}.{key}", wheel.wheel), value)),
        );
    }
    row
}

/// Some of the samples with the mean of their wheels, and what became of the rover.
fn table(record: &TrajectoryRecord) -> String {
    let last = record.samples.len() - 1;
    let lines = LINES.min(last);
    let shown = (0..=lines).map(|line| &record.samples[line * last / lines.max(1)]);
    let rows = shown.map(|sample| {
        let mut row = object(sample);
        let count = sample.wheels.len() as f64;
        let mut mean = |key: &str, values: &mut dyn Iterator<Item = f64>| {
            let mean = if count > 0.0 { json!(values.sum::<f64>() / count) } else { Value::Null };
            row.insert(key.into(), mean);
        };
        mean("slip_ratio", &mut sample.wheels.iter().map(|wheel| wheel.slip_ratio));
        mean("slip_angle_deg", &mut sample.wheels.iter().map(|wheel| wheel.slip_angle_deg));
        mean("sinkage_mm", &mut sample.wheels.iter().filter_map(|wheel| wheel.forces.sinkage_mm));
        row
    });
    let rows = Rows::from_maps(rows.collect());
    let end = &record.end;
    let simulation = match (record.simulation, &record.simulation_reason) {
        (_, Some(reason)) => format!("\nsimulation: {reason}"),
        ("dynamic", None) => String::new(),
        (word, None) => format!("\nsimulation: {word}"),
    };
    let reason = reason(record);
    format!(
        "{}{} after {} s{reason}; x {} m, y {} m, yaw {}°, {} J{simulation}\n",
        rows.to_table(&COLUMNS),
        record.outcome,
        four_digits(end.time_s),
        four_digits(end.x_m),
        four_digits(end.y_m),
        four_digits(end.yaw_deg),
        four_digits(record.energy_j),
    )
}

/// The path, seen from above.
fn chart(record: &TrajectoryRecord) -> Chart {
    let points = record.samples.iter().map(|sample| (sample.x_m, sample.y_m));
    Chart {
        title: "Path on the slope".into(),
        x_label: "along the contour, x [m]".into(),
        y_label: "uphill, y [m]".into(),
        series: vec![Series::new("path", Style::Line, 1, points)],
    }
}
