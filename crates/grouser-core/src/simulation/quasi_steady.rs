//! Quasi-steady motion: steady velocities at every instant, the pose alone integrated.
//!
//! On a plane with steady commands nothing but the yaw γ decides the steady state: velocities V(γ),
//! powers and wheels are functions of one variable. With a dash for the rate of change, γ' = dγ/dt,
//!
//! ```text
//! γ' = r(γ)        (x', y') = R(γ) (u, v)(γ)        E' = P(γ)
//! ```
//!
//! They are tabulated over the stretch of yaw ahead, as polynomials through steady states found
//! there, and the pose follows from the table. So the work goes with the yaw that a rover turns
//! through, not with the way it drives: one that keeps its yaw costs two steady states, however far
//! it goes.
//!
//! A command begins with a stretch as long as the steady one before it lasted, the first with a
//! short one, and each is longer than the one before it. Neither the stretches nor the steps of the
//! pose depend on when somebody looks: a look within a step takes a part of it, and the step goes
//! on from its start. So a motion that stays steady has the same bits however it is cut into
//! advances.

use nalgebra::Vector3;

use super::equations::Equations;
use super::point::Point;
use super::steady_state::{Before, Memory, NotSteady, SteadySolver, SteadyState, rolling};
use super::times::multiple_after;
use super::turning::Turning;
use super::watch::WATCH_PERIOD;
use crate::contact::WheelForces;
use crate::lagrange;
use crate::stored::stored;
use crate::units::Vec2;
use crate::vehicle::WheelReaction;
use crate::vehicle::kinematics::wheel_slips;
use crate::vehicle::settling::add_weighted;
use crate::vehicle::state::rotation;

/// The velocities may lag behind their steady state by this much, over the fastest rim's speed [-]:
/// the steady state's own motion in one settling time. Source: ours; models err by ten times as
/// much.
pub const MOST_LAG: f64 = 0.01;
/// And the steady state may change its yaw rate at most this fast, over the rate of settling [-],
/// or yaw and velocities would not be a slow and a fast motion. Source: ours.
pub const MOST_COUPLING: f64 = 0.1;

/// A yaw rate below this is none but for rounding, over the fastest rim's speed [-].
const ROUNDING: f64 = 1e-12;
/// A yaw that has changed by less than this is held [rad]: over ten metres of way, 0.1 µm.
const HELD: f64 = 1e-8;
/// Over so little yaw velocities change in proportion [rad]: a tenth of a degree.
const LINEAR: f64 = 1.75e-3;
/// The first stretch is what the rover turns through in this [s]: commands may change every few
/// hundredths of a second. Source: ours, as are the next three.
const FIRST_STRETCH: f64 = 0.03;
/// And under a later command in so many times the time for which the one before it lasted [-], if
/// that is longer.
const AS_LONG_AS_BEFORE: f64 = 1.1;
/// A stretch is at most so many times as long as the one before it [-].
const GROWTH: f64 = 20.0;
/// The narrowest and the longest stretch of yaw with one polynomial [rad].
const NARROWEST: f64 = 1e-10;
const LONGEST_STRETCH: f64 = 0.1;
/// Parabolas through three steady states must meet those between them to this, over the fastest
/// rim's speed [-]. The polynomial through all five is nearer by a hundred times where motion is
/// smooth.
const RESOLVED: f64 = 1e-5;
/// On a stretch of at most this width [rad] whose middle is off its chord by less than that over the
/// width, three steady states suffice: a parabola misses a third derivative of 1/rad³, which is that
/// of a sine, by 0.008 times the cube of the width, 1e-6.
const SHORT_STRETCH: f64 = 0.05;
/// A step in time turns the rover by at most this share of a stretch [-], or of one of two steady
/// states.
const STEP_SHARE: f64 = 0.1;
const LINEAR_STEP_SHARE: f64 = 0.5;
/// The longest step in time [s]: steps end at its multiples, too.
const LONGEST_STEP: f64 = WATCH_PERIOD;
/// A stretch this near to its end is at its end [-].
const AT_END: f64 = 0.01;

