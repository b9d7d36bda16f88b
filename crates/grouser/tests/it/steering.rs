//! Wheels that are steered about their kingpins.

use grouser::document::{Kind, Overrides, Source, read_mission, read_rover};
use grouser::mission::{
    Heading, Leg, Manoeuvre, Mission, MissionReport, MissionRun, Steering as ArcSteering,
};
use grouser::simulation::{
    Approach, CONTROL_PERIOD, Controller, Numerics, Observation, PrescribedYaw, Run, Scenario,
};
use grouser::studies::heading::{HeadingCurve, HeadingStudy, Steering};
use grouser::units::{Vec2, deg};
use grouser::vehicle::kinematics::{rolling_angle, wheel_velocity};
use grouser::vehicle::parts::USUAL_STEERING_RATE;
use grouser::vehicle::{DriveLaw, LoadSharing, Mount, OwnMoments, Rover, RoverState, SteeringAxis};

use super::given::{complete_traverse, hakuto, run, traverse};
use super::mounts::{changed, firm, motley};

/// How each wheel of the rovers of these tests is steered.
const AXIS: SteeringAxis =
    SteeringAxis { limit: 0.8, rate: USUAL_STEERING_RATE, kingpin_offset: Vec2::new(0.0, 0.0) };

/// The source's rover, had it wheels that can be steered.
pub(super) fn steerable() -> Rover {
    changed(|_, mount| mount.steering_axis = Some(AXIS))
}

/// With kingpins beside its hubs, on the inner side.
fn with_kingpins() -> Rover {
    changed(|_, mount| {
        let kingpin_offset = Vec2::new(0.01, -0.05 * mount.position.y.signum());
        mount.steering_axis = Some(SteeringAxis { kingpin_offset, ..AXIS });
    })
}

#[test]
fn steering_angles_of_zero_change_no_bit() {
    let on_slope = |rover: Rover| run(&Scenario { rover, ..traverse(deg(10.0), deg(5.0)) });
    let fixed = on_slope(hakuto());
    for rover in [steerable(), with_kingpins()] {
        assert_eq!(on_slope(rover.clone()), fixed);
        let there_and_back = rover.steered(&[0.3; 4]).and_then(|rover| rover.steered(&[0.0; 4]));
        assert_eq!(on_slope(there_and_back.expect("angles within limits")), fixed);
    }
}

/// Closed form: a hub goes round its kingpin, at the distance of the offset, and takes its mass
/// with it.
#[test]
fn a_hub_moves_about_its_kingpin_and_its_mass_follows() {
    let rover = with_kingpins();
    let angles = [0.3, -0.2, 0.1, 0.8];
    let steered = rover.steered(&angles).expect("angles within limits");
    let mut moment = Vec2::zeros();
    for ((before, after), angle) in rover.mounts().iter().zip(steered.mounts()).zip(angles) {
        let offset = before.steering_axis.expect("it is steered").kingpin_offset;
        let kingpin = before.position.xy() + offset;
        let (sin, cos) = f64::sin_cos(angle);
        let turned = Vec2::new(cos * offset.x - sin * offset.y, sin * offset.x + cos * offset.y);
        assert!((after.position.xy() - (kingpin - turned)).norm() < 1e-15);
        assert!((after.position.xy() - before.position.xy()).norm() > 0.004);
        assert_eq!(after.position.z, before.position.z);
        moment += after.unit.mass * after.position.xy();
    }
    assert!((steered.first_moment() - moment).norm() < 1e-12);
    assert!((steered.mass() - rover.mass()).abs() < 1e-12);
    assert_eq!(steered.steering_angles(), angles);
    // Made from its wheels as they are, or seen in a mirror twice, it is the same rover.
    let again = Rover::new(*steered.body(), steered.mounts().to_vec()).expect("a rover");
    let back = again.steered(&[0.0; 4]).expect("angles within limits");
    for (one, other) in back.mounts().iter().zip(rover.mounts()) {
        assert!((one.position - other.position).norm() < 1e-15);
    }
    let mirrored = rover.mirrored().steered(&angles.map(|angle| -angle)).expect("as before");
    for (one, other) in mirrored.mirrored().mounts().iter().zip(steered.mounts()) {
        assert!((one.position - other.position).norm() < 1e-15);
        assert_eq!(one.steering, other.steering);
    }
}

