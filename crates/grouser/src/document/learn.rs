//! What is believed of a soil after a drive, as a document with samples of each model; and the
//! state of learning, to go on from.

mod state;

use serde_json::{Map, Value as Json, json};

pub use self::state::{KeptDrive, LARGEST_STATE, StateError, state_text};
use super::columns::learn::contradictions;
use super::soil_family::DISCREPANCY;
use super::{
    Companion, Document, DocumentError, Kind, Loaded, LoadedScenario, Overrides, SAMPLES_FILE,
    Source, UncertainSoil, escape, read_scenario, with_priors_held, without_uncertainty,
};
use crate::contact::Model;
use crate::soil::Discrepancy;
use crate::soil::discrepancy::{SIDE_VALUES, VALUES};
use crate::studies::ensemble::samples::{BandInputs, Sample};
use crate::studies::learn::{Drive, Learner, LearntSample};
use grouser_io::measurements::telemetry::day_of;
use grouser_io::statistics::{NothingAccepted, quantile};
use grouser_io::{SAMPLES_MODEL, SAMPLES_WEIGHT};

/// A soil's document, and the file of samples that it names.
#[derive(Clone, Debug, PartialEq)]
pub struct LearntSoil {
    /// The document.
    pub soil: Document,
    /// The samples as CSV: the content of [`SAMPLES_FILE`].
    pub samples: String,
}

