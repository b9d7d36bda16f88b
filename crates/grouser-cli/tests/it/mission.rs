//! `mission`: what it answers, what it refuses, what it leaves in a folder.

use insta::assert_snapshot;
use serde_json::Value;

use crate::bad_input::check_is_refusal;
use crate::program::{Place, keys, number};

fn begins(legs: &str) -> String {
    format!("schema = \"mission/1\"\nname = \"a drive\"\n{legs}")
}

/// The command's contract: what each leg, the end and the whole have.
#[test]
fn a_mission_answers_with_its_legs_and_its_end() {
    let place = Place::new();
    place.write(
        "m.toml",
        begins("slope_deg = 8.0\n[[leg]]\ndrive_m = 0.5\nyaw_deg = 5.0\n[[leg]]\ndrive_m = -0.2\n"),
    );
    let answer = place.json("mission m.toml");
    assert_eq!(answer["schema"], "grouser.mission.v1");
    assert_eq!(answer["outcome"], "completed");
    assert_eq!(keys(&answer["final"]), ["time_s", "x_m", "y_m", "yaw_deg"]);
    let legs = answer["legs"].as_array().expect("legs");
    assert_eq!(legs.len(), 2);
    for (leg, distance) in legs.iter().zip([0.5, 0.2]) {
        assert!((number(&leg["distance_m"]) - distance).abs() < 1e-6, "{leg}");
        assert_eq!(leg["outcome"], "completed");
        assert_eq!(leg["stopped_by"], Value::Null);
        assert!(number(&leg["time_s"]) > 0.0 && leg["slip_ratio"].is_number());
    }
    let energy: f64 = legs.iter().map(|leg| number(&leg["energy_j"])).sum();
    assert!((number(&answer["energy_j"]) - energy).abs() < 1e-9);
}

/// A leg straight on is a traverse, by either command, to the digits that matter.
#[test]
fn a_straight_leg_is_a_traverse() {
    let place = Place::new();
    place.write("m.toml", begins("slope_deg = 12.0\n[[leg]]\ndrive_m = 0.4\nyaw_deg = 7.0\n"));
    let mission = place.json("mission m.toml");
    let time = number(&mission["legs"][0]["time_s"]);
    let line = format!("traverse --slope-deg 12 --yaw-deg 7 --duration-s {time}");
    let traverse = place.json(&line);
    for key in ["x_m", "y_m", "yaw_deg", "time_s"] {
        let [one, other] = [&mission, &traverse].map(|it| number(&it["final"][key]));
        assert!((one - other).abs() < 1e-8, "{key}: {one} {other}");
    }
}

#[test]
fn a_limit_stops_the_rover_and_it_backs_out() {
    let place = Place::new();
    let answer = place.json("mission back-out");
    let leg = &answer["legs"][0];
    assert_eq!(answer["outcome"], "stopped");
    assert_eq!(
        (&leg["stopped_by"], &leg["stopped_kind"]),
        (&"slip_ratio".into(), &"reactive".into())
    );
    assert!(number(&leg["slip_ratio"]) > 0.6, "{leg}");
    assert!((number(&leg["back_out_m"]) - 0.5).abs() < 1e-6, "{leg}");
    let shown = place.line("mission back-out").stdout;
    for of_motors in ["battery_energy_j", "current_a", "state_of_charge"] {
        assert!(!shown.contains(of_motors), "no motor is known: {shown}");
    }
    assert!(
        shown.contains("leg 1: stopped: slip ratio 0.66 over 0.5 m after 0.17 m; backed out 0.5 m"),
        "{shown}"
    );
}

