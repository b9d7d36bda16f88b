//! A traverse where soil and model are uncertain: a run of each sample, and quantiles over them.
//!
//! What a run that ends early counts as is said by the
//! [table of outcomes](crate::simulation::OutcomeRow). A rover that gets stuck counts from then on
//! as slip 1, sunk to the axles, at the place where it ended; what it would cost to get on has no
//! bound. One that ends otherwise (it leaves its map, its battery is empty, it slides, tips over or
//! touches the ground) leaves the band from then on: nothing is known of where it would be, and it
//! is not stuck. Until then it counts, so that means over a run are over its time in the band.
//! [`Ends`] says which share ended early, and how.

mod ends;

use super::drive::Drive;
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability, outputs_while};
use crate::simulation::{
    InBand, OutcomeKind, Record, Run, RunError, SAME_TIME, Scatter, Scenario, Trajectory,
    WheelRecord,
};
use crate::vehicle::Rover;

pub use ends::Ends;

/// A traverse with quantiles over the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct TraverseBand {
    /// At each time that was asked for, in that order.
    pub times: Vec<TimeBand>,
    /// Place and yaw at the end, and the means of the whole run.
    pub run: RunBand,
}

/// The rover at one time, with quantiles over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeBand {
    /// Time since the start [s].
    pub time: f64,
    /// Along the contour [m].
    pub x: Option<Band>,
    /// Uphill [m].
    pub y: Option<Band>,
    /// Yaw [rad].
    pub yaw: Option<Band>,
    /// Height of the body's centre of mass [m]; none on a plane.
    pub height: Option<Band>,
    /// Roll [rad]; none on a plane.
    pub roll: Option<Band>,
    /// Pitch [rad]; none on a plane.
    pub pitch: Option<Band>,
    /// Slip ratio [-], mean of the wheels.
    pub slip_ratio: Option<Band>,
    /// Sinkage [m], mean of the wheels.
    pub sinkage: Option<Band>,
    /// Work of the motors so far [J].
    pub energy: Option<Band>,
    /// Samples that ended early until then.
    pub ends: Ends,
}

/// A run in a few numbers, with quantiles over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunBand {
    /// Along the contour, at the end [m].
    pub x: Option<Band>,
    /// Uphill, at the end [m].
    pub y: Option<Band>,
    /// Yaw, at the end [rad].
    pub yaw: Option<Band>,
    /// Height of the body's centre of mass, at the end [m]; none on a plane.
    pub height: Option<Band>,
    /// Roll, at the end [rad]; none on a plane.
    pub roll: Option<Band>,
    /// Pitch, at the end [rad]; none on a plane.
    pub pitch: Option<Band>,
    /// Length of the way [m].
    pub distance: Option<Band>,
    /// Slip ratio [-], mean over wheels and time.
    pub slip_ratio: Option<Band>,
    /// Sinkage [m], mean over wheels and time.
    pub sinkage: Option<Band>,
    /// Work of the motors [J].
    pub energy: Option<Band>,
    /// Work of the motors over the length of the way [J/m]; infinite in a sample that gets stuck.
    pub energy_per_metre: Option<Band>,
    /// Samples that completed the run.
    pub completed: Probability,
    /// Samples that ended early.
    pub ends: Ends,
}

/// The rover at one time in one sample.
#[derive(Clone, Copy)]
struct At {
    x: f64,
    y: f64,
    yaw: f64,
    /// How it stands on ground with heights: height [m], roll and pitch [rad].
    standing: Option<[f64; 3]>,
    slip_ratio: f64,
    sinkage: f64,
    energy: f64,
}

/// What the bands need of one sample. What is missing is so because the sample had left the band.
#[derive(Clone)]
struct OfSample {
    kind: OutcomeKind,
    /// When it ended [s].
    ended: f64,
    at: Vec<Option<At>>,
    end: Option<At>,
    distance: Option<f64>,
    /// Means of slip ratio and sinkage over the time in the band.
    slip_ratio: Option<f64>,
    sinkage: Option<f64>,
    energy_per_metre: Option<f64>,
}

