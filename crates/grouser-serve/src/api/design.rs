//! `design`: the numbers of a rover that are the best under limits, as `grouser design` finds them.

use grouser::answers::design::DesignQuestion;
use grouser::answers::{Answer, AnswerOptions, Sampling};
use grouser::document::design::Measure;
use grouser::document::{self, Described as _, DesignTask, Kind, json};
use grouser_draw::title_of;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::document::settable;
use super::fields::AskedFields;
use super::parts::StudyParts;
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

const DESIGN: (Kind, &str) = (Kind::Design, "design");

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StudyParts::of(&fields, DESIGN)?;
    let is_nominal = fields.truth("nominal")?;
    let seed = fields.counts("seed", &(0..=u64::MAX))?.and_then(|seed| seed.first().copied());
    let trade = trade(&fields)?;
    let stages = Stages::of(&fields, None)?;
    fields.finish()?;
    if stages.has_samples() {
        let message = "a search has samples of its own, where soils are uncertain";
        return Err(Refusal::of_key("samples", message));
    }
    let task = parts.read(&console.folder, document::read_design)?;
    let mut line = CommandLine::new("design");
    parts.add_words(&mut line);
    if let Some([one, other]) = trade {
        line.option("trade", &format!("{},{}", one.name(), other.name()));
    }
    if is_nominal {
        line.flag("nominal");
    }
    line.maybe("seed", seed.map(|it| it.to_string()).as_deref());
    let (seed, by_models) = (seed.unwrap_or(1), Vec::new());
    let question = DesignQuestion { task, is_nominal, seed, trade, by_models };
    Ok(stages.in_turn().question(question, line))
}

/// Two measures that are traded for one another.
fn trade(fields: &AskedFields) -> Result<Option<[Measure; 2]>, Refusal> {
    const KEY: &str = "trade";
    let measure = |name: String| {
        Measure::ALL.into_iter().find(|it| it.name() == name).ok_or_else(|| {
            let words = Measure::ALL.map(Measure::name).join(", ");
            let message = format!("there is no measure `{name}`");
            Refusal::of_key(KEY, message).with_hint(format!("they are {words}"))
        })
    };
    let all = fields.texts(KEY)?.into_iter().map(measure).collect::<Result<Vec<_>, _>>()?;
    match all[..] {
        [] => Ok(None),
        [one, other] if one != other => Ok(Some([one, other])),
        _ => Err(Refusal::of_key(KEY, "it must be two measures")),
    }
}

/// The task of a design: its numbers, and what may be traded.
pub(super) fn task(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StudyParts::of(&fields, DESIGN)?;
    fields.finish()?;
    let task = parts.read(&console.folder, document::read_design)?;
    Ok(Question::new(move |_, send| {
        let measures = Measure::ALL.map(|it| json!({ "name": it.name(), "meaning": it.doc() }));
        send(json::line(&json!({
            "schema": "grouser.session.v1",
            "names": { "design": task.document.name() },
            "assumptions": task.assumptions,
            "documents": { "design.toml": task.to_toml() },
            "keys": super::document::study_keys(Kind::Design, &task.document),
            "free": task.value.free.iter().flat_map(|it| ends_of(&task.value, it)).collect::<Vec<_>>(),
            "measures": measures,
        })));
        Ok(())
    }))
}

/// The ends between which a number is free, as numbers that may be set.
fn ends_of(task: &DesignTask, (path, ends): &(String, [f64; 2])) -> [Value; 2] {
    let rover = &task.candidates[0].grounds[0].scenario.value;
    [0, 1].map(|end| {
        let key = format!("{}.free.{path}.{end}", Kind::Design);
        settable((key, ends[end]), (Kind::Scenario, path), rover.range(path).as_ref())
    })
}

impl Staged for DesignQuestion {
    fn sample(&mut self, _: Option<Sampling>) {}

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        self.answer("design", options).map_err(refused)
    }

    fn counts(&self) -> Option<&'static str> {
        Some("designs measured")
    }

    fn whose(&self) -> String {
        title_of(&self.task.value.candidates[0].grounds[0].scenario)
    }

    fn add_samples(&self, _: &mut CommandLine, _: Option<Sampling>) {}
}