/// Steady states over a stretch of yaw, evenly spaced: one, two, three or five.
#[derive(Clone)]
pub(super) struct Stretch {
    nodes: Vec<SteadyState>,
    /// From the first to the last [rad], with its sign.
    width: f64,
    /// How far from its only steady state a stretch of one holds [rad].
    reach: f64,
}

stored!(struct Stretch { nodes, width, reach });

/// A step in time on which the rover is.
#[derive(Clone, Copy)]
struct BegunStep {
    /// Where and when [s] it began.
    from: Point,
    time: f64,
    /// Where the rover was last seen.
    seen: Point,
}

stored!(struct BegunStep { from, time, seen });

impl BegunStep {
    fn at(point: &Point, time: f64) -> Self {
        Self { from: *point, time, seen: *point }
    }
}

/// What one run hands on from one advance to the next.
#[derive(Clone)]
pub(super) struct Carried {
    memory: Memory,
    stretch: Stretch,
    step: BegunStep,
    /// Velocities with which the rims would roll.
    rolled: Vector3<f64>,
    /// Since when they turn so [s].
    since: f64,
}

stored!(struct Carried { memory, stretch, step, rolled, since });

impl Carried {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        let Stretch { nodes, width, reach } = &self.stretch;
        let has_wheels = |turning: &Option<Turning>| {
            turning.as_ref().is_none_or(|turning| turning.rim_speeds().len() == count)
        };
        let is_node = |node: &SteadyState| {
            let numbers = node.velocities.iter().chain(&node.powers).chain([&node.yaw]);
            let is_finite = numbers.copied().all(f64::is_finite);
            is_finite && node.wheels.len() == count && has_wheels(&node.turning)
        };
        let is_wide = match nodes.len() {
            1 => *width == 0.0 && *reach >= 0.0,
            2 | 3 | 5 => (NARROWEST..=LONGEST_STRETCH).contains(&width.abs()),
            _ => false,
        };
        let BegunStep { from, time, seen } = &self.step;
        is_wide
            && nodes.iter().all(is_node)
            && time.is_finite()
            && self.memory.is_of(count)
            && [from, seen].into_iter().all(|point| has_wheels(&point.turning))
    }

    /// The wheels at a point of the motion, if it is one of steady states.
    pub(super) fn wheels(&self, equations: &Equations<'_>, point: &Point) -> Vec<WheelReaction> {
        self.stretch.wheels(equations, point)
    }
}

/// The motion of a rover whose wheels turn at given speeds.
pub(super) struct QuasiSteady<'a, 'g> {
    equations: &'a Equations<'g>,
    solver: SteadySolver<'a, 'g>,
    stretch: Stretch,
    step: BegunStep,
    /// Since when the rims turn as they do [s].
    since: f64,
}

impl<'a, 'g> QuasiSteady<'a, 'g> {
    /// The motion from a point on; sets the point's velocities to their steady state.
    ///
    /// * `before`: the run so far
    /// * `time`: now [s]
    /// * `rims_changed`: whether they were others so far
    pub(super) fn from(
        equations: &'a Equations<'g>,
        before: Before<Carried>,
        point: &mut Point,
        time: f64,
        rims_changed: bool,
    ) -> Result<Self, NotSteady> {
        if equations.has_uneven_soil() {
            return Err(NotSteady::UnevenSoil);
        }
        let yaw = point.state.yaw;
        let mut lasts = FIRST_STRETCH;
        let (memory, before) = match before {
            Before::Steady(Carried { memory, stretch, step, since, .. }) if !rims_changed => {
                let solver = SteadySolver::new(equations, memory);
                return Ok(Self { equations, solver, stretch, step, since });
            }
            Before::Steady(Carried { memory, rolled, since, .. }) => {
                lasts = lasts.max(AS_LONG_AS_BEFORE * (time - since));
                (memory, Before::Steady(rolled))
            }
            Before::Another => (Memory::default(), Before::Another),
            Before::Nothing => (Memory::default(), Before::Nothing),
        };
        let mut solver = SteadySolver::new(equations, memory);
        let here = solver.find_after(yaw, &point.velocities(), before)?;
        let stretch = Stretch::first(&mut solver, here, lasts)?;
        let step = BegunStep::at(point, time);
        let mut motion = Self { equations, solver, stretch, step, since: time };
        motion.set_velocities(point);
        motion.step = BegunStep::at(point, time);
        Ok(motion)
    }

