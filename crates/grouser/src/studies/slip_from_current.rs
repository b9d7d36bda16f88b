//! The slip ratio of each wheel from its motor's current and speed.
//!
//! The current gives the torque on the wheel ([`Motor::torque`](crate::vehicle::Motor::torque)),
//! and in the soil a torque belongs to a slip ratio; [Ojeda2006] has a straight line in place of
//! the soil:
//!
//! ```text
//! i, ω → T_i        p(s | T_i) ∝ (1/M) Σ_m N(T_i; T_m(s), σ(T_m(s)))        σ(T)² = (q T)² + σ_0²
//! ```
//!
//! with a uniform prior over the slip ratios asked for. *T_m(s)* is the torque of the settled wheel
//! in the *m*-th sample of soil and model, under its load and at its slip angle; one sample where
//! the soil is taken as known. The estimate is the median of that, and its interval the middle 95
//! %.
//!
//! Where torque hardly changes with slip the interval is wide, and the estimate says so:
//! [`SlipStatus::IllPosed`]. Each reading stands alone. What one says of an uncertain soil is not
//! used for the next.

mod agreement;
mod posterior;
mod torque_table;

use std::borrow::Cow;

pub use self::agreement::Agreement;
use self::posterior::{Posterior, posterior};
use self::torque_table::TorqueTable;
use super::ensemble::samples::Sample;
use super::ensemble::{Band, outputs_while};
use crate::contact::{Slip, WheelForces};
use crate::elementary::wide;
use crate::error::{ParameterError, finite, not_negative};
use crate::simulation::Scenario;
use crate::terrain::Ground;
use crate::units::Vec2;
use crate::vehicle::load::{self, Tipping};
use crate::vehicle::{LoadSharing, Mount, OwnMoments, Rover, RoverState, SteeringAxis};
pub use grouser_io::measurements::motor_log::{MotorLog, MotorReading, MotorRecord};

/// Standard deviation of a torque that a current gives: σ(T)² = (q T)² + σ_0².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueNoise {
    /// Its part in proportion to the torque, *q* [-].
    pub relative: f64,
    /// Its part that is always there, *σ_0* [N·m].
    pub absolute: f64,
}

impl TorqueNoise {
    /// 5 % and 0.005 N·m. Source: assumed, for a micro rover's motors.
    pub const USUAL: Self = Self { relative: 0.05, absolute: 0.005 };

    /// Returns the standard deviation [N·m] of a torque [N·m].
    fn of(self, torque: f64) -> f64 {
        wide::hypot(self.relative * torque, self.absolute)
    }
}

/// What an estimate rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipSettings {
    /// How well currents give torques.
    pub noise: TorqueNoise,
    /// The slip ratios that are possible, lowest and highest, while the wheel turns forward [-].
    pub slips: [f64; 2],
}

impl SlipSettings {
    /// Slip ratios from −0.2 to 1.
    pub const USUAL: Self = Self { noise: TorqueNoise::USUAL, slips: [-0.2, 1.0] };

    /// Checks that slip can be estimated with these settings.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        not_negative("relative noise of the torque", self.noise.relative)?;
        not_negative("absolute noise of the torque [N·m]", self.noise.absolute)?;
        if self.noise.relative + self.noise.absolute == 0.0 {
            let expected = "above 0 where the absolute noise is 0";
            return Err(ParameterError::new("relative noise of the torque", 0.0, expected));
        }
        for slip in self.slips {
            finite("slip ratio", slip)?;
            if !(-1.0..=1.0).contains(&slip) {
                return Err(ParameterError::new("slip ratio", slip, "from -1 to 1"));
            }
        }
        let [low, high] = self.slips;
        if low >= high {
            return Err(ParameterError::new("highest slip ratio", high, "above the lowest"));
        }
        Ok(())
    }
}

/// How wide an interval may be before its estimate is ill-posed [-]. Source: ours; half of the slip
/// at which rovers stop.
pub const WIDEST: f64 = 0.2;

