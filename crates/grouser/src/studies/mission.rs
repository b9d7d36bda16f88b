//! Missions that are driven, and what became of each leg beside what it was to be.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use super::completion::{Completion, SampleEnd};
use super::ensemble::samples::{Sample, outputs_of_samples};
use super::mobility::{advised_place, slope_and_course};
use super::verdict::{Advice, SlopeStudy, SpotTurn, SpotTurns};
use crate::elementary::wide::{asin, atan2, sin_cos, tan};
use crate::error::ParameterError;
use crate::mission::{
    Heading, Leg, LegOutcome, LegReport, Manoeuvre, Mission, MissionError, MissionReport,
    MissionRun,
};
use crate::simulation::{Approach, Integrator, Numerics, Scenario};
use crate::units::Vec2;
use crate::vehicle::RoverState;

/// A mission that was driven, leg by leg.
#[derive(Clone, Debug)]
pub struct DrivenMission {
    /// What it is called among alternatives; empty where there are none.
    pub name: String,
    /// How many legs it was to have.
    pub planned: usize,
    /// Those that were begun.
    pub legs: Vec<DrivenLeg>,
    /// The whole.
    pub report: MissionReport,
}

/// A leg that was driven, and what it was to be.
#[derive(Clone, Debug)]
pub struct DrivenLeg {
    /// Its number, counted from 1.
    pub number: usize,
    /// What was to be driven.
    pub leg: Leg,
    /// What became of it.
    pub report: LegReport,
    /// Where the mission starts, in the coordinates of ground with heights [m]; zero on a plane.
    /// Places of leg and report are seen from there.
    pub origin: Vec2,
}

/// The place that advice on a leg is about, as slope and course [rad], and the moments of its turns.
type AskedLeg = (Option<(f64, f64)>, Vec<SpotTurn>);

impl DrivenMission {
    /// Drives missions, each from its start.
    ///
    /// * `missions`: by their names among alternatives
    ///
    /// # Errors
    /// [`MissionError`] of the first that can be no mission, or whose motion cannot be computed.
    pub fn all(missions: &[(String, Mission)]) -> Result<Vec<Self>, MissionError> {
        missions.par_iter().map(|(name, mission)| Self::drive(name, mission)).collect()
    }

    /// Drives missions for what becomes of their legs: of their records the last is kept alone, so
    /// that a mission of weeks needs no more memory than one of minutes.
    ///
    /// # Errors
    /// The same as [`all`](Self::all).
    pub fn all_ends(missions: &[(String, Mission)]) -> Result<Vec<Self>, MissionError> {
        let end = |(name, mission): &(String, Mission)| {
            let mut run = MissionRun::new(mission)?;
            while run.next_leg_watched(&mut |_| true)?.is_some() {}
            Ok(Self::of(name, mission, run.finish()))
        };
        missions.par_iter().map(end).collect()
    }

    /// Drives a mission to its end.
    ///
    /// # Errors
    /// The same as [`all`](Self::all).
    pub fn drive(name: &str, mission: &Mission) -> Result<Self, MissionError> {
        Ok(Self::of(name, mission, MissionRun::new(mission)?.to_end()?))
    }

    /// The legs of a mission that were begun.
    #[must_use]
    pub fn of(name: &str, mission: &Mission, report: MissionReport) -> Self {
        let origin = mission.scenario.ground.start;
        let legs = mission.legs.iter().zip(&report.legs).enumerate();
        let legs = legs.map(|(place, (leg, report))| DrivenLeg {
            number: place + 1,
            leg: leg.clone(),
            report: report.clone(),
            origin,
        });
        Self { name: name.to_owned(), planned: mission.legs.len(), legs: legs.collect(), report }
    }

