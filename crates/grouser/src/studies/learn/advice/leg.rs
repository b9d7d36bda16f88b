//! A leg to drive for what it tells.

/// A leg of a test drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestLeg {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// The way of the rims [m].
    pub way: f64,
}
