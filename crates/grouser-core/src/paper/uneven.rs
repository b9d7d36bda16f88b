//! The paper's rover on uneven ground, which it never met: its wheels settle together as they do in
//! turns.

use std::f64::consts::FRAC_PI_6;

use crate::contact::Slip;
use crate::random::Random;
use crate::simulation::Scenario;
use crate::terrain::Ground;
use crate::terrain::surface::{Ripple, Surface};
use crate::units::{Vec2, Vec3};
use crate::vehicle::settling::ForceAccuracy;
use crate::vehicle::standing::{KnownStanding, NearbyStanding};
use crate::vehicle::{LoadSharing, OwnMoments, Rover, RoverState, Suspension, WheelReaction};

/// Anyhow standing on ripples, with three wheels or four on the ground: the wheels that settle
/// together are those that settle in turns.
#[test]
fn wheels_settle_together_as_they_do_in_turns() {
    let rigid = super::hakuto().expect("a rover");
    let pivot = Vec2::new(0.01, 0.03);
    let rockers = rigid.clone().on_rockers(Suspension { pivot, bogie: None }).expect("four");
    let (mut lifted, mut found) = (0, 0);
    for (number, rover) in [rigid, rockers].iter().enumerate() {
        for case in 0..60 {
            let mut draws = Random::stream(7, 100 * number as u64 + case);
            let (amplitude, wavelength) = (0.05 * draws.uniform(), 0.5 + 2.0 * draws.uniform());
            let ripple = Ripple { amplitude, wavelength, across: FRAC_PI_6, phase: 0.4 };
            let mut scenario = scenario_of(rover, ripple);
            scenario.ground.start = Vec2::new(draws.uniform(), draws.uniform());
            let Some((together, wheel, in_turns)) = both(&scenario, &mut draws) else {
                continue;
            };
            found += 1;
            lifted += usize::from(wheel.is_some());
            for (one, other) in together.iter().zip(&in_turns) {
                let off = (one.load - other.load).abs();
                assert!(off < 1e-8, "{number} {case}: {} N and {} N", one.load, other.load);
                let (one, other) = (one.settled, other.settled);
                let off = (one.sinkage - other.sinkage).abs();
                assert!(off < 1e-8, "{number} {case}: {off:e} m");
                let off = (one.forces.drawbar_pull - other.forces.drawbar_pull).abs();
                assert!(off < 1e-8, "{number} {case}: {off:e} N");
            }
        }
    }
    assert!(found > 90 && lifted > 3, "{found} found together, {lifted} with a wheel lifted");
}

fn scenario_of(rover: &Rover, ripple: Ripple) -> Scenario {
    let scenario = super::traverse().expect("a scenario");
    let ground = Ground::formula(scenario.ground.soil, Surface::Ripple(ripple));
    let (sharing, own_moments) = (LoadSharing::Complete, OwnMoments::Included);
    Scenario { rover: rover.clone(), ground, sharing, own_moments, ..scenario }
}

/// The wheels both ways, with the one that is lifted; none where they are not found together.
fn both(
    scenario: &Scenario,
    draws: &mut Random,
) -> Option<(Vec<WheelReaction>, Option<usize>, Vec<WheelReaction>)> {
    let ground = scenario.on_ground();
    let state = RoverState { yaw: 6.0 * draws.uniform(), ..RoverState::default() };
    let posture = ground.standing_posture(&state).expect("it stands");
    let slips: Vec<Slip> = (0..posture.wheels.len())
        .map(|_| Slip::on_test_stand(draws.uniform() - 0.3, 0.6 * draws.uniform() - 0.3))
        .collect();
    let sought = ground.sought(&posture, Vec3::z(), &slips, &[]);
    // Whichever wheel was lifted before, the one that is lifted now is found.
    let share = draws.uniform();
    let lifted = (0..4).find(|wheel| share < 0.2 * (*wheel as f64 + 1.0));
    let mut known = KnownStanding::default();
    known.lifted = lifted;
    let together = sought.together(&mut known, ForceAccuracy::EXACT)?;
    let in_turns = sought.in_turns(&mut NearbyStanding::default()).expect("they settle");
    Some((together, known.lifted, in_turns))
}
