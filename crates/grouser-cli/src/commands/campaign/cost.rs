//! `grouser campaign cost`: estimates time and disk space of studies, measured on one thread of
//! this machine.

use std::time::{Duration, Instant};

use grouser::document::Campaign;
use grouser::document::reading::four_digits;
use grouser_store::shard_bytes;
use rayon::ThreadPoolBuilder;
use serde::Serialize;
use serde_json::json;

use super::campaign;
use crate::args::{CampaignCostArgs, TableOrJson};
use crate::commands::Answer;
use crate::failure::Failure;
use crate::output;

/// What was measured of a study, and what it means for as many runs as were asked about.
#[derive(Serialize)]
struct CostRecord {
    study: String,
    /// Runs with their way into a file, on one thread [1/s].
    runs_per_core_s: f64,
    bytes_per_run: f64,
    shard_runs: u64,
    core_hours: f64,
    gigabytes: f64,
    shards: u64,
}

pub(super) fn run(args: &CampaignCostArgs) -> Result<(), Failure> {
    let each = Duration::from_secs_f64(args.seconds / args.studies.len().max(1) as f64);
    let bar = output::progress_bar(args.studies.len() as u64);
    bar.set_message("measuring");
    let mut rows = Vec::new();
    for study in &args.studies {
        rows.push(cost(study, &campaign(study, &[])?, args.runs, each)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    match args.format {
        TableOrJson::Table => output::show(table(&rows, args.runs)),
        TableOrJson::Json => {
            let asked = json!({ "runs": args.runs, "seconds": args.seconds });
            output::print_json(&Answer::new("campaign.cost", asked, json!({ "rows": rows })))
        }
    }
}

/// Computes one shard after another for as long as there is time, at least one; the quickest
/// counts: whatever else the machine does only takes time.
///
/// * `study`: how it was asked for
fn cost(
    study: &str,
    campaign: &Campaign,
    runs: u64,
    time: Duration,
) -> Result<CostRecord, Failure> {
    let one = ThreadPoolBuilder::new().num_threads(1).build();
    let one = one.map_err(|error| Failure::Run(format!("cannot start a thread: {error}")))?;
    let (mut done, mut bytes, mut shard, start) = (0, 0, 0, Instant::now());
    let mut runs_per_core_s: f64 = 0.0;
    while done == 0 || start.elapsed() < time {
        let before = Instant::now();
        let file = one.install(|| shard_bytes(campaign, shard, &|| true))?;
        let range = campaign.runs_of(shard);
        let count = range.end - range.start;
        runs_per_core_s = runs_per_core_s.max(count as f64 / before.elapsed().as_secs_f64());
        bytes += file.map_or(0, |file| file.len());
        done += count;
        shard = (shard + 1) % campaign.shards();
    }
    let bytes_per_run = bytes as f64 / done as f64;
    Ok(CostRecord {
        study: study.to_owned(),
        runs_per_core_s,
        bytes_per_run,
        shard_runs: campaign.shard_runs(),
        core_hours: runs as f64 / runs_per_core_s / 3600.0,
        gigabytes: runs as f64 * bytes_per_run / 1e9,
        shards: runs.div_ceil(campaign.shard_runs()),
    })
}

fn table(rows: &[CostRecord], runs: u64) -> String {
    let header = format!(
        "| study | runs per core and second | bytes per run | core-hours for {:e} runs | GB | shards |\n\
         |---|---|---|---|---|---|\n",
        runs as f64
    );
    let line = |row: &CostRecord| {
        let numbers = [row.runs_per_core_s, row.bytes_per_run, row.core_hours, row.gigabytes];
        let [rate, bytes, hours, gigabytes] = numbers.map(four_digits);
        let CostRecord { study, shards, shard_runs, .. } = row;
        format!(
            "| {study} | {rate} | {bytes} | {hours} | {gigabytes} | {shards} of {shard_runs} runs |\n"
        )
    };
    std::iter::once(header).chain(rows.iter().map(line)).collect()
}
