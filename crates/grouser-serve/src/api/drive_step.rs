//! `drive-step`: a rover that is driven from outside, step after step. Nothing of it is kept here: its
//! state comes with each question, and goes with the answer.

use grouser::document::columns::run::RunObject;
use grouser::document::measurements::telemetry::{csv_header, csv_line};
use grouser::document::{LoadedScenario, RIM_SPEED_M_S, json, mark_of};
use grouser::simulation::{
    Observation, Outcome, Record, Run, RunError, Scenario, State, Trajectory,
};
use grouser::studies::simulated_telemetry::truth;
use grouser::terrain::Shape;
use grouser_draw::{base64, from_base64, title_of};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::{RunSettings, ScenarioParts};
use super::staged::scene_of;
use crate::asked::{GoOn, Question};
use crate::console::Console;
use crate::refusal::Refusal;

const STATE: &str = "state";
const TELEMETRY: &str = "telemetry";
const RIM_SPEEDS: &str = "rim_speed_m_s";
/// How long a step may be [s].
const SPANS: std::ops::RangeInclusive<f64> = 0.01..=10.0;
/// Time between two records of a step [s], after each of which it is looked whether somebody waits.
const RECORD: f64 = 0.1;
/// Bytes of the mark of a scenario, which a state begins with.
const MARK: usize = size_of::<u64>();

/// What is asked of a step.
struct StepAsked {
    scenario: LoadedScenario,
    /// Of its scenario, with all that it names.
    mark: u64,
    /// None to start.
    state: Option<State>,
    /// Of each wheel [m/s].
    rim_speeds: Vec<f64>,
    /// How long it is [s].
    span: f64,
    has_scene: bool,
    /// The command that reads the telemetry of the drive, where that is asked for.
    read_by: Option<CommandLine>,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let settings = RunSettings::of_start(&fields)?;
    let parts = ScenarioParts::of(&fields)?;
    let state = fields.text(STATE)?;
    let speeds = fields.numbers(RIM_SPEEDS, &RIM_SPEED_M_S, &[0.0])?;
    let span = fields.number("dt_s", &SPANS)?.unwrap_or(RECORD);
    let has_scene = fields.truth("scene")?;
    let has_telemetry = fields.truth(TELEMETRY)?;
    fields.finish()?;
    if parts.common().has_every_model() {
        let message = "a drive is of one model: name one, or leave it out";
        return Err(Refusal::of_key("model", message));
    }
    let scenario = parts.run(&console.folder, &settings, false)?;
    let mark = mark_of_run(&scenario);
    let state = state.map(|text| state_of(&text, mark, &scenario.value)).transpose()?;
    let rim_speeds = of_each_wheel(&speeds, &scenario.value)?;
    let read_by = has_telemetry.then(|| {
        let mut line = CommandLine::new("replay");
        line.word("drive.csv");
        parts.add_options(&mut line);
        line
    });
    let asked = StepAsked { scenario, mark, state, rim_speeds, span, has_scene, read_by };
    Ok(Question::new(move |go_on, send| {
        let is_quick = asked.scenario.value.ground.is_plane() && !asked.has_scene;
        let turn = if is_quick { None } else { go_on.turn() };
        if turn.is_none() && !is_quick {
            return Err(Refusal::stopped());
        }
        let answer = asked.answer(go_on)?;
        drop(turn);
        send(json::line(&answer));
        Ok(())
    }))
}

/// The mark of a scenario with all that it names.
fn mark_of_run(scenario: &LoadedScenario) -> u64 {
    let map = match &scenario.value.ground.shape {
        Shape::Map(model) => Some(&**model),
        _ => None,
    };
    mark_of(&scenario.document, &scenario.companions, map)
}

/// The state that an answer had, if it is of this scenario.
fn state_of(text: &str, mark: u64, scenario: &Scenario) -> Result<State, Refusal> {
    let refused = |message: String| Refusal::of_key(STATE, message);
    let bytes = from_base64(text).ok_or_else(|| refused("it must be base64".to_owned()))?;
    let (own, bytes) = bytes
        .split_first_chunk::<MARK>()
        .ok_or_else(|| refused("it must be the state of an answer".to_owned()))?;
    if u64::from_le_bytes(*own) != mark {
        let message = "the state is of another scenario than the question's";
        return Err(refused(message.to_owned())
            .with_hint("a drive starts without a state, and keeps rover, soil and ground"));
    }
    State::from_bytes(bytes, scenario).map_err(|error| refused(error.to_string()))
}

