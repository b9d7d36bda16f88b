//! The attitude: the yaw that keeps a traverse level on a slope ([FourWheel], Fig. 10).
//!
//! A rover that crosses a slope along the contour needs a side force against the weight's pull. It
//! gets it by pointing its nose uphill: with yaw γ and all velocities along the contour, every
//! wheel has the slip angle β = −γ. All wheels turn alike and share one slip ratio s. Level means
//!
//! ```text
//! ΣF_x(s, γ) = W sin α sin γ        ΣF_y(s, γ) = W sin α cos γ
//! ```
//!
//! The solutions (s, γ, α) form a curve that starts at γ = 0 on level ground. It rises to a
//! steepest slope, where turning further uphill costs as much thrust as it gains, and folds back.
//! The curve is followed by its arc length, so that the fold is a point like any other. The yaw
//! moment is not balanced: it is reported.

use nalgebra::{Matrix3, Vector3};

use crate::contact::{Slip, Theory};
use crate::error::ParameterError;
use crate::root;
use crate::simulation::Scenario;
use crate::site::Site;
use crate::soil::Soil;
use crate::vehicle::reaction::{Ground, forces_of};
use crate::vehicle::{
    LoadSharing, OwnMoments, ReactionError, Rover, WheelReaction, dynamics, load,
};

/// A rover and its ground, on slopes yet to be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeStudy {
    /// The rover.
    pub rover: Rover,
    /// The soil.
    pub soil: Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The theory.
    pub theory: Theory,
    /// How the weight is shared.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
}

/// A level traverse: a point of the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Attitude {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Slip ratio of every wheel, *s* [-].
    pub slip_ratio: f64,
    /// Yaw moment left over about the common centre of mass [N·m]; negative turns the nose downhill.
    pub yaw_moment: f64,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
}

impl Attitude {
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

    /// Work of the wheels per metre along the contour, ΣT cos γ / [(1 − s) r_s] [J/m].
    #[must_use]
    pub fn energy_per_metre(&self, rover: &Rover) -> f64 {
        let radius = rover.wheel().shearing_radius();
        self.torque() / radius * self.yaw.cos() / (1.0 - self.slip_ratio)
    }
}

/// Why no yaw keeps a traverse level on a slope.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoAttitude {
    /// The rover cannot even drive on level ground.
    #[error("the wheels cannot move the rover on level ground: {0}")]
    CannotMove(String),
    /// The slope is above the steepest that can be crossed.
    /// (The slope is rounded down: one that is rounded up has no attitude.)
    #[error(
        "no level attitude: the steepest slope is {:.2}°, {reason}",
        (.limit.to_degrees() * 100.0).floor() / 100.0
    )]
    TooSteep {
        /// The steepest slope [rad].
        limit: f64,
        /// What ends the curve there.
        reason: String,
    },
}

/// All level traverses from level ground to the steepest slope.
#[derive(Clone, Debug, PartialEq)]
pub struct AttitudeCurve {
    study: AttitudeStudy,
    /// Points of the branch, rising; empty if the rover cannot move.
    points: Vec<Point>,
    /// Below this slope the flank holds the rover without any yaw [rad]; 0 for smooth soils' laws.
    held_below: f64,
    end: String,
}

/// (s, γ, α).
type Point = Vector3<f64>;

/// The steepest slope that is looked at [rad]: 60°. Source: the documents' range.
const STEEPEST: f64 = std::f64::consts::FRAC_PI_3;
/// Longest step along the curve [-, rad].
const LONGEST_STEP: f64 = 0.03;
/// First step along the curve [-, rad].
const FIRST_STEP: f64 = 0.005;
/// A step this short means that the curve ends here [-, rad].
const SHORTEST_STEP: f64 = 1e-7;
/// Force left over, over the weight, below which a traverse counts as level [-].
const BALANCED: f64 = 1e-10;
/// Stands for γ = 0⁺, where a flank law that jumps has its full force [rad].
const JUST_TURNED: f64 = 1e-9;

impl AttitudeStudy {
    /// The study of a scenario's rover and soil, whatever its slope and drive.
    #[must_use]
    pub fn of(scenario: &Scenario) -> Self {
        Self {
            rover: scenario.rover.clone(),
            soil: scenario.site.soil,
            gravity: scenario.site.gravity,
            theory: scenario.theory,
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
        }
    }

    /// Follows the curve from level ground to its end.
    ///
    /// # Errors
    /// [`ParameterError`] if soil or gravity are no such things.
    pub fn curve(&self) -> Result<AttitudeCurve, ParameterError> {
        self.site(0.0).check()?;
        let mut curve = AttitudeCurve {
            study: self.clone(),
            points: Vec::new(),
            held_below: 0.0,
            end: String::new(),
        };
        match self.start() {
            Err(reason) => curve.end = reason,
            Ok(start) => {
                curve.held_below = start.z;
                curve.points.push(start);
                curve.end = self.follow(&mut curve.points);
            }
        }
        Ok(curve)
    }

    fn site(&self, slope: f64) -> Site {
        Site { soil: self.soil, slope, gravity: self.gravity }
    }

