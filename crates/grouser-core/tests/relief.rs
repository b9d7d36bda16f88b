//! Runs over uneven ground: a tilted plane is the plane, and both ways of computing agree.

#[path = "../examples/by_hand/hakuto.rs"]
mod hakuto;

use std::sync::Arc;

use grouser_core::simulation::{Approach, Landscape, PlacedTerrain, Run, Scenario, Trajectory};
use grouser_core::site::Site;
use grouser_core::terrain::surface::{AnalyticTerrain, Incline, Surface};
use grouser_core::units::{Vec2, deg};
use grouser_core::vehicle::Suspension;

fn level(scenario: &Scenario, ground: Landscape, start: Vec2) -> Scenario {
    let site = Site::plane(scenario.site.terrain.soil, 0.0, scenario.site.gravity);
    Scenario { site, terrain: Some(PlacedTerrain { ground, start }), ..scenario.clone() }
}

fn run(scenario: &Scenario) -> Trajectory {
    let started = std::time::Instant::now();
    let run = Run::new(scenario).and_then(Run::to_end).expect("it drives");
    eprintln!("{:?} {:?} {:?} {:?}", started.elapsed(), run.work, run.method, run.last().state);
    run
}

#[test]
fn a_tilted_plane_is_the_plane() {
    let mut plane = hakuto::traverse().expect("it stands");
    plane.start.yaw = deg(8.0);
    for rocker in [false, true] {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        plane.numerics.approach = approach;
        if rocker {
            plane.rover = plane.rover.on_rockers(Suspension { pivot: Vec2::new(0.01, 0.03), bogie: None }).expect("four");
        }
        let on_plane = run(&plane);
        for azimuth in [90.0, 217.0] {
            let uphill = deg(azimuth);
            let slope = plane.site.terrain.slope;
            let incline = Incline { slope, uphill };
            let ground = AnalyticTerrain { surface: Surface::Incline(incline), soil: plane.site.terrain.soil };
            let start = Vec2::new(0.0, 0.0);
            let mut scenario = level(&plane, Landscape::Analytic(Arc::new(ground)), start);
            // Yaw from the contour, along the plane, seen from above.
            let seen = |yaw: f64| (yaw.sin() * slope.cos()).atan2(yaw.cos()) + uphill - deg(90.0);
            scenario.start.yaw = seen(plane.start.yaw);
            let over = run(&scenario);
            let (one, other) = (on_plane.last(), over.last());
            // Along the contour, and up the plane.
            let (sin, cos) = (uphill - deg(90.0)).sin_cos();
            let way = other.state.position;
            let along = Vec2::new(way.x * cos + way.y * sin, (way.y * cos - way.x * sin) / slope.cos());
            let off = (along - one.state.position).norm() / one.state.position.norm();
            eprintln!("off {off:e}, yaw {:e}", seen(one.state.yaw) - other.state.yaw);
            eprintln!("{:?} {:?}", one.energy, other.energy);
        }
    }
    }
}

#[test]
fn noise() {
    let plane = hakuto::traverse().expect("it stands");
    let slope = plane.site.terrain.slope;
    let incline = Incline { slope, uphill: deg(90.0) };
    let ground = AnalyticTerrain { surface: Surface::Incline(incline), soil: plane.site.terrain.soil };
    let scenario = level(&plane, Landscape::Analytic(Arc::new(ground)), Vec2::zeros());
    let rims = [0.06; 4];
    let equations = grouser_core::simulation::equations::Equations::of(&scenario, &rims);
    let base = grouser_core::vehicle::RoverState { velocity: Vec2::new(0.0544, -0.0048), yaw: 0.1, position: Vec2::new(0.3, 0.1), ..Default::default() };
    let at = |dx: f64, dyaw: f64, dv: f64| {
        let mut s = base; s.position.x += dx; s.yaw += dyaw; s.velocity.x += dv;
        equations.rates(&s).expect("r").acceleration
    };
    let a0 = at(0.0, 0.0, 0.0);
    for k in 1..8 { let d = 1e-9 * f64::from(k); let a = at(d, 0.0, 0.0);
        eprintln!("dx {d:e}: {:e} {:e} {:e}", a.velocity_rate.x - a0.velocity_rate.x, a.velocity_rate.y - a0.velocity_rate.y, a.yaw_acceleration - a0.yaw_acceleration); }
    for k in 1..8 { let d = 1e-9 * f64::from(k); let a = at(0.0, d, 0.0);
        eprintln!("dyaw {d:e}: {:e} {:e} {:e}", a.velocity_rate.x - a0.velocity_rate.x, a.velocity_rate.y - a0.velocity_rate.y, a.yaw_acceleration - a0.yaw_acceleration); }
    for k in 1..8 { let d = 1e-9 * f64::from(k); let a = at(0.0, 0.0, d);
        eprintln!("dv {d:e}: {:e} {:e} {:e}", a.velocity_rate.x - a0.velocity_rate.x, a.velocity_rate.y - a0.velocity_rate.y, a.yaw_acceleration - a0.yaw_acceleration); }
}
