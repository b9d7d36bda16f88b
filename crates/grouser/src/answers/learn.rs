//! What the telemetry of a drive tells of the soil, and of the next slopes.

mod advice;
mod figures;
mod page;
mod question;
mod tables;
mod words;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::{Value, json};

pub use self::advice::AdviceQuestion;
pub use self::question::{LearnQuestion, LearntDrive, SlipsFromCurrents};
use self::tables::DriveTables;
pub use self::words::{shares, slope_in_words, warning_in_words};
use super::{Answer, Attached, Member};
use crate::document::LoadedScenario;
use crate::document::columns::SLOPE;
use crate::document::columns::heading::findings;
use crate::document::columns::learn::{WAY, contradictions};
use crate::document::columns::verdict::{self, ADVICE_OBJECT};
use crate::document::learn::files_of_prior;
use crate::studies::heading::HeadingStudy;
use crate::studies::learn::Learner;

/// The name of the file of the soil that was learnt.
pub const SOIL_FILE: &str = "soil.toml";

impl LearnQuestion {
    /// The answer.
    ///
    /// * `found`: what the drive taught, with the samples and the advice of the question
    #[must_use]
    pub fn answer(&self, name: &str, found: &LearntDrive) -> Answer {
        let tables = DriveTables::of(found, &self.scenario.value.rover);
        let mut answer = Answer::new(name, "Learnt from the drive");
        self.state(&mut answer);
        self.results(&mut answer, found, &tables);
        answer.tables = tables.files();
        answer.screen = tables.screen(&words::lines(found));
        answer.documents.push(before_the_drive(&self.scenario));
        answer.given.extend(found.given.iter().chain(&self.scenario.given).cloned());
        self.page(&mut answer, found, &tables);
        let slopes = self.slopes();
        let curve = HeadingStudy::of(&self.scenario.value).curve().ok();
        answer.findings = curve.map(|curve| findings(&curve, &slopes).concat());
        answer
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let document = &self.scenario.document;
        answer.input("log", self.log.as_str());
        answer.inputs_of(document, ["rover", "soil"]);
        let slope = document.get(SLOPE.name).filter(|_| self.has_slope);
        answer.input(SLOPE.name, slope.cloned());
        answer.inputs_of(document, ["gravity_m_s2", "load_transfer", "wheel_moments"]);
        answer.input("model", document.model().map(|model| model.name()));
        answer.input("predict_slope_deg", self.slopes_deg.clone());
        self.sampling.state(answer);
        let advice = self.advice.as_ref().map(|advice| BTreeMap::from(advice.given()));
        answer.input("advice", json!(advice));
    }

    /// The results of JSON.
    fn results(&self, answer: &mut Answer, found: &LearntDrive, tables: &DriveTables) {
        let learner = found.drive.learner();
        answer.results = vec![
            Member::With(
                "predictions",
                Arc::clone(&tables.predictions),
                ADVICE_OBJECT,
                verdict::advice(&found.verdicts),
            ),
            Member::rows("warnings", Arc::clone(&tables.warnings)),
            Member::Value("learnt", learnt(learner)),
            Member::Value("models", json!(shares(learner))),
            Member::Value("narrowed", json!(found.narrowed)),
            Member::Value("contradictions", json!(contradictions(learner))),
        ];
        let soil = self.soil_file.as_ref().map(|file| Member::Value("soil", json!(file)));
        let advice = tables.advice.as_ref().map(|it| Member::Value("advice", it.to_json()));
        answer.results.extend(soil.into_iter().chain(advice));
        answer.results.push(Member::Value("notes", json!(found.notes)));
    }
}

/// How much was learnt from.
fn learnt(learner: &Learner) -> Value {
    let learnt = learner.learnt();
    json!({
        "records": learnt.records,
        "stretches": learnt.stretches,
        (WAY.name): learnt.way,
        "outliers": learnt.outliers,
        "stretches_not_used": learnt.not_used.values().sum::<u64>(),
    })
}

/// The scenario with the soil as it was known, under names that leave room for what was learnt.
fn before_the_drive(scenario: &LoadedScenario) -> Attached {
    let (document, companions) = files_of_prior(scenario);
    let assumptions = scenario.assumptions.clone();
    Attached { file: "scenario.toml".into(), toml: document.to_toml(), companions, assumptions }
}
