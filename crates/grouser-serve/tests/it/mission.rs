//! Missions: their legs may be changed, and drive as the library has it.

use grouser::document::columns::mission::MissionObject;
use grouser::document::{self, Kind, Overrides, Source};
use grouser::mission::Limited;
use grouser::studies::mission::DrivenMission;
use serde_json::{Value, json};

use crate::served::Served;

#[test]
fn a_mission_drives_the_legs_that_it_is_given() {
    let server = Served::usual();
    let task = server.post("mission-task", &json!({"mission": "there-and-back"})).lines().remove(0);
    assert_eq!(task["legs"].as_array().unwrap().len(), 3);
    let keys: Vec<&Value> = task["keys"].as_array().unwrap().iter().map(|it| &it["key"]).collect();
    assert!(keys.contains(&&json!("mission.stop.slip_ratio.above")), "{keys:?}");
    let legs = json!([{"drive_m": 0.5, "yaw_deg": 5.0}, {"goto": {"x_m": 1.0, "y_m": 0.1}}]);
    let asked = json!({"mission": "there-and-back", "set": {"mission.leg": legs}, "figures": true,
                       "slide": true});
    let lines = server.post("mission", &asked).lines();
    let text = "mission.leg=[{drive_m=0.5,yaw_deg=5.0},{goto={x_m=1.0,y_m=0.1}}]";
    let source = Source::find(Kind::Mission, "there-and-back").unwrap();
    let mission = document::read_mission(&source, &Overrides::parse([text]).unwrap()).unwrap();
    let driven = DrivenMission::all(&mission.value.missions()).unwrap();
    let expected = json!(MissionObject { mission: &driven[0], believed: None });
    for (key, value) in expected.as_object().unwrap() {
        assert_eq!(lines[0][key], *value, "{key}");
    }
    let shown = &lines[1];
    assert_eq!(shown["tables"][0]["rows"].as_array().unwrap().len(), 2);
    assert!(shown["run"]["samples"].as_array().unwrap().len() > 10);
    assert_eq!(shown["verdict"], "Completed, leg 2 of 2");
    assert!(shown["slide"].as_str().unwrap().contains("viewBox=\"0 0 320 180\""));
    for (key, wrong) in [
        ("mission", json!({"mission": "../mission.toml"})),
        (
            "mission.leg",
            json!({"mission": "there-and-back", "set": {"mission.leg": [{"fly_m": 1}]}}),
        ),
        ("samples", json!({"mission": "there-and-back", "samples": 8})),
    ] {
        let reply = server.post("mission", &wrong);
        assert_eq!(reply.status, 422, "{wrong}");
        assert_eq!(reply.lines()[0]["key"], key, "{wrong}: {reply:?}");
    }
}

#[test]
fn a_mission_begins_from_blank_and_takes_limits() {
    let server = Served::usual();
    let set = json!({"mission.rover": "spirit", "mission.soil": "mars-sand",
                     "mission.stop.sinkage_over_radius.above": 0.01});
    let asked = json!({"mission": "blank", "set": set});
    let task = server.post("mission-task", &asked).lines().remove(0);
    assert_eq!(task["names"]["soil"], "Mars sand, student code");
    let limits = task["limits"].as_array().unwrap();
    assert_eq!(limits.len(), Limited::ALL.len());
    let roll = limits.iter().find(|it| it["key"] == "mission.stop.roll_deg.above").unwrap();
    assert_eq!((&roll["label"], &roll["maximum"]), (&json!("roll [°]"), &json!(90.0)));
    let lines =
        server.post("mission", &json!({"mission": "blank", "set": set, "shown": true})).lines();
    assert_eq!(lines[0]["outcome"], "stopped");
    let command = lines[1]["command"].as_str().unwrap();
    assert!(command.contains("mission.rover=\"spirit\""), "{command}");
}
