//! `grouser validate`: errors of a wheel–soil model against measured wheel tests or a rover on
//! slopes, or a ranking of all models on these or on recorded drives.

use std::path::Path;

pub(crate) use grouser::answers::validation::figures;
use grouser::answers::validation::ranked;
use grouser::answers::{Answer, AnswerOptions};
use grouser::document::measurements::Limits;
use grouser::document::ranking::{Ranking, RankingError, rank_all, rank_one};
use grouser::document::{Kind, preset};

use crate::args::ValidateArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output;
use crate::output::answer::{give, text};
use crate::output::folder::OutputFolder;

/// The name that the schema of all its answers has.
const COMMAND: &str = "validate";

impl From<RankingError> for Failure {
    fn from(error: RankingError) -> Self {
        match error {
            RankingError::Document(error) => error.into(),
            RankingError::Measurements(error) => error.into(),
            RankingError::Rover(error) => error.into(),
            RankingError::Unreadable { folder, error } => {
                Self::at("cannot look into", &folder)(error)
            }
            RankingError::NoDataSet { .. } => Self::Usage(format!(
                "{error}\nhint: docs/guide/data.md explains how a document describes a data set; \
                 without --data-dir those that come with the program are ranked"
            )),
            RankingError::NoSuchFolder(_) | RankingError::NoSuchFile { .. } => {
                Self::Usage(error.to_string())
            }
        }
    }
}

pub(crate) fn run(args: &ValidateArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    if let Some(drives) = &args.drives {
        return recorded(args, folder, drives);
    }
    match (&args.data, &args.wheel, &args.rover, &args.soil) {
        (Some(data), Some(wheel), None, Some(soil)) => one(args, folder, data, wheel, soil),
        (Some(data), None, Some(rover), Some(soil)) => slopes(args, folder, data, rover, soil),
        (Some(data), ..) => {
            let set = inputs::ranked_data_set(args, data)?;
            ranking(args, folder, &rank_one(&set, args.read.limits())?)
        }
        // The parser of the command line asks for data, or for --all.
        (None, ..) => {
            ranking(args, folder, &rank_all(args.data_dir.as_deref(), args.read.limits())?)
        }
    }
}

/// One model with one soil on one file.
fn one(
    args: &ValidateArgs,
    folder: Option<OutputFolder>,
    data: &Path,
    wheel: &str,
    soil: &str,
) -> Result<(), Failure> {
    let question = inputs::validation(args, data, wheel, soil)?;
    output::notes(&question.measured.notes);
    let answer = question.answer(COMMAND, &options(args, folder.is_some()))?;
    // Rows of several wheels are chosen by the wheel's name.
    let is_preset = preset(Kind::Wheel, wheel).is_some();
    let wheel = if is_preset { quoted(wheel) } else { "wheel.toml".to_owned() };
    let settings = args.setting.settings.iter().filter(|it| is_preset && is_of_wheel(it));
    let settings: String = settings.map(|it| format!(" --set {}", quoted(it))).collect();
    let (read, model, gravity) = (reading(args, data), question.model.name(), question.gravity);
    let repeat = format!(
        "grouser validate {read} --wheel {wheel}{settings} --soil soil.toml --model {model} \
         --gravity-m-s2 {gravity}"
    );
    give(&answer, &repeat, folder, args.output.format)
}

/// One model with one soil and one rover on one file.
fn slopes(
    args: &ValidateArgs,
    mut folder: Option<OutputFolder>,
    data: &Path,
    rover: &String,
    soil: &String,
) -> Result<(), Failure> {
    let question = inputs::slope_validation(args, data, rover, soil)?;
    output::notes(&question.tests.notes);
    let answer = question.answer(COMMAND, &options(args, folder.is_some()))?;
    add_text(folder.as_mut(), &answer);
    let read = reading(args, data);
    let repeat = format!("grouser validate {read}{}", flags_of_scenario(args));
    give(&answer, &repeat, folder, args.output.format)
}

