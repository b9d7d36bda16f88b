//! Where rover and wheels are at every time of a run, from its records.

use grouser_core::simulation::{Record, Scenario, Trajectory};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::RoverState;

/// A rover at one time.
#[derive(Clone, Debug)]
pub(crate) struct Pose {
    /// Time since the start [s].
    pub(crate) time: f64,
    /// The body's centre of mass, in the slope frame [m]; z is over the undisturbed surface.
    pub(crate) centre: Vec3,
    /// Yaw [rad].
    pub(crate) yaw: f64,
    /// The wheels, in the mounts' order.
    pub(crate) wheels: Vec<WheelPose>,
}

/// A wheel at one time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WheelPose {
    /// How far it has turned since the start [rad], positive forward.
    pub(crate) turned: f64,
    /// Depth of its grouser tips [m].
    pub(crate) sinkage: f64,
    /// Slip ratio [-].
    pub(crate) slip_ratio: f64,
    /// The soil's force on it, in the wheel frame [N].
    pub(crate) force: Vec3,
}

/// A run as poses at the times of its records.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    poses: Vec<Pose>,
}

impl Motion {
    pub(crate) fn of(trajectory: &Trajectory, scenario: &Scenario) -> Self {
        let mut poses: Vec<Pose> = Vec::with_capacity(trajectory.records.len());
        let mut speeds = vec![0.0; scenario.rover.wheel_count()];
        for record in &trajectory.records {
            let before = poses.last();
            let mut wheels = before.map_or_else(
                || vec![WheelPose::default(); speeds.len()],
                |pose| pose.wheels.clone(),
            );
            let step = before.map_or(0.0, |pose| record.time - pose.time);
            // The record in which a rover tips over has no wheels: they stay as they were.
            for ((pose, speed), wheel) in wheels.iter_mut().zip(&mut speeds).zip(&record.wheels) {
                let forces = &wheel.reaction.settled.forces;
                *pose = WheelPose {
                    turned: pose.turned + step * 0.5 * (*speed + wheel.wheel_speed),
                    sinkage: wheel.reaction.settled.sinkage,
                    slip_ratio: wheel.reaction.slip.ratio,
                    force: Vec3::new(forces.drawbar_pull, forces.side_force, forces.normal_force),
                };
                *speed = wheel.wheel_speed;
            }
            if record.wheels.is_empty() {
                for wheel in &mut wheels {
                    wheel.force = Vec3::zeros();
                }
            }
            poses.push(pose_of(record, scenario, wheels));
        }
        Self { poses }
    }

    pub(crate) fn start(&self) -> &Pose {
        &self.poses[0]
    }

    pub(crate) fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// How long it lasts [s].
    pub(crate) fn end(&self) -> f64 {
        self.poses[self.poses.len() - 1].time
    }

    /// The pose at a time [s]: between two records all goes evenly; after the end it is that of the end.
    pub(crate) fn at(&self, time: f64) -> Pose {
        let after = self.poses.partition_point(|pose| pose.time < time);
        let Some(next) = self.poses.get(after) else { return self.poses[after - 1].clone() };
        let Some(last) = after.checked_sub(1).map(|before| &self.poses[before]) else {
            return next.clone();
        };
        let share = (time - last.time) / (next.time - last.time);
        let between = |a: f64, b: f64| a + share * (b - a);
        let wheels = last.wheels.iter().zip(&next.wheels).map(|(a, b)| WheelPose {
            turned: between(a.turned, b.turned),
            sinkage: between(a.sinkage, b.sinkage),
            slip_ratio: between(a.slip_ratio, b.slip_ratio),
            force: a.force + share * (b.force - a.force),
        });
        Pose {
            time,
            centre: last.centre + share * (next.centre - last.centre),
            yaw: between(last.yaw, next.yaw),
            wheels: wheels.collect(),
        }
    }
}

/// The body stays parallel to the slope, as in the model; its height is the mean of what its wheels leave.
fn pose_of(record: &Record, scenario: &Scenario, wheels: Vec<WheelPose>) -> Pose {
    let mounts = scenario.rover.mounts();
    let heights = mounts.iter().zip(&wheels);
    let sum: f64 = heights
        .map(|(mount, wheel)| mount.shearing_radius() - wheel.sinkage - mount.position.z)
        .sum();
    let RoverState { position, yaw, .. } = record.state;
    let centre = Vec3::new(position.x, position.y, sum / mounts.len() as f64);
    Pose { time: record.time, centre, yaw, wheels }
}

impl Pose {
    /// The mean of a quantity over the wheels.
    pub(crate) fn mean(&self, of: impl Fn(&WheelPose) -> f64) -> f64 {
        self.wheels.iter().map(of).sum::<f64>() / self.wheels.len() as f64
    }

    /// A vector of the body frame, in the slope frame.
    pub(crate) fn slope_from_body(&self, vector: Vec2) -> Vec2 {
        RoverState { yaw: self.yaw, ..RoverState::default() }.slope_from_body() * vector
    }
}
