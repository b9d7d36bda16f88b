//! What a rover meets: the ground below it, how its weight acts there, and what the wheels come to.

use nalgebra::Rotation2;

use super::by_wheel::Differences;
use super::load::{self, LoadSharing, OwnMoments, Tipping};
use super::posture::NoPosture;
use super::rover::Rover;
use super::state::RoverState;
use crate::contact::{SettleError, Settled, Slip, WheelForces, WheelSoilModel};
use crate::error::ParameterError;
use crate::stored::stored;
use crate::terrain::Ground;
use crate::units::Vec2;

/// What decides the soil's reaction on a rover, besides its motion.
#[derive(Clone, Copy)]
pub struct OnGround<'a> {
    /// The rover.
    pub rover: &'a Rover,
    /// What it stands on.
    pub ground: &'a Ground,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: &'a dyn WheelSoilModel,
    /// How the weight is shared.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
    /// How the soil below each wheel differs from that of the ground.
    pub differences: Differences<'a>,
}

/// One wheel, settled under its load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelReaction {
    /// How it moves against the soil.
    pub slip: Slip,
    /// Its load [N].
    pub load: f64,
    /// Its sinkage and the soil's forces.
    pub settled: Settled,
}

stored!(struct WheelReaction { slip, load, settled });

/// Why the wheels do not settle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReactionError {
    /// The weight falls outside the wheels.
    #[error(transparent)]
    Tipping(#[from] Tipping),
    /// The rover does not come to stand.
    #[error(transparent)]
    NoPosture(#[from] NoPosture),
    /// The ground is not known there.
    #[error(
        "wheel {wheel} is at x = {x:.3} m, y = {y:.3} m, where the map has no heights",
        x = place.x,
        y = place.y
    )]
    OffTheMap {
        /// The wheel's name.
        wheel: String,
        /// Where it meets the ground, in the map's coordinates [m].
        place: Vec2,
    },
    /// One wheel's load is more than the soil carries.
    #[error("wheel {wheel}: {source}")]
    Wheel {
        /// The wheel's name.
        wheel: String,
        /// What is wrong with it.
        source: SettleError,
    },
    /// Loads and reactions of wheels on uneven ground did not settle on each other.
    #[error(
        "no wheel loads were found that balance the rover with the soil's forces under them: the \
         last ones change that of wheel {wheel} most, by {change:.1e} of the weight"
    )]
    LoadsDoNotSettle {
        /// Name of the wheel whose load changes most.
        wheel: String,
        /// The change over the weight [-].
        change: f64,
    },
    /// Loads and torques did not settle on each other.
    #[error(
        "the wheel loads did not settle: after {rounds} rounds they still move by {change:.1e}, \
         that of wheel {wheel} most"
    )]
    Unsettled {
        /// Name of the wheel whose load moves most.
        wheel: String,
        /// How often they were computed.
        rounds: u32,
        /// Change of the moments in the last round, over weight times track [-].
        change: f64,
    },
}

/// Where a rover stands, and how its weight acts there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Position of the body's centre of mass, in the slope frame [m].
    pub place: Vec2,
    /// The rotation that takes vectors of the body frame to the slope frame.
    pub slope_from_body: Rotation2<f64>,
    /// The weight's part into the ground [N].
    pub weight: f64,
    /// The weight's pull along the ground, in the body frame, *(G_x, G_y)* [N].
    pub pull: Vec2,
    /// Tangent of the ground's inclination [-].
    pub steepness: f64,
}

impl OnGround<'_> {
    /// Checks that each soil of the ground resists each wheel of the rover, as a soil with a
    /// negative modulus of pressure-sinkage does for some widths only. A
    /// [`Terrain`](crate::terrain::Terrain) with soils of its own is not asked for them.
    ///
    /// # Errors
    /// [`ParameterError`] for the first wheel that has no stiffness under it.
    pub fn check_soils(&self) -> Result<(), ParameterError> {
        let zones = self.ground.zones.iter().flat_map(|zones| &zones.soils);
        let wheels = || self.rover.mounts().iter().map(|mount| &mount.unit.wheel);
        std::iter::once(&self.ground.soil)
            .chain(zones)
            .flat_map(|soil| wheels().map(move |wheel| (soil, wheel)))
            .try_for_each(|(soil, wheel)| soil.check_under(wheel, self.gravity))
    }

    /// Where the rover stands in a state, and how its weight acts there.
    #[must_use]
    pub fn stance(&self, state: &RoverState) -> Stance {
        let slope_from_body = state.slope_from_body();
        let weight = load::weight(self.rover, self.ground, self.gravity, state, &slope_from_body);
        let pull = load::pull(&weight, &slope_from_body);
        let (into, along) = (weight.into, weight.uphill.norm());
        let steepness = if into > 0.0 { along / into } else { 0.0 };
        Stance { place: state.position, slope_from_body, weight: into, pull, steepness }
    }

    /// Whether loads depend on the wheels' forces.
    pub(super) fn is_coupled(&self) -> bool {
        let Self { sharing, own_moments, .. } = *self;
        sharing.has_torque()
            || (own_moments == OwnMoments::Included && sharing != LoadSharing::Uniform)
    }
}

/// The soil's forces of each wheel.
pub fn forces_of(wheels: &[WheelReaction]) -> impl Iterator<Item = &WheelForces> {
    wheels.iter().map(|wheel| &wheel.settled.forces)
}
