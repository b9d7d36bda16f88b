//! The inputs of validations: measured tests or recorded drives, and what predicts them.

use std::path::Path;

use grouser::answers::validation::{
    DriveValidationQuestion, SlopeValidationQuestion, ValidationQuestion,
};
use grouser::document::measurements::{self, Choice};
use grouser::document::{Kind, LoadedScenario, Source, presets};
use grouser_logs::{DriveFolder, DriveFolderError};

use super::{StandInputs, balanced, log_options, stand};
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
    let options = log_options(&args.telemetry.log)?.with_odometry(args.telemetry.odometry());
    let DriveFolder { drives, given, notes, share_used, .. } =
        DriveFolder::read(folder, &scenario.value, &options)?;
    let folder = folder.display().to_string();
    Ok((DriveValidationQuestion { folder, scenario, drives, given, notes }, share_used))
}

impl From<DriveFolderError> for Failure {
    fn from(error: DriveFolderError) -> Self {
        let hint = match error {
            DriveFolderError::Log(error) => return error.into(),
            DriveFolderError::Unreadable { folder, error } => {
                return Self::at("cannot look into", &folder)(error);
            }
            DriveFolderError::NoFolder(_) => {
                let names: Vec<&str> = presets(Kind::DataSet).map(|it| it.name).collect();
                let names = names.join(", ");
                format!("a folder has a log of each drive; data sets by name are {names}")
            }
            _ => format!("names of logs end with .{}", DriveFolder::ENDINGS.join(", .")),
        };
        Self::Usage(format!("--drives {error}\nhint: {hint}"))
    }
}
