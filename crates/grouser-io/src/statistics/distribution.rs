//! Probability distributions of uncertain values.

use std::ops::RangeInclusive;

use nalgebra::DMatrix;

use crate::statistics::normal::{normal_score, normal_share};
use crate::statistics::random::{self, place_below};
use grouser_core::elementary::exp;
use grouser_core::elementary::wide::{ln, ln_1p};

/// The distribution of one value, in the value's own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marginal {
    /// x = m + d z.
    Normal {
        /// Mean, *m*.
        mean: f64,
        /// Standard deviation, *d*.
        standard_deviation: f64,
    },
    /// x = m e^(σz − σ²/2) with σ² = ln(1 + d²/m²): positive, with mean m and deviation d.
    Lognormal {
        /// Mean, *m*; above 0.
        mean: f64,
        /// Standard deviation, *d*.
        standard_deviation: f64,
    },
    /// x = a + (b − a) Φ(z): every value between two is as likely as the others.
    Uniform {
        /// Lower end, *a*.
        low: f64,
        /// Upper end, *b*.
        high: f64,
    },
    /// A density that rises linearly from a to c and falls linearly to b.
    ///
    /// ```text
    /// x = a + √[Φ(z) (b − a)(c − a)]        up to c
    /// x = b − √[Φ(−z) (b − a)(b − c)]       beyond
    /// ```
    Triangular {
        /// Lower end, *a*.
        low: f64,
        /// The most likely value, *c*.
        mode: f64,
        /// Upper end, *b*.
        high: f64,
    },
}

impl Marginal {
    /// The value at a standard normal score, *z* [-]; it grows with the score.
    #[must_use]
    pub fn at(&self, score: f64) -> f64 {
        let z = score;
        match *self {
            Self::Normal { mean: m, standard_deviation: d } => m + d * z,
            Self::Lognormal { mean: m, standard_deviation: d } => {
                let variance = ln_1p((d / m).powi(2));
                m * exp(variance.sqrt() * z - variance / 2.0)
            }
            Self::Uniform { low: a, high: b } => a + (b - a) * normal_share(z),
            Self::Triangular { low: a, mode: c, high: b } => {
                let share = normal_share(z);
                if share * (b - a) < c - a {
                    a + (share * (b - a) * (c - a)).sqrt()
                } else {
                    b - (normal_share(-z) * (b - a) * (b - c)).sqrt()
                }
            }
        }
    }

    /// Its median: as many samples below as above.
    #[must_use]
    pub fn median(&self) -> f64 {
        self.at(0.0)
    }

    /// The share of samples below a value, *F(x)* [-], where samples differ.
    fn share_below(&self, value: f64) -> f64 {
        let x = value;
        match *self {
            Self::Normal { mean, standard_deviation } => {
                normal_share((x - mean) / standard_deviation)
            }
            Self::Lognormal { mean, standard_deviation } => {
                let variance = ln_1p((standard_deviation / mean).powi(2));
                // The logarithm of what is not positive is below that of all that is.
                let log = if x > 0.0 { ln(x / mean) } else { f64::NEG_INFINITY };
                normal_share((log + variance / 2.0) / variance.sqrt())
            }
            Self::Uniform { low: a, high: b } => ((x - a) / (b - a)).clamp(0.0, 1.0),
            Self::Triangular { low: a, mode: c, high: b } => {
                if x <= a {
                    0.0
                } else if x < c {
                    (x - a).powi(2) / ((b - a) * (c - a))
                } else if x < b {
                    1.0 - (b - x).powi(2) / ((b - a) * (b - c))
                } else {
                    1.0
                }
            }
        }
    }

    /// The share of samples within a range [-].
    #[must_use]
    pub fn share_within(&self, range: &RangeInclusive<f64>) -> f64 {
        if self.is_certain() {
            return if range.contains(&self.at(0.0)) { 1.0 } else { 0.0 };
        }
        self.share_below(*range.end()) - self.share_below(*range.start())
    }

    /// Whether it has one value alone.
    fn is_certain(&self) -> bool {
        match *self {
            Self::Normal { standard_deviation, .. }
            | Self::Lognormal { standard_deviation, .. } => standard_deviation == 0.0,
            Self::Uniform { low, high } | Self::Triangular { low, high, .. } => low == high,
        }
    }
}

/// A distribution truncated at the ends of a range, and renormalised inside.
///
/// ```text
/// x = F⁻¹{F(low) + Φ(z) [F(high) − F(low)]}
/// ```
///
/// A cut by formula instead of by drawing again keeps a designed set of points what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    marginal: Marginal,
    /// The ends of the range.
    range: (f64, f64),
    /// The shares of samples below the range and above it [-].
    outside: (f64, f64),
}

impl Cut {
    /// A distribution as it is.
    fn nowhere(marginal: Marginal) -> Self {
        Self { marginal, range: (f64::NEG_INFINITY, f64::INFINITY), outside: (0.0, 0.0) }
    }

