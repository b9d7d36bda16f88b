//! The worst place of each leg: of all verdicts along it the worst, and of several places with that
//! the one that is most often a no-go.
//!
//! No verdict gets better as the same course becomes steeper. So a leg is judged at its steepest place
//! of each course, where courses that are nearest to the same [sampled one](SAMPLED_COURSES) are one: a
//! gentle place on a bad course is not hidden by a steep one on a good course. A place need not be
//! judged if somewhere steeper its course has a verdict that is no worse than the leg's so far.

use super::costs::{SAMPLED_COURSES, nearest_course};
use super::hazard::{Danger, Hazard};
use super::turns::Turn;
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::mobility::{advised_place, class_of};
use crate::studies::verdict::{Advice, SlopeStudy, SpotTurns, Verdict};
use crate::units::Vec2;

/// A place of a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegPlace {
    /// Slope [rad].
    pub slope: f64,
    /// Course from the contour, positive uphill [rad].
    pub course: f64,
    /// Where the piece that it is begins and ends, as length on the map from the start of the way
    /// [m].
    pub along: [f64; 2],
    /// Where it begins [m].
    pub place: Vec2,
    /// Share of the samples in which it is a no-go [-].
    pub probability_no_go: f64,
}

/// The steepest place of each course of a leg.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LegPlaces([Option<LegPlace>; SAMPLED_COURSES]);

/// A leg with the verdict on its worst place, or on the turn on the spot before it, if that is
/// worse.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedLeg {
    /// What to do there: with the slope up to the whole degree, and the course to one.
    pub advice: Advice,
    /// The place.
    pub place: LegPlace,
}

impl LegPlaces {
    /// Adds a place: of each course the one of the steepest class of slopes stays, of several the one
    /// that is most often a no-go, and of those the first.
    pub(super) fn add(&mut self, place: LegPlace) {
        let rank = |it: &LegPlace| (class_of(it.slope), it.probability_no_go);
        let known = &mut self.0[nearest_course(place.course)];
        if known.as_ref().is_none_or(|known| rank(&place) > rank(known)) {
            *known = Some(place);
        }
    }

    /// Those that are most often a no-go first, and of several the steepest.
    fn worst_first(&self) -> Vec<LegPlace> {
        let mut all: Vec<LegPlace> = self.0.iter().copied().flatten().collect();
        all.sort_by(|one, other| {
            let by_share = other.probability_no_go.total_cmp(&one.probability_no_go);
            by_share.then(other.slope.total_cmp(&one.slope))
        });
        all
    }
}

impl JudgedLeg {
    /// A leg with the verdict on the turn before it.
    fn of_turn(turn: &Turn, spot_turns: &SpotTurns) -> Option<Self> {
        let advice = spot_turns.advice(&turn.moments())?;
        let (slope, course) = (advice.slope, advice.course);
        let probability_no_go = advice.probability_stuck().unwrap_or(1.0);
        let along = [turn.along; 2];
        let place = LegPlace { slope, course, along, place: turn.place, probability_no_go };
        Some(Self { advice, place })
    }

    /// Its verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.advice.judgement.verdict
    }

    /// What is not safe about it: a verdict of no-go.
    #[must_use]
    pub fn hazard(&self) -> Option<Hazard> {
        let LegPlace { along, place, .. } = self.place;
        let of = if self.advice.is_of_turn() { Danger::TurnVerdict } else { Danger::Verdict };
        let danger = of(self.advice.judgement);
        (self.verdict() == Verdict::NoGo).then_some(Hazard { danger, along, place, worst: None })
    }
}

/// What to do on each leg, at its worst place; `None` of one whose places are not known, and of one
/// without any. `None` altogether if `go_on` was false before the end.
///
/// # Errors
/// The same as [`SlopeStudy::advice`].
pub(super) fn judged(
    legs: &[Option<LegPlaces>],
    turns: &[Turn],
    (study, samples): (&SlopeStudy, &[Sample]),
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<Option<JudgedLeg>>>, ParameterError> {
    let mut judge = Judge { study, samples, go_on, known: Vec::new() };
    let spot_turns = SpotTurns::of(study, samples);
    let leg = |(place, places): (usize, &Option<LegPlaces>)| match places {
        Some(places) => {
            let before = turns.iter().filter(|turn| turn.leg == place + 1);
            let turned = before.filter_map(|turn| JudgedLeg::of_turn(turn, &spot_turns));
            let found = judge.worst(places)?.into_iter().chain(turned);
            Ok(found.reduce(|worst, it| if it.verdict() > worst.verdict() { it } else { worst }))
        }
        None => Ok(None),
    };
    match legs.iter().enumerate().map(leg).collect() {
        Ok(legs) => Ok(Some(legs)),
        Err(Halt::Stopped) => Ok(None),
        Err(Halt::Invalid(error)) => Err(error),
    }
}

/// Why legs are not judged to the end.
enum Halt {
    Stopped,
    Invalid(ParameterError),
}

/// Judges places, each once.
struct Judge<'a> {
    study: &'a SlopeStudy,
    samples: &'a [Sample],
    go_on: &'a (dyn Fn() -> bool + Sync),
    known: Vec<Advice>,
}

impl Judge<'_> {
    /// The worst place of a leg, if it has any.
    fn worst(&mut self, places: &LegPlaces) -> Result<Option<JudgedLeg>, Halt> {
        let mut worst: Option<JudgedLeg> = None;
        for place in places.worst_first() {
            let at_most = self.at_most(&place);
            if worst.as_ref().is_some_and(|worst| at_most <= worst.verdict()) {
                continue;
            }
            let found = JudgedLeg { advice: self.advice(&place)?, place };
            if worst.as_ref().is_none_or(|worst| found.verdict() > worst.verdict()) {
                worst = Some(found);
            }
        }
        Ok(worst)
    }

    /// The worst that the verdict on a place can be: that of a place as steep or steeper, on the
    /// same course.
    fn at_most(&self, place: &LegPlace) -> Verdict {
        let (slope, course) = advised_place((place.slope, place.course));
        let is_no_better =
            |it: &&Advice| it.slope >= slope && nearest_course(it.course) == nearest_course(course);
        let found = self.known.iter().filter(is_no_better).map(|it| it.judgement.verdict);
        found.min().unwrap_or(Verdict::NoGo)
    }

    fn advice(&mut self, place: &LegPlace) -> Result<Advice, Halt> {
        let (slope, course) = advised_place((place.slope, place.course));
        if let Some(known) = self.known.iter().find(|it| (it.slope, it.course) == (slope, course)) {
            return Ok(known.clone());
        }
        let found = self.study.advice(course, &[slope], self.samples, self.go_on);
        let found = found.map_err(Halt::Invalid)?.ok_or(Halt::Stopped)?;
        self.known.extend(found.iter().cloned());
        found.into_iter().next().ok_or(Halt::Stopped)
    }
}
