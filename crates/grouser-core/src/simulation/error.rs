//! Why a run could not be computed.

use crate::error::ParameterError;
use crate::units::Vec2;
use crate::vehicle::ReactionError;

/// Why a run could not be computed. (What a rover does is an [`Outcome`](super::Outcome), not an
/// error.)
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
    /// The rover does not stand on its wheels alone where it starts.
    #[error(
        "where the rover starts its underside touches the ground at x = {x:.3} m, y = {y:.3} m, by \
         {depth:.3} m: let it start elsewhere, or with a larger `belly_clearance_m`",
        x = place.x,
        y = place.y
    )]
    HighCentred {
        /// Where, in the ground's coordinates [m].
        place: Vec2,
        /// How far the underside is below the ground there [m].
        depth: f64,
    },
    /// At its start no loads of the wheels balance the rover.
    #[error(
        "where the rover starts no wheel loads balance it: what wheels that turn so pull and brake \
         takes the load from wheel to wheel, of {wheel} most; wheels that turn against each other \
         are the usual reason: let it start from rest, or with other wheel speeds"
    )]
    UnbalancedStart {
        /// Name of the wheel whose load moves most.
        wheel: String,
    },
    /// The motion takes more and more evaluations for less and less time.
    #[error(
        "the run cannot be computed beyond {time:.3} s, at x = {x:.3} m, y = {y:.3} m: {reason}; \
         ground or wheel speeds that change too fast for the rover's size are the usual reason",
        x = place.x,
        y = place.y
    )]
    Endless {
        /// When the rover was last looked at [s].
        time: f64,
        /// Where it was, in the ground's coordinates [m].
        place: Vec2,
        /// How much was computed in vain.
        reason: String,
    },
    /// The integrator could not go on.
    #[error(
        "the run cannot be computed beyond {time:.3} s: no time step is short enough for the \
         motion there ({reason}); a locked or suddenly braked wheel is the usual reason, another \
         speed or a rolling start may avoid it"
    )]
    Stalled {
        /// When [s].
        time: f64,
        /// Message of the integrator.
        reason: String,
    },
}
