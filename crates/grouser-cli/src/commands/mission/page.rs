//! The page of a mission: what it risks, its worst leg and the verdict on each, its path and what
//! became of its legs; folded, every channel over time.

use grouser::answers::meanings;
use grouser::document::columns::ENERGY;
use grouser::document::columns::completion::RISK;
use grouser::document::columns::mission::{
    ELECTRICAL_LEG, ELECTRICAL_MISSION, LEG, MISSION, legs_brief, missions_brief,
};
use grouser::document::columns::run;
use grouser::document::columns::verdict::ADVICE;
use grouser::document::figure::axis;
use grouser::studies::mission::{DrivenLeg, DrivenMission};
use grouser_draw::chart::{Bars, Drawable};
use grouser_draw::style::on_both_grounds;

use super::answered::{Answered, reasons, sentence};
use crate::commands::sampling;
use crate::report::answer::{self, Basis, over_ground, over_time, run_meanings};
use crate::report::page::Page;

pub(super) fn html(answered: &Answered) -> String {
    let mut page = Page::new(&format!("Mission: {}", answered.document.document.name()));
    for (place, way) in answered.ways.iter().enumerate() {
        let name = if way.name.is_empty() { String::new() } else { format!("{}: ", way.name) };
        let believed = answered.believed.as_ref().map(|it| it.sentences(place, way));
        let mut believed = believed.into_iter().flatten();
        if let Some(risk) = believed.next() {
            page.answer(&format!("{name}{risk}"));
            if let Some(worst) = answered.believed.as_ref().and_then(|it| it.worst(place, way)) {
                page.answer(&format!("{name}{worst}"));
            }
            let legs: Vec<String> = believed.collect();
            page.list(&legs);
        }
        let nominal = if answered.believed.is_some() { "As it is written: " } else { "" };
        page.answer(&format!("{name}{nominal}{}.", sentence(way)));
    }
    page.list(what_was_driven(answered));
    if answered.ways.len() > 1 {
        let title = "The alternatives, each from the same start";
        let missions = answered.table();
        page.rows(title, &missions, &missions_brief(&missions));
    }
    for way in &answered.ways {
        of_way(&mut page, answered, way);
    }
    let scenario = &answered.document.value.scenario;
    let findings: Vec<_> = answered
        .ways
        .iter()
        .flat_map(|way| run::each_findings(&way.report.trajectory, scenario).into_iter().flatten())
        .collect();
    let mut columns = meanings(&LEG);
    if scenario.rover.has_motors() {
        columns.extend(meanings(&ELECTRICAL_LEG));
    }
    if answered.ways.len() > 1 {
        columns.extend(meanings(&MISSION));
        if scenario.rover.has_motors() {
            columns.extend(meanings(&ELECTRICAL_MISSION));
        }
    }
    columns.extend(run_meanings(scenario));
    let flags = match &answered.believed {
        Some(it) => sampling::numbers(it.sampling) + &sampling::rule_flags(&it.rule),
        None => " --nominal".to_owned(),
    };
    if answered.believed.is_some() {
        columns.extend(meanings(&RISK));
        columns.extend(meanings(&ADVICE));
    }
    let basis = Basis::new(format!("grouser mission mission.toml{flags}")).followed_by(&[
        "grouser mission mission.toml --stop-from STOPS.toml --out WITH-STOPS",
        "grouser mission mission.toml --animate drive.html",
    ]);
    let basis = basis.with("mission.toml", &answered.document).with_files(answered.given());
    answer::close(page, Some(&findings), &columns, &basis)
}

/// The path of a mission, its legs, and every channel.
fn of_way(page: &mut Page, answered: &Answered, way: &DrivenMission) {
    if !way.name.is_empty() {
        page.heading(&way.name);
    }
    let scenario = &answered.document.value.scenario;
    page.drawing(
        &on_both_grounds(&answered.path(way)),
        "The path from above, to scale, uphill or north at the top, a colour for each leg. The \
         rover is drawn at the start, in grey, and where each leg ended, with its number; a cross \
         marks a leg that did not end as it says.",
    );
    let legs = way.table();
    page.rows("What became of each leg", &legs, &legs_brief(&legs));
    let reasons = reasons(way);
    if !reasons.is_empty() {
        page.list(reasons.lines());
    }
    if !scenario.ground.is_plane() {
        page.folded(&answer::title_of_part(&way.name, "the ground and the way over it"), |page| {
            over_ground(page, scenario, &way.report.trajectory.records);
        });
    }
    page.folded(&answer::title_of_part(&way.name, "the work of each leg"), |page| {
        page.drawing(&energy(way), "Work of the motors in each leg, with the turn before it.");
    });
    over_time(page, &way.name, &answered.records(way), scenario);
}

fn what_was_driven(answered: &Answered) -> Vec<String> {
    let document = &answered.document.document;
    let mut lines = vec![
        format!("rover: {}", document.name_of("rover")),
        format!("soil: {}", document.name_of("soil")),
        answer::ground(document, &answered.document.value.scenario),
    ];
    lines.extend(document.text("notes").map(str::to_owned));
    lines
}

fn energy(way: &DrivenMission) -> String {
    let row = |leg: &DrivenLeg| {
        (format!("leg {}", leg.number), vec![ENERGY.unit.from_si(leg.report.energy)])
    };
    let bars = Bars {
        title: "Energy by leg".to_owned(),
        x_label: axis(ENERGY),
        parts: vec!["energy".to_owned()],
        has_rest: false,
        rows: way.legs.iter().map(row).collect(),
    };
    bars.to_svg()
}
