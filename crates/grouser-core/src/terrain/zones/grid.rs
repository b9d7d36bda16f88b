//! Zones by the numbers of a grid's cells.

use std::ops::RangeInclusive;

use super::border::Border;
use super::error::ZonesError;
use super::number::NO_ZONE;
use crate::terrain::elevation::ElevationGrid;
use crate::units::Vec2;

/// More cells than this below a wheel are not looked at one by one.
const MOST_CELLS: i64 = 2_500;

/// The zones of a grid's points; places are seen from its first point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GridZones {
    grid: ElevationGrid,
    zones: Vec<u8>,
}

impl GridZones {
    pub(super) fn new(grid: ElevationGrid, zones: Vec<u8>) -> Result<Self, ZonesError> {
        if zones.len() != grid.checked_points()? {
            let (columns, rows, given) = (grid.columns, grid.rows, zones.len());
            return Err(ZonesError::Count { columns, rows, given });
        }
        Ok(Self { grid, zones })
    }

    pub(super) fn base(&self) -> Vec2 {
        self.grid.south_west
    }

    pub(super) fn zone(&self, at: Vec2) -> Option<usize> {
        let [column, row] = self.grid.cells(at).map(cell);
        self.number(column, row)
    }

    /// The number of a cell, within the grid or beyond it.
    fn number(&self, column: i64, row: i64) -> Option<usize> {
        let within = |cell: i64, count: usize| usize::try_from(cell).ok().filter(|it| *it < count);
        let (column, row) = (within(column, self.grid.columns)?, within(row, self.grid.rows)?);
        let zone = self.zones[row * self.grid.columns + column];
        (zone != NO_ZONE).then(|| zone.into())
    }

    pub(super) fn borders(&self, about: Vec2, reach: Vec2) -> Option<Vec<Border>> {
        let [low, high] = [about - reach, about + reach].map(|at| self.grid.cells(at).map(cell));
        let [columns, rows] = [low[0]..=high[0], low[1]..=high[1]];
        let count = |range: &RangeInclusive<i64>| range.end() - range.start() + 1;
        if count(&columns) > MOST_CELLS || count(&rows) > MOST_CELLS / count(&columns) {
            return None;
        }
        let spacing = self.grid.spacing;
        let corner = |column: i64, row: i64| {
            Vec2::new(column as f64 - 0.5, row as f64 - 0.5).component_mul(&spacing)
        };
        let mut borders = Vec::new();
        for row in rows.clone() {
            for column in columns.clone() {
                let here = self.number(column, row);
                if column > *columns.start() && self.number(column - 1, row) != here {
                    borders.push([corner(column, row), corner(column, row + 1)]);
                }
                if row > *rows.start() && self.number(column, row - 1) != here {
                    borders.push([corner(column, row), corner(column + 1, row)]);
                }
            }
        }
        Some(borders)
    }
}

/// The cell of a place in cells from the first point.
#[expect(clippy::cast_possible_truncation, reason = "a place far outside is outside of the grid")]
fn cell(place: f64) -> i64 {
    /// Far outside of every grid.
    const FAR: f64 = 1e15;
    (place + 0.5).floor().clamp(-FAR, FAR) as i64
}
