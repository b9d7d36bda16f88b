//! A path over the slope that a rover is to follow, and where beside it a rover is.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use crate::elementary::wide::{self, atan2};
use crate::error::{ParameterError, finite, positive};
use crate::stored::stored;
use crate::units::Vec2;

/// A path in the slope frame, from its start to its end: straight from waypoint to waypoint, or an
/// arc.
///
/// A place beside it has three numbers: how far along the path its nearest point is (along-track),
/// how far to the left of that it lies (cross-track), and the heading of the path there.
///
/// Half a metre below a path that turns from the contour straight uphill, a metre and a half along:
///
/// ```
/// use grouser_core::mission::Route;
/// use grouser_core::units::Vec2;
///
/// let route = Route::through(&[Vec2::zeros(), Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0)])?;
/// let below = route.nearest(Vec2::new(1.5, -0.5), 0.0..=route.length());
/// assert_eq!([below.along, below.cross_track, below.heading], [1.5, -0.5, 0.0]);
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// One at least.
    pieces: Vec<Piece>,
}

/// Where a place is beside a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BesideRoute {
    /// Along-track: the path's length from its start to the point that is nearest to the place [m].
    pub along: f64,
    /// Cross-track: how far the place is from that point [m], positive to the left of one who goes
    /// along the path.
    pub cross_track: f64,
    /// Heading of the path there [rad], as a yaw: 0 along the contour, positive uphill.
    pub heading: f64,
}

stored!(struct Route { pieces });
stored!(struct BesideRoute { along, cross_track, heading });
stored!(struct Piece { shape, before, length });
stored!(enum Shape { 0 => Straight { start, along }, 1 => Arc { centre, radius, from, side } });

/// A piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    shape: Shape,
    /// Length of the path before it [m].
    before: f64,
    /// Its own [m], above 0.
    length: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// From a place in a direction of length 1.
    Straight { start: Vec2, along: Vec2 },
    /// Around a centre, from a direction there [rad]; `side` is 1 for a turn to the left, -1 for
    /// one to the right.
    Arc { centre: Vec2, radius: f64, from: f64, side: f64 },
}

impl Route {
    /// The path that leads straight from each waypoint to the next.
    ///
    /// * `places`: two or more, in the slope frame [m]
    ///
    /// # Errors
    /// [`ParameterError`] for fewer, for places that are not finite, and for one that repeats the
    /// place before it.
    pub fn through(places: &[Vec2]) -> Result<Self, ParameterError> {
        for place in places {
            finite("x of a waypoint [m]", place.x)?;
            finite("y of a waypoint [m]", place.y)?;
        }
        let mut pieces = Vec::new();
        let mut before = 0.0;
        for pair in places.windows(2) {
            let (start, way) = (pair[0], pair[1] - pair[0]);
            let length = way.norm();
            positive("way from a waypoint to the next [m]", length)?;
            let shape = Shape::Straight { start, along: way / length };
            pieces.push(Piece { shape, before, length });
            before += length;
        }
        if pieces.is_empty() {
            let expected = "2 or more";
            return Err(ParameterError::new("number of waypoints", places.len() as f64, expected));
        }
        Ok(Self { pieces })
    }

    /// An arc of a circle that begins at the origin.
    ///
    /// * `radius`: its radius [m]
    /// * `heading`: that with which it begins [rad]
    /// * `angle`: how far it turns [rad], positive to the left
    ///
    /// # Errors
    /// [`ParameterError`] for a radius that is not above 0, and an arc that does not turn.
    pub fn arc(radius: f64, heading: f64, angle: f64) -> Result<Self, ParameterError> {
        positive("radius of an arc [m]", radius)?;
        finite("heading of an arc [rad]", heading)?;
        finite("angle of an arc [rad]", angle)?;
        let length = radius * angle.abs();
        positive("length of an arc [m]", length)?;
        let side = angle.signum();
        let (sin, cos) = wide::sin_cos(heading);
        let centre = side * radius * Vec2::new(-sin, cos);
        let from = atan2(-centre.y, -centre.x);
        let shape = Shape::Arc { centre, radius, from, side };
        Ok(Self { pieces: vec![Piece { shape, before: 0.0, length }] })
    }

