//! A rover led step by step is the rover of a run: same motion, same findings, same books.

use grouser::error::ParameterError;
use grouser::simulation::{
    Approach, Controller, Integrator, Method, Motion, Numerics, Observation, Outcome, Record, Run,
    RunError, Scenario, Start, WheelRecord,
};
use grouser::units::deg;
use grouser::vehicle::drive::SlipTarget;
use grouser::vehicle::{DriveLaw, RoverState};
use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::given::{self, RIM_SPEED, run, traverse};

/// Over a way of a metre, steps and runs may differ by this [m], and over its turns [rad]: the
/// integrator's relative tolerance.
const TOLERANCE: f64 = 1e-6;

fn simulator(scenario: &Scenario) -> Run {
    Run::new(scenario).expect("a rover at its start")
}

/// A rover led by a list of commands, each for a span [s].
fn led(scenario: &Scenario, span: f64, commands: &[[f64; 4]]) -> Run {
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
        let slips = |sample: &Record| sample.wheels.iter().map(WheelRecord::power).sum::<f64>();
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
    assert_eq!(long.now(), short.now());
}

/// In a quasi-steady run on a plane any cutting has the same bits, those of the energies too.
#[test]
fn quasi_steady_steps_have_the_same_bits_however_they_are_cut() {
    let kept: [[f64; 4]; 5] = [WILD[0], WILD[1], WILD[2], WILD[4], WILD[5]];
    for slope in [0.0, deg(10.0)] {
        let base = traverse(slope, deg(3.0));
        let numerics = Numerics { approach: Approach::QuasiSteady, ..base.numerics };
        let scenario = Scenario { numerics, ..base };
        let whole = led(&scenario, 2.0, &kept);
        assert_eq!(*whole.state().method(), Method::QuasiSteady);
        for cuts in [vec![0.5; 4], vec![0.02; 100], vec![0.013, 0.7, 0.287, 0.999, 0.001]] {
            let mut rover = simulator(&scenario);
            for command in &kept {
                for span in &cuts {
                    rover.step(command, *span).expect("a step");
                }
            }
            let (now, there) = (rover.now(), whole.now());
            assert_eq!((now.state, now.energy), (there.state, there.energy), "{} cuts", cuts.len());
            let [cut, uncut] = [rover.state().work(), whole.state().work()];
            assert_eq!(cut.evaluations, uncut.evaluations, "the work is that of one step");
        }
    }
}

/// Speeds that change at every step of 20 ms: a tolerance a thousand times as tight leads to the
/// same place, nearer than the tolerance times the way and times the speed.
#[test]
fn steps_under_changing_speeds_are_as_exact_as_the_tolerance() {
    let waves = |k: usize| {
        let time = 0.02 * k as f64;
        let (both, turn) = (1.0 + 0.2 * (1.3 * time).sin(), 0.1 * (0.9 * time).sin());
        [both - turn, both - turn, both + turn, both + turn].map(|share| RIM_SPEED * share)
    };
    let jolts = |k: usize| {
        let (both, turn) = ((k * 37 % 11) as f64 / 10.0 + 0.5, (k * 53 % 7) as f64 / 20.0 - 0.15);
        [both - turn, both - turn, both + turn, both + turn].map(|share| RIM_SPEED * share)
    };
    for commands in [(0..250).map(waves).collect::<Vec<_>>(), (0..100).map(jolts).collect()] {
        let scenario = traverse(deg(10.0), 0.0);
        let integrator = Integrator::Adaptive { tolerance: 1e-9 };
        let tight =
            Scenario { numerics: Numerics { integrator, ..scenario.numerics }, ..scenario.clone() };
        let [one, other] = [&scenario, &tight].map(|it| led(it, 0.02, &commands));
        let (one, other) = (&one.now().state, &other.now().state);
        assert!(apart(one, other) < 0.1 * TOLERANCE, "{}", apart(one, other));
        let off = (one.velocity - other.velocity).norm();
        assert!(off < TOLERANCE * 2.0 * RIM_SPEED, "{off} m/s");
    }
}

/// A step is one evaluation of the motion and little more where the commands change by little: this
/// many evaluations, those of Jacobians included.
#[test]
fn a_step_under_slowly_changing_speeds_takes_few_evaluations() {
    let scenario = traverse(deg(10.0), 0.0);
    let commands: Vec<[f64; 4]> =
        (0..100).map(|k| [RIM_SPEED * (1.0 + 0.2 * (0.026 * f64::from(k)).sin()); 4]).collect();
    let before = simulator(&scenario).state().work().evaluations;
    let evaluations = led(&scenario, 0.02, &commands).state().work().evaluations - before;
    assert!(evaluations < 20 * 100, "{evaluations} evaluations for 100 steps");
}

