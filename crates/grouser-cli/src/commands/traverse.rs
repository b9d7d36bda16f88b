//! `grouser traverse`: drives a rover across a slope.

use grouser::contact::validity::Flag;
use grouser::document::columns::run::{self, RunObject};
use grouser::document::columns::{TIME, X, Y, YAW};
use grouser::document::escape;
use grouser::simulation::{Outcome, Run, Scenario, Trajectory};
use serde_json::json;

use super::{Answer, strict};
use crate::args::TraverseArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, four_digits};
use crate::output::{self, Format};

/// Lines of the table on a terminal, besides the start.
const LINES: usize = 10;

pub(crate) fn run(args: &TraverseArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::traverse(args)?;
    let run = Run::new(&scenario.value)?.to_end()?;
    let samples = run::table(&run, &scenario.value);
    if args.strict.strict {
        let flags = run::each_findings(&run, &scenario.value);
        strict::check(&args.strict, flags.iter().map(|it| &**it), &samples, &[TIME.name])?;
    }
    let rows = Rows::of_table(&samples);
    let object = RunObject { run: &run, scenario: &scenario.value };
    let answer = Answer::new("traverse", json!({ "scenario": scenario.document }), object);
    if let Some(mut folder) = folder {
        folder.add("traverse.json", answer.to_text());
        folder.add("traverse.csv", rows.to_csv()?);
        folder.add("traverse.svg", chart(&run).to_svg());
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&table(&run, &scenario.value)),
        Format::Csv => {
            tell_end(&run);
            output::print(&rows.to_csv()?)
        }
        Format::Json => output::print_json(&answer),
    }
}

/// Rows of numbers do not say that a run ended early, or why.
fn tell_end(run: &Trajectory) {
    if run.outcome != Outcome::Completed {
        let (outcome, time) = (run.outcome.name(), four_digits(run.last().time));
        let reason = reason(run);
        output::message(&format!("note: {outcome} after {time} s{reason}"));
    }
}

/// The reason of an outcome, after a colon, on one line.
fn reason(run: &Trajectory) -> String {
    run.outcome.reason().map_or(String::new(), |reason| format!(": {}", escape::line(&reason)))
}

/// Some of the records with the means of their wheels, and the outcome.
fn table(run: &Trajectory, scenario: &Scenario) -> String {
    let samples = run::brief(run, LINES);
    let names: Vec<&str> = samples.columns.iter().map(|(name, _)| name.as_str()).collect();
    let end = run.last();
    let simulation = match (run.method.name(), run.method.reason()) {
        (_, Some(reason)) => format!("\nsimulation: {reason}"),
        ("dynamic", None) => String::new(),
        (word, None) => format!("\nsimulation: {word}"),
    };
    let reason = reason(run);
    let [x, y, yaw] = [X, Y, YAW].map(|quantity| {
        let last = samples.numbers(quantity.name).last().copied().flatten();
        four_digits(last.unwrap_or(f64::NAN))
    });
    format!(
        "{}{}{} after {} s{reason}; x {x} m, y {y} m, yaw {yaw}°, {} J{simulation}\n",
        Rows::of_table(&samples).to_table(&names),
        flag_lines(run, scenario),
        run.outcome.name(),
        four_digits(end.time),
        four_digits(end.energy.motors),
    )
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

/// The path, seen from above.
fn chart(run: &Trajectory) -> Chart {
    let points =
        run.records.iter().map(|sample| (sample.state.position.x, sample.state.position.y));
    Chart {
        title: "Path on the slope".into(),
        x_label: "along the contour, x [m]".into(),
        y_label: "uphill, y [m]".into(),
        series: vec![Series::new("path", Style::Line, 1, points)],
    }
}
