//! How the weight is shared among the wheels ([FourWheel], Eqs 12-14, with load transfer).
//!
//! The wheels' loads *N* balance the weight's normal part and the moments about the common centre
//! of mass, seen from above:
//!
//! ```text
//! ΣN = m g cos α      Σ d_x N = P      Σ d_y N = R
//! ```
//!
//! with *P* and *R* from [`moments`]. Three equations for more than three wheels leave a rigid
//! chassis indeterminate: of all answers the one of least norm is taken, as a suspension of equal
//! springs would. No load is negative: a wheel that would have to pull has lifted, and the others
//! share. Where no such loads exist the rover tips over its outermost wheels.

use nalgebra::{Matrix3, Rotation2, Vector3};

use super::parts::Mount;
use super::rover::Rover;
use super::state::RoverState;
use crate::contact::WheelForces;
use crate::terrain::{Ground, Patch, Terrain};
use crate::units::Vec2;

/// Load transfer: what moves load from wheel to wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadSharing {
    /// The whole wrench of every wheel: forces at the hubs, with the wheels' torque in pitch and
    /// their overturning moments in roll. It goes with [`OwnMoments::Included`].
    #[default]
    Complete,
    /// The weight's pull along the slope, at the height of the centre of mass, in pitch and roll:
    /// the source paper's.
    QuasiStatic,
    /// The same, but with the wheels' torque in the pitch balance.
    QuasiStaticTorque,
    /// Equal loads.
    Uniform,
}

impl LoadSharing {
    /// Whether the wheels' torque is in the pitch balance.
    #[must_use]
    pub fn has_torque(self) -> bool {
        matches!(self, Self::Complete | Self::QuasiStaticTorque)
    }
}

/// Whether the overturning and aligning moments of the wheels act on the rover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OwnMoments {
    /// They are reported only.
    Neglected,
    /// Overturning moments enter the roll balance, aligning moments the yaw balance.
    #[default]
    Included,
}

/// The weight falls outside the wheels: no loads balance it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the weight falls outside the wheels")]
pub struct Tipping;

/// A weight, in the frame of the ground that it is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// Into the ground [N].
    pub into: f64,
    /// Up the ground's x and y axes [N], against the pull along it.
    pub uphill: Vec2,
}

impl Weight {
    /// A weight [N] on a patch of the ground.
    #[must_use]
    pub fn on(patch: &Patch, weight: f64) -> Self {
        Self { into: weight * patch.normal.z, uphill: weight * patch.climb() }
    }
}

/// The rover's weight on the ground under it.
///
/// * `gravity`: *g* [m/s²]
/// * `slope_from_body`: the rotation of the state
#[must_use]
pub fn weight(
    rover: &Rover,
    ground: &Ground,
    gravity: f64,
    state: &RoverState,
    slope_from_body: &Rotation2<f64>,
) -> Weight {
    let patch = ground.patch(state.position, rover.footprint(slope_from_body));
    Weight::on(&patch, rover.mass() * gravity)
}

/// The weight's pull along the ground, in the body frame, *(G_x, G_y)* [N] ([FourWheel], Eqs 12-13,
/// with the signs it leaves out): on a plane m g sin α points downhill, to −y of the slope frame.
#[must_use]
pub fn slope_pull(rover: &Rover, ground: &Ground, gravity: f64, state: &RoverState) -> Vec2 {
    let slope_from_body = state.slope_from_body();
    pull(&weight(rover, ground, gravity, state, &slope_from_body), &slope_from_body)
}

/// The same of a weight that is known.
pub(super) fn pull(weight: &Weight, slope_from_body: &Rotation2<f64>) -> Vec2 {
    -slope_from_body.inverse_transform_vector(&weight.uphill)
}

