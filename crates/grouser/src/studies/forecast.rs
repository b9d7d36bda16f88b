//! A rover's slip, drift, heading, steepest slope and power under another gravity than the one its
//! soil was measured under, on each ground that the site may have, and an error budget for each.
//!
//! Nobody has measured a wheel on the ground of the site, so that a forecast rests on choices that
//! no sample of the soil decides. Two of them are not averaged over: which [`Ground`] the site has,
//! and whether moduli are carried by a law that something [supports](Support). Each ground has a
//! forecast of its own, and another one with the laws that no measurement supports. It is the same,
//! bit for bit, as if that ground alone were asked for.
//!
//! All else is a [factor](FactorKind) within a ground: what the rover weighs, the wheel–soil model,
//! the samples of the soil, what a model gets wrong, and how moduli scale. Every level meets every
//! level of the others: a full [`factorial`](super::ensemble::factorial) design, on which the parts
//! of a variance add up.
//!
//! Levels of one factor count alike, models by their [shares](super::ensemble::models). A budget is
//! of quantities that every case has: the slip ratio of a contour traverse (1 where no heading
//! holds the contour), the drift with the nose on the contour (1, straight downhill, where the
//! rover slides), and the steepest slope (0 where it cannot drive on level ground). Bands are over
//! all cases of the ground: a case without a heading needs more of it, and more power, than any
//! number.

mod case;
mod choices;
mod error;
mod factor;
mod ground_study;
mod result;
mod run;
mod study;
mod support;

pub use self::choices::{Choices, Ground, RoverMass, SiteSoil};
pub use self::error::ForecastError;
pub use self::factor::{Factor, FactorKind, Level, REMEDY_OF_INTERACTIONS};
pub use self::result::{Forecast, GroundForecast, SlopeForecast, TestForecast};
pub use self::study::ForecastStudy;
pub use self::support::Support;
