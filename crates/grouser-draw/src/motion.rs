//! Where rover and wheels are at every time of a run, from its records.
//!
//! ```
//! use grouser_core::paper;
//! use grouser_core::simulation::Run;
//! use grouser_draw::motion::Follower;
//!
//! let scenario = paper::traverse()?;
//! let mut follower = Follower::new(&scenario.rover);
//! let run = Run::new(&scenario)?.to_end()?;
//! let poses = run.records.iter().map(|record| follower.pose(&scenario, record));
//! let turned = poses.last().expect("a record").wheels[0].turned;
//! assert_eq!(format!("{:.1} turns", turned / std::f64::consts::TAU), "1.7 turns");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use grouser_core::elementary::wide;
use grouser_core::simulation::{Record, Scenario, Trajectory};
use grouser_core::units::{Vec2, Vec3};
use grouser_core::vehicle::{Mount, Posture, Rover, RoverState};

/// A rover at one time.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Time since the start [s].
    pub time: f64,
    /// The body's centre of mass, in the slope frame [m]; z is over the undisturbed surface. On
    /// ground with heights seen from the start, and z is the height.
    pub centre: Vec3,
    /// Yaw [rad].
    pub yaw: f64,
    /// Roll, positive with the right side down, and pitch, positive with the nose up, on ground
    /// with heights [rad].
    pub leaning: Option<[f64; 2]>,
    /// The wheels, in the mounts' order.
    pub wheels: Vec<WheelPose>,
}

/// A wheel at one time.
#[derive(Clone, Copy, Debug, Default)]
pub struct WheelPose {
    /// How far it has turned since the start [rad], positive forward.
    pub turned: f64,
    /// Steering angle [rad], positive to the left.
    pub steering: f64,
    /// Depth of its grouser tips [m].
    pub sinkage: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// The soil's force on it, in the wheel frame, which is that of its ground [N].
    pub force: Vec3,
    /// Where it is on ground with heights.
    pub standing: Option<StandingWheel>,
}

/// Where a wheel is on ground with heights, in the body frame.
#[derive(Clone, Copy, Debug)]
pub struct StandingWheel {
    /// Its hub [m].
    pub hub: Vec3,
    /// Forward along the wheel, on its ground.
    pub forward: Vec3,
    /// Along its axle, to the left.
    pub axle: Vec3,
    /// Out of the ground: upright to the axle as well, unless the ground falls across the wheel.
    pub normal: Vec3,
}

/// Follows a run record by record, and says where rover and wheels are.
#[derive(Clone, Debug, Default)]
pub struct Follower {
    wheels: Vec<WheelPose>,
    /// Angular speeds in the last record [rad/s].
    speeds: Vec<f64>,
    /// Time of the last record [s].
    time: Option<f64>,
    /// Height [m], roll and pitch [rad] of the last record on ground with heights that has them.
    stood: Option<(f64, [f64; 2])>,
}

impl Follower {
    /// Before the first record of a run.
    #[must_use]
    pub fn new(rover: &Rover) -> Self {
        let count = rover.wheel_count();
        let at_rest =
            |mount: &Mount| WheelPose { steering: mount.steering, ..WheelPose::default() };
        let wheels = rover.mounts().iter().map(at_rest).collect();
        Self { wheels, speeds: vec![0.0; count], time: None, stood: None }
    }

