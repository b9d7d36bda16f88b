//! Motors that turn as fast as they are told, and what they take from the battery.

use grouser::simulation::{
    Approach, EnergyBalance, Integrator, Motion, Numerics, Outcome, PowerLost, Record, Run,
    Scenario, StuckBecause, Trajectory,
};
use grouser::soil::{Shear, Soil};
use grouser::units::deg;
use grouser::vehicle::{Battery, DriveLaw, Motor, Rover, SpeedControl, Winding};

use super::given::{RIM_SPEED, complete_traverse, hakuto_wheel, linear, run};
use super::mounts::firm;

/// A micro rover's: of the size that theory gives for one.
pub(crate) const MOTOR: Motor = Motor {
    resistance: 10.0,
    torque_constant: 0.010,
    gear_ratio: 250.0,
    efficiency: 0.6,
    friction: 1e-3,
    is_self_locking: false,
    feeds_back: false,
    control: None,
    winding: None,
};

pub(crate) fn with(motor: Motor, scenario: Scenario) -> Scenario {
    let mut parts = scenario.rover.parts().clone();
    parts.wheel_unit.motor = Some(motor);
    Scenario { rover: Rover::draft(parts).checked().expect("a rover"), ..scenario }
}

pub(crate) fn across(slope: f64) -> Scenario {
    Scenario { duration: 10.0, ..complete_traverse(slope, 3.0) }
}

/// What a motor takes changes nothing of what its wheel does.
#[test]
fn a_run_with_motors_is_the_run_without_bit_for_bit() {
    let without = run(&across(12.0));
    let motors = run(&with(MOTOR, across(12.0)));
    assert_eq!(without.records.len(), motors.records.len());
    for (one, other) in without.records.iter().zip(&motors.records) {
        assert_eq!((one.state, one.energy.motors), (other.state, other.energy.motors));
        assert_eq!(one.energy.electrical, 0.0);
        assert!(one.wheels.iter().all(|wheel| wheel.electrical.is_none()));
    }
    assert_eq!(without.work.evaluations, motors.work.evaluations);
}

/// The energy is the integral of the power, and that of the run's motors with their losses: by hand
/// from each record.
#[test]
fn battery_energy_is_the_integral_of_what_the_motors_take() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut scenario = with(MOTOR, across(10.0));
        let numerics = Numerics { approach, sample_interval: 0.05, ..scenario.numerics };
        scenario.numerics = numerics;
        let run = run(&scenario);
        let power = |place: usize| -> f64 {
            let wheels = &run.records[place].wheels;
            wheels.iter().map(|wheel| wheel.electrical.expect("a motor").power).sum()
        };
        let integral: f64 = (1..run.records.len())
            .map(|place| {
                let span = run.records[place].time - run.records[place - 1].time;
                0.5 * span * (power(place - 1) + power(place))
            })
            .sum();
        let energy = run.last().energy.electrical;
        assert!((integral / energy - 1.0).abs() < 1e-3, "{approach:?}: {integral} J, {energy} J");
        for wheel in &run.last().wheels {
            let (torque, speed) = (wheel.reaction.settled.forces.torque, wheel.wheel_speed);
            let current = (torque / (250.0 * 0.6) + 1e-3) / 0.010;
            let power = torque * speed / 0.6 + 1e-3 * 250.0 * speed + 10.0 * current * current;
            assert!(
                torque > 0.0 && (wheel.electrical.expect("a motor").power - power).abs() < 1e-12
            );
        }
    }
}

/// Closed form: on firm ground P = W sin α v / η + Σ R i², without friction.
#[test]
fn up_a_firm_slope_motors_take_the_climb_and_their_heat() {
    let motor = Motor { friction: 0.0, ..MOTOR };
    let mut scenario = with(motor, across(10.0));
    scenario.start.yaw = deg(90.0);
    let at_once = linear(1e-5, 0.0);
    let shear = Shear::Anisotropic { longitudinal: at_once, lateral: at_once };
    let soil = Soil { shear, ..firm() };
    scenario.ground.soil = soil;
    let weight = scenario.rover.mass() * scenario.gravity;
    let run = run(&scenario);
    let last = run.last();
    let climb = weight * deg(10.0).sin() * last.state.velocity.norm() / motor.efficiency;
    let each = last.wheels.iter().map(|wheel| wheel.electrical.expect("a motor"));
    let (heat, power) = each.fold((0.0, 0.0), |(heat, power), taken| {
        (heat + motor.resistance * taken.current * taken.current, power + taken.power)
    });
    assert!((power / (climb + heat) - 1.0).abs() < 0.03, "{power} W, {climb} W and {heat} W");
    assert!((last.state.velocity.norm() / RIM_SPEED - 1.0).abs() < 0.02);
}

