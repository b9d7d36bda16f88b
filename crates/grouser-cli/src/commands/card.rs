//! `grouser card`: the operator's card, on two pages.

mod columns;
mod draft;
mod layout;
mod measured;
mod picture;
mod row;
mod second;
mod stops;
mod texts;

use std::path::{Path, PathBuf};

use grouser::answers::Sampling;
use grouser::document::columns::card::{self, MeasuredYaw, YAW_AS_WRITTEN};
use grouser::document::columns::verdict::{ADVICE, ADVICE_OBJECT};
use grouser::document::columns::{Column, SLOPE, YAW, card_courses, card_drives};
use grouser::document::reading::four_digits;
use grouser::document::table::{Row, Table, WithObject};
use grouser::document::{LoadedScenario, escape};
use grouser::simulation::Approach;
use grouser::studies::card::Card;
use grouser::studies::card::drives::{CardDrives, RowDrives};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::verdict::{Side, SlopeStudy, Verdict};
use grouser_draw::{Sheet, markup, pdf_of};
use grouser_serve::CardOrder;
use serde::Serialize;
use serde_json::{Value, json};

use super::{Answer, sampling, strict};
use crate::args::{CardArgs, SideChoice};
use crate::failure::Failure;
use crate::inputs::{self, CardInputs};
use crate::output::folder::{OldFiles, OutputFolder};
use crate::output::rows::Rows;
use crate::output::text::Text;
use crate::output::{self, Format, file, remedy, terminal};
use crate::report::REPORT;
use crate::report::answer::add_next;
use crate::report::page::Page;
use picture::Picture;
use row::CardRow;

/// Samples of what somebody at a terminal reads while the card is computed. Source: ours, a second.
const DRAFT: usize = 20;

/// Steepest slope that is looked at [°].
const STEEPEST_DEG: u8 = 60;

pub(crate) fn run(args: &CardArgs) -> Result<(), Failure> {
    let target = args.out.as_deref().map(|out| Target::of(out, args.force)).transpose()?;
    if let Some(stops) = &args.stops {
        file::check_new(stops, args.force)?;
    }
    let inputs = inputs::card(args)?;
    let measured = match &args.measured {
        Some(file) => measured::read(file, args.read.limits())?,
        None => Vec::new(),
    };
    let samples = sampling::draw_if_uncertain(&inputs.scenario, args.samples, args.seed)?;
    let study = study(args, &inputs);
    let card = compute(&study, &samples, &measured)?;
    let all = card::table(&card);
    let flags = card.rows.iter().map(|row| &*row.findings);
    let held = card.rows.iter().take_while(|row| row.level.is_some()).count();
    strict::check(&args.strict, flags.take(held), &all, &[SLOPE.name])?;
    let rows = shown(&all, &measured);
    let drives = drives(args, &inputs, &study, &card)?;
    let answers = Answers {
        args,
        inputs: &inputs,
        card: &card,
        steepest: card::steepest(&card, &inputs.scenario, &study, uphill(args)),
        beside: card::beside(&rows, &measured),
        advice: advice(&rows),
        rows,
        drives,
    };
    let is_whole = target.is_some() || args.format == Format::Json;
    let courses = is_whole.then(|| study.courses(&card.rows, &samples, &|| true)).transpose()?;
    let courses = card_courses::table(&courses.map(sampling::whole).unwrap_or_default());
    let texts = texts::of(args, &inputs, &card, &answers.steepest);
    let stops = stops::text(&inputs, &card, &texts, args.stops_slope_deg);
    let limits = match (&args.stops, &stops) {
        (Some(file), Some(stops)) => file::write_result(file, stops.as_bytes()),
        (Some(_), None) => Err(stops::missing(&card, args.stops_slope_deg)),
        (None, _) => Ok(()),
    };
    if let Some(target) = target {
        let uphill = args.uphill;
        let picture = Picture::of(&inputs.scenario.value.rover, uphill);
        let sheets = [
            layout::draw(&texts, &picture, &answers.rows),
            second::draw(&texts, &answers.rows, &courses),
        ];
        target.write(&answers, &courses, &sheets, stops)?;
    }
    match args.format {
        Format::Table => output::show(answers.table()),
        Format::Csv => output::print(&Rows::of_table(&answers.rows).to_csv()?),
        Format::Json => output::print_json(&answers.json(&courses)),
    }?;
    // A card without limits is one nevertheless.
    limits
}

/// A card with its pages, of the usual side, speed and rule.
pub(super) struct Pages {
    pub(super) card: Card,
    pub(super) sheets: [Sheet; 2],
}

