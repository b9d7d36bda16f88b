//! Soil and speed that differ from wheel to wheel, and that scatter from place to place.

use std::f64::consts::TAU;

use grouser::document::campaign::Campaign;
use grouser::document::table::Cell;
use grouser::document::{self, Overrides, Source, experiment};
use grouser::simulation::{
    Approach, Integrator, Method, NotSteady, Numerics, Run, Scatter, Scenario, Start,
};
use grouser::soil::{Soil, SoilDifference};
use grouser::studies::lost_yaw::LostYawPlan;
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
        ground: base.ground.with_slope(slope),
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
    let end = |y: f64| format!("{y:.9} m");
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
        let other = base.ground.soil.differing(here);
        let other = Scenario { ground: base.ground.clone().with_soil(other), ..base.clone() };
        let difference = final_yaw(&Scenario { scatter, ..base }) - final_yaw(&other);
        assert!(difference.abs() < deg(0.01), "{difference}");
    }
}

#[test]
fn a_difference_changes_what_it_says() {
    let soil: Soil = scenario(&[]).ground.soil;
    assert_eq!(soil.differing(SoilDifference::NONE), soil);
    let steep = SoilDifference { friction_angle: deg(-60.0), stiffness: 1.0 };
    assert_eq!(soil.differing(steep).friction_angle, deg(1.0));
}

const SCATTER: SoilScatter =
    SoilScatter { friction_angle: 1.0, stiffness: 1.0, correlation_length: 0.3 };

/// Moments of a field over its realisations: both are standard normal, correlated by exp(−d²/ℓ²) in
/// every direction, and not with each other.
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

fn campaign(text: &str) -> Campaign {
    let head = "schema = \"campaign/1\"\nname = \"x\"\nstudy = \"traverse\"\nruns = 4\n";
    let source = Source::text("campaign", format!("{head}{text}"));
    document::read_campaign(&source, &Overrides::none()).expect("it is one")
}

/// The yaws at the end of all runs [°].
fn yaws(campaign: &Campaign) -> Vec<f64> {
    let place = campaign.columns().iter().position(|column| column.name == "yaw_deg");
    let yaw = |run| match campaign.run(run)[place.expect("a result")] {
        Cell::Float(Some(yaw)) => yaw,
        _ => panic!("a run without a yaw"),
    };
    (0..campaign.runs()).map(yaw).collect()
}

/// Each run has a bed of its own, the same whenever it is run, and another one by another seed.
#[test]
fn every_run_of_a_campaign_has_a_bed_of_its_own() {
    let scattered = "[scenario]\nduration_s = 3\n[scenario.scatter]\nstiffness_std = 0.2\n";
    let one = campaign(scattered);
    let found = yaws(&one);
    assert_eq!(found, yaws(&one));
    for (place, yaw) in found.iter().enumerate() {
        assert!(!found[..place].contains(yaw), "{found:?}");
    }
    assert_ne!(found, yaws(&campaign(&format!("seed = 9\n{scattered}"))));
}

#[test]
fn a_campaign_varies_a_single_wheel() {
    let spread = "[scenario]\nduration_s = 3\n[scenario.by_wheel]\nspeed_factor = [1, 1, 1, 1]\n\
                  [[parameter]]\nkey = \"by_wheel.speed_factor.0\"\n\
                  distribution = \"normal\"\nstandard_deviation = 0.01\n";
    let found = yaws(&campaign(spread));
    assert!(found[0] != found[1], "{found:?}");
}

/// Source of the deviations: an independent estimate to first order, one digit printed.
#[test]
fn lost_yaw_scatters_about_as_an_independent_estimate_has_it() {
    let soil = SoilScatter { friction_angle: deg(1.0), stiffness: 0.1, correlation_length: 0.3 };
    let plan = LostYawPlan {
        scenario: scenario(&[]),
        measured: experiment::table_4(),
        scatter: Scatter { soil, speed: 0.005, ..Scatter::NONE },
        other_lengths: Vec::new(),
        samples: 40,
        seed: 3,
    };
    let found = plan.run(&mut |_| ()).expect("it runs");
    for (slope, expected) in found.iter().zip([0.3, 0.4, 0.6, 2.0]) {
        let all = slope.together.deviation.to_degrees();
        assert!((all / expected - 1.0).abs() < 0.4, "{all} and {expected}");
        // Causes that do not know of each other add up in squares.
        let squares: f64 = slope.alone.iter().map(|it| it.deviation.powi(2)).sum();
        let ratio = squares.sqrt() / slope.together.deviation;
        assert!((ratio - 1.0).abs() < 0.35, "{ratio}");
        // And what they scatter about is what the loads take.
        let off = (slope.together.losses.median - slope.by_loads) / slope.together.deviation;
        assert!(off.abs() < 0.6, "{off}");
    }
    assert_eq!(found, plan.run(&mut |_| ()).expect("it runs"));
}

/// Steps that know how the ground differs from place to place keep their order: a run at the usual
/// tolerance is that of a finer one, and of an integrator that knows of no Jacobian.
#[test]
fn a_scattered_run_is_that_of_finer_and_of_simpler_steps() {
    let soil = SoilScatter { friction_angle: deg(2.0), stiffness: 0.2, correlation_length: 0.1 };
    let scatter = Scatter { soil, seed: 5, ..Scatter::NONE };
    let base = scenario(&["scenario.start.yaw_deg=5", "scenario.duration_s=4"]);
    let end = |integrator| {
        let numerics = Numerics { integrator, sample_interval: 4.0, ..base.numerics };
        let run = Run::new(&Scenario { scatter, numerics, ..base.clone() }).and_then(Run::to_end);
        let run = run.expect("it runs");
        (run.last().state, run.work.steps)
    };
    let (usual, steps) = end(Integrator::Adaptive { tolerance: 1e-6 });
    let (finer, _) = end(Integrator::Adaptive { tolerance: 1e-9 });
    let (simple, _) = end(Integrator::Rk4 { step: 5e-4 });
    for other in [finer, simple] {
        assert!((usual.position - other.position).norm() < 1e-6, "{usual:?} {other:?}");
        assert!((usual.yaw - other.yaw).abs() < 1e-6, "{usual:?} {other:?}");
    }
    // Without the columns of the place the steps would be a hundred times as many.
    assert!(steps < 400, "{steps}");
}

/// The runs of a point of a design for sensitivities share its bed, or the total index of every
/// input would have the scatter in it.
#[test]
fn a_design_for_sensitivities_scatters_from_point_to_point() {
    let spread = "sensitivity = true\n[scenario]\nduration_s = 3\n[scenario.scatter]\nstiffness_std = 0.3\n\
                  [[parameter]]\nkey = \"gravity_m_s2\"\ndistribution = \"normal\"\nstandard_deviation = 1e-9\n";
    let found = yaws(&campaign(spread));
    assert_eq!(found.len(), 4 * 3);
    for point in found.chunks(3) {
        assert!(point.iter().all(|yaw| (yaw - point[0]).abs() < 1e-5), "{found:?}");
    }
    assert!((found[0] - found[3]).abs() > 1e-3, "{found:?}");
}
