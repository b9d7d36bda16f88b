//! `grouser route`: the cheapest way over a map of heights, or what a given one takes.

use grouser::answers::route::{Way, WayError};
use grouser::document::escape;
use grouser::studies::route::{COURSES, Ends, Objective, RouteError};
use grouser_draw::map::{Track, ways_over_ground};
use grouser_draw::style::on_both_grounds;
use grouser_draw::{Sheet, title_of};
use grouser_map::way_as_geojson;

use super::sampling;
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::inputs::{self, Asked, RouteInputs};
use crate::output;
use crate::output::answer::give_with_pictures;
use crate::output::folder::OutputFolder;
use crate::output::slide::SlideFile;

impl From<RouteError> for Failure {
    fn from(error: RouteError) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<WayError> for Failure {
    fn from(error: WayError) -> Self {
        match error {
            WayError::Route(error) => error.into(),
            WayError::Ground(_) | WayError::Drive(_) => Self::Run(error.to_string()),
        }
    }
}

pub(crate) fn run(args: &RouteArgs) -> Result<(), Failure> {
    let mut folder = OutputFolder::for_args(&args.output)?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let inputs = inputs::route(args)?;
    let ways = ways(args, &inputs)?;
    let answer = inputs.question(args).answer("route", &ways);
    let mut pictures = Vec::new();
    if let Some(folder) = &mut folder {
        folder.add("route.geojson", way_as_geojson(&ways[0].record, &inputs.raster.coordinates));
        pictures.push(("route.svg".to_owned(), on_both_grounds(&picture(&inputs, &ways))));
    }
    if let Some(slide) = slide {
        slide.write_over(&answer, &picture(&inputs, &ways), &title_of(&inputs.scenario))?;
    }
    let repeat = repeat(args, &inputs);
    give_with_pictures(&answer, &repeat, &pictures, folder, args.output.format)
}

/// The way that is asked for, and its alternatives.
fn ways(args: &RouteArgs, inputs: &RouteInputs) -> Result<Vec<Way>, Failure> {
    // Places off the map are refused before the tables, which take a while.
    let checked = inputs.asked.check(inputs.ground()).map_err(Failure::from);
    checked.map_err(|failure| match (&args.along, failure) {
        (Some(file), Failure::Usage(what)) => {
            Failure::Usage(format!("{}: {what}", escape::path(file)))
        }
        (_, failure) => failure,
    })?;
    let samples = sampling::draw_if_uncertain(&inputs.scenario, args.samples, args.seed)?;
    let wanted = objectives(args);
    let with_risk = args.along.is_none() && wanted.contains(&Objective::Risk);
    let tables = sampling::with_bar(samples.len().max(1) * COURSES, |go_on| {
        inputs.study.tables(&samples, with_risk, go_on)
    });
    let tables = sampling::whole(tables?);
    let question = inputs.question(args);
    let one = |objective: Objective| {
        let what = match &inputs.asked {
            Asked::Between(_) => format!("the way of least {}", objective.name()),
            Asked::Along(_) => "the given way".to_owned(),
        };
        let bar = output::waiting_line(what);
        let found = question.way((&tables, &samples), objective, !args.no_drive, &|| true);
        bar.finish_and_clear();
        Ok(sampling::whole(found?))
    };
    wanted.into_iter().map(one).collect()
}

/// What ways are to have least of, the one that is asked for first.
fn objectives(args: &RouteArgs) -> Vec<Objective> {
    let chosen = args.minimise;
    let others = Objective::ALL.into_iter().filter(|it| args.alternatives && *it != chosen);
    std::iter::once(chosen).chain(others).collect()
}

/// The command that gives the answer again.
fn repeat(args: &RouteArgs, inputs: &RouteInputs) -> String {
    let asked = match &inputs.asked {
        Asked::Along(_) => "--along LINE.geojson".to_owned(),
        Asked::Between(Ends { from, to, .. }) => {
            let least = args.minimise.name();
            format!("--from {},{} --to {},{} --minimise {least}", from.x, from.y, to.x, to.y)
        }
    };
    let (samples, seed) = (args.samples, args.seed);
    let study = &inputs.study;
    let limits = [
        ("most-slope-deg", args.most_slope_deg.as_ref()),
        ("most-slip-ratio", args.most_slip_ratio.as_ref()),
        ("most-no-go", args.most_no_go.as_ref()),
        ("yaw-deg", args.yaw_deg.as_ref()),
        ("rim-speed-m-s", args.rim_speed_m_s.as_ref()),
    ];
    let limits = limits
        .into_iter()
        .filter_map(|(flag, given)| Some(format!(" --{flag} {}", given?.joined())));
    let switches = [(args.alternatives, " --alternatives"), (args.no_drive, " --no-drive")];
    let switches = switches.into_iter().filter_map(|(is_set, flag)| is_set.then_some(flag));
    let keep_out = if args.keep_out.is_some() { " --keep-out AREAS.geojson" } else { "" };
    let rest: String = limits.chain(switches.map(str::to_owned)).collect();
    let rule = sampling::rule_flags(&study.mobility.rule);
    format!(
        "grouser route DEM scenario.toml {asked}{keep_out}{rest}{rule} --samples {samples} \
         --seed {seed}"
    )
}

/// The ground and the ways.
fn picture(inputs: &RouteInputs, ways: &[Way]) -> Sheet {
    let tracks: Vec<Track<'_>> = ways
        .iter()
        .filter(|way| !way.places.is_empty())
        .map(|way| Track { name: way.name(), places: &way.places })
        .collect();
    let raster = &inputs.raster;
    let gradient = |column: usize, row: usize| raster.gradient(column, row, [1, 1]);
    ways_over_ground("Ways over the ground", &raster.grid, &gradient, &tracks)
}
