//! A yaw that is prescribed over time: as it was measured, or as something outside holds it.

use super::times::{LONGEST_DURATION, is_same_time};
use crate::error::{ParameterError, finite};

/// Yaw over time: straight between its points, and constant before the first and after the last.
///
/// A run that has one turns as it says, whatever moments the wheels make: the balance of forces
/// alone decides how the rover moves along and across the slope. The moment that holds the yaw
/// works with the motors in the energy balance.
///
/// How far downhill does a rover drift on 10° whose yaw was seen to go from 5.5° to 3.1° in 20 s?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::{PrescribedYaw, Run, Scenario};
/// use grouser_core::units::deg;
///
/// let points = vec![(0.0, deg(5.5)), (20.0, deg(3.1))];
/// let scenario = Scenario { yaw: Some(PrescribedYaw { points }), ..paper::traverse()? };
/// let end = Run::new(&scenario)?.to_end()?.last().state;
/// assert_eq!(format!("{:.2}°", end.yaw.to_degrees()), "3.10°");
/// assert_eq!(format!("{:.0} mm downhill", -1e3 * end.position.y), "14 mm downhill");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrescribedYaw {
    /// Times [s], rising, and the yaw then, *γ* [rad].
    pub points: Vec<(f64, f64)>,
}

/// The fastest that a rover is taken to turn [rad/s]: 57 °/s. Source: ours; a quarter of a turn in
/// less than two seconds is a slip of the pen, and no rover's.
pub const FASTEST_TURN: f64 = 1.0;

/// Two points that follow each other, between which the yaw changes faster than [`FASTEST_TURN`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooFast {
    /// Time [s] and yaw [rad] of the first.
    pub from: (f64, f64),
    /// Time [s] and yaw [rad] of the second.
    pub to: (f64, f64),
    /// Yaw rate [rad/s].
    pub rate: f64,
}

impl PrescribedYaw {
    /// Checks that the points are a function of time, and that a rover can turn so fast.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        if self.points.is_empty() {
            let expected = "at least 1";
            return Err(ParameterError::new("number of points of the yaw", 0.0, expected));
        }
        for (time, yaw) in &self.points {
            finite("yaw over time [rad]", *yaw)?;
            if !(0.0..=LONGEST_DURATION).contains(time) {
                let expected = "from 0 to a day, 86400 s";
                return Err(ParameterError::new("time of a yaw [s]", *time, expected));
            }
        }
        for pair in self.points.windows(2) {
            if pair[1].0 <= pair[0].0 || is_same_time(pair[1].0, pair[0].0) {
                let expected = "later than the one before it";
                return Err(ParameterError::new("time of a yaw [s]", pair[1].0, expected));
            }
        }
        match self.too_fast() {
            None => Ok(()),
            Some(TooFast { from, to, rate }) => {
                let name = format!("yaw rate between {} s and {} s [rad/s]", from.0, to.0);
                Err(ParameterError::new(name, rate, "at most 1 to either side"))
            }
        }
    }

    /// The first pair of points between which the yaw changes too fast.
    #[must_use]
    pub fn too_fast(&self) -> Option<TooFast> {
        let pairs = self.points.windows(2).map(|pair| {
            let (from, to) = (pair[0], pair[1]);
            TooFast { from, to, rate: (to.1 - from.1) / (to.0 - from.0) }
        });
        pairs.into_iter().find(|pair| pair.rate.abs() > FASTEST_TURN)
    }

    /// The yaw at a time [rad].
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        let later = self.points.partition_point(|point| point.0 < time);
        match (
            later.checked_sub(1).and_then(|before| self.points.get(before)),
            self.points.get(later),
        ) {
            (Some((start, from)), Some((end, to))) => {
                from + (to - from) * ((time - start) / (end - start))
            }
            (Some((_, yaw)), None) | (None, Some((_, yaw))) => *yaw,
            (None, None) => 0.0,
        }
    }

    /// The yaw rate from a time on [rad/s].
    #[must_use]
    pub fn rate_from(&self, time: f64) -> f64 {
        let is_later = |point: &(f64, f64)| point.0 > time && !is_same_time(point.0, time);
        let later = self.points.iter().position(is_later).unwrap_or(self.points.len());
        if later == 0 || later == self.points.len() {
            return 0.0;
        }
        let ((start, from), (end, to)) = (self.points[later - 1], self.points[later]);
        (to - from) / (end - start)
    }

    /// Whether the yaw rate may change at a time.
    pub(super) fn turns_at(&self, time: f64) -> bool {
        self.points.iter().any(|point| is_same_time(point.0, time))
    }

    /// The times after one and before another at which the yaw rate may change [s].
    pub(super) fn turns_between(&self, after: f64, until: f64) -> impl Iterator<Item = f64> {
        let is_between = move |time: &f64| {
            *time > after
                && *time < until
                && !is_same_time(*time, after)
                && !is_same_time(*time, until)
        };
        self.points.iter().map(|point| point.0).filter(is_between)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course() -> PrescribedYaw {
        PrescribedYaw { points: vec![(1.0, 0.2), (3.0, 0.6), (4.0, 0.1)] }
    }

    #[test]
    fn the_yaw_is_straight_between_its_points_and_constant_beyond() {
        let course = course();
        for (time, yaw) in [(0.0, 0.2), (1.0, 0.2), (2.0, 0.4), (3.0, 0.6), (3.5, 0.35), (9.0, 0.1)]
        {
            assert!((course.at(time) - yaw).abs() < 1e-15, "at {time} s: {}", course.at(time));
        }
    }

    #[test]
    fn the_rate_is_that_of_the_stretch_ahead() {
        let course = course();
        for (time, rate) in
            [(0.0, 0.0), (1.0, 0.2), (2.9, 0.2), (3.0, -0.5), (4.0, 0.0), (5.0, 0.0)]
        {
            assert!((course.rate_from(time) - rate).abs() < 1e-15, "from {time} s");
        }
        assert_eq!(course.turns_between(1.0, 4.0).collect::<Vec<_>>(), [3.0]);
        assert!(course.turns_at(3.0) && !course.turns_at(2.0));
    }

    #[test]
    fn a_yaw_that_changes_faster_than_a_rover_turns_is_refused() {
        let of = |rate: f64| {
            let points = vec![(0.0, 0.1), (2.0, 0.1), (2.5, 0.1 + 0.5 * rate)];
            PrescribedYaw { points }
        };
        assert!(of(0.999).check().is_ok() && of(-0.999).check().is_ok());
        for rate in [1.001, -1.001] {
            let error = of(rate).check().expect_err("it is too fast").to_string();
            assert!(error.contains("between 2 s and 2.5 s"), "{error}");
        }
    }

    #[test]
    fn times_that_do_not_rise_and_numbers_that_are_none_are_refused() {
        let of = |points: &[(f64, f64)]| PrescribedYaw { points: points.to_vec() }.check();
        assert!(of(&[(0.0, 0.1)]).is_ok());
        for wrong in [
            &[][..],
            &[(0.0, 0.1), (0.0, 0.2)],
            &[(2.0, 0.1), (1.0, 0.2)],
            &[(-1.0, 0.1)],
            &[(0.0, f64::NAN)],
            &[(f64::INFINITY, 0.1)],
        ] {
            assert!(of(wrong).is_err(), "{wrong:?}");
        }
    }
}
