//! Which course is looked at, slope by slope.

use super::classes::classes;
use super::table::{MobilityTable, OnSlope};
use crate::studies::heading::STRAIGHT_UP;

/// The direction of travel that a map is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CourseChoice {
    /// This one, *χ* [rad], counted from the contour, positive uphill.
    Fixed(f64),
    /// On each slope the one that is least often a no-go, and of several the one with the least
    /// slip, both there and on the way back.
    Best,
    /// The one that is most often a no-go, and of several the one with the most slip.
    Worst,
}

impl CourseChoice {
    /// The courses that are compared where none is fixed [rad]: straight down to straight up, 15°
    /// apart.
    #[must_use]
    pub fn courses(self) -> Vec<f64> {
        match self {
            Self::Fixed(course) => vec![course],
            Self::Best | Self::Worst => {
                (-6_i8..=6).map(|step| f64::from(step) / 6.0 * STRAIGHT_UP).collect()
            }
        }
    }

    /// For each class of slopes the number of its table.
    ///
    /// * `tables`: of these courses
    pub(super) fn by_class(self, tables: &[MobilityTable]) -> Vec<usize> {
        let chosen = |slope: f64| {
            let on_slope: Vec<OnSlope> = tables.iter().map(|table| table.at(slope)).collect();
            let all = 0..tables.len();
            let found = match self {
                Self::Fixed(_) => None,
                Self::Best => all.min_by(|one, other| {
                    let middle = on_slope.len() / 2;
                    let rank = |place: usize| {
                        // The way back of a course is the one as far down as it is up.
                        let back = rank(&on_slope[on_slope.len() - 1 - place]);
                        let there = rank(&on_slope[place]);
                        [there[0].max(back[0]), there[1].max(back[1])]
                    };
                    // Where all are alike, along the contour.
                    worse(rank(*one), rank(*other))
                        .then(one.abs_diff(middle).cmp(&other.abs_diff(middle)))
                }),
                Self::Worst => {
                    all.max_by(|one, other| worse(rank(&on_slope[*one]), rank(&on_slope[*other])))
                }
            };
            found.unwrap_or(0)
        };
        classes().map(chosen).collect()
    }
}

/// How bad a motion is: by how often it fails, then by its slip.
fn rank(found: &OnSlope) -> [f64; 2] {
    [found.probability_no_go, found.motion.map_or(f64::INFINITY, |motion| motion.slip_ratio.abs())]
}

fn worse(one: [f64; 2], other: [f64; 2]) -> std::cmp::Ordering {
    one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1]))
}
