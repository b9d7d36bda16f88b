//! `fit`: a soil that is calibrated on wheel tests, as `grouser calibrate` does it, with its
//! progress.

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use grouser::answers::AnswerError;
use grouser::answers::validation::figures;
use grouser::document::calibration::{
    AimWords, Corner, STEPS, Solved, USUAL_STEPS, WheelFound, WheelInputs, WheelProblem,
    samples_csv, sampling,
};
use grouser::document::columns::fit::column_of;
use grouser::document::measurements::{self, Choice, Condition, Limits, Measurements};
use grouser::document::validation::GroupRecord;
use grouser::document::{FitKey, SAMPLES_FILE, SoilFamily, json};
use grouser::studies::calibration::{CalibrationError, Observer, PosteriorState, Work};
use grouser::studies::measurement::Quantity;
use grouser_draw::Slide;
use grouser_draw::chart::Drawable as _;
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::{Stand, StandParts};
use super::staged::{refused, shown_table};
use crate::asked::{GoOn, Question, Send};
use crate::console::Console;
use crate::progress::Progress;
use crate::refusal::Refusal;

/// Keys of a corner plot: more are too small to be read.
const MOST_DRAWN: usize = 7;

/// What is shown of the errors of a quantity.
const ERRORS: [&str; 4] = ["rmse", "bias", "repeatability", "cells"];

/// What is asked of a fit.
struct FitAsked {
    data: String,
    stand: Stand,
    measured: Measurements,
    family: SoilFamily,
    is_point: bool,
    seed: u64,
    steps: u64,
    inputs: Value,
    line: CommandLine,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let data = fields.text("data")?.ok_or_else(|| {
        Refusal::of_key("data", "it must be a data set, or the path of a CSV file in the folder")
    })?;
    let keys = fields.texts("fit")?;
    let given = fields.texts("where")?;
    let is_point = fields.truth("point_fit")?;
    let one = |all: Option<Vec<u64>>| all.and_then(|all| all.first().copied());
    let steps = one(fields.counts("steps", &(STEPS.start..=STEPS.end - 1))?);
    let seed = one(fields.counts("seed", &(0..=u64::MAX))?);
    let parts = StandParts::of(&fields, &console.folder)?;
    fields.finish()?;
    let fit = parsed("fit", &keys, FitKey::parse)?;
    let conditions = parsed("where", &given, Condition::parse)?;
    let stand = parts.stands(&console.folder, false)?.into_iter().next();
    let stand = stand.ok_or_else(|| refused(AnswerError::Empty("models")))?;
    let limits = Limits::default();
    let of_data =
        |error: measurements::MeasurementError| Refusal::of_key("data", error.to_string());
    let bytes = bytes_of(console, &data, limits)?;
    let wheel = Some(parts.wheel().to_owned());
    let choice = Choice { conditions: conditions.clone(), wheel, limits };
    let measured = measurements::read_from(&data, &*bytes, &choice).map_err(of_data)?;
    let family = SoilFamily::new(&stand.soil.document, &fit);
    let family = family.map_err(|problem| Refusal::of_key("fit", problem))?;
    let mut line = CommandLine::new("calibrate");
    line.option("data", &data);
    parts.add_words(&mut line);
    line.option("fit", &keys.join(","));
    for condition in &given {
        line.option("where", condition);
    }
    if is_point {
        line.flag("point-fit");
    }
    line.maybe("steps", steps.map(|it| it.to_string()).as_deref());
    line.maybe("seed", seed.map(|it| it.to_string()).as_deref());
    let (seed, steps) = (seed.unwrap_or(1), steps.unwrap_or(USUAL_STEPS));
    let mut inputs = WheelInputs {
        data: &data,
        bytes: &bytes,
        conditions: &conditions,
        family: &family,
        soil: &stand.soil.document,
        wheel: &stand.wheel.document,
        gravity: stand.gravity,
        model: &stand.model(),
        seed,
        steps,
    }
    .to_json();
    inputs["files"] = json!([measured.given]);
    let asked = FitAsked { data, stand, measured, family, is_point, seed, steps, inputs, line };
    Ok(Question::new(move |go_on, send| {
        let go_on = go_on.of_study();
        let turn = go_on.turn().ok_or_else(|| refused(AnswerError::Stopped))?;
        let found = asked.found(&*go_on, send)?;
        drop(turn);
        asked.tell(&found, send);
        Ok(())
    }))
}

/// The rows of a data set that comes with Grouser, or of a file of measurements in the folder.
pub(super) fn bytes_of(console: &Console, name: &str, limits: Limits) -> Result<Vec<u8>, Refusal> {
    let refused = |problem: String| Refusal::of_key("data", problem);
    if let Some(preset) = measurements::Source::preset(name) {
        return preset.bytes(limits).map(Cow::into_owned).map_err(|it| refused(it.to_string()));
    }
    let folder = &console.folder;
    let bytes = folder.find_map(name).and_then(|path| folder.read(&path, limits.bytes()));
    bytes.map_err(|problem| refused(problem.to_string()))
}

pub(super) fn parsed<T>(
    key: &str,
    words: &[String],
    parse: fn(&str) -> Result<T, String>,
) -> Result<Vec<T>, Refusal> {
    let each = words.iter().map(|word| parse(word));
    each.collect::<Result<_, _>>().map_err(|problem| Refusal::of_key(key, problem))
}

