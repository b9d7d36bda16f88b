//! The balance of a rover that goes straight along the contour with wheels at speeds of their own.

use std::cell::RefCell;

use nalgebra::{DVector, Matrix3, Vector3};

use super::motion::{Aim, SpeedFreedom, StraightMotion, WheelSpeedStudy};
use super::search::{Place, Problem};
use crate::elementary::wide::{cos, sin};
use crate::simulation::equations::Equations;
use crate::simulation::steady_state;
use crate::units::Vec2;
use crate::vehicle::kinematics::wheel_slips;
use crate::vehicle::on_ground::forces_of;
use crate::vehicle::{RoverState, WheelReaction, dynamics};

/// Force, and moment over the farthest wheel's distance, that are left over: both over the weight,
/// along and across the rover and about its centre of mass.
///
/// The unknowns are the yaw, a number for each speed, and the slope. All forces depend on ratios of
/// speeds, so that the rover's own speed is not one of them.
pub(super) struct Balance<'a> {
    study: &'a WheelSpeedStudy,
    aim: Aim,
    /// Which of the speeds each wheel has.
    speed_of: Vec<usize>,
    speeds: usize,
    /// The wheels that turn backwards or stand.
    reversed: Vec<usize>,
    /// The farthest wheel's distance [m].
    reach: f64,
    /// The place looked at last, and the wheels there.
    last: RefCell<Option<(Place, Vec<WheelReaction>)>>,
}

/// Speed of the rover where forces alone count [m/s]: any that is much faster than creep.
const SPEED: f64 = 1.0;
/// Speed of the rover where it turns [m/s]: so slow that inertia is nothing.
const SLOW: f64 = 0.01;
/// Unknowns closer than this have wheels that are nearly alike.
const NEARBY: f64 = 0.1;
/// By this much a slope may be below 0 [rad], so that level ground is within the bounds.
const LEVEL: f64 = 1e-6;

/// The unknown of a rim speed, *κ*, over the rover's: its slip ratio, 1 − 1/κ and κ − 1, continued
/// to wheels that turn backwards. So speeds have an even spread from locked to spinning.
fn unknown_of(rim_speed: f64) -> f64 {
    if rim_speed >= 1.0 { 1.0 - 1.0 / rim_speed } else { rim_speed - 1.0 }
}

/// The inverse of [`unknown_of`].
fn rim_speed_of(unknown: f64) -> f64 {
    if unknown >= 0.0 { 1.0 / (1.0 - unknown) } else { 1.0 + unknown }
}

impl<'a> Balance<'a> {
    pub(super) fn new(study: &'a WheelSpeedStudy, freedom: SpeedFreedom, aim: Aim) -> Self {
        let rover = &study.heading.rover;
        let mounts = rover.mounts();
        let mean = mounts.iter().map(|mount| mount.position.y).sum::<f64>() / mounts.len() as f64;
        let is_uphill = |wheel: &usize| mounts[*wheel].position.y > mean;
        let all = 0..mounts.len();
        let (speed_of, speeds): (Vec<usize>, usize) = match freedom {
            SpeedFreedom::BySide => {
                (all.clone().map(|wheel| usize::from(!is_uphill(&wheel))).collect(), 2)
            }
            SpeedFreedom::ByWheel | SpeedFreedom::UphillReversed => {
                (all.clone().collect(), mounts.len())
            }
        };
        let reversed = match freedom {
            SpeedFreedom::UphillReversed => all.filter(is_uphill).collect(),
            SpeedFreedom::BySide | SpeedFreedom::ByWheel => Vec::new(),
        };
        let reach = rover.load_arms().iter().map(Vec2::norm).fold(0.0, f64::max);
        Self { study, aim, speed_of, speeds, reversed, reach, last: RefCell::default() }
    }

    /// The unknowns of a motion.
    ///
    /// * `rim_speeds`: of each wheel, over the rover's speed [-]
    pub(super) fn place(&self, yaw: f64, rim_speeds: &[f64], slope: f64) -> Place {
        let mut place = Place::zeros(self.speeds + 2);
        place[0] = yaw;
        for (speed, rim_speed) in self.speed_of.iter().zip(rim_speeds) {
            place[1 + speed] = unknown_of(*rim_speed);
        }
        place[self.speeds + 1] = slope;
        place
    }

    /// The motion at a place.
    pub(super) fn motion(&self, place: &Place) -> Option<StraightMotion> {
        let (wheels, _) = self.reactions(place)?;
        Some(StraightMotion {
            slope: self.slope(place),
            yaw: place[0],
            speed_ratios: self.rim_speeds(place),
            energy_per_metre: self.energy_per_metre(place, &wheels),
            yaw_growth: self.yaw_growth(place)?,
            wheels,
        })
    }

    fn slope(&self, place: &Place) -> f64 {
        place[self.speeds + 1]
    }

    /// Rim speeds over the rover's speed [-].
    fn rim_speeds(&self, place: &Place) -> Vec<f64> {
        self.speed_of.iter().map(|speed| rim_speed_of(place[1 + speed])).collect()
    }

    /// Those of a rover at a speed [m/s].
    fn rim_speeds_at(&self, place: &Place, speed: f64) -> Vec<f64> {
        self.rim_speeds(place).iter().map(|ratio| ratio * speed).collect()
    }

