//! What can be wrong with a parameter, and the checks that find it.

/// A parameter that no soil, wheel or rover can have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {}, it must be {expected}", rounded(*value))]
pub struct ParameterError {
    /// The parameter, in the words of the documentation.
    pub name: String,
    /// The value that was given, in SI units.
    pub value: f64,
    /// What would have been allowed.
    pub expected: &'static str,
}

impl ParameterError {
    /// A value that is not what the parameter needs.
    #[must_use]
    pub fn new(name: impl Into<String>, value: f64, expected: &'static str) -> Self {
        Self { name: name.into(), value, expected }
    }
}

/// The value without what rounding left: what was given in degrees has sixteen digits in radians.
fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

/// Finite and above zero, as masses, lengths and stiffnesses are.
///
/// # Errors
/// [`ParameterError`] if it is not.
pub fn positive(name: &str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(ParameterError::new(name, value, "finite and above zero"))
    }
}

/// Finite and not below zero.
///
/// # Errors
/// [`ParameterError`] if it is not.
pub fn not_negative(name: &str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(ParameterError::new(name, value, "finite and not negative"))
    }
}

/// Neither infinite nor NaN.
///
/// # Errors
/// [`ParameterError`] if it is not.
pub fn finite(name: &str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() { Ok(()) } else { Err(ParameterError::new(name, value, "finite")) }
}
