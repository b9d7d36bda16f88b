//! A watch over what becomes of a rover under way.

use super::outcome::{Outcome, StuckBecause};
use super::scenario::Scenario;
use crate::stored::stored;
use crate::vehicle::RoverState;
use crate::vehicle::kinematics::{rolling_velocity, wheel_velocity};

/// Time between two looks at what becomes of the rover [s]: however rarely samples are recorded, a
/// finding is found. Source: ours, a tenth of [`CERTAIN_AFTER`].
pub const WATCH_PERIOD: f64 = 0.1;
/// A finding about the motion must hold for this long [s], so that a jolt does not count. Source:
/// ours.
pub const CERTAIN_AFTER: f64 = 1.0;
/// Mean slip above which the wheels only dig [-]. Source: ours; Opportunity was given up for
/// stuck at 0.9955 on 32°.
pub const SPINNING_SLIP: f64 = 0.99;
/// Progress of the hubs over the rims' below which a rover is stuck [-]. Source: ours, as above.
pub const LEAST_PROGRESS: f64 = 0.01;
/// Sliding of a rover whose wheels stand still starts here [m/s]. Source: ours; a parked rover
/// creeps a thousand times slower.
pub const SLIDING_SPEED: f64 = 1e-3;

/// Since when each condition has held [s].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    spinning: Option<f64>,
    without_progress: Option<f64>,
    stalled: Option<f64>,
    sliding: Option<f64>,
}

stored!(struct Watch { spinning, without_progress, stalled, sliding });

/// How wheels turn.
#[derive(Clone, Copy)]
pub(super) struct Wheels<'a> {
    /// Slip ratio of each [-].
    pub(super) slip_ratios: &'a [f64],
    /// Rim speed of each, *ω r_s* [m/s].
    pub(super) rim_speeds: &'a [f64],
    /// What its motor is set to [m/s].
    pub(super) set: &'a [f64],
}

impl Watch {
    /// Looks at a rover; says what became of it once that is certain.
    pub(super) fn look(
        &mut self,
        scenario: &Scenario,
        time: f64,
        state: &RoverState,
        Wheels { slip_ratios, rim_speeds, set }: Wheels<'_>,
    ) -> Option<Outcome> {
        let rim_sum: f64 = rim_speeds.iter().map(|speed| speed.abs()).sum();
        let fastest_rim = rim_speeds.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let rolled = rolling_velocity(scenario.rover.mounts(), rim_speeds);
        let (lie, _) = scenario.ground_under(state);
        let slid = lie
            .downhill_of_body(state.yaw)
            .map_or(0.0, |downhill| state.velocity.dot(&downhill) - rolled.dot(&downhill).max(0.0));
        let sliding = slid > fastest_rim.max(SLIDING_SPEED);

        let turning = rim_speeds.iter().zip(slip_ratios).filter(|(rim, _)| **rim != 0.0);
        let (slip_sum, count) = turning.fold((0.0, 0), |(sum, count), (rim, slip_ratio)| {
            (sum + rim.signum() * slip_ratio, count + 1)
        });
        let mean_slip = slip_sum / f64::from(count.max(1));
        let along_rims: f64 = rim_speeds
            .iter()
            .zip(scenario.rover.mounts())
            .filter(|(rim, _)| **rim != 0.0)
            .map(|(rim, mount)| rim.signum() * wheel_velocity(state, mount).x)
            .sum();
        let turns = rim_sum > 0.0;
        let set_sum: f64 = set.iter().map(|speed| speed.abs()).sum();
        let as_set: f64 = set.iter().zip(rim_speeds).map(|(set, rim)| set.signum() * rim).sum();

        let certain = |since: &mut Option<f64>, holds: bool| {
            *since = if holds { since.or(Some(time)) } else { None };
            since.is_some_and(|since| time - since >= CERTAIN_AFTER)
        };
        let slides = certain(&mut self.sliding, sliding);
        let spins = certain(&mut self.spinning, turns && mean_slip > SPINNING_SLIP);
        let stands =
            certain(&mut self.without_progress, turns && along_rims < LEAST_PROGRESS * rim_sum);
        let stalls = certain(&mut self.stalled, set_sum > 0.0 && as_set < LEAST_PROGRESS * set_sum);
        if slides {
            Some(Outcome::Sliding { time })
        } else if stalls {
            Some(Outcome::Immobilised { time, because: StuckBecause::MotorsStall })
        } else if spins {
            Some(Outcome::Immobilised { time, because: StuckBecause::WheelsSpin })
        } else if stands {
            Some(Outcome::Immobilised { time, because: StuckBecause::NoProgress })
        } else {
            None
        }
    }
}
