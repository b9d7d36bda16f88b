//! What is said of a way first: how probably it is completed, and the worst verdict of its legs.

use super::super::columns::completion::in_words;
use super::super::columns::verdict::subject;
use super::super::reading::capitalised;
use crate::studies::route::{JudgedLeg, Route};
use crate::studies::verdict::Verdict;

/// The leg that has the worst verdict, by its number from 1; of several the one that is most often a
/// no-go, and of those the first.
pub(super) fn worst_of(legs: &[Option<JudgedLeg>]) -> Option<(usize, &JudgedLeg)> {
    let known = legs.iter().enumerate().filter_map(|(place, leg)| Some((place + 1, leg.as_ref()?)));
    let rank = |leg: &JudgedLeg| (leg.verdict(), leg.place.probability_no_go);
    known.reduce(|worst, it| if rank(it.1) > rank(worst.1) { it } else { worst })
}

/// The first sentences of a way.
pub(super) fn opening(route: &Route, legs: &[Option<JudgedLeg>]) -> String {
    let completed = route.risk.as_ref().map_or_else(
        || {
            "How probably it is completed is not known: some of its ground is not, or the rover \
             cannot turn on the spot."
                .to_owned()
        },
        |risk| {
            let place = risk.end.map(|end| from_the_start(end.along));
            in_words(&risk.completion, &place.unwrap_or_default())
        },
    );
    completed + &worst_of(legs).map_or_else(String::new, |worst| verdict(worst, legs.len()))
}

/// The worst verdict of some legs as a sentence, behind another one.
fn verdict((number, leg): (usize, &JudgedLeg), count: usize) -> String {
    let advice = &leg.advice;
    let verdict = capitalised(leg.verdict().in_words());
    let of_legs = match (count, leg.verdict()) {
        (1, _) => String::new(),
        (_, Verdict::Go) => " on all legs, at the worst place".to_owned(),
        (count, _) => format!(" on leg {number} of {count}, no other is worse"),
    };
    format!(
        " {verdict}{of_legs}{} ({}): {}.",
        from_the_start(leg.place.along[0]),
        subject(advice),
        advice.judgement.meaning()
    )
}

fn from_the_start(along: f64) -> String {
    format!(", {along:.1} m from the start")
}
