//! Curves of plates: pressure over sinkage.

/// A plate pressed into the soil.
#[derive(Clone, Debug, PartialEq)]
pub struct PlateCurve {
    /// The smaller side of a rectangular plate, the radius of a round one, *b* [m].
    pub width: f64,
    /// Sinkage [m] and pressure [Pa], as they were read.
    pub points: Vec<PlatePoint>,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatePoint {
    /// Sinkage, *z* [m].
    pub sinkage: f64,
    /// Pressure, *p* [Pa].
    pub pressure: f64,
    /// Standard deviation of the pressure; 0 where it is unknown.
    pub scatter: f64,
}
