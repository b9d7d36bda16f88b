//! The rover as a rigid body: momentum, the balance of its wheels, and when it tips.

use std::f64::consts::{FRAC_PI_2, PI};

use grouser::contact::WheelForces;
use grouser::terrain::{Ground, Patch, Plane, Terrain};
use grouser::units::{EARTH_GRAVITY, Vec2, Vec3, deg};
use grouser::vehicle::load::wheel_loads;
use grouser::vehicle::{
    Acceleration, Body, Inertia, LoadSharing, Mount, OwnMoments, Rover, RoverState, WheelUnit,
    dynamics, load,
};
use nalgebra::{Matrix3, Rotation2, Vector3};
use proptest::prelude::*;

use super::given::{self, cases};

/// A rover with most of its mass in wheels that stand far off to one side of its body.
fn lopsided() -> Rover {
    let inertia = Inertia { xx: 0.1, yy: 0.1, zz: 0.1 };
    let hubs = [(1.0, 0.3), (1.5, 2.0), (0.4, 1.6), (2.0, 1.0)];
    let unit = WheelUnit { mass: 2.0, inertia, wheel: given::hakuto_wheel(), motor: None };
    let mounts = hubs.iter().map(|&(x, y)| Mount {
        name: format!("at {x}, {y}"),
        position: Vec3::new(x, y, -0.1),
        unit,
        steering: 0.0,
        steering_axis: None,
        joint: None,
    });
    Rover::new(Body { mass: 1.0, inertia }, mounts.collect()).expect("it stands")
}

fn plane(slope: f64) -> Ground {
    Ground::plane(given::toyoura(), slope)
}

fn at_yaw(yaw: f64) -> RoverState {
    RoverState { yaw, ..RoverState::default() }
}

fn wheel_force(x: f64, y: f64, aligning_moment: f64) -> WheelForces {
    WheelForces { drawbar_pull: x, side_force: y, aligning_moment, ..WheelForces::default() }
}

// ---- momentum ----

/// Momentum [kg·m/s], angular momentum about the origin [kg·m²/s] and energy [J] in the slope
/// frame, summed over the parts as if each flew by itself.
fn motion_of_the_parts(rover: &Rover, state: &RoverState) -> (Vec2, f64, f64) {
    let body = (rover.body().mass, rover.body().inertia.zz, Vec2::zeros());
    let unit = rover.mounts()[0].unit;
    let wheels = rover.mounts().iter().map(|m| (unit.mass, unit.inertia.zz, m.position.xy()));
    let slope_from_body = Rotation2::new(state.yaw);
    let (mut momentum, mut angular, mut energy) = (Vec2::zeros(), 0.0, 0.0);
    for (mass, inertia, arm) in wheels.chain([body]) {
        let arm = slope_from_body * arm;
        let around = state.yaw_rate * Vec2::new(-arm.y, arm.x);
        let velocity = slope_from_body * state.velocity + around;
        momentum += mass * velocity;
        angular += (state.position + arm).perp(&(mass * velocity)) + inertia * state.yaw_rate;
        energy += 0.5 * mass * velocity.norm_squared() + 0.5 * inertia * state.yaw_rate.powi(2);
    }
    (momentum, angular, energy)
}

/// The state after a time, by the classical Runge-Kutta method with steps of a millisecond.
fn flown(
    start: &RoverState,
    duration: f64,
    acceleration: impl Fn(&RoverState) -> Acceleration,
) -> RoverState {
    const STEP: f64 = 1e-3;
    type Rates = (Vec2, f64, Vec2, f64);
    let rates = |state: &RoverState| -> Rates {
        let Acceleration { velocity_rate, yaw_acceleration } = acceleration(state);
        (state.velocity_slope(), state.yaw_rate, velocity_rate, yaw_acceleration)
    };
    let moved = |state: &RoverState, rates: &Rates, span: f64| RoverState {
        position: state.position + rates.0 * span,
        yaw: state.yaw + rates.1 * span,
        velocity: state.velocity + rates.2 * span,
        yaw_rate: state.yaw_rate + rates.3 * span,
    };
    let mut state = *start;
    let mut time = 0.0;
    while time < duration {
        let k_1 = rates(&state);
        let k_2 = rates(&moved(&state, &k_1, STEP / 2.0));
        let k_3 = rates(&moved(&state, &k_2, STEP / 2.0));
        let k_4 = rates(&moved(&state, &k_3, STEP));
        for (k, weight) in [(k_1, 1.0), (k_2, 2.0), (k_3, 2.0), (k_4, 1.0)] {
            state = moved(&state, &k, weight * STEP / 6.0);
        }
        time += STEP;
    }
    state
}

