//! The draft of a wheel.

use serde_json::Value as Json;

use super::super::kind::Kind;
use super::answers::{Answers, Usual};
use super::lines::Lines;

pub(super) const KEYS: [&str; 6] =
    ["name", "source", "radius_m", "width_m", "grousers.height_m", "grousers.count"];

/// The usual value of a question.
pub(super) fn usual(answers: &Answers, key: &str) -> Usual {
    answers.usual_of_wheel(key, "")
}

impl Answers {
    /// * `table`: the tables that the wheel stands in, with a dot behind them
    pub(super) fn usual_of_wheel(&self, key: &str, table: &str) -> Usual {
        let example = "an example, the size of HAKUTO's";
        let number = |key: &str| self.number(&format!("{table}{key}"));
        match key {
            "radius_m" => Usual::of(0.1, example),
            "width_m" => Usual::estimate(
                0.8 * number("radius_m"),
                "0.8 times the radius, as on HAKUTO, Rashid and VIPER",
            ),
            "grousers.height_m" => Usual::of(0.0, "without grousers the rim is smooth"),
            "grousers.count" => {
                let (height, radius) = (number("grousers.height_m"), number("radius_m"));
                if height <= 0.0 {
                    return Usual::left_out("the rim is smooth");
                }
                // Closer than their own height, the soil between them turns with the wheel.
                let count =
                    (std::f64::consts::TAU * radius / (2.0 * height)).ceil().clamp(1.0, 1e4);
                let count: u64 = format!("{count:.0}").parse().unwrap_or(1);
                Usual::of(count, "one for every two heights along the rim")
            }
            _ => Usual::left_out(""),
        }
    }

    /// The keys of a wheel, with grousers where it has any.
    pub(super) fn wheel_lines(&self, lines: &mut Lines, table: &str, path: &str) {
        let value = |key: &str| self.value(&format!("{table}{key}"));
        lines.key("radius_m", value("radius_m").as_ref(), "");
        lines.key("width_m", value("width_m").as_ref(), "");
        if self.number(&format!("{table}grousers.height_m")) > 0.0 {
            let grousers =
                if path.is_empty() { "grousers".to_owned() } else { format!("{path}.grousers") };
            lines.table(&format!("[{grousers}]"), &grousers);
            lines.key("height_m", value("grousers.height_m").as_ref(), "");
            lines.key("count", value("grousers.count").as_ref(), "");
        }
    }

    pub(super) fn wheel(&self) -> String {
        let mut lines = Lines::new(
            Kind::Wheel,
            "A wheel of Grouser: a rigid rim, with bars across it or smooth.",
        );
        lines.plain("name", &Json::from(self.text("name")));
        lines.plain("source", &Json::from(self.text("source")));
        let assumed: Vec<String> =
            KEYS[2..].iter().filter_map(|key| self.reason(key, key)).collect();
        lines.texts("assumed", &assumed);
        lines.blank();
        self.wheel_lines(&mut lines, "", "");
        lines.end()
    }
}
