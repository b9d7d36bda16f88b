//! What an operator is warned of: another soil, entrapment, a wheel that no longer pulls, a sensor
//! that lies.

use super::archive::Archive;
use super::gross::GrossFault;
use super::one_sided::OneSided;

/// Something that an operator should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// What it is.
    pub kind: WarningKind,
    /// When it was noticed [s].
    pub time: f64,
    /// The rims' way until then [m].
    pub way: f64,
    /// Time until it happens, if it is ahead [s].
    pub lead_time: Option<f64>,
    /// Way over the ground until it happens, if it is ahead [m].
    pub lead_way: Option<f64>,
    /// What was seen.
    pub evidence: Evidence,
}

/// What a warning rests on.
#[derive(Clone, Debug, PartialEq)]
pub enum Evidence {
    /// A motion that the soil learnt so far does not have there, over three or more stretches.
    Strange {
        /// The slip ratio that was seen [-].
        slip_ratio: f64,
        /// The slip ratio that was expected [-].
        expected: f64,
        /// The way to the left over that of the wheels as it was seen [-].
        drift: f64,
        /// The same as it was expected [-].
        expected_drift: f64,
    },
    /// Wheels that spin.
    Spinning {
        /// The slip ratio [-].
        slip_ratio: f64,
    },
    /// A slip ratio that grows.
    Growing {
        /// What it is now [-].
        slip_ratio: f64,
    },
    /// Ground that grows weaker.
    Weakening {
        /// The slip ratio now [-].
        slip_ratio: f64,
        /// What the wheels' pull is less by for each metre, over the weight [1/m].
        loss: f64,
        /// What the soil has to spare on this course, over the weight [-].
        spare: f64,
    },
    /// Ground that rises.
    Rising {
        /// The slip ratio now [-].
        slip_ratio: f64,
        /// The slope now [rad].
        slope: f64,
        /// The slope up to which the soil holds the rover on this course [rad].
        limit: f64,
    },
    /// A yaw that contradicts roll and pitch.
    Contradiction {
        /// The yaw as it was reported [rad].
        reported: f64,
        /// The yaw by roll and pitch [rad].
        by_attitude: f64,
    },
    /// A gross fault.
    Gross(GrossFault),
    /// Odometry that is faster than the wheels.
    Outrun {
        /// The slip ratio that it makes [-].
        slip_ratio: f64,
    },
    /// Readings that stay on one side of what is expected.
    OneSided {
        /// What they are.
        what: OneSided,
        /// How far, on the mean [standard deviations].
        deviations: f64,
    },
    /// A wheel with a small share of the others' torque.
    Idle {
        /// The wheel's name.
        wheel: String,
        /// The share that it has less than [-].
        share: f64,
    },
}

/// What a warning is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WarningKind {
    /// The rover moves as it would not on the soil that was learnt so far.
    SoilChange,
    /// The rover gets stuck if it goes on.
    Entrapment,
    /// A wheel has much less torque than the others.
    WheelNotPulling,
    /// Readings contradict each other, or do not change.
    LyingSensor,
}

impl WarningKind {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::SoilChange, Self::Entrapment, Self::WheelNotPulling, Self::LyingSensor];

    /// One word: `soil-change`, `entrapment`, `wheel-not-pulling`, `lying-sensor`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SoilChange => "soil-change",
            Self::Entrapment => "entrapment",
            Self::WheelNotPulling => "wheel-not-pulling",
            Self::LyingSensor => "lying-sensor",
        }
    }
}

impl WarningKind {
    /// Writes or reads it by its name.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let mut name = self.name().to_owned();
        archive.word("kind", &mut name);
        match Self::ALL.into_iter().find(|kind| kind.name() == name) {
            Some(kind) => *self = kind,
            None => archive.refuse("kind"),
        }
    }
}
