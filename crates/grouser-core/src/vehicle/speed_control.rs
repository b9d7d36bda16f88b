//! How fast a motor turns its wheel under load: its speed controller, and its limits of voltage and current.
//!
//! ```text
//! V* = k N ω_0 + K_p (ω_0 − ω) + z                        what the controller asks for, set to the speed ω_0
//! V  = V* within ±V_max and within k N ω ± R i_max        what it gives
//! z' = K_i (ω_0 − ω) + (K_i/K_p) (V − V*)                 its integral, which does not wind up at a limit
//! J ω' = T(i, ω) − T_soil      i = (V − k N ω)/R          the wheel: T as in `motor`
//! ```
//!
//! Without an integral a load leaves an error, the droop: at rest of all others ω = ω_0 − R i/(k N + K_p). With one the
//! error fades with the time K_p/K_i, unless a limit holds. A load that asks for more than the limits allow slows the
//! wheel, until the soil asks for less. The winding's inductance is left out: currents settle within a millisecond.
//! Source of the integral's correction, back-calculation: [AstromHagglund2006].

use super::motor::{Electrical, Motor};
use crate::elementary::wide::hypot;
use crate::error::{ParameterError, not_negative, positive};

/// A speed controller and its limits.
///
/// How much does a wheel slow down under 0.4 N·m that is set to 1.5 rad/s, if nothing is added to the voltage for what is
/// missing, and how much if 20 V are added for each rad/s?
///
/// ```
/// use grouser_core::vehicle::{Motor, MotorLimits, SpeedControl};
///
/// let open = SpeedControl { gain: 0.0, integral: 0.0, voltage: None, current: None };
/// let motor = Motor {
///     resistance: 10.0,
///     torque_constant: 0.010,
///     gear_ratio: 250.0,
///     efficiency: 0.6,
///     friction: 1e-3,
///     is_self_locking: false,
///     control: Some(open),
///     winding: None,
/// };
/// let under_load = |motor: Motor| motor.speed_under(0.4, 1.5, MotorLimits::NONE);
/// assert_eq!(format!("{:.3} rad/s", under_load(motor)), "0.033 rad/s");
/// let control = Some(SpeedControl { gain: 20.0, ..open });
/// assert_eq!(format!("{:.3} rad/s", under_load(Motor { control, ..motor })), "1.337 rad/s");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedControl {
    /// Voltage that it adds for a wheel that is too slow, *K_p* [V·s/rad of the wheel].
    pub gain: f64,
    /// Voltage that it adds for the angle that is missing, *K_i* [V/rad of the wheel]; 0 without an integral.
    pub integral: f64,
    /// The most voltage that it gives, *V_max* [V].
    pub voltage: Option<f64>,
    /// The most current that it gives, *i_max* [A].
    pub current: Option<f64>,
}

/// What a motor may take at most, whatever its own limits: what the battery gives, and what its temperature allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorLimits {
    /// Voltage [V].
    pub voltage: f64,
    /// Current [A].
    pub current: f64,
}

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

impl MotorLimits {
    /// All that it asks for.
    pub const NONE: Self = Self { voltage: f64::INFINITY, current: f64::INFINITY };

    /// The lower of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let (voltage, current) = (other.voltage, other.current);
        Self { voltage: self.voltage.min(voltage), current: self.current.min(current) }
    }
}

impl SpeedControl {
    /// That there can be such a controller.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        not_negative("gain of a speed controller [V·s/rad]", self.gain)?;
        not_negative("integral gain of a speed controller [V/rad]", self.integral)?;
        if self.integral > 0.0 && self.gain == 0.0 {
            let expected = "above zero beside an integral gain";
            return Err(ParameterError::new("gain of a speed controller [V·s/rad]", 0.0, expected));
        }
        self.voltage.map_or(Ok(()), |most| positive("voltage limit of a motor [V]", most))?;
        self.current.map_or(Ok(()), |most| positive("current limit of a motor [A]", most))
    }

    /// Its own limits.
    #[must_use]
    pub fn limits(&self) -> MotorLimits {
        MotorLimits {
            voltage: self.voltage.unwrap_or(f64::INFINITY),
            current: self.current.unwrap_or(f64::INFINITY),
        }
    }
}

/// How much steeper the speed falls beyond the most current than with the winding's resistance alone [-]: so much that a
/// wheel takes less than a thousandth more. Source: ours.
const STEEP: f64 = 1e4;

/// A wheel below this speed all but stands [rad/s]: friction fades to none there. Source: ours, a turn in 17 hours.
const STANDING: f64 = 1e-4;

/// Share of a torque that a self-locking gear lets through from the wheel to the motor [-]. Source: ours: so little that no
/// wheel's load moves a motor.
const LEAKING: f64 = 1e-4;

impl Motor {
    /// Torque and current of a wheel that turns as it does; of a motor without a speed controller, as if it had one without
    /// gain.
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
        let power = (voltage * current).max(0.0);
        Driven {
            torque: self.torque_of(current, speed),
            electrical: Electrical { current, voltage, power },
            integral_rate: corrected,
        }
    }

    /// Torque on a wheel that turns at a speed *ω* [rad/s], from the current [A]. Where the wheel all but stands, friction
    /// and the gear's loss pass from one direction to the other.
    fn torque_of(&self, current: f64, speed: f64) -> f64 {
        let sense = speed / hypot(speed, STANDING);
        let shaft = self.torque_constant * current - self.friction * sense;
        let back = if self.is_self_locking { LEAKING } else { self.efficiency };
        let forward = 0.5 * (1.0 + sense * if shaft < 0.0 { -1.0 } else { 1.0 });
        self.gear_ratio * shaft * (self.efficiency * forward + (1.0 - forward) / back)
    }

    /// What the integral of its controller adds to the voltage in the end, *z* = V − k N ω_0 [V]: what is missing, it has
    /// taken over, and at a limit its correction and what is missing cancel each other.
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

    /// Speed at which it turns a wheel in the end that it is set to turn at *ω_0*, *ω* [rad/s]. It falls with the torque
    /// that the wheel takes, steeply beyond the most current.
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
}

impl SpeedControl {
    /// The voltage of the set speed, whatever the load.
    const OPEN: Self = Self { gain: 0.0, integral: 0.0, voltage: None, current: None };
}
