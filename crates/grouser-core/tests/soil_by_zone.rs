//! Runs over zones of soil, and over soil that scatters, on ground with heights.

use grouser_core::contact::discrepancy::sense_of_rolling;
use grouser_core::contact::{Contact, Slip};
use grouser_core::paper;
use grouser_core::simulation::{Approach, Method, Record, Run, Scenario, Trajectory};
use grouser_core::soil::discrepancy::{Discrepancy, VALUES};
use grouser_core::soil::{PressureSinkage, SinkageExponent, Soil};
use grouser_core::terrain::surface::{Incline, Surface};
use grouser_core::terrain::zones::NO_ZONE;
use grouser_core::terrain::{
    ElevationGrid, ElevationModel, Ground, SoilScatter, SoilZones, ZonePolygon,
};
use grouser_core::units::{Vec2, Vec3, deg};
use grouser_core::vehicle::{ByWheel, PerWheel, RoverState, Ruts};

/// Where the border of most of these maps is ahead of the start [m].
const BORDER: f64 = 0.4;

/// Looser than the scenario's sand.
fn loose() -> Soil {
    let exponent = SinkageExponent::constant(1.5);
    let pressure_sinkage = PressureSinkage::Reece { k_c: 0.0, k_phi: 20.0, exponent };
    Soil { friction_angle: deg(30.0), pressure_sinkage, ..paper::toyoura() }
}

/// The scenario on a slope given by heights, which rises to the left of the start.
fn on_slope(slope: f64, approach: Approach) -> Scenario {
    let mut scenario = paper::traverse().expect("it stands");
    let surface = Surface::Incline(Incline { slope, uphill: deg(90.0) });
    scenario.ground = Ground::formula(scenario.ground.soil, surface);
    scenario.numerics.approach = approach;
    scenario
}

fn with(mut scenario: Scenario, zones: SoilZones) -> Scenario {
    scenario.ground = scenario.ground.with_zones(zones);
    scenario
}

/// All beyond a line, turned from across the way, is of another soil.
fn beyond(turn: f64, soil: Soil) -> SoilZones {
    let (sin, cos) = turn.sin_cos();
    let corner = |x: f64, y: f64| Vec2::new(BORDER + cos * x - sin * y, sin * x + cos * y);
    let ring = vec![corner(0.0, -9.0), corner(9.0, -9.0), corner(9.0, 9.0), corner(0.0, 9.0)];
    let polygon = ZonePolygon { soil: Some(0), rings: vec![ring] };
    SoilZones::from_polygons(&[polygon], vec![soil]).expect("zones")
}

fn run(scenario: &Scenario) -> Trajectory {
    let run = Run::new(scenario).and_then(Run::to_end).expect("it drives");
    if scenario.numerics.approach == Approach::QuasiSteady {
        assert_eq!(run.method, Method::QuasiSteady);
    }
    run
}

const APPROACHES: [Approach; 2] = [Approach::Dynamic, Approach::QuasiSteady];

/// Zones of the scenario's own soil change no bit, nor do zones that the rover does not come to;
/// all that differs by wheel, by place and by passes counts as without them.
#[test]
fn zones_of_the_same_soil_change_no_bit() {
    for approach in APPROACHES {
        for (ruts, scatters) in [(Ruts::Fresh, false), (Ruts::Compacted, true)] {
            let mut plain = on_slope(deg(8.0), approach);
            plain.ruts = ruts;
            plain.duration = 6.0;
            if scatters {
                plain.scatter.soil.friction_angle = deg(1.0);
                let friction_angle = PerWheel::Each(vec![deg(-1.0), 0.0, 0.0, deg(1.0)]);
                plain.by_wheel = ByWheel { friction_angle, ..ByWheel::ALIKE };
            }
            let nowhere = SoilZones::from_polygons(&[], Vec::new()).expect("zones");
            let without = run(&with(plain.clone(), nowhere)).records;
            let soil = plain.ground.soil;
            let [low, high] = [Vec2::new(-5.0, -5.0), Vec2::new(5.0, 5.0)];
            let ring = vec![low, Vec2::new(5.0, -5.0), high, Vec2::new(-5.0, 5.0)];
            let everywhere = ZonePolygon { soil: Some(0), rings: vec![ring] };
            let same = SoilZones::from_polygons(&[everywhere], vec![soil]).expect("zones");
            assert!(run(&with(plain.clone(), same)).records == without);
            // A quasi-steady run takes shorter strides over zones.
            if approach == Approach::Dynamic {
                assert!(run(&plain).records == without);
            }
            let loose = with(plain.clone(), beyond(0.0, loose()));
            assert!(run(&loose).records != without);
        }
    }
}