impl FitAsked {
    fn found(&self, go_on: &dyn GoOn, send: Send<'_>) -> Result<WheelFound, Refusal> {
        let aim = AimWords::default().aim(&self.measured.tests.trials);
        let name = Path::new(&self.data).file_name().map(|it| it.to_string_lossy());
        let problem = WheelProblem {
            family: &self.family,
            measured: &self.measured,
            file: &name.unwrap_or_default(),
            wheel: self.stand.wheel.value,
            model: self.stand.model(),
            gravity: self.stand.gravity,
            sampling: (!self.is_point).then(|| sampling(self.seed, self.steps, None)),
            aim: aim.map_err(|error| Refusal::of_key("data", error.to_string()))?,
            cross_validate: false,
        };
        let watched = Watched { go_on, send, counted: Mutex::default() };
        problem.solve(&watched).map_err(|error| match error {
            CalibrationError::Interrupted => refused(AnswerError::Stopped),
            error => Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()),
        })
    }

    /// Sends what was found, as `grouser calibrate --format json` prints it, and what is shown.
    fn tell(&self, found: &WheelFound, send: Send<'_>) {
        let Self { stand, family, .. } = self;
        let mut answer = json!({
            "schema": "grouser.calibrate.v1",
            "version": env!("CARGO_PKG_VERSION"),
            "inputs": self.inputs,
        });
        if let (Some(own), Value::Object(more)) =
            (answer.as_object_mut(), json!(found.results(AimWords::USUAL_TARGET)))
        {
            own.extend(more);
        }
        if !send(json::line(&answer)) {
            return;
        }
        let solved = &found.solved;
        let says = format!(
            "{} trials in {} cells: {}",
            self.measured.tests.trials.len(),
            self.measured.tests.cells.len(),
            solved.outcome()
        );
        let drawn = figures::all(&found.validation);
        let whose = format!("{} on {}", stand.wheel.document.name(), stand.soil.document.name());
        let slide = drawn.first().map(|it| {
            let command = self.line.text().to_owned();
            Slide::of_answer(&says, &it.chart.sheet(), &whose, command).to_svg()
        });
        let picture = |caption: &str, svg: String| json!({ "caption": caption, "svg": svg });
        let corner = solved.corner(MOST_DRAWN);
        let pictures = drawn.iter().map(|it| picture(it.caption, it.chart.to_svg()));
        let across = |it: &Corner| {
            let mut own = picture(&it.caption, it.figure.to_svg());
            own["is_wide"] = true.into();
            own
        };
        // It is read as a whole, and so it is as wide as the page, before the others.
        let pictures = corner.iter().map(across).chain(pictures);
        let mut documents = json!({ "soil.toml": found.soil.to_toml() });
        if let Some(samples) = samples_csv(family, solved) {
            documents[SAMPLES_FILE] = samples.into();
        }
        let columns: Vec<String> = match json!(solved.records.first()) {
            Value::Object(record) => record.keys().cloned().collect(),
            _ => Vec::new(),
        };
        let sentences =
            [vec![says], solved.unidentifiable.clone(), self.measured.notes.clone(), found.notes()]
                .concat();
        send(json::line(&json!({
            "schema": "grouser.shown.v1",
            "command": self.line.text(),
            "sentences": sentences,
            "assumptions": stand.soil.assumptions,
            "documents": documents,
            "tables": [
                shown_table(
                    "What is fitted, with its 95 % interval",
                    &columns,
                    &json!(solved.records),
                ),
                correlations(solved),
                errors(found),
            ],
            "figures": pictures.collect::<Vec<_>>(),
            "slide": slide,
        })));
    }
}

/// The correlation of each fitted number with each other, as a table.
fn correlations(solved: &Solved) -> Value {
    let matrix = solved.correlations();
    let keys: Vec<&str> = solved.records.iter().map(|it| &*it.key).collect();
    let row = |(place, key): (usize, &&str)| {
        let others = keys.iter().enumerate().map(|(at, it)| (*it, json!(matrix[(place, at)])));
        others.chain([("key", json!(key))]).collect()
    };
    let rows: Vec<Value> = keys.iter().enumerate().map(row).collect();
    let columns: Vec<&str> = ["key"].into_iter().chain(keys.iter().copied()).collect();
    shown_table("Correlation of what is fitted", &columns, &json!(rows))
}

/// The errors of the trials that were fitted, a row for each quantity.
fn errors(found: &WheelFound) -> Value {
    let overall = GroupRecord::from(&found.validation.overall);
    let row = |quantity| {
        let own = json!(overall.errors(quantity)?);
        let name = [("quantity", json!(column_of(quantity).name))].into_iter();
        Some(name.chain(ERRORS.map(|name| (name, own[name].clone()))).collect())
    };
    let rows: Vec<Value> = Quantity::ALL.into_iter().filter_map(row).collect();
    let columns: Vec<&str> = ["quantity"].into_iter().chain(ERRORS).collect();
    shown_table("Errors of the fit, in the unit of the quantity", &columns, &json!(rows))
}

/// Follows a fit.
struct Watched<'w> {
    go_on: &'w dyn GoOn,
    send: Send<'w>,
    counted: Mutex<Option<Progress<'w>>>,
}

impl Watched<'_> {
    fn count(&self) -> ControlFlow<()> {
        let counted = self.counted.lock().unwrap_or_else(PoisonError::into_inner);
        counted.iter().for_each(Progress::count);
        if self.go_on.is_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

impl Observer for Watched<'_> {
    fn begins(&self, work: Work) {
        let (what, done, all) = match work {
            Work::Searches(all) => ("searches of least squares", 0, Some(all as u64)),
            Work::Blocks { done, all } => ("blocks of the posterior", done, Some(all)),
            Work::LeavingOut => ("fits without a slip angle", 0, None),
        };
        let progress = Progress::new(self.send, what, done, all);
        *self.counted.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
    }

    fn searched(&self) -> ControlFlow<()> {
        self.count()
    }

    fn walked(&self, _: &PosteriorState) -> ControlFlow<()> {
        self.count()
    }
}
