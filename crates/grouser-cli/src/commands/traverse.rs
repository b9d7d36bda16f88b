//! `grouser traverse`: drives a rover across a slope.

mod of_model;
mod page;

use grouser::answers::traverse::{self, TraverseQuestion, reason};
use grouser::answers::{self, EVERY_MODEL};
use grouser::contact::validity::Flag;
use grouser::document::columns::run;
use grouser::document::columns::{ENERGY, MODEL, Quantity, TIME, X, Y, YAW, Z};
use grouser::document::gradient::GradientKeys;
use grouser::document::json;
use grouser::document::reading::{four_digits, metres};
use grouser::document::table::Table;
use grouser::simulation::{Run, Scenario, Trajectory};
use grouser::studies::traverse_band::RunBand;
use grouser_draw::chart::Drawable;
use grouser_draw::{Shown, title_of};
use serde::Serialize;
use serde_json::{Value, json};

use self::of_model::{OfModel, RECORDS, chart, given};
use super::animation::Target;
use super::destinations::Destinations;
use super::{Answer, add_files, method};
use crate::args::TraverseArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::slide::SlideFile;
use crate::output::text::Text;
use crate::output::{self, Format};
use crate::report::REPORT;
use crate::report::answer::drawing_of_ground;

/// Lines of the table on a terminal, besides the start.
const LINES: usize = 10;

pub(crate) fn run(args: &TraverseArgs) -> Result<(), Failure> {
    let destinations = Destinations::of(&args.run, &args.output)?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let of_one =
        [("--mcap", destinations.log.is_some()), ("--telemetry", destinations.telemetry.is_some())];
    for (flag, is_given) in of_one {
        if is_given && args.setting.each_model().len() > 1 {
            return Err(Failure::Usage(format!(
                "{flag} logs one run: name one model with --model"
            )));
        }
    }
    let Destinations { mut folder, animation, log, telemetry } = destinations;
    let mut gradients = args.gradients.keys();
    let mut all: Vec<OfModel> = Vec::new();
    for setting in args.setting.each_model() {
        let of_model = OfModel::of(args, &setting, gradients.as_ref(), &mut folder)?;
        // The numbers of the first are those of all: their rows have the same columns.
        let keys = of_model.gradient.as_ref().map(|it| it.keys.names().map(str::to_owned));
        gradients = keys.map(|names| GradientKeys::These(names.collect()));
        all.push(of_model);
    }
    if let Some(target) = animation {
        animate(args, &target, &all, folder.as_mut())?;
    }
    if let Some(log) = log {
        log.write(&all[0].scenario, &all[0].run, folder.as_mut())?;
    }
    if let Some(telemetry) = telemetry {
        telemetry.write(&all[0].scenario.value, &all[0].run, folder.as_mut())?;
    }
    if let Some(slide) = slide {
        let says = traverse::sentence(&all[0].scenario.value, &all[0].run);
        slide.write(&says, &chart(&all).sheet(), &title_of(&all[0].scenario))?;
    }
    match &all[..] {
        [one] => one.output(args, folder),
        all => output_all(args, folder, all),
    }
}

/// Draws the run, or one of each model, or two with different yaws beside each other.
fn animate(
    args: &TraverseArgs,
    target: &Target<'_>,
    all: &[OfModel],
    folder: Option<&mut OutputFolder>,
) -> Result<(), Failure> {
    let of_yaw = |run: &Trajectory| {
        let yaw = (100.0 * run.records[0].state.yaw.to_degrees()).round() / 100.0;
        format!("start yaw {yaw}°")
    };
    let beside = match (&args.beside_yaw_deg, all) {
        (None, _) => None,
        (yaw, [_]) => {
            let scenario = inputs::traverse(args, &args.setting, yaw.as_deref())?;
            let run = Run::new(&scenario.value)?.to_end()?;
            Some((of_yaw(&run), scenario, run))
        }
        _ => {
            let text = "--beside-yaw-deg draws two runs of one model: name one with --model";
            return Err(Failure::Usage(text.to_owned()));
        }
    };
    let own = of_yaw(&all[0].run);
    let name = |it: &OfModel| if beside.is_some() { own.as_str() } else { it.name() };
    let mut runs: Vec<Shown<'_>> = all
        .iter()
        .map(|it| Shown { name: name(it), run: &it.run, scenario: &it.scenario.value })
        .collect();
    if let Some((name, scenario, run)) = &beside {
        runs.push(Shown { name, run, scenario: &scenario.value });
    }
    target.write(&title_of(&all[0].scenario), &runs, folder)
}

