//! The cheapest way for a rover over ground with heights: in time, in work, or in what it risks.
//!
//! Ways lead over a lattice of the ground's points, in sixteen directions; a way over level ground is at most 2.8 %
//! longer than the straight line. What a metre costs comes from the [tables](super::mobility) of the steady motion that
//! holds its course: by how steeply the ground rises along the way and across it. Turns are made on the spot, and cost
//! what a turn on level ground does. No way leads where no heading holds the course, or where more of the samples than
//! the [`Limits`] allow say no-go.
//!
//! A way at the least *risk* is the one whose time is least in the worst tenth of the samples of soil and model: for each
//! metre the mean over those, the conditional value at risk, in which a sample that is stuck counts as a detour of
//! [`STUCK_WAY`]. That adds up along the way if one soil is the better one everywhere, as it is where the soil of the
//! whole ground is not known.

mod costs;
mod drive;
mod moves;
mod search;

use std::f64::consts::PI;

use self::costs::Costs;
pub use self::costs::{COURSES, RouteTables};
pub use self::drive::DrivenRoute;
use self::search::{Found, Lattice};
use super::mobility::{Ground, MobilityStudy};
use crate::error::ParameterError;
use crate::simulation::NotSteady;
use crate::terrain::SoilZones;
use crate::units::{STEEPEST_SLOPE, Vec2};

/// A sample that is stuck on a metre counts as so much way on top [m]. Source: ours; the order of what is driven to get
/// around a place.
pub const STUCK_WAY: f64 = 100.0;

/// The share of the samples that a risk is the mean of [-]. Source: ours.
pub const WORST_SHARE: f64 = 0.1;

/// What a way is to have least of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Objective {
    /// Time.
    #[default]
    Time,
    /// Work of the wheels.
    Energy,
    /// Time in the worst of the samples.
    Risk,
}

impl Objective {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Time, Self::Energy, Self::Risk];

    /// One word: `time`, `energy`, `risk`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Energy => "energy",
            Self::Risk => "risk",
        }
    }
}

/// Where a way may lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The steepest slope [rad].
    pub most_slope: f64,
    /// The largest slip ratio on the soil as written [-].
    pub most_slip_ratio: f64,
    /// In which share of the samples a place may be a no-go [-].
    pub most_no_go: f64,
}

/// What routes are made of.
#[derive(Clone, Debug)]
pub struct RouteStudy {
    /// Rover, soil, model, rim speed, rule.
    pub mobility: MobilityStudy,
    /// Where a way may lead.
    pub limits: Limits,
    /// Where it may not: any zone of these.
    pub keep_out: Option<SoilZones>,
}

/// From where to where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Where the way begins [m].
    pub from: Vec2,
    /// Where it ends [m].
    pub to: Vec2,
    /// Where the nose points at the start, from the map's x axis to the left [rad]; without it any direction.
    pub yaw: Option<f64>,
}

/// A way, and what it takes by the tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The places where it turns, with the first and the last [m].
    pub waypoints: Vec<Vec2>,
    /// Length over the ground [m].
    pub length: f64,
    /// Length on the map [m].
    pub map_length: f64,
    /// Time, with turns [s].
    pub time: f64,
    /// Work of the wheels, with turns [J].
    pub energy: f64,
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
}

/// What came of seeking a way.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The cheapest way.
    Route(Route),
    /// There is none that keeps to the limits.
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
        "the ground between start and target cannot be crossed within the limits: from the start {reached} of {cells} \
         places can be reached"
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
        "the {end} at x {:.2} m, y {:.2} m is not on the map, which goes from x {:.2} to {:.2} m and from y {:.2} to {:.2} m",
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
        "{cells} places are more than a way can be sought over, {MOST_CELLS}: cut out the area of the drive"
    )]
    TooLarge {
        /// How many.
        cells: usize,
    },
    /// A soil, a rover or a limit that is none.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// The most places that a way is sought over.
pub const MOST_CELLS: usize = (u32::MAX / 16) as usize;

impl Limits {
    /// Those of a study's rule: slip up to its no-go, and as many samples without it as it allows.
    #[must_use]
    pub fn of(study: &MobilityStudy) -> Self {
        Self {
            most_slope: STEEPEST_SLOPE,
            most_slip_ratio: study.rule.no_go_slip_ratio,
            most_no_go: 1.0 - study.rule.no_go_probability,
        }
    }
}

/// Turning on the spot on level ground.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turning {
    /// Time for a radian [s].
    time: f64,
    /// Work of the wheels for a radian [J].
    energy: f64,
}

impl RouteStudy {
    /// Seeks the cheapest way.
    ///
    /// * `tables`: of this study; with the risk, if that is the objective
    ///
    /// # Errors
    /// [`RouteError`] for ends that are not on the map, and a map that is too large.
    pub fn route(
        &self,
        tables: &RouteTables,
        ground: Ground<'_>,
        ends: &Ends,
        objective: Objective,
    ) -> Result<Answer, RouteError> {
        let cells = ground.raster().grid.columns * ground.raster().grid.rows;
        if cells > MOST_CELLS {
            return Err(RouteError::TooLarge { cells });
        }
        let costs = Costs::of(tables, objective);
        let turning = match self.turning() {
            Ok(turning) => turning,
            Err(reason) => return Ok(Answer::NoSafeRoute(NoRoute::NoTurn(reason))),
        };
        let turn = match objective {
            Objective::Energy => turning.energy,
            Objective::Time | Objective::Risk => turning.time,
        };
        let is_open =
            |place| self.keep_out.as_ref().is_none_or(|zones| zones.zone(place).is_none());
        let lattice = Lattice::new(ground, &costs, turn, is_open);
        let [from, to] =
            [self.end(&lattice, "start", ends.from)?, self.end(&lattice, "target", ends.to)?];
        let (from, to) = match (from, to) {
            (Ok(from), Ok(to)) => (from, to),
            (Err(none), _) | (_, Err(none)) => return Ok(Answer::NoSafeRoute(none)),
        };
        let heading = ends.yaw.map(|yaw| lattice.moves.nearest(yaw));
        Ok(match lattice.search(from, to, heading) {
            Found::Way(way, headings) => {
                Answer::Route(measured(&lattice, tables, turning, ends, (&way, &headings), heading))
            }
            Found::None { reached } => Answer::NoSafeRoute(NoRoute::Cut { reached, cells }),
        })
    }

