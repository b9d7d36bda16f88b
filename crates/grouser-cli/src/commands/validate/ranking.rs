//! `grouser validate --all`: ranks every model on every data set.

use grouser::document::ranking::{RankedTheory, RankingError, rank_all};
use grouser::document::validation::{ErrorsRecord, GroupRecord};
use grouser::studies::measurement::Quantity;
use serde::Serialize;
use serde_json::json;

use super::super::Answer;
use super::figures;
use crate::args::ValidateArgs;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::{aligned, csv_of_nested};
use crate::output::{self, Format};

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [RankedTheory],
}

pub(super) fn run(args: &ValidateArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let entries = rank_all(args.data_dir.as_deref(), args.read.limits())?;
    let inputs = json!({ "data_sets": entries.iter().map(|it| &it.data_set).collect::<std::collections::BTreeSet<_>>() });
    let answer = Answer::new("validate", inputs, Results { rows: &entries });
    let text = text_of(&entries);
    if let Some(mut folder) = folder {
        folder.add("ranking.json", answer.to_text());
        folder.add("ranking.csv", csv_of_nested(&entries)?);
        folder.add("ranking.txt", text.clone());
        for best in entries.iter().filter(|entry| entry.rank == 1) {
            let part = slug(&format!("{} {}", best.data_set, best.case));
            for figure in figures::all(&best.validation) {
                folder.add(format!("figures/{part}-{}.svg", figure.file), figure.chart.to_svg());
            }
        }
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&text),
        Format::Csv => output::print(&csv_of_nested(&entries)?),
        Format::Json => output::print_json(&answer),
    }
}

/// A name as part of a file's name.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

impl From<RankingError> for Failure {
    fn from(error: RankingError) -> Self {
        match error {
            RankingError::Document(error) => error.into(),
            RankingError::Measurements(error) => error.into(),
            RankingError::Unreadable { folder, error } => {
                Self::at("cannot look into", &folder)(error)
            }
            RankingError::NoDataSet { .. } => Self::Usage(format!(
                "{error}\nhint: docs/guide/data.md explains how a document describes a data set; without \
                 --data-dir those that come with the program are ranked"
            )),
            RankingError::NoSuchFolder(_) | RankingError::NoSuchFile { .. } => {
                Self::Usage(error.to_string())
            }
        }
    }
}

/// For people: a block for each part of each data set.
fn text_of(entries: &[RankedTheory]) -> String {
    let mut blocks = vec![
        "Root mean square errors over cells: drawbar pull [N] / side force [N] / sinkage [mm]\n\
         score: 0 is perfect, 1 no better than the mean of what was measured\n"
            .to_owned(),
    ];
    for part in
        entries.chunk_by(|one, other| (&one.data_set, &one.case) == (&other.data_set, &other.case))
    {
        let header = ["rank", "model", "soil", "driven", "all", "score", "no prediction"];
        let rows: Vec<Vec<String>> = part.iter().map(row).collect();
        let table = aligned(&header.map(str::to_owned), &rows);
        let [first, ..] = part else { continue };
        let repeatability = errors(&first.overall, |it| it.repeatability)
            .map_or(String::new(), |it| format!("between repeated trials, all cells: {it}\n"));
        blocks.push(format!("{}, {}\n{table}{repeatability}", first.data_set, first.case));
    }
    blocks.join("\n")
}

fn row(entry: &RankedTheory) -> Vec<String> {
    let rmse = |group: &GroupRecord| errors(group, |it| Some(it.rmse));
    vec![
        entry.rank.to_string(),
        entry.model.to_owned(),
        entry.soil.clone(),
        entry.driven.as_ref().and_then(rmse).unwrap_or_else(|| "-".to_owned()),
        rmse(&entry.overall).unwrap_or_else(|| "-".to_owned()),
        entry.score.map_or("-".to_owned(), |score| format!("{score:.2}")),
        entry.unsettled_trials.to_string(),
    ]
}

/// Three numbers as one cell; torque is named where it was measured.
fn errors(group: &GroupRecord, of: fn(ErrorsRecord) -> Option<f64>) -> Option<String> {
    let number = |quantity| {
        let value = group.errors(quantity).and_then(of);
        value.map_or("-".to_owned(), |value| format!("{value:.2}"))
    };
    let three = [Quantity::DrawbarPull, Quantity::SideForce, Quantity::Sinkage].map(number);
    three.iter().any(|cell| cell != "-").then(|| three.join(" / "))
}