impl OfModel {
    fn output(&self, args: &TraverseArgs, folder: Option<OutputFolder>) -> Result<(), Failure> {
        let rows = Rows::of_table(&self.rows());
        let sampling = args.uncertainty.sampling();
        let band = self.band.as_ref().zip(sampling);
        let question = TraverseQuestion { scenario: &self.scenario };
        let answer = question.answer("traverse", &self.run, band, self.gradient.as_ref());
        if let Some(mut folder) = folder {
            folder.add("traverse.json", json::text(&answer) + "\n");
            folder.add(RECORDS, rows.to_csv()?);
            let all = std::slice::from_ref(self);
            folder.add("traverse.svg", chart(all).to_svg());
            if let Some(drawing) = drawing_of_ground(&self.scenario.value, &self.run.records) {
                folder.add("ground.svg", drawing);
            }
            folder.add(REPORT, page::html(args, all));
            folder.add_document("scenario.toml", &self.scenario);
            folder.finish()?;
        }
        match args.output.format {
            Format::Table => {
                let given = output::answer::given(&given(std::slice::from_ref(self)));
                output::show(table(self) + self.band_table() + given)
            }
            Format::Csv => {
                tell_end(&self.run);
                self.band.iter().for_each(|band| output::notes(band.run.ends.sentences()));
                output::print(&rows.to_csv()?)
            }
            Format::Json => output::print_json(&answer),
        }
    }

    /// Some of the bands over time, and what becomes of the samples; nothing without bands.
    fn band_table(&self) -> Text {
        let Some(band) = &self.band else { return Text::default() };
        let last = band.times.len() - 1;
        let lines = LINES.min(last);
        let places: Vec<usize> = (0..=lines).map(|line| line * last / lines.max(1)).collect();
        let scenario = &self.scenario.value;
        let times = run::time_bands(&band.times, scenario).rows_at(&places);
        let RunBand { completed, ends, .. } = band.run;
        let early = ends.each().map(|(kind, count)| format!(", {count} {}", kind.in_words()));
        let samples = format!(
            "{} samples: {} completed{}\n",
            completed.trials,
            completed.successes,
            early.collect::<String>(),
        );
        let notes = ends.sentences().into_iter().map(|it| format!("note: {it}\n"));
        let samples = samples + &notes.collect::<String>();
        Text::from("\n") + Rows::of_table(&times).to_table(&run::bands_brief(scenario)) + samples
    }
}

/// The inputs of the answer of all models.
fn settings(args: &TraverseArgs, all: &[OfModel]) -> Value {
    let mut settings = json!({ "scenario": all[0].scenario.document, "model": EVERY_MODEL });
    // That of the scenario is the first of all.
    if let Some(scenario) = settings["scenario"].as_object_mut() {
        scenario.shift_remove("model");
    }
    if let Some(sampling) = args.uncertainty.sampling() {
        settings["samples"] = sampling.count.into();
        settings["seed"] = sampling.seed.into();
    }
    if let Some(gradient) = &all[0].gradient {
        settings["gradients"] = gradient.keys.names().collect();
    }
    add_files(&mut settings, &given(all));
    settings
}

#[derive(Serialize)]
struct Summaries {
    rows: Table,
}

