//! Trajectories in the words of tables, JSON and CSV.

use serde::Serialize;

use super::study::WheelRecord;
use crate::simulation::{self, Record, Trajectory};
use crate::vehicle::Rover;

/// A run: outcome, end and samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TrajectoryRecord {
    /// `completed`, `immobilised`, `sliding` or `tipped_over`.
    pub outcome: &'static str,
    /// What that means here; null for a completed run.
    pub reason: Option<String>,
    /// How it was computed: `dynamic`, `quasi-steady`, or `fell-back` from the second to the first.
    pub simulation: &'static str,
    /// Since when and why it fell back; null if it did not.
    pub simulation_reason: Option<String>,
    /// Work of the motors over the run [J].
    pub energy_j: f64,
    /// What the energy books cannot account for [J].
    pub energy_error_j: f64,
    /// The last sample.
    #[serde(rename = "final")]
    pub end: SampleRecord,
    /// All samples.
    pub samples: Vec<SampleRecord>,
}

/// The rover at one time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampleRecord {
    /// Time [s].
    pub time_s: f64,
    /// Along the contour [m].
    pub x_m: f64,
    /// Uphill [m].
    pub y_m: f64,
    /// Yaw [°], positive where the nose points uphill.
    pub yaw_deg: f64,
    /// Speed along the body [m/s].
    pub forward_speed_m_s: f64,
    /// Speed across the body [m/s], positive to the left.
    pub lateral_speed_m_s: f64,
    /// Yaw rate [°/s].
    pub yaw_rate_deg_s: f64,
    /// Power of all motors [W].
    pub power_w: f64,
    /// Work of the motors so far [J].
    pub energy_j: f64,
    /// Work done on the soil so far [J].
    pub soil_energy_j: f64,
    /// Kinetic energy [J].
    pub kinetic_energy_j: f64,
    /// Potential energy, zero at the start's height [J].
    pub potential_energy_j: f64,
    /// Each wheel; none where the rover has just tipped over or sunk.
    pub wheels: Vec<WheelSampleRecord>,
}

/// A wheel at one time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WheelSampleRecord {
    /// The wheel's name.
    pub wheel: String,
    /// Angular speed [rad/s].
    pub wheel_speed_rad_s: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// Slip angle [°].
    pub slip_angle_deg: f64,
    /// Load [N].
    pub load_n: f64,
    /// Power of its motor [W].
    pub power_w: f64,
    /// Sinkage, forces and moments.
    #[serde(flatten)]
    pub forces: WheelRecord,
}

impl TrajectoryRecord {
    /// The record of a rover's run.
    #[must_use]
    pub fn new(run: &Trajectory, rover: &Rover) -> Self {
        Self {
            outcome: run.outcome.name(),
            reason: run.outcome.reason(),
            simulation: run.method.name(),
            simulation_reason: run.method.reason(),
            energy_j: run.last().energy.motors,
            energy_error_j: run.energy_error(),
            end: SampleRecord::new(run.last(), rover),
            samples: run.records.iter().map(|sample| SampleRecord::new(sample, rover)).collect(),
        }
    }
}

impl SampleRecord {
    /// The record of a rover at one time.
    #[must_use]
    pub fn new(sample: &Record, rover: &Rover) -> Self {
        let wheels = sample.wheels.iter().zip(rover.mounts());
        let wheels = wheels.map(|(wheel, mount)| WheelSampleRecord::new(wheel, &mount.name));
        Self { wheels: wheels.collect(), ..Self::of_body(sample) }
    }

    /// The same, without what each wheel does.
    #[must_use]
    pub fn of_body(sample: &Record) -> Self {
        let (state, energy) = (&sample.state, &sample.energy);
        Self {
            time_s: sample.time,
            x_m: state.position.x,
            y_m: state.position.y,
            yaw_deg: state.yaw.to_degrees(),
            forward_speed_m_s: state.velocity.x,
            lateral_speed_m_s: state.velocity.y,
            yaw_rate_deg_s: state.yaw_rate.to_degrees(),
            power_w: sample.wheels.iter().map(simulation::WheelRecord::power).sum(),
            energy_j: energy.motors,
            soil_energy_j: energy.soil,
            kinetic_energy_j: energy.kinetic,
            potential_energy_j: energy.potential,
            wheels: Vec::new(),
        }
    }
}

impl WheelSampleRecord {
    fn new(wheel: &simulation::WheelRecord, name: &str) -> Self {
        let reaction = &wheel.reaction;
        Self {
            wheel: name.into(),
            wheel_speed_rad_s: wheel.wheel_speed,
            slip_ratio: reaction.slip.ratio,
            slip_angle_deg: reaction.slip.angle.to_degrees(),
            load_n: reaction.load,
            power_w: wheel.power(),
            forces: WheelRecord::new(&reaction.settled),
        }
    }
}