impl TraverseBand {
    /// Runs each sample; the soil and the model of `scenario` are not used. Where it
    /// [scatters](Scenario::scatter), each sample has a realisation of its own, by the scenario's
    /// seed and its number. `None` if `go_on` was false before the end. The samples are shared
    /// among threads and keep their order: the result is the same for any number of threads.
    ///
    /// How far downhill is a rover after 5 s across a slope of 10°, if any of three models may be
    /// right?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::ensemble::samples::BandInputs;
    /// use grouser::studies::traverse_band::TraverseBand;
    ///
    /// let overrides = Overrides::parse(["scenario.duration_s=5", "soil.priors=none"])?;
    /// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?;
    /// let samples = BandInputs::of_scenario(&scenario).samples(1, 12)?;
    /// let band = TraverseBand::of(&scenario.value, &samples, &[5.0], &|| true)?;
    /// let y = band.expect("not stopped").run.y.expect("there are samples");
    /// assert!(y.low < -0.02 && y.low < y.high && y.high < 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// * `samples`: at least one
    /// * `times`: [s], within the scenario's duration
    /// * `go_on`: asked before each run, from any thread
    ///
    /// # Errors
    /// [`RunError`] of the first sample that cannot be computed.
    ///
    /// # Panics
    /// If there are no samples.
    pub fn of(
        scenario: &Scenario,
        samples: &[Sample],
        times: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, RunError> {
        assert!(!samples.is_empty(), "a band needs samples");
        let run = |sample: &Sample, scatter: Scatter| {
            let mut scenario =
                Scenario { model: sample.model.clone(), scatter, ..scenario.clone() };
            scenario.ground.soil = sample.soil;
            let run = Run::new(&scenario)?.to_end()?;
            Ok(OfSample::of(&run, &scenario, times))
        };
        let scatter = scenario.scatter;
        let all = if scatter.is_any() {
            let scattered =
                |place: usize| run(&samples[place], scatter.of_case(scatter.seed, place as u64));
            outputs_while(0..samples.len(), go_on, scattered)
        } else {
            outputs_of_samples(samples, go_on, |sample| run(sample, scatter))
        };
        let Some(all) = all else { return Ok(None) };
        // Collected in order, so that the error is always that of the first sample.
        let all = all.into_iter().collect::<Result<Vec<OfSample>, RunError>>()?;
        let at = |(place, time): (usize, &f64)| TimeBand::over(&all, place, *time);
        Ok(Some(Self {
            times: times.iter().enumerate().map(at).collect(),
            run: RunBand::over(&all),
        }))
    }
}

/// The times of a run's records, and where it ended early those that it would have had.
#[must_use]
pub fn record_times(run: &Trajectory, scenario: &Scenario) -> Vec<f64> {
    let (end, interval) = (run.last().time, scenario.numerics.sample_interval);
    let mut times: Vec<f64> = run.records.iter().map(|record| record.time).collect();
    let later = (1_u32..).map(|step| f64::from(step) * interval);
    let later = later.take_while(|time| *time < scenario.duration - SAME_TIME);
    times.extend(later.filter(|time| *time > end + SAME_TIME));
    if scenario.duration > end + SAME_TIME {
        times.push(scenario.duration);
    }
    times
}

impl OfSample {
    fn of(run: &Trajectory, scenario: &Scenario, times: &[f64]) -> Self {
        let rover = &scenario.rover;
        let (drive, last, kind) = (Drive::of(run, scenario), run.last(), run.outcome.kind());
        let in_band = kind.row().in_band;
        let at = |time: &f64| {
            let past = run.records.partition_point(|record| record.time <= time + SAME_TIME);
            let record = &run.records[past.max(1) - 1];
            match in_band {
                InBand::Stuck if is_over(last.time, *time) => Some(At::stuck(record, rover)),
                InBand::Leaves if is_over(last.time, *time) => None,
                InBand::Counts | InBand::Stuck | InBand::Leaves => Some(At::of(record, rover)),
            }
        };
        let stuck = At::stuck(last, rover);
        // The means of a run that got stuck go on to its scenario's end, as the rover is from then
        // on.
        let driven = (last.time / scenario.duration).min(1.0);
        let mean = |mean: Option<f64>, stuck: f64| match (in_band, mean) {
            (InBand::Counts, mean) => Some(mean.unwrap_or(stuck)),
            (InBand::Stuck, mean) => {
                Some(mean.map_or(stuck, |mean| mean * driven + stuck * (1.0 - driven)))
            }
            (InBand::Leaves, mean) => mean,
        };
        let stays = in_band != InBand::Leaves;
        Self {
            kind,
            ended: last.time,
            at: times.iter().map(at).collect(),
            end: stays.then_some(stuck),
            distance: stays.then_some(drive.distance),
            slip_ratio: mean(drive.slip_ratio, stuck.slip_ratio),
            sinkage: mean(drive.sinkage, stuck.sinkage),
            energy_per_metre: match in_band {
                InBand::Counts => Some(drive.energy_per_metre.unwrap_or(f64::INFINITY)),
                InBand::Stuck => Some(f64::INFINITY),
                InBand::Leaves => drive.energy_per_metre,
            },
        }
    }
}

/// Whether a run that ended is over at a time [s].
fn is_over(ended: f64, time: f64) -> bool {
    ended + SAME_TIME < time
}

impl At {
    fn of(record: &Record, rover: &Rover) -> Self {
        let stuck = Self::stuck(record, rover);
        let count = record.wheels.len() as f64;
        let mean = |of: fn(&WheelRecord) -> f64| record.wheels.iter().map(of).sum::<f64>() / count;
        if record.wheels.is_empty() {
            return stuck;
        }
        Self {
            slip_ratio: mean(|wheel| wheel.reaction.slip.ratio),
            sinkage: mean(|wheel| wheel.reaction.settled.sinkage),
            ..stuck
        }
    }

