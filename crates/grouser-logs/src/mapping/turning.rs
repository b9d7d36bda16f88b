//! Speeds of wheels whose logs have their angles: how far each turned over how long.

/// How far a wheel has turned, and when that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Angle {
    /// As it is read, and then as it goes on where a reading begins again [rad].
    pub(crate) at: f64,
    /// [ns]
    pub(crate) time: i64,
}

impl Angle {
    /// The speed since an earlier angle [rad/s]; nothing within one time.
    pub(crate) fn speed_since(self, earlier: Self) -> Option<f64> {
        let over = self.time.saturating_sub(earlier.time) as f64 / 1e9;
        (over > 0.0).then(|| (self.at - earlier.at) / over)
    }
}

/// Angles that go on where what was read begins again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turned {
    /// After how much each begins again [rad], infinite where it does not.
    wraps: Vec<f64>,
    /// What was read of each last, and how far it had turned [rad].
    last: Vec<Option<[f64; 2]>>,
}

impl Turned {
    pub(crate) fn new(wraps: Vec<f64>) -> Self {
        let last = vec![None; wraps.len()];
        Self { wraps, last }
    }

    /// Makes angles that were read at a time such that go on, each by the shorter way; readings
    /// come in the order of their times.
    pub(crate) fn go_on(&mut self, time: i64, angles: &mut [(usize, Angle)]) {
        for (slot, angle) in angles {
            let (read, wrap) = (angle.at, self.wraps[*slot]);
            let at = self.last[*slot].map_or(read, |[last_read, last]| {
                let way = read - last_read;
                let turns = if wrap.is_finite() { (way / wrap).round() } else { 0.0 };
                last + (if turns == 0.0 { way } else { way - turns * wrap })
            });
            self.last[*slot] = Some([read, at]);
            *angle = Angle { at, time };
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn angles_go_on_over_the_end_of_a_turn_either_way() {
        let mut turning = Turned::new(vec![TAU, f64::INFINITY]);
        let mut at = |angle: f64, slot: usize| {
            let mut angles = [(slot, Angle { at: angle, time: 0 })];
            turning.go_on(7, &mut angles);
            assert_eq!(angles[0].1.time, 7);
            angles[0].1.at
        };
        for (read, expected) in [(6.0, 6.0), (0.1, TAU + 0.1), (3.0, TAU + 3.0), (6.0, TAU + 6.0)] {
            assert!((at(read, 0) - expected).abs() < 1e-12, "{read}");
        }
        // Back over the beginning, and one that has none.
        assert!((at(0.1, 0) - (2.0 * TAU + 0.1)).abs() < 1e-12);
        assert!((at(6.1, 0) - (TAU + 6.1)).abs() < 1e-12);
        assert_eq!([at(100.0, 1), at(-100.0, 1)], [100.0, -100.0]);
    }

    #[test]
    fn a_speed_is_a_way_over_a_time() {
        let [one, two] = [(1.0, 0), (0.5, 250_000_000)].map(|(at, time)| Angle { at, time });
        assert_eq!((two.speed_since(one), one.speed_since(one)), (Some(-2.0), None));
    }
}