/// Moments that the loads balance, *(P, R)* = (Σ d_x N, Σ d_y N) [N·m].
///
/// ```text
/// quasi-static      P = H G_x                          R = H G_y
/// with torque       P = −(H − r_s) ΣF_x − ΣT
/// own moments                                          R = H G_y + r_s ΣF_y − ΣM_x
/// complete          P of the second line, R of the third
/// ```
///
/// The first line puts the wheels' forces into the contact plane; the others take them to the
/// hubs, with the moments that then go with them. Where wheels differ in radius, or are steered by
/// δ, what such a moment has beyond that of a force in the contact plane is turned with its wheel:
///
/// ```text
/// with torque       P = −H ΣF_x − Σ cos δ (T − r_s F_x,w)        R = H G_y − Σ sin δ (T − r_s F_x,w)
/// own moments       P + Σ sin δ (M_x − r_s F_y,w)                R − Σ cos δ (M_x − r_s F_y,w)
/// ```
///
/// * `pull`: that of the weight, *(G_x, G_y)* of [`slope_pull`] [N]
/// * `wheels`: the soil's reactions, or none for the first line
#[must_use]
pub fn moments(
    rover: &Rover,
    pull: Vec2,
    sharing: LoadSharing,
    own_moments: OwnMoments,
    wheels: &[WheelForces],
) -> Vec2 {
    if sharing == LoadSharing::Uniform {
        return Vec2::zeros();
    }
    if wheels.is_empty() {
        return rover.centre_height() * pull;
    }
    let each = rover.mounts().iter().zip(wheels);
    let of_wheels =
        each.map(|(mount, wheel)| moments_of(rover, mount, sharing, own_moments, wheel));
    moments_of_weight(rover, pull, sharing) + of_wheels.sum::<Vec2>()
}

/// Those of the [`moments`] of a rover with its soil's reactions that are the weight's [N·m].
pub(super) fn moments_of_weight(rover: &Rover, pull: Vec2, sharing: LoadSharing) -> Vec2 {
    match sharing {
        LoadSharing::Uniform => Vec2::zeros(),
        _ if sharing.has_torque() => Vec2::new(0.0, rover.centre_height() * pull.y),
        _ => rover.centre_height() * pull,
    }
}

/// Those that are one wheel's [N·m].
pub(super) fn moments_of(
    rover: &Rover,
    mount: &Mount,
    sharing: LoadSharing,
    own_moments: OwnMoments,
    wheel: &WheelForces,
) -> Vec2 {
    let (mut balance, mut excess) = (Vec2::zeros(), Vec2::zeros());
    if sharing == LoadSharing::Uniform {
        return balance;
    }
    let force = Vec2::new(wheel.drawbar_pull, wheel.side_force);
    let radius = mount.shearing_radius();
    if sharing.has_torque() {
        balance.x = -rover.centre_height() * mount.body_from_wheel(force).x;
        excess.y = radius * force.x - wheel.torque;
    }
    if own_moments == OwnMoments::Included {
        excess.x = wheel.overturning_moment - radius * force.y;
    }
    let excess = mount.body_from_wheel(excess);
    balance + Vec2::new(excess.y, -excess.x)
}

/// Loads [N] that balance the weight on the wheels, in the mounts' order.
///
/// * `weight`: the weight's part into the ground, m g cos α [N]
/// * `moments`: *(P, R)* of [`moments`] [N·m]
///
/// # Errors
/// [`Tipping`] if the weight falls outside the wheels.
pub fn wheel_loads(
    rover: &Rover,
    sharing: LoadSharing,
    weight: f64,
    moments: Vec2,
) -> Result<Vec<f64>, Tipping> {
    let arms = rover.load_arms();
    let foot = moments / weight;
    if rover.support_polygon().margin(foot) < 0.0 {
        return Err(Tipping);
    }
    if sharing == LoadSharing::Uniform {
        return Ok(vec![weight / arms.len() as f64; arms.len()]);
    }
    least_norm_loads(arms, foot).map(|shares| shares.iter().map(|share| share * weight).collect())
}

