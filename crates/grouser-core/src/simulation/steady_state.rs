//! Steady states: the velocities at which nothing accelerates.
//!
//! Slip settles within milliseconds, so a rover moves at nearly the velocities V = (u, v, γ'), γ' =
//! dγ/dt, with
//!
//! ```text
//! a(V; γ) = 0          a = (u', v', γ'') of the equations of motion, at the yaw γ
//! ```
//!
//! They are sought by Newton's method with Broyden's updates of the inverse Jacobian, from the
//! steady state last found; from far away by implicit Euler steps that lengthen as the
//! accelerations fade, which go the way that the rover would go. The Jacobian says how fast, and
//! whether, a rover settles on its steady state.

mod following;

use std::cell::Cell;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::equations::{Equations, Evaluation};
use super::turning::Turning;
use crate::contact::slip::CREEP_SPEED;
use crate::newton;
use crate::stored::stored;
use crate::units::Vec2;
use crate::vehicle::kinematics::rolling_motion;
use crate::vehicle::load;
use crate::vehicle::{OnGround, RoverState, WheelReaction};

/// Why a rover's velocities are not those of a steady state, or not known to be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotSteady {
    /// The soil differs from place to place, and so does the steady state.
    #[error("the soil differs from place to place")]
    UnevenSoil,
    /// None was found.
    #[error("no velocities were found at which nothing accelerates")]
    NoSteadyState,
    /// A disturbance of the steady state grows.
    #[error("the balance is unstable: a disturbance grows at {rate:.3} /s")]
    Unstable {
        /// Its rate of growth [1/s].
        rate: f64,
    },
    /// The wheels all but spin on the spot, or are dragged: a little thrust more or less decides
    /// between standing and moving, and getting there takes its time.
    #[error("the wheels all but spin or are dragged: their mean slip ratio is {slip_ratio:.2}")]
    Spinning {
        /// Mean of the wheels' slip ratios [-].
        slip_ratio: f64,
    },
    /// Velocities take so long to settle that it shows.
    #[error("velocities take {settling_time:.2} s to settle")]
    Slow {
        /// Time in which a disturbance fades by e, or in which a rover with other velocities comes
        /// near these [s].
        settling_time: f64,
    },
    /// The steady state moves faster than the velocities can follow.
    #[error(
        "the balance moves too fast: velocities settle within {settling_time:.2e} s and lag behind \
         by {lag:.1e} of the rims' speed"
    )]
    Lags {
        /// Time in which a disturbance fades by e [s].
        settling_time: f64,
        /// How far the velocities lag behind, over the fastest rim's speed [-].
        lag: f64,
    },
}

stored!(enum NotSteady {
    0 => UnevenSoil,
    1 => NoSteadyState,
    2 => Unstable { rate },
    3 => Spinning { slip_ratio },
    4 => Slow { settling_time },
    5 => Lags { settling_time, lag },
});

/// How a rover moved until now, to a motion of one kind.
#[derive(Clone, Copy)]
pub(super) enum Before<C> {
    /// It starts, rolling.
    Nothing,
    /// By a motion of another kind.
    Another,
    /// By one of this kind.
    Steady(C),
}

/// A steady state.
#[derive(Clone, Debug)]
pub(super) struct SteadyState {
    /// Yaw, *γ* [rad].
    pub(super) yaw: f64,
    /// *(u, v, γ')* [m/s, m/s, rad/s], in the body frame.
    pub(super) velocities: Vector3<f64>,
    /// Power of the motors and into the soil [W].
    pub(super) powers: [f64; 3],
    /// The wheels.
    pub(super) wheels: Vec<WheelReaction>,
    /// How they turn, where that is not as they are set to.
    pub(super) turning: Option<Turning>,
}

stored!(struct SteadyState { yaw, velocities, powers, wheels, turning });

/// A steady state, and the time in which a rover comes near it [s].
struct ReachedState {
    steady: SteadyState,
    time: f64,
}

/// Finds steady states, each from the one before.
pub(super) struct SteadySolver<'a, 'g> {
    equations: &'a Equations<'g>,
    /// Speed to measure velocities by: the fastest rim's, or where all stand still that at which
    /// they creep [m/s].
    scale: f64,
    /// Length that makes a yaw rate a speed: the farthest wheel's distance [m].
    reach: f64,
    memory: Memory,
    /// Where the rover is [m], which matters on uneven ground.
    place: Vec2,
}