/// Records cost wheels, and change nothing of the motion.
#[test]
fn an_outcome_alone_is_that_of_the_whole_run() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        for slope in [deg(10.0), deg(35.0)] {
            let base = traverse(slope, deg(4.0));
            let scenario = Scenario { numerics: Numerics { approach, ..base.numerics }, ..base };
            let whole = run(&scenario);
            let alone = simulator(&scenario).to_outcome().expect("it ends");
            assert_eq!((alone.last(), &alone.outcome), (whole.last(), &whole.outcome));
            assert_eq!((&alone.records[0], alone.records.len()), (&whole.records[0], 2));
            assert_eq!(alone.method, whole.method);
            let saved = whole.records.len() as u64 - 2;
            let settled = whole.work.settled_wheels - alone.work.settled_wheels;
            assert!(approach == Approach::QuasiSteady || settled == 4 * saved, "{settled}");
        }
    }
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
        prop_assert_eq!(clone.state().work(), again.state().work());
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
    assert_eq!(rover.state().method(), &whole.method);
    assert!(rover.now().wheels.len() == 4 && rover.outcome().is_none());
}

/// Speeds of all rims, of those on the left and of those on the right.
fn sides(left: f64, right: f64) -> [f64; 4] {
    [left, left, right, right]
}

/// Stops, starts, reversals and turns on the spot, as drivers and learners command them: between
/// changes velocities are steady, also where a turn on the spot has two of them. A dynamic run needs
/// tenths of a second at a change at most, that is half a millimetre.
#[test]
fn stops_reversals_and_turns_on_the_spot_are_quasi_steady() {
    let go = sides(RIM_SPEED, RIM_SPEED);
    let patterns = [
        ("stops", 2, sides(0.0, 0.0), 120),
        ("reversals", 4, go.map(|rim| -rim), 120),
        ("turns", 4, sides(-0.5 * RIM_SPEED, 0.5 * RIM_SPEED), 220),
        ("curves", 3, sides(RIM_SPEED, 0.3 * RIM_SPEED), 120),
    ];
    for slope in [3.0, 10.0] {
        for (name, steps, other, most) in patterns {
            let command = |k: usize| if (k / steps).is_multiple_of(2) { go } else { other };
            let commands: Vec<[f64; 4]> = (0..36).map(command).collect();
            let changes = (commands.len() - 1) / steps;
            let base = traverse(deg(slope), 0.0);
            let approach = Approach::QuasiSteady;
            let numerics = Numerics { approach, ..base.numerics };
            let steady = Scenario { numerics, ..base.clone() };
            let [dynamic, steady] = [&base, &steady].map(|it| led(it, 0.5, &commands));
            let name = format!("{name} on {slope}°");
            assert_eq!(steady.state().method(), &Method::QuasiSteady, "{name}");
            let [work, without] = [&steady, &dynamic].map(|run| run.state().work().evaluations);
            let per_change = work / changes as u64;
            assert!(per_change < most && 2 * work < without, "{name}: {work} and {without}");
            let apart = apart(&dynamic.now().state, &steady.now().state) / changes as f64;
            assert!(apart < 5e-4, "{name}: {apart} m or rad by each change");
        }
    }
}

/// Where a rover can move in more than one way, what it did before decides: quasi-steady rovers come
/// to the motion that dynamic ones come to, under commands of any size and sign with rests among
/// them, on weak and firm sand, on the Earth and on the Moon. Velocities differ by less than a
/// twentieth of the fastest rim's after half a second, but for one motion in a hundred (measured: 77
/// of 14,241, and 135 where steps that followed a rover missed five times as much): near the limit
/// between two of them little decides.
#[test]
fn quasi_steady_rovers_come_to_the_motion_of_dynamic_ones() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut between = |low: f64, high: f64| {
        low + (high - low) * f64::from(random.next_u32()) / f64::from(u32::MAX)
    };
    let (mut compared, mut otherwise) = (0, Vec::new());
    for rover in 0..120 {
        let friction_angle = between(0.55, 0.70);
        let mut base = traverse(deg(between(0.0, 18.0)), deg(between(0.0, 360.0)));
        let gravity = if rover % 4 == 0 { 1.62 } else { 9.81 };
        base.ground.soil.friction_angle = friction_angle;
        let dynamic = Scenario { gravity, duration: 2.0, ..base };
        let approach = Approach::QuasiSteady;
        let numerics = Numerics { approach, ..dynamic.numerics };
        let steady = Scenario { numerics, ..dynamic.clone() };
        let mut runs = [&dynamic, &steady].map(simulator);
        for command in 0..3 {
            let rims: [f64; 4] = match rover % 3 {
                0 if command == 1 => [0.0; 4],
                2 => std::array::from_fn(|_| between(-0.1, 0.1)),
                _ => sides(between(-0.1, 0.1), between(-0.1, 0.1)),
            };
            let goes_on = runs.iter_mut().all(|run| {
                run.step(&rims, 0.5).expect("a step");
                run.outcome().is_none()
            });
            if !goes_on {
                break;
            }
            let [one, other] = runs.each_ref().map(|run| *run.state().rover());
            let fastest = rims.iter().fold(0.01_f64, |most, rim| most.max(rim.abs()));
            let turns = 0.2 * (one.yaw_rate - other.yaw_rate).abs();
            let apart = (one.velocity - other.velocity).norm().max(turns) / fastest;
            compared += 1;
            if apart > 0.05 {
                otherwise.push((rover, command, apart));
                break;
            }
        }
    }
    assert!(compared > 300 && otherwise.len() <= 4, "of {compared}: {otherwise:?}");
}

