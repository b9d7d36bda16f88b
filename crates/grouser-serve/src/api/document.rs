//! `scenario` and `stand`: what a question is about, as complete documents, with the numbers that
//! may be set, from the rows that declare them.

use std::ops::RangeInclusive;

use grouser::document::{
    self, Described, Document, Kind, Loaded, UncertainSoil, json, meaning, unit_of,
};
use serde_json::{Map, Value, json};

use super::fields::AskedFields;
use super::parts::{ScenarioParts, StandParts};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// The scenario of a question about headings.
pub(super) fn scenario(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = ScenarioParts::of(&fields)?;
    fields.finish()?;
    let scenario = parts.scenario(&console.folder, false)?;
    Ok(Question::new(move |_, send| {
        let document = &scenario.document;
        let names = ["rover", "soil"].map(|part| (part.to_owned(), document.name_of(part).into()));
        send(json::line(&json!({
            "schema": "grouser.session.v1",
            "names": Map::from_iter(names),
            "model": scenario.value.model.name(),
            "states_uncertainty": scenario.stated_uncertainty().is_some(),
            "assumptions": scenario.assumptions,
            "notes": scenario.notes,
            "documents": { "scenario.toml": scenario.to_toml() },
            "keys": keys(Kind::Scenario, &scenario),
        })));
        Ok(())
    }))
}

/// The soil and the wheel of a question about a test stand.
pub(super) fn stand(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StandParts::of(&fields, &console.folder)?;
    fields.finish()?;
    let stands = parts.stands(&console.folder, false)?;
    Ok(Question::new(move |_, send| {
        for stand in stands.into_iter().take(1) {
            let (soil, wheel) = (&stand.soil, &stand.wheel);
            send(json::line(&json!({
                "schema": "grouser.session.v1",
                "names": { "soil": soil.document.name(), "wheel": wheel.document.name() },
                "model": stand.model().name(),
                "states_uncertainty": soil.stated_uncertainty().is_some(),
                "assumptions": joined(&soil.assumptions, &wheel.assumptions),
                "notes": joined(&soil.notes, &wheel.notes),
                "documents": { "soil.toml": soil.to_toml(), "wheel.toml": wheel.to_toml() },
                "keys": joined(&keys(Kind::Soil, soil), &keys(Kind::Wheel, wheel)),
            })));
        }
        Ok(())
    }))
}

/// The numbers of a study's own document that may be set.
pub(super) fn study_keys(kind: Kind, document: &Document) -> Vec<Value> {
    let is_own = |path: &&String| {
        let of_others = ["rover", "soil", "wheel", "free", "choose", "also", "samples"];
        path.split('.').all(|step| !of_others.contains(&step) && step.parse::<usize>().is_err())
    };
    let one = |path: &String| {
        let (value, range) = (document.number(path)?, document::range(kind, path));
        Some(settable((format!("{kind}.{path}"), value), (kind, path), range.as_ref()))
    };
    document.number_keys().iter().filter(is_own).filter_map(one).collect()
}

/// A number that may be set under a key, and what it is by the path that declares it.
pub(super) fn settable(
    (key, value): (String, f64),
    (kind, path): (Kind, &str),
    range: Option<&RangeInclusive<f64>>,
) -> Value {
    json!({
        "key": key,
        "value": value,
        "minimum": range.map(|it| *it.start()),
        "maximum": range.map(|it| *it.end()),
        "unit": path.rsplit('.').find_map(unit_of).map(|unit| unit.symbol),
        "meaning": meaning(kind, path),
    })
}

fn joined<T: Clone>(one: &[T], other: &[T]) -> Vec<T> {
    [one, other].concat()
}

/// The numbers of a document that may be set: the key, what it says, and what it may be.
fn keys<V: Described>(kind: Kind, loaded: &Loaded<V>) -> Vec<Value> {
    let uncertain: Vec<&str> = loaded.uncertain.iter().flat_map(UncertainSoil::keys).collect();
    let one = |path: &String| {
        let value = loaded.document.number(path)?;
        let range = loaded.value.range(path)?;
        let key = match path.split_once('.') {
            Some(("rover" | "soil", _)) if kind == Kind::Scenario => path.clone(),
            _ => format!("{kind}.{path}"),
        };
        let of_soil = key.strip_prefix("soil.").unwrap_or_default();
        Some(json!({
            "key": key,
            "value": value,
            "minimum": range.start(),
            "maximum": range.end(),
            "unit": unit_of(path).map(|unit| unit.symbol),
            "meaning": meaning(kind, path),
            "is_uncertain": uncertain.contains(&of_soil),
            "is_assumed": loaded.assumed.iter().any(|it| it.key == of_soil),
        }))
    };
    // An entry of a list is set with all of its list.
    let is_single = |path: &&String| path.split('.').all(|step| step.parse::<usize>().is_err());
    loaded.document.number_keys().iter().filter(is_single).filter_map(one).collect()
}
