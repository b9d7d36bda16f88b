//! The motion that a rover settles into at a yaw, within milliseconds, while its wheels turn at
//! given speeds: what it does at that instant if nobody corrects it.

use nalgebra::Vector3;

use super::equations::{Equations, LastWheels};

use super::scenario::ROLLING_SHARE;
use super::steady_state::{Memory, NotSteady, SteadySolver, SteadyState, rolling};
use crate::elementary::wide;
use crate::units::Vec2;
use crate::vehicle::WheelReaction;
use crate::vehicle::on_ground::OnGround;
use crate::vehicle::settling::Known;

/// A steady motion at a yaw: forces and yaw moment are balanced, so that the rover goes straight on
/// or turns at a steady rate.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyMotion {
    /// Yaw, *γ* [rad].
    pub yaw: f64,
    /// Velocity of the body's centre of mass *(u, v)*, in the body frame [m/s].
    pub velocity: Vec2,
    /// Yaw rate [rad/s].
    pub yaw_rate: f64,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
    memory: Memory,
    is_held: bool,
}

/// How a steady motion is sought.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seeking {
    /// A velocity of the body's centre of mass that it may be near, in the body frame [m/s]: where
    /// it is not found from there it is sought from rolling.
    pub near: Option<Vec2>,
    /// Whether something holds the yaw: forces are balanced, and the rover does not turn.
    pub is_held: bool,
}

/// Slip ratios from which a steady motion is sought that is not found from that of a light slip
/// [-].
const NEARER: [f64; 5] = [1e-3, -1e-3, 1e-4, -1e-4, 0.0];

impl SteadyMotion {
    /// The steady motion of a rover whose wheels turn at given rim speeds [m/s], at a yaw [rad].
    ///
    /// # Errors
    /// [`NotSteady`] where no velocities are found at which nothing accelerates.
    pub fn of(ground: OnGround<'_>, rim_speeds: &[f64], yaw: f64) -> Result<Self, NotSteady> {
        Self::sought(ground, rim_speeds, yaw, Seeking::default())
    }

    /// The same, sought in a way of its own.
    ///
    /// # Errors
    /// The same as [`of`](Self::of).
    pub fn sought(
        ground: OnGround<'_>,
        rim_speeds: &[f64],
        yaw: f64,
        seeking: Seeking,
    ) -> Result<Self, NotSteady> {
        let Seeking { near, is_held } = seeking;
        let equations = Equations::new(ground, rim_speeds).holding(is_held.then_some(0.0));
        let close = near.filter(|_| !ground.rover.has_droop()).and_then(|velocity| {
            let mut solver = SteadySolver::new(&equations, Memory::default());
            let guess = Vector3::new(velocity.x, velocity.y, 0.0);
            let found = solver.find_close(yaw, &guess)?;
            Some(Self::of_state(&equations, found, solver.memory()))
        });
        close.map_or_else(|| Self::found(&equations, yaw), Ok)
    }

    fn found(equations: &Equations<'_>, yaw: f64) -> Result<Self, NotSteady> {
        let light = rolling(equations);
        let first = Self::near(equations, yaw, &light, Memory::default());
        // Where wheels hardly slip, forces turn within a thousandth of the rims' speed: only a near
        // guess finds it.
        let nearer = NEARER.into_iter().map(|slip| (1.0 - slip) / ROLLING_SHARE * light);
        let retried = nearer.map(|guess| Self::near(equations, yaw, &guess, Memory::default()));
        first.or_else(|error| retried.flatten().next().ok_or(error))
    }

    /// The steady motion of the same rover on the same ground at another yaw [rad], sought from
    /// this one, and held if this one is: in fewer evaluations if it is near.
    ///
    /// # Errors
    /// The same as [`of`](Self::of).
    pub fn at_yaw(
        &self,
        ground: OnGround<'_>,
        rim_speeds: &[f64],
        yaw: f64,
    ) -> Result<Self, NotSteady> {
        let here = Vector3::new(self.velocity.x, self.velocity.y, self.yaw_rate);
        let on_plane = Known::of_all(&ground, &self.wheels).unwrap_or_default();
        let known = LastWheels { on_plane, ..LastWheels::default() };
        let equations =
            Equations::new(ground, rim_speeds).holding(self.is_held.then_some(0.0)).near(known);
        Self::near(&equations, yaw, &here, self.memory.clone())
            .or_else(|_| Self::found(&equations, yaw))
    }

    fn near(
        equations: &Equations<'_>,
        yaw: f64,
        guess: &Vector3<f64>,
        memory: Memory,
    ) -> Result<Self, NotSteady> {
        let mut solver = SteadySolver::new(equations, memory);
        let found = solver.find(yaw, guess)?;
        Ok(Self::of_state(equations, found, solver.memory()))
    }

    fn of_state(equations: &Equations<'_>, found: SteadyState, memory: Memory) -> Self {
        let SteadyState { yaw, velocities, wheels, .. } = found;
        let (velocity, yaw_rate) = (velocities.xy(), velocities.z);
        Self { yaw, velocity, yaw_rate, wheels, memory, is_held: equations.is_held() }
    }

    /// Speed [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.velocity.norm()
    }

    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    #[must_use]
    pub fn course(&self) -> f64 {
        self.yaw + wide::atan2(self.velocity.y, self.velocity.x)
    }

    /// Change of the yaw over the way [rad/m]: negative where the nose falls.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.yaw_rate / self.speed()
    }

    /// Mean slip ratio of the wheels [-].
    #[must_use]
    pub fn slip_ratio(&self) -> f64 {
        let sum: f64 = self.wheels.iter().map(|wheel| wheel.slip.ratio).sum();
        sum / self.wheels.len() as f64
    }
}
