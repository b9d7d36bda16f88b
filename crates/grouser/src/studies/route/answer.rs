//! Ways, and why there are none.

use super::end::RouteRisk;
use super::legs::{JudgedLeg, LegPlaces, judged};
use super::profile::ProfilePiece;
use super::turns::Turn;
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::verdict::SlopeStudy;
use crate::units::Vec2;

/// From where to where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Where the way begins [m].
    pub from: Vec2,
    /// Where it ends [m].
    pub to: Vec2,
    /// Where the nose points at the start, from the map's x axis to the left [rad]; without it any
    /// direction.
    pub yaw: Option<f64>,
}

/// A way, and what it takes by the tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The places where it turns, with the first and the last [m].
    pub waypoints: Vec<Vec2>,
    /// What the way takes up to each of them.
    pub arrivals: Vec<Arrival>,
    /// Length over the ground [m].
    pub length: f64,
    /// Length on the map [m].
    pub map_length: f64,
    /// Time, with turns [s].
    pub time: f64,
    /// Work of the wheels, with turns [J].
    pub energy: f64,
    /// What motors, with cold windings, and with a battery the electronics draw, with turns [J];
    /// `None` where no motor is known.
    pub drawn: Option<f64>,
    /// Angle of all turns together [rad].
    pub turned: f64,
    /// Mean slip ratio over the way [-].
    pub mean_slip_ratio: f64,
    /// The largest [-].
    pub most_slip_ratio: f64,
    /// The steepest slope [rad].
    pub most_slope: f64,
    /// In which share of the samples some place of the way is a no-go [-].
    pub probability_no_go: f64,
    /// How probably it is completed, and how it ends otherwise; `None` over ground that nobody
    /// knows, and where the rover cannot turn.
    pub risk: Option<RouteRisk>,
    /// The places of each leg from waypoint to waypoint where it is judged; `None` of a leg that
    /// leads over ground that nobody knows, or that nobody may go to.
    pub legs: Vec<Option<LegPlaces>>,
    /// The turns on the spot, in order; those where it is not known how the ground rises are none
    /// of them.
    pub(super) turns: Vec<Turn>,
    /// All of it, piece by piece: of a way that was sought a move of the lattice, of a given line as
    /// long as the map's points are apart.
    pub profile: Vec<ProfilePiece>,
}

impl Route {
    /// What to do on each leg, at its worst place or in the turn before it, if that is worse; `None`
    /// of a leg some of whose ground is not known, and of one without length. `None` altogether if `go_on` was false before the end.
    ///
    /// # Errors
    /// The same as [`SlopeStudy::advice`].
    pub fn advice(
        &self,
        study: &SlopeStudy,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Option<JudgedLeg>>>, ParameterError> {
        judged(&self.legs, &self.turns, (study, samples), go_on)
    }
}

/// What came of seeking a way, and for each of its legs what to do at its worst place, if that is
/// known.
pub type JudgedAnswer = (Answer, Vec<Option<JudgedLeg>>);

/// What a way takes from its start to one of its waypoints, before it turns there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Arrival {
    /// Length over the ground [m].
    pub length: f64,
    /// Time, with turns [s].
    pub time: f64,
    /// Work of the wheels, with turns [J].
    pub energy: f64,
}

/// What came of seeking a way.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there are as many as ways are asked for")]
pub enum Answer {
    /// The cheapest way.
    Route(Route),
    /// There is no way that keeps to the limits.
    NoSafeRoute(NoRoute),
}

/// Why there is no way.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoRoute {
    /// Nobody may go to one of its ends.
    #[error("the {end} at x {:.2} m, y {:.2} m {why}", .place.x, .place.y)]
    End {
        /// `start` or `target`.
        end: &'static str,
        /// Where [m].
        place: Vec2,
        /// What is wrong there.
        why: &'static str,
    },
    /// What lies between cannot be crossed.
    #[error(
        "the ground between start and target cannot be crossed within the limits: from the start \
         {reached} of {cells} places can be reached"
    )]
    Cut {
        /// How many places can be reached.
        reached: usize,
        /// How many there are.
        cells: usize,
    },
    /// The rover cannot turn.
    #[error("the rover cannot turn on the spot on level ground: {0}")]
    NoTurn(String),
}

/// A way that cannot be sought.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RouteError {
    /// An end that is not on the map.
    #[error(
        "the {end} at x {:.2} m, y {:.2} m is not on the map, which goes from x {:.2} to {:.2} m \
         and from y {:.2} to {:.2} m",
        .place.x, .place.y, .corners[0].x, .corners[1].x, .corners[0].y, .corners[1].y
    )]
    OffTheMap {
        /// `start` or `target`.
        end: &'static str,
        /// Where [m].
        place: Vec2,
        /// South-west and north-east of the map [m].
        corners: [Vec2; 2],
    },
    /// More places than states can be told apart.
    #[error(
        "{cells} places are more than a way can be sought over, {MOST_CELLS}: cut out the area of \
         the drive"
    )]
    TooLarge {
        /// How many.
        cells: usize,
    },
    /// A line that cannot be driven along.
    #[error(transparent)]
    Line(#[from] LineError),
    /// An invalid soil, rover or limit.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// An invalid line, or one that is not on the map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LineError {
    /// A place that is not finite.
    #[error("place {number} of the line is x {}, y {}, and places are finite", .place.x, .place.y)]
    NoPlace {
        /// Which, from 1.
        number: usize,
        /// What it is.
        place: Vec2,
    },
    /// All places are the same one, or there is none.
    #[error("the line has no length: {places} places, and at least two different ones make a line")]
    NoLength {
        /// How many there are.
        places: usize,
    },
    /// A line of another place.
    #[error(
        "the line is not on the map: it lies within x {:.2} to {:.2} m and y {:.2} to {:.2} m, and \
         the map goes from x {:.2} to {:.2} m and from y {:.2} to {:.2} m; both need the same \
         projection",
        .line[0].x, .line[1].x, .line[0].y, .line[1].y,
        .corners[0].x, .corners[1].x, .corners[0].y, .corners[1].y
    )]
    Elsewhere {
        /// South-west and north-east of the line [m].
        line: [Vec2; 2],
        /// South-west and north-east of the map [m].
        corners: [Vec2; 2],
    },
    /// A line that takes too long to look at.
    #[error("the line is {pieces:.3e} cells of the map long, and at most {most:e} are looked at")]
    TooLong {
        /// How many.
        pieces: f64,
        /// The most.
        most: f64,
    },
}

/// The most places that a way is sought over.
pub const MOST_CELLS: usize = (u32::MAX / 16) as usize;
