//! What turns the wheels: constant speeds, the source's slip-dependent law ([FourWheel], Eq. 18),
//! or a limit of slip.

use super::by_wheel::PerWheel;
use super::rover::Rover;
use crate::elementary::wide;
use crate::error::{ParameterError, finite, positive};

/// The drives that a document can name.
///
/// How fast must the rims turn such that a rover that crabs by 5° and slips by 0.2 goes 6 cm/s
/// along the contour?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::units::deg;
/// use grouser_core::vehicle::DriveLaw;
/// use grouser_core::vehicle::drive::SlipTarget;
///
/// let law = DriveLaw::Eq18(SlipTarget { speed: 0.06, slip_ratio: 0.2 });
/// let mut rim_speeds = [0.0; 4];
/// law.rim_speeds(&paper::hakuto()?, deg(5.0), &[0.2; 4], &mut rim_speeds);
/// assert_eq!(format!("{:.1} mm/s", 1e3 * rim_speeds[0]), "74.7 mm/s");
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum DriveLaw {
    /// Every wheel turns at the same rim speed ω r_s [m/s]: what the source's experiments did.
    Constant(f64),
    /// Each wheel has a rim speed of its own [m/s]: reverse, spot turns, skid-steered arcs.
    ConstantEach(Vec<f64>),
    /// ω = v_des / [(1 − (s_ref − s)) r_s cos γ]: Eq. 18 as printed. It turns faster the more the
    /// rover crabs, and meets its target speed at no slip but s_ref = s with v = (1 − s_ref) v_des.
    Eq18AsPrinted(SlipTarget),
    /// ω = v_des cos γ / [(1 − s) r_s], s at most s_ref and a margin: the kinematics Eq. 18 means.
    Eq18(SlipTarget),
    /// The wheels have constant rim speeds, but one that slips more than it may turns slower.
    SlipLimiting(SlipLimit),
}

/// What Eq. 18 is to reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipTarget {
    /// Speed along the contour to be held, *v_des* [m/s].
    pub speed: f64,
    /// Reference slip ratio, *s_ref* [-]; 0.2 in the source.
    pub slip_ratio: f64,
}

/// How fast wheels turn, and how much they may slip.
#[derive(Clone, Debug, PartialEq)]
pub struct SlipLimit {
    /// Rim speed *ω r_s* of wheels that do not slip more than they may [m/s].
    pub speed: PerWheel,
    /// The most that a wheel may slip, *s_max* [-], 0 to below 1.
    pub slip_ratio: f64,
}

/// How far above its reference slip the corrected law still speeds the wheels up [-]. Beyond it a
/// rover that digs in would have to dig faster. Source: ours.
pub const SLIP_MARGIN: f64 = 0.2;

impl DriveLaw {
    /// Checks that the law fits a rover.
    ///
    /// # Errors
    /// [`ParameterError`] for speeds that are not finite, lists of another length than the rover
    /// has wheels, and targets out of range.
    pub fn check(&self, rover: &Rover) -> Result<(), ParameterError> {
        match self {
            Self::Constant(speed) => finite("rim speed [m/s]", *speed),
            Self::ConstantEach(speeds) => Self::check_each(speeds, rover),
            Self::Eq18AsPrinted(target) | Self::Eq18(target) => {
                positive("desired speed [m/s]", target.speed)?;
                below_one("reference slip ratio", target.slip_ratio)
            }
            Self::SlipLimiting(limit) => {
                limit.speed.check("rim speed [m/s]", rover.wheel_count(), finite)?;
                below_one("largest slip ratio", limit.slip_ratio)
            }
        }
    }

    /// Checks that there is a finite rim speed [m/s] for each wheel.
    pub(crate) fn check_each(speeds: &[f64], rover: &Rover) -> Result<(), ParameterError> {
        if speeds.len() != rover.wheel_count() {
            let count = speeds.len() as f64;
            let expected = "one for each wheel of the rover";
            return Err(ParameterError::new("the number of rim speeds", count, expected));
        }
        speeds.iter().try_for_each(|speed| finite("rim speed [m/s]", *speed))
    }

    /// The largest rim speed that the law starts with [m/s], with its sign.
    #[must_use]
    pub fn nominal_rim_speed(&self) -> f64 {
        match self {
            Self::Constant(speed) => *speed,
            Self::ConstantEach(speeds) => fastest(speeds),
            Self::Eq18AsPrinted(target) | Self::Eq18(target) => target.speed,
            Self::SlipLimiting(limit) => fastest(limit.speed.numbers()),
        }
    }

    /// Sets the rim speed ω r_s of each wheel [m/s]. Eq. 18 takes the direction of each wheel, γ +
    /// δ, for the yaw.
    ///
    /// * `crab`: how far the nose is turned off the way that is to be gone [rad]: along the contour
    ///   the yaw, *γ*
    /// * `slip_ratios`: of each wheel when it was last looked at [-]; zeros at the start
    /// * `rim_speeds`: those that were commanded before; zeros at the start
    pub fn rim_speeds(
        &self,
        rover: &Rover,
        crab: f64,
        slip_ratios: &[f64],
        rim_speeds: &mut [f64],
    ) {
        let each = rover.mounts().iter().map(|mount| crab + mount.steering).zip(slip_ratios);
        match self {
            Self::Constant(speed) => rim_speeds.fill(*speed),
            Self::ConstantEach(speeds) => rim_speeds.copy_from_slice(speeds),
            Self::Eq18AsPrinted(target) => {
                for (rim_speed, (crab, s)) in rim_speeds.iter_mut().zip(each) {
                    *rim_speed = eq_18_as_printed(target, *s, crab);
                }
            }
            Self::Eq18(target) => {
                for (rim_speed, (crab, s)) in rim_speeds.iter_mut().zip(each) {
                    *rim_speed = eq_18(target, *s, crab);
                }
            }
            Self::SlipLimiting(limit) => {
                for (wheel, (rim_speed, s)) in rim_speeds.iter_mut().zip(slip_ratios).enumerate() {
                    let wanted = limit.speed.of(wheel);
                    *rim_speed = slip_limited(wanted, *rim_speed, *s, limit.slip_ratio);
                }
            }
        }
    }

