//! For which wheels, loads and motions a soil's constants, or a wheel–soil model, are known to
//! hold.
//!
//! A domain computes nothing: [`validity`](crate::contact::validity) flags results outside it.

use crate::error::ParameterError;

/// The range of a quantity; without ends where nothing is stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The smallest value, in SI units.
    pub low: f64,
    /// The largest value, in SI units.
    pub high: f64,
}

impl Span {
    /// Every value: nothing is stated.
    pub const ANY: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// From one value to another.
    #[must_use]
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// Nothing above a value.
    #[must_use]
    pub const fn at_most(high: f64) -> Self {
        Self { high, ..Self::ANY }
    }

    /// Nothing below a value.
    #[must_use]
    pub const fn at_least(low: f64) -> Self {
        Self { low, ..Self::ANY }
    }

    /// What lies in both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// Whether a range is stated.
    #[must_use]
    pub const fn is_stated(self) -> bool {
        self.low > f64::NEG_INFINITY || self.high < f64::INFINITY
    }

    /// Whether a value lies within, but for rounding.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        /// Far above rounding, far below what anyone can measure.
        const ROUNDING: f64 = 1e-9;
        let slack = |end: f64| if end.is_finite() { ROUNDING * end.abs() } else { 0.0 };
        value >= self.low - slack(self.low) && value <= self.high + slack(self.high)
    }
}

/// How many of a soil's values are assumed, of those that each model uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssumedValues {
    /// Number of assumed values that `ishigami` uses.
    pub ishigami: u32,
    /// Number of assumed values that `bekker` uses.
    pub bekker: u32,
    /// Number of assumed values that `small-wheel` uses.
    pub small_wheel: u32,
    /// Number of assumed values that `rft` uses.
    pub rft: u32,
}

impl AssumedValues {
    /// Every value is the source's.
    pub const NONE: Self = Self { ishigami: 0, bekker: 0, small_wheel: 0, rft: 0 };
}

/// The ranges within which constants were measured or fitted, or a model was tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Load on a wheel [N].
    pub load: Span,
    /// Radius of the wheel's rim, *r* [m].
    pub radius: Span,
    /// Width of the wheel, *b* [m].
    pub width: Span,
    /// Sinkage over the shearing radius, h/r_s [-].
    pub depth: Span,
    /// Slip ratio, *s* [-].
    pub slip_ratio: Span,
    /// Size of the slip angle, |*β*| [rad].
    pub slip_angle: Span,
    /// Gravity, *g* [m/s²].
    pub gravity: Span,
    /// How many of the soil's values are assumed, for want of a printed one.
    pub assumed_values: AssumedValues,
}

impl Domain {
    /// Nothing is stated, and nothing assumed.
    pub const UNSTATED: Self = Self {
        load: Span::ANY,
        radius: Span::ANY,
        width: Span::ANY,
        depth: Span::ANY,
        slip_ratio: Span::ANY,
        slip_angle: Span::ANY,
        gravity: Span::ANY,
        assumed_values: AssumedValues::NONE,
    };

    /// Checks that no range ends before it starts.
    ///
    /// # Errors
    /// [`ParameterError`] for the first that does.
    pub fn check(&self) -> Result<(), ParameterError> {
        let ranges = [
            ("load [N]", self.load),
            ("radius [m]", self.radius),
            ("width [m]", self.width),
            ("sinkage over radius", self.depth),
            ("slip ratio", self.slip_ratio),
            ("slip angle [rad]", self.slip_angle),
            ("gravity [m/s²]", self.gravity),
        ];
        for (name, range) in ranges {
            let is_ordered = range.low <= range.high;
            // NaN is in no order.
            if !is_ordered {
                let name = format!("the upper end of the domain's {name}");
                return Err(ParameterError::new(name, range.high, "at least the lower end"));
            }
        }
        Ok(())
    }
}
