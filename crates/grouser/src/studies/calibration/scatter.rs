//! Standard error of the mean over repeated trials.

/// Readings of one quantity in trials that repeat each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repeats {
    /// The trials' means.
    pub values: Vec<f64>,
    /// Standard deviations within the trials, where they were recorded.
    pub within: Vec<f64>,
}

/// A pooled variance counts as much as this many degrees of freedom [-].
///
/// Source: ours. Two or three trials hardly determine their own scatter, but a locked wheel's
/// trials do differ more than a rolling one's: ten keep the weights of cells that are alike within
/// a few percent of each other, and let a cell that scatters ten times as much count for less.
const POOL_WEIGHT: f64 = 10.0;

/// Standard deviation of each cell's mean.
///
/// A cell's variance between trials is pooled with that of all given cells. Where no cell was
/// repeated, the scatter within the trials stands in: an upper bound, since a mean over a trial
/// scatters less than its readings. Where that is unknown too, the scatter is 0, and the model
/// discrepancy takes its place.
#[must_use]
pub fn of_means(cells: &[Repeats]) -> Vec<f64> {
    let squares: f64 = cells.iter().map(Repeats::squares).sum();
    let freedom: f64 = cells.iter().map(Repeats::freedom).sum();
    let pooled = if freedom > 0.0 { squares / freedom } else { mean_square_within(cells) };
    let of_mean = |cell: &Repeats| {
        let variance = (POOL_WEIGHT * pooled + cell.squares()) / (POOL_WEIGHT + cell.freedom());
        (variance / (cell.values.len() as f64).max(1.0)).sqrt()
    };
    cells.iter().map(of_mean).collect()
}

impl Repeats {
    /// The mean over the trials.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / (self.values.len() as f64).max(1.0)
    }

    fn squares(&self) -> f64 {
        let mean = self.mean();
        self.values.iter().map(|value| (value - mean).powi(2)).sum()
    }

    fn freedom(&self) -> f64 {
        self.values.len().saturating_sub(1) as f64
    }
}

fn mean_square_within(cells: &[Repeats]) -> f64 {
    let within = || cells.iter().flat_map(|cell| &cell.within);
    let sum: f64 = within().map(|deviation| deviation * deviation).sum();
    sum / (within().count() as f64).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(values: &[f64]) -> Repeats {
        Repeats { values: values.to_vec(), within: vec![0.3; values.len()] }
    }

    #[test]
    fn cells_that_scatter_alike_share_their_variance() {
        // Both have a variance of 1 between two trials, √(1/2) for the mean.
        let (a, b) = (0.5_f64.sqrt(), 0.5_f64.sqrt());
        let scatter = of_means(&[cell(&[-a, a]), cell(&[5.0 - b, 5.0 + b])]);
        for one in scatter {
            assert!((one - 0.5_f64.sqrt()).abs() < 1e-12);
        }
    }

    /// The pooled variance is (0 + 200)/2 = 100, with weight 10: (1000 + 200)/11 and 1000/11.
    #[test]
    fn a_cell_that_scatters_more_counts_for_less() {
        let scatter = of_means(&[cell(&[-10.0, 10.0]), cell(&[1.0, 1.0])]);
        assert!((scatter[0].powi(2) - 1200.0 / 22.0).abs() < 1e-9);
        assert!((scatter[1].powi(2) - 1000.0 / 22.0).abs() < 1e-9);
    }

    #[test]
    fn without_repeats_the_scatter_within_trials_stands_in() {
        let scatter = of_means(&[cell(&[1.0]), cell(&[2.0])]);
        assert!(scatter.iter().all(|one| (one - 0.3).abs() < 1e-12));
        let unknown = Repeats { values: vec![1.0], within: vec![] };
        assert_eq!(of_means(&[unknown]), [0.0]);
    }
}
