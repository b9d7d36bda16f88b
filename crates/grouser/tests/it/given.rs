//! What the tests are given: the source paper's rover, wheel and soil, and strategies for any
//! other.

use std::f64::consts::FRAC_PI_2;

use grouser::contact::{Contact, Settled, Slip, WheelSoilModel, settle};
use grouser::paper;
use grouser::simulation::{Motion, Run, Scenario, Start, Trajectory};
use grouser::soil::{
    Bulldozing, Domain, Exit, PressureSinkage, Rft, Shear, ShearBound, ShearModulus,
    SinkageExponent, SmallWheel, Soil, StressPeak,
};
use grouser::terrain::Ground;
use grouser::units::{EARTH_GRAVITY, Vec3, deg};
use grouser::vehicle::{Body, Inertia, LoadSharing, Mount, OwnMoments, Rover, WheelUnit};
use grouser::wheel::{Grousers, Wheel};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// A number of cases, drawn from the same seed every time: a build that fails must fail again.
/// `PROPTEST_RNG_SEED` chooses another seed.
pub(crate) fn cases(count: u32) -> Config {
    let config = Config::with_cases(count);
    let rng_seed = match config.rng_seed {
        RngSeed::Random => RngSeed::Fixed(2017),
        fixed @ RngSeed::Fixed(_) => fixed,
    };
    Config { rng_seed, failure_persistence: None, ..config }
}

// ---- the paper's ----

/// Assumed: the paper prints no wheel (theory, section 5).
pub(crate) fn hakuto_wheel() -> Wheel {
    paper::hakuto_wheel()
}

/// A wheel without grousers.
pub(crate) fn smooth_wheel(radius: f64, width: f64) -> Wheel {
    Wheel { radius, width, grousers: None }
}

/// K = K₀ + K₁ |β|.
pub(crate) fn linear(at_zero: f64, per_radian: f64) -> ShearModulus {
    ShearModulus::Linear { at_zero, per_radian }
}

/// [FourWheel], Table 3, without the domain of its measurements and what `small-wheel` adds.
pub(crate) fn toyoura() -> Soil {
    Soil { domain: Domain::UNSTATED, small_wheel: SmallWheel::OFF, ..paper::toyoura() }
}

/// Lunar regolith simulant of Ishigami et al. (2007): theory, section 2.9.
pub(crate) fn simulant_2007() -> Soil {
    Soil {
        cohesion: 800.0,
        friction_angle: deg(37.2),
        density: 1600.0,
        pressure_sinkage: PressureSinkage::Bekker {
            k_c: 1370.0,
            k_phi: 8.14e5,
            exponent: SinkageExponent::constant(1.0),
        },
        ..toyoura()
    }
}

/// A body of [FourWheel], Table 1, on wheels of Table 1 with their hubs at (x, y), 6 cm lower.
pub(crate) fn rover_on(wheel: Wheel, hubs: &[(f64, f64)]) -> Rover {
    let body = Body { mass: 5.24, inertia: Inertia { xx: 0.138, yy: 0.142, zz: 0.230 } };
    let inertia = Inertia { xx: 0.001_00, yy: 0.001_54, zz: 0.001_00 };
    let unit = WheelUnit { mass: 0.422, inertia, wheel, motor: None };
    let mounts = hubs.iter().enumerate().map(|(number, &(x, y))| Mount {
        name: format!("wheel {}", number + 1),
        position: Vec3::new(x, y, -0.06),
        unit,
        steering: 0.0,
        steering_axis: None,
        joint: None,
    });
    Rover::new(body, mounts.collect()).expect("a rover that stands")
}

/// [FourWheel], Table 2, in its order: front left, rear left, rear right, front right.
pub(crate) const HAKUTO_HUBS: [(f64, f64); 4] =
    [(0.19, 0.24), (-0.17, 0.24), (-0.17, -0.24), (0.19, -0.24)];

/// [FourWheel], Tables 1 and 2.
pub(crate) fn hakuto() -> Rover {
    rover_on(hakuto_wheel(), &HAKUTO_HUBS)
}

/// Speed of the rims in the experiments [m/s]. Source: [FourWheel], section 5.2.
pub(crate) const RIM_SPEED: f64 = 0.06;

