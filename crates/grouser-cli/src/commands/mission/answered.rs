//! What a mission answers: its rows, its path, and what became of it in words.

use grouser::document::columns::YAW;
use grouser::document::columns::run;
use grouser::document::reading::{capitalised, four_digits, metres};
use grouser::document::table::Table;
use grouser::document::{LoadedMission, escape};
use grouser::studies::mission::{DrivenLeg, DrivenMission};
use grouser_draw::{Sheet, path_of};

use super::believed::Believed;

/// A document of a mission, and what was driven: one mission, or all alternatives.
pub(super) struct Answered {
    pub(super) document: LoadedMission,
    pub(super) ways: Vec<DrivenMission>,
    /// What they risk, if samples were drawn.
    pub(super) believed: Option<Believed>,
}

impl Answered {
    /// A row for each leg that was begun, or for each alternative.
    pub(super) fn table(&self) -> Table {
        match &self.ways[..] {
            [one] => one.table(),
            ways => DrivenMission::alternatives(ways),
        }
    }

    /// A row for each record.
    pub(super) fn records(&self, way: &DrivenMission) -> Table {
        run::table(&way.report.trajectory, &self.document.value.scenario)
    }

    /// The path from above.
    pub(super) fn path(&self, way: &DrivenMission) -> Sheet {
        let title = if self.document.value.scenario.ground.is_plane() {
            "Path on the slope"
        } else {
            "Path from above, from the start"
        };
        path_of(title, &self.document.value.scenario.rover, &way.report)
    }
}

/// A line for each leg that did not end as it says.
pub(super) fn reasons(way: &DrivenMission) -> String {
    let line = |leg: &DrivenLeg| {
        let back =
            leg.report.back_out.as_ref().map_or(String::new(), |back| {
                format!("; backed out {} m", four_digits(back.distance))
            });
        let reason = escape::line(&leg.reason()?).into_owned();
        Some(format!("leg {}: {}: {reason}{back}\n", leg.number, leg.report.outcome.name()))
    };
    way.legs.iter().filter_map(line).collect()
}

/// What became of a mission.
pub(super) fn sentence(way: &DrivenMission) -> String {
    let (begun, all, end) = (way.legs.len(), way.planned, way.report.last());
    let legs = match (begun < all, all) {
        (true, _) => format!("in leg {begun} of {all}"),
        (false, 1) => "one leg".to_owned(),
        (false, all) => format!("{all} legs"),
    };
    let taken = way
        .report
        .taken()
        .map_or(String::new(), |taken| format!(", {} J electrical", four_digits(taken.energy)));
    format!(
        "{}, {legs}, after {} s: at x {} m, y {} m, yaw {}°, {} J{taken}",
        capitalised(&way.report.kind().in_words()),
        four_digits(end.time),
        metres(end.place().x),
        metres(end.place().y),
        four_digits(YAW.unit.from_si(end.state.yaw)),
        four_digits(way.report.energy()),
    )
}
