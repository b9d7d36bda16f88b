//! Contour traverses with wheels at speeds of their own.

use std::f64::consts::PI;

use grouser::contact::{Contact, Slip, settle};
use grouser::document::{self, Overrides, Source};
use grouser::simulation::equations::Equations;
use grouser::simulation::{Run, Scenario, Start};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::wheel_speeds::{
    SpeedFreedom, StraightMotion, USUAL_RATIO, WheelSpeedStudy, WheelSpeeds,
};
use grouser::units::{Vec2, deg};
use grouser::vehicle::{DriveLaw, RoverState};

fn scenario(settings: &[&str]) -> Scenario {
    let overrides = Overrides::parse(settings).expect("they are settings");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("it is one").value
}

fn study(settings: &[&str]) -> WheelSpeeds {
    WheelSpeeds::of(WheelSpeedStudy::of(&scenario(settings))).expect("it has a curve")
}

const SETTINGS: [&[&str]; 3] =
    [&[], &["scenario.load_transfer=quasi-static"], &["scenario.model=rft"]];
const FREE: [SpeedFreedom; 2] = [SpeedFreedom::BySide, SpeedFreedom::ByWheel];

/// Mean rim speed of runs [m/s].
const RIM_SPEED: f64 = 0.06;

/// The rim speeds of a motion, at that mean [m/s].
fn rim_speeds(motion: &StraightMotion) -> Vec<f64> {
    let mean = motion.speed_ratios.iter().sum::<f64>() / motion.speed_ratios.len() as f64;
    motion.speed_ratios.iter().map(|ratio| RIM_SPEED / mean * ratio).collect()
}

/// A run at the motion's speeds and from its yaw.
fn run(base: &Scenario, motion: &StraightMotion) -> Scenario {
    Scenario {
        ground: base.ground.with_slope(motion.slope),
        drive: DriveLaw::ConstantEach(rim_speeds(motion)),
        start: Start { yaw: motion.yaw, ..base.start },
        duration: 60.0,
        ..base.clone()
    }
}

/// Source: the equations of motion that runs are made of, which know nothing of the search.
#[test]
fn nothing_accelerates_in_a_straight_motion() {
    for settings in SETTINGS {
        let (base, found) = (scenario(settings), study(settings));
        for freedom in FREE {
            let motion = found.least_energy(freedom, deg(12.0)).expect("there is one");
            let (run, rims) = (run(&base, &motion), rim_speeds(&motion));
            let speed = rims[0] / motion.speed_ratios[0];
            let velocity = speed * Vec2::new(motion.yaw.cos(), -motion.yaw.sin());
            let state = RoverState { yaw: motion.yaw, velocity, ..RoverState::default() };
            let rates = Equations::of(&run, &rims).rates(&state).expect("it is a motion");
            let linear = rates.acceleration.velocity_rate.norm();
            // A push of 1e-6 of the weight; resistive force theory, which is stiffer, feels creep
            // more.
            let most = if settings.contains(&"scenario.model=rft") { 5e-4 } else { 1e-5 };
            assert!(linear < most, "{settings:?} {freedom:?}: {linear} m/s²");
            let turning = rates.acceleration.yaw_acceleration.abs();
            assert!(turning < 10.0 * most, "{settings:?} {freedom:?}: {turning} rad/s²");
            assert!(rates.velocity_slope.y.abs() < 1e-12 && rates.yaw_rate == 0.0);
            let power = rates.motor_power / speed;
            assert!((power / motion.energy_per_metre - 1.0).abs() < 1e-4, "{power} J/m");
        }
    }
}

/// Where a small error of the yaw fades, a run at these speeds stays on the contour for a minute
/// without a hand on it. What it drifts is what its start costs, at which it moves along its own
/// axis.
#[test]
fn a_run_at_these_speeds_stays_on_the_contour() {
    let (base, found) = (scenario(&[]), study(&[]));
    for slope in [5.0, 10.0, 15.0, 20.0] {
        for freedom in FREE {
            let motion = found.least_energy(freedom, deg(slope)).expect("there is one");
            assert!(motion.yaw_growth < 0.0, "{freedom:?} on {slope}°: {}", motion.yaw_growth);
            let end = Run::new(&run(&base, &motion)).and_then(Run::to_end).expect("it runs");
            let state = end.last().state;
            assert!(state.position.x > 1.5, "{freedom:?} on {slope}°: {state:?}");
            assert!(state.position.y.abs() < 2e-3, "{freedom:?} on {slope}°: {state:?}");
            assert!((state.yaw - motion.yaw).abs() < deg(0.05), "{freedom:?} on {slope}°");
        }
    }
}

