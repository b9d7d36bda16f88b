//! Errors of a wheel–soil model against measured wheel tests: every trial is predicted at its own
//! load and motion, averaged over the trials of a cell, and compared over cells of equal weight.

mod errors;
mod yardstick;

use rayon::prelude::*;

use self::errors::root_mean_square;
pub use self::errors::{Aim, Comparison, Errors, mean_score};
pub use self::yardstick::{Placed, Yardstick};
use crate::contact::validity::{self, Finding, Situation};
use crate::contact::{Model, SettleError, Settled};
use crate::soil::Soil;
use crate::studies::measurement::{Cell, PerQuantity, Quantity, WheelTests};
use crate::wheel::Wheel;

/// Measured tests, and the model to compare with them.
///
/// How far is the predicted drawbar pull of a smooth wheel from the measured one?
///
/// ```
/// use grouser::contact::Model;
/// use grouser::document::measurements::{self, Choice};
/// use grouser::document::{self, Kind, Overrides, Source};
/// use grouser::studies::validation::ValidationStudy;
///
/// let source = Source::find(Kind::DataSet, "cmu-single-wheel")?;
/// let data_set = document::read_data_set(&source, &Overrides::none())?.value;
/// let smooth = &data_set.cases[0];
/// let choice = Choice { conditions: smooth.conditions.clone(), ..Choice::default() };
/// let rows = measurements::Source::preset("cmu-single-wheel").expect("it comes with the library");
/// let tests = rows.read(&choice)?.tests;
///
/// let validation = ValidationStudy {
///     tests: &tests,
///     wheel: smooth.tested.wheel().expect("it is a wheel test").value,
///     soil: smooth.soils[0].1.value,
///     model: Model::SmallWheel,
///     gravity: data_set.gravity,
/// }
/// .run();
/// let errors = validation.overall.errors.drawbar_pull.expect("it was measured");
/// assert_eq!(format!("{:.1} N in {} cells", errors.rmse, errors.cells), "1.2 N in 36 cells");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ValidationStudy<'a> {
    /// The measured trials.
    pub tests: &'a WheelTests,
    /// The wheel that was tested.
    pub wheel: Wheel,
    /// The soil it was tested on.
    pub soil: Soil,
    /// The wheel–soil model.
    pub model: Model,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
}

/// Predictions beside measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Validation {
    /// The prediction of each trial, in the order of the tests.
    pub predictions: Vec<Result<Settled, SettleError>>,
    /// Each cell, in the order of the tests.
    pub cells: Vec<CellComparison>,
    /// The errors of driven and of skidding cells at each slip angle, angles ascending.
    pub groups: Vec<Group>,
    /// The errors of all driven cells, where there are any.
    pub driven: Option<Group>,
    /// The errors of all skidding cells, where there are any.
    pub skid: Option<Group>,
    /// The errors of all cells.
    pub overall: Group,
    /// The errors of predictions without physics, of those yardsticks that the set allows.
    pub references: Vec<Reference>,
}

/// A cell's means.
#[derive(Clone, Debug, PartialEq)]
pub struct CellComparison {
    /// Slip angle that was set, *β* [rad].
    pub slip_angle: f64,
    /// Rim speed that was set [m/s].
    pub rim_speed: Option<f64>,
    /// Slip by the total speed, *S* [-].
    pub total_slip: f64,
    /// Load, the mean over the trials [N].
    pub load: f64,
    /// Whether the wheel drives.
    pub driven: bool,
    /// Number of trials.
    pub trials: usize,
    /// Number of trials whose wheel the soil cannot carry in the model.
    pub unsettled: usize,
    /// Each quantity's means; `None` where it was not measured, or not in a trial that settles.
    pub quantities: PerQuantity<Option<Comparison>>,
    /// The flags of its trials together.
    pub findings: Vec<Finding>,
}

/// Cells judged together.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Their slip angle [rad]; `None` for several.
    pub slip_angle: Option<f64>,
    /// Whether they are driven; `None` for both kinds.
    pub driven: Option<bool>,
    /// Number of cells.
    pub cells: usize,
    /// Number of trials.
    pub trials: usize,
    /// Number of trials whose wheel the soil cannot carry in the model: they are in no error.
    pub unsettled: usize,
    /// The errors of each quantity; `None` where it was not measured.
    pub errors: PerQuantity<Option<Errors>>,
}

