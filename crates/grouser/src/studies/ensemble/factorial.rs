//! Full factorial designs: every level of a factor with every level of the others, and which part
//! of a result's variance each factor has.
//!
//! The law of total variance holds on such a design without any error of sampling:
//!
//! ```text
//! V = Var(E[Y | X_i]) + E[Var(Y | X_i)]
//! ```
//!
//! The first term is the *part* of factor *i* (first-order, V_i): if the factor were known,
//! whatever its level, the variance that is left would be V − V_i on average over its levels. As
//! every level meets every other, the parts and what only several factors cause together, their
//! *interactions*, add up to V, and no part is negative (Sobol 1993). The *total* of a factor is
//! its part with all of its interactions, E[Var(Y | all others)]: what would be left if it alone
//! were unknown. Its *shared* part has an equal share of each of its interactions (Shapley effects,
//! Owen 2014): these add up to V by themselves.

use std::iter::repeat_n;

use grouser_io::statistics::share_interval;

use super::statistics::Estimate;

/// Factors with their levels, of which each counts a number of times.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factorial {
    counts: Vec<Vec<u32>>,
}

/// The variance of a result over a design, and the parts of its factors.
#[derive(Clone, Debug, PartialEq)]
pub struct VarianceBudget {
    /// Mean.
    pub mean: f64,
    /// Variance, *V*.
    pub variance: f64,
    /// Part of each factor.
    pub parts: Vec<VariancePart>,
}

/// What a factor has of a variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariancePart {
    /// Alone: by how much the variance shrinks, on average, if the factor is known.
    pub first: f64,
    /// With all of its interactions: the variance that is left, on average, if all others are
    /// known.
    pub total: f64,
    /// With an equal share of each of its interactions.
    pub shared: f64,
}

impl Factorial {
    /// Every level of each factor with every level of the others.
    ///
    /// * `counts`: for each factor how often each of its levels counts, once or more; the last
    ///   factor varies fastest
    ///
    /// # Panics
    /// If a factor has no levels, or a level that does not count.
    #[must_use]
    pub fn new(counts: Vec<Vec<u32>>) -> Self {
        let is_whole = |levels: &Vec<u32>| !levels.is_empty() && levels.iter().all(|it| *it > 0);
        assert!(counts.iter().all(is_whole), "a factor has levels, and all of them count");
        Self { counts }
    }