#[test]
fn angles_that_wheels_cannot_have_are_refused() {
    let message = |rover: &Rover, angles: &[f64]| {
        rover.steered(angles).expect_err("no rover has these angles").to_string()
    };
    let rover = steerable();
    let beyond = message(&rover, &[0.0, deg(-50.0), 0.0, 0.0]);
    for part in ["wheel 2", "-0.87", "0.800"] {
        assert!(beyond.contains(part), "{beyond}");
    }
    assert!(message(&rover, &[0.0; 3]).contains("one for each wheel"));
    assert!(message(&rover, &[f64::NAN, 0.0, 0.0, 0.0]).contains("finite"));
    let fixed = message(&hakuto(), &[0.0, 0.0, 0.1, 0.0]);
    assert!(fixed.contains("wheel 3") && fixed.contains("steering_limit_deg"), "{fixed}");
    assert!(!hakuto().is_steerable() && rover.is_steerable());
}

#[test]
fn documents_say_how_wheels_are_steered() {
    let read = |name: &str, settings: &[&str]| {
        let overrides = Overrides::parse(settings).expect("settings");
        read_rover(&Source::find(Kind::Rover, name).expect("a preset"), &overrides)
    };
    let spirit = read("spirit", &[]).expect("a preset");
    let axes = spirit.value.mounts().iter().map(|mount| mount.steering_axis);
    let limits: Vec<f64> =
        axes.map(|axis| axis.map_or(0.0, |axis| axis.limit.to_degrees().round())).collect();
    assert_eq!(limits, [60.0, 0.0, 60.0, 60.0, 0.0, 60.0]);

    let set = ["rover.mount.0.steering_rate_deg_s=4", "rover.mount.0.kingpin_offset_m=[0.0,-0.1]"];
    let rover = read("spirit", &set).expect("settings of a wheel").value;
    let axis = rover.mounts()[0].steering_axis.expect("it is steered");
    assert!((axis.rate - deg(4.0)).abs() < 1e-15);
    assert_eq!(axis.kingpin_offset, Vec2::new(0.0, -0.1));
    let other = rover.mounts()[2].steering_axis.expect("it is steered");
    assert_eq!(other.rate, USUAL_STEERING_RATE);

    let message = |setting: &str| read("spirit", &[setting]).expect_err("no rover").to_string();
    let beyond = message("rover.mount.0.steering_deg=61");
    assert!(beyond.contains("front-left") && beyond.contains("60°"), "{beyond}");
    let unsteered = message("rover.mount.1.kingpin_offset_m=[0.0,0.1]");
    assert!(unsteered.contains("kingpin offset of `middle-left`"), "{unsteered}");
}

/// The order of the wheels is a matter of writing: results come in that order, and are the same to
/// rounding.
#[test]
fn permuting_mounts_permutes_results() {
    let order = [2, 0, 3, 1];
    let rims = [0.05, 0.06, 0.07, 0.04];
    let permuted = |rover: &Rover| {
        let mounts: Vec<Mount> = order.map(|place| rover.mounts()[place].clone()).to_vec();
        Rover::new(*rover.body(), mounts).expect("the same rover")
    };
    let on_slope = |rover: Rover, rims: [f64; 4]| {
        let drive = DriveLaw::ConstantEach(rims.to_vec());
        run(&Scenario { rover, drive, duration: 3.0, ..traverse(deg(10.0), deg(5.0)) })
    };
    let one = on_slope(motley(), rims);
    let other = on_slope(permuted(&motley()), order.map(|place| rims[place]));
    let (here, there) = (one.last(), other.last());
    assert!((here.state.position - there.state.position).norm() < 1e-7);
    assert!((here.state.yaw - there.state.yaw).abs() < 1e-7);
    for (place, wheel) in order.iter().zip(&there.wheels) {
        let same = &here.wheels[*place];
        assert!((same.wheel_speed - wheel.wheel_speed).abs() < 1e-15);
        let (one, other) = (same.reaction, wheel.reaction);
        assert!((one.load / other.load - 1.0).abs() < 1e-6);
        let [torque, there] = [one, other].map(|wheel| wheel.settled.forces.torque);
        assert!((torque / there - 1.0).abs() < 1e-6);
    }
}

