//! Points whose height is missing.

use std::collections::VecDeque;

use super::ElevationGrid;

/// At which points the height is known: a bit for each, and none at all where all are.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Known {
    bits: Vec<u64>,
    missing: usize,
}

impl Known {
    /// The points with a finite height.
    pub(super) fn of(heights: &[f32]) -> Self {
        let missing = heights.iter().filter(|height| !height.is_finite()).count();
        if missing == 0 {
            return Self { bits: Vec::new(), missing };
        }
        let of_chunk = |chunk: &[f32]| {
            let known = chunk.iter().enumerate().filter(|(_, height)| height.is_finite());
            known.fold(0, |bits, (at, _)| bits | 1 << at)
        };
        Self { bits: heights.chunks(u64::BITS as usize).map(of_chunk).collect(), missing }
    }

    /// Whether the height of a point is known.
    pub(super) fn contains(&self, point: usize) -> bool {
        let size = u64::BITS as usize;
        self.missing == 0 || (self.bits[point / size] >> (point % size)) & 1 == 1
    }

    /// How many are not.
    pub(super) fn missing(&self) -> usize {
        self.missing
    }

    /// Whether of so many points all are missing.
    pub(super) fn is_none_of(&self, points: usize) -> bool {
        self.missing == points
    }
}

/// Gives every missing point a height: beside known points it continues them, in lines through
/// three of them by a parabola, through two straight on; farther off it is as high as the nearest
/// of those.
///
/// The ground between four known points then depends on known heights only.
pub(super) fn close(heights: &mut [f32], grid: &ElevationGrid, known: &Known) {
    if known.missing == 0 {
        return;
    }
    let mut queue = VecDeque::new();
    for point in (0..heights.len()).filter(|point| !known.contains(*point)) {
        heights[point] = match continued(heights, grid, known, point) {
            Some(height) => {
                queue.push_back(point);
                height
            }
            None => f32::NAN,
        };
    }
    while let Some(point) = queue.pop_front() {
        for (x, y) in DIRECTIONS {
            let Some(next) = step(grid, point, x, y) else { continue };
            if heights[next].is_nan() {
                heights[next] = heights[point];
                queue.push_back(next);
            }
        }
    }
}

/// To all neighbours, the near ones first.
const DIRECTIONS: [(isize, isize); 8] =
    [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];

/// The height that known points in line with a missing one have there, if any is beside it: the
/// mean over lines, of which those through three points count alone if there are any, then those
/// through two.
fn continued(heights: &[f32], grid: &ElevationGrid, known: &Known, point: usize) -> Option<f32> {
    let known_at = |x: isize, y: isize| {
        let place = step(grid, point, x, y).filter(|place| known.contains(*place))?;
        Some(f64::from(heights[place]))
    };
    let (mut best, mut sum, mut lines) = (0, 0.0, 0.0);
    for (x, y) in DIRECTIONS {
        let Some(near) = known_at(x, y) else { continue };
        let (through, height) = match (known_at(2 * x, 2 * y), known_at(3 * x, 3 * y)) {
            (Some(next), Some(far)) => (3, 3.0 * (near - next) + far),
            (Some(next), None) => (2, 2.0 * near - next),
            (None, _) => (1, near),
        };
        if through > best {
            (best, sum, lines) = (through, 0.0, 0.0);
        }
        if through == best {
            (sum, lines) = (sum + height, lines + 1.0);
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "a height like its neighbours'")]
    let mean = (sum / lines) as f32;
    (best > 0).then_some(mean).filter(|height| height.is_finite())
}

/// The point so many columns and rows away.
fn step(grid: &ElevationGrid, point: usize, x: isize, y: isize) -> Option<usize> {
    let column = (point % grid.columns).checked_add_signed(x)?;
    let row = (point / grid.columns).checked_add_signed(y)?;
    (column < grid.columns && row < grid.rows).then(|| row * grid.columns + column)
}
