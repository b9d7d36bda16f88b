//! The steady state that a rover comes to from velocities far from it.
//!
//! Implicit Euler steps, linear in each, go the way that the rover would go:
//!
//! ```text
//! (1/h − J) ΔV = a(V)
//! ```
//!
//! J is taken by differences, and brought up to date by steps that it foresaw (Broyden 1965). A step
//! whose end has other accelerations than the tangent said is taken again: with a J of its own, and
//! where it had one, shorter. Where accelerations fade, steps lengthen, and from nearby Newton's steps
//! lead on.
//!
//! Where the rover goes straight to a steady state, it need not be followed.

use nalgebra::{Matrix3, Vector3};

use super::{
    CLOSE, LONGEST_WAY, ReachedState, SteadySolver, SteadyState, acceleration_of, steady_state_at,
};
use crate::simulation::equations::Evaluation;

/// A step that the tangent foresaw well enough.
struct Followed {
    velocities: Vector3<f64>,
    there: Evaluation,
    /// How long it is, and the next one may be [s].
    span: f64,
    next_span: f64,
    /// By how much the tangent missed its end, over the accelerations at its start [-].
    missed: f64,
}

/// Steps, those taken again included. Source: measured; some turns on the spot pass a place where
/// they are almost steady, and of 6,400 motions after random commands 26 are not found in 60 steps, 10
/// in these, 9 in 120.
const MOST_STEPS: usize = 80;
/// How near that is, over the fastest rim's speed [-].
const ARRIVED: f64 = 0.02;
/// The first step [s]: within the milliseconds in which slip settles.
const FIRST_STEP: f64 = 1e-3;
/// A step whose end the tangent missed by more than so many times the accelerations at its start is
/// taken again, and how much shorter [-].
const MOST_MISSED: f64 = 1.5;
const SHORTER: f64 = 0.25;
/// How far the tangent may miss the end of the next step, over the accelerations at its start [-],
/// expected to be in proportion to its length. Source: measured; of 9,000 motions after new commands,
/// rests among them, 81 end otherwise than dynamic ones with steps of 1, 40 with these, for as many
/// evaluations.
const MISSED: f64 = 0.2;
/// A step that the tangent foresaw to this brings it up to date [-]; after others it is found anew.
/// Source: measured; with 0.05 a motion costs a tenth more, with 0.2 as much.
const FORESEEN: f64 = 0.1;
/// A step is this much shorter where it has no end, or one that the rover would not come to.
const MUCH_SHORTER: f64 = 0.1;
/// The least and the most that a step is as long as the one before it [-].
const CHANGE: (f64, f64) = (0.3, 10.0);
/// A step that changes velocities by less is little, over the fastest rim's speed [-].
const LITTLE: f64 = 0.1;
/// Newton's step from which on Newton's steps alone lead there, over the fastest rim's speed [-],
/// unless they lead farther than so many times that.
const NEAR: f64 = 0.03;
const STRAYING: f64 = 2.0;
/// Shares of the way to a steady state at which it is seen whether the rover goes straight to it
/// [-], and the least cosine between the way and where the rover is drawn there. Source: measured;
/// with 0.3, of 8,900 motions after random commands 11 more end otherwise than dynamic ones.
const ON_THE_WAY: [f64; 4] = [0.0, 0.3, 0.6, 0.9];
const STRAIGHT: f64 = 0.9;
/// What forces may miss there [-].
const ROUGHLY: f64 = 1e-3;

impl SteadySolver<'_, '_> {
    /// The steady state that a rover comes to from the guess.
    ///
    /// * `most_longer`: how much longer steps become that change velocities little [-]
    pub(super) fn settle(
        &mut self,
        yaw: f64,
        guess: &Vector3<f64>,
        most_longer: f64,
    ) -> Option<ReachedState> {
        let mut velocities = *guess;
        let mut here = self.evaluate(yaw, &velocities)?;
        let (mut span, mut left) = (FIRST_STEP, MOST_STEPS);
        let (mut time, mut passed) = (0.0, Vec::new());
        let mut tangent = None;
        while left > 0 {
            let is_new = tangent.is_none();
            let jacobian = match tangent.take() {
                Some(jacobian) => jacobian,
                None => self.jacobian(yaw, &velocities, &here, None)?,
            };
            passed.push((time, velocities));
            if let Some(steady) = self.end_near(yaw, &velocities, &here, &jacobian) {
                let far = |it: &Vector3<f64>| self.size(&(it - steady.velocities)) > ARRIVED;
                let near = passed.iter().rposition(|(_, it)| far(it)).map_or(0, |last| last + 1);
                let time = passed.get(near).map_or(time, |(time, _)| *time);
                return Some(ReachedState { steady, time });
            }
            let from = (&velocities, acceleration_of(&here));
            let followed =
                self.follow(yaw, from, &jacobian, is_new, &mut left, (span, most_longer));
            let Some(step) = followed else {
                if is_new {
                    return None;
                }
                // Differences are taken from the motion last looked at.
                here = self.evaluate(yaw, &velocities)?;
                continue;
            };
            time += step.span;
            let way = step.velocities - velocities;
            let missed = acceleration_of(&step.there) - acceleration_of(&here) - jacobian * way;
            tangent = (step.missed <= FORESEEN).then(|| jacobian + self.explaining(&missed, &way));
            (velocities, here, span) = (step.velocities, step.there, step.next_span);
        }
        None
    }

