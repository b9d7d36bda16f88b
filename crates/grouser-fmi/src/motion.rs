//! The rover on its way: through a scenario, or through the legs of a mission.

use std::collections::VecDeque;

use grouser::mission::{Mission, MissionRun};
use grouser::simulation::{Outcome, OutcomeKind, Record, Run, Scenario, State};
use grouser::studies::mission::DrivenLeg;

use crate::drive::Drive;
use crate::model::FmuModel;
use crate::variables::{UNDER_WAY, number_of};

/// The rover on its way.
#[derive(Clone)]
pub(crate) enum RoverMotion {
    Scenario(Box<Run>),
    Mission(Box<LedMission>),
}

/// A mission on its way.
#[derive(Clone)]
pub(crate) struct LedMission {
    mission: Mission,
    run: MissionRun,
    /// The records of the leg under way and after it, from the last one on that was reached.
    records: VecDeque<Record>,
    /// When each leg that was driven ended [s], and what became of it.
    legs: Vec<(f64, DrivenLeg)>,
    is_over: bool,
}

/// Times that differ by less are one, but for rounding [s]: that of runs.
const SAME_TIME: f64 = 1e-9;

impl RoverMotion {
    /// The model at its start.
    ///
    /// # Errors
    /// A sentence where it cannot be computed.
    pub(crate) fn start(model: &FmuModel, parameters: &[f64]) -> Result<Self, String> {
        if let Some(mission) = model.mission(parameters)? {
            let run = MissionRun::new(&mission).map_err(|error| error.to_string())?;
            let (records, legs) = (VecDeque::new(), Vec::new());
            let mut driven = LedMission { mission, run, records, legs, is_over: false };
            driven.go_to(0.0)?;
            return Ok(Self::Mission(Box::new(driven)));
        }
        let scenario = model.scenario(parameters)?;
        let run = Run::new(&scenario).map_err(|error| error.to_string())?;
        Ok(Self::Scenario(Box::new(run)))
    }

    /// The model with a state of it.
    ///
    /// * `state`: of a run, as [`state`](Self::state) gives it; of a mission none
    /// * `span`: time since the start [s]
    ///
    /// # Errors
    /// A sentence for bytes that are no state of it.
    pub(crate) fn restored(
        model: &FmuModel,
        parameters: &[f64],
        state: &[u8],
        span: f64,
    ) -> Result<Self, String> {
        if state.is_empty() {
            // Nothing from outside changes a mission on its way: it is driven again.
            let mut motion = Self::start(model, parameters)?;
            if let Self::Mission(driven) = &mut motion {
                driven.go_to(span)?;
            }
            return Ok(motion);
        }
        let scenario: Scenario = model.scenario(parameters)?;
        let state = State::from_bytes(state, &scenario).map_err(|error| error.to_string())?;
        Ok(Self::Scenario(Box::new(Run::resume(&scenario, state))))
    }

    /// The state of a run as bytes; none of a mission.
    pub(crate) fn state(&self) -> Vec<u8> {
        match self {
            Self::Scenario(run) => run.state().to_bytes(),
            Self::Mission(_) => Vec::new(),
        }
    }

    /// Goes on. A rover whose outcome is known stays where it is.
    ///
    /// * `wheel_speeds`: that are commanded [rad/s], where inputs turn the wheels
    /// * `from`, `span`: since when, since the start, and for how long [s]
    ///
    /// # Errors
    /// A sentence where that cannot be computed.
    pub(crate) fn step(
        &mut self,
        model: &FmuModel,
        wheel_speeds: &[f64],
        [from, span]: [f64; 2],
    ) -> Result<(), String> {
        match self {
            Self::Mission(driven) => driven.go_to(from + span),
            Self::Scenario(run) if model.drive == Drive::Inputs => {
                let each = wheel_speeds.iter().zip(run.scenario().rover.mounts());
                let rims: Vec<f64> =
                    each.map(|(speed, mount)| speed * mount.shearing_radius()).collect();
                run.step(&rims, span).map_err(|error| error.to_string())
            }
            Self::Scenario(run) => {
                let done = run.play(span);
                // Nobody asks for records here, and long runs must not need memory for them.
                drop(run.take_records());
                done.map_err(|error| error.to_string())
            }
        }
    }

    /// The rover now.
    pub(crate) fn record(&self) -> Option<&Record> {
        match self {
            Self::Scenario(run) => Some(run.now()),
            Self::Mission(driven) => driven.records.front(),
        }
    }

    /// The number of what became of the rover, or of the leg that it is in, and why.
    pub(crate) fn outcome(&self) -> (i64, String) {
        match self {
            Self::Scenario(run) => {
                let outcome = run.outcome();
                let number = outcome.map_or(UNDER_WAY, |it| number_of(it.kind()));
                (number, outcome.and_then(Outcome::reason).unwrap_or_default())
            }
            Self::Mission(driven) => {
                let Some((_, leg)) = driven.legs.last().filter(|_| driven.is_at_end()) else {
                    return (UNDER_WAY, String::new());
                };
                let kind: OutcomeKind = leg.report.outcome.kind();
                (number_of(kind), leg.reason().unwrap_or_default())
            }
        }
    }

    /// The number of the leg that is driven; 0 without legs.
    pub(crate) fn leg(&self) -> i64 {
        let Self::Mission(driven) = self else { return 0 };
        let now = driven.records.front().map_or(0.0, |record| record.time);
        let ended = driven.legs.iter().filter(|(end, _)| *end <= now + SAME_TIME).count();
        // After the last one it stays there.
        i64::try_from(driven.legs.len().min(ended + 1)).unwrap_or(i64::MAX)
    }
}

impl LedMission {
    /// Goes on to the record of a time since the start [s].
    ///
    /// # Errors
    /// A sentence for a time without a record, and for a leg that cannot be computed.
    fn go_to(&mut self, time: f64) -> Result<(), String> {
        while !self.is_over && self.records.back().is_none_or(|last| last.time < time - SAME_TIME) {
            self.drive_leg()?;
        }
        // What was passed is not asked for again.
        let here = self.records.iter().position(|record| record.time > time - SAME_TIME);
        let last = self.records.len().saturating_sub(1);
        let here = here.unwrap_or(last);
        let found = self.records.get(here).map_or(time, |record| record.time);
        if found > time + SAME_TIME {
            let interval = self.mission.scenario.numerics.sample_interval;
            return Err(format!(
                "a mission is seen at multiples of its `sample_interval_s`, {interval} s, and at \
                 the ends of its legs: there is no record at {time} s"
            ));
        }
        self.records.drain(..here);
        Ok(())
    }

    fn drive_leg(&mut self) -> Result<(), String> {
        let Self { mission, run, records, legs, .. } = self;
        let mut keep = |new: &[Record]| {
            records.extend(new.iter().cloned());
            true
        };
        let report = run.next_leg_watched(&mut keep).map_err(|error| error.to_string())?;
        if let Some(report) = report.cloned() {
            let (number, leg) = (legs.len() + 1, mission.legs[legs.len()].clone());
            let origin = mission.scenario.ground.start;
            let end = run.time();
            legs.push((end, DrivenLeg { number, leg, report, origin }));
            return Ok(());
        }
        self.is_over = true;
        let last = self.run.clone().finish().trajectory.last().clone();
        if self.records.back().is_none_or(|record| record.time < last.time - SAME_TIME) {
            self.records.push_back(last);
        }
        Ok(())
    }

    /// Whether the last record was reached.
    fn is_at_end(&self) -> bool {
        self.is_over && self.records.len() <= 1
    }
}