/// What the last steady state teaches about the next one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Memory {
    /// Speed that velocities were measured by [m/s].
    scale: f64,
    /// Inverse Jacobian, (∂a/∂V)⁻¹ [s].
    inverse: Option<Matrix3<f64>>,
    /// The same of the motors' balances, too, and how the wheels turned.
    with_motors: Option<(DMatrix<f64>, Turning)>,
    /// Where stability was last looked at, and the settling time there [s].
    checked: Option<(f64, Vector3<f64>, f64)>,
    /// How velocities changed with those of rolling wheels, the yaw rate as a speed [-].
    response: Option<Matrix3<f64>>,
    /// How velocities change with the yaw, over the fastest rim's speed [1/rad].
    per_yaw: Vector3<f64>,
}

stored!(struct Memory { scale, inverse, with_motors, checked, response, per_yaw });

impl Memory {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        self.with_motors.as_ref().is_none_or(|(inverse, turning)| {
            inverse.shape() == (3 + count, 3 + count) && turning.rim_speeds().len() == count
        })
    }
}

/// From velocities this near to those of the steady state one more step leads to it, unlooked at,
/// over the fastest rim's speed [-]: velocities are found to some 3e-7, while forces and powers are
/// those of slip ratios that are off by so much, within 1e-4 of their size. Source: ours, a tenth of
/// what parabolas through steady states may miss.
pub(super) const CLOSE: f64 = 1e-6;
/// What forces may miss where a step of a search leads, over the square of the step's size over the
/// fastest rim's speed [-]: the next step is longer than that. Source: measured; steps of a rover
/// whose speeds change at random by 30 % take as many evaluations.
const MISSED_OF_STEP: f64 = 0.1;
/// What forces that are taken for those of the steady state miss at the most where they are smooth
/// [-].
const MOST_MISSED: f64 = 1e-8;
/// Steps longer than this leave the neighbourhood in which a tangent tells anything, over the
/// fastest rim's speed [-].
const LONGEST: f64 = 0.5;
/// From a guess whose step is longer than this a Jacobian found there leads on faster than the one
/// that is remembered, over the fastest rim's speed [-]. Source: measured; between 0.01 and 0.03
/// evaluations of random commands of the left and the right are as many, without it a tenth more.
/// Where each wheel has a random speed of its own they are as many with it, a fifth of them
/// differences.
const FAR: f64 = 0.02;
/// Step of differences over the fastest rim's speed [-]: forces are exact to 1e-12.
const STEP: f64 = 1e-6;

/// Wheels that slip more than this on the mean all but spin [-]. Source: ours; the thrust of sand
/// has then long stopped growing with slip.
pub const MOST_SLIP: f64 = 0.9;
/// Velocities that take longer to settle are no fast motion [s]. Source: ours, a control period:
/// what happens meanwhile would be missed by drives and samples. (On Earth they take milliseconds,
/// in the Moon's gravity half of this.)
pub const LONGEST_SETTLING: f64 = 0.1;

/// A run whose velocities take longer to come near their steady state is no steady motion meanwhile
/// [s]. Source: ours; in four settling times a disturbance fades to a fiftieth.
const LONGEST_WAY: f64 = 4.0 * LONGEST_SETTLING;

/// Rims that turn faster by such a factor move the rover alike [-]. Source: ours; at most as a
/// guess.
const SIMILAR: std::ops::RangeInclusive<f64> = 0.2..=5.0;
/// Rims turn much the same as before where the velocities of rolling wheels change by no more than
/// this, but for a common factor, over the fastest rim's speed [-]. Source: ours; a slip ratio of 1
/// is twice as far.
const MUCH_THE_SAME: f64 = 0.5;
/// Steps of a start, whose accelerations stay, become longer by this at the most [-].
const MOST_LONGER: f64 = 3.0;

