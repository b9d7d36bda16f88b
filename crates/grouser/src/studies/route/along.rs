//! What it takes to drive along a given line, and where that is not safe.
//!
//! A line is cut into pieces no longer than the grid's points are apart, of which each is priced as
//! a move of the lattice is: by how much it rises from one end to the other, and by how steeply the
//! ground rises across it in the mean of both ends. Between points, heights and gradients are
//! bilinear. A line over the lattice is cut into its moves, so that a way that was found takes the
//! same when it is read back.

use super::answer::{LineError, Route, RouteError};
use super::corridor::{Corridor, Rise, Step};
use super::costs::{Metre, RouteTables};
use super::hazard::{Danger, Hazard, Hazards};
use super::measure::{Measure, Piece, Turning};
use super::study::RouteStudy;
use crate::elementary::wide::{atan2, sin_cos};
use crate::studies::mobility::Ground;
use crate::terrain::{Footprint, SoilZones};
use crate::units::Vec2;

/// A line to drive along, in the coordinates of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    places: Vec<Vec2>,
    /// Where the nose points at the start, from the map's x axis to the left [rad]; without it
    /// along the line.
    pub yaw: Option<f64>,
}

impl Line {
    /// A line from place to place [m].
    ///
    /// * `yaw`: where the nose points at the start, from the map's x axis to the left [rad];
    ///   without it along the line
    ///
    /// # Errors
    /// [`LineError`] for fewer than two different places, and for one that is not finite.
    pub fn through(places: Vec<Vec2>, yaw: Option<f64>) -> Result<Self, LineError> {
        let is_none = |at: &Vec2| !at.x.is_finite() || !at.y.is_finite();
        if let Some(number) = places.iter().position(is_none) {
            return Err(LineError::NoPlace { number: number + 1, place: places[number] });
        }
        if places.iter().all(|place| *place == places[0]) {
            return Err(LineError::NoLength { places: places.len() });
        }
        Ok(Self { places, yaw })
    }

    /// Its places [m].
    #[must_use]
    pub fn places(&self) -> &[Vec2] {
        &self.places
    }

    /// Where it begins [m].
    #[must_use]
    pub fn start(&self) -> Vec2 {
        self.places[0]
    }

    /// Where it ends [m].
    #[must_use]
    pub fn end(&self) -> Vec2 {
        self.places[self.places.len() - 1]
    }

    /// Checks what no table is needed for: that some of it lies on the map, and that it is no longer
    /// than can be looked at.
    ///
    /// # Errors
    /// [`RouteError`] for a line none of which lies on the map, and one that is too long.
    pub fn check(&self, ground: Ground<'_>) -> Result<(), RouteError> {
        Corridor { ground }.check(&self.places)
    }

    /// The straight line from its start to its end [m].
    #[must_use]
    pub fn straight(&self) -> f64 {
        (self.end() - self.start()).norm()
    }
}

/// What came of looking along a line.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedLine {
    /// What the way takes, with the line's places as its waypoints; none where some of the ground
    /// is not known, or no heading holds the course, or the rover cannot turn.
    pub route: Option<Route>,
    /// The same whatever is known of its costs: the places, slopes and samples of all that was
    /// looked at.
    pub seen: Route,
    /// Where it is not safe, in order; with none it is safe.
    pub hazards: Vec<Hazard>,
}

impl RouteStudy {
    /// Looks along a line: what it takes to drive there, and where that is beyond the limits.
    ///
    /// * `tables`: of this study
    ///
    /// # Errors
    /// [`RouteError`] for a line none of which lies on the map, and one that is too long.
    pub fn along(
        &self,
        tables: &RouteTables,
        ground: Ground<'_>,
        line: &Line,
    ) -> Result<CheckedLine, RouteError> {
        line.check(ground)?;
        let corridor = Corridor { ground };
        let mut look = Look::from(self, tables, line.start());
        let mut before = line.yaw;
        for (number, pair) in line.places.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            if number > 0 {
                look.measure.arrive(from);
            }
            if from == to {
                continue;
            }
            let heading = atan2(to.y - from.y, to.x - from.x);
            if let Some(before) = before.replace(heading) {
                let turn = [before, angle_between(before, heading)];
                look.turn(from, turn, corridor.gradient(from));
            }
            corridor.steps(from, to).for_each(|step| look.go(&step));
        }
        Ok(look.finish(line.end()))
    }
}