/// An error of the yaw grows or fades in a run as the study says: over the way, by e for each
/// 1/growth.
#[test]
fn an_error_of_the_yaw_changes_as_fast_as_the_study_says() {
    let (base, found) = (scenario(&[]), study(&[]));
    let motion = found.least_energy(SpeedFreedom::BySide, deg(20.0)).expect("there is one");
    let yaw_at = |error: f64| {
        let start = run(&base, &motion);
        let start = Scenario { start: Start { yaw: motion.yaw + error, ..start.start }, ..start };
        let end = Run::new(&start).and_then(Run::to_end).expect("it runs");
        (end.last().state.yaw, end.last().state.position.x)
    };
    let error = deg(0.05);
    let ((above, way), (below, _)) = (yaw_at(error), yaw_at(-error));
    let growth = ((above - below) / (2.0 * error)).ln() / way;
    assert!((growth / motion.yaw_growth - 1.0).abs() < 0.03, "{growth} and {}", motion.yaw_growth);
}

/// In a mirror that swaps right and left the rover crosses the slope the other way.
#[test]
fn the_mirror_image_holds_the_contour_too() {
    let (base, found) = (scenario(&[]), study(&[]));
    let motion = found.least_energy(SpeedFreedom::ByWheel, deg(15.0)).expect("there is one");
    let there = run(&base, &motion);
    let mirrored: Vec<f64> = {
        let speeds = rim_speeds(&motion);
        let of = |name: &str| {
            let place = base.rover.mounts().iter().position(|mount| mount.name == name);
            speeds[place.expect("it has such a wheel")]
        };
        base.rover.mirrored().mounts().iter().map(|mount| of(&mount.name)).collect()
    };
    let back = Scenario {
        rover: base.rover.mirrored(),
        drive: DriveLaw::ConstantEach(mirrored),
        start: Start { yaw: PI - motion.yaw, ..base.start },
        ..there.clone()
    };
    let end = |scenario: &Scenario| {
        Run::new(scenario).and_then(Run::to_end).expect("it runs").last().state.position
    };
    let (there, back) = (end(&there), end(&back));
    assert!((there.x + back.x).abs() < 1e-6 && (there.y - back.y).abs() < 1e-6, "{there} {back}");
}

/// The wheels of a four-wheel rover in three equations leave one freedom too few, or one more: what
/// is free can only help, and what bounds it less too.
#[test]
fn more_freedom_is_never_worse() {
    for settings in SETTINGS {
        let found = study(settings);
        let steepest = FREE.map(|freedom| found.steepest(freedom).expect("there is one").slope);
        assert!(steepest[1] >= steepest[0] - 1e-6, "{settings:?}: {steepest:?}");
        let least = FREE.map(|freedom| {
            found.least_energy(freedom, deg(15.0)).expect("there is one").energy_per_metre
        });
        assert!(least[1] <= least[0] * (1.0 + 1e-6), "{settings:?}: {least:?}");
    }
}

/// With the paper's loads forces follow loads, and one speed of all wheels leaves hardly a yaw
/// moment: speeds of their own move the limit by less than 0.01°. With complete loads the moment
/// has to be balanced as well, which costs hundredths of a degree.
#[test]
fn speeds_of_their_own_hardly_move_the_steepest_slope() {
    for (settings, most) in [(SETTINGS[1], 0.01), (SETTINGS[0], 0.06)] {
        let found = study(settings);
        let alike = found.curve().limit().expect("it moves").0;
        for freedom in FREE {
            let own = found.steepest(freedom).expect("there is one").slope;
            assert!((own - alike).abs() < deg(most), "{settings:?} {freedom:?}: {own} and {alike}");
        }
    }
}

#[test]
fn on_level_ground_all_wheels_turn_alike() {
    let found = study(&[]);
    let level = found.curve().at(0.0).expect("it moves");
    for freedom in FREE {
        let motion = found.least_energy(freedom, 0.0).expect("there is one");
        assert!(motion.yaw.abs() < 1e-6, "{}", motion.yaw);
        for ratio in &motion.speed_ratios {
            assert!((ratio - level.speed_ratio()).abs() < 0.01, "{:?}", motion.speed_ratios);
        }
    }
}

