//! Contour traverses with wheels at speeds of their own, which balance what one speed of all wheels
//! cannot.
//!
//! [`heading`](super::heading) balances the forces of a rover whose wheels all turn alike, and
//! leaves the yaw moment: such a rover turns as it goes, unless something holds it. Equal speeds
//! balance it on level ground and, if at all, on single slopes: slip and yaw are two unknowns for
//! three equations. With a speed for each side, or for each wheel, there are enough unknowns for a
//! straight steady motion, all of whose accelerations are zero:
//!
//! ```text
//! ΣF_x = W sin α sin γ        ΣF_y = W sin α cos γ        ΣM_z = 0
//! ```
//!
//! with every hub's velocity along the contour. The speeds of two sides are determined by it; those
//! of wheels are not, and are chosen: for the steepest slope, or for the least work of the motors
//! per metre on a given one. What is found is the best of several searches, and locally so.
//!
//! A steady motion is no stable one: how fast a small error of the yaw grows is part of the answer.

mod balance;
mod motion;
mod search;

pub use self::motion::{SpeedFreedom, StraightMotion, USUAL_RATIO, WheelSpeedStudy};

use self::balance::Balance;
use self::motion::Aim;
use self::search::{Found, best, onto_surface};
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy};
use super::validity::RoverOnSlope;
use crate::contact::validity::Finding;
use crate::error::ParameterError;
use crate::vehicle::Rover;

/// Straight motions of a study, and the curve of headings with equal speeds from which they are
/// sought.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelSpeeds {
    study: WheelSpeedStudy,
    curve: HeadingCurve,
}

impl WheelSpeeds {
    /// Follows the curve of headings with equal speeds.
    ///
    /// # Errors
    /// The same as [`HeadingStudy::curve`], and [`ParameterError`] for a ratio that is not above 1.
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

    /// The straight motion on the steepest slope that was found; `None` if there is none on any
    /// slope.
    #[must_use]
    pub fn steepest(&self, freedom: SpeedFreedom) -> Option<StraightMotion> {
        let balance = Balance::new(&self.study, freedom, Aim::Steepest);
        let starts = self.starts(freedom, &balance);
        let found = starts.into_iter().map(|start| best(&balance, start, f64::INFINITY));
        balance.motion(&the_best(found)?.place)
    }

    /// The straight motion with the least work per metre on a slope [rad] that was found; `None` if
    /// there is none.
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
        /// How far up the slopes of equal speeds searches start: where bounds are narrow, further
        /// down [-].
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

    /// Those with the uphill wheels backward, from a net of guesses: none is near a motion with
    /// equal speeds.
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
        let HeadingStudy { rover, soil, gravity, model, .. } = &self.study.heading;
        let on_slope = RoverOnSlope { rover, soil, zones: None, gravity: *gravity, model, slope };
        on_slope.findings(motion.iter().flat_map(|motion| &motion.wheels))
    }
}

/// The one with the largest value, and of equal ones the first.
fn the_best(all: impl Iterator<Item = Found>) -> Option<Found> {
    all.reduce(|best, other| if other.value > best.value { other } else { best })
}
