//! The rover's acceleration ([FourWheel], Eqs 5-11, corrected).
//!
//! Written about the body's centre of mass, in body axes, with *S* the wheels' first moment and a
//! dash for the rate of change, γ' = dγ/dt:
//!
//! ```text
//! m (u' − γ' v) − S_x γ'² − S_y γ'' = ΣF_x + G_x
//! m (v' + γ' u) − S_y γ'² + S_x γ'' = ΣF_y + G_y
//! I γ'' + S_x (v' + γ' u) − S_y (u' − γ' v) = Σ(d_x F_y − d_y F_x + M_z) + (S_x G_y − S_y G_x)/m
//! ```
//!
//! The source mixes body and inertial axes in its Eq. 5, has two wrong signs there and two in
//! Eqs 8-9, and leaves out that the weight acts at the common centre of mass.

use nalgebra::{Matrix3, Vector3};

use super::load::OwnMoments;
use super::rover::Rover;
use super::state::{Acceleration, RoverState};
use crate::contact::WheelForces;
use crate::units::Vec2;

/// Forces of the soil on the rover: their sum [N] in the body frame, and their moment about the
/// body's centre of mass [N·m].
///
/// * `own_moments`: whether the wheels' aligning moments count
#[must_use]
pub fn soil_resultant<'a>(
    rover: &Rover,
    wheels: impl IntoIterator<Item = &'a WheelForces>,
    own_moments: OwnMoments,
) -> (Vec2, f64) {
    let mut force = Vec2::zeros();
    let mut moment = 0.0;
    for (mount, wheel) in rover.mounts().iter().zip(wheels) {
        let wheel_force = mount.body_from_wheel(Vec2::new(wheel.drawbar_pull, wheel.side_force));
        force += wheel_force;
        moment += mount.position.xy().perp(&wheel_force);
        if own_moments == OwnMoments::Included {
            moment += wheel.aligning_moment;
        }
    }
    (force, moment)
}

/// The acceleration under the soil's forces on the wheels and the weight.
///
/// * `pull`: that of the weight, *(G_x, G_y)* of [`slope_pull`](super::load::slope_pull) [N]
/// * `soil`: [`soil_resultant`]
#[must_use]
pub fn acceleration(
    rover: &Rover,
    pull: Vec2,
    state: &RoverState,
    soil: (Vec2, f64),
) -> Acceleration {
    let right_hand_side = right_hand_side(rover, pull, state, soil);
    // m I > |S|² for every rigid body, so the matrix has an inverse.
    let rates = mass_matrix(rover).lu().solve(&right_hand_side).unwrap_or_default();
    Acceleration { velocity_rate: rates.xy(), yaw_acceleration: rates.z }
}

/// The same of a rover whose yaw is held: it turns with a yaw acceleration of its own, for which
/// something gives it the moment that is returned [N·m].
///
/// * `yaw_acceleration`: *γ''* [rad/s²]
#[must_use]
pub fn held_acceleration(
    rover: &Rover,
    pull: Vec2,
    state: &RoverState,
    soil: (Vec2, f64),
    yaw_acceleration: f64,
) -> (Acceleration, f64) {
    let right_hand_side = right_hand_side(rover, pull, state, soil);
    let (m, s) = (rover.mass(), rover.first_moment());
    let x_rate = (right_hand_side.x + s.y * yaw_acceleration) / m;
    let y_rate = (right_hand_side.y - s.x * yaw_acceleration) / m;
    let rates = Vector3::new(x_rate, y_rate, yaw_acceleration);
    let moment = (mass_matrix(rover) * rates - right_hand_side).z;
    (Acceleration { velocity_rate: rates.xy(), yaw_acceleration }, moment)
}

fn mass_matrix(rover: &Rover) -> Matrix3<f64> {
    let (m, s, i) = (rover.mass(), rover.first_moment(), rover.yaw_inertia());
    Matrix3::new(m, 0.0, -s.y, 0.0, m, s.x, -s.y, s.x, i)
}

/// Forces [N] and moment [N·m] of soil and weight, and what turning takes of them.
fn right_hand_side(
    rover: &Rover,
    pull: Vec2,
    state: &RoverState,
    (soil_force, soil_moment): (Vec2, f64),
) -> Vector3<f64> {
    let force = soil_force + pull;
    let moment = soil_moment + rover.centre_of_mass().perp(&pull);
    let (m, s) = (rover.mass(), rover.first_moment());
    let (u, v, rate) = (state.velocity.x, state.velocity.y, state.yaw_rate);
    let turning = Vector3::new(
        m * rate * v + s.x * rate * rate,
        -m * rate * u + s.y * rate * rate,
        -rate * (s.x * u + s.y * v),
    );
    Vector3::new(force.x, force.y, moment) + turning
}
