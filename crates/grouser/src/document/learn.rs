//! The soil that was learnt from a drive, as a document with samples; and the state of learning, to go on from.

mod state;

use serde_json::{Map, Value as Json, json};

pub use self::state::{KeptDrive, LARGEST_STATE, StateError, state_text};
use super::soil_family::DISCREPANCY;
use super::{Document, SAMPLES_FILE, UncertainSoil, with_priors_held, without_uncertainty};
use crate::contact::Theory;
use crate::soil::Discrepancy;
use crate::soil::discrepancy::{SIDE_VALUES, VALUES};
use crate::studies::learn::LearntSample;
use grouser_io::statistics::quantile;

/// A soil's document, and the file of samples that it names.
#[derive(Clone, Debug, PartialEq)]
pub struct LearntSoil {
    /// The document.
    pub soil: Document,
    /// The samples as CSV: the content of [`SAMPLES_FILE`].
    pub samples: String,
}

/// The lists of a discrepancy: their keys, how many values they have, and where.
type List = (&'static str, usize, fn(&Discrepancy) -> &[f64]);

const LISTS: [List; 4] = [
    ("drawbar_pull", VALUES, |it| &it.drawbar_pull),
    ("side_force", SIDE_VALUES, |it| &it.side_force),
    ("sinkage", VALUES, |it| &it.sinkage),
    ("torque", VALUES, |it| &it.torque),
];

impl LearntSoil {
    /// * `prior`: the soil's document before the drive, and its uncertain keys
    /// * `theory`: the model that the samples belong to
    /// * `source`: of the drive, in words
    #[must_use]
    pub fn of(
        prior: (&Document, &UncertainSoil),
        theory: Theory,
        samples: &[LearntSample],
        source: &str,
    ) -> Self {
        let (document, uncertain) = prior;
        let keys: Vec<String> = uncertain.keys().map(str::to_owned).collect();
        let brings_own = keys.iter().any(|key| key.starts_with(DISCREPANCY));
        let discrepancies = samples.iter().filter_map(|it| it.sample.soil.discrepancy);
        let lists: &[List] = if brings_own || discrepancies.count() == 0 { &[] } else { &LISTS };
        let medians = keys.iter().enumerate().map(|(place, key)| {
            let mut values: Vec<f64> = samples.iter().map(|it| it.values[place]).collect();
            values.sort_by(f64::total_cmp);
            (key.as_str(), quantile(&values, 0.5).unwrap_or(f64::NAN))
        });
        let medians: Vec<_> = medians.collect();
        let learnt: Vec<&str> = keys.iter().map(String::as_str).collect();
        let soil = without_uncertainty(document).with(medians).changed(|keys| {
            keys["name"] = format!("{}, learnt", document.name()).into();
            keys["source"] = format!("{source}; before: {}", document.source()).into();
            keys.shift_remove("date");
            keys.shift_remove("notes");
            if let Some(Json::Array(assumed)) = keys.get_mut("assumed") {
                assumed.retain(|one| !is_about(one, &learnt));
            }
            keys.insert("model".to_owned(), theory.name().into());
            keys.insert("uncertainty".to_owned(), json!({ "samples": SAMPLES_FILE }));
            if !lists.is_empty() {
                keys.insert(DISCREPANCY.to_owned(), none(lists));
            }
        });
        Self { soil: with_priors_held(&soil), samples: csv(&keys, lists, samples) }
    }
}

/// Whether an assumption is about a number that was learnt, or about how uncertain it was.
fn is_about(assumed: &Json, learnt: &[&str]) -> bool {
    let key = assumed.as_str().and_then(|text| text.split(':').next());
    key.is_some_and(|key| key.starts_with("uncertainty.") || learnt.contains(&key))
}

/// A discrepancy of nothing.
fn none(lists: &[List]) -> Json {
    let zeros = lists.iter().map(|(key, count, _)| ((*key).to_owned(), json!(vec![0.0; *count])));
    Json::Object(zeros.collect::<Map<_, _>>())
}

fn csv(keys: &[String], lists: &[List], samples: &[LearntSample]) -> String {
    let of_lists = lists.iter().flat_map(|(key, count, _)| {
        (0..*count).map(move |place| format!("{DISCREPANCY}.{key}.{place}"))
    });
    let names: Vec<String> = keys.iter().cloned().chain(of_lists).collect();
    let mut text = names.join(",") + "\n";
    for LearntSample { sample, values } in samples {
        let wrong = sample.soil.discrepancy.unwrap_or(Discrepancy::NONE);
        let wrong = lists.iter().flat_map(|(_, _, of)| of(&wrong));
        let cells: Vec<String> =
            values.iter().chain(wrong).map(|value| json!(value).to_string()).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}
