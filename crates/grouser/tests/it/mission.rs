//! Missions: legs and stops, against runs, kinematics and symmetries.

use grouser::document::{self, Overrides, Source};
use grouser::mission::{
    Cause, Heading, Kind, Leg, LegOutcome, LegReport, Limited, Manoeuvre, Measure, Mission,
    MissionError, MissionReport, MissionRun, Sensors, Stop, Stopped, Then,
};
use grouser::simulation::{
    Approach, CONTROL_PERIOD, Integrator, Method, Numerics, Outcome, Record, Scenario,
};
use grouser::studies::completion::Completion;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::units::{Vec2, deg};
use grouser::vehicle::{DriveLaw, Rover};

use super::given::{RIM_SPEED, complete_traverse, run};

fn mission(slope: f64, legs: Vec<Leg>) -> Mission {
    Mission { scenario: complete_traverse(slope, 0.0), legs, stops: Vec::new(), sensors: None }
}

fn driven(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("a mission").to_end().expect("it can be computed")
}

fn quasi_steady(mut mission: Mission) -> Mission {
    mission.scenario.numerics =
        Numerics { approach: Approach::QuasiSteady, ..mission.scenario.numerics };
    mission
}

fn stopped(leg: &LegReport) -> (Stop, f64, &Stopped) {
    let LegOutcome::Stopped(why) = &leg.outcome else { panic!("{:?}", leg.outcome) };
    let Cause::Limit { stop, value } = why.cause else { panic!("{why:?}") };
    (stop, value, why)
}

/// One leg straight on is a traverse of its duration.
#[test]
fn a_straight_leg_is_a_traverse() {
    for (slope, yaw) in [(0.0, 0.0), (10.0, 5.0), (15.0, 40.0), (8.0, -70.0)] {
        let leg = Leg { yaw: Some(deg(yaw)), ..Leg::new(Manoeuvre::drive(1.0)) };
        let report = driven(&mission(slope, vec![leg]));
        let leg = &report.legs[0];
        assert_eq!(leg.outcome, LegOutcome::Completed, "{slope}°");
        assert!((leg.distance - 1.0).abs() < 1e-6, "{slope}°: {} m", leg.distance);
        let traverse = run(&Scenario { duration: leg.time, ..complete_traverse(slope, yaw) });
        let (end, expected) = (&report.last().state, &traverse.last().state);
        assert!((end.position - expected.position).norm() < 1e-9, "{slope}°, {yaw}°");
        assert!((end.yaw - expected.yaw).abs() < 1e-9, "{slope}°, {yaw}°");
        assert!(
            (leg.energy - traverse.last().energy.motors).abs() < 1e-9 * leg.energy.abs().max(1.0)
        );
    }
}

#[test]
fn a_leg_that_is_cut_in_two_is_one_leg() {
    let whole = driven(&mission(12.0, vec![Leg::new(Manoeuvre::drive(1.2))]));
    let parts = [0.5, 0.7].map(|way| Leg::new(Manoeuvre::drive(way)));
    let cut = driven(&mission(12.0, parts.to_vec()));
    let (one, other) = (whole.last(), cut.last());
    assert!((one.state.position - other.state.position).norm() < 1e-6);
    assert!((one.time - other.time).abs() < 1e-5 && (one.state.yaw - other.state.yaw).abs() < 1e-6);
    assert!((whole.energy() - cut.energy()).abs() < 1e-5);
}

/// What a mirrored rover drives on a level ground is the mirror image.
#[test]
fn mirrored_legs_lead_to_the_mirrored_place() {
    let legs = |side: f64| {
        vec![
            Leg::new(Manoeuvre::drive(0.4)),
            Leg::new(Manoeuvre::Turn { angle: side * deg(60.0) }),
            Leg::new(Manoeuvre::Arc { radius: 1.0, angle: side * deg(30.0), reverse: false }),
            Leg::new(Manoeuvre::drive(-0.3)),
        ]
    };
    let [left, right] = [1.0, -1.0].map(|side| driven(&mission(0.0, legs(side))));
    let (left, right) = (left.last().state, right.last().state);
    assert!((left.position.x - right.position.x).abs() < 1e-6);
    assert!((left.position.y + right.position.y).abs() < 1e-6);
    assert!((left.yaw + right.yaw).abs() < 1e-6, "{left:?} {right:?}");
}

