//! What a way takes, piece by piece.

use super::answer::{Arrival, Route};
use super::costs::{Metre, RouteTables};
use super::profile::{GroundOfPiece, ProfilePiece};
use crate::simulation::NotSteady;
use crate::studies::mobility::slope_and_course;
use crate::studies::verdict::SlopeStudy;
use crate::units::Vec2;

/// Turning on the spot on level ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Turning {
    /// Time for a radian [s].
    pub(super) time: f64,
    /// Work of the wheels for a radian [J].
    pub(super) energy: f64,
}

impl Turning {
    /// By the steady motion with both sides against each other; or why there is none.
    pub(super) fn of(study: &SlopeStudy) -> Result<Self, String> {
        let SlopeStudy { heading, rim_speed, .. } = study;
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
        Ok(Self { time: 1.0 / rate, energy: power / rate })
    }
}

/// A piece of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Its middle [m].
    pub(super) place: Vec2,
    /// The height there [m].
    pub(super) height: f64,
    /// How long it is on the map [m].
    pub(super) length: f64,
    /// How steeply the ground rises along it and across it [m/m].
    pub(super) along: f64,
    pub(super) across: f64,
}

/// A way that is being measured.
pub(super) struct Measure<'a> {
    tables: &'a RouteTables,
    turning: Turning,
    route: Route,
    /// Whether each sample has met a no-go.
    failed: Vec<bool>,
    /// How many of them fail at the worst place of the leg, with its slope and course [rad].
    worst: (usize, f64, f64),
    /// Whether the ground of the leg is known all the way.
    is_known: bool,
    /// Length on the map, over ground that is not known, too [m].
    so_far: f64,
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
            turned: 0.0,
            mean_slip_ratio: 0.0,
            most_slip_ratio: 0.0,
            most_slope: 0.0,
            probability_no_go: 0.0,
            worst: Vec::new(),
            profile: Vec::new(),
        };
        let mut measure = Self {
            tables,
            turning,
            route,
            failed: Vec::new(),
            worst: (0, 0.0, 0.0),
            is_known: true,
            so_far: 0.0,
        };
        measure.arrive(start);
        measure
    }

    /// Another waypoint, with what has been taken up to it; the sums have no turns yet.
    pub(super) fn arrive(&mut self, place: Vec2) {
        let Self { route, turning, .. } = self;
        if !route.waypoints.is_empty() {
            let (_, slope, course) = std::mem::take(&mut self.worst);
            route.worst.push(self.is_known.then_some((slope, course)));
            self.is_known = true;
        }
        route.waypoints.push(place);
        route.arrivals.push(Arrival {
            length: route.length,
            time: route.time + route.turned * turning.time,
            energy: route.energy + route.turned * turning.energy,
        });
    }

    /// * `angle`: [rad], not negative
    pub(super) fn turn(&mut self, angle: f64) {
        self.route.turned += angle;
    }

    /// Length on the map from the start [m].
    pub(super) fn so_far(&self) -> f64 {
        self.so_far
    }

    /// The leg leads where nobody may go.
    pub(super) fn is_lost(&mut self) {
        self.is_known = false;
    }

    /// Goes on by a piece over ground that nobody knows.
    ///
    /// * `place`: its middle [m]
    /// * `length`: on the map [m]
    pub(super) fn drive_unknown(&mut self, place: Vec2, length: f64) {
        self.is_known = false;
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
        let Piece { place, length, along, across, .. } = piece;
        self.note(place, length, Some(GroundOfPiece::of(self.tables, &piece)));
        let route = &mut self.route;
        route.map_length += length;
        if let Some(metre) = metre {
            route.length += length * metre.length;
            route.time += length * metre.time;
            route.energy += length * metre.energy;
            route.mean_slip_ratio += length * metre.length * metre.slip_ratio;
            route.most_slip_ratio = route.most_slip_ratio.max(metre.slip_ratio);
        }
        let (slope, course) = slope_and_course(along, across);
        route.most_slope = route.most_slope.max(slope);
        let fails = self.tables.fails(along, across);
        let here = (fails.clone().filter(|fails| *fails).count(), slope, course);
        if (here.0, slope) > (self.worst.0, self.worst.1) {
            self.worst = here;
        }
        if self.failed.is_empty() {
            self.failed.extend(fails);
        } else {
            self.failed.iter_mut().zip(fails).for_each(|(failed, fails)| *failed |= fails);
        }
    }

    /// Arrives at the end.
    pub(super) fn finish(mut self, end: Vec2) -> Route {
        self.arrive(end);
        let Self { turning, mut route, failed, .. } = self;
        route.time += route.turned * turning.time;
        route.energy += route.turned * turning.energy;
        if route.length > 0.0 {
            route.mean_slip_ratio /= route.length;
        }
        let count = failed.iter().filter(|failed| **failed).count();
        route.probability_no_go = count as f64 / failed.len().max(1) as f64;
        route
    }
}
