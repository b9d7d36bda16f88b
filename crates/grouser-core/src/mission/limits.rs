//! Limits on a rover that someone drives, looked at after every control period.

use super::odometer::Odometer;
use super::stop::{Cause, Limited, Stop, Stopped, Where};
use crate::error::ParameterError;
use crate::simulation::Run;
use crate::stored::stored;
use crate::units::Vec2;
use crate::vehicle::{Mount, RoverState, roll_and_pitch};

/// Limits on a rover under way, and what is measured for them since the drive began.
///
/// It drives nothing: whoever leads the [`Run`] has it [record](Self::record) the rover once a
/// [control period](crate::simulation::CONTROL_PERIOD), and asks it what was
/// [passed](Self::passed). A [`MissionRun`](super::MissionRun) and a [`PathRun`](super::PathRun) do
/// so.
///
/// Straight across a slope of 10°, where is a rover stopped that must not drift more than 5 cm on a
/// metre of its rims' way?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::mission::{Limited, Limits, Stop};
/// use grouser_core::simulation::{CONTROL_PERIOD, Run};
///
/// let mut run = Run::new(&paper::traverse()?)?;
/// let mut limits = Limits::new(&run, &[Stop::above(Limited::Drift, 0.05)])?;
/// let stopped = loop {
///     run.step(&[0.06; 4], CONTROL_PERIOD)?;
///     limits.record(&run);
///     if let Some(stopped) = limits.passed(&run, 0.0) {
///         break stopped;
///     }
/// };
/// assert_eq!(format!("{:.1} s, {:.3} m", run.state().time(), stopped.after), "16.7 s, 0.948 m");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Limits {
    stops: Vec<Stop>,
    odometer: Odometer,
    /// Where the rover was at the last look [m], and the way over the ground until then [m].
    last: Vec2,
    ground: f64,
    start_time: f64,
    start_work: f64,
}

stored!(struct Limits { stops, odometer, last, ground, start_time, start_work });

/// What a rover knows of itself at a look.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    /// Pose.
    pub(super) seen: &'a RoverState,
    /// Distance from its path [m].
    pub(super) off_path: f64,
    /// Whether it drives somewhere: slip, drift and distance from the path are looked at.
    pub(super) is_drive: bool,
}

impl Limits {
    /// Limits on a drive that begins where a run has come to.
    ///
    /// * `stops`: in the order in which they are asked; of two that are passed at one look, the
    ///   first counts
    ///
    /// # Errors
    /// [`ParameterError`] for an invalid limit.
    pub fn new(run: &Run, stops: &[Stop]) -> Result<Self, ParameterError> {
        stops.iter().try_for_each(|stop| stop.check(&run.scenario().rover))?;
        Ok(Self::begun(run, run.state().rover().position, stops.to_vec()))
    }

    /// The same for a rover that takes itself to be at a place [m].
    pub(super) fn begun(run: &Run, place: Vec2, stops: Vec<Stop>) -> Self {
        let scenario = run.scenario();
        let ways = stops.iter().filter(|stop| stop.limited.is_of_a_way()).map(|stop| stop.over);
        let remembered = ways.fold(0.0, f64::max);
        let state = run.state();
        let at = RoverState { position: place, ..*state.rover() };
        let down = scenario.way_down((place, 0.0), &at);
        Self {
            stops,
            odometer: Odometer::new(state.time(), down, remembered),
            last: place,
            ground: 0.0,
            start_time: state.time(),
            start_work: state.motor_work(),
        }
    }

    /// Records how far the rover, whose wheels kept their speeds since the last record, has come.
    pub fn record(&mut self, run: &Run) {
        let rover = run.state().rover();
        let place = rover.position;
        self.ground += run.scenario().way_from(self.last, rover);
        self.record_from(run, place, self.ground);
    }

    /// The same for one that takes itself to be at a place.
    ///
    /// * `place`, `ground`: where that is [m], and its way over the ground since the drive began
    ///   [m]
    pub(super) fn record_from(&mut self, run: &Run, place: Vec2, ground: f64) {
        let state = run.state();
        let at = RoverState { position: place, ..*state.rover() };
        let down = run.scenario().way_down((self.last, self.odometer.down()), &at);
        self.last = place;
        self.odometer.look(state.time(), ground, down, state.rim_speeds());
    }

