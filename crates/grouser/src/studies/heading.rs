//! The heading offset that holds the contour line on a slope. [FourWheel], Fig. 10, calls it the
//! *attitude*, others the crab angle.
//!
//! A rover that crosses a slope along the contour needs a side force against the weight's pull. It
//! gets it by pointing its nose uphill: with yaw γ and all velocities along the contour, every
//! wheel has the slip angle β = −γ. All wheels turn alike and share one slip ratio s. The contour
//! is held where
//!
//! ```text
//! ΣF_x(s, γ) = W sin α sin γ        ΣF_y(s, γ) = W sin α cos γ
//! ```
//!
//! Wheels may differ: they still share one slip ratio, so that all rims turn at one speed. Wheels
//! that are turned for good have no slip angle in common, and no attitude here.
//!
//! A rover whose wheels are [steered](Steering::Crab) holds the contour with its body along it, γ =
//! 0: it turns its wheels uphill instead of its nose, all by one steering angle δ, the crab angle.
//! Then wheels have the slip angle β = −δ, and the two equations hold along the contour and across
//! it. Rims turn at one speed, so that wheels that are not steered have β = 0 and a slip ratio of
//! their own.
//!
//! The solutions (s, γ, α) form a curve that starts at γ = 0 on level ground. It rises to a
//! steepest slope, where turning further uphill costs as much thrust as it gains, and folds back.
//! The curve is followed by its arc length, so that the fold is a point like any other. The yaw
//! moment is not balanced: it is reported.
//!
//! The ground itself has to stand before a rover crosses it: the curve ends at the latest on the
//! steepest slope that the soil holds by its own strength
//! ([`stable_slope`](crate::soil::Soil::stable_slope)), and [`LimitedBy`] names what ended it.
//!
//! A contour traverse has one course among many. On a course χ, the direction of travel counted
//! from the contour and positive uphill, a rover crabs by c = γ − χ, its wheels have β = −c, and
//! the same two equations hold, at the yaw γ = χ + c. And a rover that does nothing against the
//! slope, with its nose along the contour, drifts: it holds γ = 0 instead of a course, and χ = −c
//! is what becomes of it.

mod bracket;
mod first_rise;
mod gradient;
mod path;
mod study;

use nalgebra::Vector3;

pub use self::gradient::{ChangeableStudy, HeadingDerivatives, StudyWith};
use self::path::{End, Held, JUST_TURNED, Path, Place, Point, Reach};
pub use self::study::{HeadingStudy, STRAIGHT_UP, Steering};
use super::validity::RoverOnSlope;
use crate::contact::validity::Finding;
use crate::elementary::wide;
use crate::error::{ParameterError, finite, positive};
use crate::root;
use crate::simulation::Scenario;
use crate::simulation::power::electrical;
use crate::simulation::scenario::neglected_moments;
use crate::units::STEEPEST_SLOPE;
use crate::vehicle::on_ground::forces_of;
use crate::vehicle::{LoadSharing, Mount, OwnMoments, Rover, WheelReaction, dynamics};

/// The heading offset on a slope and course, with the slip, forces and sinkages in steady motion
/// there. The course 0 is the contour.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingOffset {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Steering angle of every wheel that is steered, *δ* [rad], positive uphill; none where the
    /// body's yaw holds the course.
    pub steering: Option<f64>,
    /// Slip ratio of every wheel, *s* [-]; where wheels are steered, of every one that is.
    pub slip_ratio: f64,
    /// Yaw moment left over about the common centre of mass [N·m]; negative turns the nose
    /// downhill.
    pub yaw_moment: f64,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
    /// How many wheels were settled to find it, beyond those of the curve.
    pub settled_wheels: u64,
}

impl HeadingOffset {
    /// Mean sinkage of the wheels [m].
    #[must_use]
    pub fn mean_sinkage(&self) -> f64 {
        let sum: f64 = self.wheels.iter().map(|wheel| wheel.settled.sinkage).sum();
        sum / self.wheels.len() as f64
    }