    /// Whether there are pieces, of one that was read.
    pub(super) fn has_pieces(&self) -> bool {
        !self.pieces.is_empty()
    }

    /// Its length [m].
    #[must_use]
    pub fn length(&self) -> f64 {
        let last = &self.pieces[self.pieces.len() - 1];
        last.before + last.length
    }

    /// The place on it after a way along it, and its heading there [rad]; that of its start before
    /// it, that of its end after it.
    ///
    /// * `along`: the way from its start [m]
    #[must_use]
    pub fn at(&self, along: f64) -> (Vec2, f64) {
        let after = self.pieces.partition_point(|piece| piece.before <= along);
        let piece = &self.pieces[after.saturating_sub(1)];
        piece.at((along - piece.before).clamp(0.0, piece.length))
    }

    /// Where a place is beside the path, by the nearest point of some part of it; of several that
    /// are as near, the first.
    ///
    /// * `place`: in the slope frame [m]
    /// * `part`: from which way along the path to which [m]
    #[must_use]
    pub fn nearest(&self, place: Vec2, part: RangeInclusive<f64>) -> BesideRoute {
        let (from, to) = (part.start().max(0.0), part.end().min(self.length()));
        let (point, heading) = self.at(from);
        let mut best = (from, point, heading);
        for piece in &self.pieces {
            let own = [from.max(piece.before), to.min(piece.before + piece.length)];
            if own[0] > own[1] {
                continue;
            }
            let own = own.map(|along| along - piece.before);
            for within in piece.candidates(place, own) {
                let (point, heading) = piece.at(within);
                if (place - point).norm_squared() < (place - best.1).norm_squared() {
                    best = (piece.before + within, point, heading);
                }
            }
        }
        let (along, point, heading) = best;
        let (sin, cos) = wide::sin_cos(heading);
        let away = place - point;
        let side = if Vec2::new(cos, sin).perp(&away) < 0.0 { -1.0 } else { 1.0 };
        BesideRoute { along, cross_track: side * away.norm(), heading }
    }
}

impl Piece {
    /// The place on it after a way along it [m], and its heading there [rad].
    fn at(&self, within: f64) -> (Vec2, f64) {
        match self.shape {
            Shape::Straight { start, along } => (start + within * along, atan2(along.y, along.x)),
            Shape::Arc { centre, radius, from, side } => {
                let direction = from + side * within / radius;
                let (sin, cos) = wide::sin_cos(direction);
                (centre + radius * Vec2::new(cos, sin), direction + side * TAU / 4.0)
            }
        }
    }

