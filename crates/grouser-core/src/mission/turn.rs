//! A turn on the spot that keeps its place.
//!
//! A skid-steered rover that turns creeps: on sand the sides do not share the turn evenly (more
//! slip gives no more thrust, so one side digs and the other walks), and on a slope its spinning
//! wheels hold it less against the weight across them. Neither can be steered away while it turns.
//! So it turns for a while, and shifts along its nose for a while, towards the place *s* along *e*
//! that minimises
//!
//! ```text
//! [n_f · (p + s e + D)]² + ε [e · (p + s e)]²
//! ```
//!
//! with *p* the way off its place, *n_f* across the nose at the end of the turn, along which it
//! could not come back then, and *D* the drift to come, ∫ c cos γ (sin γ, −cos γ) |dγ|: down the
//! slope across the nose, as much as was seen so far, with γ and *D* counted from the contour under
//! the rover.

use crate::elementary::wide;
use crate::units::Vec2;
use crate::vehicle::RoverState;
use crate::vehicle::state::rotation;

/// Off its way by more than this a rover shifts [m]. Source: ours; far below a wheel's width.
const TRIGGER: f64 = 0.015;
/// What counts the way off the place now beside that at the end, *ε* [-]. Source: ours.
const NOW: f64 = 0.3;
/// A shift leads no further off the place than this [m]. Source: ours; more would be nearer at the
/// end and further off on the way.
const FARTHEST: f64 = 0.12;
/// Drift per turn that is expected before any was seen, over the sine of the slope, *c* [m/rad],
/// and the turn that this counts for [rad]. Source: ours, of a rover of 0.5 m on sand.
const EXPECTED_DRIFT: f64 = 1.0;
const EXPECTED_COUNTS: f64 = 0.05;

/// A turn under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// The yaw at its end [rad].
    yaw: f64,
    place: Vec2,
    /// Which way the rover shifts: 1 forward, -1 backward, 0 while it turns.
    shift: f64,
    /// Place and yaw at the last look.
    last: (Vec2, f64),
    /// Sums of cos γ times the drift across [m], and of cos² γ |dγ| [rad], while it turned.
    drift: f64,
    judged: f64,
}

impl Turn {
    pub(super) fn new(yaw: f64, state: &RoverState) -> Self {
        let (place, last) = (state.position, (state.position, state.yaw));
        Self { yaw, place, shift: 0.0, last, drift: 0.0, judged: 0.0 }
    }

    /// Yaw rate that the sides would give on rigid ground [rad/s], and speed along the body's x
    /// axis [m/s].
    ///
    /// * `steepness`: sine of the slope [-], as an inclinometer has it
    /// * `contour`: direction of the contour with uphill to its left [rad], if the ground has one
    /// * `speed`: of the rims [m/s]
    /// * `reach`: the outermost wheel's distance from the middle [m]
    pub(super) fn steer(
        &mut self,
        state: &RoverState,
        steepness: f64,
        contour: Option<f64>,
        [speed, reach]: [f64; 2],
    ) -> (f64, f64) {
        self.look(state, contour);
        let way = self.way_to_shift(state, steepness, contour);
        if self.shift == 0.0 && way.abs() > TRIGGER {
            self.shift = way.signum();
        }
        if self.shift * way <= 0.0 {
            self.shift = 0.0;
        }
        if self.shift == 0.0 {
            ((self.yaw - state.yaw).signum() * speed / reach, 0.0)
        } else {
            (0.0, self.shift * speed)
        }
    }

    /// Learns from the way since the last look how much the rover drifts.
    fn look(&mut self, state: &RoverState, contour: Option<f64>) {
        let (place, yaw) = self.last;
        self.last = (state.position, state.yaw);
        if self.shift == 0.0
            && let Some(contour) = contour
        {
            let middle = f64::midpoint(yaw, state.yaw);
            let (sin, cos) = wide::sin_cos(middle);
            let across = (state.position - place).dot(&Vec2::new(-sin, cos));
            let cos = wide::cos(middle - contour);
            self.drift -= cos * across;
            self.judged += cos * cos * (state.yaw - yaw).abs();
        }
    }

    /// The way along the nose that leads to the better place [m].
    ///
    /// * `steepness`: sine of the slope [-]
    fn way_to_shift(&self, state: &RoverState, steepness: f64, contour: Option<f64>) -> f64 {
        let (sin, cos) = wide::sin_cos(state.yaw);
        let along = Vec2::new(cos, sin);
        let (end_sin, end_cos) = wide::sin_cos(self.yaw);
        let across_at_end = Vec2::new(-end_sin, end_cos);
        let off = state.position - self.place;
        let share = across_at_end.dot(&along);
        let there = across_at_end.dot(&(off + self.drift_to_come(state.yaw, steepness, contour)));
        let best = -(share * there + NOW * along.dot(&off)) / (share * share + NOW);
        // Within the circle around the place, as far as the nose leads into it.
        let (foot, aside) = (-along.dot(&off), along.perp(&off));
        let room = (FARTHEST * FARTHEST - aside * aside).max(0.0).sqrt();
        best.clamp(foot - room, foot + room)
    }

    /// Drift from a yaw [rad] to the end of the turn [m].
    fn drift_to_come(&self, yaw: f64, steepness: f64, contour: Option<f64>) -> Vec2 {
        let Some(contour) = contour else { return Vec2::zeros() };
        // ∫ sin γ cos γ dγ and ∫ cos² γ dγ
        let integrals = |yaw: f64| {
            let (sin, cos) = wide::sin_cos(yaw);
            Vec2::new(0.5 * sin * sin, -0.5 * (yaw + sin * cos))
        };
        let sense = (self.yaw - yaw).signum();
        let expected = EXPECTED_COUNTS * EXPECTED_DRIFT * steepness;
        let drift = (self.drift + expected) / (self.judged + EXPECTED_COUNTS);
        let drift = sense * drift * (integrals(self.yaw - contour) - integrals(yaw - contour));
        rotation(contour) * drift
    }
}