/// Why nothing can be drawn of what is believed.
#[derive(Debug, thiserror::Error)]
pub enum NotBelieved {
    /// No soil is accepted.
    #[error("the soil's uncertainty reaches too far: {0}")]
    Soil(#[from] NothingAccepted),
    /// The soil's document is none of the scenario.
    #[error(transparent)]
    Document(#[from] DocumentError),
}

/// The lists of a discrepancy: their keys, how many values they have, and where.
type List = (&'static str, usize, fn(&Discrepancy) -> &[f64]);

const LISTS: [List; 4] = [
    ("drawbar_pull", VALUES, |it| &it.drawbar_pull),
    ("side_force", SIDE_VALUES, |it| &it.side_force),
    ("sinkage", VALUES, |it| &it.sinkage),
    ("torque", VALUES, |it| &it.torque),
];

/// The file of a prior's samples, beside those of what was learnt.
const PRIOR_SAMPLES_FILE: &str = "prior-samples.csv";

impl LearntSoil {
    /// What the learner of a drive knows now, under each of its models; `None` of a scenario without an uncertain
    /// soil. The numbers of the document itself are those under the model with the greatest share,
    /// and its date is the day of the drive's end, where the log's clock says it.
    ///
    /// * `seed`, `count`: of the samples of each model
    /// * `log`: what the drive is called
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn now(
        scenario: &LoadedScenario,
        drive: &Drive,
        (seed, count): (u64, u32),
        log: &str,
    ) -> Result<Option<Self>, NothingAccepted> {
        let day = drive.last_time().and_then(day_of);
        Self::of_learner(scenario, drive.learner(), (seed, count), (log, day))
    }

    /// * `log`, `day`: of the drive
    fn of_learner(
        scenario: &LoadedScenario,
        learner: &Learner,
        (seed, count): (u64, u32),
        (log, day): (&str, Option<String>),
    ) -> Result<Option<Self>, NothingAccepted> {
        let prior = scenario.document.part(Kind::Soil, "soil").zip(scenario.uncertain.as_ref());
        let Some((document, uncertain)) = prior else { return Ok(None) };
        let models = learner.models();
        let of_model = |(model, share): &(Model, f64)| {
            let samples = learner.samples_of(model, seed, count)?;
            Ok(Believed { model: model.clone(), share: *share, samples })
        };
        let believed: Vec<_> = models.shares().iter().map(of_model).collect::<Result<_, _>>()?;
        let source = format!(
            "learnt by Grouser {} from {:.1} m of the drive {log}",
            env!("CARGO_PKG_VERSION"),
            learner.learnt().way,
        );
        let learnt = Self::of((&document, uncertain), &believed, &source, day);
        Ok(Some(learnt.contradicted_by(contradictions(learner))))
    }

    /// The same with what contradicts itself in it.
    fn contradicted_by(self, new: Vec<String>) -> Self {
        if new.is_empty() {
            return self;
        }
        let soil = self.soil.changed(|keys| {
            let mut all = contradictions_of(keys.get(CONTRADICTIONS));
            all.extend(new.into_iter().filter(|it| !all.contains(it)).collect::<Vec<_>>());
            keys.insert(CONTRADICTIONS.to_owned(), json!(all));
        });
        Self { soil, ..self }
    }

    /// What a learner believes, as every study has it from the soil's document: the scenario with
    /// this soil, and samples that are drawn from it. Where nothing was learnt the
    /// scenario is as it was.
    ///
    /// * `sampling`: seed and number of the samples, and of those of each model in the document
    ///
    /// # Errors
    /// [`NotBelieved`] if no soil can be drawn.
    pub fn believed(
        scenario: &LoadedScenario,
        learner: &Learner,
        sampling: (u64, u32),
    ) -> Result<(LoadedScenario, Vec<Sample>), NotBelieved> {
        let (seed, count) = sampling;
        let now = || Self::of_learner(scenario, learner, sampling, ("", None));
        let learnt = learner.learnt().is_something().then(now).transpose()?;
        let now = match learnt.flatten() {
            Some(learnt) => learnt.in_scenario(scenario)?,
            None => scenario.clone(),
        };
        let samples = BandInputs::of_scenario(&now).samples(seed, count)?;
        Ok((now, samples))
    }

    /// The file of samples that the document names.
    #[must_use]
    pub fn companion(&self) -> Companion {
        Companion { name: SAMPLES_FILE.to_owned(), content: self.samples.clone() }
    }

    /// A scenario with this soil in place of its own.
    ///
    /// # Errors
    /// [`DocumentError`] if they are no scenario together.
    pub fn in_scenario(&self, before: &LoadedScenario) -> Result<LoadedScenario, DocumentError> {
        let soil = serde_json::to_value(&self.soil).unwrap_or_default();
        let document = before.document.changed(|keys| {
            keys["soil"] = soil;
        });
        let source =
            Source::text_with("what was learnt", document.to_toml(), vec![self.companion()]);
        read_scenario(&source, &Overrides::none())
    }

    /// * `prior`: the soil's document before the drive, and its uncertain keys
    /// * `believed`: under each model; at least one
    /// * `source`: of the drive, in words
    /// * `day`: of its end, if that is known
    fn of(
        prior: (&Document, &UncertainSoil),
        believed: &[Believed],
        source: &str,
        day: Option<String>,
    ) -> Self {
        let most = believed.iter().max_by(|one, other| one.share.total_cmp(&other.share));
        let Believed { model, samples, .. } = most.unwrap_or(&believed[0]);
        let (document, uncertain) = prior;
        let keys: Vec<String> = uncertain.keys().map(str::to_owned).collect();
        let brings_own = keys.iter().any(|key| key.starts_with(DISCREPANCY));
        let mut all = believed.iter().flat_map(|it| &it.samples);
        let has_discrepancies = all.any(|it| it.sample.soil.discrepancy.is_some());
        let lists: &[List] = if has_discrepancies && !brings_own { &LISTS } else { &[] };
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
            keys.extend(day.map(|day| ("date".to_owned(), day.into())));
            if let Some(Json::Array(assumed)) = keys.get_mut("assumed") {
                assumed.retain(|one| !is_about(one, &learnt));
            }
            keys.insert("model".to_owned(), model.name().into());
            keys.insert("uncertainty".to_owned(), json!({ "samples": SAMPLES_FILE }));
            if !lists.is_empty() {
                keys.insert(DISCREPANCY.to_owned(), none(lists));
            }
        });
        Self { soil: with_priors_held(&soil), samples: csv(&keys, lists, believed) }
    }
}

/// The key of what contradicts itself in a soil that was learnt.
const CONTRADICTIONS: &str = "contradictions";

fn contradictions_of(given: Option<&Json>) -> Vec<String> {
    let all = given.and_then(Json::as_array).into_iter().flatten();
    all.filter_map(Json::as_str).map(str::to_owned).collect()
}

/// What contradicts itself in how the soil of a scenario was learnt: a sentence each.
#[must_use]
pub fn contradictions_of_soil(scenario: &Document) -> Vec<String> {
    contradictions_of(scenario.get(&format!("soil.{CONTRADICTIONS}")))
}

/// Why the soil of a scenario is not to be relied on, if it was learnt with a contradiction.
#[must_use]
pub fn contradiction(scenario: &Document) -> Option<String> {
    let all = contradictions_of_soil(scenario);
    let name = escape::line(scenario.text("soil.name").unwrap_or("unnamed"));
    (!all.is_empty()).then(|| {
        let all = all.join("; ");
        format!("soil {name}: what was learnt contradicts itself: {}", escape::line(&all))
    })
}

/// What a learner believes under one model.
struct Believed {
    model: Model,
    /// How much it believes of the model [-].
    share: f64,
    samples: Vec<LearntSample>,
}

/// A scenario as files beside those of what was learnt: its document, and the files that it names
/// under names of their own.
#[must_use]
pub fn files_of_prior<V>(before: &Loaded<V>) -> (Document, Vec<Companion>) {
    let mut companions = before.companions.clone();
    let Some(samples) = companions.iter_mut().find(|it| it.name == SAMPLES_FILE) else {
        return (before.document.clone(), companions);
    };
    PRIOR_SAMPLES_FILE.clone_into(&mut samples.name);
    let document = before.document.changed(|keys| {
        if let Some(samples) =
            keys.get_mut("soil").and_then(|it| it.pointer_mut("/uncertainty/samples"))
        {
            *samples = PRIOR_SAMPLES_FILE.into();
        }
    });
    (document, companions)
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

/// Samples as rows: each with its model and weight, unless there is one model alone, which the
/// document then names.
fn csv(keys: &[String], lists: &[List], believed: &[Believed]) -> String {
    let of_lists = lists.iter().flat_map(|(key, count, _)| {
        (0..*count).map(move |place| format!("{DISCREPANCY}.{key}.{place}"))
    });
    let of_model: &[&str] = if believed.len() > 1 { &[SAMPLES_MODEL, SAMPLES_WEIGHT] } else { &[] };
    let of_model = of_model.iter().map(|name| (*name).to_owned());
    let names: Vec<String> = of_model.chain(keys.iter().cloned()).chain(of_lists).collect();
    let mut text = names.join(",") + "\n";
    for Believed { model, share, samples } in believed {
        let weight = json!(share / samples.len() as f64).to_string();
        for LearntSample { sample, values } in samples {
            let wrong = sample.soil.discrepancy.unwrap_or(Discrepancy::NONE);
            let wrong = lists.iter().flat_map(|(_, _, of)| of(&wrong));
            let mut cells: Vec<String> =
                values.iter().chain(wrong).map(|value| json!(value).to_string()).collect();
            if believed.len() > 1 {
                cells.splice(0..0, [model.name().to_owned(), weight.clone()]);
            }
            text += &(cells.join(",") + "\n");
        }
    }
    text
}