    /// Torque of all wheels, ΣT [N·m].
    #[must_use]
    pub fn torque(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.settled.forces.torque).sum()
    }

    /// Crab angle, *c* = γ + δ − χ [rad]: how far the wheels that hold the course point uphill of
    /// it.
    #[must_use]
    pub fn crab(&self) -> f64 {
        self.yaw + self.steering.unwrap_or(0.0) - self.course
    }

    /// Rim speed of every wheel over the rover's speed along its course, cos c / (1 − s) [-], and
    /// with 1 + s instead of the divisor for wheels that brake; c is the [crab angle](Self::crab).
    #[must_use]
    pub fn speed_ratio(&self) -> f64 {
        wide::cos(self.crab()) * self.rim_over_hub()
    }

    fn rim_over_hub(&self) -> f64 {
        let s = self.slip_ratio;
        if s >= 0.0 { 1.0 / (1.0 - s) } else { 1.0 + s }
    }

    /// Work of the wheels per metre of way, ΣT cos c / [(1 − s) r_s] [J/m], and with 1 + s instead
    /// of the divisor for wheels that brake; c is the [crab angle](Self::crab).
    #[must_use]
    pub fn energy_per_metre(&self, rover: &Rover) -> f64 {
        let crab = self.crab();
        let thrust = || {
            let each = self.each_torque(rover);
            each.map(|(mount, torque)| torque / mount.shearing_radius()).sum()
        };
        let thrust: f64 =
            rover.common_radius().map_or_else(thrust, |radius| self.torque() / radius);
        thrust * wide::cos(crab) * self.rim_over_hub()
    }

    /// Drift per metre travelled, −sin χ [m/m]: positive downhill, 0 on a contour traverse.
    #[must_use]
    pub fn drift(&self) -> f64 {
        0.0 - wide::sin(self.course)
    }

    /// Power of the motors at one rim speed ω r_s of all wheels [m/s], ΣT ω [W].
    #[must_use]
    pub fn power(&self, rover: &Rover, rim_speed: f64) -> f64 {
        let of_each = || {
            let each = self.each_torque(rover);
            each.map(|(mount, torque)| torque * rim_speed / mount.shearing_radius()).sum()
        };
        rover.common_radius().map_or_else(of_each, |radius| self.torque() * rim_speed / radius)
    }

    /// Power that the motors that are known draw at one rim speed of all wheels [m/s], with cold
    /// windings, and with a battery the electronics [W]; `None` where no motor is known.
    #[must_use]
    pub fn drawn_power(&self, rover: &Rover, rim_speed: f64) -> Option<f64> {
        let of_motors = self.each_torque(rover).filter_map(|(mount, torque)| {
            Some(electrical(mount, torque, rim_speed / mount.shearing_radius())?.power)
        });
        let electronics = rover.battery().map_or(0.0, |battery| battery.electronics);
        rover.has_motors().then(|| of_motors.sum::<f64>() + electronics)
    }

    /// The torque of each wheel [N·m].
    fn each_torque<'a>(&'a self, rover: &'a Rover) -> impl Iterator<Item = (&'a Mount, f64)> {
        let torques = self.wheels.iter().map(|wheel| wheel.settled.forces.torque);
        rover.mounts().iter().zip(torques)
    }
}

/// Why there is no heading that holds a course on a slope: none holds it, or none was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoHeading {
    /// The rover cannot even drive on level ground.
    #[error("the wheels cannot move the rover on level ground: {0}")]
    CannotMove(String),
    /// The slope is above the steepest that can be crossed.
    /// (The slope is rounded down: on one that is rounded up no heading holds the course.)
    #[error(
        "no heading holds {}: the steepest slope is {:.2}°, {reason}",
        if *.course == 0.0 { "the contour" } else { "this course" },
        (.limit.to_degrees() * 100.0).floor() / 100.0
    )]
    TooSteep {
        /// The course [rad]: 0 along the contour.
        course: f64,
        /// The steepest slope [rad].
        limit: f64,
        /// What ends the curve there.
        reason: String,
    },
    /// The slope is steeper than the ground stands by its own strength.
    #[error(
        "ground-strength: the ground itself stands up to {:.2}° with a factor of safety of \
         {factor_of_safety}",
        (.limit.to_degrees() * 100.0).floor() / 100.0
    )]
    GroundStrength {
        /// The steepest slope on which the ground stands [rad].
        limit: f64,
        /// The factor of safety that was asked of it [-].
        factor_of_safety: f64,
    },
    /// The search gave up: whether a heading holds the course there is not known. A failure of the
    /// computation, and no finding about rover or soil.
    #[error(
        "not found: whether a heading holds {} is not known beyond {:.2}°, {reason}",
        if *.course == 0.0 { "the contour" } else { "this course" },
        (.beyond.to_degrees() * 100.0).floor() / 100.0
    )]
    NotFound {
        /// The course [rad]: 0 along the contour.
        course: f64,
        /// The steepest slope for which a heading was found [rad]; 0 if there is none.
        beyond: f64,
        /// Where the search gave up.
        reason: String,
    },
}