const TUMBLING: RoverState = RoverState {
    position: Vec2::new(0.3, -0.2),
    yaw: 0.4,
    velocity: Vec2::new(0.5, -0.8),
    yaw_rate: 2.0,
};

/// Change of momentum, angular momentum and energy after some time [s], over their sizes [-].
fn lost_in_flight(duration: f64, acceleration: impl Fn(&RoverState) -> Acceleration) -> [f64; 3] {
    let rover = lopsided();
    let (momentum, angular, energy) = motion_of_the_parts(&rover, &TUMBLING);
    let after = flown(&TUMBLING, duration, acceleration);
    let (later, later_angular, later_energy) = motion_of_the_parts(&rover, &after);
    [
        (later - momentum).norm() / momentum.norm(),
        (later_angular - angular).abs() / angular.abs(),
        (later_energy - energy).abs() / energy,
    ]
}

fn without_forces(state: &RoverState) -> Acceleration {
    let rover = lopsided();
    let wheels = vec![WheelForces::default(); rover.wheel_count()];
    let soil = dynamics::soil_resultant(&rover, &wheels, OwnMoments::Included);
    dynamics::acceleration(&rover, Vec2::zeros(), state, soil)
}

/// A rover that nothing touches keeps momentum, angular momentum and energy, with its centre of
/// mass 1.5 m off the point that its equations are written about.
#[test]
fn a_force_free_rover_keeps_its_momentum() {
    let lost = lost_in_flight(3.0, without_forces);
    // Six radians of turning in steps of two thousandths leave 1e-11 to the fourth order.
    assert!(lost.iter().all(|lost| *lost < 1e-9), "{lost:?}");
}

/// Signs of the two first moments and of the centrifugal term along x, as a source prints them.
#[derive(Clone, Copy, Debug)]
struct Signs {
    /// Sign of d_x sin γ in M[1,3].
    first: f64,
    /// Sign of the whole M[1,3].
    outer: f64,
    /// Sign of d_y sin γ in M[2,3].
    second: f64,
    /// Sign of d_y sin γ in the centrifugal force along x.
    centrifugal: f64,
}

/// [FourWheel], Eqs 5-10, without forces: the mass matrix and the centrifugal terms in the slope
/// frame.
fn printed_equations(state: &RoverState, signs: Signs) -> Acceleration {
    let rover = lopsided();
    let (m, s, i) = (rover.mass(), rover.first_moment(), rover.yaw_inertia());
    let (sin, cos) = state.yaw.sin_cos();
    let i_xz = signs.outer * (s.y * cos + signs.first * s.x * sin);
    let i_yz = signs.second * s.y * sin + s.x * cos;
    let mass_matrix = Matrix3::new(m, 0.0, i_xz, 0.0, m, i_yz, i_xz, i_yz, i);
    let rate = state.yaw_rate;
    let force = rate
        * rate
        * Vector3::new(s.x * cos + signs.centrifugal * s.y * sin, s.x * sin + s.y * cos, 0.0);
    let solved = mass_matrix.lu().solve(&force).expect("an invertible mass matrix");
    // Into the turning body frame, in which the velocities are kept.
    let in_slope = Rotation2::new(-state.yaw) * solved.xy();
    let v = state.velocity;
    let velocity_rate = in_slope - rate * Vec2::new(-v.y, v.x);
    Acceleration { velocity_rate, yaw_acceleration: solved.z }
}