impl<'a, 'g> SteadySolver<'a, 'g> {
    pub(super) fn new(equations: &'a Equations<'g>, memory: Memory) -> Self {
        let fastest = equations.rim_speeds().iter().fold(0.0, |most: f64, rim| most.max(rim.abs()));
        let arms = equations.rover().load_arms();
        let reach = arms.iter().map(Vec2::norm).fold(0.0, f64::max);
        let scale = fastest.max(CREEP_SPEED);
        // What a rover at rest teaches says nothing of one that moves.
        let is_similar = SIMILAR.contains(&(scale / memory.scale));
        let memory = if is_similar { memory } else { Memory::default() };
        let memory = Memory { scale, ..memory };
        Self { equations, scale, reach, memory, place: Vec2::zeros() }
    }

    /// Sets the place [m] at which steady states are sought from now on.
    pub(super) fn go_to(&mut self, place: Vec2) {
        self.place = place;
    }

    /// The state of a rover where they are sought.
    pub(super) fn state_of(&self, yaw: f64, velocities: &Vector3<f64>) -> RoverState {
        let velocity = Vec2::new(velocities.x, velocities.y);
        RoverState { position: self.place, yaw, velocity, yaw_rate: velocities.z }
    }

    /// The fastest that a hub or a rim moves, about [m/s].
    pub(super) fn speed(&self, velocities: &Vector3<f64>) -> f64 {
        self.scale * self.size(velocities).max(1e-3)
    }

    /// What to begin the next search with.
    pub(super) fn memory(&self) -> Memory {
        self.memory.clone()
    }

    /// Adapts the memory to rims that all turn faster by a factor: accelerations, which depend on
    /// ratios of speeds, change as much slower.
    fn scale_memory(&mut self, faster: f64) {
        if let Some(inverse) = &mut self.memory.inverse {
            *inverse *= faster;
        }
    }

    /// How velocities are expected to change with the yaw [m/s/rad, m/s/rad, 1/s]; nothing where no
    /// stretch was seen.
    pub(super) fn per_yaw(&self) -> Vector3<f64> {
        self.memory.per_yaw * self.scale
    }

    /// Remembers how they changed.
    pub(super) fn remember_per_yaw(&mut self, per_yaw: Vector3<f64>) {
        self.memory.per_yaw = per_yaw / self.scale;
    }

    /// Velocities with the yaw rate as a speed are these times those.
    fn lengths(&self) -> Vector3<f64> {
        Vector3::new(1.0, 1.0, self.reach)
    }

    /// How velocities are expected to change with those of rolling wheels: as they did before, or
    /// else as much.
    fn response_to(&self, change: &Vector3<f64>) -> Vector3<f64> {
        let lengths = self.lengths();
        self.memory.response.map_or(*change, |response| {
            (response * change.component_mul(&lengths)).component_div(&lengths)
        })
    }

    /// Learns from a change of rolling wheels how velocities change with it: the response nearest to
    /// the known one that explains it (Broyden 1965), of little changes a part. One that misses more
    /// than the change is forgotten.
    ///
    /// * `missed`: by how much the expected velocities were short of those found
    fn learn_response(&mut self, change: &Vector3<f64>, missed: &Vector3<f64>) {
        /// A change of this size is learnt by half, over the fastest rim's speed [-].
        const LITTLE: f64 = 0.01;
        let change = change.component_mul(&self.lengths());
        let missed = missed.component_mul(&self.lengths());
        let least = LITTLE * self.scale;
        let known = self.memory.response.unwrap_or_else(Matrix3::identity);
        let learnt = known + missed * change.transpose() / (change.norm_squared() + least * least);
        self.memory.response = (missed.norm() <= change.norm().max(least)).then_some(learnt);
    }

    /// Whether the ground is level.
    pub(super) fn is_level(&self) -> bool {
        let OnGround { rover, ground, gravity, .. } = *self.equations.on_ground();
        load::slope_pull(rover, ground, gravity, &RoverState::default()) == Vec2::zeros()
    }

    /// Size of velocities over the fastest rim's [-].
    pub(super) fn size(&self, velocities: &Vector3<f64>) -> f64 {
        let [u, v, rate] = [velocities.x, velocities.y, velocities.z];
        u.abs().max(v.abs()).max((rate * self.reach).abs()) / self.scale
    }

