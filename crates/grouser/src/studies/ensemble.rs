//! Monte Carlo: cases whose uncertain inputs are sampled, and the statistics of their results.
//!
//! An [`Ensemble`] has the inputs of each case: a [`design::Design`] spreads points over the unit
//! cube, and a [`Distribution`] makes values of them. Case *i* depends on the seed and on *i*
//! alone, so that it can be repeated on its own, on any machine, whatever other cases there are.
//! [`outputs`] computes many cases. [`statistics`] has bands, quantiles and probabilities with
//! their confidence intervals, and [`sensitivity`] attributes an output's variance to the inputs.
//!
//! [`factorial`] has designs in which named choices meet each other and the samples, and splits a
//! variance into their parts.
//!
//! [`samples`] has what a band is drawn from: a soil that its document leaves open, and one of
//! several wheel–soil [`models`].
//!
//! The meaning of the values, and the computation, are the caller's.

pub mod design;
pub mod factorial;
pub mod model_discrepancy;
pub mod models;
mod permutation;
pub mod samples;
pub mod sensitivity;
pub mod statistics;

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use self::design::Design;
use grouser_io::campaign::Sampling;
pub use grouser_io::statistics::{
    Band, Contradiction, Correlation, Distribution, Marginal, NothingAccepted, Probability,
};

/// Computes many cases, in their order. They are shared among threads, which changes no result.
///
/// * `one`: computes a case
pub fn outputs<C: Send, T: Send>(
    cases: impl IntoParallelIterator<Item = C>,
    one: impl Fn(C) -> T + Sync + Send,
) -> Vec<T> {
    cases.into_par_iter().map(one).collect()
}

/// Computes many cases; nothing if `go_on` was false before the end.
///
/// * `go_on`: asked before each case, from any thread
pub fn outputs_while<C: Send, T: Send>(
    cases: impl IntoParallelIterator<Item = C>,
    go_on: &(dyn Fn() -> bool + Sync),
    one: impl Fn(C) -> T + Sync + Send,
) -> Option<Vec<T>> {
    let stopped = AtomicBool::new(false);
    let unless_stopped = |case| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        if go_on() {
            return Some(one(case));
        }
        stopped.store(true, Ordering::Relaxed);
        None
    };
    outputs(cases, unless_stopped).into_iter().collect()
}

/// Cases with the inputs of each.
///
/// How deep does a wheel sink if its load is known to 2 N and the sand's friction angle to 1.5°,
/// and which of the two matters?
///
/// ```
/// use grouser::contact::{Contact, Ishigami, Slip, settle};
/// use grouser::document::campaign::Sampling;
/// use grouser::document::{self, Overrides, Source};
/// use grouser::soil::Soil;
/// use grouser::studies::ensemble::sensitivity::Sensitivity;
/// use grouser::studies::ensemble::statistics::Summary;
/// use grouser::studies::ensemble::{Distribution, Ensemble, Marginal, outputs};
/// use grouser::units::deg;
///
/// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
/// let (wheel, sand) = (scenario.rover.mounts()[0].unit.wheel, scenario.ground.soil);
/// let load = Marginal::Normal { mean: 17.0, standard_deviation: 2.0 };
/// let friction = Marginal::Normal { mean: deg(38.0), standard_deviation: deg(1.5) };
/// let inputs = Distribution::of_marginals(vec![load, friction], &[])?;
/// let ensemble = Ensemble::new(Sampling::Sobol, 128, 7, inputs, true);
///
/// let sinkages = outputs(0..ensemble.runs(), |run| {
///     let values = ensemble.inputs(run).values;
///     let soil = Soil { friction_angle: values[1], ..sand };
///     let slip = Slip::on_test_stand(0.2, 0.0);
///     let contact = Contact { wheel, soil, slip, gravity: scenario.gravity };
///     settle(&Ishigami::DEFAULT, &contact, values[0]).ok().map(|settled| settled.sinkage)
/// });
/// let summary = Summary::of(&sinkages, &[0.5]).expect("the wheels settle");
/// let sensitivity = Sensitivity::of(&sinkages, 2, 7).expect("the sinkage varies");
/// let (mean, deviation) = (1e3 * summary.mean.value, 1e3 * summary.deviation);
/// assert_eq!(format!("{mean:.1} ± {deviation:.1} mm"), "13.0 ± 0.7 mm");
/// let [load, friction] = [0, 1].map(|input| sensitivity.indices[input].total.value);
/// assert_eq!(format!("load {load:.2}, friction {friction:.2}"), "load 0.99, friction 0.00");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    design: Design,
    distribution: Distribution,
    sensitivity: bool,
}

/// The inputs of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The values of its distribution.
    pub values: Vec<f64>,
    /// Its place in a design for sensitivities, if it is one.
    pub place: Option<Place>,
}

/// A run's place in a design for sensitivities.
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

impl Ensemble {
    /// An ensemble of `points` cases or, for sensitivities, of that many points with the cases of
    /// all [matrices](Matrix) each.
    #[must_use]
    pub fn new(
        sampling: Sampling,
        points: u64,
        seed: u64,
        distribution: Distribution,
        sensitivity: bool,
    ) -> Self {
        let inputs = distribution.dimensions();
        let dimensions = if sensitivity { 2 * inputs } else { inputs };
        let design = Design { sampling, points, dimensions, seed };
        Self { design, distribution, sensitivity }
    }

    /// The points of the unit cube that it is made of.
    #[must_use]
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// How many dimensions the inputs have: a value is one, rows of samples together are one.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.distribution.dimensions()
    }

    /// Runs at each point: one, or A, B and one for each dimension.
    #[must_use]
    pub fn runs_per_point(&self) -> u64 {
        if self.sensitivity { self.dimensions() as u64 + 2 } else { 1 }
    }

    /// Whether the runs are a design for sensitivities.
    #[must_use]
    pub fn is_for_sensitivity(&self) -> bool {
        self.sensitivity
    }

    /// Whether a run is one of the independent samples: all are, except those of a design for
    /// sensitivities that are A with one input exchanged.
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
            let values = self.distribution.at(&self.design.point(index));
            return Inputs { values, place: None };
        }
        let place = self.place(index);
        let both = self.design.point(place.point);
        let (a, b) = both.split_at(self.dimensions());
        let values = match place.matrix {
            Matrix::A => self.distribution.at(a),
            Matrix::B => self.distribution.at(b),
            Matrix::Exchanged(dimension) => {
                let mut point = a.to_vec();
                point[dimension] = b[dimension];
                self.distribution.at(&point)
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
}
