//! A rover under another gravity than the one its soil was measured under, with one error budget.

mod figures;
mod page;
mod tables;

use std::sync::Arc;

use serde_json::{Map, Value, json};

use self::tables::Tables;
use super::{Answer, Member, samples};
use crate::document::forecast::notes;
use crate::document::{LoadedScenario, LoadedSoil};
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::forecast::{Forecast, ForecastStudy, Ground};

/// The question.
#[derive(Clone, Copy, Debug)]
pub struct ForecastQuestion<'q> {
    /// The scenario, under the gravity of the site.
    pub scenario: &'q LoadedScenario,
    /// Its study.
    pub study: &'q ForecastStudy,
    /// What its samples are drawn from.
    pub band: &'q BandInputs,
    /// The documents of the grounds that are not the soil's own.
    pub grounds: &'q [LoadedSoil],
    /// The site, by its name or its gravity.
    pub site: &'q str,
    /// Slopes [°], as they were given.
    pub slopes_deg: &'q [f64],
    /// Whether somebody says under which gravity the soil was measured.
    pub is_measured_under_stated: bool,
}

impl ForecastQuestion<'_> {
    /// The answer.
    ///
    /// * `forecast`: the study's result
    #[must_use]
    pub fn answer(&self, name: &str, forecast: &Forecast) -> Answer {
        let tables = Tables::of(forecast);
        let notes = notes(self.study, self.scenario, self.is_measured_under_stated);
        let mut answer = Answer::new(name, "Forecast under another gravity");
        self.state(&mut answer);
        let all = [
            ("rows", name, &tables.rows),
            ("steepest", "steepest", &tables.steepest),
            ("budget", "budget", &tables.budget),
            ("choices", "choices", &tables.choices),
            ("tests", "tests", &tables.tests),
        ];
        for (key, file, table) in all {
            answer.results.push(Member::rows(key, Arc::clone(table)));
            answer.tables.push((file.to_owned(), Arc::clone(table)));
        }
        answer.results.push(Member::Value("notes", json!(notes)));
        answer.screen = tables.screen(&notes);
        answer.attach("scenario.toml", self.scenario);
        for (place, ground) in self.grounds.iter().enumerate() {
            answer.attach(file_of_ground(place), ground);
        }
        self.page(&mut answer, forecast, (&tables, &notes));
        answer
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let (document, study) = (&self.scenario.document, self.study);
        let choices = &study.choices;
        let masses = choices.masses.iter().map(|mass| (mass.name.clone(), json!(mass.factor)));
        answer.inputs_of(document, ["rover", "soil"]);
        answer.input("site", self.site);
        answer.inputs_of(document, ["gravity_m_s2"]);
        answer.input("measured_gravity_m_s2", study.measured_under);
        let scalings = choices.scalings.iter().map(|scaling| scaling.name());
        answer.input("scaling", scalings.collect::<Value>());
        answer.input("ground", choices.grounds.iter().map(Ground::name).collect::<Value>());
        let documents = self.grounds.iter().map(|ground| json!(ground.document));
        answer.input("ground_soils", documents.collect::<Value>());
        answer.input("mass", masses.collect::<Map<_, _>>());
        answer.input("slope_deg", self.slopes_deg.to_vec());
        answer.input("rim_speed_m_s", study.rim_speed);
        answer.input("no_go_slip_ratio", study.no_go_slip_ratio);
        answer.inputs_of(document, ["load_transfer", "wheel_moments"]);
        let [samples, discrepancies] = study.samples;
        answer.input("samples", samples);
        answer.input("discrepancies", discrepancies);
        answer.input("seed", study.seed);
        answer.model_weights = Some(samples::weights(self.band));
    }
}

/// The name of the file of a ground.
///
/// * `place`: among the grounds that have a document
#[must_use]
pub fn file_of_ground(place: usize) -> String {
    format!("ground-{}/soil.toml", place + 1)
}
