//! Fits: a soil calibrated on the wheel tests of the folder, with its progress.

use std::fs;

use grouser_serve::Settings;
use serde_json::json;

use crate::served::Served;

/// Simulated with a longitudinal shear modulus of 0.036 m.
const TESTS: &str =
    include_str!("../../../grouser/data/experiments/simulated-wheel-test/toyoura-20n.csv");

#[test]
fn a_soil_is_fitted_to_the_wheel_tests_of_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tests.csv"), TESTS).unwrap();
    let settings = Settings { folder: Some(folder.path().to_owned()), ..Settings::default() };
    let server = Served::start(&settings);
    let files = server.ask("GET", "/api/files", "", "").lines().remove(0);
    assert_eq!(files["rows"], json!([{"kind": "measurements", "path": "tests.csv"}]));
    let asked = json!({
        "data": "tests.csv", "wheel": "hakuto", "soil": "toyoura", "where": ["slip_angle_deg=0"],
        "set": {"soil.shear.longitudinal_m": 0.1}, "fit": ["soil.shear.longitudinal_m"], "steps": 200,
    });
    let lines = server.post("fit", &asked).lines();
    let [progress @ .., answer, shown] = &lines[..] else { panic!("{lines:?}") };
    let counted = |what: &str| progress.iter().any(|it| it["what"] == what);
    assert!(counted("searches of least squares") && counted("blocks of the posterior"));
    // As the guide to calibration has it.
    let row = &answer["rows"][0];
    assert_eq!((&row["key"], &row["start"]), (&json!("soil.shear.longitudinal_m"), &json!(0.1)));
    let fit = row["fit"].as_f64().unwrap();
    assert!((fit - 0.0358).abs() < 5e-5, "{row}");
    assert!(row["p2_5"].as_f64().unwrap() < 0.036 && row["p97_5"].as_f64().unwrap() > 0.036);
    assert_eq!(
        shown["command"],
        "grouser calibrate --data tests.csv --soil toyoura --wheel hakuto --set \
         soil.shear.longitudinal_m=0.1 --fit soil.shear.longitudinal_m --where slip_angle_deg=0 \
         --steps 200"
    );
    assert!(shown["documents"]["soil.toml"].as_str().unwrap().contains("tests.csv"));
    assert!(shown["documents"]["soil-samples.csv"].is_string());
    assert_eq!(shown["tables"][0]["rows"].as_array().unwrap().len(), 1);
    let errors = &shown["tables"][2]["rows"][0];
    assert_eq!(errors["rmse"], answer["overall"][errors["quantity"].as_str().unwrap()]["rmse"]);
    // The posterior of the one number is the first figure.
    let corner = shown["figures"].as_array().unwrap().first().unwrap();
    let svg = corner["svg"].as_str().unwrap();
    assert!(svg.contains("shear longitudinal [m]"), "{svg}");
    assert!(corner["caption"].as_str().unwrap().contains("95 % interval"), "{corner}");
    for (key, wrong) in [
        ("data", json!({"data": "../tests.csv", "fit": ["soil.friction_angle_deg"]})),
        ("data", json!({"data": "absent.csv", "fit": ["soil.friction_angle_deg"]})),
        ("data", json!({"fit": ["soil.friction_angle_deg"]})),
        ("fit", json!({"data": "tests.csv", "fit": ["friction_angle_deg"]})),
        ("fit", json!({"data": "tests.csv", "fit": ["soil.nothing"]})),
        ("where", json!({"data": "tests.csv", "fit": ["soil.friction_angle_deg"], "where": "a"})),
    ] {
        let reply = server.post("fit", &wrong);
        assert_eq!(reply.status, 422, "{wrong}");
        assert_eq!(reply.lines()[0]["key"], key, "{wrong}: {reply:?}");
    }
}

