//! One clock for a log: messages without a time of their own take their place among those that
//! have one.
//!
//! A log has the times at which messages were recorded, by the clock of the recorder; most messages
//! have a stamp beside that, by the clock of the robot or of a simulation. The difference of both,
//! as the last stamped message has it, takes one clock to the other.

use crate::mapping::merge::Readings;

/// When something was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum When {
    /// By the message's own stamp [ns].
    Stamped(i64),
    /// When it was recorded.
    Recorded,
}

/// From the recorder's clock to that of the messages.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clock {
    /// By how much the recorder's is ahead [ns]; `None` before the first stamp.
    ahead: Option<i64>,
    /// Readings before the first stamp, each with the time at which it was recorded [ns].
    waiting: Vec<(i64, Readings)>,
}

/// Readings that wait for a stamp at the most; a log without any has one clock, the recorder's.
const MOST_WAITING: usize = 10_000;

impl Clock {
    /// Gives readings their times; those come out that waited for a stamp, too.
    ///
    /// * `recorded`: when the message was recorded [ns]
    pub(crate) fn place(
        &mut self,
        recorded: i64,
        (when, readings): (When, Readings),
    ) -> Vec<(i64, Readings)> {
        if let When::Stamped(time) = when {
            let ahead = recorded.saturating_sub(time);
            self.ahead = Some(ahead);
            let mut placed = self.take(ahead);
            placed.push((time, readings));
            return placed;
        }
        if let Some(ahead) = self.ahead {
            return vec![(recorded.saturating_sub(ahead), readings)];
        }
        self.waiting.push((recorded, readings));
        if self.waiting.len() < MOST_WAITING {
            return Vec::new();
        }
        self.end()
    }

    /// No stamp comes any more: what waited has the times at which it was recorded.
    pub(crate) fn end(&mut self) -> Vec<(i64, Readings)> {
        let ahead = *self.ahead.get_or_insert(0);
        self.take(ahead)
    }

    fn take(&mut self, ahead: i64) -> Vec<(i64, Readings)> {
        let place =
            |(recorded, readings): (i64, Readings)| (recorded.saturating_sub(ahead), readings);
        self.waiting.drain(..).map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(placed: &[(i64, Readings)]) -> Vec<i64> {
        placed.iter().map(|it| it.0).collect()
    }

    fn at(clock: &mut Clock, recorded: i64, when: When) -> Vec<i64> {
        times(&clock.place(recorded, (when, Readings::default())))
    }

    #[test]
    fn what_has_no_stamp_is_where_its_neighbours_are() {
        let mut clock = Clock::default();
        assert!(at(&mut clock, 1000, When::Recorded).is_empty(), "it waits");
        assert_eq!(at(&mut clock, 1010, When::Stamped(10)), [0, 10]);
        assert_eq!(at(&mut clock, 1025, When::Recorded), [25]);
        // A simulation that is slower than the recorder's clock.
        assert_eq!(at(&mut clock, 1100, When::Stamped(60)), [60]);
        assert_eq!(at(&mut clock, 1105, When::Recorded), [65]);
    }

    #[test]
    fn a_log_without_stamps_has_the_recorders_clock() {
        let mut clock = Clock::default();
        assert!(at(&mut clock, 5, When::Recorded).is_empty());
        assert_eq!(times(&clock.end()), [5]);
        assert_eq!(at(&mut clock, 7, When::Recorded), [7]);
        let mut many = Clock::default();
        let most = i64::try_from(MOST_WAITING).unwrap();
        let found: Vec<i64> =
            (0..most + 2).flat_map(|time| at(&mut many, time, When::Recorded)).collect();
        assert_eq!(found, (0..most + 2).collect::<Vec<_>>());
    }
}