/// Source: theory, section 9, Eqs 5 and 7-9.
const CORRECTED: Signs = Signs { first: 1.0, outer: -1.0, second: -1.0, centrifugal: -1.0 };

/// The test above would have found each sign that the source has wrong.
/// DIFFERENCE: [FourWheel], Eqs 5, 8 and 9 print the other sign in three places.
#[test]
fn each_sign_that_the_source_prints_wrong_loses_momentum() {
    let lost = |duration, signs| lost_in_flight(duration, |state| printed_equations(state, signs));
    let corrected = lost(3.0, CORRECTED);
    assert!(corrected.iter().all(|lost| *lost < 1e-9), "{corrected:?}");
    for printed in [
        Signs { outer: 1.0, ..CORRECTED },
        Signs { second: 1.0, ..CORRECTED },
        Signs { centrifugal: 1.0, ..CORRECTED },
        Signs { first: 1.0, outer: 1.0, second: 1.0, centrifugal: 1.0 },
    ] {
        // A fifth of a second: with all of them wrong the mass matrix soon has no inverse.
        let lost = lost(0.2, printed);
        assert!(lost[0] > 0.1 || lost[0].is_nan(), "{printed:?} loses only {lost:?}");
    }
}

/// The rover of the paper would not have shown it: its centre of mass is 2.4 mm off.
/// Source: theory, section 9: "replica tests will not detect the sign error".
#[test]
fn the_papers_rover_has_a_first_moment_of_17_gram_metres() {
    let moment = given::hakuto().first_moment();
    assert!((moment.x - 0.422 * 0.04).abs() < 1e-15 && moment.y.abs() < 1e-15);
}

// ---- equations of motion ----

fn any_rover() -> impl Strategy<Value = Rover> {
    let hub = (-1.0..1.0, -1.0..1.0);
    let hubs = proptest::collection::vec(hub, 3..=8);
    (hubs, given::log_range(0.1, 100.0), given::log_range(0.05, 50.0), 0.01..10.0).prop_filter_map(
        "the wheels stand in a line",
        |(hubs, body_mass, wheel_mass, inertia)| {
            let inertia = Inertia { xx: inertia, yy: inertia, zz: inertia };
            let unit =
                WheelUnit { mass: wheel_mass, inertia, wheel: given::hakuto_wheel(), motor: None };
            let mounts = hubs.iter().enumerate().map(|(number, &(x, y))| Mount {
                name: number.to_string(),
                position: Vec3::new(x, y, -0.1),
                unit,
                steering: 0.0,
                steering_axis: None,
                joint: None,
            });
            let body = Body { mass: body_mass, inertia };
            Rover::new(body, mounts.collect()).ok()
        },
    )
}

fn any_state() -> impl Strategy<Value = RoverState> {
    (-PI..PI, (-2.0..2.0, -2.0..2.0), -3.0..3.0).prop_map(|(yaw, (u, v), yaw_rate)| RoverState {
        yaw,
        velocity: Vec2::new(u, v),
        yaw_rate,
        ..RoverState::default()
    })
}

