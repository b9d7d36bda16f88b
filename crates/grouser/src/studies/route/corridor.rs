//! The ground along a line, piece by piece.

use super::answer::{LineError, RouteError};
use super::moves::MOVES;
use super::search::slope_at;
use crate::studies::mobility::Ground;
use crate::terrain::Extent;
use crate::units::Vec2;

/// The most pieces that a line is cut into.
const MOST_PIECES: f64 = 1e7;

/// Nearer to a point of the grid a place is that point [cells].
const NEAR: f64 = 1e-6;

/// Ground along lines.
#[derive(Clone, Copy)]
pub(super) struct Corridor<'a> {
    pub(super) ground: Ground<'a>,
}

/// A piece of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Its ends [m].
    pub(super) from: Vec2,
    pub(super) to: Vec2,
    /// The ground under it; none where it is not known all around.
    pub(super) ground: Option<Rise>,
}

/// How the ground of a piece rises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rise {
    /// Along it and across it [m/m].
    pub(super) along: f64,
    pub(super) across: f64,
    /// Height in the middle between its ends [m].
    pub(super) height: f64,
}

/// The ground at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spot {
    /// Height above the base [m].
    height: f64,
    gradient: Vec2,
}

impl Corridor<'_> {
    /// Checks that some of a line lies on the map, and that the line is no longer than can be
    /// looked at.
    pub(super) fn check(&self, places: &[Vec2]) -> Result<(), RouteError> {
        let extent = self.ground.raster().grid.extent();
        if let Some(line) = Extent::around(places).filter(|it| it.is_apart_from(&extent)) {
            let [line, corners] = [line, extent].map(|it| [it.south_west, it.north_east]);
            return Err(LineError::Elsewhere { line, corners }.into());
        }
        let cells =
            places.windows(2).map(|pair| (self.cells(pair[1]) - self.cells(pair[0])).amax());
        let pieces = cells.sum::<f64>();
        if pieces > MOST_PIECES {
            return Err(LineError::TooLong { pieces, most: MOST_PIECES }.into());
        }
        Ok(())
    }

    /// The pieces from a place to another.
    pub(super) fn steps(&self, from: Vec2, to: Vec2) -> impl Iterator<Item = Step> {
        let ends = [self.cells(from), self.cells(to)];
        let count = pieces(ends[1] - ends[0]);
        let share = move |number: usize| number as f64 / count as f64;
        let between = move |share: f64| ends[0] + share * (ends[1] - ends[0]);
        let place = move |number: usize| from + share(number) * (to - from);
        let way = (to - from).normalize();
        let base = self.ground.raster().base;
        let mut here = self.spot(ends[0]);
        (0..count).map(move |number| {
            let there = self.spot(between(share(number + 1)));
            let middle = self.spot(between(0.5 * (share(number) + share(number + 1))));
            let (from, to) = (place(number), place(number + 1));
            let ground = middle.and(here).zip(there).map(|(here, there)| {
                let gradient = 0.5 * (here.gradient + there.gradient);
                let along = (there.height - here.height) / (to - from).norm();
                let across = gradient.y * way.x - gradient.x * way.y;
                Rise { along, across, height: base + 0.5 * (here.height + there.height) }
            });
            here = there;
            Step { from, to, ground }
        })
    }

    /// How steeply the ground rises at a place to the east and to the north [m/m], if it is known all
    /// around.
    pub(super) fn gradient(&self, place: Vec2) -> Option<Vec2> {
        Some(self.spot(self.cells(place))?.gradient)
    }

    /// Columns to the east and rows to the north of the south-western point.
    fn cells(&self, place: Vec2) -> Vec2 {
        let grid = &self.ground.raster().grid;
        (place - grid.south_west).component_div(&grid.spacing).map(snapped)
    }

    /// The ground at a place, in cells: bilinear between its points. None beyond the map, and where
    /// one of the points is at the edge or beside a place without a height.
    fn spot(&self, at: Vec2) -> Option<Spot> {
        let (x, y) = (snapped(at.x), snapped(at.y));
        let (low_x, low_y) = (x.floor(), y.floor());
        let (u, v) = (x - low_x, y - low_y);
        let mut spot = Spot { height: 0.0, gradient: Vec2::zeros() };
        for (dx, dy, weight) in [
            (0.0, 0.0, (1.0 - u) * (1.0 - v)),
            (1.0, 0.0, u * (1.0 - v)),
            (0.0, 1.0, (1.0 - u) * v),
            (1.0, 1.0, u * v),
        ] {
            if weight > 0.0 {
                let point = self.point(low_x + dx, low_y + dy)?;
                spot.height += weight * point.height;
                spot.gradient += weight * point.gradient;
            }
        }
        Some(spot)
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be on the grid"
    )]
    fn point(&self, column: f64, row: f64) -> Option<Spot> {
        let raster = self.ground.raster();
        let (columns, rows) = (raster.grid.columns, raster.grid.rows);
        if !(0.0..columns as f64).contains(&column) || !(0.0..rows as f64).contains(&row) {
            return None;
        }
        let (column, row) = (column as usize, row as usize);
        let [x, y] = slope_at(self.ground, column, row)?;
        let height = f64::from(raster.heights[row * columns + column]);
        Some(Spot { height, gradient: Vec2::new(f64::from(x), f64::from(y)) })
    }
}

/// A place in cells, without what rounding has taken it off a point by.
fn snapped(at: f64) -> f64 {
    let whole = at.round();
    if (at - whole).abs() < NEAR { whole } else { at }
}

/// In how many pieces to go a way, in cells: in moves of the lattice if it is made of one kind of
/// them, else in pieces that are no longer than a cell along either axis.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "few enough, as has been checked"
)]
fn pieces(way: Vec2) -> usize {
    let moves =
        MOVES.iter().map(|&(x, y)| way.dot(&direction(x, y)) / direction(x, y).norm_squared());
    let of_one_kind = moves.zip(MOVES).find_map(|(count, (x, y))| {
        let (whole, rest) = (count.round(), way - count.round() * direction(x, y));
        (whole >= 1.0 && rest.amax() < NEAR).then_some(whole)
    });
    of_one_kind.unwrap_or_else(|| way.amax().ceil().max(1.0)) as usize
}

fn direction(x: isize, y: isize) -> Vec2 {
    Vec2::new(x as f64, y as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_over_the_lattice_is_cut_into_its_moves() {
        for ((x, y), count) in [
            ((6.0, 3.0), 3),
            ((-4.0, 8.0), 4),
            ((5.0, 5.0), 5),
            ((0.0, -7.0), 7),
            ((6.0, 4.0), 6),
            ((0.3, 0.2), 1),
            ((2.5, -0.5), 3),
        ] {
            assert_eq!(pieces(Vec2::new(x, y)), count, "{x} {y}");
        }
    }
}