    /// What the next advance starts with.
    pub(super) fn carry(self) -> Carried {
        let rolled = rolling(self.equations);
        let memory = self.solver.memory();
        Carried { memory, stretch: self.stretch, step: self.step, rolled, since: self.since }
    }

    /// The wheels at a point of the motion.
    pub(super) fn wheels(&self, point: &Point) -> Vec<WheelReaction> {
        self.stretch.wheels(self.equations, point)
    }

    /// Goes on for a while.
    ///
    /// * `from`, `until`: from now to then [s]
    pub(super) fn advance(
        &mut self,
        point: &mut Point,
        [from, until]: [f64; 2],
    ) -> Result<(), NotSteady> {
        if self.step.seen != *point {
            self.step = BegunStep::at(point, from);
        }
        loop {
            if self.equations.is_spent() {
                return Err(NotSteady::NoSteadyState);
            }
            let Some(span) = self.stretch.step_from(self.step.from.state.yaw) else {
                self.stretch = self.stretch_on()?;
                continue;
            };
            let begun = self.step.time;
            let end = (begun + span).min(multiple_after(begun, LONGEST_STEP));
            if until < end {
                *point = self.stepped(until - begun);
                self.step.seen = *point;
                return Ok(());
            }
            // A rate without bound makes no step.
            if end <= begun {
                return Err(NotSteady::NoSteadyState);
            }
            self.step = BegunStep::at(&self.stepped(end - begun), end);
            if end == until {
                *point = self.step.from;
                return Ok(());
            }
        }
    }

    /// The stretch after the one that ends where the step begins.
    fn stretch_on(&mut self) -> Result<Stretch, NotSteady> {
        let yaw = self.step.from.state.yaw;
        let most = GROWTH * self.stretch.width.abs().max(self.stretch.reach);
        let here = match self.stretch.end_at(yaw) {
            Some(end) => end.clone(),
            None => self.solver.find(yaw, &self.stretch.velocities(yaw))?,
        };
        Stretch::ahead(&mut self.solver, here, most)
    }

    /// Where a step leads: one Runge-Kutta step of the pose and the energies, on the table.
    fn stepped(&self, span: f64) -> Point {
        let mut point = self.step.from;
        if span == 0.0 {
            return point;
        }
        self.equations.count(|work| work.steps += 1);
        let yaw = point.state.yaw;
        let k_1 = self.stretch.rates(yaw);
        let k_2 = self.stretch.rates(yaw + 0.5 * span * k_1.yaw_rate);
        let k_3 = self.stretch.rates(yaw + 0.5 * span * k_2.yaw_rate);
        let k_4 = self.stretch.rates(yaw + span * k_3.yaw_rate);
        let stages = [(1.0, k_1), (2.0, k_2), (2.0, k_3), (1.0, k_4)];
        for (weight, k) in stages {
            let share = weight * span / 6.0;
            point.state.position += k.velocity_slope * share;
            point.state.yaw += k.yaw_rate * share;
            let [motors, soil, electrical] = k.powers;
            point.motors += motors * share;
            point.soil += soil * share;
            point.electrical += electrical * share;
        }
        self.set_velocities(&mut point);
        point
    }

