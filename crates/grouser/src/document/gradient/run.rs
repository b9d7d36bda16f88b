//! Derivatives of runs, by differences of whole runs.

use super::{AskedKey, GradientKeys, NoSuchKey, asked};
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::document::columns::Column;
use crate::document::columns::run::{RECORD, STANDING};
use crate::document::unit::{M_S, W};
use crate::document::varied::{Key, Varied};
use crate::document::{Described as _, LoadedScenario};
use crate::simulation::{Approach, Record, Run, RunError, Scenario, Trajectory};
use crate::studies::ensemble::outputs_while;

/// The numbers of runs: those of their scenarios.
#[derive(Clone, Debug)]
pub struct RunKeys {
    keys: Vec<AskedKey>,
}

/// The derivatives of a run's records.
#[derive(Clone, Debug, PartialEq)]
pub struct RunDerivatives {
    /// By each key, those of each result of the first record, then of the next; none of a result
    /// that a record lacks, and none at all by a key that cannot be changed alone, or with which the
    /// run ends otherwise to both sides.
    by_key: Vec<Option<Vec<Option<Derivative>>>>,
    results: usize,
}

/// Numbers that say when records are made: with others there would be none at the same times.
const TIMES: [&str; 2] = ["duration_s", "sample_interval_s"];

/// Step lengths for runs that are integrated by steps of their own, whose ends scatter by some 1e-8
/// of the way.
const INTEGRATED: StepLengths = StepLengths { long: 3e-3, short: 1e-3, tolerance: 1e-3 };

impl RunKeys {
    /// The numbers that are asked for.
    ///
    /// # Errors
    /// [`NoSuchKey`] for one that scenarios do not have, and for the times of records.
    pub fn of(scenario: &LoadedScenario, asked_for: &GradientKeys) -> Result<Self, NoSuchKey> {
        let varied = Varied::of(scenario.value.clone(), scenario.document.clone());
        let names = match asked_for {
            GradientKeys::These(names) => names.clone(),
            GradientKeys::All => {
                let all = scenario.document.number_keys().into_iter();
                let acts = |key: &String| {
                    !TIMES.contains(&&**key)
                        && asked(key, key, &varied).is_ok_and(|it| it.key.is_some())
                };
                all.filter(acts).collect()
            }
        };
        if let Some(key) = names.iter().find(|it| TIMES.contains(&&***it)) {
            let reason = "it says when there are records, which are compared at the same times";
            return Err(NoSuchKey { key: key.clone(), reason: reason.to_owned() });
        }
        let keys = names.iter().map(|name| asked(name, name, &varied));
        Ok(Self { keys: keys.collect::<Result<_, _>>()? })
    }

    /// The names of the keys, in the order of derivatives.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|key| &*key.name)
    }

    /// The keys that the document gives no value.
    pub fn lacking(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().filter(|key| key.key.is_none()).map(|key| &*key.name)
    }

    /// The names of the results that are differentiated.
    ///
    /// * `on_heights`: whether the ground has heights
    #[must_use]
    pub fn results(on_heights: bool) -> Vec<&'static str> {
        results(on_heights).map(|column| column.name).collect()
    }

    /// How many runs their derivatives ask to go on with, where nothing bends: whole ones, and as
    /// many that only begin.
    #[must_use]
    pub fn runs(&self) -> usize {
        4 * (self.keys.len() + 1)
    }

    /// The derivatives of a run's records, by differences of whole runs; of the first one, how the
    /// rover stands and sets off, by shorter ones of that record alone.
    ///
    /// * `scenario`: what was run
    /// * `number`: what its document has under a key
    /// * `run`: what became of it
    /// * `lead`: how it was led to its end, and others are
    /// * `go_on`: asked before each run, from any thread; nothing is returned once it is false
    #[must_use]
    pub fn along(
        &self,
        scenario: &Scenario,
        number: &dyn Fn(&str) -> Option<f64>,
        run: &Trajectory,
        lead: fn(Run) -> Result<Trajectory, RunError>,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<RunDerivatives> {
        let beside = Beside::of(self, scenario, number, run);
        let lengths = steps(scenario);
        let of_point = |point: &Vec<f64>| {
            let other = Run::new(&beside.changed(point)?).and_then(lead).ok()?;
            if is_beside(run, &other) {
                beside.numbers(&other.records, beside.kept.len())
            } else {
                None
            }
        };
        let mut found = beside.derivatives(beside.kept.len(), lengths, go_on, of_point)?;
        // Nothing is integrated before the first record: how the rover stands is exact.
        let first = beside.kept.iter().take_while(|cell| **cell < beside.columns.len()).count();
        let begun = |point: &Vec<f64>| {
            let start = Run::new(&beside.changed(point)?).ok()?;
            beside.numbers(std::slice::from_ref(start.now()), first)
        };
        let start = beside.derivatives(first, StepLengths::SETTLED, go_on, begun)?;
        for (all, own) in found.iter_mut().zip(start) {
            all.iter_mut().zip(own).for_each(|(all, own)| all[..first].copy_from_slice(&own));
        }
        let in_place = |slopes: Vec<Derivative>| {
            let mut all = vec![None; run.records.len() * beside.columns.len()];
            beside.kept.iter().zip(slopes).for_each(|(cell, slope)| all[*cell] = Some(slope));
            all
        };
        let by_key = found.into_iter().map(|it| it.map(in_place)).collect();
        Some(RunDerivatives { by_key, results: beside.columns.len() })
    }
}

