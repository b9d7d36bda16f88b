//! A quasi-steady motion: on a plane, or over uneven ground.

use super::along_ground::{self, AlongGround};
use super::equations::Equations;
use super::point::Point;
use super::quasi_steady::{self, QuasiSteady};
use super::steady_state::{Before, NotSteady};
use crate::contact::Slip;
use crate::stored::stored;
use crate::vehicle::WheelReaction;

/// The motion of a rover whose wheels turn at given speeds, with steady velocities.
pub(super) enum SteadyRun<'a, 'g> {
    Plane(Box<QuasiSteady<'a, 'g>>),
    Uneven(Box<AlongGround<'a, 'g>>),
}

/// What one run hands on from one advance to the next.
#[derive(Clone, Default)]
#[expect(clippy::large_enum_variant, reason = "the large one is the usual one")]
pub(super) enum Carried {
    /// Nothing: the rover starts, rolling.
    #[default]
    Nothing,
    /// The velocities at the point: they were integrated.
    Velocities,
    Plane(quasi_steady::Carried),
    Uneven(Box<along_ground::Carried>),
}

stored!(enum Carried { 0 => Nothing, 1 => Velocities, 2 => Plane(carried), 3 => Uneven(carried) });

impl Carried {
    /// Whether a rover with so many wheels can have it.
    pub(super) fn is_of(&self, count: usize) -> bool {
        match self {
            Self::Plane(carried) => carried.is_of(count),
            Self::Uneven(carried) => carried.is_of(count),
            Self::Nothing | Self::Velocities => true,
        }
    }

    /// The wheels at a point of the motion, if it is one of steady states.
    pub(super) fn wheels(
        &self,
        equations: &Equations<'_>,
        point: &Point,
    ) -> Option<Vec<WheelReaction>> {
        match self {
            Self::Plane(carried) => Some(carried.wheels(equations, point)),
            Self::Uneven(carried) => Some(carried.wheels()),
            Self::Nothing | Self::Velocities => None,
        }
    }
}

impl<'a, 'g> SteadyRun<'a, 'g> {
    /// The motion from a point on; sets the point's velocities to their steady state.
    ///
    /// * `carried`: of the run so far
    /// * `time`: now [s]
    /// * `rims_changed`: whether they were others so far
    pub(super) fn from(
        equations: &'a Equations<'g>,
        carried: Carried,
        point: &mut Point,
        time: f64,
        rims_changed: bool,
    ) -> Result<Self, NotSteady> {
        if equations.has_relief() {
            let before = match carried {
                Carried::Nothing => Before::Nothing,
                Carried::Velocities | Carried::Plane(_) => Before::Another,
                Carried::Uneven(carried) => Before::Steady(*carried),
            };
            let motion = AlongGround::from(equations, before, point, rims_changed)?;
            return Ok(Self::Uneven(Box::new(motion)));
        }
        let before = match carried {
            Carried::Nothing => Before::Nothing,
            Carried::Velocities | Carried::Uneven(_) => Before::Another,
            Carried::Plane(carried) => Before::Steady(carried),
        };
        let motion = QuasiSteady::from(equations, before, point, time, rims_changed)?;
        Ok(Self::Plane(Box::new(motion)))
    }

    /// Goes on for a while.
    ///
    /// * `from`, `until`: from now to then [s]
    /// * `kept_until`: until when the rims will keep their speeds [s], not before that
    pub(super) fn advance(
        &mut self,
        point: &mut Point,
        [from, until]: [f64; 2],
        kept_until: f64,
    ) -> Result<(), NotSteady> {
        match self {
            Self::Plane(motion) => motion.advance(point, [from, until]),
            Self::Uneven(motion) => motion.advance(point, until - from, kept_until - from),
        }
    }

    /// The wheels at a point of the motion.
    pub(super) fn wheels(&self, point: &Point) -> Vec<WheelReaction> {
        match self {
            Self::Plane(motion) => motion.wheels(point),
            Self::Uneven(motion) => motion.wheels(),
        }
    }

    /// Their slip.
    pub(super) fn slips(&self, equations: &Equations<'_>, point: &Point) -> Vec<Slip> {
        match self {
            Self::Plane(_) => equations.slips(point),
            Self::Uneven(motion) => motion.slips(),
        }
    }

    /// What the next advance starts with.
    pub(super) fn carry(self) -> Carried {
        match self {
            Self::Plane(motion) => Carried::Plane(motion.carry()),
            Self::Uneven(motion) => Carried::Uneven(Box::new(motion.carry())),
        }
    }
}
