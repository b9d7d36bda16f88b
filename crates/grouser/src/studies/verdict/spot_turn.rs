//! Turns on the spot: the two sides of the rover against each other.

use std::f64::consts::FRAC_PI_4;
use std::sync::{Arc, Mutex, PoisonError};

use super::{Advice, Driven, Holding, Judgement, Reason, STUCK_ON_GO, SlopeStudy, Verdict};
use crate::simulation::{MOST_SLIP, SteadyMotion};
use crate::studies::ensemble::Probability;
use crate::studies::ensemble::samples::{Sample, outputs_of_places};
use crate::vehicle::Rover;

/// A turn is looked at where the nose is at a multiple of this off the contour [rad]: at the ones
/// nearest to its start and its end, and at all between.
const YAW_STEP: f64 = FRAC_PI_4;
/// How many of these there are all around.
const YAWS: i32 = 8;

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
    /// The moments at which a turn is looked at. On level ground all are one.
    ///
    /// * `slope`: [rad]
    /// * `from`: where the nose is before it, from the contour with uphill to its left [rad]
    /// * `angle`: by how much it turns [rad], positive to the left
    pub(in super::super) fn moments(slope: f64, from: f64, angle: f64) -> Vec<Self> {
        #[expect(clippy::cast_possible_truncation, reason = "a few turns of the nose")]
        let step = |yaw: f64| (yaw / YAW_STEP).round() as i32;
        let (one, other) = (step(from), step(from + angle));
        // Once around is all there is to see.
        let last = one.max(other).min(one.min(other) + YAWS - 1);
        let steps = if slope > 0.0 { one.min(other)..=last } else { 0..=0 };
        let yaw = |step: i32| YAW_STEP * f64::from(step.rem_euclid(YAWS));
        steps.map(|step| Self { slope, yaw: yaw(step), is_left: angle > 0.0 }).collect()
    }

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

/// Turns on the spot of all samples. What was computed of a moment is kept, by all copies.
#[derive(Clone, Debug)]
pub(in super::super) struct SpotTurns {
    study: SlopeStudy,
    samples: Vec<Sample>,
    known: Arc<Mutex<KnownTurns>>,
}

/// Moments, each with what becomes of every sample in it.
type KnownTurns = Vec<(SpotTurn, Vec<Holding>)>;

impl SpotTurns {
    /// * `samples`: with none there is the soil as written
    pub(in super::super) fn of(study: &SlopeStudy, samples: &[Sample]) -> Self {
        let as_written = [study.nominal()];
        let samples = if samples.is_empty() { &as_written } else { samples };
        Self { study: study.clone(), samples: samples.to_vec(), known: Arc::default() }
    }

    /// Which of the samples make a turn, each by its worst moment.
    ///
    /// * `moments`: of the turn
    pub(in super::super) fn turned(&self, moments: &[SpotTurn]) -> Vec<Holding> {
        let still = Holding::At { yaw: 0.0, slip_ratio: 0.0, is_outside: false };
        moments.iter().fold(vec![still; self.samples.len()], |worst, turn| {
            let now = self.in_moment(turn);
            worst.into_iter().zip(now).map(|(worst, now)| worst.or_worse(now)).collect()
        })
    }

    /// Advice on a turn; `None` without moments.
    ///
    /// * `moments`: of the turn
    pub(in super::super) fn advice(&self, moments: &[SpotTurn]) -> Option<Advice> {
        let (study, SpotTurn { slope, .. }) = (&self.study, *moments.first()?);
        let turned = self.turned(moments);
        let at_rest = moments.iter().map(|turn| {
            study.at_rest(slope, Some(&Driven::at_rest(&study.heading, slope, turn.yaw)))
        });
        let count = |is_so: fn(&Holding) -> bool| turned.iter().filter(|it| is_so(it)).count();
        let trials = count(|it| *it != Holding::Unknown);
        Some(Advice {
            slope,
            course: 0.0,
            judgement: at_rest.fold(study.of_turns(&turned), Judgement::or),
            level: Probability { successes: count(|it| it.is_held()), trials },
            not_found: turned.len() - trials,
            yaw: None,
            driven: None,
            stuck_in_turn: Some(Probability { successes: count(|it| *it == Holding::Not), trials }),
        })
    }

