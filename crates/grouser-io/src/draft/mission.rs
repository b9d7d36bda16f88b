//! The draft of a mission.

use serde_json::{Value as Json, json};

use super::super::kind::Kind;
use super::answers::{Answers, Usual};
use super::lines::Lines;
use super::scenario;

pub(super) const KEYS: [&str; 5] = ["name", "rover", "soil", "gravity_m_s2", "slope_deg"];

/// The usual value of a question: that of a scenario.
pub(super) fn usual(answers: &Answers, key: &str) -> Usual {
    scenario::usual(answers, key)
}

impl Answers {
    /// A mission that is driven as it is, out, round and back, to be changed.
    pub(super) fn mission(&self) -> String {
        let about = "A mission of Grouser: legs that a rover drives, and limits at which it stops.";
        let mut lines = Lines::new(Kind::Mission, about);
        lines.plain("name", &Json::from(self.text("name")));
        lines.blank();
        for key in &KEYS[1..] {
            lines.key(key, self.value(key).as_ref(), "");
        }
        lines.table("[stop]", "stop");
        lines.key("slip_ratio", Some(&json!({ "above": 0.4, "over_m": 1.0 })), "");
        for (key, number) in [("drive_m", 2.0), ("turn_deg", 90.0), ("drive_m", 2.0)] {
            lines.table("[[leg]]", "leg");
            lines.key(key, Some(&json!(number)), "");
        }
        lines.end()
    }
}
