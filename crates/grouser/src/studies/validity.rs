//! Flags of validity of a rover: those of its wheels together, at rest or in motion, on a slope or
//! over a run.

use crate::contact::Model;
use crate::contact::validity::{Finding, Situation, union};
use crate::simulation::{Record, Scenario, Trajectory};
use crate::soil::Soil;
use crate::terrain::SoilZones;
use crate::vehicle::{Attitude, Mount, Rover, WheelReaction};

/// A rover on a slope of some soil.
#[derive(Clone, Copy, Debug)]
pub struct RoverOnSlope<'a> {
    /// The rover.
    pub rover: &'a Rover,
    /// The soil.
    pub soil: &'a Soil,
    /// Zones of other soils, where there are some.
    pub zones: Option<&'a SoilZones>,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: &'a Model,
    /// Slope, *α* [rad]; on ground with heights that of the body is in its place.
    pub slope: f64,
}

/// A flag, when it was raised first in a run, and by which wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raised {
    /// The flag with its number and range there.
    pub finding: Finding,
    /// Time since the start [s].
    pub time: f64,
}

impl<'a> RoverOnSlope<'a> {
    /// The rover of a scenario on its slope.
    #[must_use]
    pub fn of(scenario: &'a Scenario) -> Self {
        Self {
            rover: &scenario.rover,
            soil: &scenario.ground.soil,
            zones: scenario.ground.zones.as_deref(),
            gravity: scenario.gravity,
            model: &scenario.model,
            slope: scenario.ground.plane_slope().unwrap_or(0.0),
        }
    }

    /// The flags of its wheels together, each once.
    ///
    /// * `wheels`: in the mounts' order; of wheels that are not there, only what needs no motion is
    ///   looked at
    #[must_use]
    pub fn findings<'w>(&self, wheels: impl Iterator<Item = &'w WheelReaction>) -> Vec<Finding>
    where
        'a: 'w,
    {
        self.findings_on(wheels, |_| self.soil)
    }

    /// The same, each wheel on a soil of its own.
    fn findings_on<'w>(
        &self,
        mut wheels: impl Iterator<Item = &'w WheelReaction>,
        soil: impl Fn(&Mount) -> &'a Soil,
    ) -> Vec<Finding>
    where
        'a: 'w,
    {
        union(self.rover.mounts().iter().map(|mount| {
            let reaction = wheels.next();
            Situation {
                model: self.model,
                wheel: &mount.unit.wheel,
                soil: soil(mount),
                gravity: self.gravity,
                slope: self.slope,
                load: reaction.map(|it| it.load),
                slip: reaction.map(|it| it.slip),
                settled: reaction.map(|it| &it.settled),
            }
        }))
    }

    /// The flags of one record of a run, each wheel on the soil below its hub.
    #[must_use]
    pub fn at(&self, record: &Record) -> Vec<Finding> {
        let slope = record.standing().map_or(self.slope, Attitude::tilt);
        let there = Self { slope, ..*self };
        let turn = record.state.slope_from_body();
        let soil = |mount: &Mount| {
            let hub = record.place() + turn * mount.position.xy();
            self.zones.and_then(|zones| zones.soil(hub)).unwrap_or(self.soil)
        };
        there.findings_on(record.wheels.iter().map(|wheel| &wheel.reaction), soil)
    }

    /// The flags that any record of a run raises, in the order of time and of the list.
    #[must_use]
    pub fn over(&self, run: &Trajectory) -> Vec<Raised> {
        let mut all: Vec<Raised> = Vec::new();
        for record in &run.records {
            for finding in self.at(record) {
                if all.iter().all(|it| it.finding.flag != finding.flag) {
                    all.push(Raised { finding, time: record.time });
                }
            }
        }
        all
    }
}
