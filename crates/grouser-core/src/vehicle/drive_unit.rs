//! A motor under its speed controller: torque, current and speed of its wheel, whatever the load;
//! and with a warm winding.
//!
//! The equations are those of [`speed_control`](super::speed_control), [`motor`](super::motor) and
//! [`winding`](super::winding).

use super::motor::{Electrical, Motor};
use super::speed_control::{MotorLimits, SpeedControl};
use crate::elementary::wide::hypot;

/// A wheel that a motor turns, at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Speed that the motor is set to, *ω_0* [rad/s].
    pub set: f64,
    /// Speed of the wheel, *ω* [rad/s].
    pub speed: f64,
    /// What its controller's integral adds to the voltage, *z* [V].
    pub integral: f64,
}

/// What a motor does at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Torque on the wheel, *T* [N·m].
    pub torque: f64,
    /// What it takes.
    pub electrical: Electrical,
    /// Rate of the integral, *z'* [V/s].
    pub integral_rate: f64,
}

/// Change of copper's resistance with temperature, *α* [1/K].
const COPPER: f64 = 0.003_93;
/// The temperature of a data sheet's resistance [°C].
const REFERENCE: f64 = 20.0;
/// How much steeper the speed falls beyond the most current than with the winding's resistance
/// alone [-]: so much that a wheel takes less than a thousandth more. Source: ours.
const STEEP: f64 = 1e4;

/// A wheel below this speed all but stands [rad/s]: friction fades to none there. Source: ours, a
/// turn in 17 hours.
const STANDING: f64 = 1e-4;

/// Share of a torque that a self-locking gear lets through from the wheel to the motor [-]. Source:
/// ours: so little that no wheel's load moves a motor.
const LEAKING: f64 = 1e-4;

impl Motor {
    /// Torque and current of a wheel that turns as it does; of a motor without a speed controller,
    /// as if it had one without gain.
    ///
    /// * `limits`: besides its own
    #[must_use]
    pub fn driven(&self, drive: Drive, limits: MotorLimits) -> Driven {
        let Drive { set, speed, integral } = drive;
        let control = self.control.unwrap_or(SpeedControl::OPEN);
        let MotorLimits { voltage: most_voltage, current: most } = limits.and(control.limits());
        let constant = self.torque_constant * self.gear_ratio;
        let induced = constant * speed;
        let asked = constant * set + control.gain * (set - speed) + integral;
        let voltage = asked
            .clamp(-most_voltage, most_voltage)
            .clamp(induced - self.resistance * most, induced + self.resistance * most);
        let current = (voltage - induced) / self.resistance;
        let corrected = if control.integral > 0.0 {
            control.integral * (set - speed + (voltage - asked) / control.gain)
        } else {
            0.0
        };
        Driven {
            torque: self.torque_of(current, speed),
            electrical: self.taking(current, voltage),
            integral_rate: corrected,
        }
    }

    /// Torque on a wheel that turns at a speed *ω* [rad/s], from the current [A]. Where the wheel
    /// all but stands, friction and the gear's loss pass from one direction to the other.
    fn torque_of(&self, current: f64, speed: f64) -> f64 {
        let sense = speed / hypot(speed, STANDING);
        let shaft = self.torque_constant * current - self.friction * sense;
        let back = if self.is_self_locking { LEAKING } else { self.efficiency };
        let forward = 0.5 * (1.0 + sense * if shaft < 0.0 { -1.0 } else { 1.0 });
        self.gear_ratio * shaft * (self.efficiency * forward + (1.0 - forward) / back)
    }

    /// What the integral of its controller adds to the voltage in the end, *z* = V − k N ω_0 [V]:
    /// what is missing, it has taken over, and at a limit its correction and what is missing cancel
    /// each other.
    ///
    /// * `torque`: that the wheel takes, *T* [N·m]
    /// * `set`, `speed`: *ω_0* and *ω* [rad/s]
    #[must_use]
    pub fn settled_integral(&self, torque: f64, set: f64, speed: f64) -> f64 {
        if self.control.is_none_or(|control| control.integral == 0.0) {
            return 0.0;
        }
        self.at(torque, speed).voltage - self.torque_constant * self.gear_ratio * set
    }

    /// Speed at which it turns a wheel in the end that it is set to turn at *ω_0*, *ω* [rad/s]. It
    /// falls with the torque that the wheel takes, steeply beyond the most current.
    ///
    /// * `torque`: of the wheel, *T* [N·m], positive while it drives the wheel forward
    /// * `set`: *ω_0* [rad/s]
    /// * `limits`: besides its own
    #[must_use]
    pub fn speed_under(&self, torque: f64, set: f64, limits: MotorLimits) -> f64 {
        let Some(control) = self.control else { return set };
        let MotorLimits { voltage, current: most } = limits.and(control.limits());
        let constant = self.torque_constant * self.gear_ratio;
        let turning = |sense: f64| {
            let current = self.at(torque, sense).current;
            let drop = self.resistance * current;
            let wanted =
                if control.integral > 0.0 { set } else { set - drop / (constant + control.gain) };
            let held = wanted.clamp((-voltage - drop) / constant, (voltage - drop) / constant);
            let excess = (current.abs() - most).max(0.0).copysign(current);
            held - STEEP * self.resistance * excess / constant
        };
        let (forward, backward) = (turning(1.0), turning(-1.0));
        if forward > 0.0 {
            forward
        } else if backward < 0.0 {
            backward
        } else {
            // Friction holds it.
            0.0
        }
    }

    /// The same motor with its winding at a temperature [°C]: its resistance is another.
    #[must_use]
    pub fn at_temperature(&self, temperature: f64) -> Self {
        let factor = (1.0 + COPPER * (temperature - REFERENCE)).max(f64::MIN_POSITIVE);
        Self { resistance: self.resistance * factor, ..*self }
    }
}
