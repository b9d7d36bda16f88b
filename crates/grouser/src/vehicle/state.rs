//! Where the rover is and how it moves.

use nalgebra::Rotation2;

use crate::units::Vec2;

/// Pose and velocity of a rover on the slope.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoverState {
    /// Position of the body's centre of mass, in the slope frame [m].
    pub position: Vec2,
    /// Yaw, *γ* [rad]: positive turns the nose uphill.
    pub yaw: f64,
    /// Velocity of the body's centre of mass, in the body frame, *(u, v)* [m/s].
    pub velocity: Vec2,
    /// Yaw rate, *γ̇* [rad/s].
    pub yaw_rate: f64,
}

impl RoverState {
    /// The rotation that takes vectors of the body frame to the slope frame.
    #[must_use]
    pub fn slope_from_body(&self) -> Rotation2<f64> {
        Rotation2::new(self.yaw)
    }

    /// Velocity of the body's centre of mass, in the slope frame [m/s].
    #[must_use]
    pub fn velocity_slope(&self) -> Vec2 {
        self.slope_from_body() * self.velocity
    }
}

/// Rates of the velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acceleration {
    /// Rate of [`RoverState::velocity`], *(u̇, v̇)* [m/s²]: components in the turning body frame.
    pub velocity_rate: Vec2,
    /// Yaw acceleration, *γ̈* [rad/s²].
    pub yaw_acceleration: f64,
}
