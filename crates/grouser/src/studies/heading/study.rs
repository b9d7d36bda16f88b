//! What a study of heading offsets is about.

use std::f64::consts::FRAC_PI_2;

use crate::contact::Model;
use crate::elementary::wide::{cos, sin, tan};
use crate::root;
use crate::simulation::{NotSteady, Seeking, SteadyMotion};
use crate::soil::{SlopeStability, Soil};
use crate::terrain::Ground;
use crate::units::Vec2;
use crate::vehicle::{Differences, LoadSharing, OnGround, OwnMoments, Rover};

/// Finds heading offsets of a rover on a soil, for any slope.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingStudy {
    /// The rover.
    pub rover: Rover,
    /// The soil.
    pub soil: Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: Model,
    /// How the weight is transferred between the wheels.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
    /// What is asked of the ground's own strength before a rover crosses it.
    pub stability: SlopeStability,
    /// What is turned uphill to hold a course.
    pub steering: Steering,
}

/// What a rover turns uphill to hold its course.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Steering {
    /// Its nose: the wheels point straight ahead.
    #[default]
    None,
    /// All wheels that are steered, by one angle; its nose points along the course.
    Crab,
}

impl Steering {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::None, Self::Crab];

    /// One word: `none`, `crab`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Crab => "crab",
        }
    }
}

/// The farthest course from the contour [rad]: straight up or down the slope. Beyond it a rover
/// travels the other way, and is its own mirror image.
pub const STRAIGHT_UP: f64 = FRAC_PI_2;

impl HeadingStudy {
    /// The motion into which the rover settles on a slope *α* at a yaw *γ* [rad], with all rims at
    /// one speed
    /// [m/s]: unlike on a contour traverse, its yaw moment is balanced, and it turns.
    ///
    /// # Errors
    /// [`NotSteady`] where no velocities are found at which nothing accelerates.
    pub fn steady_motion(
        &self,
        slope: f64,
        yaw: f64,
        rim_speed: f64,
    ) -> Result<SteadyMotion, NotSteady> {
        self.steady_motion_of(slope, yaw, &vec![rim_speed; self.rover.wheel_count()])
    }

    /// The same with each rim at its own speed [m/s], in the mounts' order; negative backwards.
    ///
    /// # Errors
    /// The same as [`steady_motion`](Self::steady_motion).
    pub fn steady_motion_of(
        &self,
        slope: f64,
        yaw: f64,
        rim_speeds: &[f64],
    ) -> Result<SteadyMotion, NotSteady> {
        SteadyMotion::of(self.on_ground(&self.plane(slope)), rim_speeds, yaw)
    }

    /// The same, sought in a way of its own: held, where the rover holds its yaw by itself.
    ///
    /// # Errors
    /// The same as [`steady_motion`](Self::steady_motion).
    pub fn motion_sought(
        &self,
        slope: f64,
        yaw: f64,
        rim_speeds: &[f64],
        seeking: Seeking,
    ) -> Result<SteadyMotion, NotSteady> {
        SteadyMotion::sought(self.on_ground(&self.plane(slope)), rim_speeds, yaw, seeking)
    }

    /// The same at another yaw *γ* [rad], sought from a motion on that slope.
    ///
    /// # Errors
    /// The same as [`steady_motion`](Self::steady_motion).
    pub fn steady_motion_near(
        &self,
        motion: &SteadyMotion,
        slope: f64,
        yaw: f64,
        rim_speed: f64,
    ) -> Result<SteadyMotion, NotSteady> {
        let rim_speeds = vec![rim_speed; self.rover.wheel_count()];
        self.steady_motion_of_near(motion, slope, yaw, &rim_speeds)
    }

    /// The same with each rim at its own speed [m/s], sought from a motion with these speeds on a
    /// slope that is near.
    ///
    /// # Errors
    /// The same as [`steady_motion`](Self::steady_motion).
    pub fn steady_motion_of_near(
        &self,
        motion: &SteadyMotion,
        slope: f64,
        yaw: f64,
        rim_speeds: &[f64],
    ) -> Result<SteadyMotion, NotSteady> {
        motion.at_yaw(self.on_ground(&self.plane(slope)), rim_speeds, yaw)
    }

    /// The slope *α* [rad].
    pub(in crate::studies) fn plane(&self, slope: f64) -> Ground {
        Ground::plane(self.soil, slope)
    }

    /// What decides the soil's reaction on the rover there.
    pub(in crate::studies) fn on_ground<'a>(&'a self, plane: &'a Ground) -> OnGround<'a> {
        OnGround {
            rover: &self.rover,
            ground: plane,
            gravity: self.gravity,
            model: self.model.as_ref(),
            sharing: self.sharing,
            own_moments: self.own_moments,
            differences: Differences::NONE,
        }
    }

    /// The slope on which the rover at rest tips over at a yaw *γ* [rad]: there the weight through
    /// its centre of mass meets the edge of the polygon of its wheels.
    #[must_use]
    pub fn tipping_slope(&self, yaw: f64) -> f64 {
        /// A slope on which everything tips [rad].
        const WALL: f64 = FRAC_PI_2 - 1e-6;
        let polygon = self.rover.support_polygon();
        let downhill = Vec2::new(-sin(yaw), -cos(yaw));
        let margin =
            |slope: f64| polygon.margin(downhill * (self.rover.centre_height() * tan(slope)));
        root::between(margin, 0.0, WALL, 1e-9)
    }
}
