//! A drive that was measured beside the one that is predicted, channel by channel, and what their
//! differences point to.
//!
//! Telemetry is taken stretch by stretch of a decimetre or so ([`Stretch`]), and predicted in two
//! ways:
//!
//! 1. *prescribed motion* (`prescribed`): attitude, wheel speeds and steering angles are those that
//!    were read. The velocities (u, v) and the yaw rate are those that leave no force and no yaw
//!    moment over, and torques and sinkages go with them;
//! 2. *free run* (`free_run`): from the first pose a [`Run`](crate::simulation::Run) goes on by
//!    itself on a plane, with the wheels turning and steered over time as they were read. Position
//!    and attitude are compared.
//!
//! What differs in prescribed motion is explained by as few causes as possible (`faults`,
//! `attribution`): another soil, rims of another speed, another slope, sensors that are mounted
//! askew. Each would change the predictions in a way that is computed with the model; causes whose
//! ways were the same on this drive cannot be told apart.
//!
//! Memory does not grow with the telemetry: of a long drive every n-th stretch is kept.

mod attribution;
mod channel;
mod differences;
mod faults;
mod free_run;
mod part;
mod prescribed;
mod track;

use std::collections::BTreeMap;

use rayon::prelude::*;

use self::attribution::Sums;
pub use self::attribution::{Alone, Attribution, Finding};
pub use self::channel::{Channel, ChannelSummary, ChannelValue, Prediction};
use self::differences::Differences;
use self::faults::Faults;
pub use self::faults::{Cause, Parameter};
use self::free_run::Commands;
pub use self::free_run::{Ended, FreeRun};
pub use self::part::{EmptyPart, Part};
pub(super) use self::prescribed::{Predicted, Situation, measured, wheel_speeds};
pub use self::track::Pose;
use self::track::Track;
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::heading::HeadingStudy;
use super::learn::{GAP, Gatherer, GrossFault, GrossFaults, NotUsed, Stretch, Suspect};
use crate::simulation::{Scenario, SteadyMotion};
use crate::vehicle::{Rover, roll_and_pitch};
use grouser_io::measurements::telemetry::TelemetryRecord;
use grouser_io::statistics::quantile;

/// Takes telemetry, record by record, and then replays it.
#[derive(Clone, Debug)]
pub struct Replayer {
    scenario: Scenario,
    study: HeadingStudy,
    slope: Option<f64>,
    part: Part,
    gatherer: Gatherer,
    track: Track,
    /// The measured pose where the stretch that is being gathered began.
    opened: Option<Pose>,
    commands: Commands,
    kept: Vec<Kept>,
    /// Every n-th stretch is kept.
    every: usize,
    taken: Taken,
    gross: GrossFaults,
}

/// A stretch with the measured pose at its end.
#[derive(Clone, Debug)]
struct Kept {
    stretch: Stretch,
    pose: Pose,
}

/// What was taken of the telemetry.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Taken {
    /// Records.
    pub records: u64,
    /// Stretches of them.
    pub stretches: usize,
    /// Readings that were outliers in their stretch.
    pub outliers: u64,
}

/// Stretches that are kept at most. Source: ours, more than a curve on a page shows.
const MOST_STRETCHES: usize = 400;

/// A drive that was measured, and predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// The stretches that are compared: all, or of a long drive every n-th.
    pub stretches: Vec<ReplayedStretch>,
    /// How far measured and predicted are apart, in channels that have both.
    pub channels: Vec<ChannelSummary>,
    /// Gross faults of the telemetry: what they are of is left out of the findings.
    pub gross_faults: Vec<GrossFault>,
    /// What the differences say of each parameter, those of a cause together.
    pub findings: Vec<Finding>,
    /// Stretches that the findings rest on.
    pub explained_stretches: usize,
    /// The free run.
    pub free_run: FreeRun,
    /// Work of the wheels over the stretches that have it, measured and predicted, ΣTω dt [J].
    pub energy: Option<[f64; 2]>,
    /// What was taken of the telemetry.
    pub taken: Taken,
    /// The part of it that this is of.
    pub part: Part,
    /// Every n-th stretch is compared.
    pub every: usize,
    /// Stretches that were not predicted in prescribed motion, by why.
    pub not_predicted: BTreeMap<NotPredicted, u64>,
}