/// The rim speeds of the wheels, of one number for all, of two for the sides, left and right, or of
/// one for each. A wheel in the middle has the mean of the sides.
fn of_each_wheel(speeds: &[f64], scenario: &Scenario) -> Result<Vec<f64>, Refusal> {
    let mounts = scenario.rover.mounts();
    match *speeds {
        [one] => Ok(vec![one; mounts.len()]),
        [left, right] => {
            let of_side = |y: f64| match y {
                y if y > 0.0 => left,
                y if y < 0.0 => right,
                _ => 0.5 * (left + right),
            };
            Ok(mounts.iter().map(|mount| of_side(mount.position.y)).collect())
        }
        _ if speeds.len() == mounts.len() => Ok(speeds.to_vec()),
        _ => {
            let count = mounts.len();
            let message = format!(
                "{} numbers: it must be 1, 2 for the sides left and right, or {count} for the \
                 wheels",
                speeds.len()
            );
            Err(Refusal::of_key(RIM_SPEEDS, message))
        }
    }
}

impl StepAsked {
    fn answer(&self, go_on: &dyn GoOn) -> Result<Value, Refusal> {
        let run = self.run().map_err(failed)?;
        let (run, records) = self.stepped(run, go_on)?;
        let state = [&self.mark.to_le_bytes()[..], &run.state().to_bytes()].concat();
        let outcome = run.outcome().cloned();
        let driven = Trajectory {
            records,
            // One that is under way has none.
            outcome: outcome.clone().unwrap_or(Outcome::Completed),
            method: run.state().method().clone(),
            work: run.state().work(),
        };
        let scenario = run.scenario();
        let mut answer = json!({
            "schema": "grouser.drive-step.v1",
            "version": env!("CARGO_PKG_VERSION"),
            "inputs": { RIM_SPEEDS: self.rim_speeds, "dt_s": self.span },
        });
        let object = json!(RunObject { run: &driven, scenario, derivatives: None });
        if let (Some(own), Value::Object(more)) = (answer.as_object_mut(), object) {
            own.extend(more);
        }
        answer["outcome"] = json!(outcome.as_ref().map(Outcome::name));
        answer["reason"] = json!(outcome.as_ref().and_then(Outcome::reason));
        answer[STATE] = json!(base64(&state));
        if let Some(command) = &self.read_by {
            answer[TELEMETRY] =
                json!({ "csv": self.telemetry(&driven, scenario), "command": command.text() });
        }
        if self.has_scene {
            let scene = scene_of(&title_of(&self.scenario), &driven, scenario);
            answer["scene"] = json!(base64(&scene));
        }
        Ok(answer)
    }

    /// What perfect instruments say of the step, as lines that follow those of the step before: the
    /// first step has the header, and the others leave out their first record, which is the last of
    /// the step before.
    fn telemetry(&self, driven: &Trajectory, scenario: &Scenario) -> String {
        let (header, known) = match self.state {
            None => (csv_header(&scenario.rover), 0),
            Some(_) => (String::new(), 1),
        };
        let seen = truth(driven, scenario);
        [header].into_iter().chain(seen[known..].iter().map(csv_line)).collect()
    }

    /// The run before the step: where its state has it, or at the start with the wheels turning as
    /// they are asked to.
    fn run(&self) -> Result<Run, RunError> {
        let scenario = &self.scenario.value;
        match &self.state {
            Some(state) => Ok(Run::resume(scenario, state.clone())),
            None => Run::with_controller(scenario, &mut |_: &Observation<'_>, rims: &mut [f64]| {
                rims.copy_from_slice(&self.rim_speeds);
            }),
        }
    }

    /// The run after the step, with records on its way, the first of which is its beginning.
    fn stepped(&self, mut run: Run, go_on: &dyn GoOn) -> Result<(Run, Vec<Record>), Refusal> {
        let mut records = vec![run.now().clone()];
        let pieces = (self.span / RECORD - 1e-9).ceil().max(1.0);
        let (mut piece, span) = (0.0, self.span / pieces);
        while piece < pieces && run.outcome().is_none() {
            if !go_on.is_on() {
                return Err(Refusal::stopped());
            }
            let before = run.state().rim_speeds().to_vec();
            run.step(&self.rim_speeds, span).map_err(failed)?;
            run.start_rolling(&before);
            records.push(run.now().clone());
            piece += 1.0;
        }
        Ok((run, records))
    }
}

/// Why a step cannot be computed.
#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn failed(error: RunError) -> Refusal {
    Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string())
}
