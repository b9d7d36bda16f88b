//! Where a rover can go on a map of heights.

mod files;
mod page;
mod question;

use std::sync::Arc;

use serde_json::{Value, json};

use self::files::{FILES, brief};
pub use self::files::{MadeMap, MapFile, VerdictCounts};
pub use self::question::MapQuestion;
use super::{Answer, Displayed, Member, given_heights};
use crate::document::columns::map::{CLASS, HEADING};
use crate::document::columns::verdict::{self, ADVICE, ADVICE_OBJECT};
use crate::document::columns::{LIMIT_SLOPE, POWER, SINKAGE, SLIP_RATIO, YAW};
use crate::document::reading::rounded_down;
use crate::document::table::Table;
use crate::studies::mobility::{CourseChoice, MobilityMap, MobilityTable};

impl MapQuestion<'_> {
    /// The answer. Its page has a picture of each band, `BAND.svg`.
    #[must_use]
    pub fn answer(&self, name: &str, made: &MadeMap<'_>) -> Answer {
        let files = Arc::new(Table::of(&FILES, made.files));
        let limit = limit(self.course, made.map);
        let errors = errors(made.map);
        let sentence = sentence(made.verdicts, limit) + &kept_out(made);
        let mut answer = Answer::new(name, "Where the rover can go");
        self.state(&mut answer);
        let VerdictCounts { go, caution, cannot_tell, no_go, unknown } = made.verdicts;
        let verdicts = json!({
            "go": go,
            "caution": caution,
            "cannot_tell": cannot_tell,
            "no_go": no_go,
            "unknown": unknown,
        });
        let slopes = Arc::new(Table::of(&CLASS, made.map.advice()));
        let advice = verdict::advice(made.map.advice());
        let raster = self.ground.raster();
        answer.results = vec![
            Member::rows("files", Arc::clone(&files)),
            Member::Value("verdicts", verdicts),
            Member::With("slopes", Arc::clone(&slopes), ADVICE_OBJECT, advice),
            Member::Value("columns", json!(raster.grid.columns)),
            Member::Value("rows", json!(raster.grid.rows)),
            Member::Value("coordinate_system", json!(raster.coordinates.name())),
            Member::Value("slope_length_m", json!(self.ground.slope_length())),
            Member::Value(LIMIT_SLOPE.name, json!(limit)),
            Member::Value("interpolation_error", errors.clone()),
            Member::Value("keep_out", json!(made.keep_out.as_ref().ok())),
            Member::Value("page", json!(made.page)),
        ];
        answer.tables.push((name.to_owned(), Arc::clone(&files)));
        answer.tables.push(("slopes".to_owned(), slopes));
        answer.screen = vec![
            Displayed::Words(format!("{sentence}\nThe map: {}.\n", raster.spans())),
            Displayed::Rows(files, brief()),
        ];
        answer.given.push(given_heights(self.dem, raster));
        answer.attach("scenario.toml", self.scenario);
        let all =
            Table::default().and(&CLASS, &made.map.advice().iter().map(Some).collect::<Vec<_>>());
        let all = all.and(&ADVICE, &made.map.advice().iter().map(Some).collect::<Vec<_>>());
        self.page(&mut answer, made.files, (&errors, &Arc::new(all)), sentence);
        answer.findings = self.findings(made);
        answer
    }
}

/// The steepest slope on which a heading holds the course [°]; where courses are chosen, of the one
/// that reaches farthest.
fn limit(course: CourseChoice, map: &MobilityMap) -> Option<f64> {
    let limits = map.tables().iter().filter_map(MobilityTable::limit);
    let limit = if course == CourseChoice::Worst {
        limits.reduce(f64::min)
    } else {
        limits.reduce(f64::max)
    };
    limit.map(|limit| LIMIT_SLOPE.unit.from_si(limit))
}

/// How far numbers of the map are from those of the heading on the same slope, at most.
fn errors(map: &MobilityMap) -> Value {
    let errors = map.largest_errors();
    json!({
        (HEADING.name): YAW.unit.from_si(errors.crab),
        (SLIP_RATIO.name): errors.slip_ratio,
        (POWER.name): errors.power,
        (SINKAGE.name): SINKAGE.unit.from_si(errors.sinkage),
    })
}

/// Where the areas are that nobody may go into, or why there is no such file.
fn kept_out(made: &MadeMap<'_>) -> String {
    match &made.keep_out {
        Ok(file) => format!(
            " Areas for a route to keep out of, where the verdict is no-go or nobody can tell: \
             {file}."
        ),
        Err(why) => format!(" No file of areas to keep out of: {why}."),
    }
}

/// How much of the map is what, and up to where a heading holds the course.
fn sentence(verdicts: VerdictCounts, limit: Option<f64>) -> String {
    let VerdictCounts { go, caution, cannot_tell, no_go, unknown } = verdicts;
    let known = go + caution + cannot_tell + no_go;
    let share = |count: u64| {
        if known == 0 { 0.0 } else { (1000.0 * count as f64 / known as f64).round() / 10.0 }
    };
    let limit = limit.map_or_else(
        || "The rover cannot move on this soil.".to_owned(),
        |limit| {
            let limit = rounded_down(limit);
            format!("On the soil as written a heading holds the course up to {limit}°, no limit to drive by.")
        },
    );
    let unknown = match unknown {
        0 => String::new(),
        count => format!(" {count} cells have no height."),
    };
    format!(
        "go {} %, caution {} %, cannot tell {} %, no-go {} % of {known} cells. {limit}{unknown}",
        share(go),
        share(caution),
        share(cannot_tell),
        share(no_go)
    )
}
