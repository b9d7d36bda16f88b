//! `grouser map`: where a rover can go on a map of heights.

mod folder;
mod gazebo;

use grouser::answers::Answer;
use grouser::answers::map::MadeMap;
use grouser::document::columns::map::VERDICT;
use grouser::document::json;
use grouser::studies::mobility::{Ground, MobilityMap};
use grouser_draw::style::on_both_grounds;
use grouser_draw::title_of;
use grouser_map::{
    BandPictures, BandSummary, KEEP_OUT_FILE, Look, MAP_PAGE, MapColumn, band_files, keep_out,
    label, style, summaries, write_band,
};
use rayon::prelude::*;

use self::folder::MapFolder;
use super::sampling;
use crate::args::MapArgs;
use crate::failure::Failure;
use crate::inputs::{self, MapInputs};
use crate::output;
use crate::output::answer::{add_pictures, html, print};
use crate::output::slide::SlideFile;

/// A band, and its numbers in all.
type Summed<'b> = (&'b MapColumn, &'b BandSummary);

impl From<grouser_map::MapError> for Failure {
    fn from(error: grouser_map::MapError) -> Self {
        Self::Run(error.to_string())
    }
}

pub(crate) fn run(args: &MapArgs) -> Result<(), Failure> {
    let slide = SlideFile::of(&args.slide, args.force)?;
    let inputs = inputs::map(args)?;
    let question = inputs.question(args);
    let ground = question.ground;
    let folder = MapFolder::open(&args.out, args.force, &question.identity(), &inputs.raster)?;
    let map = tables(args, &inputs, ground.steepest())?;
    let bands = question.bands();
    let (sums, verdicts) = summaries(ground, &map, &bands);
    write(&folder, ground, &map, &bands)?;
    let summed: Vec<Summed<'_>> = bands.iter().zip(&sums).collect();
    let files = band_files(&bands, &sums, &|name| folder.path(name));
    let areas = keep_out(ground, &map);
    let made = MadeMap {
        map: &map,
        files: &files,
        verdicts,
        keep_out: areas.as_ref().map(|_| folder.path(KEEP_OUT_FILE)).map_err(|why| *why),
        page: folder.path(MAP_PAGE),
    };
    let mut answer = question.answer("map", &made);
    let keep_out = if areas.is_ok() { " --keep-out keep-out.geojson" } else { "" };
    answer.next =
        vec![format!("grouser route DEM scenario.toml --from X,Y --to X,Y{keep_out} --out WAY")];
    finish(args, &inputs, &folder, &answer, (ground, &map), &summed, (areas.ok(), slide))?;
    print(&answer, args.format)
}

/// Writes what stands beside the bands, which closes the folder.
fn finish(
    args: &MapArgs,
    inputs: &MapInputs,
    folder: &MapFolder,
    answer: &Answer,
    (ground, map): (Ground<'_>, &MobilityMap),
    bands: &[Summed<'_>],
    (areas, slide): (Option<String>, Option<SlideFile<'_>>),
) -> Result<(), Failure> {
    let drawn = BandPictures::of(&inputs.scenario, &args.course_deg, (ground, map));
    let mut pictures = Vec::new();
    for &(band, of) in bands {
        let picture = drawn.band(band, of);
        if let Some(slide) = slide.as_ref().filter(|_| band.name == VERDICT) {
            slide.write_over(answer, &picture, &title_of(&inputs.scenario))?;
        }
        pictures.push((format!("{}.svg", band.name), on_both_grounds(&picture)));
    }
    let mut output = folder.output()?;
    output.add(MAP_PAGE, html(answer, &repeat(args, inputs), &pictures));
    output.add("map.json", json::text(answer) + "\n");
    add_pictures(&mut output, &pictures);
    for &(band, of) in bands {
        output.add(format!("{}.qml", band.name), style(Look::of(band.name), of, &label(band)));
    }
    if let Some(texture) = gazebo::texture(args, inputs, ground)? {
        gazebo::add(&mut output, inputs, texture);
    }
    if let Some(areas) = areas {
        output.add(KEEP_OUT_FILE, areas);
    }
    output.add_document("scenario.toml", &inputs.scenario);
    output.finish()?;
    folder.finish()
}

/// * `steepest`: slope of the ground [rad]
fn tables(args: &MapArgs, inputs: &MapInputs, steepest: f64) -> Result<MobilityMap, Failure> {
    let samples = sampling::draw_if_uncertain(&inputs.scenario, args.samples, args.seed)?;
    // Every course, then those that are chosen, there and back.
    let count = samples.len().max(1) * (inputs.course.courses().len() + 2);
    let map = sampling::with_bar(count, |go_on| {
        MobilityMap::of(&inputs.study, inputs.course, steepest, &samples, go_on)
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

/// The command that gives the answer again.
fn repeat(args: &MapArgs, inputs: &MapInputs) -> String {
    let MapArgs { course_deg, samples, seed, .. } = args;
    let (speed, rule) = (inputs.study.rim_speed, sampling::rule_flags(&inputs.study.rule));
    format!(
        "grouser map DEM scenario.toml --course-deg {course_deg} --samples {samples} --seed {seed} \
         --rim-speed-m-s {speed}{rule} --out OTHER"
    )
}
