//! Ways as they leave: for programs, and for reading.

use grouser::document::columns::{ENERGY, SLOPE, TIME, YAW};
use grouser::studies::route::{Answer as Found, DrivenRoute, Objective, Route};
use serde::Serialize;

use crate::output::rows::four_digits;

/// A way, as it leaves.
#[derive(Clone, Serialize)]
pub(super) struct RouteRecord {
    pub(super) minimise: &'static str,
    /// `found` or `no-safe-route`.
    pub(super) status: &'static str,
    pub(super) reason: Option<String>,
    pub(super) length_m: Option<f64>,
    pub(super) time_s: Option<f64>,
    pub(super) energy_j: Option<f64>,
    pub(super) turned_deg: Option<f64>,
    pub(super) mean_slip_ratio: Option<f64>,
    pub(super) most_slip_ratio: Option<f64>,
    pub(super) most_slope_deg: Option<f64>,
    pub(super) probability_no_go: Option<f64>,
    pub(super) waypoints: Vec<[f64; 2]>,
    pub(super) simulated: Option<Simulated>,
}

/// What simulation makes of it.
#[derive(Clone, Serialize)]
pub(super) struct Simulated {
    pub(super) outcome: &'static str,
    pub(super) legs: usize,
    pub(super) length_m: f64,
    pub(super) time_s: f64,
    pub(super) energy_j: f64,
    pub(super) slip_ratio: Option<f64>,
    pub(super) miss_m: f64,
    /// How far the prediction is from it, over it [-].
    pub(super) time_error: f64,
    pub(super) energy_error: f64,
}

/// A way that was found, or why there is none.
pub(super) struct Way {
    pub(super) objective: Objective,
    pub(super) found: Found,
    pub(super) driven: Option<DrivenRoute>,
}

impl RouteRecord {
    pub(super) fn of(way: &Way) -> Self {
        let minimise = way.objective.name();
        match &way.found {
            Found::Route(route) => Self {
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
                simulated: way.driven.as_ref().map(|driven| Simulated::of(route, driven)),
            },
            Found::NoSafeRoute(reason) => Self {
                minimise,
                status: "no-safe-route",
                reason: Some(reason.to_string()),
                length_m: None,
                time_s: None,
                energy_j: None,
                turned_deg: None,
                mean_slip_ratio: None,
                most_slip_ratio: None,
                most_slope_deg: None,
                probability_no_go: None,
                waypoints: Vec::new(),
                simulated: None,
            },
        }
    }

    /// What the table does not say.
    pub(super) fn line(&self) -> String {
        match (&self.reason, &self.simulated) {
            (Some(reason), _) => format!("least {}: no safe route: {reason}\n", self.minimise),
            (None, Some(driven)) => format!(
                "least {}: driven by simulation: {}, {} s ({:+.1} %), {} J ({:+.1} %), {} m from the target\n",
                self.minimise,
                driven.outcome,
                four_digits(driven.time_s),
                100.0 * driven.time_error,
                four_digits(driven.energy_j),
                100.0 * driven.energy_error,
                four_digits(driven.miss_m)
            ),
            (None, None) => String::new(),
        }
    }
}

impl Simulated {
    pub(super) fn of(route: &Route, driven: &DrivenRoute) -> Self {
        let error = |predicted: f64, simulated: f64| predicted / simulated - 1.0;
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

/// A row of the table.
#[derive(Serialize)]
pub(super) struct Brief {
    minimise: &'static str,
    status: &'static str,
    length_m: Option<f64>,
    time_s: Option<f64>,
    energy_j: Option<f64>,
    turned_deg: Option<f64>,
    mean_slip_ratio: Option<f64>,
    most_slip_ratio: Option<f64>,
    most_slope_deg: Option<f64>,
    probability_no_go: Option<f64>,
    simulated_time_s: Option<f64>,
    simulated_energy_j: Option<f64>,
    reason: Option<String>,
}

impl Brief {
    pub(super) const COLUMNS: [&'static str; 9] = [
        "minimise",
        "status",
        "length_m",
        TIME.name,
        ENERGY.name,
        "turned_deg",
        "most_slip_ratio",
        "most_slope_deg",
        "probability_no_go",
    ];

    pub(super) fn of(record: &RouteRecord) -> Self {
        let simulated = record.simulated.as_ref();
        Self {
            minimise: record.minimise,
            status: record.status,
            length_m: record.length_m,
            time_s: record.time_s,
            energy_j: record.energy_j,
            turned_deg: record.turned_deg,
            mean_slip_ratio: record.mean_slip_ratio,
            most_slip_ratio: record.most_slip_ratio,
            most_slope_deg: record.most_slope_deg,
            probability_no_go: record.probability_no_go,
            simulated_time_s: simulated.map(|it| it.time_s),
            simulated_energy_j: simulated.map(|it| it.energy_j),
            reason: record.reason.clone(),
        }
    }
}
