//! One belief, one verdict: whoever asks for a slope and a course gets the same heading, verdict,
//! reason and probability, from whatever command.

use std::fmt::Write as _;

use serde_json::Value;

use crate::program::{Place, number};

/// Samples of soil and model.
const SAMPLES: &str = "--samples 16 --seed 3";

/// Directions of travel [°] with the names of the card's courses, a unit vector on the map of a
/// slope that rises to the north, and a leg of a mission.
const COURSES: [(f64, &str, [f64; 2], &str); 3] = [
    (0.0, "", [1.0, 0.0], "drive_m = 0.2\nheading = \"contour\""),
    (90.0, "up", [0.0, 1.0], "goto = { x_m = 0.0, y_m = 0.2 }\nyaw_deg = 90.0"),
    (-90.0, "down", [0.0, -1.0], "goto = { x_m = 0.0, y_m = -0.2 }\nyaw_deg = -90.0"),
];

/// An even plane that rises to the north, as text.
fn plane(slope_deg: f64) -> String {
    let rise = slope_deg.to_radians().tan();
    let mut text = String::new();
    for (x, y) in (0..25_u8).flat_map(|y| (0..25_u8).map(move |x| (f64::from(x), f64::from(y)))) {
        let (x, y) = (0.5 * x, 0.5 * y);
        writeln!(text, "{x} {y} {}", y * rise).expect("text");
    }
    text
}

/// The only row of a list whose number is this one.
fn at<'a>(rows: &'a Value, key: &str, value: f64) -> &'a Value {
    let mut rows = rows.as_array().expect("rows").iter();
    rows.find(|row| (number(&row[key]) - value).abs() < 1e-9).expect("the row is there")
}

/// Checks that two pieces of advice are one.
fn check_same(one: &Value, other: &Value, what: &str) {
    for key in ["verdict", "reason"] {
        assert!(one[key].is_string() && one[key] == other[key], "{what}: {one} {other}");
    }
    for key in ["probability_stuck", "yaw_deg", "yaw_deg_p2_5", "yaw_deg_p97_5"] {
        match (one[key].as_f64(), other[key].as_f64()) {
            // The ends of curves differ by round-off.
            (Some(one), Some(other)) => assert!((one - other).abs() < 1e-6, "{what}: {key} {one}"),
            (one, other) => assert_eq!(one, other, "{what}: {key}"),
        }
    }
}

/// Checks heading, card, map, route, mission and what was learnt on a day that taught nothing.
fn check_slopes(rover: &str, soil: &str, slopes: &[f64]) {
    let place = Place::new();
    let of = format!("--rover {rover} --soil {soil}");
    let list: Vec<String> = slopes.iter().map(ToString::to_string).collect();
    let heading = place.json(&format!("heading {of} --slope-deg {} {SAMPLES}", list.join(",")));
    let card = place.json(&format!("card {of} {SAMPLES}"));
    for answer in [&heading, &card] {
        assert_eq!(answer["belief"]["samples"], 16);
        let weights = answer["belief"]["model_weights"].as_object().expect("weights");
        let sum: f64 = weights.values().map(number).sum();
        assert!((sum - 1.0).abs() < 1e-12 && answer["belief"]["name"].is_string());
        assert_eq!(answer["belief"], heading["belief"]);
    }
    for slope in slopes {
        let what = format!("{rover} on {soil}, {slope}°");
        let row = at(&heading["rows"], "slope_deg", *slope);
        for key in ["verdict", "reason", "probability_stuck", "yaw_deg"] {
            assert_eq!(row[key], row["advice"][key], "{what}");
        }
        let of_card = at(&card["rows"], "slope_deg", *slope);
        check_same(&of_card["advice"], &row["advice"], &format!("{what}: card"));
        place.write("plane.xyz", plane(*slope));
        for (course, name, [east, north], leg) in COURSES {
            let what = format!("{what}, course {course}°");
            let line =
                format!("map plane.xyz {of} --course-deg {course} {SAMPLES} --out map --force");
            let map = place.json(&line);
            let on_map = &at(&map["slopes"], "slope_deg", *slope)["advice"];
            if name.is_empty() {
                check_same(on_map, &row["advice"], &format!("{what}: map"));
            } else if let Some(row) = on_course(&card, *slope, name) {
                for key in ["verdict", "reason", "probability_stuck"] {
                    assert_eq!(row[key], on_map[key], "{what}: card");
                }
            } else {
                assert_eq!(of_card["verdict"], "no_go", "the card has no other courses there");
            }
            let cells = ["go", "caution", "cannot_tell", "no_go"];
            let verdict = on_map["verdict"].as_str().expect("a verdict");
            for cell in cells {
                let has_all = number(&map["verdicts"][cell]) > 0.0;
                assert_eq!(has_all, cell == verdict, "{what}: {}", map["verdicts"]);
            }
            let ends =
                [[6.0 - 3.0 * east, 6.0 - 3.0 * north], [6.0 + 3.0 * east, 6.0 + 3.0 * north]];
            place.write(
                "line.geojson",
                format!("{{\"type\": \"LineString\", \"coordinates\": {ends:?}}}"),
            );
            let line = format!("route plane.xyz {of} --along line.geojson --no-drive {SAMPLES}");
            let route = place.json(&line);
            // Level ground has no contour, and a way there no course off it.
            let of_way = if *slope == 0.0 { &row["advice"] } else { on_map };
            check_same(&route["legs"][0]["advice"], of_way, &format!("{what}: route"));
            place.write("mission.toml", mission(rover, soil, *slope, leg));
            let mission = place.json(&format!("mission mission.toml {SAMPLES}"));
            check_same(&mission["legs"][0]["advice"], on_map, &format!("{what}: mission"));
            for answer in [&map, &route, &mission] {
                assert_eq!(answer["belief"], heading["belief"], "{what}");
            }
        }
    }
}

