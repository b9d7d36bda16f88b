//! Belly clearance: closed forms on planes, over crests and ripples, and runs that end on their
//! belly.

use grouser_core::paper;
use grouser_core::simulation::{Approach, Outcome, Run, RunError, Scenario, Trajectory};
use grouser_core::terrain::surface::{Incline, Ripple, Surface};
use grouser_core::terrain::{ElevationGrid, ElevationModel, Footprint, Ground, Patch, Terrain};
use grouser_core::units::{Vec2, deg};
use grouser_core::vehicle::{BellyPoint, Posture, Rover, Suspension, Underside};

/// Height of the underside over level hard ground [m].
const CLEARANCE: f64 = 0.10;

fn rover(clearance: f64) -> Rover {
    let mut rover = paper::hakuto().expect("it stands");
    rover.parts_mut().belly_clearance = Some(clearance);
    rover.checked().expect("it still does")
}

fn on(surface: Surface) -> Ground {
    Ground::formula(paper::toyoura(), surface)
}

/// How near the ground is to a rover that stands on it, its wheels sunk by as much each.
fn belly(rover: &Rover, ground: &Ground, (at, yaw): (Vec2, f64), sinkage: f64) -> BellyPoint {
    let ground = ground.clone().starting_at(at);
    let posture = Posture::of(rover, &ground, Vec2::zeros(), yaw, &[sinkage; 4]);
    let underside = Underside::of(rover).expect("its clearance is known");
    underside.nearest(&posture.expect("it comes to stand"), &ground)
}

/// On a plane it is what the document says less what the wheels sink, whatever the slope and the
/// yaw.
#[test]
fn on_a_plane_it_is_the_given_one_less_the_sinkage() {
    for (slope, yaw) in [(0.0, 0.0), (12.0, 33.0), (25.0, -70.0), (35.0, 90.0)] {
        let incline = on(Surface::Incline(Incline { slope: deg(slope), uphill: deg(50.0) }));
        for sinkage in [0.0, 0.013] {
            let place = (Vec2::new(3.0, -2.0), deg(yaw));
            let found = belly(&rover(CLEARANCE), &incline, place, sinkage);
            let off = found.clearance - (CLEARANCE - sinkage);
            assert!(off.abs() < 1e-12, "{slope}°, {yaw}°: {off:e}");
        }
    }
}

/// A ridge with a round crest between level ground, narrower than the rover is long: z = h (1 +
/// cos(2π x/w))/2.
struct Ridge {
    height: f64,
    width: f64,
}

impl Terrain for Ridge {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        let Self { height, width } = *self;
        let over = |place: Vec2| {
            let phase = std::f64::consts::TAU * place.x / width;
            if place.x.abs() < 0.5 * width { 0.5 * height * (1.0 + phase.cos()) } else { 0.0 }
        };
        footprint.fit(&footprint.points(at).map(over))
    }
}

const RIDGE: Ridge = Ridge { height: 0.04, width: 0.2 };

/// Astride a ridge that no wheel touches, the clearance is less by its height. The axles are 0.36 m
/// apart, the crest midway is below a point of the underside. One beside the points is missed by at
/// most its curvature times an eighth of their spacing squared.
#[test]
fn astride_a_ridge_it_is_less_by_the_ridge() {
    let Ridge { height, width } = RIDGE;
    let ridge = Ground::own(paper::toyoura(), RIDGE);
    let rover = rover(CLEARANCE);
    let middle = rover.mounts().iter().map(|mount| mount.position.x).sum::<f64>() / 4.0;
    let found = belly(&rover, &ridge, (Vec2::new(-middle, 5.0), 0.0), 0.0);
    // Ground without heights of its own has those of a tiny patch, rounded off by its curvature.
    let off = found.clearance - (CLEARANCE - height);
    assert!(off.abs() < 1e-6 && found.place.x.abs() < 1e-9, "{off:e} off at {}", found.place);

    let spacing = 0.36 / 8.0;
    let curvature = 0.5 * height * (std::f64::consts::TAU / width).powi(2);
    for share in [0.1, 0.3, 0.5] {
        let place = Vec2::new(share * spacing - middle, 5.0);
        let off = belly(&rover, &ridge, (place, 0.0), 0.0).clearance - (CLEARANCE - height);
        let most = curvature * spacing * spacing / 8.0;
        assert!(off > -1e-6 && off < most, "{off} of {most}");
    }
}

