//! Derivatives of runs, against closed forms and differences of whole runs.

use grouser::difference::Derivative;
use grouser::document::columns::run::{RECORD, STANDING};
use grouser::document::gradient::{GradientKeys, RunDerivatives, RunKeys};
use grouser::document::{LoadedScenario, Overrides, Source, read_scenario, scenario_with};
use grouser::simulation::{Record, Run, Scenario, Trajectory};

fn scenario(settings: &[&str]) -> LoadedScenario {
    let settings: Vec<String> = settings.iter().map(|it| format!("scenario.{it}")).collect();
    read_scenario(&Source::default_scenario(), &Overrides::parse(&settings).unwrap()).unwrap()
}

/// Its run with the derivatives by some keys.
fn derivatives(scenario: &LoadedScenario, keys: &[&str]) -> (Trajectory, RunKeys, RunDerivatives) {
    let asked = GradientKeys::These(keys.iter().map(|key| (*key).to_owned()).collect());
    let keys = RunKeys::of(scenario, &asked).unwrap();
    let run = Run::new(&scenario.value).unwrap().to_end().unwrap();
    let number = |key: &str| scenario.document.number(key);
    let found = keys.along(&scenario.value, &number, &run, Run::to_end, &|| true).unwrap();
    (run, keys, found)
}

fn place(result: &str) -> usize {
    RunKeys::results(true).iter().position(|it| *it == result).unwrap()
}

/// A rover in a steady state goes by how far its wheels turned: where it is at a time goes with
/// speed as with time, v ∂x/∂v = t dx/dt, in every model, but for what accelerates it along its bend
/// (1e-4 of it).
#[test]
fn a_quasi_steady_run_goes_with_its_speed_as_with_time() {
    for model in ["ishigami", "bekker", "small-wheel", "rft"] {
        let scenario =
            scenario(&["slope_deg=12", "simulation=quasi-steady", &format!("model={model}")]);
        let (run, _, found) = derivatives(&scenario, &["drive.rim_speed_m_s"]);
        let speed = scenario.document.number("drive.rim_speed_m_s").unwrap();
        for (record, at) in run.records.iter().enumerate().skip(1) {
            let along = at.state.slope_from_body() * at.state.velocity;
            let rates =
                [("x_m", along.x), ("y_m", along.y), ("yaw_deg", at.state.yaw_rate.to_degrees())];
            for (result, rate) in rates {
                let found = found.at(record, place(result), 0).unwrap();
                let expected = at.time * rate / speed;
                let error = (found.value - expected).abs();
                assert!(
                    error < 2e-4 * (1.0 + expected.abs()),
                    "{model} {result}: {found:?} {expected}"
                );
            }
        }
    }
}

/// A result of a record, in its column's unit.
fn number(result: &str, record: &Record) -> f64 {
    let mut all = RECORD.iter().chain(&STANDING);
    all.find(|column| column.name == result).unwrap().number(record)
}

/// A scenario of text.
fn of_text(text: &str) -> LoadedScenario {
    let text = format!("schema = \"scenario/1\"\n{text}");
    read_scenario(&Source::text("a test's", text), &Overrides::none()).unwrap()
}

/// The six-point difference of some result by a key.
fn six_points(
    scenario: &LoadedScenario,
    key: &str,
    step: f64,
    result: impl Fn(&Scenario) -> f64,
) -> f64 {
    const WEIGHTS: [(f64, f64); 6] =
        [(-3.0, -1.0), (-2.0, 9.0), (-1.0, -45.0), (1.0, 45.0), (2.0, -9.0), (3.0, 1.0)];
    let value = scenario.document.number(key).unwrap();
    let at = |steps: f64| {
        result(&scenario_with(&scenario.value, [(key, value + steps * step)]).unwrap())
    };
    WEIGHTS.iter().map(|(steps, weight)| weight * at(*steps)).sum::<f64>() / (60.0 * step)
}

/// How a rover stands on ground with heights, rigid and on rockers: its first record, to 1e-6 of
/// what the result changes by when the number does by its own size.
#[test]
fn derivatives_of_standing_on_ground_with_heights_are_those_of_whole_standings() {
    const RIPPLE: &str = "simulation = \"quasi-steady\"\nduration_s = 0.5\n\
         terrain = { surface = \"ripple\", amplitude_m = 0.05, wavelength_m = 2.0, start_m = [0.4, 3.0] }\n";
    let keys = [
        "soil.friction_angle_deg",
        "soil.pressure_sinkage.k_phi",
        "rover.wheel_unit.wheel.radius_m",
        "rover.body.mass_kg",
        "gravity_m_s2",
        "terrain.amplitude_m",
        "start.yaw_deg",
    ];
    let mut worst = 0.0_f64;
    for rover in ["hakuto", "hakuto-rockers"] {
        let scenario = of_text(&format!("rover = \"{rover}\"\n{RIPPLE}[start]\nyaw_deg = 20.0\n"));
        let (_, asked, found) = derivatives(&scenario, &keys);
        for (place_of_key, key) in asked.names().enumerate() {
            let value = scenario.document.number(key).unwrap();
            for (result, column) in RunKeys::results(true).into_iter().enumerate() {
                if !["z_m", "roll_deg", "pitch_deg", "stability_margin_deg"].contains(&column) {
                    continue;
                }
                let standing =
                    |scenario: &Scenario| number(column, Run::new(scenario).unwrap().now());
                let expected = six_points(&scenario, key, 1e-3 * value.abs(), standing);
                let found = found.at(0, result, place_of_key).unwrap();
                let error = ((found.value - expected) * value).abs();
                let size = 1.0 + (expected * value).abs();
                worst = worst.max(error / size);
                assert!(error < 1e-6 * size, "{rover}, {column} by {key}: {found:?} {expected}");
            }
        }
    }
    println!("standing: worst {worst:.1e}");
}

