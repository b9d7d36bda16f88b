//! The ground by place: how high it is, how it is inclined, and what soil it is of.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use crate::elementary::wide;
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::units::{Vec2, Vec3};

pub mod elevation;
pub mod footprint;
pub mod height_field;
pub mod lunar;
pub mod roughness;
pub mod soil_field;
pub mod surface;
pub mod zones;

pub use elevation::{ElevationError, ElevationGrid, ElevationModel, Extent};
pub use footprint::Footprint;
pub use height_field::HeightField;
pub use soil_field::{SoilField, SoilScatter};
pub use surface::{AnalyticTerrain, Surface};
pub use zones::{Share, SoilZones, ZonePolygon, ZonesError};

/// Ground that a rover drives on.
///
/// Places are in the ground's own coordinates, those of a rover's position; on a plane they are
/// measured along it.
///
/// Ground of your own, a round hill: how steep is it under a wheel 1 m to the side of its top?
///
/// ```
/// # mod hakuto { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/by_hand/hakuto.rs")); }
/// use std::borrow::Cow;
///
/// use grouser_core::soil::Soil;
/// use grouser_core::terrain::{Footprint, Patch, Terrain};
/// use grouser_core::units::Vec2;
///
/// struct Hill {
///     soil: Soil,
/// }
/// impl Terrain for Hill {
///     fn patch(&self, at: Vec2, footprint: Footprint) -> Patch<'_> {
///         let height = |place: Vec2| -0.1 * place.norm_squared();
///         let fit = footprint.fit(&footprint.points(at).map(height));
///         Patch { height: fit.height, normal: fit.normal, soil: Cow::Borrowed(&self.soil) }
///     }
/// }
///
/// let hill = Hill { soil: hakuto::sand() };
/// let footprint = Footprint { forward: Vec2::x(), half_length: 0.05, half_width: 0.04 };
/// let patch = hill.patch(Vec2::new(0.0, 1.0), footprint);
/// let slope = patch.normal.z.acos();
/// assert_eq!(format!("{:.1}°", slope.to_degrees()), "11.3°");
/// ```
pub trait Terrain {
    /// The ground under a wheel, or under the rover.
    ///
    /// * `at`: the place below its centre [m]
    /// * `footprint`: how far from there the ground counts
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch<'_>;

    /// As [`patch`](Self::patch), of a place seen from an origin, so that the numbers of a far origin cost no precision.
    ///
    /// * `origin`: in the ground's coordinates [m]
    /// * `at`: seen from there [m]
    fn patch_from(&self, origin: Vec2, at: Vec2, footprint: Footprint) -> Patch<'_> {
        self.patch(origin + at, footprint)
    }

    /// Height of a place seen from an origin [m]. Ground that has no answer of its own has the mean height of a tiny patch.
    ///
    /// * `origin`: in the ground's coordinates [m]
    /// * `at`: seen from there [m]
    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        /// Half of the size of that patch [m]: rounding of map coordinates of 10⁴ km is a hundred-thousandth of it.
        const HALF: f64 = 1e-4;
        let tiny = Footprint { forward: Vec2::x(), half_length: HALF, half_width: HALF };
        self.patch_from(origin, at, tiny).height
    }

    /// The soil of that patch.
    fn soil(&self, at: Vec2, footprint: Footprint) -> Cow<'_, Soil> {
        self.patch(at, footprint).soil
    }

    /// Whether what is known of the ground reaches that far. Where it does not,
    /// [`patch`](Self::patch) has an answer all the same, which continues what is known.
    fn covers(&self, at: Vec2, footprint: Footprint) -> bool {
        let _ = (at, footprint);
        true
    }
}

/// A piece of ground, flat and of one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch<'a> {
    /// Height above the origin of the coordinates [m], against gravity.
    pub height: f64,
    /// Unit vector out of the ground: its parts along the coordinates' x and y, both taken level, and
    /// against gravity.
    pub normal: Vec3,
    /// The soil: the ground's own, or one made for the place.
    pub soil: Cow<'a, Soil>,
}

impl Patch<'_> {
    /// How fast the ground climbs along its x axis, which is square to y, and its y axis [-]: the sines
    /// of their inclinations. Gravity's pull along the ground points against it.
    #[must_use]
    pub fn climb(&self) -> Vec2 {
        let (x, y, z) = (self.normal.x, self.normal.y, self.normal.z);
        let across = (x * x + z * z).sqrt();
        Vec2::new(0.0 - x / across, -y * (z / across))
    }
}

/// A plane of homogeneous soil.
///
/// How high does a rover get that drives 2 m straight up a slope of 10°?
///
/// ```
/// # mod hakuto { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/by_hand/hakuto.rs")); }
/// use grouser_core::terrain::{Footprint, Plane, Terrain};
/// use grouser_core::units::{Vec2, deg};
///
/// let plane = Plane { soil: hakuto::sand(), slope: deg(10.0) };
/// let footprint = Footprint { forward: Vec2::y(), half_length: 0.05, half_width: 0.04 };
/// let patch = plane.patch(Vec2::new(0.0, 2.0), footprint);
/// assert_eq!(format!("{:.0} mm", 1e3 * patch.height), "347 mm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The soil.
    pub soil: Soil,
    /// Inclination, *α* [rad], 0 to below π/2; the plane rises along +y.
    pub slope: f64,
}

impl Plane {
    /// That there can be such a plane.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.soil.check()?;
        if (0.0..FRAC_PI_2).contains(&self.slope) {
            Ok(())
        } else {
            Err(ParameterError::new("slope [rad]", self.slope, "0 to below π/2"))
        }
    }
}

impl Terrain for Plane {
    fn patch(&self, at: Vec2, _: Footprint) -> Patch<'_> {
        let (sin, cos) = wide::sin_cos(self.slope);
        let soil = Cow::Borrowed(&self.soil);
        Patch { height: at.y * sin, normal: Vec3::new(0.0, -sin, cos), soil }
    }

    fn soil(&self, _: Vec2, _: Footprint) -> Cow<'_, Soil> {
        Cow::Borrowed(&self.soil)
    }
}
