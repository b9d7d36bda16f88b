//! What a rover is to drive: legs and their manoeuvres.

use super::navigator::Sensors;
use super::steering::{ackermann_angles, crab_angles};
use super::stop::Stop;
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::simulation::Scenario;
use crate::units::Vec2;
use crate::vehicle::{DriveLaw, Rover};

/// A rover on its ground, and the legs that it is to drive there.
///
/// How far does a rover come, and where does it end, that drives two metres across a slope of 10°,
/// turns by 90° to its left on the spot and goes back a metre?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::mission::{Leg, Manoeuvre, Mission, MissionRun};
/// use grouser_core::units::deg;
///
/// let legs = vec![
///     Leg { yaw: Some(deg(5.0)), ..Leg::new(Manoeuvre::drive(2.0)) },
///     Leg::new(Manoeuvre::Turn { angle: deg(90.0) }),
///     Leg::new(Manoeuvre::drive(-1.0)),
/// ];
/// let mission = Mission { scenario: paper::traverse()?, legs, stops: Vec::new(), sensors: None };
/// let report = MissionRun::new(&mission)?.to_end()?;
/// let distances: Vec<String> =
///     report.legs.iter().map(|leg| format!("{:.2}", leg.distance)).collect();
/// assert_eq!([&*distances[0], &*distances[2]], ["2.00", "1.00"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mission {
    /// Rover, ground, model, and how the run is computed. Of its start, the yaw holds where the
    /// first leg has none; its drive and its duration count for nothing.
    pub scenario: Scenario,
    /// The legs, in their order.
    pub legs: Vec<Leg>,
    /// Limits of every leg that has no limit of its own for the same number.
    pub stops: Vec<Stop>,
    /// What the rover knows of where it is; without it, all.
    pub sensors: Option<Sensors>,
}

/// One leg of a mission.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// What the rover does.
    pub manoeuvre: Manoeuvre,
    /// Speeds of the rims: as for a drive forward, the manoeuvre says which way they turn. On the
    /// spot and back out it turns its wheels at the [fastest](Self::speed) of them.
    pub drive: DriveLaw,
    /// The yaw, *γ* [rad], before the manoeuvre: that of the start for a first leg, turned to on
    /// the spot for another.
    pub yaw: Option<f64>,
    /// What is held on the way.
    pub heading: Heading,
    /// What leads the rover round an arc.
    pub steering: Steering,
    /// Limits of this leg alone.
    pub stops: Vec<Stop>,
    /// How far ahead the way is simulated before it is driven [m]: where a limit would be passed,
    /// the rover stops before.
    pub look_ahead: Option<f64>,
}

/// What a rover does in a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Manoeuvre {
    /// It drives for a distance.
    Drive {
        /// How far [m]; below 0 backward.
        distance: f64,
        /// What the distance is measured by.
        by: Measure,
    },
    /// It turns on the spot.
    Turn {
        /// By how much [rad], positive to the left.
        angle: f64,
    },
    /// It drives along a circle.
    Arc {
        /// Radius of the circle of its centre of mass [m].
        radius: f64,
        /// How far it turns [rad], positive to the left.
        angle: f64,
        /// Whether it drives backward.
        reverse: bool,
    },
    /// It drives to a place.
    Goto {
        /// Where, in the slope frame [m].
        place: Vec2,
        /// How near is near enough [m].
        within: f64,
        /// Whether it drives backward.
        reverse: bool,
    },
    /// It stands.
    Wait {
        /// How long [s].
        time: f64,
    },
}

/// What a distance is measured by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The way of the centre of mass over the ground.
    #[default]
    Ground,
    /// The way of the rims, mean of all wheels: more than that over the ground where they slip.
    Odometry,
}

