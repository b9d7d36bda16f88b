//! `mission`: a rover that drives legs, with limits at which it stops, as `grouser mission --nominal`
//! has it. It is looked between legs whether somebody still waits.

use std::cell::RefCell;

use grouser::answers::{Answer, AnswerError, AnswerOptions, Member, Sampling};
use grouser::document::columns::Quantity;
use grouser::document::columns::mission::{MissionObject, legs_brief};
use grouser::document::columns::run::RunObject;
use grouser::document::reading::capitalised;
use grouser::document::{
    self, Kind, LoadedMission, given_to_drives, json, label_of, limited_quantity,
};
use grouser::mission::{Limited, Mission, MissionReport, MissionRun};
use grouser::studies::mission::{DrivenLeg, DrivenMission};
use grouser_draw::{Sheet, path_of, title_of};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::StudyParts;
use super::staged::{Staged, Stages, refused, scene_of};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

const MISSION: (Kind, &str) = (Kind::Mission, "mission");
/// Records of a mission at the most.
const RECORDS: usize = 20_000;

/// What is asked of a mission.
struct MissionAsked {
    document: LoadedMission,
    driven: RefCell<Vec<DrivenMission>>,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StudyParts::of(&fields, MISSION)?;
    let stages = Stages::of(&fields, None)?.with_scene(&fields)?;
    fields.finish()?;
    if stages.has_samples() {
        let message = "missions are driven on the soil as written";
        return Err(Refusal::of_key("samples", message));
    }
    let document = parts.read(&console.folder, document::read_mission)?;
    let mut line = CommandLine::new("mission");
    parts.add_words(&mut line);
    line.flag("nominal");
    Ok(stages.in_turn().question(MissionAsked { document, driven: RefCell::default() }, line))
}

/// A mission's legs and limits, which may be changed.
pub(super) fn task(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StudyParts::of(&fields, MISSION)?;
    fields.finish()?;
    let mission = parts.read(&console.folder, document::read_mission)?;
    Ok(Question::new(move |_, send| {
        let document = &mission.document;
        send(json::line(&json!({
            "schema": "grouser.session.v1",
            "names": {
                "mission": document.name(),
                "rover": document.name_of("rover"),
                "soil": document.name_of("soil"),
            },
            "assumptions": mission.assumptions,
            "documents": { "mission.toml": mission.to_toml() },
            "keys": super::document::study_keys(Kind::Mission, document),
            "legs": document.get("leg"),
            "limits": Limited::ALL.map(limit),
        })));
        Ok(())
    }))
}

/// A number that may be limited, and the key of its limit in every leg.
fn limit(limited: Limited) -> Value {
    let Quantity { name, unit } = limited_quantity(limited);
    let path = format!("stop.{name}.above");
    let range = document::range(Kind::Mission, &path);
    json!({
        "key": format!("mission.{path}"),
        "label": label_of(name),
        "meaning": limited.row().meaning,
        "minimum": range.as_ref().map(|it| *it.start()),
        "maximum": range.as_ref().map(|it| *it.end()),
        "unit": unit.symbol,
    })
}

/// Drives a mission while somebody waits for it.
fn driven(mission: &Mission, go_on: &dyn Fn() -> bool) -> Result<MissionReport, Refusal> {
    let failed = |error: String| Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error);
    let mut run = MissionRun::new(mission).map_err(|error| failed(error.to_string()))?;
    let mut records = 0;
    loop {
        if !go_on() {
            return Err(refused(AnswerError::Stopped));
        }
        let mut watch = |new: &[_]| {
            // Those that were not taken come again.
            records = records.max(new.len());
            // What is too much anyway needs no memory.
            records > RECORDS
        };
        let leg = run.next_leg_watched(&mut watch).map_err(|error| failed(error.to_string()))?;
        let is_over = leg.is_none();
        if records > RECORDS {
            let refusal = failed(format!("this mission has more than {RECORDS} records"));
            return Err(refusal.with_hint("a longer `mission.sample_interval_s` has fewer"));
        }
        if is_over {
            return Ok(run.finish());
        }
    }
}

/// What became of a mission, and why.
fn said(way: &DrivenMission) -> String {
    let (begun, all) = (way.legs.len(), way.planned);
    let end = capitalised(&way.report.kind().in_words());
    let reason = way.legs.last().and_then(DrivenLeg::reason);
    let reason = reason.map_or_else(String::new, |reason| format!(": {reason}"));
    format!("{end}, leg {begun} of {all}{reason}")
}

impl Staged for MissionAsked {
    fn sample(&mut self, _: Option<Sampling>) {}

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let missions = self.document.value.missions();
        let each = missions.iter().map(|(name, mission)| {
            Ok(DrivenMission::of(name, mission, driven(mission, options.go_on)?))
        });
        let ways = each.collect::<Result<Vec<_>, Refusal>>()?;
        let object = |mission| json!(MissionObject { mission, believed: None });
        let mut answer = Answer::new("mission", "A mission");
        answer.input("mission", json!(self.document.document));
        answer.results = match &ways[..] {
            [one] => match object(one) {
                Value::Object(entries) => vec![Member::Entries(entries)],
                _ => Vec::new(),
            },
            several => {
                let all = several.iter().map(object).collect();
                vec![Member::Value("alternatives", Value::Array(all))]
            }
        };
        for way in &ways {
            answer.verdict(said(way));
            let table = std::sync::Arc::new(way.table());
            let columns = legs_brief(&table);
            answer.rows("What became of each leg", &table, columns);
        }
        answer.attach("mission.toml", &self.document);
        let runs = ways.iter().map(|way| &way.report.trajectory);
        answer.given = given_to_drives(&self.document, &self.document.value.scenario, runs);
        self.driven.replace(ways);
        Ok(answer)
    }

    fn whose(&self) -> String {
        title_of(&self.document)
    }

    fn picture(&self) -> Option<Sheet> {
        let ways = self.driven.borrow();
        let title = "The path, seen from above";
        ways.first().map(|way| path_of(title, &self.document.value.scenario.rover, &way.report))
    }

    fn scene(&self) -> Option<Vec<u8>> {
        let (ways, scenario) = (self.driven.borrow(), &self.document.value.scenario);
        ways.first().map(|way| scene_of(&self.whose(), &way.report.trajectory, scenario))
    }

    fn add_samples(&self, _: &mut CommandLine, _: Option<Sampling>) {}

    fn add_shown(&self, shown: &mut Value) -> Result<(), Refusal> {
        let ways = self.driven.borrow();
        let scenario = &self.document.value.scenario;
        shown["verdict"] = json!(ways.first().map(said));
        shown["run"] =
            json!(ways.first().map(|way| {
                RunObject { run: &way.report.trajectory, scenario, derivatives: None }
            }));
        Ok(())
    }
}
