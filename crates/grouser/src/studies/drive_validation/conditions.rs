//! What a rover met over a stretch, in classes: stretches of one class may be compared.

use std::cmp::Ordering;
use std::f64::consts::PI;

use crate::elementary::wide::{cos, hypot, sin};
use crate::units::Vec2;
use crate::vehicle::Rover;
use crate::vehicle::kinematics::rolling_motion;

/// Slope, yaw, speed and turn of a stretch, each in classes. They follow from what was read of
/// attitude, wheel speeds and steering angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// Slope of the ground, a multiple of 5° [rad].
    pub slope: f64,
    /// Yaw from the contour, a multiple of 45° within half a turn, positive uphill [rad]; `None` on
    /// level ground.
    pub yaw: Option<f64>,
    /// Speed at which the rims would move the rover without slip, to one digit, negative backward
    /// [m/s].
    pub speed: f64,
    /// Radius of the turn on which they would, to one digit, positive to the left of the body [m];
    /// `None` where they would go straight.
    pub radius: Option<f64>,
}

/// A class of slopes [rad]. Source: ours; laboratories tilt their beds in such steps.
const SLOPES: f64 = PI / 36.0;
/// A class of yaws [rad].
const YAWS: f64 = PI / 4.0;
/// A turn is straight whose radius is more than this times the distance of the farthest wheel [-].
/// Source: ours.
const STRAIGHT: f64 = 20.0;
/// A rover that is slower than this has no direction [m/s].
const STANDS: f64 = 1e-4;

impl Conditions {
    pub(super) fn of(rover: &Rover, [slope, yaw]: [f64; 2], rim_speeds: &[f64]) -> Self {
        let (velocity, rate) = rolling_motion(rover.mounts(), rim_speeds);
        let reach = rover.load_arms().iter().map(Vec2::norm).fold(f64::MIN_POSITIVE, f64::max);
        let is_straight = velocity.x.abs() >= STRAIGHT * reach * rate.abs();
        let steps = (slope / SLOPES).round();
        // From 4 down to −3 eighths of a turn.
        let eighths = 4.0 - (4.0 - (yaw / YAWS).round()).rem_euclid(8.0);
        Self {
            slope: steps * SLOPES,
            yaw: (steps > 0.0).then_some(eighths * YAWS),
            speed: to_one_digit(velocity.x),
            radius: (!is_straight).then(|| to_one_digit(velocity.x / rate)),
        }
    }

    /// Drift of a motion: its way downhill per metre travelled, −sin χ [-]; `None` on level ground
    /// and at rest.
    ///
    /// * `yaw`: as it was read, *γ* [rad]
    /// * `forward`, `leftward`: velocity in the body frame [m/s]
    pub(super) fn drift(&self, yaw: f64, forward: f64, leftward: f64) -> Option<f64> {
        let (speed, uphill) = (hypot(forward, leftward), sin(yaw) * forward + cos(yaw) * leftward);
        (self.yaw.is_some() && speed > STANDS).then(|| -uphill / speed)
    }

    /// All four numbers, by which conditions are ordered.
    fn numbers(&self) -> [f64; 4] {
        let none = f64::INFINITY;
        [self.slope, self.yaw.unwrap_or(none), self.radius.unwrap_or(none), self.speed]
    }

    /// By slope, yaw, radius and speed.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let pairs = self.numbers().into_iter().zip(other.numbers());
        pairs.fold(Ordering::Equal, |order, (one, other)| order.then(one.total_cmp(&other)))
    }

    /// The same but for the slope: what interpolation over the slope keeps.
    pub(super) fn but_for_slope(&self) -> Self {
        Self { slope: 0.0, ..*self }
    }
}

/// A number to its first decimal digit.
fn to_one_digit(number: f64) -> f64 {
    // Decimal digits are those of its text.
    format!("{number:.0e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;
    use grouser_io::{Overrides, Source, read_rover};

    fn conditions(attitude: [f64; 2], left: f64, right: f64) -> Conditions {
        let source = Source::find(grouser_io::Kind::Rover, "hakuto").unwrap();
        let rover = read_rover(&source, &Overrides::none()).unwrap().value;
        let rims: Vec<f64> = rover
            .mounts()
            .iter()
            .map(|it| if it.position.y > 0.0 { left } else { right })
            .collect();
        Conditions::of(&rover, attitude.map(deg), &rims)
    }

    #[test]
    fn readings_are_put_into_the_nearest_class() {
        let found = conditions([11.9, -140.0], 0.0512, 0.0508);
        let near = |one: f64, other: f64| (one - other).abs() < 1e-12;
        assert!(near(found.slope, deg(10.0)) && near(found.yaw.unwrap(), deg(-135.0)), "{found:?}");
        assert_eq!((found.speed, found.radius), (0.05, None));
        let back = conditions([2.0, 177.0], -0.1, -0.1);
        assert_eq!((back.slope, back.yaw, back.speed), (0.0, None, -0.1));
        assert!(near(conditions([5.0, -178.0], 0.1, 0.1).yaw.unwrap(), PI));
    }

    /// The tracks are 0.48 m apart: rims at 4 and 6 cm/s go round a centre 1.2 m to the left.
    #[test]
    fn a_turn_has_the_radius_of_its_rims() {
        assert_eq!(conditions([0.0, 0.0], 0.04, 0.06).radius, Some(1.0));
        assert_eq!(conditions([0.0, 0.0], 0.06, 0.04).radius, Some(-1.0));
    }

    /// Along the contour in either direction a slide to the lower side is positive; level ground has
    /// none.
    #[test]
    fn drift_is_positive_downhill() {
        let drift =
            |slope, yaw: f64| conditions([slope, yaw], 0.05, 0.05).drift(deg(yaw), 0.04, -0.03);
        assert!((drift(10.0, 0.0).unwrap() - 0.6).abs() < 1e-12);
        assert!((drift(10.0, 180.0).unwrap() + 0.6).abs() < 1e-12);
        assert_eq!(drift(1.0, 0.0), None);
    }
}
