//! The plane under a wheel on uneven ground.

use nalgebra::Matrix3;

use super::{HeightField, Patch};
use crate::units::{Vec2, Vec3};

/// How far ground counts for a wheel: a rectangle about the point below its hub, level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// The wheel's direction: a unit vector.
    pub forward: Vec2,
    /// Half of its length along the wheel [m].
    pub half_length: f64,
    /// Half of its width [m].
    pub half_width: f64,
}

/// A wheel's footprint reaches so far along it, over its shearing radius [-]: a wheel sunk by 15 %
/// of its radius touches the soil over this length ahead of its lowest point. Source: ours.
pub const REACH: f64 = 0.5;

/// How many points of a footprint tell the ground there.
pub const POINTS: usize = 9;

/// The points, in halves of the length and of the width.
const GRID: [(f64, f64); POINTS] = [
    (-1.0, -1.0),
    (0.0, -1.0),
    (1.0, -1.0),
    (-1.0, 0.0),
    (0.0, 0.0),
    (1.0, 0.0),
    (-1.0, 1.0),
    (0.0, 1.0),
    (1.0, 1.0),
];

impl Footprint {
    /// Returns the footprint of a wheel.
    ///
    /// * `axle`: a unit vector along it, to the left, whose z points upward
    /// * `shearing_radius`, `width`: of the wheel [m]
    #[must_use]
    pub fn of_wheel(axle: Vec3, shearing_radius: f64, width: f64) -> Self {
        /// The level part of an axle shorter than this has no direction [-].
        const UPRIGHT: f64 = 1e-9;
        let level = axle.xy();
        let length = (level.x * level.x + level.y * level.y).sqrt();
        // A wheel that lies flat has no side: any will do.
        let left = if length > UPRIGHT { level / length } else { Vec2::y() };
        Self {
            forward: Vec2::new(left.y, -left.x),
            half_length: REACH * shearing_radius,
            half_width: 0.5 * width,
        }
    }

    fn left(&self) -> Vec2 {
        Vec2::new(-self.forward.y, self.forward.x)
    }

    /// The points whose heights tell the ground about a place [m].
    #[must_use]
    pub fn points(&self, at: Vec2) -> [Vec2; POINTS] {
        let (along, aside) = (self.half_length * self.forward, self.half_width * self.left());
        GRID.map(|(a, b)| at + a * along + b * aside)
    }

    /// The least-squares plane through the ground at its [`points`](Self::points).
    ///
    /// * `heights`: there [m]
    #[must_use]
    pub fn fit(&self, heights: &[f64; POINTS]) -> Patch {
        // On this grid least squares are means: Σa² = Σb² = 6 over nine points.
        const SQUARES: f64 = 6.0;
        let (mut mean, mut along, mut aside) = (0.0, 0.0, 0.0);
        for ((a, b), height) in GRID.into_iter().zip(heights) {
            mean += height / POINTS as f64;
            along += a * height / (SQUARES * self.half_length);
            aside += b * height / (SQUARES * self.half_width);
        }
        let uphill = along * self.forward + aside * self.left();
        let normal = Vec3::new(-uphill.x, -uphill.y, 1.0).normalize();
        Patch { height: mean, normal }
    }
}

/// A frame in which ground is a height over x and y, as the world of another engine has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundFrame {
    origin: Vec3,
    axes: Matrix3<f64>,
}

impl GroundFrame {
    /// The frame of a ground.
    ///
    /// * `origin`: in the world [m]
    /// * `axes`: as columns of a matrix, row by row
    #[must_use]
    pub fn new(origin: [f64; 3], axes: [f64; 9]) -> Self {
        Self { origin: origin.into(), axes: Matrix3::from_row_slice(&axes) }
    }

    /// The footprint of a wheel, and its hub, in this frame.
    ///
    /// * `hub`, `axle`: in the world
    /// * `shearing_radius`, `width`: of the wheel [m]
    #[must_use]
    pub fn footprint(
        &self,
        hub: Vec3,
        axle: Vec3,
        shearing_radius: f64,
        width: f64,
    ) -> (Footprint, Vec3) {
        let footprint = Footprint::of_wheel(self.axes.tr_mul(&axle), shearing_radius, width);
        (footprint, self.axes.tr_mul(&(hub - self.origin)))
    }

    /// A plane as the world sees it: its normal, and a hub's distance from it [m].
    ///
    /// * `fit`, `hub`: in this frame
    #[must_use]
    pub fn plane(&self, fit: Patch, hub: Vec3) -> (Vec3, f64) {
        (self.axes * fit.normal, (hub.z - fit.height) * fit.normal.z)
    }

    /// The plane under a wheel on a height field, as the world sees it.
    ///
    /// * `footprint`, `hub`: in this frame
    #[must_use]
    pub fn plane_on(
        &self,
        field: &HeightField<'_>,
        footprint: Footprint,
        hub: Vec3,
    ) -> (Vec3, f64) {
        let heights = footprint.points(hub.xy()).map(|point| field.height(point));
        self.plane(footprint.fit(&heights), hub)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane is its own least-squares plane, wherever the wheel points.
    #[test]
    fn the_plane_under_a_wheel_on_a_plane_is_that_plane() {
        for axle in [Vec3::y(), Vec3::new(-0.6, 0.8, 0.0), Vec3::new(0.6, 0.0, 0.8), Vec3::z()] {
            let footprint = Footprint::of_wheel(axle, 0.11, 0.08);
            let at = Vec2::new(0.3, -0.7);
            let height = |place: Vec2| 0.1 + 0.2 * place.x - 0.4 * place.y;
            let fit = footprint.fit(&footprint.points(at).map(height));
            assert!((fit.height - height(at)).abs() < 1e-14);
            let normal = Vec3::new(-0.2, 0.4, 1.0).normalize();
            assert!((fit.normal - normal).norm() < 1e-14, "{fit:?}");
        }
    }

    /// A ridge across the wheel is evened out; one along it tilts a wheel at its side.
    #[test]
    fn what_is_smaller_than_a_footprint_is_evened_out() {
        let footprint = Footprint::of_wheel(Vec3::y(), 0.1, 0.06);
        assert_eq!(footprint.forward, Vec2::x());
        let ridge = |place: Vec2| if place.x.abs() < 0.01 { 0.03 } else { 0.0 };
        let fit = footprint.fit(&footprint.points(Vec2::zeros()).map(ridge));
        assert!((fit.height - 0.01).abs() < 1e-15 && (fit.normal - Vec3::z()).norm() < 1e-15);
        let step = |place: Vec2| if place.y > 0.01 { 0.03 } else { 0.0 };
        let fit = footprint.fit(&footprint.points(Vec2::zeros()).map(step));
        let slope = 3.0 * 0.03 / (6.0 * 0.03);
        assert!((fit.normal - Vec3::new(0.0, -slope, 1.0).normalize()).norm() < 1e-15);
    }
}