/// The angle from one direction to another [rad], −π to π, positive to the left.
fn angle_between(one: f64, other: f64) -> f64 {
    let (sin, cos) = sin_cos(other - one);
    atan2(sin, cos)
}

/// What has been seen of a line.
struct Look<'a> {
    tables: &'a RouteTables,
    areas: Option<&'a SoilZones>,
    can_turn: bool,
    measure: Measure<'a>,
    hazards: Hazards,
    /// Whether the cost of all of it is known.
    is_priced: bool,
}

impl<'a> Look<'a> {
    fn from(study: &'a RouteStudy, tables: &'a RouteTables, start: Vec2) -> Self {
        let turning = Turning::of(&study.mobility);
        Self {
            tables,
            areas: study.keep_out.as_ref(),
            can_turn: turning.is_ok(),
            measure: Measure::from(tables, turning.unwrap_or_default(), start),
            hazards: Hazards::default(),
            is_priced: true,
        }
    }

    fn turn(&mut self, place: Vec2, turn: [f64; 2], gradient: Option<Vec2>) {
        /// Less is rounding [rad].
        const STRAIGHT: f64 = 1e-9;
        if turn[1].abs() < STRAIGHT {
            return;
        }
        self.measure.turn(place, turn, gradient);
        if !self.can_turn {
            self.is_priced = false;
            self.measure.cannot_turn();
            self.note(place, 0.0, Danger::NoTurn, None);
        }
    }

    /// Goes on by a step.
    fn go(&mut self, step: &Step) {
        let Step { from, to, ground } = *step;
        let length = (to - from).norm();
        if self.areas.is_some_and(|areas| meets(areas, from, to)) {
            self.measure.is_lost();
            self.note(from, length, Danger::KeptOut, None);
        }
        match ground {
            None => {
                self.is_priced = false;
                self.note(from, length, Danger::UnknownGround, None);
                self.measure.drive_unknown(0.5 * (from + to), length);
            }
            Some(Rise { along, across, height }) => {
                let piece = Piece { ends: [from, to], height, length, along, across };
                let metre = self.tables.steady_metre(along, across);
                self.look_at(from, &piece, metre);
                self.measure.drive(piece, metre);
            }
        }
    }

    /// Notes what is wrong with a piece before it is driven over.
    fn look_at(&mut self, from: Vec2, piece: &Piece, metre: Option<Metre>) {
        let Piece { length, along, across, .. } = *piece;
        let Some(metre) = metre else {
            self.is_priced = false;
            return self.note(from, length, Danger::NoHeading, None);
        };
        let tables = self.tables;
        for (danger, number) in tables.limits_exceeded(along, across, &metre) {
            self.note(from, length, danger, Some(number));
        }
    }

    fn note(&mut self, place: Vec2, length: f64, danger: Danger, worst: Option<f64>) {
        let so_far = self.measure.so_far();
        let along = [so_far, so_far + length];
        self.hazards.add(Hazard { danger, along, place, worst });
    }

    fn finish(self, end: Vec2) -> CheckedLine {
        let route = self.measure.finish(end);
        let hazards = self.hazards.finish();
        CheckedLine { route: self.is_priced.then(|| route.clone()), seen: route, hazards }
    }
}

/// Whether areas reach over a piece of a line.
fn meets(areas: &SoilZones, from: Vec2, to: Vec2) -> bool {
    /// Half of the width that a line is taken to have [m].
    const THIN: f64 = 1e-3;
    let way = to - from;
    let (half_length, middle) = (0.5 * way.norm(), from + 0.5 * way);
    let strip = Footprint { forward: way.normalize(), half_length, half_width: THIN };
    areas.under(middle, Vec2::zeros(), strip).iter().any(|share| share.soil.is_some())
}