fn study(rover: Rover, sharing: LoadSharing, own_moments: OwnMoments) -> HeadingStudy {
    let scenario = Scenario { rover, sharing, own_moments, ..traverse(0.0, 0.0) };
    HeadingStudy::of(&scenario)
}

fn crab(study: &HeadingStudy) -> HeadingCurve {
    let study = HeadingStudy { steering: Steering::Crab, ..study.clone() };
    study.curve().expect("a study")
}

/// A body that is turned, with its wheels steered back, moves as before, but for the load transfer:
/// with loads alike, the wheels' crab angle is the body's heading offset, on every slope up to the
/// same limit.
#[test]
fn with_loads_alike_wheels_crab_by_the_angle_that_the_nose_would_be_turned_by() {
    for own_moments in [OwnMoments::Neglected, OwnMoments::Included] {
        let study = study(steerable(), LoadSharing::Uniform, own_moments);
        let (yaw, crab) = (study.curve().expect("a study"), crab(&study));
        let [nose, wheels] = [&yaw, &crab].map(|curve| curve.limit().expect("it moves").0);
        assert!((nose - wheels).abs() < 1e-7, "{nose} and {wheels}");
        for slope in [3.0, 10.0, 17.0].map(deg) {
            let (nose, wheels) = (yaw.at(slope).expect("held"), crab.at(slope).expect("held"));
            let angle = wheels.steering.expect("wheels are steered");
            assert!((nose.yaw - angle).abs() < 1e-8 && wheels.yaw == 0.0);
            assert!((nose.slip_ratio - wheels.slip_ratio).abs() < 1e-8);
            assert!((nose.torque() / wheels.torque() - 1.0).abs() < 1e-8);
            let rover = steerable();
            let [one, other] = [&nose, &wheels].map(|it| it.energy_per_metre(&rover));
            assert!((one / other - 1.0).abs() < 1e-8, "{one} and {other} J/m");
        }
    }
}

/// What holds the contour in the study holds it in the equations of motion: along and across the
/// contour nothing is left over of the forces of a rover whose wheels have the crab angle, and its
/// yaw moment is the one reported.
#[test]
fn a_crab_angle_balances_the_forces_along_and_across_the_contour() {
    for rover in [steerable(), with_kingpins(), six_wheels()] {
        let study = study(rover.clone(), LoadSharing::Complete, OwnMoments::Included);
        let found = crab(&study).at(deg(10.0)).expect("it holds the contour");
        let angle = found.steering.expect("wheels are steered");
        let angles = rover.mounts().iter().map(|mount| mount.steering_axis.map_or(0.0, |_| angle));
        let steered = rover.steered(&angles.collect::<Vec<_>>()).expect("within limits");
        let (mut force, mut moment) = (Vec2::zeros(), 0.0);
        for (mount, wheel) in steered.mounts().iter().zip(&found.wheels) {
            let forces = wheel.settled.forces;
            let own = mount.body_from_wheel(Vec2::new(forces.drawbar_pull, forces.side_force));
            let arm = mount.position.xy() - steered.centre_of_mass();
            force += own;
            moment += arm.perp(&own) + forces.aligning_moment;
        }
        let weight = rover.mass() * study.gravity;
        let needed = Vec2::new(0.0, weight * f64::sin(deg(10.0)));
        assert!((force - needed).norm() < 1e-8 * weight, "{force}");
        assert!((moment - found.yaw_moment).abs() < 1e-9 * weight);
        // All rims turn at one speed: v cos(angle)/(1 − s) is the same for each wheel.
        let rim = |place: usize| {
            let mount = &steered.mounts()[place];
            f64::cos(mount.steering) / (1.0 - found.wheels[place].slip.ratio)
        };
        assert!((0..rover.wheel_count()).all(|place| (rim(place) / rim(0) - 1.0).abs() < 1e-9));
    }
}