/// A run, and others beside it.
struct Beside<'a> {
    scenario: &'a Scenario,
    keys: Vec<AskedKey>,
    variables: Vec<Variable>,
    columns: Vec<&'static Column<Record>>,
    /// Places of the numbers that the run has, record by record.
    kept: Vec<usize>,
    /// These numbers.
    here: Vec<f64>,
}

impl<'a> Beside<'a> {
    fn of(
        keys: &RunKeys,
        scenario: &'a Scenario,
        number: &dyn Fn(&str) -> Option<f64>,
        run: &Trajectory,
    ) -> Self {
        let columns: Vec<&Column<Record>> = results(!scenario.ground.is_plane()).collect();
        let numbers = |record| columns.iter().map(move |column| column.number(record));
        let cells: Vec<f64> = run.records.iter().flat_map(numbers).collect();
        let kept: Vec<usize> = (0..cells.len()).filter(|cell| cells[*cell].is_finite()).collect();
        let here = kept.iter().map(|cell| cells[*cell]).collect();
        let keys: Vec<AskedKey> = keys.names().map(|it| key_of(it, scenario, number)).collect();
        let variables = keys.iter().map(|key| key.variable(None)).collect();
        Self { scenario, keys, variables, columns, kept, here }
    }

    /// The scenario with other numbers.
    fn changed(&self, point: &[f64]) -> Option<Scenario> {
        let moved = self.keys.iter().zip(point).zip(&self.variables);
        let moved = moved.filter(|((_, number), variable)| **number != variable.value);
        let moved =
            moved.filter_map(|((key, number), _)| Some((&*key.key.as_ref()?.path, *number)));
        self.scenario.with(moved).ok()
    }

    /// The first of the run's numbers in other records, where all are there.
    fn numbers(&self, records: &[Record], count: usize) -> Option<Vec<f64>> {
        let each = self.columns.len();
        let number = |cell: &usize| self.columns[cell % each].number(&records[cell / each]);
        let found: Vec<f64> = self.kept[..count].iter().map(number).collect();
        found.iter().all(|it| it.is_finite()).then_some(found)
    }

    /// The derivatives of the first of the run's numbers; nothing if `go_on` was false on the way.
    fn derivatives(
        &self,
        count: usize,
        lengths: StepLengths,
        go_on: &(dyn Fn() -> bool + Sync),
        of_point: impl Fn(&Vec<f64>) -> Option<Vec<f64>> + Sync + Send,
    ) -> Option<Vec<Option<Vec<Derivative>>>> {
        let size = |cell: &usize| size(self.columns[cell % self.columns.len()]);
        let sizes: Vec<f64> = self.kept[..count].iter().map(size).collect();
        let mut was_stopped = false;
        let mut evaluate = |points: &[Vec<f64>]| {
            let found = outputs_while(points, go_on, &of_point);
            was_stopped |= found.is_none();
            found.unwrap_or_else(|| vec![None; points.len()])
        };
        let here = &self.here[..count];
        let found = derivatives(&self.variables, here, &sizes, lengths, &mut evaluate);
        (!was_stopped).then_some(found.by_variable)
    }
}

impl RunDerivatives {
    /// The derivatives of a record: of each result by the first key, then by the next.
    pub fn of_record(&self, record: usize) -> impl Iterator<Item = Option<Derivative>> {
        let keys = 0..self.by_key.len();
        keys.flat_map(move |key| (0..self.results).map(move |result| self.at(record, result, key)))
    }

    /// The derivative of a record's result by a key, by their places.
    #[must_use]
    pub fn at(&self, record: usize, result: usize, key: usize) -> Option<Derivative> {
        self.by_key[key].as_ref()?[record * self.results + result]
    }
}

/// What a record says beside its time, but for how far the belly is off the ground, which most
/// rovers do not state.
fn results(on_heights: bool) -> impl Iterator<Item = &'static Column<Record>> {
    const ALL: (&[Column<Record>], &[Column<Record>]) =
        (RECORD.split_at(1).1, STANDING.split_at(4).0);
    ALL.0.iter().chain(ALL.1.iter().filter(move |_| on_heights))
}

/// What a change of a result is small against where it is near zero, in its unit.
fn size(column: &Column<Record>) -> f64 {
    match column.unit {
        unit if unit == M_S => 0.01,
        unit if unit == W => 0.1,
        _ => 1.0,
    }
}

/// A key with its number as it is in a scenario, where that has one.
fn key_of(path: &str, scenario: &Scenario, number: &dyn Fn(&str) -> Option<f64>) -> AskedKey {
    let found = number(path).zip(scenario.range(path));
    let key = found.map(|(value, range)| Key { path: path.to_owned(), value, range });
    AskedKey { name: path.to_owned(), key }
}

/// Runs that follow one table of steady motions are as smooth as that.
fn steps(scenario: &Scenario) -> StepLengths {
    if scenario.numerics.approach == Approach::QuasiSteady && scenario.ground.is_plane() {
        StepLengths::SETTLED
    } else {
        INTEGRATED
    }
}

/// Whether another run has records at the same times.
fn is_beside(run: &Trajectory, other: &Trajectory) -> bool {
    let times =
        |it: &Trajectory| it.records.iter().map(|record| record.time.to_bits()).collect::<Vec<_>>();
    run.outcome.name() == other.outcome.name() && times(run) == times(other)
}