/// The errors of predictions without physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// How they were predicted.
    pub yardstick: Yardstick,
    /// The errors of all driven cells, where there are any.
    pub driven: Option<Group>,
    /// The errors of all skidding cells, where there are any.
    pub skid: Option<Group>,
    /// The errors of all cells.
    pub overall: Group,
}

impl ValidationStudy<'_> {
    /// Predicts every trial, in parallel, and computes the errors.
    #[must_use]
    pub fn run(&self) -> Validation {
        let predict = |trial: &crate::studies::measurement::Trial| {
            trial.predict(self.model.as_ref(), &self.wheel, &self.soil, self.gravity)
        };
        let predictions = self.tests.trials.par_iter().map(predict).collect();
        let mut validation = Validation::of(self.tests, predictions);
        for (cell, comparison) in self.tests.cells.iter().zip(&mut validation.cells) {
            let trials = cell
                .trials
                .iter()
                .map(|&trial| self.situation(trial, validation.predictions[trial].as_ref().ok()));
            comparison.findings = validity::union(trials);
        }
        validation
    }

    /// What the rules of validity look at in a trial.
    fn situation<'a>(&'a self, trial: usize, settled: Option<&'a Settled>) -> Situation<'a> {
        let trial = &self.tests.trials[trial];
        Situation {
            model: &self.model,
            wheel: &self.wheel,
            soil: &self.soil,
            gravity: self.gravity,
            slope: 0.0,
            load: Some(trial.load),
            slip: Some(trial.slip),
            settled,
        }
    }
}

impl Validation {
    /// Computes the errors of given predictions.
    ///
    /// * `predictions`: one for each trial, in their order
    #[must_use]
    pub fn of(tests: &WheelTests, predictions: Vec<Result<Settled, SettleError>>) -> Self {
        let cells: Vec<CellComparison> =
            tests.cells.iter().map(|cell| compare(tests, cell, &predictions)).collect();
        let mut angles: Vec<f64> = cells.iter().map(|cell| cell.slip_angle).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        let kinds = angles.into_iter().flat_map(|angle| [true, false].map(|kind| (angle, kind)));
        let groups =
            kinds.filter_map(|(angle, driven)| {
                group(&cells, |it| it.slip_angle == angle && it.driven == driven)
                    .map(|group| Group { slip_angle: Some(angle), driven: Some(driven), ..group })
            });
        Self {
            groups: groups.collect(),
            driven: of_kind(&cells, true),
            skid: of_kind(&cells, false),
            overall: group(&cells, |_| true).unwrap_or_else(Group::empty),
            references: Yardstick::ALL.into_iter().filter_map(|it| reference(tests, it)).collect(),
            cells,
            predictions,
        }
    }
}

/// The errors of driven, or of skidding cells, where there are any.
fn of_kind(cells: &[CellComparison], driven: bool) -> Option<Group> {
    group(cells, |it| it.driven == driven).map(|group| Group { driven: Some(driven), ..group })
}

/// The errors of a prediction without physics; `None` if it predicts no cell.
fn reference(tests: &WheelTests, yardstick: Yardstick) -> Option<Reference> {
    let mut cells: Vec<CellComparison> =
        tests.cells.iter().map(|cell| measured_alone(tests, cell)).collect();
    for quantity in Quantity::ALL {
        let places = cells.iter().enumerate().filter_map(|(place, cell)| {
            let it = cell.quantities[quantity]?;
            Some((
                place,
                Placed { series: cell.slip_angle, x: cell.total_slip, value: it.measured },
            ))
        });
        let (places, placed): (Vec<usize>, Vec<Placed>) = places.unzip();
        for (place, predicted) in places.into_iter().zip(yardstick.predict(&placed)) {
            let it = &mut cells[place].quantities[quantity];
            *it = it.zip(predicted).map(|(it, predicted)| Comparison { predicted, ..it });
        }
    }
    let overall = group(&cells, |_| true)?;
    Quantity::ALL.into_iter().any(|it| overall.errors[it].is_some()).then(|| Reference {
        yardstick,
        driven: of_kind(&cells, true),
        skid: of_kind(&cells, false),
        overall,
    })
}