    /// The cell of an end of the way.
    fn end(
        &self,
        lattice: &Lattice<'_>,
        end: &'static str,
        place: Vec2,
    ) -> Result<Result<usize, NoRoute>, RouteError> {
        let Some(cell) = lattice.cell(place) else {
            return Err(RouteError::OffTheMap { end, place, corners: lattice.corners() });
        };
        let is_kept_out =
            self.keep_out.as_ref().is_some_and(|zones| zones.zone(lattice.place(cell)).is_some());
        let why = match () {
            () if is_kept_out => "lies where nobody may go",
            () if !lattice.is_open(cell) => {
                "lies at the edge of the map, or beside a place without a height"
            }
            () if !lattice.has_way(cell) => "is a no-go in every direction",
            () => return Ok(Ok(cell)),
        };
        Ok(Err(NoRoute::End { end, place, why }))
    }

    /// Time and work of turning on the spot, by the steady motion with both sides against each other.
    fn turning(&self) -> Result<Turning, String> {
        let MobilityStudy { heading, rim_speed, .. } = &self.mobility;
        let rims: Vec<f64> = heading
            .rover
            .mounts()
            .iter()
            .map(|mount| if mount.position.y > 0.0 { -rim_speed } else { *rim_speed })
            .collect();
        let motion = heading
            .steady_motion_of(0.0, 0.0, &rims)
            .map_err(|error: NotSteady| error.to_string())?;
        let power: f64 = motion
            .wheels
            .iter()
            .zip(heading.rover.mounts())
            .zip(&rims)
            .map(|((wheel, mount), rim)| {
                wheel.settled.forces.torque * rim / mount.shearing_radius()
            })
            .sum();
        let rate = motion.yaw_rate.abs();
        if rate <= 0.0 {
            return Err("its wheels turn and it does not".to_owned());
        }
        Ok(Turning { time: 1.0 / rate, energy: power / rate })
    }
}

/// What a way takes, move by move.
fn measured(
    lattice: &Lattice<'_>,
    tables: &RouteTables,
    turning: Turning,
    ends: &Ends,
    (way, headings): (&[usize], &[usize]),
    heading: Option<usize>,
) -> Route {
    let mut route = Route {
        waypoints: vec![ends.from],
        length: 0.0,
        map_length: 0.0,
        time: 0.0,
        energy: 0.0,
        turned: 0.0,
        mean_slip_ratio: 0.0,
        most_slip_ratio: 0.0,
        most_slope: 0.0,
        probability_no_go: 0.0,
    };
    let mut failed: Vec<bool> = Vec::new();
    let mut before = heading;
    for (cell, direction) in way.iter().zip(headings) {
        if let Some(before) = before.filter(|before| before != direction) {
            route.turned += lattice.moves.turn(before, *direction);
            if *cell != way[0] {
                route.waypoints.push(lattice.place(*cell));
            }
        }
        before = Some(*direction);
        let Some((_, along, across)) = lattice.rises(*cell, *direction) else { continue };
        let way = lattice.moves.lengths[*direction];
        route.map_length += way;
        if let Some(metre) = tables.metre(along, across) {
            route.length += way * metre.length;
            route.time += way * metre.time;
            route.energy += way * metre.energy;
            route.mean_slip_ratio += way * metre.length * metre.slip_ratio;
            route.most_slip_ratio = route.most_slip_ratio.max(metre.slip_ratio);
        }
        let rise = (along * along + across * across).sqrt();
        route.most_slope = route.most_slope.max(crate::elementary::wide::atan2(rise, 1.0));
        let fails = tables.fails(along, across);
        if failed.is_empty() {
            failed.extend(fails);
        } else {
            failed.iter_mut().zip(fails).for_each(|(failed, fails)| *failed |= fails);
        }
    }
    route.waypoints.push(ends.to);
    route.time += route.turned * turning.time;
    route.energy += route.turned * turning.energy;
    if route.length > 0.0 {
        route.mean_slip_ratio /= route.length;
    }
    let count = failed.iter().filter(|failed| **failed).count();
    route.probability_no_go = count as f64 / failed.len().max(1) as f64;
    route
}

impl Lattice<'_> {
    /// South-west and north-east of the map [m].
    fn corners(&self) -> [Vec2; 2] {
        let extent = self.extent();
        [extent.south_west, extent.north_east]
    }
}

impl moves::Moves {
    /// The angle between two directions [rad], 0 to π.
    fn turn(&self, from: usize, to: usize) -> f64 {
        let [from, to] = [from, to].map(|it| self.along[it]);
        let turn = crate::elementary::wide::atan2(from.perp(&to), from.dot(&to));
        turn.abs().min(PI)
    }
}

#[cfg(test)]
mod tests;
