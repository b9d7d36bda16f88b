//! Ways that were found or given, and what is said of each.

use std::fmt::Write as _;

use crate::document::reading::four_digits;
use crate::document::route::RouteRecord;
use crate::studies::completion::Completion;
use crate::studies::route::{
    Answer as Found, CheckedLine, DrivenRoute, JudgedLeg, Limits, Line, Objective, Route, RouteRisk,
};
use crate::units::Vec2;

/// A way that was found or given, or why there is none.
#[derive(Clone, Debug)]
pub struct Way {
    /// What it takes, as it leaves the library.
    pub record: RouteRecord,
    /// Its places [m]; none where no way was found.
    pub places: Vec<Vec2>,
    /// What it takes by the tables, if that is known.
    pub(super) route: Option<Route>,
    /// How probably it is completed, if that is known.
    risk: Option<RouteRisk>,
    /// What simulation makes of it, if it was driven.
    pub(super) driven: Option<DrivenRoute>,
}

impl Way {
    /// What came of seeking a way.
    ///
    /// * `driven`: what simulation makes of it, if it was driven
    /// * `legs`: what to do on each
    #[must_use]
    pub fn sought(
        objective: Objective,
        found: Found,
        driven: Option<DrivenRoute>,
        legs: &[Option<JudgedLeg>],
    ) -> Self {
        let record = RouteRecord::of(objective, &found, driven.as_ref(), legs);
        let route = match found {
            Found::Route(route) => Some(route),
            Found::NoSafeRoute(_) => None,
        };
        let places = route.as_ref().map(|it| it.waypoints.clone()).unwrap_or_default();
        let risk = route.as_ref().and_then(|it| it.risk.clone());
        Self { record, places, route, risk, driven }
    }

    /// What came of looking along a line.
    ///
    /// * `driven`: what simulation makes of it, if it was driven
    /// * `legs`: what to do on each
    #[must_use]
    pub fn along(
        line: &Line,
        found: CheckedLine,
        limits: &Limits,
        driven: Option<DrivenRoute>,
        legs: &[Option<JudgedLeg>],
    ) -> Self {
        let record = RouteRecord::of_line(line, &found, limits, driven.as_ref(), legs);
        let (places, risk) = (line.places().to_vec(), found.seen.risk);
        Self { record, places, route: found.route, risk, driven }
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> String {
        self.record.minimise.map_or_else(|| "the given way".to_owned(), |it| format!("least {it}"))
    }

    /// The same within a sentence.
    pub(super) fn called(&self) -> String {
        let least = |it| format!("the way with the least {it}");
        self.record.minimise.map_or_else(|| "the given way".to_owned(), least)
    }

    /// A number of the way, if it is known.
    pub(super) fn by_tables(&self, number: fn(&Route) -> f64) -> Option<f64> {
        self.route.as_ref().map(number)
    }

    /// How probably it is completed, if that is known.
    pub(super) fn completion(&self) -> Option<&Completion> {
        self.risk.as_ref().map(|risk| &risk.completion)
    }

    /// A number of the simulation, if there was one.
    pub(super) fn by_simulation(&self, number: fn(&DrivenRoute) -> f64) -> Option<f64> {
        self.driven.as_ref().map(number)
    }

    /// What a table does not say of it: some lines, or none.
    pub(super) fn lines(&self) -> String {
        let (name, record) = (self.name(), &self.record);
        let mut text = String::new();
        if let Some(reason) = record.reason.as_ref().filter(|_| record.hazards.is_empty()) {
            let _ = writeln!(text, "{name}: no safe route: {reason}");
        }
        for hazard in &record.hazards {
            let _ = writeln!(text, "not safe: {}", hazard.sentence);
        }
        if let Some(driven) = &record.simulated {
            let _ = writeln!(
                text,
                "{name}: driven by simulation: {}, {} s ({:+.1} %), {} J ({:+.1} %), {} m from \
                 the target",
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
}
