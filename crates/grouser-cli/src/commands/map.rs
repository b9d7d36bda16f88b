//! `grouser map`: where a rover can go on a map of heights.

mod folder;
mod gazebo;
mod numbers;
mod page;

use grouser::answers;
use grouser::document::columns::LIMIT_SLOPE;
use grouser::document::columns::map::{bands, chosen};
use grouser::document::reading::rounded_down;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mobility::{CourseChoice, Ground, MobilityMap};
use grouser_map::{BandSummary, Look, MapColumn, style, summaries, write_band};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use self::folder::MapFolder;
use self::numbers::{errors, label};
use super::{Answer, sampling};
use crate::args::MapArgs;
use crate::failure::Failure;
use crate::inputs::{self, MapInputs};
use crate::output::rows::Rows;
use crate::output::{self, Format};

/// A file of the map.
#[derive(Serialize)]
struct FileRecord {
    name: &'static str,
    unit: &'static str,
    about: &'static str,
    /// None where no cell has a number.
    least: Option<f64>,
    mean: Option<f64>,
    most: Option<f64>,
    cells: u64,
    path: String,
}

/// How many cells have which verdict.
#[derive(Serialize)]
struct Verdicts {
    go: u64,
    caution: u64,
    no_go: u64,
    unknown: u64,
}

#[derive(Serialize)]
struct Results<'a> {
    files: &'a [FileRecord],
    verdicts: Verdicts,
    columns: usize,
    rows: usize,
    coordinate_system: String,
    slope_length_m: [f64; 2],
    #[serde(flatten)]
    limit: Value,
    interpolation_error: Value,
    page: String,
}

