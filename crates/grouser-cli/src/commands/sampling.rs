//! Samples of what is uncertain, for all commands that give bands.

use grouser::answers::Sampling;
use grouser::document::LoadedScenario;
use grouser::document::gradient::GradientKeys;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::verdict::Rule;
use serde_json::json;

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
pub(crate) fn draw_if_uncertain(
    scenario: &LoadedScenario,
    count: u32,
    seed: u64,
) -> Result<Vec<Sample>, Failure> {
    Ok(Sampling { count, seed }.draw_if_uncertain(&BandInputs::of_scenario(scenario))?)
}

/// Whether verdicts over so many samples may move.
pub(crate) fn are_few(Sampling { count, .. }: Sampling) -> bool {
    /// Enough samples: with so many the 95 % interval of a share of .2 is .13 to .29.
    const ENOUGH: u32 = 100;
    count < ENOUGH
}

/// What is said of few samples.
pub(crate) const DRAFT_LINE: &str = "a draft of few samples, whose verdicts may move: --samples 200 has those of the operator's card\n";

/// The key of what is believed of the soil.
pub(super) const BELIEF: &str = "belief";

/// The key of the models of a band with their shares.
pub(super) const WEIGHTS: &str = "model_weights";

/// Computes with a bar that goes on with every sample. The study asks whether to go on, and is
/// never stopped: Ctrl-C ends the program.
pub(crate) fn with_bar<T>(
    samples: usize,
    compute: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T,
) -> T {
    with_bar_of("samples", samples, compute)
}

/// Computes with a bar that counts `what`.
pub(crate) fn with_bar_of<T>(
    what: &'static str,
    samples: usize,
    compute: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T,
) -> T {
    if samples == 0 {
        return compute(&|| true);
    }
    let bar = output::progress_bar(samples as u64);
    bar.set_message(what);
    let found = compute(&|| {
        // What comes after the samples is asked for, too, and is little.
        bar.set_position((bar.position() + 1).min(samples as u64));
        true
    });
    bar.finish_and_clear();
    found
}

/// The noun that a bar counts: `these` where derivatives are asked for, samples otherwise.
pub(crate) fn what(gradients: Option<&GradientKeys>, these: &'static str) -> &'static str {
    if gradients.is_some() { these } else { "samples" }
}

/// The flags that ask for the same samples again, after a blank; nothing where none are asked for.
pub(crate) fn flags(sampling: Option<Sampling>) -> String {
    sampling.map_or(String::new(), |sampling| " --uncertainty".to_owned() + &numbers(sampling))
}

/// The flag of the numbers that results are differentiated by, after a blank.
pub(crate) fn gradient_flag(keys: Option<&GradientKeys>) -> String {
    keys.map_or(String::new(), |keys| format!(" --gradients {}", keys.names().join(",")))
}

/// The flags of the number of samples and of their seed, after a blank.
pub(crate) fn numbers(Sampling { count, seed }: Sampling) -> String {
    format!(" --samples {count} --seed {seed}")
}

/// The flags of a rule that is not the usual one, after a blank each.
pub(crate) fn rule_flags(rule: &Rule) -> String {
    let (own, usual) = (json!(rule), json!(Rule::DEFAULT));
    let entries = own.as_object().into_iter().flatten();
    let changed = entries.filter(|(key, value)| usual.get(key) != Some(value));
    changed.map(|(key, value)| format!(" --{} {value}", key.replace('_', "-"))).collect()
}

/// The result of a study that was not stopped.
pub(crate) fn whole<T>(found: Option<T>) -> T {
    found.unwrap_or_else(|| unreachable!("it was not stopped"))
}
