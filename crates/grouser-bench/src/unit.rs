//! The units of work.

use std::f64::consts::TAU;

use grouser::contact::{
    Contact, InstructionSet, Model, SettleError, forces_many, settle, settle_many,
};
use grouser::simulation::equations::Equations;
use grouser::simulation::{Approach, Run, Scenario};
use grouser::studies::heading::HeadingStudy;
use grouser::vehicle::DriveLaw;
use rayon::prelude::*;

use crate::fixtures::{Draws, Fixtures};

/// A unit of work, by the key of its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// A multiplication or an addition of two doubles, among many that do not wait for each other:
    /// what the machine does at most.
    Operation,
    /// The reaction on one wheel at a sinkage, one after the other.
    ForceSingle,
    /// The same for many wheels at once.
    ForceBatched,
    /// A wheel that settles under its load, one after the other.
    SettleSingle,
    /// The same for many wheels at once.
    SettleBatched,
    /// A wheel that settles by resistive force theory, one after the other.
    SettleFacets,
    /// Wheels that the soil cannot carry, one after the other: that is known, and how much it
    /// carries.
    SettleOverloaded,
    /// One evaluation of a four-wheel rover's motion.
    RoverRates,
    /// A traverse of 20 s, all accelerations integrated.
    TraverseDynamic,
    /// The same as a sequence of steady states.
    TraverseQuasiSteady,
    /// The traverse of 20 s without records but of its start and its end, all accelerations
    /// integrated.
    TraverseDynamicOutcome,
    /// The same as a sequence of steady states.
    TraverseQuasiSteadyOutcome,
    /// A step of 20 ms under speeds that change at every step, all accelerations integrated.
    ControlStep,
    /// The same as a sequence of steady states.
    ControlStepQuasiSteady,
    /// Steps under random speeds, within 30 % of the usual one, all accelerations integrated.
    RandomStep,
    /// Steps under any speeds, rests and reversals among them, all accelerations integrated.
    StopAndGoStep,
    /// The heading offset on 25 slopes up to the steepest.
    HeadingCurve,
    /// Ends of quasi-steady traverses of 20 s on varied soil, on all cores.
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
    pub const ALL: [Self; 18] = [
        Self::Operation,
        Self::ForceSingle,
        Self::ForceBatched,
        Self::SettleSingle,
        Self::SettleBatched,
        Self::SettleFacets,
        Self::SettleOverloaded,
        Self::RoverRates,
        Self::TraverseDynamic,
        Self::TraverseQuasiSteady,
        Self::TraverseDynamicOutcome,
        Self::TraverseQuasiSteadyOutcome,
        Self::ControlStep,
        Self::ControlStepQuasiSteady,
        Self::RandomStep,
        Self::StopAndGoStep,
        Self::HeadingCurve,
        Self::Campaign,
    ];

    /// Name of its time, with the unit.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Operation => "operation_ns",
            Self::ForceSingle => "force_ns_single",
            Self::ForceBatched => "force_ns_batched",
            Self::SettleSingle => "settle_ns_single",
            Self::SettleBatched => "settle_ns_batched",
            Self::SettleFacets => "rft_settle_us",
            Self::SettleOverloaded => "settle_ns_overloaded",
            Self::RoverRates => "rover_rhs_us",
            Self::TraverseDynamic => "traverse_dynamic_ms",
            Self::TraverseQuasiSteady => "traverse_quasi_steady_ms",
            Self::TraverseDynamicOutcome => "traverse_dynamic_outcome_ms",
            Self::TraverseQuasiSteadyOutcome => "traverse_quasi_steady_outcome_ms",
            Self::ControlStep => "control_step_us",
            Self::ControlStepQuasiSteady => "control_step_quasi_steady_us",
            Self::RandomStep => "random_step_us",
            Self::StopAndGoStep => "stop_and_go_step_us",
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
            Unit::Operation => operations(),
            Unit::ForceSingle => self.force_single(),
            Unit::ForceBatched => self.force_batched(),
            Unit::SettleSingle => settle_one_by_one(&self.scenario.model, &self.batch),
            Unit::SettleBatched => self.settle_batched(),
            Unit::SettleFacets => settle_one_by_one(&Model::Rft, &self.faceted),
            Unit::SettleOverloaded => self.settle_overloaded(),
            Unit::RoverRates => self.rover_rates(),
            Unit::TraverseDynamic => traverse(&self.scenario),
            Unit::TraverseQuasiSteady => traverse(&self.quasi_steady()),
            Unit::TraverseDynamicOutcome => outcome(&self.scenario),
            Unit::TraverseQuasiSteadyOutcome => outcome(&self.quasi_steady()),
            Unit::ControlStep => control(&self.scenario, StepCommands::Gentle),
            Unit::ControlStepQuasiSteady => control(&self.quasi_steady(), StepCommands::Gentle),
            Unit::RandomStep => control(&self.scenario, StepCommands::Random),
            Unit::StopAndGoStep => control(&self.scenario, StepCommands::StopAndGo),
            Unit::HeadingCurve => self.heading_curve(),
            Unit::Campaign => self.run_campaign(),
        }
    }

    fn force_single(&self) -> Done {
        let model = self.scenario.model.as_ref();
        // Each wheel waits for the one before: its sinkage carries a trace of the last force.
        let mut trace = 0.0;
        for wheel in &self.wheels {
            trace = model.forces(&wheel.contact, wheel.sinkage + trace).side_force * 1e-300;
        }
        Done { count: self.wheels.len(), checksum: trace }
    }

    fn force_batched(&self) -> Done {
        let forces = forces_many(self.scenario.model.as_ref(), &self.sunk);
        let count = forces.len();
        Done { count, checksum: forces.iter().map(|it| it.drawbar_pull).sum() }
    }

    fn settle_batched(&self) -> Done {
        let settled = settle_many(self.scenario.model.as_ref(), &self.batch);
        let sinkages = settled.iter().map(|it| it.as_ref().expect("it is carried").sinkage);
        Done { count: self.batch.len(), checksum: sinkages.sum() }
    }

    fn settle_overloaded(&self) -> Done {
        let model = self.scenario.model.as_ref();
        let capacity = |(contact, load): &(Contact, f64)| match settle(model, contact, *load) {
            Err(SettleError::SunkToAxle { capacity, .. }) => capacity,
            answer => unreachable!("the soil does not carry it: {answer:?}"),
        };
        let sum = self.overloaded.iter().map(capacity).sum();
        Done { count: self.overloaded.len(), checksum: sum }
    }

    fn rover_rates(&self) -> Done {
        /// Evaluations of the motion for one look at the clock.
        const TIMES: usize = 256;
        let rover = &self.scenario.rover;
        let DriveLaw::Constant(speed) = self.scenario.drive else {
            unreachable!("the wheels turn steadily")
        };
        let rim_speeds = vec![speed; rover.wheel_count()];
        let equations = Equations::of(&self.scenario, &rim_speeds);
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
        let ends: Vec<f64> = self.campaign.par_iter().map(|it| outcome(it).checksum).collect();
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

/// Each wheel waits for the one before: its load [N] carries a trace of the last sinkage.
fn settle_one_by_one(model: &Model, wheels: &[(Contact, f64)]) -> Done {
    let mut trace = 0.0;
    for (contact, load) in wheels {
        let settled = settle(model.as_ref(), contact, load + trace).expect("it is carried");
        trace = settled.sinkage * 1e-300;
    }
    Done { count: wheels.len(), checksum: trace }
}

/// Multiplications and additions of doubles that the force of a driving wheel of the paper takes at
/// least: 674 and about 150 of four at once, and about 140 of one. Source: counted in the compiled
/// program, `docs/performance.md`.
pub const OPERATIONS_OF_A_FORCE: f64 = 4.0 * (674.0 + 150.0) + 140.0;

fn operations() -> Done {
    const ROUNDS: usize = 10_000;
    let set = InstructionSet::best();
    Done { count: ROUNDS * set.operations_a_round(), checksum: set.multiply_and_add(ROUNDS) }
}

fn traverse(scenario: &Scenario) -> Done {
    let run = Run::new(scenario).and_then(Run::to_end).expect("the scenario runs");
    Done { count: 1, checksum: run.last().state.position.y }
}

fn outcome(scenario: &Scenario) -> Done {
    let run = Run::new(scenario).and_then(Run::to_outcome).expect("the scenario runs");
    Done { count: 1, checksum: run.last().state.position.y }
}

fn control(scenario: &Scenario, commands: StepCommands) -> Done {
    let run = controlled(scenario, commands);
    Done { count: CONTROL_STEPS, checksum: run.state().rover().position.y }
}

/// Length of a step under changed speeds [s].
const CONTROL_PERIOD: f64 = 0.02;
/// How many of them are one piece of work: 5 s.
const CONTROL_STEPS: usize = 250;

/// How the speeds of wheels change from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepCommands {
    /// Those of both sides rise and fall by a fifth within 5 s, and by a tenth against each other
    /// within 7 s.
    Gentle,
    /// Each wheel has a speed of its own, up to 30 % above or below the usual one.
    Random,
    /// Each wheel has a speed of its own between the usual one backward and forward, and every
    /// fifth step all rest.
    StopAndGo,
}

