//! `grouser validate --rover`: errors of a wheel–soil model against a rover's measured slip and yaw
//! on slopes.

use grouser_draw::chart::Drawable;
use std::path::Path;

use grouser::document::LoadedScenario;
use grouser::document::columns::{SLIP_RATIO, YAW, slope};
use grouser::document::measurements::slope_tests::{SlopePoint, SlopeTests};
use grouser::document::measurements::{self, Choice};
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::document::validation::{ErrorsRecord, ReferenceRecord, SlopeErrorsRecord};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::slope_validation::{SlopeValidation, SlopeValidationStudy};
use serde::Serialize;
use serde_json::{Value, json};

use super::super::Answer;
use super::super::strict;
use super::figures;
use crate::args::{StrictArgs, ValidateArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, aligned};
use crate::output::text::Text;
use crate::output::{self, Format};
use crate::report::REPORT;
use crate::report::page::Page;

#[derive(Serialize)]
struct Results<'a> {
    overall: &'a SlopeErrorsRecord,
    yardsticks: &'a [ReferenceRecord<SlopeErrorsRecord>],
    rows: &'a Table,
    notes: &'a [String],
}

/// One model with one soil and one rover on one file.
pub(super) fn run(
    args: &ValidateArgs,
    data: &Path,
    rover: &String,
    soil: &String,
) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::on_slopes(rover, soil, &args.setting)?;
    let choice =
        Choice { conditions: args.conditions.clone(), wheel: None, limits: args.read.limits() };
    let source = measurements::Source::find(data)?;
    let tests = source.read_slopes(&choice, &scenario.value.rover)?;
    for note in &tests.notes {
        output::message(&format!("note: {note}"));
    }
    let heading = HeadingStudy::of(&scenario.value);
    let validation = SlopeValidationStudy { tests: &tests, heading: &heading }.run()?;
    let table = slope::slopes(&validation.points);
    let flags = validation.points.iter().map(|point| &*point.findings);
    strict::check(&StrictArgs { strict: args.strict }, flags, &table, &slope::SETTINGS)?;
    let rows = Rows::of_table(&table);
    let yardsticks: Vec<_> = validation.references.iter().map(ReferenceRecord::from).collect();
    let overall = SlopeErrorsRecord::from(&validation);
    let results =
        Results { overall: &overall, yardsticks: &yardsticks, rows: &table, notes: &tests.notes };
    let answer = Answer::new("validate", settings(args, data, &scenario, &tests), results);
    let slopes = rows.to_table(&slope::brief(&validation.points));
    let text = text_of(slopes, &validation, &overall, &yardsticks);
    if let Some(mut folder) = folder {
        folder.add("validation.json", answer.to_text());
        folder.add("validation.csv", rows.to_csv()?);
        folder.add("validation.txt", text.to_string());
        folder.add(REPORT, html(&scenario, &tests, &validation, &text));
        add_figures(&mut folder, &validation);
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(text),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// The page: the errors, every slope, the figures.
///
/// * `text`: slopes and errors, as they are printed
fn html(
    scenario: &LoadedScenario,
    tests: &SlopeTests,
    validation: &SlopeValidation,
    text: &Text,
) -> String {
    let mut page = Page::new("Measured and predicted on slopes");
    page.list([
        format!("rover: {}", scenario.document.name_of("rover")),
        format!("soil: {}", scenario.document.name_of("soil")),
        format!("wheel–soil model: {}", scenario.value.model.name()),
    ]);
    page.list(&tests.notes);
    page.heading("Every slope, and the errors");
    page.code(&text.to_string());
    page.heading("Figures");
    for figure in figures::of_slopes(validation) {
        page.drawing(&figure.chart.to_svg(), figure.caption);
    }
    page.flags(validation.points.iter().flat_map(|point| &*point.findings));
    page.heading("Assumptions in force");
    page.list(&scenario.assumptions);
    page.document("scenario.toml", &scenario.to_toml());
    page.to_html()
}

fn add_figures(folder: &mut OutputFolder, validation: &SlopeValidation) {
    for figure in figures::of_slopes(validation) {
        folder.add(format!("figures/{}.svg", figure.file), figure.chart.to_svg());
    }
}

fn settings(
    args: &ValidateArgs,
    data: &Path,
    scenario: &LoadedScenario,
    tests: &SlopeTests,
) -> Value {
    let conditions: Vec<String> = args.conditions.iter().map(ToString::to_string).collect();
    let document = &scenario.document;
    json!({
        "data": data.display().to_string(),
        "where": conditions,
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "model": scenario.value.model.name(),
        "slopes": tests.points.len(),
    })
}

/// For people: every slope, then the errors beside those of the yardsticks, and what could not be
/// predicted.
fn text_of(
    slopes: Text,
    validation: &SlopeValidation,
    overall: &SlopeErrorsRecord,
    yardsticks: &[ReferenceRecord<SlopeErrorsRecord>],
) -> Text {
    let mut lines = Vec::new();
    let mut add = |of: &str, errors: &SlopeErrorsRecord| {
        for (name, measured, errors) in quantities(validation, errors) {
            lines.push(error_row(of, name, measured, errors.as_ref()));
        }
    };
    add("model", overall);
    for yardstick in yardsticks {
        add(yardstick.yardstick, &yardstick.overall);
    }
    let errors = aligned(&ERRORS.map(str::to_owned), &lines);
    let missing = match overall.no_prediction {
        0 => String::new(),
        missing => format!(
            "{missing} of {} slopes have no prediction: no heading holds the course there. They are in no error of \
             the model, but in those of the predictions without physics.\n",
            overall.cells
        ),
    };
    slopes + "\n" + errors + missing
}

/// The columns of the errors.
const ERRORS: [&str; 8] = [
    "prediction",
    "quantity",
    "slopes",
    "no prediction",
    "rmse",
    "bias",
    "rmse_share",
    "within_aim",
];

/// The quantities that were measured, each with the number of slopes on which it was, and its
/// errors.
fn quantities(
    validation: &SlopeValidation,
    errors: &SlopeErrorsRecord,
) -> impl Iterator<Item = (&'static str, usize, Option<ErrorsRecord>)> {
    let count = |is_measured: fn(&SlopePoint) -> bool| {
        validation.points.iter().filter(|it| is_measured(&it.point)).count()
    };
    let all = [
        (SLIP_RATIO.name, count(|point| point.slip_ratio.is_some()), errors.slip_ratio),
        (YAW.name, count(|point| point.yaw.is_some()), errors.yaw),
    ];
    all.into_iter().filter(|(_, measured, _)| *measured > 0)
}

/// * `measured`: on how many slopes
/// * `errors`: over the slopes with a prediction; `None` if no slope has one
fn error_row(
    of: &str,
    quantity: &str,
    measured: usize,
    errors: Option<&ErrorsRecord>,
) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), four_digits);
    let slopes = errors.map_or(0, |it| it.cells);
    let within_aim = errors.and_then(|it| it.within_aim);
    vec![
        of.to_owned(),
        quantity.to_owned(),
        slopes.to_string(),
        (measured - slopes).to_string(),
        number(errors.map(|it| it.rmse)),
        number(errors.map(|it| it.bias)),
        number(errors.and_then(|it| it.rmse_share)),
        within_aim.map_or("-", |is_met| if is_met { "yes" } else { "no" }).to_owned(),
    ]
}