/// A wheel before the border has the reaction on the one soil, a wheel behind it that on the other,
/// and between them each has one between both.
#[test]
fn a_border_that_is_crossed_has_the_soils_limits_on_either_side() {
    for approach in APPROACHES {
        let plain = on_slope(0.0, approach);
        let mut on_loose = plain.clone();
        on_loose.ground.soil = loose();
        let [hard, soft] = [&plain, &on_loose].map(|scenario| run(scenario).last().clone());
        let sinkage = |record: &Record, wheel: usize| record.wheels[wheel].reaction.settled.sinkage;
        let crossing = run(&with(plain.clone(), beyond(0.0, loose())));
        let reach = 0.5 * plain.rover.mounts()[0].shearing_radius();
        let mut seen = [0; 3];
        for record in &crossing.records {
            let x = record.state.position.x;
            for (wheel, mount) in plain.rover.mounts().iter().enumerate() {
                let passed = (x + mount.position.x - BORDER) / reach;
                let [low, high] = [sinkage(&hard, wheel), sinkage(&soft, wheel)];
                let here = sinkage(record, wheel);
                // Other wheels' thrust changes the slip, and that the sinkage, by a few hundredths.
                if passed < -1.0 {
                    assert!((here / low - 1.0).abs() < 0.15, "{here} and {low}");
                    seen[0] += 1;
                } else if passed > 1.0 {
                    assert!((here / high - 1.0).abs() < 0.15, "{here} and {high}");
                    seen[2] += 1;
                } else {
                    assert!((0.9 * low..1.1 * high).contains(&here), "{low} {here} {high}");
                    seen[1] += 1;
                }
            }
        }
        assert!(high_enough(&hard, &soft) && seen.iter().all(|count| *count > 5), "{seen:?}");
        // When all wheels are on the other soil, they are as if there never was a border.
        let last = crossing.last();
        for wheel in 0..4 {
            let [here, there] = [last, &soft].map(|record| record.wheels[wheel].reaction);
            assert!((here.slip.ratio - there.slip.ratio).abs() < 1e-5, "{here:?} and {there:?}");
            assert!((here.settled.sinkage / there.settled.sinkage - 1.0).abs() < 1e-5);
        }
    }
}

/// The soils differ by more than what is allowed for the wheels' influence on each other.
fn high_enough(hard: &Record, soft: &Record) -> bool {
    let sinkage = |record: &Record| record.wheels[0].reaction.settled.sinkage;
    sinkage(soft) > 1.5 * sinkage(hard)
}

/// Half-way over a border a wheel has the mean of both soils' forces at its sinkage, and half of
/// what a model gets wrong in one of them.
#[test]
fn a_wheel_on_two_soils_has_the_mean_of_their_forces() {
    let plain = on_slope(0.0, Approach::Dynamic);
    let own = plain.ground.soil;
    let wrong = Discrepancy { drawbar_pull: [0.1; VALUES], ..Discrepancy::NONE };
    for discrepancy in [None, Some(wrong)] {
        let other = Soil { discrepancy, ..loose() };
        let scenario = with(plain.clone(), beyond(0.0, other));
        let ground = scenario.on_ground();
        let front = &scenario.rover.mounts()[0];
        let position = Vec2::new(BORDER - front.position.x, 0.0);
        let state = RoverState { position, ..RoverState::default() };
        let posture = ground.standing_posture(&state).expect("it stands");
        let slip = Slip::on_test_stand(0.2, deg(10.0));
        let wheels = ground.reactions_standing(&posture, Vec3::z(), &[slip; 4], &[]);
        let settled = wheels.expect("they settle")[0].settled;
        let alone = |soil: Soil| {
            let soil = Soil { discrepancy: None, ..soil };
            let gravity = scenario.gravity;
            let contact = Contact { wheel: front.unit.wheel, soil, slip, gravity };
            ground.model.forces(&contact, settled.sinkage)
        };
        let (one, two) = (alone(own), alone(other));
        let more = discrepancy.map_or(0.0, |_| 0.5 * 0.1 * settled.forces.normal_force);
        let near = |found: f64, one: f64, two: f64| (found - 0.5 * (one + two)).abs() < 1e-9;
        let found = settled.forces;
        assert!(near(found.normal_force, one.normal_force, two.normal_force));
        let pull = found.drawbar_pull - sense_of_rolling(&slip) * more;
        assert!(near(pull, one.drawbar_pull, two.drawbar_pull));
        assert!(near(found.torque, one.torque, two.torque), "{found:?}");
        assert!((one.normal_force - two.normal_force).abs() > 1.0);
    }
}

/// Over borders at angles, quasi-steady and dynamic runs lead to the same place, for a fraction of
/// the work.
#[test]
fn both_ways_agree_over_borders() {
    for (turn, slope) in [(0.0, 8.0), (20.0, 0.0), (25.0, 8.0), (-60.0, 5.0)] {
        let [dynamic, steady] = APPROACHES
            .map(|approach| run(&with(on_slope(deg(slope), approach), beyond(deg(turn), loose()))));
        let (one, other) = (dynamic.last().state, steady.last().state);
        let off = (one.position - other.position).norm();
        assert!(off < 2e-4 * one.position.norm(), "{turn}°: {off:e} m off");
        assert!((one.yaw - other.yaw).abs() < deg(0.02), "{turn}°: {one:?} and {other:?}");
        assert!(steady.work.evaluations * 5 < dynamic.work.evaluations, "{:?}", steady.work);
    }
}

