//! The temperature of a motor's winding, and what it allows.
//!
//! ```text
//! C θ' = R(θ) i² − (θ − θ_0)/R_th        one body, which warms by its current and cools to its surroundings
//! R(θ) = R (1 + α (θ − 20 °C))           α = 0.00393 /K for copper
//! i_max(θ) = i_max (θ_max − θ)/(θ_max − θ_d)      from θ_d on: derating
//! ```
//!
//! A step of current warms it to θ_0 + R i² R_th with the time R_th C, as long as R stays. Source
//! of α: IEC 60028, standard annealed copper at 20 °C.

use crate::elementary::exp;
use crate::error::{ParameterError, finite, positive};

/// How a winding warms, and how warm it may become.
///
/// How warm is a winding of 10 Ω after a minute with 0.4 A, of which 20 K/W and 5 J/K are known?
///
/// ```
/// use grouser_core::vehicle::Winding;
///
/// let winding = Winding {
///     thermal_resistance: 20.0,
///     heat_capacity: 5.0,
///     surroundings: 20.0,
///     highest: 125.0,
///     derated_from: None,
/// };
/// let heat = 10.0 * 0.4 * 0.4;
/// assert_eq!(format!("{:.1} °C", winding.after(20.0, heat, 60.0)), "34.4 °C");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// From the winding to its surroundings, *R_th* [K/W].
    pub thermal_resistance: f64,
    /// Heat capacity, *C* [J/K].
    pub heat_capacity: f64,
    /// Temperature of the surroundings and at the start, *θ_0* [°C].
    pub surroundings: f64,
    /// The highest temperature that it stands, *θ_max* [°C].
    pub highest: f64,
    /// Temperature from which on the most current becomes less, *θ_d* [°C]; without it, it stays.
    pub derated_from: Option<f64>,
}

/// The coldest that there is [°C].
const ABSOLUTE_ZERO: f64 = -273.15;

impl Winding {
    /// Checks that the winding's numbers are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("thermal resistance of a winding [K/W]", self.thermal_resistance)?;
        positive("heat capacity of a winding [J/K]", self.heat_capacity)?;
        finite("temperature around a winding [°C]", self.surroundings)?;
        finite("highest temperature of a winding [°C]", self.highest)?;
        if self.surroundings <= ABSOLUTE_ZERO {
            let (name, expected) = ("temperature around a winding [°C]", "above -273.15");
            return Err(ParameterError::new(name, self.surroundings, expected));
        }
        if let Some(from) = self.derated_from
            && (from.is_nan() || from >= self.highest)
        {
            let name = "temperature from which on a motor is derated [°C]";
            return Err(ParameterError::new(name, from, "below the highest temperature"));
        }
        Ok(())
    }

    /// Its temperature after a while of steady heat [°C].
    ///
    /// * `now`: its temperature [°C]
    /// * `heat`: of the current, R i² [W]
    /// * `span`: how long [s]
    #[must_use]
    pub fn after(&self, now: f64, heat: f64, span: f64) -> f64 {
        let settled = self.surroundings + heat * self.thermal_resistance;
        let faded = exp(-span / (self.thermal_resistance * self.heat_capacity));
        settled + (now - settled) * faded
    }

    /// Share of the most current that it allows [-].
    #[must_use]
    pub fn allowed(&self, temperature: f64) -> f64 {
        let Some(from) = self.derated_from else { return 1.0 };
        ((self.highest - temperature) / (self.highest - from)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDING: Winding = Winding {
        thermal_resistance: 20.0,
        heat_capacity: 5.0,
        surroundings: 20.0,
        highest: 125.0,
        derated_from: Some(105.0),
    };

    /// Closed form: 1 − 1/e of the way after one time constant, whatever the steps.
    #[test]
    fn a_step_of_heat_warms_it_by_its_time_constant() {
        let end = WINDING.surroundings + 2.0 * 20.0;
        let once = WINDING.after(20.0, 2.0, 100.0);
        assert!((once - (end - 40.0 * (-1.0_f64).exp())).abs() < 1e-12);
        let steps = (0..100).fold(20.0, |now, _| WINDING.after(now, 2.0, 1.0));
        assert!((steps - once).abs() < 1e-10);
        assert!((WINDING.after(20.0, 2.0, 1e9) - end).abs() < 1e-12);
    }

    #[test]
    fn derating_takes_the_current_away_in_a_line() {
        let allowed = [20.0, 105.0, 115.0, 125.0, 200.0].map(|at| WINDING.allowed(at));
        assert_eq!(allowed, [1.0, 1.0, 0.5, 0.0, 0.0]);
        assert_eq!(Winding { derated_from: None, ..WINDING }.allowed(500.0), 1.0);
    }

    #[test]
    fn windings_that_are_none_are_refused() {
        for wrong in [
            Winding { thermal_resistance: 0.0, ..WINDING },
            Winding { heat_capacity: -1.0, ..WINDING },
            Winding { surroundings: -300.0, ..WINDING },
            Winding { highest: f64::NAN, ..WINDING },
            Winding { derated_from: Some(130.0), ..WINDING },
        ] {
            assert!(wrong.check().is_err(), "{wrong:?}");
        }
        assert_eq!(WINDING.check(), Ok(()));
    }
}