/// Whether a current gives the slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipStatus {
    /// The interval is narrow.
    Ok,
    /// The interval is wider than [`WIDEST`].
    IllPosed,
    /// The wheel stands.
    Standing,
    /// The wheel would drive its motor, and the gear lets nothing through.
    SelfLocking,
    /// More torque than the soil gives at any slip ratio asked for.
    TorqueTooHigh,
    /// Less torque than that.
    TorqueTooLow,
    /// The soil does not carry the wheel.
    NotCarried,
    /// The wheel carries nothing.
    Unloaded,
    /// The loads are not known: the weight falls outside the wheels.
    Tipping,
}

impl SlipStatus {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Ok,
        Self::IllPosed,
        Self::Standing,
        Self::SelfLocking,
        Self::TorqueTooHigh,
        Self::TorqueTooLow,
        Self::NotCarried,
        Self::Unloaded,
        Self::Tipping,
    ];

    /// One word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::IllPosed => "ill-posed",
            Self::Standing => "standing",
            Self::SelfLocking => "self-locking",
            Self::TorqueTooHigh => "torque-too-high",
            Self::TorqueTooLow => "torque-too-low",
            Self::NotCarried => "not-carried",
            Self::Unloaded => "unloaded",
            Self::Tipping => "tipping",
        }
    }

    /// What it means for an operator.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Ok => "the current gives the slip to 0.2 or better",
            Self::IllPosed => {
                "the current does not give the slip: slip ratios more than 0.2 apart go with it, \
                 because torque hardly changes with slip here, or the soil is not known well enough"
            }
            Self::Standing => {
                "the wheel stands: there is no slip, and the current says nothing of it"
            }
            Self::SelfLocking => {
                "the ground drives the wheel, and the self-locking gear keeps that from the motor: \
                 the current says nothing of the slip"
            }
            Self::TorqueTooHigh => {
                "more torque than this soil gives at any slip: a rock, a harder soil, a larger \
                 load, or a motor with more friction"
            }
            Self::TorqueTooLow => {
                "less torque than this soil gives at any slip: a softer or looser soil, a smaller \
                 load, or a wheel that is pushed faster"
            }
            Self::NotCarried => "this soil does not carry the wheel under its load at any slip",
            Self::Unloaded => "the wheel carries nothing, so that no slip makes a torque",
            Self::Tipping => {
                "the loads are not known: the weight falls outside the wheels on this slope"
            }
        }
    }
}

/// What a current says of a wheel's slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipEstimate {
    /// Whether it gives the slip.
    pub status: SlipStatus,
    /// Torque on the wheel, from the current [N·m]; nothing where the current does not give it.
    pub torque: Option<f64>,
    /// Load on the wheel [N].
    pub load: Option<f64>,
    /// Slip angle, *β* [rad].
    pub slip_angle: f64,
    /// Slip ratio, *s* [-], with the sign of the rim's motion: negative while a wheel that turns
    /// backward drives. Nothing unless the status is [`Ok`](SlipStatus::Ok) or
    /// [`IllPosed`](SlipStatus::IllPosed).
    pub slip_ratio: Option<Band>,
}

impl SlipEstimate {
    /// Width of the interval [-].
    #[must_use]
    pub fn width(&self) -> Option<f64> {
        self.slip_ratio.map(|band| band.high - band.low)
    }

    /// Whether a slip ratio lies in the interval; nothing without one.
    #[must_use]
    pub fn holds(&self, slip_ratio: f64) -> Option<bool> {
        self.slip_ratio.map(|band| (band.low..=band.high).contains(&slip_ratio))
    }
}

/// Why there is no estimator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoEstimator {
    /// No wheel has a motor that is known.
    #[error(
        "no wheel of the rover has a [motor], so that a current says nothing of its torque: add \
         [motor] to its document, with resistance_ohm, torque_constant_nm_a, gear_ratio, \
         gear_efficiency and friction_torque_nm"
    )]
    NoMotor,
    /// A value is out of its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// Estimates slip from currents, reading by reading.
