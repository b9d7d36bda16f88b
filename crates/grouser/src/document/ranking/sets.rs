//! The parts of data sets under the band of all models together: how good it is, and at which slip
//! the pull vanishes.

use grouser_io::statistics::weighted_quantile;
use serde::Serialize;

use super::parts::{DataSet, Part, RankingError, data_sets_of_the_program, heading_study};
use crate::contact::{Contact, Model, Slip, settle};
use crate::document::measurements::{self, Choice, Limits};
use crate::document::{LoadedSoil, LoadedWheel, Overrides, Source, Tested, read_scenario};
use crate::root;
use crate::studies::ensemble::models::{ModelSpread, Question};
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::evidence::{
    self, Answer, AnswerKind, Evidence, Judged, Shares, judged, without,
};
use crate::studies::measurement::{Quantity, WheelTests};
use crate::studies::validation::{CellComparison, mean_score, measured_alone};

/// A part of a data set under the 95 % band of all models by their weights.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SetRecord {
    /// The data set's name.
    pub data_set: String,
    /// The part's.
    pub case: String,
    /// The soil's.
    pub soil: String,
    /// Whether the soil was made for a model with these rows in view.
    pub in_sample: bool,
    /// The slip ratio straight ahead at which the measured pull vanishes [-]; null where the rows
    /// do not bracket it.
    pub zero_pull_slip_measured: Option<f64>,
    /// The same, predicted: the weighted median of the models.
    pub zero_pull_slip_predicted: Option<f64>,
    /// Whether the two are so far apart that a radius or the zero of an instrument is in doubt.
    pub zero_pull_is_doubtful: bool,
    /// How many numbers were measured.
    pub numbers: usize,
    /// The share of them that the band holds [-].
    pub held: f64,
    /// The band's interval score over the standard deviation of what was measured, the mean over
    /// kinds of answer [-]; null where nothing varies.
    pub interval_score: Option<f64>,
    /// Each kind of answer.
    pub answers: Vec<AnswersRecord>,
}

/// The answers of one kind: forces over the load, sinkage over the shearing radius, slip [-], yaw
/// [°].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnswersRecord {
    /// What was asked.
    pub kind: &'static str,
    /// How many numbers were measured.
    pub numbers: usize,
    /// Root mean square of the weighted median minus what was measured.
    pub rmse: f64,
    /// The largest difference.
    pub worst: f64,
    /// The share that the band holds [-].
    pub held: f64,
    /// The band's mean width.
    pub width: f64,
    /// Its mean interval score.
    pub interval_score: f64,
}

/// Samples of each model. Source: ours; with twice as many, weights move by a hundredth.
const SAMPLES: u64 = 100;
const SEED: u64 = 1;
/// Slips of no pull that are farther apart than this [-] hint at another radius or zero. Source:
/// ours: a tenth of the radius moves the slip by a tenth, and models differ by 0.02.
const DOUBTFUL: f64 = 0.03;

/// What every model predicts of every part of the data sets that come with the program, sample by
/// sample, on the first of its soils that was not fitted to it; a heading has no other.
///
/// * `samples`: of each model
///
/// # Errors
/// The same as [`rank_all`](super::rank_all).
pub fn evidence(samples: u64, seed: u64, limits: Limits) -> Result<Vec<Evidence>, RankingError> {
    let mut all = Vec::new();
    for DataSet { set, rows, .. } in data_sets_of_the_program()? {
        for case in &set.value.cases {
            all.extend(Part { set: &set, case }.evidence(&rows, limits, samples, seed)?);
        }
    }
    Ok(all)
}