/// A cell beside its predictions.
fn compare(
    tests: &WheelTests,
    cell: &Cell,
    predictions: &[Result<Settled, SettleError>],
) -> CellComparison {
    let predicted = |trial: usize, quantity: Quantity| {
        predictions[trial].as_ref().ok().map(|settled| quantity.of(settled))
    };
    let unsettled = cell.trials.iter().filter(|&&trial| predictions[trial].is_err()).count();
    CellComparison { unsettled, ..beside(tests, cell, &predicted) }
}

/// A cell with its measurements, each in place of its prediction.
#[must_use]
pub fn measured_alone(tests: &WheelTests, cell: &Cell) -> CellComparison {
    let as_measured = |trial: usize, quantity: Quantity| {
        tests.trials[trial].readings[quantity].map(|reading| reading.value)
    };
    beside(tests, cell, &as_measured)
}

/// * `predicted`: the prediction of a quantity of a trial, where there is one
fn beside(
    tests: &WheelTests,
    cell: &Cell,
    predicted: &dyn Fn(usize, Quantity) -> Option<f64>,
) -> CellComparison {
    let loads = cell.trials.iter().map(|&trial| tests.trials[trial].load);
    CellComparison {
        load: loads.sum::<f64>() / cell.trials.len() as f64,
        slip_angle: cell.slip_angle,
        rim_speed: cell.rim_speed,
        total_slip: cell.total_slip,
        driven: cell.is_driven(),
        trials: cell.trials.len(),
        unsettled: 0,
        quantities: PerQuantity::from_fn(|quantity| means(tests, cell, predicted, quantity)),
        findings: Vec::new(),
    }
}

/// * `predicted`: the prediction of a quantity of a trial, where there is one
fn means(
    tests: &WheelTests,
    cell: &Cell,
    predicted: &dyn Fn(usize, Quantity) -> Option<f64>,
    quantity: Quantity,
) -> Option<Comparison> {
    let pairs = cell.trials.iter().filter_map(|&trial| {
        Some((tests.trials[trial].readings[quantity]?, predicted(trial, quantity)?))
    });
    let pairs: Vec<_> = pairs.collect();
    let mean = |values: &dyn Fn(usize) -> f64| {
        (0..pairs.len()).map(values).sum::<f64>() / pairs.len() as f64
    };
    if pairs.is_empty() {
        return None;
    }
    let measured = mean(&|place| pairs[place].0.value);
    let squares: f64 = pairs.iter().map(|(reading, _)| (reading.value - measured).powi(2)).sum();
    let scatters: Vec<f64> = pairs.iter().filter_map(|(reading, _)| reading.scatter).collect();
    Some(Comparison {
        measured,
        predicted: mean(&|place| pairs[place].1),
        trials: pairs.len(),
        repeatability: (pairs.len() > 1).then(|| (squares / (pairs.len() - 1) as f64).sqrt()),
        scatter: root_mean_square(&scatters),
    })
}

/// The errors of the cells that belong to a group, if there are any.
fn group(cells: &[CellComparison], belongs: impl Fn(&CellComparison) -> bool) -> Option<Group> {
    let members: Vec<&CellComparison> = cells.iter().filter(|cell| belongs(cell)).collect();
    let load = members.iter().map(|cell| cell.load).sum::<f64>() / members.len() as f64;
    let unsettled = members.iter().map(|cell| cell.unsettled).sum();
    (!members.is_empty()).then(|| Group {
        slip_angle: None,
        driven: None,
        cells: members.len(),
        trials: members.iter().map(|cell| cell.trials).sum(),
        unsettled,
        errors: PerQuantity::from_fn(|quantity| {
            let of_cells = members.iter().filter_map(|cell| cell.quantities[quantity]);
            let errors = Errors::of(&of_cells.collect::<Vec<_>>())?;
            Some(errors.with_aim_for(quantity, load, unsettled == 0))
        }),
    })
}

impl Group {
    fn empty() -> Self {
        let errors = PerQuantity::default();
        Self { slip_angle: None, driven: None, cells: 0, trials: 0, unsettled: 0, errors }
    }

    /// The score: each quantity's error over the standard deviation of what was measured, averaged
    /// over the measured quantities [-]. 0 is perfect, 1 no better than the mean.
    #[must_use]
    pub fn score(&self) -> Option<f64> {
        mean_score(Quantity::ALL.into_iter().filter_map(|it| self.errors[it]?.score()))
    }
}