    /// How many cases there are.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.counts.iter().map(Vec::len).product()
    }

    /// The level of each factor in a case.
    #[must_use]
    pub fn levels(&self, case: usize) -> Vec<usize> {
        let strides = (0..self.counts.len()).map(|factor| self.stride(factor));
        strides.zip(&self.counts).map(|(stride, levels)| case / stride % levels.len()).collect()
    }

    /// How far apart the cases are of which only this factor's level differs.
    fn stride(&self, factor: usize) -> usize {
        self.counts[factor + 1..].iter().map(Vec::len).product()
    }

    /// The share of a level among those of its factor [-].
    #[must_use]
    pub fn share(&self, factor: usize, level: usize) -> f64 {
        let all: u32 = self.counts[factor].iter().sum();
        f64::from(self.counts[factor][level]) / f64::from(all)
    }

    /// How often a case counts.
    fn count(&self, case: usize) -> f64 {
        let levels = self.levels(case).into_iter().zip(&self.counts);
        levels.map(|(level, counts)| f64::from(counts[level])).product()
    }

    /// The outputs of all cases, each as often as it counts.
    pub fn repeated<'a>(&'a self, outputs: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        outputs.iter().enumerate().flat_map(|(case, output)| {
            let levels = self.levels(case).into_iter().zip(&self.counts);
            let count: usize = levels.map(|(level, counts)| counts[level] as usize).product();
            repeat_n(*output, count)
        })
    }

    /// The mean output.
    #[must_use]
    pub fn mean(&self, outputs: &[f64]) -> f64 {
        let mut sum = Sum::default();
        outputs.iter().enumerate().for_each(|(case, output)| sum.add(self.count(case), *output));
        sum.mean()
    }

    /// The mean output at each level of a factor, E[Y | X_i].
    #[must_use]
    pub fn means(&self, factor: usize, outputs: &[f64]) -> Vec<f64> {
        let mut sums = vec![Sum::default(); self.counts[factor].len()];
        for (case, output) in outputs.iter().enumerate() {
            sums[self.levels(case)[factor]].add(self.count(case), *output);
        }
        sums.iter().map(Sum::mean).collect()
    }

    /// The share of the cases in which something holds, with its 95 % confidence interval: that of
    /// independent trials (Wilson), as many as tell as much as these samples, of which each of one
    /// factor meets each of the other and repeats what they have in common:
    ///
    /// ```text
    /// n = n_1 n_2/(1 + (n_2 − 1) V_1/V + (n_1 − 1) V_2/V)          (Kish's effective number)
    /// ```
    ///
    /// Levels of the other factors are all there, and nothing of them is sampled. Where it holds in
    /// all cases or none, n is n_1. Without samples the share is exact.
    ///
    /// * `holds`: in each case
    /// * `sampled`: the two factors whose levels are samples
    #[must_use]
    pub fn share_of(&self, holds: &[bool], sampled: [usize; 2]) -> Estimate {
        let outputs: Vec<f64> = holds.iter().map(|it| f64::from(u8::from(*it))).collect();
        let value = self.mean(&outputs);
        let variance = value * (1.0 - value);
        let [n_1, n_2] = sampled.map(|factor| self.counts[factor].len() as f64);
        let [v_1, v_2] = sampled.map(|factor| self.first(factor, value, &outputs));
        let trials = match variance {
            _ if n_1 * n_2 == 1.0 => f64::INFINITY,
            0.0 => n_1,
            v => n_1 * n_2 / (1.0 + ((n_2 - 1.0) * v_1 + (n_1 - 1.0) * v_2) / v),
        };
        let (low, high) = share_interval(value, trials);
        Estimate { value, low, high }
    }

    /// The variance of the outputs, and the parts of the factors.
    ///
    /// Two sands under three loads: most of what the sinkages differ by is the load's.
    ///
    /// ```
    /// use grouser::studies::ensemble::factorial::Factorial;
    ///
    /// let design = Factorial::new(vec![vec![1, 1], vec![1, 1, 1]]);
    /// let budget = design.budget(&[10.0, 13.0, 15.0, 12.0, 15.0, 18.0]);
    /// let shares = budget.parts.iter().map(|part| part.first / budget.variance);
    /// let shares: Vec<String> = shares.map(|share| format!("{share:.2}")).collect();
    /// assert_eq!(shares, ["0.21", "0.78"]);
    /// assert_eq!(format!("{:.2}", budget.interactions() / budget.variance), "0.01");
    /// ```
    ///
    /// * `outputs`: finite, one for each case
    ///
    /// # Panics
    /// If there is not one output for each case.
    #[must_use]
    pub fn budget(&self, outputs: &[f64]) -> VarianceBudget {
        assert_eq!(outputs.len(), self.cases(), "an output for each case");
        let mean = self.mean(outputs);
        let squares: Vec<f64> = outputs.iter().map(|output| (output - mean).powi(2)).collect();
        let shared = self.shared(mean, outputs);
        let part = |factor: usize| VariancePart {
            first: self.first(factor, mean, outputs),
            total: self.total(factor, outputs),
            shared: shared[factor],
        };
        VarianceBudget {
            mean,
            variance: self.mean(&squares),
            parts: (0..self.counts.len()).map(part).collect(),
        }
    }

    /// Var(E[Y | X_i]).
    fn first(&self, factor: usize, mean: f64, outputs: &[f64]) -> f64 {
        let means = self.means(factor, outputs).into_iter().enumerate();
        means.map(|(level, it)| self.share(factor, level) * (it - mean).powi(2)).sum()
    }

    /// Σ V_S/|S| over the sets S of factors that have a factor in them, where V_S is what they have
    /// together and no set within S has: for each factor.
    fn shared(&self, mean: f64, outputs: &[f64]) -> Vec<f64> {
        let factors = self.counts.len();
        let mut together: Vec<f64> =
            (0..1_usize << factors).map(|set| self.closed(set, mean, outputs)).collect();
        // From what a set has with all sets within it to what it has alone (Möbius).
        for factor in 0..factors {
            for set in (0..together.len()).filter(|set| set >> factor & 1 == 1) {
                together[set] -= together[set ^ (1 << factor)];
            }
        }
        let of_factor = |factor: usize| {
            let sets = (0..together.len()).filter(|set| set >> factor & 1 == 1);
            sets.map(|set| together[set] / f64::from(set.count_ones())).sum()
        };
        (0..factors).map(of_factor).collect()
    }

    /// Var(E[Y | X_A]) of a set A of factors.
    ///
    /// * `set`: its bits
    fn closed(&self, set: usize, mean: f64, outputs: &[f64]) -> f64 {
        let is_in = |factor: usize| set >> factor & 1 == 1;
        let place = |case: usize| {
            let levels = self.levels(case).into_iter().enumerate().zip(&self.counts);
            levels.fold(
                0,
                |place, ((factor, level), counts)| {
                    if is_in(factor) { place * counts.len() + level } else { place }
                },
            )
        };
        let inside = self.counts.iter().enumerate().filter(|(factor, _)| is_in(*factor));
        let mut sums = vec![Sum::default(); inside.map(|(_, counts)| counts.len()).product()];
        for (case, output) in outputs.iter().enumerate() {
            sums[place(case)].add(self.count(case), *output);
        }
        let mut variance = Sum::default();
        for sum in &sums {
            variance.add(sum.count, (sum.mean() - mean).powi(2));
        }
        variance.mean()
    }

    /// E[Var(Y | all others)].
    fn total(&self, factor: usize, outputs: &[f64]) -> f64 {
        let (stride, count) = (self.stride(factor), self.counts[factor].len());
        let firsts = (0..outputs.len()).filter(|case| case / stride % count == 0);
        let mut sum = Sum::default();
        for first in firsts {
            let of_level = |level: usize| outputs[first + level * stride];
            let mean: f64 = (0..count).map(|it| self.share(factor, it) * of_level(it)).sum();
            let square = |it: usize| self.share(factor, it) * (of_level(it) - mean).powi(2);
            let others = self.count(first) / f64::from(self.counts[factor][0]);
            sum.add(others, (0..count).map(square).sum());
        }
        sum.mean()
    }
}

