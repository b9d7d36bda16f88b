//! The reaction over a time step: the theory's where nothing yields, never past rest, and solved.

use grouser::contact::slip::CREEP_SPEED;
use grouser::contact::time_step::{FORCES, MOTIONS, REST_SPEED, SINKAGE_DAMPING};
use grouser::contact::{Contact, Model, Slip, Stepped, SteppingWheel, TimeStep};
use grouser::units::{EARTH_GRAVITY, Vec2, mm};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::given::{cases, hakuto_wheel, toyoura};

/// Mass of the block that a lone wheel carries [kg].
const MASS: f64 = 1.7;

/// A lone wheel of mass [`MASS`] whose hub moves freely and whose rim is driven.
fn lone_wheel() -> DMatrix<f64> {
    DMatrix::from_fn(
        MOTIONS,
        FORCES,
        |motion, force| {
            if motion == force && motion < 3 { 1.0 / MASS } else { 0.0 }
        },
    )
}

fn reaction(
    inverse_mass: &DMatrix<f64>,
    duration: f64,
    sinkage: f64,
    free: [f64; MOTIONS],
) -> Stepped {
    reaction_near(inverse_mass, duration, sinkage, free, free)
}

fn reaction_near(
    inverse_mass: &DMatrix<f64>,
    duration: f64,
    sinkage: f64,
    free: [f64; MOTIONS],
    near: [f64; MOTIONS],
) -> Stepped {
    let step = TimeStep {
        duration,
        gravity: EARTH_GRAVITY,
        damping: SINKAGE_DAMPING,
        rest_speed: REST_SPEED,
        inverse_mass,
        free: &DVector::from_row_slice(&free),
    };
    let (wheel, soil, model) = (hakuto_wheel(), toyoura(), Model::Ishigami.as_ref());
    let near = DVector::from_row_slice(&near);
    step.reaction_near(&[SteppingWheel { model, wheel, soil, sinkage }], &near)
}

#[test]
fn where_nothing_yields_the_reaction_is_the_theorys() {
    let stepped = reaction(&DMatrix::zeros(4, 6), 0.002, mm(12.0), [0.05, -0.01, 0.0, 0.06]);
    let measure = CREEP_SPEED / REST_SPEED;
    let slip = Slip::of_motion(0.06 * measure, Vec2::new(0.05, -0.01) * measure);
    let contact = Contact { wheel: hakuto_wheel(), soil: toyoura(), slip, gravity: EARTH_GRAVITY };
    let model = Model::Ishigami.as_ref().forces(&contact, mm(12.0));
    assert_eq!(stepped.wheels[0].forces, model);
    assert_eq!((stepped.residual, stepped.rounds), (0.0, 0));
}

#[test]
fn above_the_ground_there_is_no_reaction() {
    let stepped = reaction(&lone_wheel(), 0.002, mm(-3.0), [0.0, 0.0, -0.1, 0.06]);
    assert_eq!(stepped.wheels[0].forces.normal_force, 0.0);
    assert_eq!(stepped.rounds, 0);
}

/// A locked wheel that slides is stopped, as by dry friction: backward Euler never lets it turn
/// back, however long the step. Taken at the start of the step, the force would throw it to and
/// fro.
#[test]
fn a_locked_wheel_slides_to_a_stop_and_not_back() {
    for duration in [0.001, 0.002, 0.005, 0.02] {
        let (mut speed, mut steps) = (0.1, 0);
        while speed > REST_SPEED {
            let stepped = reaction(&lone_wheel(), duration, mm(12.0), [speed, 0.0, 0.0, 0.0]);
            let next = speed + duration * stepped.wheels[0].forces.drawbar_pull / MASS;
            assert!(next < speed && next >= 0.0, "{speed} m/s becomes {next} m/s");
            (speed, steps) = (next, steps + 1);
            assert!(steps < 10_000, "still at {speed} m/s");
        }
    }
}

proptest! {
    #![proptest_config(cases(400))]

    /// A residual of a millionth of the rest speed, for any motion, sinkage and step.
    #[test]
    fn the_motion_at_the_end_is_found(
        free in prop::array::uniform4(-0.3..0.3_f64),
        is_still in prop::array::uniform4(prop::bool::weighted(0.3)),
        sinkage in 0.0..0.05_f64,
        log_duration in -4.0..-2.0_f64,
        log_mass in -1.0..2.0_f64,
    ) {
        let free: Vec<f64> =
            free.iter().zip(is_still).map(|(v, still)| if still { 0.0 } else { *v }).collect();
        let inverse_mass = lone_wheel() * (MASS / 10.0_f64.powf(log_mass));
        let free = [free[0], free[1], free[2], free[3]];
        let stepped = reaction(&inverse_mass, 10.0_f64.powf(log_duration), sinkage, free);
        prop_assert!(stepped.residual <= 1e-6 * REST_SPEED, "{stepped:?}");
    }

    /// A reaction is the same wherever it is sought from.
    #[test]
    fn the_reaction_does_not_depend_on_where_it_is_sought_from(
        free in prop::array::uniform4(-0.3..0.3_f64),
        apart in prop::array::uniform4(-0.05..0.05_f64),
        sinkage in 0.002..0.04_f64,
        log_duration in -4.0..-2.0_f64,
    ) {
        let (mass, duration) = (lone_wheel(), 10.0_f64.powf(log_duration));
        let near = std::array::from_fn(|k| free[k] + apart[k]);
        let alone = reaction(&mass, duration, sinkage, free).wheels[0].forces;
        let sought = reaction_near(&mass, duration, sinkage, free, near).wheels[0].forces;
        let size = 1e-4 * (1.0 + alone.normal_force.abs() + alone.drawbar_pull.abs());
        for (one, other) in [
            (alone.drawbar_pull, sought.drawbar_pull),
            (alone.side_force, sought.side_force),
            (alone.normal_force, sought.normal_force),
        ] {
            prop_assert!((one - other).abs() < size, "{alone:?} {sought:?}");
        }
    }
}
