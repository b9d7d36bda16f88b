//! Rovers and grounds of every kind are driven from outside: motors, batteries, steering,
//! suspensions and zones of soil, dynamic and quasi-steady, ahead, in curves, back and on the spot.
//! The states that go with the answers lead where the library leads that keeps its run.

use std::fs;

use grouser::document::{self, Kind, Overrides, Source, preset};
use grouser::simulation::{Observation, Outcome, Run, RunError, Scenario};
use grouser_serve::Settings;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::served::Served;

/// Rim speeds of the sides [m/s], each for half a second.
const MOVES: [[f64; 2]; 5] =
    [[0.05, 0.05], [0.02, 0.06], [-0.05, -0.05], [-0.05, 0.05], [0.0, 0.0]];

/// A motor with droop, whose winding warms, and a battery that is soon empty.
const POWERED: &str = "\n[motor]\npreset = \"maxon-re-25\"\n[motor.control]\n\
    gain_v_s_rad = 20.0\nvoltage_limit_v = 12.0\n[battery]\ncapacity_wh = 0.01\n\
    full_voltage_v = 13.0\nempty_voltage_v = 11.0\ninternal_resistance_ohm = 0.2\n\
    cutoff_voltage_v = 9.0\nelectronics_w = 3.0\n";
const RIPPLE: &str = "[terrain]\nsurface = \"ripple\"\namplitude_m = 0.03\nwavelength_m = 1.0\n";
/// The border of two sands is under the rover at its start.
const ZONES: &str = "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\
    \"properties\":{\"soil\":\"grc-1\"},\"geometry\":{\"type\":\"Polygon\",\
    \"coordinates\":[[[0.02,-5],[9,-5],[9,5],[0.02,5],[0.02,-5]]]}}]}";

/// A folder with a scenario of each kind.
fn folder() -> (TempDir, Served, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("zones.geojson", ZONES);
    write("powered.toml", &format!("{}{POWERED}", preset(Kind::Rover, "hakuto").unwrap().text));
    let over_zones =
        "[terrain]\nsurface = \"incline\"\nslope_deg = 4.0\nsoil_file = \"zones.geojson\"\n";
    let kinds = [
        ("motors", "powered.toml", "slope_deg = 4.0\n"),
        ("steered", "hakuto-steered", "slope_deg = 4.0\n"),
        ("rockers", "hakuto-rockers", RIPPLE),
        ("bogies", "curiosity-rocker-bogie", RIPPLE),
        ("six-wheels", "sojourner", "slope_deg = 4.0\n"),
        ("zones", "hakuto", over_zones),
        ("motors-over-ripples", "powered.toml", RIPPLE),
    ];
    let name = |(kind, rover, ground): (&str, &str, &str)| {
        let file = format!("{kind}.toml");
        let scenario = format!(
            "schema = \"scenario/1\"\nname = \"{kind}\"\nrover = \"{rover}\"\n\
             soil = \"toyoura\"\n{ground}"
        );
        write(&file, &scenario);
        file
    };
    let names = kinds.map(name).into();
    let place = folder.path().to_owned();
    let server = Served::start(&Settings { folder: Some(place), ..Settings::default() });
    (folder, server, names)
}

/// The rim speed of each wheel.
fn of_sides(scenario: &Scenario, [left, right]: [f64; 2]) -> Vec<f64> {
    let side = |y: f64| if y > 0.0 { left } else { right };
    scenario.rover.mounts().iter().map(|mount| side(mount.position.y)).collect()
}

/// The library's run over the moves, tenth of a second by tenth, until it ends.
fn driven(scenario: &Scenario, moves: &[[f64; 2]], tenths: u32) -> Result<Run, RunError> {
    let first = of_sides(scenario, moves[0]);
    let mut start = |_: &Observation<'_>, rims: &mut [f64]| rims.copy_from_slice(&first);
    let mut run = Run::with_controller(scenario, &mut start)?;
    for sides in moves {
        let rims = of_sides(scenario, *sides);
        for _ in 0..tenths {
            if run.outcome().is_some() {
                return Ok(run);
            }
            let before = run.state().rim_speeds().to_vec();
            run.step(&rims, 0.1)?;
            run.start_rolling(&before);
        }
    }
    Ok(run)
}

