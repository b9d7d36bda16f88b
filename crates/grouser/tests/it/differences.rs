//! Soil and speed that differ from wheel to wheel, and that scatter from place to place.

use std::f64::consts::TAU;

use grouser::document::{self, Overrides, Source, experiment};
use grouser::simulation::{Approach, Method, NotSteady, Numerics, Run, Scatter, Scenario, Start};
use grouser::soil::{Soil, SoilDifference};
use grouser::terrain::{SoilField, SoilScatter};
use grouser::units::{Vec2, deg};
use grouser::vehicle::{ByWheel, DriveLaw, PerWheel};

/// The default scenario: the complete load transfer.
fn scenario(settings: &[&str]) -> Scenario {
    let overrides = Overrides::parse(settings).expect("they are settings");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("it is one").value
}

/// The same on a slope, from a yaw [rad].
fn from(base: &Scenario, slope: f64, yaw: f64) -> Scenario {
    Scenario {
        site: base.site.with_slope(slope),
        start: Start { yaw, ..base.start },
        ..base.clone()
    }
}

fn final_yaw(scenario: &Scenario) -> f64 {
    Run::new(scenario).and_then(Run::to_end).expect("it runs").last().state.yaw
}

/// Yaws lost from the measured starts [°].
fn lost(by_wheel: &ByWheel) -> Vec<f64> {
    let base = Scenario { by_wheel: by_wheel.clone(), ..scenario(&[]) };
    let of = |row: &grouser::studies::comparison::MeasuredTraverse| {
        (row.initial_yaw - final_yaw(&from(&base, row.slope, row.initial_yaw))).to_degrees()
    };
    experiment::table_4().iter().map(of).collect()
}

/// A number for the wheels on the downhill side, and one for the others.
fn downhill(there: f64, elsewhere: f64) -> PerWheel {
    let rover = scenario(&[]).rover;
    let side = |y: f64| if y < 0.0 { there } else { elsewhere };
    PerWheel::Each(rover.mounts().iter().map(|mount| side(mount.position.y)).collect())
}

/// Source: an independent computation (Python), two digits printed.
#[test]
fn yaw_is_lost_as_an_independent_implementation_has_it() {
    let weaker_downhill = ByWheel { friction_angle: downhill(deg(-1.0), 0.0), ..ByWheel::ALIKE };
    let weaker_uphill = ByWheel { friction_angle: downhill(0.0, deg(-1.0)), ..ByWheel::ALIKE };
    let expected = [
        (ByWheel::ALIKE, [0.55, 1.30, 2.49, 6.05]),
        (weaker_downhill, [0.80, 1.67, 3.13, 8.0]),
        (weaker_uphill, [0.33, 1.02, 2.05, 4.9]),
    ];
    for (by_wheel, expected) in expected {
        for (found, expected) in lost(&by_wheel).iter().zip(expected) {
            assert!((found - expected).abs() < 0.04 * expected + 0.01, "{found} and {expected}");
        }
    }
}

/// A speed factor is a speed.
#[test]
fn a_wheel_that_turns_slower_is_one_that_is_told_so() {
    let base = scenario(&["scenario.start.yaw_deg=5"]);
    let slower = ByWheel { speed: downhill(0.98, 1.0), ..ByWheel::ALIKE };
    let told = slower.speed.numbers().iter().map(|factor| 0.06 * factor).collect();
    let told = Scenario { drive: DriveLaw::ConstantEach(told), ..base.clone() };
    assert_eq!(final_yaw(&Scenario { by_wheel: slower, ..base }), final_yaw(&told));
}

/// A controller that leaves the speeds as they were told does not apply the factors again.
#[test]
fn factors_are_applied_once() {
    let slower = ByWheel { speed: PerWheel::All(0.9), ..ByWheel::ALIKE };
    let scenario = Scenario { by_wheel: slower, duration: 2.0, ..scenario(&[]) };
    let mut keep = |_: &grouser::simulation::Observation<'_>, _: &mut [f64]| ();
    let mut run = Run::new(&scenario).expect("it starts");
    run.advance(&mut keep, 2.0).expect("it goes on");
    assert_eq!(run.state().rim_speeds(), [0.9 * 0.06; 4]);
    let alone = Run::new(&scenario).and_then(Run::to_end).expect("it runs");
    let end = |y: f64| format!("{:.9} m", y);
    assert_eq!(end(run.now().state.position.y), end(alone.last().state.position.y));
}

#[test]
fn without_differences_nothing_changes() {
    let plain = scenario(&[]);
    let still = Scenario { scatter: Scatter { seed: 7, ..Scatter::NONE }, ..plain.clone() };
    let alike = ByWheel { stiffness: PerWheel::Each(vec![1.0; 4]), ..ByWheel::ALIKE };
    let alike = Scenario { by_wheel: alike, ..plain.clone() };
    for other in [still, alike] {
        assert_eq!(final_yaw(&other), final_yaw(&plain));
    }
}