    fn reactions(&self, point: &Point) -> Result<Vec<WheelReaction>, ReactionError> {
        let (slip_ratio, yaw, slope) = (point.x, point.y, point.z);
        let slips = vec![Slip::on_test_stand(slip_ratio, -yaw); self.rover.wheel_count()];
        let ground = Ground {
            rover: &self.rover,
            site: &self.site(slope),
            model: self.theory.model(),
            sharing: self.sharing,
            own_moments: self.own_moments,
        };
        ground.reactions(yaw, &slips)
    }

    /// Forces left over, over the weight: along and across the rover [-].
    fn imbalance(&self, point: &Point) -> Result<[f64; 2], ReactionError> {
        let forces = forces_of(&self.reactions(point)?);
        let (soil, _) = dynamics::soil_resultant(&self.rover, &forces, self.own_moments);
        let pull = load::slope_pull(&self.rover, &self.site(point.z), point.y);
        let left_over = (soil + pull) / (self.rover.mass() * self.gravity);
        Ok([left_over.x, left_over.y])
    }

    /// Slip at which the wheels balance the weight along the rover, for a yaw and a slope.
    fn slip_at(&self, yaw: f64, slope: f64) -> Result<f64, String> {
        let pull = |slip_ratio: f64| self.imbalance(&Point::new(slip_ratio, yaw, slope));
        let most = pull(MOST_SLIP).map_err(|error| error.to_string())?[0];
        if most < 0.0 {
            let lacking = -most * self.rover.mass() * self.gravity;
            return Err(format!("even spinning, they lack {lacking:.2} N of thrust"));
        }
        /// In skid the wheels hold the rover back on any slope that they can be driven on.
        const DEEPEST_SKID: f64 = -0.9;
        let thrust = |slip_ratio: f64| pull(slip_ratio).map_or(-1.0, |left_over| left_over[0]);
        Ok(root::between(thrust, DEEPEST_SKID, MOST_SLIP, 1e-13))
    }

    /// The curve's first point, at γ = 0⁺: slip and slope that balance there.
    fn start(&self) -> Result<Point, String> {
        let mut slope = 0.0;
        for _ in 0..ROUNDS {
            let slip_ratio = self.slip_at(JUST_TURNED, slope)?;
            let point = Point::new(slip_ratio, JUST_TURNED, slope);
            let left_over = self.imbalance(&point).map_err(|error| error.to_string())?[1];
            if left_over.abs() < BALANCED {
                return Ok(point);
            }
            slope = (slope.sin() + left_over).clamp(0.0, STEEPEST.sin()).asin();
        }
        Err("the start of the curve was not found".into())
    }

    /// Follows the curve from its one point until it folds or ends; says what ended it.
    fn follow(&self, points: &mut Vec<Point>) -> String {
        let mut tangent = Vector3::z();
        let mut step = FIRST_STEP;
        loop {
            let here = points[points.len() - 1];
            if here.z >= STEEPEST {
                return "the end of the range of slopes".into();
            }
            if here.x >= MOST_SLIP {
                return "where the wheels spin on the spot".into();
            }
            let Some(next_tangent) = self.tangent(&here, &tangent) else {
                return self.why_not_beyond(&here, &tangent);
            };
            tangent = next_tangent;
            let next = loop {
                let guess = here + tangent * step;
                match self.correct(&guess, &tangent) {
                    Some(next) if (next - here).norm() < 2.0 * step => break Some(next),
                    _ if step < SHORTEST_STEP => break None,
                    _ => step *= 0.5,
                }
            };
            let Some(next) = next else {
                return self.why_not_beyond(&here, &tangent);
            };
            if next.z < here.z {
                points.push(self.fold_between(&here, &tangent, (next - here).norm()));
                return "where turning further uphill costs more thrust than it gains".into();
            }
            points.push(next);
            step = (1.5 * step).min(LONGEST_STEP);
        }
    }

    fn why_not_beyond(&self, here: &Point, tangent: &Point) -> String {
        match self.imbalance(&(here + tangent * FIRST_STEP)) {
            Err(ReactionError::Tipping(_)) => "where the rover tips over".into(),
            Err(error) => format!("where {error}"),
            Ok(_) => "where the balance of forces breaks off".into(),
        }
    }

    /// Unit vector along the curve, in the sense of `towards`.
    fn tangent(&self, point: &Point, towards: &Point) -> Option<Point> {
        let [along, across] = self.gradients(point, self.imbalance(point).ok()?)?;
        let tangent = along.cross(&across);
        let tangent = tangent.try_normalize(f64::MIN_POSITIVE)?;
        Some(if tangent.dot(towards) < 0.0 { -tangent } else { tangent })
    }

    /// Derivatives of the two imbalances by (s, γ, α), by forward differences.
    ///
    /// * `here`: the imbalances at the point itself
    fn gradients(&self, point: &Point, here: [f64; 2]) -> Option<[Point; 2]> {
        /// Forces are exact to 1e-12.
        const STEP: f64 = 1e-7;
        let mut gradients = [Point::zeros(); 2];
        for axis in 0..3 {
            let mut beside = *point;
            beside[axis] += STEP;
            let there = self.imbalance(&beside).ok()?;
            for (gradient, (there, here)) in gradients.iter_mut().zip(there.iter().zip(here)) {
                gradient[axis] = (there - here) / STEP;
            }
        }
        Some(gradients)
    }