/// Map, zones, start and yaw turned and moved together give the same run; the map is of heights at
/// points.
#[test]
fn a_turned_and_moved_map_of_zones_gives_the_same_run() {
    for approach in APPROACHES {
        let end = |turn: f64, middle: Vec2| {
            let (sin, cos) = turn.sin_cos();
            let turned =
                |at: Vec2| middle + Vec2::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y);
            let mut scenario = on_slope(0.0, approach);
            let soil = scenario.ground.soil;
            let grid = ElevationGrid {
                columns: 21,
                rows: 21,
                south_west: middle - Vec2::new(5.0, 5.0),
                spacing: Vec2::new(0.5, 0.5),
            };
            let model = ElevationModel::new(grid, vec![-1200.0; 441]).expect("a map");
            let ring = [(0.3, -1.0), (0.7, -0.6), (0.8, 2.0), (0.35, 0.9)];
            let ring = ring.map(|(x, y)| turned(Vec2::new(x, y))).to_vec();
            let polygon = ZonePolygon { soil: Some(0), rings: vec![ring] };
            let soils = SoilZones::from_polygons(&[polygon], vec![loose()]).expect("zones");
            scenario.ground = Ground::map(soil, model).starting_at(middle).with_zones(soils);
            scenario.start.yaw = turn;
            let state = run(&scenario).last().state;
            (turned(Vec2::zeros()) - middle, cos, sin, state)
        };
        let (_, _, _, one) = end(0.0, Vec2::zeros());
        for (turn, middle) in
            [(deg(37.0), Vec2::zeros()), (deg(-120.0), Vec2::new(512_345.0, -99_000.5))]
        {
            let (_, cos, sin, other) = end(turn, middle);
            let at = other.position;
            let back = Vec2::new(cos * at.x + sin * at.y, cos * at.y - sin * at.x);
            assert!((back - one.position).norm() < 1e-6, "{back} and {}", one.position);
            assert!((other.yaw - turn - one.yaw).abs() < 1e-6);
        }
    }
}

/// Zones by cells of a grid are those of their outlines.
#[test]
fn polygons_and_the_raster_of_them_give_the_same_run() {
    let plain = on_slope(deg(5.0), Approach::Dynamic);
    let [low, high] = [Vec2::new(0.45, -0.5), Vec2::new(0.85, 0.1)];
    let ring = vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
    let polygon = ZonePolygon { soil: Some(0), rings: vec![ring] };
    let by_polygons = SoilZones::from_polygons(&[polygon], vec![loose()]).expect("zones");
    let south_west = Vec2::new(-0.5, -1.0) + Vec2::new(0.025, 0.025);
    let grid = ElevationGrid { columns: 60, rows: 40, south_west, spacing: Vec2::new(0.05, 0.05) };
    let number = |at| by_polygons.zone(at).map_or(NO_ZONE, |_| 0);
    let by_grid = SoilZones::from_grid(grid, grid.points().map(number).collect(), vec![loose()]);
    let [one, other] =
        [by_polygons, by_grid.expect("zones")].map(|zones| run(&with(plain.clone(), zones)));
    let without = run(&plain).last().state;
    let (one, other) = (one.last().state, other.last().state);
    assert!((one.position - other.position).norm() < 1e-6, "{one:?} and {other:?}");
    assert!((one.position - without.position).norm() > 1e-3);
}

/// Soil that scatters from place to place does so on ground with heights, in both ways of
/// computing.
#[test]
fn soil_scatters_on_ground_with_heights() {
    let soil = SoilScatter { friction_angle: deg(1.0), stiffness: 0.1, correlation_length: 0.3 };
    let end = |approach: Approach, seed: u64, slope: f64| {
        let mut scenario = on_slope(deg(slope), approach);
        scenario.scatter.soil = soil;
        scenario.scatter.seed = seed;
        run(&scenario).last().state
    };
    let [dynamic, steady] = APPROACHES.map(|approach| end(approach, 1, 6.0));
    let off = (dynamic.position - steady.position).norm();
    assert!(off < 1e-3 * dynamic.position.norm(), "{off:e} m off");
    assert!((dynamic.yaw - steady.yaw).abs() < deg(0.1), "{dynamic:?} and {steady:?}");
    assert!((end(Approach::QuasiSteady, 2, 6.0).yaw - steady.yaw).abs() > deg(0.1));
    // On level ground it is the field that a plane has.
    let mut plane = paper::traverse().expect("it stands");
    plane.ground = plane.ground.with_slope(0.0);
    plane.scatter.soil = soil;
    plane.scatter.seed = 1;
    let on_plane = run(&plane).last().state;
    let level = end(Approach::Dynamic, 1, 0.0);
    assert!((level.position - on_plane.position).norm() < 1e-6, "{level:?} and {on_plane:?}");
}
