//! What a way takes, piece by piece.

use super::answer::{Arrival, Route};
use super::costs::{Metre, RouteTables};
use super::end::{End, RouteRisk};
use super::legs::{LegPlace, LegPlaces};
use super::profile::{GroundOfPiece, ProfilePiece};
use super::turns::{Turn, ends_in_turns};
use crate::simulation::NotSteady;
use crate::simulation::power::electrical;
use crate::studies::mobility::slope_and_course;
use crate::studies::verdict::{SlopeStudy, SpotTurn};
use crate::units::Vec2;

/// Turning on the spot on level ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Turning {
    /// Time for a radian [s].
    pub(super) time: f64,
    /// Work of the wheels for a radian [J].
    pub(super) energy: f64,
    /// What motors and electronics draw for a radian [J]; NaN where no motor is known.
    pub(super) drawn: f64,
}

impl Turning {
    /// By the steady motion with both sides against each other; or why there is none.
    pub(super) fn of(study: &SlopeStudy) -> Result<Self, String> {
        let SlopeStudy { heading, rim_speed, .. } = study;
        let rims = SpotTurn::rim_speeds(&heading.rover, *rim_speed);
        let motion = heading
            .steady_motion_of(0.0, 0.0, &rims)
            .map_err(|error: NotSteady| error.to_string())?;
        let each = motion.wheels.iter().zip(heading.rover.mounts()).zip(&rims);
        let each = each.map(|((wheel, mount), rim)| {
            (mount, wheel.settled.forces.torque, rim / mount.shearing_radius())
        });
        let power: f64 = each.clone().map(|(_, torque, speed)| torque * speed).sum();
        let of_motors =
            each.filter_map(|(mount, torque, speed)| Some(electrical(mount, torque, speed)?.power));
        let electronics = heading.rover.battery().map_or(0.0, |battery| battery.electronics);
        let drawn = if heading.rover.has_motors() {
            of_motors.sum::<f64>() + electronics
        } else {
            f64::NAN
        };
        let rate = motion.yaw_rate.abs();
        if rate <= 0.0 {
            return Err("its wheels turn and it does not".to_owned());
        }
        Ok(Self { time: 1.0 / rate, energy: power / rate, drawn: drawn / rate })
    }
}

/// A piece of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Its ends [m].
    pub(super) ends: [Vec2; 2],
    /// The height in its middle [m].
    pub(super) height: f64,
    /// How long it is on the map [m].
    pub(super) length: f64,
    /// How steeply the ground rises along it and across it [m/m].
    pub(super) along: f64,
    pub(super) across: f64,
}

impl Piece {
    /// Its middle [m].
    fn middle(&self) -> Vec2 {
        0.5 * (self.ends[0] + self.ends[1])
    }

    /// Its ground, and how the samples drive over it.
    fn ground(&self, tables: &RouteTables) -> GroundOfPiece {
        let (slope, course) = slope_and_course(self.along, self.across);
        let slip = tables.median_slip(slope, course);
        GroundOfPiece {
            height: self.height,
            slope,
            course,
            slip_ratio: (!slip.is_nan()).then_some(slip),
            probability_no_go: tables.probability_no_go(slope, course),
        }
    }
}

/// A way that is being measured.
pub(super) struct Measure<'a> {
    tables: &'a RouteTables,
    turning: Turning,
    route: Route,
    /// Where each sample has ended.
    ends: Vec<Option<End>>,
    /// Whether it is known of all of the way whether it can be driven.
    is_certain: bool,
    /// Where the leg is judged.
    places: LegPlaces,
    /// Whether the ground of the leg is known all the way.
    is_known: bool,
    /// Length on the map, over ground that is not known, too [m].
    so_far: f64,
    /// What motors and electronics draw, without turns [J]; NaN where no motor is known.
    drawn: f64,
}

impl<'a> Measure<'a> {
    /// A way that begins.
    pub(super) fn from(tables: &'a RouteTables, turning: Turning, start: Vec2) -> Self {
        let route = Route {
            waypoints: Vec::new(),
            arrivals: Vec::new(),
            length: 0.0,
            map_length: 0.0,
            time: 0.0,
            energy: 0.0,
            drawn: None,
            turned: 0.0,
            mean_slip_ratio: 0.0,
            most_slip_ratio: 0.0,
            most_slope: 0.0,
            probability_no_go: 0.0,
            risk: None,
            legs: Vec::new(),
            turns: Vec::new(),
            profile: Vec::new(),
        };
        let mut measure = Self {
            tables,
            turning,
            route,
            ends: Vec::new(),
            is_certain: true,
            places: LegPlaces::default(),
            is_known: true,
            so_far: 0.0,
            drawn: 0.0,
        };
        measure.arrive(start);
        measure
    }

