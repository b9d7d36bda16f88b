//! The page of a validation: the answer, the errors, the figures.

use std::path::Path;
use std::sync::Arc;

use super::super::super::Answer;
use super::super::{draw, figures, meanings_of_errors, written};
use super::ValidationQuestion;
use crate::document::columns::fit::column_of;
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::document::validation::GroupRecord;
use crate::studies::measurement::Quantity;
use crate::studies::validation::Validation;

impl ValidationQuestion {
    /// The page, but for what all pages end with.
    pub(super) fn page(
        &self,
        answer: &mut Answer,
        validation: &Validation,
        errors: &[(Quantity, Arc<Table>)],
    ) {
        answer.verdict(self.verdict(validation));
        answer.list(self.what_was_compared());
        if validation.overall.unsettled > 0 {
            answer.words(format!(
                "{} of {} trials have no prediction: in the model the soil cannot carry the wheel. \
                 No error and no figure includes them.",
                validation.overall.unsettled, validation.overall.trials
            ));
        }
        answer.heading("Errors");
        answer.words(
            "Every trial is predicted at its own load and motion. Trials that repeat each other \
             form a cell; measurement and prediction are averaged over it, and every cell weighs \
             the same. rmse: root mean square of prediction minus measurement. bias: its mean, \
             positive where the model predicts too much. repeatability: standard deviation between \
             the trials of a cell; a model whose rmse is as small agrees as well as the experiment \
             does with itself. r2: 1 is perfect, 0 no better than the mean of the measured values. \
             rmse_share: rmse over the largest measured value. within_aim: whether that is what a \
             prediction from published constants should reach. The last rows are predictions \
             without physics: the mean of the set, and interpolation between the other cells.",
        );
        for (quantity, table) in errors {
            let (name, unit) = label_and_unit(*quantity);
            answer.heading(format!("Errors of the {name} [{unit}]"));
            answer.rows("Each slip angle and motion, and all together", table, table.names());
        }
        answer.heading("Figures");
        draw(answer, figures::all(validation));
        let findings = validation.cells.iter().flat_map(|cell| cell.findings.iter().copied());
        answer.findings = Some(findings.collect());
        answer.columns = meanings_of_errors();
    }

    /// The errors of the model on these cells, in a sentence.
    fn verdict(&self, validation: &Validation) -> String {
        let overall = GroupRecord::from(&validation.overall);
        let words = Quantity::ALL.into_iter().filter_map(|quantity| {
            let errors = overall.errors(quantity)?;
            let (name, unit) = label_and_unit(quantity);
            let itself = errors.repeatability.map_or(String::new(), |deviation| {
                format!(" (repeatability of the experiment {} {unit})", four_digits(deviation))
            });
            Some(format!("{name} {} {unit}{itself}", four_digits(errors.rmse)))
        });
        let words: Vec<String> = words.collect();
        let model = self.model.name();
        if words.is_empty() {
            return format!("The model {model} predicts no trial.");
        }
        let (cells, words) = (overall.0.cells, words.join(", "));
        format!("Root mean square errors of the model {model} over {cells} cells: {words}.")
    }

    fn what_was_compared(&self) -> [String; 4] {
        let file = Path::new(&self.data).file_name();
        let file = file.map_or_else(String::new, |name| name.to_string_lossy().into());
        let rows = match &written(&self.conditions)[..] {
            [] => String::new(),
            conditions => format!(", rows with {}", conditions.join(" and ")),
        };
        [
            format!("measurements: {file}{rows}"),
            format!("wheel: {}", self.wheel.document.name()),
            format!("soil: {}", self.soil.document.name()),
            format!("gravity: {} m/s²", self.gravity),
        ]
    }
}

fn label_and_unit(quantity: Quantity) -> (String, &'static str) {
    let column = column_of(quantity);
    (column.label(), column.unit.symbol)
}
