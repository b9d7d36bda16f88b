//! How wheels turn whose speed depends on their load.

use crate::stored::Stored;

/// So many wheels may have motors whose speed depends on their load. Source: ours; no rover has had
/// more.
pub const MOST_WHEELS: usize = 8;

/// Speed of each wheel, and what its controller remembers; or the rates of both.
///
/// For a wheel whose speed does not depend on its load, it is the speed that is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turning {
    wheels: usize,
    /// Rim speeds, *ω r_s* [m/s].
    rim_speeds: [f64; MOST_WHEELS],
    /// What the integrals of controllers add to the voltage, *z* [V].
    integrals: [f64; MOST_WHEELS],
}

impl Stored for Turning {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.numbers().concat().store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        let numbers = Vec::restore(bytes)?;
        (numbers.len() <= 2 * MOST_WHEELS).then(|| Self::of(&numbers))
    }
}

impl Turning {
    /// Wheels at these rim speeds [m/s], with controllers that start now.
    pub(super) fn at(speeds: &[f64]) -> Self {
        let mut turning = Self {
            wheels: speeds.len(),
            rim_speeds: [0.0; MOST_WHEELS],
            integrals: [0.0; MOST_WHEELS],
        };
        turning.rim_speeds[..speeds.len()].copy_from_slice(speeds);
        turning
    }

    /// From the numbers of [`numbers`](Self::numbers), one list after the other.
    pub(super) fn of(numbers: &[f64]) -> Self {
        let (rim_speeds, integrals) = numbers.split_at(numbers.len() / 2);
        let mut turning = Self::at(rim_speeds);
        turning.integrals[..integrals.len()].copy_from_slice(integrals);
        turning
    }

    /// Rim speeds and integrals.
    pub(super) fn numbers(&self) -> [&[f64]; 2] {
        [self.rim_speeds(), &self.integrals[..self.wheels]]
    }

    /// Rim speed of each wheel [m/s], or its rate [m/s²].
    pub(super) fn rim_speeds(&self) -> &[f64] {
        &self.rim_speeds[..self.wheels]
    }

    /// What the integral of a wheel's controller adds to its voltage [V].
    pub(super) fn integral(&self, wheel: usize) -> f64 {
        self.integrals[wheel]
    }

    /// Sets the numbers of a wheel.
    pub(super) fn set(&mut self, wheel: usize, rim_speed: f64, integral: f64) {
        (self.rim_speeds[wheel], self.integrals[wheel]) = (rim_speed, integral);
    }
}
