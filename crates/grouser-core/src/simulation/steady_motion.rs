//! The motion that a rover settles into at a yaw, within milliseconds, while its wheels turn at
//! given speeds: what it does at that instant if nobody corrects it.

use nalgebra::Vector3;

use super::equations::Equations;
use super::quasi_steady::rolling;
use super::scenario::ROLLING_SHARE;
use super::steady_state::{Memory, NotSteady, SteadySolver};
use crate::elementary::wide;
use crate::units::Vec2;
use crate::vehicle::WheelReaction;
use crate::vehicle::on_ground::OnGround;

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
        let equations = Equations::new(ground, rim_speeds);
        let light = rolling(&equations);
        let first = Self::near(&equations, yaw, &light, Memory::default());
        // Where wheels hardly slip, forces turn within a thousandth of the rims' speed: only a near
        // guess finds it.
        let nearer = NEARER.into_iter().map(|slip| (1.0 - slip) / ROLLING_SHARE * light);
        let retried = nearer.map(|guess| Self::near(&equations, yaw, &guess, Memory::default()));
        first.or_else(|error| retried.flatten().next().ok_or(error))
    }

    /// The steady motion of the same rover on the same ground at another yaw [rad], sought from
    /// this one: in fewer evaluations if it is near.
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
        Self::near(&Equations::new(ground, rim_speeds), yaw, &here, self.memory.clone())
            .or_else(|_| Self::of(ground, rim_speeds, yaw))
    }

    fn near(
        equations: &Equations<'_>,
        yaw: f64,
        guess: &Vector3<f64>,
        memory: Memory,
    ) -> Result<Self, NotSteady> {
        let mut solver = SteadySolver::new(equations, memory);
        let found = solver.find(yaw, guess)?;
        let velocity = found.velocities.xy();
        let (yaw_rate, memory) = (found.velocities.z, solver.memory());
        Ok(Self { yaw, velocity, yaw_rate, wheels: found.wheels, memory })
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
