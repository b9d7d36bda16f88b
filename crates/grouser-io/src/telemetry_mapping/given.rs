//! What a mapping says, as it is written.

use super::super::columns::{PITCH, ROLL, X, Y, YAW};
use super::super::measurements::Dimension;
use super::super::measurements::telemetry::{COLUMNS, FORWARD, LEFTWARD, Odometry, ROTATION};

/// What stands for the name of a wheel, in topics, fields and columns.
pub const WHEEL: &str = "{wheel}";

/// A mapping before its readings are understood; texts that are left out are empty.
#[derive(Clone, Debug, Default)]
pub(crate) struct Given {
    pub(crate) name: String,
    /// How far messages may be out of order [s].
    pub(crate) window: f64,
    /// All readings within such an interval are one row [s]; 0 if those of one time are.
    pub(crate) row_interval: f64,
    /// The topic whose messages end a row.
    pub(crate) row_topic: String,
    /// The field with the time of a message.
    pub(crate) time: String,
    /// What measured ways and rotations.
    pub(crate) odometry: Option<Odometry>,
    pub(crate) readings: Vec<GivenReading>,
}

/// A reading as it is written; texts that are left out are empty.
#[derive(Clone, Debug, Default)]
pub(crate) struct GivenReading {
    pub(crate) topic: String,
    pub(crate) message: String,
    pub(crate) time: String,
    pub(crate) field: String,
    pub(crate) attitude: String,
    pub(crate) pose: String,
    /// Where a pose has its quaternion, if `pose` is its position.
    pub(crate) orientation: String,
    /// The two frames of a transform, parent and child.
    pub(crate) transform: [String; 2],
    pub(crate) column: String,
    pub(crate) columns: Vec<String>,
    pub(crate) unit: String,
    pub(crate) scale: f64,
    pub(crate) sign: f64,
    pub(crate) offset: f64,
    /// Whether the field is the angle of a wheel, and its column the speed.
    pub(crate) is_position: bool,
    /// Where angles and ticks begin again [rad, ticks], and the ticks of a turn; 0 where they are
    /// left out.
    pub(crate) wrap: f64,
    pub(crate) wrap_ticks: f64,
    pub(crate) ticks_per_turn: f64,
    pub(crate) axes: Option<Axes>,
    pub(crate) is_optional: bool,
}

/// The axes in which a log has the body and what it moves in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// x forward, y left, z up, in a frame whose z is up.
    Ros,
    /// x forward, y right, z down, in a frame whose z is down.
    Ned,
    /// Grouser's: as ROS, with pitch positive nose up.
    Grouser,
}

/// A column that a pose gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseColumn {
    /// Roll of the body.
    Roll,
    /// Pitch of the body.
    Pitch,
    /// Yaw of the body.
    Yaw,
    /// Way along the body's x since the last pose.
    Forward,
    /// Way to the body's left since the last pose.
    Leftward,
    /// Rotation to the left since the last pose.
    Rotation,
    /// Position along the contour.
    X,
    /// Position uphill.
    Y,
}

impl PoseColumn {
    /// All of them, each with its name.
    pub const ALL: [(&'static str, Self); 8] = [
        (ROLL.name, Self::Roll),
        (PITCH.name, Self::Pitch),
        (YAW.name, Self::Yaw),
        (FORWARD.name, Self::Forward),
        (LEFTWARD.name, Self::Leftward),
        (ROTATION.name, Self::Rotation),
        (X.name, Self::X),
        (Y.name, Self::Y),
    ];

    /// The column of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, _)| *known == name).map(|(_, column)| column)
    }

    /// Whether an attitude alone does not give it.
    pub(crate) fn needs_position(self) -> bool {
        matches!(self, Self::Forward | Self::Leftward | Self::X | Self::Y)
    }
}

/// All columns of telemetry but the time, which no field of its own gives, as a regular expression:
/// those of wheels have a name behind them.
pub(crate) fn column_pattern() -> String {
    let of_kind = |is_of_wheel: bool| -> String {
        let columns = COLUMNS.iter().skip(1).filter(|it| it.is_of_wheel == is_of_wheel);
        columns.map(|it| it.name).collect::<Vec<_>>().join("|")
    };
    format!("^({}|({})_.+)$", of_kind(false), of_kind(true))
}

/// Units of what columns of telemetry hold.
pub(crate) fn units() -> Vec<&'static str> {
    let dimensions = [
        Dimension::Length,
        Dimension::Angle,
        Dimension::AngularSpeed,
        Dimension::Moment,
        Dimension::Current,
    ];
    // No unit has no name: the answer is what there is.
    dimensions.iter().flat_map(|it| it.size_of("").err().unwrap_or_default()).collect()
}
