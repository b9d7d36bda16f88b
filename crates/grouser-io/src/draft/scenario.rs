//! The draft of a scenario.

use serde_json::Value as Json;

use super::super::kind::{DEFAULT_ROVER, DEFAULT_SOIL, Kind};
use super::super::schema::{root, under};
use super::answers::{Answers, Usual};
use super::lines::Lines;

pub(super) const KEYS: [&str; 8] = [
    "name",
    "rover",
    "soil",
    "gravity_m_s2",
    "slope_deg",
    "start.yaw_deg",
    "drive.rim_speed_m_s",
    "duration_s",
];

/// The usual value of a question.
pub(super) fn usual(answers: &Answers, key: &str) -> Usual {
    let without = format!("as in a {} without this key", answers.kind);
    match key {
        "rover" => Usual::of(DEFAULT_ROVER, without),
        "soil" => Usual::of(DEFAULT_SOIL, without),
        key => {
            let schemas = under(root(answers.kind), key, None);
            let implied = schemas.iter().find_map(|schema| schema.get("default").cloned());
            Usual { value: implied, why: without }
        }
    }
}

impl Answers {
    pub(super) fn scenario(&self) -> String {
        let mut lines =
            Lines::new(Kind::Scenario, "A run of Grouser: a rover that drives on a slope of soil.");
        lines.plain("name", &Json::from(self.text("name")));
        lines.blank();
        for key in &KEYS[1..] {
            // Tables come last in TOML.
            if !key.contains('.') {
                lines.key(key, self.value(key).as_ref(), "");
            }
        }
        for key in &KEYS[1..] {
            let Some((table, inner)) = key.split_once('.') else { continue };
            lines.table(&format!("[{table}]"), table);
            lines.key(inner, self.value(key).as_ref(), "");
        }
        lines.end()
    }
}
