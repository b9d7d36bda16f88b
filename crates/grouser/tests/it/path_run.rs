//! Runs along a path: limits as in missions, and where a path ends.

use std::f64::consts::FRAC_PI_2;

use grouser::mission::{
    Cause, Leg, LegOutcome, Limited, Manoeuvre, Mission, MissionRun, PathRun, PathTask, Route, Stop,
};
use grouser::simulation::{Approach, BadState, Numerics, Run, Scenario};
use grouser::units::{Vec2, deg};
use grouser::vehicle::DriveLaw;

use super::given::traverse;

const SPEED: f64 = 0.06;

fn scenario(slope: f64, yaw: f64, approach: Approach) -> Scenario {
    let usual = traverse(deg(slope), deg(yaw));
    let numerics = Numerics { approach, ..usual.numerics };
    Scenario { drive: DriveLaw::Constant(SPEED), numerics, ..usual }
}

fn on_path(scenario: &Scenario, route: Route, stops: &[Stop]) -> PathRun {
    let task = PathTask { route, within: 0.1, stops: stops.to_vec() };
    PathRun::new(Run::new(scenario).expect("a run"), task).expect("a path")
}

fn straight(yaw: f64, length: f64) -> Route {
    let (sin, cos) = deg(yaw).sin_cos();
    Route::through(&[Vec2::zeros(), length * Vec2::new(cos, sin)]).expect("a path")
}

fn limit_of(outcome: Option<&LegOutcome>) -> (Stop, f64, f64) {
    let Some(LegOutcome::Stopped(stopped)) = outcome else { panic!("{outcome:?}") };
    let Cause::Limit { stop, value } = stopped.cause else { panic!("{stopped:?}") };
    (stop, value, stopped.after)
}

/// Two ways to one number: a leg of a mission, and commands that turn the wheels the same way.
#[test]
fn a_straight_drive_stops_where_a_mission_does() {
    let over = |limited, above, over| Stop { over, ..Stop::above(limited, above) };
    for (slope, yaw, stop) in [
        (10.0, 0.0, over(Limited::Drift, 0.02, 0.3)),
        (10.0, 0.0, over(Limited::DriftPerMetre, 0.07, 0.3)),
        (13.0, 60.0, over(Limited::SlipRatio, 0.3, 0.5)),
        (12.0, 0.0, Stop::above(Limited::OffPath, 0.05)),
        (15.0, 45.0, Stop::above(Limited::Energy, 3.0)),
        (10.0, 20.0, Stop::above(Limited::Time, 7.25)),
        (17.0, 90.0, Stop::above(Limited::Sinkage, 0.05)),
        (17.0, 90.0, Stop::above(Limited::SinkageDepth, 0.005)),
        (15.0, 0.0, Stop::above(Limited::Roll, deg(14.5))),
        (15.0, 90.0, Stop::above(Limited::Torque, 0.5)),
    ] {
        for approach in [Approach::Dynamic, Approach::QuasiSteady] {
            let scenario = scenario(slope, yaw, approach);
            let leg = Leg { stops: vec![stop], ..Leg::new(Manoeuvre::drive(5.0)) };
            let plan = Mission {
                scenario: scenario.clone(),
                legs: vec![leg],
                stops: vec![],
                sensors: None,
            };
            let report = MissionRun::new(&plan).expect("a mission").to_end().expect("computed");
            let leg = &report.legs[0];
            assert_eq!(leg.outcome.name(), "stopped", "{stop:?} {approach:?}");
            let mut path = on_path(&scenario, straight(yaw, 5.0), &[stop]);
            while path.outcome().is_none() {
                path.step(&[SPEED; 4], 0.5).expect("it can be computed");
            }
            let (expected, found) = (limit_of(Some(&leg.outcome)), limit_of(path.outcome()));
            assert_eq!(found.0, expected.0, "{slope}° {approach:?}");
            let time = path.run().state().time();
            assert!((time - leg.time).abs() < 1e-9, "{stop:?} {approach:?}: {time} {leg:?}");
            assert!(
                (found.1 - expected.1).abs() < 1e-9,
                "{stop:?} {approach:?} {found:?} {expected:?}"
            );
            assert!(
                (found.2 - expected.2).abs() < 1e-9,
                "{stop:?} {approach:?} {found:?} {expected:?}"
            );
        }
    }
}

/// One long step is many short ones.
#[test]
fn how_long_a_step_is_does_not_matter() {
    let stops = [Stop::above(Limited::OffPath, 0.1)];
    let ends = [0.1, 0.5, 7.3].map(|span| {
        let scenario = scenario(12.0, 0.0, Approach::Dynamic);
        let mut path = on_path(&scenario, straight(0.0, 5.0), &stops);
        while path.outcome().is_none() {
            path.step(&[0.05, 0.05, 0.06, 0.06], span).expect("it can be computed");
        }
        (path.run().state().time(), path.beside(), path.outcome().cloned())
    });
    assert_eq!(ends[0], ends[1]);
    assert_eq!(ends[0], ends[2]);
}

