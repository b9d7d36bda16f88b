//! A run over a slope or a map of heights: what became of it, and each of its records.

mod path;

use serde_json::{Value, json};

pub use self::path::{Path, path_chart, reason, sentence};
use super::{Answer, Member, Sampling, gradient, weights};
use crate::document::columns;
use crate::document::columns::run::{self, RunObject};
use crate::document::gradient::RunKeys;
use crate::document::table::Table;
use crate::document::{LoadedScenario, given_to_drives};
use crate::simulation::{Approach, Run, RunError, Trajectory};
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::traverse_band::TraverseBand;

/// The question.
#[derive(Clone, Copy, Debug)]
pub struct TraverseQuestion<'q> {
    /// What is run.
    pub scenario: &'q LoadedScenario,
}

/// Derivatives of a run.
#[derive(Clone, Debug)]
pub struct RunGradient {
    /// The numbers by which.
    pub keys: RunKeys,
    /// A row for each record.
    pub rows: Table,
}

impl RunGradient {
    /// Those of a run that was led to its end; `None` if `go_on` was false before all runs beside
    /// it were.
    #[must_use]
    pub fn of(
        scenario: &LoadedScenario,
        run: &Trajectory,
        keys: RunKeys,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let number = |key: &str| scenario.document.number(key);
        let found = keys.along(&scenario.value, &number, run, Run::to_end, go_on)?;
        let on_heights = !scenario.value.ground.is_plane();
        let rows = columns::gradient::of_run(&keys, &found, run.records.len(), on_heights);
        Some(Self { keys, rows })
    }

    /// Those of the last record: a row for each key, with the results in columns.
    #[must_use]
    pub fn of_the_end(&self, results: &[&str]) -> Table {
        let keys: Vec<&str> = self.keys.names().collect();
        let last = self.rows.rows().saturating_sub(1);
        columns::gradient::by_key(&self.rows, &[last], &[], results, &keys)
    }

    /// What is said of them.
    #[must_use]
    pub fn lines(&self) -> String {
        let names: Vec<&str> = self.keys.names().collect();
        let lacking: Vec<&str> = self.keys.lacking().collect();
        gradient::lines(&self.rows, &names, &lacking)
    }
}

/// A run is asked so many times whether to go on.
const PARTS: f64 = 50.0;

impl TraverseQuestion<'_> {
    /// The run; `None` if `go_on` was false before its end. One of steady motions is quick, and has
    /// other last digits where it is stopped between: it is not asked.
    ///
    /// # Errors
    /// [`RunError`] if it cannot be computed.
    pub fn run(&self, go_on: &(dyn Fn() -> bool + Sync)) -> Result<Option<Trajectory>, RunError> {
        let scenario = &self.scenario.value;
        let mut run = Run::new(scenario)?;
        if matches!(scenario.numerics.approach, Approach::QuasiSteady) {
            run.run_to_end()?;
            return Ok(Some(run.finish()));
        }
        while run.outcome().is_none() && run.state().time() < scenario.duration {
            if !go_on() {
                return Ok(None);
            }
            run.play(scenario.duration / PARTS)?;
        }
        Ok(Some(run.finish()))
    }

    /// The answer, with where the run ended and its path for a slide: front ends write its page.
    ///
    /// * `band`: what samples make of it, with these
    /// * `gradient`: its derivatives
    #[must_use]
    pub fn answer(
        &self,
        name: &str,
        run: &Trajectory,
        band: Option<(&TraverseBand, Sampling)>,
        gradient: Option<&RunGradient>,
    ) -> Answer {
        let (loaded, scenario) = (self.scenario, &self.scenario.value);
        let mut answer = Answer::new(name, "A traverse");
        answer.input("scenario", json!(loaded.document));
        if let Some((_, sampling)) = band {
            sampling.state(&mut answer);
            answer.model_weights = Some(weights(&BandInputs::of_scenario(loaded)));
        }
        if let Some(gradient) = gradient {
            answer.input("gradients", json!(gradient.keys.names().collect::<Vec<_>>()));
        }
        let derivatives = gradient.map(|it| &it.rows);
        if let Value::Object(entries) = json!(RunObject { run, scenario, derivatives }) {
            answer.results.push(Member::Entries(entries));
        }
        answer.results.extend(gradient.and_then(|it| gradient::notes(&it.lines())));
        if let Some((band, _)) = band {
            let of_run = run::run_band(&band.run, scenario);
            answer.results.push(Member::Row(Some("band"), of_run));
            answer.results.push(Member::rows("bands", run::time_bands(&band.times, scenario)));
        }
        answer.verdict(sentence(scenario, run));
        let path = (scenario.model.name(), run, band.map(|(band, _)| band));
        let chart = path_chart(!scenario.ground.is_plane(), &[path]);
        answer.figure(Some("traverse"), chart, "The path, seen from above.");
        answer.attach("scenario.toml", loaded);
        answer.given = given_to_drives(loaded, scenario, [run]);
        answer
    }
}
