//! Follows the curve of heading offsets: predict along it, correct across it, stop where it folds.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};

use super::first_rise::{NoBalance, first_rise};
use super::study::HeadingStudy;
use crate::contact::{SettleError, Slip};
use crate::elementary::wide::{asin, cos, sin};
use crate::newton;
use crate::root;
use crate::units::{STEEPEST_SLOPE, Vec2};
use crate::vehicle::on_ground::{OnGround, forces_of};
use crate::vehicle::{KnownWheels, ReactionError, Rover, RoverState, WheelReaction, dynamics};

/// (s, c, α): slip ratio, crab angle c = γ + δ − χ, slope.
pub(super) type Place = Vector3<f64>;

/// A point of the curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point {
    /// Slip ratio, crab angle, slope.
    pub(super) place: Place,
    /// Derivatives of the two imbalances there, as far as they were needed.
    pub(super) gradients: Gradients,
    /// The wheels, in the mounts' order.
    pub(super) wheels: Vec<WheelReaction>,
}

/// Derivatives of the imbalances along and across the rover by (s, c, α).
pub(super) type Gradients = [Place; 2];

/// The angle that a rover holds while it crabs by c [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Held {
    /// Its course, *χ*: the yaw is χ + c.
    Course(f64),
    /// Its yaw, *γ*: the course is γ − c.
    Yaw(f64),
    /// Its course and its yaw, which are one: the wheels that are steered have the angle δ = c.
    Body(f64),
}

impl Held {
    /// Yaw at a crab angle [rad].
    pub(super) fn yaw(self, crab: f64) -> f64 {
        match self {
            Self::Course(course) => course + crab,
            Self::Yaw(yaw) | Self::Body(yaw) => yaw,
        }
    }

    /// Course at a crab angle [rad].
    pub(super) fn course(self, crab: f64) -> f64 {
        match self {
            Self::Course(course) | Self::Body(course) => course,
            Self::Yaw(yaw) => yaw - crab,
        }
    }

    /// Whether wheels are steered to hold it.
    pub(super) fn is_steered(self) -> bool {
        matches!(self, Self::Body(_))
    }

    /// Why the curve folds.
    fn reason_to_fold(self) -> &'static str {
        match self {
            Self::Course(_) => "where turning further uphill costs more thrust than it gains",
            Self::Body(_) => {
                "where turning the wheels further uphill costs more thrust than it gains"
            }
            Self::Yaw(_) => "where drifting more steeply gains no more side force",
        }
    }
}

/// The study of one course, or of one yaw.
pub(super) struct Path<'a> {
    study: &'a HeadingStudy,
    held: Held,
    /// The rover, with wheels that may be steered by any angle if they are; and the most that its
    /// own can be [rad].
    rover: Cow<'a, Rover>,
    most_steering: f64,
    settled_wheels: Cell<u64>,
    /// The place looked at last, and what is known of the wheels there.
    last: RefCell<Option<(Place, KnownWheels)>>,
}

/// How far a curve is followed: to its first point that is beyond one of these, or to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Slope [rad].
    pub(super) slope: f64,
    /// Slip ratio in drive [-].
    pub(super) slip_ratio: f64,
}

impl Reach {
    /// To its end.
    pub(super) const END: Self = Self { slope: STEEPEST_SLOPE, slip_ratio: f64::INFINITY };
}

/// Slopes at which a next point is looked for, above the last [rad].
pub(super) const NEXT_SLOPES: [f64; 4] = [2e-3, 4e-4, 5e-5, 5e-6];
/// Force left over, over the weight, that a bracketed balance may have [-]: the root of forces that
/// are exact to 1e-12.
pub(super) const CLOSE: f64 = 1e-9;

/// What ends a curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// The rover, the soil or the range: a fold, a bracket or a limit shows it.
    Shown(String),
    /// The search: it gave up, and nothing is known of what lies beyond.
    NotFound(String),
}

impl End {
    /// The end where wheels do not settle.
    fn of_error(error: &ReactionError, before: &str) -> Self {
        match error {
            ReactionError::Tipping(_) => Self::Shown(format!("{before}the rover tips over")),
            ReactionError::Wheel { source: SettleError::SunkToAxle { .. }, .. } => {
                Self::Shown(format!("{before}{error}"))
            }
            _ => Self::not_found(&error.to_string()),
        }
    }

    fn not_found(what: &str) -> Self {
        Self::NotFound(format!("where the search gave up: {what}"))
    }

