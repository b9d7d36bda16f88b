//! Everything that determines a run.

use super::scatter::Scatter;
pub use super::times::LONGEST_DURATION;
use super::yaw::PrescribedYaw;
use crate::contact::Model;
use crate::elementary::wide;
use crate::error::{ParameterError, finite, positive};
use crate::soil::SlopeStability;
use crate::stored::stored;
use crate::terrain::{Ground, Lie};
use crate::units::{EARTH_GRAVITY, Vec2};
use crate::vehicle::kinematics::rolling_velocity;
use crate::vehicle::{
    ByWheel, Differences, DriveLaw, LoadSharing, OnGround, OwnMoments, Rover, RoverState, Ruts,
};

/// One run of one rover over some ground. It determines its trajectory bit for bit.
///
/// How much farther does the rover drift on a slope of 15° than on one of 10°, in the same 20 s?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::{Run, RunError, Scenario};
/// use grouser_core::units::deg;
///
/// let on_10 = paper::traverse()?;
/// let on_15 = Scenario { ground: on_10.ground.with_slope(deg(15.0)), ..on_10.clone() };
/// let drift_mm = |scenario: &Scenario| -> Result<String, RunError> {
///     let end = Run::new(scenario)?.to_end()?.last().state.position;
///     Ok(format!("{:.0} mm downhill", -1e3 * end.y))
/// };
/// assert_eq!(drift_mm(&on_10)?, "97 mm downhill");
/// assert_eq!(drift_mm(&on_15)?, "175 mm downhill");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The rover.
    pub rover: Rover,
    /// What it drives on.
    pub ground: Ground,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: Model,
    /// How the weight is shared.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
    /// What turns the wheels.
    pub drive: DriveLaw,
    /// The yaw over time, if something holds it; without it the wheels' moments turn the rover.
    pub yaw: Option<PrescribedYaw>,
    /// How the soil below each wheel, and its speed, differ from those above.
    pub by_wheel: ByWheel,
    /// How they scatter.
    pub scatter: Scatter,
    /// What wheels leave behind for those that follow.
    pub ruts: Ruts,
    /// What is asked of the ground's own strength by those who plan on it; a run is not changed by
    /// it.
    pub stability: SlopeStability,
    /// How the run starts.
    pub start: Start,
    /// How long it lasts [s].
    pub duration: f64,
    /// How it is computed.
    pub numerics: Numerics,
}

impl Scenario {
    /// Twenty seconds on the Earth, with rims that turn at 6 cm/s and the nose along the contour,
    /// by `ishigami` and with complete loads: what a document has that says no more.
    ///
    /// ```
    /// use grouser_core::paper;
    /// use grouser_core::simulation::{Run, Scenario};
    /// use grouser_core::terrain::Ground;
    /// use grouser_core::units::deg;
    ///
    /// let slope = Ground::plane(paper::toyoura(), deg(5.0));
    /// let short = Scenario { duration: 2.0, ..Scenario::new(paper::hakuto()?, slope) };
    /// assert!(Run::new(&short)?.to_end()?.last().state.position.x > 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn new(rover: Rover, ground: Ground) -> Self {
        Self {
            rover,
            ground,
            gravity: EARTH_GRAVITY,
            model: Model::Ishigami,
            sharing: LoadSharing::Complete,
            own_moments: OwnMoments::Included,
            drive: DriveLaw::Constant(0.06),
            yaw: None,
            by_wheel: ByWheel::ALIKE,
            scatter: Scatter::NONE,
            ruts: Ruts::Fresh,
            stability: SlopeStability::USUAL,
            start: Start { yaw: 0.0, motion: Motion::Rolling },
            duration: 20.0,
            numerics: Numerics::DEFAULT,
        }
    }
}

/// How a run is computed and recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numerics {
    /// Whether velocities are integrated or steady.
    pub approach: Approach,
    /// What carries the motion through time.
    pub integrator: Integrator,
    /// Time between samples [s].
    pub sample_interval: f64,
}

