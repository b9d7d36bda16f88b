//! Whether a turn or an arc still gets on with its yaw.
//!
//! A rover on soil turns by less than its wheels would turn it on rigid ground, on steep or soft
//! ground not at all. So an arc or a turn goes on until its yaw is reached, and this says when that
//! is no longer to be expected.

use super::stop::Stopped;
use crate::stored::stored;

/// An arc falls short after so many times its own way [-]. Source: ours; with half of the turn that
/// its wheels would give on rigid ground, usual of skid-steered rovers on sand, an arc is just
/// completed.
const MOST_WAYS: f64 = 2.0;
/// A yaw that turned by less than this share of the turn that wheels would give on rigid ground
/// stands still [-]. Source: ours, as of the [progress](crate::simulation::watch::LEAST_PROGRESS)
/// of a rover that is stuck.
const STILL: f64 = 0.01;
/// The shortest time over which that is asked [s]. Source: ours; a rover that shifts back to its
/// place in a turn, at a slip ratio of 0.9, needs a third of it, and does not turn meanwhile.
const LEAST_WINDOW: f64 = 60.0;

/// How far a turn or an arc fell short of its yaw.
#[derive(Clone, Debug, PartialEq)]
pub struct FellShort {
    /// Yaw by which the rover was to turn [rad], positive to the left.
    pub asked: f64,
    /// Yaw by which it turned, as it knows it [rad].
    pub turned: f64,
    /// Why it turned no further.
    pub because: ShortBecause,
    /// The limit on the shortfall, which says what comes next.
    pub stopped: Stopped,
}

/// Why a turn or an arc was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShortBecause {
    /// The rover drove twice the arc's way.
    TwiceTheWay,
    /// Its yaw stands still.
    StandsStill,
    /// It took too long.
    TooLong,
}

stored!(struct FellShort { asked, turned, because, stopped });
stored!(enum ShortBecause { 0 => TwiceTheWay, 1 => StandsStill, 2 => TooLong });

impl FellShort {
    /// Yaw that is missing [rad], not below 0.
    #[must_use]
    pub fn shortfall(&self) -> f64 {
        (self.asked - self.turned).abs()
    }
}

impl ShortBecause {
    /// What it means: the end of a sentence.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::TwiceTheWay => "it drove twice the way of the arc",
            Self::StandsStill => "its yaw stands still",
            Self::TooLong => "it took too long",
        }
    }
}

/// A turn or an arc under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct YawWatch {
    /// Yaw at the start [rad], and the one to reach.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Time at which it is given up [s], and the way after which an arc is [m].
    give_up: f64,
    most_way: f64,
    /// Time over which the yaw has to get on [s], and by how much at least [rad].
    window: f64,
    least_gain: f64,
    /// When it last got on so far [s], and what was left then [rad].
    since: f64,
    left: f64,
}

/// What a watch is to know of a turn or an arc at its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planned {
    /// Yaw at the start [rad], and the one to reach.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Way of an arc [m].
    pub(super) way: Option<f64>,
    /// When it starts [s], how long it would take without slip [s], and how long it may take at
    /// most [s].
    pub(super) start: f64,
    pub(super) nominal: f64,
    pub(super) longest: f64,
}

impl YawWatch {
    pub(super) fn new(planned: &Planned) -> Self {
        let Planned { from, to, way, start, nominal, longest } = *planned;
        let (angle, window) = ((to - from).abs(), nominal.max(LEAST_WINDOW));
        // A turn that is short beside its window has to be done within it.
        let whole = if nominal > 0.0 { angle * window / nominal } else { 0.0 };
        Self {
            from,
            to,
            give_up: start + longest,
            most_way: way.map_or(f64::INFINITY, |way| MOST_WAYS * way),
            window,
            least_gain: (STILL * whole).min(angle),
            since: start,
            left: angle,
        }
    }

    /// Yaw that is left at some yaw [rad]; below 0 where it was passed.
    pub(super) fn left(&self, yaw: f64) -> f64 {
        (self.to - self.from).signum() * (self.to - yaw)
    }

    /// Looks at the rover; why the rest is not to be expected, if so.
    ///
    /// * `ground`: way over the ground since the start [m]
    pub(super) fn look(&mut self, time: f64, yaw: f64, ground: f64) -> Option<ShortBecause> {
        let left = self.left(yaw);
        if self.left - left >= self.least_gain {
            (self.since, self.left) = (time, left);
        }
        if ground >= self.most_way {
            Some(ShortBecause::TwiceTheWay)
        } else if time - self.since > self.window {
            Some(ShortBecause::StandsStill)
        } else {
            (time > self.give_up).then_some(ShortBecause::TooLong)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn of 10 s, of an arc of 1 m.
    const PLANNED: Planned =
        Planned { from: 1.0, to: 2.5, way: Some(1.0), start: 5.0, nominal: 10.0, longest: 260.0 };

    #[test]
    fn an_arc_is_given_up_after_twice_its_way() {
        let mut watch = YawWatch::new(&PLANNED);
        assert_eq!(watch.look(15.0, 1.5, 1.99), None);
        assert_eq!(watch.look(16.0, 1.6, 2.0), Some(ShortBecause::TwiceTheWay));
    }

    /// A minute at 1 % of 0.15 rad/s is 0.09 rad.
    #[test]
    fn a_yaw_that_gets_on_by_less_than_a_hundredth_of_its_rate_stands_still() {
        let after = |rate: f64| {
            let mut watch = YawWatch::new(&Planned { way: None, ..PLANNED });
            let mut looks = (1..2500).map(|look| 0.1 * f64::from(look));
            looks.find_map(|time| {
                let because = watch.look(5.0 + time, 1.0 + rate * time, 0.0)?;
                Some((because, time))
            })
        };
        let (because, time) = after(0.0014).expect("it is too slow");
        assert!(because == ShortBecause::StandsStill && (time - 60.1).abs() < 0.2, "{time}");
        assert_eq!(after(0.0016), None);
    }

    /// To the right, and past the yaw.
    #[test]
    fn what_is_left_is_below_0_past_the_yaw() {
        let watch = YawWatch::new(&Planned { from: 0.5, to: -0.5, ..PLANNED });
        assert_eq!(watch.left(0.25), 0.75);
        assert_eq!(watch.left(-0.75), -0.25);
    }
}