/// A rover whose front is called its rear drives backward what the other drives forward.
#[test]
fn a_rover_that_is_turned_round_reverses_the_same_way() {
    let legs = |sign: f64, reverse| {
        vec![
            Leg::new(Manoeuvre::drive(sign * 0.4)),
            Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(sign * 0.5)) },
            Leg::new(Manoeuvre::Arc { radius: 1.5, angle: deg(20.0), reverse }),
        ]
    };
    let forward =
        Mission { scenario: complete_traverse(10.0, 15.0), ..mission(10.0, legs(1.0, false)) };
    let mut backward =
        Mission { scenario: complete_traverse(10.0, -165.0), ..mission(10.0, legs(-1.0, true)) };
    let mut parts = backward.scenario.rover.parts().clone();
    for mount in &mut parts.mounts {
        (mount.position.x, mount.position.y) = (-mount.position.x, -mount.position.y);
    }
    backward.scenario.rover = Rover::draft(parts).checked().expect("a rover");
    let [forward, backward] = [forward, backward].map(|plan| driven(&plan));
    let (one, other) = (forward.last().state, backward.last().state);
    assert!((one.position - other.position).norm() < 1e-6, "{one:?} {other:?}");
    assert!((one.yaw - other.yaw - deg(180.0)).abs() < 1e-6, "{one:?} {other:?}");
    assert!((forward.energy() - backward.energy()).abs() < 1e-5);
}

/// On the spot a rover turns by its angle and ends within 0.1 m of its place. On the way it strays
/// little more, but for half a turn on a slope, over which it slides both ways.
#[test]
fn a_turn_on_the_spot_ends_at_its_angle_and_place() {
    for (slope, start, angle, strays) in [
        (0.0, 0.0, 90.0, 0.04),
        (0.0, 30.0, -170.0, 0.04),
        (5.0, 0.0, 90.0, 0.1),
        (5.0, 90.0, 90.0, 0.1),
        (10.0, 5.0, 90.0, 0.13),
        (10.0, 0.0, -90.0, 0.13),
        (10.0, 90.0, 90.0, 0.13),
        (10.0, 0.0, -45.0, 0.13),
        (10.0, 0.0, 180.0, 0.22),
    ] {
        let leg = Leg::new(Manoeuvre::Turn { angle: deg(angle) });
        let report = driven(&mission(slope, vec![Leg { yaw: Some(deg(start)), ..leg }]));
        assert_eq!(report.outcome(), "completed", "{slope}°: {:?}", report.legs);
        let end = report.last().state;
        assert!((end.yaw - deg(start + angle)).abs() < 1e-6, "{slope}°: {}°", end.yaw.to_degrees());
        let farthest = report.trajectory.records.iter().map(|it| it.state.position.norm());
        let farthest = farthest.fold(0.0, f64::max);
        assert!(
            end.position.norm() < 0.1,
            "{slope}°, {start}°, {angle}°: {} m",
            end.position.norm()
        );
        assert!(farthest < strays, "{slope}°, {start}°, {angle}°: {farthest} m");
    }
}

/// The end of an arc is where its circle says, but for what the controller lags behind.
#[test]
fn an_arc_follows_its_circle() {
    for (radius, angle, reverse) in
        [(1.0, 90.0, false), (2.0, -60.0, false), (1.5, 45.0, true), (3.0, -30.0, true)]
    {
        let leg = Leg::new(Manoeuvre::Arc { radius, angle: deg(angle), reverse });
        let report = driven(&mission(0.0, vec![leg]));
        assert_eq!(report.outcome(), "completed");
        let leg = &report.legs[0];
        let way = radius * deg(angle).abs();
        // The yaw lags behind the way, or is ahead of it, and the arc goes on until it is there.
        assert!((leg.distance / way - 1.0).abs() < 0.1, "{} m for {way} m", leg.distance);
        let end = report.last().state;
        assert!((end.yaw - deg(angle)).abs() < 1e-6, "{}°", end.yaw.to_degrees());
        let direction = if reverse { -1.0 } else { 1.0 };
        // A chord of the circle.
        let chord = 2.0 * radius * (deg(angle).abs() / 2.0).sin();
        let bearing = deg(angle) / 2.0;
        let expected = direction * chord * Vec2::new(bearing.cos(), bearing.sin());
        let off = (end.position - expected).norm();
        assert!(off < 0.08 * way, "radius {radius} m, {angle}°: {off} m off");
    }
}

