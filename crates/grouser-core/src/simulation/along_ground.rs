//! Quasi-steady motion over uneven ground: steady velocities at every pose, which is integrated by
//! strides.
//!
//! The steady state depends on place and yaw, so there is no table of it
//! ([`quasi_steady`](super::quasi_steady)): a stride is a step of the midpoint rule, with a steady
//! state in its middle and at its end, each sought from the one before. It is as long as the
//! ground's curvature lets it be, and no longer than a wheel's radius, or half of it where soils
//! differ by zone. What is looked at within a stride is interpolated between its ends (Hermite).

use nalgebra::Vector3;

use super::equations::Equations;
use super::point::Point;
use super::quasi_steady::{MOST_LAG, blended};
use super::steady_state::{Before, CLOSE, Memory, NotSteady, SteadySolver, SteadyState, rolling};
use super::turning::Turning;
use crate::contact::Slip;
use crate::stored::stored;
use crate::units::Vec2;
use crate::vehicle::{Mount, WheelReaction};

/// The velocity changes by this share of the rims' over half a stride [-]: the rest that the
/// midpoint rule leaves is below the square of it. Source: ours.
const CHANGE: f64 = 0.03;
/// A stride whose velocity changes by more than so many times that is taken again, half as long
/// [-].
const TOO_MUCH: f64 = 2.0;
/// The longest stride over zones of soil, over a wheel's radius [-]: at a border the velocity
/// changes within a footprint. Source: measured; a way of 1 m over a border is off by 0.3 mm with
/// strides as long as the radius, by less than 0.1 mm with these.
const BY_ZONES: f64 = 0.5;
/// The shortest stride, over a wheel's radius [-]: below, the ground has an edge.
const SHORTEST: f64 = 1e-3;

/// The motion of a rover over uneven ground whose wheels turn at given speeds.
pub(super) struct AlongGround<'a, 'g> {
    equations: &'a Equations<'g>,
    solver: SteadySolver<'a, 'g>,
    stride: Stride,
    /// How long the next one may be [s].
    next: f64,
}

/// What one run hands on from one advance to the next.
#[derive(Clone)]
pub(super) struct Carried {
    memory: Memory,
    stride: Stride,
    /// Velocities with which the rims would roll.
    rolled: Vector3<f64>,
}

stored!(struct Carried { memory, stride, rolled });

impl Carried {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        [&self.stride.from, &self.stride.to].iter().all(|node| node.steady.wheels.len() == count)
    }

    /// The wheels where the rover is.
    pub(super) fn wheels(&self) -> Vec<WheelReaction> {
        self.stride.wheels()
    }
}

/// A piece of way between two steady states.
#[derive(Clone)]
struct Stride {
    from: Node,
    to: Node,
    /// [s]
    length: f64,
    /// How far into it the rover is [s].
    gone: f64,
}

stored!(struct Stride { from, to, length, gone });

/// A pose with its steady state.
#[derive(Clone)]
struct Node {
    place: Vec2,
    yaw: f64,
    steady: SteadyState,
    /// Rates of the pose: of the place [m/s] and of the yaw [rad/s].
    rates: (Vec2, f64),
}

stored!(struct Node { place, yaw, steady, rates });

impl<'a, 'g> AlongGround<'a, 'g> {
    /// The motion from a point on; sets the point's velocities to their steady state.
    ///
    /// * `before`: the run so far
    /// * `rims_changed`: whether the wheels had other speeds so far
    pub(super) fn from(
        equations: &'a Equations<'g>,
        before: Before<Carried>,
        point: &mut Point,
        rims_changed: bool,
    ) -> Result<Self, NotSteady> {
        let (memory, before) = match before {
            Before::Steady(Carried { memory, stride, .. }) if !rims_changed => {
                let solver = SteadySolver::new(equations, memory);
                let next = if stride.length > 0.0 { 2.0 * stride.length } else { f64::INFINITY };
                return Ok(Self { equations, solver, stride, next });
            }
            Before::Steady(Carried { memory, rolled, .. }) => (memory, Before::Steady(rolled)),
            Before::Another => (Memory::default(), Before::Another),
            Before::Nothing => (Memory::default(), Before::Nothing),
        };
        let (place, yaw) = (point.state.position, point.state.yaw);
        let mut solver = SteadySolver::new(equations, memory);
        solver.go_to(place);
        let steady = solver.find_after(yaw, &point.velocities(), before)?;
        let from = Node::of(equations, &solver, place, yaw, steady)?;
        solver.settling_time(&from.steady)?;
        let stride = Stride { to: from.clone(), from, length: 0.0, gone: 0.0 };
        let mut motion = Self { equations, solver, stride, next: f64::INFINITY };
        motion.set_velocities(point);
        Ok(motion)
    }

