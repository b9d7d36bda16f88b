//! What was measured less what is predicted, stretch by stretch, and how each fault changes it.

use nalgebra::{DMatrix, DVector};

use super::channel::Channel;
use super::faults::{COUNT, Faults, Parameter};
use super::prescribed::{Predicted, Situation};
use crate::elementary::wide::{hypot, ln};
use crate::simulation::SteadyMotion;
use crate::studies::learn::{ModelNoise, ODOMETRY, SHALLOWEST, Stretch};

/// Differences of a stretch over their noise, and how the parameters of [`Parameter::ALL`] change
/// them.
#[derive(Clone, Debug)]
pub(super) struct Differences {
    /// Measured less predicted, with unit variance.
    pub(super) residuals: DVector<f64>,
    /// How predictions change with each parameter, over its usual size, on the same scale.
    pub(super) sensitivities: DMatrix<f64>,
}

/// A torque, or whatever turns the rover, that no soil explains turns it by this of its rims' speed
/// [-]. Source: ours: a hundredth of the weight at one side of the rover.
const TURNING: f64 = 0.02;

impl Differences {
    /// * `base`: what is taken to be wrong already
    /// * `motion`: the steady motion where nothing is
    pub(super) fn of(
        situation: &Situation,
        stretch: &Stretch,
        base: &Faults,
        motion: &SteadyMotion,
    ) -> Option<Self> {
        let seen = Seen::of(situation, stretch);
        let truth = under(situation, base, motion)?;
        let here = base.read(truth.clone());
        let numbers = seen.numbers(&here);
        let mut sensitivities = DMatrix::zeros(seen.values.len(), COUNT);
        for (place, parameter) in Parameter::ALL.into_iter().enumerate() {
            // Half of its usual size, to both sides of which a prediction bends little.
            let step = 0.5 * parameter.usual();
            let faults = base.and(parameter, step);
            let there = if parameter.moves_rover() {
                under(situation, &faults, motion)?
            } else {
                truth.clone()
            };
            let change = (seen.numbers(&faults.read(there)) - &numbers) * 2.0;
            sensitivities.set_column(place, &change);
        }
        let noise = seen.noise(&sensitivities, &here, stretch.way);
        let scale = noise.cholesky()?.l();
        Some(Self {
            residuals: scale.solve_lower_triangular(&(&seen.values - numbers))?,
            sensitivities: scale.solve_lower_triangular(&sensitivities)?,
        })
    }
}

/// The motion of a situation, where what was read and assumed is off by some faults.
fn under(situation: &Situation, faults: &Faults, near: &SteadyMotion) -> Option<Predicted> {
    let mut truth = faults.situation(situation);
    truth.study.soil = faults.soil(&situation.study.soil);
    Some(Predicted::of(&truth.motion(Some(near))?))
}

/// What was read over a stretch, as numbers without a unit: velocities over the fastest rim's,
/// torques over weight times shearing radius, logarithms of sinkages.
struct Seen<'s> {
    situation: &'s Situation,
    channels: Vec<Channel>,
    values: DVector<f64>,
    /// Variances of the instruments.
    variances: Vec<f64>,
}

impl<'s> Seen<'s> {
    fn of(situation: &'s Situation, stretch: &Stretch) -> Self {
        let (fastest, reach) = (situation.fastest(), situation.reach());
        let mut found: Vec<(Channel, f64, f64)> = Vec::new();
        let motion = [
            (Channel::ForwardSpeed, stretch.velocity[0], 1.0),
            (Channel::LateralSpeed, stretch.velocity[1], 1.0),
            (Channel::YawRate, stretch.yaw_rate, reach),
        ];
        for (channel, reading, arm) in motion {
            let Some(reading) = reading else { continue };
            let scale = arm / fastest;
            found.push((
                channel,
                scale * reading.value,
                hypot(scale * reading.deviation, ODOMETRY),
            ));
        }
        for (wheel, reading) in stretch.torques.iter().enumerate() {
            let Some(reading) = reading else { continue };
            let scale = situation.torque_scale(wheel);
            found.push((Channel::Torque(wheel), reading.value / scale, reading.deviation / scale));
        }
        for (wheel, reading) in stretch.sinkages.iter().enumerate() {
            let Some(reading) = reading else { continue };
            let value = reading.value.max(SHALLOWEST);
            found.push((Channel::Sinkage(wheel), ln(value), reading.deviation / value));
        }
        Self {
            situation,
            channels: found.iter().map(|(channel, ..)| *channel).collect(),
            values: DVector::from_iterator(found.len(), found.iter().map(|(_, value, _)| *value)),
            variances: found.iter().map(|(.., deviation)| deviation * deviation).collect(),
        }
    }

    /// The same numbers of a prediction.
    fn numbers(&self, predicted: &Predicted) -> DVector<f64> {
        let (fastest, reach) = (self.situation.fastest(), self.situation.reach());
        let number = |channel: &Channel| {
            // A prediction has every wheel of the rover.
            let value = predicted.of_channel(*channel, &[]).unwrap_or(0.0);
            match channel {
                Channel::YawRate => value * reach / fastest,
                Channel::Torque(wheel) => value / self.situation.torque_scale(*wheel),
                Channel::Sinkage(_) => ln(value.max(SHALLOWEST)),
                _ => value / fastest,
            }
        };
        DVector::from_iterator(self.channels.len(), self.channels.iter().map(number))
    }

    /// Covariance of what was read about what a right soil predicts: of the instruments, and of
    /// what no soil explains,
    /// [`ModelNoise`]: a force, or an attitude of the ground, acts as a small roll and pitch do.
    fn noise(&self, sensitivities: &DMatrix<f64>, here: &Predicted, way: f64) -> DMatrix<f64> {
        let noise = ModelNoise::USUAL;
        let together = noise.together(way);
        let force = hypot(noise.force, noise.attitude);
        let mut covariance = DMatrix::zeros(self.channels.len(), self.channels.len());
        for parameter in [Parameter::Roll, Parameter::Pitch] {
            let by_force = sensitivities.column(parameter as usize) * (force / parameter.usual());
            covariance += together * &by_force * by_force.transpose();
        }
        for (place, channel) in self.channels.iter().enumerate() {
            let of_model = match channel {
                Channel::YawRate => TURNING * TURNING,
                Channel::Torque(wheel) => {
                    let share = noise.torque_share * here.torques[*wheel];
                    (hypot(share, noise.torque) / self.situation.torque_scale(*wheel)).powi(2)
                }
                Channel::Sinkage(_) => noise.sinkage * noise.sinkage,
                _ => 0.0,
            };
            covariance[(place, place)] += together * of_model + self.variances[place];
        }
        covariance
    }
}
