//! The polygon that a rover stands on: its wheels' contact points, seen from above.

use crate::units::Vec2;

/// The convex hull of the wheels, seen from above.
#[derive(Clone, Debug)]
pub struct SupportPolygon {
    edges: Vec<Edge>,
}

/// An edge of the polygon; the polygon is to its left.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Vec2,
    along: Vec2,
    length: f64,
}

impl SupportPolygon {
    /// Polygon of no wheels: everything is inside.
    pub(super) const NONE: Self = Self { edges: Vec::new() };

    /// The hull of some wheels.
    ///
    /// * `wheels`: their places, seen from above [m]
    #[must_use]
    pub fn of(wheels: &[Vec2]) -> Self {
        /// Wheels this near to an edge [m²] stand on it.
        const ON_EDGE: f64 = 1e-12;
        let pairs = wheels.iter().flat_map(|from| wheels.iter().map(move |to| (*from, to - from)));
        let lines = pairs.map(|(from, along)| Edge { from, along, length: along.norm() });
        let is_edge = |line: &Edge| {
            line.length > 0.0 && wheels.iter().all(|wheel| line.area(*wheel) >= -ON_EDGE)
        };
        Self { edges: lines.filter(is_edge).collect() }
    }

    /// Distance [m] of a point from the nearest edge, negative outside.
    #[must_use]
    pub fn margin(&self, point: Vec2) -> f64 {
        let distances = self.edges.iter().map(|edge| edge.area(point) / edge.length);
        distances.fold(f64::INFINITY, f64::min)
    }

    /// The point of the polygon that is nearest to a point: the point itself, if it is inside.
    #[must_use]
    pub fn nearest(&self, point: Vec2) -> Vec2 {
        if self.margin(point) >= 0.0 {
            return point;
        }
        let on_edges = self.edges.iter().map(|edge| edge.nearest(point));
        let distance = |it: &Vec2| (point - it).norm_squared();
        on_edges.min_by(|one, other| distance(one).total_cmp(&distance(other))).unwrap_or(point)
    }
}

impl Edge {
    /// The point of the edge that is nearest to a point.
    fn nearest(&self, point: Vec2) -> Vec2 {
        let share = (point - self.from).dot(&self.along) / (self.length * self.length);
        self.from + self.along * share.clamp(0.0, 1.0)
    }

    /// Area of the parallelogram that a point spans with the edge [m²], positive inside the
    /// polygon.
    fn area(&self, point: Vec2) -> f64 {
        self.along.perp(&(point - self.from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_margin_is_the_distance_to_the_nearest_edge() {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let square = SupportPolygon::of(&corners.map(|(x, y)| Vec2::new(x, y)));
        assert!((square.margin(Vec2::new(0.7, 0.1)) - 0.3).abs() < 1e-12);
        assert!((square.margin(Vec2::new(0.0, -1.5)) + 0.5).abs() < 1e-12);
    }

    #[test]
    fn the_nearest_point_is_on_an_edge_a_corner_or_inside() {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let square = SupportPolygon::of(&corners.map(|(x, y)| Vec2::new(x, y)));
        for (point, nearest) in
            [((0.2, 0.3), (0.2, 0.3)), ((0.2, 3.0), (0.2, 1.0)), ((-2.0, -5.0), (-1.0, -1.0))]
        {
            let found = square.nearest(Vec2::new(point.0, point.1));
            assert!((found - Vec2::new(nearest.0, nearest.1)).norm() < 1e-12, "{found}");
        }
    }

    /// A wheel between others is no corner, and takes nothing from the polygon.
    #[test]
    fn wheels_inside_and_on_an_edge_do_not_change_the_polygon() {
        let corners = [(1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (0.2, 0.1), (-1.0, -1.0), (1.0, -1.0)];
        let polygon = SupportPolygon::of(&corners.map(|(x, y)| Vec2::new(x, y)));
        assert!((polygon.margin(Vec2::new(0.2, 0.1)) - 0.8).abs() < 1e-12);
    }
}
