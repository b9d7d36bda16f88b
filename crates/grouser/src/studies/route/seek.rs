//! Seeks a way, and says what it takes.

use super::answer::{Answer, Arrival, Ends, MOST_CELLS, NoRoute, Route, RouteError};
use super::costs::{Costs, RouteTables};
use super::search::{Found, Lattice};
use super::study::{Objective, RouteStudy};
use crate::simulation::NotSteady;
use crate::studies::mobility::{Ground, MobilityStudy};
use crate::terrain::Footprint;
use crate::units::Vec2;

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
        let spacing = ground.raster().grid.spacing;
        let is_open = |place| !self.is_kept_out(place, spacing);
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

    /// Whether an area where nobody may go reaches into the cell around a place, however narrow it is.
    ///
    /// * `spacing`: of the grid, to the east and to the north [m]
    fn is_kept_out(&self, place: Vec2, spacing: Vec2) -> bool {
        let Some(areas) = &self.keep_out else { return false };
        let cell = Footprint {
            forward: Vec2::new(1.0, 0.0),
            half_length: 0.5 * spacing.x,
            half_width: 0.5 * spacing.y,
        };
        areas.under(place, Vec2::zeros(), cell).iter().any(|share| share.soil.is_some())
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
        let why = match () {
            () if self.is_kept_out(lattice.place(cell), lattice.spacing()) => {
                "lies where nobody may go"
            }
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
        waypoints: Vec::new(),
        arrivals: Vec::new(),
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
    route.arrive(ends.from, turning);
    let mut failed: Vec<bool> = Vec::new();
    let mut before = heading;
    for (cell, direction) in way.iter().zip(headings) {
        if let Some(before) = before.filter(|before| before != direction) {
            if *cell != way[0] {
                route.arrive(lattice.place(*cell), turning);
            }
            route.turned += lattice.moves.turn(before, *direction);
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
    route.arrive(ends.to, turning);
    route.time += route.turned * turning.time;
    route.energy += route.turned * turning.energy;
    if route.length > 0.0 {
        route.mean_slip_ratio /= route.length;
    }
    let count = failed.iter().filter(|failed| **failed).count();
    route.probability_no_go = count as f64 / failed.len().max(1) as f64;
    route
}

impl Route {
    /// Another waypoint, with what has been taken up to it; the sums have no turns yet.
    fn arrive(&mut self, place: Vec2, turning: Turning) {
        self.waypoints.push(place);
        self.arrivals.push(Arrival {
            length: self.length,
            time: self.time + self.turned * turning.time,
            energy: self.energy + self.turned * turning.energy,
        });
    }
}

impl Lattice<'_> {
    /// How far apart its points are, to the east and to the north [m].
    fn spacing(&self) -> Vec2 {
        self.raster().grid.spacing
    }

    /// South-west and north-east of the map [m].
    fn corners(&self) -> [Vec2; 2] {
        let extent = self.extent();
        [extent.south_west, extent.north_east]
    }
}