    /// Sets velocities to their steady state, which itself leaves nothing over to accelerate with.
    fn set_velocities(&self, point: &mut Point) {
        point.turning = self.stretch.turning(point.state.yaw);
        let velocities = self.stretch.velocities(point.state.yaw);
        point.jump(self.equations.rover(), |state| {
            state.velocity = velocities.xy();
            state.yaw_rate = velocities.z;
        });
    }
}

/// Rates of the pose and the energies.
#[derive(Clone, Copy)]
struct PoseRates {
    velocity_slope: Vec2,
    yaw_rate: f64,
    powers: [f64; 3],
}

impl Stretch {
    /// The stretch with which a motion begins.
    ///
    /// * `lasts`: for how long it is expected to [s]
    fn first(
        solver: &mut SteadySolver<'_, '_>,
        here: SteadyState,
        lasts: f64,
    ) -> Result<Self, NotSteady> {
        let most = lasts * here.velocities.z.abs();
        if most > HELD {
            return Self::ahead(solver, here, most);
        }
        solver.settling_time(&here)?;
        Ok(Self::held(solver, here))
    }

    /// A stretch of one steady state, which holds nearby; on level ground, where no yaw differs from
    /// another, everywhere.
    fn held(solver: &SteadySolver<'_, '_>, here: SteadyState) -> Self {
        let reach = if solver.is_level() { f64::INFINITY } else { HELD };
        Self { nodes: vec![here], width: 0.0, reach }
    }

    /// The stretch that the rover will turn through from a steady state on.
    ///
    /// * `most`: its width [rad], if that is resolved
    fn ahead(
        solver: &mut SteadySolver<'_, '_>,
        here: SteadyState,
        most: f64,
    ) -> Result<Self, NotSteady> {
        let settling_time = solver.settling_time(&here)?;
        let rate = here.velocities.z;
        if solver.is_level() || solver.size(&Vector3::new(0.0, 0.0, rate)) <= ROUNDING {
            return Ok(Self::held(solver, here));
        }
        let width = most.min(LONGEST_STRETCH).copysign(rate);
        let stretch = Self::through(solver, here, width)?;
        let per_yaw = stretch.per_yaw();
        Self::check(solver, &per_yaw, settling_time, rate)?;
        solver.remember_per_yaw(per_yaw);
        Ok(stretch)
    }

    /// How velocities change along the stretch [m/s/rad, m/s/rad, 1/s].
    fn per_yaw(&self) -> Vector3<f64> {
        let [first, last] = [&self.nodes[0], &self.nodes[self.nodes.len() - 1]];
        (last.velocities - first.velocities) / self.width
    }

    /// Steady states over a stretch that starts with a known one, halved until it is resolved.
    fn through(
        solver: &mut SteadySolver<'_, '_>,
        here: SteadyState,
        mut width: f64,
    ) -> Result<Self, NotSteady> {
        let mut known = vec![(0.0, here)];
        while width.abs() > LINEAR {
            if fill(solver, &mut known, width, &[1.0, 0.5]).is_ok()
                && (width.abs() <= SHORT_STRETCH && bend(solver, &known) * width.abs() <= RESOLVED
                    || fill(solver, &mut known, width, &QUARTERS).is_ok()
                        && roughness(solver, &known) <= RESOLVED)
            {
                let nodes = known.into_iter().map(|(_, steady)| steady).collect();
                return Ok(Self { nodes, width, reach: 0.0 });
            }
            known.retain(|(share, _)| *share <= 0.5);
            for (share, _) in &mut known {
                *share *= 2.0;
            }
            width *= 0.5;
        }
        known.retain(|(share, _)| *share == 0.0 || *share == 1.0);
        fill(solver, &mut known, width, &[0.0, 1.0])?;
        let nodes = known.into_iter().map(|(_, steady)| steady).collect();
        Ok(Self { nodes, width, reach: 0.0 })
    }

