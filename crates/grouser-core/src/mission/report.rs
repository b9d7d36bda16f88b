//! What became of a mission and of its legs.

use super::driven::End;
use super::navigator::Fix;
use super::stop::{Stopped, Then};
use super::yaw_watch::FellShort;
use crate::simulation::{Outcome, OutcomeKind, Record, SAME_TIME, Trajectory};
use crate::stored::stored;
use crate::vehicle::RoverState;

/// What became of a leg.
#[derive(Clone, Debug, PartialEq)]
pub enum LegOutcome {
    /// The rover did what the leg says.
    Completed,
    /// It passed a limit.
    Stopped(Stopped),
    /// Its turn or its arc did not reach the yaw.
    FellShort(FellShort),
    /// It got stuck, slid or tipped over.
    Ended(Outcome),
}

stored!(enum LegOutcome {
    0 => Completed,
    1 => Stopped(stopped),
    2 => FellShort(short),
    3 => Ended(outcome),
});

/// What motors and battery took, of a rover whose motors are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// Electrical energy that motors, and with a battery the electronics, took [J].
    pub energy: f64,
    /// Largest current of a motor, driving or braking [A], at looks a tenth of a second apart.
    pub current: f64,
    /// Highest temperature of a motor's winding [°C], where some are known.
    pub temperature: Option<f64>,
    /// State of charge of the battery at the end [-], where that is known.
    pub charge: Option<f64>,
}

impl Taken {
    /// This, and what was taken after it.
    #[must_use]
    pub fn and(self, later: Self) -> Self {
        let temperatures = self.temperature.into_iter().chain(later.temperature);
        Self {
            energy: self.energy + later.energy,
            current: self.current.max(later.current),
            temperature: temperatures.reduce(f64::max),
            charge: later.charge,
        }
    }
}

/// A leg that was driven.
#[derive(Clone, Debug, PartialEq)]
pub struct LegReport {
    /// What became of it.
    pub outcome: LegOutcome,
    /// Way over the ground in the manoeuvre [m]; a turn to the leg's yaw before it does not count.
    pub distance: f64,
    /// How long it took, with the turn before it [s].
    pub time: f64,
    /// Work of the motors, with the turn before it [J].
    pub energy: f64,
    /// What motors and battery took, with the turn before it, where motors are known.
    pub taken: Option<Taken>,
    /// Slip ratio over the manoeuvre, 1 less the way over the ground by that of the rims [-]; of
    /// drives, arcs and ways to places alone.
    pub slip_ratio: Option<f64>,
    /// Yaw by which it really turned in an arc or a turn on the spot [rad], positive to the left; a
    /// turn to the leg's yaw before it does not count.
    pub turned: Option<f64>,
    /// The rover where it ended, before a way back out of it.
    pub end: RoverState,
    /// The way back out of it, if there was one.
    pub back_out: Option<BackOut>,
}

/// A way back after a stop.
#[derive(Clone, Debug, PartialEq)]
pub struct BackOut {
    /// What became of it: it is stopped by nothing but a limit of time.
    pub outcome: LegOutcome,
    /// Way over the ground [m].
    pub distance: f64,
    /// How long it took [s].
    pub time: f64,
    /// Work of the motors [J].
    pub energy: f64,
    /// What motors and battery took, where motors are known.
    pub taken: Option<Taken>,
}

/// A mission that was driven.
#[derive(Clone, Debug, PartialEq)]
pub struct MissionReport {
    /// The legs that were begun.
    pub legs: Vec<LegReport>,
    /// The rover over time: its last record is where the mission ended. A rover that was stopped
    /// has no outcome of its own, and counts as completed there.
    pub trajectory: Trajectory,
    /// Where the rover took itself to be, at each fix of its odometry; none of one that knows where
    /// it is.
    pub fixes: Vec<Fix>,
}

impl From<End> for LegOutcome {
    fn from(end: End) -> Self {
        match end {
            End::Reached => Self::Completed,
            End::Short(short) => Self::FellShort(short),
            End::Stopped(stopped) => Self::Stopped(stopped),
            End::Ended(outcome) => Self::Ended(outcome),
        }
    }
}

