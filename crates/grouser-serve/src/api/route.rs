//! `route`: the cheapest way over a map of heights, as `grouser route --no-drive` has it. A drive by
//! simulation takes minutes on rough ground, and nobody could stop it.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use grouser::answers::route::{Asked, RouteQuestion, WayError};
use grouser::answers::{Answer, AnswerError, AnswerOptions, Sampling};
use grouser::document::given_file::{FileContent, GivenFile};
use grouser::document::study::{MOST_SLOPE_DEG, SHARE, START_YAW_DEG};
use grouser::document::unit::less_whole_turns;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::route::{COURSES, Ends, Limits, Objective, RouteError, RouteStudy};
use grouser::units::Vec2;
use grouser_draw::title_of;
use grouser_map::way_as_geojson;
use grouser_raster::zones::ZoneCounts;
use grouser_raster::{MapPath, Raster, RasterError};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::ground::{AskedGround, GroundFields, remarks, shown};
use super::map::add_samples;
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::kept::Kept;
use crate::maps::Sought;
use crate::refusal::Refusal;

/// The samples where nothing is said of them, as the program has them.
const SAMPLES: u32 = 50;

/// What is asked of a way.
struct RouteAsked {
    ground: AskedGround,
    asked: Asked,
    limits: Limits,
    /// Areas where nobody may go: their name, and the file.
    keep_out: Option<(PathBuf, PathBuf)>,
    objectives: Vec<Objective>,
    sampling: Sampling,
    sought: Arc<Kept<Sought>>,
    /// The way that was found, as GeoJSON, and what is odd about the files.
    last: RefCell<(String, Vec<String>)>,
}

/// Limits of a way by their keys.
const LIMITS: [&str; 3] = ["most_slope_deg", "most_slip_ratio", "most_no_go"];

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let of_ground = GroundFields::of(&fields)?;
    let stages = Stages::of(&fields, Some(SAMPLES))?.of_samples()?;
    let place = |key| {
        let given = fields.place(key)?;
        given.ok_or_else(|| Refusal::of_key(key, "it must be x and y in metres of the map"))
    };
    let [from, to] = [place("from_m")?, place("to_m")?];
    let yaw = fields.number("yaw_deg", &START_YAW_DEG)?;
    let minimise = objective(&fields)?;
    let keep_out = fields.text("keep_out")?;
    let ranges = [MOST_SLOPE_DEG, SHARE, SHARE];
    let mut limits = [None; 3];
    for ((key, range), limit) in LIMITS.into_iter().zip(&ranges).zip(&mut limits) {
        *limit = fields.number(key, range)?;
    }
    let has_alternatives = fields.truth("alternatives")?;
    fields.finish()?;
    let stages = stages.of_rows(("samples", COURSES), false, 0)?;
    let mut line = of_ground.line("route");
    line.numbers("from", &from);
    line.numbers("to", &to);
    line.option("minimise", minimise.name());
    line.maybe("yaw-deg", yaw.map(|it| it.to_string()).as_deref());
    line.maybe("keep-out", keep_out.as_deref());
    for (key, limit) in LIMITS.into_iter().zip(limits) {
        line.maybe(&key.replace('_', "-"), limit.map(|it| it.to_string()).as_deref());
    }
    if has_alternatives {
        line.flag("alternatives");
    }
    line.flag("no-drive");
    let ground = of_ground.open(console)?;
    let found = keep_out.map(|name| match console.folder.find_map(&name) {
        Ok(file) => Ok((PathBuf::from(name), file)),
        Err(problem) => Err(Refusal::of_key("keep_out", problem.to_string())),
    });
    let others = Objective::ALL.into_iter().filter(|it| has_alternatives && *it != minimise);
    let [most_slope, most_slip_ratio, most_no_go] = limits;
    let usual = Limits::of(&ground.study);
    let asked = RouteAsked {
        limits: Limits {
            most_slope: most_slope.map_or(usual.most_slope, f64::to_radians),
            most_slip_ratio: most_slip_ratio.unwrap_or(usual.most_slip_ratio),
            most_no_go: most_no_go.unwrap_or(usual.most_no_go),
        },
        ground,
        asked: Asked::Between(Ends {
            from: Vec2::from(from),
            to: Vec2::from(to),
            yaw: yaw.map(|yaw| less_whole_turns(yaw).to_radians()),
        }),
        keep_out: found.transpose()?,
        objectives: std::iter::once(minimise).chain(others).collect(),
        sampling: Sampling { count: SAMPLES, seed: 1 },
        sought: Arc::clone(&console.kept.sought),
        last: RefCell::default(),
    };
    Ok(stages.question(asked, line))
}

