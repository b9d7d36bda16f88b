//! Where the rover is and how it moves.

use nalgebra::{Matrix2, Rotation2};

use crate::elementary::wide;
use crate::stored::stored;
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
    /// Yaw rate, *γ' = dγ/dt* [rad/s].
    pub yaw_rate: f64,
}

stored!(struct RoverState { position, yaw, velocity, yaw_rate });

impl RoverState {
    /// The rotation that takes vectors of the body frame to the slope frame.
    #[must_use]
    pub fn slope_from_body(&self) -> Rotation2<f64> {
        rotation(self.yaw)
    }

    /// Velocity of the body's centre of mass, in the slope frame [m/s].
    #[must_use]
    pub fn velocity_slope(&self) -> Vec2 {
        self.slope_from_body() * self.velocity
    }
}

/// The rotation by an angle [rad]. (The library's own asks the platform for sine and cosine.)
pub(crate) fn rotation(angle: f64) -> Rotation2<f64> {
    let (sin, cos) = wide::sin_cos(angle);
    Rotation2::from_matrix_unchecked(Matrix2::new(cos, -sin, sin, cos))
}

/// Rates of the velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acceleration {
    /// Rate of [`RoverState::velocity`], *(u', v')* [m/s²]: components in the turning body frame.
    pub velocity_rate: Vec2,
    /// Yaw acceleration, *γ'' = d²γ/dt²* [rad/s²].
    pub yaw_acceleration: f64,
}

/// Roll and pitch of a rover on a plane slope [rad].
///
/// * `slope`, `yaw`: *α*, *γ* [rad]
///
/// ```text
/// sin θ = sin α sin γ        tan φ = tan α cos γ
/// ```
#[must_use]
pub fn roll_and_pitch(slope: f64, yaw: f64) -> [f64; 2] {
    let across = wide::sin(slope) * wide::cos(yaw);
    [wide::atan2(across, wide::cos(slope)), wide::asin(wide::sin(slope) * wide::sin(yaw))]
}

/// Slope and yaw of a rover on a plane [rad]: the inverse of [`roll_and_pitch`]. On level ground
/// the yaw is not known, and 0.
///
/// * `roll`, `pitch`: *φ*, *θ* [rad]
///
/// ```text
/// sin α sin γ = sin θ        sin α cos γ = cos θ sin φ        cos α = cos θ cos φ
/// ```
#[must_use]
pub fn slope_and_yaw(roll: f64, pitch: f64) -> [f64; 2] {
    let (along, across) = (wide::sin(pitch), wide::cos(pitch) * wide::sin(roll));
    let upright = wide::cos(pitch) * wide::cos(roll);
    [wide::atan2(wide::hypot(along, across), upright), wide::atan2(along, across)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    #[test]
    fn slope_and_yaw_follow_from_roll_and_pitch() {
        for (slope, yaw) in [(10.0, 0.0), (10.0, 90.0), (25.0, -130.0), (13.0, 8.0), (1e-3, 40.0)] {
            let [roll, pitch] = roll_and_pitch(deg(slope), deg(yaw));
            let [found, turned] = slope_and_yaw(roll, pitch);
            assert!((found - deg(slope)).abs() < 1e-12 && (turned - deg(yaw)).abs() < 1e-9);
        }
        assert_eq!(slope_and_yaw(0.0, 0.0), [0.0, 0.0]);
    }

    /// Along the contour all of the slope is roll, straight up all of it is pitch, and the
    /// upright's share is always the slope's.
    #[test]
    fn roll_and_pitch_share_the_slope() {
        for (slope, yaw) in [(10.0, 0.0), (10.0, 90.0), (25.0, 30.0), (13.0, 8.0)] {
            let (slope, yaw) = (deg(slope), deg(yaw));
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            assert!((roll.cos() * pitch.cos() - slope.cos()).abs() < 1e-12);
        }
        let [roll, pitch] = roll_and_pitch(deg(10.0), 0.0);
        assert!((roll - deg(10.0)).abs() < 1e-12 && pitch == 0.0);
        let [roll, pitch] = roll_and_pitch(deg(10.0), deg(90.0));
        assert!(roll.abs() < 1e-12 && (pitch - deg(10.0)).abs() < 1e-12);
    }
}
