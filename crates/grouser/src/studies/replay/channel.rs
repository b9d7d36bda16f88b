//! What is compared over a drive, channel by channel, and how far measured and predicted are apart
//! in each.

use std::f64::consts::{PI, TAU};

use crate::studies::ensemble::{Band, Probability};

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Velocity along the body [m/s].
    ForwardSpeed,
    /// Velocity to the body's left [m/s].
    LateralSpeed,
    /// Yaw rate [rad/s].
    YawRate,
    /// Mean slip ratio of the wheels [-].
    SlipRatio,
    /// Mechanical power of all wheels, ΣTω [W].
    Power,
    /// Torque of a wheel [N·m], by its place among the mounts.
    Torque(usize),
    /// Sinkage of a wheel [m], by its place among the mounts.
    Sinkage(usize),
    /// Position along the contour [m].
    X,
    /// Position uphill [m].
    Y,
    /// Yaw [rad].
    Yaw,
    /// Roll [rad].
    Roll,
    /// Pitch [rad].
    Pitch,
}

/// What the prediction of a channel takes from the telemetry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prediction {
    /// Attitude, wheel speeds and steering angles, stretch by stretch.
    Prescribed,
    /// The first pose, and wheel speeds and steering angles over time.
    FreeRun,
}

impl Prediction {
    /// One word: `prescribed`, `free-run`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Prescribed => "prescribed",
            Self::FreeRun => "free-run",
        }
    }
}

/// The channels of steady motion that are not a wheel's.
const OF_MOTION: [Channel; 5] = [
    Channel::ForwardSpeed,
    Channel::LateralSpeed,
    Channel::YawRate,
    Channel::SlipRatio,
    Channel::Power,
];
/// Those of a free run.
const OF_POSE: [Channel; 5] = [Channel::X, Channel::Y, Channel::Yaw, Channel::Roll, Channel::Pitch];

impl Channel {
    /// All channels of a rover, in the order in which
    /// [`ReplayedStretch::values`](super::ReplayedStretch) has them.
    #[must_use]
    pub fn all(wheels: usize) -> Vec<Self> {
        let of_wheels = (0..wheels).map(Self::Torque).chain((0..wheels).map(Self::Sinkage));
        OF_MOTION.into_iter().chain(of_wheels).chain(OF_POSE).collect()
    }

    /// What its prediction takes from the telemetry.
    #[must_use]
    pub fn prediction(self) -> Prediction {
        if OF_POSE.contains(&self) { Prediction::FreeRun } else { Prediction::Prescribed }
    }

    /// The wheel, where it is of one.
    #[must_use]
    pub fn wheel(self) -> Option<usize> {
        match self {
            Self::Torque(wheel) | Self::Sinkage(wheel) => Some(wheel),
            _ => None,
        }
    }

    /// The same quantity, of the first wheel where it is of one.
    #[must_use]
    pub fn of_first_wheel(self) -> Self {
        match self {
            Self::Torque(_) => Self::Torque(0),
            Self::Sinkage(_) => Self::Sinkage(0),
            other => other,
        }
    }

    /// A difference of two values: that of a yaw is within half a turn.
    fn difference(self, value: f64) -> f64 {
        if self == Self::Yaw { value - TAU * ((value + PI) / TAU).floor() } else { value }
    }
}

/// One channel over one stretch, in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChannelValue {
    /// What was measured.
    pub measured: Option<f64>,
    /// What the soil of the document predicts.
    pub predicted: Option<f64>,
    /// What samples of soil and model predict.
    pub band: Option<Band>,
    /// Measured less predicted.
    pub residual: Option<f64>,
}

impl ChannelValue {
    pub(super) fn new(channel: Channel, measured: Option<f64>, predicted: Option<f64>) -> Self {
        let plain = measured.zip(predicted).map(|(measured, it)| measured - it);
        let residual = plain.map(|it| channel.difference(it));
        // A yaw within half a turn of what was measured is easier to read beside it.
        let turns = plain.zip(residual).map_or(0.0, |(plain, residual)| plain - residual);
        let predicted = predicted.map(|it| it + turns);
        Self { measured, predicted, band: None, residual }
    }

    /// Adds the band over what samples predict; as many turns away as the prediction is.
    pub(super) fn add_band(&mut self, channel: Channel, sampled: impl Iterator<Item = f64>) {
        let near = |it: f64| match self.predicted {
            Some(predicted) => predicted + channel.difference(it - predicted),
            None => it,
        };
        self.band = Band::of(sampled.map(near));
    }

    /// Whether it lies within the band, where there are both.
    fn is_within(&self) -> Option<bool> {
        let (measured, band) = self.measured.zip(self.band)?;
        Some((band.low..=band.high).contains(&measured))
    }
}

/// How far measured and predicted are apart in a channel, over all its stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelSummary {
    /// The channel.
    pub channel: Channel,
    /// Stretches that have both.
    pub count: usize,
    /// Mean of what was measured, and of what was predicted.
    pub means: [f64; 2],
    /// Mean of the residuals.
    pub bias: f64,
    /// Root of their mean square.
    pub rms: f64,
    /// Standard deviation of the residuals about their mean.
    pub scatter: f64,
    /// How many stretches lie within their bands.
    pub within: Option<Probability>,
}

impl ChannelSummary {
    /// `None` of a channel without a residual.
    pub(super) fn of<'v>(
        channel: Channel,
        values: impl Iterator<Item = &'v ChannelValue> + Clone,
    ) -> Option<Self> {
        let both =
            values.clone().filter_map(|it| Some([it.measured?, it.predicted?, it.residual?]));
        let count = both.clone().count();
        if count == 0 {
            return None;
        }
        let mean = |of: &dyn Fn([f64; 3]) -> f64| both.clone().map(of).sum::<f64>() / count as f64;
        let bias = mean(&|[.., residual]| residual);
        let square = mean(&|[.., residual]| residual * residual);
        let scatter = mean(&|[.., residual]| (residual - bias).powi(2)).sqrt();
        let within: Vec<bool> = values.filter_map(ChannelValue::is_within).collect();
        let successes = within.iter().filter(|it| **it).count();
        let within =
            (!within.is_empty()).then_some(Probability { successes, trials: within.len() });
        let means = [mean(&|[measured, ..]| measured), mean(&|[_, predicted, _]| predicted)];
        Some(Self { channel, count, means, bias, rms: square.sqrt(), scatter, within })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a turn to the left and to the right are the same.
    #[test]
    fn yaws_differ_by_no_more_than_half_a_turn() {
        let value = ChannelValue::new(Channel::Yaw, Some(3.1), Some(-3.1));
        assert!((value.residual.unwrap() + 0.0832).abs() < 1e-4, "{value:?}");
        assert!((value.predicted.unwrap() - 3.1832).abs() < 1e-4);
    }

    #[test]
    fn bias_and_scatter_make_the_mean_square() {
        let values = [1.0, 2.0, 4.0].map(|it| ChannelValue::new(Channel::X, Some(it), Some(1.0)));
        let found = ChannelSummary::of(Channel::X, values.iter()).unwrap();
        assert!((found.bias - 4.0 / 3.0).abs() < 1e-12);
        assert!((found.rms.powi(2) - found.bias.powi(2) - found.scatter.powi(2)).abs() < 1e-12);
        assert!(ChannelSummary::of(Channel::X, [ChannelValue::default()].iter()).is_none());
    }
}