///
/// The first reading near a load and slip angle settles wheels, some hundred for each sample of the
/// soil; the torques are kept, and the next readings there interpolate between them. What is kept
/// changes the cost, and no result.
///
/// How much does HAKUTO's front wheel slip on level Toyoura sand, if its motor takes 213 mA?
///
/// ```
/// use grouser::document::{self, Overrides, Source};
/// use grouser::studies::slip_from_current::{MotorReading, MotorRecord, SlipEstimator, SlipSettings};
/// use grouser::vehicle::{Motor, Rover};
///
/// let mut scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
/// let mut parts = scenario.rover.parts().clone();
/// parts.wheel_unit.motor = Some(Motor {
///     resistance: 10.0,
///     torque_constant: 0.010,
///     gear_ratio: 250.0,
///     efficiency: 0.6,
///     friction: 1e-3,
///     is_self_locking: false,
///     feeds_back: false,
///     control: None,
///     winding: None,
/// });
/// scenario.rover = Rover::draft(parts).checked()?;
///
/// let estimator = SlipEstimator::new(&scenario, Vec::new(), SlipSettings::USUAL)?;
/// let reading = MotorReading { current: 0.213, wheel_speed: 0.55, load: Some(17.0), ..MotorReading::default() };
/// let record = MotorRecord { wheels: vec![Some(reading)], ..MotorRecord::default() };
/// let slip = estimator.estimate(&record)[0].expect("a reading").slip_ratio.expect("it is driven");
/// assert_eq!(format!("{:.2}, {:.2} to {:.2}", slip.median, slip.low, slip.high), "0.06, 0.05 to 0.07");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SlipEstimator {
    rover: Rover,
    ground: Ground,
    gravity: f64,
    sharing: LoadSharing,
    own_moments: OwnMoments,
    settings: SlipSettings,
    table: TorqueTable,
}

impl SlipEstimator {
    /// An estimator for a scenario's rover, soil, gravity, model and load transfer; its slope
    /// counts where a record has none, and its drive does not.
    ///
    /// * `samples`: of an uncertain soil and model; none to take the scenario's as known
    ///
    /// # Errors
    /// [`NoEstimator`] if no wheel has a motor, or a setting is out of its range.
    pub fn new(
        scenario: &Scenario,
        samples: Vec<Sample>,
        settings: SlipSettings,
    ) -> Result<Self, NoEstimator> {
        if !scenario.rover.has_motors() {
            return Err(NoEstimator::NoMotor);
        }
        settings.check()?;
        let &Scenario { ref ground, gravity, ref model, .. } = scenario;
        let known = || vec![Sample { soil: ground.soil, model: model.clone() }];
        let samples = if samples.is_empty() { known() } else { samples };
        let table = TorqueTable::new(&scenario.rover, gravity, samples, settings.slips);
        Ok(Self {
            rover: scenario.rover.clone(),
            ground: ground.clone(),
            gravity,
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
            settings,
            table,
        })
    }

    /// The rover.
    #[must_use]
    pub fn rover(&self) -> &Rover {
        &self.rover
    }

    /// The slip of each wheel of a record, in the mounts' order; nothing for a wheel without a
    /// reading or motor.
    ///
    /// Where a reading has no load, that follows from the slope and yaw of the record and the
    /// torques of all wheels, in steady motion. Where it has no slip angle, that follows from yaw
    /// and course; without a course the rover goes where it points. A steering angle beyond its
    /// wheel's limit counts as the limit, and one of a wheel that is not steered as none.
    #[must_use]
    pub fn estimate(&self, record: &MotorRecord) -> Vec<Option<SlipEstimate>> {
        let mut felt = self.felt(record);
        for wheel in felt.iter_mut().flatten() {
            self.complete(wheel);
        }
        felt.into_iter().map(|wheel| Some(wheel?.estimate)).collect()
    }