/// Shares of the weight, N = max(0, a + b·d) with a plane (a, b) that makes their sum 1 and their
/// centre the foot of the weight.
///
/// Least norm without negative loads has this form; its plane minimises a convex function whose
/// gradient is the imbalance, which damped Newton steps drive to zero: one step while all wheels
/// stand, a few where some have lifted.
fn least_norm_loads(arms: &[Vec2], foot: Vec2) -> Result<Vec<f64>, Tipping> {
    /// Balance to be reached, as a share of the weight [-].
    const BALANCED: f64 = 1e-13;
    /// With wheels lifted the balance has corners; then this is enough [-].
    const NEARLY_BALANCED: f64 = 1e-8;
    const MOST_STEPS: usize = 200;
    let scale = arms.iter().map(Vec2::norm).fold(0.0, f64::max);
    let rows: Vec<Vector3<f64>> =
        arms.iter().map(|arm| Vector3::new(1.0, arm.x / scale, arm.y / scale)).collect();
    let target = Vector3::new(1.0, foot.x / scale, foot.y / scale);
    let loads_of = |plane: &Vector3<f64>| -> Vec<f64> {
        rows.iter().map(|row| row.dot(plane).max(0.0)).collect()
    };
    let imbalance_of = |loads: &[f64]| {
        rows.iter().zip(loads).map(|(row, load)| row * *load).sum::<Vector3<f64>>() - target
    };
    let objective = |plane: &Vector3<f64>, loads: &[f64]| {
        0.5 * loads.iter().map(|load| load * load).sum::<f64>() - target.dot(plane)
    };

    let mut plane = Vector3::new(1.0 / arms.len() as f64, 0.0, 0.0);
    let mut loads = loads_of(&plane);
    for _ in 0..MOST_STEPS {
        let imbalance = imbalance_of(&loads);
        if imbalance.norm() <= BALANCED {
            break;
        }
        let standing = rows.iter().zip(&loads).filter(|(_, load)| **load > 0.0);
        let curvature: Matrix3<f64> = standing.map(|(row, _)| row * row.transpose()).sum();
        /// Keeps the step finite where the standing wheels are in one line.
        const DAMPING: f64 = 1e-14;
        let damped = curvature + Matrix3::identity() * DAMPING;
        let step = damped.lu().solve(&-imbalance).unwrap_or(-imbalance);
        let before = objective(&plane, &loads);
        let slope = imbalance.dot(&step);
        let mut length = 1.0;
        loop {
            let next = plane + step * length;
            let next_loads = loads_of(&next);
            /// Armijo's condition: a hundredth of the promised descent.
            const DESCENT: f64 = 0.01;
            let rounding = 1e-15 * (1.0 + before.abs());
            let enough = before + DESCENT * length * slope + rounding;
            if objective(&next, &next_loads) <= enough || length < 1e-12 {
                (plane, loads) = (next, next_loads);
                break;
            }
            length *= 0.5;
        }
    }
    if imbalance_of(&loads).norm() <= NEARLY_BALANCED { Ok(loads) } else { Err(Tipping) }
}

#[cfg(test)]
mod tests {
    use super::super::support_polygon::SupportPolygon;
    use super::*;

    fn square() -> Vec<Vec2> {
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec()
    }

    fn check_balance(arms: &[Vec2], foot: Vec2) -> Vec<f64> {
        let loads = least_norm_loads(arms, foot).expect("the foot is inside");
        let sum: f64 = loads.iter().sum();
        let centre: Vec2 = arms.iter().zip(&loads).map(|(arm, load)| arm * *load).sum();
        assert!((sum - 1.0).abs() < 1e-8, "loads {loads:?} sum to {sum}");
        assert!((centre - foot).norm() < 1e-8, "loads {loads:?} centre on {centre}, not {foot}");
        assert!(loads.iter().all(|load| *load >= 0.0), "{loads:?}");
        loads
    }

    #[test]
    fn four_wheels_share_linearly_while_all_stand() {
        let loads = check_balance(&square(), Vec2::new(0.2, 0.1));
        for (load, share) in loads.iter().zip([0.325, 0.225, 0.175, 0.275]) {
            assert!((load - share).abs() < 1e-12);
        }
    }

    #[test]
    fn a_wheel_that_would_pull_lifts_and_the_others_balance() {
        let loads = check_balance(&square(), Vec2::new(0.6, 0.6));
        assert_eq!(loads[2], 0.0);
        assert!((loads[0] - 0.6).abs() < 1e-9);
    }

    #[test]
    fn three_wheels_are_determinate() {
        let arms = [Vec2::new(1.0, 0.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0)];
        let loads = check_balance(&arms, Vec2::new(-0.5, 0.25));
        for (load, share) in loads.iter().zip([0.25, 0.5, 0.25]) {
            assert!((load - share).abs() < 1e-12);
        }
    }

    #[test]
    fn balance_holds_everywhere_inside_the_wheels() {
        let hexagon: Vec<Vec2> =
            (0..6).map(|k| f64::from(k).sin_cos()).map(|(x, y)| Vec2::new(x, 2.0 * y)).collect();
        for arms in [square(), hexagon] {
            let polygon = SupportPolygon::of(&arms);
            for i in -20..=20 {
                for j in -20..=20 {
                    let foot = Vec2::new(f64::from(i), f64::from(j)) * 0.1;
                    if polygon.margin(foot) > 1e-6 {
                        check_balance(&arms, foot);
                    }
                }
            }
        }
    }
}
