//! GridHeights that no ground has: missing ones that no file declares, steps, spikes.
//!
//! Nothing is changed; what is found is said. The thresholds are ours: they lie where slopes between
//! neighbouring cells are beyond those of any slope that a rover stands on.

use grouser_core::terrain::ElevationGrid;

use crate::remark::Remark;

/// GridHeights to look at.
#[derive(Clone, Copy, Debug)]
struct GridHeights<'h> {
    grid: &'h ElevationGrid,
    /// Above a base [m], in rows from south to north; NaN where they are missing.
    above: &'h [f32],
}

/// Looks at heights.
///
/// * `base`: what they are above [m]
/// * `above`: in rows from south to north [m]; NaN where they are missing
#[must_use]
pub fn remarks(grid: &ElevationGrid, base: f64, above: &[f32]) -> Vec<Remark> {
    let heights = GridHeights { grid, above };
    let voids = heights.voids();
    let of_ground = |height: f32| height.is_finite() && !voids.iter().any(|it| it.value == height);
    let mut found: Vec<Remark> = voids.iter().map(|it| it.remark(base)).collect();
    found.extend(heights.steps(&of_ground));
    found.extend(heights.spikes(&of_ground));
    found
}

/// A height that stands for a missing one.
#[derive(Clone, Copy, Debug)]
struct Void {
    value: f32,
    cells: usize,
    gap: f64,
}

impl Void {
    fn remark(self, base: f64) -> Remark {
        // Such heights have few digits, which a sum of rounded numbers does not give back.
        let height = (1e3 * (base + f64::from(self.value))).round() / 1e3;
        Remark::Void { cells: self.cells, height, gap: self.gap }
    }
}

impl GridHeights<'_> {
    /// Distance of neighbours [m].
    fn spacing(&self) -> f64 {
        self.grid.spacing.x.min(self.grid.spacing.y)
    }

    /// Extreme heights that are apart from all others by far more than these differ.
    fn voids(&self) -> Vec<Void> {
        /// Kinds of missing heights in one file, at most.
        const MOST: usize = 4;
        /// Gap over the range of all other heights [-], and over the distance of neighbours [-].
        const OF_RANGE: f64 = 3.0;
        const OF_SPACING: f64 = 20.0;
        let mut voids: Vec<Void> = Vec::new();
        while voids.len() < MOST {
            let known = self.above.iter().copied().filter(|height| {
                height.is_finite() && !voids.iter().any(|void| void.value == *height)
            });
            let Some(ends) = ExtremeHeights::of(known) else { break };
            let [low, lower, higher, high] = ends.heights.map(f64::from);
            let apart = |gap: f64, range: f64| gap > OF_RANGE * range + OF_SPACING * self.spacing();
            if apart(lower - low, high - lower) {
                voids.push(Void { value: ends.heights[0], cells: ends.cells[0], gap: low - lower });
            } else if apart(high - higher, higher - low) {
                voids.push(Void {
                    value: ends.heights[3],
                    cells: ends.cells[1],
                    gap: high - higher,
                });
            } else {
                break;
            }
        }
        voids
    }

    /// The step that heights go up and down by, where it makes a slope.
    fn steps(&self, of_ground: &impl Fn(f32) -> bool) -> Option<Remark> {
        /// Rows that are looked at, at most.
        const ROWS: usize = 512;
        /// The least slope that a step must make to be worth a word [m/m].
        const SLOPE: f64 = 0.05;
        let stride = self.grid.rows.div_ceil(ROWS);
        let rows = || self.rows().step_by(stride);
        let differences = |row: &[f32]| -> Vec<f64> {
            let pairs = row.windows(2).filter(|pair| pair.iter().all(|it| of_ground(*it)));
            pairs.map(|pair| f64::from(pair[1]) - f64::from(pair[0])).collect()
        };
        let all: Vec<Vec<f64>> = rows().map(differences).collect();
        let steps = || all.iter().flatten().map(|it| it.abs()).filter(|it| *it > 0.0);
        let step = steps().reduce(f64::min)?;
        if step < SLOPE * self.grid.spacing.x || !steps().all(|it| is_whole(it / step)) {
            return None;
        }
        // Ground of steps is level between them; a ramp goes on.
        let lone = |it: &&[f64]| it[1] != 0.0 && it[0] * it[1] <= 0.0 && it[1] * it[2] <= 0.0;
        let alone = all.iter().flat_map(|row| row.windows(3)).filter(lone).count();
        let level = all.iter().flatten().filter(|it| **it == 0.0).count();
        let count = steps().count();
        let is_stepped = 3 * alone > count && 10 * level > count && count > 8;
        is_stepped.then(|| Remark::Steps { step, slope: (step / self.grid.spacing.x).atan() })
    }

    /// Single cells that stand out of all four neighbours.
    fn spikes(&self, of_ground: &impl Fn(f32) -> bool) -> Option<Remark> {
        /// Height over all neighbours, over their distance [-]: 76°.
        const STEEP: f32 = 4.0;
        #[expect(clippy::cast_possible_truncation, reason = "a threshold")]
        let steep = [self.grid.spacing.x, self.grid.spacing.y].map(|it| STEEP * it as f32);
        let rows: Vec<&[f32]> = self.rows().collect();
        let (mut cells, mut worst) = (0, (0.0_f32, 0, 0));
        for (row, three) in (1..).zip(rows.windows(3)) {
            for column in 1..self.grid.columns.saturating_sub(1) {
                let here = three[1][column];
                // Most cells are near to their first neighbour.
                if (here - three[1][column - 1]).abs() <= steep[0] || !of_ground(here) {
                    continue;
                }
                let across = [three[1][column - 1], three[1][column + 1]];
                let along = [three[0][column], three[2][column]];
                let Some(out) = out_of(here, (across, steep[0]), (along, steep[1])) else {
                    continue;
                };
                cells += 1;
                if out.abs() > worst.0.abs() {
                    worst = (out, column, row);
                }
            }
        }
        let (height, column, row) = worst;
        let at = self.grid.point(column, row);
        (cells > 0).then(|| Remark::Spikes { cells, height: f64::from(height), at })
    }

    fn rows(&self) -> impl Iterator<Item = &[f32]> {
        self.above.chunks_exact(self.grid.columns.max(1))
    }
}

