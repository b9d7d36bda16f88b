//! The draft of a soil: like a preset in what is not known.

use std::sync::Arc;

use serde_json::{Map, Value as Json};

use crate::statistics::Marginal;

use super::super::check::nearest;
use super::super::error::{DocumentError, Problem};
use super::super::escape;
use super::super::kind::Kind;
use super::super::overrides::Overrides;
use super::super::presets::{preset, presets};
use super::super::priors::stated_by_priors;
use super::super::read::read_soil;
use super::super::source::Source;
use super::super::stated::Parameter;
use super::super::text;
use super::super::tree::Text;
use super::answers::{Answers, Usual, rounded};
use super::lines::Lines;

pub(super) const KEYS: [&str; 11] = [
    "name",
    "source",
    LIKE,
    FRICTION_ANGLE,
    "cohesion_kpa",
    "density_kg_m3",
    "pressure_sinkage.k_c",
    "pressure_sinkage.k_phi",
    "pressure_sinkage.n",
    "shear.longitudinal_m",
    KNOWN,
];
/// The questions that are constants.
const QUESTIONED: &[&str] = KEYS.split_at(3).1.split_at(7).0;

/// The preset that the soil is like.
pub(super) const LIKE: &str = "like";
/// How well the constants are known.
pub(super) const KNOWN: &str = "known";
/// Which preset, if none is named.
const USUAL_PRESET: &str = "lunar-0-15-cm";
/// Tables that are of the preset's own tests, not of a soil like it.
const NOT_KEPT: [&str; 6] =
    ["domain", "known_from", "uncertainty", "priors", "discrepancy", "small_wheel"];
/// The key of the table that says where constants are from.
const KNOWN_FROM: &str = "known_from";
/// Its keys, each with the questions whose constants it is of.
const CONSTANTS: [(&str, &[&str]); 3] = [
    ("strength", &["cohesion_kpa", FRICTION_ANGLE]),
    ("pressure_sinkage", &["pressure_sinkage.k_c", "pressure_sinkage.k_phi", "pressure_sinkage.n"]),
    ("shear", &["shear.longitudinal_m"]),
];
const FRICTION_ANGLE: &str = "friction_angle_deg";
/// Keys that say how the preset's friction angle was found, and with it what a wheel mobilises of
/// it.
const OF_THE_FRICTION_ANGLE: [&str; 2] = ["friction_test", "constant_volume_share"];

/// The usual value of a question.
pub(super) fn usual(answers: &Answers, key: &str) -> Usual {
    answers.usual_of_soil(key)
}

impl Answers {
    pub(super) fn usual_of_soil(&self, key: &str) -> Usual {
        if key == LIKE {
            return Usual::of(USUAL_PRESET, "the surface of the Moon between craters");
        }
        if key == KNOWN {
            return Usual::left_out("it is not stated, and verdicts on this soil cannot tell");
        }
        let name = self.like();
        match self.keys_of_preset().pointer(&format!("/{}", key.replace('.', "/"))) {
            Some(value) => Usual::of(value.clone(), format!("that of the preset `{name}`")),
            None => Usual::left_out("as the priors `general` say"),
        }
    }

    /// The law of the table of a key, in the preset.
    pub(super) fn law_of_soil(&self, key: &str) -> Option<String> {
        let (table, _) = key.split_once('.')?;
        self.keys_of_preset()[table]["law"].as_str().map(str::to_owned)
    }

    fn like(&self) -> String {
        let given = self.given.get(LIKE).and_then(Json::as_str);
        given.unwrap_or(USUAL_PRESET).to_owned()
    }

    /// The document of the preset that the soil is like.
    fn preset(&self) -> Json {
        let text = preset(Kind::Soil, &self.like()).map_or("", |preset| preset.text);
        let text = Text { label: String::new(), content: text.to_owned(), ..Text::default() };
        text::parse(&Arc::new(text)).map_or(Json::Null, |node| node.to_json())
    }

