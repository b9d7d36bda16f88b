//! Turns on the spot along a way: which of the samples make them.

use std::f64::consts::FRAC_PI_2;

use super::end::End;
use super::hazard::Danger;
use crate::elementary::wide::atan2;
use crate::studies::mobility::{advised_place, slope_and_course};
use crate::studies::verdict::{Holding, SpotTurn, SpotTurns};
use crate::units::Vec2;

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

/// Where each sample ends in a turn of a way: at the first that it gets stuck in, or for which that is
/// not known.
///
/// * `samples`: how many there are
pub(super) fn ends_in_turns(
    spot_turns: &SpotTurns,
    turns: &[Turn],
    samples: usize,
) -> Vec<Option<End>> {
    let ends_in = |turn: &Turn| {
        let Turn { leg, along, place, .. } = *turn;
        let end = move |held| match held {
            Holding::At { .. } => None,
            Holding::Not => Some(End { leg, along, place, danger: Some(Danger::NoTurn) }),
            Holding::Unknown => Some(End { leg, along, place, danger: None }),
        };
        spot_turns.turned(&turn.moments()).into_iter().map(end).collect::<Vec<_>>()
    };
    turns.iter().map(ends_in).fold(vec![None; samples], |known, ends| {
        known.into_iter().zip(ends).map(|(known, end)| known.or(end)).collect()
    })
}

impl Turn {
    /// The moments at which it is looked at, on a slope up to the whole degree.
    pub(super) fn moments(&self) -> Vec<SpotTurn> {
        let Self { gradient, from, angle, .. } = *self;
        let (slope, _) = advised_place(slope_and_course(gradient.norm(), 0.0));
        let contour = atan2(gradient.y, gradient.x) - FRAC_PI_2;
        SpotTurn::moments(slope, from - contour, angle)
    }
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
        let of = |turn: Turn| {
            let all = turn.moments().into_iter();
            all.map(|it| (it.yaw.to_degrees().round(), it.is_left)).collect::<Vec<_>>()
        };
        let left = turn(gradient, 0.0, 90.0);
        assert!(left.moments().iter().all(|it| (it.slope - deg(5.0)).abs() < 1e-12));
        assert_eq!(of(left), [(0.0, true), (45.0, true), (90.0, true)]);
        assert_eq!(of(turn(gradient, 10.0, -60.0)), [(315.0, false), (0.0, false)]);
        assert_eq!(of(turn(Vec2::zeros(), 70.0, -60.0)), [(0.0, false)]);
        assert_eq!(of(turn(gradient, 0.0, 720.0)).len(), 8);
    }
}
