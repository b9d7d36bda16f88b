//! What a fit may be about: `data-sets`, with the wheels and soils that their documents name and what
//! some of them lack, and `fit-task`, the trials of one of them.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use grouser::document::columns::{
    Column, DRAWBAR_PULL, LOAD, SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, TORQUE,
};
use grouser::document::measurements::wheel_tests::{Quantity, Trial};
use grouser::document::measurements::{
    self, Choice, Condition, Limits, MeasurementError, MeasurementProblem,
};
use grouser::document::table::Table;
use grouser::document::{
    self, DataSetCase, Kind, LoadedDataSet, Overrides, Preset, Source, json, read_data_set,
};
use serde_json::{Value, json};

use super::fields::AskedFields;
use super::fit::{bytes_of, parsed};
use super::parts::wheel_of;
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// What was measured in a trial.
const TRIAL: [Column<Trial>; 7] = [
    SLIP_RATIO.number("Slip ratio", |it| it.slip.ratio),
    SLIP_ANGLE.number("Slip angle", |it| it.slip.angle),
    LOAD.number("Load on the wheel", |it| it.load),
    DRAWBAR_PULL.maybe("Drawbar pull", |it| read(it, Quantity::DrawbarPull)),
    SIDE_FORCE.maybe("Side force", |it| read(it, Quantity::SideForce)),
    SINKAGE.maybe("Sinkage", |it| read(it, Quantity::Sinkage)),
    TORQUE.maybe("Torque", |it| read(it, Quantity::Torque)),
];

fn read(trial: &Trial, quantity: Quantity) -> Option<f64> {
    trial.readings[quantity].map(|reading| reading.value)
}

/// Trials that a page has points for.
const MOST_SHOWN: usize = 5_000;

/// Bytes of a file that are looked at for what it lacks: its first lines.
const HEAD: u64 = 64 << 10;

/// The data sets that come with Grouser, and the CSV files of the folder.
pub(super) fn data_sets(console: &Console) -> String {
    let documents = documents_of(console);
    let files = console.folder.list_files().into_iter();
    let files = files.filter(|it| it.kind == "measurements").map(|it| {
        let document = documents.iter().find(|(file, _)| *file == it.path);
        let cases = document.map_or(&[][..], |(_, set)| &set.value.cases);
        row(&it.path, cases, |conditions| head_lacks(console, &it.path, conditions))
    });
    let presets = document::presets(Kind::DataSet).map(|preset| {
        let set = read_data_set(&Source::Preset(preset), &Overrides::none()).ok();
        let cases = set.as_ref().map_or(&[][..], |set| &set.value.cases);
        row(preset.name, cases, |conditions| preset_lacks(preset, conditions))
    });
    let rows: Vec<Value> = files.chain(presets).collect();
    json::line(&json!({ "schema": "grouser.data-sets.v1", "rows": rows })) + "\n"
}

/// The documents of data sets of the folder, each with the path of its file of measurements.
fn documents_of(console: &Console) -> Vec<(String, LoadedDataSet)> {
    let listed = console.folder.list().into_iter().filter(|it| it.kind == Kind::DataSet);
    let read = |path: String| {
        let source = console.folder.find(Kind::DataSet, &path).ok()?;
        let set = read_data_set(&source, &Overrides::none()).ok()?;
        let file = Path::new(&path).parent()?.join(&set.value.file);
        Some((file.to_str()?.replace('\\', "/"), set))
    };
    listed.filter_map(|it| read(it.path)).collect()
}

/// A data set with its parts of a wheel, and what a fit lacks in it.
fn row(
    name: &str,
    cases: &[DataSetCase],
    lacks: impl Fn(Vec<Condition>) -> Option<String>,
) -> Value {
    let part = |case: &DataSetCase| {
        json!({
            "name": case.name,
            "wheel": case.tested_name,
            "soils": case.soils.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "where": case.conditions.iter().map(ToString::to_string).collect::<Vec<_>>(),
        })
    };
    let of_wheels = cases.iter().filter(|case| case.tested.wheel().is_some());
    let conditions = of_wheels.clone().next().map(|case| case.conditions.clone());
    json!({
        "name": name,
        "parts": of_wheels.map(part).collect::<Vec<_>>(),
        "lacks": lacks(conditions.unwrap_or_default()),
    })
}

fn preset_lacks(preset: &Preset, conditions: Vec<Condition>) -> Option<String> {
    lacks(preset.rows.unwrap_or_default().as_bytes(), conditions, |_| true)
}

fn head_lacks(console: &Console, path: &str, conditions: Vec<Condition>) -> Option<String> {
    let mut head = Vec::new();
    let path = console.folder.find_map(path).ok()?;
    let file: File = console.folder.open_file(&path).ok()?;
    file.take(HEAD).read_to_end(&mut head).ok()?;
    let is_cut = head.len() as u64 == HEAD;
    if is_cut {
        // The last line may be a part of one.
        let end = head.iter().rposition(|byte| *byte == b'\n').unwrap_or(0);
        head.truncate(end);
    }
    // Rows that are wanted may come later.
    let may_come = |problem: &MeasurementProblem| {
        use MeasurementProblem::{NoRowMeets, NoRowOk, NoRows};
        is_cut && matches!(problem, NoRows | NoRowMeets { .. } | NoRowOk { .. })
    };
    lacks(&head, conditions, |problem| !may_come(problem))
}

/// What rows lack to be fitted; several wheels are a choice, and no lack.
fn lacks(
    rows: &[u8],
    conditions: Vec<Condition>,
    counts: impl Fn(&MeasurementProblem) -> bool,
) -> Option<String> {
    let choice = Choice { conditions, ..Choice::default() };
    let error = measurements::read_from("", rows, &choice).err()?;
    let is_lack = !error.is_of_several_wheels() && counts(error.problem());
    is_lack.then(|| error.problem().to_string())
}

/// The trials of a data set, before some of them are left out.
pub(super) fn task(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let data = fields.text("data")?.unwrap_or_default();
    let (wheel, rover) = (fields.text("wheel")?, fields.text("rover")?);
    let given = fields.texts("where")?;
    fields.finish()?;
    let conditions = parsed("where", &given, Condition::parse)?;
    let of_rover = || rover.map(|name| wheel_of(&console.folder, &name)).transpose();
    let wheel = wheel.map_or_else(of_rover, |it| Ok(Some(it)))?;
    let choice = Choice { conditions, wheel, limits: Limits::default() };
    let of_data = |error: MeasurementError| Refusal::of_key("data", error.to_string());
    let bytes = bytes_of(console, &data, choice.limits)?;
    let measured = measurements::read_from(&data, &*bytes, &choice).map_err(of_data)?;
    let count = measured.tests.trials.len();
    if count > MOST_SHOWN {
        let message = format!("{count} trials are more than the {MOST_SHOWN} that can be shown");
        return Err(Refusal::of_key("data", message).with_hint("`where` takes a part of them"));
    }
    Ok(Question::new(move |_, send| {
        let mut rows = json!(Table::of(&TRIAL, &measured.tests.trials));
        for (row, line) in rows.as_array_mut().into_iter().flatten().zip(&measured.lines) {
            row["line"] = json!(line);
        }
        send(json::line(&json!({
            "schema": "grouser.fit-task.v1",
            "rows": rows,
            "notes": measured.notes,
        })));
        Ok(())
    }))
}
