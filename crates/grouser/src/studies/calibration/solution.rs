//! A calibration in its steps: least squares, posterior samples, and the parameters that the data
//! do not determine.

use std::ops::ControlFlow;

use nalgebra::DMatrix;

use super::diagnostics::{Samples, Summary};
use super::identifiability::Identifiability;
use super::{Advanced, Calibration, CalibrationError, Channel, Fit};
use super::{FitSettings, PosteriorState, SamplerSettings};
use crate::soil::Discrepancy;

/// Share of the steps discarded as burn-in [-].
pub(super) const DISCARDED: f64 = 0.5;

/// Chains agree well enough below this R-hat [-]. Source: Gelman and others, Bayesian Data
/// Analysis, 3rd ed., section 11.5, ask for 1.1; Vehtari and others (2021) for 1.01.
pub const GOOD_R_HAT: f64 = 1.05;

/// Follows the progress of a calibration, from any thread, and can stop it.
pub trait Observer: Sync {
    /// Some work begins.
    fn begins(&self, _work: Work) {}

    /// A search has ended.
    fn searched(&self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The searches have ended, with a fit.
    fn fitted(&self, _fit: &Fit) {}

    /// A block of the posterior was walked; the state can be kept, to go on from it later.
    fn walked(&self, _state: &PosteriorState) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The work is done.
    fn ends(&self) {}
}

/// A stage of a calibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Least squares from a number of starts.
    Searches(usize),
    /// Samples of the posterior, in blocks.
    Blocks {
        /// Blocks walked before.
        done: u64,
        /// All blocks.
        all: u64,
    },
    /// Fits without some of the measurements.
    LeavingOut,
}

/// Settings of the sampler, and the state that it continues.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// The settings.
    pub settings: SamplerSettings,
    /// The state of an earlier run that was stopped; without it, walkers start around the fit.
    pub kept: Option<PosteriorState>,
}

/// The result of a calibration.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The channels of observations, each with its discrepancy.
    pub channels: Vec<Channel>,
    /// Least squares.
    pub fit: Fit,
    /// Standard deviations of its values, to first order.
    pub deviations: Vec<f64>,
    /// The posterior; missing without sampling.
    pub posterior: Option<Posterior>,
    /// Parameters and combinations that the data do not determine.
    pub identifiability: Identifiability,
    /// The most likely point near the fit, and the covariance there; missing with sampling.
    pub(super) mode: Option<(Vec<f64>, DMatrix<f64>)>,
}

/// A sampled posterior. Its coordinates are those of the parameters, then those of the
/// discrepancies.
#[derive(Clone, Debug)]
pub struct Posterior {
    /// The samples after burn-in.
    pub samples: Samples,
    /// The summary of each value.
    pub summaries: Vec<Summary>,
    /// The settings of the sampler.
    pub settings: SamplerSettings,
    /// Walkers of each ensemble.
    pub walkers: usize,
    /// Share of the proposed moves that were made [-].
    pub acceptance: f64,
    /// What the model gets wrong, for each row that is [`kept`](Self::kept); none where the
    /// experiment has no wheel.
    pub discrepancies: Vec<Discrepancy>,
}

/// Samples that are handed on to predictions.
const KEPT: usize = 1000;

impl Posterior {
    /// The rows that are handed on to predictions.
    #[must_use]
    pub fn kept(&self) -> Vec<&[f64]> {
        self.samples.thinned(KEPT)
    }

    /// The largest R-hat of all values [-].
    #[must_use]
    pub fn worst_r_hat(&self) -> f64 {
        self.summaries.iter().map(|it| it.r_hat).fold(1.0, f64::max)
    }

    /// The smallest effective sample size of all values [-].
    #[must_use]
    pub fn least_effective_samples(&self) -> f64 {
        self.summaries.iter().map(|it| it.effective_samples).fold(f64::INFINITY, f64::min)
    }
}

impl Calibration<'_> {
    /// [`fit`](Self::fit), with an observer of all work.
    ///
    /// # Errors
    /// The same as [`fit`](Self::fit).
    pub fn search(
        &self,
        settings: &FitSettings,
        observer: &dyn Observer,
    ) -> Result<Fit, CalibrationError> {
        observer.begins(Work::Searches(settings.starts));
        let fit = self.fit(settings, &|| observer.searched())?;
        observer.ends();
        observer.fitted(&fit);
        Ok(fit)
    }

    /// Samples the posterior around a fit, if asked to, and finds the parameters that the data do
    /// not determine.
    ///
    /// # Errors
    /// [`CalibrationError::Interrupted`] if the observer stopped it,
    /// [`CalibrationError::ForeignState`] if a kept state belongs to another problem.
    pub fn solve(
        &self,
        fit: Fit,
        sampling: Option<Sampling>,
        observer: &dyn Observer,
    ) -> Result<Solution, CalibrationError> {
        let sampled = sampling.map(|sampling| self.sample(&fit, sampling, observer));
        let posterior = sampled.transpose()?;
        let (identifiability, mode) = if let Some(posterior) = &posterior {
            (Identifiability::of_samples(self, &posterior.samples), None)
        } else {
            let (mode, covariance) = self.mode_near(&fit);
            (Identifiability::of_mode(&mode, &covariance), Some((mode, covariance)))
        };
        let deviations = fit.deviations(self.space());
        let channels = self.experiment().channels().to_vec();
        Ok(Solution { channels, fit, deviations, posterior, identifiability, mode })
    }

    fn sample(
        &self,
        fit: &Fit,
        Sampling { settings, kept }: Sampling,
        observer: &dyn Observer,
    ) -> Result<Posterior, CalibrationError> {
        let mut state = kept.unwrap_or_else(|| self.start_posterior(fit, &settings));
        observer.begins(Work::Blocks { done: state.blocks, all: settings.blocks });
        let walked = self.advance(&mut state, &settings, &mut |state| observer.walked(state))?;
        if walked == Advanced::Stopped {
            return Err(CalibrationError::Interrupted);
        }
        observer.ends();
        let samples = Samples::of(self, &state, DISCARDED);
        Ok(Posterior {
            summaries: samples.summaries(),
            samples,
            walkers: settings.walkers_for(self.dimension()),
            settings,
            acceptance: state.acceptance(),
            discrepancies: Vec::new(),
        })
    }
}