impl NoHeading {
    /// Whether this is a failure of the search, which says nothing about rover and soil.
    #[must_use]
    pub const fn is_not_found(&self) -> bool {
        matches!(self, Self::NotFound { .. })
    }
}

/// What ends a curve of headings at its steepest slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitedBy {
    /// The wheels: on steeper slopes no heading balances the forces.
    Wheels,
    /// The strength of the ground, which would slide by itself.
    GroundStrength,
    /// Neither: the range of slopes that is looked at.
    Range,
    /// The search, which gave up: the limit is only the steepest slope for which a heading was
    /// found.
    NotFound,
}

impl LimitedBy {
    /// One word: `wheels`, `ground-strength`, `range`, `not-found`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wheels => "wheels",
            Self::GroundStrength => "ground-strength",
            Self::Range => "range",
            Self::NotFound => "not-found",
        }
    }
}

/// Slip ratio of a rover that does not move, or holds no course [-].
pub(super) const STUCK: f64 = 1.0;

/// Drift of a rover that slides: straight downhill [m/m].
pub(super) const STRAIGHT_DOWN: f64 = 1.0;

/// Why a curve ends where the ground would slide by itself.
const BEYOND_STRENGTH: &str = "where the ground's own strength ends";

/// The heading offsets of a course, from level ground to the steepest slope.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingCurve {
    study: HeadingStudy,
    held: Held,
    /// Points of the branch, rising; empty if the rover cannot move.
    points: Vec<Point>,
    /// Below this slope the side walls hold the rover without any crab [rad]; 0 where the side-wall
    /// law does not jump.
    held_below: f64,
    end: End,
    settled_wheels: u64,
}

