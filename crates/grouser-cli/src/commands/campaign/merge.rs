//! `grouser campaign merge`: merges the parts of an array of jobs into one folder.

use grouser_store::{Results, Study};

use super::digest::DigestRecord;
use super::{inputs, stored};
use crate::args::{CampaignMergeArgs, TableOrJson};
use crate::commands::Answer;
use crate::failure::Failure;
use crate::output;

pub(super) fn run(args: &CampaignMergeArgs) -> Result<(), Failure> {
    let Some(first) = args.folders.first() else { return Ok(()) };
    let (_, campaign) = stored(first)?;
    let study = Study::of(&campaign);
    let bar = output::progress_bar(study.shards());
    bar.set_message("shards");
    // Ctrl-C at any moment leaves a folder that the same command goes on with.
    let merged = grouser_store::merge(&args.out, &study, &args.folders, &mut |done, _| {
        bar.set_position(done);
    });
    bar.finish_and_clear();
    let record = DigestRecord::from(merged?);
    match args.format {
        TableOrJson::Table => output::show(record.line()),
        TableOrJson::Json => {
            let results = Results::open(&args.out)?;
            output::print_json(&Answer::new("campaign.merge", inputs(&results), record))
        }
    }
}
