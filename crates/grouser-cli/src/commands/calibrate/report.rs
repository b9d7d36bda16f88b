//! The report of a calibration: text, page, figures.

use grouser::document::calibration::{
    LeftOutRecord, ParameterRecord, Solved, WheelFound, samples_csv,
};
use grouser::document::columns::fit::column_of;
use grouser::document::columns::{LOAD, SLIP_ANGLE, SLIP_RATIO};
use grouser::document::reading::four_digits;
use grouser::document::validation::GroupRecord;
use grouser::document::{Document, SAMPLES_FILE, SoilFamily};
use grouser::studies::calibration::Posterior;
use grouser::studies::calibration::diagnostics::Samples;
use grouser::studies::measurement::Quantity;
use grouser_draw::chart::{Chart, Drawable, Series, Style};
use serde::Serialize;

use super::super::{Answer, validate};
use super::wheel::Problem;
use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, aligned};
use crate::output::text::Text;
use crate::output::{self, Format};
use crate::report::answer::add_next;
use crate::report::page::Page;

/// Keys of the corner plot on the page; the file has all.
const KEYS_ON_PAGE: usize = 7;

/// Prints the results.
pub(super) fn print<R: Serialize>(
    args: &CalibrateArgs,
    text: Text,
    solved: &Solved,
    answer: &Answer<R>,
) -> Result<(), Failure> {
    match args.output.format {
        Format::Table => output::show(text),
        Format::Csv => output::print(&Rows::of(&solved.records).to_csv()?),
        Format::Json => output::print_json(answer),
    }
}

/// The fitted soil with its samples, and the parameters.
pub(super) fn add_soil(
    folder: &mut OutputFolder,
    family: &SoilFamily,
    solved: &Solved,
    soil: &Document,
) -> Result<(), Failure> {
    folder.add("parameters.csv", Rows::of(&solved.records).to_csv()?);
    folder.add("soil.toml", soil.to_toml());
    if let Some(samples) = samples_csv(family, solved) {
        folder.add(SAMPLES_FILE, samples);
    }
    Ok(())
}

/// The report as text: blocks with an empty line between them.
pub(super) fn text(found: &WheelFound, target: &str) -> Text {
    let solved = &found.solved;
    let mut blocks = vec![parameters(&solved.records)];
    blocks.extend(conclusions(solved));
    blocks.extend(judgement(found, target));
    Text::blocks(blocks)
}

/// Errors of the fit, errors at slip angles left out, and proposed runs.
fn judgement(found: &WheelFound, target: &str) -> Vec<Text> {
    let overall = GroupRecord::from(&found.validation.overall);
    let mut blocks = vec![errors("with the fit", &[overall])];
    let left_out: Vec<&LeftOutRecord> =
        found.left_out.iter().chain(&found.left_out_overall).collect();
    if !left_out.is_empty() {
        let groups: Vec<GroupRecord> = left_out.iter().map(|it| it.errors.clone()).collect();
        blocks.push(errors("with the angle left out of the fit", &groups));
    }
    if left_out.iter().any(|it| it.has_bands()) {
        blocks.push(coverage(&left_out));
    }
    if !found.proposals.is_empty() {
        let title = format!("next runs that narrow the prediction of {target}\n");
        blocks.push(Text::from(title) + next_runs(found));
    }
    blocks
}

/// How the bands of posteriors hold cells that they have not seen, a row for each quantity.
fn coverage(groups: &[&LeftOutRecord]) -> Text {
    let header = [
        SLIP_ANGLE.name,
        "motion",
        "quantity",
        "cells",
        "coverage_50",
        "coverage_95",
        "interval_score",
    ];
    let row = |group: &LeftOutRecord, quantity: Quantity| {
        let bands = group.coverage(quantity);
        let mut row = condition(&group.errors);
        row.extend([column_of(quantity).name.to_owned(), bands.cells_with_band?.to_string()]);
        let shares = [bands.coverage_50?, bands.coverage_95?];
        row.extend(shares.map(|share| format!("{share:.2}")));
        row.push(four_digits(bands.interval_score?));
        Some(row)
    };
    let rows = groups.iter().flat_map(|group| Quantity::ALL.map(|quantity| row(group, quantity)));
    let table = aligned(&header.map(str::to_owned), &rows.flatten().collect::<Vec<_>>());
    Text::from("predictive bands with the angle left out of the fit\n") + table
}

/// Slip angle and motion of a group.
fn condition(group: &GroupRecord) -> Vec<String> {
    let angle = group.slip_angle().map_or("all".to_owned(), four_digits);
    vec![angle, group.motion().to_owned()]
}

fn next_runs(found: &WheelFound) -> Text {
    let header = [LOAD.name, SLIP_RATIO.name, SLIP_ANGLE.name, "std_before", "std_after"];
    let rows = found.proposals.iter().map(|it| {
        [it.load_n, it.slip_ratio, it.slip_angle_deg, it.std_before, it.std_after]
            .map(four_digits)
            .to_vec()
    });
    aligned(&header.map(str::to_owned), &rows.collect::<Vec<_>>())
}

