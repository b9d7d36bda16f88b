//! Results of [routes](crate::studies::route) as they leave the library, with units in their names.

use serde::Serialize;

use super::columns::{SLOPE, YAW};
use crate::studies::route::{Answer, Arrival, DrivenRoute, Objective, Route};

/// A way, as it leaves; without a way there is a reason instead of numbers.
#[derive(Clone, Debug, Serialize)]
pub struct RouteRecord {
    /// What it has least of.
    pub minimise: &'static str,
    /// `found` or `no-safe-route`.
    pub status: &'static str,
    /// Why there is none.
    pub reason: Option<String>,
    /// Length over the ground.
    pub length_m: Option<f64>,
    /// Time, with turns.
    pub time_s: Option<f64>,
    /// Work of the wheels, with turns.
    pub energy_j: Option<f64>,
    /// Angle of all turns together.
    pub turned_deg: Option<f64>,
    /// Mean slip ratio over the way.
    pub mean_slip_ratio: Option<f64>,
    /// The largest.
    pub most_slip_ratio: Option<f64>,
    /// The steepest slope.
    pub most_slope_deg: Option<f64>,
    /// In which share of the samples some place of the way is a no-go.
    pub probability_no_go: Option<f64>,
    /// x and y of the places where it turns, with the first and the last.
    pub waypoints: Vec<[f64; 2]>,
    /// What it takes up to each of them.
    pub arrivals: Vec<ArrivalRecord>,
    /// What simulation makes of it, if it was driven.
    pub simulated: Option<SimulatedRecord>,
}

/// What a way takes up to a waypoint, before it turns there.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ArrivalRecord {
    /// Length over the ground.
    pub length_m: f64,
    /// Time, with turns.
    pub time_s: f64,
    /// Work of the wheels, with turns.
    pub energy_j: f64,
}

/// What simulation makes of a way.
#[derive(Clone, Debug, Serialize)]
pub struct SimulatedRecord {
    /// One word: `completed`, or what ended it.
    pub outcome: &'static str,
    /// How many of the legs between waypoints were completed.
    pub legs: usize,
    /// Length over the ground.
    pub length_m: f64,
    /// Time, with turns.
    pub time_s: f64,
    /// Work of the wheels, with turns.
    pub energy_j: f64,
    /// Slip ratio over all legs.
    pub slip_ratio: Option<f64>,
    /// How far from the target it ended.
    pub miss_m: f64,
    /// How far the predicted time is from it, over it.
    pub time_error: f64,
    /// How far the predicted work is from it, over it.
    pub energy_error: f64,
}

impl RouteRecord {
    /// What came of seeking a way.
    ///
    /// * `driven`: what simulation makes of it, if it was driven
    #[must_use]
    pub fn of(objective: Objective, answer: &Answer, driven: Option<&DrivenRoute>) -> Self {
        let minimise = objective.name();
        match answer {
            Answer::Route(route) => Self::of_route(minimise, route, driven),
            Answer::NoSafeRoute(reason) => Self::of_none(minimise, reason.to_string()),
        }
    }

    fn of_route(minimise: &'static str, route: &Route, driven: Option<&DrivenRoute>) -> Self {
        Self {
            minimise,
            status: "found",
            reason: None,
            length_m: Some(route.length),
            time_s: Some(route.time),
            energy_j: Some(route.energy),
            turned_deg: Some(YAW.unit.from_si(route.turned)),
            mean_slip_ratio: Some(route.mean_slip_ratio),
            most_slip_ratio: Some(route.most_slip_ratio),
            most_slope_deg: Some(SLOPE.unit.from_si(route.most_slope)),
            probability_no_go: Some(route.probability_no_go),
            waypoints: route.waypoints.iter().map(|it| [it.x, it.y]).collect(),
            arrivals: route.arrivals.iter().map(ArrivalRecord::of).collect(),
            simulated: driven.map(|driven| SimulatedRecord::of(route, driven)),
        }
    }

    fn of_none(minimise: &'static str, reason: String) -> Self {
        Self {
            minimise,
            status: "no-safe-route",
            reason: Some(reason),
            length_m: None,
            time_s: None,
            energy_j: None,
            turned_deg: None,
            mean_slip_ratio: None,
            most_slip_ratio: None,
            most_slope_deg: None,
            probability_no_go: None,
            waypoints: Vec::new(),
            arrivals: Vec::new(),
            simulated: None,
        }
    }
}

impl ArrivalRecord {
    fn of(arrival: &Arrival) -> Self {
        Self { length_m: arrival.length, time_s: arrival.time, energy_j: arrival.energy }
    }
}

impl SimulatedRecord {
    fn of(route: &Route, driven: &DrivenRoute) -> Self {
        let error = |predicted: f64, simulated: f64| {
            if predicted == simulated { 0.0 } else { predicted / simulated - 1.0 }
        };
        Self {
            outcome: driven.outcome,
            legs: driven.legs,
            length_m: driven.distance,
            time_s: driven.time,
            energy_j: driven.energy,
            slip_ratio: driven.slip_ratio,
            miss_m: driven.miss,
            time_error: error(route.time, driven.time),
            energy_error: error(route.energy, driven.energy),
        }
    }
}
