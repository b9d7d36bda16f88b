//! `grouser validate`: errors of a wheel–soil model against measured wheel tests or a rover on
//! slopes, or a ranking of all models.

pub(crate) mod figures;
mod page;
mod ranking;
mod slopes;

use grouser_draw::chart::Drawable;
use std::path::Path;

use grouser::document::columns::SLIP_ANGLE;
use grouser::document::columns::fit::{self, column_of};
use grouser::document::measurements::{self, Choice, Measurements};
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::document::validation::{ErrorsRecord, GroupRecord, ReferenceRecord};
use grouser::studies::measurement::Quantity;
use grouser::studies::validation::{Reference, Validation, ValidationStudy};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::{Answer, strict};
use crate::args::{StrictArgs, ValidateArgs};
use crate::failure::Failure;
use crate::inputs::{self, StandInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, aligned};
use crate::output::text::Text;
use crate::output::{self, Format};

pub(crate) fn run(args: &ValidateArgs) -> Result<(), Failure> {
    match (&args.data, &args.wheel, &args.rover, &args.soil) {
        (Some(data), Some(wheel), None, Some(soil)) => one(args, data, wheel, soil),
        (Some(data), None, Some(rover), Some(soil)) => slopes::run(args, data, rover, soil),
        (Some(data), ..) => ranking::of_one(args, data),
        // The parser of the command line asks for data, or for --all.
        (None, ..) => ranking::of_all(args),
    }
}

#[derive(Serialize)]
struct Results<'a> {
    overall: &'a GroupRecord,
    driven: Option<GroupRecord>,
    skid: Option<GroupRecord>,
    rows: &'a [GroupRecord],
    yardsticks: &'a [ReferenceRecord<GroupRecord>],
    cells: &'a Table,
    notes: &'a [String],
}

