//! The search for a heading loses no branch: what it says of a slope is what a drive does there.

use grouser::document::{self, Kind, Overrides, Source};
use grouser::simulation::{
    Approach, Motion, Numerics, Outcome, PrescribedYaw, Run, Scenario, Start,
};
use grouser::site::Site;
use grouser::studies::heading::{HeadingCurve, HeadingOffset, HeadingStudy, LimitedBy};
use grouser::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, deg};
use grouser::vehicle::DriveLaw;
use rayon::prelude::*;

/// A ready rover on a ready soil, with the model that the soil was made for.
fn scenario(rover: &str, soil: &str, gravity: f64) -> Scenario {
    let find = |kind, name| Source::find(kind, name).expect("a preset");
    let none = Overrides::none();
    let base = document::read_scenario(&Source::default_scenario(), &none).expect("read").value;
    let rover = document::read_rover(&find(Kind::Rover, rover), &none).expect("read").value;
    let soil = document::read_soil(&find(Kind::Soil, soil), &none).expect("read");
    let theory = soil.document.theory().unwrap_or_default();
    Scenario { rover, theory, site: Site::plane(soil.value, 0.0, gravity), ..base }
}

fn curve(rover: &str, soil: &str, gravity: f64, course_deg: f64) -> HeadingCurve {
    let scenario = scenario(rover, soil, gravity);
    HeadingStudy::of(&scenario).curve_on(deg(course_deg)).expect("presets")
}

/// All ready rovers on all ready soils under three gravities.
fn triples() -> Vec<(&'static str, &'static str, f64)> {
    let soils = || document::presets(Kind::Soil).map(|soil| soil.name);
    let gravities = [EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY];
    document::presets(Kind::Rover)
        .flat_map(|rover| soils().map(move |soil| (rover.name, soil)))
        .flat_map(|(rover, soil)| gravities.map(|gravity| (rover, soil, gravity)))
        .collect()
}

// ---- the cases ----

/// Pull falls with the root of the slip where wheels begin to skid; it does not end there.
#[test]
fn a_rover_that_drives_down_10_degrees_has_a_heading_there() {
    let curve = curve("mgru3", "grc-3", EARTH_GRAVITY, -90.0);
    let slips: Vec<f64> = [1.0, 2.0, 5.0, 10.0]
        .map(|slope| curve.at(deg(slope)).expect("it drives down").slip_ratio)
        .to_vec();
    assert!(slips.is_sorted_by(|gentle, steep| gentle > steep), "{slips:?}");
    assert!(slips[3] < 0.0, "it brakes: {slips:?}");
    assert_eq!(curve.limited_by(), Some(LimitedBy::GroundStrength));
}

/// Pull falls again at high slip: level ground has two balances, and a drive has the one with little slip.
#[test]
fn level_ground_has_the_balance_with_the_least_slip() {
    let curve = curve("rashid", "dry-sand", EARTH_GRAVITY, 0.0);
    let level = curve.at(0.0).expect("it drives");
    assert!(level.slip_ratio < 0.05, "{}", level.slip_ratio);
    assert!(curve.at(deg(5.0)).is_ok(), "{:?}", curve.limit());
}

// ---- against drives ----

/// What a drive with its yaw held does on a slope.
fn drive(scenario: &Scenario, slope: f64, yaw: f64) -> Option<(Outcome, f64)> {
    let scenario = Scenario {
        site: scenario.site.with_slope(slope),
        yaw: Some(PrescribedYaw { points: vec![(0.0, yaw)] }),
        start: Start { yaw, motion: Motion::Rolling },
        drive: DriveLaw::Constant(0.05),
        duration: 10.0,
        numerics: Numerics {
            approach: Approach::QuasiSteady,
            sample_interval: 1.0,
            ..Numerics::DEFAULT
        },
        ..scenario.clone()
    };
    let run = Run::new(&scenario).and_then(Run::to_end).ok()?;
    let end = run.last().state.position;
    Some((run.outcome, end.y.atan2(end.x)))
}

/// How curves of headings agree with drives half a degree below their limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Counts {
    curves: usize,
    agree: usize,
    /// The search gave up.
    not_found: usize,
    /// The rover cannot move on level ground, or its limit is less than half a degree.
    flat: usize,
    /// The drive does not keep its course.
    differ: usize,
    /// Of all curves those that end where the ground slides by itself.
    ground: usize,
}

fn compare(rover: &str, soil: &str, gravity: f64, course_deg: f64) -> Counts {
    /// A run starts at a slip of its own, and swings in [rad].
    const OFF_COURSE: f64 = 0.02;
    let scenario = scenario(rover, soil, gravity);
    let curve = HeadingStudy::of(&scenario).curve_on(deg(course_deg)).expect("presets");
    let mut counts = Counts { curves: 1, ..Counts::default() };
    let Ok((limit, reason)) = curve.limit() else {
        return Counts { flat: 1, ..counts };
    };
    counts.ground = usize::from(curve.limited_by() == Some(LimitedBy::GroundStrength));
    if curve.limited_by() == Some(LimitedBy::NotFound) {
        println!("{rover} {soil} {gravity} {course_deg}: {:.2}° {reason}", limit.to_degrees());
        return Counts { not_found: 1, ..counts };
    }
    if limit < deg(0.5) {
        return Counts { flat: 1, ..counts };
    }
    let below = limit - deg(0.5);
    let heading: HeadingOffset = curve.at(below).expect("below the limit");
    let driven = drive(&scenario, below, heading.yaw);
    match driven {
        Some((Outcome::Completed, course)) if (course - deg(course_deg)).abs() < OFF_COURSE => {
            counts.agree = 1;
        }
        other => {
            println!("{rover} {soil} {gravity} {course_deg}: {:.2}° {other:?}", limit.to_degrees());
            counts.differ = 1;
        }
    }
    counts
}

fn count(triples: &[(&str, &str, f64)]) -> Counts {
    const COURSES: [f64; 5] = [-90.0, -45.0, 0.0, 45.0, 90.0];
    let places = triples.iter().flat_map(|triple| COURSES.map(|course| (*triple, course)));
    let places: Vec<_> = places.collect();
    let all: Vec<Counts> = places
        .par_iter()
        .map(|((rover, soil, gravity), course)| compare(rover, soil, *gravity, *course))
        .collect();
    all.iter().fold(Counts::default(), |sum, it| Counts {
        curves: sum.curves + it.curves,
        agree: sum.agree + it.agree,
        not_found: sum.not_found + it.not_found,
        flat: sum.flat + it.flat,
        differ: sum.differ + it.differ,
        ground: sum.ground + it.ground,
    })
}
