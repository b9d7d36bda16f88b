//! Proposes the next runs: those that reduce the uncertainty of a prediction most.
//!
//! Posterior samples give the covariance of a prediction and the outcome of a future run; without
//! them the Fisher information of the fit does, by derivatives at the settled sinkages. Taking that
//! as linear and normal, an outcome y with noise N shrinks the prediction's variance by
//!
//! ```text
//! Σ_ty (Σ_yy + N)⁻¹ Σ_yt
//! ```
//!
//! whatever it turns out to be. Runs are chosen one after the other, each as the best one then.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::diagnostics::covariance_of;
use super::solution::Solution;
use super::wheel_test::WheelTestExperiment;
use super::{Experiment as _, ParameterSpace};
use crate::contact::Slip;
use crate::studies::ensemble::outputs;
use crate::studies::measurement::{PerQuantity, Quantity};

/// A setting of the test stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Load [N].
    pub load: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Slip angle [rad].
    pub slip_angle: f64,
}

/// The prediction of interest: a quantity of the wheel at a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The quantity.
    pub quantity: Quantity,
    /// The setting.
    pub setting: Setting,
}

/// The prediction that the next runs should narrow, and the settings that the stand can run.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// The prediction to narrow.
    pub target: Target,
    /// The settings that the stand can run.
    pub candidates: Vec<Setting>,
    /// How many runs to propose.
    pub count: usize,
}

/// Samples used to propose the next runs.
const DESIGN_SAMPLES: usize = 200;

impl Aim {
    /// The runs to make next, the best first.
    ///
    /// * `space`: of the parameters
    #[must_use]
    pub fn proposals(
        &self,
        space: &ParameterSpace,
        experiment: &WheelTestExperiment,
        solution: &Solution,
    ) -> Vec<Proposal> {
        let noise = noise(experiment, &solution.fit.discrepancies);
        let (target, candidates) = (&self.target, &self.candidates);
        if let Some(posterior) = &solution.posterior {
            let rows = posterior.samples.thinned(DESIGN_SAMPLES);
            let outlook = Outlook::of_wheel_test(experiment, &rows, target, candidates, &noise);
            return outlook.propose(self.count);
        }
        let Some((mode, covariance)) = &solution.mode else { return Vec::new() };
        let by_slopes = self.covariance_by_slopes(space, experiment, mode, covariance, &noise);
        let Some(covariance) = by_slopes else { return Vec::new() };
        let noise: Vec<f64> = measured(&noise).iter().filter_map(|&it| noise[it]).collect();
        propose(covariance, candidates.len(), &noise, self.count)
    }

    /// The covariance of the prediction and of all that candidates would measure, by their
    /// derivatives at the most likely point; nothing where a wheel has none.
    ///
    /// * `mode`, `covariance`: that point, and the covariance there
    fn covariance_by_slopes(
        &self,
        space: &ParameterSpace,
        experiment: &WheelTestExperiment,
        mode: &[f64],
        covariance: &DMatrix<f64>,
        noise: &PerQuantity<Option<f64>>,
    ) -> Option<DMatrix<f64>> {
        let settings: Vec<(Slip, f64)> = std::iter::once(&self.target.setting)
            .chain(&self.candidates)
            .map(|it| (Slip::on_test_stand(it.slip_ratio, it.slip_angle), it.load))
            .collect();
        let values = |coordinates: &[f64]| space.values(coordinates);
        let slopes = experiment.slopes_at(&settings, mode, &values)?;
        let measured = measured(noise);
        let outcomes =
            (1..settings.len()).flat_map(|it| measured.iter().map(move |one| (it, *one)));
        let rows: Vec<(usize, Quantity)> =
            std::iter::once((0, self.target.quantity)).chain(outcomes).collect();
        let jacobian = DMatrix::from_fn(rows.len(), mode.len(), |row, axis| {
            let (setting, quantity) = rows[row];
            slopes[axis][setting][quantity]
        });
        Some(&jacobian * covariance * jacobian.transpose())
    }
}

/// The quantities that a run would measure.
fn measured(noise: &PerQuantity<Option<f64>>) -> Vec<Quantity> {
    Quantity::ALL.into_iter().filter(|&quantity| noise[quantity].is_some()).collect()
}

