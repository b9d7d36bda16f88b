//! What turns the wheels of a leg: laws of slip and speeds of each wheel, against runs and closed
//! forms.

use grouser::mission::{Heading, Leg, Manoeuvre, Mission, MissionReport, MissionRun};
use grouser::simulation::Scenario;
use grouser::units::deg;
use grouser::vehicle::drive::{SlipLimit, SlipTarget};
use grouser::vehicle::{ByWheel, DriveLaw, PerWheel};

use super::given::{RIM_SPEED, complete_traverse, run};

const TARGET: SlipTarget = SlipTarget { speed: RIM_SPEED, slip_ratio: 0.2 };
const LIMIT: SlipLimit = SlipLimit { speed: PerWheel::All(RIM_SPEED), slip_ratio: 0.2 };

fn driven(scenario: Scenario, legs: Vec<Leg>) -> MissionReport {
    let mission = Mission { scenario, legs, stops: Vec::new(), sensors: None };
    MissionRun::new(&mission).expect("a mission").to_end().expect("it can be computed")
}

fn with(drive: DriveLaw, manoeuvre: Manoeuvre) -> Leg {
    Leg { drive, ..Leg::new(manoeuvre) }
}

/// A straight leg along the contour has the angle between nose and way that a traverse has: its
/// yaw. In its first control period a mission knows its slip already, a traverse does not yet: with
/// laws that ask for it a third of a millimetre.
#[test]
fn a_straight_leg_with_any_law_is_a_traverse() {
    let laws = [
        DriveLaw::ConstantEach(vec![0.06, 0.055, 0.05, 0.05]),
        DriveLaw::Eq18(TARGET),
        DriveLaw::Eq18AsPrinted(TARGET),
        DriveLaw::SlipLimiting(LIMIT),
    ];
    for drive in laws {
        let leg = with(drive.clone(), Manoeuvre::drive(0.8));
        let report = driven(complete_traverse(10.0, 0.0), vec![leg]);
        let traverse = run(&Scenario {
            duration: report.legs[0].time,
            drive: drive.clone(),
            ..complete_traverse(10.0, 0.0)
        });
        let (end, expected) = (&report.last().state, &traverse.last().state);
        let close = if drive.varies() { 5e-4 } else { 1e-9 };
        assert!(
            (end.position - expected.position).norm() < close,
            "{drive:?} {end:?} {expected:?}"
        );
        assert!((end.yaw - expected.yaw).abs() < close, "{drive:?}");
    }
}

/// By Eq. 18 a rover goes as fast as it is meant to, whichever way: straight, on arcs and in
/// reverse, on flat ground and across a slope.
#[test]
fn by_eq_18_a_rover_keeps_its_speed_over_the_ground() {
    let arc = |angle: f64, reverse| Manoeuvre::Arc { radius: 3.0, angle: deg(angle), reverse };
    let contour = |way| Leg {
        heading: Heading::Contour,
        ..with(DriveLaw::Eq18(TARGET), Manoeuvre::drive(way))
    };
    let cases = [
        (0.0, with(DriveLaw::Eq18(TARGET), Manoeuvre::drive(1.5))),
        (0.0, with(DriveLaw::Eq18(TARGET), Manoeuvre::drive(-1.5))),
        (0.0, with(DriveLaw::Eq18(TARGET), arc(30.0, false))),
        (0.0, with(DriveLaw::Eq18(TARGET), arc(-30.0, true))),
        (10.0, contour(1.5)),
        (10.0, contour(-1.5)),
    ];
    for (slope, leg) in cases {
        let report = driven(complete_traverse(slope, 0.0), vec![leg.clone()]);
        let leg_report = &report.legs[0];
        let speed = leg_report.distance / leg_report.time;
        assert!((speed / RIM_SPEED - 1.0).abs() < 0.02, "{leg:?}: {speed} m/s");
        let slip_ratio = leg_report.slip_ratio.expect("it drove");
        assert!(slip_ratio > 0.03, "without the law it would be that much slower: {slip_ratio}");
    }
}

/// A motor that turns twice as fast as it is told slips by what a drive allows, and costs less; the
/// closed form of a hub that the other wheels push on at 1 - s of their rims.
#[test]
fn a_wheel_that_runs_away_is_held_at_the_limit() {
    let speed = PerWheel::Each(vec![1.0, 1.0, 2.0, 1.0]);
    let by_wheel = ByWheel { speed, ..ByWheel::ALIKE };
    let base = Scenario { by_wheel, ..complete_traverse(0.0, 0.0) };
    let hold = |drive| Leg { heading: Heading::Hold, ..with(drive, Manoeuvre::drive(1.0)) };
    let constant = driven(base.clone(), vec![hold(DriveLaw::Constant(RIM_SPEED))]);
    let limited = driven(base, vec![hold(DriveLaw::SlipLimiting(LIMIT))]);
    let slip = |report: &MissionReport| report.last().wheels[2].reaction.slip.ratio;
    assert!(slip(&constant) > LIMIT.slip_ratio + 0.1, "{}", slip(&constant));
    assert!((slip(&limited) - LIMIT.slip_ratio).abs() < 1e-3, "{}", slip(&limited));
    assert!(limited.energy() < constant.energy());
}

/// All wheels of a rover that drives straight on turn alike and slip alike, and its soil knows no
/// rate: up a slope that asks for more slip than is allowed, a limit makes it slower and nothing
/// else.
#[test]
fn a_limit_of_slip_does_not_help_up_a_plane() {
    let base = complete_traverse(9.0, 90.0);
    let free =
        driven(base.clone(), vec![with(DriveLaw::Constant(RIM_SPEED), Manoeuvre::drive(0.3))]);
    let limited = driven(base, vec![with(DriveLaw::SlipLimiting(LIMIT), Manoeuvre::drive(0.3))]);
    let slip = |report: &MissionReport| report.legs[0].slip_ratio.expect("it drove");
    assert!(slip(&free) > LIMIT.slip_ratio, "{}", slip(&free));
    assert!((slip(&limited) - slip(&free)).abs() < 0.02, "{} {}", slip(&limited), slip(&free));
    assert!(limited.legs[0].time > 2.0 * free.legs[0].time);
}

/// Slower on its right a rover turns to its right, and backward it comes back the way it went.
#[test]
fn speeds_of_each_wheel_steer_a_rover_there_and_back() {
    let base = complete_traverse(0.0, 0.0);
    let mounts = base.rover.mounts();
    let speeds = mounts.iter().map(|mount| if mount.position.y < 0.0 { 0.04 } else { 0.06 });
    let drive = DriveLaw::ConstantEach(speeds.collect());
    let legs = [0.5, -0.5].map(|way| with(drive.clone(), Manoeuvre::drive(way))).to_vec();
    let report = driven(base, legs);
    let (turned, end) = (report.legs[0].end.yaw, report.last().state);
    assert!(turned < deg(-5.0), "{}°", turned.to_degrees());
    assert!(end.yaw.abs() < 0.1 * turned.abs(), "{}°", end.yaw.to_degrees());
    assert!(end.position.norm() < 0.02, "{:?}", end.position);
}
