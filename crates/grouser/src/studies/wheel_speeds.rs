//! Contour traverses with wheels at speeds of their own, which balance what one speed of all wheels cannot.
//!
//! [`heading`](super::heading) balances the forces of a rover whose wheels all turn alike, and leaves the yaw moment:
//! such a rover turns as it goes, unless something holds it. Equal speeds balance it on level ground and, if at
//! all, on single slopes: slip and yaw are two unknowns for three equations. With a speed for each side, or for each
//! wheel, there are enough unknowns for a straight steady motion, all of whose accelerations are zero:
//!
//! ```text
//! ΣF_x = W sin α sin γ        ΣF_y = W sin α cos γ        ΣM_z = 0
//! ```
//!
//! with every hub's velocity along the contour. The speeds of two sides are determined by it; those of wheels are
//! not, and are chosen: for the steepest slope, or for the least work of the motors per metre on a given one. What is
//! found is the best of several searches, and locally so.
//!
//! A steady motion is no stable one: how fast a small error of the yaw grows is part of the answer.

mod balance;
mod search;

use self::balance::Balance;
use self::search::{Found, best, onto_surface};
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy};
use super::validity::RoverOnSlope;
use crate::contact::validity::Finding;
use crate::error::ParameterError;
use crate::simulation::Scenario;
use crate::vehicle::{Rover, WheelReaction};

/// Which wheels may turn at a speed of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedFreedom {
    /// Both sides: the wheels of one have one speed.
    BySide,
    /// Every wheel, forward or backward.
    ByWheel,
    /// Every wheel, and those of the uphill side turn backward or stand, as [Mochizuki2024] proposes against drift.
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
/// By how much must the downhill wheels turn faster on 10° such that the nose does not fall, and how much steeper
/// a slope can be crossed?
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

/// The fastest wheel over the mean, unless another is asked for [-]. Source: ours; motors that are geared for one speed
/// have about so much above it.
pub const USUAL_RATIO: f64 = 2.0;

/// A rover that goes straight along the contour, with nothing left over to accelerate or to turn it.
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
enum Aim {
    /// The steepest slope.
    Steepest,
    /// The least work per metre on a slope [rad].
    LeastEnergy(f64),
}

/// Straight motions of a study, and the curve of headings with equal speeds from which they are sought.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelSpeeds {
    study: WheelSpeedStudy,
    curve: HeadingCurve,
}

impl WheelSpeedStudy {
    /// That of a scenario's rover and soil, whatever its slope and drive, with the [usual](USUAL_RATIO) speeds.
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

impl WheelSpeeds {
    /// Follows the curve of headings with equal speeds.
    ///
    /// # Errors
    /// As [`HeadingStudy::curve`], and for a ratio that is not above 1.
    pub fn of(study: WheelSpeedStudy) -> Result<Self, ParameterError> {
        let curve = study.heading.curve()?;
        Self::from(study, curve)
    }

    /// The same with the curve at hand: that of the study.
    ///
    /// # Errors
    /// [`ParameterError`] for a ratio that is not above 1.
    pub fn from(study: WheelSpeedStudy, curve: HeadingCurve) -> Result<Self, ParameterError> {
        let ratio = study.most_ratio;
        if !(ratio > 1.0 && ratio.is_finite()) {
            let name = "ratio of the fastest wheel's speed to the mean";
            return Err(ParameterError::new(name, ratio, "a finite number above 1"));
        }
        Ok(Self { study, curve })
    }

    /// The headings with equal speeds.
    #[must_use]
    pub fn curve(&self) -> &HeadingCurve {
        &self.curve
    }

    /// The rover.
    #[must_use]
    pub fn rover(&self) -> &Rover {
        &self.study.heading.rover
    }

    /// The straight motion on the steepest slope that was found; none where there is none on any.
    #[must_use]
    pub fn steepest(&self, freedom: SpeedFreedom) -> Option<StraightMotion> {
        let balance = Balance::new(&self.study, freedom, Aim::Steepest);
        let starts = self.starts(freedom, &balance);
        let found = starts.into_iter().map(|start| best(&balance, start, f64::INFINITY));
        balance.motion(&the_best(found)?.place)
    }

