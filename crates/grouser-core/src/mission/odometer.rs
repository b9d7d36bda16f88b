//! How far a rover came in a leg: over the ground, and by its rims.

use std::collections::VecDeque;

use crate::stored::stored;

/// Ways since a leg began, and the last metres of them.
#[derive(Clone, Debug)]
pub(super) struct Odometer {
    time: f64,
    now: Mark,
    /// Looks of the last metres, the oldest first.
    marks: VecDeque<Mark>,
    /// The way of the rims that is remembered [m].
    remembered: f64,
}

/// How far a rover had come.
#[derive(Clone, Copy, Debug)]
struct Mark {
    /// Way straight down the ground [m].
    down: f64,
    /// Way over the ground [m].
    ground: f64,
    /// Way of the rims, mean of all wheels [m].
    rims: f64,
}

stored!(struct Odometer { time, now, marks, remembered });
stored!(struct Mark { down, ground, rims });

impl Mark {
    fn toward(self, later: Self, share: f64) -> Self {
        Self {
            down: self.down + (later.down - self.down) * share,
            ground: self.ground + (later.ground - self.ground) * share,
            rims: self.rims + (later.rims - self.rims) * share,
        }
    }
}

/// What was seen over the last metres of the rims' way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// Slip ratio over it [-].
    pub(super) slip_ratio: f64,
    /// Way straight down the ground [m].
    pub(super) drift: f64,
}

impl Seen {
    /// Way straight down the ground for a metre travelled [m/m]; nothing of a rover that stands.
    ///
    /// * `over`: the way of the rims over which it was seen [m]
    pub(super) fn drift_per_metre(self, over: f64) -> Option<f64> {
        let travelled = (1.0 - self.slip_ratio) * over;
        (travelled > 0.0).then(|| self.drift / travelled)
    }
}

impl Odometer {
    /// * `down`: how far straight downhill the rover is [m], as for [`look`](Self::look)
    /// * `remembered`: the longest way of the rims that will be asked for [m]
    pub(super) fn new(time: f64, down: f64, remembered: f64) -> Self {
        let now = Mark { down, ground: 0.0, rims: 0.0 };
        Self { time, now, marks: VecDeque::from([now]), remembered }
    }

    /// Looks at a rover whose rims had the same speeds since the last look [m/s].
    ///
    /// * `ground`: its way over the ground since the leg began [m]
    /// * `down`: how far straight downhill it is [m]
    pub(super) fn look(&mut self, time: f64, ground: f64, down: f64, rim_speeds: &[f64]) {
        self.now = Mark {
            down,
            ground,
            rims: self.now.rims + mean_speed(rim_speeds) * (time - self.time),
        };
        self.time = time;
        self.marks.push_back(self.now);
        // One mark at or before the way that is remembered stays.
        let old = self.now.rims - self.remembered;
        while self.marks.get(1).is_some_and(|second| second.rims <= old) {
            self.marks.pop_front();
        }
    }

    /// Lays what was seen since some way of the rims [m] anew, evenly from there to what is known
    /// now: between two fixes a rover only reckoned.
    pub(super) fn lay_anew(&mut self, since: f64) {
        let now = self.now;
        let first = self.marks.partition_point(|mark| mark.rims <= since);
        let start = first.checked_sub(1).and_then(|at| self.marks.get(at)).copied();
        let Some(start) = start.filter(|start| start.rims < now.rims) else { return };
        for mark in self.marks.range_mut(first..) {
            *mark = start.toward(now, (mark.rims - start.rims) / (now.rims - start.rims));
        }
    }

    /// How far straight downhill the rover is [m].
    pub(super) fn down(&self) -> f64 {
        self.now.down
    }

    /// Way over the ground [m].
    pub(super) fn ground(&self) -> f64 {
        self.now.ground
    }

    /// Way of the rims [m].
    pub(super) fn rims(&self) -> f64 {
        self.now.rims
    }

    /// The last metres of the rims' way; nothing before they have gone so far.
    ///
    /// * `over`: how many [m], at most those that are remembered
    pub(super) fn over(&self, over: f64) -> Option<Seen> {
        let from = self.now.rims - over;
        if from < 0.0 {
            return None;
        }
        let later = self.marks.partition_point(|mark| mark.rims <= from);
        let before = *self.marks.get(later.checked_sub(1)?)?;
        let start = match self.marks.get(later) {
            Some(after) if after.rims > before.rims => {
                before.toward(*after, (from - before.rims) / (after.rims - before.rims))
            }
            _ => before,
        };
        Some(Seen {
            slip_ratio: 1.0 - (self.now.ground - start.ground) / over,
            drift: self.now.down - start.down,
        })
    }
}

/// Mean speed of rims, whichever way they turn [m/s].
pub(super) fn mean_speed(rim_speeds: &[f64]) -> f64 {
    rim_speeds.iter().map(|speed| speed.abs()).sum::<f64>() / rim_speeds.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: half of the rims' way along, a tenth of it down.
    #[test]
    fn slip_and_drift_are_those_of_the_last_metres() {
        let mut odometer = Odometer::new(0.0, 0.0, 1.0);
        for step in 1..=40_u32 {
            let time = 0.7 * f64::from(step);
            let (along, down) = (0.03 * time, 0.006 * time);
            odometer.look(time, along.hypot(down), down, &[0.06, -0.06]);
            let rims = 0.06 * time;
            assert!((odometer.rims() - rims).abs() < 1e-12);
            let seen = odometer.over(1.0);
            if rims < 1.0 {
                assert_eq!(seen, None);
            } else {
                let seen = seen.expect("a metre was gone");
                let way = f64::hypot(0.5, 0.1);
                assert!((seen.slip_ratio - (1.0 - way)).abs() < 1e-12, "{seen:?}");
                assert!((seen.drift - 0.1).abs() < 1e-12, "{seen:?}");
                let per_metre = seen.drift_per_metre(1.0).expect("it moves");
                assert!((per_metre - 0.1 / way).abs() < 1e-12, "{per_metre}");
            }
        }
        assert!(odometer.marks.len() < 30, "what is too old is forgotten");
    }
}
