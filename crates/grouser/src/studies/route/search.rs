//! The cheapest way over the lattice: A*, with what a way costs at least.
//!
//! A state is a cell and one of sixteen headings. From it a rover drives one move straight ahead,
//! or turns to the next heading on either side. Both cost something, and what a way to the target
//! costs at least is known: the shortest way over the lattice at the least price of a level metre,
//! and what the difference in height adds to it ([`Bound`](super::costs::Bound)). That is
//! consistent, so that a state is looked at once, and the first way found to the target is the
//! cheapest.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use grouser_raster::Raster;
use rayon::prelude::*;

use super::costs::Costs;
use super::moves::{DIRECTIONS, MOVES, Moves};
use crate::studies::mobility::Ground;
use crate::units::Vec2;

/// The cells of a grid as a rover meets them.
pub(super) struct Lattice<'a> {
    pub(super) ground: Ground<'a>,
    pub(super) moves: Moves,
    columns: usize,
    rows: usize,
    /// How steeply the ground of each cell rises to the east and to the north; NaN where nobody may
    /// go.
    gradients: Vec<[f32; 2]>,
    costs: &'a Costs<'a>,
    /// What it costs to turn by a radian.
    turn: f64,
}

/// What came of a search.
pub(super) enum Found {
    /// The cells of the way, from the first to the last, and the headings of its moves.
    Way(Vec<usize>, Vec<usize>),
    /// None leads there: so many cells can be reached.
    None { reached: usize },
}

/// How a state was come to.
const DROVE: u8 = 1;
const TURNED_LEFT: u8 = 2;
const TURNED_RIGHT: u8 = 3;
/// It is where the search began.
const BEGAN: u8 = 4;
/// It will not be looked at again.
const DONE: u8 = 0x80;

/// How steeply the ground of a point rises to the east and to the north [m/m]; none at the edge,
/// and beside a place without a height.
pub(super) fn slope_at(ground: Ground<'_>, column: usize, row: usize) -> Option<[f32; 2]> {
    let found = ground.surrounds(column, row).then(|| ground.gradient(column, row));
    #[expect(clippy::cast_possible_truncation, reason = "as heights are")]
    found.flatten().map(|it| [it.x as f32, it.y as f32])
}

/// The cell nearest to a place; nothing beyond the map.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
pub(super) fn cell_at(ground: Ground<'_>, place: Vec2) -> Option<usize> {
    let grid = &ground.raster().grid;
    let from = place - grid.south_west;
    let (x, y) = (from.x / grid.spacing.x, from.y / grid.spacing.y);
    let inside = |at: f64, count: usize| (-0.5..=count as f64 - 0.5).contains(&at);
    if !inside(x, grid.columns) || !inside(y, grid.rows) {
        return None;
    }
    let near = |at: f64, count: usize| (at.round().max(0.0) as usize).min(count - 1);
    Some(near(y, grid.rows) * grid.columns + near(x, grid.columns))
}

impl<'a> Lattice<'a> {
    /// * `is_open`: whether one may go to a place, besides what its slope says
    /// * `turn`: what it costs to turn by a radian
    pub(super) fn new(
        ground: Ground<'a>,
        costs: &'a Costs<'a>,
        turn: f64,
        is_open: impl Fn(Vec2) -> bool + Sync,
    ) -> Self {
        let grid = &ground.raster().grid;
        let gradient = |cell: usize| {
            let (column, row) = (cell % grid.columns, cell / grid.columns);
            let found = is_open(grid.point(column, row)).then(|| slope_at(ground, column, row));
            found.flatten().unwrap_or([f32::NAN; 2])
        };
        let cells = grid.columns * grid.rows;
        Self {
            ground,
            moves: Moves::on(grid.spacing),
            columns: grid.columns,
            rows: grid.rows,
            gradients: (0..cells).into_par_iter().map(gradient).collect(),
            costs,
            turn,
        }
    }

    /// The place of a cell [m].
    pub(super) fn place(&self, cell: usize) -> Vec2 {
        self.ground.raster().grid.point(cell % self.columns, cell / self.columns)
    }

    /// The heights.
    pub(super) fn raster(&self) -> &Raster {
        self.ground.raster()
    }

    /// Whether one may stand there.
    pub(super) fn is_open(&self, cell: usize) -> bool {
        !self.gradients[cell][0].is_nan()
    }

    /// Whether one may turn on the spot there.
    fn may_turn(&self, cell: usize) -> bool {
        let [east, north] = self.gradients[cell].map(f64::from);
        self.costs.of.may_turn(Vec2::new(east, north).norm())
    }

    /// Height above the base [m].
    fn height(&self, cell: usize) -> f64 {
        f64::from(self.ground.raster().heights[cell])
    }

    /// The cell one move ahead, if that is on the map.
    fn ahead(&self, cell: usize, direction: usize) -> Option<usize> {
        let (east, north) = MOVES[direction];
        let column = (cell % self.columns).checked_add_signed(east)?;
        let row = (cell / self.columns).checked_add_signed(north)?;
        (column < self.columns && row < self.rows).then_some(row * self.columns + column)
    }

    /// How steeply the ground rises along a move and across it; none where nobody may go, there or
    /// on the way.
    pub(super) fn rises(&self, cell: usize, direction: usize) -> Option<(usize, f64, f64)> {
        let to = self.ahead(cell, direction)?;
        let [here, there] = [cell, to].map(|it| self.gradients[it]);
        if here[0].is_nan() || there[0].is_nan() || !self.passes(cell, direction) {
            return None;
        }
        let along = (self.height(to) - self.height(cell)) / self.moves.lengths[direction];
        let way = self.moves.along[direction];
        let mean = |axis: usize| 0.5 * (f64::from(here[axis]) + f64::from(there[axis]));
        let across = mean(1) * way.x - mean(0) * way.y;
        Some((to, along, across))
    }