/// How far a height is above all neighbours, or below them, if that is more than so much.
fn out_of(here: f32, across: ([f32; 2], f32), along: ([f32; 2], f32)) -> Option<f32> {
    let mut least = f32::INFINITY;
    for (neighbours, steep) in [across, along] {
        for neighbour in neighbours {
            let out = here - neighbour;
            // Missing neighbours say nothing.
            if out.is_nan()
                || out.abs() <= steep
                || (least.is_finite() && out.signum() != least.signum())
            {
                return None;
            }
            if out.abs() < least.abs() {
                least = out;
            }
        }
    }
    Some(least)
}

/// Whether a quotient is whole, but for rounding.
fn is_whole(quotient: f64) -> bool {
    (quotient - quotient.round()).abs() <= 1e-3 * quotient.max(1.0)
}

/// The two least and the two greatest heights.
struct ExtremeHeights {
    /// Ascending.
    heights: [f32; 4],
    /// How many have the least, and how many the greatest.
    cells: [usize; 2],
}

impl ExtremeHeights {
    /// None unless there are two different heights.
    fn of(known: impl Iterator<Item = f32>) -> Option<Self> {
        let (mut low, mut lower, mut higher, mut high) =
            (f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY);
        let mut cells = [0, 0];
        for height in known {
            if height < low {
                (lower, low, cells[0]) = (low, height, 0);
            } else if height > low && height < lower {
                lower = height;
            }
            if height > high {
                (higher, high, cells[1]) = (high, height, 0);
            } else if height < high && height > higher {
                higher = height;
            }
            cells[0] += usize::from(height == low);
            cells[1] += usize::from(height == high);
        }
        (low < high).then_some(Self { heights: [low, lower, higher, high], cells })
    }
}