    fn at_ends(marginal: Marginal, range: &RangeInclusive<f64>) -> Self {
        // One value alone is inside, also where it is an end.
        if marginal.is_certain() {
            return Self::nowhere(marginal);
        }
        let (low, high) = (*range.start(), *range.end());
        let outside = (marginal.share_below(low), 1.0 - marginal.share_below(high));
        Self { marginal, range: (low, high), outside }
    }

    fn at(&self, score: f64) -> f64 {
        let (below, above) = self.outside;
        let inside = 1.0 - below - above;
        let cut = if below == 0.0 && above == 0.0 {
            score
        } else if score < 0.0 {
            normal_score(below + normal_share(score) * inside)
        } else {
            // From the other end, where small shares are exact.
            -normal_score(above + normal_share(-score) * inside)
        };
        // Round-off may lead just beside an end.
        self.marginal.at(cut).clamp(self.range.0, self.range.1)
    }
}

/// Correlation of the normal scores of two values, *ρ* [-]: of normal values themselves, of
/// lognormal ones' logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// The places of the two values.
    pub between: [usize; 2],
    /// Its size, above −1 and below 1.
    pub value: f64,
}

/// Contradictory correlations: their matrix is not positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no values can have these correlations together: their matrix is not positive definite")]
pub struct Contradiction;

/// A distribution over several values: parts that are independent of each other, whose values
/// follow each other.
///
/// It keeps within the ranges of its values in one of two ways. A single sample is
/// [drawn](Self::draw) again while it is refused, which truncates all values together. For points
/// of the unit cube, which a design spread as it wants them, each value's distribution is cut by
/// formula ([`within`](Self::within)).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distribution {
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
enum Part {
    /// Values with normal scores L z, where L Lᵀ is their matrix of correlations.
    Scores { marginals: Vec<Cut>, factor: DMatrix<f64> },
    /// One of several rows of values.
    Samples {
        rows: Vec<Vec<f64>>,
        /// The share of the rows up to each of them [-]; empty where each is as likely as the
        /// others.
        ends: Vec<f64>,
    },
}

/// No sample was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{tries} tries of sample {index} gave nothing that can be used")]
pub struct NothingAccepted {
    /// The sample's number.
    pub index: u64,
    /// The number of tries.
    pub tries: u32,
}

/// Tries for one sample. A distribution of which less than one in a hundred samples can be used is
/// far from the one that was written down; then 1000 tries succeed in all but 4e-5 of the samples.
const MOST_TRIES: u32 = 1000;

impl Distribution {
    /// Values with given marginals and correlations; pairs that are not named are uncorrelated.
    ///
    /// # Errors
    /// [`Contradiction`] if the correlations contradict each other.
    ///
    /// # Panics
    /// If a correlation is between places that no value has.
    pub fn of_marginals(
        marginals: Vec<Marginal>,
        correlations: &[Correlation],
    ) -> Result<Self, Contradiction> {
        /// Squares of a factor's diagonal below this are round-off [-].
        const SINGULAR: f64 = 1e-12;
        let mut matrix = DMatrix::identity(marginals.len(), marginals.len());
        for Correlation { between: [one, other], value } in correlations {
            matrix[(*one, *other)] = *value;
            matrix[(*other, *one)] = *value;
        }
        let factor = matrix.cholesky().ok_or(Contradiction)?.unpack();
        if factor.diagonal().iter().any(|pivot| pivot * pivot <= SINGULAR) {
            return Err(Contradiction);
        }
        let marginals = marginals.into_iter().map(Cut::nowhere).collect();
        Ok(Self { parts: vec![Part::Scores { marginals, factor }] })
    }

    /// The same, each value's distribution cut off at the ends of its range. (Correlations are of
    /// the scores, and stay what they are; samples are not cut.)
    ///
    /// * `ranges`: one for each value; each with some share of its value's samples inside
    #[must_use]
    pub fn within(mut self, mut ranges: &[RangeInclusive<f64>]) -> Self {
        for part in &mut self.parts {
            let (own, others) = ranges.split_at(part.width());
            if let Part::Scores { marginals, .. } = part {
                for (cut, range) in marginals.iter_mut().zip(own) {
                    *cut = Cut::at_ends(cut.marginal, range);
                }
            }
            ranges = others;
        }
        self
    }