impl Replay {
    /// The causes that explain most of the differences if each is taken to be the only one, with
    /// the share that it explains then [-]: at most three, the one with the most evidence first.
    /// One with less evidence than the absence of all of them is left out.
    #[must_use]
    pub fn best_causes(&self) -> Vec<(Cause, f64)> {
        const MOST: usize = 3;
        let mut best: Vec<(&Finding, Cause)> =
            self.findings.iter().map(|it| (it, it.parameter.cause())).collect();
        best.dedup_by_key(|(_, cause)| *cause);
        best.retain(|(it, _)| it.alone.evidence > 0.0);
        best.sort_by(|(one, _), (other, _)| other.alone.evidence.total_cmp(&one.alone.evidence));
        best.into_iter().take(MOST).map(|(it, cause)| (cause, it.alone.share)).collect()
    }

    /// Why no stretch could be predicted, most often, where none could: nothing of the drive was
    /// compared then.
    #[must_use]
    pub fn nothing_predicted(&self) -> Option<&'static str> {
        let all: u64 = self.not_predicted.values().sum();
        let (why, _) = self.not_predicted.iter().max_by_key(|(_, count)| **count)?;
        (all >= self.stretches.len() as u64).then(|| why.meaning())
    }
}

/// One stretch, measured and predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayedStretch {
    /// Its end [s].
    pub time: f64,
    /// How long it is [s].
    pub span: f64,
    /// Slope of the ground and yaw, as they were read [rad].
    pub attitude: Option<[f64; 2]>,
    /// Its channels, by [`Channel::all`].
    pub values: Vec<ChannelValue>,
}

/// Why a stretch has no prediction in prescribed motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotPredicted {
    /// What was read says so.
    Read(NotUsed),
    /// In the soil of the document no velocities balance the rover.
    NotSteady,
}

impl NotPredicted {
    /// What it means for an operator.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Read(why) => why.meaning(),
            Self::NotSteady => {
                "in this soil no steady motion goes with that attitude and those wheel speeds"
            }
        }
    }
}

/// Why there is nothing to replay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "nothing can be told from {records} {}: a stretch to replay needs wheel speeds over two \
     records or more",
    if *records == 1 { "record" } else { "records" }
)]
pub struct NothingToReplay {
    /// Records that were taken.
    pub records: u64,
}

impl Replayer {
    /// * `scenario`: its rover, soil, model, gravity and load transfer are used
    /// * `slope`: of the ground, where it is known by other means than the telemetry [rad]
    #[must_use]
    pub fn new(scenario: &Scenario, slope: Option<f64>) -> Self {
        Self {
            study: HeadingStudy::of(scenario),
            gatherer: Gatherer::new(&scenario.rover, slope),
            scenario: scenario.clone(),
            slope,
            part: Part::default(),
            track: Track::default(),
            opened: None,
            commands: Commands::default(),
            kept: Vec::new(),
            every: 1,
            taken: Taken::default(),
            gross: GrossFaults::default(),
        }
    }

    /// Replays a part of the telemetry, as if it had no other records.
    #[must_use]
    pub fn within(self, part: Part) -> Self {
        Self { part, ..self }
    }