    /// The steady state at a yaw, sought from velocities near enough for Newton's steps; that of motors
    /// that droop from any, as ever.
    pub(super) fn find_near(
        &mut self,
        yaw: f64,
        guess: &Vector3<f64>,
    ) -> Result<SteadyState, NotSteady> {
        let found = if self.has_no_measure() {
            None
        } else if self.equations.droops() {
            self.find_turning(yaw, guess)
        } else {
            self.find_close(yaw, guess)
        };
        found.ok_or(NotSteady::NoSteadyState)
    }

    /// Whether the rover has no speed to measure by: at rest, and turned, or with motors that roll
    /// back.
    fn has_no_measure(&self) -> bool {
        self.is_at_rest() && (self.equations.is_held() || self.equations.droops())
    }

    /// The same, from velocities that may be farther off: then what the rover comes to from there.
    pub(super) fn find(
        &mut self,
        yaw: f64,
        guess: &Vector3<f64>,
    ) -> Result<SteadyState, NotSteady> {
        let found = self.find_near(yaw, guess);
        if found.is_ok() || self.equations.droops() || self.has_no_measure() {
            return found;
        }
        self.settle(yaw, guess, 0.0).map(|it| it.steady).ok_or(NotSteady::NoSteadyState)
    }

    /// The steady state with which a motion begins, or goes on after a change of the rims' speeds.
    ///
    /// Where a rover can move in more than one way, as in a turn on the spot on a slope, how it
    /// moved decides which it comes to: where the rims turn much the same as before, its velocities
    /// change with theirs as they last did, and so where all wheels go on the same way; elsewhere it is
    /// followed from its velocities.
    ///
    /// * `now`: its velocities
    /// * `before`: how it moved, with the velocities with which the rims rolled
    pub(super) fn find_after(
        &mut self,
        yaw: f64,
        now: &Vector3<f64>,
        before: Before<Vector3<f64>>,
    ) -> Result<SteadyState, NotSteady> {
        let rolling = rolling(self.equations);
        if self.is_at_rest() || matches!(before, Before::Nothing) {
            return self.find(yaw, &rolling);
        }
        if let Before::Steady(rolled) = before {
            // Motion depends on ratios of speeds alone: of rims that all turn faster, everything is
            // faster.
            let faster = rolling.xy().dot(&rolled.xy()) / rolled.xy().norm_squared();
            let faster = if SIMILAR.contains(&faster) { faster } else { 1.0 };
            let change = rolling - faster * rolled;
            let is_much_the_same = self.size(&change) <= MUCH_THE_SAME;
            if is_much_the_same || self.goes_on(&rolled, &rolling) {
                self.scale_memory(faster);
                let guess = faster * now + self.response_to(&change);
                let found = if is_much_the_same {
                    Some(self.find(yaw, &guess)?)
                } else {
                    self.find_close(yaw, &guess)
                };
                if let Some(steady) = found {
                    self.learn_response(&change, &(steady.velocities - guess));
                    return Ok(steady);
                }
            }
        }
        // What other motions did with the yaw or with their rims tells nothing of this one.
        (self.memory.response, self.memory.per_yaw) = (None, Vector3::zeros());
        if self.equations.droops() {
            // Motors that droop turn the rims in their own time.
            return self.find(yaw, &rolling);
        }
        if let Some(steady) = self.straight(yaw, now, &rolling) {
            return Ok(steady);
        }
        let ReachedState { steady, time } =
            self.settle(yaw, now, MOST_LONGER).ok_or(NotSteady::NoSteadyState)?;
        if time > LONGEST_WAY { Err(NotSteady::Slow { settling_time: time }) } else { Ok(steady) }
    }

    /// Whether all wheels turn one way now, and all hubs of rolling wheels move this way along the body
    /// as they did before, without much of a change across it. Motors that droop have speeds of their
    /// own.
    fn goes_on(&self, before: &Vector3<f64>, now: &Vector3<f64>) -> bool {
        !self.equations.droops()
            && self.all_go_along(now)
            && self.hubs_go_along(before)
            && before.x * now.x > 0.0
            && (now.y - before.y).abs() <= MUCH_THE_SAME * self.scale
    }

    /// Whether all wheels turn one way, and all hubs of rolling wheels move this way along the body.
    fn all_go_along(&self, rolling: &Vector3<f64>) -> bool {
        self.equations.rim_speeds().iter().all(|rim| rim * rolling.x > 0.0)
            && self.hubs_go_along(rolling)
    }

