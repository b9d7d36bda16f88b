//! What is answered: what the library answers, in its words, line by line.

use grouser::answers::AnswerOptions;
use grouser::answers::heading::HeadingQuestion;
use grouser::document::{self, Kind, Overrides, Source, json};
use grouser::studies::heading::Steering;
use grouser::studies::verdict::Rule;
use serde_json::json;

use crate::served::Served;

#[test]
fn an_answer_is_the_librarys_byte_for_byte() {
    let server = Served::usual();
    let reply = server.post(
        "heading",
        &json!({"soil": "toyoura", "slope_deg": 10, "set": {"soil.friction_angle_deg": 36.5}, "nominal": true}),
    );
    assert_eq!(reply.status, 200, "{reply:?}");
    assert!(reply.head.contains("content-type: application/x-ndjson"));
    let set = ["scenario.soil=toyoura", "soil.friction_angle_deg=36.5"];
    let overrides = Overrides::parse(set).unwrap();
    let scenario = document::read_scenario(&Source::default_scenario(), &overrides).unwrap();
    let question = HeadingQuestion {
        scenarios: vec![scenario],
        slopes_deg: vec![10.0],
        steering: Steering::None,
        most_speed_ratio: None,
        sampling: None,
        rule: Rule::DEFAULT,
        gradients: None,
    };
    let answer = question.answer("heading", &AnswerOptions::ROWS).unwrap();
    assert_eq!(reply.body, json::line(&answer) + "\n");
}

#[test]
fn stages_come_one_after_another_with_their_commands() {
    let server = Served::usual();
    let reply = server.post(
        "heading",
        &json!({"soil": "toyoura-uncertain", "slope_deg": 10, "stages": [0, 8], "shown": true}),
    );
    let lines = reply.lines();
    let schemas: Vec<_> = lines.iter().map(|line| line["schema"].as_str().unwrap()).collect();
    let stage = ["grouser.heading.v1", "grouser.shown.v1"];
    assert_eq!(schemas, [stage, stage].concat());
    assert!(lines[0]["rows"][0].get("yaw_deg_p2_5").is_none());
    assert!(lines[2]["rows"][0]["yaw_deg_p2_5"].is_number());
    let command = "grouser heading --soil toyoura-uncertain --slope-deg 10";
    assert_eq!(lines[1]["command"], format!("{command} --nominal"));
    assert_eq!(lines[3]["command"], format!("{command} --samples 8 --seed 1"));
    assert!(lines[3]["documents"]["scenario.toml"].as_str().unwrap().contains("[soil]"));
}

#[test]
fn errors_name_their_key_in_the_engines_words() {
    let server = Served::usual();
    for (question, body, key, words) in [
        (
            "heading",
            json!({"set": {"soil.friction_angle_deg": 99}}),
            "soil.friction_angle_deg",
            "it must be 5 to 60",
        ),
        (
            "heading",
            json!({"set": {"soil.frction_angle_deg": 30}}),
            "soil.frction_angle_deg",
            "frction_angle_deg",
        ),
        ("heading", json!({"slope_deg": 70}), "slope_deg", "it must be from 0 to 60"),
        ("heading", json!({"slope": 7}), "slope", "no such key"),
        ("heading", json!({"rover": "hakutoo"}), "rover", "no rover preset"),
        ("heading", json!({"model": "ishigamy"}), "model", "ishigamy"),
        ("heading", json!({"gravity_m_s2": 99}), "gravity_m_s2", "99"),
        ("heading", json!({"gravity_m_s2": "mon"}), "gravity_m_s2", "name of a gravity"),
        ("heading", json!({"samples": 1}), "samples", "whole number from 2"),
        ("heading-map", json!({"course_deg": 99}), "course_deg", "from -90 to 90"),
        ("wheel-test", json!({"gradients": ["soil.nothing"]}), "gradients", "soil.nothing"),
        ("wheel-drawing", json!({"slip_ratio": 2}), "slip_ratio", "from -0.9 to 1"),
        (
            "stand",
            json!({"set": {"soil.cohesion_kpa": {"a": 1}}}),
            "soil.cohesion_kpa",
            "it must be a number",
        ),
    ] {
        let reply = server.post(question, &body);
        assert_eq!(reply.status, 422, "{body}: {reply:?}");
        let error = reply.lines().remove(0);
        assert_eq!(error["key"], key, "{body}: {error}");
        assert!(error["error"].as_str().unwrap().contains(words), "{body}: {error}");
    }
    for body in ["", "{", "[]", "7", "\"a\"", "{\"slope_deg\": NaN}"] {
        let reply = server.ask("POST", "/api/heading", "Content-Type: application/json\r\n", body);
        assert_eq!(reply.status, 400, "{body}: {reply:?}");
    }
}

