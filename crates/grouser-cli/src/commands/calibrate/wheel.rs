//! Calibration on wheel tests.

use grouser::document::calibration::{WheelFound, WheelInputs, WheelProblem};
use grouser::document::measurements::{self, Choice, Measurements};
use grouser::document::{SoilFamily, to_toml};
use serde_json::Value;

use super::super::{Answer, add_files};
use super::checkpoint::{Checkpoint, open_folder};
use super::next_runs::aim;
use super::progress::{Progress, sampling};
use super::report;
use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output;

/// The inputs of a calibration on wheel tests.
pub(super) struct Problem {
    pub(super) file: String,
    pub(super) stand: StandInputs,
    pub(super) measured: Measurements,
    pub(super) family: SoilFamily,
    pub(super) settings: Value,
}

pub(super) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    let folder = open_folder(args)?;
    let problem = problem(args)?;
    let checkpoint = Checkpoint::open(args, problem.settings.to_string())?;
    let found = find(args, &problem, checkpoint.as_ref())?;
    let solved = &found.solved;
    output::notes(found.notes());
    let given = [problem.measured.given.clone()];
    let mut inputs = problem.settings.clone();
    add_files(&mut inputs, &given);
    let answer = Answer::new("calibrate", inputs, found.results(&args.target));
    let text = report::text(&found, &args.target) + output::answer::given(&given);
    if let Some(mut folder) = folder {
        folder.add("calibration.json", answer.to_text());
        report::add_soil(&mut folder, &problem.family, solved, &found.soil)?;
        folder.add("start-soil.toml", to_toml(problem.family.base()));
        folder.add_document("wheel.toml", &problem.stand.wheel);
        report::add(&mut folder, &problem, &found, &args.target);
        folder.finish()?;
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove()?;
    }
    report::print(args, text, solved, &answer)
}

fn problem(args: &CalibrateArgs) -> Result<Problem, Failure> {
    let (Some(data), Some(wheel)) = (&args.data, &args.wheel) else {
        return Err(Failure::Usage("--data and --wheel go together".into()));
    };
    let stand = inputs::stand(&args.soil, wheel, &args.setting)?;
    let limits = args.read.limits();
    let choice = Choice { conditions: args.conditions.clone(), wheel: Some(wheel.clone()), limits };
    let rows = measurements::Source::find(data)?;
    // Read once: of a pipe there is no second time.
    let bytes = rows.bytes(limits)?;
    let measured = measurements::read_from(&rows.label(), &*bytes, &choice)?;
    output::notes(&measured.notes);
    let family = SoilFamily::new(&stand.soil.document, &args.fit)
        .map_err(|problem| Failure::Usage(format!("--fit: {problem}")))?;
    let settings = WheelInputs {
        data: &data.display().to_string(),
        bytes: &bytes,
        conditions: &args.conditions,
        family: &family,
        soil: &stand.soil.document,
        wheel: &stand.wheel.document,
        gravity: stand.gravity,
        model: &stand.model,
        seed: args.seed,
        steps: args.steps,
    }
    .to_json();
    let file = data.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    Ok(Problem { file, stand, measured, family, settings })
}

fn find(
    args: &CalibrateArgs,
    problem: &Problem,
    checkpoint: Option<&Checkpoint>,
) -> Result<WheelFound, Failure> {
    let Problem { stand, measured, family, file, .. } = problem;
    let calibration = WheelProblem {
        family,
        measured,
        file,
        wheel: stand.wheel.value,
        model: stand.model.clone(),
        gravity: stand.gravity,
        sampling: sampling(args, checkpoint),
        aim: aim(args, &measured.tests.trials)?,
        cross_validate: args.cross_validate,
    };
    let progress = Progress::new(checkpoint);
    calibration.solve(&progress).map_err(|error| progress.failure(error))
}
