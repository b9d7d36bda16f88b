//! The ground by place: how high it is, how it is inclined, and what soil it is of.

use std::borrow::Cow;

use crate::soil::Soil;
use crate::units::{Vec2, Vec3};

pub mod elevation;
pub mod footprint;
pub mod ground;
pub mod height_field;
pub mod lunar;
pub mod plane;
pub mod roughness;
pub mod soil_field;
pub mod surface;
pub mod zones;

pub use elevation::{ElevationError, ElevationGrid, ElevationModel, Extent};
pub use footprint::{Footprint, GroundFrame};
pub use ground::{Ground, Lie, OwnTerrain, Shape};
pub use height_field::HeightField;
pub use plane::Plane;
pub use soil_field::{SoilField, SoilScatter};
pub use surface::Surface;
pub use zones::{Share, SoilZones, ZonePolygon, ZonesError};

/// The shape of ground that a rover drives on, and its soil where it has one of its own. A run
/// takes any by its [`Ground`].
///
/// Places are in the ground's own coordinates, those of a rover's position; on a plane they are
/// measured along it.
///
/// Ground of your own, a round hill: how steep is it under a wheel 1 m to the side of its top?
///
/// ```
/// use grouser_core::terrain::{Footprint, Patch, Terrain};
/// use grouser_core::units::Vec2;
///
/// struct Hill;
/// impl Terrain for Hill {
///     fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
///         footprint.fit(&footprint.points(at).map(|place| -0.1 * place.norm_squared()))
///     }
/// }
///
/// let footprint = Footprint { forward: Vec2::x(), half_length: 0.05, half_width: 0.04 };
/// let patch = Hill.patch(Vec2::new(0.0, 1.0), footprint);
/// let slope = patch.normal.z.acos();
/// assert_eq!(format!("{:.1}°", slope.to_degrees()), "11.3°");
/// ```
pub trait Terrain: Send + Sync {
    /// The ground under a wheel, or under the rover.
    ///
    /// * `at`: the place below its centre [m]
    /// * `footprint`: how far from there the ground counts
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch;

    /// Does what [`patch`](Self::patch) does, for a place seen from an origin, so that the numbers
    /// of a far origin cost no precision.
    ///
    /// * `origin`: in the ground's coordinates [m]
    /// * `at`: seen from there [m]
    fn patch_from(&self, origin: Vec2, at: Vec2, footprint: Footprint) -> Patch {
        self.patch(origin + at, footprint)
    }

    /// Height of a place seen from an origin [m]. Ground that has no answer of its own has the mean
    /// height of a tiny patch.
    ///
    /// * `origin`: in the ground's coordinates [m]
    /// * `at`: seen from there [m]
    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        /// Half of the size of that patch [m]: rounding of map coordinates of 10⁴ km is a
        /// hundred-thousandth of it.
        const HALF: f64 = 1e-4;
        let tiny = Footprint { forward: Vec2::x(), half_length: HALF, half_width: HALF };
        self.patch_from(origin, at, tiny).height
    }

    /// The soil there, where the terrain has one of its own; otherwise it is that of the run's
    /// [`Ground`].
    fn soil(&self, at: Vec2, footprint: Footprint) -> Option<Cow<'_, Soil>> {
        let _ = (at, footprint);
        None
    }

    /// Whether what is known of the ground reaches that far. Where it does not,
    /// [`patch`](Self::patch) has an answer all the same, which continues what is known.
    fn covers(&self, at: Vec2, footprint: Footprint) -> bool {
        let _ = (at, footprint);
        true
    }
}

/// A flat piece of ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Height above the origin of the coordinates [m], against gravity.
    pub height: f64,
    /// Unit vector out of the ground: its parts along the coordinates' x and y, both taken level,
    /// and against gravity.
    pub normal: Vec3,
}

impl Patch {
    /// How fast the ground climbs along its x axis, which is square to y, and its y axis [-]: the
    /// sines of their inclinations. Gravity's pull along the ground points against it.
    #[must_use]
    pub fn climb(&self) -> Vec2 {
        let (x, y, z) = (self.normal.x, self.normal.y, self.normal.z);
        let across = (x * x + z * z).sqrt();
        Vec2::new(0.0 - x / across, -y * (z / across))
    }
}