    pub(super) fn reason(&self) -> &str {
        let (Self::Shown(reason) | Self::NotFound(reason)) = self;
        reason
    }
}

/// Longest step along the curve [-, rad].
const LONGEST_STEP: f64 = 0.05;
/// First step along the curve [-, rad].
const FIRST_STEP: f64 = 0.005;
/// A step this short means that the curve ends here [-, rad].
const SHORTEST_STEP: f64 = 1e-7;
/// Places closer than this have wheels that are nearly alike [-, rad]: two of the longest steps.
const NEARBY: f64 = 0.1;
/// A correction longer than this is of another part of the curve [-, rad].
const LONGEST: f64 = 0.5;
/// In skid this deep the wheels hold the rover back on any slope that they can be driven on [-].
const DEEPEST_SKID: f64 = -0.9;
/// Force left over, over the weight, below which a rover counts as balanced [-].
const BALANCED: f64 = 1e-10;
/// Stands for c = 0⁺, where a side-wall law that jumps has its full force [rad].
pub(super) const JUST_TURNED: f64 = 1e-9;
/// Wheels that slip this much no longer move the rover, or hold it [-].
pub(super) const MOST_SLIP: f64 = 0.999;

impl<'a> Path<'a> {
    pub(super) fn new(study: &'a HeadingStudy, held: Held) -> Self {
        let (mut rover, mut most_steering) = (Cow::Borrowed(&study.rover), f64::INFINITY);
        if held.is_steered() {
            let limits = study.rover.mounts().iter().filter_map(|mount| mount.steering_axis);
            most_steering = limits.map(|axis| axis.limit).fold(most_steering, f64::min);
            rover = Cow::Owned(without_limits(&study.rover));
        }
        let (settled_wheels, last) = (Cell::new(0), RefCell::default());
        Self { study, held, rover, most_steering, settled_wheels, last }
    }

