//! Single-wheel tests as an experiment: predicts the forces and the sinkage of every cell of a test
//! series.

use rayon::prelude::*;

use super::experiment::{Channel, Experiment, Measure, Observation, Place, Regime, Site};
use super::scatter::{self, Repeats};
use crate::contact::discrepancy::sense_of_rolling;
use crate::contact::{
    Contact, Model, SettleError, Settled, Slip, forces_many, settle, settle_many,
};
use crate::elementary::wide::{ln, sin};
use crate::error::{ParameterError, finite, not_negative};
use crate::soil::Soil;
use crate::studies::measurement::{Cell, PerQuantity, Quantity, Reading, Trial, WheelTests};
use crate::wheel::Wheel;

/// Makes a soil from parameter values.
pub type SoilOf<'a> = dyn Fn(&[f64]) -> Result<Soil, ParameterError> + Sync + 'a;

/// The detail in which a test series is predicted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resolution {
    /// Each trial at its own load and motion, averaged over the cell.
    Trials,
    /// Each cell at the mean load and motion of its trials: as many times faster as there are
    /// repeats. On the wheel tests of Pavlov and Johnson (2022) the two differ by a sixth of the
    /// trials' scatter or less (root mean square), at worst by 1.2 of it.
    #[default]
    Cells,
}

/// Model discrepancies of a test series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Discrepancies {
    /// One for each quantity.
    #[default]
    PerQuantity,
    /// One for each quantity of driven wheels, and another of skidding ones, which models
    /// predict less well.
    PerRegime,
}

/// A series of wheel tests, and the model to fit.
pub struct WheelTestExperiment<'a> {
    tests: WheelTests,
    setup: Setup<'a>,
    channels: Vec<Channel>,
    observations: Vec<Observation>,
    /// The quantity and the cell of each observation.
    sources: Vec<(Quantity, usize)>,
    places: Vec<Place>,
    /// The runs to predict, cell by cell.
    runs: Vec<Vec<Run>>,
}

/// A load and a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run {
    slip: Slip,
    load: f64,
}

/// A run that has settled in some soil.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SettledRun {
    load: f64,
    /// None where the soil does not carry the load, or there is none.
    slope: Option<SinkingSlope>,
}

/// What a wheel's readings do as it sinks on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SinkingSlope {
    /// Where it has settled [m].
    sinkage: f64,
    /// ∂F_z/∂h [N/m].
    stiffness: f64,
    /// The derivative of each reading by the sinkage.
    slopes: PerQuantity<f64>,
}

/// How far a wheel sinks for the differences of its forces, over its sinkage [-].
const SINKING: f64 = 1e-5;

/// Wheels at given sinkages, settled or not.
fn forces_at(model: &Model, wheels: &[(Contact, f64)]) -> Vec<Settled> {
    let forces = forces_many(model.as_ref(), wheels);
    let each = wheels.iter().zip(forces);
    each.map(|(&(_, sinkage), forces)| Settled { sinkage, forces, evaluations: 0 }).collect()
}

/// What a wheel is tested with, and what for.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// The wheel.
    pub wheel: Wheel,
    /// The wheel–soil model.
    pub model: &'a Model,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// Makes a soil from parameter values.
    pub soil_of: &'a SoilOf<'a>,
    /// How finely the tests are predicted.
    pub resolution: Resolution,
    /// Which observations share a model discrepancy.
    pub discrepancies: Discrepancies,
}

impl<'a> WheelTestExperiment<'a> {
    /// The experiment of a test series: an observation for each cell and each quantity read there.
    ///
    /// # Errors
    /// [`ParameterError`] for a load or a reading that is no number, or a negative load.
    pub fn new(tests: &WheelTests, setup: Setup<'a>) -> Result<Self, ParameterError> {
        for trial in &tests.trials {
            not_negative("load of a trial [N]", trial.load)?;
            for reading in Quantity::ALL.into_iter().filter_map(|one| trial.readings[one]) {
                finite("reading of a trial", reading.value)?;
            }
        }
        let runs = |cell| runs_of(tests, cell, setup.resolution);
        let mut experiment = Self {
            tests: tests.clone(),
            setup,
            channels: Vec::new(),
            observations: Vec::new(),
            sources: Vec::new(),
            places: Vec::new(),
            runs: tests.cells.iter().map(runs).collect(),
        };
        experiment.observe_all(None);
        Ok(experiment)
    }

