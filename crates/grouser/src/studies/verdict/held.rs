//! Whether a sample holds a course.

use super::super::heading::{HeadingCurve, HeadingOffset, NoHeading, STUCK};
use crate::elementary::wide;
use crate::units::Vec2;

/// Whether a sample holds a course on a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) enum Holding {
    /// By a heading.
    At {
        /// Yaw, *γ* [rad].
        yaw: f64,
        /// Slip ratio, *s* [-].
        slip_ratio: f64,
        /// Whether the sample's model or soil is so far outside its domain that nobody is to drive
        /// by it.
        is_outside: bool,
    },
    /// By none.
    Not,
    /// The search gave up.
    Unknown,
}

impl Holding {
    pub(in super::super) fn of(
        curve: &HeadingCurve,
        found: &Result<HeadingOffset, NoHeading>,
    ) -> Self {
        match found {
            Ok(heading) => {
                let findings = curve.findings(heading.slope, found);
                let is_outside = findings.iter().any(|it| it.flag.rule().forbids_driving);
                Self::At { yaw: heading.yaw, slip_ratio: heading.slip_ratio, is_outside }
            }
            Err(none) if none.is_not_found() => Self::Unknown,
            Err(_) => Self::Not,
        }
    }

    /// Of a motion on a course that no heading is sought for, or in a turn on the spot.
    ///
    /// * `yaw`: that it is driven at [rad]
    /// * `slip_ratio`: nothing where it is stuck [-]
    pub(in super::super) fn of_motion(yaw: f64, slip_ratio: Option<f64>) -> Self {
        let at = |slip_ratio| Self::At { yaw, slip_ratio, is_outside: false };
        slip_ratio.map_or(Self::Not, at)
    }

    /// The worse of two moments: being stuck, then what is not known, then the larger slip.
    pub(super) fn or_worse(self, other: Self) -> Self {
        let rank = |it: &Self| match it {
            Self::Not => f64::INFINITY,
            Self::Unknown => f64::MAX,
            Self::At { slip_ratio, .. } => slip_ratio.abs(),
        };
        if rank(&other) > rank(&self) { other } else { self }
    }

    /// Whether a heading holds the course.
    pub(in super::super) fn is_held(self) -> bool {
        matches!(self, Self::At { .. })
    }

    /// Velocity of the body in its own frame [m/s], in a contour traverse along a course [rad] by
    /// the sample's own heading.
    pub(super) fn velocity(self, course: f64, rim_speed: f64) -> Option<Vec2> {
        let Self::At { yaw, slip_ratio: s, .. } = self else { return None };
        let along = rim_speed * if s >= 0.0 { 1.0 - s } else { 1.0 / (1.0 + s) };
        Some(Vec2::new(along, along * wide::tan(course - yaw)))
    }

    /// What bands have of the yaw: above every number where no heading holds the course.
    pub(in super::super) fn yaw(self) -> Option<f64> {
        match self {
            Self::At { yaw, .. } => Some(yaw),
            Self::Not => Some(f64::INFINITY),
            Self::Unknown => None,
        }
    }

    /// What bands have of the slip: 1 where no heading holds the course.
    pub(in super::super) fn slip_ratio(self) -> Option<f64> {
        match self {
            Self::At { slip_ratio, .. } => Some(slip_ratio),
            Self::Not => Some(STUCK),
            Self::Unknown => None,
        }
    }
}
