//! The numbers of a campaign's summary, one column of the results after another.

use std::ops::Range;

use grouser::document::Campaign;
use grouser::document::campaign::{Column, Frequencies, QuantityStatistics, Role};
use grouser::document::reading::four_digits;
use grouser::document::table::{ColumnKind, Values};
use grouser::studies::ensemble::sensitivity::Sensitivity;
use grouser::studies::ensemble::statistics::{Convergence, Estimate, Quantile, Summary};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::error::StoreError;
use crate::results::{Finished, Results};

/// Half of all are below [-].
const MEDIAN: f64 = 0.5;
/// The quantiles, and the ends of their names.
const QUANTILES: [(f64, &str); 5] =
    [(0.025, "p2_5"), (0.25, "p25"), (MEDIAN, "p50"), (0.75, "p75"), (0.975, "p97_5")];
/// Points of a distribution's curve.
const CURVE: usize = 200;

/// The statistics of a campaign.
#[derive(Debug, Serialize)]
pub struct Statistics {
    /// A row for each quantity.
    pub rows: Vec<Map<String, Value>>,
    /// Of each event.
    pub probabilities: Vec<ProbabilityRecord>,
    /// Of each input and quantity, where the campaign was laid out for them.
    pub sensitivities: Vec<SensitivityRecord>,
    /// Of each quantity after ever more runs.
    pub convergence: Vec<ConvergenceRecord>,
    /// For the figures.
    #[serde(skip)]
    pub curves: Vec<Curve>,
}

/// The probability of an event.
#[derive(Debug, Serialize)]
pub struct ProbabilityRecord {
    /// What happens.
    pub event: String,
    /// In how many runs.
    pub count: usize,
    /// Of how many.
    pub runs: usize,
    /// Its probability [-].
    pub probability: f64,
    /// The lower end of its 95 % interval.
    pub probability_low: f64,
    /// The upper end.
    pub probability_high: f64,
}

/// Sobol indices of an input for a quantity.
#[derive(Debug, Serialize)]
pub struct SensitivityRecord {
    /// The quantity.
    pub quantity: String,
    /// The input.
    pub input: String,
    /// First-order index [-].
    pub first: f64,
    /// The lower end of its 95 % interval.
    pub first_low: f64,
    /// The upper end.
    pub first_high: f64,
    /// Total index [-].
    pub total: f64,
    /// The lower end of its 95 % interval.
    pub total_low: f64,
    /// The upper end.
    pub total_high: f64,
    /// Points that all runs of which have the quantity.
    pub points: usize,
    /// Points that were left out.
    pub points_missing: usize,
}

/// Statistics of the first runs.
#[derive(Debug, Serialize)]
pub struct ConvergenceRecord {
    /// The quantity.
    pub quantity: String,
    /// Of how many.
    pub runs: usize,
    /// Their mean.
    pub mean: Option<f64>,
    /// The lower end of its 95 % interval.
    pub mean_low: Option<f64>,
    /// The upper end.
    pub mean_high: Option<f64>,
    /// Their median.
    pub p50: Option<f64>,
    /// The lower end of its 95 % interval.
    pub p50_low: Option<f64>,
    /// The upper end.
    pub p50_high: Option<f64>,
}

/// A quantity's distribution: what share of the runs is below.
#[derive(Debug)]
pub struct Curve {
    /// The quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: Option<&'static str>,
    /// The quantity, and the share of the runs below it.
    pub points: Vec<(f64, f64)>,
}

/// A table for people.
#[derive(Debug)]
pub struct Table {
    /// What the rows are.
    pub caption: &'static str,
    /// The columns.
    pub header: Vec<String>,
    /// Row by row.
    pub cells: Vec<Vec<String>>,
}

impl Statistics {
    /// Statistics of all runs of a campaign that are there, with the digest of what was read. The
    /// library decides which runs count for which of them.
    ///
    /// # Errors
    /// [`StoreError`] if a shard cannot be read, or none is there.
    pub fn of(campaign: &Campaign, results: &Results) -> Result<(Self, Finished), StoreError> {
        let (frequencies, mut finished) = frequencies(campaign, results)?;
        let mut statistics = Self {
            rows: Vec::new(),
            probabilities: probabilities(&frequencies),
            sensitivities: Vec::new(),
            convergence: Vec::new(),
            curves: Vec::new(),
        };
        let manifest = results.manifest();
        let present = results.missing().others();
        let runs: Vec<Range<u64>> = present.iter().map(|shard| manifest.runs_of(shard)).collect();
        let is_result =
            |column: &&Column| column.role == Role::Result && column.kind == ColumnKind::Float;
        let columns: Vec<&Column> = campaign.columns().iter().filter(is_result).collect();
        let (mut words, _) = results.columns(&["status"])?;
        let Some(Values::Text(statuses)) = words.pop() else {
            return Err(StoreError::NoColumn("status".to_owned()));
        };
        for batch in columns.chunks(columns_at_once(&runs)) {
            let names: Vec<&str> = batch.iter().map(|column| column.name.as_str()).collect();
            let (all, found) = results.columns(&names)?;
            finished = found;
            for (column, values) in batch.iter().zip(all) {
                if let Values::Float(values) = values {
                    let counted = campaign.counted(&column.name, &runs, &values, &statuses);
                    statistics.add(campaign, column, &runs, &counted);
                }
            }
        }
        Ok((statistics, finished))
    }

