//! Runs over uneven ground: a tilted plane is the plane, both ways of computing agree, and energy
//! is kept.

use grouser_core::paper;
use grouser_core::simulation::{
    Approach, Method, Outcome, PrescribedYaw, Record, Run, Scenario, Trajectory,
};
use grouser_core::terrain::surface::{Cone, Incline, Ripple, Surface};
use grouser_core::terrain::{ElevationGrid, ElevationModel, Ground};
use grouser_core::units::{Vec2, deg};
use grouser_core::vehicle::{Rover, Ruts, Suspension};

/// The scenario on ground with heights in place of its plane.
fn over(scenario: &Scenario, ground: Ground, start: Vec2) -> Scenario {
    Scenario { ground: ground.starting_at(start), ..scenario.clone() }
}

fn surface(scenario: &Scenario, surface: Surface) -> Ground {
    Ground::formula(scenario.ground.soil, surface)
}

/// A map of a plane, far from the origin of its coordinates.
fn map(scenario: &Scenario, incline: Incline, middle: Vec2) -> Ground {
    let south_west = middle - Vec2::new(10.0, 10.0);
    let grid = ElevationGrid { columns: 41, rows: 41, south_west, spacing: Vec2::new(0.5, 0.5) };
    let heights: Vec<f64> =
        grid.points().map(|at| -1800.0 + Surface::Incline(incline).height(at - middle)).collect();
    let model = ElevationModel::new(grid, heights).expect("a map");
    Ground::map(scenario.ground.soil, model)
}

fn on_rockers(rover: &Rover) -> Rover {
    let suspension = Suspension { pivot: Vec2::new(0.01, 0.03), bogie: None };
    rover.on_rockers(suspension).expect("it has four wheels")
}

fn run(scenario: &Scenario) -> Trajectory {
    let run = Run::new(scenario).and_then(Run::to_end).expect("it drives");
    if scenario.numerics.approach == Approach::QuasiSteady {
        assert_eq!(run.method, Method::QuasiSteady);
    }
    run
}

/// Every kind of rover, both ways of computing.
fn scenarios() -> Vec<Scenario> {
    let mut base = paper::traverse().expect("it stands");
    base.start.yaw = deg(8.0);
    let mut all = Vec::new();
    for rover in [base.rover.clone(), on_rockers(&base.rover)] {
        for approach in [Approach::Dynamic, Approach::QuasiSteady] {
            let mut scenario = Scenario { rover: rover.clone(), ..base.clone() };
            scenario.numerics.approach = approach;
            all.push(scenario);
        }
    }
    all
}

/// A plane by any description gives the plane's way, yaw and work, wherever it is and rises.
#[test]
fn a_tilted_plane_is_the_plane() {
    for plane in scenarios() {
        let on_plane = run(&plane);
        let one = on_plane.last();
        let slope = plane.ground.plane_slope().expect("a plane");
        for (azimuth, is_map) in [(90.0, false), (217.0, false), (-25.0, true)] {
            let uphill = deg(azimuth);
            let incline = Incline { slope, uphill };
            let is_rigid = plane.rover.suspension().is_none();
            if is_map && is_rigid && plane.numerics.approach == Approach::Dynamic {
                // The rounding of heights warps the ground, which takes a rigid rover minutes.
                continue;
            }
            let (ground, start) = if is_map {
                let middle = Vec2::new(512_345.0, -2_100_020.0);
                (map(&plane, incline, middle), middle)
            } else {
                (surface(&plane, Surface::Incline(incline)), Vec2::zeros())
            };
            // Yaw from the contour, along the plane, as it is seen from above.
            let seen = |yaw: f64| (yaw.sin() * slope.cos()).atan2(yaw.cos()) + uphill - deg(90.0);
            let mut scenario = over(&plane, ground, start);
            scenario.start.yaw = seen(plane.start.yaw);
            let on_relief = run(&scenario);
            let other = on_relief.last();

            // Along the contour, and up the plane.
            let (sin, cos) = (uphill - deg(90.0)).sin_cos();
            let way = other.state.position;
            let way =
                Vec2::new(cos * way.x + sin * way.y, (cos * way.y - sin * way.x) / slope.cos());
            let off = (way - one.state.position).norm() / one.state.position.norm();
            assert!(off < 2e-5, "{azimuth}° {:?}: {off:e} off", plane.numerics.approach);
            assert!((seen(one.state.yaw) - other.state.yaw).abs() < deg(2e-3));
            assert!((one.energy.motors / other.energy.motors - 1.0).abs() < 1e-4);
            let rise =
                |first: &Record, last: &Record| last.energy.potential - first.energy.potential;
            let (climbed, rose) =
                (rise(&on_plane.records[0], one), rise(&on_relief.records[0], other));
            assert!((climbed - rose).abs() < 1e-3 * one.energy.motors, "{climbed} and {rose}");
        }
    }
}

