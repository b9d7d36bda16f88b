//! What learning rests on.

use super::filter::Wandering;
use super::noise::ModelNoise;

/// What learning rests on besides soil, rover and telemetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LearnSettings {
    /// How far off a right model of the right soil is.
    pub noise: ModelNoise,
    /// How soils change along the way.
    pub wandering: Wandering,
    /// How much of what observations say for a model against others counts [-].
    pub trust: f64,
    /// The part of the models' shares that stays what it was [-].
    pub kept_share: f64,
}

impl LearnSettings {
    /// Source: ours, found with twin experiments (`docs/guide/learn.md`).
    pub const USUAL: Self =
        Self { noise: ModelNoise::USUAL, wandering: Wandering::USUAL, trust: 0.5, kept_share: 0.1 };
}
