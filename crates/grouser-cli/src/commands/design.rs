//! `grouser design`: numbers of a rover that are the best under limits.

use std::sync::atomic::{AtomicU64, Ordering};

use grouser::answers::AnswerOptions;
use grouser::answers::design::DesignQuestion;
use grouser::document::LoadedDesign;
use grouser::document::design::Measure;

use crate::args::{DesignArgs, SettingArgs};
use crate::failure::Failure;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;
use crate::{inputs, output};

pub(crate) fn run(args: &DesignArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let trade = match args.trade[..] {
        [] => None,
        [one, other] if one != other => Some([one, other]),
        _ => return Err(Failure::Usage(format!("--trade takes two measures, such as {EXAMPLE}"))),
    };
    let (task, by_models) = tasks(args)?;
    let (is_nominal, seed) = (args.nominal, args.seed.unwrap_or(1));
    let question = DesignQuestion { task, is_nominal, seed, trade, by_models };
    let mut answer = with_count(|go_on| {
        let (has_page, is_strict) = (folder.is_some(), args.strict.strict);
        question.answer("design", &AnswerOptions { has_page, is_strict, go_on })
    })?;
    answer.next = vec!["grouser heading --rover rover.toml".to_owned()];
    give(&answer, &repeat(args), folder, args.output.format)
}

/// Searches with a line that counts the designs that were measured: nobody knows how many it takes.
/// Ctrl-C ends the program.
fn with_count<T>(search: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T) -> T {
    let (line, count) = (output::waiting_line("designs measured"), AtomicU64::new(0));
    let found = search(&|| {
        let count = count.fetch_add(1, Ordering::Relaxed) + 1;
        line.set_message(format!("{count} designs measured"));
        true
    });
    line.finish_and_clear();
    found
}

/// Two measures that may be traded.
const EXAMPLE: &str = "energy_j_per_m,wheel_mass_kg";

/// The task, and the same by every other model where all are asked for.
fn tasks(args: &DesignArgs) -> Result<(LoadedDesign, Vec<LoadedDesign>), Failure> {
    if !args.setting.has_every_model() {
        return Ok((inputs::design(args, &args.setting)?, Vec::new()));
    }
    let own = inputs::design(args, &SettingArgs { model: None, ..args.setting.clone() })?;
    let is_own =
        |setting: &SettingArgs| setting.model.as_deref() == Some(own.value.model(0).name());
    let others = args.setting.each_model().into_iter().filter(|setting| !is_own(setting));
    let others = others.map(|setting| inputs::design(args, &setting)).collect::<Result<_, _>>()?;
    Ok((own, others))
}

/// The command that gives the answer again, from the document in the folder.
fn repeat(args: &DesignArgs) -> String {
    let trade: Vec<&str> = args.trade.iter().copied().map(Measure::name).collect();
    let trade =
        if trade.is_empty() { String::new() } else { format!(" --trade {}", trade.join(",")) };
    let nominal = if args.nominal { " --nominal" } else { "" };
    let seed = args.seed.map_or_else(String::new, |seed| format!(" --seed {seed}"));
    let model = if args.setting.has_every_model() { " --model all" } else { "" };
    format!("grouser design design.toml{trade}{nominal}{seed}{model}")
}