/// A mount may have a motor of its own, and the others none.
#[test]
fn a_wheel_may_have_the_only_motor() {
    let mut scenario = across(8.0);
    let mut parts = scenario.rover.parts().clone();
    parts.mounts[2].motor = Some(MOTOR);
    scenario.rover = Rover::draft(parts).checked().expect("a rover");
    assert!(scenario.rover.has_motors());
    let run = run(&scenario);
    let known: Vec<bool> = run.last().wheels.iter().map(|it| it.electrical.is_some()).collect();
    assert_eq!(known, [false, false, true, false]);
    assert!(run.last().energy.electrical > 0.0);
    let mut parts = scenario.rover.parts().clone();
    parts.mounts[2].motor = Some(Motor { efficiency: 0.0, ..MOTOR });
    let error = Rover::draft(parts).checked().expect_err("no gear is as bad as that");
    assert!(error.to_string().contains("efficiency of a gear"), "{error}");
}

/// A controller without an integral, of which 12 % of the speed is missing at 1 N·m.
const PROPORTIONAL: SpeedControl =
    SpeedControl { gain: 97.5, integral: 0.0, voltage: None, current: None };

fn controlled(control: SpeedControl) -> Motor {
    Motor { control: Some(control), ..MOTOR }
}

/// Rim speed of each wheel over the one that is set [-].
fn shares(record: &Record) -> Vec<f64> {
    let radius = hakuto_wheel().shearing_radius();
    record.wheels.iter().map(|wheel| wheel.wheel_speed * radius / RIM_SPEED).collect()
}

/// Closed form of the droop, under the torque that each wheel takes; with an integral nothing is
/// missing.
#[test]
fn wheels_turn_at_the_speed_at_which_motor_and_soil_agree() {
    let integral = SpeedControl { integral: 975.0, ..PROPORTIONAL };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        for control in [PROPORTIONAL, integral] {
            let mut scenario = with(controlled(control), across(12.0));
            scenario.numerics.approach = approach;
            let run = run(&scenario);
            let radius = hakuto_wheel().shearing_radius();
            for wheel in &run.last().wheels {
                let torque = wheel.reaction.settled.forces.torque;
                let current = (torque / (250.0 * 0.6) + 1e-3) / 0.010;
                let missing =
                    if control.integral > 0.0 { 0.0 } else { 10.0 * current / (2.5 + 97.5) };
                let expected = RIM_SPEED / radius - missing;
                let off = wheel.wheel_speed / expected - 1.0;
                // An integral runs after a torque that grows as the nose falls.
                let close = if control.integral > 0.0 { 2e-5 } else { 2e-7 };
                assert!(off.abs() < close, "{approach:?}, {control:?}: {off:e}");
                let electrical = wheel.electrical.expect("a motor");
                assert!((electrical.current / current - 1.0).abs() < 1e-5, "{electrical:?}");
            }
        }
    }
}

