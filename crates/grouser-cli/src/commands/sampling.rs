//! Samples of what is uncertain, for all commands that give bands.

use grouser::answers::Sampling;
use grouser::document::LoadedScenario;
use grouser::studies::ensemble::samples::{BandInputs, Sample};

use crate::failure::Failure;
use crate::output;

/// The samples.
pub(crate) fn draw(inputs: &BandInputs, samples: u32, seed: u64) -> Result<Vec<Sample>, Failure> {
    Ok(inputs.samples(seed, samples)?)
}

/// The samples of a scenario's soil and model.
pub(crate) fn draw_of(scenario: &LoadedScenario, of: Sampling) -> Result<Vec<Sample>, Failure> {
    Ok(of.draw(&BandInputs::of_scenario(scenario))?)
}

/// The samples of a scenario's soil and model; none where one soil and one model are all there is.
pub(super) fn draw_if_uncertain(
    scenario: &LoadedScenario,
    samples: u32,
    seed: u64,
) -> Result<Vec<Sample>, Failure> {
    let inputs = BandInputs::of_scenario(scenario);
    if inputs.is_certain() { Ok(Vec::new()) } else { draw(&inputs, samples, seed) }
}

/// The key of the models of a band with their shares.
pub(super) const WEIGHTS: &str = "model_weights";

/// Computes with a bar that goes on with every sample. The study asks whether to go on, and is
/// never stopped: Ctrl-C ends the program.
pub(super) fn with_bar<T>(
    samples: usize,
    compute: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T,
) -> T {
    if samples == 0 {
        return compute(&|| true);
    }
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
pub(super) fn flags(sampling: Option<Sampling>) -> String {
    sampling.map_or(String::new(), |Sampling { count, seed }| {
        format!(" --uncertainty --samples {count} --seed {seed}")
    })
}

/// The result of a study that was not stopped.
pub(super) fn whole<T>(found: Option<T>) -> T {
    found.unwrap_or_else(|| unreachable!("it was not stopped"))
}
