//! `grouser campaign summarise`: statistics of all runs.

mod page;

use grouser_draw::chart::Drawable;
use grouser_store::Statistics;
use serde::Serialize;

use super::digest::DigestRecord;
use super::{inputs, stored};
use crate::args::CampaignSummariseArgs;
use crate::commands::Answer;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::{Rows, aligned};
use crate::output::text::Text;
use crate::output::{self, Format};

/// The results for programs.
#[derive(Serialize)]
struct SummaryRecord<'a> {
    #[serde(flatten)]
    digest: &'a DigestRecord,
    #[serde(flatten)]
    statistics: &'a Statistics,
}

pub(super) fn run(args: &CampaignSummariseArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let (results, campaign) = stored(&args.folder)?;
    if let Some(part) = results.manifest().part {
        output::message(&format!(
            "note: this is part {part} of a campaign; `grouser campaign merge` brings the parts \
             together"
        ));
    }
    results.require_all()?;
    let (statistics, finished) = Statistics::of(&campaign, &results)?;
    let digest = DigestRecord::from(finished);
    let record = SummaryRecord { digest: &digest, statistics: &statistics };
    let answer = Answer::new("campaign.summarise", inputs(&results), record);
    if let Some(mut folder) = folder {
        folder.add("summary.json", answer.to_text());
        folder.add("summary.csv", Rows::of(&statistics.rows).to_csv()?);
        folder.add("probabilities.csv", Rows::of(&statistics.probabilities).to_csv()?);
        folder.add("convergence.csv", Rows::of(&statistics.convergence).to_csv()?);
        if !statistics.sensitivities.is_empty() {
            folder.add("sensitivities.csv", Rows::of(&statistics.sensitivities).to_csv()?);
        }
        let figures = grouser_store::figures(&statistics);
        for figure in &figures {
            folder.add(format!("figures/{}.svg", figure.file), figure.chart.to_svg());
        }
        folder.add("report.html", page::html(&campaign, &results, &statistics, &digest, &figures));
        folder.add("study.toml", results.study().to_owned());
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(text_of(&statistics, &digest)),
        Format::Csv => output::print(&Rows::of(&statistics.rows).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
}

fn text_of(statistics: &Statistics, digest: &DigestRecord) -> Text {
    let tables = statistics.tables();
    let tables = tables.iter().map(|table| aligned(&table.header, &table.cells) + "\n");
    tables.collect::<Text>() + digest.line()
}
