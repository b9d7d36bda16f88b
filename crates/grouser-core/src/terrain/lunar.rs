//! Ground that looks like the Moon's: craters by the published counts, in all states of wear, on
//! fractal relief.
//!
//! It is made by chance from a seed, and shows no place of the Moon. Craters are as many as counts
//! find where new ones form as fast as old ones wear away ([`EQUILIBRIUM`]). Their shapes are a
//! fresh crater's whose soil has crept downhill by diffusion, to the depths that [Dsne2021] states.
//! Between them is a relief with the Hurst exponent and the median slope of [Rosenburg2011].
//!
//! DIFFERENCE from the Moon: heights of craters add up where they overlap, so that a young crater
//! does not wipe out what was there before; slopes may then exceed a fresh crater's 31°. There are
//! no stones.

mod degradation;
mod population;
mod relief;

pub use population::{AgedCrater, EQUILIBRIUM, expected_count};
pub use relief::{BASELINE, Roughness};

use std::f64::consts::PI;
use std::ops::{Range, RangeInclusive};

use super::{ElevationGrid, Extent};
use crate::error::{ParameterError, finite, positive};
use crate::random::Random;
use crate::units::Vec2;
use degradation::{Profile, Shapes};
use population::Population;

/// The kinds of ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LunarGround {
    /// A plain of lava, smooth between its craters.
    #[default]
    Mare,
    /// The older and steeper ground about the plains.
    Highlands,
}

impl LunarGround {
    /// All kinds.
    pub const ALL: [Self; 2] = [Self::Mare, Self::Highlands];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Mare => "mare",
            Self::Highlands => "highlands",
        }
    }

    /// Its relief between craters. Source: [Rosenburg2011]: Hurst exponents of 0.76 and 0.95, and
    /// slopes whose median over 17 m is 2.0° and 7.5°. Of a surface of normal heights the median of
    /// the slope is √(2 ln 2) of the root mean square along a line. Craters come on top.
    #[must_use]
    pub fn roughness(self) -> Roughness {
        /// √(2 ln 2).
        const MEDIAN_OVER_RMS: f64 = 1.177_410_022_515_474_7;
        let (hurst, median_slope) = match self {
            Self::Mare => (0.76, PI / 90.0),
            Self::Highlands => (0.95, PI / 24.0),
        };
        let median = crate::elementary::wide::tan(median_slope);
        Roughness { hurst, rms_slope: median / MEDIAN_OVER_RMS }
    }
}

/// A square piece of lunar ground.
///
/// How many craters of at least 4 m has a site of 200 m, and how deep is its largest?
///
/// ```
/// use grouser_core::terrain::lunar::LunarSite;
///
/// let model = LunarSite::new(200.0, 1.0, 1).model()?;
/// let largest = model.craters[0];
/// let shown = format!("{}: {:.0} m, {:.1} m deep", model.craters.len(), largest.diameter, largest.depth);
/// assert_eq!(shown, "211: 33 m, 1.6 m deep");
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LunarSite {
    /// Its sides [m], rounded to whole cells.
    pub size: f64,
    /// Distance between neighbouring points [m].
    pub cell_size: f64,
    /// What ground it is.
    pub ground: LunarGround,
    /// Number of craters over that of the [equilibrium](EQUILIBRIUM) [-], 0 to 1.
    pub crater_share: f64,
    /// Upper limit of the craters' diameters [m].
    pub largest_crater: f64,
    /// Seed of all that is by chance.
    pub seed: u64,
}

/// Heights of a [`LunarSite`].
#[derive(Clone, Debug, PartialEq)]
pub struct LunarModel {
    /// The points. The origin is the site's middle.
    pub grid: ElevationGrid,
    /// Heights at the points [m], in the grid's order.
    pub heights: Vec<f64>,
    /// The craters with their centres on the site, from the largest down.
    pub craters: Vec<AgedCrater>,
}

/// Streams of random numbers.
const RELIEF: u64 = 1;
const CRATERS: u64 = 2;

impl LunarSite {
    /// Cells along a side, at least and at most.
    pub const CELLS: RangeInclusive<f64> = 8.0..=4096.0;
    /// Sides that a site may have at most [m]: on larger ones the Moon's shape shows.
    pub const LARGEST_SIZE: f64 = 20_000.0;
    /// Diameter of the smallest craters over a cell [-]: fewer cells do not show a bowl.
    pub const SMALLEST_IN_CELLS: f64 = 4.0;
    /// Upper limit of the craters' diameters, where nothing else is asked for [m]: the law's,
    /// [`EQUILIBRIUM`].
    pub const USUAL_LARGEST_CRATER: f64 = 100.0;
    /// The largest that may be asked for [m]: how many larger ones there are depends on the
    /// ground's age.
    pub const LARGEST_CRATER: f64 = 300.0;