/// Rims that turn back find their steady motion again: a drive there and back needs no integration.
#[test]
fn a_reversal_stays_quasi_steady() {
    for slope in [0.0, 6.0, 12.0] {
        let ways = [1.0, -1.0, 0.5, -0.5];
        let legs = ways.map(|way| Leg::new(Manoeuvre::drive(way))).to_vec();
        let plan = mission(slope, legs);
        let mut run = MissionRun::new(&quasi_steady(plan.clone())).expect("a mission");
        while run.next_leg().expect("it can be computed").is_some() {}
        assert_eq!(*run.method(), Method::QuasiSteady, "{slope}°");
        let (quasi_steady, dynamic) = (run.finish(), driven(&plan));
        let off = quasi_steady.last().state.position - dynamic.last().state.position;
        assert!(off.norm() < 2e-3, "{slope}°: {off}");
    }
}

/// With its yaw held, and even more on a contour, a rover drifts less than freely.
#[test]
fn what_is_held_is_held() {
    let end = |heading| {
        let leg = Leg { heading, yaw: Some(deg(6.0)), ..Leg::new(Manoeuvre::drive(6.0)) };
        let report = driven(&quasi_steady(mission(12.0, vec![leg])));
        assert_eq!(report.outcome(), "completed");
        report.last().state
    };
    let [free, hold, contour] = [Heading::Free, Heading::Hold, Heading::Contour].map(end);
    assert!((hold.yaw - deg(6.0)).abs() < deg(0.1), "{}°", hold.yaw.to_degrees());
    assert!(free.yaw < deg(5.0), "freely the nose falls: {}°", free.yaw.to_degrees());
    assert!(contour.position.y.abs() < 0.02, "{} m", contour.position.y);
    assert!(free.position.y < hold.position.y && hold.position.y < -0.02);
}

#[test]
fn a_waypoint_is_reached_across_a_slope_forward_and_backward() {
    for (place, reverse) in [
        (Vec2::new(3.0, 0.0), false),
        (Vec2::new(2.0, 1.0), false),
        (Vec2::new(-2.0, 0.5), false),
        (Vec2::new(-2.0, 0.0), true),
    ] {
        let leg = Leg::new(Manoeuvre::Goto { place, within: 0.1, reverse });
        let report = driven(&quasi_steady(mission(8.0, vec![leg])));
        assert_eq!(report.outcome(), "completed", "{place}: {:?}", report.legs);
        assert!((report.last().state.position - place).norm() < 0.1 + 1e-6, "{place}");
    }
}

/// Slip by odometry: where the rims are counted, less ground is gone.
#[test]
fn odometry_counts_the_rims() {
    let leg = Leg::new(Manoeuvre::Drive { distance: 1.0, by: Measure::Odometry });
    let report = driven(&mission(10.0, vec![Leg { yaw: Some(deg(60.0)), ..leg }]));
    let leg = &report.legs[0];
    assert!((leg.time - 1.0 / RIM_SPEED).abs() < 1e-5, "{} s", leg.time);
    let slip = leg.slip_ratio.expect("a drive");
    assert!((leg.distance - (1.0 - slip)).abs() < 1e-6 && slip > 0.1, "{slip}");
}

/// Each limit stops within one control period of where it is passed.
#[test]
fn limits_stop_within_a_control_period() {
    let drive = || Leg { yaw: Some(deg(10.0)), ..Leg::new(Manoeuvre::drive(5.0)) };
    for (limited, above, rate) in [
        (Limited::Time, 7.03, 1.0),
        (Limited::Energy, 3.3, 1.0),
        (Limited::OffPath, 0.05, RIM_SPEED),
    ] {
        let stop = Stop::above(limited, above);
        let report = driven(&mission(12.0, vec![Leg { stops: vec![stop], ..drive() }]));
        let (found, value, why) = stopped(&report.legs[0]);
        assert_eq!((found.limited, why.kind), (limited, limited.row().kind));
        assert!(
            value > above && value <= above + rate * CONTROL_PERIOD + 1e-9,
            "{limited:?}: {value}"
        );
        assert_eq!(report.outcome(), "stopped");
    }
}

