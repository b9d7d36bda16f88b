//! What routes are made of.

use crate::studies::mobility::MobilityStudy;
use crate::terrain::SoilZones;
use crate::units::STEEPEST_SLOPE;

/// A sample that is stuck on a metre counts as so much way on top [m]. Source: ours; the order of what is driven to get
/// around a place.
pub const STUCK_WAY: f64 = 100.0;

/// The share of the samples that a risk is the mean of [-]. Source: ours.
pub const WORST_SHARE: f64 = 0.1;

/// What a way is to have least of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Objective {
    /// Time.
    #[default]
    Time,
    /// Work of the wheels.
    Energy,
    /// Time in the worst of the samples.
    Risk,
}

impl Objective {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Time, Self::Energy, Self::Risk];

    /// One word: `time`, `energy`, `risk`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Energy => "energy",
            Self::Risk => "risk",
        }
    }
}

/// Where a way may lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The steepest slope [rad].
    pub most_slope: f64,
    /// The largest slip ratio on the soil as written [-].
    pub most_slip_ratio: f64,
    /// In which share of the samples a place may be a no-go [-].
    pub most_no_go: f64,
}

/// What routes are made of.
#[derive(Clone, Debug)]
pub struct RouteStudy {
    /// Rover, soil, model, rim speed, rule.
    pub mobility: MobilityStudy,
    /// Where a way may lead.
    pub limits: Limits,
    /// Where it may not: any zone of these.
    pub keep_out: Option<SoilZones>,
}

impl Limits {
    /// Those of a study's rule: slip up to its no-go, and as many samples without it as it allows.
    #[must_use]
    pub fn of(study: &MobilityStudy) -> Self {
        Self {
            most_slope: STEEPEST_SLOPE,
            most_slip_ratio: study.rule.no_go_slip_ratio,
            most_no_go: 1.0 - study.rule.no_go_probability,
        }
    }
}
