//! The units of work.

use grouser::contact::{settle, settle_many};
use grouser::simulation::equations::Equations;
use grouser::simulation::{Approach, Run, Scenario};
use grouser::studies::heading::HeadingStudy;
use grouser::vehicle::DriveLaw;
use grouser::vehicle::reaction::Ground;
use rayon::prelude::*;

use crate::fixtures::Fixtures;

/// A unit of work, by the key of its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// The reaction on one wheel at a sinkage, one after the other.
    ForceSingle,
    /// The same for many wheels at once.
    ForceBatched,
    /// A wheel that settles under its load, one after the other.
    SettleSingle,
    /// The same for many wheels at once.
    SettleBatched,
    /// One evaluation of a four-wheel rover's motion.
    RoverRates,
    /// A traverse of 20 s, all accelerations integrated.
    TraverseDynamic,
    /// The same as a sequence of steady states.
    TraverseQuasiSteady,
    /// The heading offset on 25 slopes up to the steepest.
    HeadingCurve,
    /// Quasi-steady traverses of 20 s on varied soil, on all cores.
    Campaign,
}

/// The result of a unit of work.
#[derive(Clone, Copy, Debug)]
pub struct Done {
    /// How often the unit was done.
    pub count: usize,
    /// Something of every result, so that nothing can be left out; the same at every call.
    pub checksum: f64,
}

impl Unit {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::ForceSingle,
        Self::ForceBatched,
        Self::SettleSingle,
        Self::SettleBatched,
        Self::RoverRates,
        Self::TraverseDynamic,
        Self::TraverseQuasiSteady,
        Self::HeadingCurve,
        Self::Campaign,
    ];

    /// Name of its time, with the unit.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::ForceSingle => "force_ns_single",
            Self::ForceBatched => "force_ns_batched",
            Self::SettleSingle => "settle_ns_single",
            Self::SettleBatched => "settle_ns_batched",
            Self::RoverRates => "rover_rhs_us",
            Self::TraverseDynamic => "traverse_dynamic_ms",
            Self::TraverseQuasiSteady => "traverse_quasi_steady_ms",
            Self::HeadingCurve => "attitude_curve_ms",
            Self::Campaign => "campaign_traverses_per_s",
        }
    }
}

impl Fixtures {
    /// Does a unit of work, as often as it takes to be worth a look at the clock.
    ///
    /// # Panics
    /// If a fixture cannot be computed: it always could.
    #[must_use]
    pub fn work(&self, unit: Unit) -> Done {
        match unit {
            Unit::ForceSingle => self.force_single(),
            Unit::ForceBatched => self.force_batched(),
            Unit::SettleSingle => self.settle_single(),
            Unit::SettleBatched => self.settle_batched(),
            Unit::RoverRates => self.rover_rates(),
            Unit::TraverseDynamic => traverse(&self.scenario),
            Unit::TraverseQuasiSteady => traverse(&self.quasi_steady()),
            Unit::HeadingCurve => self.heading_curve(),
            Unit::Campaign => self.run_campaign(),
        }
    }

    fn force_single(&self) -> Done {
        let model = self.scenario.theory.model();
        // Each wheel waits for the one before: its sinkage carries a trace of the last force.
        let mut trace = 0.0;
        for wheel in &self.wheels {
            trace = model.forces(&wheel.contact, wheel.sinkage + trace).side_force * 1e-300;
        }
        Done { count: self.wheels.len(), checksum: trace }
    }

    fn force_batched(&self) -> Done {
        let model = self.scenario.theory.model();
        let forces = self.wheels.iter().map(|it| model.forces(&it.contact, it.sinkage));
        Done { count: self.wheels.len(), checksum: forces.map(|it| it.drawbar_pull).sum() }
    }

    fn settle_single(&self) -> Done {
        let model = self.scenario.theory.model();
        let mut trace = 0.0;
        for wheel in &self.wheels {
            let settled = settle(model, &wheel.contact, wheel.load + trace).expect("it is carried");
            trace = settled.sinkage * 1e-300;
        }
        Done { count: self.wheels.len(), checksum: trace }
    }

    fn settle_batched(&self) -> Done {
        let settled = settle_many(self.scenario.theory.model(), &self.batch);
        let sinkages = settled.iter().map(|it| it.as_ref().expect("it is carried").sinkage);
        Done { count: self.batch.len(), checksum: sinkages.sum() }
    }

    fn rover_rates(&self) -> Done {
        /// Evaluations of the motion for one look at the clock.
        const TIMES: usize = 256;
        let Scenario { rover, site, theory, sharing, own_moments, drive, .. } = &self.scenario;
        let &DriveLaw::Constant(speed) = drive else { unreachable!("the wheels turn steadily") };
        let rim_speeds = vec![speed; rover.wheel_count()];
        let (sharing, own_moments) = (*sharing, *own_moments);
        let (model, differences) = (theory.model(), self.scenario.differences());
        let ground = Ground { rover, site, model, sharing, own_moments, differences };
        let equations = Equations::new(ground, &rim_speeds);
        let mut state = self.scenario.start_state(&rim_speeds);
        let mut sum = 0.0;
        for time in 0..TIMES {
            state.yaw = 1e-4 * time as f64;
            sum += equations.rates(&state).expect("it stands").acceleration.yaw_acceleration;
        }
        Done { count: TIMES, checksum: sum }
    }

    fn heading_curve(&self) -> Done {
        let curve = HeadingStudy::of(&self.scenario).curve().expect("it has one");
        let (steepest, _) = curve.limit().expect("it can move");
        let slopes = (1..=25).map(|step| steepest * f64::from(step) / 25.0);
        Done {
            count: 1,
            checksum: slopes.filter_map(|it| curve.at(it).ok()).map(|it| it.yaw).sum(),
        }
    }

    fn run_campaign(&self) -> Done {
        let ends: Vec<f64> = self.campaign.par_iter().map(|it| traverse(it).checksum).collect();
        Done { count: ends.len(), checksum: ends.iter().sum() }
    }

    /// The scenario with velocities in balance.
    #[must_use]
    pub fn quasi_steady(&self) -> Scenario {
        let mut scenario = self.scenario.clone();
        scenario.numerics.approach = Approach::QuasiSteady;
        scenario
    }
}

fn traverse(scenario: &Scenario) -> Done {
    let run = Run::new(scenario).and_then(Run::to_end).expect("the scenario runs");
    Done { count: 1, checksum: run.last().state.position.y }
}
