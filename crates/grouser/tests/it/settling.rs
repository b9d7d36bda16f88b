//! All wheels of a rover settle under loads that depend on their forces: loads, sinkages and forces
//! are those of each other, wherever the search began.

use grouser::contact::{Contact, Model, Slip, settle_from};
use grouser::simulation::Scenario;
use grouser::units::deg;
use grouser::vehicle::load;
use grouser::vehicle::on_ground::{OnGround, WheelReaction, forces_of};
use grouser::vehicle::{KnownWheels, LoadSharing, OwnMoments, RoverState, Stance};
use proptest::prelude::*;

use super::{discrepancy, given};

/// How far what settles may be from what it should be, over the weight [-]: what a kink of the
/// forces leaves.
const TOLERANCE: f64 = 1e-9;

fn check(ground: &OnGround<'_>, state: &RoverState, wheels: &[WheelReaction]) {
    let stance = ground.stance(state);
    let OnGround { rover, gravity, sharing, own_moments, .. } = *ground;
    let forces: Vec<_> = forces_of(wheels).copied().collect();
    let moments = load::moments(rover, stance.pull, sharing, own_moments, &forces);
    let loads = load::wheel_loads(rover, sharing, stance.weight, moments).expect("it stands");
    let soil = ground.ground.soil.on_slope(stance.steepness);
    let off = |one: f64, other: f64| (one - other).abs() / stance.weight;
    for ((wheel, mount), load) in wheels.iter().zip(rover.mounts()).zip(loads) {
        let slip = wheel.slip;
        let contact = Contact { wheel: mount.unit.wheel, soil, slip, gravity };
        let there = ground.model.forces(&contact, wheel.settled.sinkage);
        let found = &wheel.settled.forces;
        for (one, other) in [
            (wheel.load, load),
            (found.normal_force, load),
            (found.drawbar_pull, there.drawbar_pull),
            (found.side_force, there.side_force),
            (found.torque, there.torque),
            (found.overturning_moment, there.overturning_moment),
        ] {
            assert!(off(one, other) < TOLERANCE, "{one} and {other}: {wheel:?}");
        }
    }
}

/// Each wheel has the sinkage and the forces that it has by itself under its load.
fn check_alone(ground: &OnGround<'_>, stance: &Stance, wheels: &[WheelReaction]) {
    let soil = ground.ground.soil.on_slope(stance.steepness);
    for (wheel, mount) in wheels.iter().zip(ground.rover.mounts()) {
        let (slip, gravity) = (wheel.slip, ground.gravity);
        let contact = Contact { wheel: mount.unit.wheel, soil, slip, gravity };
        let found = &wheel.settled;
        let alone = settle_from(ground.model, &contact, wheel.load, found.sinkage);
        let alone = alone.expect("it is carried");
        let is_near = |one: f64, other: f64| (one - other).abs() < TOLERANCE * stance.weight;
        assert!((found.sinkage / alone.sinkage - 1.0).abs() < 1e-8, "{found:?} and {alone:?}");
        let (one, other) = (&found.forces, &alone.forces);
        assert!(is_near(one.drawbar_pull, other.drawbar_pull), "{found:?} and {alone:?}");
        assert!(is_near(one.side_force, other.side_force), "{found:?} and {alone:?}");
        assert!(is_near(one.torque, other.torque), "{found:?} and {alone:?}");
    }
}

proptest! {
    #![proptest_config(given::cases(60))]

    #[test]
    fn loads_and_forces_are_those_of_each_other(
        slope in 0.0..deg(25.0),
        yaw in -1.0..1.0,
        slips in prop::array::uniform4((-0.3..0.9, -0.6..0.6)),
        model in prop::sample::select(vec![Model::Ishigami, Model::Bekker, Model::SmallWheel]),
        sharing in prop::sample::select(vec![LoadSharing::Complete, LoadSharing::QuasiStaticTorque]),
    ) {
        let own_moments = OwnMoments::Included;
        let scenario = Scenario { model, sharing, own_moments, ..given::traverse(slope, 0.0) };
        let ground = scenario.on_ground();
        let state = RoverState { yaw, ..RoverState::default() };
        let stance = ground.stance(&state);
        let all = |shift: f64| {
            slips.map(|(ratio, angle)| Slip::on_test_stand(ratio + shift, angle + shift))
        };
        if let Ok(wheels) = ground.reactions(&stance, &all(0.0)) {
            check(&ground, &state, &wheels);
            for shift in [1e-8, 1e-3, 0.05] {
                if let Ok(near) = ground.reactions_near(&stance, &all(shift), &wheels) {
                    check(&ground, &state, &near);
                }
            }
        }
    }

    /// What is known of a motion nearby changes no answer, nor does what a soil's discrepancy adds,
    /// nor a model that does not say how a shallow wheel sinks.
    #[test]
    fn wheels_that_settle_together_have_what_each_has_alone(
        slope in 0.0..deg(20.0),
        yaw in -1.0..1.0,
        slips in prop::array::uniform4((-0.2..0.7, -0.5..0.5)),
        model in prop::sample::select(Model::ALL.to_vec()),
        is_off in any::<bool>(),
    ) {
        let (sharing, own_moments) = (LoadSharing::Complete, OwnMoments::Included);
        let mut scenario =
            Scenario { model, sharing, own_moments, ..given::traverse(slope, 0.0) };
        scenario.ground.soil.discrepancy = is_off.then(discrepancy::uneven);
        let ground = scenario.on_ground();
        let stance = ground.stance(&RoverState { yaw, ..RoverState::default() });
        let mut known = KnownWheels::default();
        for shift in [0.0, 1e-8, 1e-3, 0.05] {
            let all = slips.map(|(ratio, angle)| Slip::on_test_stand(ratio + shift, angle + shift));
            if let Ok(wheels) = ground.reactions_by(&stance, &all, &mut known) {
                check_alone(&ground, &stance, &wheels);
            }
        }
    }
}
