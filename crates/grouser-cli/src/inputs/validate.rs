//! The inputs of validations: measured tests or recorded drives, and what predicts them.

use std::path::{Path, PathBuf};

use grouser::answers::validation::{
    DriveValidationQuestion, SlopeValidationQuestion, ValidationQuestion,
};
use grouser::document::given_file::GivenFile;
use grouser::document::measurements::{self, Choice};
use grouser::document::{Kind, LoadedScenario, Source, escape, presets};
use grouser::studies::drive_validation::{DriveRecorder, RecordedDrive};
use grouser_logs::TelemetryLog;

use super::{StandInputs, balanced, stand, telemetry};
use crate::args::{BalanceArgs, SettingArgs, ValidateArgs};
use crate::failure::Failure;

/// A wheel on a test stand, and the rows of a file.
pub(crate) fn validation(
    args: &ValidateArgs,
    data: &Path,
    wheel: &str,
    soil: &str,
) -> Result<ValidationQuestion, Failure> {
    let StandInputs { soil, wheel: tested, gravity, model, .. } =
        stand(soil, wheel, &args.setting)?;
    let measured = measurements::Source::find(data)?.read(&choice(args, Some(wheel)))?;
    Ok(ValidationQuestion {
        data: data.display().to_string(),
        conditions: args.conditions.clone(),
        measured,
        soil,
        wheel: tested,
        gravity,
        model,
    })
}

/// A rover, and the rows of a file of its slopes.
pub(crate) fn slope_validation(
    args: &ValidateArgs,
    data: &Path,
    rover: &String,
    soil: &String,
) -> Result<SlopeValidationQuestion, Failure> {
    let scenario = on_slopes(rover, soil, &args.setting)?;
    let source = measurements::Source::find(data)?;
    let tests = source.read_slopes(&choice(args, None), &scenario.value.rover)?;
    let (data, conditions) = (data.display().to_string(), args.conditions.clone());
    Ok(SlopeValidationQuestion { data, conditions, tests, scenario })
}

/// The scenario whose rover, soil and load transfer count on slopes.
fn on_slopes(
    rover: &String,
    soil: &String,
    setting: &SettingArgs,
) -> Result<LoadedScenario, Failure> {
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    balanced("validate", None, Some(rover), Some(soil), setting, &balance)
}

/// Which rows are wanted.
fn choice(args: &ValidateArgs, wheel: Option<&str>) -> Choice {
    let conditions = args.conditions.clone();
    Choice { conditions, wheel: wheel.map(str::to_owned), limits: args.read.limits() }
}

/// A data set that all models are ranked on: a preset, or a document.
pub(crate) fn ranked_data_set(args: &ValidateArgs, data: &Path) -> Result<Source, Failure> {
    const BOTH: &str = "one model is judged with --soil and either --wheel or --rover; a data set \
                        by its name, or its document (FILE.toml), alone ranks all models";
    let of_one_model = [
        ("--soil", args.soil.is_some()),
        ("--where", !args.conditions.is_empty()),
        ("--set", !args.setting.settings.is_empty()),
        ("--model", args.setting.model.is_some()),
        ("--gravity-m-s2", args.setting.gravity.is_some()),
    ];
    if let Some((flag, _)) = of_one_model.into_iter().find(|(_, is_given)| *is_given) {
        return Err(Failure::Usage(format!("{flag}: {BOTH}")));
    }
    let is_document = data.extension().is_some_and(|extension| extension == "toml");
    // A misspelt name is answered with the right one.
    let rows = measurements::Source::find(data)?;
    let is_preset = matches!(rows, measurements::Source::Preset { .. });
    if !is_document && !is_preset {
        // What is not there is no matter of flags.
        rows.bytes(args.read.limits())?;
        return Err(Failure::Usage(format!("--data {}: {BOTH}", data.display())));
    }
    Ok(Source::find(Kind::DataSet, &data.to_string_lossy())?)
}