    /// Bands of height [m], roll and pitch [rad], over the samples that have them.
    fn standing(all: &[&Self]) -> [Option<Band>; 3] {
        [0, 1, 2].map(|part| Band::of(all.iter().filter_map(|at| Some(at.standing?[part]))))
    }

    /// The rover where it is, with its wheels spinning, down to their axles.
    fn stuck(record: &Record, rover: &Rover) -> Self {
        Self {
            x: record.place().x,
            y: record.place().y,
            yaw: record.state.yaw,
            standing: record.standing().map(|it| [it.height, it.roll, it.pitch]),
            slip_ratio: 1.0,
            sinkage: rover.mean_axle_height(),
            energy: record.energy.motors,
        }
    }
}

impl TimeBand {
    fn over(samples: &[OfSample], place: usize, time: f64) -> Self {
        let band = |of: fn(&At) -> f64| {
            Band::of(samples.iter().filter_map(|sample| sample.at[place].as_ref()).map(of))
        };
        let [height, roll, pitch] = At::standing(
            &samples.iter().filter_map(|sample| sample.at[place].as_ref()).collect::<Vec<_>>(),
        );
        let ended = samples.iter().filter(|sample| is_over(sample.ended, time));
        Self {
            time,
            x: band(|at| at.x),
            y: band(|at| at.y),
            yaw: band(|at| at.yaw),
            height,
            roll,
            pitch,
            slip_ratio: band(|at| at.slip_ratio),
            sinkage: band(|at| at.sinkage),
            energy: band(|at| at.energy),
            ends: Ends::of(samples.len(), ended.map(|sample| sample.kind)),
        }
    }
}

impl RunBand {
    fn over(samples: &[OfSample]) -> Self {
        let end = |of: fn(&At) -> f64| {
            Band::of(samples.iter().filter_map(|sample| sample.end.as_ref()).map(of))
        };
        let [height, roll, pitch] = At::standing(
            &samples.iter().filter_map(|sample| sample.end.as_ref()).collect::<Vec<_>>(),
        );
        let band = |of: fn(&OfSample) -> Option<f64>| Band::of(samples.iter().filter_map(of));
        let counts = |sample: &&OfSample| sample.kind.row().in_band == InBand::Counts;
        let successes = samples.iter().filter(counts).count();
        Self {
            x: end(|at| at.x),
            y: end(|at| at.y),
            yaw: end(|at| at.yaw),
            height,
            roll,
            pitch,
            distance: band(|sample| sample.distance),
            slip_ratio: band(|sample| sample.slip_ratio),
            sinkage: band(|sample| sample.sinkage),
            energy: end(|at| at.energy),
            energy_per_metre: band(|sample| sample.energy_per_metre),
            completed: Probability { successes, trials: samples.len() },
            ends: Ends::of(samples.len(), samples.iter().map(|sample| sample.kind)),
        }
    }
}