    /// For each leg that was begun the place that advice is about, as slope and course [rad], and the
    /// moments of its turns on the spot. On a plane the place is its slope and the course that the leg
    /// asks for or has gone, over ground with heights the steepest of the way. `None` for legs that
    /// lead nowhere, that are driven backward or with wheels that crab, and over zones of soil: advice
    /// is about a nose in front on one soil.
    fn asked(&self, scenario: &Scenario) -> Vec<AskedLeg> {
        // Places are seen from where the mission starts.
        let mut end = RoverState { yaw: scenario.start.yaw, ..RoverState::default() };
        let asked = |leg: &DrivenLeg| {
            let before = std::mem::replace(&mut end, leg.report.end);
            if scenario.ground.zones.is_some() {
                return (None, Vec::new());
            }
            let way = leg.way(before.position, before.yaw).filter(|_| leg.is_nose_first());
            let place = way.map(|way| leg.place(scenario, before.position, way));
            (place, leg.turns(scenario, before))
        };
        self.legs.iter().map(asked).collect()
    }

    /// What to do on each leg that was begun, if it leads somewhere or turns on the spot: where the
    /// turn before its way has the worse verdict, in that. `None` if `go_on` was false before the
    /// end.
    ///
    /// # Errors
    /// The same as [`SlopeStudy::advice`].
    pub fn advice(
        &self,
        study: &SlopeStudy,
        scenario: &Scenario,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Option<Advice>>>, ParameterError> {
        let asked = self.asked(scenario);
        let places: Vec<_> = asked.iter().filter_map(|it| it.0).collect();
        let Some(ways) = study.advice_at(&places, samples, go_on)? else { return Ok(None) };
        let (mut ways, spot_turns) = (ways.into_iter(), SpotTurns::of(study, samples));
        let leg = |(place, turns): (Option<_>, Vec<SpotTurn>)| {
            let way: Option<Advice> = place.and_then(|_| ways.next());
            let verdict = |it: &Advice| it.judgement.verdict;
            let all = way.into_iter().chain(spot_turns.advice(&turns));
            all.reduce(|one, other| if verdict(&other) > verdict(&one) { other } else { one })
        };
        Ok(Some(asked.into_iter().map(leg).collect()))
    }

    /// Those of its legs that lead somewhere.
    pub fn ways(&self) -> impl Iterator<Item = &LegReport> {
        self.legs.iter().map(|leg| &leg.report).filter(|report| report.slip_ratio.is_some())
    }
}

impl DrivenLeg {
    /// Whether it is driven forward, with wheels that point ahead.
    fn is_nose_first(&self) -> bool {
        let is_crab = matches!(self.leg.heading, Heading::Crab { .. });
        self.leg.manoeuvre.direction() > 0.0 && !is_crab
    }

    /// The way that it asks for, or that was gone where it asks for none, from where it begins [m];
    /// `None` for one that leads nowhere.
    fn way(&self, from: Vec2, yaw: f64) -> Option<Vec2> {
        let gone = self.report.end.position - from;
        let way = match self.leg.manoeuvre {
            Manoeuvre::Turn { .. } | Manoeuvre::Wait { .. } => return None,
            Manoeuvre::Goto { place, .. } => place - from,
            Manoeuvre::Arc { .. } => gone,
            // A yaw says where the nose points, not where the rover goes.
            Manoeuvre::Drive { distance, .. }
                if self.leg.heading != Heading::Contour && gone.norm() > 0.1 * distance.abs() =>
            {
                gone
            }
            Manoeuvre::Drive { distance, .. } => {
                let (sin, cos) = sin_cos(self.leg.yaw.unwrap_or(yaw));
                Vec2::new(cos, sin) * distance
            }
        };
        (way.norm() > 0.0).then_some(way)
    }

    /// The moments of its turns on the spot: before it, and as a manoeuvre.
    fn turns(&self, scenario: &Scenario, mut before: RoverState) -> Vec<SpotTurn> {
        let is_first = self.number == 1;
        before.yaw = self.leg.yaw.filter(|_| is_first).unwrap_or(before.yaw);
        let to_yaw = self.leg.turn_before(scenario, &before, is_first).map(|it| it - before.yaw);
        let itself = match self.leg.manoeuvre {
            Manoeuvre::Turn { angle } => Some(angle),
            _ => None,
        };
        let (lie, _) = scenario.ground_under(&before);
        let slope = asin(lie.steepness().clamp(0.0, 1.0));
        let slope = scenario.ground.plane_slope().unwrap_or(advised_place((slope, 0.0)).0);
        let uphill = lie.uphill().unwrap_or_else(Vec2::zeros);
        let yaw = before.yaw - (atan2(uphill.y, uphill.x) - FRAC_PI_2);
        let turns = [(yaw, to_yaw), (yaw + to_yaw.unwrap_or(0.0), itself)].into_iter();
        turns
            .filter_map(|(from, angle)| angle.map(|it| SpotTurn::moments(slope, from, it)))
            .flatten()
            .collect()
    }

