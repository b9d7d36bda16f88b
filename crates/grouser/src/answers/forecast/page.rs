//! The page of a forecast: each ground's answer, its budget, what would shrink it, every choice.

use super::super::Answer;
use super::tables::Tables;
use super::{ForecastQuestion, figures};
use crate::document::columns::SLOPE;
use crate::document::columns::forecast as columns;
use crate::document::reading::four_digits;
use crate::studies::ensemble::Band;
use crate::studies::forecast::{
    Factor, FactorKind, Forecast, GroundForecast, REMEDY_OF_INTERACTIONS, SlopeForecast,
};

impl ForecastQuestion<'_> {
    /// The page, but for what all pages end with.
    pub(super) fn page(
        &self,
        answer: &mut Answer,
        forecast: &Forecast,
        (tables, notes): (&Tables, &[String]),
    ) {
        answer.verdict(verdict(forecast));
        answer.list(self.what_was_computed(forecast));
        answer.list(notes.to_vec());
        answer.heading("Forecast on each ground");
        answer.words(
            "Each number has a band over all cases of its ground: the 2.5 %, 50 % and 97.5 % \
             quantiles. Nothing is averaged over grounds. A case in which no heading holds the \
             contour is not left out: it slips by 1, sinks to its axles, and needs more yaw, power \
             and work than any number, so that an end of these bands may be missing. support: what \
             a row rests on; none, where no measurement supports how moduli scale.",
        );
        figures::bands_to(answer, forecast, tables);
        answer.rows("On each ground and slope", &tables.rows, columns::brief());
        let caption =
            "Steepest slope on which a heading holds the contour, and shares of its variance";
        answer.rows(caption, &tables.steepest, tables.steepest_brief.clone());
        answer.heading("Error budget");
        answer.words(
            "Shares of the variance of the slip ratio and of the steepest slope within one ground, \
             each with an equal share of its interactions: the shares of a row add up to 1. \
             budget.csv has the same in more detail, and of the drift. A share that comes of n \
             samples is itself known to about a share of √(2/(n − 1)) only.",
        );
        figures::budget_to(answer, forecast, tables);
        let caption = "Shares of the variance of the slip ratio";
        answer.rows(caption, &tables.rows, tables.shares_brief.clone());
        answer.heading("What would shrink it");
        answer.list(remedies(forecast));
        answer.folded("What each choice would mean", |answer| {
            let caption = "Means of the cases of each choice";
            answer.rows(caption, &tables.choices, columns::choices_brief());
        });
        if tables.tests.rows() > 0 {
            answer.folded("What tests would show", |answer| {
                answer.words(
                    "The same rover on the soil, and under the gravity, that was measured: as \
                     heavy as it is (equal-mass), and lightened until it weighs there what it \
                     weighs at the site (equal-weight). By granular scaling the first is the \
                     forecast. The second is a test of another machine: compare its slip with the \
                     forecast's before trusting one.",
                );
                let names = tables.tests.names();
                answer.rows("Tests where the soil was measured", &tables.tests, names);
            });
        }
        let slopes = forecast.grounds.iter().flat_map(|ground| &ground.slopes);
        let findings = slopes.flat_map(|slope| slope.findings.iter().copied());
        answer.findings = Some(findings.collect());
        answer.columns = columns::all_meanings();
    }

    fn what_was_computed(&self, forecast: &Forecast) -> Vec<String> {
        let name = |key: &str| self.scenario.document.text(key).unwrap_or_default().to_owned();
        let rover = format!("rover: {}", name("rover.name"));
        let mut lines = vec![rover, format!("soil: {}", name("soil.name"))];
        let first = forecast.grounds.first().into_iter().flat_map(|it| &it.factors);
        lines.extend(first.map(levels));
        lines.extend(forecast.grounds.iter().map(|it| {
            format!("on {}: {} cases, support {}", columns::name(it), it.cases, it.support.name())
        }));
        lines
    }
}

/// The slip of each ground on the slope where it is least known on one of them, and the factor that
/// has most of that, in two sentences.
fn verdict(forecast: &Forecast) -> String {
    let first: Vec<&GroundForecast> =
        forecast.grounds.iter().filter(|it| forecast.is_first(it)).collect();
    let places = first.iter().flat_map(|it| it.slopes.iter().enumerate().map(move |at| (*it, at)));
    let variance = |slope: &SlopeForecast| slope.slip_budget.variance;
    let widest =
        places.max_by(|(_, one), (_, other)| variance(one.1).total_cmp(&variance(other.1)));
    let Some((ground, (place, slope))) = widest else { return "No slope was asked for.".into() };
    let of_ground = |it: &&GroundForecast| {
        let [low, median, high] = it.slopes[place].slip_ratio.map_or([None; 3], ends).map(short);
        format!("{median} ({low} to {high}) on {}", it.ground)
    };
    let on_all: Vec<String> = first.iter().map(of_ground).collect();
    let slips = on_all.join(", ");
    let parts = ground.factors.iter().zip(&slope.slip_budget.parts);
    let largest = parts.max_by(|(_, one), (_, other)| one.shared.total_cmp(&other.shared));
    let due = largest.filter(|_| variance(slope) > 0.0).map_or(String::new(), |(factor, part)| {
        let [alone, all] = [part.first, part.shared].map(|it| 100.0 * it / variance(slope));
        format!(
            " It is least known on {}, where {} has most of its variance: {alone:.0} % alone, \
             {all:.0} % with its share of interactions.",
            ground.ground,
            factor.kind.name()
        )
    });
    let degrees = four_digits(SLOPE.unit.as_given(slope.slope));
    format!("On {degrees}° the slip ratio is {slips}: median, and 95 % of the ground's cases.{due}")
}

fn ends(band: Band) -> [Option<f64>; 3] {
    [band.low, band.median, band.high].map(Some)
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
    let line = |kind: FactorKind| format!("{}: {}", kind.name(), kind.remedy());
    let of_factors = columns::open_shares(forecast).into_iter().map(|(kind, _)| line(kind));
    let rest = format!("interactions: {REMEDY_OF_INTERACTIONS}");
    of_factors.chain([format!("which ground it is: {REMEDY_OF_GROUND}"), rest]).collect()
}

/// What would tell grounds apart.
const REMEDY_OF_GROUND: &str = "cohesion, friction angle and density measured at the site: a cone \
                                penetrometer, a trench, the tracks of a rover that was there";
