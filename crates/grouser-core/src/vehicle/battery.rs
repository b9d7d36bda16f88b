//! The battery, and the electronics that it feeds besides the motors.
//!
//! ```text
//! U_0 = U_empty + (U_full − U_empty) q            open-circuit voltage at the state of charge q
//! P = U I      U = U_0 − R_b I                    power, voltage and current at its terminals
//! E q' = −U_0 I                                   what it gives, with what is lost in it
//! ```
//!
//! Power below 0 is fed back and charges it, until it is full. The smaller of the two currents that
//! give a power flows. No current gives a power above
//! U_0²/(4 R_b): then, and where the voltage falls below that at which the electronics switch off,
//! the rover is without power.

use crate::error::{ParameterError, not_negative, positive};
use crate::stored::stored;

/// A battery, and what the electronics draw from it.
///
/// What is left of 7.4 V at the terminals of a battery of 0.2 Ω from which 10 W are drawn?
///
/// ```
/// use grouser_core::vehicle::Battery;
///
/// let battery = Battery {
///     capacity: 40.0 * 3600.0,
///     full_voltage: 8.4,
///     empty_voltage: 6.4,
///     resistance: 0.2,
///     cutoff_voltage: 6.0,
///     electronics: 2.0,
///     charge: 0.5,
/// };
/// let terminals = battery.under(10.0, 0.5).expect("it gives that");
/// assert_eq!(format!("{:.2} V, {:.2} A", terminals.voltage, terminals.current), "7.12 V, 1.40 A");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    /// Energy that it holds when it is full, *E* [J].
    pub capacity: f64,
    /// Open-circuit voltage when it is full [V].
    pub full_voltage: f64,
    /// Open-circuit voltage when it is empty [V].
    pub empty_voltage: f64,
    /// Internal resistance, *R_b* [Ω].
    pub resistance: f64,
    /// Voltage at the terminals below which the electronics switch off [V].
    pub cutoff_voltage: f64,
    /// Power that the electronics draw all the time [W].
    pub electronics: f64,
    /// State of charge at the start, *q* [-].
    pub charge: f64,
}

/// A battery's terminals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terminals {
    /// Voltage, *U* [V].
    pub voltage: f64,
    /// Current, *I* [A].
    pub current: f64,
}

stored!(struct Terminals { voltage, current });

impl Battery {
    /// Checks that the battery's numbers are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("capacity of a battery [J]", self.capacity)?;
        positive("voltage of a full battery [V]", self.full_voltage)?;
        positive("voltage of an empty battery [V]", self.empty_voltage)?;
        not_negative("internal resistance of a battery [Ω]", self.resistance)?;
        not_negative("voltage at which electronics switch off [V]", self.cutoff_voltage)?;
        not_negative("power of the electronics [W]", self.electronics)?;
        if self.empty_voltage > self.full_voltage {
            let expected = "at most that of the full one";
            let name = "voltage of an empty battery [V]";
            return Err(ParameterError::new(name, self.empty_voltage, expected));
        }
        if !(0.0..=1.0).contains(&self.charge) {
            return Err(ParameterError::new("state of charge", self.charge, "0 to 1"));
        }
        Ok(())
    }

    /// Open-circuit voltage at a state of charge, *U_0* [V].
    #[must_use]
    pub fn open_voltage(&self, charge: f64) -> f64 {
        self.empty_voltage + (self.full_voltage - self.empty_voltage) * charge.clamp(0.0, 1.0)
    }

    /// Its terminals where a power is drawn [W]; none where it cannot give that.
    #[must_use]
    pub fn under(&self, power: f64, charge: f64) -> Option<Terminals> {
        let open = self.open_voltage(charge);
        if self.resistance == 0.0 {
            return Some(Terminals { voltage: open, current: power / open });
        }
        let root = open * open - 4.0 * self.resistance * power;
        if root < 0.0 {
            return None;
        }
        // The smaller current, in the form that loses no digits.
        let current = 2.0 * power / (open + root.sqrt());
        Some(Terminals { voltage: open - self.resistance * current, current })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BATTERY: Battery = Battery {
        capacity: 144e3,
        full_voltage: 8.4,
        empty_voltage: 6.4,
        resistance: 0.2,
        cutoff_voltage: 6.0,
        electronics: 2.0,
        charge: 1.0,
    };

    #[test]
    fn power_is_voltage_times_current_up_to_what_it_can_give() {
        for charge in [0.0, 0.3, 1.0] {
            let most = BATTERY.open_voltage(charge).powi(2) / (4.0 * BATTERY.resistance);
            for power in [0.0, 1.0, 0.5 * most, 0.999 * most] {
                let Terminals { voltage, current } = BATTERY.under(power, charge).expect("it can");
                assert!((voltage * current - power).abs() < 1e-12 * most);
                let drop = BATTERY.open_voltage(charge) - voltage;
                assert!((drop - BATTERY.resistance * current).abs() < 1e-12);
                assert!(voltage >= 0.5 * BATTERY.open_voltage(charge));
            }
            assert_eq!(BATTERY.under(1.001 * most, charge), None);
        }
        let ideal = Battery { resistance: 0.0, ..BATTERY };
        assert_eq!(ideal.under(84.0, 1.0), Some(Terminals { voltage: 8.4, current: 10.0 }));
    }

    #[test]
    fn batteries_that_are_none_are_refused() {
        for wrong in [
            Battery { capacity: 0.0, ..BATTERY },
            Battery { empty_voltage: 9.0, ..BATTERY },
            Battery { resistance: -0.1, ..BATTERY },
            Battery { charge: 1.1, ..BATTERY },
            Battery { electronics: f64::NAN, ..BATTERY },
        ] {
            assert!(wrong.check().is_err(), "{wrong:?}");
        }
        assert_eq!(BATTERY.check(), Ok(()));
    }
}