/// Newton and Euler about the common centre of mass, in the slope frame, then back to the body's.
fn by_the_common_centre(
    rover: &Rover,
    slope: f64,
    state: &RoverState,
    wheels: &[WheelForces],
) -> Acceleration {
    let turned = |vector: Vec2| Rotation2::new(state.yaw) * vector;
    let quarter = |vector: Vec2| Vec2::new(-vector.y, vector.x);
    let unit = rover.mounts()[0].unit;
    let hubs: Vec<Vec2> = rover.mounts().iter().map(|m| m.position.xy()).collect();
    let mass = rover.body().mass + unit.mass * hubs.len() as f64;
    let centre: Vec2 = hubs.iter().map(|hub| unit.mass / mass * hub).sum();
    let inertia: f64 = rover.body().inertia.zz
        + rover.body().mass * centre.norm_squared()
        + hubs
            .iter()
            .map(|hub| unit.inertia.zz + unit.mass * (hub - centre).norm_squared())
            .sum::<f64>();
    let weight = Vec2::new(0.0, -mass * EARTH_GRAVITY * slope.sin());
    let mut force = weight;
    let mut moment = 0.0;
    for (hub, wheel) in hubs.iter().zip(wheels) {
        let wheel_force = turned(Vec2::new(wheel.drawbar_pull, wheel.side_force));
        force += wheel_force;
        moment += turned(hub - centre).perp(&wheel_force) + wheel.aligning_moment;
    }
    let yaw_acceleration = moment / inertia;
    // The body's centre, seen from the common one, turns with the rover.
    let arm = turned(-centre);
    let body_centre = force / mass + yaw_acceleration * quarter(arm) - state.yaw_rate.powi(2) * arm;
    let in_body = Rotation2::new(-state.yaw) * body_centre;
    Acceleration {
        velocity_rate: in_body - state.yaw_rate * quarter(state.velocity),
        yaw_acceleration,
    }
}

proptest! {
    #![proptest_config(cases(500))]

    /// Two derivations, one acceleration.
    #[test]
    fn newton_and_euler_about_the_common_centre_of_mass_agree(
        rover in any_rover(), state in any_state(), slope in 0.0..1.0,
        forces in proptest::collection::vec((-50.0..50.0, -50.0..50.0, -5.0..5.0), 8),
    ) {
        let wheels: Vec<WheelForces> = forces[..rover.wheel_count()]
            .iter()
            .map(|&(x, y, moment)| wheel_force(x, y, moment))
            .collect();
        let pull = load::slope_pull(&rover, &plane(slope), EARTH_GRAVITY, &state);
        let soil = dynamics::soil_resultant(&rover, &wheels, OwnMoments::Included);
        let ours = dynamics::acceleration(&rover, pull, &state, soil);
        let theirs = by_the_common_centre(&rover, slope, &state, &wheels);
        let size = theirs.velocity_rate.norm() + theirs.yaw_acceleration.abs() + 1.0;
        // Rounding of a 3 by 3 solution; light bodies with far wheels are the worst conditioned.
        prop_assert!((ours.velocity_rate - theirs.velocity_rate).norm() < 1e-9 * size);
        prop_assert!((ours.yaw_acceleration - theirs.yaw_acceleration).abs() < 1e-9 * size);
    }

    /// Source: [FourWheel], Eqs 12-14. DIFFERENCE: they print no signs; the weight points downhill,
    /// so it pulls a rover backward whose nose is uphill (γ > 0), and always to the right of a
    /// rover that drives along +x.
    #[test]
    fn the_weight_pulls_downhill_whatever_the_yaw(yaw in -PI..PI, slope in 0.0..1.5) {
        let (rover, ground) = (given::hakuto(), plane(slope));
        let weight = rover.mass() * EARTH_GRAVITY;
        let pull = load::slope_pull(&rover, &ground, EARTH_GRAVITY, &at_yaw(yaw));
        prop_assert!((pull.x + weight * slope.sin() * yaw.sin()).abs() < 1e-12 * weight);
        prop_assert!((pull.y + weight * slope.sin() * yaw.cos()).abs() < 1e-12 * weight);
        let in_slope = Rotation2::new(yaw) * pull;
        prop_assert!((in_slope - Vec2::new(0.0, -weight * slope.sin())).norm() < 1e-12 * weight);
    }
}

/// The aligning moments of the wheels turn the rover only where they are told to.
#[test]
fn own_moments_turn_the_rover_only_if_they_are_included() {
    let rover = given::hakuto();
    let wheels = vec![wheel_force(0.0, 0.0, 0.1); 4];
    let turning = |own_moments| {
        let state = RoverState::default();
        let soil = dynamics::soil_resultant(&rover, &wheels, own_moments);
        dynamics::acceleration(&rover, Vec2::zeros(), &state, soil).yaw_acceleration
    };
    assert_eq!(turning(OwnMoments::Neglected), 0.0);
    // 0.4 N·m about the common centre, where the inertia is I − m c².
    let inertia = rover.yaw_inertia() - rover.mass() * rover.centre_of_mass().norm_squared();
    assert!((turning(OwnMoments::Included) - 0.4 / inertia).abs() < 1e-12);
}