    /// The tables of the preset that the soil does not take, as they are of its own tests.
    pub(super) fn not_kept(&self) -> Vec<&'static str> {
        let preset = self.preset();
        NOT_KEPT.into_iter().filter(|table| preset.get(table).is_some()).collect()
    }

    /// The document of that preset without what is of its own tests.
    fn keys_of_preset(&self) -> Json {
        let mut keys = self.preset();
        if let Json::Object(keys) = &mut keys {
            let has_other_angle = self.given.contains_key(FRICTION_ANGLE);
            keys.retain(|key, _| {
                let key = key.as_str();
                let is_of_another = has_other_angle && OF_THE_FRICTION_ANGLE.contains(&key);
                !NOT_KEPT.contains(&key) && !is_of_another
            });
        }
        keys
    }

    /// Which constants are all the preset's, so that bands draw about them as about copied ones.
    fn copied_constants(&self) -> impl Iterator<Item = &'static str> {
        let is_given = |question: &&str| self.given.contains_key(*question);
        let copied = CONSTANTS.iter().filter(move |(_, questions)| !questions.iter().any(is_given));
        copied.map(|(key, _)| *key)
    }

    pub(super) fn soil(&self) -> String {
        let like = self.like();
        let mut keys = self.keys_of_preset();
        let mut assumed: Vec<String> =
            QUESTIONED.iter().filter_map(|key| self.reason(key, key)).collect();
        for key in QUESTIONED {
            if let Some(answer) = self.given.get(*key) {
                set(&mut keys, key, answer.clone());
            }
        }
        let Json::Object(keys) = keys else { return String::new() };
        let is_stated = |key: &str| ["schema", "name", "source", "notes", "assumed"].contains(&key);
        let rest = keys.iter().filter(|(key, _)| !is_stated(key));
        for (key, value) in rest.clone() {
            let inner = value.as_object().into_iter().flatten();
            let paths = inner.map(|(inner, _)| format!("{key}.{inner}"));
            let own = (!value.is_object()).then(|| key.clone());
            let kept = paths.chain(own).filter(|path| !KEYS.contains(&path.as_str()));
            assumed.extend(kept.map(|path| format!("{path}: that of the preset `{like}`")));
        }

        let mut lines =
            Lines::new(Kind::Soil, "A soil of Grouser: `assumed` has what is taken from another.");
        let not_kept = self.not_kept();
        if !not_kept.is_empty() {
            lines.comment(&format!("Not taken from `{like}`: {}.", not_kept.join(", ")));
        }
        lines.plain("name", &Json::from(self.text("name")));
        lines.plain("source", &Json::from(self.text("source")));
        lines.texts("assumed", &assumed);
        lines.blank();
        let (tables, numbers): (Vec<_>, Vec<_>) = rest.partition(|(_, value)| value.is_object());
        for (key, value) in numbers {
            lines.key(key, Some(value), "");
        }
        let known = self.given.get(KNOWN);
        let stated: Vec<(&str, Json)> = match known {
            // What nobody answered is the preset's, however well the rest is known.
            Some(known) => {
                let copied: Vec<&str> = self.copied_constants().collect();
                let word =
                    |key| if copied.contains(&key) { Json::from("copied") } else { known.clone() };
                CONSTANTS.map(|(key, _)| (key, word(key))).to_vec()
            }
            None => self.copied_constants().map(|key| (key, Json::from("copied"))).collect(),
        };
        if !stated.is_empty() {
            lines.table(&format!("[{KNOWN_FROM}]"), KNOWN_FROM);
            for (key, word) in stated {
                lines.key(key, Some(&word), "");
            }
        }
        for (table, keys) in tables {
            lines.table(&format!("[{table}]"), table);
            lines.law(keys["law"].as_str());
            for (key, value) in keys.as_object().into_iter().flatten() {
                lines.key(key, Some(value), "");
            }
        }
        let soil = lines.end();
        let rows = if known.is_some() { uncertainty_of(&soil) } else { String::new() };
        soil + &rows
    }
}

/// Rows that state how well the constants of a soil are known: as the priors take those to be that
/// are from where `known_from` says.
fn uncertainty_of(soil: &str) -> String {
    let Ok(read) = read_soil(&Source::text("the draft", soil), &Overrides::none()) else {
        return String::new();
    };
    let believed = stated_by_priors(&read.document).parameters.into_iter();
    let own = believed.filter(|it| QUESTIONED.contains(&&*it.key));
    let rows = own.filter_map(|Parameter { key, marginal, .. }| {
        let (law, deviation) = match marginal {
            Marginal::Normal { standard_deviation, .. } => ("normal", standard_deviation),
            Marginal::Lognormal { standard_deviation, .. } => ("lognormal", standard_deviation),
            Marginal::Uniform { .. } | Marginal::Triangular { .. } => return None,
        };
        let mut lines = Lines::rest(Kind::Soil);
        lines.table("[[uncertainty.parameter]]", "uncertainty.parameter");
        lines.plain("key", &Json::from(key));
        lines.plain("distribution", &Json::from(law));
        lines.plain("standard_deviation", &Json::from(rounded(deviation)));
        Some(lines.end())
    });
    rows.collect()
}

/// Checks that there is a preset of this name.
pub(super) fn check_preset(name: &str) -> Result<(), DocumentError> {
    if preset(Kind::Soil, name).is_some() {
        return Ok(());
    }
    let names: Vec<&str> = presets(Kind::Soil).map(|preset| preset.name).collect();
    let hint = nearest(name, names.iter().copied()).map_or_else(
        || format!("the soil presets are {}", names.join(", ")),
        |meant| format!("did you mean `{meant}`?"),
    );
    let problem = Problem::Malformed("there is no such preset of a soil");
    let label = Overrides::change_label(LIKE, &escape::line(name));
    Err(DocumentError::whole(label, problem).with_hint(hint))
}

/// Sets a dotted key; tables on the way are made.
fn set(keys: &mut Json, path: &str, value: Json) {
    match path.split_once('.') {
        None => keys[path] = value,
        Some((table, rest)) => {
            if !keys[table].is_object() {
                keys[table] = Json::Object(Map::new());
            }
            set(&mut keys[table], rest, value);
        }
    }
}