/// Astride a crest of long ripples both axles stand as high and as steep, mirrored: each wheel's
/// plane is the mean of its footprint, so that the hub's height is a closed form of the ripple's.
#[test]
fn astride_a_ripple_it_is_the_geometry_of_the_axles() {
    let (amplitude, wavelength) = (0.05, 1.2);
    // The crest is at x = 0.
    let phase = deg(90.0);
    let ripple = on(Surface::Ripple(Ripple { amplitude, wavelength, across: 0.0, phase }));
    for rover in [rover(CLEARANCE), {
        let rockers = Suspension { pivot: Vec2::new(0.01, 0.02), bogie: None };
        rover(CLEARANCE).on_rockers(rockers).expect("it has four wheels")
    }] {
        let mounts = rover.mounts();
        let (half, radius) = (0.18, mounts[0].shearing_radius());
        let middle = mounts.iter().map(|mount| mount.position.x).sum::<f64>() / 4.0;
        let found = belly(&rover, &ripple, (Vec2::new(-middle, 0.3), 0.0), 0.0);

        // The front wheel meets the ground at x: (hub − x)/r = sin of its plane's slope.
        let wave = std::f64::consts::TAU / wavelength;
        let reach = 0.5 * radius;
        let mut x: f64 = half;
        let (mut height, mut slope): (f64, f64) = (0.0, 0.0);
        for _ in 0..100 {
            // Means over the three rows of the footprint, at −reach, 0 and reach.
            height = amplitude * (wave * x).cos() * (1.0 + 2.0 * (wave * reach).cos()) / 3.0;
            slope = -amplitude * (wave * x).sin() * (wave * reach).sin() / reach;
            x = half + radius * slope.atan().sin();
        }
        let hub = height + radius * slope.atan().cos();
        let expected = hub - radius + CLEARANCE - amplitude;
        assert!(found.place.x.abs() < 1e-9, "{}", found.place);
        let off = found.clearance - expected;
        assert!(off.abs() < 1e-6 && expected < CLEARANCE - 0.01, "{off:e} off {expected}");
    }
}

/// A map far from the origin of its coordinates has the clearance of the same ground by a formula.
#[test]
fn on_a_map_it_is_that_of_the_ground() {
    let ripple = Ripple { amplitude: 0.05, wavelength: 1.2, across: deg(20.0), phase: 0.3 };
    let middle = Vec2::new(512_345.0, -2_100_020.0);
    let south_west = middle - Vec2::new(2.0, 2.0);
    let grid = ElevationGrid { columns: 201, rows: 201, south_west, spacing: Vec2::repeat(0.02) };
    let heights = grid.points().map(|at| -1800.0 + Surface::Ripple(ripple).height(at - middle));
    let map = ElevationModel::new(grid, heights).expect("a map");
    let map = Ground::map(paper::toyoura(), map);
    for at in [Vec2::zeros(), Vec2::new(0.4, -0.3)] {
        let formula = belly(&rover(CLEARANCE), &on(Surface::Ripple(ripple)), (at, 0.7), 0.01);
        let mapped = belly(&rover(CLEARANCE), &map, (middle + at, 0.7), 0.01);
        assert!((formula.clearance - mapped.clearance).abs() < 1e-5);
        assert!((middle + formula.place - mapped.place).norm() < 1e-5);
    }
}

/// Over ripples across the way, from a trough on.
fn over_ripples(amplitude: f64, clearance: Option<f64>, approach: Approach) -> Scenario {
    let mut scenario = paper::traverse().expect("it stands");
    let ripple = Ripple { amplitude, wavelength: 1.2, across: 0.0, phase: deg(-90.0) };
    scenario.ground = on(Surface::Ripple(ripple));
    if let Some(clearance) = clearance {
        scenario.rover = rover(clearance);
    }
    scenario.start.yaw = 0.0;
    scenario.duration = 20.0;
    scenario.numerics.approach = approach;
    scenario
}

