//! Documents, and what they name.

use grouser::document::read_campaign;
use grouser_io::{
    Companion, DocumentError, Kind, Loaded, Overrides, Source, presets, read_data_set, read_design,
    read_limits, read_mission, read_motor, read_priors, read_rover, read_scenario, read_soil,
    read_telemetry_mapping, read_wheel,
};

use super::{Outcome, Reader, Stage, any, finite, refused};
use crate::corpus;

pub(super) fn all() -> Vec<Reader> {
    let of = |kind: Kind| presets(kind).map(|preset| preset.text.into()).collect::<Vec<Vec<u8>>>();
    let with = |kind: Kind, own: &[&str]| {
        let own = own.iter().map(|text| (*text).into());
        of(kind).into_iter().chain(own).collect::<Vec<Vec<u8>>>()
    };
    vec![
        Reader::new("soil", 6, with(Kind::Soil, &[corpus::SAMPLED_SOIL]), |bytes, stage| {
            document(read_soil, &source(bytes, stage))
        }),
        Reader::new("wheel", 10, of(Kind::Wheel), |bytes, stage| {
            document(read_wheel, &source(bytes, stage))
        }),
        Reader::new("motor", 10, of(Kind::Motor), |bytes, stage| {
            document(read_motor, &source(bytes, stage))
        }),
        Reader::new("rover", 10, of(Kind::Rover), |bytes, stage| {
            document(read_rover, &source(bytes, stage))
        }),
        Reader::new("scenario", 3, with(Kind::Scenario, &corpus::SCENARIOS), |bytes, stage| {
            document(read_scenario, &source(bytes, stage))
        }),
        Reader::new("mission", 3, of(Kind::Mission), |bytes, stage| {
            document(read_mission, &source(bytes, stage))
        }),
        Reader::new("priors", 10, of(Kind::Prior), |bytes, stage| {
            any(&read_priors(&source(bytes, stage), &none()))
        }),
        Reader::new("data set", 3, of(Kind::DataSet), |bytes, stage| {
            any(&read_data_set(&source(bytes, stage), &none()))
        }),
        Reader::new("design", 2, of(Kind::Design), |bytes, stage| {
            any(&read_design(&source(bytes, stage), &none()))
        }),
        Reader::new("campaign", 3, of(Kind::Campaign), |bytes, stage| {
            any(&read_campaign(&source(bytes, stage), &none()))
        }),
        Reader::new("mapping of telemetry", 10, of(Kind::TelemetryMapping), |bytes, stage| {
            any(&read_telemetry_mapping(&source(bytes, stage), &none()))
        }),
        Reader::new("limits", 6, vec![corpus::LIMITS.into()], |bytes, stage| {
            finite(&read_limits(&source(bytes, stage)))
        }),
        Reader::new("set values", 3, vec![corpus::SETTINGS.into()], |bytes, _| {
            any(&Overrides::parse(String::from_utf8_lossy(bytes).lines()))
        }),
        Reader::new("samples of a soil", 5, vec![corpus::SAMPLES.into()], |bytes, _| {
            soil_beside(bytes)
        }),
        Reader::new("legs, CSV", 3, vec![corpus::LEGS.into()], |bytes, _| {
            mission_beside("legs.csv", bytes)
        }),
        Reader::new("legs, GeoJSON", 5, vec![corpus::PLACES.into()], |bytes, _| {
            mission_beside("legs.geojson", bytes)
        }),
        Reader::new("limits of a mission", 3, vec![corpus::LIMITS.into()], |bytes, _| {
            mission_beside("limits.toml", bytes)
        }),
    ]
}

/// Reads a document. What it resolves to is the same document, written otherwise.
fn document<V: PartialEq>(
    read: fn(&Source, &Overrides) -> Result<Loaded<V>, DocumentError>,
    source: &Source,
) -> Outcome {
    let found = match read(source, &none()) {
        Ok(found) => found,
        Err(error) => return refused(&error),
    };
    let companions = found.companions.clone();
    let text = Source::text_with("the resolved document", found.to_toml(), companions);
    match read(&text, &none()) {
        Ok(again) if again.value == found.value => Outcome::Read,
        Ok(_) => Outcome::Wrong("another when it is written down and read again".to_owned()),
        Err(error) => Outcome::Wrong(format!("refused when it is written down: {error}")),
    }
}

fn samples() -> Vec<Companion> {
    beside("samples.csv", corpus::SAMPLES.as_bytes())
}

fn none() -> Overrides {
    Overrides::none()
}

/// A document as a text in memory, or as a file if it is no text.
fn source(bytes: &[u8], stage: &Stage) -> Source {
    match std::str::from_utf8(bytes) {
        Ok(text) => Source::text_with("a document", text, samples()),
        Err(_) => Source::file(stage.file("document.toml", bytes)),
    }
}

/// A soil whose samples are these.
fn soil_beside(bytes: &[u8]) -> Outcome {
    let source = Source::text_with("a soil", corpus::SAMPLED_SOIL, beside("samples.csv", bytes));
    any(&read_soil(&source, &none()))
}

/// A mission whose legs or limits these are.
fn mission_beside(name: &str, bytes: &[u8]) -> Outcome {
    let key = if name.starts_with("legs") { "legs_from" } else { "stop_from" };
    let mut text = format!("schema = \"mission/1\"\nname = \"one\"\n{key} = \"{name}\"\n");
    if key == "stop_from" {
        text += "[[leg]]\ndrive_m = 1.0\n";
    }
    any(&read_mission(&Source::text_with("a mission", text, beside(name, bytes)), &none()))
}

fn beside(name: &str, bytes: &[u8]) -> Vec<Companion> {
    let content = String::from_utf8_lossy(bytes).into_owned();
    vec![Companion { name: name.to_owned(), content }]
}
