//! A way piece by piece, for its profile.

use crate::units::Vec2;

/// A piece of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePiece {
    /// Its leg, from waypoint to waypoint, counted from 1.
    pub leg: usize,
    /// Length on the map from the start of the way to its middle [m].
    pub along: f64,
    /// Its middle [m].
    pub place: Vec2,
    /// The ground there, if it is known.
    pub ground: Option<GroundOfPiece>,
}

/// The ground of a piece, and how samples of soil and model drive over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundOfPiece {
    /// Height in the middle [m].
    pub height: f64,
    /// Slope [rad].
    pub slope: f64,
    /// Course from the contour, positive uphill [rad].
    pub course: f64,
    /// The median over the samples of the slip ratio with which each holds the course by its own
    /// heading [-], 1 where none does; `None` where no sample is known.
    pub slip_ratio: Option<f64>,
    /// Share of the samples in which it is a no-go [-].
    pub probability_no_go: f64,
}