fn objective(fields: &AskedFields) -> Result<Objective, Refusal> {
    let Some(word) = fields.text("minimise")? else { return Ok(Objective::Time) };
    Objective::ALL.into_iter().find(|it| it.name() == word).ok_or_else(|| {
        let words = Objective::ALL.map(Objective::name).join(", ");
        let refusal = Refusal::of_key("minimise", "a way cannot have least of that");
        refusal.with_hint(format!("it is {words}"))
    })
}

impl RouteAsked {
    /// The study, what its files gave, and what is odd about them.
    fn study(&self, raster: &Raster) -> Result<(RouteStudy, Vec<GivenFile>, Vec<String>), Refusal> {
        let mobility = self.ground.study.clone();
        let study = RouteStudy { mobility, limits: self.limits, keep_out: None };
        let mut remarks = remarks(raster);
        let Some((name, file)) = &self.keep_out else { return Ok((study, Vec::new(), remarks)) };
        let of_areas = |error: RasterError| {
            let (message, hint) = error.fault.in_parts("file of areas", Some(&error.file));
            Refusal { hint, ..Refusal::of_key("keep_out", message) }
        };
        let open = &|path: &Path| self.ground.folder.open_file(path);
        let (study, counts, remark) = study
            .keeping_out_of(MapPath { path: file, open }, &raster.frame())
            .map_err(of_areas)?;
        remarks.extend(remark.map(|it| it.to_string()));
        let ZoneCounts { there, used } = counts;
        Ok((study, vec![GivenFile::new(shown(name), FileContent::KeepOut, there, used)], remarks))
    }

    /// The tables, which are kept for the next way.
    fn tables(
        &self,
        study: &RouteStudy,
        options: &AnswerOptions<'_>,
    ) -> Result<Arc<Sought>, Refusal> {
        let with_risk = self.objectives.contains(&Objective::Risk);
        let Sampling { count, seed } = self.sampling;
        let Limits { most_slope, most_slip_ratio, most_no_go } = self.limits;
        let limits = [most_slope, most_slip_ratio, most_no_go];
        let key = self.ground.key(&json!([limits, with_risk, count, seed]));
        self.sought.get_or(&key, || {
            let inputs = BandInputs::of_scenario(&self.ground.scenario);
            let samples = self.sampling.draw_if_uncertain(&inputs);
            let samples = samples.map_err(|error| refused(error.into()))?;
            let tables = study.tables(&samples, with_risk, options.go_on);
            let tables = tables.map_err(|error| refused(error.into()))?;
            let tables = tables.ok_or_else(|| refused(AnswerError::Stopped))?;
            Ok(Sought { tables, samples })
        })
    }
}

impl Staged for RouteAsked {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling.unwrap_or(self.sampling);
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let raster = self.ground.raster()?;
        let (study, given, remarks) = self.study(&raster)?;
        let question = RouteQuestion {
            dem: &self.ground.dem,
            raster: &raster,
            scenario: &self.ground.scenario,
            study: &study,
            asked: &self.asked,
            along: None,
            keep_out: self.keep_out.as_ref().map(|(name, _)| name.as_path()),
            given: &given,
            sampling: self.sampling,
        };
        self.asked.check(question.ground()).map_err(|error| off(&error))?;
        let sought = self.tables(&study, options)?;
        let of_samples = (&sought.tables, &*sought.samples);
        let way = |objective: &Objective| {
            let way = question.way(of_samples, *objective, false, options.go_on);
            way.map_err(no_way)?.ok_or_else(|| refused(AnswerError::Stopped))
        };
        let ways = self.objectives.iter().map(way).collect::<Result<Vec<_>, _>>()?;
        let line = way_as_geojson(&ways[0].record, &raster.coordinates);
        self.last.replace((line, remarks));
        Ok(question.answer("route", &ways))
    }

    fn whose(&self) -> String {
        title_of(&self.ground.scenario)
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        add_samples(line, sampling);
    }

    fn add_shown(&self, shown: &mut Value) -> Result<(), Refusal> {
        let (line, remarks) = &*self.last.borrow();
        shown["files"] = json!({ "route.geojson": line });
        shown["notes"] = json!(remarks);
        Ok(())
    }
}

/// Why an end is no end.
fn off(error: &RouteError) -> Refusal {
    let key = match error {
        RouteError::OffTheMap { end: "start", .. } => "from_m",
        RouteError::OffTheMap { .. } => "to_m",
        _ => "dem",
    };
    Refusal::of_key(key, error.to_string())
}

/// Why nothing can be said of a way.
fn no_way(error: WayError) -> Refusal {
    match error {
        WayError::Route(error) => off(&error),
        error => Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()),
    }
}