    /// * `values`: of a quantity, in the order of the runs
    fn add(
        &mut self,
        campaign: &Campaign,
        column: &Column,
        runs: &[Range<u64>],
        values: &[Option<f64>],
    ) {
        let shares = QUANTILES.map(|(share, _)| share);
        let found = QuantityStatistics::of(campaign, runs, values, &shares);
        self.rows.push(row(column, found.summary.as_ref(), found.samples));
        self.convergence.extend(found.convergence.iter().map(|point| converged(column, point)));
        self.sensitivities.extend(sensitivities(campaign, column, found.sensitivity.as_ref()));
        let numbered = runs.iter().cloned().flatten().zip(values);
        let samples = numbered.filter(|(run, _)| campaign.ensemble().is_sample(*run));
        self.curves.extend(curve(column, samples.filter_map(|(_, value)| *value).collect()));
    }

    /// The probability of failure, in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let failure = self.probabilities.iter().find(|it| it.event.starts_with("failure"));
        let Some(it) = failure else { return "There are no runs.".into() };
        format!(
            "{} of {} runs failed, that is, had no result or were not completed: {:.2} %, with 95 % \
             confidence between {:.2} and {:.2} %.",
            it.count,
            it.runs,
            1e2 * it.probability,
            1e2 * it.probability_low,
            1e2 * it.probability_high
        )
    }

    /// The tables for people.
    #[must_use]
    pub fn tables(&self) -> Vec<Table> {
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

/// How many columns are in memory at once: each pass over the files brings that many, and checks
/// them.
fn columns_at_once(runs: &[Range<u64>]) -> usize {
    const BYTES: usize = 1 << 28;
    let rows: u64 = runs.iter().map(|runs| runs.end - runs.start).sum();
    let rows = usize::try_from(rows).unwrap_or(usize::MAX).max(1);
    (BYTES / size_of::<Option<f64>>() / rows).max(1)
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
    let is_median = |it: &&Quantile| it.share == MEDIAN;
    let median = point.summary.as_ref().and_then(|it| it.quantiles.iter().find(is_median));
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
fn curve(column: &Column, mut sorted: Vec<f64>) -> Option<Curve> {
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
    found: Option<&Sensitivity>,
) -> Vec<SensitivityRecord> {
    let inputs = campaign.factors();
    let Some(found) = found else { return Vec::new() };
    let record =
        |(input, share): (&String, &grouser::studies::ensemble::sensitivity::SobolIndex)| {
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

/// How often each status and outcome is, and each word about a leg, counted shard by shard.
fn frequencies(
    campaign: &Campaign,
    results: &Results,
) -> Result<(Frequencies, Finished), StoreError> {
    let has_outcome = campaign.columns().iter().any(|column| column.name == "outcome");
    let mut names = if has_outcome { vec!["status", "outcome"] } else { vec!["status"] };
    let of_legs = campaign.words_of_legs();
    names.extend(&of_legs);
    let mut frequencies = Frequencies::default();
    let finished = results.read(&names, &mut |shard, table| {
        let words = |name: &str| match table.column(name) {
            Some(Values::Text(words)) => words.as_slice(),
            _ => &[],
        };
        let runs = results.manifest().runs_of(shard);
        for column in &of_legs {
            frequencies.add_of_leg(campaign, runs.clone(), column, words(column));
        }
        frequencies.add(campaign, runs, words("status"), words("outcome"));
    })?;
    Ok((frequencies, finished))
}

/// The probability of each event, that of any failure, and those of what became of each leg.
fn probabilities(frequencies: &Frequencies) -> Vec<ProbabilityRecord> {
    let mut counts = frequencies.events.clone();
    counts.insert("failure (all but ok and completed)".into(), frequencies.failures);
    let of_legs = frequencies.legs.iter().flat_map(|(column, words)| {
        words.iter().map(move |(word, count)| (format!("{column}: {word}"), *count))
    });
    let record = |(event, count): (String, usize)| {
        let probability = frequencies.probability(count)?;
        let (probability_low, probability_high) = probability.interval();
        Some(ProbabilityRecord {
            event,
            count,
            runs: frequencies.samples,
            probability: probability.estimate(),
            probability_low,
            probability_high,
        })
    };
    counts.into_iter().chain(of_legs).filter_map(record).collect()
}
