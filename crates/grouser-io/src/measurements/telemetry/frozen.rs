//! Channels that stay exactly as they are while others of their kind change, or after they scattered:
//! what a sensor that no longer measures leaves behind.

use std::collections::VecDeque;

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
    /// The last numbers before, each another than the one before it.
    before: VecDeque<f64>,
    /// Whether those scattered, known once the number has stayed for long.
    scattered: bool,
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
            channel.change_to(number);
        }
        channel.rows += 1;
        if channel.rows == ROWS + 1 {
            channel.scattered = channel.has_scattered();
        }
        // A wheel may stand, and a rover go straight on.
        let may_stay = !channel.is_judged || (number == 0.0 && kind == STANDING);
        let is_still = channel.rows > ROWS && !may_stay;
        is_still && (channel.others.len() >= OTHERS || (number != 0.0 && channel.scattered))
    }
}

impl FrozenChannel {
    /// Numbers that are remembered.
    const BEFORE: usize = 20;

    fn change_to(&mut self, number: f64) {
        self.others.clear();
        if self.number.is_finite() {
            self.before.push_back(self.number);
        }
        if self.before.len() > Self::BEFORE {
            self.before.pop_front();
        }
        (self.number, self.rows, self.scattered) = (number, 0, false);
    }

    /// Whether it went up and down before, and took many numbers: what settles, or is rounded
    /// coarsely, does not.
    fn has_scattered(&self) -> bool {
        /// Changes of direction among those remembered.
        const TURNS: usize = 6;
        /// Less is rounding of the computer that simulated it, over the number [-].
        const CHANGE: f64 = 1e-4;
        let changes: Vec<f64> =
            self.before.iter().zip(self.before.iter().skip(1)).map(|(a, b)| b - a).collect();
        let is_change = |it: &&[f64]| {
            it[0] * it[1] < 0.0 && it.iter().all(|it| it.abs() > CHANGE * self.number.abs())
        };
        let turns = changes.windows(2).filter(is_change).count();
        let is_new = |(place, number): &(usize, &f64)| {
            !self.before.iter().take(*place).any(|it| it == *number)
        };
        let different = self.before.iter().enumerate().filter(is_new).count();
        turns >= TURNS && different >= OTHERS
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

#[cfg(test)]
mod tests {
    use super::super::COLUMNS;
    use super::*;

    /// The row in which the way forward counts as frozen, of 600 rows.
    fn frozen_at(way: impl Fn(u32) -> f64) -> Option<u32> {
        let forward = COLUMNS.iter().find(|it| it.name == FORWARD.name);
        let mut frozen = Frozen::of(std::iter::once(forward));
        (0..600).find(|row| frozen.is_frozen_with(0, way(*row)))
    }

    /// What scattered and then stays is frozen; what settles, what is rounded coarsely and what comes
    /// to stand is not.
    #[test]
    fn a_channel_that_scattered_and_stays_is_frozen() {
        let scatter = |row: u32| 0.006 + 1e-4 * f64::from(row * 7919 % 101);
        assert_eq!(frozen_at(|row| scatter(row.min(200))), Some(300));
        assert_eq!(frozen_at(scatter), None);
        assert_eq!(frozen_at(|row| 0.006 * (1.0 - 0.5_f64.powi(row.min(40).cast_signed()))), None);
        assert_eq!(frozen_at(|row| (200.0 * scatter(row.min(200))).round() / 200.0), None);
        assert_eq!(frozen_at(|row| if row < 200 { scatter(row) } else { 0.0 }), None);
    }
}