    /// What the next advance starts with.
    pub(super) fn carry(self) -> Carried {
        let rolled = rolling(self.equations);
        Carried { memory: self.solver.memory(), stride: self.stride, rolled }
    }

    /// The wheels at the point that it has come to.
    pub(super) fn wheels(&self) -> Vec<WheelReaction> {
        self.stride.wheels()
    }

    /// Their slip.
    pub(super) fn slips(&self) -> Vec<Slip> {
        self.stride.slips()
    }

    /// Goes on for a while [s].
    ///
    /// * `horizon`: how long the rims will keep their speeds [s], at least the span
    pub(super) fn advance(
        &mut self,
        point: &mut Point,
        span: f64,
        horizon: f64,
    ) -> Result<(), NotSteady> {
        let mut left = span;
        while left > 0.0 {
            let remaining = self.stride.length - self.stride.gone;
            if remaining <= 0.0 {
                self.stride = self.stride_on(left.max(horizon - (span - left)))?;
                continue;
            }
            if left < remaining {
                self.go(point, self.stride.gone + left);
                break;
            }
            self.go(point, self.stride.length);
            left -= remaining;
        }
        Ok(())
    }

    /// Goes on within the stride to a time since its start [s].
    fn go(&mut self, point: &mut Point, time: f64) {
        let before = self.stride.pose();
        let powers_before = self.stride.powers();
        let way = time - self.stride.gone;
        self.stride.gone = time;
        let after = self.stride.pose();
        point.state.position += after.0 - before.0;
        point.state.yaw += after.1 - before.1;
        let powers: Vec<f64> = powers_before
            .iter()
            .zip(self.stride.powers())
            .map(|(a, b)| 0.5 * way * (a + b))
            .collect();
        point.motors += powers[0];
        point.soil += powers[1];
        point.electrical += powers[2];
        self.set_velocities(point);
    }

    fn set_velocities(&mut self, point: &mut Point) {
        point.turning = self.stride.turning();
        let velocities = self.stride.velocities();
        point.jump(self.equations.rover(), |state| {
            state.velocity = velocities.xy();
            state.yaw_rate = velocities.z;
        });
    }

    /// The stride after this one.
    ///
    /// * `most`: its longest time [s]
    fn stride_on(&mut self, most: f64) -> Result<Stride, NotSteady> {
        let from = self.stride.to.clone();
        let radii = self.equations.rover().mounts().iter().map(Mount::shearing_radius);
        let radius = radii.fold(f64::INFINITY, f64::min);
        let speed = self.solver.speed(&from.steady.velocities);
        let share = if self.equations.has_zones() { BY_ZONES } else { 1.0 };
        let longest = share * radius / speed;
        let mut length = self.next.min(longest);
        loop {
            // A rest that is hardly one would be a stride of its own.
            let step = if length > 0.9 * most { most } else { length };
            let attempt = self.stride_from(&from, step);
            let change = attempt.as_ref().map_or(f64::INFINITY, |(_, change)| *change);
            if change > TOO_MUCH * CHANGE && step > SHORTEST * longest {
                length = 0.5 * step;
                continue;
            }
            let (stride, change) = attempt?;
            self.equations.count(|work| work.steps += 1);
            self.next = step * (CHANGE / change.max(1e-12)).clamp(0.5, 2.0);
            return Ok(stride);
        }
    }