    /// Whether all hubs move one way along the body.
    fn hubs_go_along(&self, velocities: &Vector3<f64>) -> bool {
        let arms = self.equations.rover().load_arms();
        let side = arms.iter().map(|arm| arm.y.abs()).fold(0.0, f64::max);
        (velocities.z * side).abs() < velocities.x.abs()
    }

    /// Whether no wheel is to turn.
    fn is_at_rest(&self) -> bool {
        self.scale <= CREEP_SPEED
    }

    /// The same of wheels that turn as they are set to, by Newton's steps alone.
    pub(super) fn find_close(&mut self, yaw: f64, guess: &Vector3<f64>) -> Option<SteadyState> {
        let mut here = self.evaluate(yaw, guess)?;
        if let Some(inverse) = self.memory.inverse
            && self.size(&(inverse * acceleration_of(&here))) <= FAR
        {
            if let Some(steady) = self.correct_from(yaw, guess, here, inverse, LONGEST) {
                return Some(steady);
            }
            here = self.evaluate(yaw, guess)?;
        }
        let inverse = self.jacobian(yaw, guess, &here, None)?.try_inverse()?;
        self.correct_from(yaw, guess, here, inverse, LONGEST)
    }

    /// The steady state nearest to a guess where the motion was looked at already.
    ///
    /// * `longest`: step over the fastest rim's speed [-]
    fn correct_from(
        &mut self,
        yaw: f64,
        guess: &Vector3<f64>,
        here: Evaluation,
        inverse: Matrix3<f64>,
        longest: f64,
    ) -> Option<SteadyState> {
        let missed = Cell::new(0.0);
        let zero = newton::zero_from(
            |velocities, way| {
                missed.set(MISSED_OF_STEP * way * way);
                let state = self.state_of(yaw, velocities);
                let here = self.equations.attempt_to(missed.get(), &state)?;
                Some((acceleration_of(&here), here))
            },
            (*guess, (acceleration_of(&here), here)),
            inverse,
            |step| self.size(step),
            longest,
            |_, step| self.size(step) <= CLOSE && missed.get() <= MOST_MISSED,
        )?;
        self.memory.inverse = Some(zero.inverse);
        Some(steady_state_at(yaw, zero.at + zero.left, zero.value, None))
    }

    /// The steady state of wheels whose speeds depend on their loads: their speeds are sought with
    /// the velocities.
    fn find_turning(&mut self, yaw: f64, guess: &Vector3<f64>) -> Option<SteadyState> {
        let known = self.memory.with_motors.take();
        let set = Turning::at(self.equations.rim_speeds());
        let turning = known.as_ref().map_or(set, |(_, turning)| *turning);
        let near = joined(guess, turning.rim_speeds());
        if let Some((inverse, _)) = known
            && let Some(steady) = self.correct_turning(yaw, &near, inverse)
        {
            return Some(steady);
        }
        if let Some(steady) = self.find_turning_anew(yaw, &near) {
            return Some(steady);
        }
        // From where motors would lead that hold their speeds.
        let held = self.settle(yaw, guess, 0.0)?.steady;
        self.find_turning_anew(yaw, &joined(&held.velocities, set.rim_speeds()))
    }

    fn find_turning_anew(&mut self, yaw: f64, near: &DVector<f64>) -> Option<SteadyState> {
        let inverse = self.jacobian_turning(yaw, near)?.try_inverse()?;
        self.correct_turning(yaw, near, inverse)
    }

    /// The steady state nearest to the guess, and how the wheels turn in it.
    fn correct_turning(
        &mut self,
        yaw: f64,
        guess: &DVector<f64>,
        inverse: DMatrix<f64>,
    ) -> Option<SteadyState> {
        let size = |step: &DVector<f64>| {
            let rims = step.rows(3, step.len() - 3).amax() / self.scale;
            self.size(&step.fixed_rows::<3>(0).into()).max(rims)
        };
        let zero = newton::zero_near(
            |unknown| self.imbalance(yaw, unknown),
            guess,
            inverse,
            size,
            LONGEST,
            |_, step| size(step) <= CLOSE,
        )?;
        let (velocities, rim_speeds) = parted(&(zero.at + zero.left));
        let turning = self.turning_at(&rim_speeds, &zero.value);
        self.memory.with_motors = Some((zero.inverse, turning));
        Some(steady_state_at(yaw, velocities, zero.value, Some(turning)))
    }

