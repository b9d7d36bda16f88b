//! How a slope is looked at: from downhill, ahead and above, without perspective.

use crate::sheet::Place;
use grouser_core::elementary::wide;
use grouser_core::units::Vec3;

/// How far the view is turned from straight uphill, towards where a traverse comes from [rad].
const AZIMUTH: f64 = 32.0 * std::f64::consts::PI / 180.0;
/// How far it looks down from the horizon [rad].
const ELEVATION: f64 = 30.0 * std::f64::consts::PI / 180.0;

/// A parallel projection of the slope frame. Places on the picture are to the right, and down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    /// To the right on the picture, in the slope frame.
    right: Vec3,
    /// Upwards on the picture.
    up: Vec3,
    /// Towards the eye.
    pub(crate) towards: Vec3,
    /// What is vertical, upwards.
    pub(crate) vertical: Vec3,
    /// What is horizontal and uphill.
    pub(crate) horizontal: Vec3,
    /// Millimetres of the picture for a metre.
    pub(crate) scale: f64,
    /// Where the slope frame's origin is on the picture [mm].
    pub(crate) origin: Place,
}

impl Camera {
    /// The camera over a slope, with a millimetre for a metre.
    ///
    /// * `slope`: inclination [rad]
    pub(crate) fn over(slope: f64) -> Self {
        let [(sin_a, cos_a), (sin_e, cos_e)] = [AZIMUTH, ELEVATION].map(wide::sin_cos);
        let (sin, cos) = wide::sin_cos(slope);
        // From the horizon's frame (along the contour, horizontally uphill, upright) to the
        // slope's.
        let of_slope =
            |v: [f64; 3]| Vec3::new(v[0], v[1] * cos + v[2] * sin, -v[1] * sin + v[2] * cos);
        Self {
            right: of_slope([cos_a, sin_a, 0.0]),
            up: of_slope([-sin_a * sin_e, cos_a * sin_e, cos_e]),
            towards: of_slope([sin_a * cos_e, -cos_a * cos_e, sin_e]),
            vertical: of_slope([0.0, 0.0, 1.0]),
            horizontal: of_slope([0.0, 1.0, 0.0]),
            scale: 1.0,
            origin: [0.0, 0.0],
        }
    }

    /// Where a point of the slope frame [m] is on the picture [mm].
    pub(crate) fn place(&self, point: Vec3) -> Place {
        let [x, y] = self.way(point);
        [self.origin[0] + x, self.origin[1] + y]
    }

    /// The way on the picture [mm] of a way in the slope frame [m].
    pub(crate) fn way(&self, way: Vec3) -> Place {
        [self.scale * self.right.dot(&way), -self.scale * self.up.dot(&way)]
    }

    /// The same camera, with a scale and a place such that points fill a rectangle.
    pub(crate) fn framing(self, points: &[Vec3], [left, top]: Place, size: Place) -> Self {
        let plain = Self { scale: 1.0, origin: [0.0, 0.0], ..self };
        let places: Vec<Place> = points.iter().map(|point| plain.place(*point)).collect();
        let end = |k: usize, pick: fn(f64, f64) -> f64, start: f64| {
            places.iter().map(|place| place[k]).fold(start, pick)
        };
        let low = [0, 1].map(|k| end(k, f64::min, f64::INFINITY));
        let high = [0, 1].map(|k| end(k, f64::max, f64::NEG_INFINITY));
        let extent = [0, 1].map(|k| (high[k] - low[k]).max(1e-9));
        let scale = (size[0] / extent[0]).min(size[1] / extent[1]);
        // What is left over is more on the left, where the legend is.
        let (start, share) = ([left, top], [0.7, 0.5]);
        let origin =
            [0, 1].map(|k| start[k] + share[k] * (size[k] - scale * extent[k]) - scale * low[k]);
        Self { scale, origin, ..self }
    }
}