    /// Takes a record.
    pub fn update(&mut self, record: TelemetryRecord) {
        if !self.part.has(record.time) {
            return;
        }
        self.taken.records += 1;
        let time = record.time;
        self.gross.read(&record);
        self.track.push(&record);
        let rims = rim_speeds(&self.study.rover, &record);
        let complete = self.gatherer.push(record);
        let is_behind = complete.as_ref().is_some_and(|it| it.time[1] < time);
        if !is_behind {
            self.commands.read(time, &rims);
        }
        if let Some(stretch) = complete {
            self.take(stretch);
        }
        if is_behind {
            self.commands.read(time, &rims);
        }
        let begins = self.opened.is_none_or(|it| time - it.time > GAP && is_behind);
        if begins {
            self.opened = self.track.now();
        }
    }

    fn take(&mut self, stretch: Stretch) {
        let begun = self.opened.take();
        let (Some(mut start), Some(mut pose)) = (begun, self.track.at(stretch.time[1])) else {
            return;
        };
        self.taken.outliers += stretch.outliers as u64;
        let turned =
            stretch.yaw_rate.map_or(0.0, |it| it.value) * (stretch.time[1] - stretch.time[0]);
        // Roll and pitch tell the yaw in the middle of the stretch, and the mean of what was read
        // is that, too.
        let middle = stretch.reported_yaw.or(stretch.attitude.map(|it| it[1]));
        if self.taken.stretches == 0
            && let Some(middle) = middle
        {
            let (mut first, mut last) = (Some(start), Some(pose));
            let angle = middle - 0.5 * turned - start.yaw;
            self.track.turn(angle, &mut [&mut first, &mut last]);
            (start, pose) = (first.unwrap_or(start), last.unwrap_or(pose));
        }
        // One reading of the yaw has its noise.
        start.yaw = stretch.reported_yaw.map_or(start.yaw, |it| it - 0.5 * turned);
        self.commands.push(&stretch, start);
        if self.taken.stretches.is_multiple_of(self.every) {
            self.keep(Kept { stretch, pose });
        }
        self.taken.stretches += 1;
    }

    fn keep(&mut self, kept: Kept) {
        if self.kept.len() >= MOST_STRETCHES {
            let mut place = 0;
            self.kept.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.every *= 2;
        }
        self.kept.push(kept);
    }

