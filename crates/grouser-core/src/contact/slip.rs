//! Slip ratio and slip angle: how a wheel's rim moves against the soil ([FourWheel], Eqs 15-17).

use std::f64::consts::PI;

use crate::elementary::wide::{atan2, hypot, tan};
use crate::stored::stored;
use crate::units::Vec2;

/// A wheel slower than this is at rest [m/s]. Source: ours.
///
/// The models here know only ratios of speeds, so at rest they are undefined, as dry friction
/// is. Below this speed the stresses fade linearly to none. The fastest parked rover therefore
/// creeps at about a micrometre per second, and at the speeds of a rover the effect is 1e-9.
pub const CREEP_SPEED: f64 = 1e-6;

/// Slip ratio, *s* [-]: positive while the rim outruns the hub, negative while it skids.
///
/// ```text
/// s = (ω r_s − v_x) / max(|ω r_s|, |v_x|)            after [FourWheel], Eq. (16)
/// ```
///
/// The source has a driving and a skidding branch, for forward travel only. Dividing by the
/// larger speed joins them; in reverse the sign follows the rim, so *s* > 0 always means that
/// the soil pushes the wheel along +x. |*s*| ≤ 1 while rim and hub move in the same sense, and
/// at most 2 when they oppose each other. A wheel at rest has *s* = 0.
///
/// * `rim_speed`: ω r_s [m/s], with the shearing radius r_s = r + h_g
/// * `hub_velocity`: velocity of the hub [m/s] in the wheel frame (x forward, y left)
#[must_use]
pub fn slip_ratio(rim_speed: f64, hub_velocity: Vec2) -> f64 {
    let v_x = hub_velocity.x;
    let faster = rim_speed.abs().max(v_x.abs());
    (rim_speed - v_x) / hypot(faster, CREEP_SPEED)
}

/// Slip angle, *β* [rad]: positive while the hub moves to the left; −π/2 to π/2.
///
/// ```text
/// β = atan(v_y / |v_x|)                              after [FourWheel], Eq. (17)
/// ```
///
/// The source prints v_y/v_x, which has the wrong sign in reverse. A wheel at rest has *β* = 0.
///
/// * `hub_velocity`: velocity of the hub [m/s] in the wheel frame (x forward, y left)
#[must_use]
pub fn slip_angle(hub_velocity: Vec2) -> f64 {
    atan2(hub_velocity.y, hypot(hub_velocity.x, CREEP_SPEED))
}

/// How a rim moves against the soil, in ratios of speeds: all that a rate-independent model needs.
///
/// The ratios stay finite for every motion: |ω r_s| counts as at least [`CREEP_SPEED`]. For a
/// driving wheel `forward` is 1 − s and `lateral` is (1 − s) tan β; for a braking one `forward` is
/// 1/(1 + s).
///
/// How does a wheel slip whose rim runs at 6 cm/s, while its hub moves 5.4 cm/s forward and 0.5
/// cm/s to the right?
///
/// ```
/// use grouser_core::contact::Slip;
/// use grouser_core::units::Vec2;
///
/// let slip = Slip::of_motion(0.06, Vec2::new(0.054, -0.005));
/// assert_eq!(format!("{:.2}", slip.ratio), "0.10");
/// assert_eq!(format!("{:.1}°", slip.angle.to_degrees()), "-5.3°");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Slip ratio, *s* [-].
    pub ratio: f64,
    /// Slip angle, *β* [rad].
    pub angle: f64,
    /// Sense of the rim, ω r_s / |ω r_s| [-]: 1 rolls forward, −1 backward.
    pub rim: f64,
    /// Hub speed along the wheel over the rim's, v_x / |ω r_s| [-].
    pub forward: f64,
    /// Hub speed across the wheel over the rim's, v_y / |ω r_s| [-].
    pub lateral: f64,
    /// Sense of the hub's motion across the wheel, v_y / |v_y| [-]: 1 to the left, −1 to the right.
    pub sideways: f64,
    /// Which side of the wheel enters the soil [-]: 1 the front, −1 the back.
    ///
    /// Rim and hub agree on it in ordinary rolling. Where they oppose each other it passes from
    /// the rim's sense to the hub's in proportion to their speeds, so that nothing jumps.
    pub entering_side: f64,
}

