//! Limits at which a rover stops, and what it does then.

use crate::error::{ParameterError, finite, positive};
use crate::simulation::Outcome;
use crate::vehicle::{Mount, Rover};

/// A limit on one number.
///
/// A number over a distance is of the last metres that the *rims* went in this leg, so that a rover which stands on
/// spinning wheels is stopped, too; until they have gone so far, and in turns and waits, it has no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The number.
    pub limited: Limited,
    /// The rover stops above it, in SI units.
    pub above: f64,
    /// The way of the rims over which it is taken [m], for those that are of a [way](Limited::is_of_a_way).
    pub over: f64,
    /// What comes next.
    pub then: Then,
}

/// A number that may be limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limited {
    /// Slip ratio over a way: 1 less what the ground saw of the rims' way [-].
    SlipRatio,
    /// Way straight down the ground over a way [m]; none on level ground.
    Drift,
    /// Largest sinkage of a wheel over its shearing radius [-].
    Sinkage,
    /// Roll to either side [rad].
    Roll,
    /// Pitch, nose up or down [rad].
    Pitch,
    /// Largest torque of a motor [N·m].
    Torque,
    /// Time since the leg began [s].
    Time,
    /// Work of the motors since the leg began [J].
    Energy,
    /// Distance from the straight line of the leg [m].
    OffPath,
    /// Largest current of a motor, driving or braking [A].
    Current,
    /// Highest temperature of a motor's winding [°C].
    Temperature,
    /// Depth of discharge of the battery: 1 less its state of charge [-].
    Discharge,
}

/// What a rover does once it has stopped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Then {
    /// The mission ends.
    #[default]
    End,
    /// The next leg begins.
    NextLeg,
    /// It drives so far [m] against the way of the leg, and the mission ends.
    BackOut(f64),
}

/// How a rover knows that it should stop. Source: [BiesiadeckiMaimone2006], in its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A limit that comes with the command: time and energy.
    Command,
    /// What was felt on the way.
    Reactive,
    /// What a simulation of the way ahead says.
    Predictive,
}

/// That a rover stopped, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// What made it stop.
    pub cause: Cause,
    /// How it was known.
    pub kind: Kind,
    /// Way over the ground since the manoeuvre began [m].
    pub after: f64,
}

/// What makes a rover stop.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// A limit that was passed, or would have been.
    Limit {
        /// The limit.
        stop: Stop,
        /// The number, in SI units.
        value: f64,
    },
    /// What would have become of it on the way ahead.
    Outcome(Outcome),
}

impl Stopped {
    /// What the rover does next.
    #[must_use]
    pub fn then(&self) -> Then {
        match &self.cause {
            Cause::Limit { stop, .. } => stop.then,
            Cause::Outcome(_) => Then::End,
        }
    }
}

impl Limited {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::SlipRatio,
        Self::Drift,
        Self::Sinkage,
        Self::Roll,
        Self::Pitch,
        Self::Torque,
        Self::Time,
        Self::Energy,
        Self::OffPath,
        Self::Current,
        Self::Temperature,
        Self::Discharge,
    ];

    /// Whether it is taken over a way.
    #[must_use]
    pub fn is_of_a_way(self) -> bool {
        matches!(self, Self::SlipRatio | Self::Drift)
    }

    /// Whether it has a value only where a manoeuvre leads somewhere: not in turns and waits.
    pub(super) fn is_of_a_drive(self) -> bool {
        self.is_of_a_way() || self == Self::OffPath
    }

    /// Whether the wheels' forces and sinkage must be known for it.
    pub(super) fn needs_wheels(self) -> bool {
        matches!(self, Self::Sinkage | Self::Torque | Self::Current)
    }

    /// How it is known that it was passed, on the way.
    #[must_use]
    pub fn kind(self) -> Kind {
        if matches!(self, Self::Time | Self::Energy) { Kind::Command } else { Kind::Reactive }
    }
}

impl Stop {
    /// A limit at which the mission ends; a number of a way is taken over a metre.
    ///
    /// * `above`: in SI units
    #[must_use]
    pub fn above(limited: Limited, above: f64) -> Self {
        Self { limited, above, over: 1.0, then: Then::End }
    }

    /// That it can be passed by a rover: what it limits has to be known of it.
    ///
    /// # Errors
    /// [`ParameterError`] where it is not.
    fn check_on(&self, rover: &Rover) -> Result<(), ParameterError> {
        let winding = |mount: &Mount| mount.unit.motor.is_some_and(|it| it.winding.is_some());
        let [name, expected] = match self.limited {
            Limited::Current if !rover.has_motors() => {
                ["limit of the current [A]", "left out for a rover whose motors are not known"]
            }
            Limited::Temperature if !rover.mounts().iter().any(winding) => [
                "limit of the winding's temperature [°C]",
                "left out for a rover whose motors' windings are not known",
            ],
            Limited::Discharge if rover.battery().is_none() => [
                "limit of the depth of discharge",
                "left out for a rover whose battery is not known",
            ],
            _ => return Ok(()),
        };
        Err(ParameterError::new(name, self.above, expected))
    }

    pub(super) fn check(&self, rover: &Rover) -> Result<(), ParameterError> {
        self.check_on(rover)?;
        finite("limit at which to stop", self.above)?;
        if self.limited.is_of_a_way() {
            positive("way over which a limit holds [m]", self.over)?;
        }
        match self.then {
            Then::BackOut(distance) => positive("distance to back out [m]", distance),
            Then::End | Then::NextLeg => Ok(()),
        }
    }
}
