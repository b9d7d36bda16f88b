//! Stretches of like conditions together, and the errors of each prediction over all such cells.

use super::conditions::Conditions;
use super::quantity::{DriveQuantity, DriveValues};
use super::recorded::Split;
use crate::contact::Model;
use crate::studies::slope_tests::Mean;
use crate::studies::validation::{Comparison, Errors, Placed, Yardstick, mean_score};

/// A stretch of a drive beside what each model predicts.
pub(super) struct JudgedStretch {
    pub(super) drive: usize,
    pub(super) split: Split,
    pub(super) conditions: Conditions,
    pub(super) measured: DriveValues,
    /// By model; `None` where it knows no steady motion.
    pub(super) predicted: Vec<Option<DriveValues>>,
}

const QUANTITIES: usize = DriveQuantity::ALL.len();

/// Stretches of like conditions over all drives of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveCell {
    /// The set of its drives.
    pub split: Split,
    /// What the rover met.
    pub conditions: Conditions,
    /// How many drives have such stretches: they repeat each other.
    pub trials: usize,
    /// What was measured: means over trials, and the standard deviation between them.
    pub measured: [Option<Mean>; QUANTITIES],
    /// What each model predicts, over the same stretches.
    pub predicted: Vec<DriveValues>,
    /// The number of trials, for each model, without a stretch for which it knows a steady motion.
    pub no_prediction: Vec<usize>,
}

/// What predicts.
#[derive(Clone, Debug, PartialEq)]
pub enum Predictor {
    /// A wheel–soil model with the soil.
    Model(Model),
    /// The other cells alone.
    Yardstick(Yardstick),
}

impl Predictor {
    /// The name of the model or of the yardstick.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Model(model) => model.name(),
            Self::Yardstick(yardstick) => yardstick.name(),
        }
    }
}

/// The errors of a prediction over the cells of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedPrediction {
    /// What predicts.
    pub by: Predictor,
    /// The set.
    pub split: Split,
    /// The errors of each quantity that was measured. In a cell without a prediction the mean of
    /// what was measured stands in, so that all are judged on the same cells.
    pub errors: [Option<Errors>; QUANTITIES],
    /// The root mean square error of each quantity over the standard deviation between all cells, of
    /// both sets [-]: a set in which a quantity hardly differs would judge by its noise.
    pub scores: DriveValues,
    /// Their mean [-].
    pub score: Option<f64>,
    /// Trials, all cells together, and those of them without a prediction.
    pub trials: [usize; 2],
}

/// The cells of the training set, then those of the test set, by their conditions.
///
/// * `models`: how many there are
pub(super) fn cells_of(mut readings: Vec<JudgedStretch>, models: usize) -> Vec<DriveCell> {
    readings.sort_by(|one, other| {
        let by_set = one.split.cmp(&other.split);
        let by_conditions = one.conditions.compare(&other.conditions);
        by_set.then(by_conditions).then(one.drive.cmp(&other.drive))
    });
    let is_same = |one: &JudgedStretch, other: &JudgedStretch| {
        one.split == other.split && one.conditions.compare(&other.conditions).is_eq()
    };
    readings.chunk_by(is_same).map(|it| DriveCell::of(it, models)).collect()
}

impl DriveCell {
    /// * `readings`: of one set and like conditions, by drive; at least one
    fn of(readings: &[JudgedStretch], models: usize) -> Self {
        let trials: Vec<&[JudgedStretch]> =
            readings.chunk_by(|one, other| one.drive == other.drive).collect();
        let measured: [Option<Mean>; QUANTITIES] = std::array::from_fn(|place| {
            let values =
                trials.iter().filter_map(|it| mean(it.iter().map(|it| it.measured[place])));
            mean_over(&values.collect::<Vec<_>>())
        });
        let predicted = (0..models).map(|model| {
            std::array::from_fn(|place| {
                // A model that knows no motion for some stretches is compared over the others.
                let errors =
                    trials.iter().map(|it| mean(it.iter().map(|it| it.error(model, place))));
                Some(measured[place]?.value + mean(errors)?)
            })
        });
        let without = |model: usize| {
            let is_without =
                |it: &&&[JudgedStretch]| it.iter().all(|it| it.predicted[model].is_none());
            trials.iter().filter(is_without).count()
        };
        Self {
            split: readings[0].split,
            conditions: readings[0].conditions,
            trials: trials.len(),
            measured,
            predicted: predicted.collect(),
            no_prediction: (0..models).map(without).collect(),
        }
    }
}