impl StepCommands {
    /// The speed of each wheel over the usual one, in a step; `sides` are left 1, right −1.
    fn shares(self, step: usize, sides: &[f64], draws: &mut Draws) -> Vec<f64> {
        let wave = |period: f64| (TAU * CONTROL_PERIOD * step as f64 / period).sin();
        let of_each = |side: &f64| match self {
            Self::Gentle => 1.0 + 0.2 * wave(5.0) - 0.1 * wave(7.0) * side,
            Self::Random => draws.between(0.7, 1.3),
            Self::StopAndGo if step % 5 == 4 => 0.0,
            Self::StopAndGo => draws.between(-1.0, 1.0),
        };
        sides.iter().map(of_each).collect()
    }
}

/// A rover led through these steps under speeds that change at every one.
///
/// # Panics
/// If a step cannot be computed: those of the fixtures always could.
#[must_use]
pub fn controlled(scenario: &Scenario, commands: StepCommands) -> Run {
    let mut run = Run::new(scenario).expect("the scenario starts");
    let base = scenario.drive.nominal_rim_speed();
    let mounts = scenario.rover.mounts().iter();
    let sides: Vec<f64> = mounts.map(|mount| mount.position.y.signum()).collect();
    let mut draws = Draws::new();
    for step in 0..CONTROL_STEPS {
        let shares = commands.shares(step, &sides, &mut draws);
        let rim_speeds: Vec<f64> = shares.into_iter().map(|share| base * share).collect();
        run.step(&rim_speeds, CONTROL_PERIOD).expect("the rover goes on");
    }
    run
}
