//! The soil's reaction over a time step of another engine, such that its steps stay stable.
//!
//! An engine of rigid bodies holds forces constant over a step Δt. The soil's change steeply with
//! velocities: by their whole size within the rim's speed, and for wheels at rest, where they are
//! those of dry friction, within next to nothing. Taken at the start of a step they would
//! overshoot, so they are taken at its end (backward Euler), where the unknown is the wheels'
//! motion *u*:
//!
//! ```text
//! u = u° + Δt A f(u)                    u = (v_x, v_y, v_z, ω r_s) of every wheel
//!                                       f = (F_x, F_y, F_z, −T/r_s, M_x, M_z) of every wheel
//! h = h° − Δt v_z
//! f = (1 − c v_z) f_theory(h, u)        never less than none
//! ```
//!
//! *u°* is the motion at the end of the step without the soil, *h°* the sinkage at its start. The
//! effective inverse mass *A* (Delassus matrix) [1/kg] says how forces change velocities: of a
//! mechanism with Jacobians J_u, J_f and inertia M it is J_u M⁻¹ J_fᵀ. As Δt shrinks the reaction
//! becomes the model's own; what a finite Δt adds is backward Euler's damping, of the order of Δt.
//!
//! The models have no damping of their own, and without any a wheel would bounce on the soil as on
//! a spring. The *sinkage damping* c lets all stresses grow with the rate of sinking, as in Hunt
//! and Crossley (1975): there is no force without sinkage, no pull on a wheel that leaves, and no
//! effect at rest.

use nalgebra::{DMatrix, DVector, Dyn, LU, SMatrix, SVector};

use super::discrepancy;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::model::WheelSoilModel;
use super::slip::{CREEP_SPEED, Slip};
use crate::elementary::wide;
use crate::soil::Soil;
use crate::units::Vec2;
use crate::wheel::Wheel;

/// Velocities of a wheel: v_x, v_y, v_z of the hub and ω r_s, in the wheel frame [m/s].
pub const MOTIONS: usize = 4;
/// Forces on a wheel: F_x, F_y, F_z, −T/r_s [N], M_x, M_z [N·m].
pub const FORCES: usize = 6;

/// Default of the sinkage damping, *c* [s/m]. Source: assumed; for a wheel that a soil with
/// F_z ~ h^2.2 carries at h = 15 mm on the Earth it is 0.65 of critical damping, and it adds 1 % to
/// the forces of one that sinks at 2 mm/s.
pub const SINKAGE_DAMPING: f64 = 5.0;

/// Default of the rest speed [m/s]. Source: assumed; a thousandth of a rover's speed.
pub const REST_SPEED: f64 = 1e-4;

/// A wheel at the start of a step.
#[derive(Clone, Copy)]
pub struct SteppingWheel<'a> {
    /// The wheel–soil model.
    pub model: &'a dyn WheelSoilModel,
    /// The wheel.
    pub wheel: Wheel,
    /// The soil under it.
    pub soil: Soil,
    /// Sinkage, *h°* [m]; negative above the ground.
    pub sinkage: f64,
}

/// What decides the reaction of the soil over a step.
///
/// Which force does the soil put on a locked wheel of 1.7 kg that is dragged along at 5 cm/s, over
/// a step of 2 ms?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::time_step::{FORCES, MOTIONS, REST_SPEED, SINKAGE_DAMPING};
/// use grouser_core::contact::{Ishigami, SteppingWheel, TimeStep};
/// use grouser_core::units::mm;
/// use nalgebra::{DMatrix, DVector};
///
/// let (duration, gravity, mass) = (2e-3, 9.81, 1.7);
/// // Forces move the hub along x, y and z; a locked rim has no motion of its own.
/// let inverse_mass = DMatrix::from_fn(MOTIONS, FORCES, |motion, force| {
///     if motion == force && motion < 3 { 1.0 / mass } else { 0.0 }
/// });
/// let free = DVector::from_vec(vec![0.05, 0.0, -gravity * duration, 0.0]);
/// let (damping, rest_speed) = (SINKAGE_DAMPING, REST_SPEED);
/// let step =
///     TimeStep { duration, gravity, damping, rest_speed, inverse_mass: &inverse_mass, free: &free };
/// let (wheel, soil) = (paper::hakuto_wheel(), paper::toyoura());
/// let wheel = SteppingWheel { model: &Ishigami::DEFAULT, wheel, soil, sinkage: mm(20.0) };
/// let stepped = step.reaction(&[wheel]);
/// let forces = stepped.wheels[0].forces;
/// assert_eq!(format!("{:.1} N along the wheel", forces.drawbar_pull), "-27.3 N along the wheel");
/// assert_eq!(format!("{:.1} N upward", forces.normal_force), "26.1 N upward");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TimeStep<'a> {
    /// Its length, *Δt* [s].
    pub duration: f64,
    /// Gravity [m/s²]; it gives the soil its weight.
    pub gravity: f64,
    /// Sinkage damping, *c* [s/m].
    pub damping: f64,
    /// Below this speed [m/s] of rim and hub the stresses fade to none, in place of
    /// [`CREEP_SPEED`].
    pub rest_speed: f64,
    /// Effective inverse mass (Delassus matrix), *A* [1/kg, 1/(kg·m)]: a row for each velocity, a
    /// column for each force.
    pub inverse_mass: &'a DMatrix<f64>,
    /// Velocities at the end of the step without the soil, *u°* [m/s].
    pub free: &'a DVector<f64>,
}