    /// Ways along it [m] of which one is that of its point nearest to a place, between two ways.
    fn candidates(&self, place: Vec2, [from, to]: [f64; 2]) -> [f64; 3] {
        let foot = match self.shape {
            Shape::Straight { start, along } => (place - start).dot(&along).clamp(from, to),
            Shape::Arc { centre, radius, from: first, side } => {
                let away = place - centre;
                let turned = side * (atan2(away.y, away.x) - first) - from / radius;
                // The first place after `from` in that direction: an arc may go round more than
                // once.
                let foot = from + radius * turned.rem_euclid(TAU);
                if foot > to { from } else { foot }
            }
        };
        [foot, from, to]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    const TOLERANCE: f64 = 1e-12;

    fn check(route: &Route, place: [f64; 2], expected: [f64; 3]) {
        let place = Vec2::new(place[0], place[1]);
        let found = route.nearest(place, 0.0..=route.length());
        let found = [found.along, found.cross_track, found.heading];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < TOLERANCE, "{place}: {found} != {expected}");
        }
    }

    fn two_bends() -> Route {
        let places = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [5.0, 5.0]];
        Route::through(&places.map(|[x, y]| Vec2::new(x, y))).expect("a path")
    }

    /// Closed forms: feet on the pieces, a corner from outside, places before the start and beyond
    /// the end.
    #[test]
    fn places_beside_straight_pieces_are_where_geometry_has_them() {
        let route = two_bends();
        assert!((route.length() - 8.0).abs() < TOLERANCE);
        check(&route, [0.5, 0.3], [0.5, 0.3, 0.0]);
        check(&route, [0.5, -0.3], [0.5, -0.3, 0.0]);
        check(&route, [2.3, 0.5], [2.5, -0.3, FRAC_PI_2]);
        check(&route, [2.3, -0.4], [2.0, -0.5, 0.0]);
        check(&route, [-3.0, 4.0], [0.0, 5.0, 0.0]);
        check(&route, [5.6, 5.8], [8.0, 1.0, f64::atan2(4.0, 3.0)]);
        // Half way up the last piece, 0.1 m to its right.
        check(&route, [3.5 + 0.08, 3.0 - 0.06], [5.5, -0.1, f64::atan2(4.0, 3.0)]);
    }

    /// Closed form: on a circle around (0, 2), left of the rover, the distance is that to the
    /// centre less the radius.
    #[test]
    fn places_beside_an_arc_are_where_geometry_has_them() {
        let left = Route::arc(2.0, 0.0, PI).expect("an arc");
        for (angle, off) in [(0.3, 0.5), (1.0, -0.4), (2.5, 0.0), (3.1, 1.9)] {
            let (radius, direction) = (2.0 - off, angle - FRAC_PI_2);
            let place = [radius * f64::cos(direction), 2.0 + radius * f64::sin(direction)];
            check(&left, place, [2.0 * angle, off, angle]);
        }
        let right = Route::arc(2.0, FRAC_PI_2, -FRAC_PI_2).expect("an arc");
        let (place, heading) = right.at(right.length());
        assert!((place - Vec2::new(2.0, 2.0)).norm() < TOLERANCE && heading.abs() < TOLERANCE);
        check(&right, [1.5, 0.5], [FRAC_PI_2, -(2.0 - 0.5_f64.sqrt()), FRAC_PI_2 / 2.0]);
    }

    /// A second implementation: the nearest of points that lie densely on the path.
    #[test]
    fn the_nearest_point_is_the_nearest_of_many() {
        let routes = [two_bends(), Route::arc(0.7, 0.4, -5.0).expect("an arc")];
        for route in routes {
            let dense: Vec<f64> =
                (0..=80_000).map(|k| route.length() * f64::from(k) / 80_000.0).collect();
            for (x, y) in [(0.1, 0.7), (3.0, 0.2), (-1.0, -1.0), (2.2, 3.0), (0.3, -0.9)] {
                let place = Vec2::new(x, y);
                for part in [0.0..=route.length(), 0.5..=1.7, 2.5..=3.0] {
                    let found = route.nearest(place, part.clone());
                    assert!(part.contains(&found.along), "{found:?}");
                    let many = dense.iter().filter(|along| part.contains(along));
                    let many = many.map(|along| (place - route.at(*along).0).norm());
                    let least = many.fold(f64::INFINITY, f64::min);
                    // Half of the distance between two points of the dense ones.
                    assert!((found.cross_track.abs() - least).abs() < 6e-5, "{found:?}, {least}");
                }
            }
        }
    }

    /// An arc that goes round twice: the part decides between the rounds.
    #[test]
    fn rounds_are_told_apart_by_the_part() {
        let route = Route::arc(1.0, 0.0, 2.0 * TAU).expect("an arc");
        let place = Vec2::new(1.2, 1.0);
        for (part, along) in [(0.0..=3.0, FRAC_PI_2), (6.0..=9.0, FRAC_PI_2 + TAU)] {
            let found = route.nearest(place, part);
            assert!((found.along - along).abs() < TOLERANCE, "{found:?}");
            assert!((found.cross_track + 0.2).abs() < TOLERANCE, "{found:?}");
        }
    }

    #[test]
    fn what_is_no_path_is_refused() {
        let (here, there) = (Vec2::zeros(), Vec2::new(1.0, 0.0));
        for places in [&[][..], &[here], &[here, here], &[here, there, there]] {
            assert!(Route::through(places).is_err(), "{places:?}");
        }
        assert!(Route::through(&[here, Vec2::new(f64::NAN, 0.0)]).is_err());
        for (radius, angle) in [(0.0, 1.0), (-1.0, 1.0), (1.0, 0.0), (1.0, f64::INFINITY)] {
            assert!(Route::arc(radius, 0.0, angle).is_err(), "{radius} {angle}");
        }
    }
}