// ---- loads ----

/// Checks that no load is negative, and that loads carry the weight and balance the moments about
/// the centre of mass.
fn check_balance(
    rover: &Rover,
    loads: &[f64],
    weight: f64,
    moments: Vec2,
) -> Result<(), TestCaseError> {
    let centre = rover.centre_of_mass();
    let sum: f64 = loads.iter().sum();
    let arms = rover.mounts().iter().map(|mount| mount.position.xy() - centre);
    let balance: Vec2 = arms.zip(loads).map(|(arm, load)| arm * *load).sum();
    // Damped Newton steps on a function with corners, where wheels have lifted: to 1e-8.
    prop_assert!((sum - weight).abs() < 1e-7 * weight, "{loads:?} carry {sum} of {weight}");
    prop_assert!((balance - moments).norm() < 1e-7 * weight * 2.0, "{balance} for {moments}");
    prop_assert!(loads.iter().all(|load| *load >= 0.0), "{loads:?}");
    Ok(())
}

proptest! {
    #![proptest_config(cases(1000))]

    /// Three to eight wheels anywhere, the weight's foot anywhere among them: some may have lifted.
    #[test]
    fn loads_balance_the_weight_on_any_number_of_wheels(
        rover in any_rover(), shares in proptest::collection::vec(0.0..1.0, 8),
    ) {
        let weight = 50.0;
        let arms = rover.load_arms();
        let total: f64 = shares[..arms.len()].iter().sum();
        prop_assume!(total > 0.1);
        let foot: Vec2 = arms.iter().zip(&shares).map(|(arm, share)| arm * (*share / total)).sum();
        prop_assume!(rover.support_polygon().margin(foot) > 1e-6);
        let moments = foot * weight;
        let loads = wheel_loads(&rover, LoadSharing::QuasiStatic, weight, moments);
        let loads = loads.map_err(|_| TestCaseError::fail("it stands, but is said to tip"))?;
        check_balance(&rover, &loads, weight, moments)?;
        // Of all loads that balance, those of equal springs have the least sum of squares; the ones
        // that the foot was made of are others.
        let squares = |loads: &mut dyn Iterator<Item = f64>| loads.map(|n| n * n).sum::<f64>();
        let least = squares(&mut loads.iter().copied());
        let other = squares(&mut shares[..arms.len()].iter().map(|share| share / total * weight));
        prop_assert!(least <= other * (1.0 + 1e-6), "{least} > {other}");
    }

    #[test]
    fn equal_loads_are_equal(rover in any_rover()) {
        // Equal loads need no balance, but a rover that would tip still does.
        prop_assume!(rover.support_polygon().margin(Vec2::zeros()) > 0.0);
        let loads = wheel_loads(&rover, LoadSharing::Uniform, 30.0, Vec2::zeros());
        let count = rover.wheel_count();
        prop_assert_eq!(loads, Ok(vec![30.0 / count as f64; count]));
    }

    /// Source: theory, section 4.3: the symmetric short form, where the centre is midway.
    #[test]
    fn a_symmetric_rover_has_the_textbook_loads(yaw in -PI..PI, slope in 0.0..0.4) {
        let (half_base, half_track) = (0.2, 0.25);
        let hubs = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let hubs = hubs.map(|(x, y)| (half_base * x, half_track * y));
        let rover = given::rover_on(given::hakuto_wheel(), &hubs);
        let weight = rover.mass() * EARTH_GRAVITY;
        let loads = quasi_static_loads(&rover, slope, yaw).expect("it stands");
        let height = rover.centre_height();
        for ((x, y), load) in hubs.into_iter().zip(loads) {
            let roll = slope.sin() * yaw.cos() * height / half_track * y.signum();
            let pitch = slope.sin() * yaw.sin() * height / half_base * x.signum();
            let expected = weight / 4.0 * (slope.cos() - roll - pitch);
            prop_assert!((load - expected).abs() < 1e-9 * weight, "{load} N, not {expected} N");
        }
    }
}

