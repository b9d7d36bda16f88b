//! A run from the first pose, with the wheels turning and steered over time as they were measured,
//! on a plane.

use super::track::Pose;
use crate::simulation::{
    Controller, Motion, Observation, Outcome, Run, RunError, Scatter, Scenario, Start,
};
use crate::studies::ensemble::samples::Sample;
use crate::studies::learn::{GAP, Stretch};
use crate::terrain::Ground;
use crate::vehicle::ByWheel;
use grouser_io::statistics::quantile;

/// How the wheels turn until a time.
#[derive(Clone, Debug)]
struct Command {
    from: f64,
    until: f64,
    /// Rim speed of each wheel [m/s].
    rim_speeds: Vec<f64>,
    /// Steering angle of each wheel [rad], where it was read.
    steering: Vec<Option<f64>>,
}

/// Commands without a gap between them.
#[derive(Clone, Debug)]
struct Piece {
    start: Pose,
    commands: Vec<Command>,
}

/// How the wheels were seen to turn over a drive. Its size does not grow with the drive: of a long
/// one, neighbouring commands become one.
#[derive(Clone, Debug, Default)]
pub(super) struct Commands {
    pieces: Vec<Piece>,
    /// The ways in which the wheels turned since the last stretch, one after another.
    turns: Vec<OneWay>,
}

/// Records in which no wheel changes its direction.
#[derive(Clone, Debug)]
struct OneWay {
    /// The last record [s].
    until: f64,
    /// Which way each wheel turns, where it was read: 1, −1, or 0 where it stands.
    directions: Vec<Option<f64>>,
    /// Rim speeds of each wheel as they were read [m/s].
    rim_speeds: Vec<Vec<f64>>,
}

/// Commands at most. Source: ours, a kilometre or two of stretches.
const MOST: usize = 20_000;
/// A rim that is slower stands [m/s]. Source: ours, noise of encoders.
const STANDS: f64 = 1e-3;

/// A free run.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeRun {
    /// Slope of its plane [rad].
    pub slope: f64,
    /// Times at which it was set on the measured pose: the start, and the end of each gap of the
    /// telemetry [s].
    pub starts: Vec<f64>,
    /// What ended it before the telemetry ended, and when [s].
    pub ended: Option<(f64, Ended)>,
    /// Where it came to, over time.
    pub(super) poses: Vec<Pose>,
}

/// What ends a free run.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// What became of the rover.
    Outcome(Outcome),
    /// It could not be computed: why.
    Failed(String),
}

impl Commands {
    /// Takes the wheels' motion at a time [s].
    ///
    /// * `rim_speeds`: of each wheel [m/s], where it was read
    pub(super) fn read(&mut self, time: f64, rim_speeds: &[Option<f64>]) {
        match self.turns.last_mut().filter(|turn| turn.goes_on(rim_speeds)) {
            Some(turn) => turn.push(time, rim_speeds),
            None => self.turns.push(OneWay::new(time, rim_speeds)),
        }
    }

    /// Takes the wheels' motion over a stretch: as it is on the mean, or where wheels change their
    /// direction under way, turn by turn.
    ///
    /// * `start`: the measured pose where it began
    pub(super) fn push(&mut self, stretch: &Stretch, start: Pose) {
        let mut turns = std::mem::take(&mut self.turns);
        turns.retain(|turn| turn.until >= stretch.time[0]);
        for command in Command::of_stretch(stretch, &turns) {
            self.push_command(command, start);
        }
        if self.pieces.iter().map(|it| it.commands.len()).sum::<usize>() > MOST {
            self.pieces.iter_mut().for_each(Piece::thin_out);
        }
    }

    fn push_command(&mut self, command: Command, start: Pose) {
        let open = self.pieces.last_mut().filter(|piece| {
            piece.commands.last().is_some_and(|last| command.from - last.until <= GAP)
        });
        match open {
            // What the wheels did between two records is what they do next.
            Some(piece) => {
                let from = piece.commands.last().map_or(command.from, |last| last.until);
                piece.commands.push(Command { from, ..command });
            }
            None => self.pieces.push(Piece { start, commands: vec![command] }),
        }
    }

    /// Runs a scenario's rover by them on a plane; with the soil and model of a sample.
    ///
    /// * `slope`: of the plane [rad]
    pub(super) fn run(&self, scenario: &Scenario, slope: f64, sample: &Sample) -> FreeRun {
        let starts = self.pieces.iter().map(|piece| piece.start.time).collect();
        let mut run = FreeRun { slope, starts, ended: None, poses: Vec::new() };
        for piece in &self.pieces {
            let scenario = piece.scenario(scenario, slope, sample);
            if let Err(error) = piece.run(&scenario, &mut run) {
                let time = run.poses.last().map_or(piece.start.time, |it| it.time);
                run.ended = Some((time, Ended::Failed(error.to_string())));
            }
        }
        run
    }
}

impl OneWay {
    fn new(time: f64, speeds: &[Option<f64>]) -> Self {
        let wheels = speeds.len();
        let (directions, rim_speeds) = (vec![None; wheels], vec![Vec::new(); wheels]);
        let mut turn = Self { until: time, directions, rim_speeds };
        turn.push(time, speeds);
        turn
    }

    /// Whether no wheel turns another way.
    fn goes_on(&self, speeds: &[Option<f64>]) -> bool {
        let pairs = self.directions.iter().zip(speeds);
        pairs.into_iter().all(|(own, speed)| match (own, speed.map(direction)) {
            (Some(own), Some(other)) => *own == other,
            _ => true,
        })
    }