/// Straight up a slope that is too steep: slip over a metre of the rims.
#[test]
fn a_slip_check_stops_and_backs_out() {
    let climb = Leg { yaw: Some(deg(90.0)), ..Leg::new(Manoeuvre::drive(5.0)) };
    let stop = Stop { then: Then::BackOut(0.3), ..Stop::above(Limited::SlipRatio, 0.4) };
    let next = Leg::new(Manoeuvre::drive(1.0));
    let mut plan = mission(17.0, vec![climb, next]);
    plan.stops = vec![stop];
    let report = driven(&plan);
    assert_eq!((report.legs.len(), report.outcome()), (1, "stopped"));
    let leg = &report.legs[0];
    let (_, value, why) = stopped(leg);
    assert!(value > 0.4 && why.kind == Kind::Reactive, "{value}");
    let back = leg.back_out.as_ref().expect("it backed out");
    assert!(
        (back.distance - 0.3).abs() < 1e-6 && back.outcome == LegOutcome::Completed,
        "{back:?}"
    );
    // The rims went a metre before anybody could know.
    assert!((leg.time - 1.0 / RIM_SPEED).abs() < CONTROL_PERIOD + 1e-6, "{} s", leg.time);
}

#[test]
fn a_limit_may_lead_to_the_next_leg() {
    let stop = Stop { then: Then::NextLeg, ..Stop::above(Limited::Time, 5.0) };
    let legs = vec![
        Leg { stops: vec![stop], ..Leg::new(Manoeuvre::drive(5.0)) },
        Leg::new(Manoeuvre::drive(0.2)),
    ];
    let report = driven(&mission(5.0, legs));
    let names: Vec<&str> = report.legs.iter().map(|leg| leg.outcome.name()).collect();
    assert_eq!((&names[..], report.outcome()), (&["stopped", "completed"][..], "completed"));
}

/// Ahead of time: a rover that looks ahead stops where one that feels its slip has dug in already.
#[test]
fn what_is_foreseen_stops_before_it_is_felt() {
    let stop = Stop { over: 0.5, ..Stop::above(Limited::SlipRatio, 0.4) };
    let climb = Leg { yaw: Some(deg(90.0)), ..Leg::new(Manoeuvre::drive(5.0)) };
    let plan = |look_ahead| Mission {
        stops: vec![stop],
        ..mission(17.0, vec![Leg { look_ahead, ..climb.clone() }])
    };
    let [felt, foreseen] = [None, Some(1.0)].map(|ahead| driven(&plan(ahead)));
    let kinds = [&felt, &foreseen].map(|report| stopped(&report.legs[0]).2.kind);
    assert_eq!(kinds, [Kind::Reactive, Kind::Predictive]);
    assert!(foreseen.legs[0].distance < 1e-6 && felt.legs[0].distance > 0.1);
}

/// Where it cannot be reached, a leg ends in time with a reason.
#[test]
fn what_cannot_be_reached_ends() {
    let leg = Leg { yaw: Some(deg(90.0)), ..Leg::new(Manoeuvre::drive(50.0)) };
    let report = driven(&mission(27.0, vec![leg]));
    assert!(
        matches!(
            &report.legs[0].outcome,
            LegOutcome::Ended(Outcome::Immobilised { .. } | Outcome::Sliding { .. })
        ),
        "{:?}",
        report.legs
    );
}

#[test]
fn waiting_takes_its_time_and_no_energy_on_level_ground() {
    let mut plan = mission(0.0, vec![Leg::new(Manoeuvre::Wait { time: 12.5 })]);
    plan.scenario.start.motion = grouser::simulation::Motion::Rest;
    let report = driven(&plan);
    let leg = &report.legs[0];
    assert!((leg.time - 12.5).abs() < 1e-9 && leg.energy.abs() < 1e-9, "{leg:?}");
}

