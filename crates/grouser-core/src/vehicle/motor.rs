//! The motor of a wheel: a brushed or field-oriented DC motor behind a gear.
//!
//! ```text
//! V   = R i + k N ω                             voltage of the winding
//! τ   = k i − τ_f sgn ω                         torque of the motor's shaft
//! T   = N η τ       where the motor drives      (T ω > 0)
//! T   = N τ / η     where the wheel drives it   (T ω < 0), η > 0
//! P   = V i                                     power that it takes
//! P   = max(V i, 0)                             of one that feeds nothing back
//! ```
//!
//! The torque constant *k* [N·m/A] is the constant of the voltage that turning induces, too
//! [V·s/rad]. A self-locking gear lets no torque of the wheel through to the motor. Power that a
//! driven motor gives is taken back where the motor feeds back, and is lost otherwise.

use super::speed_control::SpeedControl;
use super::winding::Winding;
use crate::error::{ParameterError, not_negative, positive};
use crate::stored::stored;

/// A DC motor behind a gear.
///
/// What does a micro rover's motor take that turns its wheel at 0.55 rad/s against 0.4 N·m?
///
/// ```
/// use grouser_core::vehicle::Motor;
///
/// let motor = Motor {
///     resistance: 10.0,
///     torque_constant: 0.010,
///     gear_ratio: 250.0,
///     efficiency: 0.6,
///     friction: 1e-3,
///     is_self_locking: false,
///     feeds_back: false,
///     control: None,
///     winding: None,
/// };
/// let taken = motor.at(0.4, 0.55);
/// assert_eq!(format!("{:.0} mA at {:.2} V", 1e3 * taken.current, taken.voltage), "367 mA at 5.04 V");
/// assert_eq!(format!("{:.0} mW", 1e3 * taken.power), "1849 mW");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Resistance of the winding and of its leads, *R* [Ω].
    pub resistance: f64,
    /// Torque constant, *k* [N·m/A].
    pub torque_constant: f64,
    /// How often the motor turns while the wheel turns once, *N* [-].
    pub gear_ratio: f64,
    /// Efficiency of the gear, *η* [-], above 0 to 1.
    pub efficiency: f64,
    /// Torque of friction at the motor's shaft, *τ_f* [N·m].
    pub friction: f64,
    /// Whether the wheel cannot turn the gear.
    pub is_self_locking: bool,
    /// Whether braking power is taken back.
    pub feeds_back: bool,
    /// How it keeps its speed under load; without it, always.
    pub control: Option<SpeedControl>,
    /// How warm it becomes, where that is known.
    pub winding: Option<Winding>,
}

/// What a motor takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Electrical {
    /// Current, *i* [A], below 0 where it brakes.
    pub current: f64,
    /// Voltage, *V* [V], of the sign of the speed where it drives.
    pub voltage: f64,
    /// Power [W]; below 0 where it is taken back.
    pub power: f64,
}

stored!(struct Electrical { current, voltage, power });

