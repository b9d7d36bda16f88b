//! How fast a motor turns its wheel under load: its speed controller, and its limits of voltage and
//! current.
//!
//! ```text
//! V* = k N ω_0 + K_p (ω_0 − ω) + z                        what the controller asks for, set to the speed ω_0
//! V  = V* within ±V_max and within k N ω ± R i_max        what it gives
//! z' = K_i (ω_0 − ω) + (K_i/K_p) (V − V*)                 its integral, which does not wind up at a limit
//! J ω' = T(i, ω) − T_soil      i = (V − k N ω)/R          the wheel: T as in `motor`
//! ```
//!
//! Without an integral a load leaves an error, the droop: at rest of all others
//! ω = ω_0 − R i/(k N + K_p). With one the error fades with the time K_p/K_i, unless a limit holds.
//! A load that asks for more than the limits allow slows the wheel, until the soil asks for less.
//! The winding's inductance is left out: currents settle within a millisecond. Source of the
//! integral's correction, back-calculation: [AstromHagglund2006].

use crate::error::{ParameterError, not_negative, positive};
use crate::stored::stored;

/// A speed controller and its limits.
///
/// How much does a wheel slow down under 0.4 N·m that is set to 1.5 rad/s, if nothing is added to
/// the voltage for what is missing, and how much if 20 V are added for each rad/s?
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
///     feeds_back: false,
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
    /// Voltage that it adds for the angle that is missing, *K_i* [V/rad of the wheel]; 0 without an
    /// integral.
    pub integral: f64,
    /// The most voltage that it gives, *V_max* [V].
    pub voltage: Option<f64>,
    /// The most current that it gives, *i_max* [A].
    pub current: Option<f64>,
}

/// What a motor may take at most, whatever its own limits: what the battery gives, and what its
/// temperature allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorLimits {
    /// Voltage [V].
    pub voltage: f64,
    /// Current [A].
    pub current: f64,
}

stored!(struct MotorLimits { voltage, current });

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
    /// Checks that the controller's numbers are within their ranges.
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

impl SpeedControl {
    /// The voltage of the set speed, whatever the load.
    pub(super) const OPEN: Self = Self { gain: 0.0, integral: 0.0, voltage: None, current: None };
}
