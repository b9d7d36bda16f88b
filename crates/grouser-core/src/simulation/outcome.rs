//! What may become of a rover.

use super::outcome_kind::OutcomeKind;
use crate::stored::stored;
use crate::units::Vec2;

/// What became of the rover.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It drove for its whole duration.
    Completed,
    /// It no longer gets ahead.
    Immobilised {
        /// When that was certain [s].
        time: f64,
        /// What stopped it.
        because: StuckBecause,
    },
    /// It slides downhill faster than its wheels turn, beside what they roll downhill.
    Sliding {
        /// When that was certain [s].
        time: f64,
    },
    /// Its weight fell outside its wheels.
    TippedOver {
        /// When [s].
        time: f64,
    },
    /// Its battery no longer gave what motors and electronics drew.
    BrownOut {
        /// When [s].
        time: f64,
        /// What its battery lacks.
        because: PowerLost,
    },
    /// It drove to where its map has no heights.
    OffTheMap {
        /// When [s].
        time: f64,
        /// The wheel that came there.
        wheel: String,
        /// Where, in the map's coordinates [m].
        place: Vec2,
    },
    /// Its underside came to the ground.
    HighCentred {
        /// When that was seen [s].
        time: f64,
        /// Where, in the ground's coordinates [m].
        place: Vec2,
    },
}

stored!(enum Outcome {
    0 => Completed,
    1 => Immobilised { time, because },
    2 => Sliding { time },
    3 => TippedOver { time },
    4 => BrownOut { time, because },
    5 => OffTheMap { time, wheel, place },
    6 => HighCentred { time, place },
});

/// Why a battery no longer gave what was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PowerLost {
    /// It is empty.
    Empty,
    /// The voltage at its terminals is below that at which the electronics switch off.
    BelowCutoff {
        /// The voltage [V].
        voltage: f64,
        /// Voltage at which the electronics switch off [V].
        cutoff: f64,
    },
    /// No current of it has the power that is drawn.
    TooMuchDrawn {
        /// The power [W].
        power: f64,
    },
}

stored!(enum PowerLost {
    0 => Empty,
    1 => BelowCutoff { voltage, cutoff },
    2 => TooMuchDrawn { power },
});

/// What stopped a rover.
#[derive(Clone, Debug, PartialEq)]
pub enum StuckBecause {
    /// The wheels' mean slip stayed above [`SPINNING_SLIP`](super::watch::SPINNING_SLIP).
    WheelsSpin,
    /// The hubs' progress stayed under [`LEAST_PROGRESS`](super::watch::LEAST_PROGRESS) of the
    /// rims'.
    NoProgress,
    /// The motors stayed under [`LEAST_PROGRESS`](super::watch::LEAST_PROGRESS) of the speeds that
    /// they are set to.
    MotorsStall,
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

stored!(enum StuckBecause {
    0 => WheelsSpin,
    1 => NoProgress,
    2 => MotorsStall,
    3 => SunkToAxle { wheel, load, capacity },
});

impl Outcome {
    /// Its kind, of which the [table](OutcomeKind::row) says name, meaning, severity and what a
    /// band counts it as.
    #[must_use]
    pub fn kind(&self) -> OutcomeKind {
        match self {
            Self::Completed => OutcomeKind::Completed,
            Self::Immobilised { .. } => OutcomeKind::Immobilised,
            Self::Sliding { .. } => OutcomeKind::Sliding,
            Self::TippedOver { .. } => OutcomeKind::TippedOver,
            Self::BrownOut { .. } => OutcomeKind::BrownOut,
            Self::OffTheMap { .. } => OutcomeKind::OffTheMap,
            Self::HighCentred { .. } => OutcomeKind::HighCentred,
        }
    }

    /// One word: that of its [kind](Self::kind).
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.kind().name()
    }

    /// Whether the rover drove for its whole duration.
    #[must_use]
    pub fn is_completed(&self) -> bool {
        *self == Self::Completed
    }

    /// When it was certain [s]; nothing for a run that was completed.
    #[must_use]
    pub fn time(&self) -> Option<f64> {
        match self {
            Self::Completed => None,
            Self::Immobilised { time, .. }
            | Self::Sliding { time }
            | Self::TippedOver { time }
            | Self::BrownOut { time, .. }
            | Self::OffTheMap { time, .. }
            | Self::HighCentred { time, .. } => Some(*time),
        }
    }

    /// Reason in a few words; nothing for a completed run.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        let place = |place: &Vec2| format!("x = {:.3} m, y = {:.3} m", place.x, place.y);
        match self {
            Self::Completed => None,
            Self::Immobilised { because, .. } => Some(because.sentence()),
            Self::Sliding { .. } => Some("it slides downhill faster than its wheels turn".into()),
            Self::TippedOver { .. } => {
                let why = "no loads of its wheels balance it: its weight falls outside them, or one on a \
                           rocker or bogie would have to be held down";
                Some(why.into())
            }
            Self::BrownOut { because, .. } => Some(because.sentence()),
            Self::OffTheMap { wheel, place: at, .. } => {
                Some(format!("wheel {wheel} is at {}, where the map has no heights", place(at)))
            }
            Self::HighCentred { place: at, .. } => {
                Some(format!("its underside touches the ground at {}", place(at)))
            }
        }
    }
}

impl StuckBecause {
    /// Reason in a few words.
    fn sentence(&self) -> String {
        match self {
            Self::WheelsSpin => "the wheels spin without moving the rover".into(),
            Self::NoProgress => "the rover gets ahead by less than 1 % of its rims".into(),
            Self::MotorsStall => {
                "its motors stall: they turn at less than 1 % of the speed that they are set to"
                    .into()
            }
            Self::SunkToAxle { wheel, load, capacity } => format!(
                "wheel {wheel} sank to its axle: it bears {load:.3} N, the soil carries \
                 {capacity:.3} N"
            ),
        }
    }
}

impl PowerLost {
    /// Reason in a few words.
    fn sentence(self) -> String {
        match self {
            Self::Empty => "its battery is empty".into(),
            Self::BelowCutoff { voltage, cutoff } => format!(
                "its battery falls to {voltage:.2} V, below the {cutoff:.2} V at which the \
                 electronics switch off"
            ),
            Self::TooMuchDrawn { power } => {
                format!("its battery cannot give the {power:.1} W that motors and electronics draw")
            }
        }
    }
}