/// A locked wheel stops its hub sideways, within a micrometre a second, while it slides on along its
/// plane: a motion a million times as stiff as the stop. A third of these stops had no end.
#[test]
fn a_rover_that_turns_on_a_slope_stops() {
    for yaw in (0..40).map(|k| 56.0 + 0.3 * f64::from(k)) {
        let mut scenario = Scenario { duration: 2.0, ..traverse(deg(15.19), deg(yaw)) };
        scenario.ground.soil.friction_angle = 0.625;
        let run = led(&scenario, 0.5, &[sides(0.0463, -0.0882), [0.0; 4]]);
        let speed = run.state().rover().velocity.norm();
        assert!(speed < 1e-6, "{speed} m/s at {yaw}°");
    }
}

/// Where no steady motion is found, velocities are integrated until the wheels turn otherwise.
#[test]
fn a_steady_motion_is_sought_again_with_each_command() {
    let locked = [0.0, 0.06, 0.06, 0.06];
    let command = |k: usize| if k == 4 { locked } else { [RIM_SPEED; 4] };
    let commands: Vec<[f64; 4]> = (0..40).map(command).collect();
    let base = traverse(deg(10.0), 0.0);
    let approach = Approach::QuasiSteady;
    let steady = Scenario { numerics: Numerics { approach, ..base.numerics }, ..base.clone() };
    let [dynamic, steady] = [&base, &steady].map(|it| led(it, 0.5, &commands));
    let Method::FallbackToDynamic { time, .. } = *steady.state().method() else {
        panic!("{:?}", steady.state().method())
    };
    assert!((time - 2.0).abs() < 1e-9, "{time} s");
    let [work, without] = [&steady, &dynamic].map(|run| run.state().work());
    assert!(work.steps > 36 * 5 && work.evaluations < without.evaluations, "{work:?}");
    let apart = apart(&dynamic.now().state, &steady.now().state);
    assert!(apart < 2e-3, "{apart} m or rad");
}

/// Steps of a command that is the scenario's own find the balance anew as the rover turns.
#[test]
fn quasi_steady_steps_of_the_same_command_follow_a_rover_that_turns() {
    let rims = [0.058, 0.058, 0.062, 0.062];
    let drive = DriveLaw::ConstantEach(rims.to_vec());
    let base = Scenario { duration: 6.0, drive, ..traverse(deg(10.0), 0.0) };
    let approach = Approach::QuasiSteady;
    let scenario = Scenario { numerics: Numerics { approach, ..base.numerics }, ..base };
    let whole = run(&scenario);
    let yaw = whole.last().state.yaw;
    assert!(yaw > deg(1.0) && whole.method == Method::QuasiSteady, "{yaw}");
    for (span, count) in [(0.1, 60), (0.01, 600)] {
        let rover = led(&scenario, span, &vec![rims; count]);
        let apart = apart(&rover.now().state, &whole.last().state);
        assert!(apart < 2.0 * 1e-5 * 0.36 / 0.3, "{apart} after steps of {span} s");
    }
}

/// The law of Eq. 18 by a closure of one's own is the drive of a scenario, bit for bit.
#[test]
fn a_controller_leads_as_the_scenarios_drive_does() {
    let law = DriveLaw::Eq18(SlipTarget { speed: 0.06, slip_ratio: 0.2 });
    let scenario = Scenario { duration: 3.0, drive: law.clone(), ..traverse(deg(10.0), deg(3.0)) };
    let whole = run(&scenario);
    let mut own = |seen: &Observation<'_>, rim_speeds: &mut [f64]| {
        law.rim_speeds(&seen.scenario().rover, seen.rover().yaw, seen.slip_ratios(), rim_speeds);
    };
    // Another drive in the scenario says nothing to a run that a controller starts.
    let other = Scenario { drive: DriveLaw::Constant(0.01), ..scenario.clone() };
    let mut led = Run::with_controller(&other, &mut own).expect("a start");
    let at_start = led.records().len();
    led.step(led.state().rim_speeds().to_vec().as_slice(), 0.1).expect("the first period");
    for until in [1.0, 2.0, 3.0] {
        led.advance(&mut own, until).expect("it is led");
    }
    assert_eq!((at_start, led.records().len()), (1, 30), "the first period was a step");
    assert_eq!(led.now(), whole.last());
    assert_eq!(led.finish().records[1..], whole.records[2..]);
}

