//! Which of the two ways through time a run took.

use super::steady_state::NotSteady;

/// How a run was computed.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// The velocities were integrated like the pose.
    Dynamic,
    /// The velocities were steady at every instant, the pose was integrated.
    QuasiSteady,
    /// Quasi-steady up to a time, dynamic from there until the wheels were to turn otherwise, when
    /// a steady motion is sought again; the first time of several.
    FallbackToDynamic {
        /// When [s].
        time: f64,
        /// Why the quasi-steady motion is not valid there.
        because: NotSteady,
    },
}

impl Method {
    /// `dynamic`, `quasi-steady`, or `fell-back`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dynamic => "dynamic",
            Self::QuasiSteady => "quasi-steady",
            Self::FallbackToDynamic { .. } => "fell-back",
        }
    }

    /// Since when and why it fell back to dynamic, in a few words.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        match self {
            Self::FallbackToDynamic { time, because } => {
                Some(format!("dynamic from {time:.1} s on: {because}"))
            }
            Self::Dynamic | Self::QuasiSteady => None,
        }
    }
}