/// The last answer of a drive by the states of its answers, or why there is none.
fn by_states(
    served: &Served,
    about: &Value,
    moves: &[[f64; 2]],
    span: f64,
) -> Result<Value, String> {
    let mut last = Value::Null;
    for sides in moves {
        let mut asked = about.clone();
        asked["rim_speed_m_s"] = json!(sides);
        asked["dt_s"] = json!(span);
        if let Some(state) = last.get("state") {
            asked["state"] = state.clone();
        }
        let reply = served.post("drive-step", &asked);
        let answer = reply.lines().remove(0);
        match reply.status {
            200 => last = answer,
            422 => return Err(answer["error"].as_str().unwrap().to_owned()),
            other => panic!("{other}: {answer}"),
        }
        if last["outcome"].is_string() {
            break;
        }
    }
    Ok(last)
}

#[test]
fn every_kind_of_rover_and_ground_is_driven() {
    let (folder, server, names) = folder();
    for name in &names {
        for simulation in ["dynamic", "quasi-steady"] {
            let key = "scenario.simulation";
            let path = folder.path().join(name);
            let source = Source::find(Kind::Scenario, path.to_str().unwrap()).unwrap();
            let set = Overrides::parse([&*format!("{key}={simulation}")]).unwrap();
            let scenario = document::read_scenario(&source, &set).unwrap().value;
            let about = json!({"scenario": name, "set": {key: simulation}});
            let own = by_states(&server, &about, &MOVES, 0.5);
            let run = driven(&scenario, &MOVES, 5);
            let (own, run) = match (own, run) {
                (Ok(own), Ok(run)) => (own, run),
                (Err(own), Err(library)) => {
                    assert_eq!(own, library.to_string(), "{name}, {simulation}");
                    continue;
                }
                (own, run) => panic!("{name}, {simulation}: {own:?}, {:?}", run.err()),
            };
            let (last, end) = (own["samples"].as_array().unwrap().last().unwrap(), run.now());
            let found = ["time_s", "x_m", "y_m"].map(|it| last[it].as_f64().unwrap());
            let place = end.state.position;
            assert_eq!(found, [end.time, place.x, place.y], "{name}, {simulation}");
            let energy = last["energy_j"].as_f64().unwrap();
            assert!((energy / end.energy.motors - 1.0).abs() < 1e-3, "{name}, {simulation}");
            let charge = end.battery.as_ref().map(|it| it.charge);
            assert_eq!(last["state_of_charge"].as_f64(), charge, "{name}, {simulation}");
            assert_eq!(charge.is_some(), name.starts_with("motors"));
            assert_eq!(own["outcome"].as_str(), run.outcome().map(Outcome::name));
            // Each kind is driven somewhere, but for bogies that tip over at a stroke of the sides.
            let yaw = last["yaw_deg"].as_f64().unwrap();
            let has_turned = place.norm() > 2e-3 && yaw.abs() > 0.2;
            let tips = name == "bogies.toml" && own["outcome"] == "tipped_over";
            assert!(has_turned || tips, "{name}, {simulation}: {last}");
        }
    }
}

/// A battery runs empty over many steps, each of which goes on with its charge.
#[test]
fn a_battery_runs_empty_by_hand() {
    let (_folder, server, _) = folder();
    let about = json!({"scenario": "motors.toml"});
    let ended = by_states(&server, &about, &[[0.05, 0.05]; 20], 1.0).unwrap();
    assert_eq!(ended["outcome"], "brown_out", "{}", ended["final"]);
    assert!(ended["final"]["time_s"].as_f64().unwrap() < 13.0, "{}", ended["final"]);
}