    /// Whether the speeds can change during a run.
    #[must_use]
    pub fn varies(&self) -> bool {
        matches!(self, Self::Eq18AsPrinted(_) | Self::Eq18(_) | Self::SlipLimiting(_))
    }
}

/// Smallest divisor in Eq. 18 as printed [-], so that a crab angle of 90° or a skid of s_ref − 1
/// gives a large speed, not an infinite one.
const LEAST_DIVISOR: f64 = 0.05;

/// Rim speed ω r_s [m/s] by [FourWheel], Eq. (18), as printed.
fn eq_18_as_printed(target: &SlipTarget, slip_ratio: f64, crab: f64) -> f64 {
    let s = slip_ratio.clamp(-1.0, 1.0);
    target.speed / ((1.0 - (target.slip_ratio - s)) * wide::cos(crab)).max(LEAST_DIVISOR)
}

/// Rim speed ω r_s [m/s] at which a wheel that slips by s goes v_des along the contour.
///
/// The source divides by cos γ; along the contour v_x = v_des cos γ, so it belongs above the bar.
fn eq_18(target: &SlipTarget, slip_ratio: f64, crab: f64) -> f64 {
    /// However large the reference, some share of the rim's speed must be left to the hub.
    const MOST_SLIP: f64 = 0.95;
    let s = slip_ratio.clamp(0.0, (target.slip_ratio + SLIP_MARGIN).min(MOST_SLIP));
    target.speed * wide::cos(crab) / (1.0 - s)
}

/// A wheel that slips more than it may still turns at this share of what is wanted [-], so that it
/// finds out when its soil holds again. Source: ours.
const LEAST_SHARE: f64 = 0.1;

/// Rim speed ω r_s [m/s] at which a wheel slips by no more than it may, were its hub to go on as it
/// does:
///
/// ```text
/// |ω r_s| ≤ (|ω r_s| − ω r_s s)_before / (1 − s_max)
/// ```
///
/// * `wanted`: what it turns at where that is less [m/s]
/// * `before`: the speed commanded before [m/s]
/// * `slip_ratio`: what it slipped by then [-], below 0 where it drives backward
/// * `most`: *s_max* [-]
#[must_use]
pub fn slip_limited(wanted: f64, before: f64, slip_ratio: f64, most: f64) -> f64 {
    if wanted * before <= 0.0 {
        return wanted;
    }
    let hub = before.abs() - before * slip_ratio;
    let allowed = hub / (1.0 - most);
    allowed.clamp(LEAST_SHARE * wanted.abs(), wanted.abs()).copysign(wanted)
}

/// The speed that is largest, whichever way it turns its wheel [m/s].
fn fastest(speeds: &[f64]) -> f64 {
    speeds.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
}

fn below_one(name: &'static str, ratio: f64) -> Result<(), ParameterError> {
    if (0.0..1.0).contains(&ratio) {
        return Ok(());
    }
    Err(ParameterError::new(name, ratio, "0 to below 1"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    const TARGET: SlipTarget = SlipTarget { speed: 0.06, slip_ratio: 0.2 };

    /// Source: [FourWheel], Eq. (18). DIFFERENCE: none, this is the printed law.
    #[test]
    fn as_printed_the_reference_slip_leaves_the_rim_at_the_target_speed() {
        assert!((eq_18_as_printed(&TARGET, 0.2, 0.0) - 0.06).abs() < 1e-15);
        let at_15_degrees = eq_18_as_printed(&TARGET, 0.2, deg(15.0));
        assert!((at_15_degrees - 0.06 / deg(15.0).cos()).abs() < 1e-15);
    }

    #[test]
    fn corrected_it_reaches_the_target_speed_along_the_contour() {
        for (s, yaw) in [(0.0, 0.0), (0.1, deg(10.0)), (0.35, deg(25.0))] {
            let along_wheel = eq_18(&TARGET, s, yaw) * (1.0 - s);
            assert!((along_wheel / yaw.cos() - 0.06).abs() < 1e-15);
        }
    }

    #[test]
    fn corrected_it_stops_speeding_up_beyond_the_margin() {
        assert_eq!(eq_18(&TARGET, 0.4, 0.0), eq_18(&TARGET, 0.9, 0.0));
    }

    /// Closed form: a hub at 3 cm/s lets a rim turn at 3/(1 - 0.4) = 5 cm/s.
    #[test]
    fn a_wheel_that_slips_more_than_it_may_turns_as_fast_as_its_hub_allows() {
        for side in [1.0, -1.0] {
            let limited = |before, s| slip_limited(side * 0.06, side * before, side * s, 0.4);
            assert!((limited(0.06, 0.5) - side * 0.05).abs() < 1e-15);
            assert!((limited(0.05, 0.4) - side * 0.05).abs() < 1e-15, "it stays there");
            assert_eq!(limited(0.05, 0.1), side * 0.06, "it goes back where the soil holds");
            assert_eq!(limited(0.0, 0.0), side * 0.06, "at the start");
            assert!((limited(0.06, 1.5) - side * 0.006).abs() < 1e-15, "it never stands");
        }
    }
}