    /// Whether the cells that a move leads past are open.
    fn passes(&self, cell: usize, direction: usize) -> bool {
        let (east, north) = MOVES[direction];
        let half = |by: isize| if by.abs() == 2 { by / 2 } else { by };
        // Of a straight move none; else those at its sides.
        let sides = match (east.abs(), north.abs()) {
            (1, 1) => [(east, 0), (0, north)],
            (2, 1) => [(half(east), 0), (half(east), north)],
            (1, 2) => [(0, half(north)), (east, half(north))],
            _ => return true,
        };
        sides.into_iter().all(|(east, north)| {
            let column = (cell % self.columns).checked_add_signed(east);
            let row = (cell / self.columns).checked_add_signed(north);
            column.zip(row).is_some_and(|(column, row)| self.is_open(row * self.columns + column))
        })
    }

    /// The price of a move; infinite where nobody may go.
    pub(super) fn price(&self, cell: usize, direction: usize) -> (usize, f64) {
        let Some((to, along, across)) = self.rises(cell, direction) else {
            return (cell, f64::INFINITY);
        };
        (to, self.costs.price(along, across) * self.moves.lengths[direction])
    }

    /// Whether a cell can be left, or come to, at all.
    pub(super) fn has_way(&self, cell: usize) -> bool {
        (0..DIRECTIONS).any(|direction| self.price(cell, direction).1.is_finite())
    }

    /// What the way to the target costs at least.
    pub(super) fn at_least(&self, cell: usize, target: usize) -> f64 {
        let way = self.place(target) - self.place(cell);
        let (columns, rows) = self.moves.steps(way);
        let climb = self.height(target) - self.height(cell);
        let bound = self.costs.bound;
        bound.level * self.moves.shortest(columns.round(), rows.round()) + bound.climb * climb
    }

    /// The cheapest way between two cells.
    ///
    /// * `heading`: at the start; without it any
    pub(super) fn search(&self, from: usize, target: usize, heading: Option<usize>) -> Found {
        let states = self.columns * self.rows * DIRECTIONS;
        // Pages that are never touched are never there.
        let mut costs = vec![0.0_f32; states];
        let mut how = vec![0_u8; states];
        let mut open: BinaryHeap<Reverse<(u32, u32)>> = BinaryHeap::new();
        let at_start = self.at_least(from, target);
        // Positive numbers are in the order of their bits.
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the order of near ones does not matter"
        )]
        let key = |cost: f64, least: f64| ((cost + least - at_start).max(0.0) as f32).to_bits();
        let number = |state: usize| u32::try_from(state).unwrap_or(u32::MAX);
        for direction in (0..DIRECTIONS).filter(|it| heading.is_none_or(|heading| heading == *it)) {
            let state = from * DIRECTIONS + direction;
            how[state] = BEGAN;
            open.push(Reverse((key(0.0, at_start), number(state))));
        }
        let mut reached = 0;
        while let Some(Reverse((_, state))) = open.pop() {
            let state = state as usize;
            if how[state] & DONE != 0 {
                continue;
            }
            how[state] |= DONE;
            let (cell, direction) = (state / DIRECTIONS, state % DIRECTIONS);
            if cell == target {
                return self.way(&how, state);
            }
            if how[state] & !DONE == DROVE || how[state] & !DONE == BEGAN {
                reached += 1;
            }
            let left = (direction + 1) % DIRECTIONS;
            let right = (direction + DIRECTIONS - 1) % DIRECTIONS;
            let (ahead, price) = self.price(cell, direction);
            let turn = if self.may_turn(cell) { self.turn } else { f64::INFINITY };
            let steps = [
                (ahead * DIRECTIONS + direction, price, DROVE),
                (cell * DIRECTIONS + left, turn * self.moves.to_next[direction], TURNED_LEFT),
                (cell * DIRECTIONS + right, turn * self.moves.to_next[right], TURNED_RIGHT),
            ];
            for (next, price, by) in steps.into_iter().filter(|(_, price, _)| price.is_finite()) {
                let cost = f64::from(costs[state]) + price;
                #[expect(clippy::cast_possible_truncation, reason = "memory is scarce")]
                let kept = cost as f32;
                if how[next] == 0 || (how[next] & DONE == 0 && kept < costs[next]) {
                    costs[next] = kept;
                    how[next] = by;
                    open.push(Reverse((
                        key(cost, self.at_least(next / DIRECTIONS, target)),
                        number(next),
                    )));
                }
            }
        }
        Found::None { reached: reached / 2 }
    }

    /// The way to a state.
    fn way(&self, how: &[u8], end: usize) -> Found {
        let (mut cells, mut headings) = (vec![end / DIRECTIONS], Vec::new());
        let mut state = end;
        loop {
            let (cell, direction) = (state / DIRECTIONS, state % DIRECTIONS);
            state = match how[state] & !DONE {
                DROVE => {
                    let back = (direction + DIRECTIONS / 2) % DIRECTIONS;
                    let from = self.ahead(cell, back).unwrap_or(cell);
                    cells.push(from);
                    headings.push(direction);
                    from * DIRECTIONS + direction
                }
                TURNED_LEFT => cell * DIRECTIONS + (direction + DIRECTIONS - 1) % DIRECTIONS,
                TURNED_RIGHT => cell * DIRECTIONS + (direction + 1) % DIRECTIONS,
                _ => break,
            };
        }
        cells.reverse();
        headings.reverse();
        Found::Way(cells, headings)
    }
}