    /// Another waypoint, with what has been taken up to it; the sums have no turns yet.
    pub(super) fn arrive(&mut self, place: Vec2) {
        let Self { route, turning, .. } = self;
        if !route.waypoints.is_empty() {
            let places = std::mem::take(&mut self.places);
            route.legs.push(self.is_known.then_some(places));
            self.is_known = true;
        }
        route.waypoints.push(place);
        route.arrivals.push(Arrival {
            length: route.length,
            time: route.time + route.turned * turning.time,
            energy: route.energy + route.turned * turning.energy,
        });
    }

    /// Turns on the spot.
    ///
    /// * `from`: where the nose points, from the map's x axis to the left [rad]
    /// * `angle`: by which it turns [rad], positive to the left
    /// * `gradient`: how steeply the ground rises there to the east and to the north [m/m], if it is
    ///   known
    pub(super) fn turn(&mut self, place: Vec2, [from, angle]: [f64; 2], gradient: Option<Vec2>) {
        self.route.turned += angle.abs();
        let (leg, along) = (self.route.waypoints.len(), self.so_far);
        let turn = |gradient| Turn { leg, along, place, gradient, from, angle };
        self.is_certain &= gradient.is_some();
        self.route.turns.extend(gradient.map(turn));
    }

    /// Length on the map from the start [m].
    pub(super) fn so_far(&self) -> f64 {
        self.so_far
    }

    /// The leg leads where nobody may go.
    pub(super) fn is_lost(&mut self) {
        self.is_known = false;
    }

    /// It cannot turn where it has to.
    pub(super) fn cannot_turn(&mut self) {
        self.is_certain = false;
    }

    /// Goes on by a piece over ground that nobody knows.
    ///
    /// * `place`: its middle [m]
    /// * `length`: on the map [m]
    pub(super) fn drive_unknown(&mut self, place: Vec2, length: f64) {
        self.is_known = false;
        self.is_certain = false;
        self.note(place, length, None);
    }

    /// Adds a piece to the profile.
    fn note(&mut self, place: Vec2, length: f64, ground: Option<GroundOfPiece>) {
        let leg = self.route.waypoints.len();
        let along = self.so_far + 0.5 * length;
        self.route.profile.push(ProfilePiece { leg, along, place, ground });
        self.so_far += length;
    }

    /// Goes on by a piece.
    ///
    /// * `metre`: what a metre of it costs, if it can be driven
    pub(super) fn drive(&mut self, piece: Piece, metre: Option<Metre>) {
        let ground = piece.ground(self.tables);
        let GroundOfPiece { slope, course, probability_no_go, .. } = ground;
        let along = [self.so_far, self.so_far + piece.length];
        let place = piece.ends[0];
        self.places.add(LegPlace { slope, course, along, place, probability_no_go });
        self.meet(&piece);
        self.note(piece.middle(), piece.length, Some(ground));
        let (route, length) = (&mut self.route, piece.length);
        route.map_length += length;
        if let Some(metre) = metre {
            route.length += length * metre.length;
            route.time += length * metre.time;
            route.energy += length * metre.energy;
            self.drawn += length * metre.drawn;
            route.mean_slip_ratio += length * metre.length * metre.slip_ratio;
            route.most_slip_ratio = route.most_slip_ratio.max(metre.slip_ratio);
        }
        route.most_slope = route.most_slope.max(slope);
    }

    /// Sees which of the samples end at a piece.
    fn meet(&mut self, piece: &Piece) {
        let (leg, middle) = (self.route.waypoints.len(), piece.middle());
        let along = self.so_far + 0.5 * piece.length;
        let fates = self.tables.fates(piece.along, piece.across);
        let ends = fates.map(|fate| fate.map(|danger| End { leg, along, place: middle, danger }));
        if self.ends.is_empty() {
            self.ends.extend(ends);
        } else {
            self.ends.iter_mut().zip(ends).for_each(|(known, end)| *known = known.or(end));
        }
    }

    /// Arrives at the end.
    pub(super) fn finish(mut self, end: Vec2) -> Route {
        self.arrive(end);
        let Self { tables, turning, mut route, ends, is_certain, drawn, .. } = self;
        route.time += route.turned * turning.time;
        route.energy += route.turned * turning.energy;
        let drawn = if route.turned > 0.0 { drawn + route.turned * turning.drawn } else { drawn };
        route.drawn = (!drawn.is_nan() && route.length > 0.0).then_some(drawn);
        if route.length > 0.0 {
            route.mean_slip_ratio /= route.length;
        }
        let count = ends.iter().flatten().count();
        route.probability_no_go = count as f64 / ends.len().max(1) as f64;
        route.risk = (is_certain && !ends.is_empty()).then(|| {
            let stuck = ends_in_turns(&tables.turns, &route.turns, ends.len());
            let first = |(end, stuck): (Option<End>, Option<End>)| match (end, stuck) {
                (Some(end), Some(stuck)) if stuck.along > end.along => Some(end),
                (end, stuck) => stuck.or(end),
            };
            RouteRisk::of(&ends.into_iter().zip(stuck).map(first).collect::<Vec<_>>())
        });
        route
    }
}
