//! Wheels in the ruts of those before them.

use std::f64::consts::{FRAC_PI_2, PI};

use grouser::contact::Slip;
use grouser::document::{self, Overrides, Source, experiment};
use grouser::simulation::equations::Equations;
use grouser::simulation::{Run, Scenario, Start};
use grouser::soil::Compaction;
use grouser::units::{Vec2, deg};
use grouser::vehicle::{Rover, RoverState, Ruts};

fn scenario(settings: &[&str]) -> Scenario {
    let overrides = Overrides::parse(settings).expect("they are settings");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("it is one").value
}

/// Denser by a tenth, and sheared sooner by a tenth.
const STATED: Compaction = Compaction { density: 1.1, shear_modulus: 0.9 };

/// What each wheel of a rover finds that goes straight at a crab angle [rad], its wheels with a
/// slip ratio of 0.2.
fn found(ruts: Ruts, rover: &Rover, crab: f64) -> Vec<Compaction> {
    let velocity = Vec2::new(crab.cos(), -crab.sin());
    let rim_speed = velocity.x / 0.8;
    let slips = vec![Slip::of_motion(rim_speed, velocity); rover.wheel_count()];
    ruts.of_wheels(rover, &slips).expect("there are ruts")
}

/// The share of a rut that each wheel finds, from the density.
fn shares(rover: &Rover, crab: f64) -> Vec<f64> {
    let all = found(Ruts::Stated(STATED), rover, crab);
    all.iter().map(|it| (it.density - 1.0) / (STATED.density - 1.0)).collect()
}

/// Source: the overlap o = 1 − L |sin γ|/b by hand: HAKUTO's wheels are 0.36 m apart and 0.08 m
/// wide. Straight ahead it is whole, and of other signs the same.
#[test]
fn rear_wheels_overlap_as_the_way_lets_them() {
    let rover = scenario(&[]).rover;
    for (crab, expected) in [(0.0, 1.0), (3.3, 0.741), (5.5, 0.569), (9.2, 0.281), (12.9, 0.0)] {
        for crab in [crab, -crab] {
            for (mount, share) in rover.mounts().iter().zip(shares(&rover, deg(crab))) {
                let expected = if mount.position.x > 0.0 { 0.0 } else { expected };
                assert!((share - expected).abs() < 1e-3, "{} at {crab}°: {share}", mount.name);
            }
        }
    }
}

/// Backward the front wheels follow.
#[test]
fn whoever_goes_behind_follows() {
    let rover = scenario(&[]).rover;
    for (mount, share) in rover.mounts().iter().zip(shares(&rover, PI)) {
        let expected = f64::from(u8::from(mount.position.x > 0.0));
        assert!((share - expected).abs() < 1e-6, "{}: {share}", mount.name);
    }
}

/// Six wheels: the middle ones on one pass, the last on two.
#[test]
fn a_third_wheel_finds_two_passes() {
    let rover = scenario(&["scenario.rover=curiosity"]).rover;
    assert_eq!(rover.wheel_count(), 6);
    let all = found(Ruts::Compacted, &rover, 0.0);
    let mut by_place: Vec<(f64, f64)> =
        rover.mounts().iter().zip(&all).map(|(mount, it)| (mount.position.x, it.density)).collect();
    by_place.sort_by(|one, other| other.0.total_cmp(&one.0));
    assert_eq!((by_place[0].1, by_place[1].1), (1.0, 1.0));
    for (pass, pair) in by_place.chunks(2).enumerate().skip(1) {
        // The wheels of that rover do not stand in line: a rut is met in part.
        let whole = Compaction::of_passes(0.2, u32::try_from(pass).expect("few")).density;
        for (_, density) in pair {
            assert!(*density > 1.0 && *density <= whole + 1e-9, "{density} and {whole}");
        }
    }
    assert!(by_place[4].1 > by_place[2].1);
}

fn final_state(scenario: &Scenario) -> RoverState {
    Run::new(scenario).and_then(Run::to_end).expect("it runs").last().state
}

