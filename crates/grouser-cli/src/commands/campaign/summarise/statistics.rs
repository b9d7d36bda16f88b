//! The numbers of a summary, one column of the results after another.

use std::collections::BTreeMap;

use grouser::document::Campaign;
use grouser::document::campaign::{Column, Role, Values};
use grouser::studies::campaign::sensitivity::Sensitivity;
use grouser::studies::campaign::summary::{Convergence, Estimate, Quantile, Summary};
use grouser::studies::uncertainty::Probability;
use grouser_store::Results;
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::failure::Failure;
use crate::output::rows::four_digits;

/// The quantiles that are told, and how words end that name them.
pub(super) const QUANTILES: [(f64, &str); 5] =
    [(0.025, "p2_5"), (0.25, "p25"), (0.5, "p50"), (0.75, "p75"), (0.975, "p97_5")];
/// Points of a distribution's curve.
const CURVE: usize = 200;

/// What a campaign says.
#[derive(Serialize)]
pub(super) struct Statistics {
    /// A row for each quantity.
    pub(super) rows: Vec<Map<String, Value>>,
    pub(super) probabilities: Vec<ProbabilityRecord>,
    pub(super) sensitivities: Vec<SensitivityRecord>,
    pub(super) convergence: Vec<ConvergenceRecord>,
    /// For the figures.
    #[serde(skip)]
    pub(super) curves: Vec<Curve>,
}

/// How often something happened.
#[derive(Serialize)]
pub(super) struct ProbabilityRecord {
    pub(super) event: String,
    pub(super) count: usize,
    pub(super) runs: usize,
    pub(super) probability: f64,
    pub(super) probability_low: f64,
    pub(super) probability_high: f64,
}

/// What an input's variance does to a quantity's.
#[derive(Serialize)]
pub(super) struct SensitivityRecord {
    pub(super) quantity: String,
    pub(super) input: String,
    pub(super) first: f64,
    pub(super) first_low: f64,
    pub(super) first_high: f64,
    pub(super) total: f64,
    pub(super) total_low: f64,
    pub(super) total_high: f64,
    /// Points that all runs of which have the quantity, and those that were left out.
    pub(super) points: usize,
    pub(super) points_missing: usize,
}

/// What the first runs said.
#[derive(Serialize)]
pub(super) struct ConvergenceRecord {
    pub(super) quantity: String,
    pub(super) runs: usize,
    pub(super) mean: Option<f64>,
    pub(super) mean_low: Option<f64>,
    pub(super) mean_high: Option<f64>,
    pub(super) p50: Option<f64>,
    pub(super) p50_low: Option<f64>,
    pub(super) p50_high: Option<f64>,
}

/// A quantity's distribution: what share of the runs is below.
pub(super) struct Curve {
    pub(super) quantity: String,
    pub(super) unit: Option<&'static str>,
    pub(super) points: Vec<(f64, f64)>,
}

/// A table for people.
pub(super) struct Table {
    pub(super) caption: &'static str,
    pub(super) header: Vec<String>,
    pub(super) cells: Vec<Vec<String>>,
}

impl Statistics {
    /// Of all runs of a campaign.
    ///
    /// Of a campaign for sensitivities, quantiles and probabilities are over the runs of A and B, which
    /// are draws; the others are those once more with one input exchanged.
    pub(super) fn of(campaign: &Campaign, results: &Results) -> Result<Self, Failure> {
        let draws = Draws::of(campaign, results);
        let mut statistics = Self {
            rows: Vec::new(),
            probabilities: probabilities(campaign, results, &draws)?,
            sensitivities: Vec::new(),
            convergence: Vec::new(),
            curves: Vec::new(),
        };
        for column in campaign.columns().iter().filter(|column| column.role == Role::Result) {
            let Values::Float(values) = results.column(&column.name)? else { continue };
            if draws.per_point > 1 {
                statistics.sensitivities.extend(sensitivities(campaign, column, &values));
            }
            statistics.add(column, &draws.only(values));
        }
        Ok(statistics)
    }

    /// * `values`: of a quantity, in the order of the runs
    fn add(&mut self, column: &Column, values: &[Option<f64>]) {
        let shares = QUANTILES.map(|(share, _)| share);
        self.rows.push(row(column, Summary::of(values, &shares).as_ref(), values.len()));
        let convergence = Convergence::of(values, &[0.5]).into_iter();
        self.convergence.extend(convergence.map(|point| converged(column, &point)));
        self.curves.extend(curve(column, values));
    }

