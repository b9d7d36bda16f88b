//! Seeks a way, and says what it takes.

use super::answer::{Answer, Ends, MOST_CELLS, NoRoute, Route, RouteError};
use super::costs::{Costs, RouteTables};
use super::measure::{Measure, Piece, Turning};
use super::search::{Found, Lattice};
use super::study::{Objective, RouteStudy};
use crate::studies::mobility::Ground;
use crate::terrain::Footprint;
use crate::units::Vec2;

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
        let turning = match Turning::of(&self.mobility) {
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
    let mut before = heading;
    for (cell, direction) in way.iter().zip(headings) {
        if let Some(before) = before.filter(|before| before != direction) {
            if *cell != way[0] {
                measure.arrive(lattice.place(*cell));
            }
            measure.turn(lattice.moves.turn(before, *direction));
        }
        before = Some(*direction);
        let Some((_, along, across)) = lattice.rises(*cell, *direction) else { continue };
        let length = lattice.moves.lengths[*direction];
        measure.drive(Piece { length, along, across }, tables.metre(along, across));
    }
    measure.finish(ends.to)
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