impl LegReport {
    /// Radius of the circle that was really driven [m]: the way over the ground by the turn; of
    /// drives that turned alone.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        let turned = self.turned?.abs();
        (self.slip_ratio.is_some() && turned > 0.0).then(|| self.distance / turned)
    }
}

impl LegOutcome {
    /// Its kind, of which the [table](OutcomeKind::row) says name, meaning and severity.
    #[must_use]
    pub fn kind(&self) -> OutcomeKind {
        match self {
            Self::Completed => OutcomeKind::Completed,
            Self::Stopped(_) => OutcomeKind::Stopped,
            Self::FellShort(_) => OutcomeKind::FellShort,
            Self::Ended(outcome) => outcome.kind(),
        }
    }

    /// One word: that of its [kind](Self::kind).
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.kind().name()
    }

    /// Whether the rover did what the leg says.
    #[must_use]
    pub fn is_completed(&self) -> bool {
        self.kind() == OutcomeKind::Completed
    }

    /// The limit that stopped the rover, or that its turn fell short by more than.
    #[must_use]
    pub fn stopped(&self) -> Option<&Stopped> {
        match self {
            Self::Stopped(stopped) | Self::FellShort(FellShort { stopped, .. }) => Some(stopped),
            Self::Completed | Self::Ended(_) => None,
        }
    }

    /// What the rover does next.
    #[must_use]
    pub fn then(&self) -> Then {
        match self {
            Self::Completed => Then::NextLeg,
            Self::Ended(_) => Then::End,
            Self::Stopped(stopped) | Self::FellShort(FellShort { stopped, .. }) => stopped.then(),
        }
    }
}

impl MissionReport {
    /// What became of the mission: the outcome of its last leg, and of the way back out of it.
    #[must_use]
    pub fn kind(&self) -> OutcomeKind {
        let Some(last) = self.legs.last() else { return OutcomeKind::Completed };
        let back = last.back_out.as_ref().map(|back| &back.outcome);
        let failed = back.filter(|outcome| !outcome.is_completed());
        failed.unwrap_or(&last.outcome).kind()
    }

    /// One word: that of its [kind](Self::kind).
    #[must_use]
    pub fn outcome(&self) -> &'static str {
        self.kind().name()
    }

    /// The rover where the mission ended.
    ///
    /// # Panics
    /// Never: there always is a record of the end.
    #[must_use]
    pub fn last(&self) -> &Record {
        self.trajectory.last()
    }

    /// The legs with their records, each from where the one before it ended; of a mission whose
    /// records were not taken on the way.
    #[must_use]
    pub fn legs_with_records(&self) -> Vec<(&LegReport, &[Record])> {
        let records = &self.trajectory.records;
        let mut end = records.first().map_or(0.0, |first| first.time);
        let mut from = 0;
        let each = self.legs.iter().map(|leg| {
            end += leg.time + leg.back_out.as_ref().map_or(0.0, |back| back.time);
            let until = records.partition_point(|record| record.time <= end + SAME_TIME);
            let own = &records[from.min(until)..until];
            from = until.saturating_sub(1);
            (leg, own)
        });
        each.collect()
    }

    /// Work of the motors in all legs [J].
    #[must_use]
    pub fn energy(&self) -> f64 {
        let of_leg =
            |leg: &LegReport| leg.energy + leg.back_out.as_ref().map_or(0.0, |back| back.energy);
        self.legs.iter().map(of_leg).sum()
    }

    /// What motors and battery took in all legs, with the ways back out of them, where motors are
    /// known.
    #[must_use]
    pub fn taken(&self) -> Option<Taken> {
        let back = |leg: &LegReport| leg.back_out.as_ref().and_then(|back| back.taken);
        let each = self.legs.iter().flat_map(|leg| [leg.taken, back(leg)]);
        each.flatten().reduce(Taken::and)
    }
}
