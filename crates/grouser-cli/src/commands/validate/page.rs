//! The page of a validation: the answer, the errors, the figures.

use grouser_draw::chart::Drawable;
use std::path::Path;

use grouser::document::columns::fit::column_of;
use grouser::document::reading::four_digits;
use grouser::document::validation::GroupRecord;
use grouser::studies::measurement::Quantity;
use grouser::studies::validation::Validation;

use super::{ERRORS, error_rows, figures, groups_and_sums};
use crate::args::ValidateArgs;
use crate::inputs::StandInputs;
use crate::report::page::Page;

pub(super) fn html(
    args: &ValidateArgs,
    data: &Path,
    stand: &StandInputs,
    validation: &Validation,
) -> String {
    let mut page = Page::new("Measured and predicted");
    page.answer(&answer(stand, validation));
    page.list(what_was_compared(args, data, stand));
    if validation.overall.unsettled > 0 {
        page.paragraph(&format!(
            "{} of {} trials have no prediction: in the model the soil cannot carry the wheel. No \
             error and no figure includes them.",
            validation.overall.unsettled, validation.overall.trials
        ));
    }
    page.heading("Errors");
    page.paragraph(
        "Every trial is predicted at its own load and motion. Trials that repeat each other form a \
         cell; measurement and prediction are averaged over it, and every cell weighs the same. \
         rmse: root mean square of prediction minus measurement. bias: its mean, positive where \
         the model predicts too much. repeatability: standard deviation between the trials of a \
         cell; a model whose rmse is as small agrees as well as the experiment does with itself. \
         r2: 1 is perfect, 0 no better than the mean of the measured values. rmse_share: rmse over \
         the largest measured value. within_aim: whether that is what a prediction from published \
         constants should reach. The last rows are predictions without physics: the mean of the \
         set, and interpolation between the other cells.",
    );
    let groups = groups_and_sums(validation);
    for quantity in Quantity::ALL {
        let rows = error_rows(&groups, validation, quantity);
        if !rows.is_empty() {
            let (name, unit) = (column_of(quantity).label(), column_of(quantity).unit.symbol);
            let caption = format!("Errors of the {name} [{unit}]");
            page.grid(&caption, &ERRORS.map(str::to_owned), &rows);
        }
    }
    page.heading("Figures");
    for figure in figures::all(validation) {
        page.drawing(&figure.chart.to_svg(), figure.caption);
    }
    page.flags(validation.cells.iter().flat_map(|cell| &cell.findings));
    page.heading("Assumptions in force");
    page.list(stand.soil.assumptions.iter().chain(&stand.wheel.assumptions));
    page.to_html()
}

/// The errors of the model on these cells, in a sentence.
fn answer(stand: &StandInputs, validation: &Validation) -> String {
    let overall = GroupRecord::from(&validation.overall);
    let words = Quantity::ALL.into_iter().filter_map(|quantity| {
        let errors = overall.errors(quantity)?;
        let (name, unit) = (column_of(quantity).label(), column_of(quantity).unit.symbol);
        let itself = errors.repeatability.map_or(String::new(), |deviation| {
            format!(" (repeatability of the experiment {} {unit})", four_digits(deviation))
        });
        Some(format!("{name} {} {unit}{itself}", four_digits(errors.rmse)))
    });
    let words: Vec<String> = words.collect();
    let model = stand.model.name();
    if words.is_empty() {
        return format!("The model {model} predicts no trial.");
    }
    let (cells, words) = (overall.0.cells, words.join(", "));
    format!("Root mean square errors of the model {model} over {cells} cells: {words}.")
}

fn what_was_compared(args: &ValidateArgs, data: &Path, stand: &StandInputs) -> Vec<String> {
    let file = data.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    let conditions: Vec<String> = args.conditions.iter().map(ToString::to_string).collect();
    let rows = match &conditions[..] {
        [] => String::new(),
        conditions => format!(", rows with {}", conditions.join(" and ")),
    };
    vec![
        format!("measurements: {file}{rows}"),
        format!("wheel: {}", stand.wheel.document.name()),
        format!("soil: {}", stand.soil.document.name()),
        format!("gravity: {} m/s²", stand.gravity),
    ]
}