    /// The tables for people.
    pub(super) fn tables(&self) -> Vec<Table> {
        let mut tables = vec![self.quantities(), self.chances()];
        if !self.sensitivities.is_empty() {
            tables.push(self.shares());
        }
        tables
    }

    fn quantities(&self) -> Table {
        let number = |row: &Map<String, Value>, key: &str| row[key].as_f64();
        let cells = self.rows.iter().map(|row| {
            let shown = |key: &str| number(row, key).map_or("-".into(), four_digits);
            let quantile = |key: &str| {
                let ends = ["low", "high"].map(|end| shown(&format!("{key}_{end}")));
                format!("{} [{}, {}]", shown(key), ends[0], ends[1])
            };
            let name = row["quantity"].as_str().unwrap_or_default().to_owned();
            let mut cells = vec![name, row["runs"].to_string(), shown("mean"), shown("std")];
            cells.extend(["p2_5", "p50", "p97_5"].map(quantile));
            cells
        });
        let header = ["quantity", "runs", "mean", "std", "p2_5", "p50", "p97_5"];
        Table {
            caption: "Quantiles, each with its 95 % confidence interval",
            header: header.map(str::to_owned).to_vec(),
            cells: cells.collect(),
        }
    }

    fn chances(&self) -> Table {
        let cells = self.probabilities.iter().map(|it| {
            let share = [it.probability, it.probability_low, it.probability_high].map(four_digits);
            let [share, low, high] = share;
            vec![it.event.clone(), it.count.to_string(), format!("{share} [{low}, {high}]")]
        });
        let header = ["event", "count", "probability"];
        Table {
            caption: "Probabilities, each with its 95 % confidence interval (Wilson)",
            header: header.map(str::to_owned).to_vec(),
            cells: cells.collect(),
        }
    }

    fn shares(&self) -> Table {
        let cells = self.sensitivities.iter().map(|it| {
            let index =
                |value: f64, low: f64, high: f64| format!("{value:.3} [{low:.3}, {high:.3}]");
            vec![
                it.quantity.clone(),
                it.input.clone(),
                index(it.first, it.first_low, it.first_high),
                index(it.total, it.total_low, it.total_high),
            ]
        });
        let header = ["quantity", "input", "first", "total"];
        Table {
            caption: "Sobol indices, each with its 95 % confidence interval",
            header: header.map(str::to_owned).to_vec(),
            cells: cells.collect(),
        }
    }
}

/// Which runs are draws.
struct Draws {
    /// Runs of a point; A and B are the first two of several.
    per_point: u64,
    /// Numbers of the runs that the folder has, shard by shard.
    runs: Vec<std::ops::Range<u64>>,
}

impl Draws {
    fn of(campaign: &Campaign, results: &Results) -> Self {
        let manifest = results.manifest();
        let runs = manifest.own_shards().map(|shard| manifest.runs_of(shard)).collect();
        Self { per_point: campaign.plan().runs_per_point(), runs }
    }

    fn has(&self, run: u64) -> bool {
        run % self.per_point < 2
    }

    /// Of the values of all runs, those of draws.
    fn only<T>(&self, values: Vec<T>) -> Vec<T> {
        if self.per_point <= 1 {
            return values;
        }
        let runs = self.runs.iter().cloned().flatten();
        runs.zip(values).filter(|(run, _)| self.has(*run)).map(|(_, value)| value).collect()
    }
}

fn row(column: &Column, summary: Option<&Summary>, runs: usize) -> Map<String, Value> {
    let mut row = Map::new();
    let mut put = |key: String, value: Value| drop(row.insert(key, value));
    put("quantity".into(), json!(column.name));
    put("unit".into(), json!(column.unit()));
    put("runs".into(), json!(summary.map_or(0, |it| it.count)));
    put("runs_without".into(), json!(summary.map_or(runs, |it| it.missing)));
    let mean = summary.map(|it| it.mean);
    put("mean".into(), json!(mean.map(|it: Estimate| it.value)));
    put("mean_low".into(), json!(mean.map(|it| it.low)));
    put("mean_high".into(), json!(mean.map(|it| it.high)));
    put("std".into(), json!(summary.map(|it| it.deviation)));
    put("least".into(), json!(summary.map(|it| it.least)));
    put("most".into(), json!(summary.map(|it| it.most)));
    for (place, (_, word)) in QUANTILES.iter().enumerate() {
        let quantile: Option<&Quantile> = summary.and_then(|it| it.quantiles.get(place));
        put((*word).to_owned(), json!(quantile.map(|it| it.value)));
        put(format!("{word}_low"), json!(quantile.and_then(|it| it.low)));
        put(format!("{word}_high"), json!(quantile.and_then(|it| it.high)));
    }
    row
}