/// Each part of some data sets.
///
/// * `are_known`: whether these are the sets of the program, from which the weights are: each is
///   judged by weights that are found without it
pub(super) fn records(
    sets: &[DataSet],
    are_known: bool,
    limits: Limits,
) -> Result<Vec<SetRecord>, RankingError> {
    let parts = sets.iter().flat_map(|it| {
        it.set.value.cases.iter().map(move |case| (Part { set: &it.set, case }, &it.rows))
    });
    let found = parts.filter_map(|(part, rows)| {
        let found = part.evidence(rows, limits, SAMPLES, SEED).transpose()?;
        Some(found.map(|found| (part, rows, found)))
    });
    let found: Vec<_> = found.collect::<Result<_, _>>()?;
    let known = found.iter().filter(|_| are_known).map(|(_, _, evidence)| evidence.clone());
    let known: Vec<Evidence> = known.collect();
    let record = |(part, rows, found): &(Part<'_>, &measurements::Source, Evidence)| {
        let in_force = || ModelSpread::all(found.in_sample.as_ref(), Question::Along).in_order();
        let shares = if are_known { without(found, &known) } else { in_force() };
        part.record(found, &shares, rows, limits)
    };
    found.iter().map(record).collect()
}

impl Part<'_> {
    fn choice(&self, limits: Limits) -> Choice {
        Choice { conditions: self.case.conditions.clone(), wheel: None, limits }
    }

    /// The soil that predictions are judged with.
    fn judged_soil(&self) -> Option<&(String, LoadedSoil)> {
        let soils = &self.case.soils;
        soils.iter().find(|(name, _)| !self.case.is_fitted(name)).or(soils.first())
    }

    fn evidence(
        &self,
        rows: &measurements::Source,
        limits: Limits,
        samples: u64,
        seed: u64,
    ) -> Result<Option<Evidence>, RankingError> {
        let Some((name, soil)) = self.judged_soil() else { return Ok(None) };
        Ok(Some(Evidence {
            data_set: self.set.document.name().to_owned(),
            case: self.case.name.clone(),
            soil: name.clone(),
            source: soil.document.text("source").unwrap_or_default().to_owned(),
            in_sample: self.case.is_fitted(name).then(|| soil.document.usual_model("")),
            answers: self.answers(soil, rows, limits, samples, seed)?,
        }))
    }

    fn answers(
        &self,
        soil: &LoadedSoil,
        rows: &measurements::Source,
        limits: Limits,
        samples: u64,
        seed: u64,
    ) -> Result<Vec<Answer>, RankingError> {
        let (inputs, gravity) = (BandInputs::of_soil(soil, None), self.set.value.gravity);
        let tested = evidence::Tested { soil: &inputs, gravity, samples, seed };
        let choice = self.choice(limits);
        Ok(match &self.case.tested {
            Tested::Wheel(wheel) => {
                tested.of_wheel(wheel.value, &rows.read(&choice)?.tests).unwrap_or_default()
            }
            Tested::Rover(rover) => {
                let usual = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
                let tests = rows.read_slopes(&choice, &rover.value)?;
                let heading = heading_study(&usual, rover, soil, Model::default(), gravity);
                tested.of_rover(&heading, &tests)?.unwrap_or_default()
            }
        })
    }

    fn record(
        &self,
        found: &Evidence,
        shares: &Shares,
        rows: &measurements::Source,
        limits: Limits,
    ) -> Result<SetRecord, RankingError> {
        let judged = judged(found, shares);
        let numbers = judged.iter().map(|it| it.count).sum::<usize>();
        let held = judged.iter().map(|it| it.held).sum::<usize>() as f64 / numbers.max(1) as f64;
        let [measured, predicted] = match &self.case.tested {
            Tested::Wheel(wheel) => self.zero_pull(wheel, &rows.read(&self.choice(limits))?.tests),
            Tested::Rover(_) => [None, None],
        };
        Ok(SetRecord {
            data_set: found.data_set.clone(),
            case: found.case.clone(),
            soil: found.soil.clone(),
            in_sample: found.in_sample.is_some(),
            zero_pull_slip_measured: measured,
            zero_pull_slip_predicted: predicted,
            zero_pull_is_doubtful: measured
                .zip(predicted)
                .is_some_and(|(one, other)| (one - other).abs() > DOUBTFUL),
            numbers,
            held,
            interval_score: score(found, &judged),
            answers: judged.iter().map(AnswersRecord::of).collect(),
        })
    }

    /// The slips at which the pull vanishes straight ahead: measured, and predicted with the soil
    /// as written.
    fn zero_pull(&self, wheel: &LoadedWheel, tests: &WheelTests) -> [Option<f64>; 2] {
        let cells = tests.cells.iter().map(|cell| measured_alone(tests, cell));
        let straight = cells.filter(|cell| cell.slip_angle == 0.0);
        let point = |cell: CellComparison| {
            let pull = cell.quantities[Quantity::DrawbarPull]?.measured;
            Some((cell.total_slip, pull, cell.load))
        };
        let mut points: Vec<(f64, f64, f64)> = straight.filter_map(point).collect();
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        if points.is_empty() {
            return [None, None];
        }
        let load = points.iter().map(|it| it.2).sum::<f64>() / points.len() as f64;
        [crossing(&points), self.predicted_zero(wheel, load)]
    }

    /// The weighted median of the models' slips of no pull, with the soil as written.
    fn predicted_zero(&self, wheel: &LoadedWheel, load: f64) -> Option<f64> {
        let (_, soil) = self.judged_soil()?;
        let spread = ModelSpread::all(None, Question::Along);
        let zero = |(model, share): &(Model, f64)| {
            let pull = |slip: f64| {
                let slip = Slip::on_test_stand(slip, 0.0);
                let (wheel, soil) = (wheel.value, soil.value);
                let contact = Contact { wheel, soil, slip, gravity: self.set.value.gravity };
                settle(model.as_ref(), &contact, load).map_or(-load, |it| it.forces.drawbar_pull)
            };
            first_zero(pull).map(|slip| (slip, *share))
        };
        weighted_quantile(spread.shares().iter().filter_map(zero).collect(), 0.5)
    }
}

