//! How probably a drive is completed, and how it ends otherwise.

use super::super::limited_quantity;
use super::super::reading::{capitalised, four_digits};
use super::{Column, PROBABILITY_COMPLETED, text, whole};
use crate::studies::completion::Completion;

/// What a drive risks.
pub const RISK: [Column<Completion>; 6] = [
    PROBABILITY_COMPLETED
        .probability("Share of the samples that complete all legs", |it| Some(it.completed)),
    text("commonest_end", "The commonest end of the others, by its name", |it| {
        it.commonest.as_ref().map(|end| end.outcome.to_owned())
    }),
    text("commonest_end_limit", "The number at whose limit they stop, if they do", |it| {
        Some(limited_quantity(it.commonest.as_ref()?.limit?).name.to_owned())
    }),
    whole("commonest_end_leg", "The leg in which they end so, from 1", |it| {
        it.commonest.as_ref().map(|end| end.leg)
    }),
    whole("commonest_end_draws", "How many samples end so", |it| {
        it.commonest.as_ref().map(|end| end.count)
    }),
    whole("draws_not_computed", "Samples that cannot be computed, and count as nothing", |it| {
        Some(it.not_computed)
    }),
];

/// How probable it is that a drive is completed, and how it ends otherwise, as a sentence.
///
/// * `place`: where on its leg the commonest end is; empty if that is not known
#[must_use]
pub fn in_words(risk: &Completion, place: &str) -> String {
    let percent = |share: f64| format!("{} %", four_digits((1000.0 * share).round() / 10.0));
    let completed = risk.completed;
    let (low, high) = completed.interval();
    let end = risk.commonest.as_ref().map_or_else(String::new, |end| {
        format!(
            "; it ends most often in leg {}{place}: {}{}, in {} of {}",
            end.leg,
            end.outcome.replace(['-', '_'], " "),
            end.limit.map_or_else(String::new, |it| {
                format!(" at the limit of {}", limited_quantity(it).name)
            }),
            end.count,
            completed.trials
        )
    });
    let lost = match risk.not_computed {
        0 => String::new(),
        some => format!("; {some} more could not be computed"),
    };
    capitalised(&format!(
        "completed on {} of {} samples of soil and model (95 %: {} to {}){end}{lost}.",
        percent(completed.estimate()),
        completed.trials,
        percent(low),
        percent(high)
    ))
}