    /// The same experiment, with the scatter of repeated trials taken about what parameter values
    /// predict of each: about the values of a first fit, say.
    ///
    /// Trials that repeat a setting still differ in their loads, by a tenth or more. What that
    /// does to their readings is no scatter, but a new experiment does not know better, and
    /// takes the trials for worse than they are.
    ///
    /// # Errors
    /// [`ParameterError`] if the values make no soil.
    pub fn with_scatter_about(mut self, values: &[f64]) -> Result<Self, ParameterError> {
        let soil = self.soil(values)?;
        soil.check()?;
        self.observe_all(Some(&soil));
        Ok(self)
    }

    /// The soil of parameter values: the first ones, if there are more.
    ///
    /// # Errors
    /// [`ParameterError`] if they make none, or one without stiffness under a wheel of this width.
    pub fn soil(&self, values: &[f64]) -> Result<Soil, ParameterError> {
        let soil = (self.setup.soil_of)(values)?;
        soil.check_under(&self.setup.wheel, self.setup.gravity)?;
        Ok(soil)
    }

    /// The quantity and the place of the cell of each observation.
    #[must_use]
    pub fn sources(&self) -> &[(Quantity, usize)] {
        &self.sources
    }

    /// What the stand would read of a wheel: for every soil and every load.
    ///
    /// A soil that cannot carry the load must not end a search, and should show it which way to
    /// turn: the wheel counts as one sunk to its axle, with all readings larger by
    /// 1 + ln(load/capacity), so that they come down as the soil gets stronger.
    #[must_use]
    pub fn readings(&self, soil: &Soil, slip: Slip, load: f64) -> PerQuantity<f64> {
        let run = self.contact(soil, slip);
        self.read(&run, load, settle(self.setup.model.as_ref(), &run, load))
    }

    fn contact(&self, soil: &Soil, slip: Slip) -> Contact {
        let Setup { wheel, gravity, .. } = self.setup;
        Contact { wheel, soil: *soil, slip, gravity }
    }

    /// What the stand reads of a wheel, or of one that is sunk to its axle.
    fn read(
        &self,
        contact: &Contact,
        load: f64,
        result: Result<Settled, SettleError>,
    ) -> PerQuantity<f64> {
        /// The load counts as no more than e^10 times what the soil carries.
        const WEAKEST: f64 = 10.0;
        match result {
            Ok(settled) => PerQuantity::from_fn(|quantity| quantity.of(&settled)),
            Err(error) => {
                let capacity = match error {
                    SettleError::SunkToAxle { capacity, .. } => capacity,
                    SettleError::BadLoad { .. } => 0.0,
                };
                let overload = (ln(load) - ln(capacity)).clamp(0.0, WEAKEST);
                let sinkage = contact.wheel.shearing_radius();
                let forces = self.setup.model.as_ref().forces(contact, sinkage);
                let sunk = Settled { sinkage, forces, evaluations: 0 };
                PerQuantity::from_fn(|quantity| quantity.of(&sunk) * (1.0 + overload))
            }
        }
    }

    /// What the stand would read in some cells, in each the mean over its runs.
    #[must_use]
    pub fn cell_readings(&self, soil: &Soil, cells: &[usize]) -> Vec<PerQuantity<f64>> {
        self.cells_settled(soil, cells).0
    }

    /// The readings of some cells, and the settled sinkage of each run [m], NaN where it has not
    /// settled.
    fn cells_settled(&self, soil: &Soil, cells: &[usize]) -> (Vec<PerQuantity<f64>>, Vec<f64>) {
        let runs = cells.iter().flat_map(|&cell| &self.runs[cell]);
        let wheels: Vec<(Contact, f64)> =
            runs.map(|run| (self.contact(soil, run.slip), run.load)).collect();
        let settled = settle_many(self.setup.model.as_ref(), &wheels);
        let sinkage =
            |result: &Result<Settled, _>| result.as_ref().map_or(f64::NAN, |it| it.sinkage);
        let sinkages = settled.iter().map(sinkage).collect();
        let readings = wheels
            .iter()
            .zip(settled)
            .map(|((contact, load), result)| self.read(contact, *load, result));
        (self.means(cells, readings), sinkages)
    }

    /// The mean of each cell's readings, which follow each other run by run.
    fn means(
        &self,
        cells: &[usize],
        mut readings: impl Iterator<Item = PerQuantity<f64>>,
    ) -> Vec<PerQuantity<f64>> {
        let mean = |&cell: &usize| {
            let count = self.runs[cell].len();
            let here: Vec<PerQuantity<f64>> = readings.by_ref().take(count).collect();
            PerQuantity::from_fn(|quantity| {
                here.iter().map(|reading| reading[quantity]).sum::<f64>() / (count as f64).max(1.0)
            })
        };
        cells.iter().map(mean).collect()
    }