/// Recorded drives, with what predicts them, and the share of their rows that was used.
///
/// * `folder`: with a log of each, in folders of any depth
pub(crate) fn drive_validation(
    args: &ValidateArgs,
    folder: &Path,
) -> Result<(DriveValidationQuestion, f64), Failure> {
    let (Some(rover), Some(soil)) = (&args.rover, &args.soil) else {
        return Err(Failure::Usage(
            "--drives: --rover and --soil say what is predicted with".to_owned(),
        ));
    };
    let scenario = on_slopes(rover, soil, &args.setting)?;
    let logs = logs_below(folder)?;
    let (mut drives, mut notes, mut first_error) = (Vec::new(), Notes::default(), None);
    let (mut given, mut rows, mut used) = (Vec::new(), 0.0, 0.0);
    for path in &logs {
        let name = path.strip_prefix(folder).unwrap_or(path).to_string_lossy().into_owned();
        match drive(path, &name, args, &scenario) {
            Ok((drive, log)) => {
                rows += drive.records as f64;
                used += log.share_used() * drive.records as f64;
                for note in log.notes() {
                    notes.add(&name, note);
                }
                let mut files = log.given().into_iter();
                given.extend(files.next().map(|log| GivenFile { file: name, ..log }));
                given.extend(files.filter(|it| !given.contains(it)).collect::<Vec<_>>());
                drives.push(drive);
            }
            Err(error) => {
                notes.add(&name, left_out(&error, path));
                first_error = first_error.or(Some(error));
            }
        }
    }
    if let (true, Some(error)) = (drives.is_empty(), first_error) {
        return Err(error);
    }
    let (folder, notes) = (folder.display().to_string(), notes.sentences());
    let share = if rows > 0.0 { used / rows } else { 1.0 };
    Ok((DriveValidationQuestion { folder, scenario, drives, given, notes }, share))
}

/// Why a log is left out, without its name, which stands before every note.
fn left_out(error: &Failure, path: &Path) -> String {
    let text = error.to_string();
    let why = text.lines().next().unwrap_or_default();
    let after = why.strip_prefix(&escape::path(path)).and_then(|it| it.split_once(": "));
    format!("left out: {}", after.map_or(why, |(_, why)| why))
}

/// Notes on logs: what is the same of many is one note.
#[derive(Default)]
struct Notes(Vec<(String, String, usize)>);

impl Notes {
    fn add(&mut self, log: &str, note: String) {
        match self.0.iter_mut().find(|(_, known, _)| *known == note) {
            Some((.., more)) => *more += 1,
            None => self.0.push((log.to_owned(), note, 0)),
        }
    }

    fn sentences(self) -> Vec<String> {
        let sentence = |(log, note, more): (String, String, usize)| match more {
            0 => format!("{log}: {note}"),
            more => format!("{log} and {more} more: {note}"),
        };
        self.0.into_iter().map(sentence).collect()
    }
}

/// A drive, and its log, read to its end.
fn drive(
    path: &Path,
    name: &str,
    args: &ValidateArgs,
    scenario: &LoadedScenario,
) -> Result<(RecordedDrive, TelemetryLog), Failure> {
    let mut log = telemetry(&[path.to_owned()], &args.telemetry, &scenario.value.rover, None)?;
    let mut recorder = DriveRecorder::new(&scenario.value);
    while let Some(record) = log.next_record()? {
        recorder.update(record);
    }
    Ok((recorder.finish(name.to_owned()), log))
}

/// What the names of logs end with.
const LOGS: [&str; 7] = ["csv", "gz", "parquet", "arrow", "arrows", "feather", "mcap"];

/// The logs below a folder, by their paths.
fn logs_below(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !folder.is_dir() {
        let names: Vec<&str> = presets(Kind::DataSet).map(|it| it.name).collect();
        return Err(Failure::Usage(format!(
            "--drives {}: there is no such folder\nhint: a folder has a log of each drive; data \
             sets by name are {}",
            escape::path(folder),
            names.join(", ")
        )));
    }
    let (mut logs, mut folders, mut others) = (Vec::new(), vec![folder.to_owned()], 0);
    while let Some(folder) = folders.pop() {
        let unreadable = || Failure::at("cannot look into", &folder);
        for entry in std::fs::read_dir(&folder).map_err(unreadable())? {
            let entry = entry.map_err(unreadable())?;
            let ending = entry.path().extension().map(|it| it.to_string_lossy().to_lowercase());
            // A link to a folder may lead back here.
            if entry.file_type().map_err(unreadable())?.is_dir() {
                folders.push(entry.path());
            } else if ending.is_some_and(|it| LOGS.contains(&it.as_str())) {
                logs.push(entry.path());
            } else {
                others += 1;
            }
        }
    }
    logs.sort();
    if logs.is_empty() {
        return Err(Failure::Usage(format!(
            "--drives {}: no log in it or below, among {others} files\nhint: names of logs end with \
             .{}",
            escape::path(folder),
            LOGS.join(", .")
        )));
    }
    Ok(logs)
}