/// Wheels that follow in ruts meet soil as compacted on ground with heights as on the plane,
/// uphill, where all of them do, and across, where the rover's yaw decides how much of a wheel is
/// in the rut.
#[test]
fn ruts_on_a_tilted_plane_are_those_of_the_plane() {
    for mut plane in scenarios() {
        plane.duration = 10.0;
        for (yaw, is_all) in [(deg(90.0), true), (deg(4.0), false)] {
            plane.start.yaw = yaw;
            let slope = plane.ground.plane_slope().expect("a plane");
            let end = |ruts: Ruts| {
                let plane = Scenario { ruts, ..plane.clone() };
                let incline = Incline { slope, uphill: deg(90.0) };
                let ground = surface(&plane, Surface::Incline(incline));
                let mut over = over(&plane, ground, Vec2::zeros());
                over.start.yaw = (yaw.sin() * slope.cos()).atan2(yaw.cos());
                let place = run(&over).last().state.position;
                let on_plane = run(&plane).last().state.position;
                (on_plane, Vec2::new(place.x, place.y / slope.cos()))
            };
            let [(fresh, _), (rutted, over)] = [Ruts::Fresh, Ruts::Compacted].map(end);
            let by_ruts = (rutted - fresh).norm();
            assert!(by_ruts > if is_all { 5e-3 } else { 5e-4 }, "{by_ruts}");
            let off = (over - rutted).norm();
            assert!(off < 0.01 * by_ruts, "{off:e} m off, ruts move by {by_ruts:e} m");
        }
    }
}

/// On a wide cone a rover drives as on the plane that touches it, the nearer the wider it is.
#[test]
fn a_wide_cone_is_nearly_a_plane() {
    let plane = &scenarios()[1];
    let one = run(plane).last().state.position;
    let slope = plane.ground.plane_slope().expect("a plane");
    let off = |radius: f64| {
        let cone = Cone { tip: Vec2::new(0.0, radius), slope, rounding: 1.0 };
        let mut scenario = over(plane, surface(plane, Surface::Cone(cone)), Vec2::zeros());
        scenario.start.yaw = (plane.start.yaw.sin() * slope.cos()).atan2(plane.start.yaw.cos());
        let way = run(&scenario).last().state.position;
        (Vec2::new(way.x, way.y / slope.cos()) - one).norm()
    };
    let [near, far] = [off(100.0), off(400.0)];
    assert!(near < 0.02 && far < 0.3 * near, "{near} m and {far} m off");
}

fn ripple(plane: &Scenario, rover: &Rover) -> Scenario {
    let waves = Ripple { amplitude: 0.06, wavelength: 1.1, across: deg(30.0), phase: 0.4 };
    let mut scenario = over(plane, surface(plane, Surface::Ripple(waves)), Vec2::zeros());
    scenario.rover = rover.clone();
    scenario.duration = 40.0;
    scenario
}

/// Over ripples quasi-steady and dynamic runs lead to the same place, and motors' work is the
/// soil's and the height's.
///
/// * `lost`: the share of the motors' work that neither has
fn check_ripples(rover: &Rover, lost: f64) {
    let base = &scenarios()[0];
    let dynamic = run(&ripple(base, rover));
    let mut steady = ripple(base, rover);
    steady.numerics.approach = Approach::QuasiSteady;
    let steady = run(&steady);
    assert!(steady.work.evaluations * 5 < dynamic.work.evaluations);
    let (one, other) = (dynamic.last().state, steady.last().state);
    let off = (one.position - other.position).norm();
    assert!(one.position.norm() > 1.0 && off < 2e-3 * one.position.norm(), "{off:e} m off");
    assert!((one.yaw - other.yaw).abs() < deg(0.2), "{one:?} and {other:?}");
    for trajectory in [&dynamic, &steady] {
        let (first, last) = (trajectory.records[0].energy, trajectory.last().energy);
        let kept = last.soil + last.potential - first.potential + last.kinetic - first.kinetic;
        assert!((last.motors - kept).abs() < lost * last.motors, "{} and {kept}", last.motors);
        let pitches = trajectory.records.iter().filter_map(|record| record.attitude);
        let steepest = pitches.map(|it| it.pitch.abs()).fold(0.0, f64::max);
        assert!(steepest > deg(10.0), "{steepest}");
    }
}