/// Where measured pulls over rising slips pass zero, on a line between two neighbours.
fn crossing(points: &[(f64, f64, f64)]) -> Option<f64> {
    points.windows(2).find(|pair| pair[0].1 <= 0.0 && pair[1].1 > 0.0).map(|pair| {
        let [(s_0, f_0, _), (s_1, f_1, _)] = [pair[0], pair[1]];
        s_0 - f_0 * (s_1 - s_0) / (f_1 - f_0)
    })
}

/// The first slip from light braking on at which a pull passes zero.
fn first_zero(pull: impl Fn(f64) -> f64) -> Option<f64> {
    const FROM: f64 = -0.3;
    const STEP: f64 = 0.05;
    const STEPS: u32 = 24;
    const TOLERANCE: f64 = 1e-6;
    let at = |step: u32| FROM + STEP * f64::from(step);
    let step = (0..STEPS).find(|&step| pull(at(step)) <= 0.0 && pull(at(step + 1)) > 0.0)?;
    Some(root::between(pull, at(step), at(step + 1), TOLERANCE))
}

/// The mean over kinds of the interval score over the standard deviation of what was measured.
fn score(found: &Evidence, judged: &[Judged]) -> Option<f64> {
    let of = |it: &Judged| {
        let measured = found.answers.iter().filter(|answer| answer.kind == it.kind);
        let values: Vec<f64> = measured.map(|answer| answer.measured).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        let deviation = (squares / values.len() as f64).sqrt();
        (deviation > 0.0).then(|| it.interval_score / deviation)
    };
    mean_score(judged.iter().filter_map(of))
}

impl AnswersRecord {
    fn of(it: &Judged) -> Self {
        let unit = if it.kind == AnswerKind::Heading { 1.0_f64.to_degrees() } else { 1.0 };
        Self {
            kind: it.kind.name(),
            numbers: it.count,
            rmse: unit * it.rmse,
            worst: unit * it.worst,
            held: it.held as f64 / it.count as f64,
            width: unit * it.width,
            interval_score: unit * it.interval_score,
        }
    }
}