    /// Checks that velocities can follow the steady state as it moves along the stretch.
    fn check(
        solver: &SteadySolver<'_, '_>,
        per_yaw: &Vector3<f64>,
        settling_time: f64,
        rate: f64,
    ) -> Result<(), NotSteady> {
        let lag = settling_time * rate.abs() * solver.size(per_yaw);
        if lag > MOST_LAG || settling_time * per_yaw.z.abs() > MOST_COUPLING {
            return Err(NotSteady::Lags { settling_time, lag });
        }
        Ok(())
    }

    /// The wheels at a point of the motion.
    fn wheels(&self, equations: &Equations<'_>, point: &Point) -> Vec<WheelReaction> {
        let rim_speeds = equations.turning(point);
        let slips = wheel_slips(equations.rover(), &point.state, rim_speeds);
        let weights = self.weights(point.state.yaw);
        slips
            .enumerate()
            .map(|(wheel, slip)| {
                let reactions = self.nodes.iter().map(|node| &node.wheels[wheel]);
                WheelReaction { slip, ..blended(reactions.zip(weights)) }
            })
            .collect()
    }

    /// Where a yaw is on the stretch: 0 at its start, 1 at its end.
    fn share(&self, yaw: f64) -> f64 {
        if self.width == 0.0 { 0.0 } else { (yaw - self.nodes[0].yaw) / self.width }
    }

    /// How long the next step is from a yaw on at the most [s]; none where the stretch ends there.
    fn step_from(&self, yaw: f64) -> Option<f64> {
        if self.width == 0.0 {
            let is_held = (yaw - self.nodes[0].yaw).abs() <= self.reach;
            return is_held.then_some(f64::INFINITY);
        }
        let (share, rate) = (self.share(yaw), self.velocities(yaw).z / self.width);
        let left = if rate < 0.0 { share } else { 1.0 - share };
        let is_on = (-AT_END..=1.0 + AT_END).contains(&share) && left > AT_END;
        let most = if self.nodes.len() == 2 { LINEAR_STEP_SHARE } else { STEP_SHARE };
        // A rate of zero lasts for ever.
        is_on.then(|| left.min(most) / rate.abs())
    }

    /// The steady state at whose yaw the stretch ends, if the rover turns on there.
    fn end_at(&self, yaw: f64) -> Option<&SteadyState> {
        let (share, rate) = (self.share(yaw), self.velocities(yaw).z);
        let is_first = rate * self.width < 0.0;
        let (at, end) = if is_first { (0.0, self.nodes.first()) } else { (1.0, self.nodes.last()) };
        let is_near = self.width != 0.0 && (share - at).abs() <= AT_END;
        end.filter(|end| is_near && end.velocities.z * rate > 0.0)
    }

    fn weights(&self, yaw: f64) -> [f64; 5] {
        match self.nodes.len() {
            1 => [1.0, 0.0, 0.0, 0.0, 0.0],
            2 => lagrange::weights(&[0.0, 1.0], self.share(yaw)),
            3 => lagrange::weights(&[0.0, 0.5, 1.0], self.share(yaw)),
            _ => lagrange::weights(&QUARTERS, self.share(yaw)),
        }
    }

    fn velocities(&self, yaw: f64) -> Vector3<f64> {
        let weighted = self.nodes.iter().zip(self.weights(yaw));
        weighted.map(|(node, weight)| node.velocities * weight).sum()
    }

    /// How the wheels turn, where that is not as they are set to.
    fn turning(&self, yaw: f64) -> Option<Turning> {
        let first = self.nodes[0].turning?;
        let mut sum = vec![0.0; 2 * first.rim_speeds().len()];
        for (node, weight) in self.nodes.iter().zip(self.weights(yaw)) {
            let numbers = node.turning.as_ref().map(Turning::numbers)?;
            for (sum, number) in sum.iter_mut().zip(numbers.into_iter().flatten()) {
                *sum += weight * number;
            }
        }
        Some(Turning::of(&sum))
    }