/// The parameters as a table.
pub(super) fn parameters(records: &[ParameterRecord]) -> Text {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), four_digits);
    let row = |it: &ParameterRecord| {
        vec![
            it.key.clone(),
            four_digits(it.start),
            four_digits(it.fit),
            number(it.fit_std),
            number(it.p50),
            number(it.p2_5),
            number(it.p97_5),
            number(it.r_hat),
            it.effective_samples.map_or("-".to_owned(), |count| format!("{count:.0}")),
        ]
    };
    let header =
        ["key", "start", "fit", "fit_std", "p50", "p2_5", "p97_5", "r_hat", "effective_samples"];
    aligned(&header.map(str::to_owned), &records.iter().map(row).collect::<Vec<_>>())
}

/// Parameters that the data do not determine, and the discrepancy between model and data.
pub(super) fn conclusions(solved: &Solved) -> Vec<Text> {
    let mut blocks = Vec::new();
    if !solved.unidentifiable.is_empty() {
        let lines: String = solved.unidentifiable.iter().map(|it| format!("- {it}\n")).collect();
        blocks.push(format!("what these data do not determine\n{lines}").into());
    }
    blocks.push(discrepancies(solved));
    blocks
}

fn discrepancies(solved: &Solved) -> Text {
    let rows = solved
        .discrepancies
        .iter()
        .map(|it| vec![it.channel.clone(), four_digits(it.mean.unwrap_or(it.fit))]);
    let header = ["channel", "std"].map(str::to_owned);
    let table = aligned(&header, &rows.collect::<Vec<_>>());
    let text = Text::from("model discrepancy, beyond the scatter of the trials\n") + table;
    let lengths = solved.correlation_lengths.iter();
    let lengths: Vec<Vec<String>> = lengths
        .map(|it| vec![it.along.to_owned(), four_digits(it.mean.unwrap_or(it.fit))])
        .collect();
    if lengths.is_empty() {
        return text;
    }
    let header = ["along", "correlation_length"].map(str::to_owned);
    text + "\n" + aligned(&header, &lengths)
}

/// Root mean square errors of groups of cells.
fn errors(what: &str, groups: &[GroupRecord]) -> Text {
    let [pull, side, sinkage, torque] = Quantity::ALL.map(|it| column_of(it).name);
    let header = [SLIP_ANGLE.name, "motion", "cells", pull, side, sinkage, torque];
    let row = |group: &GroupRecord| {
        let rmse = |quantity| {
            group.errors(quantity).map_or("-".to_owned(), |errors| four_digits(errors.rmse))
        };
        let mut row = condition(group);
        row.push(group.0.cells.to_string());
        row.extend(Quantity::ALL.map(rmse));
        row
    };
    let rows: Vec<Vec<String>> = groups.iter().map(row).collect();
    Text::from(format!("root mean square errors {what}\n"))
        + aligned(&header.map(str::to_owned), &rows)
}

/// The page, and the figures as files.
pub(super) fn add(folder: &mut OutputFolder, problem: &Problem, found: &WheelFound, target: &str) {
    let mut page = Page::new("Calibration");
    let soil = problem.stand.soil.document.name();
    let wheel = problem.stand.wheel.document.name();
    let model = problem.stand.model.name();
    page.answer(&fitted(&found.solved.records));
    page.paragraph(&format!(
        "Fitted to {} ({} trials in {} cells) with the model {model}, {wheel}; keys that are not \
         fitted are those of {soil}.",
        problem.file,
        problem.measured.tests.trials.len(),
        problem.measured.tests.cells.len(),
    ));
    let notes = found.notes();
    if !notes.is_empty() {
        page.list(notes);
    }
    page.heading("Results");
    add_parameters(&mut page, &found.solved);
    for block in judgement(found, target) {
        page.text(&block);
    }
    page.heading("Measured and predicted with the fit");
    for figure in validate::figures::all(&found.validation) {
        let svg = figure.chart.to_svg();
        page.drawing(&svg, figure.caption);
        folder.add(format!("figures/{}.svg", figure.file), svg);
    }
    add_posterior(folder, &mut page, &found.solved);
    add_next(&mut page, &next());
    page.folded("Correlations", |page| {
        page.text(&(Text::from("of each pair of fitted keys") + correlations(&found.solved)));
    });
    page.folded("How it was made", |page| how_it_was_made(page, problem));
    page.folded("Assumptions in force", |page| {
        page.list(problem.stand.soil.assumptions.iter().chain(&problem.stand.wheel.assumptions));
    });
    folder.add("report.html", page.to_html());
}

/// The commands to go on with.
pub(super) fn next() -> [String; 3] {
    [
        "grouser heading --rover ROVER --soil soil.toml --slope-deg LIST --out HEADINGS",
        "grouser card --rover ROVER --soil soil.toml --out CARD",
        "grouser validate --data OTHER-TESTS.csv --wheel WHEEL --soil soil.toml --out VALIDATED",
    ]
    .map(str::to_owned)
}