    /// The runs in a soil, settled, with what their forces do there as they sink.
    ///
    /// * `kept`: the sinkages at which they have settled, where those are known
    fn settled_runs(&self, soil: &Soil, kept: &[f64]) -> Vec<SettledRun> {
        let runs = self.runs.iter().flatten();
        let wheels: Vec<(Contact, f64)> =
            runs.map(|run| (self.contact(soil, run.slip), run.load)).collect();
        let found: Vec<Option<f64>> = if kept.len() == wheels.len() {
            kept.iter().map(|sinkage| (!sinkage.is_nan()).then_some(*sinkage)).collect()
        } else {
            let settled = settle_many(self.setup.model.as_ref(), &wheels);
            settled.into_iter().map(|it| Some(it.ok()?.sinkage)).collect()
        };
        let at = |share: f64| {
            let sunk = wheels.iter().zip(&found).filter_map(|((contact, _), sinkage)| {
                let sinkage = (*sinkage)? * share;
                Some((*contact, sinkage))
            });
            forces_at(self.setup.model, &sunk.collect::<Vec<_>>()).into_iter()
        };
        let (mut above, mut below) = (at(1.0 - SINKING), at(1.0 + SINKING));
        let run = |((_, load), sinkage): (&(Contact, f64), &Option<f64>)| {
            let slope = sinkage.and_then(|sinkage| {
                let (above, below) = (above.next()?, below.next()?);
                let way = 2.0 * SINKING * sinkage;
                let stiffness = (below.forces.normal_force - above.forces.normal_force) / way;
                let slopes = PerQuantity::from_fn(|it| (it.of(&below) - it.of(&above)) / way);
                (stiffness > 0.0).then_some(SinkingSlope { sinkage, stiffness, slopes })
            });
            SettledRun { load: *load, slope }
        };
        wheels.iter().zip(&found).map(run).collect()
    }

    /// What the stand would read in a soil next to the one in which runs have settled: no wheel is
    /// settled again, but sinks on by as much as the load asks for. One that did not settle is read
    /// as a whole.
    fn cell_readings_beside(&self, settled: &[SettledRun], soil: &Soil) -> Vec<PerQuantity<f64>> {
        let slips = || self.runs.iter().flatten().map(|run| run.slip);
        let sunk = slips().zip(settled).filter_map(|(slip, run)| {
            let slope = run.slope.as_ref()?;
            Some((self.contact(soil, slip), slope.sinkage))
        });
        let mut forces = forces_at(self.setup.model, &sunk.collect::<Vec<_>>()).into_iter();
        let readings = slips().zip(settled).map(|(slip, run)| match &run.slope {
            Some(slope) => forces.next().map_or_else(PerQuantity::default, |there| {
                let sinking = (run.load - there.forces.normal_force) / slope.stiffness;
                PerQuantity::from_fn(|it| it.of(&there) + slope.slopes[it] * sinking)
            }),
            None => self.readings(soil, slip, run.load),
        });
        let every: Vec<usize> = (0..self.runs.len()).collect();
        self.means(&every, readings)
    }

    /// How what the stand would read at some settings changes with each number of a point: a list
    /// over the settings for each number, by differences at the settled sinkages. None where the
    /// point is no soil.
    ///
    /// * `settings`: motions and loads [N]
    /// * `values`: of the parameters at a point
    pub(super) fn slopes_at(
        &self,
        settings: &[(Slip, f64)],
        point: &[f64],
        values: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<Vec<PerQuantity<f64>>>> {
        /// Source: ours; coordinates are of order 1, and forces exact but for rounding.
        const STEP: f64 = 1e-5;
        let run = |&(slip, load): &(Slip, f64)| vec![Run { slip, load }];
        let (channels, observations, sources, places) = Default::default();
        let (tests, setup) = (self.tests.clone(), self.setup);
        let runs = settings.iter().map(run).collect();
        let at = Self { tests, setup, channels, observations, sources, places, runs };
        let settled = at.settled_runs(&at.soil(&values(point)).ok()?, &[]);
        let slopes = |axis: usize| {
            let beside = |by: f64| {
                let mut there = point.to_vec();
                there[axis] += by;
                Some(at.cell_readings_beside(&settled, &at.soil(&values(&there)).ok()?))
            };
            let pairs = beside(-STEP)?.into_iter().zip(beside(STEP)?);
            let slope = |(below, above): (PerQuantity<f64>, PerQuantity<f64>)| {
                PerQuantity::from_fn(|it| (above[it] - below[it]) / (2.0 * STEP))
            };
            Some(pairs.map(slope).collect())
        };
        (0..point.len()).map(slopes).collect()
    }

    /// The predictions of the observations by what the stand reads in each cell.
    fn observed<'r>(
        &'r self,
        cells: &'r [PerQuantity<f64>],
    ) -> impl Iterator<Item = f64> + use<'r, 'a> {
        self.sources.iter().map(|&(quantity, cell)| cells[cell][quantity])
    }