    /// The pose of the next record. A wheel turns by the mean of its speeds in this record and the
    /// last.
    ///
    /// * `scenario`: the same for all records
    pub fn pose(&mut self, scenario: &Scenario, record: &Record) -> Pose {
        let step = self.time.map_or(0.0, |time| record.time - time);
        self.time = Some(record.time);
        // The record in which a rover tips over has no wheels: they stay as they were.
        let wheels = self.wheels.iter_mut().zip(&mut self.speeds);
        for ((pose, speed), wheel) in wheels.zip(&record.wheels) {
            let forces = &wheel.reaction.settled.forces;
            *pose = WheelPose {
                turned: pose.turned + step * 0.5 * (*speed + wheel.wheel_speed),
                steering: wheel.steering,
                sinkage: wheel.reaction.settled.sinkage,
                slip_ratio: wheel.reaction.slip.ratio,
                force: Vec3::new(forces.drawbar_pull, forces.side_force, forces.normal_force),
                standing: pose.standing,
            };
            *speed = wheel.wheel_speed;
        }
        if record.wheels.is_empty() {
            for wheel in &mut self.wheels {
                wheel.force = Vec3::zeros();
            }
        }
        self.stand(scenario, record);
        let mut pose = pose_of(record, &scenario.rover, self.wheels.clone());
        if let Some((height, leaning)) = self.stood {
            pose.centre.z = height;
            pose.leaning = Some(leaning);
        }
        pose
    }

    /// Sets the rover on ground with heights. Where it has tipped over or left its map, it stays as
    /// it was.
    fn stand(&mut self, scenario: &Scenario, record: &Record) {
        let Some(standing) = record.standing() else { return };
        self.stood = Some((standing.height, [standing.roll, standing.pitch]));
        let ground = &scenario.ground;
        let angles: Vec<f64> = self.wheels.iter().map(|wheel| wheel.steering).collect();
        let sinkages: Vec<f64> = self.wheels.iter().map(|wheel| wheel.sinkage).collect();
        let state = &record.state;
        let steered = scenario.rover.steered(&angles).ok();
        let rover = steered.as_ref().unwrap_or(&scenario.rover);
        if let Ok(posture) = Posture::of(rover, ground, state.position, state.yaw, &sinkages) {
            let in_body = |vector: &Vec3| posture.ground_from_body.inverse() * vector;
            for (pose, wheel) in self.wheels.iter_mut().zip(&posture.wheels) {
                pose.standing = Some(StandingWheel {
                    hub: in_body(&wheel.hub),
                    forward: in_body(&wheel.forward),
                    axle: in_body(&wheel.axle),
                    normal: in_body(&wheel.normal),
                });
            }
        }
    }
}

/// A run as poses at the times of its records.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    poses: Vec<Pose>,
    /// How far downhill it has come, by each record [m].
    ways_down: Vec<f64>,
}