/// What a rover holds while it drives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Heading {
    /// Nothing: its wheels keep one speed.
    #[default]
    Free,
    /// The yaw with which the leg began.
    Hold,
    /// The height on the slope at which the leg began: the nose is turned uphill as far as that
    /// needs.
    Contour,
    /// The nose towards a place [m], or the tail where it drives backward.
    Toward(Vec2),
    /// The yaw and the line with which the leg began: the sides hold the yaw, and all wheels that
    /// are steered turn uphill together as far as the line needs. Along the contour, the body lies
    /// along it and wheels crab; to a place, they point there, without a turn of the nose, as far
    /// as their limits allow.
    Crab {
        /// Crab angle with which the leg begins, *δ* [rad], positive to the left, on the way to a
        /// place from the direction in which it lies.
        angle: f64,
    },
}

/// What leads a rover round an arc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Steering {
    /// The speeds of its sides: wheels slip sideways.
    #[default]
    Sides,
    /// Wheels that are steered: the axle of each points to the centre of the circle, and rims are
    /// as fast as their distances from there (Ackermann). Where some wheels are not steered, the
    /// centre lies beside the middle of these.
    Ackermann,
}

/// The usual speed of the rims [m/s]. Source: [FourWheel], section 5.2.
const USUAL_SPEED: f64 = 0.06;

/// The most legs of a mission. Source: ours; a day of a rover has dozens.
const MOST_LEGS: usize = 10_000;

/// A leg that no rover can drive.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("leg {leg}: {source}")]
pub struct PlanError {
    /// Its number, counted from 1; 0 for the mission.
    pub leg: usize,
    /// What is wrong.
    pub source: ParameterError,
}

impl Manoeuvre {
    /// A drive that is measured over the ground.
    ///
    /// * `distance`: how far [m]; below 0 backward
    #[must_use]
    pub fn drive(distance: f64) -> Self {
        Self::Drive { distance, by: Measure::Ground }
    }

    /// Which way the wheels turn: 1 forward, -1 backward, 0 where they stand or turn against each
    /// other.
    #[must_use]
    pub fn direction(&self) -> f64 {
        let backward = match self {
            Self::Drive { distance, .. } => *distance < 0.0,
            Self::Arc { reverse, .. } | Self::Goto { reverse, .. } => *reverse,
            Self::Turn { .. } | Self::Wait { .. } => return 0.0,
        };
        if backward { -1.0 } else { 1.0 }
    }

    /// Whether it is complete at a yaw: a turn on the spot, or an arc.
    #[must_use]
    pub fn turns(&self) -> bool {
        match self {
            Self::Turn { .. } | Self::Arc { .. } => true,
            Self::Drive { .. } | Self::Goto { .. } | Self::Wait { .. } => false,
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Drive { distance, .. } => finite("distance [m]", *distance),
            Self::Turn { angle } => finite("angle of a turn [rad]", *angle),
            Self::Arc { radius, angle, .. } => {
                positive("radius of an arc [m]", *radius)?;
                finite("angle of an arc [rad]", *angle)
            }
            Self::Goto { place, within, .. } => {
                finite("x of a waypoint [m]", place.x)?;
                finite("y of a waypoint [m]", place.y)?;
                positive("nearness to a waypoint [m]", *within)
            }
            Self::Wait { time } => not_negative("time to wait [s]", *time),
        }
    }
}

impl Leg {
    /// A leg at the usual speed of 6 cm/s, without limits of its own.
    #[must_use]
    pub fn new(manoeuvre: Manoeuvre) -> Self {
        Self {
            manoeuvre,
            drive: DriveLaw::Constant(USUAL_SPEED),
            yaw: None,
            heading: Heading::Free,
            steering: Steering::Sides,
            stops: Vec::new(),
            look_ahead: None,
        }
    }