impl JudgedStretch {
    /// Prediction less measurement.
    fn error(&self, model: usize, quantity: usize) -> Option<f64> {
        Some(self.predicted[model].as_ref()?[quantity]? - self.measured[quantity]?)
    }
}

/// The mean of the values that are there.
fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let (sum, count) =
        values.flatten().fold((0.0, 0.0), |(sum, count), it| (sum + it, count + 1.0));
    (count > 0.0).then_some(sum / count)
}

fn mean_over(values: &[f64]) -> Option<Mean> {
    let value = mean(values.iter().copied().map(Some))?;
    let squares: f64 = values.iter().map(|it| (it - value).powi(2)).sum();
    let freedom = (values.len() - 1) as f64;
    let deviation = (freedom > 0.0).then(|| (squares / freedom).sqrt());
    Some(Mean { value, rows: values.len(), deviation })
}

/// Models, then yardsticks, on the cells of a set, best first.
///
/// Yardsticks know the cells of both sets: the mean of a set of one cell would be that cell.
pub(super) fn judged(all: &[DriveCell], models: &[Model], split: Split) -> Vec<JudgedPrediction> {
    let spreads: DriveValues = std::array::from_fn(|place| spread(all, place));
    let is_of_set = |it: &&DriveCell| it.split == split;
    let cells: Vec<&DriveCell> = all.iter().filter(is_of_set).collect();
    let trials: usize = cells.iter().map(|it| it.trials).sum();
    let judge = |by: Predictor, without: usize, of: &dyn Fn(usize) -> Vec<Option<f64>>| {
        let errors: [Option<Errors>; QUANTITIES] =
            std::array::from_fn(|place| errors(&cells, place, &of(place), middle(all, place)?));
        let scores = std::array::from_fn(|place| Some(errors[place]?.rmse / spreads[place]?));
        let score = mean_score(scores.into_iter().flatten());
        JudgedPrediction { by, split, errors, scores, score, trials: [trials, without] }
    };
    let of_models = models.iter().enumerate().map(|(model, it)| {
        let without = cells.iter().map(|it| it.no_prediction[model]).sum();
        let of = |place: usize| -> Vec<Option<f64>> {
            cells.iter().map(|it| it.predicted[model][place]).collect()
        };
        judge(Predictor::Model(it.clone()), without, &of)
    });
    let of_yardsticks = [Yardstick::Mean, Yardstick::Interpolation].into_iter().map(|it| {
        let of = |place: usize| {
            let predicted = over_slopes(all, place, it).into_iter().zip(all);
            predicted.filter(|(_, cell)| cell.split == split).map(|(value, _)| value).collect()
        };
        judge(Predictor::Yardstick(it), 0, &of)
    });
    [best_first(of_models.collect()), best_first(of_yardsticks.collect())].concat()
}

/// The standard deviation of a quantity between cells; `None` where it does not differ.
fn spread(cells: &[DriveCell], place: usize) -> Option<f64> {
    let middle = middle(cells, place)?;
    let values = cells.iter().map(|it| it.measured[place].map(|it| it.value));
    let square = mean(values.map(|it| it.map(|it| (it - middle).powi(2))))?;
    (square > 0.0).then(|| square.sqrt())
}

/// The mean of a quantity over cells.
fn middle(cells: &[DriveCell], place: usize) -> Option<f64> {
    mean(cells.iter().map(|it| it.measured[place].map(|it| it.value)))
}

fn best_first(mut all: Vec<JudgedPrediction>) -> Vec<JudgedPrediction> {
    let score = |it: &JudgedPrediction| it.score.unwrap_or(f64::INFINITY);
    all.sort_by(|one, other| score(one).total_cmp(&score(other)));
    all
}

/// The errors of a quantity; `None` where it was not measured.
///
/// * `middle`: what stands in for a prediction
fn errors(
    cells: &[&DriveCell],
    place: usize,
    predicted: &[Option<f64>],
    middle: f64,
) -> Option<Errors> {
    let pairs = cells.iter().zip(predicted).filter_map(|(cell, predicted)| {
        let Mean { value, rows, deviation } = cell.measured[place]?;
        Some(Comparison {
            measured: value,
            predicted: predicted.unwrap_or(middle),
            trials: rows,
            repeatability: deviation,
            scatter: None,
        })
    });
    Errors::of(&pairs.collect::<Vec<_>>())
}

