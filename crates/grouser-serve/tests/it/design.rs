//! Designs: searched with their progress, and stopped with who asked for them.

use std::io::Read as _;
use std::time::Instant;

use grouser::answers::AnswerOptions;
use grouser::answers::design::DesignQuestion;
use grouser::document::{self, Kind, Overrides, Source, json};
use grouser_serve::{Limits, Settings};
use serde_json::{Value, json};

use crate::served::Served;

const LIGHTER: &str = "design-lighter-wheels";

#[test]
fn a_design_is_the_librarys_after_its_progress() {
    let server = Served::usual();
    let asked = json!({"design": LIGHTER, "set": {"design.subject_to.limit_slope_deg.at_least": 20},
                       "trade": ["energy_j_per_m", "wheel_mass_kg"], "nominal": true, "figures": true,
                       "slide": true});
    let reply = server.post("design", &asked);
    assert_eq!(reply.status, 200, "{reply:?}");
    let lines = reply.lines();
    let [progress @ .., answer, shown] = &lines[..] else { panic!("{lines:?}") };
    assert!(progress.iter().all(|it| it["schema"] == "grouser.progress.v1"), "{progress:?}");
    let done: Vec<u64> = progress.iter().map(|it| it["done"].as_u64().unwrap()).collect();
    assert!(!done.is_empty() && done.is_sorted(), "{done:?}");
    let overrides = Overrides::parse(["design.subject_to.limit_slope_deg.at_least=20"]).unwrap();
    let source = Source::find(Kind::Design, LIGHTER).unwrap();
    let question = DesignQuestion {
        task: document::read_design(&source, &overrides).unwrap(),
        is_nominal: true,
        seed: 1,
        trade: Some(["energy_j_per_m", "wheel_mass_kg"].map(measure)),
        by_models: Vec::new(),
    };
    let expected = question.answer("design", &AnswerOptions::ROWS).unwrap();
    let line = reply.body.lines().nth(lines.len() - 2).unwrap();
    assert_eq!(line, json::line(&expected));
    assert!(answer["constraints"][0]["price"].is_number());
    let command = format!(
        "grouser design {LIGHTER} --set design.subject_to.limit_slope_deg.at_least=20 --trade \
         energy_j_per_m,wheel_mass_kg --nominal"
    );
    assert_eq!(shown["command"], command.as_str());
    // Limits, designs, and those along the trade-off; its curve and its wheels.
    assert_eq!(shown["tables"].as_array().unwrap().len(), 3);
    assert_eq!(shown["tables"][2]["rows"].as_array().unwrap().len(), 9);
    assert_eq!(shown["figures"].as_array().unwrap().len(), 2);
    let slide = shown["slide"].as_str().unwrap();
    assert!(slide.contains("viewBox=\"0 0 320 180\""), "{}", &slide[..200]);
}

fn measure(name: &str) -> document::design::Measure {
    document::design::Measure::ALL.into_iter().find(|it| it.name() == name).unwrap()
}

#[test]
fn a_task_has_its_numbers_and_its_errors_name_their_keys() {
    let server = Served::usual();
    let task = server.post("design-task", &json!({ "design": LIGHTER })).lines().remove(0);
    let keys: Vec<&Value> = task["keys"].as_array().unwrap().iter().map(|it| &it["key"]).collect();
    assert!(keys.contains(&&json!("design.subject_to.limit_slope_deg.at_least")), "{keys:?}");
    assert!(keys.contains(&&json!("design.slope_deg")), "{keys:?}");
    for (body, key) in [
        (json!({}), "design"),
        (json!({"design": "../design.toml"}), "design"),
        (json!({"design": LIGHTER, "trade": ["mass"]}), "trade"),
        (json!({"design": LIGHTER, "trade": ["width_m"]}), "trade"),
        (json!({"design": LIGHTER, "samples": 8}), "samples"),
        (json!({"design": LIGHTER, "set": {"design.slope_deg": 99}}), "design.slope_deg"),
    ] {
        let reply = server.post("design", &body);
        assert_eq!(reply.status, 422, "{body}: {reply:?}");
        assert_eq!(reply.lines()[0]["key"], key, "{body}");
    }
    // Each end of what is free has a key of its own, and its own error.
    let ends = |body: Value| server.post("design-task", &body).lines().remove(0)["free"].clone();
    let [least, most] =
        [0, 1].map(|end| format!("design.free.rover.wheel_unit.wheel.radius_m.{end}"));
    let set = |of: &[(&str, f64)]| {
        let set: Value = of.iter().map(|(key, value)| ((*key).to_owned(), json!(value))).collect();
        json!({ "design": LIGHTER, "set": set })
    };
    let free = ends(set(&[(&most, 0.12)]));
    let radius: Vec<&Value> = free.as_array().unwrap().iter().take(2).collect();
    assert_eq!((&radius[0]["key"], &radius[0]["value"]), (&json!(least), &json!(0.06)));
    assert_eq!((&radius[1]["key"], &radius[1]["value"]), (&json!(most), &json!(0.12)));
    assert!(radius[0]["minimum"].is_number() && radius[0]["unit"] == "m", "{free}");
    for (of, key) in [
        (&[(&*least, 0.3)][..], &least),
        (&[(&most, 0.01)], &most),
        (&[(&least, -1.0)], &least),
        (&[(&least, 0.07), (&most, 1e3)], &most),
    ] {
        let reply = server.post("design-task", &set(of));
        assert_eq!((reply.status, &reply.lines()[0]["key"]), (422, &json!(key)), "{reply:?}");
    }
    // Where no design keeps the limits, the nearest one says which it misses.
    let limits = json!({"design.subject_to.sinkage_ratio.at_most": 0.001});
    let none = server.post("design", &json!({"design": LIGHTER, "nominal": true, "set": limits}));
    let last = none.lines().pop().unwrap();
    assert!(last["error"].as_str().unwrap().contains("misses sinkage_ratio"), "{last}");
}

/// One place: the next search has it as soon as the first one is not asked for any more.
#[test]
fn a_search_ends_with_who_asked_for_it() {
    let limits = Limits { runs: 1, ..Limits::default() };
    let server = Served::start(&Settings { limits, ..Settings::default() });
    let long = json!({"design": LIGHTER, "set": {"design.soil": "toyoura-uncertain"},
                      "trade": ["energy_j_per_m", "wheel_mass_kg"]});
    let mut stream = server.begin("design", &long);
    let mut first = [0; 64];
    stream.read_exact(&mut first).unwrap();
    assert!(first.starts_with(b"HTTP/1.1 200"));
    drop(stream);
    let since = Instant::now();
    let next = server.post("design", &json!({"design": LIGHTER, "nominal": true}));
    assert_eq!(next.status, 200);
    // The long search takes minutes.
    assert!(since.elapsed().as_secs() < 30, "{:?}", since.elapsed());
}
