//! A route that is driven: what simulation makes of what the tables say.

use std::sync::Arc;

use super::answer::{Ends, Route};
use crate::elementary::wide::atan2;
use crate::mission::{Leg, Manoeuvre, Mission, MissionError, MissionRun};
use crate::simulation::{Approach, OutcomeKind, Scenario};
use crate::terrain::{ElevationModel, Ground};
use crate::units::Vec2;
use crate::vehicle::DriveLaw;

/// What became of a route that was driven.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenRoute {
    /// One word: `completed`, or what ended it.
    pub outcome: &'static str,
    /// How many of the legs between waypoints were completed.
    pub legs: usize,
    /// Way over the ground [m].
    pub distance: f64,
    /// Time, with turns [s].
    pub time: f64,
    /// Work of the wheels, with turns [J].
    pub energy: f64,
    /// What motors, and with a battery the electronics, took, with turns [J]; `None` where no motor
    /// is known.
    pub drawn: Option<f64>,
    /// Slip ratio over all legs, 1 less the way over the ground by that of the rims [-].
    pub slip_ratio: Option<f64>,
    /// How far from the target it ended [m].
    pub miss: f64,
}

/// How near to a waypoint is near enough [m].
const WITHIN: f64 = 0.1;

impl Route {
    /// The mission that drives the route: a leg to each waypoint, before which the rover turns on
    /// the spot to where it lies.
    ///
    /// * `scenario`: rover, soil, gravity and model
    /// * `rim_speed`: of all wheels [m/s]
    #[must_use]
    pub fn mission(
        &self,
        scenario: &Scenario,
        ground: &Arc<ElevationModel>,
        rim_speed: f64,
    ) -> Mission {
        let start = self.waypoints[0];
        let legs = self.waypoints.windows(2).filter(|pair| pair[0] != pair[1]).map(|pair| {
            let manoeuvre =
                Manoeuvre::Goto { place: pair[1] - start, within: WITHIN, reverse: false };
            let drive = DriveLaw::Constant(rim_speed);
            Leg { drive, yaw: Some(direction(pair[0], pair[1])), ..Leg::new(manoeuvre) }
        });
        let mut legs: Vec<Leg> = legs.collect();
        let mut scenario = scenario.clone();
        scenario.numerics.approach = Approach::QuasiSteady;
        if let Some(first) = legs.first_mut() {
            scenario.start.yaw = first.yaw.take().unwrap_or(0.0);
        }
        scenario.ground = Ground::map(scenario.ground.soil, Arc::clone(ground)).starting_at(start);
        scenario.yaw = None;
        Mission { scenario, legs, stops: Vec::new(), sensors: None }
    }

    /// Drives the route.
    ///
    /// # Errors
    /// [`MissionError`] if the motion cannot be computed.
    pub fn drive(
        &self,
        scenario: &Scenario,
        ground: &Arc<ElevationModel>,
        rim_speed: f64,
    ) -> Result<DrivenRoute, MissionError> {
        let mission = self.mission(scenario, ground, rim_speed);
        if mission.legs.is_empty() {
            return Ok(DrivenRoute::nowhere());
        }
        let mut run = MissionRun::new(&mission)?;
        while run.next_leg_watched(&mut |_| true)?.is_some() {}
        let report = run.finish();
        let sum =
            |of: fn(&crate::mission::LegReport) -> f64| report.legs.iter().map(of).sum::<f64>();
        let distance = sum(|leg| leg.distance);
        let rims =
            report.legs.iter().filter_map(|leg| Some(leg.distance / (1.0 - leg.slip_ratio?)));
        let rims: f64 = rims.sum();
        let completed = report.legs.iter().filter(|leg| leg.outcome.is_completed()).count();
        let end = report.legs.last().map_or_else(Vec2::zeros, |leg| leg.end.position);
        let target = self.waypoints[self.waypoints.len() - 1] - self.waypoints[0];
        Ok(DrivenRoute {
            outcome: report
                .legs
                .last()
                .map_or(OutcomeKind::Completed, |leg| leg.outcome.kind())
                .name(),
            legs: completed,
            distance,
            time: sum(|leg| leg.time),
            energy: sum(|leg| leg.energy),
            drawn: report.taken().map(|taken| taken.energy),
            slip_ratio: (rims > 0.0).then(|| 1.0 - distance / rims),
            miss: (target - end).norm(),
        })
    }
}

impl DrivenRoute {
    /// Where start and target are one place.
    fn nowhere() -> Self {
        Self {
            outcome: OutcomeKind::Completed.name(),
            legs: 0,
            distance: 0.0,
            time: 0.0,
            energy: 0.0,
            drawn: None,
            slip_ratio: None,
            miss: 0.0,
        }
    }
}

impl Ends {
    /// The straight line between them [m].
    #[must_use]
    pub fn distance(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

/// The direction from one place to another [rad].
fn direction(from: Vec2, to: Vec2) -> f64 {
    let way = to - from;
    atan2(way.y, way.x)
}
