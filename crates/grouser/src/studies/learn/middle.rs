//! The middle of readings of which some are outliers, and how well it is known.

/// The mean of the readings that are near the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Middle {
    /// The mean.
    pub(super) value: f64,
    /// Standard deviation of a reading, by the middle half: however far off outliers are.
    pub(super) scatter: f64,
    /// Standard deviation of a reading, by those that are near the others.
    pub(super) spread: f64,
    /// How many readings are near the others.
    pub(super) count: usize,
    /// How many are not.
    pub(super) outliers: usize,
}

/// Readings farther than this from the median are outliers, in standard deviations. Source: ours;
/// of a thousand normal readings two are.
const FARTHEST: f64 = 3.1;

/// Fewer readings than this have their median, and no mean.
const MANY: usize = 12;

impl Middle {
    /// Returns the middle of some readings; `None` if there are no readings.
    ///
    /// The scatter is that of the middle half, which is 1.349 standard deviations of normal
    /// readings wide: a quarter of outliers at each end does not show in it. Readings that are
    /// rounded to more than that have the scatter of the middle eight tenths, 2.563 wide.
    pub(super) fn of(readings: &mut [f64]) -> Option<Self> {
        const HALF: f64 = 1.348_979_500_4;
        const EIGHT_TENTHS: f64 = 2.563_103_131_1;
        if readings.is_empty() {
            return None;
        }
        readings.sort_by(f64::total_cmp);
        let at = |share: f64| grouser_io::statistics::quantile(readings, share).unwrap_or(f64::NAN);
        let (median, half) = (at(0.5), (at(0.75) - at(0.25)) / HALF);
        let scatter = if half > 0.0 { half } else { (at(0.9) - at(0.1)) / EIGHT_TENTHS };
        // The middle half of a dozen readings may be narrow by chance: those near it tell what is
        // near.
        let (_, _, first) = near(readings, median, scatter);
        let (count, mean, spread) = near(readings, median, first.max(scatter));
        // Of few readings two may be outliers in one direction, and widen what counts as near.
        let value = if count < MANY { median } else { mean };
        let outliers = readings.len() - count;
        Some(Self { value, scatter, spread, count: count.max(1), outliers })
    }

    /// Standard deviation of the mean.
    ///
    /// * `usual`: of a reading, where there are too few to tell
    pub(super) fn deviation(&self, usual: f64) -> f64 {
        const ENOUGH: usize = 5;
        /// Standard deviation of a median over that of a mean, √(π/2) [-].
        const OF_MEDIAN: f64 = 1.253;
        let (scatter, factor) = match self.count {
            0..ENOUGH => (self.scatter.max(usual), if self.count > 1 { OF_MEDIAN } else { 1.0 }),
            ENOUGH..MANY => (self.scatter, OF_MEDIAN),
            _ => (self.spread, 1.0),
        };
        factor * scatter / (self.count as f64).sqrt()
    }
}

/// Returns the count, mean and standard deviation of the readings that are near a middle.
///
/// The deviation is that whose inverse square is right on the mean, Σ(x − m)²/(n − 3) with their
/// mean m: readings are weighed by it, and one that is right on the mean itself would give those
/// too much weight that lie close together by chance.
fn near(readings: &[f64], middle: f64, scatter: f64) -> (usize, f64, f64) {
    let near = || readings.iter().filter(|it| (**it - middle).abs() <= FARTHEST * scatter);
    let count = near().count();
    let mean = near().sum::<f64>() / count.max(1) as f64;
    let squares: f64 = near().map(|it| (it - mean) * (it - mean)).sum();
    (count, mean, (squares / count.saturating_sub(3).max(1) as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::random;

    #[test]
    fn outliers_do_not_move_the_middle() {
        let mut random = random::generator(5, 1);
        let mut readings: Vec<f64> =
            (0..400).map(|_| 1.0 + 0.1 * random::standard_normal(&mut random)).collect();
        let clean = Middle::of(&mut readings.clone()).unwrap();
        for reading in readings.iter_mut().step_by(20) {
            *reading = 50.0;
        }
        let found = Middle::of(&mut readings).unwrap();
        assert!((found.value - clean.value).abs() < 0.01, "{found:?}");
        assert!((found.scatter - 0.1).abs() < 0.015, "{found:?}");
        assert!((20..=26).contains(&found.outliers), "{found:?}");
    }

    /// Readings rounded to more than their noise still have the mean of all.
    #[test]
    fn rounded_readings_have_their_mean() {
        let mut readings = [vec![0.0; 30], vec![1.0; 70]].concat();
        let found = Middle::of(&mut readings).unwrap();
        assert!((found.value - 0.7).abs() < 1e-12 && found.outliers == 0, "{found:?}");
        assert!(Middle::of(&mut []).is_none());
        let one = Middle::of(&mut [3.0]).unwrap();
        assert_eq!((one.value, one.deviation(0.2)), (3.0, 0.2));
    }
}
