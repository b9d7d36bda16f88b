//! Motors that turn as fast as they are told, and what they take from the battery.

use grouser::simulation::{Approach, Numerics, Scenario};
use grouser::soil::{Shear, Soil};
use grouser::units::deg;
use grouser::vehicle::{LoadSharing, Motor, OwnMoments, Rover};

use super::given::{RIM_SPEED, linear, run, traverse};
use super::mounts::firm;

/// A micro rover's: of the size that theory gives for one.
pub(crate) const MOTOR: Motor = Motor {
    resistance: 10.0,
    torque_constant: 0.010,
    gear_ratio: 250.0,
    efficiency: 0.6,
    friction: 1e-3,
    is_self_locking: false,
};

pub(crate) fn with(motor: Motor, scenario: Scenario) -> Scenario {
    let mut parts = scenario.rover.parts().clone();
    parts.wheel_unit.motor = Some(motor);
    Scenario { rover: Rover::draft(parts).checked().expect("a rover"), ..scenario }
}

fn across(slope: f64) -> Scenario {
    let (sharing, own_moments) = (LoadSharing::Complete, OwnMoments::Included);
    Scenario { sharing, own_moments, duration: 10.0, ..traverse(deg(slope), deg(3.0)) }
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

/// The energy is the integral of the power, and that of the run's motors with their losses: by hand from each record.
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
    scenario.site = scenario.site.with_soil(soil);
    let weight = scenario.rover.mass() * scenario.site.gravity;
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