#[test]
fn a_path_is_completed_near_its_end() {
    let scenario = scenario(5.0, 0.0, Approach::QuasiSteady);
    let mut path = on_path(&scenario, straight(0.0, 0.5), &[]);
    while path.outcome().is_none() {
        path.step(&[SPEED; 4], 0.5).expect("it can be computed");
    }
    assert_eq!(path.outcome(), Some(&LegOutcome::Completed));
    let away = (path.run().state().rover().position - Vec2::new(0.5, 0.0)).norm();
    // It is looked at every tenth of a second, in which it comes 6 mm.
    assert!(away <= 0.1 && away > 0.1 - 0.0061, "{away} m");
    let ended = path.run().state().time();
    path.step(&[SPEED; 4], 0.5).expect("nothing to compute");
    assert_eq!(path.run().state().time(), ended);
}

#[test]
fn a_rover_that_goes_past_the_end_has_left_the_path() {
    let scenario = scenario(15.0, 0.0, Approach::QuasiSteady);
    let mut path = on_path(&scenario, straight(0.0, 3.0), &[]);
    while path.outcome().is_none() {
        path.step(&[SPEED; 4], 0.5).expect("it can be computed");
    }
    let (stop, value, _) = limit_of(path.outcome());
    assert_eq!((stop.limited, stop.above), (Limited::OffPath, 0.1));
    let beside = path.beside();
    assert!(value > 0.1 && (value - beside.cross_track.abs()).abs() < 1e-12);
    assert!(beside.cross_track < 0.0, "it drifts downhill, to the right: {beside:?}");
}

/// Where the path leads back 12 cm beside itself, a rover that drives out is not taken to be on its
/// way back.
#[test]
fn a_path_that_leads_back_beside_itself_is_no_short_cut() {
    let places = [[0.0, 0.0], [1.0, 0.0], [1.0, -0.12], [-1.0, -0.12]];
    let route = Route::through(&places.map(|[x, y]| Vec2::new(x, y))).expect("a path");
    let mut path = on_path(&scenario(12.0, 0.0, Approach::QuasiSteady), route, &[]);
    while path.run().state().rover().position.x < 0.85 {
        path.step(&[SPEED; 4], 0.5).expect("it can be computed");
        let (place, beside) = (path.run().state().rover().position, path.beside());
        assert!((beside.along - place.x).abs() < 1e-9, "{place} {beside:?}");
        assert!((beside.cross_track - place.y).abs() < 1e-9, "{place} {beside:?}");
        assert!((path.heading_error() - path.run().state().rover().yaw).abs() < 1e-12);
    }
    // It has come nearer to the way back than to the way out.
    assert!(path.run().state().rover().position.y < -0.06);
    assert_eq!(path.outcome(), None);
}

#[test]
fn an_arc_is_left_at_its_side() {
    let route = Route::arc(1.0, 0.0, FRAC_PI_2).expect("an arc");
    let scenario = scenario(0.0, 0.0, Approach::QuasiSteady);
    let mut path = on_path(&scenario, route, &[Stop::above(Limited::OffPath, 0.05)]);
    while path.outcome().is_none() {
        path.step(&[SPEED; 4], 0.1).expect("it can be computed");
    }
    let place = path.run().state().rover().position;
    let off = (place - Vec2::new(0.0, 1.0)).norm() - 1.0;
    assert!((limit_of(path.outcome()).1 - off).abs() < 1e-12);
    assert!((path.beside().cross_track + off).abs() < 1e-12, "to the right of an arc to the left");
}

/// A rover on a path goes on from its bytes as from a clone, also once a limit has stopped it.
#[test]
fn a_rover_on_a_path_goes_on_from_bytes() {
    let scenario = scenario(12.0, 0.0, Approach::Dynamic);
    let stops = [Stop { over: 0.2, ..Stop::above(Limited::Drift, 0.02) }];
    let mut path = on_path(&scenario, straight(0.0, 5.0), &stops);
    for _ in 0..30 {
        let task = PathTask::from_bytes(&path.task().to_bytes()).expect("a path");
        assert_eq!(task, *path.task());
        let mut other = PathRun::from_bytes(&path.to_bytes(), &scenario, &task).expect("a state");
        for one in [&mut path, &mut other] {
            one.step(&[SPEED; 4], 0.5).expect("a step");
        }
        assert_eq!(other.outcome(), path.outcome());
        assert_eq!(other.to_bytes(), path.to_bytes());
    }
    assert!(path.outcome().is_some(), "it was stopped");
    let elsewhere = PathTask { within: 0.2, ..path.task().clone() };
    let error = PathRun::from_bytes(&path.to_bytes(), &scenario, &elsewhere).err();
    assert_eq!(error, Some(BadState::OtherPath));
    let error = PathRun::from_bytes(&path.run().state().to_bytes(), &scenario, path.task()).err();
    assert_eq!(error, Some(BadState::Unreadable));
}
