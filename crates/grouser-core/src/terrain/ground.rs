//! The ground of a run: its shape, its soils, and where on it the run starts.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use super::{ElevationModel, Footprint, Patch, Plane, SoilZones, Surface, Terrain};
use crate::elementary::wide;
use crate::error::{ParameterError, finite};
use crate::soil::Soil;
use crate::units::{Vec2, Vec3};

/// The ground of a run, of which a plane is one shape among several.
///
/// Its places as a [`Terrain`] are seen from where the run starts, so that the large numbers of a
/// map's coordinates cost no precision.
///
/// How high above its start is a place 3 m uphill of it, on a slope of 10° and on a hill of one's
/// own?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::terrain::{Footprint, Ground, Patch, Terrain};
/// use grouser_core::units::{Vec2, deg};
///
/// struct Hill;
/// impl Terrain for Hill {
///     fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
///         footprint.fit(&footprint.points(at).map(|place| -0.1 * place.norm_squared()))
///     }
/// }
///
/// let footprint = Footprint { forward: Vec2::x(), half_length: 0.18, half_width: 0.24 };
/// let rise = |ground: Ground| {
///     let height = |at: Vec2| ground.patch(at, footprint).height;
///     format!("{:.2} m", height(Vec2::new(0.0, 3.0)) - height(Vec2::zeros()))
/// };
/// assert_eq!(rise(Ground::plane(paper::toyoura(), deg(10.0))), "0.52 m");
/// let hill = Ground::own(paper::toyoura(), Hill).starting_at(Vec2::new(0.0, -5.0));
/// assert_eq!(rise(hill), "2.10 m");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ground {
    /// The soil, where no zone has another one and the terrain has none of its own.
    pub soil: Soil,
    /// Its shape.
    pub shape: Shape,
    /// The start of the rover, of its body's centre of mass seen from above, in the coordinates of
    /// the shape [m].
    pub start: Vec2,
    /// Zones of other soils, in the coordinates of the shape, if there are any.
    pub zones: Option<Arc<SoilZones>>,
}

/// The shape of the ground.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A plane, whose coordinates lie in it: x along the contour, y uphill. A run on it takes
    /// closed forms.
    Plane(Plane),
    /// A map of heights.
    Map(Arc<ElevationModel>),
    /// Heights by formula.
    Formula(Surface),
    /// Any other terrain.
    Own(OwnTerrain),
}

/// A terrain that this crate does not know, shared by the runs on it.
#[derive(Clone)]
pub struct OwnTerrain(Arc<dyn Terrain>);

impl OwnTerrain {
    /// Shares a terrain.
    #[must_use]
    pub fn new(terrain: impl Terrain + 'static) -> Self {
        Self(Arc::new(terrain))
    }
}

impl fmt::Debug for OwnTerrain {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("OwnTerrain")
    }
}

/// Equal are those that are one.
impl PartialEq for OwnTerrain {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Ground {
    /// A plane of one soil.
    ///
    /// * `slope`: its inclination, *α* [rad]
    #[must_use]
    pub fn plane(soil: Soil, slope: f64) -> Self {
        Self::of(soil, Shape::Plane(Plane { slope }))
    }

    /// A map of heights, with one soil. A run starts at the origin of its coordinates unless
    /// [another place](Self::starting_at) is named.
    #[must_use]
    pub fn map(soil: Soil, heights: impl Into<Arc<ElevationModel>>) -> Self {
        Self::of(soil, Shape::Map(heights.into()))
    }

    /// Heights by formula, with one soil.
    #[must_use]
    pub fn formula(soil: Soil, surface: Surface) -> Self {
        Self::of(soil, Shape::Formula(surface))
    }

    /// Any terrain.
    ///
    /// * `soil`: where the terrain has none of its own
    #[must_use]
    pub fn own(soil: Soil, terrain: impl Terrain + 'static) -> Self {
        Self::of(soil, Shape::Own(OwnTerrain::new(terrain)))
    }

    /// A shape with one soil.
    #[must_use]
    pub fn of(soil: Soil, shape: Shape) -> Self {
        Self { soil, shape, start: Vec2::zeros(), zones: None }
    }

    /// The same ground for a run that starts elsewhere on it [m].
    #[must_use]
    pub fn starting_at(self, start: Vec2) -> Self {
        Self { start, ..self }
    }

    /// The same ground with zones of other soils.
    #[must_use]
    pub fn with_zones(self, zones: impl Into<Arc<SoilZones>>) -> Self {
        Self { zones: Some(zones.into()), ..self }
    }

    /// The same ground of another soil.
    #[must_use]
    pub fn with_soil(self, soil: Soil) -> Self {
        Self { soil, ..self }
    }

    /// A plane of this soil.
    ///
    /// * `slope`: its inclination, *α* [rad]
    #[must_use]
    pub fn with_slope(&self, slope: f64) -> Self {
        Self::plane(self.soil, slope)
    }

    /// The plane, where the ground is one.
    #[must_use]
    pub fn as_plane(&self) -> Option<Plane> {
        match self.shape {
            Shape::Plane(plane) => Some(plane),
            Shape::Map(_) | Shape::Formula(_) | Shape::Own(_) => None,
        }
    }

    /// Inclination of the plane, *α* [rad], where the ground is one.
    #[must_use]
    pub fn plane_slope(&self) -> Option<f64> {
        Some(self.as_plane()?.slope)
    }

