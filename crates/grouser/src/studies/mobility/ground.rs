//! The ground that a map is of.

use grouser_raster::Raster;
use rayon::prelude::*;

use super::map::{CellMotion, MobilityMap};
use crate::elementary::wide::atan2;
use crate::units::Vec2;
use crate::vehicle::Rover;

/// Heights, and how far apart those are between which a rover stands.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    raster: &'a Raster,
    reach: [usize; 2],
}

impl<'a> Ground<'a> {
    /// Ground under a rover: slopes are those between points half of the rover's length away on
    /// either side, or neighbours where points are farther apart.
    #[must_use]
    pub fn under(rover: &Rover, raster: &'a Raster) -> Self {
        let hubs = rover.mounts().iter().map(|mount| mount.position.x);
        let (rear, front) =
            hubs.fold((0.0, 0.0), |(low, high), x| (f64::min(low, x), f64::max(high, x)));
        let half = 0.5 * (front - rear);
        let spacing = raster.grid.spacing;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive ratio, at least 1"
        )]
        let reach =
            [spacing.x, spacing.y].map(|spacing| (half / spacing).round().max(1.0) as usize);
        Self { raster, reach }
    }

    /// The heights.
    #[must_use]
    pub fn raster(&self) -> &'a Raster {
        self.raster
    }

    /// Distance of the points between which slopes are taken, to the east and to the north [m].
    #[must_use]
    pub fn slope_length(&self) -> [f64; 2] {
        let spacing = self.raster.grid.spacing;
        [2.0 * self.reach[0] as f64 * spacing.x, 2.0 * self.reach[1] as f64 * spacing.y]
    }

    /// How steeply a point's ground rises to the east and to the north [m/m]; none where its height
    /// is missing.
    #[must_use]
    pub fn gradient(&self, column: usize, row: usize) -> Option<Vec2> {
        self.raster.gradient(column, row, self.reach)
    }

    /// The steepest slope of all points whose slope is known [rad].
    #[must_use]
    pub fn steepest(&self) -> f64 {
        let grid = &self.raster.grid;
        let of_row = |row: usize| {
            let gradients = (0..grid.columns).filter_map(|column| self.gradient(column, row));
            gradients.map(|it| it.norm()).fold(0.0, f64::max)
        };
        atan2((0..grid.rows).into_par_iter().map(of_row).reduce(|| 0.0, f64::max), 1.0)
    }

    /// Whether the ground is known all around a point, as far as a rover's wheels reach.
    #[must_use]
    pub fn surrounds(&self, column: usize, row: usize) -> bool {
        let raster = self.raster;
        let [east, north] = self.reach;
        column >= east
            && row >= north
            && (row - north..=row + north).all(|row| {
                (column - east..=column + east).all(|column| raster.height(column, row).is_some())
            })
    }

    /// What a rover does at a point; none where its height is missing.
    ///
    /// * `row`: from the south
    #[must_use]
    pub fn at(&self, map: &MobilityMap, column: usize, row: usize) -> Option<CellMotion> {
        self.gradient(column, row).map(|gradient| map.at(gradient))
    }
}