fn how_it_was_made(page: &mut Page, problem: &Problem) {
    page.paragraph(
        "Bounded least squares from several starts; then an affine-invariant ensemble sampler with \
         priors uniform within the bounds (by the logarithm where a number spans decades). An \
         observation is the mean over the trials of a cell; its deviation from the model is taken \
         as normal: the scatter of that mean between trials, and a model discrepancy with one \
         standard deviation for each quantity of driven and of skidding wheels, correlated between \
         cells by a Matérn kernel over slip and slip angle. Deviations and correlation lengths are \
         sampled along. Each sample in soil-samples.csv has a discrepancy drawn with it, which \
         predictions with --uncertainty add to the model's.",
    );
    let setting = |name: &str| format!("{name}: {}", problem.settings[name]);
    page.list(["data", "data_fingerprint", "where", "model", "seed", "steps"].map(setting));
    page.paragraph(
        "All inputs are in calibration.json, the documents of the start in start-soil.toml and \
         wheel.toml.",
    );
}

/// The fitted values in a sentence, each with the interval that holds 95 % of its posterior.
fn fitted(records: &[ParameterRecord]) -> String {
    let one = |it: &ParameterRecord| match (it.p50, it.p2_5, it.p97_5) {
        (Some(middle), Some(low), Some(high)) => {
            let [middle, low, high] = [middle, low, high].map(four_digits);
            format!("{} = {middle} ({low} to {high})", it.key)
        }
        _ => match it.fit_std {
            Some(deviation) => {
                format!("{} = {} ± {}", it.key, four_digits(it.fit), four_digits(deviation))
            }
            None => format!("{} = {}, at its bound", it.key, four_digits(it.fit)),
        },
    };
    let values: Vec<String> = records.iter().map(one).collect();
    let interval = if records.iter().any(|it| it.p50.is_some()) {
        " In brackets: 95 % of the posterior."
    } else {
        ""
    };
    format!("{}.{interval}", values.join("; "))
}

/// The fitted keys, those that the data do not determine, and the discrepancy between model and
/// data.
pub(super) fn add_parameters(page: &mut Page, solved: &Solved) {
    page.text(&(Text::from("fitted keys") + parameters(&solved.records)));
    if !solved.unidentifiable.is_empty() {
        page.heading("What these data do not determine");
        page.list(&solved.unidentifiable);
    }
    page.text(&discrepancies(solved));
}

/// Corner plot and traces, if there is a posterior.
pub(super) fn add_posterior(folder: &mut OutputFolder, page: &mut Page, solved: &Solved) {
    let Some(Posterior { samples, .. }) = &solved.solution.posterior else { return };
    page.heading("Posterior");
    if let Some(corner) = solved.corner(KEYS_ON_PAGE) {
        let is_part = solved.records.len() > KEYS_ON_PAGE;
        let all = if is_part { " figures/corner.svg has all." } else { "" };
        page.drawing(&corner.figure.to_svg(), &(corner.caption + all));
    }
    if let Some(corner) = solved.corner(usize::MAX) {
        folder.add("figures/corner.svg", corner.figure.to_svg());
    }
    let traces = traces(&solved.records, samples).to_svg();
    page.drawing(
        &traces,
        "Means of each ensemble of walkers over the kept steps, in standard deviations from the \
         mean of all. Ensembles that have converged cross each other all along.",
    );
    folder.add("figures/traces.svg", traces);
}

/// For the key that mixes worst: the mean of each ensemble over the steps.
fn traces(records: &[ParameterRecord], samples: &Samples) -> Chart {
    let worst = |it: &&(usize, &ParameterRecord)| it.1.r_hat.unwrap_or(1.0);
    let numbered: Vec<(usize, &ParameterRecord)> = records.iter().enumerate().collect();
    let place = numbered.iter().max_by(|a, b| worst(a).total_cmp(&worst(b))).map_or(0, |it| it.0);
    let (mean, deviation) = (records[place].mean.unwrap_or(0.0), records[place].std.unwrap_or(1.0));
    let series = samples.chains.iter().enumerate().map(|(number, chain)| {
        let steps = chain.chunks(samples.walkers).enumerate();
        let points = steps.map(|(step, walkers)| {
            let sum: f64 = walkers.iter().map(|row| row[place]).sum();
            (step as f64, (sum / walkers.len() as f64 - mean) / deviation.max(f64::MIN_POSITIVE))
        });
        Series::new(format!("ensemble {}", number + 1), Style::Line, number, points)
    });
    Chart::new(
        format!("Mean of the walkers: {}, the key that mixes worst", records[place].key),
        ("kept step", "deviations from the mean"),
        series.collect(),
    )
}

/// Correlations of the fitted keys, two digits, under numbers for names.
fn correlations(solved: &Solved) -> Text {
    let count = solved.records.len();
    let matrix = solved.correlations();
    let mut header = vec!["key".to_owned()];
    header.extend((1..=count).map(|number| number.to_string()));
    let row = |(place, record): (usize, &ParameterRecord)| {
        let mut row = vec![format!("{} {}", place + 1, record.key)];
        row.extend((0..count).map(|other| format!("{:.2}", matrix[(place, other)])));
        row
    };
    aligned(&header, &solved.records.iter().enumerate().map(row).collect::<Vec<_>>())
}
