//! `traverse`: a run over a slope or a map of heights, as `grouser traverse` has it.

use std::cell::RefCell;

use grouser::answers::traverse::TraverseQuestion;
use grouser::answers::{Answer, AnswerError, AnswerOptions, Sampling, check_flags};
use grouser::document::LoadedScenario;
use grouser::document::columns::{TIME, run};
use grouser::simulation::{RunError, Trajectory};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::traverse_band::{TraverseBand, record_times};
use grouser_draw::title_of;
use http::StatusCode;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::{RunSettings, ScenarioParts};
use super::staged::{Staged, Stages, refused, scene_of};
use super::wheel_test::add_uncertainty;
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// Records of a run at the most.
const RECORDS: f64 = 5000.0;
/// Its length at the most [s]: one of steady motions goes on to its end.
const DURATION: f64 = 600.0;

/// What is asked of a traverse.
struct TraverseAsked {
    scenario: LoadedScenario,
    sampling: Option<Sampling>,
    /// The run of the soil as written, which all stages share.
    run: RefCell<Option<Trajectory>>,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let settings = RunSettings::of(&fields)?;
    let parts = ScenarioParts::of(&fields)?;
    let stages = Stages::of(&fields, None)?.with_scene(&fields)?;
    fields.finish()?;
    if parts.common().has_every_model() {
        let message = "records are of one model: name one, or leave it out";
        return Err(Refusal::of_key("model", message));
    }
    let scenario = parts.run(&console.folder, &settings, stages.has_samples())?;
    let stages = stages.of_rows(("samples", 1), false, 0)?;
    let records = scenario.value.duration / scenario.value.numerics.sample_interval;
    if records > RECORDS {
        let message = format!("{records} records: it must be at most {RECORDS}");
        let refusal = Refusal::of_key("duration_s", message);
        return Err(refusal.with_hint("a longer `scenario.sample_interval_s` has fewer"));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
    // Every sample keeps where it was at each record.
    stages.check_samples_of(records as usize + 1)?;
    if scenario.value.duration > DURATION {
        let message = format!("{} s: it must be at most {DURATION}", scenario.value.duration);
        return Err(Refusal::of_key("duration_s", message));
    }
    let mut line = CommandLine::new("traverse");
    parts.add_words(&mut line);
    settings.add_words(&mut line);
    // Records take long on uneven ground.
    let stages = if scenario.value.ground.is_plane() { stages } else { stages.in_turn() };
    Ok(stages.question(TraverseAsked { scenario, sampling: None, run: RefCell::default() }, line))
}

impl Staged for TraverseAsked {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling;
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let question = TraverseQuestion { scenario: &self.scenario };
        let scenario = &self.scenario.value;
        let mut last = self.run.borrow_mut();
        let run = match last.take() {
            Some(run) => run,
            None => question.run(options.go_on).map_err(failed)?.ok_or_else(stopped)?,
        };
        let run = last.insert(run);
        if options.is_strict {
            let flags = run::each_findings(run, scenario);
            let records = run::table(run, scenario);
            let checked = check_flags(flags.iter().map(|it| &**it), &records, &[TIME.name]);
            checked.map_err(|error| refused(error.into()))?;
        }
        let Some(sampling) = self.sampling else {
            return Ok(question.answer("traverse", run, None, None));
        };
        let samples = sampling.draw(&BandInputs::of_scenario(&self.scenario));
        let samples = samples.map_err(|error| refused(error.into()))?;
        let times = record_times(run, scenario);
        let band = TraverseBand::of(scenario, &samples, &times, options.go_on).map_err(failed)?;
        let band = band.ok_or_else(stopped)?;
        Ok(question.answer("traverse", run, Some((&band, sampling)), None))
    }

    fn whose(&self) -> String {
        title_of(&self.scenario)
    }

    fn scene(&self) -> Option<Vec<u8>> {
        let run = self.run.borrow();
        run.as_ref().map(|run| scene_of(&self.whose(), run, &self.scenario.value))
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        add_uncertainty(line, sampling);
    }
}

fn stopped() -> Refusal {
    refused(AnswerError::Stopped)
}

/// Why a run has no end.
#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn failed(error: RunError) -> Refusal {
    Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string())
}
