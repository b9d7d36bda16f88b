//! Ways as they are read: a row each, and what the table does not say.

use std::fmt::Write as _;

use grouser::document::columns::{ENERGY, TIME};
use grouser::document::reading::four_digits;
use grouser::document::route::RouteRecord;
use serde::Serialize;

/// What a way is called.
pub(super) fn name(record: &RouteRecord) -> String {
    record.minimise.map_or_else(|| "the given way".to_owned(), |it| format!("least {it}"))
}

/// What the table does not say of a way.
pub(super) fn lines(record: &RouteRecord) -> String {
    let name = name(record);
    let mut text = String::new();
    match &record.reason {
        Some(reason) if record.hazards.is_empty() => {
            let _ = writeln!(text, "{name}: no safe route: {reason}");
        }
        _ => (),
    }
    for hazard in &record.hazards {
        let _ = writeln!(text, "not safe: {}", hazard.sentence);
    }
    if let Some(driven) = &record.simulated {
        let _ = writeln!(
            text,
            "{name}: driven by simulation: {}, {} s ({:+.1} %), {} J ({:+.1} %), {} m from the \
             target",
            driven.outcome,
            four_digits(driven.time_s),
            100.0 * driven.time_error,
            four_digits(driven.energy_j),
            100.0 * driven.energy_error,
            four_digits(driven.miss_m)
        );
    }
    text
}

/// A row of the table.
#[derive(Serialize)]
pub(super) struct Brief {
    minimise: Option<&'static str>,
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