/// Where the correlation reaches beyond all bounds the whole bed has the soil of one place.
#[test]
fn a_field_without_end_is_another_soil() {
    let soil = SoilScatter { friction_angle: deg(2.0), stiffness: 0.2, correlation_length: 1e3 };
    for seed in 0..5 {
        let scatter = Scatter { soil, seed, ..Scatter::NONE };
        let base = scenario(&["scenario.start.yaw_deg=5"]);
        let here = scatter.soil_field().expect("it scatters").at(Vec2::zeros());
        let other = base.site.terrain.soil.differing(here);
        let other = Scenario { site: base.site.with_soil(other), ..base.clone() };
        let difference = final_yaw(&Scenario { scatter, ..base }) - final_yaw(&other);
        assert!(difference.abs() < deg(0.01), "{difference}");
    }
}

#[test]
fn a_difference_changes_what_it_says() {
    let soil: Soil = scenario(&[]).site.terrain.soil;
    assert_eq!(soil.differing(SoilDifference::NONE), soil);
    let steep = SoilDifference { friction_angle: deg(-60.0), stiffness: 1.0 };
    assert_eq!(soil.differing(steep).friction_angle, deg(1.0));
}

const SCATTER: SoilScatter =
    SoilScatter { friction_angle: 1.0, stiffness: 1.0, correlation_length: 0.3 };

/// Moments of a field over its realisations: both are standard normal, correlated by exp(−d²/ℓ²) in every direction,
/// and not with each other.
#[test]
fn a_field_is_normal_and_correlated_as_stated() {
    const SEEDS: u64 = 20_000;
    let length = SCATTER.correlation_length;
    for (distance, direction) in [(0.0, 0.0), (0.3, 0.0), (0.3, 1.0), (1.0, 2.0), (2.5, 0.5)] {
        let (sin, cos) = f64::sin_cos(direction * TAU / 8.0);
        let apart = distance * length * Vec2::new(cos, sin);
        let mut sums = [0.0; 5];
        for seed in 0..SEEDS {
            let field = SoilField::new(SCATTER, seed);
            let here = Vec2::new(1.7, -0.4);
            let [one, other] = [field.at(here), field.at(here + apart)];
            let stiffness = [one.stiffness.ln(), other.stiffness.ln()];
            sums[0] += one.friction_angle * other.friction_angle;
            sums[1] += stiffness[0] * stiffness[1];
            sums[2] += one.friction_angle * stiffness[1];
            sums[3] += one.friction_angle;
            sums[4] += one.friction_angle.powi(4);
        }
        let [friction, stiffness, across, mean, fourth] = sums.map(|sum| sum / SEEDS as f64);
        let expected = (-distance * distance).exp();
        // Four standard errors of a mean of products.
        let error = 4.0 * (2.0 / SEEDS as f64).sqrt();
        assert!((friction - expected).abs() < error, "{friction} at {distance}");
        assert!((stiffness - expected).abs() < error, "{stiffness} at {distance}");
        assert!(across.abs() < error && mean.abs() < error, "{across} {mean}");
        assert!((fourth - 3.0).abs() < 0.25, "{fourth}");
    }
}

#[test]
fn speeds_scatter_from_wheel_to_wheel_and_from_seed_to_seed() {
    let of = |seed| Scatter { speed: 0.005, seed, ..Scatter::NONE }.speed_factors();
    assert_eq!(of(3).take(4).collect::<Vec<_>>(), of(3).take(4).collect::<Vec<_>>());
    let all: Vec<f64> = (0..2000).flat_map(|seed| of(seed).take(4)).map(|it| it - 1.0).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let deviation = (all.iter().map(|it| it * it).sum::<f64>() / all.len() as f64).sqrt();
    assert!(mean.abs() < 2e-4 && (deviation / 0.005 - 1.0).abs() < 0.03, "{mean} {deviation}");
}

#[test]
fn a_quasi_steady_run_over_scattered_soil_goes_dynamically_and_says_so() {
    let base = scenario(&["scenario.scatter.stiffness_std=0.1", "scenario.duration_s=2"]);
    let numerics = Numerics { approach: Approach::QuasiSteady, ..base.numerics };
    let run = Run::new(&Scenario { numerics, ..base.clone() }).and_then(Run::to_end).unwrap();
    let because = NotSteady::UnevenSoil;
    assert_eq!(run.method, Method::FallbackToDynamic { time: 0.0, because });
    let dynamic = Run::new(&base).and_then(Run::to_end).unwrap();
    assert_eq!(run.last().state, dynamic.last().state);
}