    /// Whether it is a plane, whose coordinates lie in it.
    #[must_use]
    pub fn is_plane(&self) -> bool {
        self.as_plane().is_some()
    }

    /// Its heights, in the coordinates of its shape.
    #[must_use]
    pub fn terrain(&self) -> &dyn Terrain {
        match &self.shape {
            Shape::Plane(plane) => plane,
            Shape::Map(heights) => &**heights,
            Shape::Formula(surface) => surface,
            Shape::Own(terrain) => &*terrain.0,
        }
    }

    /// Checks that there can be such ground.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.soil.check()?;
        self.zones.as_ref().map_or(Ok(()), |zones| zones.check())?;
        self.start.iter().try_for_each(|place| finite("start on the ground [m]", *place))?;
        match &self.shape {
            Shape::Plane(plane) => plane.check(),
            Shape::Formula(surface) => surface.check(),
            Shape::Map(_) | Shape::Own(_) => Ok(()),
        }
    }

    /// The soil under a footprint where no zone has another one.
    ///
    /// * `at`: seen from the start [m]
    #[must_use]
    pub fn soil_under(&self, at: Vec2, footprint: Footprint) -> Cow<'_, Soil> {
        let own = self.terrain().soil(self.start + at, footprint);
        own.unwrap_or(Cow::Borrowed(&self.soil))
    }

    /// How the ground lies under a footprint, and how high it is there [m].
    ///
    /// * `at`: seen from the start [m]
    #[must_use]
    pub fn lie(&self, at: Vec2, footprint: Footprint) -> (Lie, f64) {
        let Patch { height, normal } = self.patch(at, footprint);
        let lie = if self.is_plane() {
            // Its coordinates lie in it, so that gravity leans.
            Lie { normal: Vec3::z(), up: Vec3::new(0.0, 0.0 - normal.y, normal.z) }
        } else {
            Lie { normal, up: Vec3::z() }
        };
        (lie, height)
    }
}

impl Terrain for Ground {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        self.terrain().patch_from(self.start, at, footprint)
    }

    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        self.terrain().height_from(self.start + origin, at)
    }

    fn soil(&self, at: Vec2, footprint: Footprint) -> Option<Cow<'_, Soil>> {
        Some(self.soil_under(at, footprint))
    }

    fn covers(&self, at: Vec2, footprint: Footprint) -> bool {
        self.terrain().covers(self.start + at, footprint)
    }
}

/// Ground less inclined than this is level: it has no uphill [rad], 0.05°. Source: ours; a rover's
/// inclinometer reads no finer, and it is far above what the rounding of a map's heights tilts (a
/// thousandth of a degree).
pub const LEVEL: f64 = 0.05 * std::f64::consts::PI / 180.0;

/// How the ground lies under a rover: where it faces, and where up is.
///
/// Both are unit vectors in the coordinates in which a run has its places and yaw. Those of a plane
/// lie in it, so that up leans; all others are level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lie {
    /// Out of the ground.
    pub normal: Vec3,
    /// Against gravity.
    pub up: Vec3,
}

impl Lie {
    /// Sine of the inclination [-].
    #[must_use]
    pub fn steepness(&self) -> f64 {
        self.climb().norm()
    }

    /// Whether the ground is as good as level.
    #[must_use]
    pub fn is_level(&self) -> bool {
        self.steepness() <= LEVEL
    }

    /// Up along the ground, as long as the sine of its inclination.
    fn climb(&self) -> Vec3 {
        self.up - self.normal * self.normal.dot(&self.up)
    }

    /// Uphill in the coordinates of places, a unit vector; none on [`LEVEL`] ground.
    #[must_use]
    pub fn uphill(&self) -> Option<Vec2> {
        if self.is_level() {
            return None;
        }
        self.climb().xy().try_normalize(0.0)
    }

    /// Direction of the contour line that has uphill to its left [rad], counter-clockwise from the
    /// x axis of places; none on [`LEVEL`] ground.
    #[must_use]
    pub fn contour(&self) -> Option<f64> {
        let uphill = self.uphill()?;
        Some(wide::atan2(0.0 - uphill.x, uphill.y))
    }

    /// Straight downhill along the axes of a body that stands on it, forward and to the left: a
    /// unit vector; none on [`LEVEL`] ground.
    ///
    /// * `yaw`: of the body [rad]
    #[must_use]
    pub fn downhill_of_body(&self, yaw: f64) -> Option<Vec2> {
        if self.is_level() {
            return None;
        }
        (-self.climb_of_body(yaw)).try_normalize(0.0)
    }

    /// How fast the ground climbs along the axes of a body that stands on it, forward and to the
    /// left: the sines of their inclinations [-].
    ///
    /// * `yaw`: of the body [rad]
    #[must_use]
    pub fn climb_of_body(&self, yaw: f64) -> Vec2 {
        let (sin, cos) = wide::sin_cos(yaw);
        // The nose lies on the ground and, seen along z, in the direction of the yaw.
        let drop = (cos * self.normal.x + sin * self.normal.y) / self.normal.z;
        let forward = Vec3::new(cos, sin, 0.0 - drop).normalize();
        let left = self.normal.cross(&forward);
        Vec2::new(forward.dot(&self.up), left.dot(&self.up))
    }
}