#[test]
fn sliders_are_made_of_rows() {
    let server = Served::usual();
    let session = server.post("scenario", &json!({"soil": "toyoura-uncertain"})).lines().remove(0);
    let keys = session["keys"].as_array().unwrap();
    let key = |name: &str| keys.iter().find(|it| it["key"] == name).unwrap();
    let friction = key("soil.friction_angle_deg");
    let range = document::range(Kind::Soil, "friction_angle_deg").unwrap();
    assert_eq!(friction["value"], 38.0);
    assert_eq!(friction["minimum"].as_f64(), Some(*range.start()));
    assert_eq!(friction["maximum"].as_f64(), Some(*range.end()));
    assert_eq!(friction["unit"], "°");
    assert_eq!(friction["meaning"], "Angle of internal friction, φ [°].");
    assert_eq!(friction["is_uncertain"], true);
    assert_eq!(key("soil.cohesion_kpa")["is_uncertain"], false);
    // Each may be set as it is.
    let set: serde_json::Map<_, _> = keys
        .iter()
        .map(|it| (it["key"].as_str().unwrap().to_owned(), it["value"].clone()))
        .collect();
    let reply = server.post("scenario", &json!({"soil": "toyoura-uncertain", "set": set}));
    assert_eq!(reply.status, 200, "{reply:?}");
}

#[test]
fn the_wheel_is_drawn_with_its_numbers() {
    let server = Served::usual();
    let drawn =
        server.post("wheel-drawing", &json!({"load_n": 20, "slip_ratio": 0.3})).lines().remove(0);
    let names: Vec<_> =
        drawn["drawings"].as_array().unwrap().iter().map(|it| &it["name"]).collect();
    assert_eq!(names, ["wheel", "shear", "bulldozing"]);
    assert!(drawn["drawings"][0]["svg"].as_str().unwrap().contains("20.0 N"));
}

#[test]
fn hostile_names_come_back_as_text() {
    let folder = tempfile::tempdir().unwrap();
    let hostile = "</script><img src=x onerror=alert(1)>\\u202e\\u001b[31m";
    let sand = document::preset(Kind::Soil, "toyoura").unwrap().text;
    let sand = sand.replace("Toyoura sand", hostile);
    assert!(sand.contains(hostile));
    std::fs::write(folder.path().join("sand.toml"), sand).unwrap();
    let settings =
        grouser_serve::Settings { folder: Some(folder.path().to_owned()), ..Default::default() };
    let server = Served::start(&settings);
    let reply = server.post(
        "heading",
        &json!({"soil": "sand.toml", "stages": [0, 8], "shown": true, "figures": true}),
    );
    assert_eq!(reply.status, 200, "{reply:?}");
    // No browser takes it for a page, no terminal for a command, and it is the same text again.
    assert!(reply.head.contains("content-type: application/x-ndjson"));
    assert!(!reply.body.chars().any(|c| document::escape::is_hidden(c) && c != '\n'));
    let first = reply.lines().remove(0);
    let name = first["inputs"]["soil"]["name"].as_str().unwrap();
    assert_eq!(name, "</script><img src=x onerror=alert(1)>\u{202e}\u{1b}[31m");
    for line in reply.lines() {
        for figure in line["figures"].as_array().into_iter().flatten() {
            assert!(!figure["svg"].as_str().unwrap().contains("<img"));
        }
    }
}

/// 16 to 9, with the first sentence of the answer and the command that gives it again.
#[test]
fn every_answer_with_a_picture_has_a_slide() {
    let server = Served::usual();
    for (question, body) in [
        ("heading", json!({"slope_deg": 10, "nominal": true, "slide": true})),
        ("heading-map", json!({"slope_deg": [5, 10], "course_deg": [0, 30], "slide": true})),
        ("wheel-test", json!({"slip_ratio": [0, 0.2, 0.4], "slide": true})),
        ("traverse", json!({"slope_deg": 10, "duration_s": 2, "slide": true})),
    ] {
        let shown = server.post(question, &body).lines().pop().unwrap();
        let slide = shown["slide"].as_str().unwrap();
        assert!(slide.contains("viewBox=\"0 0 320 180\""), "{question}");
        let command = shown["command"].as_str().unwrap();
        assert!(slide.contains(&format!(">{command}</text>")), "{question}: {command}");
    }
}

#[test]
fn a_wheel_is_that_of_the_questions_rover() {
    let server = Served::usual();
    let asked = json!({"rover": "viper", "soil": "toyoura", "slip_ratio": 0.2, "shown": true});
    let shown = server.post("wheel-test", &asked).lines().remove(1);
    let command = shown["command"].as_str().unwrap();
    assert!(command.contains("--wheel viper-engineering"), "{command}");
    let stand = server.post("stand", &json!({"rover": "rashid"})).lines().remove(0);
    assert_eq!(stand["names"]["wheel"], "Rashid-1 wheel");
    // One that is named comes first.
    let stand = server.post("stand", &json!({"rover": "rashid", "wheel": "lrv"})).lines().remove(0);
    assert_eq!(stand["names"]["wheel"], "Lunar Roving Vehicle wheel");
}