/// The integrated speeds and those of the balance are two ways to one motion.
#[test]
fn droop_is_the_same_dynamically_and_quasi_steadily() {
    let ends = [Approach::Dynamic, Approach::QuasiSteady].map(|approach| {
        let mut scenario = with(controlled(PROPORTIONAL), across(10.0));
        scenario.numerics.approach = approach;
        let run = run(&scenario);
        let name = if approach == Approach::Dynamic { "dynamic" } else { "quasi-steady" };
        assert_eq!(run.method.name(), name);
        let EnergyBalance { motors, soil, kinetic, potential, .. } = run.last().energy;
        let start = run.records[0].energy;
        let left = motors - soil - (kinetic - start.kinetic) - (potential - start.potential);
        // Steady velocities are found to 1e-6 of the rims' speed, and powers with them.
        assert!((left / motors).abs() < 2e-6, "{approach:?}: {left:e} J of {motors} J");
        assert!(start.motors.abs() < 1e-15);
        (run.last().state, run.last().energy.electrical)
    });
    let [dynamic, steady] = ends;
    assert!((dynamic.0.position - steady.0.position).norm() < 1e-4);
    assert!((dynamic.0.yaw - steady.0.yaw).abs() < 2e-5);
    assert!((dynamic.1 / steady.1 - 1.0).abs() < 2e-3, "{} J, {} J", dynamic.1, steady.1);
}

/// Motors stiff and without losses drive as those that hold every speed.
#[test]
fn stiff_motors_without_losses_give_the_ideal_drive() {
    let stiff = SpeedControl { gain: 1e7, ..PROPORTIONAL };
    let lossless = Motor { efficiency: 1.0, friction: 0.0, ..controlled(stiff) };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let with_approach = |mut scenario: Scenario| {
            scenario.numerics.approach = approach;
            run(&scenario)
        };
        let ideal = with_approach(across(10.0)).last().state;
        let stiff = with_approach(with(lossless, across(10.0))).last().state;
        let way = ideal.position.norm();
        assert!((ideal.position - stiff.position).norm() < 1e-6 * way, "{approach:?}");
        assert!((ideal.yaw - stiff.yaw).abs() < 1e-6, "{approach:?}");
        assert!((ideal.velocity - stiff.velocity).norm() < 1e-6 * RIM_SPEED, "{approach:?}");
    }
}

/// Downhill wheels carry more, turn slower, and let the nose fall: by how much more than with
/// motors that hold their speed, in 20 s, for a tenth of the speed at 1 N·m.
#[test]
fn droop_of_a_tenth_at_a_newton_metre_lets_the_nose_fall_further() {
    // R/(k N η (k N + K_p)) = 0.1 ω_0.
    let tenth = 10.0 / (2.5 * 0.6 * 0.1 * (RIM_SPEED / 0.11)) - 2.5;
    let control = SpeedControl { gain: tenth, ..PROPORTIONAL };
    for (slope, expected) in [(5.0, 0.14), (10.0, 0.34), (15.0, 0.57), (20.0, 0.82)] {
        let end = |scenario: Scenario| -> f64 {
            let scenario = Scenario { duration: 20.0, ..scenario };
            run(&scenario).last().state.yaw.to_degrees()
        };
        let further = end(across(slope)) - end(with(controlled(control), across(slope)));
        assert!((further - expected).abs() < 0.01, "{slope}°: {further:.3}°");
    }
}

fn stalled(run: &Trajectory) -> bool {
    matches!(run.outcome, Outcome::Immobilised { because: StuckBecause::MotorsStall, .. })
}

/// A limit of the current is a limit of the torque: below what the wheels need on level ground they
/// stall, above it they turn as they are set to; on a slope between both, too, one stalls and the
/// other climbs.
#[test]
fn wheels_stall_whose_motors_may_not_give_what_the_slope_takes() {
    let up = |slope: f64, current: f64| {
        let control = SpeedControl { current: Some(current), integral: 975.0, ..PROPORTIONAL };
        let mut scenario = with(controlled(control), across(slope));
        scenario.start.yaw = deg(90.0);
        run(&scenario)
    };
    let free = up(10.0, 10.0);
    let needs: f64 = free
        .last()
        .wheels
        .iter()
        .map(|it| it.electrical.expect("a motor").current)
        .fold(0.0, f64::max);
    let enough = up(10.0, 1.02 * needs);
    assert_eq!(enough.outcome, Outcome::Completed);
    assert!((enough.last().state.position - free.last().state.position).norm() < 1e-3);
    let less = up(10.0, 0.6 * needs);
    assert!(stalled(&less), "{:?}", less.outcome);
    for record in &less.records {
        for wheel in &record.wheels {
            let current = wheel.electrical.expect("a motor").current;
            assert!(current.abs() < 0.6 * needs * (1.0 + 1e-9), "{current} A");
        }
    }
}

