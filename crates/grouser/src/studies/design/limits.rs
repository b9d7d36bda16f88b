//! Limits of what is measured of a design.

use grouser_io::design::Measure;

/// A limit of a measure on one of the grounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignLimit {
    /// On which ground, as numbered in
    /// [`RoverChoice::grounds`](grouser_io::design_task::RoverChoice::grounds).
    pub ground: usize,
    /// What is limited.
    pub measure: Measure,
    /// To which side.
    pub side: LimitSide,
    /// The limit, in SI.
    pub bound: f64,
}

/// To which side a measure is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitSide {
    /// It is to be as large or larger.
    AtLeast,
    /// It is to be as small or smaller.
    AtMost,
}

/// What a change of a measure is small against, in its unit: aims and limits are counted in it.
pub(super) const fn size(measure: Measure) -> f64 {
    match measure {
        Measure::LimitSlope | Measure::Crab | Measure::TippingSlope => 5.0,
        Measure::SinkageRatio | Measure::SlipRatio | Measure::Width | Measure::Current => 0.1,
        Measure::EnergyPerMetre => 10.0,
        Measure::Torque | Measure::BrakingTorque | Measure::WheelMass => 1.0,
    }
}

/// The same, in SI.
pub(super) fn size_in_si(measure: Measure) -> f64 {
    measure.unit().to_si(size(measure))
}

impl LimitSide {
    /// Its key in documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AtLeast => "at_least",
            Self::AtMost => "at_most",
        }
    }

    /// One where more is worse, minus one where less is.
    pub(super) const fn sign(self) -> f64 {
        match self {
            Self::AtLeast => -1.0,
            Self::AtMost => 1.0,
        }
    }
}

impl DesignLimit {
    /// Whether a value of its measure, in SI, keeps it but for rounding.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        self.excess(value) <= 1e-6
    }

    pub(super) fn is_of_slope(&self) -> bool {
        self.measure == Measure::LimitSlope
    }

    /// By how much something misses it, over the measure's size; not above 0 where it keeps it.
    pub(super) fn excess(&self, value: f64) -> f64 {
        self.side.sign() * (value - self.bound) / size_in_si(self.measure)
    }
}
