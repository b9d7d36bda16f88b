//! How far a rover is from tipping over: the force-angle margin.
//!
//! Seen from the common centre of mass, the outermost points at which wheels touch the ground, *p*,
//! are the corners of a polygon. Each of its edges is an axis about which the rover may tip; the
//! weight *f* passes inside of it by the angle *θ*, and the least of these angles is the margin:
//!
//! ```text
//! a = (p_next − p) / |p_next − p|        l = (1 − a aᵀ) p        g = (1 − a aᵀ) f        θ = −atan2(a · (g × l), g · l)
//! ```
//!
//! On level ground tan θ is half of the track, or of the wheelbase, over the height of the centre
//! of mass. Only the weight counts: a rover on loose soil accelerates by less than a thousandth of
//! it.
//!
//! Source: Papadopoulos and Rey, "A new measure of tipover stability margin for mobile
//! manipulators", ICRA 1996, without their factor of the forces' size.

use super::posture::Posture;
use super::rover::Rover;
use super::statics::centre_of_mass;
use crate::elementary::wide::atan2;
use crate::units::Vec3;

/// The least angle by which the weight may turn before the rover tips over [rad]; negative where it
/// tips.
///
/// * `posture`: in the ground's coordinates
/// * `up`: against gravity, a unit vector in the same
#[must_use]
pub fn stability_margin(rover: &Rover, posture: &Posture, up: Vec3) -> f64 {
    let centre = centre_of_mass(rover, posture);
    let touching = |(wheel, mount): (&super::posture::StandingWheel, &super::parts::Mount)| {
        wheel.hub - mount.shearing_radius() * wheel.normal - centre
    };
    let corners: Vec<Vec3> = posture.wheels.iter().zip(rover.mounts()).map(touching).collect();
    least_angle(&corners, up)
}

/// * `corners`: seen from the centre of mass [m]
fn least_angle(corners: &[Vec3], up: Vec3) -> f64 {
    /// A point so little outside of an edge is on it [m²].
    const ON_EDGE: f64 = 1e-9;
    let mut least = f64::INFINITY;
    for from in corners {
        for to in corners {
            let along = to - from;
            let is_edge = along.norm() > 0.0
                && corners.iter().all(|it| up.dot(&along.cross(&(it - from))) >= -ON_EDGE);
            if is_edge {
                let axis = along.normalize();
                let across = |of: Vec3| of - axis.dot(&of) * axis;
                let (arm, weight) = (across(*from), across(-up));
                least = least.min(-atan2(axis.dot(&weight.cross(&arm)), weight.dot(&arm)));
            }
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Unit};

    use super::*;
    use crate::elementary::wide::atan2;

    /// Wheels 0.36 m apart along the rover and 0.48 m across, 0.2 m below the centre of mass.
    fn corners() -> Vec<Vec3> {
        let at = |(x, y): (f64, f64)| Vec3::new(0.18 * x, 0.24 * y, -0.2);
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(at).to_vec()
    }

    #[test]
    fn on_level_ground_it_is_the_angle_of_the_nearest_edge() {
        let margin = least_angle(&corners(), Vec3::z());
        assert!((margin - atan2(0.18, 0.2)).abs() < 1e-14, "{margin}");
    }

    /// A rover on a slope has so much less, and one turned over its edge a negative margin.
    #[test]
    fn a_slope_takes_its_angle_off() {
        for slope in [0.1, 0.5, 0.8, 1.0] {
            let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(Vec3::y()), slope);
            let corners: Vec<Vec3> = corners().iter().map(|corner| turn * corner).collect();
            let margin = least_angle(&corners, Vec3::z());
            assert!((margin - (atan2(0.18, 0.2) - slope)).abs() < 1e-14, "{slope}: {margin}");
        }
    }

    /// Wheels between others are no corners.
    #[test]
    fn middle_wheels_change_nothing() {
        let mut six = corners();
        six.extend([Vec3::new(0.0, 0.24, -0.2), Vec3::new(0.0, -0.24, -0.2)]);
        let (all, four) = (least_angle(&six, Vec3::z()), least_angle(&corners(), Vec3::z()));
        assert!((all - four).abs() < 1e-14);
    }
}
