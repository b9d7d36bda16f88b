//! The page of a forecast: the answer, the budget, what would shrink it, and every choice.

use super::super::Answer;
use super::tables::Tables;
use super::{ForecastQuestion, figures};
use crate::document::columns::forecast::{
    self as columns, FACTOR, INTERACTIONS, SHARED_SHARE, VARIANCE_SHARE,
};
use crate::document::columns::{SLIP_RATIO, SLOPE};
use crate::document::reading::four_digits;
use crate::studies::forecast::{Factor, FactorKind, Forecast, REMEDY_OF_INTERACTIONS};

impl ForecastQuestion<'_> {
    /// The page, but for what all pages end with.
    pub(super) fn page(
        &self,
        answer: &mut Answer,
        forecast: &Forecast,
        (tables, notes): (&Tables, &[String]),
    ) {
        answer.verdict(verdict(tables));
        answer.list(self.what_was_computed(forecast));
        answer.list(notes.to_vec());
        answer.heading("Forecast");
        answer.words(
            "Each number has a band over all cases: the 2.5 %, 50 % and 97.5 % quantiles. A case \
             in which no heading holds the contour is not left out: it slips by 1, sinks to its \
             axles, and needs more yaw, power and work than any number, so that an end of these \
             bands may be missing.",
        );
        answer.rows("On each slope", &tables.rows, columns::brief());
        answer.words(tables.limit_line().trim_end());
        answer.heading("Error budget");
        answer.words(
            "The variance of the slip ratio, of the drift and of the steepest slope, in parts. \
             variance_share: what a factor has alone; by so much the variance shrinks, on average \
             over its levels, if the factor becomes known. total_share: the same with its \
             interactions; so much would be left if all others were known. Parts and interactions \
             add up to the whole. shared_share: with an equal share of each of its interactions; \
             these add up to the whole by themselves. standard_deviation: the square root of the \
             part, in the unit of the quantity. A part that comes of n samples is itself known to \
             about a share of √(2/(n − 1)) only.",
        );
        figures::budget_to(answer, tables);
        answer.rows("Parts, largest first", &tables.budget, columns::budget_brief());
        answer.heading("What would shrink it");
        answer.list(remedies(forecast));
        answer.heading("What each choice would mean");
        let caption = "Means of the cases of each choice";
        answer.rows(caption, &tables.choices, columns::choices_brief());
        if tables.tests.rows() > 0 {
            answer.heading("What tests would show");
            answer.words(
                "The same rover on the soil, and under the gravity, that was measured: as heavy as \
                 it is (equal-mass), and lightened until it weighs there what it weighs at the \
                 site (equal-weight). By granular scaling the first is the forecast. The second is \
                 a test of another machine: compare its slip with the forecast's before trusting \
                 one.",
            );
            let names = tables.tests.names();
            answer.rows("Tests where the soil was measured", &tables.tests, names);
        }
        answer.heading("Figures");
        figures::bands_to(answer, forecast, tables);
        let slopes = forecast.slopes.iter();
        let findings = slopes.flat_map(|slope| slope.findings.iter().copied());
        answer.findings = Some(findings.collect());
        answer.columns = columns::all_meanings();
    }

    fn what_was_computed(&self, forecast: &Forecast) -> Vec<String> {
        let name = |key: &str| self.scenario.document.text(key).unwrap_or_default().to_owned();
        let rover = format!("rover: {}", name("rover.name"));
        let mut lines = vec![rover, format!("soil: {}", name("soil.name"))];
        lines.extend(forecast.factors.iter().map(levels));
        let cases = forecast.cases;
        lines.push(format!("{cases} cases: every level of each with every level of the others"));
        lines
    }
}

/// The slip where it is least known, and the factor that has most of that, in two sentences.
fn verdict(tables: &Tables) -> String {
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
            " Of its variance {factor} has most: {alone:.0} % alone, {all:.0} % with its share of \
             interactions."
        )
    });
    format!(
        "The slip is least known on {}°: {low} to {high} (95 % of the cases), median \
         {median}.{due}",
        four_digits(slope)
    )
}

fn short(number: Option<f64>) -> String {
    number.map_or("–".into(), four_digits)
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
