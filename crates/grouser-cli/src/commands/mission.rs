//! `grouser mission`: drives a rover through legs, with limits at which it stops.

mod answered;
mod believed;
mod page;

use grouser::document::columns::TIME;
use grouser::document::columns::mission::{MissionObject, legs_brief, missions_brief};
use grouser::document::columns::run;
use grouser::document::given_file::GivenFile;
use grouser::document::given_to_drives;
use grouser::studies::mission::DrivenMission;
use grouser_draw::style::on_both_grounds;
use grouser_draw::{Shown, title_of};
use serde::Serialize;
use serde_json::json;

use self::answered::{Answered, reasons, sentence};
use self::believed::Believed;
use super::destinations::Destinations;
use super::{Answer, add_files, method, sampling, strict};
use crate::args::{MissionArgs, StrictArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::slide::SlideFile;
use crate::output::text::Text;
use crate::output::{self, Format, remedy};
use crate::report::REPORT;
use crate::report::answer::drawing_of_ground;

pub(crate) fn run(args: &MissionArgs) -> Result<(), Failure> {
    let destinations = Destinations::of(&args.run, &args.output)?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let document = inputs::mission::read(args)?;
    let Destinations { mut folder, animation, log, telemetry } = destinations;
    let missions = document.value.missions();
    for (flag, is_given) in [("--mcap", log.is_some()), ("--telemetry", telemetry.is_some())] {
        if is_given && missions.len() > 1 {
            return Err(Failure::Usage(format!(
                "{flag} logs one mission: this one has alternatives, each of which would be one"
            )));
        }
    }
    let has_records = folder.is_some()
        || animation.is_some()
        || log.is_some()
        || telemetry.is_some()
        || slide.is_some()
        || args.strict.strict
        // Which zones are met is seen of records.
        || document.value.scenario.ground.zones.is_some();
    let drive = if has_records { DrivenMission::all } else { DrivenMission::all_ends };
    let ways = drive(&missions)?;
    let believed = match args.belief.sampling() {
        Some(sampling) => Some(Believed::of(args, &document, (&missions, &ways), sampling)?),
        None => None,
    };
    let answered = Answered { document, ways, believed };
    answered.check(&args.strict)?;
    if let Some(animation) = animation {
        animation.write(&title_of(&answered.document), &answered.shown(), folder.as_mut())?;
    }
    if let (Some(log), [one]) = (log, &answered.ways[..]) {
        log.write_mission(&answered.document, one, folder.as_mut())?;
    }
    if let (Some(telemetry), [one]) = (telemetry, &answered.ways[..]) {
        let scenario = &answered.document.value.scenario;
        telemetry.write(scenario, &one.report.trajectory, folder.as_mut())?;
    }
    if let (Some(slide), Some(first)) = (slide, answered.ways.first()) {
        let risk =
            answered.believed.as_ref().and_then(|it| it.sentences(0, first).into_iter().next());
        let says = risk.unwrap_or_else(|| sentence(first));
        slide.write(&says, &answered.path(first), &title_of(&answered.document))?;
    }
    answered.output(args, folder)
}

/// The results: of one mission, or of each alternative.
#[derive(Serialize)]
#[serde(untagged)]
enum Results<'a> {
    One(MissionObject<'a>),
    Several { alternatives: Vec<MissionObject<'a>> },
}

impl Answered {
    /// Checks that nothing is extrapolated, where that is asked for.
    fn check(&self, strict: &StrictArgs) -> Result<(), Failure> {
        if !strict.strict {
            return Ok(());
        }
        let scenario = &self.document.value.scenario;
        self.ways.iter().try_for_each(|way| {
            let run = &way.report.trajectory;
            let flags = run::each_findings(run, scenario);
            let records = run::table(run, scenario);
            strict::check(strict, flags.iter().map(|it| &**it), &records, &[TIME.name])
        })
    }

    /// For a picture.
    fn shown(&self) -> Vec<Shown<'_>> {
        let (title, scenario) = (self.document.document.name(), &self.document.value.scenario);
        let mut all = Vec::new();
        for way in &self.ways {
            let name = if way.name.is_empty() { title } else { &way.name };
            all.push(Shown { name, run: &way.report.trajectory, scenario });
        }
        all
    }

    fn output(&self, args: &MissionArgs, folder: Option<OutputFolder>) -> Result<(), Failure> {
        let rows = Rows::of_table(&self.table());
        let object = |(place, mission)| {
            let believed = self.believed.as_ref().map(|it| it.way(place));
            MissionObject { mission, believed }
        };
        let results = match &self.ways[..] {
            [one] => Results::One(object((0, one))),
            ways => {
                Results::Several { alternatives: ways.iter().enumerate().map(object).collect() }
            }
        };
        let mut inputs = json!({ "mission": self.document.document });
        if let Some(Believed { belief, rule, sampling, .. }) = &self.believed {
            inputs["rule"] = json!(rule);
            inputs["samples"] = sampling.count.into();
            inputs["seed"] = sampling.seed.into();
            inputs[sampling::BELIEF] = belief.clone();
        }
        add_files(&mut inputs, &self.given());
        let answer = Answer::new("mission", inputs, results);
        if let Some(mut folder) = folder {
            folder.add("mission.json", answer.to_text());
            folder.add("mission.csv", rows.to_csv()?);
            for (place, way) in self.ways.iter().enumerate() {
                let end = self.ending(place);
                let legs = Rows::of_table(&way.table()).to_csv()?;
                folder.add(format!("legs{end}.csv"), legs);
                let records = Rows::of_table(&self.records(way)).to_csv()?;
                folder.add(format!("records{end}.csv"), records);
                folder.add(format!("path{end}.svg"), on_both_grounds(&self.path(way)));
                let (scenario, run) = (&self.document.value.scenario, &way.report.trajectory);
                if let Some(drawing) = drawing_of_ground(scenario, &run.records) {
                    folder.add(format!("ground{end}.svg"), drawing);
                }
            }
            folder.add(REPORT, page::html(self));
            folder.add_document("mission.toml", &self.document);
            folder.finish()?;
        }
        match args.output.format {
            Format::Table => output::show(self.text()),
            Format::Csv => output::print(&rows.to_csv()?),
            Format::Json => output::print_json(&answer),
        }
    }

    /// What the files gave.
    fn given(&self) -> Vec<GivenFile> {
        let drives = self.ways.iter().map(|way| &way.report.trajectory);
        given_to_drives(&self.document, &self.document.value.scenario, drives)
    }

    /// The end of the names of a way's files: its number, where there are several.
    fn ending(&self, place: usize) -> String {
        if self.ways.len() > 1 { format!("-{}", place + 1) } else { String::new() }
    }

    fn text(&self) -> Text {
        let blocks = self.ways.iter().enumerate().map(|(place, way)| {
            let name = if way.name.is_empty() { String::new() } else { format!("{}\n", way.name) };
            let legs = way.table();
            let legs = Rows::of_table(&legs).to_table(&legs_brief(&legs));
            let run = &way.report.trajectory;
            let simulation = method::line(run, &self.document.value.scenario);
            let sentences = reasons(way) + &sentence(way) + "\n" + &simulation;
            let risk = self.believed.as_ref().map_or_else(Vec::new, |it| it.sentences(place, way));
            let risk: String = risk.into_iter().map(|line| line + "\n").collect();
            Text::from(name + &risk) + legs + Text::from(sentences)
        });
        let blocks = Text::blocks(blocks);
        let is_draft = self.believed.as_ref().is_some_and(|it| sampling::are_few(it.sampling));
        let draft = Text::from(if is_draft { sampling::DRAFT_LINE } else { "" });
        let reasons = self.believed.iter().flat_map(Believed::reasons);
        let hints = remedy::of_reasons(reasons).into_iter().map(|hint| Text::from(hint + "\n"));
        let draft = draft + hints.collect::<Text>() + output::answer::given(&self.given());
        if self.ways.len() == 1 {
            return blocks + draft;
        }
        let missions = self.table();
        let missions = Rows::of_table(&missions).to_table(&missions_brief(&missions));
        blocks + Text::from("\n") + missions + draft
    }
}