/// Off, and where ruts are not met, all is fresh to the last bit.
#[test]
fn without_overlap_the_soil_is_fresh() {
    let fresh = scenario(&["scenario.slope_deg=20", "scenario.start.yaw_deg=20"]);
    assert_eq!(fresh.ruts, Ruts::Fresh);
    let unmet = Scenario { ruts: Ruts::Stated(Compaction::NONE), ..fresh.clone() };
    assert_eq!(final_state(&fresh), final_state(&unmet));
    // Along the contour at a yaw above 12.9° the rear wheels run beside the ruts.
    let crabbed = Scenario { ruts: Ruts::Compacted, ..fresh.clone() };
    let rates = |scenario: &Scenario, yaw: f64| {
        let velocity = 0.05 * Vec2::new(yaw.cos(), -yaw.sin());
        let state = RoverState { yaw, velocity, ..RoverState::default() };
        Equations::of(scenario, &[0.06; 4]).rates(&state).expect("it is a motion")
    };
    assert_eq!(rates(&fresh, deg(13.0)), rates(&crabbed, deg(13.0)));
    assert_ne!(rates(&fresh, deg(12.0)), rates(&crabbed, deg(12.0)));
}

/// Source: an independent computation (Python): the yaw lost with 10 % more density and 10 % less
/// modulus, the overlap that of the measured yaw at the start. Ours follows the way, which the yaw
/// leaves as it falls.
#[test]
fn ruts_take_yaw_as_an_independent_implementation_has_it() {
    let base = Scenario { ruts: Ruts::Stated(STATED), ..scenario(&[]) };
    for (row, expected) in experiment::table_4().iter().zip([0.78, 1.72, 2.93, 6.05]) {
        let run = Scenario {
            ground: base.ground.with_slope(row.slope),
            start: Start { yaw: row.initial_yaw, ..base.start },
            ..base.clone()
        };
        let lost = (row.initial_yaw - final_state(&run).yaw).to_degrees();
        assert!((lost - expected).abs() < 0.06 * expected, "{lost}° and {expected}°");
    }
}

/// Straight up and straight down the rear wheels are wholly in ruts, and nothing turns the rover.
#[test]
fn up_and_down_the_slope_ruts_turn_nothing() {
    for yaw in [FRAC_PI_2, -FRAC_PI_2] {
        let start = Start { yaw, ..scenario(&[]).start };
        let base = Scenario { ruts: Ruts::Compacted, start, ..scenario(&[]) };
        let end = final_state(&base);
        assert!((end.yaw - yaw).abs() < 1e-9 && end.position.x.abs() < 1e-9, "{end:?}");
        let fresh = final_state(&Scenario { ruts: Ruts::Fresh, ..base });
        // Denser sand slips less: up the slope farther, and down it no faster.
        assert!(end.position.y > fresh.position.y, "{end:?} and {fresh:?}");
    }
}

#[test]
fn the_mirror_image_has_the_mirrored_ruts() {
    let start = |yaw: f64| Start { yaw, ..scenario(&[]).start };
    let base = Scenario { ruts: Ruts::Compacted, ..scenario(&["scenario.duration_s=5"]) };
    let there = final_state(&Scenario { start: start(deg(4.0)), ..base.clone() });
    let back = final_state(&Scenario { start: start(PI - deg(4.0)), ..base });
    assert!((there.position.x + back.position.x).abs() < 1e-8);
    assert!((there.position.y - back.position.y).abs() < 1e-8);
    assert!((there.yaw - (PI - back.yaw)).abs() < 1e-8);
}

#[test]
fn documents_name_ruts() {
    assert_eq!(scenario(&["scenario.ruts=compacted"]).ruts, Ruts::Compacted);
    assert_eq!(scenario(&["scenario.ruts=none"]).ruts, Ruts::Fresh);
    let wrong = Overrides::parse(["scenario.ruts=deep"]).expect("it is a setting");
    let message = document::read_scenario(&Source::default_scenario(), &wrong)
        .expect_err("no ruts are called deep")
        .to_string();
    assert!(message.contains("ruts") && message.contains("compacted"), "{message}");
}
