//! The part of a log that is replayed.

/// Times of a log [s]: of all of it where there is no end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    from: Option<f64>,
    to: Option<f64>,
}

/// A part that has no time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the part of the log ends at {to} s, which is not after {from} s, where it begins")]
pub struct EmptyPart {
    from: f64,
    to: f64,
}

impl Part {
    /// * `from`: where it begins [s]
    /// * `to`: where it ends [s]
    ///
    /// # Errors
    /// [`EmptyPart`] where it ends before it begins.
    pub fn new(from: Option<f64>, to: Option<f64>) -> Result<Self, EmptyPart> {
        match (from, to) {
            (Some(from), Some(to)) if from >= to => Err(EmptyPart { from, to }),
            _ => Ok(Self { from, to }),
        }
    }

    /// Where it begins and ends [s].
    #[must_use]
    pub const fn ends(self) -> [Option<f64>; 2] {
        [self.from, self.to]
    }

    /// Whether it is all of the log.
    #[must_use]
    pub const fn is_whole(self) -> bool {
        self.from.is_none() && self.to.is_none()
    }

    pub(super) fn has(self, time: f64) -> bool {
        self.from.is_none_or(|from| time >= from) && self.to.is_none_or(|to| time <= to)
    }
}
