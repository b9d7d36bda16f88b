//! Ground by formulas: planes, ramps, cones, ripples and craters.

mod crater;
mod shapes;

pub use crater::Crater;
pub use shapes::{Cone, Incline, Ramp, Ripple};

use super::{Footprint, Patch, Terrain};
use crate::error::ParameterError;
use crate::units::Vec2;

/// A surface whose height and gradient are formulas.
///
/// Places are on a map, x east and y north, and heights are against gravity, all in metres.
/// Directions are from east, counter-clockwise. Where a surface has an edge, between the level
/// ground and a ramp without a rounding or at the tip of a cone, its gradient is that of one side.
///
/// How high does the rim of a fresh crater of 20 m stand, and how deep is its middle?
///
/// ```
/// use grouser_core::terrain::surface::{Crater, Surface};
/// use grouser_core::units::Vec2;
///
/// let crater = Surface::Crater(Crater::fresh(Vec2::zeros(), 20.0));
/// let height = |x: f64| format!("{:+.2} m", crater.height(Vec2::new(x, 0.0)));
/// assert_eq!([height(10.0), height(0.0)], ["+0.72 m", "-3.20 m"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Surface {
    /// A plane through the origin.
    Incline(Incline),
    /// An incline between two level pieces of ground.
    Ramp(Ramp),
    /// A hill or a pit of even slope.
    Cone(Cone),
    /// Waves of one length.
    Ripple(Ripple),
    /// A bowl with a rim.
    Crater(Crater),
}

impl Surface {
    /// Checks that the surface's values are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Incline(incline) => incline.check(),
            Self::Ramp(ramp) => ramp.check(),
            Self::Cone(cone) => cone.check(),
            Self::Ripple(ripple) => ripple.check(),
            Self::Crater(crater) => crater.check(),
        }
    }

    /// Height at a place [m].
    #[must_use]
    pub fn height(&self, at: Vec2) -> f64 {
        match self {
            Self::Incline(incline) => incline.height(at),
            Self::Ramp(ramp) => ramp.height(at),
            Self::Cone(cone) => cone.height(at),
            Self::Ripple(ripple) => ripple.heights()(at),
            Self::Crater(crater) => crater.height(at),
        }
    }

    /// Heights at several places [m]: what is the same at all of them is computed once.
    #[must_use]
    pub fn heights<const N: usize>(&self, at: [Vec2; N]) -> [f64; N] {
        match self {
            Self::Incline(incline) => {
                let gradient = incline.gradient();
                at.map(|place| gradient.dot(&place))
            }
            Self::Ripple(ripple) => at.map(ripple.heights()),
            _ => at.map(|place| self.height(place)),
        }
    }

    /// How fast the height grows at a place, to the east and to the north [-].
    #[must_use]
    pub fn gradient(&self, at: Vec2) -> Vec2 {
        match self {
            Self::Incline(incline) => incline.gradient(),
            Self::Ramp(ramp) => ramp.gradient(at),
            Self::Cone(cone) => cone.gradient(at),
            Self::Ripple(ripple) => ripple.gradient(at),
            Self::Crater(crater) => crater.gradient(at),
        }
    }
}

/// A wheel meets the least-squares plane of the surface at the points of its footprint
/// ([`Footprint::fit`]).
///
/// How steep is a ripple 1 m long and 10 cm from trough to crest, at most, under a wheel?
///
/// ```
/// use grouser_core::terrain::surface::{Ripple, Surface};
/// use grouser_core::terrain::{Footprint, Terrain};
/// use grouser_core::units::Vec2;
///
/// let ripple = Ripple { amplitude: 0.05, wavelength: 1.0, across: 0.0, phase: 0.0 };
/// let terrain = Surface::Ripple(ripple);
/// let wheel = Footprint { forward: Vec2::x(), half_length: 0.06, half_width: 0.05 };
/// let steepest = terrain.patch(Vec2::zeros(), wheel).normal.z.acos();
/// assert_eq!(format!("{:.1}°", steepest.to_degrees()), "17.1°");
/// ```
impl Terrain for Surface {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        footprint.fit(&self.heights(footprint.points(at)))
    }

    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        self.height(origin + at)
    }
}
