//! The cheapest way over ground with heights, or what a given one takes.

mod columns;
mod page;
mod profile;
mod question;
mod seek;
mod way;

use std::path::Path;
use std::sync::Arc;

use serde_json::{Map, Value, json};

use self::columns::{MOST_SLOPE, WAY, brief};
pub use self::question::{Asked, RouteQuestion};
pub use self::seek::WayError;
pub use self::way::Way;
use super::{Answer, Displayed, Member, findings_up_to, given_heights};
use crate::contact::validity::Finding;
use crate::document::columns::completion::RISK;
use crate::document::columns::{SLOPE, YAW};
use crate::document::route::RouteRecord;
use crate::document::table::Table;
use crate::studies::completion::Completion;
use crate::studies::heading::STRAIGHT_UP;

impl RouteQuestion<'_> {
    /// The answer. Its page has one picture, `NAME.svg`: the ground with the ways.
    ///
    /// * `ways`: at least one: first that which is asked for, then its alternatives
    #[must_use]
    pub fn answer(&self, name: &str, ways: &[Way]) -> Answer {
        let rows = Arc::new(rows_of(ways));
        let what = if self.has_line() { "What a way takes" } else { "The cheapest way" };
        let [rover, soil] = ["rover", "soil"].map(|part| self.scenario.document.name_of(part));
        let mut answer = Answer::new(name, format!("{what}: {rover} on {soil}"));
        self.state(&mut answer);
        let others: Vec<&RouteRecord> = ways[1..].iter().map(|way| &way.record).collect();
        answer.results = vec![
            Member::Entries(entries(&ways[0].record)),
            Member::Value("straight_m", json!(self.asked.straight())),
            Member::Value("coordinate_system", json!(self.raster.coordinates.name())),
            Member::Value("alternatives", json!(others)),
        ];
        answer.tables.push((name.to_owned(), Arc::clone(&rows)));
        answer.tables.extend(ways.iter().enumerate().filter_map(profile_file));
        let lines: String = ways.iter().map(Way::lines).collect();
        answer.screen = vec![
            Displayed::Words(format!("{}\n", ways[0].record.sentence)),
            Displayed::Rows(Arc::clone(&rows), brief(ways)),
            Displayed::Words(lines),
        ];
        answer.given.push(given_heights(self.dem, self.raster));
        answer.given.extend(self.given.iter().cloned());
        answer.attach("scenario.toml", self.scenario);
        self.page(&mut answer, ways, &rows);
        answer.findings = self.findings(ways);
        answer
    }

    /// The flags of the soil as written up to the steepest slope of the ways, along the contour and
    /// straight up and down; `None` where no way is known.
    fn findings(&self, ways: &[Way]) -> Option<Vec<Finding>> {
        let slopes = ways.iter().filter_map(|way| way.by_tables(|it| it.most_slope));
        let steepest = slopes.reduce(f64::max)?;
        let courses = [-STRAIGHT_UP, 0.0, STRAIGHT_UP];
        findings_up_to(&self.study.mobility.heading, courses, steepest)
    }

    /// Which energy a way has least of: what the motors draw, or where none is known what the
    /// wheels do.
    fn energy(&self) -> &'static str {
        if self.study.mobility.heading.rover.has_motors() { "electrical" } else { "mechanical" }
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let (document, limits) = (&self.scenario.document, self.study.limits);
        let shown = |file: &Path| file.display().to_string();
        let (from, to, yaw) = match self.asked {
            Asked::Between(ends) => (ends.from, ends.to, ends.yaw),
            Asked::Along(line) => (line.start(), line.end(), line.yaw),
        };
        answer.input("dem", shown(self.dem));
        answer.inputs_of(document, ["rover", "soil"]);
        answer.input("model", self.scenario.value.model.name());
        answer.inputs_of(document, ["gravity_m_s2"]);
        answer.input("from_m", [from.x, from.y]);
        answer.input("to_m", [to.x, to.y]);
        answer.input("along", self.along.map(shown));
        answer.input(YAW.name, yaw.map(|yaw| YAW.unit.from_si(yaw)));
        answer.input("keep_out", self.keep_out.map(shown));
        answer.input(MOST_SLOPE.name, SLOPE.unit.from_si(limits.most_slope));
        answer.input("most_slip_ratio", limits.most_slip_ratio);
        answer.input("most_no_go", limits.most_no_go);
        answer.input("rim_speed_m_s", self.study.mobility.rim_speed);
        answer.input("energy", self.energy());
        self.sampling.state(answer);
        if let Value::Object(rule) = json!(self.study.mobility.rule) {
            answer.inputs.extend(rule);
        }
        answer.belief = Some(self.sampling.belief(self.scenario));
    }
}

/// A row for each way.
fn rows_of(ways: &[Way]) -> Table {
    let risks: Vec<Option<&Completion>> = ways.iter().map(Way::completion).collect();
    Table::of(&WAY, ways).and(&RISK, &risks)
}

/// The profile of a way by the name of its file: that of the way that is asked for is `profile`,
/// that of an alternative has what it has least of at its end.
fn profile_file((place, way): (usize, &Way)) -> Option<(String, Arc<Table>)> {
    let RouteRecord { profile, minimise, .. } = &way.record;
    let least = minimise.filter(|_| place > 0).map_or_else(String::new, |it| format!("-{it}"));
    (profile.rows() > 0).then(|| (format!("profile{least}"), Arc::new(profile.clone())))
}

/// What a way takes, as the entries of an object of JSON.
fn entries(record: &RouteRecord) -> Map<String, Value> {
    match json!(record) {
        Value::Object(entries) => entries,
        other => unreachable!("a record is an object, not {other}"),
    }
}