/// Loads of a rover that stands on a slope.
fn quasi_static_loads(rover: &Rover, slope: f64, yaw: f64) -> Result<Vec<f64>, load::Tipping> {
    let sharing = LoadSharing::QuasiStatic;
    let moments = load::moments(
        rover,
        load::slope_pull(rover, &plane(slope), EARTH_GRAVITY, &at_yaw(yaw)),
        sharing,
        OwnMoments::Neglected,
        &[],
    );
    wheel_loads(rover, sharing, rover.mass() * EARTH_GRAVITY * slope.cos(), moments)
}

/// On 50° with its nose turned 30° uphill the paper's rover still stands, on three wheels.
#[test]
fn a_wheel_lifts_before_the_rover_tips() {
    let (rover, slope, yaw) = (given::hakuto(), deg(50.0), deg(30.0));
    let loads = quasi_static_loads(&rover, slope, yaw).expect("it stands");
    // Front left is the uphill corner.
    assert_eq!(loads[0], 0.0);
    assert!(loads[1..].iter().all(|load| *load > 0.0), "{loads:?}");
    let weight = rover.mass() * EARTH_GRAVITY * slope.cos();
    let pull = load::slope_pull(&rover, &plane(slope), EARTH_GRAVITY, &at_yaw(yaw));
    let moments = rover.centre_height() * pull;
    check_balance(&rover, &loads, weight, moments).expect("they balance");
}

/// The slope on which a rover tips, by halving; −π/2 points its right side downhill.
fn tipping_slope(rover: &Rover, yaw: f64) -> f64 {
    let (mut stands, mut tips) = (0.0, FRAC_PI_2 - 1e-9);
    while tips - stands > 1e-10 {
        let slope = 0.5 * (stands + tips);
        if quasi_static_loads(rover, slope, yaw).is_ok() {
            stands = slope;
        } else {
            tips = slope;
        }
    }
    stands
}

proptest! {
    #![proptest_config(cases(200))]

    /// A rover on a rectangle of wheels tips where the vertical through its centre of mass leaves
    /// it: tan α = (way to the edge, downhill) / height.
    #[test]
    fn a_rover_tips_where_geometry_says(yaw in -PI..PI) {
        let rover = given::hakuto();
        let centre = rover.centre_of_mass();
        let (downhill_x, downhill_y) = (-yaw.sin(), -yaw.cos());
        let edge_x = if downhill_x > 0.0 { 0.19 - centre.x } else { 0.17 + centre.x };
        let way = (edge_x / downhill_x.abs()).min(0.24 / downhill_y.abs());
        let expected = (way / rover.centre_height()).atan();
        let found = tipping_slope(&rover, yaw);
        // Within a nanometre of the edge a wheel line counts as carrying.
        prop_assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
    }
}

/// Straight across the slope: half the track over the height of the centre of mass.
#[test]
fn the_papers_rover_tips_at_57_degrees() {
    let slope = tipping_slope(&given::hakuto(), 0.0).to_degrees();
    assert!((slope - (0.24_f64 / 0.1554).atan().to_degrees()).abs() < 0.01, "{slope}°");
}

