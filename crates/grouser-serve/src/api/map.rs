//! `map`: where a rover can go on a map of heights, as `grouser map` has it. No file is written:
//! those that the answer names are what the command would write.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

use grouser::answers::map::{MadeMap, MapQuestion};
use grouser::answers::{Answer, AnswerError, AnswerOptions, Sampling};
use grouser::document::columns::map::{VERDICT, bands, chosen};
use grouser::document::study::COURSE_DEG;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mobility::{CourseChoice, Ground, MobilityMap};
use grouser_draw::style::on_both_grounds;
use grouser_draw::{Sheet, title_of};
use grouser_map::{
    BandPictures, KEEP_OUT_FILE, MAP_PAGE, MapColumn, band_files, keep_out, label, summaries,
};
use grouser_raster::Raster;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::ground::{AskedGround, GroundFields, remarks, shown};
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::kept::Kept;
use crate::maps::Mapped;
use crate::refusal::Refusal;

/// The samples where nothing is said of them, as the program has them.
pub(super) const SAMPLES: u32 = 200;
/// The folder that the command would write into.
const OUT: &str = "map";

/// What is asked of a map.
pub(super) struct MapAsked {
    pub(super) ground: AskedGround,
    pub(super) course: CourseChoice,
    given_course: String,
    sampling: Sampling,
    /// The bands that are drawn.
    layers: Vec<String>,
    has_areas: bool,
    maps: Arc<Kept<Mapped>>,
    last: RefCell<Option<Arc<Mapped>>>,
}

/// What a question says of its map.
pub(super) struct MapFields {
    ground: GroundFields,
    course: CourseChoice,
    given_course: String,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let of_map = MapFields::of(&fields)?;
    let stages = Stages::of(&fields, Some(SAMPLES))?.of_samples()?;
    let mut layers = fields.texts("layers")?;
    let has_areas = fields.truth("areas")?;
    fields.finish()?;
    if layers.is_empty() {
        layers.push(VERDICT.to_owned());
    }
    let known = of_map.bands();
    if let Some(unknown) = layers.iter().find(|it| known.iter().all(|band| band.name != **it)) {
        let names: Vec<&str> = known.iter().map(|band| band.name).collect();
        let refusal = Refusal::of_key("layers", format!("this map has no layer `{unknown}`"));
        return Err(refusal.with_hint(format!("it has {}", names.join(", "))));
    }
    let courses = of_map.course.courses().len();
    let stages = stages.of_rows(("course_deg", courses), false, 0)?;
    let mut line = of_map.line("map");
    line.option("out", OUT);
    Ok(stages.question(MapAsked { layers, has_areas, ..of_map.open(console)? }, line))
}

impl MapFields {
    pub(super) fn of(fields: &AskedFields) -> Result<Self, Refusal> {
        let (course, given_course) = course(fields)?;
        Ok(Self { ground: GroundFields::of(fields)?, course, given_course })
    }

    /// The bands of such a map.
    fn bands(&self) -> Vec<MapColumn> {
        let is_fixed = matches!(self.course, CourseChoice::Fixed(_));
        bands().into_iter().chain(chosen().into_iter().filter(|_| !is_fixed)).collect()
    }

    pub(super) fn line(&self, command: &str) -> CommandLine {
        let mut line = self.ground.line(command);
        line.option("course-deg", &self.given_course);
        line
    }

    pub(super) fn open(self, console: &Console) -> Result<MapAsked, Refusal> {
        Ok(MapAsked {
            ground: self.ground.open(console)?,
            course: self.course,
            given_course: self.given_course,
            sampling: Sampling { count: SAMPLES, seed: 1 },
            layers: Vec::new(),
            has_areas: false,
            maps: Arc::clone(&console.kept.maps),
            last: RefCell::default(),
        })
    }
}

/// The course, and how it is given: a number of degrees, or a word.
fn course(fields: &AskedFields) -> Result<(CourseChoice, String), Refusal> {
    const KEY: &str = "course_deg";
    let word = match fields.take(KEY) {
        None => return Ok((CourseChoice::Fixed(0.0), 0.0.to_string())),
        Some(Value::String(word)) => word,
        Some(value) => {
            let degrees = value.as_f64().filter(|degrees| COURSE_DEG.contains(degrees));
            let degrees = degrees.ok_or_else(|| {
                let (from, to) = (COURSE_DEG.start(), COURSE_DEG.end());
                Refusal::of_key(KEY, format!("{value}: it must be from {from} to {to}"))
            })?;
            return Ok((CourseChoice::Fixed(degrees.to_radians()), degrees.to_string()));
        }
    };
    match &*word {
        "best" => Ok((CourseChoice::Best, word)),
        "worst" => Ok((CourseChoice::Worst, word)),
        _ => Err(Refusal::of_key(KEY, "it must be a number of degrees, `best` or `worst`")),
    }
}