    /// A stride, and by how much the velocity changes in its first half, over the fastest rim's
    /// [-].
    fn stride_from(&mut self, from: &Node, length: f64) -> Result<(Stride, f64), NotSteady> {
        let equations = self.equations;
        let half = 0.5 * length;
        let (place, yaw) = (from.place + half * from.rates.0, from.yaw + half * from.rates.1);
        let middle = Node::at(equations, &mut self.solver, place, yaw, &from.steady.velocities)?;
        let change = middle.steady.velocities - from.steady.velocities;
        let (place, yaw) =
            (from.place + length * middle.rates.0, from.yaw + length * middle.rates.1);
        let guess = from.steady.velocities + 2.0 * change;
        let to = Node::at(equations, &mut self.solver, place, yaw, &guess)?;
        let settling_time = self.solver.settling_time(&to.steady)?;
        let turned = middle.rates.1 - from.rates.1;
        let size = self.solver.size(&change).max(self.solver.size(&Vector3::new(0.0, 0.0, turned)));
        // Velocities must be able to follow the steady state as it moves. How near it is found tells
        // nothing of that, which in a short stride is all that changes.
        let lag = settling_time * (size - CLOSE).max(0.0) / half;
        if lag > MOST_LAG {
            return Err(NotSteady::Lags { settling_time, lag });
        }
        Ok((Stride { from: from.clone(), to, length, gone: 0.0 }, size))
    }
}

impl Node {
    /// * `guess`: velocities near the steady ones
    fn at(
        equations: &Equations<'_>,
        solver: &mut SteadySolver<'_, '_>,
        place: Vec2,
        yaw: f64,
        guess: &Vector3<f64>,
    ) -> Result<Self, NotSteady> {
        solver.go_to(place);
        let steady = solver.find(yaw, guess)?;
        Self::of(equations, solver, place, yaw, steady)
    }

    /// A pose with its steady state.
    fn of(
        equations: &Equations<'_>,
        solver: &SteadySolver<'_, '_>,
        place: Vec2,
        yaw: f64,
        steady: SteadyState,
    ) -> Result<Self, NotSteady> {
        let state = solver.state_of(yaw, &steady.velocities);
        let rates = equations.pose_rates(&state).ok_or(NotSteady::NoSteadyState)?;
        Ok(Self { place, yaw, steady, rates })
    }
}

impl Stride {
    /// How far into it the rover is [-].
    fn share(&self) -> f64 {
        if self.length > 0.0 { self.gone / self.length } else { 0.0 }
    }

    /// Place and yaw.
    fn pose(&self) -> (Vec2, f64) {
        let (s, h) = (self.share(), self.length);
        // The cubic with both ends' values and rates.
        let to = s * s * (3.0 - 2.0 * s);
        let (rate_from, rate_to) = (h * s * (1.0 - s) * (1.0 - s), h * s * s * (s - 1.0));
        let Self { from, to: end, .. } = self;
        let place = from.place
            + to * (end.place - from.place)
            + rate_from * from.rates.0
            + rate_to * end.rates.0;
        let yaw =
            from.yaw + to * (end.yaw - from.yaw) + rate_from * from.rates.1 + rate_to * end.rates.1;
        (place, yaw)
    }

    fn velocities(&self) -> Vector3<f64> {
        let s = self.share();
        (1.0 - s) * self.from.steady.velocities + s * self.to.steady.velocities
    }

    fn powers(&self) -> [f64; 3] {
        let s = self.share();
        let [from, to] = [&self.from.steady.powers, &self.to.steady.powers];
        [0, 1, 2].map(|which| (1.0 - s) * from[which] + s * to[which])
    }

    fn turning(&self) -> Option<Turning> {
        let [from, to] = [self.from.steady.turning?, self.to.steady.turning?];
        let s = self.share();
        let numbers = from.numbers().into_iter().flatten().zip(to.numbers().into_iter().flatten());
        Some(Turning::of(&numbers.map(|(from, to)| (1.0 - s) * from + s * to).collect::<Vec<_>>()))
    }

    /// The wheels.
    fn wheels(&self) -> Vec<WheelReaction> {
        let s = self.share();
        let pairs = self.from.steady.wheels.iter().zip(&self.to.steady.wheels);
        let wheels = pairs.map(|(from, to)| {
            let slip = from.slip.towards(&to.slip, s);
            WheelReaction { slip, ..blended([(from, 1.0 - s), (to, s)].into_iter()) }
        });
        wheels.collect()
    }

    /// Their slip.
    fn slips(&self) -> Vec<Slip> {
        let s = self.share();
        let pairs = self.from.steady.wheels.iter().zip(&self.to.steady.wheels);
        pairs.map(|(from, to)| from.slip.towards(&to.slip, s)).collect()
    }
}
