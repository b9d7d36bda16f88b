//! Documents, and what they name.

use grouser::document::read_campaign;
use grouser_io::{
    Companion, Kind, Overrides, Source, presets, read_data_set, read_design, read_limits,
    read_mission, read_motor, read_priors, read_rover, read_scenario, read_soil,
    read_telemetry_mapping, read_wheel,
};

use super::{Outcome, Reader, Stage, any, finite};
use crate::corpus;

pub(super) fn all() -> Vec<Reader> {
    let of = |kind: Kind| presets(kind).map(|preset| preset.text.into()).collect::<Vec<Vec<u8>>>();
    let with = |kind: Kind, own: &[&str]| {
        let own = own.iter().map(|text| (*text).into());
        of(kind).into_iter().chain(own).collect::<Vec<Vec<u8>>>()
    };
    vec![
        Reader::new("soil", 10, with(Kind::Soil, &[corpus::SAMPLED_SOIL]), |bytes, stage| {
            finite(&read_soil(&source(bytes, stage), &none()).map(|it| it.value))
        }),
        Reader::new("wheel", 10, of(Kind::Wheel), |bytes, stage| {
            finite(&read_wheel(&source(bytes, stage), &none()).map(|it| it.value))
        }),
        Reader::new("motor", 10, of(Kind::Motor), |bytes, stage| {
            finite(&read_motor(&source(bytes, stage), &none()).map(|it| it.value))
        }),
        Reader::new("rover", 10, of(Kind::Rover), |bytes, stage| {
            any(&read_rover(&source(bytes, stage), &none()))
        }),
        Reader::new("scenario", 5, with(Kind::Scenario, &corpus::SCENARIOS), |bytes, stage| {
            any(&read_scenario(&source(bytes, stage), &none()))
        }),
        Reader::new("mission", 5, of(Kind::Mission), |bytes, stage| {
            any(&read_mission(&source(bytes, stage), &none()))
        }),
        Reader::new("priors", 10, of(Kind::Prior), |bytes, stage| {
            any(&read_priors(&source(bytes, stage), &none()))
        }),
        Reader::new("data set", 5, of(Kind::DataSet), |bytes, stage| {
            any(&read_data_set(&source(bytes, stage), &none()))
        }),
        Reader::new("design", 5, of(Kind::Design), |bytes, stage| {
            any(&read_design(&source(bytes, stage), &none()))
        }),
        Reader::new("campaign", 5, of(Kind::Campaign), |bytes, stage| {
            any(&read_campaign(&source(bytes, stage), &none()))
        }),
        Reader::new("mapping of telemetry", 10, of(Kind::TelemetryMapping), |bytes, stage| {
            any(&read_telemetry_mapping(&source(bytes, stage), &none()))
        }),
        Reader::new("limits", 10, vec![corpus::LIMITS.into()], |bytes, stage| {
            finite(&read_limits(&source(bytes, stage)))
        }),
        Reader::new("set values", 10, vec![corpus::SETTINGS.into()], |bytes, _| {
            any(&Overrides::parse(String::from_utf8_lossy(bytes).lines()))
        }),
        Reader::new("samples of a soil", 10, vec![corpus::SAMPLES.into()], |bytes, _| {
            soil_beside(bytes)
        }),
        Reader::new("legs, CSV", 5, vec![corpus::LEGS.into()], |bytes, _| {
            mission_beside("legs.csv", bytes)
        }),
        Reader::new("legs, GeoJSON", 5, vec![corpus::PLACES.into()], |bytes, _| {
            mission_beside("legs.geojson", bytes)
        }),
        Reader::new("limits of a mission", 5, vec![corpus::LIMITS.into()], |bytes, _| {
            mission_beside("limits.toml", bytes)
        }),
    ]
}

fn none() -> Overrides {
    Overrides::none()
}

/// A document as a text in memory, or as a file if it is no text.
fn source(bytes: &[u8], stage: &Stage) -> Source {
    match std::str::from_utf8(bytes) {
        Ok(text) => Source::text("a document", text),
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