    /// The steady state, where it is near.
    fn end_near(
        &mut self,
        yaw: f64,
        velocities: &Vector3<f64>,
        here: &Evaluation,
        jacobian: &Matrix3<f64>,
    ) -> Option<SteadyState> {
        let inverse = jacobian.try_inverse()?;
        let step = inverse * acceleration_of(here);
        let way = self.size(&step);
        if way <= CLOSE {
            self.memory.inverse = Some(inverse);
            return Some(steady_state_at(yaw, velocities - step, here.clone(), None));
        }
        let (longest, before) = (STRAYING * way, self.memory.inverse);
        let found = (way <= NEAR)
            .then(|| self.correct_from(yaw, velocities, here.clone(), inverse, longest))??;
        if self.size(&(found.velocities - velocities)) > longest {
            self.memory.inverse = before;
            return None;
        }
        Some(found)
    }

    /// The least matrix that makes a change of velocities what was missed (Broyden 1965).
    fn explaining(&self, missed: &Vector3<f64>, way: &Vector3<f64>) -> Matrix3<f64> {
        let lengths = self.lengths();
        let way = way.component_mul(&lengths);
        missed * (way.component_mul(&lengths) / way.norm_squared()).transpose()
    }

    /// A step, as long as the tangent foresees it; none where it foresees none. A tangent that was not
    /// taken here is given up at its first miss.
    ///
    /// * `from`: velocities and accelerations
    /// * `is_new`: whether the tangent was taken here
    /// * `left`: steps
    fn follow(
        &self,
        yaw: f64,
        (from, acceleration): (&Vector3<f64>, Vector3<f64>),
        jacobian: &Matrix3<f64>,
        is_new: bool,
        left: &mut usize,
        (mut span, most_longer): (f64, f64),
    ) -> Option<Followed> {
        let size = |acceleration: &Vector3<f64>| {
            Vector3::new(acceleration.x, acceleration.y, acceleration.z * self.reach).norm()
        };
        while *left > 0 {
            *left -= 1;
            let step = (Matrix3::identity() / span - jacobian).try_inverse()? * acceleration;
            // A long way in one step is not what the rover would do.
            let is_short = self.size(&step) <= 1.0;
            let Some(there) = is_short.then(|| self.evaluate(yaw, &(from + step))).flatten() else {
                span *= MUCH_SHORTER;
                continue;
            };
            let reached = acceleration_of(&there);
            let missed = size(&(reached - step / span)) / size(&acceleration);
            if missed > MOST_MISSED {
                if !is_new {
                    return None;
                }
                span *= SHORTER;
                continue;
            }
            let fading = size(&acceleration) / size(&reached);
            // Accelerations that stay, as of a start, are followed by shares of the way.
            let share = (LITTLE / self.size(&step)).min(most_longer);
            // Accelerations that grow are no reason for a shorter one.
            let longer = fading.clamp(1.0, CHANGE.1).max(share);
            let next_span = span * longer.min(MISSED / missed).max(CHANGE.0);
            return Some(Followed { velocities: from + step, there, span, next_span, missed });
        }
        None
    }

    /// The steady state of wheels that all turn one way, if a rover that all but rests goes straight to
    /// it: it is sought from velocities of rolling wheels, and seen on the way that the rover is drawn
    /// along it.
    pub(super) fn straight(
        &mut self,
        yaw: f64,
        now: &Vector3<f64>,
        rolling: &Vector3<f64>,
    ) -> Option<SteadyState> {
        if self.size(now) > LITTLE || !self.all_go_along(rolling) {
            return None;
        }
        let steady = self.find_close(yaw, rolling)?;
        let lengths = self.lengths();
        let change = steady.velocities - now;
        let way = change.component_mul(&lengths);
        let mut time = 0.0;
        for (at, share) in ON_THE_WAY.into_iter().enumerate() {
            let state = self.state_of(yaw, &(now + share * change));
            let drawn = acceleration_of(&self.equations.attempt_to(ROUGHLY, &state)?);
            let drawn = drawn.component_mul(&lengths);
            let along = drawn.dot(&way) / way.norm();
            // Where there is no way, nothing is along it.
            let is_straight = along >= STRAIGHT * drawn.norm();
            if !is_straight {
                return None;
            }
            let next = ON_THE_WAY.get(at + 1).copied().unwrap_or(1.0 - ARRIVED);
            time += (next - share) * way.norm() / along;
        }
        (time <= LONGEST_WAY).then_some(steady)
    }
}
