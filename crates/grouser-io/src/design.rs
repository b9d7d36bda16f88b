//! The settings of a design's document: what is measured, what is to be least, what is limited.

use super::columns::{ENERGY_PER_METRE, LIMIT_SLOPE, SLIP_RATIO, TORQUE};
use super::unit::{A, DEG, J_PER_M, KG, M, NM, ONE, Unit};
use grouser_core::simulation::Scenario;

/// What is measured of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The steepest slope on which a heading holds the course.
    LimitSlope,
    /// The deepest wheel's sinkage over its shearing radius, h/r_s.
    SinkageRatio,
    /// Slip ratio of the wheels.
    SlipRatio,
    /// Work of the wheels per metre of way.
    EnergyPerMetre,
    /// Crab angle that holds the course.
    Crab,
    /// The largest torque of a wheel.
    Torque,
    /// The largest torque with which a wheel brakes.
    BrakingTorque,
    /// The largest current of a motor.
    Current,
    /// The slope on which the rover at rest tips over, whatever its yaw.
    TippingSlope,
    /// Width of the rover over its wheels.
    Width,
    /// Mass of all wheels.
    WheelMass,
}

/// The ends between which something may be, in SI; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitEnds {
    /// The least that it may be.
    pub least: f64,
    /// The most that it may be.
    pub most: f64,
}

/// What a document says.
#[derive(Clone, Debug)]
pub(crate) struct DesignSettings {
    pub(crate) scenario: Scenario,
    pub(crate) course: f64,
    pub(crate) aim: DesignAim,
    pub(crate) weights: Weights,
    pub(crate) limits: [LimitEnds; Measure::COUNT],
    pub(crate) probability: f64,
}

/// What is to be least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum DesignAim {
    One(Measure),
    WeightedSum,
}

/// What one of each measure, in its unit, counts in a sum.
pub type Weights = [f64; Measure::COUNT];

impl LimitEnds {
    /// No limit.
    pub const NONE: Self = Self { least: f64::NEG_INFINITY, most: f64::INFINITY };
}

impl Measure {
    /// How many there are.
    pub const COUNT: usize = 11;

    /// All of them.
    pub const ALL: [Self; Self::COUNT] = [
        Self::LimitSlope,
        Self::SinkageRatio,
        Self::SlipRatio,
        Self::EnergyPerMetre,
        Self::Crab,
        Self::Torque,
        Self::BrakingTorque,
        Self::Current,
        Self::TippingSlope,
        Self::Width,
        Self::WheelMass,
    ];

    /// Its name in documents and answers.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LimitSlope => LIMIT_SLOPE.name,
            Self::SinkageRatio => "sinkage_ratio",
            Self::SlipRatio => SLIP_RATIO.name,
            Self::EnergyPerMetre => ENERGY_PER_METRE.name,
            Self::Crab => "crab_deg",
            Self::Torque => TORQUE.name,
            Self::BrakingTorque => "braking_torque_nm",
            Self::Current => "current_a",
            Self::TippingSlope => "tipping_slope_deg",
            Self::Width => "width_m",
            Self::WheelMass => "wheel_mass_kg",
        }
    }

    /// What it is.
    #[must_use]
    pub(crate) const fn sentence(self) -> &'static str {
        match self {
            Self::LimitSlope => "The steepest slope on which a heading holds the course.",
            Self::SinkageRatio => "The deepest wheel's sinkage over its shearing radius, h/r_s.",
            Self::SlipRatio => "Slip ratio of the wheels without its sign, |s|.",
            Self::EnergyPerMetre => "Work of the wheels per metre of way.",
            Self::Crab => "Crab angle that holds the course, without its sign.",
            Self::Torque => "The largest torque of a wheel, driving or braking.",
            Self::BrakingTorque => {
                "The largest torque with which a wheel brakes; 0 where all drive."
            }
            Self::Current => "The largest current of a motor that is known, driving or braking.",
            Self::TippingSlope => {
                "The slope on which the rover at rest tips over, at its worst yaw."
            }
            Self::Width => "Width of the rover over its wheels.",
            Self::WheelMass => "Mass of all wheels.",
        }
    }

    /// The same without its full stop.
    #[must_use]
    pub const fn doc(self) -> &'static str {
        match self.sentence().as_bytes() {
            [text @ .., b'.'] => self.sentence().split_at(text.len()).0,
            _ => self.sentence(),
        }
    }

    /// The unit that its name ends with.
    #[must_use]
    pub const fn unit(self) -> Unit {
        match self {
            Self::LimitSlope | Self::Crab | Self::TippingSlope => DEG,
            Self::SinkageRatio | Self::SlipRatio => ONE,
            Self::EnergyPerMetre => J_PER_M,
            Self::Torque | Self::BrakingTorque => NM,
            Self::Current => A,
            Self::Width => M,
            Self::WheelMass => KG,
        }
    }

    /// The measure of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.name() == name)
    }

    /// Whether it is of the rover alone, wherever that drives.
    #[must_use]
    pub const fn is_of_rover(self) -> bool {
        matches!(self, Self::TippingSlope | Self::Width | Self::WheelMass)
    }

    /// Whether more of it is better.
    #[must_use]
    pub const fn is_to_be_large(self) -> bool {
        matches!(self, Self::LimitSlope | Self::TippingSlope)
    }

    /// Its place in [`ALL`](Self::ALL).
    #[must_use]
    pub const fn place(self) -> usize {
        self as usize
    }
}
