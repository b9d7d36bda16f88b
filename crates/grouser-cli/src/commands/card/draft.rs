//! What somebody who waits for a card reads first.

use grouser::document::columns::{SLOPE, YAW};
use grouser::document::reading::four_digits;
use grouser::studies::card::{Card, CardRow};

/// Slopes of which the heading is said [°].
const READ_DEG: [f64; 3] = [5.0, 10.0, 15.0];

/// The verdicts and a few headings of a card of few samples, in a line.
///
/// * `samples`: of the card to come
pub(super) fn line(card: &Card, samples: usize) -> String {
    let slope = |row: &CardRow| SLOPE.unit.from_si(row.advice.slope);
    let runs = card.rows.chunk_by(|one, next| verdict(one) == verdict(next));
    let verdicts = runs.filter_map(|run| {
        Some(format!("{} from {}°", verdict(run.first()?), four_digits(slope(run.first()?))))
    });
    let verdicts: Vec<String> = verdicts.collect();
    let read = card.rows.iter().filter(|row| READ_DEG.contains(&slope(row)));
    let headings = read.filter_map(|row| {
        let yaw = YAW.unit.from_si(row.advice.driven.as_ref()?.yaw);
        Some(format!("{yaw:.1}° on {}°", four_digits(slope(row))))
    });
    let headings: Vec<String> = headings.collect();
    let headings = match &headings[..] {
        [] => String::new(),
        all => format!("; heading {}", all.join(", ")),
    };
    let drawn = card.draws.unwrap_or_default();
    format!("draft of {drawn} samples, {samples} come: {}{headings}", verdicts.join(", "))
}

fn verdict(row: &CardRow) -> String {
    row.advice.judgement.verdict.name().replace('_', " ")
}