impl Pages {
    /// * `samples`, `seed`: as the flags
    pub(super) fn of(scenario: LoadedScenario, samples: u32, seed: u64) -> Result<Self, Failure> {
        let args = CardArgs { samples, seed, ..CardArgs::usual() };
        let inputs = CardInputs::usual(&args, scenario)?;
        let samples = sampling::draw_if_uncertain(&inputs.scenario, args.samples, args.seed)?;
        let study = study(&args, &inputs);
        let card = compute(&study, &samples, &[])?;
        let pages = Self::drawn(&args, &inputs, (&study, &samples), card, &|| true)?;
        Ok(sampling::whole(pages))
    }

    /// The pages of a card that was computed; `None` if `go_on` was false before the end.
    fn drawn(
        args: &CardArgs,
        inputs: &CardInputs,
        (study, samples): (&SlopeStudy, &[Sample]),
        card: Card,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, Failure> {
        let Some(courses) = study.courses(&card.rows, samples, go_on)? else { return Ok(None) };
        let (rows, courses) = (shown(&card::table(&card), &[]), card_courses::table(&courses));
        let picture = Picture::of(&inputs.scenario.value.rover, args.uphill);
        let steepest = card::steepest(&card, &inputs.scenario, study, uphill(args));
        let texts = texts::of(args, inputs, &card, &steepest);
        let sheets = [layout::draw(&texts, &picture, &rows), second::draw(&texts, &rows, &courses)];
        Ok(Some(Self { card, sheets }))
    }
}

/// The card that the console saves: that of `grouser card` without other flags than those of its
/// scenario and rule.
pub(super) fn pdf(
    order: CardOrder,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<u8>>, String> {
    let draw = || {
        inputs::check_agreement(&order.scenario)?;
        let args = CardArgs::usual();
        let inputs = CardInputs::usual(&args, order.scenario)?;
        let inputs = CardInputs { rule: order.rule, ..inputs };
        let samples = sampling::draw_if_uncertain(&inputs.scenario, args.samples, args.seed)?;
        let study = study(&args, &inputs);
        let Some(card) = study.card(&samples, &slopes(&[]), go_on)? else { return Ok(None) };
        Pages::drawn(&args, &inputs, (&study, &samples), card, go_on)
    };
    let pages = draw().map_err(|failure: Failure| failure.to_string())?;
    Ok(pages.map(|pages| pdf_of(&pages.sheets)))
}

fn study(args: &CardArgs, inputs: &CardInputs) -> SlopeStudy {
    let (rim_speed, rule) = (inputs.rim_speed, inputs.rule);
    let study = SlopeStudy::of(&inputs.scenario).with_uphill(uphill(args));
    SlopeStudy { rim_speed, rule, holds_heading: args.holds_heading, ..study }
}

fn uphill(args: &CardArgs) -> Side {
    if args.uphill == SideChoice::Right { Side::Right } else { Side::Left }
}

fn compute(
    study: &SlopeStudy,
    samples: &[Sample],
    measured: &[MeasuredYaw],
) -> Result<Card, Failure> {
    let slopes = slopes(measured);
    if samples.len() > 2 * DRAFT && terminal::has_progress() {
        let drafted = sampling::whole(study.card(&samples[..DRAFT], &slopes, &|| true)?);
        output::message(&draft::line(&card::table(&drafted), DRAFT, samples.len()));
    }
    let card = sampling::with_bar(samples.len(), |go_on| study.card(samples, &slopes, go_on));
    Ok(sampling::whole(card?))
}

/// The slopes of a card [rad].
fn slopes(measured: &[MeasuredYaw]) -> Vec<f64> {
    let degrees = (0..=STEEPEST_DEG).map(f64::from);
    let asked = measured.iter().map(|point| point.slope);
    let mut slopes: Vec<f64> = degrees.chain(asked).map(|slope| SLOPE.unit.to_si(slope)).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.dedup();
    slopes
}

/// Ways between two corrections of those who drive by the card, over the card's [-].
const LATENESSES: [f64; 2] = [1.0, 2.0];

/// Drives on the page's slopes by other soils than the card's; nothing if none are asked for.
fn drives(
    args: &CardArgs,
    inputs: &CardInputs,
    study: &SlopeStudy,
    card: &Card,
) -> Result<Option<Table>, Failure> {
    let Some(count) = args.drives else { return Ok(None) };
    let seed = other_seed(args.seed);
    let others = sampling::draw(&BandInputs::of_scenario(&inputs.scenario), count, seed)?;
    let slopes = layout::slopes(&card::table(card));
    let is_shown = |slope: f64| slopes.iter().any(|it| SLOPE.unit.to_si(*it) == slope);
    let rows: Vec<_> = card.rows.iter().filter(|row| is_shown(row.advice.slope)).collect();
    let bar = output::progress_bar((LATENESSES.len() * rows.len() * others.len()) as u64);
    bar.set_message("drives");
    let mut all: Vec<RowDrives> = Vec::new();
    for lateness in LATENESSES {
        let drives = CardDrives { study, lateness, approach: Approach::QuasiSteady, seed };
        for row in &rows {
            all.extend(drives.on(row, &others, &|| bar.inc(1))?);
        }
    }
    bar.finish_and_clear();
    Ok(Some(card_drives::table(&all)))
}

/// The seed of the soils that are driven: the one after the card's.
fn other_seed(seed: u64) -> u64 {
    seed.wrapping_add(1)
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

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    steepest: Row<'a>,
    rows: WithObject<'a>,
    courses: &'a Table,
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<&'a Table>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drives: Option<&'a Table>,
}

/// From which slope on there is no go, and why, as a line; nothing where there is none.
fn no_go_line(card: &Card) -> String {
    let advice = card.rows.iter().map(|row| &row.advice);
    let first = advice.clone().find(|it| it.judgement.verdict == Verdict::NoGo);
    first.map_or_else(String::new, |it| {
        let slope = four_digits(SLOPE.unit.from_si(it.slope));
        format!("{slope}° and steeper: {}\n", it.judgement.of_several().sentence())
    })
}

/// The advice of each row.
fn advice(rows: &Table) -> Table {
    let names: Vec<String> = ADVICE.iter().flat_map(Column::names).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    rows.select(&names, &(0..rows.rows()).collect::<Vec<_>>())
}

/// The inputs of the card.
fn settings(args: &CardArgs, inputs: &CardInputs, card: &Card) -> Value {
    let document = &inputs.scenario.document;
    let mut settings = json!({
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "model": inputs.scenario.value.model.name(),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "uphill": if args.uphill == SideChoice::Left { "left" } else { "right" },
        "rim_speed_m_s": inputs.rim_speed,
        "holds_heading": args.holds_heading,
        "rule": inputs.rule,
    });
    if card.draws.is_some() {
        settings["samples"] = args.samples.into();
        settings["seed"] = args.seed.into();
    }
    let sampling = Sampling { count: args.samples, seed: args.seed };
    settings[sampling::BELIEF] = sampling.belief(&inputs.scenario);
    if args.drives.is_some() {
        settings["seed_of_drives"] = other_seed(args.seed).into();
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
    /// The files of the card, each with what its name has before the ending.
    fn files(self, sheets: &[Sheet; 2]) -> Vec<(&'static str, Vec<u8>)> {
        let each = |of: fn(&Sheet) -> Vec<u8>| {
            self.ends().iter().zip(sheets).map(|(end, sheet)| (*end, of(sheet))).collect()
        };
        match self {
            Self::Html => vec![("", html(sheets).into_bytes())],
            Self::Pdf => vec![("", pdf_of(sheets))],
            Self::Png => each(Sheet::to_png),
            Self::Svg => each(|sheet| sheet.to_svg().into_bytes()),
        }
    }

    /// What the names of its files have before the ending: a picture has one page.
    fn ends(self) -> &'static [&'static str] {
        match self {
            Self::Html | Self::Pdf => &[""],
            Self::Png | Self::Svg => &["", "-2"],
        }
    }
}

/// A page that prints on two sheets.
fn html(sheets: &[Sheet; 2]) -> String {
    let [first, second] = sheets;
    let title = markup(first.title());
    let svg = format!("{}{}", first.to_svg(), second.to_svg());
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <meta name=\"generator\" content=\"Grouser {}\">\n<title>{title}</title>\n<style>\n\
         @page {{ size: A4; margin: 0 }}\nbody {{ margin: 0 }}\n\
         svg {{ display: block; width: 100%; max-width: 210mm; height: auto; margin: 0 auto }}\n\
         @media print {{ svg {{ width: 210mm; height: 296.9mm; break-after: page }} \
         svg:last-child {{ break-after: auto }} }}\n\
         </style>\n</head>\n<body>\n{svg}</body>\n</html>\n",
        env!("CARGO_PKG_VERSION")
    )
}

/// The card's numbers.
struct Answers<'a> {
    args: &'a CardArgs,
    inputs: &'a CardInputs,
    card: &'a Card,
    /// The steepest slope, and what numbers are worth there: one row.
    steepest: Table,
    rows: Table,
    /// The advice of each row.
    advice: Table,
    beside: Table,
    drives: Option<Table>,
}