/// A state is all that changes: another run goes on from there, bit for bit, by either approach.
#[test]
fn a_run_goes_on_from_a_state() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let base = traverse(deg(12.0), 0.0);
        let scenario = Scenario { numerics: Numerics { approach, ..base.numerics }, ..base };
        let mut run = led(&scenario, 0.13, &WILD[..3]);
        let mut again = Run::resume(&scenario, run.state().clone());
        assert_eq!(again.now().state, run.now().state);
        for command in &WILD[3..] {
            run.step(command, 0.13).expect("a step");
            again.step(command, 0.13).expect("a step");
            assert_eq!((run.now(), run.outcome()), (again.now(), again.outcome()));
        }
    }
}

/// A controller sees the wheels: here the soil's torques and the loads, which bear the weight.
#[test]
fn a_controller_sees_time_motion_and_wheels() {
    let scenario = Scenario { duration: 1.0, ..traverse(deg(10.0), deg(5.0)) };
    let weight = scenario.rover.mass() * scenario.gravity * deg(10.0).cos();
    let mut looks = Vec::new();
    let mut watcher = |seen: &Observation<'_>, rim_speeds: &mut [f64]| {
        let wheels = seen.wheels().expect("they settle");
        let load: f64 = wheels.iter().map(|wheel| wheel.load).sum();
        let torque: f64 = wheels.iter().map(|wheel| wheel.settled.forces.torque).sum();
        assert!((load - weight).abs() < 1e-9 * weight && wheels[0].settled.sinkage > 0.0);
        assert_eq!(seen.slip_ratios(), wheels.iter().map(|w| w.slip.ratio).collect::<Vec<_>>());
        looks.push((seen.time(), seen.rover().velocity.x, torque));
        rim_speeds.fill(RIM_SPEED);
    };
    let mut run = Run::with_controller(&scenario, &mut watcher).expect("a start");
    run.advance(&mut watcher, 1.0).expect("it is led");
    let times: Vec<f64> = looks.iter().map(|look| look.0).collect();
    assert_eq!(times.len(), 11, "{times:?}");
    assert!(times.iter().skip(1).enumerate().all(|(k, time)| (time - 0.1 * k as f64).abs() < 1e-9));
    // Before the start it stands with its wheels at rest, on a slope that drags at it.
    let (first, last) = (looks[0], looks[10]);
    assert!(first.1 == 0.0 && first.2.abs() < 1e-9, "{first:?}");
    assert!(last.1 > 0.8 * RIM_SPEED && last.2 > 0.1, "{last:?}");
}

#[test]
fn commands_that_no_wheel_can_follow_are_refused() {
    let scenario = traverse(0.0, 0.0);
    let mut run = simulator(&scenario);
    let mut wild = |_: &Observation<'_>, rim_speeds: &mut [f64]| rim_speeds.fill(f64::NAN);
    assert!(matches!(run.advance(&mut wild, 1.0), Err(RunError::Parameter(_))));
    assert_eq!(run.now().time, 0.0);
    struct Backward;
    impl Controller for Backward {
        fn command(&mut self, _: &Observation<'_>, _: &mut [f64]) {}
        fn period(&self) -> Option<f64> {
            Some(-0.1)
        }
    }
    assert!(matches!(run.advance(&mut Backward, 1.0), Err(RunError::Parameter(_))));
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
        assert!(matches!(told, Err(RunError::Parameter(ParameterError { .. }))));
        assert_eq!(rover.now(), &before);
    }
    let nowhere = traverse(0.0, 0.0).ground.with_slope(f64::NAN);
    assert!(Run::new(&Scenario { ground: nowhere, ..traverse(0.0, 0.0) }).is_err());
}

#[test]
fn a_rover_at_its_start_was_looked_at() {
    let rover = simulator(&traverse(deg(10.0), deg(5.5)));
    let now = rover.now();
    assert_eq!((now.time, now.wheels.len(), now.energy.motors), (0.0, 4, 0.0));
    assert_eq!(rover.state().rim_speeds(), [RIM_SPEED; 4]);
    assert_eq!(rover.scenario().drive, DriveLaw::Constant(RIM_SPEED));
    assert!(!matches!(rover.outcome(), Some(Outcome::Completed)));
}