    /// Replays what was taken; nothing if `go_on` was false before the end.
    ///
    /// * `samples`: of soil and model, for bands; none to take both as known
    /// * `go_on`: asked before each sample, from any thread
    ///
    /// # Errors
    /// [`NothingToReplay`] of telemetry without a stretch.
    pub fn finish(
        mut self,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Replay>, NothingToReplay> {
        if let Some(stretch) = self.gatherer.take() {
            self.take(stretch);
        }
        // What one record has is no stretch of a drive.
        if self.kept.iter().all(|it| it.stretch.time[0] == it.stretch.time[1]) {
            return Err(NothingToReplay { records: self.taken.records });
        }
        let nominal = Sample { soil: self.study.soil, model: self.study.model.clone() };
        let slope = self.plane();
        let motions: Vec<Motion> =
            self.kept.par_iter().map(|it| self.predicted(&it.stretch)).collect();
        let free_run = self.commands.run(&self.scenario, slope, &nominal);
        let channels = Channel::all(self.study.rover.wheel_count());
        let mut stretches = self.compared(&motions, &free_run);
        if !samples.is_empty() {
            let sampled =
                outputs_of_samples(samples, go_on, |sample| self.sampled(sample, slope, &motions));
            let Some(sampled) = sampled else { return Ok(None) };
            add_bands(&mut stretches, &channels, &sampled);
        }
        let gross = self.gross_faults();
        let (findings, explained_stretches) = self.findings(&motions, &gross);
        let gross_faults = gross.found().to_vec();
        let mut not_predicted = BTreeMap::new();
        for why in motions.iter().filter_map(|it| it.as_ref().err()) {
            *not_predicted.entry(*why).or_default() += 1;
        }
        let summary = |(place, channel): (usize, Channel)| {
            ChannelSummary::of(channel, stretches.iter().map(|it| &it.values[place]))
        };
        let channels = channels.into_iter().enumerate().filter_map(summary).collect();
        let energy = energy(&stretches);
        let Self { taken, part, every, .. } = self;
        Ok(Some(Replay {
            stretches,
            channels,
            gross_faults,
            findings,
            explained_stretches,
            free_run,
            energy,
            taken,
            part,
            every,
            not_predicted,
        }))
    }

    /// The slope of the plane of free runs [rad]: as it is known, or the middle of what was read.
    fn plane(&self) -> f64 {
        let read = self.kept.iter().filter_map(|it| it.stretch.attitude.map(|it| it[0]));
        let mut read: Vec<f64> = read.collect();
        read.sort_by(f64::total_cmp);
        self.slope.or(quantile(&read, 0.5)).unwrap_or(0.0)
    }

    /// The steady motion that the soil of the document predicts for a stretch.
    fn predicted(&self, stretch: &Stretch) -> Result<(Situation, SteadyMotion), NotPredicted> {
        let situation = Situation::of(&self.study, stretch).map_err(NotPredicted::Read)?;
        let motion = situation.motion(None).ok_or(NotPredicted::NotSteady)?;
        Ok((situation, motion))
    }

    fn compared(&self, motions: &[Motion], free_run: &FreeRun) -> Vec<ReplayedStretch> {
        let rover = &self.study.rover;
        let channels = Channel::all(rover.wheel_count());
        let one = |(kept, motion): (&Kept, &Motion)| {
            let Kept { stretch, pose } = kept;
            let steady = motion.as_ref().ok().map(|(_, motion)| Predicted::of(motion));
            let steady_channels =
                channels.iter().copied().filter(|it| it.prediction() == Prediction::Prescribed);
            let mut values: Vec<ChannelValue> =
                prescribed::values(steady_channels, stretch, rover, steady.as_ref()).collect();
            let free = free_run.at(stretch.time[1]);
            let posed =
                channels.iter().copied().filter(|it| it.prediction() == Prediction::FreeRun);
            values.extend(posed.map(|channel| {
                let predicted = free.and_then(|it| of_pose(channel, &it, Some(free_run.slope)));
                ChannelValue::new(channel, self.measured_pose(channel, stretch, pose), predicted)
            }));
            let [begin, time] = stretch.time;
            ReplayedStretch { time, span: time - begin, attitude: stretch.attitude, values }
        };
        self.kept.iter().zip(motions).map(one).collect()
    }

    fn measured_pose(&self, channel: Channel, stretch: &Stretch, pose: &Pose) -> Option<f64> {
        match channel {
            Channel::Roll | Channel::Pitch => {
                let [slope, yaw] = stretch.attitude?;
                of_pose(channel, &Pose { yaw, ..*pose }, Some(slope))
            }
            Channel::X | Channel::Y if !self.track.has_position() => None,
            _ => of_pose(channel, pose, None),
        }
    }

    /// What one sample predicts: every channel of every stretch.
    fn sampled(&self, sample: &Sample, slope: f64, motions: &[Motion]) -> Vec<Vec<Option<f64>>> {
        let rover = &self.study.rover;
        let channels = Channel::all(rover.wheel_count());
        let free_run = self.commands.run(&self.scenario, slope, sample);
        let one = |(kept, motion): (&Kept, &Motion)| {
            let steady = motion.as_ref().ok().and_then(|(situation, near)| {
                Some(Predicted::of(&situation.on(sample).motion(Some(near))?))
            });
            let speeds = prescribed::wheel_speeds(&kept.stretch, rover);
            let free = free_run.at(kept.stretch.time[1]);
            let value = |channel: &Channel| match channel.prediction() {
                Prediction::Prescribed => steady.as_ref()?.of_channel(*channel, &speeds),
                Prediction::FreeRun => of_pose(*channel, &free?, Some(slope)),
            };
            channels.iter().map(value).collect()
        };
        self.kept.iter().zip(motions).map(one).collect()
    }

    /// What of the telemetry no rover can have.
    fn gross_faults(&self) -> GrossFaults {
        let mut gross = self.gross.clone();
        for kept in &self.kept {
            gross.look(&kept.stretch, &self.study.rover, self.study.gravity);
        }
        gross
    }

    /// What the differences point to, and from how many stretches.
    ///
    /// * `gross`: what is left out
    fn findings(&self, motions: &[Motion], gross: &GrossFaults) -> (Vec<Finding>, usize) {
        let is_of_attitude =
            |it: &GrossFault| matches!(it.suspect, Suspect::Attitude | Suspect::StillAttitude);
        let has_attitude = !gross.found().iter().any(is_of_attitude);
        let stretch = |kept: &Kept| {
            let mut stretch = kept.stretch.clone();
            gross.leave_out(&mut stretch);
            stretch
        };
        let pairs = self.kept.iter().zip(motions).filter(|_| has_attitude);
        let pairs: Vec<(Stretch, &Motion)> =
            pairs.map(|(it, motion)| (stretch(it), motion)).collect();
        let sums = |base: &Faults| {
            let one = |(stretch, motion): &(Stretch, &Motion)| {
                let (situation, motion) = motion.as_ref().ok()?;
                Differences::of(situation, stretch, base, motion)
            };
            let all: Vec<Option<Differences>> = pairs.par_iter().map(one).collect();
            // Added up in order: the same bits whatever the threads.
            let mut sums = Sums::new();
            all.iter().flatten().for_each(|it| sums.add(it, base));
            sums
        };
        let found = sums(&Faults::default());
        // Once more with the tangents where the first round led: predictions are no straight lines.
        let found = match found.best() {
            nothing if nothing == Faults::default() => found,
            best => sums(&best),
        };
        (found.findings(), found.stretches)
    }
}

/// The steady motion of a stretch with what it rests on, or why there is none.
type Motion = Result<(Situation, SteadyMotion), NotPredicted>;

/// A channel of a pose.
///
/// * `slope`: of the ground [rad], for roll and pitch
fn of_pose(channel: Channel, pose: &Pose, slope: Option<f64>) -> Option<f64> {
    match channel {
        Channel::X => Some(pose.position.x),
        Channel::Y => Some(pose.position.y),
        Channel::Yaw => Some(pose.yaw),
        Channel::Roll => slope.map(|slope| roll_and_pitch(slope, pose.yaw)[0]),
        Channel::Pitch => slope.map(|slope| roll_and_pitch(slope, pose.yaw)[1]),
        _ => None,
    }
}

/// The rim speed of each wheel [m/s], where it was read.
fn rim_speeds(rover: &Rover, record: &TelemetryRecord) -> Vec<Option<f64>> {
    let wheels = rover.mounts().iter().zip(&record.wheels);
    wheels.map(|(mount, wheel)| Some(wheel.speed? * mount.shearing_radius())).collect()
}

/// Adds the bands over what samples predict.
///
/// * `sampled`: by sample, stretch and channel
fn add_bands(
    stretches: &mut [ReplayedStretch],
    channels: &[Channel],
    sampled: &[Vec<Vec<Option<f64>>>],
) {
    for (row, stretch) in stretches.iter_mut().enumerate() {
        for (place, (value, channel)) in stretch.values.iter_mut().zip(channels).enumerate() {
            value.add_band(*channel, sampled.iter().filter_map(|sample| sample[row][place]));
        }
    }
}

/// Work of the wheels over the stretches that have it, measured and predicted [J].
fn energy(stretches: &[ReplayedStretch]) -> Option<[f64; 2]> {
    let place = Channel::all(0).iter().position(|it| *it == Channel::Power)?;
    let both = stretches.iter().filter_map(|it| {
        let value = &it.values[place];
        Some([it.span * value.measured?, it.span * value.predicted?])
    });
    both.reduce(|[measured, predicted], [more, other]| [measured + more, predicted + other])
}
