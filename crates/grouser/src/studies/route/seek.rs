//! Seeks a way, and says what it takes.

use super::answer::{Answer, Ends, JudgedAnswer, MOST_CELLS, NoRoute, Route, RouteError};
use super::corridor::Corridor;
use super::costs::{Costs, RouteTables, drawn_or_work};
use super::legs::JudgedLeg;
use super::measure::{Measure, Piece, Turning};
use super::search::{Found, Lattice, cell_at};
use super::study::{Objective, RouteStudy};
use crate::error::ParameterError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::mobility::{Ground, class_of};
use crate::studies::verdict::Verdict;
use crate::terrain::Footprint;
use crate::units::Vec2;
use grouser_io::unit::DEG;

/// Where a slope is a no-go, so many classes of slopes below it are looked at, too.
const LOOKED_BELOW: usize = 4;

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
        let [from, to] = ends.cells(ground)?;
        let cells = cells_of(ground);
        let costs = Costs::of(tables, objective);
        let turning = match Turning::of(&self.mobility) {
            Ok(turning) => turning,
            Err(reason) => return Ok(Answer::NoSafeRoute(NoRoute::NoTurn(reason))),
        };
        let turn = match objective {
            Objective::Energy => drawn_or_work(turning.drawn, turning.energy),
            Objective::Time | Objective::Risk => turning.time,
        };
        let spacing = ground.raster().grid.spacing;
        let is_open = |place| !self.is_kept_out(place, spacing);
        let lattice = Lattice::new(ground, &costs, turn, is_open);
        for ((end, place), cell) in ends.named().into_iter().zip([from, to]) {
            if let Some(why) = self.why_nobody_stands(&lattice, cell) {
                return Ok(Answer::NoSafeRoute(NoRoute::End { end, place, why }));
            }
        }
        let heading = ends.yaw.map(|yaw| lattice.moves.nearest(yaw));
        Ok(match lattice.search(from, to, heading) {
            Found::Way(way, headings) => {
                Answer::Route(measured(&lattice, tables, turning, ends, (&way, &headings), heading))
            }
            Found::None { reached } => Answer::NoSafeRoute(NoRoute::Cut { reached, cells }),
        })
    }

    /// Seeks the cheapest way that has no leg with the verdict no-go, and judges its legs; `None` if
    /// `go_on` was false before the end. Where a way has such a leg, the slopes of its course from
    /// there on are kept off, and a way is sought again. Where a turn on the spot has that verdict,
    /// none is made on such slopes, if there is a way without; else the way has that turn, and says
    /// so.
    ///
    /// * `tables`: of this study; with the risk, if that is the objective
    /// * `samples`: those of the tables
    ///
    /// # Errors
    /// The same as [`route`](Self::route), and [`ParameterError`] for an invalid soil.
    pub fn judged_route(
        &self,
        tables: &RouteTables,
        (ground, ends): (Ground<'_>, &Ends),
        objective: Objective,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<JudgedAnswer>, RouteError> {
        let mut tables = tables.clone();
        let mut with_bad_turns = None;
        loop {
            let found = self.route(&tables, ground, ends, objective)?;
            let Answer::Route(route) = &found else {
                return Ok(Some(with_bad_turns.unwrap_or((found, Vec::new()))));
            };
            let legs = route.advice(&self.mobility, samples, go_on)?;
            let Some(legs) = legs else { return Ok(None) };
            let mut is_new = false;
            let no_go = || legs.iter().flatten().filter(|leg| leg.verdict() == Verdict::NoGo);
            for leg in no_go().filter(|leg| !leg.advice.is_of_turn()) {
                let Some(from) = self.no_go_from(leg, samples, go_on)? else { return Ok(None) };
                is_new |= tables.keep_off(leg.advice.course, from, leg.advice.judgement);
            }
            if !is_new {
                // Legs are not bad: their turns may be.
                let turns = no_go().filter(|leg| leg.advice.is_of_turn());
                match turns.map(|leg| leg.advice.slope).reduce(f64::min) {
                    Some(from) if tables.keep_turns_off(from) => {
                        with_bad_turns = Some((found, legs));
                    }
                    _ => return Ok(Some((found, legs))),
                }
            }
        }
    }

    /// The least slope of a leg's course that has the verdict no-go as the leg has [rad], of those
    /// that are up to [`LOOKED_BELOW`] less steep.
    fn no_go_from(
        &self,
        leg: &JudgedLeg,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<f64>, ParameterError> {
        let (slope, course) = (leg.advice.slope, leg.advice.course);
        let class = class_of(slope);
        let gentler = (class.saturating_sub(LOOKED_BELOW)..class).map(|it| DEG.to_si(it as f64));
        let gentler: Vec<f64> = gentler.collect();
        let Some(found) = self.mobility.advice(course, &gentler, samples, go_on)? else {
            return Ok(None);
        };
        let first = found.iter().find(|it| it.judgement.verdict == Verdict::NoGo);
        Ok(Some(first.map_or(slope, |it| it.slope)))
    }

    /// Whether an area where nobody may go reaches into the cell around a place, however narrow it
    /// is.
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

    /// Why no way begins or ends in a cell; nothing where one may.
    fn why_nobody_stands(&self, lattice: &Lattice<'_>, cell: usize) -> Option<&'static str> {
        match () {
            () if self.is_kept_out(lattice.place(cell), lattice.spacing()) => {
                Some("lies where nobody may go")
            }
            () if !lattice.is_open(cell) => {
                Some("lies at the edge of the map, or beside a place without a height")
            }
            () if !lattice.has_way(cell) => Some("is a no-go in every direction"),
            () => None,
        }
    }
}

impl Ends {
    /// Checks what no table is needed for: that both ends are on the map, and that the map is not
    /// too large to seek a way over.
    ///
    /// # Errors
    /// [`RouteError`] for ends that are not on the map, and a map that is too large.
    pub fn check(&self, ground: Ground<'_>) -> Result<(), RouteError> {
        self.cells(ground).map(drop)
    }

    /// The cells of both ends.
    fn cells(&self, ground: Ground<'_>) -> Result<[usize; 2], RouteError> {
        let cells = cells_of(ground);
        if cells > MOST_CELLS {
            return Err(RouteError::TooLarge { cells });
        }
        let extent = ground.raster().grid.extent();
        let corners = [extent.south_west, extent.north_east];
        let cell = |(end, place)| {
            cell_at(ground, place).ok_or(RouteError::OffTheMap { end, place, corners })
        };
        let [from, to] = self.named().map(cell);
        Ok([from?, to?])
    }

    fn named(&self) -> [(&'static str, Vec2); 2] {
        [("start", self.from), ("target", self.to)]
    }
}

fn cells_of(ground: Ground<'_>) -> usize {
    ground.raster().grid.columns * ground.raster().grid.rows
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
    let mut measure = Measure::from(tables, turning, ends.from);
    let corridor = Corridor { ground: lattice.ground };
    let mut before = heading;
    for (cell, direction) in way.iter().zip(headings) {
        if let Some(before) = before.filter(|before| before != direction) {
            if *cell != way[0] {
                measure.arrive(lattice.place(*cell));
            }
            let turn = [lattice.moves.angle(before), lattice.moves.turn(before, *direction)];
            let place = lattice.place(*cell);
            measure.turn(place, turn, corridor.gradient(place));
        }
        before = Some(*direction);
        let Some((to, along, across)) = lattice.rises(*cell, *direction) else { continue };
        let (length, cells) = (lattice.moves.lengths[*direction], [*cell, to]);
        let (ends, height) = (cells.map(|it| lattice.place(it)), lattice.mean_height(cells));
        let piece = Piece { ends, height, length, along, across };
        measure.drive(piece, tables.steady_metre(along, across));
    }
    measure.finish(ends.to)
}

impl Lattice<'_> {
    /// How far apart its points are, to the east and to the north [m].
    fn spacing(&self) -> Vec2 {
        self.raster().grid.spacing
    }

    /// The mean height of two cells [m].
    fn mean_height(&self, [one, other]: [usize; 2]) -> f64 {
        let raster = self.raster();
        raster.base + f64::midpoint(raster.heights[one].into(), raster.heights[other].into())
    }
}
