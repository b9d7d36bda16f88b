//! A calibration from its search to what is known: least squares, samples, and what the data leave
//! open.

use std::ops::ControlFlow;

use super::diagnostics::{Samples, Summary};
use super::identifiability::Identifiability;
use super::{Advanced, Calibration, CalibrationError, Channel, Fit};
use super::{FitSettings, PosteriorState, SamplerSettings};

/// The first half of the steps still knows where the walkers started [-].
const DISCARDED: f64 = 0.5;

/// Chains agree well enough below this R-hat [-]. Source: Gelman and others, Bayesian Data
/// Analysis, 3rd ed., section 11.5, ask for 1.1; Vehtari and others (2021) for 1.01.
pub const GOOD_R_HAT: f64 = 1.05;

/// Who follows a calibration, from any thread, and may break it off.
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

/// What a calibration does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Least squares from so many starts.
    Searches(usize),
    /// Samples of the posterior, in blocks.
    Blocks {
        /// How many were walked before.
        done: u64,
        /// How many there will be.
        all: u64,
    },
    /// Fits without some of the measurements.
    LeavingOut,
}

/// How a posterior is sampled, and where from.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// How.
    pub settings: SamplerSettings,
    /// The state of an earlier run that was stopped; without it, walkers start around the fit.
    pub kept: Option<PosteriorState>,
}

/// What a calibration found.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The channels of observations, each with its discrepancy.
    pub channels: Vec<Channel>,
    /// Least squares.
    pub fit: Fit,
    /// Standard deviations of its values, to first order.
    pub deviations: Vec<f64>,
    /// All that agrees with the data; none if it was not sampled.
    pub posterior: Option<Posterior>,
    /// What the data cannot tell apart.
    pub identifiability: Identifiability,
}

/// A sampled posterior. Its coordinates are those of the parameters, then those of the discrepancies.
#[derive(Clone, Debug)]
pub struct Posterior {
    /// The samples that count.
    pub samples: Samples,
    /// What is known of each value.
    pub summaries: Vec<Summary>,
    /// How it was sampled.
    pub settings: SamplerSettings,
    /// Walkers of each ensemble.
    pub walkers: usize,
    /// Share of the proposed moves that were made [-].
    pub acceptance: f64,
}

impl Posterior {
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
    /// As [`fit`](Self::fit).
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

    /// Samples around a fit, if that is wanted, and what the data leave open.
    ///
    /// # Errors
    /// [`CalibrationError::Interrupted`] if the observer broke off,
    /// [`CalibrationError::ForeignState`] if a kept state belongs to another problem.
    pub fn solve(
        &self,
        fit: Fit,
        sampling: Option<Sampling>,
        observer: &dyn Observer,
    ) -> Result<Solution, CalibrationError> {
        let sampled = sampling.map(|sampling| self.sample(&fit, sampling, observer));
        let posterior = sampled.transpose()?;
        let identifiability = match &posterior {
            Some(posterior) => Identifiability::of_samples(self, &posterior.samples),
            None => Identifiability::of_fit(self, &fit),
        };
        let deviations = fit.deviations(self.space());
        let channels = self.experiment().channels().to_vec();
        Ok(Solution { channels, fit, deviations, posterior, identifiability })
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
        })
    }
}