/// Moments of the wheels' forces and own moments about the common centre of mass, by the levers:
/// the hubs lie H − r_s below it. Forces that balance the slope's pull, so that nothing
/// accelerates.
#[test]
fn loads_balance_the_moments_of_everything_that_acts_on_the_wheels() {
    let (rover, ground, yaw) = (given::hakuto(), plane(deg(15.0)), deg(20.0));
    let pull = load::slope_pull(&rover, &ground, EARTH_GRAVITY, &at_yaw(yaw));
    let wheel = WheelForces {
        drawbar_pull: -pull.x / 4.0,
        side_force: -pull.y / 4.0,
        torque: 0.3,
        overturning_moment: -0.2,
        ..WheelForces::default()
    };
    let below = rover.centre_height() - rover.mounts()[0].shearing_radius();
    let (sharing, own) = (LoadSharing::QuasiStaticTorque, OwnMoments::Included);
    let moments = load::moments(&rover, pull, sharing, own, &[wheel; 4]);
    // About y: −Σ d_x N + (−below) ΣF_x − ΣT = 0, for the soil turns a driven wheel backward.
    let pitch = -below * 4.0 * wheel.drawbar_pull - 4.0 * wheel.torque;
    // About x: Σ d_y N + below ΣF_y + ΣM_x = 0.
    let roll = -below * 4.0 * wheel.side_force - 4.0 * wheel.overturning_moment;
    assert!((moments - Vec2::new(pitch, roll)).norm() < 1e-12, "{moments}, not {pitch}, {roll}");
}

// ---- the ground ----

/// Axes of the ground are square to each other and to its normal, the first of them level across y:
/// the climb along each is the sine of its inclination, and what a weight loses into the ground it
/// has along it.
#[test]
fn a_weight_is_divided_between_the_ground_and_its_axes() {
    let normal = Vec3::new(0.2, -0.3, 0.8).normalize();
    let patch = Patch { height: 0.0, normal };
    let x_axis = Vec3::new(normal.z, 0.0, -normal.x).normalize();
    let y_axis = normal.cross(&x_axis);
    let climb = patch.climb();
    assert!((climb - Vec2::new(x_axis.z, y_axis.z)).norm() < 1e-15, "{climb}");
    let whole = 7.0 * EARTH_GRAVITY;
    let weight = load::Weight::on(&patch, whole);
    let parts = weight.into.hypot(weight.uphill.norm());
    assert!((parts - whole).abs() < 1e-12 && weight.into < whole, "{weight:?}");
}

/// A plane climbs along y: by its height over the way along it, and square to its normal.
#[test]
fn a_plane_has_one_normal_and_a_height_that_grows_along_y() {
    let plane = Plane { slope: deg(20.0) };
    let patch = |x: f64, y: f64| {
        let footprint = given::hakuto().footprint(&Rotation2::identity());
        plane.patch(Vec2::new(x, y), footprint)
    };
    let (here, there) = (patch(0.0, 0.0), patch(3.0, 2.0));
    assert_eq!(here.normal, there.normal);
    let way = Vec3::new(3.0, 2.0 * deg(20.0).cos(), there.height - here.height);
    assert!(here.normal.dot(&way).abs() < 1e-15 && (way.norm() - 13_f64.sqrt()).abs() < 1e-14);
    assert!((here.climb() - Vec2::new(0.0, deg(20.0).sin())).norm() < 1e-15);
}

// ---- the stance ----

#[test]
fn no_rover_stands_on_two_wheels_or_on_a_line() {
    let parts = given::hakuto();
    let stand = |hubs: &[(f64, f64, f64)]| {
        let unit = parts.mounts()[0].unit;
        let mounts = hubs.iter().map(|&(x, y, z)| Mount {
            name: "wheel".into(),
            position: Vec3::new(x, y, z),
            unit,
            steering: 0.0,
            steering_axis: None,
            joint: None,
        });
        Rover::new(*parts.body(), mounts.collect())
    };
    assert!(stand(&[(0.1, 0.2, 0.0), (-0.1, 0.2, 0.0)]).is_err());
    assert!(stand(&[(0.1, 0.2, 0.0), (0.0, 0.2, 0.0), (-0.1, 0.2, 0.0)]).is_err());
    assert!(stand(&[(0.1, 0.2, 0.0), (0.0, -0.2, 0.01), (-0.1, 0.2, 0.0)]).is_err());
    assert!(stand(&[(0.1, 0.2, 0.0), (0.0, -0.2, 0.0), (-0.1, 0.2, 0.0)]).is_ok());
}