impl Numerics {
    /// Integrated by the implicit solver, ten samples a second.
    pub const DEFAULT: Self = Self {
        approach: Approach::Dynamic,
        integrator: Integrator::Adaptive { tolerance: 1e-6 },
        sample_interval: 0.1,
    };
}

impl Default for Numerics {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Where a run's velocities come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Approach {
    /// They are integrated with the pose.
    #[default]
    Dynamic,
    /// They are the ones at which nothing accelerates, and the pose alone is integrated. Where that
    /// is not valid the run goes on dynamically, and its trajectory says so.
    QuasiSteady,
}

stored!(enum Approach { 0 => Dynamic, 1 => QuasiSteady });

/// What carries the motion through time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// Method of order 5 with steps of its own, explicit while slip settles within milliseconds,
    /// and implicit in the minutes that follow.
    Adaptive {
        /// Relative tolerance of a step [-].
        tolerance: f64,
    },
    /// Classical Runge-Kutta with a fixed step: slow, and independent of the other.
    Rk4 {
        /// Step [s]; stable up to about a millisecond while all hubs move, and a thousandth of that
        /// where one comes to rest.
        step: f64,
    },
}

/// How a run starts, at the origin of the slope frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Yaw, *γ* [rad].
    pub yaw: f64,
    /// Whether it already moves.
    pub motion: Motion,
}

/// Motion at the start of a run; the wheels turn from the first instant on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Motion {
    /// The body moves the way that its wheels roll, which is along its x axis where none is
    /// steered, at [`ROLLING_SHARE`] of the wheels' mean rim velocity. It does not turn.
    #[default]
    Rolling,
    /// Nothing moves but the wheels.
    Rest,
}

/// Speed of a rolling start over the rim's speed [-]. Source: ours, a light slip.
pub const ROLLING_SHARE: f64 = 0.95;

/// Returns the error of neglected moments: the complete load transfer has the wheels' own moments
/// in it.
#[must_use]
pub fn neglected_moments() -> ParameterError {
    let name = "share of the wheels' own moments in a complete load transfer";
    ParameterError::new(name, 0.0, "1: they are part of it")
}