#[test]
fn plans_that_are_none_name_their_leg() {
    let bad = [
        Leg::new(Manoeuvre::drive(f64::NAN)),
        Leg { drive: DriveLaw::Constant(0.0), ..Leg::new(Manoeuvre::drive(1.0)) },
        Leg { drive: DriveLaw::ConstantEach(vec![0.06; 3]), ..Leg::new(Manoeuvre::drive(1.0)) },
        Leg::new(Manoeuvre::Arc { radius: -1.0, angle: 1.0, reverse: false }),
        Leg { heading: Heading::Hold, ..Leg::new(Manoeuvre::Wait { time: 1.0 }) },
        Leg { look_ahead: Some(0.0), ..Leg::new(Manoeuvre::drive(1.0)) },
    ];
    for leg in bad {
        let plan = mission(5.0, vec![Leg::new(Manoeuvre::drive(1.0)), leg]);
        let error = MissionRun::new(&plan).err().expect("it is none");
        assert!(matches!(&error, MissionError::Plan(plan) if plan.leg == 2), "{error}");
        assert!(error.to_string().starts_with("leg 2: "), "{error}");
    }
    let error = MissionRun::new(&mission(5.0, Vec::new())).err().expect("no leg");
    assert!(error.to_string().contains("number of legs"), "{error}");
}

/// The same mission is the same to the last bit, leg by leg or at once, and with its records taken
/// on the way.
#[test]
fn a_mission_is_determined() {
    let legs = vec![
        Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(0.5)) },
        Leg::new(Manoeuvre::Turn { angle: deg(30.0) }),
    ];
    let plan = mission(9.0, legs);
    let whole = driven(&plan);
    let mut run = MissionRun::new(&plan).expect("a mission");
    let mut records = Vec::new();
    let mut take = |some: &[Record]| {
        records.extend_from_slice(some);
        true
    };
    while run.next_leg_watched(&mut take).expect("a leg").is_some() {}
    let end = run.finish();
    records.extend(end.trajectory.records);
    assert!(records == whole.trajectory.records && end.legs == whole.legs);
}

/// An hour in two legs: who takes the records sees a few at a time, and none are kept.
#[test]
fn memory_does_not_grow_with_a_mission() {
    let hold = Leg { heading: Heading::Hold, ..Leg::new(Manoeuvre::drive(120.0)) };
    let mut plan =
        quasi_steady(mission(3.0, vec![hold, Leg::new(Manoeuvre::Wait { time: 1800.0 })]));
    plan.scenario.numerics.sample_interval = 1.0;
    let (mut count, mut most) = (0, 0);
    let mut run = MissionRun::new(&plan).expect("a mission");
    let mut take = |some: &[Record]| {
        (count, most) = (count + some.len(), most.max(some.len()));
        true
    };
    while run.next_leg_watched(&mut take).expect("a leg").is_some() {}
    assert!(count > 3_500 && most < 1100, "{count} records, {most} at once");
    assert!(run.finish().trajectory.records.len() <= 1);
}

/// The path of an arc is its circle: a rover that follows it is nowhere far off.
#[test]
fn off_the_path_of_an_arc_is_off_its_circle() {
    for reverse in [false, true] {
        let arc = Leg::new(Manoeuvre::Arc { radius: 1.5, angle: deg(60.0), reverse });
        let with = |above| {
            let stops = vec![Stop::above(Limited::OffPath, above)];
            driven(&mission(0.0, vec![Leg { stops, ..arc.clone() }]))
        };
        assert_eq!(with(0.1).outcome(), "completed", "reverse {reverse}");
        let report = with(1e-4);
        let (stop, value, _) = stopped(&report.legs[0]);
        assert_eq!(stop.limited, Limited::OffPath);
        assert!(value < 0.01, "{value}");
    }
}

/// Heading noise of 1° and visual odometry each half metre with 2 %.
pub(crate) const SENSORS: Sensors = Sensors {
    heading_deviation: 0.017_453,
    heading_interval: 1.0,
    heading_delay: 0.0,
    odometry_deviation: 0.02,
    odometry_interval: 0.5,
    seed: 1,
};