    /// The values of this distribution, and after them those of another that is independent of it.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.parts.extend(other.parts);
        self
    }

    /// Rows of samples, such as those of a posterior; each sample of the distribution is one of
    /// them, independent of the others.
    ///
    /// # Panics
    /// If there are none.
    #[must_use]
    pub fn of_samples(rows: Vec<Vec<f64>>) -> Self {
        assert!(!rows.is_empty(), "a distribution needs samples");
        Self { parts: vec![Part::Samples { rows, ends: Vec::new() }] }
    }

    /// The same of rows that count by weights, of which only the ratios count.
    ///
    /// * `rows`: each with its weight, which is 0 or more
    ///
    /// # Panics
    /// If there are none.
    #[must_use]
    pub fn of_weighted_samples(rows: Vec<(Vec<f64>, f64)>) -> Self {
        assert!(!rows.is_empty(), "a distribution needs samples");
        let sum: f64 = rows.iter().map(|(_, weight)| weight).sum();
        let mut end = 0.0;
        let ends = rows.iter().map(|(_, weight)| {
            end += weight / sum;
            end
        });
        let ends = ends.collect();
        let rows = rows.into_iter().map(|(row, _)| row).collect();
        Self { parts: vec![Part::Samples { rows, ends }] }
    }

    /// The values of this distribution without its rows of samples.
    #[must_use]
    pub fn without_samples(mut self) -> Self {
        self.parts.retain(|part| !matches!(part, Part::Samples { .. }));
        self
    }

    /// Sample number `index`: the result of `accept` for the first values that it accepts. Refused
    /// values are sampled again, so that the distribution is truncated to the accepted values.
    ///
    /// # Errors
    /// [`NothingAccepted`] if it refuses a thousand in a row.
    pub fn draw<T>(
        &self,
        seed: u64,
        index: u64,
        mut accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<T, NothingAccepted> {
        self.draw_with_point(seed, index, |values| accept(values)).map(|(_, accepted)| accepted)
    }

    /// The same, with the point of the unit cube at which the values are.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw).
    pub fn draw_with_point<T>(
        &self,
        seed: u64,
        index: u64,
        accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<(Vec<f64>, T), NothingAccepted> {
        self.draw_near(seed, index, |point| point, accept)
    }

    /// The same with samples in the order of their rows: sample *i* has row *i*, and from the last
    /// on again the first. Refused values keep their row.
    ///
    /// # Errors
    /// The same as [`draw`](Self::draw).
    pub(crate) fn draw_in_order<T>(
        &self,
        seed: u64,
        index: u64,
        accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<(Vec<f64>, T), NothingAccepted> {
        let count = self.sample_rows().map_or(1, <[_]>::len);
        let place = ((index % count as u64) as f64 + 0.5) / count as f64;
        let in_order = |mut point: Vec<f64>| {
            // Rows of samples come last.
            if let (Some(last), Some(_)) = (point.last_mut(), self.sample_rows()) {
                *last = place;
            }
            point
        };
        self.draw_near(seed, index, in_order, accept)
    }

    /// Draws at points that are moved.
    fn draw_near<T>(
        &self,
        seed: u64,
        index: u64,
        moved: impl Fn(Vec<f64>) -> Vec<f64>,
        mut accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<(Vec<f64>, T), NothingAccepted> {
        let mut random = random::generator(seed, index);
        let mut draw = || {
            let point = (0..self.dimensions()).map(|_| random::uniform(&mut random)).collect();
            let point = moved(point);
            accept(&self.at(&point)).map(|accepted| (point, accepted))
        };
        let drawn = (0..MOST_TRIES).find_map(|_| draw());
        drawn.ok_or(NothingAccepted { index, tries: MOST_TRIES })
    }

    /// The rows of samples among its parts, which come last; none if it has no such part.
    pub(crate) fn sample_rows(&self) -> Option<&[Vec<f64>]> {
        match self.parts.last() {
            Some(Part::Samples { rows, .. }) => Some(rows),
            _ => None,
        }
    }

    /// The number of uniform numbers of a sample: one for each marginal, and one for rows of
    /// samples.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.parts.iter().map(Part::dimensions).sum()
    }

    /// The values at a point of the unit cube: uniform points give samples of the distribution.
    ///
    /// * `point`: a number above 0 and below 1 for each of the [`dimensions`](Self::dimensions)
    #[must_use]
    pub fn at(&self, mut point: &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.parts.iter().map(Part::width).sum());
        for part in &self.parts {
            let (own, others) = point.split_at(part.dimensions());
            part.add(own, &mut values);
            point = others;
        }
        values
    }
}

impl Part {
    fn dimensions(&self) -> usize {
        match self {
            Self::Scores { marginals, .. } => marginals.len(),
            Self::Samples { .. } => 1,
        }
    }

    /// How many values it has.
    fn width(&self) -> usize {
        match self {
            Self::Scores { marginals, .. } => marginals.len(),
            Self::Samples { rows, .. } => rows[0].len(),
        }
    }

    /// Adds its values at a point.
    fn add(&self, point: &[f64], values: &mut Vec<f64>) {
        match self {
            Self::Samples { rows, ends } if ends.is_empty() => {
                values.extend(&rows[place_below(point[0] * rows.len() as f64, rows.len())]);
            }
            Self::Samples { rows, ends } => {
                // Round-off may leave the last end just below 1.
                let row = ends.partition_point(|end| *end <= point[0]).min(rows.len() - 1);
                values.extend(&rows[row]);
            }
            Self::Scores { marginals, factor } => {
                let independent: Vec<f64> = point.iter().map(|u| normal_score(*u)).collect();
                let scores = (0..marginals.len()).map(|row| {
                    (0..=row).map(|column| factor[(row, column)] * independent[column]).sum()
                });
                values.extend(marginals.iter().zip(scores).map(|(cut, score)| cut.at(score)));
            }
        }
    }
}