/// The experiment of [FourWheel], section 5.2: 20 s across a slope at 6 cm/s.
pub(crate) fn traverse(slope: f64, yaw: f64) -> Scenario {
    Scenario {
        sharing: LoadSharing::QuasiStatic,
        own_moments: OwnMoments::Neglected,
        start: Start { yaw, motion: Motion::Rolling },
        ..Scenario::new(hakuto(), Ground::plane(toyoura(), slope))
    }
}

/// The same under the complete wrench of every wheel.
///
/// * `slope`, `yaw`: [°]
pub(crate) fn complete_traverse(slope: f64, yaw: f64) -> Scenario {
    let (sharing, own_moments) = (LoadSharing::Complete, OwnMoments::Included);
    Scenario { sharing, own_moments, ..traverse(deg(slope), deg(yaw)) }
}

/// The run of a scenario that can be computed.
pub(crate) fn run(scenario: &Scenario) -> Trajectory {
    let run = Run::new(scenario).expect("the scenario is a run");
    run.to_end().expect("it can be computed")
}

/// A wheel on a test stand, on Earth.
pub(crate) fn on_stand(soil: Soil, wheel: Wheel, slip_ratio: f64, slip_angle: f64) -> Contact {
    let slip = Slip::on_test_stand(slip_ratio, slip_angle);
    Contact { wheel, soil, slip, gravity: EARTH_GRAVITY }
}

/// A wheel settled under a load that its soil carries.
pub(crate) fn settled(model: &dyn WheelSoilModel, contact: &Contact, load: f64) -> Settled {
    settle(model, contact, load).expect("the soil carries the load")
}

// ---- any ----

/// A wheel from a mouse's to a tractor's.
pub(crate) fn any_wheel() -> impl Strategy<Value = Wheel> {
    let grousers = prop_oneof![Just(None), (0.0..0.3, 1..60_u32).prop_map(Some)];
    (log_range(0.02, 1.0), 0.2..2.0, grousers).prop_map(|(radius, width_share, grousers)| Wheel {
        radius,
        width: width_share * radius,
        grousers: grousers
            .map(|(share, count): (f64, u32)| Grousers { height: share * radius, count }),
    })
}