/// A six-wheel rover whose wheels at the corners are steered.
fn six_wheels() -> Rover {
    let rover = super::examples::own_rover::six_wheels(0.0).expect("a rover");
    let mut mounts = rover.mounts().to_vec();
    for mount in mounts.iter_mut().filter(|mount| mount.position.x.abs() > 0.1) {
        mount.steering_axis = Some(AXIS);
    }
    Rover::new(*rover.body(), mounts).expect("the same rover")
}

#[test]
fn a_curve_of_crab_angles_ends_where_wheels_turn_no_further() {
    let limit = deg(6.0);
    let rover = changed(|_, mount| {
        mount.steering_axis = Some(SteeringAxis { limit, ..AXIS });
    });
    let study = study(rover, LoadSharing::QuasiStatic, OwnMoments::Neglected);
    let curve = crab(&study);
    let (steepest, reason) = curve.limit().expect("it moves");
    assert!(reason.contains("steered any further"), "{reason}");
    let last = curve.at(steepest).expect("it holds the contour");
    assert!((last.steering.expect("wheels are steered") - limit).abs() < 1e-8);
    assert!(curve.at(steepest + deg(0.1)).is_err());

    let fixed = HeadingStudy { steering: Steering::Crab, rover: hakuto(), ..study };
    let message = fixed.curve().expect_err("no wheel is steered").to_string();
    assert!(message.contains("steering_limit_deg"), "{message}");
}

/// A rover that is driven by legs, with the complete loads.
fn mission(rover: Rover, slope: f64, legs: Vec<Leg>) -> Mission {
    let scenario = Scenario { rover, ..complete_traverse(slope, 0.0) };
    Mission { scenario, legs, stops: Vec::new(), sensors: None }
}

fn driven(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("a mission").to_end().expect("it can be computed")
}

fn crabbing(way: f64, angle: f64) -> Leg {
    Leg { heading: Heading::Crab { angle }, ..Leg::new(Manoeuvre::drive(way)) }
}

/// Largest distance from the contour through the start, after a way along it [m].
fn off_contour(report: &MissionReport, after: f64) -> f64 {
    let records = report.trajectory.records.iter();
    let later = records.filter(|record| record.state.position.x > after);
    later.map(|record| record.state.position.y.abs()).fold(0.0, f64::max)
}

#[test]
fn legs_that_do_not_steer_change_no_bit() {
    let legs = || {
        vec![
            Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(0.5)) },
            Leg::new(Manoeuvre::Turn { angle: deg(20.0) }),
            Leg::new(Manoeuvre::Arc { radius: 1.0, angle: deg(10.0), reverse: false }),
        ]
    };
    let fixed = driven(&mission(hakuto(), 8.0, legs()));
    let steered = driven(&mission(with_kingpins(), 8.0, legs()));
    assert_eq!(fixed.trajectory.records, steered.trajectory.records);
}

/// The angle of the study holds the contour from the start; without it, the rover learns it on the
/// way.
#[test]
fn a_crab_leg_stays_on_the_contour() {
    for rover in [steerable(), six_wheels(), with_kingpins()] {
        let study = study(rover.clone(), LoadSharing::Complete, OwnMoments::Included);
        let angle = crab(&study).at(deg(10.0)).expect("held").steering.expect("steered");
        let told = driven(&mission(rover.clone(), 10.0, vec![crabbing(4.0, angle)]));
        let untold = driven(&mission(rover.clone(), 10.0, vec![crabbing(8.0, 0.0)]));
        let off = [off_contour(&told, 0.0), off_contour(&untold, 0.0), off_contour(&untold, 7.5)];
        assert!(off[0] < 0.003 && off[1] < 0.05 && off[2] < 0.003, "{off:?}");
        for report in [&told, &untold] {
            let end = report.last();
            assert!(end.state.yaw.abs() < deg(0.5), "{}°", end.state.yaw.to_degrees());
            assert!((end.wheels[0].steering - angle).abs() < deg(1.0));
            let (error, energy) = (report.trajectory.energy_error(), report.energy());
            assert!(error.abs() < 1e-4 * energy, "{error} of {energy} J");
        }
    }
}