/// A speed is for all wheels, or one for each; a leg keeps those of the leg before.
#[test]
fn speeds_are_for_all_wheels_or_one_for_each_and_stay() {
    let place = Place::new();
    let legs = |first: &str| {
        let then = "[[leg]]\ndrive_m = 0.2\n[[leg]]\ndrive_m = 0.2\n";
        let speeds = "speed_m_s = [0.03, 0.03, 0.03, 0.03]\n";
        begins(&format!(
            "slope_deg = 0.0\n[[leg]]\ndrive_m = 0.2\nspeed_m_s = {first}\n{then}{speeds}"
        ))
    };
    place.write("m.toml", legs("0.03"));
    let times = |line: &str| -> Vec<f64> {
        let answer = place.json(line);
        let legs = answer["legs"].as_array().expect("legs");
        legs.iter().map(|leg| number(&leg["time_s"])).collect()
    };
    let slow = times("mission m.toml");
    assert!((slow[0] - 0.2 / (0.95 * 0.03)).abs() < 0.3, "{slow:?}");
    assert!(slow.iter().all(|time| (time - slow[0]).abs() < 0.1), "{slow:?}");
    let fast = times("mission m.toml --set mission.leg.0.speed_m_s=0.06");
    assert!((slow[0] / fast[0] - 2.0).abs() < 0.02 && (slow[1] / fast[1] - 2.0).abs() < 0.02);
    assert_eq!(
        slow[2],
        times("mission m.toml --set mission.leg.0.speed_m_s=[0.03,0.03,0.03,0.03]")[2]
    );
}

#[test]
fn alternatives_are_compared_in_a_table_and_are_objects_of_their_own() {
    let place = Place::new();
    let leg = |name: &str, yaw: f64, way: f64| {
        format!(
            "[[alternative]]\nname = \"{name}\"\n[[alternative.leg]]\nyaw_deg = {yaw:?}\ndrive_m = {way:?}\n"
        )
    };
    let ways = leg("forward", 90.0, 0.3) + &leg("backward", -90.0, -0.3);
    place.write("m.toml", begins(&ways));
    let csv = place.results("mission m.toml --format csv");
    let names: Vec<&str> = csv.lines().map(|line| line.split(',').next().unwrap_or("")).collect();
    assert_eq!(names, ["alternative", "forward", "backward"]);
    let answer = place.json("mission m.toml");
    let both = answer["alternatives"].as_array().expect("two ways");
    assert!(both.iter().all(|way| (number(&way["final"]["y_m"]) - 0.3).abs() < 1e-6), "{both:?}");
    assert_eq!(place.line("mission m.toml --nominal --out out").code(), 0);
    for file in ["legs-1.csv", "records-2.csv", "path-2.svg", "report.html", "mission.toml"] {
        assert!(place.file(&format!("out/{file}")).exists(), "{file}");
    }
    let refused = check_is_refusal(&place.line("mission m.toml --mcap m.mcap"), 2);
    assert!(refused.contains("alternatives"), "{refused}");
}

/// The folder has all that repeats the mission, whatever file its legs came from.
#[test]
fn legs_come_from_files_and_the_folder_repeats_them() {
    let place = Place::new();
    place.write(
        "legs.csv",
        "drive_m,turn_deg,goto.x_m,goto.y_m,speed_m_s\n0.3,,,,0.05\n,,0.6,0.05,\n",
    );
    place.write(
        "legs.geojson",
        r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "properties":
        {"speed_m_s": 0.05, "fid": 3}, "geometry": {"type": "LineString", "coordinates": [[0.3, 0], [0.6, 0.05]]}}]}"#,
    );
    place.write(
        "m.toml",
        begins("slope_deg = 3.0\nlegs_from = \"legs.csv\"\n[[leg]]\nwait_s = 1.0\n"),
    );
    let line = place.line("mission m.toml --nominal --format json");
    assert!(
        line.stderr.contains("after its 2 legs come the mission's own, 3\n"),
        "{}",
        line.stderr
    );
    let answer: Value = serde_json::from_str(&line.stdout).expect("JSON");
    let legs = answer["legs"].as_array().expect("legs");
    let what: Vec<&str> = legs.iter().filter_map(|leg| leg["manoeuvre"].as_str()).collect();
    assert_eq!(what, ["drive 0.3 m", "go to 0.6, 0.05 m", "wait 1 s"]);
    assert_eq!(place.line("mission m.toml --nominal --out out").code(), 0);
    let written: Value =
        serde_json::from_str(&place.read("out/mission.json")).expect("the folder has the answer");
    assert_eq!(written["legs"], answer["legs"], "whether or not records are kept");
    assert_eq!(written["final"], answer["final"]);
    std::fs::remove_file(place.file("legs.csv")).expect("it is there");
    let again = place.json("mission out/mission.toml --nominal");
    assert_eq!(again["legs"], answer["legs"]);
    place.write("empty.toml", begins("slope_deg = 3.0\n"));
    let of_map = r#"{"type": "LineString", "coordinates": [[500000, 5400000], [500010, 5400000]]}"#;
    place.write("utm.geojson", of_map);
    let far = check_is_refusal(&place.line("mission empty.toml --legs-from utm.geojson"), 2);
    for part in ["leg 1 goes to x 500000 m, y 5400000 m, 5423 km away", "need the map"] {
        assert!(far.contains(part), "{part}: {far}");
    }
    let places = place.json("mission empty.toml --nominal --legs-from legs.geojson");
    assert_eq!(places["legs"][1]["manoeuvre"], "go to 0.6, 0.05 m");
}

