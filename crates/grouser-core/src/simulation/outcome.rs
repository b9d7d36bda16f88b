//! What may become of a rover.

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

/// Why a battery no longer gave what was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PowerLost {
    /// It is empty.
    Empty,
    /// The voltage at its terminals is below that at which the electronics switch off.
    BelowCutoff {
        /// The voltage [V].
        voltage: f64,
        /// That at which they switch off [V].
        cutoff: f64,
    },
    /// No current of it has the power that is drawn.
    TooMuchDrawn {
        /// The power [W].
        power: f64,
    },
}

/// What stopped a rover.
#[derive(Clone, Debug, PartialEq)]
pub enum StuckBecause {
    /// The wheels' mean slip stayed above [`SPINNING_SLIP`](super::watch::SPINNING_SLIP).
    WheelsSpin,
    /// The hubs' progress stayed under [`LEAST_PROGRESS`](super::watch::LEAST_PROGRESS) of the rims'.
    NoProgress,
    /// The motors stayed under [`LEAST_PROGRESS`](super::watch::LEAST_PROGRESS) of the speeds that they are set to.
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

impl Outcome {
    /// One word: `completed`, `immobilised`, `sliding`, `tipped_over`, `brown_out`, `off_map`, `high_centred`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Immobilised { .. } => "immobilised",
            Self::Sliding { .. } => "sliding",
            Self::TippedOver { .. } => "tipped_over",
            Self::BrownOut { .. } => "brown_out",
            Self::OffTheMap { .. } => "off_map",
            Self::HighCentred { .. } => "high_centred",
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
                StuckBecause::MotorsStall => {
                    "its motors stall: they turn at less than 1 % of the speed that they are set to"
                        .into()
                }
                StuckBecause::SunkToAxle { wheel, load, capacity } => format!(
                    "wheel {wheel} sank to its axle: it bears {load:.3} N, the soil carries {capacity:.3} N"
                ),
            }),
            Self::Sliding { .. } => Some("it slides downhill faster than its wheels turn".into()),
            Self::TippedOver { .. } => Some("its weight falls outside its wheels".into()),
            Self::BrownOut { because, .. } => Some(match because {
                PowerLost::Empty => "its battery is empty".into(),
                PowerLost::BelowCutoff { voltage, cutoff } => format!(
                    "its battery falls to {voltage:.2} V, below the {cutoff:.2} V at which the electronics switch off"
                ),
                PowerLost::TooMuchDrawn { power } => {
                    format!(
                        "its battery cannot give the {power:.1} W that motors and electronics draw"
                    )
                }
            }),
            Self::OffTheMap { wheel, place, .. } => Some(format!(
                "wheel {wheel} is at x = {:.3} m, y = {:.3} m, where the map has no heights",
                place.x, place.y
            )),
            Self::HighCentred { place, .. } => Some(format!(
                "its underside touches the ground at x = {:.3} m, y = {:.3} m",
                place.x, place.y
            )),
        }
    }
}