    /// What becomes of each sample in a moment.
    fn in_moment(&self, turn: &SpotTurn) -> Vec<Holding> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, held)) = known().iter().find(|it| it.0 == *turn) {
            return held.clone();
        }
        let heading = &self.study.heading;
        let rims = SpotTurn::rim_speeds(&heading.rover, turn.sense() * self.study.rim_speed);
        let in_sample = |place: usize| {
            let study = heading.of_sample(&self.samples[place]);
            let motion = study.steady_motion_of(turn.slope, turn.yaw, &rims);
            let slip = motion.map(|it| moving_slip(&it, &rims, turn.sense()));
            // A motion that is not found is no finding about the soil.
            slip.map_or(Holding::Unknown, |slip| Holding::of_motion(turn.yaw, slip))
        };
        let held = outputs_of_places(&self.samples, &|| true, in_sample).unwrap_or_default();
        known().push((*turn, held.clone()));
        held
    }
}

impl SlopeStudy {
    /// What the motions of all samples say of a turn on the spot: a no-go is one in which too many get
    /// stuck. Slip alone makes none: wheels that are dragged across their way slip by 0.6 to 0.8 on
    /// sand where simulated turns are completed. But they dig, so that it is no go either.
    pub(in super::super) fn of_turns(&self, turned: &[Holding]) -> Judgement {
        let share = |is_so: &dyn Fn(&Holding) -> bool| {
            turned.iter().filter(|it| is_so(it)).count() as f64 / turned.len() as f64
        };
        let [stuck, unknown] =
            [Holding::Not, Holding::Unknown].map(|it| share(&|held| *held == it));
        let most = self.rule.no_go_probability;
        let mut found = Judgement::GO;
        found.add(stuck >= most, Verdict::NoGo, Reason::Stuck);
        let is_open = stuck + unknown >= most || stuck <= STUCK_ON_GO;
        found.add(unknown > STUCK_ON_GO && is_open, Verdict::CannotTell, Reason::SearchGaveUp);
        found.add(stuck > STUCK_ON_GO, Verdict::Caution, Reason::Stuck);
        let most = self.rule.no_go_slip_ratio;
        let digs = share(&|it| it.slip_ratio().is_some_and(|slip| slip.abs() > most));
        found.add(digs > 1.0 - self.rule.go_probability, Verdict::Caution, Reason::WheelsDig);
        found
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

#[cfg(test)]
mod tests {
    use super::*;
    use grouser_io::{Overrides, Source, read_scenario};

    /// Of a hundred samples: how many turn with little slip and with much, get stuck, and are not
    /// known.
    #[test]
    fn who_gets_stuck_decides_and_what_is_not_known_leaves_it_open() {
        use Reason::{AllMet, SearchGaveUp, Stuck, WheelsDig};
        use Verdict::{CannotTell, Caution, Go, NoGo};
        let scenario = read_scenario(&Source::default_scenario(), &Overrides::none());
        let study = SlopeStudy::of(&scenario.expect("it is there"));
        let at = |slip_ratio| Holding::At { yaw: 0.0, slip_ratio, is_outside: false };
        let kinds = [at(0.5), at(-0.8), Holding::Not, Holding::Unknown];
        for (counts, verdict, reason) in [
            ([100, 0, 0, 0], Go, AllMet),
            ([95, 5, 0, 0], Go, AllMet),
            ([0, 100, 0, 0], Caution, WheelsDig),
            ([99, 0, 1, 0], Caution, Stuck),
            ([99, 0, 0, 1], CannotTell, SearchGaveUp),
            ([79, 0, 1, 20], CannotTell, SearchGaveUp),
            ([90, 0, 5, 5], Caution, Stuck),
            ([80, 0, 20, 0], NoGo, Stuck),
            ([20, 0, 20, 60], NoGo, Stuck),
        ] {
            let turned = kinds.iter().zip(counts);
            let turned: Vec<Holding> =
                turned.flat_map(|(kind, count)| vec![*kind; count]).collect();
            let found = study.of_turns(&turned);
            assert_eq!((found.verdict, found.reason), (verdict, reason), "{counts:?}");
        }
    }
}
