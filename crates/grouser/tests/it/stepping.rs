//! A rover led step by step is the rover of a run: same motion, same findings, same books.

use grouser::error::ParameterError;
use grouser::simulation::{
    Approach, Integrator, Motion, Numerics, Outcome, Sample, Scenario, SimulationError, Simulator,
    Start, WheelSample,
};
use grouser::site::Site;
use grouser::units::deg;
use grouser::vehicle::{DriveLaw, RoverState};
use proptest::prelude::*;

use super::given::{self, RIM_SPEED, run, traverse};

/// Over a way of a metre, steps and runs may differ by this [m], and over its turns [rad]: the
/// integrator's relative tolerance.
const TOLERANCE: f64 = 1e-6;

fn simulator(scenario: &Scenario) -> Simulator {
    Simulator::new(scenario.clone()).expect("a rover at its start")
}

/// A rover led by a list of commands, each for a span [s].
fn led(scenario: &Scenario, span: f64, commands: &[[f64; 4]]) -> Simulator {
    let mut rover = simulator(scenario);
    for command in commands {
        rover.step(command, span).expect("a step");
    }
    rover
}

fn apart(one: &RoverState, other: &RoverState) -> f64 {
    (one.position - other.position).norm().max((one.yaw - other.yaw).abs())
}

/// Left and right rims by turns: gentle changes, jolts, a spot turn, reverse, and a halt.
const WILD: [[f64; 4]; 8] = [
    [0.06, 0.06, 0.06, 0.06],
    [0.058, 0.058, 0.062, 0.062],
    [0.03, 0.03, 0.09, 0.09],
    [-0.05, -0.05, 0.05, 0.05],
    [-0.06, -0.06, -0.06, -0.06],
    [0.0, 0.0, 0.0, 0.0],
    [0.01, 0.02, 0.08, 0.04],
    [0.06, 0.06, 0.06, 0.06],
];

#[test]
fn steps_with_constant_commands_lead_where_the_run_leads() {
    let scenario = Scenario { duration: 6.0, ..traverse(deg(10.0), deg(5.5)) };
    let whole = run(&scenario);
    for (span, count) in [(0.01, 600), (0.03, 200), (0.1, 60), (1.5, 4), (6.0, 1)] {
        let rover = led(&scenario, span, &vec![[RIM_SPEED; 4]; count]);
        let (now, end) = (rover.now(), whole.last());
        assert!((now.time - 6.0).abs() < 1e-9, "steps of {span} s end at {} s", now.time);
        assert!(apart(&now.state, &end.state) < TOLERANCE, "steps of {span} s");
        let (energy, there) = (now.energy.motors, end.energy.motors);
        assert!((energy - there).abs() < TOLERANCE * there.abs().max(1.0));
        let slips = |sample: &Sample| sample.wheels.iter().map(WheelSample::power).sum::<f64>();
        assert!((slips(now) - slips(end)).abs() < TOLERANCE);
    }
}

/// The fixed-step integrator knows no stiffness, no history and no step control. Its step is stable
/// where no hub comes to rest, so that the jolts here go forward only.
#[test]
fn changing_commands_lead_where_an_independent_integrator_leads() {
    let commands: Vec<[f64; 4]> =
        WILD.iter().map(|rims| rims.map(|rim| 0.05 + 0.3 * rim)).collect();
    let implicit = Scenario { duration: 1.0, ..traverse(deg(12.0), deg(4.0)) };
    let integrator = Integrator::Rk4 { step: 2e-4 };
    let explicit =
        Scenario { numerics: Numerics { integrator, ..implicit.numerics }, ..implicit.clone() };
    let (one, other) = (led(&implicit, 0.1, &commands), led(&explicit, 0.1, &commands));
    assert!(apart(&one.now().state, &other.now().state) < TOLERANCE);
}

/// How a time is cut into steps of one command does not matter.
#[test]
fn short_steps_add_up_to_long_ones() {
    let scenario = traverse(deg(10.0), 0.0);
    let long = led(&scenario, 0.4, &WILD);
    let each_four_times: Vec<_> = WILD.iter().flat_map(|command| [*command; 4]).collect();
    let short = led(&scenario, 0.1, &each_four_times);
    assert!(apart(&long.now().state, &short.now().state) < TOLERANCE);
}

proptest! {
    #![proptest_config(given::cases(12))]

    /// A clone has the same history: it goes on as the original does, whatever is asked of it.
    #[test]
    fn equal_commands_have_equal_bits(
        rims in prop::collection::vec(prop::array::uniform4(-0.1..0.1), 6),
        span in 0.005..0.3,
        slope in 0.0..deg(20.0),
    ) {
        let scenario = traverse(slope, 0.0);
        let first = led(&scenario, span, &rims[..3]);
        let mut clone = first.clone();
        for command in &rims[3..] {
            clone.step(command, span).expect("a step");
        }
        let again = led(&scenario, span, &rims);
        prop_assert_eq!(clone.now(), again.now());
        prop_assert_eq!(clone.outcome(), again.outcome());
        prop_assert_eq!(clone.work(), again.work());
    }
}