/// What a yardstick predicts for each cell: the slope is what it interpolates over, all other
/// conditions alike.
fn over_slopes(cells: &[DriveCell], place: usize, yardstick: Yardstick) -> Vec<Option<f64>> {
    let mut series: Vec<Conditions> = Vec::new();
    let mut predicted = vec![None; cells.len()];
    let mut placed = Vec::new();
    for (cell, it) in cells.iter().enumerate() {
        let Some(mean) = it.measured[place] else { continue };
        let alike = it.conditions.but_for_slope();
        let known = series.iter().position(|it| *it == alike).unwrap_or_else(|| {
            series.push(alike);
            series.len() - 1
        });
        let at = Placed { series: known as f64, x: it.conditions.slope, value: mean.value };
        placed.push((cell, at));
    }
    let (places, placed): (Vec<usize>, Vec<Placed>) = placed.into_iter().unzip();
    for (cell, value) in places.into_iter().zip(yardstick.predict(&placed)) {
        predicted[cell] = value;
    }
    predicted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(drive: usize, slope: f64, measured: f64, predicted: Option<f64>) -> JudgedStretch {
        let values = |value: f64| [Some(value), None, None, None];
        JudgedStretch {
            drive,
            split: Split::Test,
            conditions: Conditions { slope, yaw: None, speed: 0.05, radius: None },
            measured: values(measured),
            predicted: vec![predicted.map(values)],
        }
    }

    /// Two drives read 0.1 and 0.3 on one slope: they are one cell of 0.2 ± 0.14. A drive of three
    /// stretches counts once, and a model is compared over the stretches that it knows.
    #[test]
    fn drives_of_one_cell_repeat_each_other() {
        let readings = vec![
            reading(0, 0.0, 0.1, Some(0.2)),
            reading(1, 0.0, 0.2, None),
            reading(1, 0.0, 0.3, Some(0.3)),
            reading(1, 0.0, 0.4, None),
            reading(1, 0.2, 0.5, None),
        ];
        let cells = cells_of(readings, 1);
        let [one, other] = &cells[..] else { panic!("{cells:?}") };
        let mean = one.measured[0].unwrap();
        assert!((mean.value - 0.2).abs() < 1e-12, "{mean:?}");
        assert!((mean.deviation.unwrap() - 0.02_f64.sqrt()).abs() < 1e-12);
        assert!((one.predicted[0][0].unwrap() - 0.25).abs() < 1e-12, "{one:?}");
        assert_eq!((one.no_prediction[0], other.no_prediction[0]), (0, 1));
        assert_eq!((other.predicted[0][0], one.measured[1]), (None, None));
    }

    /// A model that predicts one of two cells, and that exactly, is half as good as the mean in
    /// squares: it is not ranked on the cell that it knows alone.
    #[test]
    fn the_mean_stands_in_for_what_is_not_predicted() {
        let cells = cells_of(vec![reading(0, 0.0, 0.1, Some(0.1)), reading(0, 0.2, 0.3, None)], 1);
        let found = judged(&cells, &[Model::default()], Split::Test);
        let score = |place: usize| found[place].score.unwrap();
        assert!((score(0) - 0.5_f64.sqrt()).abs() < 1e-12, "{found:?}");
        let mean = found.iter().find(|it| it.by == Predictor::Yardstick(Yardstick::Mean));
        assert!((mean.unwrap().score.unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(found[0].trials, [2, 1]);
    }

    /// Of three cells one is in the test set: its yardsticks know the two others as well.
    #[test]
    fn the_mean_of_one_cell_is_not_that_cell() {
        let training = |slope: f64, measured: f64| JudgedStretch {
            split: Split::Training,
            ..reading(1, slope, measured, Some(measured))
        };
        let readings =
            vec![training(0.0, 0.1), training(0.2, 0.3), reading(0, 0.1, 0.26, Some(0.25))];
        let found = judged(&cells_of(readings, 1), &[Model::default()], Split::Test);
        let rmse = |place: usize| found[place].errors[0].unwrap().rmse;
        assert_eq!(found[0].by, Predictor::Model(Model::default()));
        assert!((rmse(0) - 0.01).abs() < 1e-12, "{found:?}");
        let by = |yardstick| {
            let place = found.iter().position(|it| it.by == Predictor::Yardstick(yardstick));
            rmse(place.unwrap())
        };
        assert!((by(Yardstick::Mean) - 0.04).abs() < 1e-12, "{found:?}");
        assert!((by(Yardstick::Interpolation) - 0.06).abs() < 1e-12, "{found:?}");
    }
}