/// At the voltage of half the no-load speed the wheels turn at most so fast, and take no more
/// voltage.
#[test]
fn a_limit_of_the_voltage_is_a_limit_of_the_speed() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut ends = Vec::new();
        for integral in [0.0, 975.0] {
            let control = SpeedControl { voltage: Some(2.8), integral, ..PROPORTIONAL };
            let mut scenario = with(controlled(control), across(5.0));
            scenario.numerics.approach = approach;
            let run = run(&scenario);
            for wheel in &run.last().wheels {
                let electrical = wheel.electrical.expect("a motor");
                assert!((electrical.voltage - 2.8).abs() < 1e-6, "{approach:?}: {electrical:?}");
                let (torque, control) = (wheel.reaction.settled.forces.torque, None);
                let closed = Motor { control, ..MOTOR }.speed(2.8, torque);
                assert!((wheel.wheel_speed / closed - 1.0).abs() < 1e-5);
            }
            ends.push(shares(run.last()));
        }
        let alike = ends[0].iter().zip(&ends[1]).all(|(one, other)| (one - other).abs() < 1e-5);
        assert!(alike && ends[0].iter().all(|share| *share < 0.95), "{approach:?}: {ends:?}");
    }
}

/// An integral does not wind up at a limit: when the set speed comes back within it, the wheels
/// follow within its time.
#[test]
fn a_controller_comes_back_from_its_limit_without_winding_up() {
    let control = SpeedControl { voltage: Some(4.0), integral: 975.0, ..PROPORTIONAL };
    let mut run = Run::new(&with(controlled(control), across(0.0))).expect("a run");
    run.step(&[2.0 * RIM_SPEED; 4], 20.0).expect("at the limit");
    assert!(run.state().rim_speeds()[0] < 1.8 * RIM_SPEED);
    let slow = 0.5 * RIM_SPEED;
    run.step(&[slow; 4], 0.5).expect("within it");
    for rim in run.state().rim_speeds() {
        assert!((rim / slow - 1.0).abs() < 0.02, "{rim} m/s");
    }
}

/// Straight down a slope wheels brake: motors that feed back take less, by the integral of what a
/// braking motor gives, V i below 0, and nothing else of the run changes.
#[test]
fn motors_that_feed_back_take_less_by_what_they_give_on_a_descent() {
    // Of a motor that loses little, fast enough that heat does not take all.
    let losing = Motor { resistance: 1.0, efficiency: 0.9, friction: 1e-4, ..MOTOR };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let driven = |motor: Motor| {
            let mut scenario = with(motor, across(18.0));
            scenario.start.yaw = deg(-90.0);
            let numerics = Numerics { approach, sample_interval: 0.02, ..scenario.numerics };
            scenario.numerics = numerics;
            run(&scenario)
        };
        let (lost, fed) = (driven(losing), driven(Motor { feeds_back: true, ..losing }));
        let given = |record: &Record| -> f64 {
            let motors = record.wheels.iter().filter_map(|wheel| wheel.electrical);
            motors.map(|it| (it.voltage * it.current).min(0.0)).sum()
        };
        let spans = lost.records.windows(2);
        let back: f64 = spans
            .map(|pair| {
                let span = pair[1].time - pair[0].time;
                0.5 * span * (given(&pair[0]) + given(&pair[1]))
            })
            .sum();
        let [lost_end, fed_end] = [&lost, &fed].map(|it| it.last().energy);
        let less = lost_end.electrical - fed_end.electrical;
        assert!(back < -0.5, "{approach:?}: {back} J");
        // Between records 0.02 s apart lie straight lines.
        assert!((less / -back - 1.0).abs() < 2e-3, "{approach:?}: {less} J, {back} J");
        assert!(fed_end.electrical > fed_end.motors, "what is lost is lost all the same");
        assert_eq!((lost_end.motors, lost.last().state), (fed_end.motors, fed.last().state));
    }
}

