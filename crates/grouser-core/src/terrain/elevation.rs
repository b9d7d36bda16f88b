//! Elevation models: measured heights at the points of a regular grid.

mod convolution;
mod error;
mod gaps;
mod grid;

pub use error::ElevationError;
pub use grid::{ElevationGrid, Extent};

use super::{Footprint, Patch, Terrain};
use crate::units::Vec2;
use convolution::{POINTS, Stencil};
use gaps::Known;

/// Ground whose heights are known at the points of a regular grid.
///
/// Places are in the coordinates of a map: x east, y north, in metres. Between the points the
/// height is that of cubic convolution [Keys1981], which goes through the points' heights, has a
/// continuous gradient, and repeats every quadratic surface:
///
/// ```text
/// z(x, y) = Σ_i Σ_j w_i(u) w_j(v) z_ij          u, v: how far into the cell, 0 to 1; four points along each axis
/// ```
///
/// At the edges of the grid, points beyond it continue the three nearest by a parabola, as the
/// source does. A height of a point that is not finite is *missing*: at the rim of missing heights
/// the known ones are continued in the same manner, so that places between four known points have
/// no use for what lies beyond. [`covers`](Terrain::covers) tells such places from the others.
/// Elsewhere the ground goes on as high as at the nearest edge, so that there is a height
/// everywhere.
///
/// A wheel meets the least-squares plane of the ground at the points of its footprint
/// ([`Footprint::fit`]).
///
/// A point takes 4 bytes: heights are kept as `f32` above a base. Over a relief of 100 m that
/// rounds them to 4 µm, wherever the base is. Coordinates are `f64`; the grid's own place on the
/// map (hundreds of kilometres) costs them 0.1 nm.
///
/// How steep is the ground at a place of a map, 2 m between its points, on the rim of a shallow
/// bowl?
///
/// ```
/// use grouser_core::terrain::{ElevationGrid, ElevationModel, Footprint, Terrain};
/// use grouser_core::units::Vec2;
///
/// let south_west = Vec2::new(500_000.0, -2_100_000.0);
/// let grid = ElevationGrid { columns: 11, rows: 11, south_west, spacing: Vec2::new(2.0, 2.0) };
/// let middle = south_west + Vec2::new(10.0, 10.0);
/// let bowl = |place: Vec2| -1250.0 + 0.02 * (place - middle).norm_squared();
/// let heights: Vec<f64> = grid.points().map(bowl).collect();
/// let model = ElevationModel::new(grid, heights)?;
///
/// let east = middle + Vec2::new(5.0, 0.0);
/// assert_eq!(format!("{:.3} m", model.height(east)), "-1249.500 m");
/// assert_eq!(format!("{:.1}°", model.gradient(east).norm().atan().to_degrees()), "11.3°");
/// let wheel = Footprint { forward: Vec2::y(), half_length: 0.05, half_width: 0.04 };
/// assert!(model.covers(east, wheel) && !model.covers(middle + Vec2::new(11.0, 0.0), wheel));
/// # Ok::<(), grouser_core::terrain::ElevationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ElevationModel {
    grid: ElevationGrid,
    /// Height of the zero of `heights` [m].
    base: f64,
    /// Above the base [m], all finite, in the order of [`ElevationGrid::points`].
    heights: Vec<f32>,
    /// At which points the height was given.
    known: Known,
}

impl ElevationModel {
    /// The model of these heights.
    ///
    /// * `heights`: at the grid's points [m], in rows from south to north, each from west to east;
    ///   those that are not finite are missing
    ///
    /// # Errors
    /// [`ElevationError`] if the grid is invalid, does not have as many points as there are
    /// heights, or if no height is known.
    pub fn new(
        grid: ElevationGrid,
        heights: impl IntoIterator<Item = f64>,
    ) -> Result<Self, ElevationError> {
        let points = grid.checked_points()?;
        let mut base = None;
        let above = heights.into_iter().map(|height| {
            if height.is_finite() {
                above(height, *base.get_or_insert_with(|| round_base(height)))
            } else {
                f32::NAN
            }
        });
        // One more than needed is enough to see that there are too many.
        let above: Vec<f32> = above.take(points.saturating_add(1)).collect();
        Self::above_base(grid, base.unwrap_or(0.0), above)
    }

    /// The model of heights above a base, which are kept as they are.
    ///
    /// * `base`: what they are above [m]: near them, and a whole number of metres so that it costs
    ///   no bit
    /// * `heights`: as for [`new`](Self::new)
    ///
    /// # Errors
    /// The same as [`new`](Self::new).
    pub fn above_base(
        grid: ElevationGrid,
        base: f64,
        mut heights: Vec<f32>,
    ) -> Result<Self, ElevationError> {
        let points = grid.checked_points()?;
        if heights.len() != points {
            let given = heights.len();
            return Err(ElevationError::Count { columns: grid.columns, rows: grid.rows, given });
        }
        if !base.is_finite() {
            return Err(ElevationError::Base { base });
        }
        let known = Known::of(&heights);
        if known.is_none_of(points) {
            return Err(ElevationError::NothingKnown { points });
        }
        gaps::close(&mut heights, &grid, &known);
        Ok(Self { grid, base, heights, known })
    }

