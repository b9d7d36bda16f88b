//! `grouser card`: the operator's card, on one page.

mod columns;
mod layout;
mod measured;
mod picture;
mod row;
mod texts;

use std::path::Path;

use grouser::document::card::RuleRecord;
use grouser::document::columns::card::{self, MeasuredYaw, YAW_AS_WRITTEN};
use grouser::document::columns::{SLOPE, YAW};
use grouser::document::escape;
use grouser::document::table::{Row, Table};
use grouser::studies::card::{Card, CardStudy};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::heading::HeadingStudy;
use grouser_page::{Sheet, markup};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling, strict};
use crate::args::{CardArgs, SideChoice};
use crate::failure::Failure;
use crate::inputs::{self, CardInputs};
use crate::output::folder::{OldFiles, OutputFolder};
use crate::output::rows::Rows;
use crate::output::{self, Format, file};
use picture::Picture;
use row::CardRow;

/// Steepest slope that is looked at [°].
const STEEPEST_DEG: u8 = 60;

pub(crate) fn run(args: &CardArgs) -> Result<(), Failure> {
    let target = args.out.as_deref().map(|out| Target::of(out, args.force)).transpose()?;
    let inputs = inputs::card(args)?;
    let measured = match &args.measured {
        Some(file) => measured::read(file, args.read.limits())?,
        None => Vec::new(),
    };
    let samples = samples(args, &inputs)?;
    let card = compute(args, &inputs, &samples, &measured)?;
    let all = card::table(&card);
    let flags = card.rows.iter().map(|row| &*row.findings);
    let held = card.rows.iter().take_while(|row| row.level.is_some()).count();
    strict::check(&args.strict, flags.take(held), &all, &[SLOPE.name])?;
    let rows = shown(&all, &measured);
    let beside = card::beside(&rows, &measured);
    if let Some(target) = target {
        let uphill = args.uphill;
        let picture = Picture::of(&inputs.scenario.value.rover, uphill);
        let sheet = layout::draw(&texts::of(args, &inputs, &card), &picture, &rows);
        target.write(
            &Answers { args, inputs: &inputs, card: &card, rows: &rows, beside: &beside },
            &sheet,
        )?;
    }
    match args.format {
        Format::Table => output::print(&table(&inputs, &card, &rows, &beside)),
        Format::Csv => output::print(&Rows::of_table(&rows).to_csv()?),
        Format::Json => output::print_json(&answer(
            args,
            &inputs,
            &card,
            &card::steepest(&card),
            &rows,
            &beside,
        )),
    }
}

/// The samples; none where one soil and one model are all there is.
fn samples(args: &CardArgs, inputs: &CardInputs) -> Result<Vec<Sample>, Failure> {
    let band = BandInputs::of_scenario(&inputs.scenario);
    if inputs.scenario.uncertain.is_none() && band.models().shares().len() == 1 {
        return Ok(Vec::new());
    }
    sampling::draw(&band, args.samples, args.seed)
}

fn compute(
    args: &CardArgs,
    inputs: &CardInputs,
    samples: &[Sample],
    measured: &[MeasuredYaw],
) -> Result<Card, Failure> {
    let mut heading = HeadingStudy::of(&inputs.scenario.value);
    if args.uphill == SideChoice::Right {
        heading.rover = heading.rover.mirrored();
    }
    let is_uncertainty_stated = inputs.scenario.stated_uncertainty().is_some();
    let (rim_speed, rule) = (inputs.rim_speed, inputs.rule);
    let study = CardStudy { heading, rim_speed, rule, is_uncertainty_stated };
    let degrees = (0..=STEEPEST_DEG).map(f64::from);
    let asked = measured.iter().map(|point| point.slope);
    let mut slopes: Vec<f64> = degrees.chain(asked).map(|slope| SLOPE.unit.to_si(slope)).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.dedup();
    let bar = output::progress_bar(samples.len() as u64);
    bar.set_message("samples");
    let card = study.card(samples, &slopes, &|| bar.inc(1));
    bar.finish_and_clear();
    Ok(card?)
}

/// The rows up to the first slope that no soil can be crossed on, and those that were measured on.
fn shown(rows: &Table, measured: &[MeasuredYaw]) -> Table {
    let [least, ..] = YAW.quantiles();
    let is_crossed = |row: &CardRow<'_>| {
        [&*least, YAW_AS_WRITTEN.name].iter().any(|name| row.named(name).is_some())
    };
    let is_last = |row: &CardRow<'_>| row.is_no_go() && !is_crossed(row);
    let last = CardRow::all(rows).position(|row| is_last(&row)).unwrap_or(rows.rows());
    let is_measured = |row: CardRow<'_>| measured.iter().any(|it| it.slope == row.slope());
    let kept = CardRow::all(rows).enumerate();
    let kept = kept.filter(|(place, row)| *place <= last || is_measured(*row));
    rows.rows_at(&kept.map(|(place, _)| place).collect::<Vec<_>>())
}