    /// The rover with its wheels as they are at a crab angle [rad].
    pub(super) fn rover(&self, crab: f64) -> Cow<'_, Rover> {
        if !self.held.is_steered() {
            return Cow::Borrowed(&self.rover);
        }
        let angle = crab.clamp(-FRAC_PI_2, FRAC_PI_2);
        let mounts = self.rover.mounts().iter();
        let angles: Vec<f64> =
            mounts.map(|mount| mount.steering_axis.map_or(0.0, |_| angle)).collect();
        let steered = self.rover.steered(&angles);
        Cow::Owned(steered.expect("wheels without limits are steered by a quarter turn at most"))
    }

    /// The slip of each wheel at a place.
    fn slips(&self, slip_ratio: f64, crab: f64) -> Vec<Slip> {
        let turned = Slip::on_test_stand(slip_ratio, -crab);
        if !self.held.is_steered() {
            return vec![turned; self.rover.wheel_count()];
        }
        // At the speed of the other rims, a wheel that is not steered has the rover's whole speed.
        let (rim, hub) = if slip_ratio >= 0.0 {
            (1.0, (1.0 - slip_ratio) / cos(crab))
        } else {
            (1.0 + slip_ratio, 1.0 / cos(crab))
        };
        let straight = Slip::on_test_stand((rim - hub) / rim.max(hub), 0.0);
        let mounts = self.rover.mounts().iter();
        mounts.map(|mount| mount.steering_axis.map_or(straight, |_| turned)).collect()
    }

    /// The yaw without any crab [rad].
    pub(super) fn yaw_at_rest(&self) -> f64 {
        self.held.yaw(0.0)
    }

    /// The imbalances at a place, if the wheels settle there.
    pub(super) fn left_over(&self, place: &Place) -> Option<[f64; 2]> {
        self.imbalance(place).ok()
    }

    /// How many wheels were settled so far.
    pub(super) fn settled_wheels(&self) -> u64 {
        self.settled_wheels.get()
    }

    /// Begins with the wheels of a known point.
    pub(super) fn begin_at(&self, point: &Point) {
        let plane = self.study.plane(point.place.z);
        let rover = self.rover(point.place.y);
        let ground = OnGround { rover: &rover, ..self.study.on_ground(&plane) };
        let known = KnownWheels::of(&ground, &point.wheels);
        self.last.replace(Some((point.place, known)));
    }

    /// The rover at a crab angle [rad]; how fast it goes does not count.
    fn state(&self, crab: f64) -> RoverState {
        RoverState { yaw: self.held.yaw(crab), ..RoverState::default() }
    }

    /// The wheels at a place, and the weight's pull there, in the body frame [N].
    fn reactions(&self, place: &Place) -> Result<(Vec<WheelReaction>, Vec2), ReactionError> {
        let (slip_ratio, crab, slope) = (place.x, place.y, place.z);
        let slips = self.slips(slip_ratio, crab);
        self.settled_wheels.set(self.settled_wheels.get() + slips.len() as u64);
        let plane = self.study.plane(slope);
        let rover = self.rover(crab);
        let ground = OnGround { rover: &rover, ..self.study.on_ground(&plane) };
        let stance = ground.stance(&self.state(crab));
        let mut last = self.last.borrow_mut();
        let near = last.as_mut().filter(|(last, _)| (*place - *last).norm() < NEARBY);
        let wheels = if let Some((last, known)) = near {
            let wheels = ground.reactions_by(&stance, &slips, known)?;
            *last = *place;
            wheels
        } else {
            let mut known = KnownWheels::default();
            let wheels = ground.reactions_by(&stance, &slips, &mut known)?;
            *last = Some((*place, known));
            wheels
        };
        Ok((wheels, stance.pull))
    }

    /// The wheels at a place, and the forces left over there, over the weight: along and across
    /// the rover [-].
    pub(super) fn balance(
        &self,
        place: &Place,
    ) -> Result<([f64; 2], Vec<WheelReaction>), ReactionError> {
        let study = self.study;
        let (wheels, pull) = self.reactions(place)?;
        let (soil, _) =
            dynamics::soil_resultant(&self.rover(place.y), forces_of(&wheels), study.own_moments);
        let left_over = (soil + pull) / (study.rover.mass() * study.gravity);
        Ok(([left_over.x, left_over.y], wheels))
    }

    fn imbalance(&self, place: &Place) -> Result<[f64; 2], ReactionError> {
        self.balance(place).map(|(left_over, _)| left_over)
    }

    /// Lowest slip at which thrust and weight are in equilibrium along the rover, for a crab angle
    /// and a slope. Where pull falls again at high slip there are more of them, to which no rover
    /// comes that sets out rolling.
    pub(super) fn slip_at(&self, crab: f64, slope: f64) -> Result<f64, End> {
        let left_over = |slip_ratio: f64| {
            self.imbalance(&Place::new(slip_ratio, crab, slope)).map(|left_over| left_over[0])
        };
        let [below, above] = first_rise(&left_over).map_err(|none| self.no_balance(none))?;
        // Wheels that no sinkage carries move nothing.
        let thrust = |slip_ratio: f64| left_over(slip_ratio).unwrap_or(-1.0);
        let (slip_ratio, left) = root::bracketed(thrust, below, above, 1e-13, 0.0);
        if left.abs() < CLOSE {
            return Ok(slip_ratio);
        }
        // Loads that settle in more than one way depend on where they were looked at before: look
        // anew from both ends.
        let anew = root::between(thrust, DEEPEST_SKID, above.0, 1e-13);
        if thrust(anew).abs() < CLOSE {
            return Ok(anew);
        }
        Err(End::not_found("thrust jumps past its balance"))
    }

    fn no_balance(&self, none: NoBalance) -> End {
        match none {
            NoBalance::Lacks(share) => {
                let lacking = share * self.study.rover.mass() * self.study.gravity;
                End::Shown(format!("at any slip they lack {lacking:.2} N of thrust or more"))
            }
            NoBalance::Pushed => End::Shown("even locked wheels do not hold the rover".into()),
            NoBalance::Fault(error) => End::of_error(&error, ""),
        }
    }

    /// A point that is known to be on the curve.
    pub(super) fn point(&self, place: Place) -> Result<Point, ReactionError> {
        let (here, wheels) = self.balance(&place)?;
        let gradients = self.gradients(&place, here).unwrap_or_default();
        Ok(Point { place, gradients, wheels })
    }

    /// The curve's first point, at c = 0⁺: slip and slope in equilibrium there.
    pub(super) fn start(&self) -> Result<Point, End> {
        /// Rounds in which slip and slope settle on each other.
        const ROUNDS: usize = 100;
        // Straight up or down the slope nothing pulls sideways, and the rover does not crab.
        let yaw = self.yaw_at_rest();
        if self.is_straight() {
            let place = Place::new(self.slip_at(0.0, 0.0)?, 0.0, 0.0);
            return self.point(place).map_err(|error| End::of_error(&error, ""));
        }
        let mut slope = 0.0;
        for _ in 0..ROUNDS {
            let slip_ratio = self.slip_at(JUST_TURNED, slope)?;
            let place = Place::new(slip_ratio, JUST_TURNED, slope);
            let left_over = self.imbalance(&place).map_err(|error| End::of_error(&error, ""))?[1];
            if left_over.abs() < BALANCED {
                return self.point(place).map_err(|error| End::of_error(&error, ""));
            }
            // The slope's pull across the rover goes with the cosine of its yaw.
            slope = asin((sin(slope) + left_over / cos(yaw)).clamp(0.0, sin(STEEPEST_SLOPE)));
        }
        Err(End::not_found("slip and slope of the first crab did not settle on each other"))
    }

    /// Follows the curve from its one point until it folds or ends, or until a point is not below a
    /// slope, or slips more than it need; says what ended it.
    pub(super) fn follow(&self, points: &mut Vec<Point>, reach: Reach) -> End {
        let mut step = FIRST_STEP;
        loop {
            let here = points[points.len() - 1].clone();
            if here.place.z >= reach.slope {
                return End::Shown("the end of the range of slopes".into());
            }
            if here.place.x > reach.slip_ratio && self.climbs_at_last(points) {
                return End::Shown("the end of the range of slip ratios".into());
            }
            let next = match self.next_along(points, &mut step) {
                Ok(next) => next,
                Err(towards) => match self.next_by_bracket(&here) {
                    Some(next) => {
                        step = FIRST_STEP;
                        next
                    }
                    None => return self.why_not_beyond(&here.place, &towards),
                },
            };
            if next.place.x.abs() > MOST_SLIP {
                return self.end_at_most_slip(points, &next.place);
            }
            if next.place.y > self.most_steering && next.place.z >= here.place.z {
                return self.end_at_most_steering(points, &next.place);
            }
            if next.place.z < here.place.z {
                if let Some(deeper) = self.deeper_skid(&here) {
                    points.push(deeper);
                    step = FIRST_STEP;
                    continue;
                }
                self.end_at_fold(points, next);
                return End::Shown(self.held.reason_to_fold().into());
            }
            points.push(next);
            step = (1.5 * step).min(LONGEST_STEP);
        }
    }

    /// The next point along the curve, with the longest step that leads to one; or the direction in
    /// which none did.
    fn next_along(&self, points: &[Point], step: &mut f64) -> Result<Point, Place> {
        let here = &points[points.len() - 1];
        loop {
            let way = self.predict(points, *step).ok_or_else(Vector3::z)?;
            let normal = way.normalize();
            match self.correct(&(here.place + way), &normal, &here.gradients) {
                Some(next) if (next.place - here.place).norm() < 2.0 * *step => return Ok(next),
                _ if *step < SHORTEST_STEP => return Err(normal),
                _ => *step *= 0.5,
            }
        }
    }

    /// The way to a guess of the next point: along the tangent, then along the parabola through
    /// the last three points by the length of their chords.
    fn predict(&self, points: &[Point], step: f64) -> Option<Place> {
        let here = &points[points.len() - 1];
        if points.len() < 3 {
            let towards = match points.len() {
                1 => Vector3::z(),
                _ => here.place - points[points.len() - 2].place,
            };
            return Some(self.tangent(here, &towards)? * step);
        }
        let [two_back, back] = [&points[points.len() - 3], &points[points.len() - 2]];
        let last = here.place - back.place;
        let (length, before) = (last.norm(), (back.place - two_back.place).norm());
        let slope = last / length;
        let slope_before = (back.place - two_back.place) / before;
        let bend = (slope - slope_before) / (length + before);
        Some(slope * step + bend * (step * (step + length)))
    }

    fn why_not_beyond(&self, here: &Place, towards: &Place) -> End {
        match self.imbalance(&(here + towards * FIRST_STEP)) {
            Err(error) => End::of_error(&error, "where "),
            Ok(_) => self.what_slips_show(here),
        }
    }

    /// Straight up or down a slope, where slip alone is to be found, all slips just above a point
    /// show whether there is a balance; on other courses they do not.
    fn what_slips_show(&self, here: &Place) -> End {
        let unknown = || End::not_found("no next point of the curve was found");
        if !self.is_straight() {
            return unknown();
        }
        let slope = here.z + NEXT_SLOPES[NEXT_SLOPES.len() - 1];
        let left_over = |slip_ratio: f64| {
            self.imbalance(&Place::new(slip_ratio, 0.0, slope)).map(|left_over| left_over[0])
        };
        match first_rise(&left_over) {
            Ok(_) => unknown(),
            Err(NoBalance::Fault(error)) => End::of_error(&error, "where "),
            Err(NoBalance::Pushed) => {
                End::Shown("where even locked wheels do not hold the rover".into())
            }
            Err(NoBalance::Lacks(_)) => {
                End::Shown("where the wheels lack thrust at any slip".into())
            }
        }
    }

    /// How slip ratio and crab angle go with the slope at a point, *(ds/dα, dc/dα, 1)*.
    pub(super) fn per_slope(point: &Point) -> Option<Place> {
        let [along, across] = &point.gradients;
        let tangent = along.cross(across);
        /// Flatter than this the curve folds, and the slope does not determine the point [-].
        const STEEP: f64 = 0.05;
        (tangent.z.abs() > STEEP * tangent.norm()).then(|| tangent / tangent.z)
    }

    /// Unit vector along the curve, in the sense of `towards`.
    fn tangent(&self, point: &Point, towards: &Place) -> Option<Place> {
        let fresh = self.gradients(&point.place, self.imbalance(&point.place).ok()?)?;
        let tangent = fresh[0].cross(&fresh[1]).try_normalize(f64::MIN_POSITIVE)?;
        Some(if tangent.dot(towards) < 0.0 { -tangent } else { tangent })
    }

    /// Derivatives of the two imbalances by (s, c, α), by forward differences.
    ///
    /// * `here`: the imbalances at the place itself
    fn gradients(&self, place: &Place, here: [f64; 2]) -> Option<Gradients> {
        /// Forces are exact to 1e-12, those of loads that depend on them to 1e-11: a gradient to
        /// 1e-4.
        const STEP: f64 = 1e-7;
        let mut gradients = Gradients::default();
        for axis in 0..3 {
            let mut beside = *place;
            beside[axis] += STEP;
            let there = self.imbalance(&beside).ok()?;
            for (gradient, (there, here)) in gradients.iter_mut().zip(there.iter().zip(here)) {
                gradient[axis] = (there - here) / STEP;
            }
        }
        Some(gradients)
    }

    /// The point of the curve in the plane through `guess` across `normal`.
    ///
    /// * `gradients`: from nearby; where they lead nowhere, those of the guess are taken
    pub(super) fn correct(
        &self,
        guess: &Place,
        normal: &Place,
        gradients: &Gradients,
    ) -> Option<Point> {
        self.correct_with(guess, normal, gradients)
            .or_else(|| {
                let fresh = self.gradients(guess, self.imbalance(guess).ok()?)?;
                self.correct_with(guess, normal, &fresh)
            })
            .or_else(|| self.correct_by_root(guess, normal))
    }

    /// The same where wheels begin to skid. There the part of the arc that slides forwards grows
    /// with the root of the slip, and pull falls with it, without a finite slope: the root *u*, s =
    /// −u², is the unknown.
    fn correct_by_root(&self, guess: &Place, normal: &Place) -> Option<Point> {
        /// Above this slip a point is of the driven part of the curve [-].
        const DRIVEN: f64 = 0.05;
        /// A difference of the root: of slip it is 1e-14 next to zero, and forces are exact to
        /// 1e-12 [-].
        const STEP: f64 = 1e-7;
        if guess.x > DRIVEN {
            return None;
        }
        let place_of = |it: &Place| Place::new(-(it.x * it.x.abs()), it.y, it.z);
        let residual = |it: &Place| {
            let place = place_of(it);
            let ([along, across], wheels) = self.balance(&place).ok()?;
            Some((Vector3::new(along, across, normal.dot(&(place - guess))), wheels))
        };
        let start = Place::new((-guess.x).max(0.0).sqrt(), guess.y, guess.z);
        let (here, _) = residual(&start)?;
        let mut jacobian = Matrix3::zeros();
        for axis in 0..3 {
            let mut beside = start;
            beside[axis] += STEP;
            jacobian.set_column(axis, &((residual(&beside)?.0 - here) / STEP));
        }
        let is_zero = |left_over: &Vector3<f64>, _: &Vector3<f64>| left_over.amax() < BALANCED;
        let inverse = jacobian.try_inverse()?;
        let zero = newton::zero_near(residual, &start, inverse, Vector3::norm, LONGEST, is_zero)?;
        let place = place_of(&zero.at);
        if place.y < -JUST_TURNED {
            return None;
        }
        let gradients = self.gradients(&place, self.imbalance(&place).ok()?)?;
        Some(Point { place, gradients, wheels: zero.value })
    }

    fn correct_with(&self, guess: &Place, normal: &Place, gradients: &Gradients) -> Option<Point> {
        let [along, across] = gradients;
        let rows = [along.transpose(), across.transpose(), normal.transpose()];
        let zero = newton::zero_near(
            |place| {
                let ([along, across], wheels) = self.balance(place).ok()?;
                Some((Vector3::new(along, across, normal.dot(&(place - guess))), wheels))
            },
            guess,
            Matrix3::from_rows(&rows).try_inverse()?,
            Vector3::norm,
            LONGEST,
            |left_over, _| left_over.amax() < BALANCED,
        )?;
        // Straight up or down the slope the crab angle is nothing but rounding.
        if zero.at.y < -JUST_TURNED {
            return None;
        }
        let jacobian = zero.inverse.try_inverse()?;
        let gradients = [0, 1].map(|row| jacobian.row(row).transpose());
        Some(Point { place: zero.at, gradients, wheels: zero.value })
    }

    /// Ends a curve where slip reaches [`MOST_SLIP`], in drive or in skid.
    ///
    /// * `beyond`: a place past it
    fn end_at_most_slip(&self, points: &mut Vec<Point>, beyond: &Place) -> End {
        let here = &points[points.len() - 1];
        let most = MOST_SLIP.copysign(beyond.x);
        let share = (most - here.place.x) / (beyond.x - here.place.x);
        let mut guess = here.place + (beyond - here.place) * share;
        guess.x = most;
        points.extend(self.correct(&guess, &Vector3::x(), &here.gradients));
        let reason = if most > 0.0 {
            "where the wheels spin on the spot"
        } else {
            "where the wheels are all but locked"
        };
        End::Shown(reason.into())
    }

    /// Ends a curve where wheels are steered as far as they can.
    ///
    /// * `beyond`: a place past it
    fn end_at_most_steering(&self, points: &mut Vec<Point>, beyond: &Place) -> End {
        let here = &points[points.len() - 1];
        let share = (self.most_steering - here.place.y) / (beyond.y - here.place.y);
        let mut guess = here.place + (beyond - here.place) * share;
        guess.y = self.most_steering;
        points.extend(self.correct(&guess, &Vector3::y(), &here.gradients));
        End::Shown("where the wheels cannot be steered any further".into())
    }

    /// Whether the curve still rises at its last point: where it does not, its end takes that point
    /// off.
    fn climbs_at_last(&self, points: &[Point]) -> bool {
        let [.., before, last] = points else { return true };
        let way = last.place - before.place;
        self.tangent(last, &way).is_some_and(|tangent| tangent.z >= 0.0)
    }

    /// Ends a curve at its highest point, which lies around the last of `points`.
    ///
    /// * `beyond`: a point past it
    fn end_at_fold(&self, points: &mut Vec<Point>, beyond: Point) {
        let climbs = |point: &Point, towards: &Place| self.tangent(point, towards).map(|t| t.z);
        let mut after = beyond;
        let last = &points[points.len() - 1];
        if points.len() > 1 {
            let way = last.place - points[points.len() - 2].place;
            if climbs(last, &way).is_some_and(|climb| climb < 0.0) {
                after = points[points.len() - 1].clone();
                points.pop();
            }
        }
        /// The slope hardly changes around its highest point: this share of a step is enough [-].
        const NEARLY: f64 = 1e-5;
        let before = &points[points.len() - 1];
        let chord = after.place - before.place;
        let normal = chord.normalize();
        let at =
            |share: f64| self.correct(&(before.place + chord * share), &normal, &before.gradients);
        let climb =
            |share: f64| at(share).and_then(|point| climbs(&point, &normal)).unwrap_or(-1.0);
        if let Some(top) = at(root::between(climb, 0.0, 1.0, NEARLY)) {
            points.push(top);
        }
    }
}

/// The same rover with wheels that are steered as far as a quarter turn.
fn without_limits(rover: &Rover) -> Rover {
    let mut mounts = rover.mounts().to_vec();
    for axis in mounts.iter_mut().filter_map(|mount| mount.steering_axis.as_mut()) {
        axis.limit = FRAC_PI_2;
    }
    Rover::new(*rover.body(), mounts).expect("limits of steering are no part of a stance")
}
