//! `grouser campaign`: Monte Carlo campaigns, which sample uncertain inputs, run, and summarise.

mod cost;
mod digest;
mod merge;
mod progress;
mod python;
mod rerun;
mod run;
mod summarise;

use std::path::Path;

use grouser::document::given_file::GivenFile;
use grouser::document::{self, Campaign, Kind, Overrides, Source, escape};
use grouser_store::{Results, StoreError, Study};
use serde_json::{Value, json};

use crate::args::{CampaignArgs, CampaignCommand};
use crate::failure::Failure;
use crate::output;

pub(crate) fn run(args: &CampaignArgs) -> Result<(), Failure> {
    match &args.command {
        CampaignCommand::Run(args) => run::run(args),
        CampaignCommand::Rerun(args) => rerun::run(args),
        CampaignCommand::Merge(args) => merge::run(args),
        CampaignCommand::Summarise(args) => summarise::run(args),
        CampaignCommand::Digest(args) => digest::run(args),
        CampaignCommand::Cost(args) => cost::run(args),
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Disk { operation, path, source } => {
                Self::at(&format!("cannot {operation}"), &path)(source)
            }
            error if error.is_environment() => Self::Run(with_command(&error)),
            error => Self::Usage(error.to_string()),
        }
    }
}

/// What is wrong with a folder and, where going on mends it, the command that does.
fn with_command(error: &StoreError) -> String {
    let Some(folder) = error.mendable_folder() else { return error.to_string() };
    // A folder whose study is damaged cannot say which it was.
    let study = match error {
        StoreError::StudyChanged(_) => "STUDY".to_owned(),
        _ => folder.join("study.toml").display().to_string(),
    };
    let part = Results::open(folder).ok().and_then(|results| results.manifest().part);
    let part = part.map_or(String::new(), |part| format!(" --shard {part}"));
    format!("{error}: `grouser campaign run {study} --out {}{part}`", folder.display())
}

/// The campaign of an argument.
fn campaign(study: &str, settings: &[String]) -> Result<Campaign, Failure> {
    let source = Source::find(Kind::Campaign, study)
        .map_err(|error| error.in_argument(format!("campaign {}", study.escape_debug())))?;
    let overrides = Overrides::parse_flags("--set", settings)?;
    overrides.check_kinds(&[
        Kind::Campaign,
        Kind::Scenario,
        Kind::Rover,
        Kind::Soil,
        Kind::Wheel,
    ])?;
    let campaign = document::read_campaign(&source, &overrides)?;
    let files = campaign.files();
    let given = files.given.iter().map(GivenFile::sentence);
    output::notes(
        given.chain(files.notes.iter().cloned()).map(|it| escape::line(&it).into_owned()),
    );
    Ok(campaign)
}

/// The results in a folder and the campaign that they are of.
fn stored(folder: &Path) -> Result<(Results, Campaign), Failure> {
    let results = Results::open(folder)?;
    let source = Source::file(results.study_file());
    let campaign = document::read_campaign(&source, &Overrides::none())?;
    let (theirs, ours) = (&results.manifest().version, env!("CARGO_PKG_VERSION"));
    if theirs != ours {
        return Err(Failure::Usage(format!(
            "the folder {} was computed by grouser {theirs}, this is {ours}: its numbers may \
             differ",
            folder.display()
        )));
    }
    results.require_study(&Study::of(&campaign))?;
    Ok((results, campaign))
}

/// What an answer was made from.
fn inputs(results: &Results) -> Value {
    let manifest = results.manifest();
    json!({
        "study": manifest.name,
        "study_sha256": manifest.study_sha256,
        "seed": manifest.seed,
        "runs": manifest.runs,
        "part": manifest.part,
    })
}