/// A wheel at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppedWheel {
    /// Sinkage, *h* [m], 0 to r_s.
    pub sinkage: f64,
    /// Slip there.
    pub slip: Slip,
    /// The reaction that acts over the step.
    pub forces: WheelForces,
}

/// The reaction over a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped {
    /// The wheels, in their order.
    pub wheels: Vec<SteppedWheel>,
    /// What is left of *u − u° − Δt A f* [m/s], its largest part.
    pub residual: f64,
    /// How many rounds of Newton's method it took.
    pub rounds: u32,
}

/// Velocities agree to this share of the rest speed [-]: forces then do to 1e-6.
const AGREED: f64 = 1e-6;

/// Derivatives of the residual, ready to solve with.
type Factors = LU<f64, Dyn, Dyn>;

/// The reaction, as far as the search knows it.
struct Try {
    motion: DVector<f64>,
    wheels: Vec<SteppedWheel>,
    residual: DVector<f64>,
}

impl TimeStep<'_> {
    /// The reaction of the soil on wheels that a mechanism couples.
    ///
    /// Wheels deeper than the axle have the forces of axle depth.
    #[must_use]
    pub fn reaction(&self, wheels: &[SteppingWheel<'_>]) -> Stepped {
        self.reaction_near(wheels, self.free)
    }

    /// The [`reaction`](Self::reaction), sought from a motion near the one at the end of the step,
    /// which saves most of the search: such as the one that the forces of the step before lead to.
    /// Where that search does not end, one from the motion without the soil follows.
    ///
    /// Newton's method, with the model's derivatives by differences, kept while they lead on, and
    /// steps that are halved until they lead nearer. Where none does, the nearest is taken, and
    /// `residual` says how near that is.
    ///
    /// * `motion`: of the wheels [m/s], as long as [`free`](Self::free)
    #[must_use]
    pub fn reaction_near(&self, wheels: &[SteppingWheel<'_>], motion: &DVector<f64>) -> Stepped {
        let near = self.sought(wheels, motion);
        if near.residual <= AGREED * self.rest_speed || motion == self.free {
            return near;
        }
        let anew = self.sought(wheels, self.free);
        let rounds = near.rounds + anew.rounds;
        let nearer = if anew.residual < near.residual { anew } else { near };
        Stepped { rounds, ..nearer }
    }

    fn sought(&self, wheels: &[SteppingWheel<'_>], motion: &DVector<f64>) -> Stepped {
        const MOST_ROUNDS: u32 = 40;
        let mut best = self.attempt(wheels, motion.clone());
        let mut derivatives = None;
        let mut rounds = 0;
        while best.residual.amax() > AGREED * self.rest_speed && rounds < MOST_ROUNDS {
            rounds += 1;
            if let Some(kept) = &derivatives
                && let Some(next) = self.kept_step(wheels, &best, kept)
            {
                best = next;
                continue;
            }
            let fresh = self.jacobian(wheels, &best).lu();
            let Some(next) = self.halved_step(wheels, &best, &fresh) else { break };
            best = next;
            derivatives = Some(fresh);
        }
        Stepped { wheels: best.wheels, residual: best.residual.amax(), rounds }
    }

    /// A step by derivatives from further away; nothing where it leaves more than a quarter.
    fn kept_step(
        &self,
        wheels: &[SteppingWheel<'_>],
        best: &Try,
        derivatives: &Factors,
    ) -> Option<Try> {
        /// Rounds by derivatives that are there cost a fifth of the others.
        const MOST_LEFT: f64 = 0.25;
        let next = self.attempt(wheels, &best.motion - derivatives.solve(&best.residual)?);
        (next.residual.norm() < MOST_LEFT * best.residual.norm()).then_some(next)
    }

    /// A step, halved until it leads nearer; nothing where none does.
    fn halved_step(
        &self,
        wheels: &[SteppingWheel<'_>],
        best: &Try,
        derivatives: &Factors,
    ) -> Option<Try> {
        const MOST_HALVINGS: i32 = 20;
        let step = derivatives.solve(&best.residual)?;
        let shorter = |halvings| &best.motion - &step * wide::powi(0.5, halvings);
        (0..MOST_HALVINGS)
            .map(|halvings| self.attempt(wheels, shorter(halvings)))
            .find(|next| next.residual.norm() < best.residual.norm())
    }

    fn attempt(&self, wheels: &[SteppingWheel<'_>], motion: DVector<f64>) -> Try {
        let stepped = wheels.iter().enumerate().map(|(k, wheel)| {
            self.stepped(wheel, &motion.fixed_rows::<MOTIONS>(MOTIONS * k).into_owned())
        });
        let stepped: Vec<SteppedWheel> = stepped.collect();
        let mut forces = DVector::zeros(FORCES * wheels.len());
        for (k, (wheel, after)) in wheels.iter().zip(&stepped).enumerate() {
            forces.fixed_rows_mut::<FORCES>(FORCES * k).copy_from(&wrench(&wheel.wheel, after));
        }
        let residual = &motion - self.free - self.inverse_mass * forces * self.duration;
        Try { motion, wheels: stepped, residual }
    }

    /// One wheel with a motion *u* at the end of the step.
    fn stepped(&self, of: &SteppingWheel<'_>, u: &SVector<f64, MOTIONS>) -> SteppedWheel {
        let SteppingWheel { model, wheel, soil, .. } = *of;
        let [v_x, v_y, v_z, rim_speed] = u.data.0[0];
        let sinkage = (of.sinkage - self.duration * v_z).clamp(0.0, wheel.shearing_radius());
        // The models know ratios of speeds alone: in another measure of speed, another is rest.
        let measure = CREEP_SPEED / self.rest_speed;
        let slip = Slip::of_motion(rim_speed * measure, Vec2::new(v_x, v_y) * measure);
        let contact = Contact { wheel, soil, slip, gravity: self.gravity };
        let growth = (1.0 - self.damping * v_z).max(0.0);
        let forces = discrepancy::corrected(&contact, model.forces(&contact, sinkage));
        SteppedWheel { sinkage, slip, forces: forces * growth }
    }

    /// Derivatives of the residual by the motion: I − Δt A ∂f/∂u.
    fn jacobian(&self, wheels: &[SteppingWheel<'_>], here: &Try) -> DMatrix<f64> {
        let mut jacobian = DMatrix::identity(here.motion.len(), here.motion.len());
        for (k, wheel) in wheels.iter().enumerate() {
            if here.wheels[k].sinkage <= 0.0 {
                continue;
            }
            let slopes = self.slopes(wheel, &here.wheels[k], &here.motion, MOTIONS * k);
            let columns = self.inverse_mass.fixed_columns::<FORCES>(FORCES * k) * slopes;
            let mut block = jacobian.fixed_columns_mut::<MOTIONS>(MOTIONS * k);
            block -= columns * self.duration;
        }
        jacobian
    }

    /// ∂f/∂u of one wheel.
    fn slopes(
        &self,
        wheel: &SteppingWheel<'_>,
        here: &SteppedWheel,
        motion: &DVector<f64>,
        first: usize,
    ) -> SMatrix<f64, FORCES, MOTIONS> {
        /// Difference in velocity: a share of the rest speed, and of the velocity [-].
        const SHARES: (f64, f64) = (1e-3, 1e-6);
        let u: SVector<f64, MOTIONS> = motion.fixed_rows::<MOTIONS>(first).into_owned();
        let before = wrench(&wheel.wheel, here);
        SMatrix::from_columns(&[0, 1, 2, 3].map(|axis: usize| {
            let mut moved = u;
            moved[axis] += SHARES.0 * self.rest_speed + SHARES.1 * u[axis].abs();
            let after = wrench(&wheel.wheel, &self.stepped(wheel, &moved));
            (after - before) / (moved[axis] - u[axis])
        }))
    }
}

/// Forces as the effective inverse mass takes them.
fn wrench(wheel: &Wheel, stepped: &SteppedWheel) -> SVector<f64, FORCES> {
    let f = &stepped.forces;
    let rim_force = -f.torque / wheel.shearing_radius();
    let (moment_x, moment_z) = (f.overturning_moment, f.aligning_moment);
    [f.drawbar_pull, f.side_force, f.normal_force, rim_force, moment_x, moment_z].into()
}
