//! The card's limits as the table `[stop]` of a mission.

use std::fmt::Write as _;

use grouser::document::columns::SLOPE;
use grouser::document::limited_quantity;
use grouser::document::reading::four_digits;
use grouser::mission::Stop;
use grouser::studies::card::Card;
use grouser::studies::verdict::{Judgement, Verdict};

use super::texts::Texts;
use crate::failure::Failure;
use crate::inputs::CardInputs;
use crate::output::remedy;

/// The file: a table that `mission --stop-from` reads, and that can be copied into a mission.
///
/// * `slope_deg`: of the mission [°], if it is on one
pub(super) fn text(
    inputs: &CardInputs,
    card: &Card,
    texts: &Texts,
    slope_deg: Option<f64>,
) -> Option<String> {
    let found = card.stops(&inputs.rule, slope_deg.and_then(|it| SLOPE.in_si(&[it]).pop()))?;
    let shown = |slope: f64| four_digits(SLOPE.unit.as_given(slope));
    let [first, last] = [found.slopes.first()?, found.slopes.last()?].map(|it| shown(it.0));
    let mut text = format!(
        "# Limits at which to turn back, by the operator's card: {title}.\n\
         # grouser mission MISSION.toml --stop-from THIS-FILE reads them; the table may stand in a \
         mission, too.\n\
         # They are for slopes that are a go or a caution on the card, {first} to {last}°, and a \
         leg may have limits\n# of its own.\n#\n\
         # slip_ratio: {which} of the card's limits on these slopes:\n",
        which = slope_deg.map_or_else(
            || "the lowest".to_owned(),
            |it| format!("for a mission on {}° that", four_digits(it)),
        ),
        title = texts.title.replace(char::is_control, " "),
    );
    for (slope, limit) in &found.slopes {
        let _ = writeln!(text, "#     {}° {}", shown(*slope), downwards(*limit));
    }
    if slope_deg.is_none() {
        text += "# On a steep slope a rover passes the lowest as a rule: card --stops-slope-deg has \
                 that of one\n# slope.\n";
    }
    text += "# drift_m_per_m: the card's limit of a go; for legs along the contour. A leg that leads \
             downhill\n# has drift_m_per_m = 1.0 among its own limits.\n\
             # roll_deg, pitch_deg: the steepest of these slopes.\n[stop]\n";
    found.stops.iter().for_each(|stop| text += &line(stop));
    Some(text)
}

/// A limit as a line of TOML.
fn line(stop: &Stop) -> String {
    let quantity = limited_quantity(stop.limited);
    let above = downwards(quantity.unit.as_given(stop.above));
    if !stop.limited.is_of_a_way() {
        return format!("{} = {above}\n", quantity.name);
    }
    format!("{} = {{ above = {above}, over_m = {} }}\n", quantity.name, stop.over)
}

/// A limit with four decimals at most, rounded down: what is rounded up is beyond it.
fn downwards(limit: f64) -> f64 {
    // What is below a step by rounding alone stays on it.
    (limit * 1e4 + 1e-6).floor() / 1e4
}

/// A card from which there are no limits, and why.
pub(super) fn missing(card: &Card, slope_deg: Option<f64>) -> Failure {
    let judgements = card.rows.iter().map(|row| row.advice.judgement);
    let doubt = judgements.clone().find(|it| it.verdict == Verdict::CannotTell);
    let why =
        doubt.or_else(|| judgements.clone().next()).map_or_else(String::new, Judgement::meaning);
    if let (Some(slope), None) = (slope_deg.map(four_digits), doubt) {
        return Failure::Run(format!(
            "--stops-slope-deg {slope}: this card has no go or caution on a slope as steep"
        ));
    }
    let hints = remedy::of_reasons(doubt.map(|it| it.reason).into_iter());
    let hint: String = hints.into_iter().map(|hint| format!("\n{hint}")).collect();
    Failure::Run(format!(
        "--stops: no slope of this card is a go or a caution, so that it has no limits to turn \
         back at: {why}{hint}"
    ))
}