/// Every model on recorded drives, or on a data set of slopes, which are drives in few numbers.
fn recorded(
    args: &ValidateArgs,
    mut folder: Option<OutputFolder>,
    drives: &Path,
) -> Result<(), Failure> {
    if drives.to_str().is_some_and(|name| preset(Kind::DataSet, name).is_some()) {
        let set = inputs::ranked_data_set(args, drives)?;
        return ranking(args, folder, &rank_one(&set, args.read.limits())?);
    }
    let (question, share_used) = inputs::drive_validation(args, drives)?;
    let answer = question.answer(COMMAND)?;
    add_text(folder.as_mut(), &answer);
    let file = drives.file_name().unwrap_or(drives.as_os_str()).to_string_lossy();
    let mapping = args.telemetry.log.mapping.iter();
    let mapping: String =
        mapping.map(|it| format!(" --mapping {}", quoted(&it.to_string_lossy()))).collect();
    let (odometry, flags) = (args.telemetry.odometry_option(), flags_of_scenario(args));
    let repeat = format!("grouser validate --drives {}{mapping}{odometry}{flags}", quoted(&file));
    give(&answer, &repeat, folder, args.output.format)?;
    inputs::check_share_used(&file, share_used, &args.telemetry.log)
}

/// The rover, the soil and what is set of them, as flags.
fn flags_of_scenario(args: &ValidateArgs) -> String {
    let parts = [("--rover", &args.rover), ("--soil", &args.soil)];
    let parts = parts.into_iter().filter_map(|(flag, it)| Some((flag, it.as_ref()?)));
    let settings = args.setting.settings.iter().map(|it| ("--set", it));
    let model = args.setting.model.iter().map(|it| ("--model", it));
    let gravity = args.setting.gravity.iter().map(|it| ("--gravity-m-s2", it));
    let flags = parts.chain(settings).chain(model).chain(gravity);
    flags.map(|(flag, it)| format!(" {flag} {}", quoted(it))).collect()
}

/// Every model on some data sets.
fn ranking(
    args: &ValidateArgs,
    mut folder: Option<OutputFolder>,
    ranking: &Ranking,
) -> Result<(), Failure> {
    let answer = ranked(COMMAND, ranking, &options(args, folder.is_some()));
    add_text(folder.as_mut(), &answer);
    let sets = match (args.data.as_ref().or(args.drives.as_ref()), &args.data_dir) {
        (Some(data), _) => reading(args, data),
        (None, Some(folder)) => {
            format!("--all --data-dir {}{}", quoted(&folder.to_string_lossy()), most_rows(args))
        }
        (None, None) => format!("--all{}", most_rows(args)),
    };
    give(&answer, &format!("grouser validate {sets}"), folder, args.output.format)
}

fn options(args: &ValidateArgs, has_page: bool) -> AnswerOptions<'static> {
    AnswerOptions { has_page, is_strict: args.strict, ..AnswerOptions::ROWS }
}

/// Adds what is printed for reading to a folder.
fn add_text(folder: Option<&mut OutputFolder>, answer: &Answer) {
    if let Some(folder) = folder {
        folder.add(format!("{}.txt", answer.name), text(answer).to_string());
    }
}

/// The measurements, and which of their rows are read, as flags. A file is looked for in the folder
/// of the page.
fn reading(args: &ValidateArgs, data: &Path) -> String {
    let file = data.file_name().unwrap_or(data.as_os_str()).to_string_lossy();
    let conditions =
        args.conditions.iter().map(|it| format!(" --where {}", quoted(&it.to_string())));
    format!("--data {}{}{}", quoted(&file), conditions.collect::<String>(), most_rows(args))
}

/// The limit on rows as a flag, if it is not the usual one.
fn most_rows(args: &ValidateArgs) -> String {
    let most = args.read.max_rows;
    if most == Limits::ROWS { String::new() } else { format!(" --max-rows {most}") }
}

/// Whether a setting is of the wheel's document.
fn is_of_wheel(setting: &str) -> bool {
    setting.trim_start().starts_with("wheel")
}

/// A word of a command, in quotes where a shell would read it otherwise.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./=,:+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
