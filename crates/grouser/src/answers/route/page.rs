//! The page of ways.

use std::sync::Arc;

use super::super::{Answer, PageBlock, meanings, setting};
use super::columns::{WAY, brief};
use super::profile::charts;
use super::question::RouteQuestion;
use super::way::Way;
use crate::document::columns::completion::RISK;
use crate::document::columns::route::PROFILE;
use crate::document::columns::verdict::ADVICE;
use crate::document::reading::four_digits;
use crate::document::route::{AdvisedLegs, RouteRecord};
use crate::document::table::Table;

/// How the numbers of ways that were sought come about.
const OF_THE_LATTICE: &str = "Predicted by tables of the steady motion on each slope and course, \
                              with turns on the spot as on level ground. The lattice's sixteen \
                              directions make a way up to 2.8 % longer than it need be.";

/// How the numbers of a given line come about.
const OF_A_LINE: &str = "Predicted by tables of the steady motion on each slope and course, piece \
                         by piece as long as the map's points are apart, with turns on the spot as \
                         on level ground.";

impl RouteQuestion<'_> {
    /// The page, but for what all pages end with.
    ///
    /// * `rows`: of the ways
    pub(super) fn page(&self, answer: &mut Answer, ways: &[Way], rows: &Arc<Table>) {
        answer.verdict(&*ways[0].record.sentence);
        answer.verdict(verdict(&ways[0].record));
        answer.list(setting(&self.scenario.document));
        let caption = "The ground as a Sun in the north-west lights it, 30° above the horizon. \
                       Rings: where the way turns.";
        let picture = format!("{}.svg", answer.name);
        answer.page.push(PageBlock::Picture { file: picture, caption: caption.to_owned() });
        answer.heading("What each way takes");
        answer.rows("Ways", rows, brief(ways));
        for way in ways {
            way.lines().lines().for_each(|line| answer.words(line));
        }
        for way in ways.iter().filter(|way| way.record.legs.rows.rows() > 0) {
            let AdvisedLegs { rows, advice } = &way.record.legs;
            let mut legs = rows.clone();
            legs.columns.extend(advice.columns.clone());
            let names = legs.names();
            answer.words(format!("What to do on each leg of {}, at its worst place:", way.name()));
            answer.rows("Advice for each leg", &Arc::new(legs), names);
        }
        for way in ways.iter().filter(|way| way.record.profile.rows() > 0) {
            answer.heading(format!("Along {}", way.called()));
            answer.charts(charts(&way.record.profile));
        }
        answer.words(if self.has_line() { OF_A_LINE } else { OF_THE_LATTICE });
        answer.words(
            "What the way cannot know: steps and stones between the points of the map, and soil \
             that differs from place to place. Flags of validity are of driving along the contour, \
             straight up and straight down, up to the steepest slope of the ways.",
        );
        answer.columns = meanings(&WAY);
        answer.columns.extend(meanings(&RISK));
        answer.columns.extend(meanings(&ADVICE));
        answer.columns.extend(meanings(&PROFILE));
    }
}

/// What the way that is asked for takes, or why there is none, in a sentence.
fn verdict(record: &RouteRecord) -> String {
    let drawn = record.battery_energy_j.map_or_else(String::new, |drawn| {
        format!(" of work, for which {} J are drawn", four_digits(drawn))
    });
    let taken = match (record.length_m, record.time_s, record.energy_j) {
        (Some(length), Some(time), Some(energy)) => Some(format!(
            "{} m in {} s with {} J{drawn}",
            four_digits(length),
            four_digits(time),
            four_digits(energy)
        )),
        _ => None,
    };
    let least = record.minimise.map(|least| match (least, record.battery_energy_j) {
        ("energy", Some(_)) => "energy drawn".to_owned(),
        ("energy", None) => "energy, by the work of the wheels".to_owned(),
        (least, _) => least.to_owned(),
    });
    match (least, &record.reason, taken) {
        (Some(least), None, Some(taken)) => format!("{taken}: the way with the least {least}."),
        (Some(_), reason, _) => {
            format!("No safe route: {}.", reason.as_deref().unwrap_or_default())
        }
        (None, None, Some(taken)) => format!("{taken}: the given way is safe."),
        (None, reason, taken) => {
            let but = taken.map_or_else(String::new, |taken| format!("{taken}, but "));
            let why = reason.as_deref().unwrap_or_default();
            format!("{but}the given way is not safe: {why}.")
        }
    }
}