/// On rockers no normal force does work.
#[test]
fn over_ripples_on_rockers_both_ways_agree_and_energy_is_kept() {
    check_ripples(&on_rockers(&scenarios()[0].rover), 5e-3);
}

/// The wheels of a rigid rover on warped ground sink and rise as it goes, by which normal forces do
/// work on the soil.
#[test]
fn over_ripples_rigidly_both_ways_agree_and_energy_is_kept() {
    check_ripples(&scenarios()[0].rover, 5e-3);
}

/// On a map a drive ends where that does, with what it drove so far; it does not start there.
#[test]
fn a_drive_that_leaves_the_map_says_where() {
    let plane = &scenarios()[1];
    let incline = Incline { slope: deg(3.0), uphill: deg(90.0) };
    let middle = Vec2::new(2000.0, -500.0);
    let start = middle + Vec2::new(9.3, 0.0);
    let mut scenario = over(plane, map(plane, incline, middle), start);
    scenario.start.yaw = 0.0;
    let drive = |scenario: &Scenario| Run::new(scenario).and_then(Run::to_end);
    let driven = drive(&scenario).expect("it drives as far as the map goes");
    let Outcome::OffTheMap { time, place, .. } = &driven.outcome else {
        panic!("{:?}", driven.outcome);
    };
    assert!(*time > 1.0 && driven.last().time <= *time, "{time}");
    assert!(place.x > start.x && (place.x - driven.last().place().x).abs() < 0.5, "{place}");
    scenario.ground.start = middle + Vec2::new(40.0, 0.0);
    let error = drive(&scenario).expect_err("no map is there").to_string();
    assert!(error.contains("where the map has no heights"), "{error}");
}

/// A yaw that is held over time is exactly that on a tilted plane and over ripples; on the plane's
/// contour the way is the plane's, and both ways of computing lead to the same place.
#[test]
fn a_yaw_is_held_over_time_on_any_ground() {
    let base = &scenarios()[0];
    let slope = base.ground.plane_slope().expect("a plane");
    let held = |points: Vec<(f64, f64)>| Some(PrescribedYaw { points });
    let mut plane = Scenario { yaw: held(vec![(0.0, 0.0)]), ..base.clone() };
    plane.start.yaw = 0.0;
    let incline = Incline { slope, uphill: deg(90.0) };
    let tilted = over(&plane, surface(&plane, Surface::Incline(incline)), Vec2::zeros());
    let [one, other] = [&plane, &tilted].map(|scenario| run(scenario).last().state);
    let seen = Vec2::new(one.position.x, one.position.y * slope.cos());
    assert!((seen - other.position).norm() < 2e-5 * one.position.norm(), "{one:?} {other:?}");
    assert!(other.yaw.abs() < 1e-12, "{}", other.yaw);

    let points = vec![(0.0, deg(8.0)), (12.0, deg(-4.0)), (30.0, deg(20.0))];
    let ends = [Approach::Dynamic, Approach::QuasiSteady].map(|approach| {
        let mut scenario = ripple(base, &base.rover);
        scenario.start.yaw = 0.0;
        scenario.yaw = held(points.clone());
        scenario.numerics.approach = approach;
        let run = run(&scenario);
        let yaw = PrescribedYaw { points: points.clone() };
        for record in &run.records {
            assert!((record.state.yaw - yaw.at(record.time)).abs() < 1e-9, "at {} s", record.time);
        }
        run.last().state
    });
    let off = (ends[0].position - ends[1].position).norm();
    assert!(off < 2e-3 * ends[0].position.norm(), "{off:e} m off");
}
