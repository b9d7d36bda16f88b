//! `grouser route`: the cheapest way over a map of heights.

mod geojson;
mod page;

use std::sync::Arc;

use grouser::document::columns::{ENERGY, SLOPE, TIME, YAW};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::mobility::Ground;
use grouser::studies::route::{
    Answer as Found, COURSES, DrivenRoute, Objective, Route, RouteError, RouteTables,
};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling};
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::inputs::{self, RouteInputs};
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, four_digits};
use crate::output::{self, Format};
use crate::report::REPORT;

/// A way, as it leaves.
#[derive(Clone, Serialize)]
struct RouteRecord {
    minimise: &'static str,
    /// `found` or `no-safe-route`.
    status: &'static str,
    reason: Option<String>,
    length_m: Option<f64>,
    time_s: Option<f64>,
    energy_j: Option<f64>,
    turned_deg: Option<f64>,
    mean_slip_ratio: Option<f64>,
    most_slip_ratio: Option<f64>,
    most_slope_deg: Option<f64>,
    probability_no_go: Option<f64>,
    waypoints: Vec<[f64; 2]>,
    simulated: Option<Simulated>,
}

/// What simulation makes of it.
#[derive(Clone, Serialize)]
struct Simulated {
    outcome: &'static str,
    legs: usize,
    length_m: f64,
    time_s: f64,
    energy_j: f64,
    slip_ratio: Option<f64>,
    miss_m: f64,
    /// How far the prediction is from it, over it [-].
    time_error: f64,
    energy_error: f64,
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    best: &'a RouteRecord,
    straight_m: f64,
    coordinate_system: String,
    alternatives: &'a [RouteRecord],
}

/// A way that was found, or why there is none.
struct Way {
    objective: Objective,
    found: Found,
    driven: Option<DrivenRoute>,
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
    let records: Vec<RouteRecord> = ways.iter().map(RouteRecord::of).collect();
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
        folder.add(REPORT, page::html(args, &inputs, &ways, &records, &rows));
        folder.add_document("scenario.toml", &inputs.scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let lines: String = records.iter().map(RouteRecord::line).collect();
            output::show(rows.to_table(&Brief::COLUMNS) + lines)
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
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

impl RouteRecord {
    fn of(way: &Way) -> Self {
        let minimise = way.objective.name();
        match &way.found {
            Found::Route(route) => Self {
                minimise,
                status: "found",
                reason: None,
                length_m: Some(route.length),
                time_s: Some(route.time),
                energy_j: Some(route.energy),
                turned_deg: Some(YAW.unit.from_si(route.turned)),
                mean_slip_ratio: Some(route.mean_slip_ratio),
                most_slip_ratio: Some(route.most_slip_ratio),
                most_slope_deg: Some(SLOPE.unit.from_si(route.most_slope)),
                probability_no_go: Some(route.probability_no_go),
                waypoints: route.waypoints.iter().map(|it| [it.x, it.y]).collect(),
                simulated: way.driven.as_ref().map(|driven| Simulated::of(route, driven)),
            },
            Found::NoSafeRoute(reason) => Self {
                minimise,
                status: "no-safe-route",
                reason: Some(reason.to_string()),
                length_m: None,
                time_s: None,
                energy_j: None,
                turned_deg: None,
                mean_slip_ratio: None,
                most_slip_ratio: None,
                most_slope_deg: None,
                probability_no_go: None,
                waypoints: Vec::new(),
                simulated: None,
            },
        }
    }

    /// What the table does not say.
    fn line(&self) -> String {
        match (&self.reason, &self.simulated) {
            (Some(reason), _) => format!("least {}: no safe route: {reason}\n", self.minimise),
            (None, Some(driven)) => format!(
                "least {}: driven by simulation: {}, {} s ({:+.1} %), {} J ({:+.1} %), {} m from the target\n",
                self.minimise,
                driven.outcome,
                four_digits(driven.time_s),
                100.0 * driven.time_error,
                four_digits(driven.energy_j),
                100.0 * driven.energy_error,
                four_digits(driven.miss_m)
            ),
            (None, None) => String::new(),
        }
    }
}

impl Simulated {
    fn of(route: &Route, driven: &DrivenRoute) -> Self {
        let error = |predicted: f64, simulated: f64| predicted / simulated - 1.0;
        Self {
            outcome: driven.outcome,
            legs: driven.legs,
            length_m: driven.distance,
            time_s: driven.time,
            energy_j: driven.energy,
            slip_ratio: driven.slip_ratio,
            miss_m: driven.miss,
            time_error: error(route.time, driven.time),
            energy_error: error(route.energy, driven.energy),
        }
    }
}

/// A row of the table.
#[derive(Serialize)]
struct Brief {
    minimise: &'static str,
    status: &'static str,
    length_m: Option<f64>,
    time_s: Option<f64>,
    energy_j: Option<f64>,
    turned_deg: Option<f64>,
    mean_slip_ratio: Option<f64>,
    most_slip_ratio: Option<f64>,
    most_slope_deg: Option<f64>,
    probability_no_go: Option<f64>,
    simulated_time_s: Option<f64>,
    simulated_energy_j: Option<f64>,
    reason: Option<String>,
}

impl Brief {
    const COLUMNS: [&'static str; 9] = [
        "minimise",
        "status",
        "length_m",
        TIME.name,
        ENERGY.name,
        "turned_deg",
        "most_slip_ratio",
        "most_slope_deg",
        "probability_no_go",
    ];

    fn of(record: &RouteRecord) -> Self {
        let simulated = record.simulated.as_ref();
        Self {
            minimise: record.minimise,
            status: record.status,
            length_m: record.length_m,
            time_s: record.time_s,
            energy_j: record.energy_j,
            turned_deg: record.turned_deg,
            mean_slip_ratio: record.mean_slip_ratio,
            most_slip_ratio: record.most_slip_ratio,
            most_slope_deg: record.most_slope_deg,
            probability_no_go: record.probability_no_go,
            simulated_time_s: simulated.map(|it| it.time_s),
            simulated_energy_j: simulated.map(|it| it.energy_j),
            reason: record.reason.clone(),
        }
    }
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
        "yaw_deg": args.yaw_deg,
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
