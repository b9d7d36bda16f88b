//! What a picture of a scenario is called.

use grouser_io::{Kind, Loaded, escape, preset};

/// The rover and the soil of a scenario or a mission, by their titles where they are presets. The
/// slope is in the picture.
#[must_use]
pub fn title_of<V>(scenario: &Loaded<V>) -> String {
    let named = |kind: Kind, part: &str| {
        let name = scenario.document.text(&format!("{part}.name")).unwrap_or(part);
        match preset(kind, name) {
            Some(preset) => preset.title_and_source().0,
            None => escape::line(name).to_string(),
        }
    };
    format!("{} on {}", named(Kind::Rover, "rover"), named(Kind::Soil, "soil"))
}
