//! The moves of the lattice: sixteen directions from a cell to others, and the shortest way over
//! them.

use std::f64::consts::TAU;

use crate::elementary::wide::atan2;
use crate::units::Vec2;

/// The number of directions.
pub(super) const DIRECTIONS: usize = 16;

/// Columns to the east and rows to the north, from the east to the left.
pub(super) const MOVES: [(isize, isize); DIRECTIONS] = [
    (1, 0),
    (2, 1),
    (1, 1),
    (1, 2),
    (0, 1),
    (-1, 2),
    (-1, 1),
    (-2, 1),
    (-1, 0),
    (-2, -1),
    (-1, -1),
    (-1, -2),
    (0, -1),
    (1, -2),
    (1, -1),
    (2, -1),
];

/// The moves on a grid.
#[derive(Clone, Debug)]
pub(super) struct Moves {
    /// Horizontal length of each [m].
    pub(super) lengths: [f64; DIRECTIONS],
    /// Its direction, of length 1.
    pub(super) along: [Vec2; DIRECTIONS],
    /// The angle from each direction to the next on its left [rad].
    pub(super) to_next: [f64; DIRECTIONS],
    spacing: Vec2,
}

impl Moves {
    /// * `spacing`: of the grid, to the east and to the north [m]
    pub(super) fn on(spacing: Vec2) -> Self {
        let ways = MOVES.map(|(x, y)| Vec2::new(x as f64 * spacing.x, y as f64 * spacing.y));
        let angle = |direction: usize| {
            let way = ways[direction % DIRECTIONS];
            atan2(way.y, way.x)
        };
        let to_next = std::array::from_fn(|direction| {
            let turn = angle(direction + 1) - angle(direction);
            if turn < 0.0 { turn + TAU } else { turn }
        });
        Self {
            lengths: ways.map(|way| way.norm()),
            along: ways.map(|way| way.normalize()),
            to_next,
            spacing,
        }
    }

    /// Length of the shortest way over the lattice [m]: with two directions, those on either side
    /// of the straight line.
    ///
    /// * `columns`, `rows`: how far it leads
    pub(super) fn shortest(&self, columns: f64, rows: f64) -> f64 {
        let (x, y) = (columns.abs(), rows.abs());
        let [east, flat, diagonal, steep, north] = [0, 1, 2, 3, 4].map(|it| self.lengths[it]);
        // How often each of the two directions has to be taken: x = Σ n Δx, y = Σ n Δy.
        match () {
            () if 2.0 * y <= x => (x - 2.0 * y) * east + y * flat,
            () if y <= x => (x - y) * flat + (2.0 * y - x) * diagonal,
            () if 2.0 * x <= y => (y - 2.0 * x) * north + x * steep,
            () => (y - x) * steep + (2.0 * x - y) * diagonal,
        }
    }

    /// The direction nearest to an angle [rad].
    pub(super) fn nearest(&self, angle: f64) -> usize {
        let turned = |direction: usize| {
            let (sin, cos) = crate::elementary::wide::sin_cos(angle);
            self.along[direction].dot(&Vec2::new(cos, sin))
        };
        (0..DIRECTIONS).max_by(|one, other| turned(*one).total_cmp(&turned(*other))).unwrap_or(0)
    }

    /// The angle of a direction, from the east to the left [rad].
    pub(super) fn angle(&self, direction: usize) -> f64 {
        let along = self.along[direction];
        atan2(along.y, along.x)
    }

    /// The angle from one direction to another [rad], −π to π, positive to the left.
    pub(super) fn turn(&self, from: usize, to: usize) -> f64 {
        let [from, to] = [from, to].map(|it| self.along[it]);
        atan2(from.perp(&to), from.dot(&to))
    }

    /// Columns and rows from one place to another.
    pub(super) fn steps(&self, way: Vec2) -> (f64, f64) {
        (way.x / self.spacing.x, way.y / self.spacing.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lattice is at most 2.8 % longer than the straight line, in any direction.
    #[test]
    fn the_shortest_way_is_nearly_straight() {
        let moves = Moves::on(Vec2::new(0.5, 0.5));
        let mut longest: f64 = 0.0;
        for (columns, rows) in (-60..=60).flat_map(|x| (-60..=60).map(move |y| (x, y))) {
            let (x, y) = (f64::from(columns), f64::from(rows));
            if (x, y) != (0.0, 0.0) {
                longest = longest.max(moves.shortest(x, y) / (0.5 * x.hypot(y)));
            }
        }
        assert!((1.02..1.028).contains(&longest), "{longest}");
        assert_eq!(moves.shortest(-3.0, 0.0), 1.5);
    }

    #[test]
    fn directions_go_round_once() {
        let moves = Moves::on(Vec2::new(1.0, 1.0));
        assert!((moves.to_next.iter().sum::<f64>() - TAU).abs() < 1e-12);
        assert!(moves.to_next.iter().all(|angle| *angle > 0.3 && *angle < 0.5));
        assert_eq!(moves.nearest(3.0), 8);
    }
}