    /// Makes all observations anew.
    ///
    /// * `reference`: predicts the differences between trials that are no scatter
    fn observe_all(&mut self, reference: Option<&Soil>) {
        self.observations.clear();
        self.sources.clear();
        let expected = |trial: &Trial| {
            let readings = |soil| self.readings(soil, trial.slip, trial.load);
            reference.map_or_else(PerQuantity::default, readings)
        };
        let expected: Vec<PerQuantity<f64>> = self.tests.trials.iter().map(expected).collect();
        for quantity in Quantity::ALL {
            // Driven and skidding wheels scatter differently, and are pooled apart.
            for regime in [Regime::Driven, Regime::Skid] {
                self.observe(quantity, regime, &expected);
            }
        }
        self.places = self.places_of_observations();
    }

    /// Where each observation lies, and what its discrepancy is proportional to.
    fn places_of_observations(&self) -> Vec<Place> {
        let mut families: Vec<Quantity> = Vec::new();
        let place = |(&(quantity, cell), observation): (&(Quantity, usize), &Observation)| {
            let family = families.iter().position(|one| *one == quantity).unwrap_or_else(|| {
                families.push(quantity);
                families.len() - 1
            });
            let run = mean_run(&self.runs[cell]);
            let site = Site {
                slip: run.slip.total(),
                slip_angle: self.tests.cells[cell].slip_angle.abs(),
            };
            let weight = self.weight(quantity, &run, observation.value);
            let measure = match quantity {
                Quantity::Sinkage => Measure::Logarithmic,
                _ => Measure::Linear,
            };
            Place { family, site, weight, measure }
        };
        self.sources.iter().zip(&self.observations).map(place).collect()
    }

    /// What a discrepancy of a quantity is proportional to, as [`crate::contact::discrepancy`] adds
    /// it: in the quantity's SI unit.
    ///
    /// * `read`: the observation's value
    fn weight(&self, quantity: Quantity, run: &Run, read: f64) -> f64 {
        let sense = sense_of_rolling(&run.slip);
        let rolling = sense.abs().max(LEAST_SENSE).copysign(sense);
        let radius = self.setup.wheel.shearing_radius();
        match quantity {
            Quantity::DrawbarPull => run.load * rolling,
            Quantity::SideForce => run.load * sideways(run.slip.angle),
            Quantity::Torque => run.load * radius * rolling,
            Quantity::Sinkage => read.max(LEAST_SINKAGE * radius),
        }
    }

    /// Adds the observations of a quantity, if there are any.
    fn observe(&mut self, quantity: Quantity, regime: Regime, expected: &[PerQuantity<f64>]) {
        let tests = &self.tests;
        let cells: Vec<usize> = (0..tests.cells.len())
            .filter(|&cell| tests.cells[cell].is_driven() == (regime == Regime::Driven))
            .filter(|&cell| tests.readings_of(&tests.cells[cell], quantity).next().is_some())
            .collect();
        if cells.is_empty() {
            return;
        }
        let repeats: Vec<Repeats> =
            cells.iter().map(|&cell| repeats_of(tests, cell, quantity, expected)).collect();
        let regime = match self.setup.discrepancies {
            Discrepancies::PerQuantity => Regime::Any,
            Discrepancies::PerRegime => regime,
        };
        let channel = self.channel(Channel::Wheel { quantity, regime });
        let scatters = scatter::of_means(&repeats);
        for ((cell, repeats), scatter) in cells.into_iter().zip(&repeats).zip(scatters) {
            self.observations.push(Observation { value: repeats.mean(), scatter, channel });
            self.sources.push((quantity, cell));
        }
    }

    /// The place of a channel, which is added if it is new.
    fn channel(&mut self, channel: Channel) -> usize {
        let place = self.channels.iter().position(|one| *one == channel);
        place.unwrap_or_else(|| {
            self.channels.push(channel);
            self.channels.len() - 1
        })
    }
}

