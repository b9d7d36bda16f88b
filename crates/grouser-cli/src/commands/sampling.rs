//! Samples of what is uncertain, for all commands that give bands.

use grouser::studies::ensemble::samples::{BandInputs, Sample};
use serde_json::{Map, Value, json};

use crate::args::UncertaintyArgs;
use crate::failure::Failure;
use crate::output;

/// The samples.
pub(crate) fn draw(inputs: &BandInputs, samples: u32, seed: u64) -> Result<Vec<Sample>, Failure> {
    inputs.samples(seed, samples).map_err(|error| {
        Failure::Usage(format!(
            "the soil's uncertainty reaches too far: {error}\nhint: smaller standard deviations \
             keep the samples within the ranges of their keys"
        ))
    })
}

/// The key of [`weights`].
pub(super) const WEIGHTS: &str = "model_weights";

/// The models of the samples, each with its share [-].
pub(super) fn weights(inputs: &BandInputs) -> Value {
    let pair =
        |(model, share): &(grouser::contact::Model, f64)| (model.name().to_owned(), json!(share));
    Value::Object(inputs.models().shares().iter().map(pair).collect::<Map<_, _>>())
}

/// The weights of several scenarios, in their order; one object where all are alike.
pub(super) fn one_or_each(mut weights: Vec<Value>) -> Value {
    match weights.pop() {
        Some(last) if weights.iter().all(|it| *it == last) => last,
        Some(last) => weights.into_iter().chain([last]).collect(),
        None => Value::Null,
    }
}

/// The models of the samples with their shares, as a line to read; nothing where there is one
/// alone.
pub(super) fn line(inputs: &BandInputs) -> String {
    if inputs.models().shares().len() < 2 {
        return String::new();
    }
    let mut shares = inputs.models().shares().to_vec();
    shares.sort_by(|one, other| other.1.total_cmp(&one.1));
    let share = |(model, share): &(grouser::contact::Model, f64)| {
        format!("{} {:.0} %", model.name(), 100.0 * share)
    };
    let shares: Vec<String> = shares.iter().map(share).collect();
    format!("models of the samples: {}\n", shares.join(", "))
}

/// Computes with a bar that goes on with every sample. The study asks whether to go on, and is
/// never stopped: Ctrl-C ends the program.
pub(super) fn with_bar<T>(
    samples: usize,
    compute: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T,
) -> T {
    let bar = output::progress_bar(samples as u64);
    bar.set_message("samples");
    let found = compute(&|| {
        bar.inc(1);
        true
    });
    bar.finish_and_clear();
    found
}

/// The flags that ask for the same samples again, after a blank; nothing where none are asked for.
pub(super) fn flags(args: &UncertaintyArgs) -> String {
    let UncertaintyArgs { sampling, seed } = args;
    if !sampling.uncertainty {
        return String::new();
    }
    format!(" --uncertainty --samples {} --seed {seed}", sampling.samples)
}

/// The result of a study that was not stopped.
pub(super) fn whole<T>(found: Option<T>) -> T {
    found.unwrap_or_else(|| unreachable!("it was not stopped"))
}