/// Deviations of a new reading from the model: mean scatter and model discrepancy.
fn noise(experiment: &WheelTestExperiment, discrepancies: &[f64]) -> PerQuantity<Option<f64>> {
    PerQuantity::from_fn(|quantity| {
        let own = experiment.sources().iter().zip(experiment.observations());
        let own = own.filter(|((source, _), _)| *source == quantity);
        let variances: Vec<f64> =
            own.map(|(_, it)| it.scatter.powi(2) + discrepancies[it.channel].powi(2)).collect();
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        (!variances.is_empty()).then(|| mean.sqrt())
    })
}

/// A proposed run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    /// Place of its setting among the candidates.
    pub candidate: usize,
    /// Deviation of the prediction before this run, and after those proposed earlier.
    pub before: f64,
    /// The same after this run, as it is to be expected.
    pub after: f64,
}

/// A prediction and the outcomes of candidate runs, sample by sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// The prediction, sample by sample.
    pub prediction: Vec<f64>,
    /// For each candidate the outcomes that it would measure, each sample by sample.
    pub outcomes: Vec<Vec<Vec<f64>>>,
    /// Deviations of the measured outcomes about the model, √(s² + δ²): the same for each run.
    pub noise: Vec<f64>,
}

impl Outlook {
    /// The outlook for a wheel test.
    ///
    /// * `rows`: samples, each beginning with the values of the experiment's parameters. Samples
    ///   that are no valid soil are left out.
    /// * `noise`: of the quantities that a run would measure; `None` for those that it would not
    #[must_use]
    pub fn of_wheel_test(
        experiment: &WheelTestExperiment,
        rows: &[&[f64]],
        target: &Target,
        candidates: &[Setting],
        noise: &PerQuantity<Option<f64>>,
    ) -> Self {
        let measured = measured(noise);
        let one_sample = |row: &&[f64]| {
            let soil = experiment.soil(row).ok()?;
            let at = |setting: &Setting| {
                let slip = Slip::on_test_stand(setting.slip_ratio, setting.slip_angle);
                experiment.readings(&soil, slip, setting.load)
            };
            let prediction = at(&target.setting)[target.quantity];
            let outcome = |setting: &Setting| {
                let readings = at(setting);
                measured.iter().map(|&quantity| readings[quantity]).collect::<Vec<f64>>()
            };
            Some((prediction, candidates.iter().map(outcome).collect::<Vec<_>>()))
        };
        let samples: Vec<_> = outputs(rows, one_sample).into_iter().flatten().collect();
        let outcomes = (0..candidates.len()).map(|candidate| {
            let column = |k: usize| samples.iter().map(|(_, one)| one[candidate][k]).collect();
            (0..measured.len()).map(column).collect()
        });
        Self {
            outcomes: outcomes.collect(),
            prediction: samples.iter().map(|(prediction, _)| *prediction).collect(),
            noise: measured.iter().filter_map(|&quantity| noise[quantity]).collect(),
        }
    }

    /// The candidates that would shrink the prediction's deviation the most, one after the other.
    /// A run may be proposed again, as a repetition.
    #[must_use]
    pub fn propose(&self, count: usize) -> Vec<Proposal> {
        if self.prediction.len() < 2 {
            return Vec::new();
        }
        propose(self.joint_covariance(), self.outcomes.len(), &self.noise, count)
    }

