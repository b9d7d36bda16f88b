//! Why a run could not be computed.

use crate::error::ParameterError;
use crate::vehicle::ReactionError;

/// Why a run could not be computed. (What a rover does is an [`Outcome`](super::Outcome), not an error.)
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The scenario is no run.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The soil's reaction could not be found.
    #[error("at {time:.3} s: {source}")]
    Reaction {
        /// When [s].
        time: f64,
        /// What is wrong.
        source: ReactionError,
    },
    /// The integrator could not go on.
    #[error(
        "the run cannot be computed beyond {time:.3} s: no time step is short enough for the motion \
         there ({reason}); a locked or suddenly braked wheel is the usual reason, another speed \
         or a rolling start may avoid it"
    )]
    Stalled {
        /// When [s].
        time: f64,
        /// Message of the integrator.
        reason: String,
    },
}