impl HeadingStudy {
    /// The study of a scenario's rover and soil, whatever its slope and drive.
    ///
    /// Which heading offset holds the contour on 10°, and up to which slope is there one?
    ///
    /// ```
    /// use grouser::document::{self, Overrides, Source};
    /// use grouser::studies::heading::HeadingStudy;
    /// use grouser::units::deg;
    ///
    /// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    /// let curve = HeadingStudy::of(&scenario).curve()?;
    /// assert_eq!(format!("{:.2}°", curve.at(deg(10.0))?.yaw.to_degrees()), "5.03°");
    /// assert_eq!(format!("{:.1}°", curve.limit()?.0.to_degrees()), "20.2°");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        Self {
            rover: scenario.rover.clone(),
            soil: scenario.ground.soil,
            gravity: scenario.gravity,
            model: scenario.model.clone(),
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
            stability: scenario.stability,
            steering: Steering::None,
        }
    }

    /// The steepest slope on which the ground stands by its own strength [rad], at most
    /// [`STEEPEST_SLOPE`].
    #[must_use]
    pub fn ground_limit(&self) -> f64 {
        self.soil.stable_slope(self.gravity, self.stability)
    }

    /// Follows the curve of contour traverses from level ground to its end.
    ///
    /// # Errors
    /// [`ParameterError`] if the soil or the gravity is not valid, a wheel is turned for good, or
    /// none is steered where wheels are to hold the course.
    pub fn curve(&self) -> Result<HeadingCurve, ParameterError> {
        self.curve_on(0.0)
    }

    /// Follows the curve of another course, *χ* [rad], −π/2 to π/2, positive uphill.
    ///
    /// # Errors
    /// The same as [`curve`](Self::curve), and [`ParameterError`] for a course out of its range.
    pub fn curve_on(&self, course: f64) -> Result<HeadingCurve, ParameterError> {
        check_course(course)?;
        self.follow(self.held(course), Reach::END)
    }

    /// The first part of the same curve: to its first point that slips more than is asked for. The
    /// points are those of the whole curve, and its limit is the slope of the last of them.
    ///
    /// * `most_slip`: slip ratio [-]
    ///
    /// # Errors
    /// The same as [`curve_on`](Self::curve_on).
    pub(super) fn curve_up_to(
        &self,
        course: f64,
        most_slip: f64,
    ) -> Result<HeadingCurve, ParameterError> {
        check_course(course)?;
        self.follow(self.held(course), Reach { slip_ratio: most_slip, ..Reach::END })
    }

    /// The first part of the same curve, as far as a slope [rad] and no further. Next to the fold,
    /// where a curve's last points come from the search for it, it may differ from the whole curve
    /// by round-off.
    ///
    /// # Errors
    /// The same as [`curve_on`](Self::curve_on).
    pub(super) fn curve_to_slope(
        &self,
        course: f64,
        slope: f64,
    ) -> Result<HeadingCurve, ParameterError> {
        check_course(course)?;
        self.follow(self.held(course), Reach { slope, ..Reach::END })
    }

    /// Finds the heading offset that holds the contour on one slope [rad]. The curve is followed as
    /// far as that slope and no further, next to the fold to round-off.
    ///
    /// # Errors
    /// [`ParameterError`] if the soil or gravity is invalid; [`NoHeading`] within if no heading
    /// holds the contour there.
    pub fn on_slope(&self, slope: f64) -> Result<Result<HeadingOffset, NoHeading>, ParameterError> {
        Ok(self.curve_to_slope(0.0, slope)?.at(slope))
    }

    /// Follows the curve of drift: the nose stays along the contour, γ = 0, and the course turns
    /// downhill with the slope. It ends where no drift holds the rover any more.
    ///
    /// # Errors
    /// The same as [`curve`](Self::curve).
    pub fn drift_curve(&self) -> Result<HeadingCurve, ParameterError> {
        self.drift_curve_along(0.0)
    }

    /// The same with the nose along another course, *γ* [rad], −π/2 to π/2, positive uphill.
    ///
    /// # Errors
    /// The same as [`curve_on`](Self::curve_on).
    pub fn drift_curve_along(&self, yaw: f64) -> Result<HeadingCurve, ParameterError> {
        check_course(yaw)?;
        self.follow(Held::Yaw(yaw), Reach::END)
    }

    /// What is held on a course [rad].
    fn held(&self, course: f64) -> Held {
        match self.steering {
            Steering::None => Held::Course(course),
            Steering::Crab => Held::Body(course),
        }
    }

    /// The curve of a held course or yaw, as far as it is to reach, or to its end.
    fn follow(&self, held: Held, reach: Reach) -> Result<HeadingCurve, ParameterError> {
        let level = self.plane(0.0);
        level.check()?;
        positive("gravity [m/s²]", self.gravity)?;
        self.on_ground(&level).check_soils()?;
        self.stability.check()?;
        if self.sharing == LoadSharing::Complete && self.own_moments == OwnMoments::Neglected {
            return Err(neglected_moments());
        }
        let is_crab = held.is_steered();
        if is_crab && !self.rover.is_steerable() {
            let expected = "one or more where wheels hold the course: `steering_limit_deg` says \
                            how far they turn";
            return Err(ParameterError::new("number of wheels that are steered", 0.0, expected));
        }
        for mount in self.rover.mounts() {
            if mount.steering != 0.0 && !(is_crab && mount.steering_axis.is_some()) {
                let name = format!("steering of wheel {} [rad]", mount.name);
                let expected = "0 where all wheels are to share one slip ratio and one slip angle";
                return Err(ParameterError::new(name, mount.steering, expected));
            }
        }
        let path = Path::new(self, held);
        let (mut points, mut held_below) = (Vec::new(), 0.0);
        let end = match path.start() {
            Err(reason) => reason,
            Ok(start) => {
                held_below = start.place.z;
                points.push(start);
                let slope = reach.slope.min(self.ground_limit());
                path.follow(&mut points, Reach { slope, ..reach })
            }
        };
        let settled_wheels = path.settled_wheels();
        Ok(HeadingCurve { study: self.clone(), held, points, held_below, end, settled_wheels })
    }
}

