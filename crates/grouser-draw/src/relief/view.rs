//! Parallel projections of the ground.

use crate::sheet::Place;
use grouser_core::elementary::wide;
use grouser_core::units::{Vec2, Vec3};

/// Directions from which the oblique view looks: turned from north to the left, and down from the
/// horizon [°].
const AZIMUTH: f64 = 35.0;
const ELEVATION: f64 = 30.0;

/// Where points of the ground are on the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    right: Vec3,
    up: Vec3,
    towards: Vec3,
    /// [mm/m]
    scale: f64,
    /// The sheet's place of the ground's origin [mm].
    origin: Place,
    /// The upper left corner of the view [mm].
    pub(super) corner: Place,
}

impl View {
    fn new([right, up, towards]: [Vec3; 3], scale: f64) -> Self {
        Self { right, up, towards, scale, origin: [0.0, 0.0], corner: [0.0, 0.0] }
    }

    pub(super) fn from_above(scale: f64) -> Self {
        Self::new([Vec3::x(), Vec3::y(), Vec3::z()], scale)
    }

    /// From the south-east and above.
    pub(super) fn oblique() -> Self {
        let [(sin_a, cos_a), (sin_e, cos_e)] =
            [AZIMUTH, ELEVATION].map(|angle| wide::sin_cos(angle.to_radians()));
        let right = Vec3::new(cos_a, sin_a, 0.0);
        let up = Vec3::new(-sin_a * sin_e, cos_a * sin_e, cos_e);
        Self::new([right, up, Vec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e)], 1.0)
    }

    /// The same with a point of the ground in its upper left corner.
    ///
    /// * `at`: the point [m]
    /// * `corner`: where it is on the sheet [mm]
    pub(super) fn with(self, at: Vec2, corner: Place) -> Self {
        let plain = Self { origin: [0.0, 0.0], ..self };
        let [x, y] = plain.place(at.push(0.0));
        Self { origin: [corner[0] - x, corner[1] - y], corner, ..self }
    }

    /// The same with a scale and a place such that points fill a rectangle.
    ///
    /// * `corner`, `size`: of the rectangle [mm]
    pub(super) fn framing(self, points: &[Vec3], corner: Place, size: Place) -> Self {
        let places: Vec<Place> = points.iter().map(|point| self.place(*point)).collect();
        let end = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            places.iter().map(|place| place[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|axis| end(axis, f64::min, f64::INFINITY));
        let high = [0, 1].map(|axis| end(axis, f64::max, f64::NEG_INFINITY));
        let scale = [0, 1].map(|axis| size[axis] / (high[axis] - low[axis]).max(1e-9));
        let scale = self.scale * scale[0].min(scale[1]);
        let origin = [0, 1].map(|axis| {
            let room = size[axis] - scale * (high[axis] - low[axis]);
            corner[axis] + 0.5 * room - scale * low[axis]
        });
        Self { scale, origin, corner, ..self }
    }

    pub(super) fn place(&self, point: Vec3) -> Place {
        [
            self.origin[0] + self.scale * self.right.dot(&point),
            self.origin[1] - self.scale * self.up.dot(&point),
        ]
    }

    /// How long a length is on the sheet [mm].
    ///
    /// * `length`: [m]
    pub(super) fn length(&self, length: f64) -> f64 {
        self.scale * length
    }

    /// How near a point is to the eye [m].
    pub(super) fn depth(&self, point: Vec3) -> f64 {
        self.towards.dot(&point)
    }

    /// Whether a face is seen.
    ///
    /// * `normal`: out of what it belongs to
    pub(super) fn sees(&self, normal: Vec3) -> bool {
        self.towards.dot(&normal) > 0.0
    }
}
