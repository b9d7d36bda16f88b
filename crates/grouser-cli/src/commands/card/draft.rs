//! What somebody who waits for a card reads first.

use grouser::document::table::Table;

use super::row::CardRow;

/// Slopes of which the heading is said [°].
const READ_DEG: [f64; 3] = [5.0, 10.0, 15.0];

/// The verdicts and a few headings of a card of few samples, in a line.
///
/// * `drawn`: its samples
/// * `samples`: of the card to come
pub(super) fn line(card: &Table, drawn: usize, samples: usize) -> String {
    let rows: Vec<CardRow<'_>> = CardRow::all(card).collect();
    let runs = rows.chunk_by(|one, next| one.verdict() == next.verdict());
    let verdicts: Vec<String> = runs
        .filter_map(|run| run.first())
        .map(|row| format!("{} from {}°", row.verdict().replace('_', " "), row.slope()))
        .collect();
    let read = rows.iter().filter(|row| READ_DEG.contains(&row.slope()));
    let headings: Vec<String> = read
        .filter_map(|row| Some(format!("{:.1}° on {}°", row.heading()?, row.slope())))
        .collect();
    let headings = match &headings[..] {
        [] => String::new(),
        all => format!("; heading {}", all.join(", ")),
    };
    format!("draft of {drawn} samples, {samples} come: {}{headings}", verdicts.join(", "))
}
