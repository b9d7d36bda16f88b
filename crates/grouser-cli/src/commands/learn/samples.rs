//! Samples of what was learnt.

use grouser::answers::Sampling;
use grouser::studies::learn::{Learner, LearntSample};

use crate::failure::Failure;

/// Samples of what is believed.
pub(super) fn samples(of: Sampling, learner: &Learner) -> Result<Vec<LearntSample>, Failure> {
    learner.samples(of.seed, of.count).map_err(|error| reaches_too_far(&error))
}

/// What is believed cannot be drawn from.
pub(super) fn reaches_too_far(error: &dyn std::error::Error) -> Failure {
    Failure::Usage(format!("the soil's uncertainty reaches too far: {error}"))
}