/// Set to stand on a slope, a wheel with a self-locking gear stands; one without creeps as its
/// short-circuited winding lets it, and friction above what the slope asks for holds it, too.
#[test]
fn a_rover_that_is_set_to_stand_holds_by_its_gear_or_by_friction() {
    let open = SpeedControl { gain: 0.0, ..PROPORTIONAL };
    let downhill = |motor: Motor| {
        let mut scenario = with(motor, across(10.0));
        scenario.start.yaw = deg(90.0);
        scenario.start.motion = Motion::Rest;
        scenario.drive = DriveLaw::Constant(0.0);
        let run = run(&scenario);
        -run.last().state.position.y
    };
    let locking = downhill(Motor { is_self_locking: true, ..controlled(open) });
    let rubbing = downhill(Motor { friction: 4e-3, ..controlled(open) });
    let rolling = downhill(Motor { friction: 0.0, ..controlled(open) });
    assert!(locking.abs() < 1e-3, "{locking} m");
    assert!(rubbing.abs() < 1e-3, "{rubbing} m");
    assert!(rolling > 0.02, "{rolling} m");
}

/// An independent integrator, and steps that hold: the same motion while the motors' speeds settle.
#[test]
fn motors_settle_alike_by_small_explicit_steps() {
    let control = SpeedControl { integral: 975.0, ..PROPORTIONAL };
    let ends = [Integrator::Adaptive { tolerance: 1e-8 }, Integrator::Rk4 { step: 2e-5 }].map(
        |integrator| {
            let mut scenario = with(controlled(control), across(10.0));
            scenario.duration = 0.3;
            scenario.numerics.integrator = integrator;
            *run(&scenario)
                .last()
                .wheels
                .iter()
                .map(|wheel| wheel.wheel_speed)
                .chain([run(&scenario).last().state.position.x])
                .collect::<Vec<f64>>()
                .first_chunk::<5>()
                .expect("four wheels and a place")
        },
    );
    for (one, other) in ends[0].iter().zip(&ends[1]) {
        assert!((one / other - 1.0).abs() < 1e-6, "{one}, {other}");
    }
}

/// A run in pieces is the run, bit for bit, with motors, windings and a battery as without.
#[test]
fn a_run_with_motors_goes_on_where_it_paused() {
    let motor = Motor { winding: Some(WINDING), ..controlled(PROPORTIONAL) };
    let battery = Battery { full_voltage: 3.4, empty_voltage: 2.6, cutoff_voltage: 1.0, ..BATTERY };
    for scenario in
        [with(controlled(PROPORTIONAL), across(10.0)), powered(motor, battery, across(10.0))]
    {
        let whole = run(&scenario);
        let mut run = Run::new(&scenario).expect("a run");
        for time in [2.5, 2.55, 7.3, 10.0] {
            run.advance(&mut scenario.drive.clone(), time).expect("it goes on");
        }
        let pieces = run.finish();
        assert_eq!(whole.last().state, pieces.last().state);
        assert_eq!(whole.last().wheels, pieces.last().wheels);
        assert_eq!(whole.last().battery, pieces.last().battery);
    }
}

pub(crate) const WINDING: Winding = Winding {
    thermal_resistance: 20.0,
    heat_capacity: 2.0,
    surroundings: 20.0,
    highest: 125.0,
    derated_from: None,
};

/// Two small cells.
pub(crate) const BATTERY: Battery = Battery {
    capacity: 20.0 * 3600.0,
    full_voltage: 8.4,
    empty_voltage: 6.4,
    resistance: 0.3,
    cutoff_voltage: 5.5,
    electronics: 3.0,
    charge: 1.0,
};

pub(crate) fn powered(motor: Motor, battery: Battery, scenario: Scenario) -> Scenario {
    let mut parts = scenario.rover.parts().clone();
    (parts.wheel_unit.motor, parts.battery) = (Some(motor), Some(battery));
    Scenario { rover: Rover::draft(parts).checked().expect("a rover"), ..scenario }
}

