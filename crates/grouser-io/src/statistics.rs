//! Distributions of values that are not known exactly, random numbers, and bands of what follows
//! from them.

mod band;
mod distribution;
pub mod normal;
pub mod random;

pub use band::{Band, Probability, interval_score, quantile, share_interval, weighted_quantile};
pub use distribution::{Contradiction, Correlation, Distribution, Marginal, NothingAccepted};
