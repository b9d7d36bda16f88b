//! One look at the rover in time.

use super::equations::Equations;
use super::point::Point;
use super::power::{self, EnergyBalance};
use super::supply::{Charge, Supply};
use crate::units::Vec2;
use crate::vehicle::posture::Attitude;
use crate::vehicle::{Electrical, RoverState, WheelReaction};

/// The rover at one time.
///
/// Which wheel carries most after 10 s across a slope, and what power does its motor give?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::Run;
///
/// let scenario = paper::traverse()?;
/// let trajectory = Run::new(&scenario)?.to_end()?;
/// let record = &trajectory.records[100];
/// assert_eq!(format!("{:.1} s", record.time), "10.0 s");
/// let loads = record.wheels.iter().map(|wheel| wheel.reaction.load);
/// let (most, load) = loads.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).expect("four wheels");
/// assert_eq!(scenario.rover.mounts()[most].name, "rear-right");
/// assert_eq!(format!("{load:.1} N"), "19.3 N");
/// assert_eq!(format!("{:.0} mW", 1e3 * record.wheels[most].power()), "101 mW");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time since the start [s].
    pub time: f64,
    /// Pose and velocity.
    pub state: RoverState,
    /// Where the run started, in the coordinates of ground with heights [m]; none on a plane.
    /// Positions are seen from there.
    pub origin: Option<Vec2>,
    /// How it stands on uneven ground, or on a suspension.
    pub attitude: Option<Attitude>,
    /// By how much the weight may turn there before the rover tips over, the force-angle margin
    /// [rad].
    pub stability_margin: Option<f64>,
    /// Least height of its underside over ground with heights, its
    /// [belly clearance](crate::vehicle::belly) [m]; none where the rover's document says nothing
    /// of it.
    pub belly_clearance: Option<f64>,
    /// Each wheel, in the mounts' order; none where a rover has just tipped over or sunk.
    pub wheels: Vec<WheelRecord>,
    /// Energy since the start.
    pub energy: EnergyBalance,
    /// The battery, where it is known.
    pub battery: Option<Charge>,
}

impl Record {
    /// The rover at a point of its run; without wheels where those do not settle.
    pub(super) fn new(
        equations: &Equations<'_>,
        time: f64,
        point: &Point,
        wheels: &[WheelReaction],
        supply: Option<&Supply>,
    ) -> Self {
        let (rover, state) = (equations.rover(), point.state);
        let sunk = equations.sunk(&state, wheels);
        let wheel_speeds: Vec<f64> = rover.wheel_speeds(equations.turning(point)).collect();
        let spin = power::spin_energy(rover, &wheel_speeds);
        let energy = EnergyBalance {
            // A spin that depends on the load is no jump: what it takes is seen by what it is.
            motors: point.motors + if point.turning.is_some() { spin } else { 0.0 },
            soil: point.soil,
            kinetic: power::kinetic_energy(rover, &state) + spin,
            potential: equations.potential_energy(&state),
            electrical: point.electrical + supply.map_or(0.0, Supply::beside),
        };
        let taken = equations.taken(point, wheels);
        let warm = supply.map(|supply| {
            let taken: Vec<_> = taken.iter().map(|it| it.unwrap_or_default()).collect();
            supply.warm(rover, &taken)
        });
        let each = wheels.iter().zip(wheel_speeds).zip(taken).enumerate();
        let wheels = each.map(|(wheel, ((&reaction, wheel_speed), cold))| WheelRecord {
            wheel_speed,
            steering: rover.mounts()[wheel].steering,
            reaction,
            electrical: cold.map(|cold| warm.as_ref().map_or(cold, |warm| warm[wheel].taken)),
            temperature: supply.and_then(|supply| supply.temperature(wheel)),
        });
        let wheels = wheels.collect();
        let battery = supply.and_then(Supply::battery);
        let origin = equations.origin();
        Self {
            time,
            state,
            origin,
            attitude: sunk.as_ref().map(|sunk| sunk.attitude),
            stability_margin: sunk.as_ref().map(|sunk| sunk.stability_margin),
            belly_clearance: sunk.and_then(|sunk| sunk.belly_clearance),
            wheels,
            energy,
            battery,
        }
    }

    /// Where the body's centre of mass is, seen from above [m]: in the coordinates of ground with
    /// heights, or in the slope frame.
    #[must_use]
    pub fn place(&self) -> Vec2 {
        self.origin.map_or(self.state.position, |origin| origin + self.state.position)
    }

    /// How it stands on ground with heights; none on a plane.
    #[must_use]
    pub fn standing(&self) -> Option<&Attitude> {
        self.attitude.as_ref().filter(|_| self.origin.is_some())
    }
}

/// A wheel at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelRecord {
    /// Angular speed, *ω* [rad/s].
    pub wheel_speed: f64,
    /// Steering angle, *δ* [rad], positive to the left.
    pub steering: f64,
    /// Slip, load, sinkage and forces.
    pub reaction: WheelReaction,
    /// What its motor takes, where that is known.
    pub electrical: Option<Electrical>,
    /// Temperature of its motor's winding, where that is known [°C].
    pub temperature: Option<f64>,
}

impl WheelRecord {
    /// Power of the motor, T ω [W].
    #[must_use]
    pub fn power(&self) -> f64 {
        self.reaction.settled.forces.torque * self.wheel_speed
    }
}
