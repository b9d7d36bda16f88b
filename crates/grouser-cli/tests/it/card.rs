//! `card`: the operator's page, its numbers and its files.

use serde_json::Value;

use crate::program::{Place, changed_preset, number};

/// An uncertain soil, with draws enough to tell go from no-go.
const UNCERTAIN: &str = "card --soil toyoura-uncertain --samples 40";

fn rows(answer: &Value) -> &Vec<Value> {
    answer["rows"].as_array().expect("rows")
}

fn row(answer: &Value, slope_deg: f64) -> &Value {
    let is_it = |row: &&Value| number(&row["slope_deg"]) == slope_deg;
    rows(answer).iter().find(is_it).expect("the slope is on the card")
}

/// What a person could read on an SVG page, line by line.
fn texts(svg: &str) -> Vec<String> {
    let parts = svg.split("fill-opacity=\"0\">").skip(1);
    parts.map(|part| part.split_once('<').expect("the element ends").0.to_owned()).collect()
}

#[test]
fn numbers_are_those_of_the_attitude() {
    let place = Place::new();
    let card = place.json(UNCERTAIN);
    let attitude = place
        .json("attitude --soil toyoura-uncertain --slope-deg 5,13,17 --uncertainty --samples 40");
    for expected in rows(&attitude) {
        let row = row(&card, number(&expected["slope_deg"]));
        for word in ["yaw_deg", "slip_ratio"] {
            for suffix in ["", "_p2_5", "_p50", "_p97_5"] {
                let key = format!("{word}{suffix}");
                assert_eq!(row[&key], expected[&key], "{key}");
            }
        }
        assert_eq!(row["probability_level"], expected["probability_level"]);
        // Work per metre is power over speed: P = E v (1 - s)/cos γ along the contour.
        let (energy, slip) = (number(&expected["energy_j_per_m"]), number(&row["slip_ratio"]));
        let way = 0.06 * (1.0 - slip) / number(&row["yaw_deg"]).to_radians().cos();
        assert!((number(&row["power_w"]) - energy * way).abs() < 1e-12);
    }
}

/// For a slope of 13° the page has one line with the slope, the heading and the heading's band.
#[test]
fn the_page_says_what_it_must() {
    let place = Place::new();
    place.results(&format!("{UNCERTAIN} --out card.svg"));
    let texts = texts(&place.read("card.svg"));
    let row = row(&place.json(UNCERTAIN), 13.0).clone();
    let heading = format!("{:.1}°", number(&row["yaw_deg_p50"]));
    let (low, high) = (number(&row["yaw_deg_p2_5"]), number(&row["yaw_deg_p97_5"]));
    let slope = texts.iter().position(|text| text == "13°").expect("the slope");
    assert_eq!(texts[slope + 1], heading);
    assert_eq!(texts[slope + 2], format!("{low:.1} to {high:.1}°"));
    let all = texts.join("\n");
    for part in [
        "HAKUTO on Toyoura sand, uncertain",
        "GO\n",
        "CAUTION",
        "NO-GO",
        "at least 95 % of 40 samples",
        "less than 80 %",
        "Date of the soil: not stated",
        "Gravity 9.807 m/s² (earth)",
        "6 cm/s",
        "Holds for",
        "Leaves out",
        "Assumed",
        "Uphill on the left or on the right",
        "40 samples, seed 1",
        &format!("grouser {}", env!("CARGO_PKG_VERSION")),
    ] {
        assert!(all.contains(part), "{part} is missing in\n{all}");
    }
}

#[test]
fn without_stated_uncertainty_the_page_says_so_and_draws_no_band() {
    let place = Place::new();
    let table =
        place.results("card --model ishigami --set soil.priors=none --out card.svg --margin-deg 4");
    assert!(table.contains("no uncertainty of this soil is stated: no bands"));
    let svg = place.read("card.svg");
    let texts = texts(&svg).join("\n");
    assert!(texts.contains("NOT STATED: no bands"));
    assert!(texts.contains("a slope 4° steeper"));
    assert!(!texts.contains("95 %") && !svg.contains("rgb(219,219,219)"), "a band is drawn");
    let json = place.json("card --model ishigami --set soil.priors=none");
    assert!(rows(&json).iter().all(|row| row["yaw_deg_p50"].is_null() && row["draws"].is_null()));
}