#[test]
fn wheels_turn_no_faster_and_no_further_than_they_can() {
    let (limit, rate) = (deg(4.0), deg(2.0));
    let slow = changed(|place, mount| {
        let limit = if place == 1 { deg(3.0) } else { limit };
        mount.steering_axis = Some(SteeringAxis { limit, rate, ..AXIS });
    });
    let legs = vec![crabbing(2.0, 0.0), Leg::new(Manoeuvre::drive(0.5))];
    let report = driven(&mission(slow.clone(), 12.0, legs));
    let records = &report.trajectory.records;
    for pair in records.windows(2) {
        // What wheels turn between two looks, they turn at the second.
        let span = pair[1].time - pair[0].time + CONTROL_PERIOD;
        for (before, after) in pair[0].wheels.iter().zip(&pair[1].wheels) {
            let turned = (after.steering - before.steering).abs();
            assert!(turned <= rate * span + 1e-9, "{turned} in {span} s");
        }
    }
    let most = |wheel: usize| {
        records.iter().map(|record| record.wheels[wheel].steering).fold(0.0, f64::max)
    };
    assert!((most(0) - limit).abs() < 1e-12 && (most(1) - deg(3.0)).abs() < 1e-12);
    assert!(report.last().wheels.iter().all(|wheel| wheel.steering == 0.0), "straight again");

    let refused = |leg: Leg| {
        let error = MissionRun::new(&mission(slow.clone(), 0.0, vec![leg])).map(|_| ());
        error.expect_err("it cannot be driven").to_string()
    };
    let message = refused(crabbing(1.0, deg(5.0)));
    assert!(message.contains("leg 1: steering angle of wheel wheel 1"), "{message}");
    let arc = Leg::new(Manoeuvre::Arc { radius: 1.0, angle: 1.0, reverse: false });
    let message = refused(Leg { steering: ArcSteering::Ackermann, ..arc.clone() });
    assert!(message.contains("steering angle of wheel"), "{message}");
    let fixed = mission(hakuto(), 0.0, vec![Leg { steering: ArcSteering::Ackermann, ..arc }]);
    assert!(MissionRun::new(&fixed).is_err());
}

/// Closed form: the axle of every wheel points to the centre of the circle, and its rim is as fast
/// as its distance from there.
#[test]
fn axles_of_an_arc_point_to_its_centre() {
    for rover in [steerable(), with_kingpins(), six_wheels()] {
        for (forward, rate) in [(0.06, 0.04), (0.06, -0.03), (-0.06, 0.05), (-0.05, -0.02)] {
            let centre = Vec2::new(0.0, forward / rate);
            let state = RoverState {
                velocity: Vec2::new(forward, 0.0),
                yaw_rate: rate,
                ..RoverState::default()
            };
            for mount in rover.mounts().iter().filter(|mount| mount.steering_axis.is_some()) {
                // From any angle that the wheel may have before.
                for before in [0.0, 0.3] {
                    let angle = rolling_angle(&state, &mount.at_angle(before));
                    let steered = mount.at_angle(angle);
                    let arm = centre - steered.position.xy();
                    let along = steered.wheel_from_body(arm);
                    assert!(along.x.abs() < 1e-12, "{forward} {rate}: {along}");
                    let velocity = wheel_velocity(&state, &steered);
                    assert!((velocity.x.abs() - rate.abs() * arm.norm()).abs() < 1e-12);
                    assert!(velocity.y.abs() < 1e-12 && velocity.x * forward > 0.0);
                }
            }
        }
    }
}

