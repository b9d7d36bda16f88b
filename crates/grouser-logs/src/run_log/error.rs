//! Why a log could not be written.

use std::io;

/// The longest time that a log can have [s], 570 years: 64 bits of nanoseconds hold it.
pub(crate) const LONGEST: f64 = 1.8e10;

/// Why a log could not be written.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// What it is written to failed.
    #[error(transparent)]
    Write(#[from] io::Error),
    /// A number is not finite; a log has finite numbers only.
    #[error("{name} of {whose} is {value} at {time} s: a log has finite numbers only")]
    NotFinite {
        /// The column.
        name: &'static str,
        /// The wheel, or the rover.
        whose: String,
        /// When [s].
        time: f64,
        /// What it is.
        value: f64,
    },
    /// A record does not come after the one before it.
    #[error(
        "a record of {time} s cannot follow one of {last} s: append records in the order of time"
    )]
    OutOfOrder {
        /// Its time [s].
        time: f64,
        /// The time before [s].
        last: f64,
    },
    /// A time that no log can have.
    #[error("{time} s is no time of a log, which are from 0 s to {LONGEST:e} s")]
    NoTime {
        /// It [s].
        time: f64,
    },
}