/// Where only the models are uncertain, the bands are theirs, and the margin still stands in for the soil's.
#[test]
fn models_alone_have_bands_and_keep_the_margin() {
    let place = Place::new();
    let table =
        place.results("card --samples 30 --set soil.priors=none --out card.svg --margin-deg 4");
    assert!(table.contains("bands are of the models alone; slopes are judged with a margin"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("a slope 4° steeper") && texts.contains("NOT STATED: bands"));
    assert!(texts.contains("rft 33.33 %"), "{texts}");
    let card = place.json("card --samples 30 --set soil.priors=none --margin-deg 4");
    let row = row(&card, 10.0);
    let models = place.json("heading --set soil.priors=none --slope-deg 10 --model all");
    for word in ["yaw_deg", "slip_ratio"] {
        let of_spread = rows(&models).iter().filter(|row| row["model"] != "bekker");
        let values: Vec<f64> = of_spread.map(|row| number(&row[word])).collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let ends = ["p2_5", "p97_5"].map(|end| number(&row[format!("{word}_{end}")]));
        assert_eq!((values.len(), ends), (3, [least, most]));
    }
}

#[test]
fn the_day_of_the_soil_is_on_the_page() {
    let place = Place::new();
    let dated =
        |day: &str| changed_preset("soil", "toyoura", "name ", &format!("date = \"{day}\"\nname "));
    place.write("soil.toml", dated("2026-11-20"));
    place.results("card --samples 4 --soil soil.toml --out card.svg");
    assert!(texts(&place.read("card.svg")).join("\n").contains("Date of the soil: 2026-11-20"));
    for day in ["2026-02-29", "20.11.2026", "yesterday", "2026-13-01"] {
        place.write("soil.toml", dated(day));
        let answer = place.line("card --samples 4 --soil soil.toml");
        assert_eq!(answer.code(), 2, "{day}");
        assert!(answer.stderr.contains("soil.toml:") && answer.stderr.contains("date"));
    }
}

#[test]
fn flags_change_the_verdicts_and_the_rule_on_the_page() {
    let place = Place::new();
    let last_go = |line: &str| {
        let answer = place.json(line);
        let goes = rows(&answer).iter().filter(|row| row["verdict"] == "go");
        goes.map(|row| number(&row["slope_deg"])).fold(0.0, f64::max)
    };
    let margin = |deg| format!("card --set soil.priors=none --margin-deg {deg}");
    let usual = last_go(UNCERTAIN);
    assert!(last_go(&format!("{UNCERTAIN} --go-slip-ratio 0.15")) < usual);
    assert!(last_go(&format!("{UNCERTAIN} --go-probability 0.8")) > usual);
    assert!(last_go(&margin(2)) > last_go(&margin(8)));
    let strict = "--no-go-probability 0.9 --no-go-slip-ratio 0.4";
    place.results(&format!("{UNCERTAIN} {strict} --out card.svg"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("less than 90 % of them it does so with slip up to 40 %"));
}

/// The file's name says which form; what is there stays there.
#[test]
fn files_are_what_their_names_say_and_are_not_replaced() {
    let place = Place::new();
    for (name, start) in [
        ("card.svg", b"<svg".as_slice()),
        ("card.pdf", b"%PDF-"),
        ("card.png", b"\x89PNG"),
        ("card.html", b"<!doctype html>"),
    ] {
        let line = format!("card --samples 4 --out {name}");
        place.results(&line);
        let bytes = std::fs::read(place.file(name)).expect("it is written");
        assert!(bytes.starts_with(start), "{name}");
        let again = place.line(&line);
        assert!(again.code() == 2 && again.stderr.contains("--force"), "{}", again.stderr);
        place.results(&format!("{line} --force"));
        assert_eq!(std::fs::read(place.file(name)).expect("it is written"), bytes, "{name}");
    }
    let other = place.line("card --out card.docx");
    assert!(other.code() == 2 && other.stderr.contains(".pdf"), "{}", other.stderr);
    assert_eq!(place.names().len(), 4);
}

/// A folder is enough to make the card again, with the same bytes.
#[test]
fn a_folder_has_all_forms_and_its_documents_make_the_same_card() {
    let place = Place::new();
    place.results(&format!("{UNCERTAIN} --out one"));
    let mut names: Vec<String> = std::fs::read_dir(place.file("one"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let expected =
        ["card.csv", "card.html", "card.json", "card.pdf", "card.png", "card.svg", "scenario.toml"];
    assert_eq!(names, expected);
    place.results("card one/scenario.toml --samples 40 --out two");
    for name in expected {
        let bytes = |folder: &str| std::fs::read(place.file(folder).join(name)).expect("a file");
        assert_eq!(bytes("one"), bytes("two"), "{name}");
    }
}

#[test]
fn measured_yaws_are_placed_beside_the_band() {
    let place = Place::new();
    place.write("yaws.csv", "slope_deg,start_yaw_deg,end_yaw_deg\n5,0.1,2\n12.5,30,\n");
    let answer = place.json(&format!("{UNCERTAIN} --measured yaws.csv"));
    let measured = answer["measured"].as_array().expect("records");
    let seen: Vec<(f64, &str, &str)> = measured
        .iter()
        .map(|record| {
            let word = |key: &str| record[key].as_str().expect("a word");
            (number(&record["slope_deg"]), word("measured"), word("place"))
        })
        .collect();
    let expected =
        [(5.0, "start_yaw", "below"), (5.0, "end_yaw", "inside"), (12.5, "start_yaw", "above")];
    assert_eq!(seen, expected);
    for (content, part) in [
        ("yaw_deg\n1\n", "slope_deg"),
        ("slope_deg\n1\n", "yaw_deg"),
        ("slope_deg,yaw_deg\n5,much\n", "yaws.csv:2: "),
        ("slope_deg,yaw_deg\n95,1\n", "0 to 60"),
    ] {
        place.write("yaws.csv", content);
        let answer = place.line("card --samples 4 --measured yaws.csv");
        assert_eq!(answer.code(), 2, "{content}");
        assert!(answer.stderr.contains(part), "{}", answer.stderr);
    }
    assert_eq!(place.line("card --measured nowhere.csv").code(), 2);
}

/// A rover that is no mirror image of itself has two cards, and each says whose it is.
#[test]
fn a_lopsided_rover_has_a_card_for_each_side() {
    let place = Place::new();
    let text = changed_preset("rover", "hakuto", "0.24", "0.30");
    place.write("rover.toml", text);
    let line = "card --samples 4 --rover rover.toml --out";
    place.results(&format!("{line} left.svg"));
    place.results(&format!("{line} right.svg --uphill right"));
    assert!(texts(&place.read("left.svg")).join("\n").contains("rover's LEFT"));
    assert!(texts(&place.read("right.svg")).join("\n").contains("rover's RIGHT"));
    let heading = |line: &str| number(&row(&place.json(line), 10.0)["yaw_deg"]);
    let left = heading("card --samples 4 --rover rover.toml");
    assert!((left - heading("card --samples 4 --rover rover.toml --uphill right")).abs() > 1e-3);
}

/// Where the rover cannot even drive on level ground the card is a single no-go.
#[test]
fn a_rover_that_cannot_move_has_a_card_that_forbids_it() {
    let place = Place::new();
    let slick = "--set soil.friction_angle_deg=5 --set soil.exit.ratio=0";
    place.results(&format!("card --samples 4 {slick} --out card.svg"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("NO-GO   on any slope"), "{texts}");
}
