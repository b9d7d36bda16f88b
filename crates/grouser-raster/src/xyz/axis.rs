//! The regular grid that coordinates lie on, along one axis.

/// Where the points of a grid are along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    /// The first one [m].
    pub(super) first: f64,
    /// Distance between neighbours [m].
    pub(super) spacing: f64,
    pub(super) count: u64,
}

/// Why coordinates are on no grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Irregular {
    /// All are the same.
    OneValue,
    /// One lies between the others.
    Between {
        /// Which one.
        point: usize,
        /// Distance between the others [m].
        spacing: f64,
    },
}

/// How far a coordinate may be from its point of the grid, over the spacing [-]: what printing it
/// with few digits takes.
const OFF: f64 = 0.02;
/// Coordinates that near to each other are one, over the largest of them [-]: what sums of spacings
/// leave.
const SAME: f64 = 1e-12;

impl Axis {
    /// The grid of these coordinates.
    ///
    /// Its spacing is the usual distance from one coordinate to the next one, or the least one if
    /// distances differ, as they do where rows or columns are missing.
    pub(super) fn of(coordinates: &[f64]) -> Result<Self, Irregular> {
        let mut sorted = coordinates.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let (first, last) = (sorted[0], sorted[sorted.len() - 1]);
        let same = SAME * first.abs().max(last.abs());
        sorted.dedup_by(|next, kept| *next - *kept <= same);
        if sorted.len() < 2 {
            return Err(Irregular::OneValue);
        }
        let mut steps: Vec<f64> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_unstable_by(f64::total_cmp);
        let (usual, least) = (steps[steps.len() / 2], steps[0]);
        let as_usual = steps.iter().filter(|step| (*step / usual - 1.0).abs() <= OFF).count();
        // Where most neighbours are as far apart, the others are wrong and not the grid finer.
        let spacing = if 2 * as_usual > steps.len() { usual } else { least };
        Self::with_spacing(&sorted, spacing).ok_or_else(|| {
            let axis = Self { first, spacing, count: u64::MAX };
            let off = |coordinate: f64| axis.off(coordinate) > OFF;
            let point = coordinates.iter().position(|coordinate| off(*coordinate)).unwrap_or(0);
            Irregular::Between { point, spacing }
        })
    }

    /// The grid of about that spacing, if all coordinates are on it.
    fn with_spacing(sorted: &[f64], spacing: f64) -> Option<Self> {
        let steps = sorted.windows(2).map(|pair| ((pair[1] - pair[0]) / spacing).round());
        let steps: f64 = steps.sum();
        let (first, last) = (sorted[0], sorted[sorted.len() - 1]);
        if steps < (sorted.len() - 1) as f64 || steps > 1e15 {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e15")]
        let count = steps as u64 + 1;
        let axis = Self { first, spacing: (last - first) / steps, count };
        sorted.iter().all(|coordinate| axis.off(*coordinate) <= OFF).then_some(axis)
    }

    /// The point of a coordinate that is on the grid.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "zero to the number of points"
    )]
    pub(super) fn index(&self, coordinate: f64) -> usize {
        self.place(coordinate).round() as usize
    }

    fn place(&self, coordinate: f64) -> f64 {
        (coordinate - self.first) / self.spacing
    }

    /// How far from the nearest point, over the spacing [-].
    fn off(&self, coordinate: f64) -> f64 {
        let place = self.place(coordinate);
        (place - place.round()).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_printed_with_few_digits_is_found() {
        let thirds: Vec<f64> =
            (0..2000).map(|i| (1e3 * (500_000.0 + f64::from(i) / 3.0)).round() / 1e3).collect();
        let axis = Axis::of(&thirds).expect("a grid");
        assert_eq!((axis.count, axis.index(thirds[1234])), (2000, 1234));
        assert!((axis.spacing - 1.0 / 3.0).abs() < 1e-6);
    }

    #[test]
    fn gaps_are_multiples_of_the_spacing() {
        let gappy = Axis::of(&[0.0, 2.0, 8.0, 10.0, 9.0, 4.0, 20.0]).expect("a grid");
        assert_eq!((gappy.count, gappy.spacing), (21, 1.0));
    }

    #[test]
    fn what_is_off_the_grid_is_found() {
        let off = Axis::of(&[0.0, 1.0, 2.0, 3.5, 4.0, 5.0, 6.0]);
        assert_eq!(off, Err(Irregular::Between { point: 3, spacing: 1.0 }));
        assert_eq!(Axis::of(&[3.0, 3.0]), Err(Irregular::OneValue));
    }
}