    /// The straight motion with the least work per metre on a slope [rad] that was found; none where there is none.
    #[must_use]
    pub fn least_energy(&self, freedom: SpeedFreedom, slope: f64) -> Option<StraightMotion> {
        let balance = Balance::new(&self.study, freedom, Aim::LeastEnergy(slope));
        let climb = Balance::new(&self.study, freedom, Aim::Steepest);
        let near = self.curve.at(slope).ok().filter(|_| freedom != SpeedFreedom::UphillReversed);
        let mut starts: Vec<Found> = Vec::new();
        starts.extend(near.and_then(|it| onto_surface(&balance, &self.alike(&balance, &it))));
        if starts.is_empty() {
            // Up from a slope that is less steep, and as many ways as there are.
            starts.extend(self.starts(freedom, &climb).into_iter().filter_map(|start| {
                let mut place = best(&climb, start, slope).place;
                let last = place.len() - 1;
                place[last] = slope;
                onto_surface(&balance, &place)
            }));
        }
        let found = starts.into_iter().map(|start| best(&balance, start, f64::INFINITY));
        balance.motion(&the_best(found)?.place)
    }

    /// Straight motions to search from.
    fn starts(&self, freedom: SpeedFreedom, balance: &Balance<'_>) -> Vec<Found> {
        let wheels = self.study.heading.rover.wheel_count();
        if freedom == SpeedFreedom::UphillReversed {
            return self.reversed_starts(balance);
        }
        /// How far up the slopes of equal speeds searches start: where bounds are narrow, further down [-].
        const SHARES: [f64; 3] = [0.5, 0.1, 0.01];
        /// By how much the unknown of one wheel's speed is larger in a start [-].
        const FASTER: f64 = 0.2;
        let Ok((limit, _)) = self.curve.limit() else { return Vec::new() };
        let from = |share: f64| {
            let Ok(heading) = self.curve.at(share * limit) else { return Vec::new() };
            let alike = self.alike(balance, &heading);
            let faster = |wheel: usize| {
                let mut guess = alike.clone();
                guess[1 + wheel] += FASTER;
                guess
            };
            let each = if freedom == SpeedFreedom::ByWheel { wheels } else { 0 };
            let guesses = [alike.clone()].into_iter().chain((0..each).map(faster));
            guesses.filter_map(|guess| onto_surface(balance, &guess)).collect::<Vec<_>>()
        };
        SHARES.into_iter().map(from).find(|found| !found.is_empty()).unwrap_or_default()
    }

    /// Those with the uphill wheels backward, from a net of guesses: none is near a motion with equal speeds.
    fn reversed_starts(&self, balance: &Balance<'_>) -> Vec<Found> {
        let mounts = self.study.heading.rover.mounts();
        let mean = mounts.iter().map(|mount| mount.position.y).sum::<f64>() / mounts.len() as f64;
        let mut found = Vec::new();
        for slope in [0.03_f64, 0.15, 0.3] {
            for yaw in [-0.8, -0.3, 0.0, 0.3, 0.8] {
                for backward in [0.0, -0.3, -1.0, -3.0] {
                    for forward in [1.1, 1.5, 3.0, 9.0] {
                        let of = |uphill: bool| if uphill { backward } else { forward };
                        let ratios: Vec<f64> =
                            mounts.iter().map(|mount| of(mount.position.y > mean)).collect();
                        let guess = balance.place(yaw, &ratios, slope);
                        found.extend(onto_surface(balance, &guess));
                    }
                }
            }
        }
        found
    }

    /// The unknowns of a rover whose wheels turn alike.
    fn alike(&self, balance: &Balance<'_>, heading: &HeadingOffset) -> search::Place {
        let ratios = vec![heading.speed_ratio(); self.study.heading.rover.wheel_count()];
        balance.place(heading.yaw, &ratios, heading.slope)
    }

    /// The flags of a motion on a slope [rad]; without one, those that need no motion.
    #[must_use]
    pub fn findings(&self, slope: f64, motion: Option<&StraightMotion>) -> Vec<Finding> {
        let HeadingStudy { rover, soil, gravity, theory, .. } = &self.study.heading;
        let on_slope = RoverOnSlope { rover, soil, gravity: *gravity, theory: *theory, slope };
        on_slope.findings(motion.iter().flat_map(|motion| &motion.wheels))
    }
}

/// The one with the largest value, and of equal ones the first.
fn the_best(all: impl Iterator<Item = Found>) -> Option<Found> {
    all.reduce(|best, other| if other.value > best.value { other } else { best })
}