    /// Estimates all records of a log, in their order; nothing if `go_on` was false before the end.
    /// Records are shared among threads: the result is the same for any number of them.
    ///
    /// * `go_on`: asked before each of [`log_steps`](Self::log_steps), from any thread
    #[must_use]
    pub fn of_log(
        &self,
        log: &MotorLog,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Vec<Option<SlipEstimate>>>> {
        // The table first, so that no two threads fill the same place of it.
        let needed = log.records.iter().flat_map(|record| self.felt(record)).flatten();
        let needed = needed.filter(|wheel| wheel.torque.is_some());
        self.table.fill(needed.map(|wheel| wheel.place), go_on)?;
        outputs_while(&log.records, go_on, |record| self.estimate(record))
    }

    /// How often [`of_log`](Self::of_log) asks whether to go on, at most.
    #[must_use]
    pub fn log_steps(&self, log: &MotorLog) -> usize {
        let needed = log.records.iter().flat_map(|record| self.felt(record)).flatten();
        let needed = needed.filter(|wheel| wheel.torque.is_some());
        log.records.len() + self.table.missing(needed.map(|wheel| wheel.place)).len()
    }

    /// What each wheel feels, without what the soil makes of it.
    fn felt(&self, record: &MotorRecord) -> Vec<Option<Felt>> {
        let slope = record.slope.or(self.ground.plane_slope()).unwrap_or(0.0);
        let rover = self.steered(record);
        let loads = self.loads(&rover, record, slope);
        let wheels = rover.mounts().iter().enumerate().map(|(place, mount)| {
            let (motor, reading) = (mount.unit.motor?, (*record.wheels.get(place)?)?);
            let slip_angle = reading.slip_angle.unwrap_or_else(|| slip_angle(mount, record));
            let load = reading.load.or(loads.as_ref().ok().map(|loads| loads[place]));
            let torque = motor.torque(reading.current, reading.wheel_speed);
            let status = if reading.wheel_speed.abs() * mount.shearing_radius() < STANDS {
                Some(SlipStatus::Standing)
            } else if torque.is_none() {
                Some(SlipStatus::SelfLocking)
            } else {
                match load {
                    None => Some(SlipStatus::Tipping),
                    Some(load) if load < LIGHTEST => Some(SlipStatus::Unloaded),
                    Some(_) => None,
                }
            };
            let sense = 1.0_f64.copysign(reading.wheel_speed);
            Some(Felt {
                place: torque_table::Place::of(place, load.unwrap_or(0.0), slip_angle, slope),
                // As of a wheel that turns forward; nothing where there is no more to find.
                torque: torque.filter(|_| status.is_none()).map(|torque| sense * torque),
                sense,
                is_self_locking: motor.is_self_locking,
                estimate: SlipEstimate {
                    status: status.unwrap_or(SlipStatus::Ok),
                    torque,
                    load,
                    slip_angle,
                    slip_ratio: None,
                },
            })
        });
        wheels.collect()
    }

    /// The slip of a wheel whose torque is known.
    fn complete(&self, wheel: &mut Felt) {
        let Some(torque) = wheel.torque else { return };
        let mut curves = self.table.curves(wheel.place);
        if wheel.is_self_locking {
            // Through such a gear the motor feels no torque below 0. What is not a number stays so.
            let driven = curves.iter_mut().flatten().filter(|torque| **torque < 0.0);
            driven.for_each(|torque| *torque = 0.0);
        }
        let (noise, slips) = (self.settings.noise, self.settings.slips);
        match posterior(&curves, torque, |torque| noise.of(torque), slips) {
            Posterior::Band(band) => {
                let estimate = &mut wheel.estimate;
                estimate.slip_ratio = Some(if wheel.sense > 0.0 {
                    band
                } else {
                    Band { low: -band.high, median: -band.median, high: -band.low }
                });
                if band.high - band.low > WIDEST {
                    estimate.status = SlipStatus::IllPosed;
                }
            }
            Posterior::Above => wheel.estimate.status = SlipStatus::TorqueTooHigh,
            Posterior::Below => wheel.estimate.status = SlipStatus::TorqueTooLow,
            Posterior::Nowhere => wheel.estimate.status = SlipStatus::NotCarried,
        }
    }

    /// Loads of all wheels [N] in steady motion, where the wheels' forces hold the weight's pull.
    ///
    /// The law of the scenario shares the weight. Its torques are those of the motors, and its
    /// forces equal shares of what holds the pull; a wheel whose torque is not known has that of
    /// its force. Overturning moments are those of forces in the contact plane.
    fn loads(&self, rover: &Rover, record: &MotorRecord, slope: f64) -> Result<Vec<f64>, Tipping> {
        let plane = self.ground.with_slope(slope);
        let state = RoverState { yaw: record.yaw.unwrap_or(0.0), ..RoverState::default() };
        let pull = load::slope_pull(rover, &plane, self.gravity, &state);
        let share = -pull / rover.mounts().len() as f64;
        let forces = rover.mounts().iter().enumerate().map(|(place, mount)| {
            let (force, radius) = (mount.wheel_from_body(share), mount.shearing_radius());
            let reading = record.wheels.get(place).copied().flatten();
            let torque =
                mount.unit.motor.zip(reading).and_then(|(motor, reading)| {
                    motor.torque(reading.current, reading.wheel_speed)
                });
            WheelForces {
                drawbar_pull: force.x,
                side_force: force.y,
                torque: torque.unwrap_or(radius * force.x),
                overturning_moment: radius * force.y,
                ..WheelForces::default()
            }
        });
        let forces: Vec<WheelForces> = forces.collect();
        let moments = load::moments(rover, pull, self.sharing, self.own_moments, &forces);
        let weight = load::weight(rover, &plane, self.gravity, &state, &state.slope_from_body());
        load::wheel_loads(rover, self.sharing, weight.into, moments)
    }

    /// The rover with its wheels steered as in a record.
    fn steered(&self, record: &MotorRecord) -> Cow<'_, Rover> {
        let read = |place: usize| (*record.wheels.get(place)?)?.steering;
        let mounts = self.rover.mounts();
        let angles: Vec<f64> = (0..mounts.len())
            .map(|place| {
                let Mount { steering, steering_axis, .. } = &mounts[place];
                let within = |axis: &SteeringAxis| {
                    read(place).map(|angle| angle.clamp(-axis.limit, axis.limit))
                };
                steering_axis.as_ref().and_then(within).unwrap_or(*steering)
            })
            .collect();
        if angles == self.rover.steering_angles() {
            return Cow::Borrowed(&self.rover);
        }
        // Within its limits a rover can be steered.
        self.rover.steered(&angles).map_or(Cow::Borrowed(&self.rover), Cow::Owned)
    }
}

/// Slip angle of a wheel whose rover holds a course without turning [rad].
fn slip_angle(mount: &Mount, record: &MotorRecord) -> f64 {
    let yaw = record.yaw.unwrap_or(0.0);
    let crab = record.course.map_or(0.0, |course| course - yaw);
    let (sin, cos) = wide::sin_cos(crab);
    let hub = mount.wheel_from_body(Vec2::new(cos, sin));
    Slip::of_motion(hub.x, hub).angle
}

/// Rims that are slower than this stand [m/s]: 0.1 mm/s.
const STANDS: f64 = 1e-4;

/// Wheels that carry less than this carry nothing [N].
const LIGHTEST: f64 = 1e-3;

/// What a wheel feels, and what is estimated of it.
struct Felt {
    place: torque_table::Place,
    /// Torque on a wheel that turns forward [N·m], if a slip follows from it.
    torque: Option<f64>,
    /// 1 forward, −1 backward.
    sense: f64,
    is_self_locking: bool,
    estimate: SlipEstimate,
}