impl Answers<'_> {
    /// The card's rows, or the comparison or the drives where one of them is asked for.
    fn table(&self) -> Text {
        let Self { inputs, card, rows, beside, drives, .. } = self;
        if let Some(drives) = drives {
            return Rows::of_table(drives).to_table(&card_drives::brief());
        }
        if beside.rows() > 0 {
            return Rows::of_table(beside).to_table(&card::beside_brief());
        }
        let brief = if card.draws.is_some() { card::bands_brief() } else { card::brief() };
        let driven = CardRow::all(rows).position(CardRow::is_no_go).unwrap_or(rows.rows());
        let table = rows.rows_at(&(0..driven).collect::<Vec<_>>());
        let text = Rows::of_table(&table).to_table(&brief) + no_go_line(card);
        let hints = remedy::of_reasons(card.rows.iter().map(|row| row.advice.judgement.reason));
        let hints: String = hints.into_iter().map(|hint| hint + "\n").collect();
        let scenario = &inputs.scenario;
        if scenario.stated_uncertainty().is_some() {
            return text + hints;
        }
        let bands = match (card.draws, &scenario.uncertain) {
            (Some(_), Some(_)) => "bands are of priors and of the models",
            (Some(_), None) => "bands are of the models alone",
            (None, _) => "no bands",
        };
        text + format!(
            "no uncertainty of this soil is stated: {bands}; nobody can tell a go\n{hints}"
        )
    }

    fn json<'a>(&'a self, courses: &'a Table) -> Answer<Results<'a>> {
        let Self { args, inputs, card, steepest, rows, advice, beside, drives } = self;
        let rows = WithObject { rows, name: ADVICE_OBJECT, of: advice };
        let measured = (beside.rows() > 0).then_some(beside);
        let drives = drives.as_ref();
        let results = Results { steepest: steepest.row(0), rows, courses, measured, drives };
        Answer::new("card", settings(args, inputs, card), results)
    }
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
        for end in form.ends() {
            file::check_new(&with_end(out, end), force)?;
        }
        Ok(Self::File(out, *form))
    }

    fn write(
        self,
        answers: &Answers<'_>,
        courses: &Table,
        sheets: &[Sheet; 2],
        stops: Option<String>,
    ) -> Result<(), Failure> {
        let mut folder = match self {
            Self::File(out, form) => {
                let files = form.files(sheets);
                return files
                    .iter()
                    .try_for_each(|(end, bytes)| file::write_result(&with_end(out, end), bytes));
            }
            Self::Folder(folder) => folder,
        };
        for (ending, form) in FORMS {
            for (end, bytes) in form.files(sheets) {
                folder.add(format!("card{end}.{ending}"), bytes);
            }
        }
        folder.add(REPORT, report(answers, courses, sheets, stops.is_some()));
        folder.add("card.json", answers.json(courses).to_text());
        folder.add("card.csv", Rows::of_table(&answers.rows).to_csv()?);
        folder.add("courses.csv", Rows::of_table(courses).to_csv()?);
        if let Some(stops) = stops {
            folder.add("stops.toml", stops);
        }
        folder.add_document("scenario.toml", &answers.inputs.scenario);
        folder.finish()
    }
}