/// Closed form: a nearly steady current warms a winding to θ_0 + R(θ) i² R_th with its time
/// constant; on level ground the current is steady, and R(θ) is that of copper.
#[test]
fn windings_warm_by_their_current() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let motor = Motor { winding: Some(WINDING), ..MOTOR };
        let mut scenario = with(motor, across(0.0));
        scenario.numerics.approach = approach;
        scenario.duration = 200.0;
        let run = run(&scenario);
        for (wheel, record) in run.last().wheels.iter().enumerate() {
            let current = record.electrical.expect("a motor").current;
            // θ = 20 + x: x = R_th R (1 + α x) i².
            let heat = 20.0 * 10.0 * current * current;
            let settled = heat / (1.0 - 0.003_93 * heat);
            let warm = record.temperature.expect("a winding") - 20.0;
            assert!((warm / settled - 1.0).abs() < 0.01, "{approach:?}: {warm} K, {settled} K");
            let early = run.records[100].wheels[wheel].temperature.expect("a winding") - 20.0;
            let rise = 1.0 - (-10.0 / 40.0 * (1.0 - 0.003_93 * heat)).exp();
            let off = early / settled / rise - 1.0;
            assert!(off.abs() < 0.03, "{approach:?}: {early} K of {settled} K: {off}");
            let volts = record.electrical.expect("a motor").voltage;
            let speed = record.wheel_speed;
            let ohms = 10.0 * (1.0 + 0.003_93 * warm);
            assert!((volts - ohms * current - 2.5 * speed).abs() < 1e-9);
        }
    }
}

/// The energy is the integral of all that is drawn, and the charge falls by it and by what the
/// battery loses itself.
#[test]
fn a_battery_gives_what_motors_and_electronics_draw() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let motor = Motor { winding: Some(WINDING), ..MOTOR };
        let mut scenario = powered(motor, BATTERY, across(10.0));
        scenario.numerics.approach = approach;
        scenario.duration = 60.0;
        let run = run(&scenario);
        let power = |record: &Record| -> f64 {
            let wheels = record.wheels.iter().map(|wheel| wheel.electrical.expect("one").power);
            wheels.sum::<f64>() + 3.0
        };
        let (mut energy, mut charge) = (0.0, 1.0);
        for pair in run.records.windows(2) {
            let span = pair[1].time - pair[0].time;
            energy += 0.5 * span * (power(&pair[0]) + power(&pair[1]));
            let [one, other] = [&pair[0], &pair[1]].map(|record| {
                let battery = record.battery.expect("a battery");
                let open = 6.4 + 2.0 * battery.charge;
                let (u, i) = (battery.terminals.voltage, battery.terminals.current);
                assert!((u * i - power(record)).abs() < 1e-9 && (open - 0.3 * i - u).abs() < 1e-3);
                open * i
            });
            charge -= 0.5 * span * (one + other) / BATTERY.capacity;
        }
        let last = run.last();
        let battery = last.battery.expect("a battery");
        assert!((last.energy.electrical / energy - 1.0).abs() < 1e-3, "{approach:?}");
        assert!((battery.charge - charge).abs() < 1e-6, "{} and {charge}", battery.charge);
        assert!(energy / BATTERY.capacity < 1.0 - charge, "some is lost in the battery");
    }
}

/// What a battery or a winding is changes nothing of a rover whose motors hold their speed.
#[test]
fn battery_and_windings_change_no_bit_of_an_ideal_drive() {
    let plain = run(&across(10.0));
    let motor = Motor { winding: Some(WINDING), ..MOTOR };
    let powered = run(&powered(motor, BATTERY, across(10.0)));
    assert_eq!(plain.records.len(), powered.records.len());
    let states = |run: &Trajectory| -> Vec<_> { run.records.iter().map(|it| it.state).collect() };
    assert_eq!(states(&plain), states(&powered));
}

/// An empty battery, and one that cannot give the power, end the run; one at the end of its charge
/// slows the motors.
#[test]
fn a_battery_that_fails_is_an_outcome() {
    let ends = |battery: Battery| {
        let run = run(&powered(MOTOR, battery, across(10.0)));
        (run.outcome.clone(), run.last().time)
    };
    assert_eq!(ends(BATTERY).0, Outcome::Completed);
    let (empty, time) = ends(Battery { capacity: 40.0, ..BATTERY });
    assert!(matches!(empty, Outcome::BrownOut { because: PowerLost::Empty, .. }), "{empty:?}");
    // 40 J at 3 W and what the motors take, three watts or so.
    assert!((4.0..10.0).contains(&time), "{time} s");
    let (weak, time) = ends(Battery { resistance: 5.0, ..BATTERY });
    assert!(
        matches!(weak, Outcome::BrownOut { because: PowerLost::TooMuchDrawn { power }, .. } if power > 3.0),
        "{weak:?}"
    );
    assert!(time < 0.2, "{time} s");
    let (low, _) = ends(Battery { cutoff_voltage: 8.3, ..BATTERY });
    let Outcome::BrownOut { because: PowerLost::BelowCutoff { voltage, .. }, .. } = low else {
        panic!("{low:?}")
    };
    assert!(voltage < 8.3);
}