fn converged(column: &Column, point: &Convergence) -> ConvergenceRecord {
    let mean = point.summary.as_ref().map(|it| it.mean);
    let median = point.summary.as_ref().and_then(|it| it.quantiles.first());
    ConvergenceRecord {
        quantity: column.name.clone(),
        runs: point.runs,
        mean: mean.map(|it| it.value),
        mean_low: mean.map(|it| it.low),
        mean_high: mean.map(|it| it.high),
        p50: median.map(|it| it.value),
        p50_low: median.and_then(|it| it.low),
        p50_high: median.and_then(|it| it.high),
    }
}

/// The curve of a distribution; none for a quantity that does not vary.
fn curve(column: &Column, values: &[Option<f64>]) -> Option<Curve> {
    let mut sorted: Vec<f64> = values.iter().copied().flatten().collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    if sorted[0] == sorted[last] {
        return None;
    }
    let steps = last.min(CURVE);
    let point = |step: usize| {
        let place = step * last / steps;
        (sorted[place], place as f64 / last as f64)
    };
    Some(Curve {
        quantity: column.name.clone(),
        unit: column.unit(),
        points: (0..=steps).map(point).collect(),
    })
}

fn sensitivities(
    campaign: &Campaign,
    column: &Column,
    values: &[Option<f64>],
) -> Vec<SensitivityRecord> {
    let inputs = campaign.factors();
    let Some(found) = Sensitivity::of(values, inputs.len(), campaign.seed()) else {
        return Vec::new();
    };
    let record =
        |(input, share): (&String, &grouser::studies::campaign::sensitivity::SobolIndex)| {
            SensitivityRecord {
                quantity: column.name.clone(),
                input: input.clone(),
                first: share.first.value,
                first_low: share.first.low,
                first_high: share.first.high,
                total: share.total.value,
                total_low: share.total.low,
                total_high: share.total.high,
                points: found.points,
                points_missing: found.missing,
            }
        };
    inputs.iter().zip(&found.indices).map(record).collect()
}

/// How often each status and outcome is, and how often either is a failure.
fn probabilities(
    campaign: &Campaign,
    results: &Results,
    draws: &Draws,
) -> Result<Vec<ProbabilityRecord>, Failure> {
    let has_outcome = campaign.columns().iter().any(|column| column.name == "outcome");
    let names: &[&str] = if has_outcome { &["status", "outcome"] } else { &["status"] };
    let (mut counts, mut failures, mut runs) = (BTreeMap::<String, usize>::new(), 0, 0);
    for shard in results.manifest().own_shards() {
        let table = results.shard(shard, names)?;
        let words = |name: &str| match table.column(name) {
            Some(Values::Text(words)) => words.clone(),
            _ => Vec::new(),
        };
        let (statuses, outcomes) = (words("status"), words("outcome"));
        for (place, run) in results.manifest().runs_of(shard).enumerate() {
            if draws.per_point > 1 && !draws.has(run) {
                continue;
            }
            let status = statuses.get(place).cloned().flatten().unwrap_or_default();
            let outcome = outcomes.get(place).cloned().flatten();
            let is_failure =
                status != "ok" || outcome.as_ref().is_some_and(|outcome| outcome != "completed");
            runs += 1;
            failures += usize::from(is_failure);
            *counts.entry(outcome.unwrap_or(status)).or_default() += 1;
        }
    }
    counts.insert("failure (all but ok and completed)".into(), failures);
    Ok(counts.into_iter().filter_map(|(event, count)| chance(event, count, runs)).collect())
}

fn chance(event: String, count: usize, runs: usize) -> Option<ProbabilityRecord> {
    if runs == 0 {
        return None;
    }
    let probability = Probability { successes: count, trials: runs };
    let (low, high) = probability.interval();
    Some(ProbabilityRecord {
        event,
        count,
        runs,
        probability: probability.estimate(),
        probability_low: low,
        probability_high: high,
    })
}