/// Numbers of every size between two.
pub(crate) fn log_range(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Exponents and how they change with slip, 0.5 to 2.
fn any_exponent() -> impl Strategy<Value = SinkageExponent> {
    prop_oneof![
        (0.5..2.0).prop_map(SinkageExponent::constant),
        (0.9..1.5, -0.4..0.5, -0.4..0.5).prop_map(|(at_zero, per_slip, per_skid)| {
            SinkageExponent { at_zero, per_slip, per_skid }
        }),
    ]
}

/// Both laws. Bekker's moduli are drawn so that a plate that has sunk by 10 cm bears 0.01 to 1 MPa.
pub(crate) fn any_pressure_sinkage() -> impl Strategy<Value = PressureSinkage> {
    let reece = (0.0..50.0, log_range(10.0, 3000.0), any_exponent())
        .prop_map(|(k_c, k_phi, exponent)| PressureSinkage::Reece { k_c, k_phi, exponent });
    let bekker = (0.0..0.1, log_range(1e4, 1e6), any_exponent()).prop_map(
        |(k_c_share, pressure_at_10_cm, exponent)| {
            let k_phi = pressure_at_10_cm / 0.1_f64.powf(exponent.at_zero);
            PressureSinkage::Bekker { k_c: k_c_share * k_phi, k_phi, exponent }
        },
    );
    prop_oneof![reece, bekker]
}

/// A modulus from `least` to 20 cm, in both forms.
fn any_modulus(least: f64) -> impl Strategy<Value = ShearModulus> {
    prop_oneof![
        (log_range(least, 0.2), 0.0..0.05).prop_map(|(k_0, k_1)| linear(k_0, k_1)),
        (log_range(least, 0.2), 0.0..0.05, 0.0..0.05, 0.3..1.5).prop_map(
            |(at_zero, per_radian, per_radian_squared, angle_limit)| ShearModulus::Quadratic {
                at_zero,
                per_radian,
                per_radian_squared,
                angle_limit,
            }
        ),
    ]
}

/// The paper's shear law, with moduli from `least` [m] on.
pub(crate) fn any_anisotropic(least: f64) -> impl Strategy<Value = Shear> {
    (any_modulus(least), any_modulus(least))
        .prop_map(|(longitudinal, lateral)| Shear::Anisotropic { longitudinal, lateral })
}

/// The shear law that respects Mohr-Coulomb, with moduli from `least` [m] on.
pub(crate) fn any_isotropic(least: f64) -> impl Strategy<Value = Shear> {
    any_modulus(least).prop_map(|modulus| Shear::Isotropic { modulus })
}

/// With Coulomb's bound and without.
pub(crate) fn any_shear_bound() -> impl Strategy<Value = ShearBound> {
    proptest::sample::select(&[ShearBound::None, ShearBound::Coulomb][..])
}

/// Both exit laws, at most λ.
pub(crate) fn any_exit(most: f64) -> impl Strategy<Value = Exit> {
    let quadratic = (0.0..1.0, -2.0..0.0, 0.0..2.0).prop_map(
        move |(at_zero, per_slip, per_slip_squared): (f64, f64, f64)| Exit::QuadraticInSlip {
            at_zero: at_zero * most,
            per_slip,
            // So that λ at s = 1, the other end of a parabola that is open above, stays in range.
            per_slip_squared: per_slip_squared.min(most * (1.0 - at_zero) - per_slip),
        },
    );
    prop_oneof![(0.0..most).prop_map(Exit::Ratio), quadratic]
}

/// Every bulldozing law.
pub(crate) const BULLDOZING: [Bulldozing; 4] =
    [Bulldozing::None, Bulldozing::Sign, Bulldozing::Sine, Bulldozing::SineSquared];

/// Soils with every law, up to strongly cohesive ones.
pub(crate) fn any_soil() -> impl Strategy<Value = Soil> {
    let shear = prop_oneof![any_anisotropic(5e-4), any_isotropic(5e-4)];
    let cohesion = prop_oneof![Just(0.0), 0.0..5000.0];
    let strength = (cohesion, deg(10.0)..deg(50.0), 500.0..3000.0);
    let peak = (0.0..0.7, 0.0..0.3).prop_map(|(a0, a1)| StressPeak { a0, a1 });
    let shear = (shear, any_shear_bound());
    let bulldozing = proptest::sample::select(&BULLDOZING[..]);
    (strength, any_pressure_sinkage(), peak, shear, any_exit(1.2), bulldozing).prop_map(
        |(strength, pressure_sinkage, stress_peak, shear, exit, bulldozing)| {
            let (cohesion, friction_angle, density) = strength;
            let (shear, shear_bound) = shear;
            Soil {
                cohesion,
                friction_angle,
                constant_volume_share: 0.0,
                density,
                pressure_sinkage,
                stress_peak,
                shear,
                shear_bound,
                exit,
                bulldozing,
                small_wheel: SmallWheel::OFF,
                rft: Rft::PUBLISHED,
                domain: Domain::UNSTATED,
                discrepancy: None,
            }
        },
    )
}

/// Soils without cohesion that recover no more than they were pressed: dry sands.
pub(crate) fn any_sand() -> impl Strategy<Value = Soil> {
    (any_soil(), any_exit(1.0)).prop_map(|(soil, exit)| Soil { cohesion: 0.0, exit, ..soil })
}

/// Slip ratios of every sense, −2 to 2, among them the special ones.
pub(crate) fn any_slip_ratio() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -2.0..2.0, 1 => proptest::sample::select(vec![-2.0, -1.0, 0.0, 1.0, 2.0])]
}

/// Slip angles up to ±90°, among them the special ones.
pub(crate) fn any_slip_angle() -> impl Strategy<Value = f64> {
    let special = vec![-FRAC_PI_2, 0.0, FRAC_PI_2];
    prop_oneof![4 => -FRAC_PI_2..FRAC_PI_2, 1 => proptest::sample::select(special)]
}

/// Contacts in every motion of a test stand, on asteroids to giant planets.
pub(crate) fn any_contact() -> impl Strategy<Value = Contact> {
    (any_soil(), any_wheel(), any_slip_ratio(), any_slip_angle(), log_range(0.01, 30.0)).prop_map(
        |(soil, wheel, s, beta, gravity)| Contact {
            wheel,
            soil,
            slip: Slip::on_test_stand(s, beta),
            gravity,
        },
    )
}

/// Sinkages, in shearing radii, from a trace to the axle.
pub(crate) fn any_depth() -> impl Strategy<Value = f64> {
    log_range(1e-4, 1.0)
}