    /// Covariance of the prediction, first, and of all outcomes, candidate by candidate.
    fn joint_covariance(&self) -> DMatrix<f64> {
        let row = |sample: usize| {
            let outcomes = self.outcomes.iter().flatten().map(|outcome| outcome[sample]);
            std::iter::once(self.prediction[sample]).chain(outcomes).collect::<Vec<f64>>()
        };
        let rows: Vec<Vec<f64>> = (0..self.prediction.len()).map(row).collect();
        covariance_of(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }
}

/// The candidates that would shrink a prediction's deviation the most, one after the other.
///
/// * `covariance`: of the prediction, first, and of all outcomes, candidate by candidate
/// * `noise`: deviations of the measured outcomes
fn propose(
    mut covariance: DMatrix<f64>,
    candidates: usize,
    noise: &[f64],
    count: usize,
) -> Vec<Proposal> {
    let mut proposals = Vec::new();
    if noise.is_empty() {
        return proposals;
    }
    let variances = noise.iter().map(|deviation| deviation * deviation);
    let noise = DMatrix::from_diagonal(&DVector::from_iterator(noise.len(), variances));
    for _ in 0..count {
        let before = covariance[(0, 0)].max(0.0).sqrt();
        let gain = |candidate| gain_of_prediction(&covariance, candidate, &noise);
        let gains: Vec<f64> = (0..candidates).map(gain).collect();
        // The first of equals: `max_by` would take the last.
        let best = (0..gains.len()).rev().max_by(|&i, &j| gains[i].total_cmp(&gains[j]));
        let Some(candidate) = best else { break };
        covariance -= gain_of_all(&covariance, candidate, &noise);
        let after = covariance[(0, 0)].max(0.0).sqrt();
        proposals.push(Proposal { candidate, before, after });
    }
    proposals
}

/// How a run would lower the prediction's variance.
fn gain_of_prediction(covariance: &DMatrix<f64>, candidate: usize, noise: &DMatrix<f64>) -> f64 {
    let each = noise.nrows();
    let with_prediction = covariance.view((0, 1 + candidate * each), (1, each)).into_owned();
    let gain = |factor: Factor| (&with_prediction * factor.solve(&with_prediction.transpose()))[0];
    factor(covariance, candidate, noise).map_or(0.0, gain)
}

/// How a run would lower the joint covariance.
fn gain_of_all(covariance: &DMatrix<f64>, candidate: usize, noise: &DMatrix<f64>) -> DMatrix<f64> {
    let (each, size) = (noise.nrows(), covariance.nrows());
    let with_all = covariance.columns(1 + candidate * each, each).into_owned();
    let gain = |factor: Factor| &with_all * factor.solve(&with_all.transpose());
    factor(covariance, candidate, noise).map_or_else(|| DMatrix::zeros(size, size), gain)
}

type Factor = Cholesky<f64, Dyn>;

/// Returns the Cholesky factor of the covariance of a run's outcomes with their noise; `None` if it
/// cannot be inverted.
fn factor(covariance: &DMatrix<f64>, candidate: usize, noise: &DMatrix<f64>) -> Option<Factor> {
    let (each, first) = (noise.nrows(), 1 + candidate * noise.nrows());
    (covariance.view((first, first), (each, each)) + noise).cholesky()
}

#[cfg(test)]
mod tests {
    use super::super::ensemble::normal_numbers;
    use super::*;

    /// Prediction t ~ N(0, 4). A run that measures t with noise 1 leaves the variance
    /// 1/(1/4 + 1/1) = 0.8; measured again, 1/(1/4 + 2/1) = 4/9. An unrelated run changes nothing.
    #[test]
    fn the_run_that_measures_the_prediction_is_proposed() {
        let numbers = normal_numbers(5, 0, 8000);
        let (ours, theirs) = numbers.split_at(4000);
        let prediction: Vec<f64> = ours.iter().map(|x| 2.0 * x).collect();
        let outcomes = vec![vec![theirs.to_vec()], vec![prediction.clone()]];
        let outlook = Outlook { prediction, outcomes, noise: vec![1.0] };
        let proposals = outlook.propose(2);
        assert_eq!([proposals[0].candidate, proposals[1].candidate], [1, 1]);
        // 4000 samples know their own deviation to 1.1 %.
        for (found, expected) in [
            (proposals[0].before, 2.0),
            (proposals[0].after, 0.8_f64.sqrt()),
            (proposals[1].after, 2.0 / 3.0),
        ] {
            assert!((found / expected - 1.0).abs() < 0.04, "{found} instead of {expected}");
        }
    }

    #[test]
    fn without_candidates_or_samples_nothing_is_proposed() {
        let nothing = Outlook { prediction: vec![], outcomes: vec![], noise: vec![1.0] };
        assert!(nothing.propose(3).is_empty());
        let prediction = vec![1.0, 2.0, 3.0];
        assert!(Outlook { prediction, outcomes: vec![], noise: vec![1.0] }.propose(3).is_empty());
    }
}