/// A sum of values that count a number of times.
#[derive(Clone, Copy, Default)]
struct Sum {
    count: f64,
    sum: f64,
}

impl Sum {
    fn add(&mut self, count: f64, value: f64) {
        self.count += count;
        self.sum += count * value;
    }

    fn mean(&self) -> f64 {
        self.sum / self.count
    }
}

impl VarianceBudget {
    /// What no factor has alone.
    #[must_use]
    pub fn interactions(&self) -> f64 {
        let alone: f64 = self.parts.iter().map(|part| part.first).sum();
        // Below zero by round-off only.
        (self.variance - alone).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Outputs without any order in them.
    fn outputs(count: usize) -> Vec<f64> {
        (0..count).map(|case| ((case * 7919) % 101) as f64 / 101.0).collect()
    }

    fn design() -> Factorial {
        Factorial::new(vec![vec![1, 1, 1], vec![8, 1, 1], vec![1], vec![2, 3], vec![1; 5]])
    }

    fn variance(values: &[f64]) -> f64 {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count
    }

    #[test]
    fn parts_add_up_to_the_whole() {
        let design = design();
        let outputs = outputs(design.cases());
        let budget = design.budget(&outputs);
        let repeated: Vec<f64> = design.repeated(&outputs).collect();
        assert_eq!(repeated.len(), 3 * 10 * 5 * 5);
        assert!((budget.variance - variance(&repeated)).abs() < 1e-14);
        let parts: f64 = budget.parts.iter().map(|part| part.first).sum();
        assert!((parts + budget.interactions() - budget.variance).abs() < 1e-14);
        assert!(budget.interactions() > 0.1 * budget.variance);
        let nothing = budget.parts[2];
        assert!(nothing.first < 1e-30 && nothing.total < 1e-30 && nothing.shared.abs() < 1e-15);
        for part in &budget.parts {
            assert!(part.first <= part.shared + 1e-15 && part.shared <= part.total + 1e-15);
            assert!(part.total <= budget.variance);
        }
        let shared: f64 = budget.parts.iter().map(|part| part.shared).sum();
        assert!((shared - budget.variance).abs() < 1e-14);
    }

    #[test]
    fn a_known_factor_takes_its_part_away() {
        let design = design();
        let outputs = outputs(design.cases());
        let budget = design.budget(&outputs);
        for factor in 0..design.counts.len() {
            let mut left = 0.0;
            for level in 0..design.counts[factor].len() {
                let mut counts = design.counts.clone();
                counts[factor] = vec![1];
                let known = Factorial::new(counts);
                let kept = (0..outputs.len()).filter(|case| design.levels(*case)[factor] == level);
                let kept: Vec<f64> = kept.map(|case| outputs[case]).collect();
                left += design.share(factor, level) * known.budget(&kept).variance;
            }
            assert!(
                (budget.variance - left - budget.parts[factor].first).abs() < 1e-14,
                "{factor}"
            );
        }
    }

    /// Closed form: a sum of functions of one factor each has no interactions, and a product of two
    /// with mean zero nothing else.
    #[test]
    fn sums_do_not_interact_and_products_do_nothing_else() {
        let design = Factorial::new(vec![vec![1, 1], vec![1, 2, 1]]);
        let value = |levels: &[usize], f: fn(f64, f64) -> f64| {
            f(levels[0] as f64 * 2.0 - 1.0, levels[1] as f64 - 1.0)
        };
        let of = |f: fn(f64, f64) -> f64| {
            let outputs: Vec<f64> =
                (0..design.cases()).map(|case| value(&design.levels(case), f)).collect();
            design.budget(&outputs)
        };
        let sum = of(|x, y| x + y);
        assert!((sum.parts[0].first - 1.0).abs() < 1e-15 && sum.interactions() < 1e-15);
        assert!((sum.parts[1].first - 0.5).abs() < 1e-15);
        let VariancePart { first, total, shared } = sum.parts[1];
        assert!((first - total).abs() < 1e-15 && (first - shared).abs() < 1e-15);
        let product = of(|x, y| x * y);
        assert!(product.parts.iter().all(|part| part.first < 1e-15));
        assert!((product.interactions() - 0.5).abs() < 1e-15);
        assert!((product.parts[0].total - 0.5).abs() < 1e-15);
        assert!(product.parts.iter().all(|part| (part.shared - 0.25).abs() < 1e-15));
    }
}
