//! Limits at which a rover stops, and what it does then.

use crate::error::{ParameterError, finite, positive};
use crate::simulation::Outcome;
use crate::stored::stored;
use crate::vehicle::{Mount, Rover};

/// A limit on one number.
///
/// A number over a distance is of the last metres that the *rims* went in this leg, so that a rover
/// which stands on spinning wheels is stopped, too; until they have gone so far, and in turns and
/// waits, it has no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The number.
    pub limited: Limited,
    /// The rover stops above it, in SI units.
    pub above: f64,
    /// The way of the rims over which it is taken [m], for those that are of a
    /// [way](Limited::is_of_a_way).
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
    /// Drift over a way: way straight down the ground for a metre travelled [m/m]; none on level
    /// ground.
    DriftPerMetre,
    /// Largest sinkage of a wheel over its shearing radius [-].
    Sinkage,
    /// Largest sinkage of a wheel [m].
    SinkageDepth,
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
    /// Yaw that a turn or an arc lacks where it ends [rad].
    Shortfall,
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

/// A stop of a rover, and its cause.
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

stored!(struct Stop { limited, above, over, then });
stored!(enum Limited {
    0 => SlipRatio,
    1 => Drift,
    2 => DriftPerMetre,
    3 => Sinkage,
    4 => SinkageDepth,
    5 => Roll,
    6 => Pitch,
    7 => Torque,
    8 => Time,
    9 => Energy,
    10 => OffPath,
    11 => Current,
    12 => Temperature,
    13 => Discharge,
    14 => Shortfall,
});
stored!(enum Then { 0 => End, 1 => NextLeg, 2 => BackOut(distance) });
stored!(enum Kind { 0 => Command, 1 => Reactive, 2 => Predictive });
stored!(struct Stopped { cause, kind, after });
stored!(enum Cause { 0 => Limit { stop, value }, 1 => Outcome(outcome) });

impl Stopped {
    /// The number whose limit made it stop; `None` where the way ahead did.
    #[must_use]
    pub fn limit(&self) -> Option<Limited> {
        match &self.cause {
            Cause::Limit { stop, .. } => Some(stop.limited),
            Cause::Outcome(_) => None,
        }
    }

    /// What the rover does next.
    #[must_use]
    pub fn then(&self) -> Then {
        match &self.cause {
            Cause::Limit { stop, .. } => stop.then,
            Cause::Outcome(_) => Then::End,
        }
    }
}

/// What is known of a number that may be limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimitedRow {
    /// What the number is: a sentence with its full stop.
    pub meaning: &'static str,
    /// How it is known, on the way, that the limit was passed.
    pub kind: Kind,
    /// Where it has a value.
    pub known: Where,
    /// Whether the wheels' forces and sinkage must be known for it.
    pub(super) needs_wheels: bool,
}

/// Where a number that is limited has a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    /// At every look.
    Everywhere,
    /// Where a manoeuvre leads somewhere: not in turns and waits.
    Drives,
    /// The same, over a way of the rims, once they have gone so far.
    Ways,
    /// At the end of a turn or an arc.
    Ends,
}

/// The row of each number, from which the list of all numbers is made too.
macro_rules! rows {
    ($($limited:ident { $kind:ident, $known:ident, needs_wheels: $needs:literal, $meaning:literal })+) => {
        impl Limited {
            /// All of them.
            pub const ALL: [Self; [$($meaning),+].len()] = [$(Self::$limited),+];

            /// What is known of it.
            #[must_use]
            pub const fn row(self) -> &'static LimitedRow {
                match self {
                    $(Self::$limited => &LimitedRow {
                        meaning: $meaning,
                        kind: Kind::$kind,
                        known: Where::$known,
                        needs_wheels: $needs,
                    },)+
                }
            }
        }
    };
}

rows! {
    SlipRatio {
        Reactive, Ways, needs_wheels: false,
        "Slip ratio over a way: 1 less what the ground saw of the rims' way."
    }
    Drift { Reactive, Ways, needs_wheels: false, "Way down the ground under the rover over a way." }
    DriftPerMetre {
        Reactive, Ways, needs_wheels: false,
        "Drift over a way: way down the ground under the rover for a metre travelled."
    }
    Sinkage {
        Reactive, Everywhere, needs_wheels: true,
        "Largest sinkage of a wheel over its shearing radius."
    }
    SinkageDepth { Reactive, Everywhere, needs_wheels: true, "Largest sinkage of a wheel." }
    Roll { Reactive, Everywhere, needs_wheels: false, "Roll to either side." }
    Pitch { Reactive, Everywhere, needs_wheels: false, "Pitch, nose up or down." }
    Torque { Reactive, Everywhere, needs_wheels: true, "Largest torque of a wheel's motor." }
    Time { Command, Everywhere, needs_wheels: false, "Time since the leg began." }
    Energy { Command, Everywhere, needs_wheels: false, "Work of the motors since the leg began." }
    OffPath {
        Reactive, Drives, needs_wheels: false,
        "Distance from the straight line, or the circle, of the leg."
    }
    Current {
        Reactive, Everywhere, needs_wheels: true,
        "Largest current of a wheel's motor, driving or braking."
    }
    Temperature {
        Reactive, Everywhere, needs_wheels: false, "Highest temperature of a motor's winding."
    }
    Discharge {
        Reactive, Everywhere, needs_wheels: false,
        "Depth of discharge: 1 less the battery's state of charge."
    }
    Shortfall {
        Reactive, Ends, needs_wheels: false,
        "Yaw that a turn or an arc lacks where it ends; without it 2°: beyond, the leg is \
         `fell_short`."
    }
}

impl Limited {
    /// Whether it is taken over a way.
    #[must_use]
    pub const fn is_of_a_way(self) -> bool {
        matches!(self.row().known, Where::Ways)
    }
}

impl Kind {
    /// One word: `command`, `reactive` or `predictive`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Command => "command",
            Self::Reactive => "reactive",
            Self::Predictive => "predictive",
        }
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

    /// Checks that a limit applies to a rover: what it limits has to be known of the rover.
    ///
    /// # Errors
    /// [`ParameterError`] where it is not known.
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
