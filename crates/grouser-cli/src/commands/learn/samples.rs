//! Samples of what was learnt.

use grouser::studies::learn::{Learner, LearntSample};

use crate::args::LearnArgs;
use crate::failure::Failure;

/// Samples of what is believed.
pub(super) fn samples(args: &LearnArgs, learner: &Learner) -> Result<Vec<LearntSample>, Failure> {
    learner.samples(args.seed, args.samples).map_err(|error| reaches_too_far(&error))
}

/// What is believed cannot be drawn from.
pub(super) fn reaches_too_far(error: &dyn std::error::Error) -> Failure {
    Failure::Usage(format!("the soil's uncertainty reaches too far: {error}"))
}
