//! Progress of a calibration: bars, notes, and its state on disk.

use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};

use grouser::document::calibration::{self, fit_notes};
use grouser::studies::calibration::{
    CalibrationError, Fit, Observer, PosteriorState, Sampling, Work,
};
use indicatif::ProgressBar;

use super::checkpoint::Checkpoint;
use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::output;

/// Follows a calibration.
pub(super) struct Progress<'a> {
    checkpoint: Option<&'a Checkpoint>,
    bar: Mutex<Option<ProgressBar>>,
    /// Why it was broken off, if it was.
    failure: Mutex<Option<Failure>>,
}

impl<'a> Progress<'a> {
    pub(super) fn new(checkpoint: Option<&'a Checkpoint>) -> Self {
        Self { checkpoint, bar: Mutex::default(), failure: Mutex::default() }
    }

    /// The failure to report: the one that stopped the work, or the error itself.
    pub(super) fn failure(&self, error: CalibrationError) -> Failure {
        let broken_off = self.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        broken_off.unwrap_or_else(|| error.into())
    }

    fn bar(&self) -> MutexGuard<'_, Option<ProgressBar>> {
        self.bar.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Observer for Progress<'_> {
    fn begins(&self, work: Work) {
        let counted = |length, what: &'static str| output::progress_bar(length).with_message(what);
        *self.bar() = Some(match work {
            Work::Searches(starts) => counted(starts as u64, "least squares from several starts"),
            Work::Blocks { done, all } => {
                counted(all, "blocks of the posterior").with_position(done)
            }
            Work::LeavingOut => output::waiting_line("fits without one slip angle"),
        });
    }

    fn searched(&self) -> ControlFlow<()> {
        if let Some(bar) = &*self.bar() {
            bar.inc(1);
        }
        ControlFlow::Continue(())
    }

    fn fitted(&self, fit: &Fit) {
        output::notes(fit_notes(fit));
    }

    fn walked(&self, state: &PosteriorState) -> ControlFlow<()> {
        if let Some(bar) = &*self.bar() {
            bar.set_position(state.blocks);
        }
        match self.checkpoint.map(|it| it.write(state)) {
            Some(Err(error)) => {
                *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                ControlFlow::Break(())
            }
            _ => ControlFlow::Continue(()),
        }
    }

    fn ends(&self) {
        if let Some(bar) = self.bar().take() {
            bar.finish_and_clear();
        }
    }
}

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Interrupted
            | CalibrationError::NoStart { .. }
            | CalibrationError::ForeignState { .. } => Self::Run(error.to_string()),
            CalibrationError::OneSlipAngle => {
                let text = "--cross-validate leaves out each slip angle in turn, and all trials \
                            are at one";
                Self::Usage(text.to_owned())
            }
            CalibrationError::LeavingOut { .. } => {
                Self::Usage(format!("--cross-validate: {error}"))
            }
            _ => Self::Usage(error.to_string()),
        }
    }
}

/// The posterior's sampling of the flags; none if least squares will do.
pub(super) fn sampling(args: &CalibrateArgs, checkpoint: Option<&Checkpoint>) -> Option<Sampling> {
    let kept = checkpoint.and_then(Checkpoint::kept);
    (!args.point_fit).then(|| calibration::sampling(args.seed, args.steps, kept))
}
