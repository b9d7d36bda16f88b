//! What of a drive is compared.

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveQuantity {
    /// Mean slip ratio of the wheels [-].
    SlipRatio,
    /// Way downhill per metre travelled, −sin χ [-]; level ground has none.
    Drift,
    /// Yaw rate [rad/s].
    YawRate,
    /// Mechanical power of all wheels, ΣTω [W].
    Power,
}

impl DriveQuantity {
    /// All of them, in the order of every array that has one value for each.
    pub const ALL: [Self; 4] = [Self::SlipRatio, Self::Drift, Self::YawRate, Self::Power];
}

/// A value of each of [`DriveQuantity::ALL`], in SI units; `None` where there is none.
pub type DriveValues = [Option<f64>; DriveQuantity::ALL.len()];