pub(crate) fn run(args: &MapArgs) -> Result<(), Failure> {
    let inputs = inputs::map(args)?;
    let settings = settings(args, &inputs);
    let folder = MapFolder::open(&args.out, args.force, &settings, &inputs.raster)?;
    let map = tables(args, &inputs)?;
    let ground = Ground::under(&inputs.study.heading.rover, &inputs.raster);
    let bands = bands_of(inputs.course);
    let (of, counts) = summaries(ground, &map, &bands);
    write(&folder, ground, &map, &bands)?;
    let files = bands.iter().zip(&of).map(|(band, of)| record(&folder, band, of));
    let files: Vec<FileRecord> = files.collect();
    let [unknown, go, caution, no_go] = counts;
    let raster = &inputs.raster;
    let limit = limit(&inputs, &map);
    let verdicts = Verdicts { go, caution, no_go, unknown };
    let sentence = sentence(&verdicts, limit);
    let results = Results {
        files: &files,
        verdicts,
        columns: raster.grid.columns,
        rows: raster.grid.rows,
        coordinate_system: raster.coordinates.name(),
        slope_length_m: ground.slope_length(),
        limit: json!({ (LIMIT_SLOPE.name): limit }),
        interpolation_error: errors(&map),
        page: folder.path(page::NAME),
    };
    let page = page::html(
        args,
        &inputs,
        (ground, &map),
        &bands.iter().zip(&of).collect::<Vec<_>>(),
        &sentence,
    );
    let answer = Answer::new("map", settings, results);
    let rows = Rows::of(&files);
    let mut output = folder.output()?;
    output.add(page::NAME, page);
    output.add("map.json", answer.to_text());
    for (band, of) in bands.iter().zip(&of) {
        let text = style(Look::of(band.name), of, &label(band));
        output.add(format!("{}.qml", band.name), text);
        output.add(format!("{}.svg", band.name), page::picture((ground, &map), band, of));
    }
    if let Some(texture) = gazebo::texture(args, &inputs, ground)? {
        gazebo::add(&mut output, &inputs, texture);
    }
    output.add_document("scenario.toml", &inputs.scenario);
    output.finish()?;
    folder.finish()?;
    match args.format {
        Format::Table => {
            let columns = ["name", "unit", "least", "mean", "most", "path"];
            output::show(rows.to_table(&columns) + sentence)
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// The bands of a map: the course as well, where it is chosen.
fn bands_of(course: CourseChoice) -> Vec<MapColumn> {
    let mut all: Vec<MapColumn> = bands().into();
    if !matches!(course, CourseChoice::Fixed(_)) {
        all.extend(chosen());
    }
    all
}

fn tables(args: &MapArgs, inputs: &MapInputs) -> Result<MobilityMap, Failure> {
    let band = BandInputs::of_scenario(&inputs.scenario);
    let samples = if band.is_certain() {
        Vec::new()
    } else {
        sampling::draw(&band, args.samples, args.seed)?
    };
    let count = samples.len().max(1) * inputs.course.courses().len();
    let map = sampling::with_bar(count, |go_on| {
        MobilityMap::of(&inputs.study, inputs.course, &samples, go_on)
    });
    Ok(sampling::whole(map?))
}

/// Writes the bands that are not there yet.
fn write(
    folder: &MapFolder,
    ground: Ground<'_>,
    map: &MobilityMap,
    bands: &[MapColumn],
) -> Result<(), Failure> {
    let missing: Vec<&MapColumn> = bands.iter().filter(|band| !folder.has(band.name)).collect();
    if missing.len() < bands.len() && output::terminal::has_progress() {
        let there = bands.len() - missing.len();
        output::message(&format!("{there} of {} bands are there already", bands.len()));
    }
    let grid = &ground.raster().grid;
    let bar = output::progress_bar((missing.len() * grid.columns * grid.rows) as u64);
    bar.set_message("cells");
    let one = |band: &&MapColumn| {
        folder.make(band.name, |file| {
            Ok(write_band(file, ground, map, band, &|cells| bar.inc(cells))?)
        })
    };
    let written: Vec<Result<(), Failure>> = missing.par_iter().map(one).collect();
    bar.finish_and_clear();
    written.into_iter().collect()
}

impl From<grouser_map::MapError> for Failure {
    fn from(error: grouser_map::MapError) -> Self {
        Self::Run(error.to_string())
    }
}

fn record(folder: &MapFolder, band: &MapColumn, of: &BandSummary) -> FileRecord {
    let number = |number: f64| Some(number).filter(|number| number.is_finite());
    FileRecord {
        name: band.name,
        unit: band.unit.symbol,
        about: band.doc,
        least: number(of.least),
        mean: number(of.mean),
        most: number(of.most),
        cells: of.known,
        path: folder.path(&format!("{}.tif", band.name)),
    }
}

/// The steepest slope on which a heading holds the course [°]; where courses are chosen, of the one
/// that reaches farthest.
fn limit(inputs: &MapInputs, map: &MobilityMap) -> Option<f64> {
    let limits = map.tables().iter().filter_map(grouser::studies::mobility::MobilityTable::limit);
    let limit = if inputs.course == CourseChoice::Worst {
        limits.reduce(f64::min)
    } else {
        limits.reduce(f64::max)
    };
    limit.map(|limit| LIMIT_SLOPE.unit.from_si(limit))
}

fn sentence(verdicts: &Verdicts, limit: Option<f64>) -> String {
    let Verdicts { go, caution, no_go, unknown } = *verdicts;
    let known = go + caution + no_go;
    let share = |count: u64| {
        if known == 0 { 0.0 } else { (1000.0 * count as f64 / known as f64).round() / 10.0 }
    };
    let limit = limit.map_or_else(
        || "The rover cannot move on this soil.".to_owned(),
        |limit| format!("A heading holds the course up to {}°.", rounded_down(limit)),
    );
    let unknown = match unknown {
        0 => String::new(),
        count => format!(" {count} cells have no height."),
    };
    format!(
        "go {} %, caution {} %, no-go {} % of {known} cells. {limit}{unknown}\n",
        share(go),
        share(caution),
        share(no_go)
    )
}

/// The inputs of the answer, by which a map that was stopped is known again.
fn settings(args: &MapArgs, inputs: &MapInputs) -> Value {
    let document = &inputs.scenario.document;
    let band = BandInputs::of_scenario(&inputs.scenario);
    json!({
        "dem": args.dem,
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "model": inputs.scenario.value.model.name(),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "slope_stability": document.get("slope_stability"),
        "course_deg": args.course_deg,
        "rim_speed_m_s": inputs.study.rim_speed,
        "go_slip_ratio": inputs.study.rule.go_slip_ratio,
        "go_probability": inputs.study.rule.go_probability,
        "no_go_slip_ratio": inputs.study.rule.no_go_slip_ratio,
        "no_go_probability": inputs.study.rule.no_go_probability,
        "samples": args.samples,
        "seed": args.seed,
        (sampling::WEIGHTS): answers::weights(&band),
    })
}