impl Motor {
    /// Checks that the motor's numbers are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("resistance of a motor [Ω]", self.resistance)?;
        positive("torque constant of a motor [N·m/A]", self.torque_constant)?;
        positive("gear ratio of a motor", self.gear_ratio)?;
        positive("efficiency of a gear", self.efficiency)?;
        not_negative("friction of a motor [N·m]", self.friction)?;
        if self.efficiency > 1.0 {
            let expected = "above 0 and at most 1";
            return Err(ParameterError::new("efficiency of a gear", self.efficiency, expected));
        }
        self.winding.map_or(Ok(()), |winding| winding.check())?;
        let current = self.control.and_then(|control| control.current);
        if current.is_none() && self.winding.is_some_and(|winding| winding.derated_from.is_some()) {
            let expected = "given where a winding derates its motor: that is what becomes less";
            return Err(ParameterError::new("current limit of a motor [A]", 0.0, expected));
        }
        self.control.map_or(Ok(()), |control| control.check())
    }

    /// What it takes to turn a wheel.
    ///
    /// * `torque`: of the wheel, *T* [N·m], positive while it drives the wheel forward
    /// * `wheel_speed`: *ω* [rad/s]
    #[must_use]
    pub fn at(&self, torque: f64, wheel_speed: f64) -> Electrical {
        let current = self.shaft_torque(torque, wheel_speed) / self.torque_constant;
        let induced = self.torque_constant * self.gear_ratio * wheel_speed;
        let voltage = self.resistance * current + induced;
        self.taking(current, voltage)
    }

    /// What it takes by a current [A] under a voltage [V].
    pub(crate) fn taking(&self, current: f64, voltage: f64) -> Electrical {
        let power = voltage * current;
        Electrical { current, voltage, power: if self.feeds_back { power } else { power.max(0.0) } }
    }

    /// Torque on the wheel, *T* [N·m], from the current: the inverse of [`at`](Self::at).
    ///
    /// ```text
    /// τ = k i − τ_f sgn ω      T = N η τ  where the motor drives      T = N τ / η  where the wheel drives it
    /// T = N (k i + τ_f sgn i) / η   where it stands and holds the wheel by its current
    /// ```
    ///
    /// Nothing where the current does not depend on it: through a self-locking gear while the wheel
    /// would drive the motor, and at a wheel that friction or such a gear holds.
    ///
    /// * `current`: *i* [A]
    /// * `wheel_speed`: *ω* [rad/s]
    #[must_use]
    pub fn torque(&self, current: f64, wheel_speed: f64) -> Option<f64> {
        let field = self.torque_constant * current;
        if wheel_speed == 0.0 {
            let is_held = self.is_self_locking || current == 0.0;
            let holding = field + self.friction.copysign(current);
            return (!is_held).then(|| self.gear_ratio * holding / self.efficiency);
        }
        let shaft = field - self.friction.copysign(wheel_speed);
        if shaft * wheel_speed > 0.0 {
            Some(self.gear_ratio * self.efficiency * shaft)
        } else {
            (!self.is_self_locking).then(|| self.gear_ratio * shaft / self.efficiency)
        }
    }

    /// Torque of the magnetic field on the shaft, k i [N·m].
    fn shaft_torque(&self, torque: f64, wheel_speed: f64) -> f64 {
        let at_shaft = torque / self.gear_ratio;
        if wheel_speed == 0.0 {
            // It holds the wheel, and its friction helps.
            let load = if self.is_self_locking { 0.0 } else { at_shaft * self.efficiency };
            return load.signum() * (load.abs() - self.friction).max(0.0);
        }
        let is_driven = torque * wheel_speed < 0.0;
        let load = match is_driven {
            true if self.is_self_locking => 0.0,
            true => at_shaft * self.efficiency,
            false => at_shaft / self.efficiency,
        };
        load + self.friction.copysign(wheel_speed)
    }

    /// Speed at which a voltage turns a wheel against a torque that it drives, *ω* [rad/s]; 0 where
    /// the torque is more than the motor gives.
    ///
    /// * `voltage`: *V* [V], not below 0
    /// * `torque`: *T* [N·m], not below 0
    #[must_use]
    pub fn speed(&self, voltage: f64, torque: f64) -> f64 {
        let shaft = torque / (self.gear_ratio * self.efficiency) + self.friction;
        let left = voltage - self.resistance * shaft / self.torque_constant;
        left.max(0.0) / (self.torque_constant * self.gear_ratio)
    }

    /// Speed of the wheel under a voltage and no load, *ω_0* = (V − R τ_f / k) / (k N) [rad/s].
    #[must_use]
    pub fn no_load_speed(&self, voltage: f64) -> f64 {
        self.speed(voltage, 0.0)
    }

    /// Current of a motor that stands under a voltage, V / R [A].
    #[must_use]
    pub fn stall_current(&self, voltage: f64) -> f64 {
        voltage / self.resistance
    }

    /// Torque on the wheel of a motor that stands under a voltage and is about to turn, N η (k V /
    /// R − τ_f) [N·m]; 0 where its friction is more than that.
    #[must_use]
    pub fn stall_torque(&self, voltage: f64) -> f64 {
        let shaft = self.torque_constant * self.stall_current(voltage) - self.friction;
        self.gear_ratio * self.efficiency * shaft.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOTOR: Motor = Motor {
        resistance: 10.0,
        torque_constant: 0.010,
        gear_ratio: 250.0,
        efficiency: 0.6,
        friction: 1e-3,
        is_self_locking: false,
        feeds_back: false,
        control: None,
        winding: None,
    };

    /// The power goes to the wheel, to the gear, to friction and to heat, and nowhere else.
    #[test]
    fn power_is_what_the_wheel_gets_and_what_is_lost() {
        for (torque, speed) in [(0.4, 0.55), (0.1, -0.0), (-0.3, -0.8), (0.0, 0.5)] {
            let taken = MOTOR.at(torque, speed);
            let heat = MOTOR.resistance * taken.current * taken.current;
            let gear = torque * speed * (1.0 / MOTOR.efficiency - 1.0);
            let friction = MOTOR.friction * MOTOR.gear_ratio * speed.abs();
            let sum = torque * speed + gear + friction + heat;
            assert!((taken.power - sum).abs() < 1e-12, "{torque} N·m, {speed} rad/s: {taken:?}");
        }
    }

    #[test]
    fn speed_is_the_inverse_of_what_a_torque_takes() {
        for torque in [0.0, 0.05, 0.3, 1.0] {
            let voltage = MOTOR.at(torque, 0.55).voltage;
            assert!((MOTOR.speed(voltage, torque) - 0.55).abs() < 1e-12, "{torque} N·m");
        }
        let line = |share: f64| MOTOR.speed(12.0, share * MOTOR.stall_torque(12.0));
        assert!((line(0.0) - MOTOR.no_load_speed(12.0)).abs() < 1e-12);
        assert!((line(0.5) - 0.5 * line(0.0)).abs() < 1e-12, "speed falls in a line");
        assert!(line(1.0).abs() < 1e-12 && line(2.0) == 0.0);
        assert!((MOTOR.no_load_speed(12.0) - (12.0 - 1.0) / 2.5).abs() < 1e-12);
        assert!((MOTOR.stall_torque(12.0) - 150.0 * (0.012 - 0.001)).abs() < 1e-12);
    }

    /// Downhill the wheel drives its motor: less current, of the other sign once friction is
    /// overcome, and none through a self-locking gear but for friction.
    #[test]
    fn a_driven_motor_brakes_and_a_self_locking_one_only_rubs() {
        let braking = MOTOR.at(-0.6, 0.5).current;
        assert!((braking - (-0.6 / 250.0 * 0.6 + 1e-3) / 0.010).abs() < 1e-15 && braking < 0.0);
        let locking = Motor { is_self_locking: true, ..MOTOR };
        assert!((locking.at(-0.6, 0.5).current - 0.1).abs() < 1e-15);
        assert_eq!(
            locking.at(-0.6, 0.0),
            Electrical::default(),
            "it stands on a slope for nothing"
        );
        assert!(MOTOR.at(-0.6, 0.5).power.abs() < 1e-15, "what it gives is not taken back");
    }

    /// What comes back is what the wheel gives, less what the gear takes of it, friction and heat;
    /// a motor that drives takes the same either way.
    #[test]
    fn a_motor_that_feeds_back_gives_what_is_left_of_the_wheels_power() {
        let feeding = Motor { feeds_back: true, ..MOTOR };
        for (torque, speed) in [(-2.0, 3.0), (2.0, -3.0)] {
            let taken = feeding.at(torque, speed);
            let heat = MOTOR.resistance * taken.current * taken.current;
            let friction = MOTOR.friction * MOTOR.gear_ratio * f64::abs(speed);
            let expected = torque * speed * MOTOR.efficiency + friction + heat;
            assert!((taken.power - expected).abs() < 1e-12 && expected < -1.0, "{taken:?}");
            assert_eq!(MOTOR.at(torque, speed), Electrical { power: 0.0, ..taken });
        }
        // Slowly, heat takes all of it.
        assert!(feeding.at(-2.0, 0.05).power > 0.0);
        assert_eq!(feeding.at(0.4, 0.55), MOTOR.at(0.4, 0.55));
    }

    /// The current that a torque takes gives the torque back, forward and backward, driving, driven
    /// and holding.
    #[test]
    fn a_current_gives_the_torque_that_takes_it() {
        for torque in [-0.6, -0.1, -1e-6, 0.0, 1e-6, 0.2, 0.9] {
            for speed in [-0.8, -1e-3, 1e-3, 0.5] {
                let found = MOTOR.torque(MOTOR.at(torque, speed).current, speed);
                let found = found.expect("the wheel reaches the motor");
                assert!((found - torque).abs() < 1e-14, "{torque} N·m, {speed} rad/s: {found} N·m");
            }
        }
        for torque in [-0.9, 0.6] {
            let found = MOTOR.torque(MOTOR.at(torque, 0.0).current, 0.0).expect("it holds");
            assert!((found - torque).abs() < 1e-14, "{torque} N·m held: {found} N·m");
        }
        assert_eq!(MOTOR.torque(MOTOR.at(0.1, 0.0).current, 0.0), None, "friction holds it");
    }

    #[test]
    fn a_self_locking_gear_hides_the_wheel_that_would_drive_it() {
        let locking = Motor { is_self_locking: true, ..MOTOR };
        for (torque, speed) in [(-0.6, 0.5), (0.6, -0.5), (0.3, 0.0)] {
            assert_eq!(locking.torque(locking.at(torque, speed).current, speed), None);
        }
        let found = locking.torque(locking.at(0.3, 0.5).current, 0.5).expect("it drives");
        assert!((found - 0.3).abs() < 1e-14);
    }

    /// A motor that stands holds by friction what its friction can, and pays for the rest.
    #[test]
    fn a_motor_that_holds_is_helped_by_its_friction() {
        let most = MOTOR.friction * MOTOR.gear_ratio / MOTOR.efficiency;
        assert_eq!(MOTOR.at(0.99 * most, 0.0).current, 0.0);
        assert!((MOTOR.at(-2.0 * most, 0.0).current + 0.1).abs() < 1e-12);
    }

    #[test]
    fn motors_that_are_none_are_refused() {
        for wrong in [
            Motor { resistance: 0.0, ..MOTOR },
            Motor { torque_constant: f64::NAN, ..MOTOR },
            Motor { gear_ratio: -1.0, ..MOTOR },
            Motor { efficiency: 1.1, ..MOTOR },
            Motor { friction: f64::INFINITY, ..MOTOR },
        ] {
            assert!(wrong.check().is_err(), "{wrong:?}");
        }
        assert_eq!(MOTOR.check(), Ok(()));
    }
}
