//! Craters.

use super::shapes::place;
use crate::elementary::wide;
use crate::error::{ParameterError, not_negative, positive};
use crate::units::Vec2;

/// A bowl with a raised rim in level ground.
///
/// ```text
/// z = h + d (2 x² − x⁴ − 1)          x = r/R ≤ 1              bowl
/// z = h (1 − u)³ (1 + 3 u)           u = (r − R)/w, 0 to 1    rim and blanket of ejecta
/// z = 0                              beyond
/// ```
///
/// with the distance *r* from the centre, the radius *R* of the crest, the depth *d* below the
/// crest, the crest's height *h* and the width *w* of the rim's outer slope. Sizes of fresh craters
/// are from [Pike1977]. The usual shape between them is a paraboloid, d x² from the floor up, with
/// a blanket ∝ (R/r)³ outside ([McGetchin1973], as in [MartinEtAl2014]). DIFFERENCE: these meet in
/// an edge at the crest, with 38° inside; ours has a level crest and a continuous gradient, so that
/// heights and slopes converge on finer grids. It is at most d/4 above that paraboloid, at x =
/// 0.71, and within 0.18 h of that blanket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crater {
    /// Where its centre is [m].
    pub centre: Vec2,
    /// Diameter of the crest, 2 *R* [m].
    pub diameter: f64,
    /// How far the centre is below the crest, *d* [m].
    pub depth: f64,
    /// How far the crest is above the ground about it, *h* [m].
    pub rim_height: f64,
    /// How far from the crest the ground is level again, *w* [m].
    pub rim_width: f64,
}

/// Depth of a fresh simple crater over its diameter [-]. Source: [Pike1977], 0.196 D^1.010 in km;
/// the power is left out, which changes a crater of 10 m by 5 %.
const DEPTH: f64 = 0.196;
/// Height of its rim over its diameter [-]. Source: [Pike1977], 0.036 D^1.014 in km; without the
/// power.
const RIM_HEIGHT: f64 = 0.036;
/// Width of its rim's outer slope over its diameter [-]. Source: [Pike1977], 0.257 D^1.011 in km;
/// without the power.
const RIM_WIDTH: f64 = 0.257;

impl Crater {
    /// A fresh simple crater, as small ones on the Moon are: 0.196 of its diameter deep below a rim
    /// of 0.036. Its walls are up to 31° steep.
    ///
    /// * `centre`: where it is [m]
    /// * `diameter`: of its crest [m], below 15 km
    #[must_use]
    pub fn fresh(centre: Vec2, diameter: f64) -> Self {
        let [depth, rim_height, rim_width] =
            [DEPTH, RIM_HEIGHT, RIM_WIDTH].map(|ratio| ratio * diameter);
        Self { centre, diameter, depth, rim_height, rim_width }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        place("centre of the crater [m]", self.centre)?;
        positive("diameter of the crater [m]", self.diameter)?;
        not_negative("depth of the crater [m]", self.depth)?;
        not_negative("height of the crater's rim [m]", self.rim_height)?;
        positive("width of the crater's rim [m]", self.rim_width)
    }

    pub(super) fn height(&self, at: Vec2) -> f64 {
        let (h, d) = (self.rim_height, self.depth);
        match self.part(at) {
            Part::Bowl { x } => h + d * (2.0 * x * x - x * x * x * x - 1.0),
            Part::Rim { u } => h * (1.0 - u) * (1.0 - u) * (1.0 - u) * (1.0 + 3.0 * u),
            Part::Beyond => 0.0,
        }
    }

    pub(super) fn gradient(&self, at: Vec2) -> Vec2 {
        let from = at - self.centre;
        let outward = match self.part(at) {
            Part::Bowl { x } => {
                let radius = 0.5 * self.diameter;
                // Over x, so that the centre has a direction, too.
                return from * (4.0 * self.depth * (1.0 - x * x) / (radius * radius));
            }
            Part::Rim { u } => -12.0 * self.rim_height * u * (1.0 - u) * (1.0 - u) / self.rim_width,
            Part::Beyond => return Vec2::zeros(),
        };
        from * (outward / wide::hypot(from.x, from.y))
    }

    fn part(&self, at: Vec2) -> Part {
        let from = at - self.centre;
        let (r, radius) = (wide::hypot(from.x, from.y), 0.5 * self.diameter);
        let u = (r - radius) / self.rim_width;
        if u <= 0.0 {
            Part::Bowl { x: r / radius }
        } else if u < 1.0 {
            Part::Rim { u }
        } else {
            Part::Beyond
        }
    }
}

/// Where a place is.
enum Part {
    /// Distance from the centre over the radius [-].
    Bowl {
        x: f64,
    },
    /// Distance from the crest over the rim's width [-].
    Rim {
        u: f64,
    },
    Beyond,
}