/// No wheel is faster than it may be, and a bound that is nearly 1 leaves nearly equal speeds.
#[test]
fn speeds_keep_their_bound() {
    for most_ratio in [1.001, 1.01, USUAL_RATIO] {
        let study = WheelSpeedStudy { most_ratio, ..WheelSpeedStudy::of(&scenario(&[])) };
        let found = WheelSpeeds::of(study).expect("it has a curve");
        for motion in [found.steepest(SpeedFreedom::ByWheel), found.steepest(SpeedFreedom::BySide)]
        {
            let ratios = motion.expect("there is one").speed_ratios;
            let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
            let most = ratios.iter().copied().fold(0.0, f64::max) / mean;
            assert!(most <= most_ratio + 1e-6, "{most}");
        }
    }
    for wrong in [1.0, 0.5, f64::NAN, f64::INFINITY] {
        let study = WheelSpeedStudy { most_ratio: wrong, ..WheelSpeedStudy::of(&scenario(&[])) };
        assert!(WheelSpeeds::of(study).is_err(), "{wrong}");
    }
}

/// Backward, a wheel drags more than one with the same load can pull, whatever its slip: two wheels
/// of four that turn backward stop the other two.
#[test]
fn wheels_that_turn_backward_outweigh_those_that_drive() {
    let base = scenario(&[]);
    let load = 17.0;
    let model = base.model.as_ref();
    let pull = |slip_ratio: f64| {
        let soil = base.ground.soil.on_slope(0.0);
        let slip = Slip::on_test_stand(slip_ratio, 0.0);
        let wheel = base.rover.mounts()[0].unit.wheel;
        let contact = Contact { wheel, soil, slip, gravity: base.gravity };
        settle(model, &contact, load).expect("it carries it").forces.drawbar_pull
    };
    let driven = (0..100).map(|step| pull(f64::from(step) / 100.0)).fold(0.0, f64::max);
    let backward = (0..=99).map(|step| -pull(-1.0 - f64::from(step) / 100.0));
    let least = backward.fold(f64::INFINITY, f64::min);
    assert!(least > driven, "{least} N and {driven} N");
    assert_eq!(study(&[]).steepest(SpeedFreedom::UphillReversed), None);
}

/// What is said of least work is so: speeds of all wheels beside those found, brought back onto the
/// contour by another solver, need more.
#[test]
fn no_speeds_nearby_need_less_work() {
    let (base, found) = (scenario(&[]), study(&[]));
    let slope = deg(18.0);
    let best = found.least_energy(SpeedFreedom::ByWheel, slope).expect("there is one");
    let heading = HeadingStudy::of(&base);
    // Yaw and the downhill side's speed are what brings it back.
    let motion = |ratios: &[f64], yaw: f64, downhill: f64| {
        let rims: Vec<f64> = base
            .rover
            .mounts()
            .iter()
            .zip(ratios)
            .map(|(mount, ratio)| {
                RIM_SPEED * ratio * if mount.position.y < 0.0 { downhill } else { 1.0 }
            })
            .collect();
        let motion = heading.steady_motion_of(slope, yaw, &rims).expect("it settles");
        let torques = motion.wheels.iter().map(|wheel| wheel.settled.forces.torque);
        let radius = base.rover.common_radius().expect("its wheels are alike");
        let power: f64 = torques.zip(&rims).map(|(torque, rim)| torque * rim / radius).sum();
        (motion.course(), motion.turning(), power / motion.speed())
    };
    let held = |ratios: &[f64]| {
        let (mut yaw, mut downhill) = (best.yaw, 1.0);
        for _ in 0..20 {
            let (course, turning, energy) = motion(ratios, yaw, downhill);
            if course.abs() < 1e-8 && turning.abs() < 1e-7 {
                return energy;
            }
            const STEP: f64 = 1e-5;
            let by_yaw = motion(ratios, yaw + STEP, downhill);
            let by_speed = motion(ratios, yaw, downhill + STEP);
            let [a, b] = [(by_yaw.0 - course) / STEP, (by_speed.0 - course) / STEP];
            let [c, d] = [(by_yaw.1 - turning) / STEP, (by_speed.1 - turning) / STEP];
            let divisor = a * d - b * c;
            yaw -= (d * course - b * turning) / divisor;
            downhill -= (a * turning - c * course) / divisor;
        }
        panic!("{ratios:?} do not come back onto the contour");
    };
    let least = held(&best.speed_ratios);
    assert!((least / best.energy_per_metre - 1.0).abs() < 1e-4, "{least}");
    for (front, diagonal) in
        [(0.02, 0.0), (-0.02, 0.0), (0.0, 0.02), (0.0, -0.02), (0.01, 0.01), (-0.01, 0.01)]
    {
        let beside = best.speed_ratios.iter().zip(base.rover.mounts()).map(|(ratio, mount)| {
            let (x, y) = (mount.position.x.signum(), mount.position.y.signum());
            ratio * (1.0 + front * x + diagonal * x * y)
        });
        let energy = held(&beside.collect::<Vec<_>>());
        assert!(energy > least, "{energy} and {least} J/m");
    }
}
