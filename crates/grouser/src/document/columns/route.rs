//! The profile of a way, and where it ends if it is not completed.

use super::super::unit::M;
use super::map::PROBABILITY_NO_GO;
use super::{COURSE, Column, Quantity, SLIP_RATIO, SLOPE, X, Y, Z, maybe, quantity, whole};
use crate::studies::route::{GroundOfPiece, ProfilePiece, RouteRisk};

/// Length on the map from the start of a way.
pub const ALONG: Quantity = quantity("along_m", M);

/// A piece of a way; over ground that is not known it has its place alone.
pub const PROFILE: [Column<ProfilePiece>; 9] = [
    whole("leg", "Number of its leg, from 1", |it| Some(it.leg)),
    ALONG.number("Length on the map from the start of the way, to the middle of the piece", |it| {
        it.along
    }),
    X.number("x there", |it| it.place.x),
    Y.number("y there", |it| it.place.y),
    Z.maybe("Height of the map there", |it| ground(it, |it| it.height)),
    SLOPE.maybe("Slope of the piece", |it| ground(it, |it| it.slope)),
    COURSE.maybe("Course on that slope, from the contour, positive uphill", |it| {
        ground(it, |it| it.course)
    }),
    SLIP_RATIO.maybe(
        "Slip ratio, median over the samples, each with its nose where it holds the course; a \
         sample that does not, or slips more than a no-go, counts as 1",
        |it| it.ground?.slip_ratio,
    ),
    PROBABILITY_NO_GO.maybe("Share of the samples in which the piece is a no-go", |it| {
        ground(it, |it| it.probability_no_go)
    }),
];

fn ground(piece: &ProfilePiece, number: fn(&GroundOfPiece) -> f64) -> Option<f64> {
    piece.ground.as_ref().map(number)
}

/// Where the commonest end of a way is: beside what it
/// [risks](super::completion::RISK).
pub const COMMONEST_END: [Column<RouteRisk>; 3] = [
    maybe(
        "commonest_end_along_m",
        M,
        "Length on the map from the start to where half of the samples that end so have ended",
        |it| Some(it.end?.along),
    ),
    maybe("commonest_end_x_m", M, "x there", |it| Some(it.end?.place.x)),
    maybe("commonest_end_y_m", M, "y there", |it| Some(it.end?.place.y)),
];