stored!(struct Slip { ratio, angle, rim, forward, lateral, sideways, entering_side });

impl Slip {
    /// Between this slip and another; senses are those of the nearer one, and so is the angle where
    /// both are more than half a turn apart.
    ///
    /// * `share`: of the way to the other [-]
    #[must_use]
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |from: f64, to: f64| (1.0 - share) * from + share * to;
        let nearer = if share < 0.5 { self } else { other };
        let is_near = (other.angle - self.angle).abs() <= PI;
        Self {
            ratio: between(self.ratio, other.ratio),
            angle: if is_near { between(self.angle, other.angle) } else { nearer.angle },
            rim: nearer.rim,
            forward: between(self.forward, other.forward),
            lateral: between(self.lateral, other.lateral),
            sideways: nearer.sideways,
            entering_side: between(self.entering_side, other.entering_side),
        }
    }

    /// The slip of a moving wheel.
    ///
    /// * `rim_speed`: ω r_s [m/s]
    /// * `hub_velocity`: velocity of the hub [m/s] in the wheel frame (x forward, y left)
    #[must_use]
    pub fn of_motion(rim_speed: f64, hub_velocity: Vec2) -> Self {
        let rim_size = hypot(rim_speed, CREEP_SPEED);
        let v_x = hub_velocity.x;
        Self {
            ratio: slip_ratio(rim_speed, hub_velocity),
            angle: slip_angle(hub_velocity),
            rim: rim_speed / rim_size,
            forward: v_x / rim_size,
            lateral: hub_velocity.y / rim_size,
            sideways: hub_velocity.y / hypot(hub_velocity.y, CREEP_SPEED),
            entering_side: (rim_speed + v_x) / (rim_speed.abs() + v_x.abs()).max(CREEP_SPEED),
        }
    }

    /// The slip of a wheel on a test stand, from the two numbers that are set there.
    ///
    /// The hub travels forward for slip ratios from −1 (locked) to 1 (spinning on the spot);
    /// above 1 it is dragged backward, below −1 the rim turns backward. A slip angle of 90° is
    /// the limit β → 90° at that slip ratio.
    ///
    /// * `slip_ratio`: *s* [-], −2 to 2
    /// * `slip_angle`: *β* [rad], −π/2 to π/2
    #[must_use]
    pub fn on_test_stand(slip_ratio: f64, slip_angle: f64) -> Self {
        let s = slip_ratio;
        // The faster of rim and hub moves at 1 m/s.
        let (rim_speed, v_x) = if s >= 0.0 { (1.0, 1.0 - s) } else { (1.0 + s, 1.0) };
        let v_y = tan(slip_angle) * f64::abs(v_x);
        let motion = Self::of_motion(rim_speed, Vec2::new(v_x, v_y));
        // Spinning on the spot, the motion alone no longer tells the slip angle.
        // And on a stand the smallest slip angle has a side.
        let sideways = if slip_angle == 0.0 { 0.0 } else { slip_angle.signum() };
        Self { ratio: s, angle: slip_angle, sideways, ..motion }
    }

    /// Slip by the total speed, *S* [-]: positive while the rim outruns the hub in any direction.
    ///
    /// ```text
    /// S = (|ω r_s| − V) / max(|ω r_s|, V)      V = √(v_x² + v_y²)      after Pavlov (2024)
    /// ```
    ///
    /// −1 is a locked wheel, 1 one that spins on the spot. Unlike the slip ratio it counts a
    /// wheel pushed sideways as one that skids. A wheel at rest has *S* = 0.
    #[must_use]
    pub fn total(&self) -> f64 {
        let (rim, travel) = (self.rim.abs(), hypot(self.forward, self.lateral));
        (rim - travel) / hypot(rim.max(travel), self.creep())
    }

    /// [`CREEP_SPEED`] over the rim's speed [-]: what keeps ratios finite at rest.
    pub(super) fn creep(&self) -> f64 {
        // rim = ω r_s/√(ω² r_s² + creep²), so the rest of its square is the creep's.
        (1.0 - self.rim * self.rim).max(0.0).sqrt()
    }

    /// How much the wheel is one that enters the soil with its front, and with its back [-]. Each
    /// share by itself, so that a mirrored wheel has the mirrored bits.
    pub(super) fn shares_of_sides(&self) -> (f64, f64) {
        (0.5 * (1.0 + self.entering_side), 0.5 * (1.0 - self.entering_side))
    }

    /// The same motion seen in a mirror that swaps front and back.
    #[must_use]
    pub fn front_to_back(&self) -> Self {
        Self {
            ratio: -self.ratio,
            rim: -self.rim,
            forward: -self.forward,
            entering_side: -self.entering_side,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    fn slip_of(rim_speed: f64, v_x: f64) -> f64 {
        slip_ratio(rim_speed, Vec2::new(v_x, 0.0))
    }

    /// Source: [FourWheel], Eq. (16), both branches.
    #[test]
    fn driving_and_braking_as_printed() {
        assert!((slip_of(1.0, 0.8) - 0.2).abs() < 1e-9);
        assert!((slip_of(0.5, 1.0) + 0.5).abs() < 1e-9);
        assert!((slip_of(0.0, 1.0) + 1.0).abs() < 1e-9);
    }

    #[test]
    fn in_reverse_the_sign_follows_the_rim() {
        assert!((slip_of(-1.0, -0.8) + 0.2).abs() < 1e-9);
        assert!((slip_of(-0.5, -1.0) - 0.5).abs() < 1e-9);
        assert!((slip_of(1.0, -1.0) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_wheel_at_rest_does_not_slip() {
        let rest = Slip::of_motion(0.0, Vec2::zeros());
        assert_eq!((rest.ratio, rest.angle, rest.forward, rest.lateral), (0.0, 0.0, 0.0, 0.0));
    }

    /// Source: the definition of the CMU files (notes), at a slip angle of 60°.
    #[test]
    fn the_total_slip_knows_no_direction() {
        let total = |rim, v_x, v_y| Slip::of_motion(rim, Vec2::new(v_x, v_y)).total();
        let (v_x, v_y) = (0.005, 0.005 * deg(60.0).tan());
        for (rim, expected) in [(0.0, -1.0), (0.005, -0.5), (0.01, 0.0), (0.1, 0.9)] {
            assert!((total(rim, v_x, v_y) - expected).abs() < 1e-6, "{rim}");
            assert!((total(-rim, -v_x, v_y) - expected).abs() < 1e-6, "{rim}");
        }
        assert_eq!(total(0.0, 0.0, 0.0), 0.0);
    }

    #[test]
    fn the_slip_angle_is_positive_to_the_left_both_ways() {
        for v_x in [0.1, -0.1] {
            assert!((slip_angle(Vec2::new(v_x, 0.1)) - deg(45.0)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_entering_side_passes_from_the_rims_to_the_hubs_without_a_jump() {
        let side = |rim, v_x| Slip::of_motion(rim, Vec2::new(v_x, 0.0)).entering_side;
        assert_eq!(side(1.0, 0.5), 1.0);
        assert_eq!(side(-1.0, -0.5), -1.0);
        assert_eq!(side(1.0, -1.0), 0.0);
        assert!((side(1.0, -1e-3) - 1.0).abs() < 3e-3);
        assert!((side(1e-3, -1.0) + 1.0).abs() < 3e-3);
    }
}
