//! What a run leaves behind.

use std::ops::AddAssign;

use super::balance::Unsteady;
use super::power::EnergyBalance;
use crate::vehicle::{RoverState, WheelReaction};

/// A run: its samples in the order of time, and what became of the rover.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// At the start, at every sample interval, and at the end.
    pub samples: Vec<Sample>,
    /// What became of the rover.
    pub outcome: Outcome,
    /// How it was computed.
    pub method: Method,
    /// Work of the solver.
    pub work: Work,
}

/// How much was computed for a run: counts that repeat on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the equations of motion, by whatever solves them.
    pub evaluations: u64,
    /// Jacobians among them: each is made of a few of those evaluations.
    pub jacobians: u64,
    /// Steps in time.
    pub steps: u64,
    /// Wheels that were settled, for the evaluations and for the samples.
    pub settled_wheels: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.jacobians += other.jacobians;
        self.steps += other.steps;
        self.settled_wheels += other.settled_wheels;
    }
}

/// How a run was computed.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// The velocities were integrated like the pose.
    Dynamic,
    /// The velocities were in balance at every instant, the pose was integrated.
    QuasiSteady,
    /// Quasi-steady up to a time, dynamic from there on.
    FellBack {
        /// When [s].
        time: f64,
        /// Why the quasi-steady motion is not valid there.
        because: Unsteady,
    },
}

impl Method {
    /// `dynamic`, `quasi-steady`, or `fell-back`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dynamic => "dynamic",
            Self::QuasiSteady => "quasi-steady",
            Self::FellBack { .. } => "fell-back",
        }
    }

    /// Since when and why it fell back to dynamic, in a few words.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        match self {
            Self::FellBack { time, because } => {
                Some(format!("dynamic from {time:.1} s on: {because}"))
            }
            Self::Dynamic | Self::QuasiSteady => None,
        }
    }
}

/// The rover at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time since the start [s].
    pub time: f64,
    /// Pose and velocity.
    pub state: RoverState,
    /// Each wheel, in the mounts' order; none where a rover has just tipped over or sunk.
    pub wheels: Vec<WheelSample>,
    /// Energy since the start.
    pub energy: EnergyBalance,
}

/// A wheel at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSample {
    /// Angular speed, *ω* [rad/s].
    pub wheel_speed: f64,
    /// Slip, load, sinkage and forces.
    pub reaction: WheelReaction,
}

impl WheelSample {
    /// Power of the motor, T ω [W].
    #[must_use]
    pub fn power(&self) -> f64 {
        self.reaction.settled.forces.torque * self.wheel_speed
    }
}

/// What became of the rover.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It drove for as long as it was told to.
    Completed,
    /// It no longer gets ahead.
    Immobilised {
        /// When that was certain [s].
        time: f64,
        /// What stopped it.
        because: StuckBecause,
    },
    /// It slides downhill faster than its wheels turn.
    Sliding {
        /// When that was certain [s].
        time: f64,
    },
    /// Its weight fell outside its wheels.
    TippedOver {
        /// When [s].
        time: f64,
    },
}

/// What stopped a rover.
#[derive(Clone, Debug, PartialEq)]
pub enum StuckBecause {
    /// The wheels' mean slip stayed above [`SPINNING_SLIP`](super::watch::SPINNING_SLIP).
    WheelsSpin,
    /// The hubs' progress stayed under [`LEAST_PROGRESS`](super::watch::LEAST_PROGRESS) of the rims'.
    NoProgress,
    /// A wheel sank to its axle.
    SunkToAxle {
        /// Its name.
        wheel: String,
        /// Its load [N].
        load: f64,
        /// The most that the soil carries [N].
        capacity: f64,
    },
}

impl Outcome {
    /// One word: `completed`, `immobilised`, `sliding`, `tipped_over`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Immobilised { .. } => "immobilised",
            Self::Sliding { .. } => "sliding",
            Self::TippedOver { .. } => "tipped_over",
        }
    }

    /// The reason, in a few words; none for a completed run.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        match self {
            Self::Completed => None,
            Self::Immobilised { because, .. } => Some(match because {
                StuckBecause::WheelsSpin => "the wheels spin without moving the rover".into(),
                StuckBecause::NoProgress => {
                    "the rover gets ahead by less than 1 % of its rims".into()
                }
                StuckBecause::SunkToAxle { wheel, load, capacity } => format!(
                    "wheel {wheel} sank to its axle: it bears {load:.3} N, the soil carries {capacity:.3} N"
                ),
            }),
            Self::Sliding { .. } => Some("it slides downhill faster than its wheels turn".into()),
            Self::TippedOver { .. } => Some("its weight falls outside its wheels".into()),
        }
    }
}

impl Trajectory {
    /// The last sample.
    ///
    /// # Panics
    /// Never for a trajectory of [`Simulation::run`](super::Simulation::run): it has its start.
    #[must_use]
    pub fn last(&self) -> &Sample {
        self.samples.last().expect("a trajectory has at least its start")
    }

    /// Energy that the books cannot account for [J]: motors less soil, kinetic and potential.
    #[must_use]
    pub fn energy_error(&self) -> f64 {
        let (first, last) = (&self.samples[0].energy, &self.last().energy);
        let (motors, soil) = (last.motors - first.motors, last.soil - first.soil);
        let kinetic = last.kinetic - first.kinetic;
        let potential = last.potential - first.potential;
        motors - soil - kinetic - potential
    }
}
