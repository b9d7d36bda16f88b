//! The page of a forecast: the answer, the budget, what would shrink it, and every choice.

use grouser::document::columns::forecast::{
    self as columns, FACTOR, INTERACTIONS, SHARED_SHARE, VARIANCE_SHARE,
};
use grouser::document::columns::{SLIP_RATIO, SLOPE};
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::studies::forecast::{Factor, FactorKind, Forecast, REMEDY_OF_INTERACTIONS};

use super::figures::Figure;
use super::tables::Tables;
use crate::inputs::ForecastInputs;
use crate::output::rows::Rows;
use crate::report::page::Page;

pub(super) fn html(
    inputs: &ForecastInputs,
    forecast: &Forecast,
    tables: &Tables,
    (figures, notes): (&[Figure], &[String]),
) -> String {
    let mut page = Page::new("Forecast under another gravity");
    page.answer(&answer(tables));
    page.list(what_was_computed(inputs, forecast));
    page.list(notes);
    page.heading("Forecast");
    page.paragraph(
        "Each number has a band over all cases: the 2.5 %, 50 % and 97.5 % quantiles. A case in which no heading holds \
         the contour is not left out: it slips by 1, sinks to its axles, and needs more yaw, power and work than any \
         number, so that an end of these bands may be missing.",
    );
    add(&mut page, "On each slope", &tables.rows, &columns::brief());
    page.paragraph(tables.limit_line().trim_end());
    page.heading("Error budget");
    page.paragraph(
        "The variance of the slip ratio, of the drift and of the steepest slope, in parts. variance_share: what a \
         factor has alone; by so much the variance shrinks, on average over its levels, if the factor becomes known. \
         total_share: the same with its interactions; so much would be left if all others were known. Parts and \
         interactions add up to the whole. shared_share: with an equal share of each of its \
         interactions; these add up to the whole by themselves. standard_deviation: the square root of the part, in the unit of the \
         quantity. A part that comes of n samples is itself known to about a share of √(2/(n − 1)) only.",
    );
    let mut figures = figures.iter();
    for figure in figures.by_ref().take(3) {
        page.drawing(&figure.svg, figure.caption);
    }
    add(&mut page, "Parts, largest first", &tables.budget, &columns::budget_brief());
    page.heading("What would shrink it");
    page.list(remedies(forecast));
    page.heading("What each choice would mean");
    add(&mut page, "Means of the cases of each choice", &tables.choices, &columns::choices_brief());
    if tables.tests.rows() > 0 {
        page.heading("What tests would show");
        page.paragraph(
            "The same rover on the soil, and under the gravity, that was measured: as heavy as it is (equal-mass), and \
             lightened until it weighs there what it weighs at the site (equal-weight). By granular scaling the first \
             is the forecast. The second is a test of another machine: compare its slip with the forecast's before \
             trusting one.",
        );
        let names: Vec<&String> = tables.tests.columns.iter().map(|(name, _)| name).collect();
        add(&mut page, "Tests where the soil was measured", &tables.tests, &names);
    }
    page.heading("Figures");
    for figure in figures {
        page.drawing(&figure.svg, figure.caption);
    }
    page.flags(forecast.slopes.iter().flat_map(|slope| &slope.findings));
    page.heading("Assumptions in force");
    let grounds = inputs.grounds.iter().flat_map(|ground| &ground.assumptions);
    page.list(inputs.scenario.assumptions.iter().chain(grounds));
    page.to_html()
}

fn add(page: &mut Page, caption: &str, table: &Table, names: &[impl AsRef<str>]) {
    let header: Vec<String> = names.iter().map(|name| name.as_ref().to_owned()).collect();
    page.grid(caption, &header, &Rows::of_table(table).cells(names));
}

/// The slip where it is least known, and the factor that has most of that, in two sentences.
fn answer(tables: &Tables) -> String {
    let Some(slope) = tables.widest_slip() else { return "No slope was asked for.".into() };
    let slip = tables.budget_of(&[SLIP_RATIO.name]);
    let (factors, shares) = (slip.texts(FACTOR), slip.numbers(VARIANCE_SHARE.name));
    let slopes = tables.rows.numbers(SLOPE.name);
    let place = slopes.iter().position(|it| *it == Some(slope)).unwrap_or_default();
    let [low, median, high] =
        SLIP_RATIO.quantiles().map(|name| short(tables.rows.numbers(&name)[place]));
    let shared = slip.numbers(SHARED_SHARE.name);
    let here = (0..slip.rows()).filter(|row| slip.numbers(SLOPE.name)[*row] == Some(slope));
    let parts = here.filter_map(|row| Some((row, shared[row]?)));
    let largest = parts.max_by(|one, other| one.1.total_cmp(&other.1));
    let due = largest.map_or(String::new(), |(row, share)| {
        let factor = factors[row].as_deref().unwrap_or_default();
        let [alone, all] = [shares[row].unwrap_or_default(), share].map(|share| 100.0 * share);
        format!(
            " Of its variance {factor} has most: {alone:.0} % alone, {all:.0} % with its share of interactions."
        )
    });
    format!(
        "The slip is least known on {}°: {low} to {high} (95 % of the cases), median {median}.{due}",
        four_digits(slope)
    )
}

fn short(number: Option<f64>) -> String {
    number.map_or("–".into(), four_digits)
}

fn what_was_computed(inputs: &ForecastInputs, forecast: &Forecast) -> Vec<String> {
    let document = &inputs.scenario.document;
    let name = |key: &str| {
        let name = document.get(key).and_then(|part| part.get("name"));
        name.and_then(|name| name.as_str()).unwrap_or_default().to_owned()
    };
    let mut lines = vec![format!("rover: {}", name("rover")), format!("soil: {}", name("soil"))];
    lines.extend(forecast.factors.iter().map(levels));
    lines.push(format!(
        "{} cases: every level of each with every level of the others",
        forecast.cases
    ));
    lines
}

/// The levels of a factor, in a line.
fn levels(factor: &Factor) -> String {
    let name = factor.kind.name();
    if !factor.is_named() {
        return match factor.levels.len() {
            1 => format!("{name}: nothing is uncertain"),
            count => format!("{name}: {count} samples"),
        };
    }
    let is_even = factor.levels.iter().all(|level| level.count == 1);
    let of_level = |level| {
        let share = 100.0 * factor.share(level);
        if is_even { level.name.clone() } else { format!("{} ({share:.0} %)", level.name) }
    };
    let levels: Vec<String> = factor.levels.iter().map(of_level).collect();
    format!("{name}: {}", levels.join(", "))
}

fn remedies(forecast: &Forecast) -> Vec<String> {
    let open = forecast.factors.iter().filter(|factor| factor.levels.len() > 1);
    let of_factors = open.map(|factor| line(factor.kind));
    of_factors.chain([format!("{INTERACTIONS}: {REMEDY_OF_INTERACTIONS}")]).collect()
}

fn line(kind: FactorKind) -> String {
    format!("{}: {}", kind.name(), kind.remedy())
}
