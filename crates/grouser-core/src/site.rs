//! Where the rover drives: ground under some gravity.

use crate::error::{ParameterError, positive};
use crate::soil::Soil;
use crate::terrain::{Patch, Plane, Terrain};
use crate::units::Vec2;

/// Ground under some gravity: a [`Plane`], unless another terrain is named.
///
/// With which force does a slope of 10° pull a rover of 6.9 kg downhill, on the Earth and on the Moon?
///
/// ```
/// # mod hakuto { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/by_hand/hakuto.rs")); }
/// use grouser_core::site::Site;
/// use grouser_core::terrain::{Footprint, Terrain};
/// use grouser_core::units::{EARTH_GRAVITY, MOON_GRAVITY, Vec2, deg};
///
/// let pull = |gravity: f64| {
///     let site = Site::plane(hakuto::sand(), deg(10.0), gravity);
///     let rover = Footprint { forward: Vec2::x(), half_length: 0.19, half_width: 0.24 };
///     let weight = site.weight(6.9, &site.terrain.patch(Vec2::zeros(), rover));
///     format!("{:.2} N", weight.uphill.y)
/// };
/// assert_eq!(pull(EARTH_GRAVITY), "11.75 N");
/// assert_eq!(pull(MOON_GRAVITY), "1.94 N");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site<T: ?Sized = Plane> {
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The ground.
    pub terrain: T,
}

impl Site {
    /// A plane of one soil.
    ///
    /// * `slope`: its inclination, *α* [rad]
    /// * `gravity`: *g* [m/s²]
    #[must_use]
    pub fn plane(soil: Soil, slope: f64, gravity: f64) -> Self {
        Self { gravity, terrain: Plane { soil, slope } }
    }

    /// The same plane of another soil.
    #[must_use]
    pub fn with_soil(self, soil: Soil) -> Self {
        Self { terrain: Plane { soil, ..self.terrain }, ..self }
    }

    /// The same soil on another slope [rad].
    #[must_use]
    pub fn with_slope(self, slope: f64) -> Self {
        Self { terrain: Plane { slope, ..self.terrain }, ..self }
    }

    /// That there can be such a place.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.terrain.soil.check()?;
        positive("gravity [m/s²]", self.gravity)?;
        self.terrain.check()
    }
}

/// A mass's weight, in the frame of the ground that it is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// Into the ground [N].
    pub into: f64,
    /// Up the ground's x and y axes [N], against the pull along it.
    pub uphill: Vec2,
}

impl<T: Terrain + ?Sized> Site<T> {
    /// The weight of a mass [kg] on a patch of the ground.
    #[must_use]
    pub fn weight(&self, mass: f64, patch: &Patch<'_>) -> Weight {
        let weight = mass * self.gravity;
        Weight { into: weight * patch.normal.z, uphill: weight * patch.climb() }
    }
}
