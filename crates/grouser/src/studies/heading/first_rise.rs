//! The lowest slip at which the thrust comes to suffice, by looks over all slips.

use crate::vehicle::ReactionError;

/// Slip between two looks at the thrust [-]. Source: ours, because pulls rise and fall over tenths
/// of slip.
const LOOK: f64 = 0.04;
/// Slip of the last look, in drive and in skid [-], and which look that is.
pub(super) const LAST: f64 = 0.999;
const LAST_LOOK: u32 = 25;

/// A slip [-], and what is left over of the thrust there, over the weight [-].
pub(super) type Looked = (f64, f64);

/// Why no slip balances the thrust.
pub(super) enum NoBalance {
    /// At any slip the thrust lacks this much or more, over the weight [-].
    Lacks(f64),
    /// At any slip the rover is pushed on: its wheels do not brake enough.
    Pushed,
    /// At no slip do the wheels settle.
    Fault(ReactionError),
}

/// The lowest slip around which the thrust comes to suffice, as two slips with what is left over
/// there, over the weight.
///
/// * `left_over`: of the thrust at a slip, over the weight [-]
pub(super) fn first_rise(
    left_over: &dyn Fn(f64) -> Result<f64, ReactionError>,
) -> Result<[Looked; 2], NoBalance> {
    // Wheels that no sinkage carries move nothing.
    const NOTHING: f64 = -1.0;
    let (mut best, mut fault) = (f64::NEG_INFINITY, None);
    let mut look = |slip: f64| match left_over(slip) {
        Ok(thrust) => {
            best = best.max(thrust);
            (slip, thrust)
        }
        Err(error) => {
            fault.get_or_insert(error);
            (slip, NOTHING)
        }
    };
    let slip_of = |place: u32| (LOOK * f64::from(place)).min(LAST);
    let mut here = look(0.0);
    if here.1 >= 0.0 {
        for place in 1..=LAST_LOOK {
            let lower = look(-slip_of(place));
            if lower.1 < 0.0 {
                return Ok([lower, here]);
            }
            here = lower;
        }
        return Err(NoBalance::Pushed);
    }
    for place in 1..=LAST_LOOK {
        let higher = look(slip_of(place));
        if higher.1 >= 0.0 {
            return Ok([here, higher]);
        }
        here = higher;
    }
    Err(match fault {
        Some(error) if best == f64::NEG_INFINITY => NoBalance::Fault(error),
        _ => NoBalance::Lacks(-best),
    })
}