    /// The first limit that is passed now.
    ///
    /// * `off_path`: how far the rover is from where it should drive [m]
    #[must_use]
    pub fn passed(&self, run: &Run, off_path: f64) -> Option<Stopped> {
        self.passed_as(run, Known { seen: run.state().rover(), off_path, is_drive: true })
    }

    /// The same by what a rover knows of itself.
    pub(super) fn passed_as(&self, run: &Run, known: Known<'_>) -> Option<Stopped> {
        let [sinkage_ratio, sinkage, torque, current] = self.of_wheels(run);
        let state = run.state();
        let roll_and_pitch = || roll_and_pitch_of(run, known.seen.yaw);
        let value = |stop: &Stop| match stop.limited {
            Limited::SlipRatio => Some(self.odometer.over(stop.over)?.slip_ratio),
            Limited::Drift => Some(self.odometer.over(stop.over)?.drift),
            Limited::OffPath => Some(known.off_path),
            Limited::DriftPerMetre => self.odometer.over(stop.over)?.drift_per_metre(stop.over),
            Limited::Sinkage => Some(sinkage_ratio),
            Limited::SinkageDepth => Some(sinkage),
            Limited::Roll => Some(roll_and_pitch()[0].abs()),
            Limited::Pitch => Some(roll_and_pitch()[1].abs()),
            Limited::Torque => Some(torque),
            Limited::Time => Some(state.time() - self.start_time),
            Limited::Energy => Some(state.motor_work() - self.start_work),
            Limited::Current => Some(current),
            Limited::Temperature => state.warmest(),
            Limited::Discharge => Some(1.0 - state.battery()?.charge),
            Limited::Shortfall => None,
        };
        let is_looked_at = |stop: &&Stop| match stop.limited.row().known {
            Where::Everywhere => true,
            Where::Drives | Where::Ways => known.is_drive,
            Where::Ends => false,
        };
        self.stops.iter().filter(is_looked_at).find_map(|stop| {
            let value = value(stop)?;
            (value > stop.above).then(|| self.stopped(*stop, value))
        })
    }

    /// Returns the stop of a rover that passes a limit here.
    pub(super) fn stopped(&self, stop: Stop, value: f64) -> Stopped {
        let (cause, kind) = (Cause::Limit { stop, value }, stop.limited.row().kind);
        Stopped { cause, kind, after: self.odometer.ground() }
    }

    /// Ways since the drive began.
    pub(super) fn odometer(&self) -> &Odometer {
        &self.odometer
    }

    /// Calls [`Odometer::lay_anew`].
    pub(super) fn lay_anew(&mut self, since: f64) {
        self.odometer.lay_anew(since);
    }

    /// Largest sinkage of a wheel over its shearing radius [-], largest sinkage [m], largest torque
    /// [N·m] and largest current [A], if some limit needs them.
    fn of_wheels(&self, run: &Run) -> [f64; 4] {
        if !self.stops.iter().any(|stop| stop.limited.row().needs_wheels) {
            return [0.0; 4];
        }
        let radii = run.scenario().rover.mounts().iter().map(Mount::shearing_radius);
        let each = run.wheels().into_iter().zip(radii).map(|((wheel, taken), radius)| {
            let current = taken.map_or(0.0, |taken| taken.current.abs());
            let sinkage = wheel.settled.sinkage;
            [sinkage / radius, sinkage, wheel.settled.forces.torque.abs(), current]
        });
        each.fold([0.0; 4], |most, one| [0, 1, 2, 3].map(|i| f64::max(most[i], one[i])))
    }
}

/// How the rover leans [rad]: as it stands on ground with heights, or on the plane by the yaw that
/// it knows.
fn roll_and_pitch_of(run: &Run, yaw: f64) -> [f64; 2] {
    let standing = (!run.scenario().ground.is_plane()).then(|| run.now().standing()).flatten();
    match standing {
        Some(standing) => [standing.roll, standing.pitch],
        None => roll_and_pitch(run.scenario().ground.plane_slope().unwrap_or(0.0), yaw),
    }
}