impl Scenario {
    /// Checks that the scenario's values are valid.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.ground.check()?;
        positive("gravity [m/s²]", self.gravity)?;
        self.on_ground().check_soils()?;
        self.drive.check(&self.rover)?;
        self.by_wheel.check(self.rover.wheel_count())?;
        self.scatter.check()?;
        self.stability.check()?;
        finite("start yaw [rad]", self.start.yaw)?;
        if let Some(yaw) = &self.yaw {
            yaw.check()?;
            if self.start.yaw != 0.0 && self.start.yaw != yaw.at(0.0) {
                let expected = "that of the yaw over time, or left out";
                return Err(ParameterError::new("start yaw [rad]", self.start.yaw, expected));
            }
        }
        if self.sharing == LoadSharing::Complete && self.own_moments == OwnMoments::Neglected {
            return Err(neglected_moments());
        }
        positive("duration [s]", self.duration)?;
        if self.duration > LONGEST_DURATION {
            let expected = "at most a day, 86400 s";
            return Err(ParameterError::new("duration [s]", self.duration, expected));
        }
        positive("sample interval [s]", self.numerics.sample_interval)?;
        match self.numerics.integrator {
            Integrator::Adaptive { tolerance } => positive("tolerance", tolerance),
            Integrator::Rk4 { step } => positive("step [s]", step),
        }
    }

    /// The rover on its ground.
    #[must_use]
    pub fn on_ground(&self) -> OnGround<'_> {
        OnGround {
            rover: &self.rover,
            ground: &self.ground,
            gravity: self.gravity,
            model: self.model.as_ref(),
            sharing: self.sharing,
            own_moments: self.own_moments,
            differences: self.differences(),
        }
    }

    /// How the ground lies under the rover, and its height there [m].
    #[must_use]
    pub fn ground_under(&self, state: &RoverState) -> (Lie, f64) {
        self.ground.lie(state.position, self.rover.footprint(&state.slope_from_body()))
    }

    /// How far the nose is turned uphill of the contour under the rover [rad]: on a plane the yaw;
    /// on level ground with heights nothing.
    #[must_use]
    pub fn yaw_from_contour(&self, state: &RoverState) -> f64 {
        if self.ground.is_plane() {
            return state.yaw;
        }
        // The contour has two directions, of which the nose is near to one.
        let uphill = self.ground_under(state).0.downhill_of_body(state.yaw).map(|down| -down);
        uphill.map_or(0.0, |uphill| wide::asin(uphill.x.clamp(-1.0, 1.0)))
    }

    /// How far straight downhill a rover is [m] that came from a place near by.
    ///
    /// On a plane that is the way down since the origin. Where the ground bends it is the sum of
    /// the ways down the ground under the rover; on [level](crate::terrain::ground::LEVEL) ground
    /// there is no way down.
    ///
    /// * `before`: the place [m], and how far downhill it is [m]
    #[must_use]
    pub fn way_down(&self, before: (Vec2, f64), state: &RoverState) -> f64 {
        let (place, down) = before;
        let (lie, _) = self.ground_under(state);
        match lie.uphill() {
            None => down,
            Some(uphill) if self.ground.is_plane() => 0.0 - state.position.dot(&uphill),
            Some(uphill) => down - uphill.dot(&(state.position - place)) / lie.normal.z,
        }
    }

    /// Length of the way along the ground from a place near by [m].
    #[must_use]
    pub fn way_from(&self, place: Vec2, state: &RoverState) -> f64 {
        let level = state.position - place;
        if self.ground.is_plane() {
            return level.norm();
        }
        let normal = self.ground_under(state).0.normal;
        let rise = normal.xy().dot(&level) / normal.z;
        (level.norm_squared() + rise * rise).sqrt()
    }

    /// How the soil below each wheel differs from that of the ground.
    #[must_use]
    pub fn differences(&self) -> Differences<'_> {
        let by_wheel = (self.by_wheel != ByWheel::ALIKE).then_some(&self.by_wheel);
        Differences { by_wheel, by_place: self.scatter.soil_field(), ruts: self.ruts }
    }

    /// The rim speeds, *ω r_s* [m/s], of wheels of which others are commanded [m/s].
    #[must_use]
    pub fn rim_speeds(&self, commanded: &[f64]) -> Vec<f64> {
        self.each_rim_speed(commanded).collect()
    }

    /// The same, one after the other.
    pub(super) fn each_rim_speed<'a>(
        &'a self,
        commanded: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        let differ = |(wheel, (commanded, scatter)): (usize, (&f64, f64))| {
            commanded * self.by_wheel.speed.of(wheel) * scatter
        };
        commanded.iter().zip(self.scatter.speed_factors()).enumerate().map(differ)
    }

    /// The state at time 0.
    ///
    /// * `rim_speeds`: ω r_s of each wheel [m/s]
    #[must_use]
    pub fn start_state(&self, rim_speeds: &[f64]) -> RoverState {
        let (yaw, yaw_rate) = match &self.yaw {
            Some(yaw) => (yaw.at(0.0), yaw.rate_from(0.0)),
            None => (self.start.yaw, 0.0),
        };
        let at_rest = RoverState { yaw, yaw_rate, ..RoverState::default() };
        match self.start.motion {
            Motion::Rest => at_rest,
            Motion::Rolling => {
                let velocity = ROLLING_SHARE * rolling_velocity(self.rover.mounts(), rim_speeds);
                RoverState { velocity, ..at_rest }
            }
        }
    }
}