    /// Speed of its fastest rims, *ω r_s* [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.drive.nominal_rim_speed().abs()
    }

    fn check(&self, rover: &Rover) -> Result<(), ParameterError> {
        self.manoeuvre.check()?;
        self.drive.check(rover)?;
        match self.drive {
            DriveLaw::Constant(speed) => positive("rim speed of a leg [m/s]", speed)?,
            _ => positive("fastest rim speed of a leg [m/s]", self.speed())?,
        }
        self.yaw.map_or(Ok(()), |yaw| finite("yaw of a leg [rad]", yaw))?;
        self.look_ahead.map_or(Ok(()), |way| positive("way that is looked ahead [m]", way))?;
        if let Heading::Toward(place) = self.heading {
            finite("x of the place ahead [m]", place.x)?;
            finite("y of the place ahead [m]", place.y)?;
        }
        self.check_steering(rover)?;
        let is_drive = matches!(self.manoeuvre, Manoeuvre::Drive { .. });
        let crabs_to_place = matches!(
            (self.manoeuvre, self.heading),
            (Manoeuvre::Goto { .. }, Heading::Crab { .. })
        );
        if self.heading != Heading::Free && !is_drive && !crabs_to_place {
            let expected =
                "left out: it goes with a drive; turns, arcs, waypoints and waits have their own";
            return Err(ParameterError::new("heading of a leg", 1.0, expected));
        }
        self.stops.iter().try_for_each(|stop| stop.check(rover))
    }
}

impl Leg {
    /// Checks that wheels can be steered as the leg needs.
    fn check_steering(&self, rover: &Rover) -> Result<(), ParameterError> {
        let is_ackermann = self.steering == Steering::Ackermann;
        let is_crab = matches!(self.heading, Heading::Crab { .. });
        if (is_ackermann || is_crab) && !rover.is_steerable() {
            let name = "number of wheels that are steered";
            let expected =
                "one or more where a leg steers: `steering_limit_deg` says how far they turn";
            return Err(ParameterError::new(name, 0.0, expected));
        }
        if let Heading::Crab { angle } = self.heading {
            finite("crab angle of a leg [rad]", angle)?;
            rover.check_steering(&crab_angles(rover, angle))?;
        }
        match self.manoeuvre {
            Manoeuvre::Arc { radius, angle, .. } if is_ackermann => {
                let forward = self.manoeuvre.direction() * self.speed();
                let rate = angle.signum() * self.speed() / radius;
                rover.check_steering(&ackermann_angles(rover, [forward, rate]))
            }
            _ if is_ackermann => {
                let expected = "left out: `ackermann` goes with an arc";
                Err(ParameterError::new("steering of a leg", 1.0, expected))
            }
            _ => Ok(()),
        }
    }
}

impl Mission {
    /// Checks that the mission is valid.
    ///
    /// # Errors
    /// [`PlanError`] for the first leg that is wrong.
    pub fn check(&self) -> Result<(), PlanError> {
        let whole = |source| PlanError { leg: 0, source };
        if self.legs.is_empty() || self.legs.len() > MOST_LEGS {
            let expected = "1 to 10000";
            return Err(whole(ParameterError::new(
                "number of legs",
                self.legs.len() as f64,
                expected,
            )));
        }
        let rover = &self.scenario.rover;
        self.stops.iter().try_for_each(|stop| stop.check(rover)).map_err(whole)?;
        self.sensors.map_or(Ok(()), |sensors| sensors.check()).map_err(whole)?;
        let mut legs = self.legs.iter().enumerate();
        legs.try_for_each(|(place, leg)| {
            leg.check(&self.scenario.rover).map_err(|source| PlanError { leg: place + 1, source })
        })?;
        if self.scenario.yaw.is_some() {
            let expected = "left out: legs have headings";
            return Err(whole(ParameterError::new("yaw over time", 1.0, expected)));
        }
        self.scenario.check().map_err(whole)
    }

    /// Speed of the fastest rims on its first leg that leads somewhere [m/s]: that of its first leg
    /// where none does.
    #[must_use]
    pub fn rim_speed(&self) -> f64 {
        let leads = |leg: &&Leg| leg.manoeuvre.direction() != 0.0;
        self.legs.iter().find(leads).or(self.legs.first()).map_or(USUAL_SPEED, Leg::speed)
    }

    /// The limits of a leg: its own, and those of the mission for other numbers.
    pub(super) fn stops_of(&self, leg: &Leg) -> Vec<Stop> {
        let is_own = |stop: &Stop| leg.stops.iter().any(|own| own.limited == stop.limited);
        let shared = self.stops.iter().filter(|stop| !is_own(stop));
        leg.stops.iter().chain(shared).copied().collect()
    }
}