/// Where motors meet the soil their speeds and currents balance: the steady motion of wheels that
/// their motors turn, to 1e-6.
#[test]
fn derivatives_of_wheels_that_motors_turn_are_those_of_whole_runs() {
    let scenario = scenario(&[
        "slope_deg=12",
        "simulation=quasi-steady",
        "duration_s=10",
        "rover.motor=maxon-re-25",
        "rover.motor.control.gain_v_s_rad=0.5",
        "rover.motor.control.integral_v_rad=5.0",
        "rover.motor.control.voltage_limit_v=24.0",
    ]);
    let keys = [
        "soil.friction_angle_deg",
        "rover.motor.resistance_ohm",
        "rover.body.mass_kg",
        "slope_deg",
    ];
    let (run, _, found) = derivatives(&scenario, &keys);
    let mut worst = 0.0_f64;
    for (place_of_key, key) in keys.iter().enumerate() {
        let value = scenario.document.number(key).unwrap();
        for result in ["x_m", "y_m", "yaw_deg", "energy_j"] {
            let end = |scenario: &Scenario| {
                number(result, Run::new(scenario).unwrap().to_end().unwrap().last())
            };
            let expected = six_points(&scenario, key, 1e-3 * value.abs(), end);
            let found = found.at(run.records.len() - 1, place(result), place_of_key).unwrap();
            let error = ((found.value - expected) * value).abs();
            let size = 1.0 + (expected * value).abs();
            worst = worst.max(error / size);
            assert!(error < 1e-6 * size, "{result} by {key}: {found:?} {expected}");
        }
    }
    println!("motors: worst {worst:.1e}");
}

/// The five-point difference of whole runs by a key.
fn reference(scenario: &LoadedScenario, key: &str, share: f64, result: &str) -> f64 {
    let value = scenario.document.number(key).unwrap();
    let step = share * value.abs();
    let end = |steps: f64| {
        let changed = scenario_with(&scenario.value, [(key, value + steps * step)]).unwrap();
        let run = Run::new(&changed).unwrap().to_end().unwrap();
        let end = run.last();
        match result {
            "x_m" => end.place().x,
            "y_m" => end.place().y,
            "yaw_deg" => end.state.yaw.to_degrees(),
            _ => end.energy.motors,
        }
    };
    (end(-2.0) - end(2.0) + 8.0 * (end(1.0) - end(-1.0))) / (12.0 * step)
}

#[test]
fn derivatives_of_runs_are_those_of_whole_runs() {
    let keys = [
        "soil.friction_angle_deg",
        "soil.pressure_sinkage.k_phi",
        "rover.wheel_unit.wheel.width_m",
        "rover.mount.0.position_m.1",
        "gravity_m_s2",
        "slope_deg",
    ];
    for (simulation, share, allowed) in [("quasi-steady", 1e-3, 1e-6), ("dynamic", 6e-3, 2e-3)] {
        let scenario =
            scenario(&["slope_deg=10", &format!("simulation={simulation}"), "duration_s=8"]);
        let (run, _, found) = derivatives(&scenario, &keys);
        for (number, key) in keys.iter().enumerate() {
            let value = scenario.document.number(key).unwrap();
            for result in ["x_m", "y_m", "yaw_deg", "energy_j"] {
                let Derivative { value: found, .. } =
                    found.at(run.records.len() - 1, place(result), number).unwrap();
                let expected = reference(&scenario, key, share, result);
                // By how much the result changes when the number does by its own size.
                let [found, expected] = [found, expected].map(|it| it * value);
                let error = (found - expected).abs();
                assert!(
                    error < allowed * (0.1 + expected.abs()),
                    "{simulation}, {result} by {key}: {found} {expected}"
                );
            }
        }
    }
}

/// Where a run ends otherwise with the number to one side, the slope is that of the other.
#[test]
fn a_run_at_its_edge_has_the_derivatives_of_the_side_on_which_it_ends_alike() {
    let on = |slope: f64| scenario(&[&format!("slope_deg={slope}"), "duration_s=3"]);
    let completes =
        |slope: f64| Run::new(&on(slope).value).unwrap().to_end().unwrap().outcome.is_completed();
    let (mut gentle, mut steep) = (10.0, 35.0);
    assert!(completes(gentle) && !completes(steep));
    while steep - gentle > 1e-3 {
        let middle = 0.5 * (gentle + steep);
        *if completes(middle) { &mut gentle } else { &mut steep } = middle;
    }
    let last = |slope: f64| {
        let (run, _, found) = derivatives(&on(slope), &["slope_deg"]);
        found.at(run.records.len() - 1, place("y_m"), 0).unwrap().value
    };
    let (at_edge, beside) = (last(gentle), last(gentle - 0.2));
    assert!((at_edge / beside - 1.0).abs() < 0.05, "{gentle}°: {at_edge} and {beside}");
}

#[test]
fn all_numbers_of_a_scenario_are_keys_but_the_times_of_records() {
    let scenario = scenario(&["slope_deg=10"]);
    let keys = RunKeys::of(&scenario, &GradientKeys::All).unwrap();
    let names: Vec<&str> = keys.names().collect();
    for name in ["soil.cohesion_kpa", "rover.body.mass_kg", "start.yaw_deg", "drive.rim_speed_m_s"]
    {
        assert!(names.contains(&name), "{name} of {names:?}");
    }
    assert!(!names.iter().any(|it| ["duration_s", "sample_interval_s"].contains(it)));
    let times = GradientKeys::These(vec!["duration_s".to_owned()]);
    assert!(RunKeys::of(&scenario, &times).unwrap_err().to_string().contains("records"));
}
