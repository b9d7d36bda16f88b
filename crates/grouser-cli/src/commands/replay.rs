//! `grouser replay`: a drive that was measured beside the one that is predicted.

mod found;
mod page;

use grouser::document::LoadedScenario;
use grouser::document::columns::replay as columns;
use grouser::document::columns::{SLOPE, TIME};
use grouser::document::table::{Row, Table};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::replay::{Replay, Replayer};
use serde::Serialize;
use serde_json::{Value, json};

use self::found::Found;
use super::{Answer, log, sampling};
use crate::args::ReplayArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

#[derive(Serialize)]
struct Results<'a> {
    points_to: &'a [String],
    findings: &'a Table,
    channels: &'a Table,
    #[serde(skip_serializing_if = "Option::is_none")]
    work: Option<Row<'a>>,
    stretches: &'a Table,
    replayed: Value,
    notes: &'a [String],
}

pub(crate) fn run(args: &ReplayArgs) -> Result<(), Failure> {
    let mut folder = OutputFolder::for_args(&args.output)?;
    let (has_folder, may_replace) = (folder.is_some(), args.output.force);
    let target = args.mcap.as_deref().map(|it| log::Target::of(it, has_folder, may_replace));
    let target = target.transpose()?;
    let (scenario, found) = replay(args)?;
    let work = found.replay.energy.map(|energy| Table::of(&columns::WORK, &[energy]));
    let results = Results {
        points_to: &found.sentences,
        findings: &found.findings,
        channels: &found.channels,
        work: work.as_ref().map(|table| table.row(0)),
        stretches: &found.over_time,
        replayed: replayed(&found.replay),
        notes: &found.notes,
    };
    let answer = Answer::new("replay", settings(args, &scenario), results);
    if let Some(target) = target {
        target.write_replay(&scenario, &found.replay, folder.as_mut())?;
    }
    if let Some(mut folder) = folder {
        folder.add("replay.json", answer.to_text());
        folder.add("replay.csv", Rows::of_table(&found.over_time).to_csv()?);
        folder.add("channels.csv", Rows::of_table(&found.channels).to_csv()?);
        folder.add("findings.csv", Rows::of_table(&found.findings).to_csv()?);
        folder.add(REPORT, page::html(args, &scenario, &found));
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(page::text(&found)),
        Format::Csv => output::print(&Rows::of_table(&found.over_time).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

fn replay(args: &ReplayArgs) -> Result<(LoadedScenario, Found), Failure> {
    let (scenario, samples) = inputs::replay(args)?;
    let slope = scenario.value.ground.plane_slope().filter(|_| args.slope_deg.is_some());
    let mut replayer = Replayer::new(&scenario.value, slope);
    let (label, read) = read(args, &scenario, &mut replayer)?;
    let replay = sampling::with_bar(samples.len(), |go_on| replayer.finish(&samples, go_on));
    let replay = replay.map_err(|error| Failure::Usage(format!("{label}: {error}")))?;
    let (replay, rover) = (sampling::whole(replay), &scenario.value.rover);
    let found = Found {
        over_time: columns::over_time(&replay, rover),
        channels: columns::channels(&replay, rover),
        findings: columns::findings(&replay),
        sentences: columns::sentences(&replay),
        notes: read.into_iter().chain(columns::notes(&replay)).collect(),
        replay,
    };
    Ok((scenario, found))
}

/// Gives all records of the log to the replayer; what messages call the log, and notes on what was
/// left out of it.
fn read(
    args: &ReplayArgs,
    scenario: &LoadedScenario,
    replayer: &mut Replayer,
) -> Result<(String, Vec<String>), Failure> {
    let mut log = inputs::telemetry(&args.log, &args.telemetry, &scenario.value.rover, None)?;
    while let Some(record) = log.next_record()? {
        replayer.update(record);
    }
    Ok((log.label().to_owned(), log.notes()))
}

/// How much was replayed.
fn replayed(replay: &Replay) -> Value {
    json!({
        "records": replay.taken.records,
        "stretches": replay.taken.stretches,
        "compared_stretches": replay.stretches.len(),
        "explained_stretches": replay.explained_stretches,
        "outliers": replay.taken.outliers,
        "free_run": {
            (SLOPE.name): SLOPE.unit.from_si(replay.free_run.slope),
            "starts": replay.free_run.starts.len(),
            "ended": replay.free_run.ended.as_ref().map(|(time, _)| json!({ (TIME.name): time })),
        },
    })
}

/// The inputs of the answer.
fn settings(args: &ReplayArgs, scenario: &LoadedScenario) -> Value {
    let document = &scenario.document;
    let sampled = args.uncertainty.sampling.uncertainty;
    json!({
        "log": args.log.display().to_string(),
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "slope_deg": args.slope_deg.as_ref().and_then(|_| document.get("slope_deg")),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "model": scenario.value.model.name(),
        "samples": sampled.then_some(args.uncertainty.sampling.samples),
        "seed": sampled.then_some(args.uncertainty.seed),
        (sampling::WEIGHTS): sampled.then(|| sampling::weights(&BandInputs::of_scenario(scenario))),
    })
}