    /// Accelerations, and how far each rim is from the speed at which its motor turns it under the
    /// soil's torque [m/s].
    fn imbalance(&self, yaw: f64, unknown: &DVector<f64>) -> Option<(DVector<f64>, Evaluation)> {
        let (velocities, rim_speeds) = parted(unknown);
        let here = self.equations.attempt_at(&self.state_of(yaw, &velocities), &rim_speeds)?;
        let turned = rim_speeds.iter().zip(&here.wheels).enumerate();
        let off: Vec<f64> = turned
            .map(|(wheel, (rim, it))| rim - self.equations.rim_speed_under(wheel, it))
            .collect();
        Some((joined(&acceleration_of(&here), &off), here))
    }

    fn jacobian_turning(&self, yaw: f64, near: &DVector<f64>) -> Option<DMatrix<f64>> {
        self.equations.count(|work| work.jacobians += 1);
        let (here, _) = self.imbalance(yaw, near)?;
        let mut jacobian = DMatrix::zeros(near.len(), near.len());
        for axis in 0..near.len() {
            let size = if axis == 2 { self.scale / self.reach } else { self.scale };
            let mut beside = near.clone();
            beside[axis] += STEP * size;
            let (there, _) = self.imbalance(yaw, &beside)?;
            jacobian.set_column(axis, &((there - &here) / (STEP * size)));
        }
        Some(jacobian)
    }

    /// Wheels at these rim speeds [m/s], with controllers whose integrals have settled.
    fn turning_at(&self, rim_speeds: &[f64], here: &Evaluation) -> Turning {
        let mut turning = Turning::at(rim_speeds);
        for (wheel, reaction) in here.wheels.iter().enumerate() {
            let integral = self.equations.settled_integral(wheel, rim_speeds[wheel], reaction);
            turning.set(wheel, rim_speeds[wheel], integral);
        }
        turning
    }

    /// Checks that a rover settles on the steady state; returns the time in which it does [s]. The
    /// last answer holds in its neighbourhood; farther off the inverse that a search leaves says as
    /// much, where neither of them is near the limits.
    pub(super) fn settling_time(&mut self, steady: &SteadyState) -> Result<f64, NotSteady> {
        /// How far the neighbourhood is [rad], and over the fastest rim's speed [-].
        const NEAR_YAW: f64 = 0.2;
        const NEAR_VELOCITIES: f64 = 0.05;
        /// And how far it is that the inverse is asked [-].
        const FAR_VELOCITIES: f64 = 0.5;
        /// Rovers that settle within this surely settle in time [s].
        const SURELY: f64 = 0.25 * LONGEST_SETTLING;
        let slips = steady.wheels.iter().map(|wheel| wheel.slip.ratio);
        let slip_ratio = slips.sum::<f64>() / steady.wheels.len() as f64;
        // Wheels that stand still hold the rover, and wheels that turn against each other do.
        if slip_ratio.abs() > MOST_SLIP && !self.is_at_rest() {
            return Err(NotSteady::Spinning { slip_ratio });
        }
        if let Some((yaw, velocities, time)) = self.memory.checked
            && (yaw - steady.yaw).abs() < NEAR_YAW
        {
            let far = self.size(&(velocities - steady.velocities));
            if far < NEAR_VELOCITIES {
                return Ok(time);
            }
            let by_inverse = || self.memory.inverse?.try_inverse().and_then(|it| time_of(&it).ok());
            // A search of motors that droop keeps another inverse.
            if steady.turning.is_none()
                && far < FAR_VELOCITIES
                && time <= SURELY
                && let Some(time) = by_inverse().filter(|time| *time <= SURELY)
            {
                return Ok(time);
            }
        }
        let jacobian = self.jacobian_of(steady).ok_or(NotSteady::NoSteadyState)?;
        self.memory.inverse = jacobian.try_inverse();
        let time = time_of(&jacobian)?;
        self.memory.checked = Some((steady.yaw, steady.velocities, time));
        Ok(time)
    }

