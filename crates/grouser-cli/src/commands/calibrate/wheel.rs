//! Calibration on wheel tests.

use std::path::Path;

use grouser::document::calibration::ProposalRecord;
use grouser::document::checkpoint::fingerprint;
use grouser::document::measurements::{self, Choice, Measurements};
use grouser::document::validation::GroupRecord;
use grouser::document::{SAMPLES_FILE, SoilDocument, SoilFamily, key_of, to_toml};
use grouser::error::ParameterError;
use grouser::soil::Soil;
use grouser::studies::calibration::cross_validation::{leave_one_angle_out, slip_angles, without};
use grouser::studies::calibration::wheel_test::{Discrepancies, Setup};
use grouser::studies::calibration::{
    Calibration, Fit, FitSettings, Parameter, ParameterSpace, Resolution, WheelTestExperiment,
};
use grouser::studies::validation::{Validation, ValidationStudy};
use serde::Serialize;
use serde_json::{Value, json};

use super::super::Answer;
use super::checkpoint::{Checkpoint, open_folder};
use super::next_runs::Aim;
use super::report;
use super::solve::{self, Solved};
use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output;

/// Everything that a calibration on wheel tests is made from.
pub(super) struct Problem {
    pub(super) file: String,
    pub(super) stand: StandInputs,
    pub(super) measured: Measurements,
    pub(super) family: SoilFamily,
    pub(super) settings: Value,
}

/// What it found.
pub(super) struct Found {
    pub(super) solved: Solved,
    pub(super) validation: Validation,
    pub(super) left_out: Vec<GroupRecord>,
    pub(super) target: String,
    pub(super) proposals: Vec<ProposalRecord>,
    pub(super) soil: SoilDocument,
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [grouser::document::calibration::ParameterRecord],
    discrepancies: &'a [solve::DiscrepancyRecord],
    cannot_tell_apart: &'a [String],
    target: &'a str,
    proposals: &'a [ProposalRecord],
    overall: GroupRecord,
    driven: Option<GroupRecord>,
    cross_validation: &'a [GroupRecord],
    searches_that_agree: usize,
    searches: usize,
    sampler: &'a Option<solve::SamplerRecord>,
}

pub(super) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    let folder = open_folder(args)?;
    let problem = problem(args)?;
    let checkpoint = Checkpoint::open(args, problem.settings.to_string())?;
    let found = find(args, &problem, checkpoint.as_ref())?;
    let solved = &found.solved;
    let results = Results {
        rows: &solved.records,
        discrepancies: &solved.discrepancies,
        cannot_tell_apart: &solved.questions,
        target: &found.target,
        proposals: &found.proposals,
        overall: GroupRecord::from(&found.validation.overall),
        driven: found.validation.driven.as_ref().map(GroupRecord::from),
        cross_validation: &found.left_out,
        searches_that_agree: solved.fit.searches.iter().filter(|search| search.agrees).count(),
        searches: solved.fit.searches.len(),
        sampler: &solved.sampler,
    };
    let answer = Answer::new("calibrate", problem.settings.clone(), results);
    let text = report::text(&found);
    if let Some(mut folder) = folder {
        folder.add("calibration.json", answer.to_text());
        report::add_soil(&mut folder, &problem.family, solved, &found.soil)?;
        folder.add("start-soil.toml", to_toml(problem.family.base()));
        folder.add_document("wheel.toml", &problem.stand.wheel);
        report::add(&mut folder, &problem, &found);
        folder.finish()?;
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove()?;
    }
    report::print(args, &text, solved, &answer)
}

fn problem(args: &CalibrateArgs) -> Result<Problem, Failure> {
    let (Some(data), Some(wheel)) = (&args.data, &args.wheel) else {
        return Err(Failure::Usage("--data and --wheel go together".into()));
    };
    let stand = inputs::stand(&args.soil, wheel, &args.setting)?;
    let choice = Choice { conditions: args.conditions.clone(), wheel: Some(wheel.clone()) };
    let measured = measurements::read(data, &choice)?;
    for note in &measured.notes {
        output::tell(&format!("note: {note}"));
    }
    let family = SoilFamily::new(&stand.soil.document, &args.fit)
        .map_err(|problem| Failure::Usage(format!("--fit: {problem}")))?;
    let settings = settings(args, data, &stand, &family)?;
    let file = data.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    Ok(Problem { file, stand, measured, family, settings })
}

fn settings(
    args: &CalibrateArgs,
    data: &Path,
    stand: &StandInputs,
    family: &SoilFamily,
) -> Result<Value, Failure> {
    let bytes = std::fs::read(data).map_err(Failure::at("cannot read", data))?;
    let conditions: Vec<String> = args.conditions.iter().map(ToString::to_string).collect();
    let keys = family.parameters().iter();
    let fit: Vec<Value> =
        keys.map(|key| json!({"key": key.name, "from": key.lower, "to": key.upper})).collect();
    Ok(json!({
        "data": data.display().to_string(),
        "data_fingerprint": fingerprint(&bytes),
        "where": conditions,
        "fit": fit,
        "soil": stand.soil.document,
        "wheel": stand.wheel.document,
        "gravity_m_s2": stand.gravity,
        "model": stand.theory.name(),
        "seed": args.seed,
        "steps": args.steps,
    }))
}