/// The motors change the wheels' spin at every new command; the books keep that work. They are as
/// exact as the integrator's energies, 1e-8 J and 1e-6 of their size in every step.
#[test]
fn the_books_of_the_energy_stay_closed_under_changing_commands() {
    let scenario = traverse(deg(10.0), 0.0);
    let start = simulator(&scenario).now().energy;
    let end = led(&scenario, 0.3, &WILD).now().energy;
    let stored = end.kinetic - start.kinetic + end.potential - start.potential;
    let missing = end.motors - end.soil - stored;
    assert!(end.motors > 0.1 && missing.abs() < 1e-5, "{missing} of {} J", end.motors);
}

/// What becomes of a rover is found at the same time, by the same watch.
#[test]
fn outcomes_are_those_of_the_run() {
    let steep = traverse(deg(35.0), 0.0);
    let up = Start { yaw: deg(90.0), motion: Motion::Rest };
    let stuck = Scenario { start: up, ..traverse(deg(28.0), 0.0) };
    let tips = Start { yaw: 0.0, motion: Motion::Rest };
    let tipped = Scenario { start: tips, ..traverse(deg(75.0), 0.0) };
    for (scenario, word) in [(steep, "sliding"), (stuck, "immobilised"), (tipped, "tipped_over")] {
        let told = run(&scenario).outcome;
        assert_eq!(told.name(), word);
        for span in [0.05, 0.37] {
            let mut rover = simulator(&scenario);
            for _ in 0..400 {
                rover.step(&[RIM_SPEED; 4], span).expect("a step");
            }
            assert_eq!(rover.outcome(), Some(&told), "steps of {span} s");
            let ended = rover.now().clone();
            rover.step(&[-RIM_SPEED; 4], span).expect("a step after the end");
            assert_eq!(rover.now(), &ended, "a run that has ended goes on");
        }
    }
}

#[test]
fn quasi_steady_steps_lead_where_the_quasi_steady_run_leads() {
    let base = Scenario { duration: 6.0, ..traverse(deg(10.0), deg(5.5)) };
    let approach = Approach::QuasiSteady;
    let scenario = Scenario { numerics: Numerics { approach, ..base.numerics }, ..base };
    let whole = run(&scenario);
    let rover = led(&scenario, 0.1, &[[RIM_SPEED; 4]; 60]);
    // Two tables, of different lengths, each good to 1e-5 of the rim's speed: over a way of 0.36 m,
    // and at the wheels' distance of 0.3 m as an angle.
    let apart = apart(&rover.now().state, &whole.last().state);
    assert!(apart < 2.0 * 1e-5 * 0.36 / 0.3, "{apart}");
    assert_eq!(rover.method(), &whole.method);
    assert!(rover.now().wheels.len() == 4 && rover.outcome().is_none());
}

#[test]
fn what_nothing_can_do_changes_nothing() {
    let mut rover = led(&traverse(deg(10.0), 0.0), 0.1, &WILD[..2]);
    let before = rover.now().clone();
    let wrong: [(&[f64], f64); 6] = [
        (&[0.06; 3], 0.1),
        (&[0.06, 0.06, 0.06, f64::NAN], 0.1),
        (&[0.06, f64::INFINITY, 0.06, 0.06], 0.1),
        (&[0.06; 4], 0.0),
        (&[0.06; 4], -0.1),
        (&[0.06; 4], f64::NAN),
    ];
    for (rims, span) in wrong {
        let told = rover.step(rims, span);
        assert!(matches!(told, Err(SimulationError::Parameter(ParameterError { .. }))));
        assert_eq!(rover.now(), &before);
    }
    let nowhere = Site { slope: f64::NAN, ..traverse(0.0, 0.0).site };
    assert!(Simulator::new(Scenario { site: nowhere, ..traverse(0.0, 0.0) }).is_err());
}

#[test]
fn a_rover_at_its_start_was_looked_at() {
    let rover = simulator(&traverse(deg(10.0), deg(5.5)));
    let now = rover.now();
    assert_eq!((now.time, now.wheels.len(), now.energy.motors), (0.0, 4, 0.0));
    assert_eq!(rover.rim_speeds(), [RIM_SPEED; 4]);
    assert_eq!(rover.scenario().drive, DriveLaw::Constant(RIM_SPEED));
    assert!(!matches!(rover.outcome(), Some(Outcome::Completed)));
}
