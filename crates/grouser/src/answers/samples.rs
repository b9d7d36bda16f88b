//! The samples of an answer with bands, and what it says of their models.

use serde_json::{Map, Value, json};

use super::Answer;
use crate::contact::Model;
use crate::document::LoadedScenario;
use crate::document::statistics::NothingAccepted;
use crate::studies::ensemble::samples::{BandInputs, Sample};

/// How many samples, and of which stream of random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// The number of samples.
    pub count: u32,
    /// The stream.
    pub seed: u64,
}

impl Sampling {
    /// Draws the samples of a scenario's soil and model; none where one soil and one model are all
    /// there is.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw).
    pub fn draw_if_uncertain(self, inputs: &BandInputs) -> Result<Vec<Sample>, NothingAccepted> {
        if inputs.is_certain() { Ok(Vec::new()) } else { self.draw(inputs) }
    }

    /// What is believed of a scenario's soil and model: name, number of samples, and the models with
    /// their shares.
    #[must_use]
    pub fn belief(self, scenario: &LoadedScenario) -> Value {
        let inputs = BandInputs::of_scenario(scenario);
        json!({
            "name": scenario.document.text("soil.name"),
            "samples": if inputs.is_certain() { 1 } else { self.count },
            "model_weights": weights(&inputs),
        })
    }

    /// Draws the samples.
    ///
    /// # Errors
    /// [`NothingAccepted`] if the soil's uncertainty reaches beyond the ranges of its keys.
    pub fn draw(self, inputs: &BandInputs) -> Result<Vec<Sample>, NothingAccepted> {
        inputs.samples(self.seed, self.count)
    }

    /// Adds the samples to the inputs of an answer.
    pub(super) fn state(self, answer: &mut Answer) {
        answer.input("samples", self.count);
        answer.input("seed", self.seed);
    }
}

/// The models of the samples, each with its share [-].
#[must_use]
pub fn weights(inputs: &BandInputs) -> Value {
    let pair = |(model, share): &(Model, f64)| (model.name().to_owned(), json!(share));
    Value::Object(inputs.models().shares().iter().map(pair).collect::<Map<_, _>>())
}

/// The models of the samples with their shares, as a line to read; nothing where there is one
/// alone.
pub(super) fn line(inputs: &BandInputs) -> String {
    if inputs.models().shares().len() < 2 {
        return String::new();
    }
    let mut shares = inputs.models().shares().to_vec();
    shares.sort_by(|one, other| other.1.total_cmp(&one.1));
    let share = |(model, share): &(Model, f64)| format!("{} {:.0} %", model.name(), 100.0 * share);
    let shares: Vec<String> = shares.iter().map(share).collect();
    format!("models of the samples: {}\n", shares.join(", "))
}

/// The weights of several scenarios, in their order; one object where all are alike.
pub(super) fn one_or_each(mut weights: Vec<Value>) -> Value {
    match weights.pop() {
        Some(last) if weights.iter().all(|it| *it == last) => last,
        Some(last) => weights.into_iter().chain([last]).collect(),
        None => Value::Null,
    }
}