    /// ∂a/∂V at a steady state whose wheels keep their speeds.
    fn jacobian_of(&self, steady: &SteadyState) -> Option<Matrix3<f64>> {
        let (yaw, velocities) = (steady.yaw, &steady.velocities);
        let rims = steady.turning.as_ref().map(Turning::rim_speeds);
        let here = self.evaluate_at(yaw, velocities, rims)?;
        self.jacobian(yaw, velocities, &here, rims)
    }

    fn evaluate(&self, yaw: f64, velocities: &Vector3<f64>) -> Option<Evaluation> {
        self.evaluate_at(yaw, velocities, None)
    }

    /// * `rims`: speeds at which they turn [m/s], if not as they are set to
    fn evaluate_at(
        &self,
        yaw: f64,
        velocities: &Vector3<f64>,
        rims: Option<&[f64]>,
    ) -> Option<Evaluation> {
        let state = self.state_of(yaw, velocities);
        match rims {
            None => self.equations.attempt(&state),
            Some(rims) => self.equations.attempt_at(&state, rims),
        }
    }

    /// ∂a/∂V, by forward differences.
    ///
    /// * `here`: there, the last evaluation
    fn jacobian(
        &self,
        yaw: f64,
        velocities: &Vector3<f64>,
        here: &Evaluation,
        rims: Option<&[f64]>,
    ) -> Option<Matrix3<f64>> {
        self.equations.count(|work| work.jacobians += 1);
        let steps = [self.scale, self.scale, self.scale / self.reach].map(|size| STEP * size);
        let mut jacobian = Matrix3::zeros();
        for (axis, step) in steps.into_iter().enumerate() {
            let mut beside = *velocities;
            beside[axis] += step;
            let there = match rims {
                None => self.equations.attempt_beside(&self.state_of(yaw, &beside))?,
                Some(_) => self.evaluate_at(yaw, &beside, rims)?,
            };
            let change = acceleration_of(&there) - acceleration_of(here);
            jacobian.set_column(axis, &(change / step));
        }
        Some(jacobian)
    }
}

/// The time in which disturbances of a steady state with this Jacobian fade by e [s].
fn time_of(jacobian: &Matrix3<f64>) -> Result<f64, NotSteady> {
    let rates = jacobian.complex_eigenvalues();
    let slowest = rates.iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
    if slowest >= 0.0 || slowest.is_infinite() {
        return Err(NotSteady::Unstable { rate: slowest });
    }
    let settling_time = -1.0 / slowest;
    if settling_time > LONGEST_SETTLING {
        return Err(NotSteady::Slow { settling_time });
    }
    Ok(settling_time)
}

/// Velocities of a rover that follows its rims as well as a rigid body can, at a light slip.
pub(super) fn rolling(equations: &Equations<'_>) -> Vector3<f64> {
    let (velocity, rate) = rolling_motion(equations.rover().mounts(), equations.rim_speeds());
    super::scenario::ROLLING_SHARE * Vector3::new(velocity.x, velocity.y, rate)
}

fn acceleration_of(evaluation: &Evaluation) -> Vector3<f64> {
    let acceleration = &evaluation.rates.acceleration;
    let rate = acceleration.velocity_rate;
    Vector3::new(rate.x, rate.y, acceleration.yaw_acceleration)
}

/// Velocities and the wheels' numbers in one list.
fn joined(velocities: &Vector3<f64>, of_wheels: &[f64]) -> DVector<f64> {
    DVector::from_iterator(3 + of_wheels.len(), velocities.iter().chain(of_wheels).copied())
}

/// Such a list apart again.
fn parted(all: &DVector<f64>) -> (Vector3<f64>, Vec<f64>) {
    (all.fixed_rows::<3>(0).into(), all.rows(3, all.len() - 3).iter().copied().collect())
}

fn steady_state_at(
    yaw: f64,
    velocities: Vector3<f64>,
    evaluation: Evaluation,
    turning: Option<Turning>,
) -> SteadyState {
    let Evaluation { rates, wheels } = evaluation;
    let powers = [rates.motor_power, rates.soil_power, rates.electrical_power];
    SteadyState { yaw, velocities, powers, wheels, turning }
}
