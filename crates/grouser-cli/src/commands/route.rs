//! `grouser route`: the cheapest way over a map of heights.

mod geojson;
mod page;
mod record;

use std::sync::Arc;

use grouser::document::columns::{SLOPE, YAW};
use grouser::document::route::RouteRecord;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::mobility::Ground;
use grouser::studies::route::{
    Answer as Found, COURSES, DrivenRoute, Objective, Route, RouteError, RouteTables,
};
use serde::Serialize;
use serde_json::{Value, json};

use self::record::Brief;
use super::{Answer, sampling};
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::inputs::{self, RouteInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

/// A way that was found, or why there is none.
struct Way {
    objective: Objective,
    found: Found,
    driven: Option<DrivenRoute>,
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    best: &'a RouteRecord,
    straight_m: f64,
    coordinate_system: String,
    alternatives: &'a [RouteRecord],
}

pub(crate) fn run(args: &RouteArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::route(args)?;
    let chosen: Objective = args.minimise.into();
    let mut wanted = vec![chosen];
    if args.alternatives {
        wanted.extend(Objective::ALL.into_iter().filter(|it| *it != chosen));
    }
    let samples = samples(args, &inputs)?;
    let with_risk = wanted.contains(&Objective::Risk);
    let tables = sampling::with_bar(samples.len().max(1) * COURSES, |go_on| {
        inputs.study.tables(&samples, with_risk, go_on)
    });
    let tables = sampling::whole(tables?);
    let ways = wanted.into_iter().map(|objective| way(args, &inputs, &tables, objective));
    let ways = ways.collect::<Result<Vec<Way>, Failure>>()?;
    let records: Vec<RouteRecord> = ways.iter().map(Way::record).collect();
    let results = Results {
        best: &records[0],
        straight_m: inputs.ends.distance(),
        coordinate_system: inputs.raster.coordinates.name(),
        alternatives: &records[1..],
    };
    let answer = Answer::new("route", settings(args, &inputs), results);
    let rows = Rows::of(&records.iter().map(Brief::of).collect::<Vec<_>>());
    if let Some(mut folder) = folder {
        folder.add("route.json", answer.to_text());
        folder.add("route.csv", rows.to_csv()?);
        folder.add("route.geojson", geojson::text(&ways));
        folder.add("route.svg", page::picture(&inputs, &ways));
        folder.add(REPORT, page::html(args, &inputs, &ways, &records, &rows));
        folder.add_document("scenario.toml", &inputs.scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let lines: String = records.iter().map(record::line).collect();
            output::show(rows.to_table(&Brief::COLUMNS) + lines)
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

impl Way {
    fn record(&self) -> RouteRecord {
        RouteRecord::of(self.objective, &self.found, self.driven.as_ref())
    }
}

fn samples(args: &RouteArgs, inputs: &RouteInputs) -> Result<Vec<Sample>, Failure> {
    let band = BandInputs::of_scenario(&inputs.scenario);
    if band.is_certain() {
        return Ok(Vec::new());
    }
    sampling::draw(&band, args.samples, args.seed)
}

impl From<RouteError> for Failure {
    fn from(error: RouteError) -> Self {
        Self::Usage(error.to_string())
    }
}

fn way(
    args: &RouteArgs,
    inputs: &RouteInputs,
    tables: &RouteTables,
    objective: Objective,
) -> Result<Way, Failure> {
    let RouteInputs { study, ends, raster, .. } = inputs;
    let ground = Ground::under(&study.mobility.heading.rover, raster);
    let bar = output::progress_bar(0);
    bar.set_message(format!("least {}", objective.name()));
    let found = study.route(tables, ground, ends, objective)?;
    bar.finish_and_clear();
    let driven = match &found {
        Found::Route(route) if !args.no_drive => Some(drive(route, inputs)?),
        _ => None,
    };
    Ok(Way { objective, found, driven })
}

/// Drives a way by simulation.
fn drive(route: &Route, inputs: &RouteInputs) -> Result<DrivenRoute, Failure> {
    let scenario = &inputs.scenario.value;
    let model = inputs.raster.clone().model(scenario.site.terrain.soil);
    let model = model.map_err(|error| Failure::Run(error.to_string()))?;
    let bar = output::progress_bar(0);
    bar.set_message("driving the way");
    let driven = route.drive(scenario, &Arc::new(model), inputs.study.mobility.rim_speed);
    bar.finish_and_clear();
    driven.map_err(|error| Failure::Run(format!("the way cannot be driven: {error}")))
}

/// The inputs of the answer.
fn settings(args: &RouteArgs, inputs: &RouteInputs) -> Value {
    let document = &inputs.scenario.document;
    let band = BandInputs::of_scenario(&inputs.scenario);
    let limits = inputs.study.limits;
    json!({
        "dem": args.dem,
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "model": inputs.scenario.value.theory.name(),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "from_m": [inputs.ends.from.x, inputs.ends.from.y],
        "to_m": [inputs.ends.to.x, inputs.ends.to.y],
        "yaw_deg": inputs.ends.yaw.map(|yaw| YAW.unit.from_si(yaw)),
        "keep_out": args.keep_out,
        "most_slope_deg": SLOPE.unit.from_si(limits.most_slope),
        "most_slip_ratio": limits.most_slip_ratio,
        "most_no_go": limits.most_no_go,
        "rim_speed_m_s": inputs.study.mobility.rim_speed,
        "samples": args.samples,
        "seed": args.seed,
        (sampling::SHARES): sampling::shares(&band),
    })
}
