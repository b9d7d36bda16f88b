//! A run along a path, whose wheels are turned by commands from outside.

use super::angles::turned;
use super::limits::Limits;
use super::report::LegOutcome;
use super::route::{BesideRoute, Route};
use super::stop::{Limited, Stop};
use crate::error::{ParameterError, positive};
use crate::simulation::{BadState, CONTROL_PERIOD, Run, RunError, Scenario, State};
use crate::stored::{self, Stored, stored};
use crate::units::Vec2;

/// A run of a rover that is to follow a path, as far as it has come: a [`Run`] that is led by one
/// command after the other, and ends at the end of the path, or where a limit is passed.
///
/// After every control period the [`Limits`] are looked at, as in a mission, and the rover stays
/// where the first one was passed. The path is completed where its end is as near as
/// [`PathTask::within`]; a rover that went past it further off is stopped by the limit on the
/// distance from the path, as on its way to a waypoint of a mission.
///
/// A clone goes on as the original would, bit for bit.
///
/// With one speed for all wheels straight across a slope of 10°, when does a limit of 5 cm on the
/// distance from the path stop a rover?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::mission::{Limited, PathRun, PathTask, Route, Stop};
/// use grouser_core::simulation::Run;
/// use grouser_core::units::Vec2;
///
/// let task = PathTask {
///     route: Route::through(&[Vec2::zeros(), Vec2::new(1.0, 0.0)])?,
///     within: 0.1,
///     stops: vec![Stop::above(Limited::OffPath, 0.05)],
/// };
/// let mut path = PathRun::new(Run::new(&paper::traverse()?)?, task)?;
/// while path.outcome().is_none() {
///     path.step(&[0.06; 4], 0.5)?;
/// }
/// let off = 1e3 * path.beside().cross_track;
/// assert_eq!(format!("{:.1} s, {off:.1} mm", path.run().state().time()), "10.3 s, -50.1 mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct PathRun {
    run: Run,
    follower: Follower,
}

/// What is known of a rover on its path.
#[derive(Clone)]
struct Follower {
    task: PathTask,
    limits: Limits,
    beside: BesideRoute,
    /// Where the rover was at the last look [m].
    last: Vec2,
    outcome: Option<LegOutcome>,
}

/// A path, where it is completed, and limits on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTask {
    /// The path.
    pub route: Route,
    /// How near to its end is near enough [m].
    pub within: f64,
    /// Limits at which the rover stops; what [comes next](Stop::then) counts for nothing.
    pub stops: Vec<Stop>,
}

stored!(struct PathTask { route, within, stops });
stored!(struct Follower { task, limits, beside, last, outcome });

/// A rover as near as this beside the end of its path is past it [m]. Source: ours; far below what
/// a rover measures.
const CLOSE: f64 = 1e-7;
/// The nearest point of the path moves by at most so many times what the rover moved and was off
/// the path [-]. Source: ours. In a corner of 90° a rover that cuts it by *e* passes over a way of
/// 2 *e* along the path at once; parts of the path that lead back beside it are further away along
/// it.
const FURTHEST: f64 = 2.0;

impl PathRun {
    /// A rover that is to follow a path from where its run has come to.
    ///
    /// # Errors
    /// [`ParameterError`] for invalid limits, and an end that is never near enough.
    pub fn new(run: Run, task: PathTask) -> Result<Self, ParameterError> {
        positive("nearness to the end of a path [m]", task.within)?;
        let limits = Limits::new(&run, &task.stops)?;
        let place = run.state().rover().position;
        let start = task.route.nearest(place, 0.0..=0.0);
        let around = FURTHEST * start.cross_track.abs();
        let beside = task.route.nearest(place, 0.0..=around);
        let outcome = run.outcome().map(|outcome| LegOutcome::Ended(outcome.clone()));
        Ok(Self { run, follower: Follower { task, limits, beside, last: place, outcome } })
    }

    /// Turns the wheels at the given speeds for a while, or until the path or the run ends. A rover
    /// whose [`outcome`](Self::outcome) is known stays as it is.
    ///
    /// * `rim_speeds`, `span`: as in [`Run::step`]
    ///
    /// # Errors
    /// The same as [`Run::step`].
    pub fn step(&mut self, rim_speeds: &[f64], span: f64) -> Result<(), RunError> {
        if self.outcome().is_some() {
            return Ok(());
        }
        let Self { run, follower } = self;
        run.step_watched(rim_speeds, span, CONTROL_PERIOD, &mut |run| {
            follower.look(run);
            follower.outcome.is_some()
        })
    }