/// One model with one soil on one file.
fn one(args: &ValidateArgs, data: &Path, wheel: &str, soil: &str) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let stand = inputs::stand(soil, wheel, &args.setting)?;
    let choice = Choice {
        conditions: args.conditions.clone(),
        wheel: Some(wheel.to_owned()),
        limits: args.read.limits(),
    };
    let measured = measurements::Source::find(data)?.read(&choice)?;
    for note in &measured.notes {
        output::message(&format!("note: {note}"));
    }
    let validation = judge(&measured, &stand);
    let groups: Vec<GroupRecord> = validation.groups.iter().map(GroupRecord::from).collect();
    let yardsticks: Vec<_> = validation.references.iter().map(ReferenceRecord::from).collect();
    let cells = fit::cells(&validation.cells);
    let flags = validation.cells.iter().map(|cell| &*cell.findings);
    let strict = StrictArgs { strict: args.strict };
    strict::check(&strict, flags, &cells, &fit::SETTINGS)?;
    let results = Results {
        overall: &GroupRecord::from(&validation.overall),
        driven: validation.driven.as_ref().map(GroupRecord::from),
        skid: validation.skid.as_ref().map(GroupRecord::from),
        rows: &groups,
        yardsticks: &yardsticks,
        cells: &cells,
        notes: &measured.notes,
    };
    let answer = Answer::new("validate", settings(args, data, &stand), results);
    let text = text_of(&validation) + Rows::of_table(&cells).footnotes();
    if let Some(mut folder) = folder {
        folder.add("validation.json", answer.to_text());
        folder.add("validation.csv", long_rows(&validation).to_csv()?);
        folder.add("cells.csv", Rows::of_table(&cells).to_csv()?);
        folder.add("trials.csv", Rows::of_table(&fit::trials(&measured, &validation)).to_csv()?);
        folder.add("validation.html", page::html(args, data, &stand, &validation));
        for figure in figures::all(&validation) {
            folder.add(format!("figures/{}.svg", figure.file), figure.chart.to_svg());
        }
        folder.add_document("soil.toml", &stand.soil);
        folder.add_document("wheel.toml", &stand.wheel);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(text),
        Format::Csv => output::print(&long_rows(&validation).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

fn judge(measured: &Measurements, stand: &StandInputs) -> Validation {
    ValidationStudy {
        tests: &measured.tests,
        wheel: stand.wheel.value,
        soil: stand.soil.value,
        model: stand.model.clone(),
        gravity: stand.gravity,
    }
    .run()
}

fn settings(args: &ValidateArgs, data: &Path, stand: &StandInputs) -> Value {
    let conditions: Vec<String> = args.conditions.iter().map(ToString::to_string).collect();
    json!({
        "data": data.display().to_string(),
        "where": conditions,
        "soil": stand.soil.document,
        "wheel": stand.wheel.document,
        "gravity_m_s2": stand.gravity,
        "model": stand.model.name(),
    })
}

/// Every group with what is above it: driven, skid, all.
fn groups_and_sums(validation: &Validation) -> Vec<GroupRecord> {
    let sums = [&validation.driven, &validation.skid].into_iter().flatten();
    let all = validation.groups.iter().chain(sums).chain([&validation.overall]);
    all.map(GroupRecord::from).collect()
}

/// The errors as a row for each group and quantity, and for each yardstick and quantity.
fn long_rows(validation: &Validation) -> Rows {
    let mut rows: Vec<Map<String, Value>> = Vec::new();
    for group in groups_and_sums(validation) {
        rows.extend(rows_of(&group, None));
    }
    for reference in validation.references.iter().map(ReferenceRecord::from) {
        rows.extend(rows_of(&reference.overall, Some(reference.yardstick)));
    }
    Rows::from_maps(rows)
}

/// A row for each quantity of a group.
///
/// * `yardstick`: whose errors they are, if not the model's
fn rows_of(group: &GroupRecord, yardstick: Option<&str>) -> Vec<Map<String, Value>> {
    let row = |quantity: Quantity| {
        let errors = group.errors(quantity)?;
        let row = json!({
            (SLIP_ANGLE.name): group.slip_angle(),
            "motion": group.motion(),
            "quantity": column_of(quantity).name,
            "cells": errors.cells,
            "unsettled_trials": group.0.unsettled,
        });
        let errors = serde_json::to_value(errors).ok()?;
        let (mut row, errors) = (row.as_object()?.clone(), errors.as_object()?.clone());
        row.extend(errors);
        row.insert("yardstick".to_owned(), yardstick.into());
        Some(row)
    };
    Quantity::ALL.into_iter().filter_map(row).collect()
}

/// For people: a block for each quantity, and what could not be predicted.
fn text_of(validation: &Validation) -> Text {
    let groups = groups_and_sums(validation);
    let blocks = Quantity::ALL.into_iter().filter_map(|it| block(&groups, validation, it));
    let (unsettled, trials) = (validation.overall.unsettled, validation.overall.trials);
    let missing = (unsettled > 0).then(|| {
        Text::from(format!(
            "{unsettled} of {trials} trials have no prediction: the soil cannot carry the wheel. \
             They are in no error above.\n"
        ))
    });
    Text::blocks(blocks.chain(missing))
}

fn block(groups: &[GroupRecord], validation: &Validation, quantity: Quantity) -> Option<Text> {
    let rows = error_rows(groups, validation, quantity);
    let table = aligned(&ERRORS.map(str::to_owned), &rows);
    (!rows.is_empty()).then(|| Text::from(format!("{}\n", column_of(quantity).name)) + table)
}

/// Columns of a quantity's errors.
const ERRORS: [&str; 9] = [
    SLIP_ANGLE.name,
    "motion",
    "cells",
    "rmse",
    "repeatability",
    "bias",
    "r2",
    "rmse_share",
    "within_aim",
];

/// A quantity's errors for people, a row for each group, then one for each yardstick.
fn error_rows(
    groups: &[GroupRecord],
    validation: &Validation,
    quantity: Quantity,
) -> Vec<Vec<String>> {
    let row = |group: &GroupRecord| {
        let angle = group.slip_angle().map_or("all".to_owned(), four_digits);
        Some(error_row(angle, group.motion(), group.errors(quantity)?))
    };
    let yardstick = |reference: &Reference| {
        let group = GroupRecord::from(&reference.overall);
        let name = reference.yardstick.name().to_owned();
        Some(error_row(name, group.motion(), group.errors(quantity)?))
    };
    let models = groups.iter().filter_map(row);
    models.chain(validation.references.iter().filter_map(yardstick)).collect()
}

/// * `of`: a slip angle, or a yardstick
fn error_row(of: String, motion: &str, errors: ErrorsRecord) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), four_digits);
    vec![
        of,
        motion.to_owned(),
        errors.cells.to_string(),
        four_digits(errors.rmse),
        number(errors.repeatability),
        four_digits(errors.bias),
        number(errors.r2),
        number(errors.rmse_share),
        errors.within_aim.map_or("-", |is_met| if is_met { "yes" } else { "no" }).to_owned(),
    ]
}
