//! What is sought with wheels at speeds of their own, and what is found.

use super::super::heading::HeadingStudy;
use crate::simulation::Scenario;
use crate::vehicle::WheelReaction;

/// Which wheels may turn at a speed of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedFreedom {
    /// Both sides: the wheels of one have one speed.
    BySide,
    /// Every wheel, forward or backward.
    ByWheel,
    /// Every wheel, and those of the uphill side turn backward or stand, as [Mochizuki2024]
    /// proposes against drift.
    UphillReversed,
}

impl SpeedFreedom {
    /// All.
    pub const ALL: [Self; 3] = [Self::BySide, Self::ByWheel, Self::UphillReversed];

    /// A word or two: `by-side`, `by-wheel`, `uphill-reversed`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BySide => "by-side",
            Self::ByWheel => "by-wheel",
            Self::UphillReversed => "uphill-reversed",
        }
    }
}

/// Finds wheel speeds at which a rover crosses slopes straight along the contour.
///
/// By how much must the downhill wheels turn faster on 10° such that the nose does not fall, and
/// how much steeper a slope can be crossed?
///
/// ```
/// use grouser::document::{self, Overrides, Source};
/// use grouser::studies::heading::HeadingStudy;
/// use grouser::studies::wheel_speeds::{SpeedFreedom, WheelSpeedStudy, WheelSpeeds};
/// use grouser::units::deg;
///
/// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
/// let found = WheelSpeeds::of(WheelSpeedStudy::of(&scenario))?;
/// let on_10 = found.least_energy(SpeedFreedom::BySide, deg(10.0)).expect("there is one");
/// let [uphill, downhill] = [on_10.speed_ratios[0], on_10.speed_ratios[2]];
/// assert_eq!(format!("{:.1} %", 100.0 * (downhill / uphill - 1.0)), "2.4 %");
/// let steepest = found.steepest(SpeedFreedom::ByWheel).expect("there is one");
/// assert_eq!(format!("{:.1}°", steepest.slope.to_degrees()), "20.2°");
/// assert_eq!(format!("{:.1}°", found.curve().limit()?.0.to_degrees()), "20.2°");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WheelSpeedStudy {
    /// Rover, soil, gravity, model and load transfer.
    pub heading: HeadingStudy,
    /// The fastest wheel's speed over the mean of all, both without their signs [-]; above 1.
    pub most_ratio: f64,
}

/// The fastest wheel over the mean, unless another is asked for [-]. Source: ours; motors that are
/// geared for one speed have about so much above it.
pub const USUAL_RATIO: f64 = 2.0;

/// A rover that goes straight along the contour, with nothing left over to accelerate or to turn
/// it.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightMotion {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Rim speed of each wheel over the rover's speed [-], in the mounts' order; negative backward.
    pub speed_ratios: Vec<f64>,
    /// Work of the motors per metre of way [J/m]; wheels that are dragged give nothing back.
    pub energy_per_metre: f64,
    /// How fast a small error of the yaw grows over the way [1/m]; negative where it fades.
    pub yaw_growth: f64,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
}

/// What is best in a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Aim {
    /// The steepest slope.
    Steepest,
    /// The least work per metre on a slope [rad].
    LeastEnergy(f64),
}

impl WheelSpeedStudy {
    /// Returns the study of a scenario's rover and soil, whatever its slope and drive, with the
    /// [usual](USUAL_RATIO) speeds.
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        Self { heading: HeadingStudy::of(scenario), most_ratio: USUAL_RATIO }
    }
}

impl StraightMotion {
    /// Mean slip ratio of the wheels [-].
    #[must_use]
    pub fn slip_ratio(&self) -> f64 {
        self.mean(|wheel| wheel.slip.ratio)
    }

    /// Mean sinkage of the wheels [m].
    #[must_use]
    pub fn mean_sinkage(&self) -> f64 {
        self.mean(|wheel| wheel.settled.sinkage)
    }

    /// Torque of all wheels, ΣT [N·m].
    #[must_use]
    pub fn torque(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.settled.forces.torque).sum()
    }

    fn mean(&self, of: impl Fn(&WheelReaction) -> f64) -> f64 {
        self.wheels.iter().map(of).sum::<f64>() / self.wheels.len() as f64
    }
}