/// The card's rows, or the comparison where one is asked for.
fn table(inputs: &CardInputs, card: &Card, rows: &Table, beside: &Table) -> String {
    if beside.rows() > 0 {
        return Rows::of_table(beside).to_table(&card::beside_brief());
    }
    let brief = if card.draws.is_some() { card::bands_brief() } else { card::brief() };
    let text = Rows::of_table(rows).to_table(&brief);
    let scenario = &inputs.scenario;
    if scenario.stated_uncertainty().is_some() {
        return text;
    }
    let bands = match (card.draws, &scenario.uncertain) {
        (Some(_), Some(_)) => "bands are of priors and of the models",
        (Some(_), None) => "bands are of the models alone",
        (None, _) => "no bands",
    };
    format!("{text}no uncertainty of this soil is stated: {bands}; no slope is a go\n")
}

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    steepest: Row<'a>,
    rows: &'a Table,
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<&'a Table>,
}

fn answer<'a>(
    args: &CardArgs,
    inputs: &CardInputs,
    card: &Card,
    steepest: &'a Table,
    rows: &'a Table,
    measured: &'a Table,
) -> Answer<Results<'a>> {
    let measured = (measured.rows() > 0).then_some(measured);
    let results = Results { steepest: steepest.row(0), rows, measured };
    Answer::new("card", settings(args, inputs, card), results)
}

/// The inputs of the card.
fn settings(args: &CardArgs, inputs: &CardInputs, card: &Card) -> Value {
    let document = &inputs.scenario.document;
    let mut settings = json!({
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "model": inputs.scenario.value.theory.name(),
        "loads": document.get("loads"),
        "moments": document.get("moments"),
        "uphill": if args.uphill == SideChoice::Left { "left" } else { "right" },
        "speed_m_s": inputs.rim_speed,
        "rule": RuleRecord::from(&inputs.rule),
    });
    if card.draws.is_some() {
        settings["samples"] = args.samples.into();
        settings["seed"] = args.seed.into();
        settings[sampling::SHARES] = sampling::shares(&BandInputs::of_scenario(&inputs.scenario));
    }
    settings
}

/// Forms of the page, by what the file's name ends in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Html,
    Pdf,
    Png,
    Svg,
}

const FORMS: [(&str, Form); 4] =
    [("html", Form::Html), ("pdf", Form::Pdf), ("png", Form::Png), ("svg", Form::Svg)];

impl Form {
    fn bytes(self, sheet: &Sheet) -> Vec<u8> {
        match self {
            Self::Html => html(sheet).into_bytes(),
            Self::Pdf => sheet.to_pdf(),
            Self::Png => sheet.to_png(),
            Self::Svg => sheet.to_svg().into_bytes(),
        }
    }
}

/// A page that prints on one sheet.
fn html(sheet: &Sheet) -> String {
    let (title, svg) = (markup(sheet.title()), sheet.to_svg());
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <meta name=\"generator\" content=\"Grouser {}\">\n<title>{title}</title>\n<style>\n\
         @page {{ size: A4; margin: 0 }}\nbody {{ margin: 0 }}\n\
         svg {{ display: block; width: 100%; max-width: 210mm; height: auto; margin: 0 auto }}\n\
         @media print {{ svg {{ width: 210mm; height: 296.9mm }} }}\n\
         </style>\n</head>\n<body>\n{svg}</body>\n</html>\n",
        env!("CARGO_PKG_VERSION")
    )
}

/// What is written beside the page.
struct Answers<'a> {
    args: &'a CardArgs,
    inputs: &'a CardInputs,
    card: &'a Card,
    rows: &'a Table,
    beside: &'a Table,
}

/// Where the card goes.
enum Target<'a> {
    File(&'a Path, Form),
    Folder(OutputFolder),
}

impl<'a> Target<'a> {
    /// A file for a name that ends like one; a folder for one that ends in nothing.
    fn of(out: &'a Path, force: bool) -> Result<Self, Failure> {
        let Some(ending) = out.extension().filter(|_| !out.is_dir()) else {
            let old_files = if force { OldFiles::Replace } else { OldFiles::Keep };
            return Ok(Self::Folder(OutputFolder::open(out, old_files)?));
        };
        let ending = ending.to_string_lossy().to_lowercase();
        let Some((_, form)) = FORMS.iter().find(|(known, _)| *known == ending) else {
            let shown = escape::path(out);
            return Err(Failure::Usage(format!(
                "--out {shown}: a card ends in .html, .pdf, .png or .svg; a name without an \
                 ending is a folder for all of them"
            )));
        };
        file::check_new(out, force)?;
        Ok(Self::File(out, *form))
    }

    fn write(self, answers: &Answers<'_>, sheet: &Sheet) -> Result<(), Failure> {
        let mut folder = match self {
            Self::File(out, form) => return file::write(out, &form.bytes(sheet)),
            Self::Folder(folder) => folder,
        };
        for (ending, form) in FORMS {
            folder.add(format!("card.{ending}"), form.bytes(sheet));
        }
        let Answers { args, inputs, card, rows, beside } = answers;
        folder.add(
            "card.json",
            answer(args, inputs, card, &card::steepest(card), rows, beside).to_text(),
        );
        folder.add("card.csv", Rows::of_table(rows).to_csv()?);
        folder.add_document("scenario.toml", &inputs.scenario);
        folder.finish()
    }
}