fn find(
    args: &CalibrateArgs,
    problem: &Problem,
    checkpoint: Option<&Checkpoint>,
) -> Result<Found, Failure> {
    let Problem { stand, measured, family, .. } = problem;
    let soil_of = |values: &[f64]| -> Result<Soil, ParameterError> { family.soil(values) };
    let setup = Setup {
        wheel: stand.wheel.value,
        theory: stand.theory,
        gravity: stand.gravity,
        soil_of: &soil_of,
        resolution: Resolution::Cells,
        discrepancies: Discrepancies::PerRegime,
    };
    let space = ParameterSpace::new(family.parameters().to_vec())?;
    let experiment = WheelTestExperiment::new(&measured.tests, setup)?;
    let aim = Aim::of(args, &measured.tests.trials)?;
    if args.cross_validate {
        check_that_angles_can_be_left_out(problem, setup, &space)?;
    }
    let rough =
        solve::fit(&Calibration::new(&experiment, space.clone())?, &FitSettings::default())?;
    // Now that a soil is known, what differing loads did to repeated trials is no scatter.
    let experiment = experiment.with_scatter_about(&rough.values)?;
    let calibration = Calibration::new(&experiment, starting_at(&space, &rough.values)?)?;
    let last = FitSettings { starts: 1, tried: 1, ..FitSettings::default() };
    let fit = Fit { searches: rough.searches, ..solve::fit(&calibration, &last)? };
    let solved = solve::solve(args, &calibration, fit, family.parameters(), checkpoint)?;
    let soil = family.soil(&solved.fit.values)?;
    let left_out = if args.cross_validate { left_out(problem, setup, &space)? } else { Vec::new() };
    let samples = solved.samples.as_ref().map(|_| SAMPLES_FILE);
    let source = format!(
        "{} fitted by Grouser {} to {} ({} trials in {} cells)",
        key_names(family),
        env!("CARGO_PKG_VERSION"),
        problem.file,
        measured.tests.trials.len(),
        measured.tests.cells.len(),
    );
    Ok(Found {
        proposals: aim.proposals(&experiment, &solved),
        validation: judge(problem, soil),
        soil: family.fitted(&solved.fit.values, &source, stand.theory, samples),
        left_out,
        target: args.target.clone(),
        solved,
    })
}

/// The same parameters, searched from other values.
fn starting_at(space: &ParameterSpace, values: &[f64]) -> Result<ParameterSpace, ParameterError> {
    let each = space.parameters().iter().zip(values);
    let moved = each.map(|(parameter, &start)| Parameter { start, ..parameter.clone() });
    ParameterSpace::new(moved.collect())
}

fn key_names(family: &SoilFamily) -> String {
    family.parameters().iter().map(key_of).collect::<Vec<_>>().join(", ")
}

fn judge(problem: &Problem, soil: Soil) -> Validation {
    let Problem { stand, measured, .. } = problem;
    ValidationStudy {
        tests: &measured.tests,
        wheel: stand.wheel.value,
        soil,
        theory: stand.theory,
        gravity: stand.gravity,
    }
    .run()
}

/// What would fail after hours of sampling fails at once.
fn check_that_angles_can_be_left_out(
    problem: &Problem,
    setup: Setup,
    space: &ParameterSpace,
) -> Result<(), Failure> {
    let tests = &problem.measured.tests;
    let angles = slip_angles(tests);
    if let [_] = angles[..] {
        return Err(Failure::Usage(
            "--cross-validate leaves out each slip angle in turn, and all trials are at one".into(),
        ));
    }
    for angle in angles {
        let others = WheelTestExperiment::new(&without(tests, angle), setup)?;
        Calibration::new(&others, space.clone()).map_err(|error| {
            let degrees = (angle.to_degrees() * 1e9).round() / 1e9;
            Failure::Usage(format!("--cross-validate: without the trials at {degrees}°, {error}"))
        })?;
    }
    Ok(())
}

/// The errors at each slip angle of the fit without it: driven, skid, both.
fn left_out(
    problem: &Problem,
    setup: Setup,
    space: &ParameterSpace,
) -> Result<Vec<GroupRecord>, Failure> {
    let tests = &problem.measured.tests;
    let bar = output::progress_bar(0);
    bar.set_message("fits without one slip angle");
    let observer = || {
        bar.inc(1);
        std::ops::ControlFlow::Continue(())
    };
    let fits = leave_one_angle_out(tests, setup, space, &FitSettings::default(), &observer)?;
    bar.finish_and_clear();
    let mut records = Vec::new();
    for left in fits {
        let mut validation = judge(problem, (setup.soil_of)(&left.fit.values)?);
        validation.groups.retain(|group| group.slip_angle == Some(left.slip_angle));
        records.extend(validation.groups.iter().map(GroupRecord::from));
    }
    Ok(records)
}
