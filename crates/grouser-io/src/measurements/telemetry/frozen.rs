//! Channels that stay exactly as they are while others of their kind change: what a sensor that no
//! longer measures leaves behind.

use super::super::super::columns::{PITCH, ROLL, SINKAGE, WHEEL_SPEED};
use super::super::log_column::LogColumn;
use super::{FORWARD, LEFTWARD, MOTOR_CURRENT, ROTATION, WHEEL_TORQUE};

/// Rows with the same number before a channel counts as frozen.
const ROWS: u64 = 100;
/// Different numbers of other channels of its kind meanwhile: what is rounded coarsely stays the
/// same for long, but takes few numbers.
const OTHERS: usize = 8;

/// Looks for frozen channels.
#[derive(Clone, Debug)]
pub(super) struct Frozen(Vec<FrozenChannel>);

#[derive(Clone, Debug, Default)]
struct FrozenChannel {
    kind: Option<u8>,
    is_judged: bool,
    number: f64,
    /// Rows that have this number.
    rows: u64,
    /// Different numbers of the others meanwhile.
    others: Vec<f64>,
}

impl Frozen {
    /// * `columns`: those of a table; nothing for one that is not known
    pub(super) fn of(columns: impl Iterator<Item = Option<&'static LogColumn>>) -> Self {
        let channel = |it: Option<&LogColumn>| FrozenChannel {
            kind: it.and_then(|it| kind_of(it.name)),
            is_judged: it.is_some_and(|it| ![LEFTWARD.name, ROTATION.name].contains(&it.name)),
            number: f64::NAN,
            ..FrozenChannel::default()
        };
        Self(columns.map(channel).collect())
    }

    /// Whether the channel of a column is frozen, with a number more.
    pub(super) fn is_frozen_with(&mut self, place: usize, number: f64) -> bool {
        let Some(kind) = self.0[place].kind else { return false };
        for (other, channel) in self.0.iter_mut().enumerate() {
            let is_other = other != place && channel.kind == Some(kind);
            if is_other && channel.others.len() < OTHERS && !channel.others.contains(&number) {
                channel.others.push(number);
            }
        }
        let channel = &mut self.0[place];
        if channel.number != number {
            channel.others.clear();
            (channel.number, channel.rows) = (number, 0);
        }
        channel.rows += 1;
        // A wheel may stand, and a rover go straight on.
        let may_stay = !channel.is_judged || (number == 0.0 && kind == STANDING);
        channel.rows > ROWS && channel.others.len() >= OTHERS && !may_stay
    }
}

/// The kind of which 0 is a reading like any other.
const STANDING: u8 = 0;

/// A number for each kind of channels that change together.
fn kind_of(column: &str) -> Option<u8> {
    let kinds: [&[&str]; 6] = [
        &[WHEEL_SPEED.name],
        &[ROLL.name, PITCH.name],
        &[WHEEL_TORQUE.name],
        &[MOTOR_CURRENT.name],
        &[SINKAGE.name],
        &[FORWARD.name, LEFTWARD.name, ROTATION.name],
    ];
    (0..).zip(kinds).find(|(_, names)| names.contains(&column)).map(|(kind, _)| kind)
}