/// The track that the rover takes itself to follow keeps to the contour, and the real one to three
/// times the error of the sensors' closed form.
#[test]
fn a_contour_is_held_by_what_sensors_say() {
    let leg =
        Leg { yaw: Some(deg(8.0)), heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(50.0)) };
    for seed in 0..2 {
        let sensors = Some(Sensors { seed, ..SENSORS });
        let mut plan = Mission { sensors, ..mission(15.0, vec![leg.clone()]) };
        plan.scenario.numerics.sample_interval = 10.0;
        let report = driven(&plan);
        assert_eq!(report.outcome(), "completed", "{:?}", report.legs);
        assert!((report.legs[0].distance - 50.0).abs() < 1.0, "{} m", report.legs[0].distance);
        let settled: Vec<_> = report.fixes.iter().filter(|fix| fix.truth.x > 2.0).collect();
        assert!(settled.len() > 90);
        for fix in settled {
            let allowed = 3.0 * SENSORS.deviation_after(fix.truth.x) + 0.05;
            assert!(fix.estimate.y.abs() < 0.05, "seed {seed}: {fix:?}");
            assert!(fix.truth.y.abs() < allowed, "seed {seed}: {fix:?}, {allowed} m allowed");
        }
    }
}

/// Without errors a rover that measures knows as much as one that knows all, but for what it
/// reckons between fixes.
#[test]
fn perfect_sensors_are_nearly_the_truth() {
    let perfect = Sensors { heading_deviation: 0.0, odometry_deviation: 0.0, ..SENSORS };
    let leg = Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(4.0)) };
    let knows_all = mission(10.0, vec![leg]);
    let measures = Mission { sensors: Some(perfect), ..knows_all.clone() };
    let [known, measured] = [driven(&knows_all), driven(&measures)];
    assert!(known.fixes.is_empty() && measured.fixes.len() > 6);
    assert!(measured.fixes.iter().all(|fix| (fix.estimate - fix.truth).norm() < 1e-12));
    let off = (measured.last().state.position - known.last().state.position).norm();
    assert!(off < 0.03, "{off} m");
}

/// On a slope on which a mission ends in many ways, a sample that is driven by steady motions ends
/// mostly as it does where velocities are integrated: of 24 samples of the preset 11 complete it, of
/// which 8 do so dynamically. (With runs that fell back to their end, and turns on the spot that began
/// anew, half of 40 did.)
#[test]
fn samples_end_a_mission_mostly_as_they_do_dynamically() {
    let overrides = Overrides::parse(["mission.soil=toyoura-uncertain"]).expect("keys");
    let source = Source::find(document::Kind::Mission, "slip-check").expect("a preset");
    let loaded = document::read_mission(&source, &overrides).expect("a mission");
    let (_, mission) = loaded.value.missions().remove(0);
    let scenario = loaded.with_value(loaded.value.scenario.clone());
    let samples = BandInputs::of_scenario(&scenario).samples(1, 24).expect("samples");
    let completes = |sample: &Sample, approach: Approach| {
        let mut mission = mission.clone();
        let scenario = &mut mission.scenario;
        (scenario.ground.soil, scenario.model) = (sample.soil, sample.model.clone());
        let integrator = Integrator::Adaptive { tolerance: 1e-3 };
        scenario.numerics = Numerics { approach, integrator, ..scenario.numerics };
        let report = driven(&mission);
        let is_last = report.legs.len() == mission.legs.len();
        is_last && report.legs.iter().all(|leg| leg.outcome == LegOutcome::Completed)
    };
    let all = |approach| samples.iter().map(|it| completes(it, approach)).collect::<Vec<_>>();
    let (steady, dynamic) = (all(Approach::QuasiSteady), all(Approach::Dynamic));
    let differ = steady.iter().zip(&dynamic).filter(|(one, other)| one != other).count();
    let completed = dynamic.iter().filter(|it| **it).count();
    assert!((6..18).contains(&completed) && differ <= 4, "{steady:?} and {dynamic:?}");
    let found = Completion::of_mission(&mission, &samples, &|| true).expect("it is not stopped");
    assert_eq!(found.completed.successes, steady.iter().filter(|it| **it).count());
}
