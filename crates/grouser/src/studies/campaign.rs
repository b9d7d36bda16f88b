//! Campaigns: many runs over what is not known exactly, and what they say together.
//!
//! A [`Plan`] tells the inputs of each run: a [`design::Design`] spreads points over the unit cube, and
//! [`Distribution`]s make values of them. Run *i* depends on the plan and on *i* alone, so that it can
//! be repeated on its own, on any machine. [`summary`] has quantiles and probabilities with their
//! confidence intervals, [`sensitivity`] says which input an output's variance comes from, and
//! [`drive`] what is kept of a traverse.
//!
//! What the inputs stand for, and what is run with them, is not known here.

pub mod design;
pub mod drive;
mod permutation;
pub mod sensitivity;
pub mod summary;

use self::design::{Design, Sampling};
use super::uncertainty::Distribution;

/// The inputs of a campaign's runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    design: Design,
    /// Independent of each other; their values follow each other in a run's inputs.
    distributions: Vec<Distribution>,
    sensitivity: bool,
}

/// The inputs of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The values of all distributions, one after another.
    pub values: Vec<f64>,
    /// Its place in a design for sensitivities, if it is one.
    pub place: Option<Place>,
}

/// A run's place among those that tell sensitivities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The point, below N.
    pub point: u64,
    /// The matrix whose row it is.
    pub matrix: Matrix,
}

/// The matrices of Saltelli's design (2010): two independent sets of points, A and B, and for each
/// dimension *i* the set A with that one dimension of B.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matrix {
    /// A.
    A,
    /// B.
    B,
    /// A with dimension *i* of B.
    Exchanged(usize),
}

impl Plan {
    /// A plan of `points` runs or, for sensitivities, of that many points with the runs of all
    /// [matrices](Matrix) each.
    ///
    /// * `distributions`: independent of each other
    #[must_use]
    pub fn new(
        sampling: Sampling,
        points: u64,
        seed: u64,
        distributions: Vec<Distribution>,
        sensitivity: bool,
    ) -> Self {
        let inputs: usize = distributions.iter().map(Distribution::dimensions).sum();
        let dimensions = if sensitivity { 2 * inputs } else { inputs };
        let design = Design { sampling, points, dimensions, seed };
        Self { design, distributions, sensitivity }
    }

    /// The points of the unit cube that it is made of.
    #[must_use]
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// How many dimensions the inputs have: a value is one, rows of samples together are one.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.distributions.iter().map(Distribution::dimensions).sum()
    }

    /// Runs at each point: one, or A, B and one for each dimension.
    #[must_use]
    pub fn runs_per_point(&self) -> u64 {
        if self.sensitivity { self.dimensions() as u64 + 2 } else { 1 }
    }

    /// Whether the runs are laid out so that they tell sensitivities.
    #[must_use]
    pub fn is_for_sensitivity(&self) -> bool {
        self.sensitivity
    }

    /// Whether a run is one of the independent samples: all are, but for those of a design for sensitivities
    /// that are A with one input exchanged.
    #[must_use]
    pub fn is_sample(&self, run: u64) -> bool {
        !self.sensitivity || matches!(self.place(run).matrix, Matrix::A | Matrix::B)
    }

    /// How many runs there are.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.design.points.saturating_mul(self.runs_per_point())
    }

    /// The inputs of run number `index`. The runs of a point follow each other.
    #[must_use]
    pub fn inputs(&self, index: u64) -> Inputs {
        if !self.sensitivity {
            let values = self.values(&self.design.point(index));
            return Inputs { values, place: None };
        }
        let place = self.place(index);
        let both = self.design.point(place.point);
        let (a, b) = both.split_at(self.dimensions());
        let values = match place.matrix {
            Matrix::A => self.values(a),
            Matrix::B => self.values(b),
            Matrix::Exchanged(dimension) => {
                let mut point = a.to_vec();
                point[dimension] = b[dimension];
                self.values(&point)
            }
        };
        Inputs { values, place: Some(place) }
    }

    fn place(&self, index: u64) -> Place {
        let (point, which) = (index / self.runs_per_point(), index % self.runs_per_point());
        let matrix = match which {
            0 => Matrix::A,
            1 => Matrix::B,
            // Below the number of dimensions.
            other => Matrix::Exchanged(usize::try_from(other - 2).unwrap_or(usize::MAX)),
        };
        Place { point, matrix }
    }

    fn values(&self, point: &[f64]) -> Vec<f64> {
        let mut values =
            Vec::with_capacity(self.distributions.iter().map(Distribution::width).sum());
        let mut rest = point;
        for distribution in &self.distributions {
            let (own, others) = rest.split_at(distribution.dimensions());
            values.extend(distribution.at(own));
            rest = others;
        }
        values
    }
}
