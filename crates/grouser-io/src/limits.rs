//! Limits on their own, for a rover that something else than a mission drives.

use serde_json::{Value as Json, json};

use super::check;
use super::describe::mission::{self, MISSION};
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::Inner;
use super::kind::Kind;
use super::schema::{root, under};
use super::source::Source;
use super::text;
use super::values::check_stops;
use grouser_core::mission::Stop;

/// The table of a mission that they stand in.
const STOP: &str = "stop";

/// Reads limits on their own: a text that has the table `[stop]` of a mission, and nothing else.
///
/// ```
/// use grouser_io::{Source, read_limits};
///
/// let text = "[stop]\nslip_ratio = { above = 0.4, over_m = 0.5 }\nroll_deg = { above = 12.0 }";
/// let stops = read_limits(&Source::text("limits", text))?;
/// assert_eq!([stops[0].above, stops[0].over], [0.4, 0.5]);
/// assert_eq!(format!("{:.4} rad", stops[1].above), "0.2094 rad");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first, with its key and what it may be.
pub fn read_limits(source: &Source) -> Result<Vec<Stop>, DocumentError> {
    let tree = text::parse(&source.read()?)?;
    if let Some(other) = tree.entries().iter().find(|entry| entry.key != STOP) {
        let problem = Problem::UnknownKey { key: other.key.clone() };
        let hint = format!("limits stand in the table `{STOP}`");
        return Err(DocumentError::at(&other.key_origin, problem).with_hint(hint));
    }
    let Some(entry) = tree.entry(STOP) else { return Ok(Vec::new()) };
    let root = root(Kind::Mission);
    check::answer(root, &under(root, STOP, None), &entry.node, STOP)?;
    let document = Document::of(Kind::Mission, &tree.to_json());
    let limits = json!({ STOP: document.get(STOP).unwrap_or(&Json::Null) });
    let mut plan = mission::blank();
    MISSION.put(&mut plan, &limits);
    check_stops(&plan.stops, "").map_err(|misfit| misfit.of(&tree))?;
    Ok(plan.stops)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Overrides, read_mission};

    fn read(text: &str) -> Result<Vec<Stop>, DocumentError> {
        read_limits(&Source::text("limits", text))
    }

    /// The same table in a mission.
    #[test]
    fn limits_alone_are_those_of_a_mission() {
        let table = "[stop]\nenergy_j = { above = 4 }\ndrift_m = { above = 0.1 }\n\
            off_path_m = { above = 0.5, then = \"back-out\", back_out_m = 0.2 }\n";
        let mission =
            format!("schema = \"mission/1\"\nname = \"one\"\n{table}[[leg]]\ndrive_m = 1.0\n");
        let plan = read_mission(&Source::text("mission", mission), &Overrides::none());
        let expected = plan.expect("a mission").value.mission().stops;
        assert_eq!(read(table).expect("limits"), expected);
        assert_eq!(expected.len(), 3);
        assert_eq!(read("").expect("none"), Vec::new());
    }

    #[test]
    fn an_error_names_the_key_and_what_it_may_be() {
        for (text, expected) in [
            ("stop.slip_ratio.above = 1.5", "`stop.slip_ratio.above` is 1.5, it must be 0 to 1"),
            ("stop.slip.above = 0.5", "unknown key `stop.slip`"),
            ("stop.roll_deg.over_m = 0.5", "unknown key `stop.roll_deg.over_m`"),
            ("stop.time_s = { }", "`stop.time_s.above`"),
            ("stop.time_s = \"5\"", "`stop.time_s`"),
            ("stop.time_s = -5", "`stop.time_s`"),
            ("stop.time_s.above = \"long\"", "`stop.time_s.above`"),
            ("stop.time_s = { above = 1, then = \"back-out\" }", "does not say how far"),
            ("stops.time_s.above = 1", "unknown key `stops`"),
        ] {
            let message = read(text).expect_err(text).to_string();
            assert!(message.contains(expected), "{text}: {message}");
        }
    }
}