/// The page: both sides of the card, and the numbers behind them.
fn report(answers: &Answers<'_>, courses: &Table, sheets: &[Sheet; 2], has_stops: bool) -> String {
    let mut page = Page::new("The operator's card");
    for sheet in sheets {
        page.drawing(&sheet.to_svg(), sheet.title());
    }
    let brief = if answers.card.draws.is_some() { card::bands_brief() } else { card::brief() };
    page.heading("Every slope");
    page.rows("The rows of the card", &answers.rows, &brief);
    let names: Vec<&String> = courses.columns.iter().map(|(name, _)| name).collect();
    page.rows("Other courses", courses, &names);
    page.flags(Some(answers.card.rows.iter().flat_map(|row| &row.findings)));
    let scenario = &answers.inputs.scenario;
    page.heading("Assumptions in force");
    page.list(&scenario.assumptions);
    let stops = if has_stops { " --stop-from stops.toml" } else { "" };
    let next = [
        format!("grouser mission MISSION.toml{stops} --out DRIVE"),
        "grouser map DEM scenario.toml --course-deg best --out MAP".to_owned(),
    ];
    add_next(&mut page, &next);
    page.document("scenario.toml", &scenario.to_toml());
    page.to_html()
}

/// A file's name with something before its ending: `card-2.svg`.
fn with_end(out: &Path, end: &str) -> PathBuf {
    if end.is_empty() {
        return out.to_owned();
    }
    let part = |of: Option<&std::ffi::OsStr>| of.unwrap_or_default().to_os_string();
    let mut name = part(out.file_stem());
    name.push(end);
    name.push(".");
    name.push(part(out.extension()));
    out.with_file_name(name)
}