fn drive(scenario: &Scenario) -> Result<Trajectory, RunError> {
    Run::new(scenario).and_then(Run::to_end)
}

/// A run ends at a crest between the axles of a rover with too little clearance; one with more
/// drives over it.
#[test]
fn a_rover_high_centres_on_a_crest() {
    let mut ends = Vec::new();
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let stuck = drive(&over_ripples(0.06, Some(0.03), approach)).expect("it drives up to it");
        let Outcome::HighCentred { time, place } = stuck.outcome else {
            panic!("{:?}", stuck.outcome);
        };
        assert_eq!(stuck.outcome.name(), "high_centred");
        let reason = stuck.outcome.reason().expect("a reason");
        assert!(reason.starts_with("its underside touches the ground at x = 0."), "{reason}");
        // The first crest, at 0.6 m, is between the axles, and the tilted underside comes down on
        // the way up to it.
        let last = stuck.last();
        assert!(last.time == time && (0.35..0.6).contains(&last.place().x), "{last:?}");
        assert!((0.4..0.6).contains(&place.x), "{place}");
        let clearances = stuck.records.iter().filter_map(|record| record.belly_clearance);
        let clearances: Vec<f64> = clearances.collect();
        assert_eq!(clearances.len(), stuck.records.len());
        let (touching, before) = clearances.split_last().expect("some");
        assert!(*touching <= 0.0 && *touching > -1e-3, "{touching}");
        assert!(before.iter().all(|clearance| *clearance > 0.0));
        ends.push(time);

        let over = drive(&over_ripples(0.06, Some(0.07), approach)).expect("it drives");
        assert_eq!(over.outcome, Outcome::Completed);
        let least = over.records.iter().filter_map(|record| record.belly_clearance);
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least > 0.03 && least < 0.04, "{least}");
        assert!(over.last().place().x > 0.8, "{}", over.last().place());
    }
    let [dynamic, steady] = ends[..] else { panic!("two ways") };
    assert!((dynamic - steady).abs() < 0.3, "{dynamic} and {steady}");
}

#[test]
fn a_start_on_the_belly_is_an_error() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut scenario = over_ripples(0.06, Some(0.03), approach);
        scenario.ground.start = Vec2::new(0.6, 0.0);
        let error = Run::new(&scenario).map(|_| ()).expect_err("it stands on a crest");
        let message = error.to_string();
        assert!(matches!(error, RunError::HighCentred { depth, .. } if depth > 0.0), "{message}");
        assert!(
            message.contains("where the rover starts its underside touches the ground at x = 0.6"),
            "{message}"
        );
    }
}

/// A rover that clears the ground drives as one of which nothing is known, bit for bit; the records
/// of that one, and those on a plane, have no clearance.
#[test]
fn a_clearance_that_suffices_changes_no_motion() {
    let without = drive(&over_ripples(0.04, None, Approach::QuasiSteady)).expect("it drives");
    assert!(without.records.iter().all(|record| record.belly_clearance.is_none()));
    let with = drive(&over_ripples(0.04, Some(0.2), Approach::QuasiSteady)).expect("it drives");
    assert_eq!(without.records.len(), with.records.len());
    for (one, other) in without.records.iter().zip(&with.records) {
        assert!(other.belly_clearance.is_some_and(|clearance| clearance > 0.1));
        assert_eq!((one.state, &one.wheels), (other.state, &other.wheels));
    }
    let mut plane = paper::traverse().expect("it stands");
    plane.duration = 1.0;
    let before = drive(&plane).expect("it drives");
    plane.rover = rover(0.001);
    assert_eq!(drive(&plane).expect("so it does"), before);
}

#[test]
fn a_negative_clearance_is_refused() {
    let mut rover = paper::hakuto().expect("it stands");
    rover.parts_mut().belly_clearance = Some(-0.1);
    let message = rover.checked().expect_err("it has none").to_string();
    assert_eq!(message, "belly clearance [m] is -0.1, it must be finite and not negative");
}