fn check_course(course: f64) -> Result<(), ParameterError> {
    finite("course [rad]", course)?;
    if course.abs() > STRAIGHT_UP {
        return Err(ParameterError::new("course [rad]", course, "−π/2 to π/2"));
    }
    Ok(())
}

impl HeadingCurve {
    /// The course, *χ* [rad]; of a curve of drift the one it has on level ground.
    #[must_use]
    pub fn course(&self) -> f64 {
        self.held.course(0.0)
    }

    /// What is turned uphill to hold the course.
    #[must_use]
    pub fn steering(&self) -> Steering {
        if self.held.is_steered() { Steering::Crab } else { Steering::None }
    }

    /// How many wheels were settled to follow the curve.
    #[must_use]
    pub fn settled_wheels(&self) -> u64 {
        self.settled_wheels
    }

    /// The steepest slope on which a heading holds the course [rad], and what ends the curve there.
    ///
    /// # Errors
    /// [`NoHeading::CannotMove`] if there is none.
    pub fn limit(&self) -> Result<(f64, &str), NoHeading> {
        let Some(last) = self.points.last() else {
            return Err(match &self.end {
                End::Shown(reason) => NoHeading::CannotMove(reason.clone()),
                End::NotFound(reason) => self.not_found(0.0, reason),
            });
        };
        let ground = self.study.ground_limit();
        Ok(match self.limited_by() {
            Some(LimitedBy::GroundStrength) => (ground, BEYOND_STRENGTH),
            _ => (last.place.z.min(ground), self.end.reason()),
        })
    }

    fn not_found(&self, beyond: f64, reason: &str) -> NoHeading {
        NoHeading::NotFound { course: self.course(), beyond, reason: reason.into() }
    }

    /// What ends the curve at its [`limit`](Self::limit): the wheels, the ground or the search;
    /// nothing where the rover cannot move.
    #[must_use]
    pub fn limited_by(&self) -> Option<LimitedBy> {
        let ground = self.study.ground_limit();
        let Some(last) = self.points.last() else {
            return matches!(self.end, End::NotFound(_)).then_some(LimitedBy::NotFound);
        };
        Some(match self.end {
            End::NotFound(_) if last.place.z < ground => LimitedBy::NotFound,
            _ if last.place.z < ground => LimitedBy::Wheels,
            _ if ground < STEEPEST_SLOPE => LimitedBy::GroundStrength,
            _ => LimitedBy::Range,
        })
    }

    /// The heading offset on a slope [rad].
    ///
    /// # Errors
    /// [`NoHeading`] if no heading holds the course there, or no drift holds the rover.
    pub fn at(&self, slope: f64) -> Result<HeadingOffset, NoHeading> {
        let (point, settled_wheels) = self.point_on(slope)?;
        Ok(self.heading(&point, settled_wheels))
    }

    /// The curve's point on a slope [rad], and how many wheels were settled to find it.
    fn point_on(&self, slope: f64) -> Result<(Point, u64), NoHeading> {
        let (limit, reason) = self.limit()?;
        let (ground, stability) = (self.study.ground_limit(), self.study.stability);
        if slope > ground && ground < STEEPEST_SLOPE {
            let factor_of_safety = stability.factor_of_safety;
            return Err(NoHeading::GroundStrength { limit: ground, factor_of_safety });
        }
        if slope > limit {
            if self.limited_by() == Some(LimitedBy::NotFound) {
                return Err(self.not_found(limit, reason));
            }
            let reason = reason.into();
            return Err(NoHeading::TooSteep { course: self.course(), limit, reason });
        }
        let path = Path::new(&self.study, self.held);
        let point = if slope <= self.held_below {
            let slip_ratio = path.slip_at(0.0, slope).map_err(|end| match end {
                End::Shown(reason) => NoHeading::CannotMove(reason),
                End::NotFound(reason) => self.not_found(0.0, &reason),
            })?;
            let place = Place::new(slip_ratio, 0.0, slope);
            path.point(place).map_err(|error| NoHeading::CannotMove(error.to_string()))?
        } else {
            let above = self.points.partition_point(|point| point.place.z < slope).max(1);
            let high = &self.points[above.min(self.points.len() - 1)];
            let low = &self.points[above - 1];
            path.begin_at(if slope - low.place.z < high.place.z - slope { low } else { high });
            Self::settle_on(&path, slope, low, high)
        };
        Ok((point, path.settled_wheels()))
    }

