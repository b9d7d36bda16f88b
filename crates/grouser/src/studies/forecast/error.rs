//! Why there is no forecast.

use crate::error::ParameterError;
use crate::studies::ensemble::NothingAccepted;
use crate::studies::heading::NoHeading;

/// Why there is no forecast.
#[derive(Debug, thiserror::Error)]
pub enum ForecastError {
    /// A value is out of its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No soil can be drawn.
    #[error(transparent)]
    NothingAccepted(#[from] NothingAccepted),
    /// The search for a heading gave up in one of the cases. Each level of each factor has the same
    /// cases, so that none can be left out.
    #[error("a case of the forecast: {0}")]
    NotFound(NoHeading),
}
