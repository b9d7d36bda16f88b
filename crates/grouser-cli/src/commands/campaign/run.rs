//! `grouser campaign run`: computes all missing runs of a campaign.

use std::collections::BTreeMap;

use grouser::document::Campaign;
use grouser::document::campaign::FAILED;
use grouser::document::table::Values;
use grouser_store::{Folder, Results, Study, compute};
use indicatif::ProgressBar;
use serde::Serialize;

use super::digest::DigestRecord;
use super::progress::Progress;
use super::{campaign, inputs, python};
use crate::args::{CampaignRunArgs, ExecutorChoice, TableOrJson};
use crate::commands::Answer;
use crate::failure::Failure;
use crate::{interrupt, output};

/// What a campaign comes to.
#[derive(Serialize)]
struct RunRecord {
    /// Whether all runs were there before.
    finished_before: bool,
    #[serde(flatten)]
    digest: DigestRecord,
    /// How often each status is.
    statuses: BTreeMap<String, u64>,
    runs_per_s: Option<f64>,
}

pub(super) fn run(args: &CampaignRunArgs) -> Result<(), Failure> {
    let campaign = campaign(&args.study, &args.settings)?;
    if args.executor != ExecutorChoice::Threads {
        return python::hand_over(args);
    }
    if args.scheduler.is_some() {
        return Err(Failure::Usage("--scheduler: it goes with --executor dask or ray".into()));
    }
    if let Some(threads) = args.threads {
        // It fails only if there is a pool already, and nothing made one yet.
        drop(rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global());
    }
    let mut folder = open(args, &Study::of(&campaign))?;
    tell_surprises(&folder);
    tell_of_many_files(&campaign, &folder);
    let finished_before = folder.missing().is_empty();
    let progress = Progress::new(args.format, &folder);
    if !finished_before {
        interrupt::handle_ctrl_c();
        compute_missing(&campaign, &mut folder, &progress)?;
    }
    let runs_per_s = progress.rate(&folder);
    let (digest, statuses) = read_once(&mut folder)?;
    let results = Results::open(&args.out)?;
    finish(args, &results, RunRecord { finished_before, digest, statuses, runs_per_s })
}

/// Opens the folder, and checks all files in it, with a progress bar.
fn open(args: &CampaignRunArgs, study: &Study) -> Result<Folder, Failure> {
    let _deferred = interrupt::defer_ctrl_c();
    let mut bar = None;
    let folder = Folder::open_watched(&args.out, study, args.shard, &mut |done, all| {
        let bar =
            bar.get_or_insert_with(|| output::progress_bar(all).with_message("shards checked"));
        bar.set_position(done);
    });
    bar.inspect(ProgressBar::finish_and_clear);
    Ok(folder?)
}

/// More files than disks and their tools like.
fn tell_of_many_files(campaign: &Campaign, folder: &Folder) {
    const MANY: u64 = 1_000_000;
    let shards = folder.missing().len();
    if shards > MANY {
        output::message(&format!(
            "note: {shards} files of {} runs each will be written; `shard_runs`, up to 1000000, \
             makes them fewer and larger, and --shard I/N splits them over N folders",
            campaign.shard_runs()
        ));
    }
}

fn tell_surprises(folder: &Folder) {
    for name in folder.mended() {
        output::message(&format!(
            "note: {name} was damaged or of an earlier form, and is written anew"
        ));
    }
    for (shard, fault) in folder.faults() {
        output::message(&format!("note: shard {shard} is computed anew: {fault}"));
    }
    if !folder.is_locked() {
        output::message(
            "note: this disk has no locks: make sure that no second campaign writes to the folder",
        );
    }
    if folder.runs_done() > 0 && !folder.missing().is_empty() {
        output::message(&format!(
            "going on: {} of {} runs are there",
            folder.runs_done(),
            folder.runs()
        ));
    }
}

/// Computes what is missing, until Ctrl-C or the disk stops it.
fn compute_missing(
    campaign: &Campaign,
    folder: &mut Folder,
    progress: &Progress,
) -> Result<(), Failure> {
    let go_on = || {
        progress.start();
        !interrupt::is_asked_to_stop()
    };
    let mut reported = None;
    progress.report(folder, &mut reported)?;
    let done = compute(campaign, folder, &go_on, |folder, shard, bytes| {
        {
            let _deferred = interrupt::defer_ctrl_c();
            folder.accept(shard, bytes)?;
        }
        progress.report(folder, &mut reported)
    });
    progress.end();
    if done.is_err() {
        // The disk may be full: when the session ended is not worth a second message.
        drop(folder.pause());
        return done;
    }
    if interrupt::is_asked_to_stop() && !folder.missing().is_empty() {
        folder.pause()?;
        return Err(Failure::Interrupted(format!(
            "{} of {} runs are kept; the same command goes on",
            folder.runs_done(),
            folder.runs()
        )));
    }
    Ok(())
}

/// The digest and the counts of statuses: both from one reading of all files.
fn read_once(folder: &mut Folder) -> Result<(DigestRecord, BTreeMap<String, u64>), Failure> {
    let mut counts = BTreeMap::new();
    let bar = output::progress_bar(folder.manifest().own_count());
    bar.set_message("shards read for the digest");
    let finished = folder.finish_reading(&["status"], &mut |_, table| {
        bar.inc(1);
        for (_, values) in table.columns {
            let Values::Text(words) = values else { continue };
            for word in words.into_iter().flatten() {
                *counts.entry(word).or_default() += 1;
            }
        }
    });
    bar.finish_and_clear();
    Ok((finished?.into(), counts))
}

fn finish(args: &CampaignRunArgs, results: &Results, record: RunRecord) -> Result<(), Failure> {
    let all: u64 = record.statuses.values().sum();
    let failed: u64 = FAILED.iter().filter_map(|word| record.statuses.get(*word)).sum();
    match args.format {
        TableOrJson::Table => output::show(text_of(args, &record, all))?,
        TableOrJson::Json => {
            let answer = Answer::new("campaign.run", inputs(results), record);
            output::print(&answer.to_line())?;
        }
    }
    if failed == 0 {
        return Ok(());
    }
    Err(Failure::Partly(format!("{failed} of {all} runs failed; the column `reason` says why")))
}

fn text_of(args: &CampaignRunArgs, record: &RunRecord, all: u64) -> String {
    let folder = args.out.display();
    let first = match (record.finished_before, record.runs_per_s) {
        (true, _) => format!("{folder} is finished, there is nothing to do: {all} runs"),
        (false, Some(rate)) => format!("{folder} is finished: {all} runs, {rate:.0} per second"),
        (false, None) => format!("{folder} is finished: {all} runs"),
    };
    let statuses = record.statuses.iter().map(|(word, count)| format!("{word}: {count}"));
    let statuses = statuses.collect::<Vec<_>>().join(", ");
    format!("{first}\n{statuses}\n{}", record.digest.line())
}
