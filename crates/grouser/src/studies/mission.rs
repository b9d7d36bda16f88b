//! Missions that are driven, and what became of each leg beside what it was to be.

use rayon::prelude::*;

use crate::mission::{Leg, LegReport, Mission, MissionError, MissionReport, MissionRun};
use crate::units::Vec2;

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

    /// Those of its legs that lead somewhere.
    pub fn ways(&self) -> impl Iterator<Item = &LegReport> {
        self.legs.iter().map(|leg| &leg.report).filter(|report| report.slip_ratio.is_some())
    }
}