impl Motion {
    pub(crate) fn of(trajectory: &Trajectory, scenario: &Scenario) -> Self {
        let mut follower = Follower::new(&scenario.rover);
        let pose = |record| follower.pose(scenario, record);
        let poses = trajectory.records.iter().map(pose).collect();
        Self { poses, ways_down: ways_down(trajectory, scenario) }
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

    /// The pose at a time [s]: between two records all goes evenly; after the end it is that of the
    /// end.
    pub(crate) fn at(&self, time: f64) -> Pose {
        let after = self.poses.partition_point(|pose| pose.time < time);
        let Some(next) = self.poses.get(after) else { return self.poses[after - 1].clone() };
        let Some(last) = after.checked_sub(1).map(|before| &self.poses[before]) else {
            return next.clone();
        };
        last.between(next, time)
    }

    /// How far downhill the rover has come by a time [s], along the ground [m].
    pub(crate) fn way_down(&self, time: f64) -> f64 {
        let after = self.poses.partition_point(|pose| pose.time < time);
        let (Some(next), Some(before)) = (self.poses.get(after), after.checked_sub(1)) else {
            return self.ways_down[after.min(self.poses.len() - 1)];
        };
        let [from, to] = [self.poses[before].time, next.time];
        let [down, further] = [self.ways_down[before], self.ways_down[after]];
        down + (time - from) / (to - from) * (further - down)
    }
}

/// How far downhill a rover has come, by each record [m].
fn ways_down(trajectory: &Trajectory, scenario: &Scenario) -> Vec<f64> {
    let mut before: Option<(Vec2, f64)> = None;
    let mut start = 0.0;
    let way = |record: &Record| {
        let state = &record.state;
        let down = scenario.way_down(before.unwrap_or((state.position, 0.0)), state);
        if before.is_none() {
            start = down;
        }
        before = Some((state.position, down));
        down - start
    };
    trajectory.records.iter().map(way).collect()
}

/// The body stays parallel to the slope, as in the model; its height is the mean of what its wheels
/// leave.
fn pose_of(record: &Record, rover: &Rover, wheels: Vec<WheelPose>) -> Pose {
    let mounts = rover.mounts();
    let heights = mounts.iter().zip(&wheels);
    let sum: f64 = heights
        .map(|(mount, wheel)| mount.shearing_radius() - wheel.sinkage - mount.position.z)
        .sum();
    let RoverState { position, yaw, .. } = record.state;
    let centre = Vec3::new(position.x, position.y, sum / mounts.len() as f64);
    Pose { time: record.time, centre, yaw, leaning: None, wheels }
}

/// The rotation that takes the coordinates' axes into others, as a quaternion: x, y, z and w.
///
/// * `axes`: unit vectors, at right angles
#[must_use]
pub fn quaternion_to([x, y, z]: [Vec3; 3]) -> [f64; 4] {
    // Of four formulas the one that divides by the largest part (Shepperd 1978).
    let trace = x.x + y.y + z.z;
    let parts = [x.x, y.y, z.z, trace];
    let largest = (0..4).fold(0, |most, part| if parts[part] > parts[most] { part } else { most });
    let (q, size) = match largest {
        0 => ([1.0 + x.x - y.y - z.z, y.x + x.y, z.x + x.z, y.z - z.y], 1.0 + x.x - y.y - z.z),
        1 => ([y.x + x.y, 1.0 - x.x + y.y - z.z, z.y + y.z, z.x - x.z], 1.0 - x.x + y.y - z.z),
        2 => ([z.x + x.z, z.y + y.z, 1.0 - x.x - y.y + z.z, x.y - y.x], 1.0 - x.x - y.y + z.z),
        _ => ([y.z - z.y, z.x - x.z, x.y - y.x, 1.0 + trace], 1.0 + trace),
    };
    q.map(|part| 0.5 * part / size.sqrt())
}

/// Rotations over time as quaternions, of the two of each the one nearer to that before.
pub(crate) fn rotations(poses: &[Pose], of: impl Fn(&Pose) -> [f64; 4]) -> Vec<f64> {
    let mut last: Option<[f64; 4]> = None;
    let mut all = Vec::with_capacity(4 * poses.len());
    for pose in poses {
        let mut next = of(pose);
        if last.is_some_and(|last| last.iter().zip(&next).map(|(a, b)| a * b).sum::<f64>() < 0.0) {
            next = next.map(|part| -part);
        }
        all.extend(next);
        last = Some(next);
    }
    all
}

impl WheelPose {
    /// The soil's force on it along its forward direction, its axle and upright to both [N].
    #[must_use]
    pub fn force_in_wheel(&self) -> Vec3 {
        let Some(standing) = &self.standing else { return self.force };
        let [forward, left, normal] = standing.ground_in_wheel();
        forward * self.force.x + left * self.force.y + normal * self.force.z
    }
}

impl StandingWheel {
    fn between(&self, next: &Self, share: f64) -> Self {
        let between = |a: Vec3, b: Vec3| a + share * (b - a);
        let direction = |a: Vec3, b: Vec3| between(a, b).try_normalize(1e-9).unwrap_or(b);
        Self {
            hub: between(self.hub, next.hub),
            forward: direction(self.forward, next.forward),
            axle: direction(self.axle, next.axle),
            normal: direction(self.normal, next.normal),
        }
    }

