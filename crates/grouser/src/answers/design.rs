//! Which numbers of a rover are the best, under limits.

use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::{Answer, AnswerError, AnswerOptions, Attached, Displayed, Member};
use crate::document::columns::{Column, number, text};
use crate::document::design::{LoadedDesign, Measure};
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::document::unit::ONE;
use crate::document::{Kind, to_toml};
use crate::studies::design::{Design, DesignStudy, Limit};

/// The question.
#[derive(Clone, Debug)]
pub struct DesignQuestion {
    /// The task.
    pub task: LoadedDesign,
}

/// A limit, and how a design keeps it.
struct Kept<'a> {
    limit: &'a Limit,
    value: f64,
    price: f64,
}

const CONSTRAINTS: &[Column<Kept<'_>>] = &[
    text("name", "What is limited", |it| Some(it.limit.measure.name().to_owned())),
    text("side", "`at_least` or `at_most`", |it| Some(it.limit.side.name().to_owned())),
    number("bound", ONE, "The limit, in the unit of its name", |it| it.limit.bound),
    number("value", ONE, "What the design has", |it| it.value),
    number("price", ONE, "By how much the aim falls if the limit is loosened by one", |it| {
        it.price
    }),
];

impl DesignQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError::Design`] where there is no design.
    pub fn answer(&self, name: &str, _: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        let study = DesignStudy::of(self.task.value.clone());
        let design = study.design()?;
        let table = Arc::new(constraints(&study, &design));
        let mut answer = Answer::new(name, "A design");
        self.state(&mut answer);
        let free = self.task.value.free.iter().map(|(key, _)| key.path.clone());
        let values: Map<String, Value> =
            free.zip(design.values.iter().map(|value| json!(value))).collect();
        let aim = self.task.value.minimise;
        answer.results = vec![
            Member::Value("design", Value::Object(values)),
            Member::Value("objective", json!({ "name": aim.name(), "value": design.of(aim) })),
            Member::rows("constraints", Arc::clone(&table)),
            Member::Value("measures", measures(&design)),
            Member::Value(
                "certificate",
                json!({ "probes": design.certificate.probes, "better": design.certificate.better }),
            ),
            Member::Value(
                "starts",
                json!({ "searches": design.certificate.starts, "agreed": design.certificate.agreed }),
            ),
        ];
        answer.tables.push((name.to_owned(), Arc::clone(&table)));
        let lines = self.lines(&study, &design);
        answer.screen = vec![
            Displayed::Words(lines.join("\n") + "\n"),
            Displayed::Rows(Arc::clone(&table), table.names()),
        ];
        lines.into_iter().for_each(|line| answer.verdict(line));
        answer.rows("What is limited", &table, table.names());
        answer.attach("design.toml", &self.task);
        answer.documents.push(self.rover(&design));
        Ok(answer)
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let keys = ["rover", "soil", "gravity_m_s2", "slope_deg", "minimise", "free", "subject_to"];
        answer.inputs_of(&self.task.document, keys);
        answer.input("model", self.task.value.scenario.value.model.name());
    }

    /// What is said of the design.
    fn lines(&self, study: &DesignStudy, design: &Design) -> Vec<String> {
        let task = &self.task.value;
        let pairs = task.free.iter().zip(&design.values);
        let numbers =
            pairs.map(|((key, _), value)| format!("{} = {}", key.path, four_digits(*value)));
        let aim = task.minimise;
        let mut lines = vec![format!(
            "{} is {} at the least, with {}.",
            aim.name(),
            four_digits(design.of(aim)),
            numbers.collect::<Vec<_>>().join(", ")
        )];
        let limits = study.limits().iter().zip(&design.prices).filter(|(_, price)| **price > 0.0);
        lines.extend(limits.map(|(limit, price)| {
            let unit = limit.measure.unit().symbol;
            format!(
                "{} holds it back: loosened by 1 {unit} it is worth {} {}.",
                limit.measure.name(),
                four_digits(*price),
                aim.unit().symbol
            )
        }));
        let it = design.certificate;
        lines.push(format!(
            "{} of {} searches came to it; {} of {} designs within 1 % of the bounds are better.",
            it.agreed, it.starts, it.better, it.probes
        ));
        lines
    }

    /// The rover's document with the numbers that were found.
    fn rover(&self, design: &Design) -> Attached {
        let document = &self.task.value.scenario.document;
        let numbers = design.numbers.iter().map(|(key, value)| (&**key, *value));
        let changed = document.with(numbers).part(Kind::Rover, "rover");
        Attached {
            file: "rover.toml".into(),
            toml: changed.map_or_else(String::new, |rover| to_toml(&rover)),
            companions: Vec::new(),
            assumptions: Vec::new(),
        }
    }
}

fn constraints(study: &DesignStudy, design: &Design) -> Table {
    let pairs = study.limits().iter().zip(&design.prices);
    let kept: Vec<Kept<'_>> = pairs
        .map(|(limit, price)| Kept { limit, value: design.of(limit.measure), price: *price })
        .collect();
    Table::of(CONSTRAINTS, &kept)
}

fn measures(design: &Design) -> Value {
    let all = Measure::ALL.into_iter().map(|it| (it.name().to_owned(), json!(design.of(it))));
    Value::Object(all.collect())
}