/// A hot winding lets through less current, until its rover stalls; the current never passes what
/// is allowed.
#[test]
fn a_derated_motor_stalls_before_it_burns() {
    let control = SpeedControl { integral: 975.0, current: Some(0.6), ..PROPORTIONAL };
    let winding =
        Winding { derated_from: Some(30.0), highest: 50.0, heat_capacity: 0.5, ..WINDING };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut scenario =
            with(Motor { winding: Some(winding), ..controlled(control) }, across(12.0));
        scenario.start.yaw = deg(90.0);
        scenario.duration = 60.0;
        scenario.numerics.approach = approach;
        let run = run(&scenario);
        assert!(stalled(&run), "{approach:?}: {:?}", run.outcome);
        for wheel in run.records.iter().flat_map(|record| &record.wheels) {
            assert!(wheel.temperature.expect("a winding") < 50.0);
            assert!(wheel.electrical.expect("a motor").current < 0.6 * (1.0 + 1e-3));
        }
    }
}

/// The voltage falls as the battery empties, and with it the speed of motors that have no other
/// limit.
#[test]
fn motors_slow_down_as_the_battery_empties() {
    let control = SpeedControl { integral: 975.0, ..PROPORTIONAL };
    let battery = Battery {
        full_voltage: 4.2,
        empty_voltage: 2.2,
        cutoff_voltage: 2.0,
        resistance: 0.02,
        capacity: 2000.0,
        ..BATTERY
    };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut scenario = powered(controlled(control), battery, across(5.0));
        scenario.duration = 200.0;
        scenario.numerics.approach = approach;
        let run = run(&scenario);
        // Ten records a second.
        let at = |time: usize| shares(&run.records[10 * time])[0];
        assert!((at(5) - 1.0).abs() < 1e-3, "{approach:?}: {}", at(5));
        assert!(at(180) < 0.99 && at(190) < at(180), "{}, {}", at(180), at(190));
        let late = run.last();
        let volts = late.wheels[0].electrical.expect("a motor").voltage;
        let given = late.battery.expect("a battery").terminals.voltage;
        assert!((volts / given - 1.0).abs() < 0.01, "{approach:?}: {volts} V of {given} V");
    }
}

/// What motors cost whose speed depends on their load: wheels that are settled in a dynamic run of
/// 20 s, and evaluations of a quasi-steady one of ten minutes, over those of a rover whose motors
/// hold their speed.
#[test]
fn motors_cost_at_most_twice_a_dynamic_run() {
    let integral = SpeedControl { integral: 975.0, ..PROPORTIONAL };
    let stiff = SpeedControl { gain: 1000.0, ..PROPORTIONAL };
    let cases = [
        (Approach::Dynamic, 20.0, [(PROPORTIONAL, 1.7), (stiff, 1.7), (integral, 2.1)]),
        (Approach::QuasiSteady, 600.0, [(PROPORTIONAL, 2.0), (stiff, 1.7), (integral, 1.5)]),
    ];
    for (approach, duration, controls) in cases {
        let work = |mut scenario: Scenario| {
            scenario.duration = duration;
            scenario.numerics.approach = approach;
            let work = run(&scenario).work;
            if approach == Approach::Dynamic { work.settled_wheels } else { work.evaluations }
        };
        let ideal = work(across(10.0)) as f64;
        for (control, most) in controls {
            let ratio = work(with(controlled(control), across(10.0))) as f64 / ideal;
            assert!(ratio < most, "{approach:?}, {control:?}: {ratio:.2}");
        }
    }
}