/// The results of all models: a row for each, and the records of each in a file of its own.
fn output_all(
    args: &TraverseArgs,
    folder: Option<OutputFolder>,
    all: &[OfModel],
) -> Result<(), Failure> {
    let mut summaries = Summaries { rows: Table::default() };
    for of_model in all {
        summaries.rows.append(of_model.summary());
    }
    let rows = Rows::of_table(&summaries.rows);
    let answer = Answer::new("traverse", settings(args, all), &summaries);
    if let Some(mut folder) = folder {
        folder.add("traverse.json", answer.to_text());
        folder.add("traverse.csv", rows.to_csv()?);
        folder.add("traverse.svg", chart(all).to_svg());
        folder.add(REPORT, page::html(args, all));
        for of_model in all {
            let name = of_model.name();
            folder.add(format!("traverse-{name}.csv"), Rows::of_table(&of_model.rows()).to_csv()?);
            folder.add_document(&format!("scenario-{name}.toml"), &of_model.scenario);
        }
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => {
            let mut names = vec![MODEL.to_owned()];
            let has_bands = args.uncertainty.sampling.uncertainty;
            names.extend(if has_bands { run::summary_bands_brief() } else { run::summary_brief() });
            output::show(rows.to_table(&names) + output::answer::given(&given(all)))
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

/// Rows of numbers do not say that a run ended early, or why.
fn tell_end(run: &Trajectory) {
    if !run.outcome.is_completed() {
        let (outcome, time) = (run.outcome.name(), four_digits(run.last().time));
        let reason = reason(run);
        output::message(&format!("note: {outcome} after {time} s{reason}"));
    }
}

/// Some of the records with the means of their wheels, the model where nobody names one, and the
/// outcome.
fn table(of: &OfModel) -> Text {
    let (run, scenario) = (&of.run, &of.scenario);
    let mut samples = run::brief(run, &scenario.value, LINES);
    let mut derivatives = String::new();
    if let Some(gradient) = &of.gradient {
        let keys: Vec<&str> = gradient.keys.names().collect();
        let names = answers::gradient::brief(&[Y.name, YAW.name, ENERGY.name], &keys);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let places = run::brief_places(run, LINES);
        samples.columns.extend(gradient.rows.select(&names, &places).columns);
        derivatives = gradient.lines();
    }
    let names: Vec<&str> = samples.columns.iter().map(|(name, _)| name.as_str()).collect();
    let end = run.last();
    let simulation = method::line(run, &scenario.value);
    let reason = reason(run);
    let last = |quantity: Quantity| {
        samples.numbers(quantity.name).last().copied().flatten().unwrap_or(f64::NAN)
    };
    let place = if scenario.value.ground.is_plane() {
        format!("x {} m, y {} m", metres(last(X)), metres(last(Y)))
    } else {
        format!("x {} m, y {} m, z {} m", metres(last(X)), metres(last(Y)), metres(last(Z)))
    };
    let yaw = four_digits(last(YAW));
    let battery = if scenario.value.rover.has_motors() {
        format!(", {} J from the battery", four_digits(end.energy.electrical))
    } else {
        String::new()
    };
    let outcome = format!(
        "{} after {} s{reason}; {place}, yaw {yaw}°, {} J{battery}\n{simulation}",
        run.outcome.name(),
        four_digits(end.time),
        four_digits(end.energy.motors),
    );
    Rows::of_table(&samples).to_table(&names)
        + derivatives
        + flag_lines(run, &scenario.value)
        + scenario.document.usual_model_line("soil")
        + outcome
}

/// The flags of a run, a line each: since when, and what they mean.
fn flag_lines(run: &Trajectory, scenario: &Scenario) -> String {
    let raised = run::raised(run, scenario);
    let names = raised.texts("flag").iter().flatten();
    let times = raised.numbers(TIME.name).iter().flatten();
    let line = |(name, time): (&String, &f64)| {
        let meaning = Flag::of_name(name).map_or("", |flag| flag.rule().meaning);
        format!("{name} since {} s: {meaning}\n", four_digits(*time))
    };
    names.zip(times).map(line).collect()
}
