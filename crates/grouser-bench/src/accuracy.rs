//! Accuracy of the units of work, against the same results computed with much more effort.

use grouser::contact::{Ishigami, Rft, WheelForces, WheelSoilModel as _, settle};
use grouser::simulation::{Integrator, Run, Scenario};
use grouser::studies::heading::{HeadingOffset, HeadingStudy};
use grouser::vehicle::dynamics;
use grouser::vehicle::on_ground::forces_of;

use crate::fixtures::Fixtures;
use crate::unit::{StepCommands, controlled};

/// The largest errors over the fixtures.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Error of a wheel's forces against four times as many nodes, over its load [-].
    pub force: f64,
    /// Error of the force that carries a settled wheel against its load, over the load [-].
    pub settle: f64,
    /// Error of a settled wheel's forces by resistive force theory against four times as many nodes
    /// over the arc and twenty times as many across, over its load [-].
    pub settle_facets: f64,
    /// Error of the end of a dynamic traverse against a tolerance a thousand times as tight [m].
    pub traverse_dynamic: f64,
    /// Error of the end of a quasi-steady traverse against the same dynamic one [m].
    pub traverse_quasi_steady: f64,
    /// Error of where 250 steps of 20 ms under changing speeds lead, against a tolerance a thousand
    /// times as tight [m].
    pub control_step: f64,
    /// The same of quasi-steady steps [m].
    pub control_step_quasi_steady: f64,
    /// Error of the place where a rover is after steps under random speeds [m].
    pub random_step: f64,
    /// Error of the place where a rover is after steps under any speeds, rests among them [m].
    pub stop_and_go_step: f64,
    /// Error of the equilibrium of forces on the curve of heading offsets, over the weight [-].
    pub heading_curve: f64,
}

impl Accuracy {
    /// Measures the errors.
    ///
    /// # Panics
    /// If a fixture cannot be computed: it always could.
    #[must_use]
    pub fn of(fixtures: &Fixtures) -> Self {
        let Fixtures { scenario, .. } = fixtures;
        let exact = end(&tight(scenario));
        let miss = |scenario: &Scenario| {
            let (x, y) = end(scenario);
            (x - exact.0).hypot(y - exact.1)
        };
        let led = |scenario: &Scenario, commands: StepCommands| {
            controlled(scenario, commands).state().rover().position
        };
        let miss_of_steps = |scenario: &Scenario, commands: StepCommands| {
            (led(scenario, commands) - led(&tight(&fixtures.scenario), commands)).norm()
        };
        Self {
            control_step: miss_of_steps(scenario, StepCommands::Gentle),
            control_step_quasi_steady: miss_of_steps(
                &fixtures.quasi_steady(),
                StepCommands::Gentle,
            ),
            random_step: miss_of_steps(scenario, StepCommands::Random),
            stop_and_go_step: miss_of_steps(scenario, StepCommands::StopAndGo),
            force: force(fixtures),
            settle: carried(fixtures),
            settle_facets: facets(fixtures),
            traverse_dynamic: miss(scenario),
            traverse_quasi_steady: miss(&fixtures.quasi_steady()),
            heading_curve: imbalance(scenario),
        }
    }
}

fn force(fixtures: &Fixtures) -> f64 {
    let (model, reference) = (fixtures.scenario.model.as_ref(), Ishigami::reference());
    let errors = fixtures.wheels.iter().map(|wheel| {
        let found = model.forces(&wheel.contact, wheel.sinkage);
        let exact = reference.forces(&wheel.contact, wheel.sinkage);
        difference(&found, &exact) / wheel.load
    });
    errors.fold(0.0, f64::max)
}

/// The largest among the components of two forces [N].
fn difference(found: &WheelForces, exact: &WheelForces) -> f64 {
    let parts =
        |forces: &WheelForces| [forces.drawbar_pull, forces.side_force, forces.normal_force];
    let differences = parts(found).into_iter().zip(parts(exact));
    differences.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

fn facets(fixtures: &Fixtures) -> f64 {
    let reference = Rft::reference();
    let errors = fixtures.faceted.iter().map(|(contact, load)| {
        let settled = settle(&Rft::DEFAULT, contact, *load).expect("it is carried");
        difference(&settled.forces, &reference.forces(contact, settled.sinkage)) / load
    });
    errors.fold(0.0, f64::max)
}

fn carried(fixtures: &Fixtures) -> f64 {
    let model = fixtures.scenario.model.as_ref();
    let errors = fixtures.wheels.iter().map(|wheel| {
        let settled = settle(model, &wheel.contact, wheel.load).expect("it is carried");
        (settled.forces.normal_force / wheel.load - 1.0).abs()
    });
    errors.fold(0.0, f64::max)
}

fn tight(scenario: &Scenario) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.numerics.integrator = Integrator::Adaptive { tolerance: 1e-9 };
    scenario
}

fn end(scenario: &Scenario) -> (f64, f64) {
    let run = Run::new(scenario).and_then(Run::to_end).expect("the scenario runs");
    let position = run.last().state.position;
    (position.x, position.y)
}

fn imbalance(scenario: &Scenario) -> f64 {
    let curve = HeadingStudy::of(scenario).curve().expect("it has one");
    let weight = scenario.rover.mass() * scenario.gravity;
    let miss = |heading: HeadingOffset| {
        let forces = forces_of(&heading.wheels);
        let (force, _) = dynamics::soil_resultant(&scenario.rover, forces, scenario.own_moments);
        let pull = weight * heading.slope.sin();
        let (forward, left) = (pull * heading.yaw.sin(), pull * heading.yaw.cos());
        (force.x - forward).hypot(force.y - left) / weight
    };
    curve.headings().into_iter().map(miss).fold(0.0, f64::max)
}