    /// Forward, to the left on the ground and out of it, the axes of the soil's force, each along
    /// the wheel's forward direction, its axle and upright to both.
    #[must_use]
    pub fn ground_in_wheel(&self) -> [Vec3; 3] {
        let Self { forward, axle, normal, .. } = self;
        let up = forward.cross(axle);
        let in_wheel = |it: &Vec3| Vec3::new(it.dot(forward), it.dot(axle), it.dot(&up));
        [*forward, normal.cross(forward), *normal].each_ref().map(in_wheel)
    }
}

impl Pose {
    /// The pose at a time [s] between this one and a later one: between the two all goes evenly.
    #[must_use]
    pub fn between(&self, next: &Self, time: f64) -> Self {
        let share = (time - self.time) / (next.time - self.time);
        let between = |a: f64, b: f64| a + share * (b - a);
        let wheels = self.wheels.iter().zip(&next.wheels).map(|(a, b)| WheelPose {
            turned: between(a.turned, b.turned),
            steering: between(a.steering, b.steering),
            sinkage: between(a.sinkage, b.sinkage),
            slip_ratio: between(a.slip_ratio, b.slip_ratio),
            force: a.force + share * (b.force - a.force),
            standing: a.standing.zip(b.standing).map(|(a, b)| a.between(&b, share)),
        });
        Self {
            time,
            centre: self.centre + share * (next.centre - self.centre),
            yaw: between(self.yaw, next.yaw),
            leaning: self.leaning.zip(next.leaning).map(|([roll, pitch], [to_roll, to_pitch])| {
                [between(roll, to_roll), between(pitch, to_pitch)]
            }),
            wheels: wheels.collect(),
        }
    }

    /// A wheel's hub, in the body frame [m]: its mount has its place, its sinkage the height; on
    /// ground with heights it is where the suspension has it.
    ///
    /// * `index`: of the mount
    #[must_use]
    pub fn hub_in_body(&self, mount: &Mount, index: usize) -> Vec3 {
        let WheelPose { sinkage, steering, standing, .. } = self.wheels[index];
        if let Some(standing) = standing {
            return standing.hub;
        }
        let height = mount.shearing_radius() - sinkage - self.centre.z;
        let hub = mount.at_angle(steering).position;
        Vec3::new(hub.x, hub.y, height)
    }

    /// A wheel's direction forward and that of its axle, to the left, in the body frame.
    ///
    /// * `index`: of the mount
    #[must_use]
    pub fn wheel_in_body(&self, mount: &Mount, index: usize) -> [Vec3; 2] {
        let WheelPose { steering, standing, .. } = self.wheels[index];
        if let Some(StandingWheel { forward, axle, .. }) = standing {
            return [forward, axle];
        }
        let mount = mount.at_angle(steering);
        [Vec2::x(), Vec2::y()].map(|axis| mount.body_from_wheel(axis).push(0.0))
    }

    /// The body's x, y and z axes, in the frame of its centre.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 3] {
        let [roll, pitch] = self.leaning.unwrap_or_default();
        let [(sin_y, cos_y), (sin_p, cos_p), (sin_r, cos_r)] =
            [self.yaw, pitch, roll].map(wide::sin_cos);
        let forward = Vec3::new(cos_p * cos_y, cos_p * sin_y, sin_p);
        let level_left = Vec3::new(-sin_y, cos_y, 0.0);
        let upright = forward.cross(&level_left);
        let left = cos_r * level_left + sin_r * upright;
        [forward, left, forward.cross(&left)]
    }

    /// The mean of a quantity over the wheels.
    pub(crate) fn mean(&self, of: impl Fn(&WheelPose) -> f64) -> f64 {
        self.wheels.iter().map(of).sum::<f64>() / self.wheels.len() as f64
    }

    /// A vector of the body frame, in the slope frame.
    pub(crate) fn slope_from_body(&self, vector: Vec2) -> Vec2 {
        RoverState { yaw: self.yaw, ..RoverState::default() }.slope_from_body() * vector
    }
}
