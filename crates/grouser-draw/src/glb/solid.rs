//! Solids as triangles.

use std::f64::consts::TAU;

use grouser_core::elementary::wide;
use grouser_core::units::Vec3;
use grouser_core::wheel::Wheel;

use crate::rover::{Bar, Block, bars_of};

/// Flat faces around a wheel.
const ROUND: u32 = 36;

/// Triangles with the directions in which their faces look.
#[derive(Default)]
pub(super) struct Solid {
    pub(super) places: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) triangles: Vec<u32>,
}

impl Solid {
    /// A flat convex face, its corners counterclockwise as seen from outside.
    pub(super) fn face(&mut self, corners: &[Vec3], normal: Vec3) {
        let first = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        let count = u32::try_from(corners.len()).unwrap_or(u32::MAX);
        self.places.extend_from_slice(corners);
        self.normals.extend(corners.iter().map(|_| normal));
        for corner in 2..count {
            self.triangles.extend([first, first + corner - 1, first + corner]);
        }
    }

    /// A piece of uneven ground: two triangles.
    pub(super) fn cell(&mut self, corners: &[Vec3; 4]) {
        let [a, b, c, d] = *corners;
        let normal = (c - a).cross(&(d - b)).try_normalize(0.0).unwrap_or_else(Vec3::z);
        self.face(corners, normal);
    }

    pub(super) fn block(&mut self, block: &Block) {
        let corner = |axis: usize, is_high: bool, a: bool, b: bool| {
            let mut of = [is_high; 3];
            of[(axis + 1) % 3] = a;
            of[(axis + 2) % 3] = b;
            block.corner(of)
        };
        for axis in 0..3 {
            for is_high in [false, true] {
                let mut normal = Vec3::zeros();
                normal[axis] = if is_high { 1.0 } else { -1.0 };
                let mut ends = [(false, false), (true, false), (true, true), (false, true)]
                    .map(|(a, b)| corner(axis, is_high, a, b));
                if !is_high {
                    ends.reverse();
                }
                self.face(&ends, normal);
            }
        }
    }
}

/// The rim with its side walls, and what shows its turning: spokes and grousers. The axle is along
/// y.
pub(super) fn wheel_solids(wheel: &Wheel) -> [Solid; 2] {
    let (radius, side) = (wheel.radius, 0.5 * wheel.width);
    let out = |angle: f64| {
        let (sin, cos) = wide::sin_cos(angle);
        Vec3::new(sin, 0.0, cos)
    };
    let at = |angle: f64, radius: f64, y: f64| radius * out(angle) + Vec3::new(0.0, y, 0.0);
    let mut rim = Solid::default();
    let step = TAU / f64::from(ROUND);
    for k in 0..ROUND {
        let (a, b) = (step * f64::from(k), step * f64::from(k + 1));
        let corners =
            [at(a, radius, -side), at(a, radius, side), at(b, radius, side), at(b, radius, -side)];
        rim.face(&[corners[3], corners[2], corners[1], corners[0]], out(0.5 * (a + b)));
    }
    for y in [side, -side] {
        let mut disc: Vec<Vec3> = (0..ROUND).map(|k| at(step * f64::from(k), radius, y)).collect();
        if y < 0.0 {
            disc.reverse();
        }
        rim.face(&disc, Vec3::new(0.0, y.signum(), 0.0));
    }
    let mut bars = Solid::default();
    for Bar { angle, inner, outer, half_thick, half_wide, .. } in bars_of(wheel) {
        let (along, across) = (out(angle), out(angle + 0.25 * TAU));
        let corner = |r: f64, t: f64, y: f64| r * along + t * across + Vec3::new(0.0, y, 0.0);
        let (t, w) = (half_thick, half_wide);
        let faces = [
            ([(outer, t, w), (outer, t, -w), (outer, -t, -w), (outer, -t, w)], along),
            ([(inner, t, w), (outer, t, w), (outer, -t, w), (inner, -t, w)], Vec3::y()),
            ([(inner, t, -w), (inner, -t, -w), (outer, -t, -w), (outer, t, -w)], -Vec3::y()),
            ([(inner, t, -w), (outer, t, -w), (outer, t, w), (inner, t, w)], across),
            ([(inner, -t, w), (outer, -t, w), (outer, -t, -w), (inner, -t, -w)], -across),
        ];
        for (corners, normal) in faces {
            bars.outward(&corners.map(|(r, t, y)| corner(r, t, y)), normal);
        }
    }
    [rim, bars]
}

impl Solid {
    /// The direction of a corner of those around the z axis.
    pub(super) fn around(corner: u32, corners: u32) -> Vec3 {
        let (sin, cos) = wide::sin_cos(TAU * f64::from(corner) / f64::from(corners));
        Vec3::new(cos, sin, 0.0)
    }

    /// A flat face whose corners are put in the order that its direction asks for.
    fn outward(&mut self, corners: &[Vec3; 4], normal: Vec3) {
        let turn = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let mut corners = *corners;
        if turn.dot(&normal) < 0.0 {
            corners.reverse();
        }
        self.face(&corners, normal);
    }
}
