//! What the motors said on the stretches of a drive, beside the slip that was seen there.

use super::Lesson;
use super::stretch::Stretch;
use crate::elementary::wide::atan2;
use crate::units::Vec2;
use crate::vehicle::kinematics::wheel_slips;
use crate::vehicle::{Rover, RoverState};
use grouser_io::measurements::motor_log::{MotorLog, MotorReading, MotorRecord};

/// Records at most: of a longer drive stretches that are evenly spread.
const MOST: usize = 400;

/// A record for each stretch, with the slip of each wheel as odometry has it; nothing of a drive
/// without currents.
#[must_use]
pub fn motor_log(lessons: &[Lesson], rover: &Rover) -> Option<MotorLog> {
    let step = lessons.len().div_ceil(MOST).max(1);
    let stretches = lessons.iter().step_by(step).map(|it| &it.stretch);
    let records: Vec<MotorRecord> = stretches.map(|it| record(it, rover)).collect();
    let has_readings = records.iter().any(|it| it.wheels.iter().any(Option::is_some));
    has_readings.then_some(MotorLog { records })
}

fn record(stretch: &Stretch, rover: &Rover) -> MotorRecord {
    let yaw = stretch.attitude.map(|[_, yaw]| yaw);
    let [forward, leftward] = stretch.velocity.map(|it| it.map(|it| it.value));
    let velocity = forward.map(|forward| Vec2::new(forward, leftward.unwrap_or(0.0)));
    let state = |velocity: Vec2| RoverState {
        yaw: yaw.unwrap_or(0.0),
        velocity,
        yaw_rate: stretch.yaw_rate.map_or(0.0, |it| it.value),
        ..RoverState::default()
    };
    let slips: Option<Vec<f64>> = velocity.map(|velocity| {
        wheel_slips(rover, &state(velocity), &stretch.rim_speeds).map(|it| it.ratio).collect()
    });
    let reading = |wheel: usize| {
        Some(MotorReading {
            current: (*stretch.currents.get(wheel)?)?,
            wheel_speed: stretch.rim_speeds.get(wheel)? / rover.mounts()[wheel].shearing_radius(),
            steering: stretch.steering.get(wheel).copied().flatten(),
            slip_ratio: slips.as_ref().and_then(|it| it.get(wheel).copied()),
            ..MotorReading::default()
        })
    };
    MotorRecord {
        time: stretch.time[1],
        slope: stretch.attitude.map(|[slope, _]| slope),
        yaw,
        course: yaw.zip(velocity).map(|(yaw, it)| yaw + atan2(it.y, it.x)),
        wheels: (0..rover.wheel_count()).map(reading).collect(),
    }
}