    /// The rover on its path as bytes, as [`State::to_bytes`]: [`from_bytes`](Self::from_bytes)
    /// reads them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self { run, follower } = self;
        stored::sealed(|bytes| {
            run.state().to_bytes().store(bytes);
            follower.store(bytes);
        })
    }

    /// The rover that was made [bytes](Self::to_bytes), on the same path under the same limits. It
    /// goes on as it would, bit for bit.
    ///
    /// * `scenario`: as in [`State::from_bytes`]
    ///
    /// # Errors
    /// [`BadState`], as [`State::from_bytes`], and for one on another path.
    pub fn from_bytes(
        bytes: &[u8],
        scenario: &Scenario,
        task: &PathTask,
    ) -> Result<Self, BadState> {
        let content = &mut stored::opened(bytes).ok_or(BadState::Unreadable)?;
        let read = <(Vec<u8>, Follower)>::restore(content).filter(|_| content.is_empty());
        let (state, follower) = read.ok_or(BadState::Unreadable)?;
        if follower.task != *task {
            return Err(BadState::OtherPath);
        }
        let run = Run::resume(scenario, State::from_bytes(&state, scenario)?);
        Ok(Self { run, follower })
    }

    /// The run.
    #[must_use]
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The path, and the limits.
    #[must_use]
    pub fn task(&self) -> &PathTask {
        &self.follower.task
    }

    /// What became of the rover, once that is known.
    #[must_use]
    pub fn outcome(&self) -> Option<&LegOutcome> {
        self.follower.outcome.as_ref()
    }

    /// Where the rover is beside its path. As the path may come near to itself, the nearest point
    /// is sought no further along it from the last one than twice what the rover moved since then
    /// and was off the path.
    #[must_use]
    pub fn beside(&self) -> BesideRoute {
        self.follower.beside
    }

    /// The rover's yaw less the heading of the path beside it, from -π to π [rad].
    #[must_use]
    pub fn heading_error(&self) -> f64 {
        turned(self.run.state().rover().yaw - self.follower.beside.heading)
    }

    /// What is left of the path [m].
    #[must_use]
    pub fn left(&self) -> f64 {
        self.follower.left()
    }

    /// The place on the path after a further way along it, seen from the rover: in the body frame
    /// [m].
    ///
    /// * `way`: along the path from where the rover is beside it [m]; the end stays where it is
    #[must_use]
    pub fn ahead(&self, way: f64) -> Vec2 {
        let rover = self.run.state().rover();
        let (place, _) = self.follower.task.route.at(self.follower.beside.along + way);
        rover.slope_from_body().transpose() * (place - rover.position)
    }
}

impl PathTask {
    /// The path and its limits as bytes, for other processes: [`from_bytes`](Self::from_bytes)
    /// reads them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        stored::sealed(|bytes| self.store(bytes))
    }

    /// The path that was made [bytes](Self::to_bytes); nothing of others.
    #[must_use]
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let content = &mut stored::opened(bytes)?;
        Self::restore(content).filter(|task| content.is_empty() && task.route.has_pieces())
    }
}

impl Follower {
    /// Looks at the rover: where it is, and what became of it.
    fn look(&mut self, run: &Run) {
        let place = run.state().rover().position;
        let moved = (place - self.last).norm();
        self.last = place;
        let BesideRoute { along, cross_track, .. } = self.beside;
        let around = FURTHEST * (moved + cross_track.abs());
        self.beside = self.task.route.nearest(place, along - around..=along + around);
        self.limits.record(run);
        let ended = run.outcome().map(|outcome| LegOutcome::Ended(outcome.clone()));
        let off_path = self.beside.cross_track.abs();
        let stopped = || self.limits.passed(run, off_path).map(LegOutcome::Stopped);
        self.outcome = ended.or_else(stopped).or_else(|| self.arrived(place));
    }

    /// What is left of the path [m].
    fn left(&self) -> f64 {
        self.task.route.length() - self.beside.along
    }

    /// How the path ended, if it did.
    fn arrived(&self, place: Vec2) -> Option<LegOutcome> {
        let (end, within) = (self.task.route.at(self.task.route.length()).0, self.task.within);
        let away = (place - end).norm();
        if away <= within && self.left() <= within {
            return Some(LegOutcome::Completed);
        }
        let missed = Stop::above(Limited::OffPath, within);
        let is_past = self.left() <= CLOSE;
        is_past.then(|| LegOutcome::Stopped(self.limits.stopped(missed, away)))
    }
}
