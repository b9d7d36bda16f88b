//! A traverse in a few numbers: its length, drift, slip, sinkage and energy.

use crate::elementary::wide::hypot;
use crate::simulation::{Record, Scenario, Trajectory, WheelRecord};

/// Length, drift and means of a traverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Length of the way [m], from record to record, with the height of ground that has heights.
    pub distance: f64,
    /// Drift per metre travelled [m/m], −1 to 1: the way straight down the ground, positive
    /// downhill, over the distance, as
    /// [`HeadingOffset::drift`](crate::studies::heading::HeadingOffset::drift); 0 on level ground.
    /// Missing for a rover that did not move.
    pub drift: Option<f64>,
    /// Slip ratio [-], the mean over wheels and records. Missing where no record has its wheels.
    pub slip_ratio: Option<f64>,
    /// Sinkage [m], the mean over wheels and records.
    pub sinkage: Option<f64>,
    /// Mean power of the motors [W]. Missing for a run of no duration.
    pub power: Option<f64>,
    /// Work of the motors [J].
    pub energy: f64,
    /// Work of the motors over the length of the way [J/m].
    pub energy_per_metre: Option<f64>,
    /// Electrical energy that motors, and with a battery the electronics, took [J]. Missing where
    /// no motor is known.
    pub battery_energy: Option<f64>,
    /// Largest current of a motor, driving or braking [A], over the records. Missing where no motor
    /// is known.
    pub current: Option<f64>,
}

impl Drive {
    /// The numbers of a run of a scenario; means are over its records.
    #[must_use]
    pub fn of(run: &Trajectory, scenario: &Scenario) -> Self {
        /// A shorter way counts as standing still [m].
        const STILL: f64 = 1e-9;
        let last = run.last();
        let steps = run.records.windows(2);
        let length = |pair: &[Record]| {
            let height = |record: &Record| record.standing().map_or(0.0, |it| it.height);
            let level = (pair[1].state.position - pair[0].state.position).norm();
            if pair[0].origin.is_none() {
                level
            } else {
                hypot(level, height(&pair[1]) - height(&pair[0]))
            }
        };
        let distance: f64 = steps.map(length).sum();
        let per_metre = |quantity: f64| (distance > STILL).then(|| quantity / distance);
        let energy = last.energy.motors;
        let wheels = run.records.iter().flat_map(|record| &record.wheels);
        let currents = wheels.filter_map(|wheel| Some(wheel.electrical?.current.abs()));
        let current = currents.reduce(f64::max);
        Self {
            distance,
            drift: per_metre(down(run, scenario)),
            slip_ratio: mean(run, |wheel| wheel.reaction.slip.ratio),
            sinkage: mean(run, |wheel| wheel.reaction.settled.sinkage),
            power: (last.time > 0.0).then(|| energy / last.time),
            energy,
            energy_per_metre: per_metre(energy),
            battery_energy: current.map(|_| last.energy.electrical),
            current,
        }
    }
}

/// Way straight down the ground, from record to record [m].
fn down(run: &Trajectory, scenario: &Scenario) -> f64 {
    let start = (run.records[0].state.position, 0.0);
    let each = run.records.iter().skip(1);
    let (_, down) = each.fold(start, |before, record| {
        (record.state.position, scenario.way_down(before, &record.state))
    });
    down
}

fn mean(run: &Trajectory, quantity: fn(&WheelRecord) -> f64) -> Option<f64> {
    let all = run.records.iter().flat_map(|sample| &sample.wheels).map(quantity);
    let (count, sum) = all.fold((0_usize, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / count as f64)
}
