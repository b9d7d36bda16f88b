//! `grouser campaign rerun`: computes one run again, and compares it with the stored row.

use grouser::document::table::Cell;
use serde_json::{Map, Value, json};

use super::{inputs, stored};
use crate::args::{CampaignRerunArgs, TableOrJson};
use crate::commands::Answer;
use crate::failure::Failure;
use crate::output;
use crate::output::rows::aligned;

pub(super) fn run(args: &CampaignRerunArgs) -> Result<(), Failure> {
    let (results, campaign) = stored(&args.folder)?;
    let manifest = results.manifest();
    let shard = args.run / manifest.shard_runs;
    let is_stored = manifest.has(shard) && !results.missing().contains(shard);
    // A run that the campaign does not have is for the results to refuse.
    let is_unstored = args.run < manifest.runs && !is_stored;
    let kept = if is_unstored { None } else { Some(results.row(args.run)?) };
    let names = campaign.columns().iter().map(|column| column.name.clone());
    let row: Vec<(String, Cell)> = names.zip(campaign.run(args.run)).collect();
    if let Some(kept) = &kept {
        check_same(args, &row, kept)?;
    }
    let verdict = if kept.is_some() { "equal to the stored row" } else { "not stored yet" };
    let cells: Map<String, Value> =
        row.into_iter().map(|(name, cell)| (name, value(&cell))).collect();
    match args.format {
        TableOrJson::Table => {
            let line = |(name, value): (&String, &Value)| vec![name.clone(), written(value)];
            let lines: Vec<Vec<String>> = cells.iter().map(line).collect();
            let header = ["column", "value"].map(str::to_owned);
            output::show(aligned(&header, &lines) + format!("{verdict}\n"))
        }
        TableOrJson::Json => {
            let answer = json!({ "run": args.run, "row": cells, "stored": kept.is_some() });
            output::print_json(&Answer::new("campaign.rerun", inputs(&results), answer))
        }
    }
}

/// Checks that a run is equal to the stored one, bit for bit.
fn check_same(
    args: &CampaignRerunArgs,
    row: &[(String, Cell)],
    kept: &[(String, Cell)],
) -> Result<(), Failure> {
    let bits = |cell: &Cell| match cell {
        Cell::Float(value) => Cell::Whole(value.map(f64::to_bits)),
        cell => cell.clone(),
    };
    let pairs = row.iter().zip(kept);
    let differing = pairs.filter(|((_, ours), (_, theirs))| bits(ours) != bits(theirs));
    let words: Vec<String> = differing
        .map(|((name, ours), (_, theirs))| {
            format!(
                "{name} is stored as {}, and is now {}",
                written(&value(theirs)),
                written(&value(ours))
            )
        })
        .collect();
    if words.is_empty() {
        return Ok(());
    }
    Err(Failure::Run(format!("run {} is not what is stored: {}", args.run, words.join("; "))))
}

fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Float(value) => json!(value),
        Cell::Whole(value) => json!(value),
        Cell::Text(value) => json!(value),
        Cell::Words(names) => json!(names),
    }
}

fn written(value: &Value) -> String {
    match value {
        Value::Null => "-".into(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