/// On firm ground wheels that are steered round an arc roll: it is the circle, its slip that of a
/// straight way, and it takes less work than an arc by the sides.
#[test]
fn a_steered_arc_is_its_circle() {
    let (radius, angle) = (1.2, deg(60.0));
    for (reverse, side) in [(false, 1.0), (false, -1.0), (true, 1.0)] {
        let manoeuvre = Manoeuvre::Arc { radius, angle: side * angle, reverse };
        let report = |rover: Rover, steering: ArcSteering| {
            let leg = Leg { steering, ..Leg::new(manoeuvre) };
            let mut mission = mission(rover, 0.0, vec![leg]);
            mission.scenario.ground.soil = firm();
            driven(&mission)
        };
        for rover in [steerable(), with_kingpins(), six_wheels()] {
            let steered = report(rover.clone(), ArcSteering::Ackermann);
            let end = steered.last();
            assert!((end.state.yaw - side * angle).abs() < deg(2.0), "{}", end.state.yaw);
            let centre = Vec2::new(0.0, if reverse { -side * radius } else { side * radius });
            let records = steered.trajectory.records.iter();
            let off = records.map(|it| ((it.state.position - centre).norm() - radius).abs());
            let off = off.fold(0.0, f64::max);
            let by_sides = report(rover, ArcSteering::Sides);
            assert!(off < 0.01, "{off} m off the circle");
            for wheel in &end.wheels {
                let slip = wheel.reaction.slip;
                assert!(slip.angle.abs() < deg(2.0), "{slip:?}");
            }
            assert!(2.0 * steered.energy() < by_sides.energy());
        }
    }
}

/// A controller of one's own steers, and a state goes on as it was.
#[test]
fn a_run_goes_on_from_a_state_with_steered_wheels() {
    struct Slalom;
    impl Controller for Slalom {
        fn command(&mut self, _: &Observation<'_>, rim_speeds: &mut [f64]) {
            rim_speeds.fill(0.06);
        }

        fn steer(&mut self, seen: &Observation<'_>, angles: &mut [f64]) {
            let side = if seen.time() % 4.0 < 2.0 { 1.0 } else { -1.0 };
            angles.fill(side * 0.2);
        }
    }
    let scenario = Scenario { rover: with_kingpins(), ..traverse(deg(8.0), 0.0) };
    let mut one = Run::with_controller(&scenario, &mut Slalom).expect("a run");
    one.advance(&mut Slalom, 3.0).expect("it goes on");
    let mut other = Run::resume(&scenario, one.state().clone());
    for run in [&mut one, &mut other] {
        run.advance(&mut Slalom, 6.0).expect("it goes on");
    }
    assert_eq!(one.now(), other.now());
    assert_ne!(one.now().wheels[0].steering, 0.0);
    let end = one.finish();
    assert!(end.energy_error().abs() < 1e-5 * end.last().energy.motors, "{} J", end.energy_error());

    struct TooFar;
    impl Controller for TooFar {
        fn command(&mut self, _: &Observation<'_>, _: &mut [f64]) {}

        fn steer(&mut self, _: &Observation<'_>, angles: &mut [f64]) {
            angles[2] = 1.0;
        }
    }
    let mut run = Run::with_controller(&scenario, &mut TooFar).expect("a run");
    let error = run.advance(&mut TooFar, 1.0).expect_err("beyond the limit").to_string();
    assert!(error.contains("wheel 3") && error.contains("0.800"), "{error}");
}

/// To a place beside its nose a crabbing rover goes without turning it.
#[test]
fn wheels_point_to_a_place_beside_the_nose() {
    for (place, reverse) in [((1.2, 0.8), false), ((1.0, -0.7), false), ((-1.0, 0.6), true)] {
        let place = Vec2::new(place.0, place.1);
        let manoeuvre = Manoeuvre::Goto { place, within: 0.02, reverse };
        let leg = Leg { heading: Heading::Crab { angle: 0.0 }, ..Leg::new(manoeuvre) };
        let mut mission = mission(steerable(), 0.0, vec![leg]);
        mission.scenario.ground.soil = firm();
        let end = driven(&mission);
        assert_eq!(end.legs.len(), 1);
        let last = end.last();
        assert!((last.state.position - place).norm() < 0.021, "{}", last.state.position);
        assert!(last.state.yaw.abs() < deg(1.0), "{}", last.state.yaw);
        let direction = (place.y / place.x).atan();
        assert!((last.wheels[0].steering - direction).abs() < deg(3.0));
    }
}

/// A body that is turned by 90°, with its wheels steered back by as much, moves as before where
/// loads are alike: over time, along the same way, with the same work.
#[test]
fn a_body_turned_by_90_degrees_with_its_wheels_steered_back_moves_as_before() {
    let quarter = deg(90.0);
    let axis = SteeringAxis { limit: quarter, ..AXIS };
    let rover = changed(|_, mount| mount.steering_axis = Some(axis));
    let across = rover.steered(&[-quarter; 4]).expect("a quarter turn");
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let end = |rover: &Rover, yaw: f64| {
            let base = traverse(deg(10.0), yaw);
            let scenario = Scenario {
                rover: rover.clone(),
                sharing: LoadSharing::Uniform,
                // Its yaw moment, which the places of its wheels decide, is held.
                yaw: Some(PrescribedYaw { points: vec![(0.0, yaw), (5.0, yaw)] }),
                numerics: Numerics { approach, ..base.numerics },
                duration: 5.0,
                ..base
            };
            run(&scenario)
        };
        let (along, across) = (end(&rover, deg(4.0)), end(&across, deg(4.0) + quarter));
        let (one, other) = (along.last(), across.last());
        assert!((one.state.position - other.state.position).norm() < 1e-8);
        assert!((one.energy.motors / other.energy.motors - 1.0).abs() < 1e-7);
        for (one, other) in one.wheels.iter().zip(&other.wheels) {
            let [one, other] = [one, other].map(|wheel| wheel.reaction.slip);
            assert!((one.ratio - other.ratio).abs() < 1e-7, "{one:?} {other:?}");
            assert!((one.angle - other.angle).abs() < 1e-7, "{one:?} {other:?}");
        }
    }
}

