//! `grouser route`: the cheapest way over a map of heights, or what a given one takes.

mod geojson;
mod page;
mod record;
mod way;

use std::sync::Arc;

use grouser::answers;
use grouser::document::columns::{SLOPE, YAW};
use grouser::document::route::RouteRecord;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::mobility::Ground;
use grouser::studies::route::{
    Answer as Found, COURSES, DrivenRoute, Ends, Line, Objective, Route, RouteError, RouteTables,
};
use serde::Serialize;
use serde_json::{Value, json};

use self::record::Brief;
use self::way::Way;
use super::{Answer, sampling};
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::inputs::{self, Asked, RouteInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

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
    let samples = samples(args, &inputs)?;
    let wanted = objectives(args);
    let with_risk = args.along.is_none() && wanted.contains(&Objective::Risk);
    let tables = sampling::with_bar(samples.len().max(1) * COURSES, |go_on| {
        inputs.study.tables(&samples, with_risk, go_on)
    });
    let tables = sampling::whole(tables?);
    let ways = match &inputs.asked {
        Asked::Between(ends) => {
            let ways = wanted.into_iter().map(|it| sought(args, &inputs, &tables, ends, it));
            ways.collect::<Result<Vec<Way>, Failure>>()?
        }
        Asked::Along(line) => vec![given(args, &inputs, &tables, line)?],
    };
    let records: Vec<RouteRecord> = ways.iter().map(|way| way.record.clone()).collect();
    let results = Results {
        best: &records[0],
        straight_m: inputs.asked.distance(),
        coordinate_system: inputs.raster.coordinates.name(),
        alternatives: &records[1..],
    };
    let answer = Answer::new("route", settings(args, &inputs), results);
    let rows = Rows::of(&records.iter().map(Brief::of).collect::<Vec<_>>());
    if let Some(mut folder) = folder {
        folder.add("route.json", answer.to_text());
        folder.add("route.csv", rows.to_csv()?);
        folder.add("route.geojson", geojson::text(&records[0]));
        folder.add("route.svg", page::picture(&inputs, &ways));
        folder.add(REPORT, page::html(args, &inputs, &ways, &records, &rows));
        folder.add_document("scenario.toml", &inputs.scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let lines: String = records.iter().map(record::lines).collect();
            output::show(rows.to_table(&Brief::COLUMNS) + lines)
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

impl Asked {
    /// The straight line from start to target [m].
    fn distance(&self) -> f64 {
        match self {
            Self::Between(ends) => ends.distance(),
            Self::Along(line) => line.straight(),
        }
    }
}

/// What ways are to have least of, the one that is asked for first.
fn objectives(args: &RouteArgs) -> Vec<Objective> {
    let chosen: Objective = args.minimise.into();
    let others = Objective::ALL.into_iter().filter(|it| args.alternatives && *it != chosen);
    std::iter::once(chosen).chain(others).collect()
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

fn sought(
    args: &RouteArgs,
    inputs: &RouteInputs,
    tables: &RouteTables,
    ends: &Ends,
    objective: Objective,
) -> Result<Way, Failure> {
    let RouteInputs { study, raster, .. } = inputs;
    let ground = Ground::under(&study.mobility.heading.rover, raster);
    let bar = output::progress_bar(0);
    bar.set_message(format!("least {}", objective.name()));
    let found = study.route(tables, ground, ends, objective)?;
    bar.finish_and_clear();
    let route = match &found {
        Found::Route(route) => Some(route),
        Found::NoSafeRoute(_) => None,
    };
    let driven = drive(args, route, inputs)?;
    Ok(Way {
        record: RouteRecord::of(objective, &found, driven.as_ref()),
        places: route.map(|it| it.waypoints.clone()).unwrap_or_default(),
    })
}

fn given(
    args: &RouteArgs,
    inputs: &RouteInputs,
    tables: &RouteTables,
    line: &Line,
) -> Result<Way, Failure> {
    let RouteInputs { study, raster, .. } = inputs;
    let ground = Ground::under(&study.mobility.heading.rover, raster);
    let found = study.along(tables, ground, line)?;
    let driven = drive(args, found.route.as_ref(), inputs)?;
    Ok(Way {
        record: RouteRecord::of_line(line, &found, &study.limits, driven.as_ref()),
        places: line.places().to_vec(),
    })
}

/// Drives a way by simulation, if there is one and that is asked for.
fn drive(
    args: &RouteArgs,
    route: Option<&Route>,
    inputs: &RouteInputs,
) -> Result<Option<DrivenRoute>, Failure> {
    let Some(route) = route.filter(|_| !args.no_drive) else { return Ok(None) };
    let scenario = &inputs.scenario.value;
    let model = inputs.raster.clone().model();
    let model = model.map_err(|error| Failure::Run(error.to_string()))?;
    let bar = output::progress_bar(0);
    bar.set_message("driving the way");
    let driven = route.drive(scenario, &Arc::new(model), inputs.study.mobility.rim_speed);
    bar.finish_and_clear();
    driven.map(Some).map_err(|error| Failure::Run(format!("the way cannot be driven: {error}")))
}

/// The inputs of the answer.
fn settings(args: &RouteArgs, inputs: &RouteInputs) -> Value {
    let document = &inputs.scenario.document;
    let band = BandInputs::of_scenario(&inputs.scenario);
    let limits = inputs.study.limits;
    let (from, to, yaw) = match &inputs.asked {
        Asked::Between(ends) => (ends.from, ends.to, ends.yaw),
        Asked::Along(line) => (line.start(), line.end(), line.yaw),
    };
    let [from, to] = [from, to].map(|it| [it.x, it.y]);
    json!({
        "dem": args.dem,
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "model": inputs.scenario.value.model.name(),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "from_m": from,
        "to_m": to,
        "along": args.along,
        "yaw_deg": yaw.map(|yaw| YAW.unit.from_si(yaw)),
        "keep_out": args.keep_out,
        "most_slope_deg": SLOPE.unit.from_si(limits.most_slope),
        "most_slip_ratio": limits.most_slip_ratio,
        "most_no_go": limits.most_no_go,
        "rim_speed_m_s": inputs.study.mobility.rim_speed,
        "samples": args.samples,
        "seed": args.seed,
        (sampling::WEIGHTS): answers::weights(&band),
    })
}