#[test]
fn bad_missions_are_refused_with_the_leg_that_is_wrong() {
    let place = Place::new();
    let bad = [
        "",
        "[[leg]]\ndrive_m = 1.0\n[[leg]]\ndrive_m = 1.0\nturn_deg = 3.0\n",
        "[[leg]]\nspeed_m_s = 0.05\n",
        "[[leg]]\narc = { radius_m = -1.0, angle_deg = 20.0 }\n",
        "[[leg]]\nwait_s = 1.0\nheading = \"hold\"\n",
        "[[leg]]\nturn_deg = 1.0\nby = \"odometry\"\n",
        "[[leg]]\ndrive_m = 1.0\nheading = \"toward\"\n",
        "[[leg]]\ndrive_m = 1.0\ntoward = { x_m = 1.0, y_m = 1.0 }\n",
        "[[leg]]\ndrive_m = -1.0\nreverse = true\n",
        "[[leg]]\ndrive_m = 1.0\nspeed_m_s = 0.0\n",
        "[[leg]]\ndrive_m = nan\n",
        "[[leg]]\ngoto = { x_m = 1.0 }\n",
        "[stop]\nslip_ratio = { above = 0.4, then = \"back-out\" }\n[[leg]]\ndrive_m = 1.0\n",
        "[stop]\nslip = { above = 0.4 }\n[[leg]]\ndrive_m = 1.0\n",
        "[stop]\nslip_ratio = 1.4\n[[leg]]\ndrive_m = 1.0\n",
        "[stop]\ndrift_m_per_m = \"much\"\n[[leg]]\ndrive_m = 1.0\n",
        "[[leg]]\nturn_deg = 20.0\nstop = { drift_m_per_m = 0.1 }\n",
        "[[leg]]\ndrive_m = 1.0\nstop = { shortfall_deg = 3.0 }\n",
        "stop_from = \"nowhere.toml\"\n[[leg]]\ndrive_m = 1.0\n",
        "stop_from = \"flat.toml\"\n[[leg]]\ndrive_m = 1.0\n",
        "[[leg]]\ndrive_m = 1.0\n[[alternative]]\nname = \"a\"\n[[alternative.leg]]\ndrive_m = 1.0\n",
        "legs_from = \"nowhere.csv\"\n",
        "legs_from = \"words.csv\"\n",
        "legs_from = \"points.geojson\"\n",
        "[sensors]\nodometry_interval_m = 0.0\n[[leg]]\ndrive_m = 1.0\n",
        "[[leg]]\ndrive_m = 1.0\nspeed_m_s = [0.06, 0.06]\n",
        "[[leg]]\nturn_deg = 90.0\ndrive = { law = \"eq18\" }\n",
        "[[leg]]\ndrive_m = 1.0\nspeed_m_s = [0.06, 0.06, 0.05, 0.05]\n[[leg]]\ndrive_m = 1.0\ndrive = { law = \"eq18-as-printed\" }\n",
    ];
    place.write("words.csv", "drive_m,turn_deg\nfar,\n");
    place.write("flat.toml", "slip_ratio = 0.4\n");
    place.write("points.geojson", "{\"type\": \"Polygon\", \"coordinates\": []}");
    let refused = bad.map(|legs| {
        place.write("m.toml", begins(legs));
        check_is_refusal(&place.line("mission m.toml"), 2)
    });
    assert_snapshot!("missions", refused.join("\n"));
}

