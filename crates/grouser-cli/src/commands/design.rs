//! `grouser design`: numbers of a rover that are the best under limits.

use grouser::answers::AnswerOptions;
use grouser::answers::design::DesignQuestion;
use grouser::document::{self, Kind, Overrides, Source};

use crate::args::DesignArgs;
use crate::failure::Failure;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;

pub(crate) fn run(args: &DesignArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let mut overrides = Overrides::parse_flags("--set", &args.setting.settings)?;
    overrides.check_kinds(&[Kind::Design, Kind::Rover, Kind::Soil, Kind::Wheel, Kind::Motor])?;
    for (flag, key, value) in [
        ("--model", "design.model", &args.setting.model),
        ("--gravity-m-s2", "design.gravity_m_s2", &args.setting.gravity),
    ] {
        if let Some(value) = value {
            overrides.flag(flag, key, value)?;
        }
    }
    let source = Source::find(Kind::Design, &args.design)?;
    let question = DesignQuestion { task: document::read_design(&source, &overrides)? };
    let options = AnswerOptions { has_page: folder.is_some(), ..AnswerOptions::ROWS };
    let mut answer = question.answer("design", &options)?;
    answer.next = vec!["grouser heading --rover rover.toml --nominal".to_owned()];
    give(&answer, "grouser design design.toml", folder, args.output.format)
}
