//! A contour line over ground with heights: that of the height at which a leg begins.

use std::f64::consts::{FRAC_PI_2, PI};

use super::angles::{near_enough, turned};
use super::plan::Leg;
use crate::elementary::wide;
use crate::simulation::Scenario;
use crate::terrain::Lie;
use crate::units::Vec2;
use crate::vehicle::RoverState;

/// Ground less steep than this counts as so steep where a difference of heights becomes a distance
/// from the contour, sin 1° [-]. Source: ours; on flatter ground a millimetre of height would be
/// decimetres of way.
const LEAST_STEEPNESS: f64 = 0.0175;

/// The line of one height, as a rover meets it with its footprint.
///
/// A rover is as far from it as the ground rises, or falls, to that height at the slope under it:
///
/// ```text
/// e = (z_0 − z) / sin α
/// ```
///
/// On a tilted plane that is the distance along the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contour {
    /// Height of the ground where the leg begins, *z_0* [m].
    height: f64,
    /// Which way it is followed: 1 with uphill to the left, -1 to the right.
    side: f64,
    /// The yaw with which the rover sets out, [near enough](near_enough) to the contour [rad].
    start_yaw: f64,
    /// Direction of the contour at the last look [rad], and how far that has turned since the leg
    /// began [rad].
    direction: f64,
    turned: f64,
}

impl Contour {
    /// The contour of a leg that begins here, followed the way that is nearer to the nose, backward
    /// to the tail. None on level ground, and on a plane, whose contours are straight lines.
    pub(super) fn of_leg(leg: &Leg, scenario: &Scenario, state: &RoverState) -> Option<Self> {
        if scenario.ground.is_plane() {
            return None;
        }
        let (lie, height) = scenario.ground_under(state);
        let direction = lie.contour()?;
        let off = turned(state.yaw - direction).abs();
        let ahead = if leg.manoeuvre.direction() < 0.0 { -1.0 } else { 1.0 };
        let side = if off <= FRAC_PI_2 { ahead } else { -ahead };
        let along = if side * ahead < 0.0 { direction + PI } else { direction };
        let start_yaw = near_enough(state.yaw, along);
        Some(Self { height, side, start_yaw, direction, turned: 0.0 })
    }

    /// Sees how far the contour has turned to where the rover is; how far it lies to the rover's
    /// left [m].
    pub(super) fn look(&mut self, scenario: &Scenario, state: &RoverState) -> f64 {
        let (lie, height) = scenario.ground_under(state);
        if let Some(direction) = lie.contour() {
            self.turned += turned(direction - self.direction);
            self.direction = direction;
        }
        self.left(&lie, height)
    }

    /// The yaw of a rover that turns with the contour [rad].
    pub(super) fn yaw(&self) -> f64 {
        self.start_yaw + self.turned
    }

    /// How far it lies to the left of a rover that follows it [m].
    pub(super) fn left_of(&self, scenario: &Scenario, state: &RoverState) -> f64 {
        let (lie, height) = scenario.ground_under(state);
        self.left(&lie, height)
    }

    /// * `height`: of the ground under the rover [m]
    fn left(&self, lie: &Lie, height: f64) -> f64 {
        self.side * (self.height - height) / lie.steepness().max(LEAST_STEEPNESS)
    }

    /// Its direction beside a rover that follows it, of length 1.
    pub(super) fn along(&self, scenario: &Scenario, state: &RoverState) -> Vec2 {
        let direction = scenario.ground_under(state).0.contour().unwrap_or(self.direction);
        let (sin, cos) = wide::sin_cos(direction);
        self.side * Vec2::new(cos, sin)
    }
}
