//! Drives from outside: each step goes on from the state that the last one gave, and the server keeps
//! nothing.

use grouser::document::{self, Overrides, Source};
use grouser::simulation::{Observation, Run};
use grouser_serve::Settings;
use serde_json::{Value, json};

use crate::served::Served;

/// The answer to a step of a rover on a slope of 5°.
fn step(server: &Served, state: Option<&str>, more: &Value) -> Value {
    let mut asked = json!({"soil": "toyoura", "slope_deg": 5, "dt_s": 0.3, "state": state});
    asked.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let reply = server.post("drive-step", &asked);
    assert_eq!(reply.status, 200, "{reply:?}");
    reply.lines().remove(0)
}

#[test]
fn steps_lead_where_the_library_leads() {
    let server = Served::usual();
    let first = step(&server, None, &json!({"rim_speed_m_s": [0.05, 0.06]}));
    let second = step(&server, first["state"].as_str(), &json!({"rim_speed_m_s": 0.06}));
    let set = Overrides::parse(["scenario.soil=toyoura", "scenario.slope_deg=5"]).unwrap();
    let scenario = document::read_scenario(&Source::default_scenario(), &set).unwrap().value;
    let sides = [0.05, 0.05, 0.06, 0.06];
    let mut start = |_: &Observation<'_>, rims: &mut [f64]| rims.copy_from_slice(&sides);
    let mut run = Run::with_controller(&scenario, &mut start).unwrap();
    for rims in [sides; 3].into_iter().chain([[0.06; 4]; 3]) {
        run.step(&rims, 0.3 / 3.0).unwrap();
    }
    let end = run.now();
    let last = second["samples"].as_array().unwrap().last().unwrap();
    assert_eq!(last["time_s"].as_f64(), Some(end.time));
    assert_eq!(last["x_m"].as_f64(), Some(end.state.position.x));
    assert_eq!(last["wheels"][3]["slip_ratio"].as_f64(), Some(end.wheels[3].reaction.slip.ratio));
    // The first record is the last one of the step before.
    assert_eq!(second["samples"][0]["x_m"], first["samples"][3]["x_m"]);
    assert_eq!(
        (&second["outcome"], second["samples"].as_array().unwrap().len()),
        (&Value::Null, 4)
    );
}

#[test]
fn a_drive_turns_stands_and_ends() {
    let server = Served::usual();
    let turn = json!({"rim_speed_m_s": [-0.05, 0.05], "slope_deg": 0, "dt_s": 5, "scene": true});
    let turned = step(&server, None, &turn);
    let yaw =
        |answer: &Value| answer["samples"].as_array().unwrap().last().unwrap()["yaw_deg"].as_f64();
    assert!(yaw(&turned).unwrap() > 5.0, "{turned}");
    assert!(turned["scene"].as_str().unwrap().len() > 1000);
    let wait = json!({"rim_speed_m_s": 0.0, "slope_deg": 0, "dt_s": 3});
    let stood = step(&server, turned["state"].as_str(), &wait);
    assert!((yaw(&stood).unwrap() - yaw(&turned).unwrap()).abs() < 1.0, "{stood}");
    assert_eq!(stood["outcome"], Value::Null);
    let steep = json!({"rim_speed_m_s": 0.06, "slope_deg": 35, "yaw_deg": 90, "dt_s": 10});
    let ended = step(&server, None, &steep);
    assert!(ended["outcome"].is_string() && ended["reason"].is_string(), "{ended}");
    // A drive that has ended stays where it is.
    let after = step(&server, ended["state"].as_str(), &steep);
    assert_eq!((&after["outcome"], &after["samples"][0]), (&ended["outcome"], &after["final"]));
}

/// A drive that is saved is a log, of one header and a row for each tenth of a second: what replays
/// logs finds nothing wrong with it.
#[test]
fn a_drive_is_a_log_that_is_replayed() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_owned();
    let server = Served::start(&Settings { folder: Some(place.clone()), ..Settings::default() });
    let mut csv = String::new();
    let mut state: Option<String> = None;
    for rims in [json!(0.06), json!([0.05, 0.06]), json!(0.06), json!([0.06, 0.05])] {
        let asked = json!({"rim_speed_m_s": rims, "dt_s": 10, "telemetry": true});
        let answer = step(&server, state.as_deref(), &asked);
        state = answer["state"].as_str().map(str::to_owned);
        csv.push_str(answer["telemetry"]["csv"].as_str().unwrap());
        assert_eq!(answer["telemetry"]["command"], "grouser replay drive.csv --soil toyoura");
    }
    let times: Vec<f64> =
        csv.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
    assert!(csv.starts_with("time_s,") && times.len() == 401, "{} rows", times.len());
    assert!(times.windows(2).all(|pair| (pair[1] - pair[0] - 0.1).abs() < 1e-9));
    std::fs::write(place.join("drive.csv"), csv).unwrap();
    let reply = server.post("replay", &json!({"log": "drive.csv", "soil": "toyoura"}));
    assert_eq!(reply.status, 200, "{reply:?}");
    let found = reply.lines().into_iter().find(|it| it["schema"] == "grouser.replay.v1").unwrap();
    let said = found["points_to"][0].as_str().unwrap();
    assert!(said.contains("point to nothing"), "{said}");
    let channels = found["channels"].as_array().unwrap();
    let forward = channels.iter().find(|it| it["channel"] == "forward_speed_m_s").unwrap();
    assert!(forward["rms"].as_f64().unwrap() < 2e-3, "{forward}");
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    let server = Served::usual();
    let first = step(&server, None, &json!({"rim_speed_m_s": 0.06}));
    let state = first["state"].as_str().unwrap();
    let mut damaged = state.to_owned();
    damaged.replace_range(100..104, "AAAA");
    for (key, words, wrong) in [
        ("state", "another scenario", json!({"slope_deg": 6, "state": state})),
        ("state", "another scenario", json!({"rover": "viper", "slope_deg": 5, "state": state})),
        ("state", "base64", json!({"slope_deg": 5, "state": "ä"})),
        ("state", "state of an answer", json!({"slope_deg": 5, "state": "Zm9v"})),
        ("state", "damaged", json!({"slope_deg": 5, "state": damaged})),
        ("dt_s", "from 0.01 to 10", json!({"dt_s": 11})),
        ("rim_speed_m_s", "3 numbers", json!({"rim_speed_m_s": [0, 0, 0]})),
        ("rim_speed_m_s", "it must be from", json!({"rim_speed_m_s": 1e9})),
        ("duration_s", "no such key", json!({"duration_s": 5})),
        ("model", "one model", json!({"model": "all"})),
    ] {
        let mut asked = json!({"soil": "toyoura"});
        asked.as_object_mut().unwrap().extend(wrong.as_object().unwrap().clone());
        let reply = server.post("drive-step", &asked);
        assert_eq!(reply.status, 422, "{wrong}");
        let refusal = reply.lines().remove(0);
        assert_eq!(refusal["key"], key, "{wrong}: {refusal}");
        assert!(refusal["error"].as_str().unwrap().contains(words), "{wrong}: {refusal}");
    }
}
