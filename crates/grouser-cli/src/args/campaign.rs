//! Arguments of `campaign`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, Subcommand, ValueEnum};
use grouser_store::Part;

use super::{OutputArgs, TableOrJson};

#[derive(Debug, Args)]
pub(crate) struct CampaignArgs {
    #[command(subcommand)]
    pub(crate) command: CampaignCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum CampaignCommand {
    /// Compute a campaign's runs, or those that are missing.
    Run(CampaignRunArgs),
    /// Compute one run again, and compare it with what is stored.
    Rerun(CampaignRerunArgs),
    /// Merge the parts of an array of jobs.
    Merge(CampaignMergeArgs),
    /// Statistics of all runs: quantiles, probabilities, convergence, sensitivities.
    Summarise(CampaignSummariseArgs),
    /// Print the SHA-256 over all results.
    Digest(CampaignDigestArgs),
    /// Measure what studies cost: runs per core and second, bytes per run, and the cost of many
    /// runs.
    Cost(CampaignCostArgs),
}

#[derive(Debug, Args)]
#[command(
    after_help = "The same command goes on with a campaign that was interrupted in any way. Exit \
                        codes: 0 all runs are there, 3 some of them failed (their rows say why), \
                        130 interrupted."
)]
pub(crate) struct CampaignRunArgs {
    /// The study: a campaign document's file or preset.
    #[arg(value_name = "STUDY", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) study: String,
    /// Folder for the results: a new one, or that of the same study.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Threads, or worker processes; without it as many as there are cores.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub(crate) threads: Option<u16>,
    /// Only part I of N of an array of jobs, counted from 1; `campaign merge` merges them.
    #[arg(long, value_name = "I/N", value_parser = parse_part)]
    pub(crate) shard: Option<Part>,
    /// Where runs are computed: threads of this program, or the Python package with its processes,
    /// Dask or Ray.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) executor: ExecutorChoice,
    /// Address of the cluster's scheduler, for `dask` and `ray`.
    #[arg(long, value_name = "ADDRESS")]
    pub(crate) scheduler: Option<String>,
    /// Override a key of the study, such as `campaign.runs=100`; can be repeated.
    #[arg(long = "set", value_name = "DOCUMENT.KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// `json`: a line of progress now and then, and one at the end.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

/// Where a campaign is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExecutorChoice {
    /// This program.
    #[default]
    Threads,
    /// Processes of this machine, by the Python package.
    Processes,
    /// Dask distributed, by the Python package.
    Dask,
    /// Ray, by the Python package.
    Ray,
}

fn parse_part(text: &str) -> Result<Part, String> {
    let numbers = text.split_once('/').and_then(|(index, of)| {
        Some(Part { index: index.trim().parse().ok()?, of: of.trim().parse().ok()? })
    });
    numbers
        .filter(|part| (1..=part.of).contains(&part.index))
        .ok_or_else(|| "it must be I/N with I from 1 to N, such as 2/8".to_owned())
}

#[derive(Debug, Args)]
pub(crate) struct CampaignRerunArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The run's number, from 0.
    #[arg(value_name = "RUN")]
    pub(crate) run: u64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignMergeArgs {
    /// Folder for all of it: a new one, or one that an earlier merge left unfinished.
    #[arg(value_name = "OUT")]
    pub(crate) out: PathBuf,
    /// The folders of the parts.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) folders: Vec<PathBuf>,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignSummariseArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignDigestArgs {
    /// A campaign's folder.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

#[derive(Debug, Args)]
pub(crate) struct CampaignCostArgs {
    /// Studies: campaign documents' files or presets.
    #[arg(value_name = "STUDY", required = true)]
    pub(crate) studies: Vec<String>,
    /// Number of runs to estimate the cost of.
    #[arg(long, value_name = "N", default_value_t = 1_000_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) runs: u64,
    /// Time to measure, in all [s].
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = measured_seconds)]
    pub(crate) seconds: f64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableOrJson,
}

fn measured_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("'{text}' is not a number"))?;
    let range = 0.1..=600.0;
    range.contains(&seconds).then_some(seconds).ok_or_else(|| "it must be 0.1 to 600".to_owned())
}