    fn rates(&self, yaw: f64) -> PoseRates {
        let mut velocities = Vector3::zeros();
        let (mut motors, mut soil, mut electrical) = (0.0, 0.0, 0.0);
        for (node, weight) in self.nodes.iter().zip(self.weights(yaw)) {
            velocities += node.velocities * weight;
            motors += node.powers[0] * weight;
            soil += node.powers[1] * weight;
            electrical += node.powers[2] * weight;
        }
        let velocity_slope = rotation(yaw) * velocities.xy();
        PoseRates { velocity_slope, yaw_rate: velocities.z, powers: [motors, soil, electrical] }
    }
}

/// Where the steady states of a long stretch are.
const QUARTERS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Finds the steady states that are missing at some shares of a stretch, each from those known;
/// leaves them in the order of the shares.
fn fill(
    solver: &mut SteadySolver<'_, '_>,
    known: &mut Vec<(f64, SteadyState)>,
    width: f64,
    shares: &[f64],
) -> Result<(), NotSteady> {
    let start = known[0].1.yaw;
    for &share in shares {
        if known.iter().any(|(at, _)| *at == share) {
            continue;
        }
        let places: Vec<f64> = known.iter().take(5).map(|(at, _)| *at).collect();
        let weighted = known.iter().zip(lagrange::weights::<5>(&places, share));
        let along: Vector3<f64> =
            weighted.map(|((_, node), weight)| node.velocities * weight).sum();
        // Where one steady state alone is known, the stretch before this tells how they change.
        let further =
            if known.len() == 1 { solver.per_yaw() * (share * width) } else { Vector3::zeros() };
        let guess = along + further;
        let yaw = start + share * width;
        // A stretch that is too long for a search from nearby is halved.
        let steady = if width.abs() > LINEAR {
            solver.find_near(yaw, &guess)
        } else {
            solver.find(yaw, &guess)
        }?;
        known.push((share, steady));
        known.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    }
    Ok(())
}

/// How far the middle one of three steady states is off the chord between the others, over the
/// fastest rim's speed [-].
fn bend(solver: &SteadySolver<'_, '_>, nodes: &[(f64, SteadyState)]) -> f64 {
    let [first, middle, last] = [0, 1, 2].map(|at| nodes[at].1.velocities);
    solver.size(&(middle - 0.5 * (first + last)))
}

/// How far parabolas through the first, the middle and the last of five steady states miss the
/// other two, over the fastest rim's speed [-].
fn roughness(solver: &SteadySolver<'_, '_>, nodes: &[(f64, SteadyState)]) -> f64 {
    let miss = |at: usize| {
        let weights: [f64; 3] = lagrange::weights(&[0.0, 0.5, 1.0], nodes[at].0);
        let parabola: Vector3<f64> =
            (0..3).map(|node| nodes[2 * node].1.velocities * weights[node]).sum();
        solver.size(&(nodes[at].1.velocities - parabola))
    };
    miss(1).max(miss(3))
}

/// A wheel between its reactions at several steady states; its slip is for the caller to set.
pub(super) fn blended<'a>(
    weighted: impl Iterator<Item = (&'a WheelReaction, f64)>,
) -> WheelReaction {
    let mut sum: Option<WheelReaction> = None;
    for (reaction, weight) in weighted {
        let blend = sum.get_or_insert_with(|| nothing_of(reaction));
        blend.load += weight * reaction.load;
        blend.settled.sinkage += weight * reaction.settled.sinkage;
        add_weighted(&mut blend.settled.forces, &reaction.settled.forces, weight);
    }
    sum.expect("a stretch has steady states")
}

/// A reaction with all that is weighted at zero; nothing was evaluated for it.
fn nothing_of(reaction: &WheelReaction) -> WheelReaction {
    let mut nothing = *reaction;
    nothing.load = 0.0;
    nothing.settled.sinkage = 0.0;
    nothing.settled.evaluations = 0;
    nothing.settled.forces = WheelForces::default();
    nothing
}