    /// The curve's point on a slope, between two known ones.
    fn settle_on(path: &Path<'_>, slope: f64, below: &Point, above: &Point) -> Point {
        let (low, high) = (below.place, above.place);
        let share = if high.z > low.z { (slope - low.z) / (high.z - low.z) } else { 1.0 };
        let rise = high.z - low.z;
        let guess = match (Path::per_slope(below), Path::per_slope(above)) {
            (Some(at_low), Some(at_high)) => {
                // The cubic with these ends and slopes (Hermite).
                let (t, u) = (share, 1.0 - share);
                low * (u * u * (1.0 + 2.0 * t))
                    + high * (t * t * (1.0 + 2.0 * u))
                    + (at_low * u - at_high * t) * (rise * t * u)
            }
            _ => low + (high - low) * share,
        };
        let level = Vector3::z();
        let on_slope = Place::new(guess.x, guess.y, slope);
        if let Some(point) = path.correct(&on_slope, &level, &above.gradients) {
            let inside = point.place.y >= low.y.min(high.y) - 1e-9
                && point.place.y <= low.y.max(high.y) + 1e-9;
            if inside {
                return point;
            }
        }
        // Close to the fold the slope no longer determines the point: go by the distance along the
        // curve.
        let Some(chord) = (high - low).try_normalize(f64::MIN_POSITIVE) else {
            return above.clone();
        };
        let along =
            |share: f64| path.correct(&(low + (high - low) * share), &chord, &below.gradients);
        let rise = |share: f64| along(share).map_or(-1.0, |point| point.place.z - slope);
        let nearest = if share < 0.5 { below } else { above };
        along(root::between(rise, 0.0, 1.0, 1e-13)).unwrap_or_else(|| nearest.clone())
    }

    /// The flags of what was found on a slope [rad]; without a heading, those that need no motion.
    #[must_use]
    pub fn findings(&self, slope: f64, found: &Result<HeadingOffset, NoHeading>) -> Vec<Finding> {
        let HeadingStudy { rover, soil, gravity, model, .. } = &self.study;
        let on_slope = RoverOnSlope { rover, soil, zones: None, gravity: *gravity, model, slope };
        on_slope.findings(found.iter().flat_map(|heading| &heading.wheels))
    }

    /// Slope [rad], slip ratio [-] and crab angle [rad] at points along the curve, from level
    /// ground to the steepest slope.
    pub(super) fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().map(|point| [point.place.z, point.place.x, point.place.y])
    }

    /// Points along the curve, from level ground to the steepest slope.
    #[must_use]
    pub fn headings(&self) -> Vec<HeadingOffset> {
        self.points.iter().map(|point| self.heading(point, 0)).collect()
    }

    fn heading(&self, point: &Point, settled_wheels: u64) -> HeadingOffset {
        Self::heading_of(&self.study, self.held, point, settled_wheels)
    }

    fn heading_of(
        study: &HeadingStudy,
        held: Held,
        point: &Point,
        settled_wheels: u64,
    ) -> HeadingOffset {
        let Point { place, wheels, .. } = point;
        let forces = forces_of(wheels);
        let crab = if place.y <= JUST_TURNED { 0.0 } else { place.y };
        let path = Path::new(study, held);
        let rover = path.rover(crab);
        let (force, moment) = dynamics::soil_resultant(&rover, forces, study.own_moments);
        HeadingOffset {
            slope: place.z,
            course: held.course(crab),
            yaw: held.yaw(crab),
            steering: held.is_steered().then_some(crab),
            slip_ratio: place.x,
            yaw_moment: moment - rover.centre_of_mass().perp(&force),
            wheels: wheels.clone(),
            settled_wheels,
        }
    }
}
