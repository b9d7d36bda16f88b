//! Balances of a heading by brackets: slower than following the curve, and sure where its forces
//! are continuous.

use super::first_rise::LAST;
use super::path::{CLOSE, NEXT_SLOPES, Path, Place, Point};
use crate::root;

/// The first half-width of a bracket around the last point [-, rad].
const NARROW: f64 = 1e-4;
/// How often it is doubled: to 0.1.
const DOUBLINGS: u32 = 10;

impl Path<'_> {
    /// Whether the course leads straight up or down the slope, so that nothing pulls sideways.
    pub(super) fn is_straight(&self) -> bool {
        self.yaw_at_rest().abs() >= super::study::STRAIGHT_UP
    }

    /// A next point on a steeper slope, where steps along the curve lead to none: brackets in slip,
    /// and around them in crab angle, on both sides of the last point.
    pub(super) fn next_by_bracket(&self, here: &Point) -> Option<Point> {
        NEXT_SLOPES.iter().find_map(|rise| self.bracketed_on(here.place.z + rise, &here.place))
    }

    /// The balance of wheels that skid more, beyond a fold where they skid: pull is not monotone in
    /// skid, and where it no longer holds a rover that goes downhill the rover gets faster, until
    /// its wheels skid enough.
    pub(super) fn deeper_skid(&self, here: &Point) -> Option<Point> {
        /// Slopes above the last point on which it is looked for [rad]: the fold lies within a
        /// step.
        const RISES: [f64; 3] = [2e-3, 1e-2, 5e-2];
        if here.place.x >= 0.0 || !self.is_straight() {
            return None;
        }
        RISES.iter().find_map(|rise| self.bracketed_on(here.place.z + rise, &here.place))
    }

    /// The point on a slope that is nearest to another.
    fn bracketed_on(&self, slope: f64, near: &Place) -> Option<Point> {
        let crab = if self.is_straight() {
            near.y
        } else {
            // Turning further uphill gains side force.
            let across = |crab: f64| {
                let slip = self.slip_near(near.x, crab, slope)?;
                Some(self.left_over(&Place::new(slip, crab, slope))?[1])
            };
            widened(across, near.y, (0.0, f64::INFINITY))?
        };
        let slip_ratio = self.slip_near(near.x, crab, slope)?;
        let place = Place::new(slip_ratio, crab, slope);
        let left_over = self.left_over(&place)?;
        let is_balanced = left_over.iter().all(|it| it.abs() < CLOSE);
        if is_balanced { self.point(place).ok() } else { None }
    }

    /// The slip nearest to another at which the thrust comes to suffice.
    fn slip_near(&self, near: f64, crab: f64, slope: f64) -> Option<f64> {
        widened(
            |slip| Some(self.left_over(&Place::new(slip, crab, slope))?[0]),
            near,
            (-LAST, LAST),
        )
    }
}

/// The root of a function near a place, where it rises through zero.
///
/// * `range`: of its argument
fn widened(f: impl Fn(f64) -> Option<f64>, near: f64, range: (f64, f64)) -> Option<f64> {
    let start = (near, f(near)?);
    let side = if start.1 < 0.0 { 1.0 } else { -1.0 };
    let mut inner = start;
    let mut width = NARROW;
    for _ in 0..=DOUBLINGS {
        let at = (near + side * width).clamp(range.0, range.1);
        let outer = (at, f(at)?);
        if (outer.1 < 0.0) != (start.1 < 0.0) {
            let within = |x: f64| f(x).unwrap_or(f64::NAN);
            return Some(root::bracketed(within, inner, outer, 1e-14, 0.0).0);
        }
        inner = outer;
        width *= 2.0;
    }
    None
}
