//! `grouser campaign digest`: prints the SHA-256 over all results.

use grouser_store::{Finished, Results};
use serde::Serialize;

use super::inputs;
use crate::args::{CampaignDigestArgs, TableOrJson};
use crate::commands::Answer;
use crate::failure::Failure;
use crate::output;

/// What identifies results.
#[derive(Serialize)]
pub(super) struct DigestRecord {
    digest: String,
    shards: u64,
    bytes: u64,
}

impl From<Finished> for DigestRecord {
    fn from(finished: Finished) -> Self {
        let Finished { digest, shards, bytes } = finished;
        Self { digest, shards, bytes }
    }
}

impl DigestRecord {
    /// For people.
    pub(super) fn line(&self) -> String {
        let Self { digest, shards, bytes } = self;
        let bytes = *bytes as f64;
        let size = if bytes < 1e6 {
            format!("{:.0} kB", bytes / 1e3)
        } else {
            format!("{:.1} MB", bytes / 1e6)
        };
        let files = if *shards == 1 { "file" } else { "files" };
        format!("{shards} {files}, {size}, SHA-256 {digest}\n")
    }
}

pub(super) fn run(args: &CampaignDigestArgs) -> Result<(), Failure> {
    let results = Results::open(&args.folder)?;
    let record = DigestRecord::from(results.digest()?);
    match args.format {
        TableOrJson::Table => output::show(record.line()),
        TableOrJson::Json => {
            output::print_json(&Answer::new("campaign.digest", inputs(&results), record))
        }
    }
}
