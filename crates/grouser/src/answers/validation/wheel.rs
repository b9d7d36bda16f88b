//! Errors of a model against measured wheel tests.

mod errors;
mod page;

use std::sync::Arc;

use serde_json::{Map, Value, json};

use self::errors::{groups_and_sums, tables};
use super::super::{Answer, AnswerError, AnswerOptions, Displayed, Member};
use super::shown::{Block, Shown, on_screen};
use super::{FILE, flat, written};
use crate::contact::Model;
use crate::contact::validity::Flag;
use crate::document::columns::SLIP_ANGLE;
use crate::document::columns::fit::{self, column_of};
use crate::document::columns::flags::FLAGS;
use crate::document::measurements::{Condition, Measurements};
use crate::document::table::Table;
use crate::document::validation::{GroupRecord, ReferenceRecord};
use crate::document::{LoadedSoil, LoadedWheel};
use crate::studies::measurement::Quantity;
use crate::studies::validation::{Validation, ValidationStudy};

/// The question of measured wheel tests.
#[derive(Clone, Debug)]
pub struct ValidationQuestion {
    /// The name of a data set, or of a file with its folder.
    pub data: String,
    /// What each row meets.
    pub conditions: Vec<Condition>,
    /// The rows.
    pub measured: Measurements,
    /// The soil of the predictions.
    pub soil: LoadedSoil,
    /// The wheel that was tested.
    pub wheel: LoadedWheel,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: Model,
}

impl ValidationQuestion {
    /// The answer.
    ///
    /// * `schema`: the name that its schema has
    ///
    /// # Errors
    /// [`AnswerError::OutsideDomain`]: a flag where none is accepted.
    pub fn answer(&self, schema: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        let validation = self.validation();
        let cells = Arc::new(fit::cells(&validation.cells));
        let flags = validation.cells.iter().map(|cell| &*cell.findings);
        options.check(flags, &cells, &fit::SETTINGS)?;
        let mut answer = Answer::new(FILE, "Measured and predicted").with_schema(schema);
        self.state(&mut answer);
        self.results(&mut answer, &validation, &cells);
        let errors = tables(&validation);
        answer.screen = screen(&validation, &errors, &cells);
        answer.attach("soil.toml", &self.soil);
        answer.attach("wheel.toml", &self.wheel);
        answer.given.push(self.measured.given.clone());
        if options.has_page {
            self.page(&mut answer, &validation, &errors);
        }
        Ok(answer)
    }

    /// Every trial, predicted.
    fn validation(&self) -> Validation {
        ValidationStudy {
            tests: &self.measured.tests,
            wheel: self.wheel.value,
            soil: self.soil.value,
            model: self.model.clone(),
            gravity: self.gravity,
        }
        .run()
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        answer.input("data", self.data.as_str());
        answer.input("where", written(&self.conditions));
        answer.input("soil", json!(self.soil.document));
        answer.input("wheel", json!(self.wheel.document));
        answer.input("gravity_m_s2", self.gravity);
        answer.input("model", self.model.name());
    }

    /// The results of JSON, and the tables.
    fn results(&self, answer: &mut Answer, validation: &Validation, cells: &Arc<Table>) {
        let overall = GroupRecord::from(&validation.overall);
        let [driven, skid] =
            [&validation.driven, &validation.skid].map(|it| it.as_ref().map(GroupRecord::from));
        let groups: Vec<GroupRecord> = validation.groups.iter().map(GroupRecord::from).collect();
        let yardsticks: Vec<ReferenceRecord<GroupRecord>> =
            validation.references.iter().map(ReferenceRecord::from).collect();
        answer.results = vec![
            Member::Value("overall", json!(overall)),
            Member::Value("driven", json!(driven)),
            Member::Value("skid", json!(skid)),
            Member::Value("rows", json!(groups)),
            Member::Value("yardsticks", json!(yardsticks)),
            Member::rows("cells", Arc::clone(cells)),
            Member::Value("notes", json!(self.measured.notes)),
        ];
        let trials = fit::trials(&self.measured, validation);
        answer.tables = vec![
            (FILE.to_owned(), Arc::new(errors(validation, &yardsticks))),
            ("cells".to_owned(), Arc::clone(cells)),
            ("trials".to_owned(), Arc::new(trials)),
        ];
    }
}

/// A row for each group and quantity, and for each yardstick and quantity.
fn errors(validation: &Validation, yardsticks: &[ReferenceRecord<GroupRecord>]) -> Table {
    let groups = groups_and_sums(validation);
    let models = groups.iter().flat_map(|group| rows_of(group, None));
    let of_yardsticks = yardsticks.iter().flat_map(|it| rows_of(&it.overall, Some(it.yardstick)));
    flat::table_of(&models.chain(of_yardsticks).collect::<Vec<_>>())
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

/// For reading: a block for each quantity, what could not be predicted, and what the flags mean.
fn screen(
    validation: &Validation,
    errors: &[(Quantity, Arc<Table>)],
    cells: &Table,
) -> Vec<Displayed> {
    let block = |(quantity, table): &(Quantity, Arc<Table>)| {
        let title = Shown::Title(column_of(*quantity).name.to_owned());
        vec![title, Shown::Rows("Errors", Arc::clone(table))]
    };
    let mut blocks: Vec<Block> = errors.iter().map(block).collect();
    let (unsettled, trials) = (validation.overall.unsettled, validation.overall.trials);
    if unsettled > 0 {
        blocks.push(vec![Shown::Words(format!(
            "{unsettled} of {trials} trials have no prediction: the soil cannot carry the wheel. \
             They are in no error above.\n"
        ))]);
    }
    let mut screen = on_screen(&blocks);
    screen.push(Displayed::Words(meanings_of_flags(cells)));
    screen
}

/// What the flags of the cells mean, a line each.
fn meanings_of_flags(cells: &Table) -> String {
    let names = cells.words(FLAGS);
    let is_raised = |flag: &Flag| names.iter().flatten().any(|name| *name == flag.name());
    let raised = Flag::ALL.into_iter().filter(is_raised);
    raised.map(|flag| format!("{}: {}\n", flag.name(), flag.rule().meaning)).collect()
}
