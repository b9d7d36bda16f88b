//! The attitude over slope, course and soil.

use grouser::contact::Model;
use grouser::simulation::{Approach, Numerics, Scenario};
use grouser::studies::heading::{HeadingStudy, Steering};
use grouser::studies::heading_map::HeadingMap;
use grouser::units::{EARTH_GRAVITY, Vec2, deg};
use grouser::vehicle::{LoadSharing, OwnMoments};

use super::given;

fn study() -> HeadingStudy {
    HeadingStudy {
        rover: given::hakuto(),
        soil: given::toyoura(),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        sharing: LoadSharing::QuasiStatic,
        own_moments: OwnMoments::Neglected,
        stability: grouser::soil::SlopeStability::USUAL,
        steering: Steering::None,
    }
}

fn degrees(list: &[f64]) -> Vec<f64> {
    list.iter().map(|number| deg(*number)).collect()
}

#[test]
fn course_0_is_the_level_traverse() {
    let slopes = degrees(&[0.0, 5.0, 10.0, 20.0, 25.0]);
    let map = HeadingMap::of(&[study()], &[0.0], &slopes).expect("courses and slopes");
    let curve = study().curve().expect("sand");
    for (slope, cell) in slopes.iter().zip(&map.rows[0].cells) {
        assert_eq!(*cell, curve.at(*slope));
    }
}

/// The rover that is started at a map's yaw, on its slope, goes on its course: a run in time has
/// nothing in common with the map but the equations.
#[test]
fn a_run_that_starts_at_the_maps_yaw_keeps_its_course() {
    let (courses, slopes) = (degrees(&[-75.0, -45.0, -15.0, 20.0, 50.0]), degrees(&[4.0, 12.0]));
    let map = HeadingMap::of(&[study()], &courses, &slopes).expect("courses and slopes");
    for row in &map.rows {
        for attitude in row.cells.iter().flatten() {
            let base = given::traverse(attitude.slope, attitude.yaw);
            let numerics = Numerics { approach: Approach::QuasiSteady, ..base.numerics };
            let run = given::run(&Scenario { numerics, duration: 1.0, ..base });
            let way = run.last().state.position;
            let course = way.y.atan2(way.x);
            // In a second the yaw moment that a map leaves unbalanced turns the rover a little.
            assert!((course - row.course).abs() < deg(0.1), "{way}, not on {}", row.course);
            let slip = run.last().wheels[0].reaction.slip.ratio;
            // Hubs in front and behind move a little otherwise than the middle while it turns.
            assert!((slip - attitude.slip_ratio).abs() < 0.01, "{slip}: {attitude:?}");
        }
    }
    let found = map.rows.iter().flat_map(|row| row.cells.iter().flatten()).count();
    assert_eq!(found, 10);
}

/// Forces of the soil and the slope's pull cancel, whatever the course.
#[test]
fn forces_balance_in_every_cell() {
    let slopes: Vec<f64> = (0..=12).map(|step| deg(2.0 * f64::from(step))).collect();
    let courses: Vec<f64> = (-6..=6).map(|step| deg(15.0 * f64::from(step))).collect();
    let study = study();
    let map = HeadingMap::of(std::slice::from_ref(&study), &courses, &slopes)
        .expect("courses and slopes");
    let weight = study.rover.mass() * study.gravity;
    let mut found = 0;
    for row in &map.rows {
        for attitude in row.cells.iter().flatten() {
            let forces = attitude.wheels.iter().map(|wheel| wheel.settled.forces);
            let sum: Vec2 = forces.map(|f| Vec2::new(f.drawbar_pull, f.side_force)).sum();
            let (slope, yaw) = (attitude.slope, attitude.yaw);
            let pull = -weight * slope.sin() * Vec2::new(yaw.sin(), yaw.cos());
            // The correction ends at 1e-10 of the weight.
            assert!((sum + pull).norm() < 1e-9 * weight, "{sum} and {pull}");
            // The nose is uphill of the course.
            assert!(attitude.yaw >= row.course - 1e-9);
            found += 1;
        }
        // Up to where the curve ends there is an attitude on every slope, and none beyond.
        let (limit, _) = row.limit.as_ref().expect("it moves");
        for (slope, cell) in slopes.iter().zip(&row.cells) {
            assert_eq!(cell.is_ok(), slope <= limit, "{slope} of {limit}, course {}", row.course);
        }
    }
    assert!(found > 130, "{found}");
}

/// A slope that is climbed straight up is climbed by slip alone; straight down the wheels brake.
#[test]
fn straight_up_and_down_nothing_crabs() {
    let courses = degrees(&[-90.0, 90.0]);
    let map = HeadingMap::of(&[study()], &courses, &degrees(&[10.0])).expect("courses");
    let [down, up] = [0, 1].map(|row| map.rows[row].cells[0].as_ref().expect("it goes"));
    assert!((up.yaw - deg(90.0)).abs() < 1e-9 && (down.yaw + deg(90.0)).abs() < 1e-9);
    assert!(up.slip_ratio > 0.1 && down.slip_ratio < 0.0);
    let rover = given::hakuto();
    assert!(up.energy_per_metre(&rover) > 0.0 && down.energy_per_metre(&rover) < 0.0);
}

#[test]
fn the_same_map_has_the_same_bits_for_any_number_of_threads() {
    let soils = [study(), HeadingStudy { soil: given::simulant_2007(), ..study() }];
    let map = || {
        HeadingMap::of(&soils, &degrees(&[-30.0, 0.0, 30.0]), &degrees(&[5.0, 15.0])).expect("map")
    };
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let many = rayon::ThreadPoolBuilder::new().num_threads(4).build().expect("threads");
    assert_eq!(alone.install(map), many.install(map));
}

/// Continuation, not search: a curve with 25 slopes costs some wheels for each.
#[test]
fn a_curve_of_25_slopes_settles_a_thousand_wheels() {
    let slopes: Vec<f64> = (0..25).map(|step| deg(0.8 * f64::from(step))).collect();
    let map = HeadingMap::of(&[study()], &[0.0], &slopes).expect("courses and slopes");
    // Measured: about 1400; with a fresh Jacobian in every step it were three times as many.
    let settled = map.rows[0].settled_wheels;
    assert!(settled < 1500, "{settled}");
}
