//! Turns on the spot along a way: which of the samples get stuck in them.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::{Arc, Mutex, PoisonError};

use super::end::End;
use super::hazard::Danger;
use crate::elementary::wide::atan2;
use crate::studies::ensemble::samples::Sample;
use crate::studies::mobility::{advised_place, class_of, slope_and_course};
use crate::studies::verdict::{SlopeStudy, SpotTurn};
use crate::units::Vec2;

/// A turn is looked at where the nose is at a multiple of this off the contour [rad]: at the ones
/// nearest to its start and its end, and at all between.
const YAW_STEP: f64 = FRAC_PI_4;
/// How many of these there are all around.
const YAWS: i32 = 8;

/// A turn on the spot of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// Before this leg, counted from 1.
    pub(super) leg: usize,
    /// Length on the map from the start of the way [m].
    pub(super) along: f64,
    /// The place [m].
    pub(super) place: Vec2,
    /// How steeply the ground rises there to the east and to the north [m/m].
    pub(super) gradient: Vec2,
    /// Where the nose points before it, from the map's x axis to the left [rad].
    pub(super) from: f64,
    /// By how much it turns [rad], positive to the left.
    pub(super) angle: f64,
}

/// Which samples get stuck in a turn: by class of slope, yaw in steps, and whether to the left.
type Known = BTreeMap<(usize, i32, bool), Arc<[bool]>>;

/// Turns on the spot of all samples. What was computed is kept, by all copies.
#[derive(Clone, Debug)]
pub(super) struct SpotTurns {
    study: SlopeStudy,
    samples: Vec<Sample>,
    known: Arc<Mutex<Known>>,
}

impl SpotTurns {
    /// * `samples`: with none there is the soil as written
    pub(super) fn of(study: &SlopeStudy, samples: &[Sample]) -> Self {
        let as_written = [study.nominal()];
        let samples = if samples.is_empty() { &as_written } else { samples };
        Self { study: study.clone(), samples: samples.to_vec(), known: Arc::default() }
    }

    /// Where each sample ends that gets stuck in a turn of a way, at the first that it does.
    pub(super) fn ends(&self, turns: &[Turn]) -> Vec<Option<End>> {
        let mut ends: Vec<Option<End>> = vec![None; self.samples.len()];
        for turn in turns {
            let Turn { leg, along, place, .. } = *turn;
            let end = End { leg, along, place, danger: Some(Danger::NoTurn) };
            for stuck in moments(turn).map(|it| self.stuck(it)) {
                ends.iter_mut().zip(&*stuck).filter(|it| *it.1).for_each(|(known, _)| {
                    known.get_or_insert(end);
                });
            }
        }
        ends
    }

    fn stuck(&self, (slope, step, is_left): (f64, i32, bool)) -> Arc<[bool]> {
        let key = (class_of(slope), step, is_left);
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(stuck) = known().get(&key) {
            return Arc::clone(stuck);
        }
        let turn = SpotTurn { slope, yaw: YAW_STEP * f64::from(step), is_left };
        let stuck: Arc<[bool]> = self.study.stuck_on_the_spot(&turn, &self.samples).into();
        known().insert(key, Arc::clone(&stuck));
        stuck
    }
}

/// The moments at which a turn is looked at: slope up to the whole degree [rad], yaw in steps, and
/// whether it is to the left. On level ground all are one.
fn moments(turn: &Turn) -> impl Iterator<Item = (f64, i32, bool)> {
    let Turn { gradient, from, angle, .. } = *turn;
    let (slope, _) = advised_place(slope_and_course(gradient.norm(), 0.0));
    let contour = atan2(gradient.y, gradient.x) - FRAC_PI_2;
    #[expect(clippy::cast_possible_truncation, reason = "a few turns of the nose")]
    let step = |yaw: f64| ((yaw - contour) / YAW_STEP).round() as i32;
    let (one, other) = (step(from), step(from + angle));
    let steps = if slope > 0.0 { one.min(other)..=one.max(other) } else { 0..=0 };
    steps.map(move |step| (slope, step.rem_euclid(YAWS), angle > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    /// On a slope of 4.2° that rises to the north, from east to north.
    #[test]
    fn a_turn_is_looked_at_every_eighth_of_a_circle() {
        let gradient = Vec2::new(0.0, deg(4.2).tan());
        let turn = |gradient, from: f64, angle: f64| {
            let place = Vec2::zeros();
            Turn { leg: 1, along: 0.0, place, gradient, from: deg(from), angle: deg(angle) }
        };
        let of = |turn: Turn| moments(&turn).map(|it| (it.1, it.2)).collect::<Vec<_>>();
        let left = turn(gradient, 0.0, 90.0);
        assert!(moments(&left).all(|(slope, _, _)| (slope - deg(5.0)).abs() < 1e-12));
        assert_eq!(of(left), [(0, true), (1, true), (2, true)]);
        assert_eq!(of(turn(gradient, 10.0, -60.0)), [(7, false), (0, false)]);
        assert_eq!(of(turn(Vec2::zeros(), 70.0, -60.0)), [(0, false)]);
    }
}