/// Readings of a quantity in a cell, without what was expected to tell its trials apart: their
/// mean is that of the readings.
fn repeats_of(
    tests: &WheelTests,
    cell: usize,
    quantity: Quantity,
    expected: &[PerQuantity<f64>],
) -> Repeats {
    let trials = tests.cells[cell].trials.iter();
    let read: Vec<(Reading, f64)> = trials
        .filter_map(|&trial| {
            let reading = tests.trials[trial].readings[quantity]?;
            Some((reading, expected[trial][quantity]))
        })
        .collect();
    let mean = read.iter().map(|(_, expected)| expected).sum::<f64>() / read.len() as f64;
    Repeats {
        values: read.iter().map(|(reading, expected)| reading.value - (expected - mean)).collect(),
        within: read.iter().filter_map(|(reading, _)| reading.scatter).collect(),
    }
}

/// What the discrepancy of a side force is proportional to, beside the load [-]: sin β, as the side
/// force is itself, and 0 straight ahead by symmetry. In between it counts as that of 7.5° at
/// least: half-way to the first slip angle at which a soil's discrepancy has values.
pub(super) fn sideways(slip_angle: f64) -> f64 {
    /// sin 7.5°.
    const LEAST: f64 = 0.130_526_192_220_051_6;
    if slip_angle == 0.0 { 0.0 } else { sin(slip_angle.abs()).max(LEAST).copysign(slip_angle) }
}

/// A locked wheel that is dragged sideways rolls this much at least, for the weight of its
/// discrepancy [-]: what a stand reads there is no symmetry of the soil's.
const LEAST_SENSE: f64 = 0.3;

/// A sinkage counts as this share of the radius at least, for the weight of its discrepancy [-].
const LEAST_SINKAGE: f64 = 0.02;

fn runs_of(tests: &WheelTests, cell: &Cell, resolution: Resolution) -> Vec<Run> {
    let trials = cell.trials.iter().map(|&trial| &tests.trials[trial]);
    let runs: Vec<Run> = trials.map(|trial| Run { slip: trial.slip, load: trial.load }).collect();
    if resolution == Resolution::Trials || runs.len() < 2 {
        return runs;
    }
    vec![mean_run(&runs)]
}

/// The mean load and motion of some runs.
fn mean_run(runs: &[Run]) -> Run {
    let mean = |of: &dyn Fn(&Run) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
    let slip = Slip {
        ratio: mean(&|run| run.slip.ratio),
        angle: mean(&|run| run.slip.angle),
        rim: mean(&|run| run.slip.rim),
        forward: mean(&|run| run.slip.forward),
        lateral: mean(&|run| run.slip.lateral),
        sideways: mean(&|run| run.slip.sideways),
        entering_side: mean(&|run| run.slip.entering_side),
    };
    Run { slip, load: mean(&|run| run.load) }
}

impl Experiment for WheelTestExperiment<'_> {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn observations(&self) -> &[Observation] {
        &self.observations
    }

    fn places(&self) -> &[Place] {
        &self.places
    }

    fn predict(&self, values: &[f64], predictions: &mut [f64]) -> Result<(), ParameterError> {
        self.predict_and_keep(values, predictions).map(drop)
    }

    /// Keeps the sinkages of all runs [m], NaN where one has not settled.
    fn predict_and_keep(
        &self,
        values: &[f64],
        predictions: &mut [f64],
    ) -> Result<Vec<f64>, ParameterError> {
        let soil = self.soil(values)?;
        soil.check()?;
        let every: Vec<usize> = (0..self.runs.len()).collect();
        let (cells, sinkages) = self.cells_settled(&soil, &every);
        for (prediction, found) in predictions.iter_mut().zip(self.observed(&cells)) {
            *prediction = found;
        }
        Ok(sinkages)
    }

    fn predict_beside(
        &self,
        values: &[f64],
        kept: &[f64],
        beside: &[Vec<f64>],
    ) -> Vec<Option<Vec<f64>>> {
        let soil = |values: &[f64]| {
            let soil = self.soil(values).ok()?;
            soil.check().ok()?;
            Some(soil)
        };
        let Some(here) = soil(values) else { return vec![None; beside.len()] };
        let settled = self.settled_runs(&here, kept);
        let one = |values: &Vec<f64>| {
            let cells = self.cell_readings_beside(&settled, &soil(values)?);
            Some(self.observed(&cells).collect())
        };
        beside.par_iter().map(one).collect()
    }
}