/// A number alone is what a limit is above; limits of a file stand behind the mission's own, and
/// the folder has them all.
#[test]
fn limits_are_numbers_and_come_from_files() {
    let place = Place::new();
    place.write("stops.toml", "[stop]\nsinkage_mm = 3\ndrift_m_per_m = 0.5\nroll_deg = 20.0\n");
    let leg = "[[leg]]\ndrive_m = 3.0\nyaw_deg = 0.0\n";
    let head = "slope_deg = 10.0\nstop_from = \"stops.toml\"\n";
    let limits = "[stop]\nsinkage_mm = 90\ndrift_m_per_m = { above = 0.04, over_m = 0.5 }\n";
    place.write("m.toml", begins(&format!("{head}{limits}{leg}")));
    let answer = place.json("mission m.toml --nominal --out out");
    let stop = &answer["inputs"]["mission"]["stop"];
    assert_eq!(number(&stop["sinkage_mm"]["above"]), 90.0, "{stop}");
    assert_eq!(number(&stop["roll_deg"]["above"]), 20.0, "{stop}");
    assert_eq!(answer["legs"][0]["stopped_by"], "drift_m_per_m");
    let reason = answer["legs"][0]["reason"].as_str().expect("a reason");
    assert!(reason.contains("m/m over 0.5 m after"), "{reason}");
    let again = place.json("mission out/mission.toml --nominal");
    assert_eq!(again["legs"], answer["legs"]);
    // What a flag names stands behind the mission's own, too.
    place.write("plain.toml", begins(&format!("slope_deg = 10.0\n{leg}")));
    let sunk = place.json("mission plain.toml --nominal --stop-from stops.toml");
    assert_eq!(sunk["legs"][0]["stopped_by"], "sinkage_mm");
    let set = "--set mission.stop.sinkage_mm=80 --set mission.stop.drift_m_per_m=0.9";
    let gone = place.json(&format!("mission plain.toml --nominal --stop-from stops.toml {set}"));
    assert_eq!(gone["legs"][0]["outcome"], "completed");
    // What a mission risks names the limit, and the legs that the soil as written does not reach.
    let legs = "[[leg]]\ndrive_m = 1.0\n".repeat(3);
    place.write(
        "three.toml",
        begins(&format!("slope_deg = 10.0\n[stop]\nslip_ratio = 0.01\n{legs}")),
    );
    let line = "mission three.toml --samples 4 --simulation quasi-steady";
    let risk = place.json(line);
    assert_eq!(risk["commonest_end"], "stopped", "{risk}");
    assert_eq!(risk["commonest_end_limit"], "slip_ratio");
    let text = place.results(line);
    for words in [
        "in leg 1: stopped at the limit of slip_ratio, in ",
        "Not advised on, as the drive on the soil as written ends in leg 1: legs 2 to 3.",
        "\nhint: a soil that states how well its numbers are known gives verdicts",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn flags_change_what_a_mission_says() {
    let place = Place::new();
    place.write("m.toml", begins("[[leg]]\ndrive_m = 0.2\n"));
    let line = "mission m.toml --slope-deg 4 --gravity-m-s2 moon --model small-wheel --set \
                mission.leg.0.drive_m=0.3 --set soil.friction_angle_deg=36 --simulation \
                quasi-steady";
    let answer = place.json(line);
    let mission = &answer["inputs"]["mission"];
    assert_eq!((number(&mission["slope_deg"]), number(&mission["gravity_m_s2"])), (4.0, 1.62));
    assert_eq!(mission["model"], "small-wheel");
    assert_eq!(answer["simulation"], "quasi-steady");
    assert!((number(&answer["legs"][0]["distance_m"]) - 0.3).abs() < 1e-6);
}