    /// The points at which heights were given.
    #[must_use]
    pub fn grid(&self) -> &ElevationGrid {
        &self.grid
    }

    /// What its points span.
    #[must_use]
    pub fn extent(&self) -> Extent {
        self.grid.extent()
    }

    /// What the heights are kept above [m].
    #[must_use]
    pub fn base(&self) -> f64 {
        self.base
    }

    /// The heights above the base [m] as [`above_base`](Self::above_base) takes them: NaN where
    /// they are missing.
    pub fn heights_above_base(&self) -> impl Iterator<Item = f32> + '_ {
        let given = |(point, height): (usize, &f32)| {
            if self.known.contains(point) { *height } else { f32::NAN }
        };
        self.heights.iter().enumerate().map(given)
    }

    /// Number of points whose height is missing.
    #[must_use]
    pub fn missing(&self) -> usize {
        self.known.missing()
    }

    /// The height above the datum of the heights that were given [m].
    ///
    /// * `at`: the place on the map [m]
    #[must_use]
    pub fn height(&self, at: Vec2) -> f64 {
        self.base + self.above_base_at(self.grid.place(at))
    }

    /// The height above the base [m] at a place in cells from the first point.
    fn above_base_at(&self, [column, row]: [f64; 2]) -> f64 {
        let along_x = Stencil::of_height(column, self.grid.columns);
        let along_y = Stencil::of_height(row, self.grid.rows);
        let rows = self.about(&along_x, &along_y);
        along_y.sum(rows.map(|row| along_x.sum(row)))
    }

    /// How fast the height grows to the east and to the north [-]. Outside of the extent nothing
    /// grows across the edge.
    ///
    /// * `at`: the place on the map [m]
    #[must_use]
    pub fn gradient(&self, at: Vec2) -> Vec2 {
        let [column, row] = self.grid.place(at);
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        let along_x = Stencil::of_height(column, columns);
        let along_y = Stencil::of_height(row, rows);
        let east = Stencil::of_slope(column, columns, self.grid.spacing.x);
        let north = Stencil::of_slope(row, rows, self.grid.spacing.y);
        let about = self.about(&along_x, &along_y);
        let x = along_y.sum(about.map(|row| east.sum(row)));
        Vec2::new(x, north.sum(about.map(|row| along_x.sum(row))))
    }

    /// Whether the place is between four points whose heights are known.
    #[must_use]
    pub fn is_known(&self, at: Vec2) -> bool {
        let Some((column, row)) = self.grid.cell(at) else { return false };
        let columns = self.grid.columns;
        // The last row and column have no cell of their own: their points are the edges of the one
        // before.
        let corner = row * columns + column;
        let corners = [corner, corner + 1, corner + columns, corner + columns + 1];
        corners.into_iter().all(|point| self.known.contains(point))
    }

    /// The heights above the base at the 16 points of two stencils, row by row; zero where a small
    /// grid has no such point, for which there is no weight either.
    fn about(&self, along_x: &Stencil, along_y: &Stencil) -> [[f64; POINTS]; POINTS] {
        let ElevationGrid { columns, rows, .. } = self.grid;
        let start = |row: usize| (along_y.first + row) * columns + along_x.first;
        if columns >= POINTS && rows >= POINTS {
            return std::array::from_fn(|row| {
                let here = self.heights[start(row)..].first_chunk::<POINTS>();
                here.expect("a stencil is within its grid").map(f64::from)
            });
        }
        let mut about = [[0.0; POINTS]; POINTS];
        for (row, heights) in about.iter_mut().enumerate().take(rows) {
            let here = &self.heights[start(row)..][..columns.min(POINTS)];
            for (to, height) in heights.iter_mut().zip(here) {
                *to = f64::from(*height);
            }
        }
        about
    }
}

impl Terrain for ElevationModel {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        self.patch_from(Vec2::zeros(), at, footprint)
    }

    fn patch_from(&self, origin: Vec2, at: Vec2, footprint: Footprint) -> Patch {
        // Neither the map's place nor its height is added before differences are taken.
        let from = origin - self.grid.south_west;
        let above = |place: Vec2| self.above_base_at(self.grid.cells(from + place));
        let fit = footprint.fit(&footprint.points(at).map(above));
        Patch { height: self.base + fit.height, ..fit }
    }

    fn height_from(&self, origin: Vec2, at: Vec2) -> f64 {
        let from = origin - self.grid.south_west;
        self.base + self.above_base_at(self.grid.cells(from + at))
    }

    fn covers(&self, at: Vec2, footprint: Footprint) -> bool {
        footprint.points(at).into_iter().all(|place| self.is_known(place))
    }
}

/// A base for heights like this one [m]: in whole metres, so that a height of a file in `f32` is
/// above it by a number that `f32` has, too.
#[must_use]
pub fn round_base(height: f64) -> f64 {
    height.round()
}

/// A height above a base, as it is kept [m].
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "a difference of heights, rounded on purpose")]
pub fn above(height: f64, base: f64) -> f32 {
    (height - base) as f32
}
