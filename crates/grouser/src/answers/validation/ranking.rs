//! The ranking of all models on measured tests, beside predictions without physics.

mod blocks;

use std::collections::BTreeSet;
use std::sync::Arc;

use serde_json::json;

use self::blocks::blocks;
use super::super::{Answer, AnswerOptions, Member};
use super::shown::{Block, on_page, on_screen};
use super::{figures, flat, meanings_of_errors};
use crate::contact::validity::Finding;
use crate::document::columns::{MODEL, slope};
use crate::document::ranking::{Found, RankedModel, Ranking};
use crate::document::table::Table;

/// The name that its files have.
const FILE: &str = "ranking";

/// What a ranking answers. A data set has its own soils and wheels, so that there is no document
/// beside it.
///
/// * `schema`: the name that its schema has
#[must_use]
pub fn ranked(schema: &str, ranking: &Ranking, options: &AnswerOptions<'_>) -> Answer {
    let mut answer = Answer::new(FILE, "Models ranked on measured tests").with_schema(schema);
    let names: BTreeSet<&String> = ranking.rows.iter().map(|row| &row.data_set).collect();
    answer.input("data_sets", json!(names));
    let slopes = Arc::new(slopes(ranking));
    answer.results = vec![
        Member::Value("rows", json!(ranking.rows)),
        Member::Value("yardsticks", json!(ranking.yardsticks)),
        Member::Value("models", json!(ranking.models)),
        Member::Value("sets", json!(ranking.sets)),
        Member::rows("slopes", Arc::clone(&slopes)),
    ];
    answer.tables.push((FILE.to_owned(), Arc::new(rows(ranking))));
    if slopes.rows() > 0 {
        answer.tables.push(("slopes".to_owned(), slopes));
    }
    let blocks = blocks(ranking);
    answer.screen = on_screen(&blocks);
    if options.has_page {
        page(&mut answer, ranking, blocks);
    }
    answer
}

/// Models, then yardsticks.
fn rows(ranking: &Ranking) -> Table {
    let models = ranking.rows.iter().map(flat::flattened);
    let all = models.chain(ranking.yardsticks.iter().map(flat::flattened));
    flat::table_of(&all.collect::<Vec<_>>())
}

/// Every slope of every ranked model of a rover, measured and predicted.
fn slopes(ranking: &Ranking) -> Table {
    let mut all = Table::default();
    for row in &ranking.rows {
        if let Found::Slope(validation) = &row.found {
            let table = slope::slopes(&validation.points).with_word("soil", &row.soil);
            let table = table.with_word(MODEL, row.model).with_word("case", &row.case);
            all.append(table.with_word("data_set", &row.data_set));
        }
    }
    all
}

/// The page, but for what all pages end with.
fn page(answer: &mut Answer, ranking: &Ranking, blocks: Vec<Block>) {
    on_page(blocks, answer);
    answer.heading("The best model of each part");
    for best in ranking.rows.iter().filter(|entry| entry.rank == 1) {
        let part = slug(&format!("{} {}", best.data_set, best.case));
        let all = match &best.found {
            Found::Wheel(validation) => figures::all(validation),
            Found::Slope(validation) => figures::of_slopes(validation),
        };
        for figures::Figure { file, chart, caption } in all {
            let caption = format!("{}, {}: {caption}", best.data_set, best.case);
            answer.figure(Some(&format!("figures/{part}-{file}")), chart, caption);
        }
    }
    answer.findings = Some(ranking.rows.iter().flat_map(findings).collect());
    answer.columns = meanings_of_errors();
}

/// Where the predictions of a model are outside a domain.
fn findings(row: &RankedModel) -> Vec<Finding> {
    match &row.found {
        Found::Wheel(it) => it.cells.iter().flat_map(|cell| cell.findings.clone()).collect(),
        Found::Slope(it) => it.points.iter().flat_map(|point| point.findings.clone()).collect(),
    }
}

/// A name as part of a file's name.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}