    fn push(&mut self, time: f64, speeds: &[Option<f64>]) {
        self.until = time;
        for ((own, read), speed) in self.directions.iter_mut().zip(&mut self.rim_speeds).zip(speeds)
        {
            *own = own.or(speed.map(direction));
            read.extend(speed);
        }
    }

    /// The middle of what each wheel did [m/s], or what it did on the mean over the stretch.
    fn middles(&self, means: &[f64]) -> Vec<f64> {
        let middle = |(read, mean): (&Vec<f64>, &f64)| {
            let mut read = read.clone();
            read.sort_by(f64::total_cmp);
            quantile(&read, 0.5).unwrap_or(*mean)
        };
        self.rim_speeds.iter().zip(means).map(middle).collect()
    }
}

fn direction(rim_speed: f64) -> f64 {
    if rim_speed.abs() < STANDS { 0.0 } else { rim_speed.signum() }
}

impl Piece {
    /// Makes one command of each two.
    fn thin_out(&mut self) {
        let merged = self.commands.chunks(2).map(|pair| match pair {
            [one, other] => one.and(other),
            rest => rest[0].clone(),
        });
        self.commands = merged.collect();
    }

    fn scenario(&self, scenario: &Scenario, slope: f64, sample: &Sample) -> Scenario {
        let last = self.commands.last().map_or(self.start.time, |it| it.until);
        let duration =
            (last - self.start.time).clamp(1.0, crate::simulation::scenario::LONGEST_DURATION);
        let mut numerics = scenario.numerics;
        // Poses are read off the run itself.
        numerics.sample_interval = duration;
        Scenario {
            ground: Ground::plane(sample.soil, slope),
            model: sample.model.clone(),
            yaw: None,
            by_wheel: ByWheel::ALIKE,
            scatter: Scatter::NONE,
            start: Start { yaw: self.start.yaw, motion: Motion::Rolling },
            duration,
            numerics,
            ..scenario.clone()
        }
    }

    fn run(&self, scenario: &Scenario, found: &mut FreeRun) -> Result<(), RunError> {
        let Some(first) = self.commands.first() else { return Ok(()) };
        let mut played = Played(first);
        let mut run = Run::with_controller(scenario, &mut played)?;
        let pose = |run: &Run, time| Pose {
            time,
            position: self.start.position + run.state().rover().position,
            yaw: run.state().rover().yaw,
        };
        found.poses.push(pose(&run, self.start.time));
        for command in &self.commands {
            let until = command.until - self.start.time;
            if until <= run.state().time() {
                continue;
            }
            played.0 = command;
            run.advance(&mut played, until)?;
            if let Some(outcome) = run.outcome() {
                found.ended =
                    Some((self.start.time + run.state().time(), Ended::Outcome(outcome.clone())));
                break;
            }
            found.poses.push(pose(&run, command.until));
        }
        Ok(())
    }
}

impl Command {
    fn of_stretch(stretch: &Stretch, turns: &[OneWay]) -> Vec<Self> {
        let ([mut from, end], means) = (stretch.time, &stretch.rim_speeds);
        let steering = &stretch.steering;
        if turns.len() < 2 {
            let (rim_speeds, steering) = (means.clone(), steering.clone());
            return vec![Self { from, until: end, rim_speeds, steering }];
        }
        let command = |turn: &OneWay| {
            let (rim_speeds, steering) = (turn.middles(means), steering.clone());
            let command = Self { from, until: turn.until, rim_speeds, steering };
            from = turn.until;
            command
        };
        turns.iter().map(command).collect()
    }

    /// This one and the next as one.
    fn and(&self, next: &Self) -> Self {
        let spans = [self.until - self.from, next.until - next.from];
        let whole = (spans[0] + spans[1]).max(f64::MIN_POSITIVE);
        let speeds = self.rim_speeds.iter().zip(&next.rim_speeds);
        let mean = |(one, other): (&f64, &f64)| (spans[0] * one + spans[1] * other) / whole;
        let rim_speeds = speeds.map(mean).collect();
        Self { from: self.from, until: next.until, rim_speeds, steering: next.steering.clone() }
    }
}

/// Turns wheels as one command says.
struct Played<'a>(&'a Command);

impl Controller for Played<'_> {
    fn command(&mut self, _seen: &Observation<'_>, rim_speeds: &mut [f64]) {
        rim_speeds.copy_from_slice(&self.0.rim_speeds);
    }

    fn steer(&mut self, seen: &Observation<'_>, angles: &mut [f64]) {
        let mounts = seen.scenario().rover.mounts();
        for ((angle, read), mount) in angles.iter_mut().zip(&self.0.steering).zip(mounts) {
            if let (Some(read), Some(axis)) = (read, mount.steering_axis) {
                *angle = read.clamp(-axis.limit, axis.limit);
            }
        }
    }

    fn period(&self) -> Option<f64> {
        None
    }
}

impl FreeRun {
    /// Where it is at a time [s], between the poses that it has.
    pub(super) fn at(&self, time: f64) -> Option<Pose> {
        let after = self.poses.partition_point(|it| it.time < time);
        let next = self.poses.get(after)?;
        let Some(last) = after.checked_sub(1).map(|before| &self.poses[before]) else {
            return (next.time == time).then_some(*next);
        };
        let is_gap = self.starts.contains(&next.time) && next.time > time;
        let share = (time - last.time) / (next.time - last.time);
        let between = |from: f64, to: f64| from + share * (to - from);
        (!is_gap).then(|| Pose {
            time,
            position: last.position + share * (next.position - last.position),
            yaw: between(last.yaw, next.yaw),
        })
    }
}