    /// Mare whose craters are in equilibrium, up to a diameter of 100 m.
    ///
    /// * `size`: of a side [m]
    /// * `cell_size`: distance between neighbouring points [m]
    #[must_use]
    pub fn new(size: f64, cell_size: f64, seed: u64) -> Self {
        let largest_crater = Self::USUAL_LARGEST_CRATER;
        Self { size, cell_size, ground: LunarGround::Mare, crater_share: 1.0, largest_crater, seed }
    }

    /// Diameter of the smallest craters [m].
    #[must_use]
    pub fn smallest_crater(&self) -> f64 {
        Self::SMALLEST_IN_CELLS * self.cell_size
    }

    /// Mean number of craters with their centres on such sites.
    #[must_use]
    pub fn expected_craters(&self) -> f64 {
        let area = self.size * self.size;
        let above = |diameter: f64| expected_count(self.crater_share, diameter, area);
        above(self.smallest_crater()) - above(self.largest_crater)
    }

    /// Checks that the site's values are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("size of the site [m]", self.size)?;
        positive("cell size [m]", self.cell_size)?;
        finite("share of craters [-]", self.crater_share)?;
        let within = |is_within: bool, name: &str, value: f64, expected: &'static str| {
            if is_within { Ok(()) } else { Err(ParameterError::new(name, value, expected)) }
        };
        let cells = (self.size / self.cell_size).round();
        within(Self::CELLS.contains(&cells), "number of cells along a side", cells, "8 to 4096")?;
        let is_small = self.size <= Self::LARGEST_SIZE;
        within(is_small, "size of the site [m]", self.size, "20000 at most")?;
        let is_share = (0.0..=1.0).contains(&self.crater_share);
        within(is_share, "share of craters [-]", self.crater_share, "0 to 1")?;
        let largest = self.largest_crater;
        let diameters = self.smallest_crater()..=Self::LARGEST_CRATER;
        within(
            diameters.contains(&largest) || (self.crater_share == 0.0 && largest.is_finite()),
            "diameter of the largest crater [m]",
            largest,
            "four cells or more, and 300 at most",
        )
    }

    /// The site's heights: of the same site the same, bit for bit. A finer grid has the same
    /// craters and the same waves, and smaller ones as well.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn model(&self) -> Result<LunarModel, ParameterError> {
        self.check()?;
        let grid = self.grid();
        let mut heights = vec![0.0; grid.columns * grid.rows];
        relief::add(
            &mut heights,
            &grid,
            self.ground.roughness(),
            Random::stream(self.seed, RELIEF),
        );
        let shapes = Shapes::new();
        let mut craters = Vec::new();
        let extent = grid.extent();
        for crater in self.craters(&shapes) {
            let profile = shapes.profile(crater.diameter, crater.depth / crater.diameter);
            dig(&mut heights, &grid, crater.centre, profile);
            if extent.contains(crater.centre) {
                craters.push(crater);
            }
        }
        Ok(LunarModel { grid, heights, craters })
    }

    /// The points, about the origin.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be 8 to 4096"
    )]
    fn grid(&self) -> ElevationGrid {
        let cells = (self.size / self.cell_size).round();
        let points = cells as usize + 1;
        let half = 0.5 * cells * self.cell_size;
        let spacing = Vec2::new(self.cell_size, self.cell_size);
        ElevationGrid {
            columns: points,
            rows: points,
            south_west: Vec2::new(-half, -half),
            spacing,
        }
    }

    /// The craters on the site and about it, as far as the largest may reach into it, from the
    /// largest down.
    fn craters(&self, shapes: &Shapes) -> impl Iterator<Item = AgedCrater> + use<> {
        let deepest = shapes.deepest();
        let half = 0.5 * self.size + shapes.profile(self.largest_crater, deepest).reach();
        let on = Extent { south_west: Vec2::new(-half, -half), north_east: Vec2::new(half, half) };
        let random = Random::stream(self.seed, CRATERS);
        let smallest = if self.crater_share > 0.0 { self.smallest_crater() } else { f64::INFINITY };
        Population::new(random, on, self.crater_share, self.largest_crater, deepest)
            .take_while(move |crater| crater.diameter >= smallest)
    }
}

/// Adds a crater to heights.
fn dig(heights: &mut [f64], grid: &ElevationGrid, centre: Vec2, profile: Profile<'_>) {
    let reach = profile.reach();
    let [column, row] = grid.cells(centre - grid.south_west);
    let columns = about(column, reach / grid.spacing.x, grid.columns);
    for row in about(row, reach / grid.spacing.y, grid.rows) {
        for column in columns.clone() {
            let distance = (grid.point(column, row) - centre).norm();
            heights[row * grid.columns + column] += profile.height(distance);
        }
    }
}

/// The points that are at most a number of cells away from a place.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "kept between 0 and the count"
)]
fn about(place: f64, cells: f64, count: usize) -> Range<usize> {
    let end = |at: f64| at.clamp(0.0, count as f64) as usize;
    end((place - cells).ceil())..end((place + cells).floor() + 1.0)
}