    /// The point of the curve in the plane through `guess` across `normal`, by Newton's method.
    fn correct(&self, guess: &Point, normal: &Point) -> Option<Point> {
        const MOST_STEPS: usize = 12;
        let mut point = *guess;
        for _ in 0..MOST_STEPS {
            let [along, across] = self.imbalance(&point).ok()?;
            let beside = normal.dot(&(point - guess));
            if along.abs().max(across.abs()).max(beside.abs()) < BALANCED {
                return (point.y >= 0.0).then_some(point);
            }
            let [d_along, d_across] = self.gradients(&point, [along, across])?;
            let jacobian = Matrix3::from_rows(&[
                d_along.transpose(),
                d_across.transpose(),
                normal.transpose(),
            ]);
            point -= jacobian.lu().solve(&Vector3::new(along, across, beside))?;
        }
        None
    }

    /// The curve's highest point, within `span` of a point before it.
    fn fold_between(&self, before: &Point, tangent: &Point, span: f64) -> Point {
        let at = |distance: f64| self.correct(&(before + tangent * distance), tangent);
        let rise = |distance: f64| {
            at(distance).and_then(|point| self.tangent(&point, tangent)).map_or(-1.0, |t| t.z)
        };
        at(root::between(rise, 0.0, span, 1e-9)).unwrap_or(*before)
    }
}

/// Wheels that slip this much no longer move the rover [-].
const MOST_SLIP: f64 = 0.999;
/// Rounds in which the start of the curve settles.
const ROUNDS: usize = 100;

impl AttitudeCurve {
    /// The steepest slope that can be crossed level [rad], and what ends the curve there.
    ///
    /// # Errors
    /// [`NoAttitude::CannotMove`] if there is none.
    pub fn limit(&self) -> Result<(f64, &str), NoAttitude> {
        match self.points.last() {
            Some(last) => Ok((last.z.min(STEEPEST), &self.end)),
            None => Err(NoAttitude::CannotMove(self.end.clone())),
        }
    }

    /// The attitude on a slope [rad].
    ///
    /// # Errors
    /// [`NoAttitude`] if no yaw keeps the traverse level there.
    pub fn at(&self, slope: f64) -> Result<Attitude, NoAttitude> {
        let (limit, reason) = self.limit()?;
        if slope > limit {
            return Err(NoAttitude::TooSteep { limit, reason: reason.into() });
        }
        if slope <= self.held_below {
            let slip_ratio = self.study.slip_at(0.0, slope).map_err(NoAttitude::CannotMove)?;
            return self.attitude(&Point::new(slip_ratio, 0.0, slope));
        }
        let above = self.points.partition_point(|point| point.z < slope).max(1);
        let (low, high) = (self.points[above - 1], self.points[above.min(self.points.len() - 1)]);
        let share = if high.z > low.z { (slope - low.z) / (high.z - low.z) } else { 1.0 };
        let guess = low + (high - low) * share;
        self.attitude(&self.settle_on(slope, guess, low, high))
    }

    /// The curve's point on a slope, between two known ones.
    fn settle_on(&self, slope: f64, guess: Point, low: Point, high: Point) -> Point {
        let level = Vector3::z();
        let on_slope = Point::new(guess.x, guess.y, slope);
        if let Some(point) = self.study.correct(&on_slope, &level) {
            let inside = point.y >= low.y.min(high.y) - 1e-9 && point.y <= low.y.max(high.y) + 1e-9;
            if inside {
                return point;
            }
        }
        // Close to the fold the slope no longer tells the point: go by the distance along the curve.
        let chord = (high - low).normalize();
        let along = |share: f64| self.study.correct(&(low + (high - low) * share), &chord);
        let rise = |share: f64| along(share).map_or(-1.0, |point| point.z - slope);
        along(root::between(rise, 0.0, 1.0, 1e-13)).unwrap_or(guess)
    }

    /// Points along the curve, from level ground to the steepest slope.
    #[must_use]
    pub fn attitudes(&self) -> Vec<Attitude> {
        self.points.iter().filter_map(|point| self.attitude(point).ok()).collect()
    }

    fn attitude(&self, point: &Point) -> Result<Attitude, NoAttitude> {
        let study = &self.study;
        let wheels =
            study.reactions(point).map_err(|error| NoAttitude::CannotMove(error.to_string()))?;
        let forces = forces_of(&wheels);
        let (force, moment) = dynamics::soil_resultant(&study.rover, &forces, study.own_moments);
        Ok(Attitude {
            slope: point.z,
            yaw: if point.y <= JUST_TURNED { 0.0 } else { point.y },
            slip_ratio: point.x,
            yaw_moment: moment - study.rover.centre_of_mass().perp(&force),
            wheels,
        })
    }
}
