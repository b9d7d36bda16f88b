//! Turns on the spot: the two sides of the rover against each other.

use super::SlopeStudy;
use crate::simulation::{MOST_SLIP, SteadyMotion};
use crate::studies::ensemble::samples::{Sample, outputs_of_places};
use crate::vehicle::Rover;

/// A moment of a turn on the spot, on an even slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct SpotTurn {
    /// Slope, *α* [rad].
    pub(in super::super) slope: f64,
    /// Yaw, *γ* [rad], from the contour with uphill to its left, positive uphill.
    pub(in super::super) yaw: f64,
    /// Whether the nose turns to the left.
    pub(in super::super) is_left: bool,
}

impl SpotTurn {
    /// The sense of the yaw rate: 1 to the left, -1 to the right.
    fn sense(&self) -> f64 {
        if self.is_left { 1.0 } else { -1.0 }
    }

    /// The rims' speeds [m/s] of a turn on the spot to the left; wheels on the middle line stand.
    ///
    /// * `rim_speed`: of the outer ones [m/s]
    pub(in super::super) fn rim_speeds(rover: &Rover, rim_speed: f64) -> Vec<f64> {
        let side = |y: f64| if y == 0.0 { 0.0 } else { -y.signum() };
        rover.mounts().iter().map(|mount| rim_speed * side(mount.position.y)).collect()
    }
}

impl SlopeStudy {
    /// Which of the samples get stuck in a turn on the spot, as the operator's card counts them.
    pub(in super::super) fn stuck_on_the_spot(
        &self,
        turn: &SpotTurn,
        samples: &[Sample],
    ) -> Vec<bool> {
        let rims = SpotTurn::rim_speeds(&self.heading.rover, turn.sense() * self.rim_speed);
        let is_stuck = |place: usize| {
            let study = self.heading.of_sample(&samples[place]);
            let motion = study.steady_motion_of(turn.slope, turn.yaw, &rims);
            motion.map_or(true, |it| moving_slip(&it, &rims, turn.sense()).is_none())
        };
        outputs_of_places(samples, &|| true, is_stuck).unwrap_or_default()
    }
}

/// Mean slip ratio of the wheels that are driven, positive where rims outrun the rover, either way
/// [-]; `None` for a rover that is stuck: its wheels all but spin, or it does not turn as it is to.
///
/// * `rim_speeds`: [m/s]
/// * `sense`: that of the yaw rate, positive to the left; 0 where the rover is not to turn
pub(in super::super) fn moving_slip(
    motion: &SteadyMotion,
    rim_speeds: &[f64],
    sense: f64,
) -> Option<f64> {
    let driven = motion.wheels.iter().zip(rim_speeds).filter(|(_, rim)| **rim != 0.0);
    let (sum, count) = driven.fold((0.0, 0), |(sum, count), (wheel, rim)| {
        (sum + rim.signum() * wheel.slip.ratio, count + 1)
    });
    let slip_ratio = sum / f64::from(count.max(1));
    let turns = sense == 0.0 || sense * motion.yaw_rate > 0.0;
    (slip_ratio.abs() <= MOST_SLIP && turns).then_some(slip_ratio)
}
