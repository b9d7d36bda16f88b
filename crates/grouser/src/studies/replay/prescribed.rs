//! Prescribed motion: what a soil predicts at the attitude, the wheel speeds and the steering
//! angles that were read.

use super::channel::{Channel, ChannelValue};
use crate::simulation::SteadyMotion;
use crate::studies::ensemble::samples::Sample;
use crate::studies::heading::HeadingStudy;
use crate::studies::learn::{NotUsed, Reading, Stretch, steady_attitude, steered};
use crate::units::Vec2;
use crate::vehicle::kinematics::wheel_slips;
use crate::vehicle::{Rover, RoverState};

/// What a prediction takes from the telemetry.
#[derive(Clone, Debug)]
pub(in crate::studies) struct Situation {
    /// With the rover as it was steered.
    pub(in crate::studies) study: HeadingStudy,
    /// Slope and yaw [rad].
    pub(in crate::studies) slope: f64,
    pub(in crate::studies) yaw: f64,
    /// Rim speed of each wheel [m/s].
    pub(in crate::studies) rim_speeds: Vec<f64>,
}

/// What is predicted, or what instruments read of it.
#[derive(Clone, Debug)]
pub(in crate::studies) struct Predicted {
    /// Along the body and to its left [m/s].
    pub(super) velocity: Vec2,
    /// Yaw rate [rad/s].
    pub(super) yaw_rate: f64,
    /// Torque of each wheel [N·m].
    pub(super) torques: Vec<f64>,
    /// Sinkage of each wheel [m].
    sinkages: Vec<f64>,
    /// Mean slip ratio of the wheels [-].
    slip_ratio: f64,
}

impl Situation {
    pub(in crate::studies) fn of(study: &HeadingStudy, stretch: &Stretch) -> Result<Self, NotUsed> {
        let [slope, yaw] = steady_attitude(stretch)?;
        let rover = steered(&study.rover, &stretch.steering);
        let study = HeadingStudy { rover, ..study.clone() };
        Ok(Self { study, slope, yaw, rim_speeds: stretch.rim_speeds.clone() })
    }

    /// The same with another soil and model.
    pub(in crate::studies) fn on(&self, sample: &Sample) -> Self {
        Self { study: self.study.of_sample(sample), ..self.clone() }
    }

    /// The steady motion there, sought near another; `None` where no velocities leave no force and
    /// no yaw moment over.
    pub(in crate::studies) fn motion(&self, near: Option<&SteadyMotion>) -> Option<SteadyMotion> {
        let Self { study, slope, yaw, rim_speeds } = self;
        let found = match near {
            Some(near) => study.steady_motion_of_near(near, *slope, *yaw, rim_speeds),
            None => study.steady_motion_of(*slope, *yaw, rim_speeds),
        };
        found.ok()
    }

    /// Speeds are measured by the fastest rim's [m/s].
    pub(super) fn fastest(&self) -> f64 {
        self.rim_speeds.iter().map(|it| it.abs()).fold(0.0, f64::max)
    }

    /// Turning is measured by the speed of the farthest wheel: its distance [m].
    pub(super) fn reach(&self) -> f64 {
        reach(&self.study.rover)
    }

    /// Torques are measured by this [N·m].
    pub(super) fn torque_scale(&self, wheel: usize) -> f64 {
        let rover = &self.study.rover;
        rover.mounts()[wheel].shearing_radius() * rover.mass() * self.study.gravity
    }
}

fn reach(rover: &Rover) -> f64 {
    rover.load_arms().iter().map(Vec2::norm).fold(f64::MIN_POSITIVE, f64::max)
}

impl Predicted {
    pub(in crate::studies) fn of(motion: &SteadyMotion) -> Self {
        let each = || motion.wheels.iter().map(|it| &it.settled);
        Self {
            velocity: motion.velocity,
            yaw_rate: motion.yaw_rate,
            torques: each().map(|it| it.forces.torque).collect(),
            sinkages: each().map(|it| it.sinkage).collect(),
            slip_ratio: motion.slip_ratio(),
        }
    }

    /// The value of a channel of steady motion.
    ///
    /// * `speeds`: angular speed of each wheel [rad/s]
    pub(in crate::studies) fn of_channel(&self, channel: Channel, speeds: &[f64]) -> Option<f64> {
        match channel {
            Channel::ForwardSpeed => Some(self.velocity.x),
            Channel::LateralSpeed => Some(self.velocity.y),
            Channel::YawRate => Some(self.yaw_rate),
            Channel::SlipRatio => Some(self.slip_ratio),
            Channel::Power => Some(power(&self.torques, speeds)),
            Channel::Torque(wheel) => self.torques.get(wheel).copied(),
            Channel::Sinkage(wheel) => self.sinkages.get(wheel).copied(),
            Channel::X | Channel::Y | Channel::Yaw | Channel::Roll | Channel::Pitch => None,
        }
    }
}

fn power(torques: &[f64], speeds: &[f64]) -> f64 {
    torques.iter().zip(speeds).map(|(torque, speed)| torque * speed).sum()
}

/// Angular speed of each wheel [rad/s].
pub(in crate::studies) fn wheel_speeds(stretch: &Stretch, rover: &Rover) -> Vec<f64> {
    let pairs = stretch.rim_speeds.iter().zip(rover.mounts());
    pairs.map(|(speed, mount)| speed / mount.shearing_radius()).collect()
}

/// What was measured of a channel of steady motion.
pub(in crate::studies) fn measured(
    channel: Channel,
    stretch: &Stretch,
    rover: &Rover,
) -> Option<f64> {
    let value = |it: Option<Reading>| it.map(|it| it.value);
    let [forward, leftward] = stretch.velocity.map(value);
    match channel {
        Channel::ForwardSpeed => forward,
        Channel::LateralSpeed => leftward,
        Channel::YawRate => value(stretch.yaw_rate),
        Channel::SlipRatio => {
            let velocity = Vec2::new(forward?, leftward.unwrap_or(0.0));
            let yaw_rate = value(stretch.yaw_rate).unwrap_or(0.0);
            let state = RoverState { velocity, yaw_rate, ..RoverState::default() };
            let rover = steered(rover, &stretch.steering);
            let slips = wheel_slips(&rover, &state, &stretch.rim_speeds);
            Some(slips.map(|it| it.ratio).sum::<f64>() / stretch.rim_speeds.len() as f64)
        }
        Channel::Power => {
            let torques: Option<Vec<f64>> = stretch.torques.iter().map(|it| value(*it)).collect();
            Some(power(&torques?, &wheel_speeds(stretch, rover)))
        }
        Channel::Torque(wheel) => value(*stretch.torques.get(wheel)?),
        Channel::Sinkage(wheel) => value(*stretch.sinkages.get(wheel)?),
        Channel::X | Channel::Y | Channel::Yaw | Channel::Roll | Channel::Pitch => None,
    }
}

/// The channels of steady motion over a stretch, side by side.
pub(super) fn values<'c>(
    channels: impl Iterator<Item = Channel> + 'c,
    stretch: &'c Stretch,
    rover: &'c Rover,
    predicted: Option<&'c Predicted>,
) -> impl Iterator<Item = ChannelValue> + 'c {
    let speeds = wheel_speeds(stretch, rover);
    channels.map(move |channel| {
        let predicted = predicted.and_then(|it| it.of_channel(channel, &speeds));
        ChannelValue::new(channel, measured(channel, stretch, rover), predicted)
    })
}