#[test]
fn a_fit_says_how_its_numbers_go_together() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tests.csv"), TESTS).unwrap();
    let settings = Settings { folder: Some(folder.path().to_owned()), ..Settings::default() };
    let server = Served::start(&settings);
    let keys = ["soil.shear.longitudinal_m", "soil.friction_angle_deg"];
    let asked = json!({
        "data": "tests.csv", "wheel": "hakuto", "soil": "toyoura", "where": ["slip_angle_deg=0"],
        "fit": keys, "steps": 200,
    });
    let lines = server.post("fit", &asked).lines();
    let shown = lines.last().unwrap();
    let rows = &shown["tables"][1]["rows"];
    let between = rows[0][keys[1]].as_f64().unwrap();
    assert!((0.0..1.0).contains(&between.abs()) && rows[1][keys[0]] == between, "{rows}");
    assert!((rows[0][keys[0]].as_f64().unwrap() - 1.0).abs() < 1e-12, "{rows}");
    // The picture says the same to who does not see it.
    let caption = shown["figures"].as_array().unwrap().first().unwrap()["caption"].clone();
    let said = format!("shear longitudinal [m] and friction angle [°]: {between:.2}.");
    assert!(caption.as_str().unwrap().contains(&said), "{caption}: {between}");
}

#[test]
fn a_fit_goes_without_some_trials_by_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tests.csv"), TESTS).unwrap();
    let settings = Settings { folder: Some(folder.path().to_owned()), ..Settings::default() };
    let server = Served::start(&settings);
    let asked = json!({"data": "tests.csv", "wheel": "hakuto", "where": "slip_angle_deg=0"});
    let task = server.post("fit-task", &asked).lines().remove(0);
    let trials = task["rows"].as_array().unwrap();
    let line = trials[1]["line"].as_u64().unwrap();
    assert!(trials[1]["drawbar_pull_n"].is_number() && trials[1]["load_n"].is_number());
    let without = format!("line!={line}");
    let asked = json!({
        "data": "tests.csv", "wheel": "hakuto", "soil": "toyoura", "point_fit": true,
        "where": ["slip_angle_deg=0", without], "fit": ["soil.shear.longitudinal_m"],
    });
    let shown = server.post("fit", &asked).lines().pop().unwrap();
    let words = format!("without 1 of {} trials, by their lines", trials.len());
    assert!(shown["sentences"].as_array().unwrap().contains(&json!(words)), "{shown}");
    assert!(shown["command"].as_str().unwrap().contains(&format!("--where 'line!={line}'")));
}

#[test]
fn data_sets_say_what_they_lack_and_with_what_they_were_measured() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tests.csv"), TESTS).unwrap();
    fs::write(folder.path().join("log.csv"), "time_s,x_m\n0,1\n").unwrap();
    let set = "schema = \"data-set/1\"\nname = \"ours\"\nsource = \"ours\"\nfile = \"tests.csv\"\n\
               [[case]]\nname = \"all\"\nwheel = \"hakuto\"\nsoils = [\"toyoura\"]\n";
    fs::write(folder.path().join("ours.toml"), set).unwrap();
    let settings = Settings { folder: Some(folder.path().to_owned()), ..Settings::default() };
    let server = Served::start(&settings);
    let list = server.ask("GET", "/api/data-sets", "", "").lines().remove(0);
    let of = |name: &str| {
        let rows = list["rows"].as_array().unwrap();
        rows.iter().find(|row| row["name"] == name).unwrap().clone()
    };
    let part = json!({"name": "all", "wheel": "hakuto", "soils": ["toyoura"], "where": []});
    assert_eq!((&of("tests.csv")["lacks"], &of("tests.csv")["parts"][0]), (&json!(null), &part));
    assert!(of("log.csv")["lacks"].is_string());
    let smooth = &of("cmu-single-wheel")["parts"][0];
    assert_eq!(smooth["wheel"], "cmu-smooth");
    assert_eq!(of("cmu-single-wheel")["lacks"], json!(null));
    for name in ["hakuto-slope", "viper-slip-slope"] {
        let lacks = of(name)["lacks"].as_str().unwrap().to_owned();
        assert!(lacks.contains("the load is missing"), "{name}: {lacks}");
    }
}