/// The row of another course on a card; none on a slope that page 1 calls no-go.
fn on_course<'a>(card: &'a Value, slope: f64, name: &str) -> Option<&'a Value> {
    let rows = card["courses"].as_array().expect("courses").iter();
    let mut of_course = rows.filter(|row| row["course"] == name);
    of_course.find(|row| number(&row["slope_deg"]) == slope)
}

fn mission(rover: &str, soil: &str, slope: f64, leg: &str) -> String {
    format!(
        "schema = \"mission/1\"\nname = \"a leg\"\nrover = \"{rover}\"\nsoil = \"{soil}\"\n\
         slope_deg = {slope}\n\n[[leg]]\nspeed_m_s = 0.06\n{leg}\n"
    )
}

/// Slopes from a go to a no-go.
#[test]
fn all_commands_say_the_same_of_a_slope() {
    check_slopes("hakuto", "toyoura-uncertain", &[5.0, 11.0, 21.0]);
}

/// A soil that states no uncertainty, and a rover with other wheels: nobody can tell, and all say
/// so.
#[test]
fn all_commands_cannot_tell_alike() {
    check_slopes("rashid", "toyoura", &[4.0, 14.0]);
}

/// On level ground, where all moments of a turn on the spot are one: a leg that turns, a leg that
/// turns to where it leads, a bend of a way, and the card's second page.
#[test]
fn all_commands_say_the_same_of_a_turn_on_the_spot() {
    let place = Place::new();
    let (rover, soil) = ("hakuto", "toyoura-uncertain");
    let of = format!("--rover {rover} --soil {soil} {SAMPLES}");
    let card = place.json(&format!("card {of}"));
    let on_card = on_course(&card, 0.0, "turn-on-the-spot").expect("a row");
    assert_eq!(on_card["verdict"], "caution", "a turn that is worth a word: {on_card}");
    let check = |advice: &Value, what: &str| {
        for key in ["verdict", "reason"] {
            assert_eq!(advice[key], on_card[key], "{what}: {advice}");
        }
        let stuck = &on_card["probability_stuck_without_checks"];
        assert_eq!(&advice["probability_stuck"], stuck, "{what}");
        assert!(advice["yaw_deg"].is_null(), "{what}: no heading is set in a turn");
    };
    let legs = "turn_deg = 10.0\n\n[[leg]]\ngoto = { x_m = 0.0, y_m = 0.2 }";
    place.write("mission.toml", mission(rover, soil, 0.0, legs));
    let mission = place.json(&format!("mission mission.toml {SAMPLES}"));
    check(&mission["legs"][0]["advice"], "mission, a turn");
    check(&mission["legs"][1]["advice"], "mission, a turn before a way");
    place.write("level.xyz", plane(0.0));
    let bend = "{\"type\": \"LineString\", \"coordinates\": [[3, 3], [6, 3], [6, 6]]}";
    place.write("bend.geojson", bend);
    let route = place.json(&format!("route level.xyz {of} --along bend.geojson --no-drive"));
    assert_eq!(route["legs"][0]["advice"]["verdict"], "go");
    check(&route["legs"][1]["advice"], "route");
    assert!(route["legs"][1]["course_deg"].is_null(), "it is about the turn");
}

/// Many rovers, beliefs and slopes.
#[test]
#[ignore = "minutes"]
fn all_commands_say_the_same_of_many_slopes() {
    let slopes: Vec<f64> = (0..=20).step_by(4).map(f64::from).collect();
    let beliefs =
        ["toyoura-uncertain", "toyoura", "lunar-0-15-cm", "grc-1", "hit-lss1", "mars-simulant"];
    let rovers = [
        "hakuto",
        "hakuto-flight",
        "hakuto-steered",
        "hakuto-rockers",
        "el-dorado-2",
        "mgru3",
        "rashid",
        "pragyan",
        "yutu-2",
        "curiosity-rocker-bogie",
    ];
    for (rover, soil) in rovers.iter().flat_map(|rover| beliefs.map(|soil| (rover, soil))) {
        println!("{rover} on {soil}");
        check_slopes(rover, soil, &slopes);
    }
}

/// What a day that taught nothing leaves is what was believed before it.
#[test]
fn a_day_that_taught_nothing_changes_no_advice() {
    let place = Place::new();
    // A rover that stands.
    let mut log = "time_s,roll_deg,pitch_deg,wheel_speed_rad_s\n".to_owned();
    for step in 0..40_u8 {
        writeln!(log, "{},8,0.5,0", 0.5 * f64::from(step)).expect("text");
    }
    place.write("log.csv", log);
    let soil = "toyoura-uncertain";
    let line = format!("learn log.csv --prior {soil} --predict-slope-deg 5,12 {SAMPLES}");
    let learnt = place.line(&format!("{line} --format json")).stdout;
    let learnt: Value = serde_json::from_str(&learnt).expect("JSON");
    let heading = place.json(&format!("heading --soil {soil} --slope-deg 5,12 {SAMPLES}"));
    for slope in [5.0, 12.0] {
        let [learnt, heading] = [&learnt["predictions"], &heading["rows"]]
            .map(|rows| &at(rows, "slope_deg", slope)["advice"]);
        check_same(learnt, heading, &format!("{slope}°"));
    }
}