    /// The rover at a speed [m/s], straight along the contour.
    fn state(place: &Place, speed: f64) -> RoverState {
        let yaw = place[0];
        let velocity = speed * Vec2::new(cos(yaw), -sin(yaw));
        RoverState { yaw, velocity, ..RoverState::default() }
    }

    /// The wheels at a place, and the weight's pull there, in the body frame [N].
    fn reactions(&self, place: &Place) -> Option<(Vec<WheelReaction>, Vec2)> {
        let (heading, state) = (&self.study.heading, Self::state(place, SPEED));
        let rim_speeds = self.rim_speeds_at(place, SPEED);
        let slips: Vec<_> = wheel_slips(&heading.rover, &state, &rim_speeds).collect();
        let plane = heading.plane(self.slope(place));
        let ground = heading.on_ground(&plane);
        let stance = ground.stance(&state);
        let wheels = match &*self.last.borrow() {
            Some((last, wheels)) if (place - last).norm() < NEARBY => {
                ground.reactions_near(&stance, &slips, wheels)
            }
            _ => ground.reactions(&stance, &slips),
        };
        let wheels = wheels.ok()?;
        self.last.replace(Some((place.clone(), wheels.clone())));
        Some((wheels, stance.pull))
    }

    /// Work of the motors per metre of way [J/m]. What a wheel would give back that is dragged, no
    /// motor takes.
    fn energy_per_metre(&self, place: &Place, wheels: &[WheelReaction]) -> f64 {
        let mounts = self.study.heading.rover.mounts();
        let each = wheels.iter().zip(self.rim_speeds(place)).zip(mounts);
        let work = each.map(|((wheel, ratio), mount)| {
            (wheel.settled.forces.torque * ratio / mount.shearing_radius()).max(0.0)
        });
        work.sum()
    }

    /// How fast a small error of the yaw grows over the way [1/m]: that of the velocities' steady
    /// state, *−(∂a/∂V)⁻¹ ∂a/∂γ*, and where that state is unstable by itself the rate at which it
    /// is left.
    fn yaw_growth(&self, place: &Place) -> Option<f64> {
        /// Steps, over the speed, or of the yaw [rad]: forces are exact to 1e-11.
        const STEP: f64 = 1e-6;
        let rim_speeds = self.rim_speeds_at(place, SLOW);
        let plane = self.study.heading.plane(self.slope(place));
        let equations = Equations::new(self.study.heading.on_ground(&plane), &rim_speeds);
        let sizes = [SLOW, SLOW, SLOW / self.reach];
        let accelerations = |state: &RoverState| {
            let rates = equations.rates(state).ok()?.acceleration;
            let [along, across] = [rates.velocity_rate.x, rates.velocity_rate.y];
            let all = Vector3::new(along, across, rates.yaw_acceleration);
            Some(all.component_div(&Vector3::from(sizes)))
        };
        let state = Self::state(place, SLOW);
        let here = accelerations(&state)?;
        let by = |change: &dyn Fn(&mut RoverState)| {
            let mut beside = state;
            change(&mut beside);
            Some((accelerations(&beside)? - here) / STEP)
        };
        let by_velocities = Matrix3::from_columns(&[
            by(&|beside| beside.velocity.x += STEP * sizes[0])?,
            by(&|beside| beside.velocity.y += STEP * sizes[1])?,
            by(&|beside| beside.yaw_rate += STEP * sizes[2])?,
        ]);
        let by_yaw = by(&|beside| beside.yaw += STEP)?;
        let eigenvalues = by_velocities.complex_eigenvalues();
        let fastest = eigenvalues.iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
        if fastest >= 0.0 {
            return Some(fastest / SLOW);
        }
        let yaw_rate = -(by_velocities.try_inverse()? * by_yaw).z * sizes[2];
        Some(yaw_rate / SLOW)
    }
}

impl Problem for Balance<'_> {
    fn evaluate(&self, place: &Place) -> Option<(DVector<f64>, f64)> {
        let heading = &self.study.heading;
        let (wheels, pull) = self.reactions(place)?;
        let forces = forces_of(&wheels);
        let (force, moment) = dynamics::soil_resultant(&heading.rover, forces, heading.own_moments);
        let weight = heading.rover.mass() * heading.gravity;
        let left = (force + pull) / weight;
        let moment = moment - heading.rover.centre_of_mass().perp(&force);
        let mut all = vec![left.x, left.y, moment / (weight * self.reach)];
        let value = match self.aim {
            Aim::Steepest => self.slope(place),
            Aim::LeastEnergy(slope) => {
                all.push(self.slope(place) - slope);
                -self.energy_per_metre(place, &wheels) / weight
            }
        };
        Some((DVector::from_vec(all), value))
    }

    fn bounds(&self, place: &Place) -> DVector<f64> {
        let (rim_speeds, slope) = (self.rim_speeds(place), self.slope(place));
        let mean = rim_speeds.iter().map(|it| it.abs()).sum::<f64>() / rim_speeds.len() as f64;
        let ratios = rim_speeds.iter().map(|it| self.study.most_ratio - it.abs() / mean);
        let spinning = (0..self.speeds).map(|it| steady_state::MOST_SLIP - place[1 + it]);
        let reversed = self.reversed.iter().map(|wheel| -rim_speeds[*wheel]);
        // The nose points forward, and the ground stands.
        let others = [cos(place[0]), slope + LEVEL, self.study.heading.ground_limit() - slope];
        DVector::from_vec(ratios.chain(spinning).chain(reversed).chain(others).collect())
    }
}
