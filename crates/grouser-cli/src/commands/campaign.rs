//! `grouser campaign`: many runs over what is not known exactly.

mod cost;
mod digest;
mod merge;
mod progress;
mod python;
mod rerun;
mod run;
mod summarise;

use std::path::Path;

use grouser::document::{self, Campaign, Kind, Overrides, Source};
use grouser_store::{Results, StoreError, Study};
use serde_json::{Value, json};

use crate::args::{CampaignArgs, CampaignCommand};
use crate::failure::Failure;

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
            error if error.is_environment() => Self::Run(error.to_string()),
            error => Self::Usage(error.to_string()),
        }
    }
}

/// The campaign of an argument.
fn campaign(study: &str, settings: &[String]) -> Result<Campaign, Failure> {
    let source = Source::find(Kind::Campaign, study)
        .map_err(|error| error.in_argument(format!("campaign {}", study.escape_debug())))?;
    Ok(document::read_campaign(&source, &Overrides::parse_flags("--set", settings)?)?)
}

/// The results in a folder and the campaign that they are of.
fn stored(folder: &Path) -> Result<(Results, Campaign), Failure> {
    let results = Results::open(folder)?;
    let source = Source::file(results.study_file());
    let campaign = document::read_campaign(&source, &Overrides::none())?;
    let (theirs, ours) = (&results.manifest().version, env!("CARGO_PKG_VERSION"));
    if theirs != ours {
        return Err(Failure::Usage(format!(
            "the folder {} was computed by grouser {theirs}, this is {ours}: its numbers may differ",
            folder.display()
        )));
    }
    if Study::of(&campaign).hash() != results.manifest().study_sha256 {
        return Err(Failure::Usage(format!(
            "{} is not the study that the folder's runs are of: it was changed",
            results.study_file().display()
        )));
    }
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