impl MapAsked {
    pub(super) fn question<'q>(&'q self, raster: &'q Raster) -> MapQuestion<'q> {
        let AskedGround { dem, scenario, study, .. } = &self.ground;
        MapQuestion {
            dem,
            ground: Ground::under(&study.heading.rover, raster),
            scenario,
            study,
            course: self.course,
            given_course: &self.given_course,
            sampling: self.sampling,
        }
    }

    fn pictures<'q>(&'q self, mapped: &'q Mapped, question: &MapQuestion<'q>) -> BandPictures<'q> {
        BandPictures::of(&self.ground.scenario, &self.given_course, (question.ground, &mapped.map))
    }

    /// The bands that are asked for, drawn.
    fn drawn<'q>(
        &'q self,
        mapped: &'q Mapped,
        question: &MapQuestion<'q>,
    ) -> Vec<(MapColumn, Sheet)> {
        let pictures = self.pictures(mapped, question);
        let all = question.bands().into_iter().zip(&mapped.sums);
        let drawn = all.filter(|(band, _)| self.layers.iter().any(|layer| layer == band.name));
        let drawn = drawn.map(|(band, sum)| {
            let sheet = pictures.band(&band, sum);
            (band, sheet)
        });
        drawn.collect()
    }

    /// The map, which is kept for the next question about it.
    pub(super) fn mapped(&self, options: &AnswerOptions<'_>) -> Result<Arc<Mapped>, Refusal> {
        let Sampling { count, seed } = self.sampling;
        let key = self.ground.key(&json!([self.given_course, count, seed]));
        self.maps.get_or(&key, || {
            let raster = self.ground.raster()?;
            let question = self.question(&raster);
            let ground = question.ground;
            let samples =
                self.sampling.draw_if_uncertain(&BandInputs::of_scenario(question.scenario));
            let samples = samples.map_err(|error| refused(error.into()))?;
            let (steepest, go_on) = (ground.steepest(), options.go_on);
            let map = MobilityMap::of(question.study, self.course, steepest, &samples, go_on);
            let map = map.map_err(|error| refused(error.into()))?;
            let map = map.ok_or_else(|| refused(AnswerError::Stopped))?;
            let (sums, verdicts) = summaries(ground, &map, &question.bands());
            let areas = keep_out(ground, &map);
            Ok(Mapped { raster: Arc::clone(&raster), map, sums, verdicts, areas })
        })
    }
}

impl Staged for MapAsked {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling.unwrap_or(self.sampling);
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let mapped = self.mapped(options)?;
        let question = self.question(&mapped.raster);
        let path_of = |name: &str| shown(&Path::new(OUT).join(name));
        let made = MadeMap {
            map: &mapped.map,
            files: &band_files(&question.bands(), &mapped.sums, &path_of),
            verdicts: mapped.verdicts,
            keep_out: mapped.areas.as_ref().map(|_| path_of(KEEP_OUT_FILE)).map_err(|why| *why),
            page: path_of(MAP_PAGE),
        };
        let answer = question.answer("map", &made);
        self.last.replace(Some(mapped));
        Ok(answer)
    }

    fn whose(&self) -> String {
        title_of(&self.ground.scenario)
    }

    fn picture(&self) -> Option<Sheet> {
        let last = self.last.borrow();
        self.drawn(last.as_ref()?, &self.question(&last.as_ref()?.raster)).pop().map(|it| it.1)
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        add_samples(line, sampling);
    }

    fn add_shown(&self, shown: &mut Value) -> Result<(), Refusal> {
        let last = self.last.borrow();
        let Some(mapped) = last.as_ref() else { return Ok(()) };
        let question = self.question(&mapped.raster);
        let bands = question.bands();
        let drawings = self.drawn(mapped, &question).into_iter().map(|(band, sheet)| {
            json!({ "name": band.name, "caption": band.doc, "svg": on_both_grounds(&sheet) })
        });
        let layers = bands
            .iter()
            .map(|band| json!({ "name": band.name, "label": label(band), "about": band.doc }));
        let frame = self.pictures(mapped, &question).frame();
        shown["drawings"] = drawings.collect();
        shown["layers"] = layers.collect();
        shown["frame"] = json!({
            "picture_mm": frame.picture,
            "corner_mm": frame.corner,
            "size_mm": frame.size,
            "south_west_m": [frame.south_west.x, frame.south_west.y],
            "north_east_m": [frame.north_east.x, frame.north_east.y],
            "spacing_m": [mapped.raster.grid.spacing.x, mapped.raster.grid.spacing.y],
        });
        shown["notes"] = remarks(&mapped.raster).into();
        if let (true, Ok(areas)) = (self.has_areas, &mapped.areas) {
            shown["files"] = json!({ KEEP_OUT_FILE: areas });
        }
        Ok(())
    }
}

/// Adds the samples, as commands that are always of samples take them.
pub(super) fn add_samples(line: &mut CommandLine, sampling: Option<Sampling>) {
    if let Some(Sampling { count, seed }) = sampling {
        line.option("samples", &count.to_string());
        line.option("seed", &seed.to_string());
    }
}