#[test]
fn documents_of_missions_steer() {
    let read = |legs: &str| {
        let text = format!(
            "schema = \"mission/1\"\nrover = \"hakuto-steered\"\nsoil = \"toyoura\"\nslope_deg = 5\n{legs}"
        );
        read_mission(&Source::text("a mission", text), &Overrides::none())
    };
    let legs = "[[leg]]\ndrive_m = 1\nheading = \"crab\"\ncrab_deg = 4\n\
        [[leg]]\ngoto = { x_m = 1, y_m = 1 }\nheading = \"crab\"\n\
        [[leg]]\narc = { radius_m = 2, angle_deg = 30 }\nsteering = \"ackermann\"\n";
    let loaded = read(legs).expect("a mission");
    let [drive, goto, arc] = &loaded.value.mission().legs[..] else { panic!("three legs") };
    assert_eq!(drive.heading, Heading::Crab { angle: deg(4.0) });
    assert_eq!(goto.heading, Heading::Crab { angle: 0.0 });
    assert_eq!(arc.steering, ArcSteering::Ackermann);
    let again = read_mission(&Source::text("again", loaded.to_toml()), &Overrides::none());
    assert_eq!(again.expect("it was written").value, loaded.value);

    for (leg, part) in [
        ("drive_m = 1\ncrab_deg = 4", "not the heading \"crab\""),
        ("drive_m = 1\nsteering = \"ackermann\"", "goes with `arc` only"),
        ("turn_deg = 1\nheading = \"crab\"", "goes with `drive_m` only"),
        ("drive_m = 1\nheading = \"crab\"\ncrab_deg = 61", "`front-left` turns up to 60°"),
        ("arc = { radius_m = 0.2, angle_deg = 9 }\nsteering = \"ackermann\"", "steering angle of"),
    ] {
        let message = read(&format!("[[leg]]\n{leg}\n")).expect_err("no leg").to_string();
        assert!(message.contains(part), "{message}");
    }
    let fixed = format!(
        "schema = \"mission/1\"\nrover = \"hakuto\"\nsoil = \"toyoura\"\nslope_deg = 5\n{legs}"
    );
    let message = read_mission(&Source::text("fixed", fixed), &Overrides::none());
    let message = message.expect_err("no wheel is steered").to_string();
    assert!(message.contains("steering_limit_deg"), "{message}");
}
