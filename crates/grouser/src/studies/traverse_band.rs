//! A traverse where soil and model are uncertain: a run of each sample, and quantiles over them.
//!
//! Bands are over all samples. From the time at which a run ends early (immobilised, sliding or tipped over) its
//! sample counts as slip 1, sunk to the axles, at the place where it ended; what it would cost to get on has no
//! bound. (A rover that slides goes further downhill than that place: the probability of completing says how many
//! of the samples do not.)

use super::drive::Drive;
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::ensemble::{Band, Probability, outputs_while};
use crate::simulation::{
    Outcome, Record, Run, RunError, SAME_TIME, Scatter, Scenario, Trajectory, WheelRecord,
};
use crate::vehicle::Rover;

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
    /// Slip ratio [-], mean of the wheels.
    pub slip_ratio: Option<Band>,
    /// Sinkage [m], mean of the wheels.
    pub sinkage: Option<Band>,
    /// Work of the motors so far [J].
    pub energy: Option<Band>,
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
    /// Length of the way [m].
    pub distance: Option<Band>,
    /// Slip ratio [-], mean over wheels and time.
    pub slip_ratio: Option<Band>,
    /// Sinkage [m], mean over wheels and time.
    pub sinkage: Option<Band>,
    /// Work of the motors [J].
    pub energy: Option<Band>,
    /// Work of the motors over the length of the way [J/m]; infinite in a sample that does not complete it.
    pub energy_per_metre: Option<Band>,
    /// Samples that completed the run.
    pub completed: Probability,
    /// Samples that got stuck.
    pub immobilised: usize,
    /// Samples that slid downhill.
    pub sliding: usize,
    /// Samples that tipped over.
    pub tipped_over: usize,
    /// Samples whose battery failed.
    pub brown_out: usize,
    /// Samples that drove off their map.
    pub off_map: usize,
    /// Samples whose underside came to the ground.
    pub high_centred: usize,
}

/// The rover at one time in one sample.
#[derive(Clone, Copy)]
struct At {
    x: f64,
    y: f64,
    yaw: f64,
    slip_ratio: f64,
    sinkage: f64,
    energy: f64,
}

/// What the bands need of one sample.
#[derive(Clone)]
struct OfSample {
    outcome: Outcome,
    at: Vec<At>,
    end: At,
    distance: f64,
    energy_per_metre: f64,
}

impl TraverseBand {
    /// Runs each sample; the soil and the model of `scenario` are not used. Where it [scatters](Scenario::scatter),
    /// each sample has a realisation of its own, by the scenario's seed and its number. `None` if `go_on` was false before the
    /// end. The samples are shared among threads and keep their order: the result is the same for any number of
    /// threads.
    ///
    /// How far downhill is a rover after 5 s across a slope of 10°, if any of three models may be right?
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
            let mut scenario = Scenario { theory: sample.theory, scatter, ..scenario.clone() };
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
        let (drive, last) = (Drive::of(run), run.last());
        let at = |time: &f64| {
            let past = run.records.partition_point(|record| record.time <= time + SAME_TIME);
            let record = &run.records[past.max(1) - 1];
            let is_over = run.outcome != Outcome::Completed && last.time + SAME_TIME < *time;
            if is_over { At::stuck(record, rover) } else { At::of(record, rover) }
        };
        // The means of a run that ended early go on to its scenario's end, as the rover is from then on.
        let driven = (last.time / scenario.duration).min(1.0);
        let mean = |mean: Option<f64>, stuck: f64| {
            mean.map_or(stuck, |mean| {
                if run.outcome == Outcome::Completed {
                    mean
                } else {
                    mean * driven + stuck * (1.0 - driven)
                }
            })
        };
        let stuck = At::stuck(last, rover);
        let energy_per_metre = drive.energy_per_metre.filter(|_| run.outcome == Outcome::Completed);
        Self {
            outcome: run.outcome.clone(),
            at: times.iter().map(at).collect(),
            end: At {
                slip_ratio: mean(drive.slip_ratio, stuck.slip_ratio),
                sinkage: mean(drive.sinkage, stuck.sinkage),
                ..stuck
            },
            distance: drive.distance,
            energy_per_metre: energy_per_metre.unwrap_or(f64::INFINITY),
        }
    }
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

    /// The rover where it is, with its wheels spinning, down to their axles.
    fn stuck(record: &Record, rover: &Rover) -> Self {
        Self {
            x: record.place().x,
            y: record.place().y,
            yaw: record.state.yaw,
            slip_ratio: 1.0,
            sinkage: rover.mean_axle_height(),
            energy: record.energy.motors,
        }
    }
}

impl TimeBand {
    fn over(samples: &[OfSample], place: usize, time: f64) -> Self {
        let band =
            |of: fn(&At) -> f64| Band::of(samples.iter().map(|sample| of(&sample.at[place])));
        Self {
            time,
            x: band(|at| at.x),
            y: band(|at| at.y),
            yaw: band(|at| at.yaw),
            slip_ratio: band(|at| at.slip_ratio),
            sinkage: band(|at| at.sinkage),
            energy: band(|at| at.energy),
        }
    }
}

impl RunBand {
    fn over(samples: &[OfSample]) -> Self {
        let end = |of: fn(&At) -> f64| Band::of(samples.iter().map(|sample| of(&sample.end)));
        let band = |of: fn(&OfSample) -> f64| Band::of(samples.iter().map(of));
        let count = |is: fn(&Outcome) -> bool| samples.iter().filter(|it| is(&it.outcome)).count();
        let successes = count(|outcome| *outcome == Outcome::Completed);
        Self {
            x: end(|at| at.x),
            y: end(|at| at.y),
            yaw: end(|at| at.yaw),
            distance: band(|sample| sample.distance),
            slip_ratio: end(|at| at.slip_ratio),
            sinkage: end(|at| at.sinkage),
            energy: end(|at| at.energy),
            energy_per_metre: band(|sample| sample.energy_per_metre),
            completed: Probability { successes, trials: samples.len() },
            immobilised: count(|outcome| matches!(outcome, Outcome::Immobilised { .. })),
            sliding: count(|outcome| matches!(outcome, Outcome::Sliding { .. })),
            tipped_over: count(|outcome| matches!(outcome, Outcome::TippedOver { .. })),
            brown_out: count(|outcome| matches!(outcome, Outcome::BrownOut { .. })),
            off_map: count(|outcome| matches!(outcome, Outcome::OffTheMap { .. })),
            high_centred: count(|outcome| matches!(outcome, Outcome::HighCentred { .. })),
        }
    }
}