    fn place(&self, scenario: &Scenario, from: Vec2, way: Vec2) -> (f64, f64) {
        /// Places of the way that are looked at.
        const PLACES: usize = 33;
        let is_contour = self.leg.heading == Heading::Contour;
        let yaw = atan2(way.y, way.x);
        if let Some(slope) = scenario.ground.plane_slope() {
            let along = way.normalize();
            let course = asin(along.y.clamp(-1.0, 1.0));
            let (_, course) = advised_place((slope, if is_contour { 0.0 } else { course }));
            return (slope, course);
        }
        let gone = self.report.end.position - from;
        let look = |place: usize| {
            let position = from + gone * (place as f64 / (PLACES - 1) as f64);
            let (velocity, yaw_rate) = (Vec2::zeros(), 0.0);
            let state = RoverState { position, yaw, velocity, yaw_rate };
            let (lie, _) = scenario.ground_under(&state);
            let rise = tan(asin(lie.steepness().clamp(0.0, 1.0)));
            let uphill = lie.uphill().unwrap_or_else(Vec2::zeros);
            let along = if is_contour { 0.0 } else { rise * uphill.dot(&way.normalize()) };
            slope_and_course(along, (rise * rise - along * along).max(0.0).sqrt())
        };
        let steepest = (0..PLACES).map(look).max_by(|one, other| one.0.total_cmp(&other.0));
        advised_place(steepest.unwrap_or_default())
    }
}

impl Completion {
    /// Drives a mission on each sample, quasi-steadily; `None` if `go_on` was false before the end.
    /// Soils of zones, and what scatters, are the mission's own in all of them.
    ///
    /// * `samples`: of soil and model; with none there is the mission as it is written alone
    /// * `go_on`: asked before each sample, from any thread
    pub fn of_mission(
        mission: &Mission,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let scenario = &mission.scenario;
        let as_written = [Sample { soil: scenario.ground.soil, model: scenario.model.clone() }];
        let samples = if samples.is_empty() { &as_written } else { samples };
        let end = |sample: &Sample| end_of(mission, sample).unwrap_or(SampleEnd::NotComputed);
        let ends = outputs_of_samples(samples, go_on, end)?;
        Some(Self::of(&ends))
    }
}

/// Relative tolerance of runs on samples where they are no steady motions: samples differ from each
/// other by hundreds of times as much.
const ROUGHLY: f64 = 1e-3;

/// How a mission ends on a sample.
fn end_of(mission: &Mission, sample: &Sample) -> Result<SampleEnd, MissionError> {
    let mut scenario = mission.scenario.clone();
    scenario.ground.soil = sample.soil;
    scenario.model = sample.model.clone();
    let (approach, integrator) =
        (Approach::QuasiSteady, Integrator::Adaptive { tolerance: ROUGHLY });
    scenario.numerics = Numerics { approach, integrator, ..scenario.numerics };
    let mission = Mission { scenario, ..mission.clone() };
    let mut run = MissionRun::new(&mission)?;
    while run.next_leg_watched(&mut |_| true)?.is_some() {}
    let report = run.finish();
    let last = report.legs.last().map(|leg| &leg.outcome);
    let is_whole =
        report.legs.len() == mission.legs.len() && last.is_some_and(LegOutcome::is_completed);
    let limit = match last {
        Some(LegOutcome::Stopped(stopped)) => stopped.limit(),
        _ => None,
    };
    Ok(if is_whole {
        SampleEnd::Completed
    } else {
        SampleEnd::In(report.legs.len(), report.outcome(), limit)
    })
}
