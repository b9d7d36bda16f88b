//! What scripts are written against: words, formats, flags, files.

use std::fmt::Write as _;
use std::fs;

use grouser::simulation::OutcomeKind;
use serde_json::{Value, json};

use crate::program::{Place, changed_preset, keys, number};

// ---- Words ----

#[test]
fn json_says_what_it_is() {
    let place = Place::new();
    for (line, schema) in [
        ("wheel-test", "grouser.wheel-test.v1"),
        ("attitude", "grouser.attitude.v1"),
        ("traverse --duration-s 0.1", "grouser.traverse.v1"),
        ("presets", "grouser.presets.v1"),
    ] {
        let json = place.json(line);
        assert_eq!(json["schema"], schema);
        assert_eq!(json["version"], env!("CARGO_PKG_VERSION"));
    }
}

/// The words of a wheel test that the design fixes.
const WHEEL_WORDS: [&str; 12] = [
    "load_n",
    "slip_ratio",
    "slip_angle_deg",
    "status",
    "sinkage_mm",
    "entry_angle_deg",
    "exit_angle_deg",
    "max_stress_angle_deg",
    "drawbar_pull_n",
    "side_force_n",
    "normal_force_n",
    "torque_nm",
];

#[test]
fn wheel_test_rows_have_the_words_of_the_design() {
    let json = Place::new().json("wheel-test --load-n 5,10 --slip-ratio 0:0.2:0.1");
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 6);
    for row in rows {
        for word in WHEEL_WORDS {
            assert!(!row[word].is_null(), "{word} in {row}");
        }
        assert_eq!(row["status"], "ok");
        let load = number(&row["load_n"]);
        assert!((number(&row["normal_force_n"]) - load).abs() < 1e-6 * load);
    }
}

#[test]
fn rows_are_ordered_by_load_then_angle_then_slip() {
    let json =
        Place::new().json("wheel-test --load-n 9,8 --slip-angle-deg 2,1 --slip-ratio 0.3,0.1");
    let rows = json["rows"].as_array().expect("rows").iter();
    let order: Vec<_> = rows
        .map(|row| ["load_n", "slip_angle_deg", "slip_ratio"].map(|word| number(&row[word])))
        .collect();
    let mut expected = Vec::new();
    for load in [9.0, 8.0] {
        for angle in [2.0, 1.0] {
            expected.extend([0.3, 0.1].map(|slip| [load, angle, slip]));
        }
    }
    assert_eq!(order, expected);
}

#[test]
fn attitude_rows_have_the_words_of_the_design_and_the_limit_stands_beside_them() {
    let json =
        Place::new().json("attitude --load-transfer quasi-static --slope-deg 5,10,15,20 --nominal");
    let limit = number(&json["limit_slope_deg"]);
    assert!((20.0..21.0).contains(&limit), "{limit}");
    for row in json["rows"].as_array().expect("rows") {
        for word in ["slope_deg", "yaw_deg", "slip_ratio", "sinkage_mm", "torque_nm"] {
            assert!(row[word].is_number(), "{word} in {row}");
        }
        assert_eq!(row["status"], "ok");
    }
}

const UNCERTAIN: &str =
    "attitude --soil toyoura-uncertain --slope-deg 5,20 --uncertainty --samples 24";

#[test]
fn an_uncertain_soil_adds_its_words_to_the_rows_and_changes_none() {
    let place = Place::new();
    let json = place.json(UNCERTAIN);
    assert_eq!(json["schema"], "grouser.attitude.v1");
    assert_eq!((&json["inputs"]["samples"], &json["inputs"]["seed"]), (&json!(24), &json!(1)));
    let plain = place.json("attitude --soil toyoura-uncertain --slope-deg 5,20 --nominal");
    let rows = json["rows"].as_array().expect("rows");
    for (row, plain) in rows.iter().zip(plain["rows"].as_array().expect("rows")) {
        for (key, value) in plain.as_object().expect("an object") {
            let is_yaw = key == "yaw_deg";
            let key = if is_yaw { "yaw_deg_as_written" } else { key };
            assert_eq!(&row[key], value, "{key}");
        }
        for word in ["yaw_deg", "slip_ratio", "sinkage_mm", "energy_j_per_m"] {
            // No number is above the headings of samples that no heading holds.
            if word == "yaw_deg" && row["slope_deg"] == 20.0 {
                assert!(row["yaw_deg_p97_5"].is_null(), "{row}");
                continue;
            }
            let end = |end: &str| number(&row[format!("{word}_{end}")]);
            assert!(end("p2_5") < end("p50"), "{word}: {row}");
            // In some samples no heading holds the contour of 20°: their work per metre has no
            // bound.
            if word == "energy_j_per_m" && row["slope_deg"] == 20.0 {
                assert!(row["energy_j_per_m_p97_5"].is_null(), "{row}");
            } else {
                assert!(end("p50") < end("p97_5"), "{word}: {row}");
            }
        }
        let share = |end: &str| number(&row[format!("probability_level{end}")]);
        assert!(share("_low") <= share("") && share("") <= share("_high"), "{row}");
        assert_eq!(number(&row["draws"]), 24.0);
        assert_eq!(share(""), number(&row["draws_level"]) / 24.0);
    }
    for word in ["limit_slope_deg", "limit_reason"] {
        assert_eq!(json[word], plain[word]);
    }
    let limit = |end: &str| number(&json[format!("limit_slope_deg_{end}")]);
    assert!(limit("p2_5") < limit("p50") && limit("p50") < limit("p97_5"));
    assert!(plain.get("limit_slope_deg_p50").is_none() && plain.get("draws").is_none());
    assert!(plain["inputs"].get("seed").is_none());
}

#[test]
fn the_seed_and_nothing_else_decides_the_draws() {
    let place = Place::new();
    let line = format!("{UNCERTAIN} --format csv");
    let words: Vec<&str> = line.split(' ').collect();
    let on = |threads: &str| {
        let output = place.command(&words).env("RAYON_NUM_THREADS", threads).output();
        output.expect("the program starts").stdout
    };
    assert_eq!(on("1"), on("3"));
    assert_eq!(on("2"), place.results(&format!("{line} --seed 1")).into_bytes());
    assert_ne!(on("2"), place.results(&format!("{line} --seed 2")).into_bytes());
}

/// Where no draw has an attitude there is no yaw; all count as slip 1, and the probability still
/// says something.
#[test]
fn a_slope_without_any_level_attitude_has_slip_1() {
    let json = Place::new()
        .json("attitude --soil toyoura-uncertain --slope-deg 40 --uncertainty --samples 10");
    let row = &json["rows"][0];
    assert!(row["yaw_deg_p50"].is_null() && row["slip_ratio"].is_null(), "{row}");
    assert_eq!((&row["slip_ratio_p2_5"], &row["slip_ratio_p97_5"]), (&json!(1.0), &json!(1.0)));
    assert!(number(&row["sinkage_mm_p2_5"]) > 99.0 && row["energy_j_per_m_p2_5"].is_null());
    assert_eq!((number(&row["probability_level"]), number(&row["draws_level"])), (0.0, 0.0));
    assert!(number(&row["probability_level_high"]) > 0.2, "{row}");
    assert!(row["status"].as_str().expect("a text").starts_with("ground-strength"));
}

#[test]
fn a_wheel_test_has_bands_beside_its_values() {
    let place = Place::new();
    let flags = "--slip-ratio 0.1,0.4 --slip-angle-deg 0,15 --set soil.priors=none";
    let plain = place.json(&format!("wheel-test {flags}"));
    let json = place.json(&format!("wheel-test {flags} --uncertainty --samples 40"));
    let rows = json["rows"].as_array().expect("rows");
    for (row, plain) in rows.iter().zip(plain["rows"].as_array().expect("rows")) {
        for (key, value) in plain.as_object().expect("an object") {
            assert_eq!(&row[key], value, "{key}");
        }
        for word in ["sinkage_mm", "drawbar_pull_n", "side_force_n", "torque_nm"] {
            let [low, high] = ["p2_5", "p97_5"].map(|end| number(&row[format!("{word}_{end}")]));
            let value = number(&row[word]);
            assert!(low <= value && value <= high, "{word}: {row}");
        }
        // The models disagree on it.
        assert!(number(&row["drawbar_pull_n_p2_5"]) < number(&row["drawbar_pull_n_p97_5"]));
        assert_eq!((number(&row["probability_carried"]), number(&row["draws"])), (1.0, 40.0));
    }
    assert_eq!((&json["inputs"]["samples"], &json["inputs"]["seed"]), (&json!(40), &json!(1)));
    assert!(json["model_weights"]["rft"].is_number());
    let one = format!("wheel-test {flags} --uncertainty --samples 40 --model rft");
    let one = place.json(&one);
    for row in one["rows"].as_array().expect("rows") {
        assert_eq!(row["drawbar_pull_n_p2_5"], row["drawbar_pull_n_p97_5"]);
        assert_eq!(row["drawbar_pull_n"], row["drawbar_pull_n_p50"]);
    }
}

/// Bekker's closed form has a part in what needs no force across a wheel.
#[test]
fn model_weights_go_with_the_question() {
    let place = Place::new();
    let flags = "--soil grc-3 --wheel viper-engineering --load-n 171.7 --slip-ratio 0.2";
    let weights = |angle: &str| {
        let line =
            format!("wheel-test {flags} --slip-angle-deg {angle} --uncertainty --samples 20");
        place.json(&line)["model_weights"].clone()
    };
    let (along, across) = (weights("0"), weights("5"));
    assert!(number(&along["bekker"]) > 0.0 && across["bekker"].is_null(), "{along} {across}");
    for weights in [along, across] {
        let sum: f64 = weights.as_object().expect("an object").values().map(number).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{weights}");
    }
    let up = "heading-map --rover mgru3 --soil grc-1-second-hand --slope-deg 10 --samples 10";
    let up = place.json(&format!("{up} --course-deg 90 --uncertainty"));
    assert!(number(&up["model_weights"]["bekker"]) > 0.0);
    let card = place.json("card --soil toyoura-uncertain --samples 20");
    assert!(number(&card["belief"]["model_weights"]["ishigami"]) > 0.7);
}

/// Straight up, on slopes of which the last is too steep for the soil as written.
#[test]
fn a_map_has_bands_where_it_has_no_value_too() {
    let place = Place::new();
    let flags = "--course-deg 90 --slope-deg 5,15,21.5,50 --uncertainty --samples 30 \
                 --set soil.priors=none";
    let json = place.json(&format!("attitude-map {flags}"));
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 4);
    let band = |row: &Value| ["p2_5", "p97_5"].map(|end| number(&row[format!("slip_ratio_{end}")]));
    for row in &rows[..2] {
        let ([low, high], slip) = (band(row), number(&row["slip_ratio"]));
        assert!(0.0 < low && low <= slip && slip <= high && high <= 1.0, "{row}");
        assert_eq!(row["status"], "ok");
    }
    for row in &rows[2..] {
        assert!(row["slip_ratio"].is_null(), "{row}");
        let status = row["status"].as_str().expect("a text");
        let is_too_steep =
            ["no heading holds", "ground-strength"].iter().any(|it| status.starts_with(it));
        assert!(is_too_steep, "{status}");
    }
    // One of the models still climbs the first of them, none the last.
    let [low, high] = band(&rows[2]);
    assert!(low < 1.0 && high == 1.0, "{}", rows[2]);
    assert_eq!(band(&rows[3]), [1.0, 1.0]);
    let again = place.json(&format!("heading-map {flags}"));
    assert_eq!(again["rows"], json["rows"]);
}

#[test]
fn a_traverse_has_bands_over_time_and_at_its_end() {
    let place = Place::new();
    let flags = "traverse --slope-deg 10 --duration-s 2 --uncertainty --samples 6 \
                 --set soil.priors=none";
    let json = place.json(&format!("{flags} --out run"));
    let (samples, bands) = (json["samples"].as_array(), json["bands"].as_array());
    let (samples, bands) = (samples.expect("samples"), bands.expect("bands"));
    assert_eq!(samples.len(), bands.len());
    for (sample, band) in samples.iter().zip(bands) {
        assert_eq!(sample["time_s"], band["time_s"]);
        for word in ["x_m", "y_m", "yaw_deg", "energy_j"] {
            let [low, high] = ["p2_5", "p97_5"].map(|end| number(&band[format!("{word}_{end}")]));
            let value = number(&sample[word]);
            // The ends of six samples lie a little within the outermost of them.
            let room = 0.2 * (high - low);
            assert!(low - room <= value && value <= high + room, "{word}: {band}");
        }
    }
    assert_eq!(
        (&json["band"]["probability_completed"], &json["band"]["draws"]),
        (&json!(1.0), &json!(6))
    );
    assert!(number(&json["band"]["y_m_p2_5"]) < number(&json["band"]["y_m_p97_5"]));
    let csv = place.read("run/traverse.csv");
    assert_eq!(csv.lines().count(), bands.len() + 1);
    assert!(csv.lines().next().expect("a header").contains(",y_m_p97_5,"));
    assert!(place.read("run/traverse.svg").contains("95 % of the samples"));
    assert!(place.results(flags).contains("6 samples: 6 completed"));
    let all = place.json("traverse --slope-deg 10 --duration-s 1 --model all --out all");
    let rows = all["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 4);
    for row in rows {
        let model = row["model"].as_str().expect("a name");
        let one = place.json(&format!("traverse all/scenario-{model}.toml"));
        assert_eq!((&row["y_m"], &row["outcome"]), (&one["final"]["y_m"], &one["outcome"]));
    }
}

/// Where the run of the soil as written ends early, its rows go on with the bands.
#[test]
fn bands_of_a_traverse_outlast_its_run() {
    let place = Place::new();
    let line = "traverse --slope-deg 40 --duration-s 3 --uncertainty --samples 6";
    let csv = place.line(&format!("{line} --format csv")).stdout;
    let rows: Vec<&str> = csv.lines().skip(1).collect();
    let is_over = |row: &&&str| row.split(',').nth(1).expect("x_m").is_empty();
    let over = rows.iter().filter(is_over).count();
    assert!(over > 0 && over < rows.len(), "{over} of {}", rows.len());
    assert!(rows.last().expect("rows").starts_with('3'), "{csv}");
    let json = place.json(line);
    assert_eq!(json["outcome"], "sliding");
    assert_eq!(json["bands"].as_array().expect("bands").len(), rows.len());
    assert!(number(&json["band"]["draws_sliding"]) > 0.0);
}

#[test]
fn every_model_has_its_rows() {
    let place = Place::new();
    for (command, rows_of_each) in [
        ("wheel-test --slip-ratio 0.1,0.4", 2),
        ("heading --slope-deg 5,10", 2),
        ("heading-map --slope-deg 5,10 --course-deg 0,45 --soil toyoura,lunar-nominal", 8),
        ("heading --slope-deg 5,10 --uncertainty --samples 4", 2),
    ] {
        let all = place.json(&format!("{command} --model all"));
        let rows = all["rows"].as_array().expect("rows");
        assert_eq!(all["inputs"]["soils"].is_null(), !command.starts_with("heading-map"));
        assert_eq!(rows.len(), 4 * rows_of_each, "{command}");
        for (model, rows) in
            ["ishigami", "bekker", "small-wheel", "rft"].into_iter().zip(rows.chunks(rows_of_each))
        {
            let one = place.json(&format!("{command} --model {model}"));
            for (row, alone) in rows.iter().zip(one["rows"].as_array().expect("rows")) {
                let mut row = row.clone();
                let name = row.as_object_mut().expect("an object").remove("model");
                assert_eq!((name, &row), (Some(json!(model)), alone), "{command}");
            }
        }
    }
    let csv = place.results("wheel-test --slip-ratio 0.1 --model all --format csv");
    assert!(csv.starts_with("model,load_n,"), "{csv}");
    let table = place.results("heading --slope-deg 10 --model all --nominal --out every");
    assert!(table.contains("bekker: steepest slope"), "{table}");
    place.results("check every/scenario-rft.toml every/scenario-bekker.toml");
}

#[test]
fn a_traverse_has_an_outcome_an_end_and_samples() {
    let json = Place::new().json("traverse --slope-deg 10 --yaw-deg 5.5 --duration-s 2");
    assert_eq!(json["outcome"], "completed");
    let samples = json["samples"].as_array().expect("samples");
    assert_eq!(json["final"], samples[samples.len() - 1]);
    for word in ["time_s", "x_m", "y_m", "yaw_deg", "power_w", "energy_j"] {
        assert!(json["final"][word].is_number(), "{word}");
    }
    assert_eq!(json["final"]["time_s"], 2.0);
    assert_eq!(samples[0]["time_s"], 0.0);
    assert_eq!(samples[0]["yaw_deg"], 5.5);
    let wheels = samples[1]["wheels"].as_array().expect("wheels");
    let names: Vec<_> = wheels.iter().map(|wheel| wheel["wheel"].as_str().unwrap_or("")).collect();
    assert_eq!(names, ["front-left", "rear-left", "rear-right", "front-right"]);
    for word in ["slip_ratio", "slip_angle_deg", "load_n", "sinkage_mm", "wheel_speed_rad_s"] {
        assert!(wheels[0][word].is_number(), "{word}");
    }
}

#[test]
fn every_outcome_is_a_result() {
    let place = Place::new();
    for (line, outcome) in [
        ("traverse --duration-s 1", "completed"),
        ("traverse too-steep", "sliding"),
        ("traverse --slope-deg 60 --yaw-deg 90 --duration-s 5 --set rover.body.mass_kg=6", ""),
        ("traverse --set soil.pressure_sinkage.k_phi=0.1", ""),
    ] {
        let json = place.json(line);
        let found = json["outcome"].as_str().expect("an outcome");
        assert!(OutcomeKind::of_runs().any(|kind| kind.name() == found), "{line}: {found}");
        assert!(outcome.is_empty() || found == outcome, "{line}: {found}");
        assert_eq!(json["reason"].is_null(), found == "completed", "{line}");
    }
}

#[test]
fn what_has_no_physical_answer_has_a_reason_and_nulls() {
    let place = Place::new();
    let json = place.json("wheel-test --load-n 100000 --slip-ratio 0.5");
    let row = &json["rows"][0];
    assert_eq!(row["load_n"], 1e5);
    assert_eq!(row["slip_ratio"], 0.5);
    assert!(row["status"].as_str().is_some_and(|status| status.contains("carries")), "{row}");
    for word in keys(row) {
        let inputs = ["load_n", "slip_ratio", "slip_angle_deg", "status", "flags"];
        let is_input = inputs.contains(&word);
        assert_eq!(row[word].is_null(), !is_input, "{word}");
    }

    let json = place.json("attitude --slope-deg 10,25 --nominal");
    let row = &json["rows"][1];
    assert_eq!(row["slope_deg"], 25.0);
    assert!(row["yaw_deg"].is_null() && row["slip_ratio"].is_null(), "{row}");
    assert_ne!(row["status"], "ok");
}

#[test]
fn the_header_of_csv_is_the_keys_of_json() {
    let place = Place::new();
    for line in ["wheel-test", "attitude", "presets"] {
        let csv = place.results(&format!("{line} --format csv"));
        let header: Vec<_> = csv.lines().next().expect("a header").split(',').collect();
        let json = place.json(line);
        // What JSON has in an object stands in columns of their own as well.
        let is_object = |key: &&str| json["rows"][0][*key].is_object();
        let keys = keys(&json["rows"][0]).into_iter().filter(|key| !is_object(key));
        assert_eq!(header, keys.collect::<Vec<_>>(), "{line}");
    }
    let csv = place.results("traverse --duration-s 0.1 --format csv");
    let header = csv.lines().next().expect("a header");
    assert!(header.starts_with("time_s,x_m,y_m,yaw_deg,"), "{header}");
    assert!(header.contains(",front-left.slip_ratio,"), "{header}");
}

/// Read and written again, every number is the same text, in CSV and in JSON alike.
#[test]
fn floats_are_in_their_shortest_round_trip_form() {
    let place = Place::new();
    let line = "wheel-test --slip-ratio -1:1:0.25 --slip-angle-deg 0:30:10";
    let csv = place.results(&format!("{line} --format csv"));
    let json = place.results(&format!("{line} --format json"));
    let header: Vec<_> = csv.lines().next().expect("a header").split(',').collect();
    let mut count = 0;
    for cells in csv.lines().skip(1) {
        for (cell, key) in cells.split(',').zip(&header) {
            let Ok(value) = cell.parse::<f64>() else { continue };
            assert_eq!(Value::from(value).to_string(), cell, "{key}");
            assert!(json.contains(&format!("\"{key}\": {cell}")), "{key}: {cell}");
            count += 1;
        }
    }
    // All but the status and the flags.
    assert_eq!(count, 9 * 4 * (header.len() - 2));
}

#[test]
fn ranges_are_written_as_their_decimals() {
    let place = Place::new();
    let slips = |line: &str| -> Vec<f64> {
        let json = place.json(line);
        let rows = json["rows"].as_array().expect("rows").iter();
        rows.map(|row| number(&row["slip_ratio"])).collect()
    };
    assert_eq!(
        slips("wheel-test --slip-ratio 0:0.9:0.1"),
        [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
    );
    let both_ways = [-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0];
    assert_eq!(slips("wheel-test --slip-ratio -1:1:0.25"), both_ways);
    assert_eq!(slips("wheel-test --slip-ratio=-1:1:0.25"), both_ways);
    assert_eq!(slips("wheel-test --slip-ratio -0.2,0.5,0.8:0.9:0.05"), [-0.2, 0.5, 0.8, 0.85, 0.9]);
}

// ---- Flags ----

#[test]
fn set_changes_one_key() {
    let place = Place::new();
    let json = place.json("wheel-test --set soil.cohesion_kpa=0.5 --set wheel.radius_m=0.12");
    assert_eq!(json["inputs"]["soil"]["cohesion_kpa"], 0.5);
    assert_eq!(json["inputs"]["wheel"]["radius_m"], 0.12);
    let json = place.json(
        "traverse --duration-s 0.1 --set rover.body.mass_kg=6 --set scenario.slope_deg=3 \
         --set scenario.soil.density_kg_m3=1500 --set wheel.width_m=0.1",
    );
    let scenario = &json["inputs"]["scenario"];
    assert_eq!(scenario["slope_deg"], 3.0);
    assert_eq!(scenario["soil"]["density_kg_m3"], 1500.0);
    assert_eq!(scenario["rover"]["body"]["mass_kg"], 6.0);
    assert_eq!(scenario["rover"]["wheel_unit"]["wheel"]["width_m"], 0.1);
}

#[test]
fn the_theory_is_the_flags_or_the_soils_or_ishigami() {
    let place = Place::new();
    assert_eq!(place.json("wheel-test")["inputs"]["model"], "ishigami");
    assert_eq!(place.json("wheel-test --model bekker")["inputs"]["model"], "bekker");
    let soil =
        place.results("presets toyoura").replace("model = \"ishigami\"", "model = \"bekker\"");
    place.write("sand.toml", soil);
    assert_eq!(place.json("wheel-test --soil sand.toml")["inputs"]["model"], "bekker");
    assert_eq!(place.json("attitude --soil sand.toml")["inputs"]["model"], "bekker");
    let again = place.json("wheel-test --soil sand.toml --model ishigami");
    assert_eq!(again["inputs"]["model"], "ishigami");
    assert_eq!(again["rows"], place.json("wheel-test")["rows"]);
    assert_ne!(again["rows"], place.json("wheel-test --model bekker")["rows"]);
}

#[test]
fn gravity_is_a_number_or_a_name() {
    let place = Place::new();
    for (word, value) in [("earth", 9.80665), ("1.62", 1.62)] {
        for command in ["wheel-test", "attitude"] {
            let json = place.json(&format!("{command} --gravity-m-s2 {word}"));
            assert_eq!(json["inputs"]["gravity_m_s2"], value, "{command} {word}");
        }
    }
    let by_name = place.json("traverse --duration-s 0.1 --gravity-m-s2 moon");
    let moon = by_name["inputs"]["scenario"]["gravity_m_s2"].clone();
    let by_number = place.json(&format!("traverse --duration-s 0.1 --gravity-m-s2 {moon}"));
    assert_eq!(by_name, by_number);
    assert!((1.6..1.65).contains(&number(&moon)));
    let mars = place.json("wheel-test --gravity-m-s2 mars")["inputs"]["gravity_m_s2"].clone();
    assert!((3.7..3.75).contains(&number(&mars)));
}

#[test]
fn loads_and_moments_change_the_balance() {
    let place = Place::new();
    let attitude = |flags: &str| {
        let json = place.json(&format!("attitude --slope-deg 10 {flags}"));
        number(&json["rows"][0]["yaw_deg"])
    };
    let plain = attitude("");
    assert_eq!(plain, attitude("--load-transfer complete"));
    for flags in [
        "--load-transfer uniform",
        "--load-transfer quasi-static",
        "--load-transfer quasi-static-torque",
        "--load-transfer quasi-static --wheel-moments included",
    ] {
        assert_ne!(plain, attitude(flags), "{flags}");
    }
}

#[test]
fn documents_are_presets_or_files() {
    let place = Place::new();
    place.write("sand.toml", place.results("presets toyoura"));
    place.write("wheel.toml", place.results("presets hakuto --kind wheel"));
    place.write("rover.toml", place.results("presets hakuto --kind rover"));
    let preset = place.results("wheel-test --format json");
    assert_eq!(
        preset,
        place.results("wheel-test --format json --soil sand.toml --wheel wheel.toml")
    );
    let preset = place.results("attitude --format json");
    assert_eq!(
        preset,
        place.results("attitude --format json --soil ./sand.toml --rover rover.toml")
    );
    let preset = place.results("traverse --duration-s 1 --format json");
    let line = "traverse --duration-s 1 --format json --rover rover.toml --soil sand.toml";
    assert_eq!(preset, place.results(line));
}

#[test]
fn every_flag_of_a_traverse_reaches_the_scenario() {
    let json = Place::new().json(
        "traverse --rover el-dorado-2 --soil simulant-2007 --slope-deg 7.5 --yaw-deg -5 \
         --duration-s 0.2 --ground-speed-m-s 0.05 --drive eq18 --reference-slip-ratio 0.1 --start \
         rest --load-transfer uniform --wheel-moments included --model bekker --gravity-m-s2 3.71",
    );
    let scenario = &json["inputs"]["scenario"];
    assert_eq!(scenario["slope_deg"], 7.5);
    assert_eq!(scenario["start"]["yaw_deg"], -5.0);
    assert_eq!(scenario["start"]["motion"], "rest");
    assert_eq!(scenario["duration_s"], 0.2);
    assert_eq!(scenario["drive"]["law"], "eq18");
    assert_eq!(scenario["drive"]["ground_speed_m_s"], 0.05);
    assert_eq!(scenario["drive"]["reference_slip_ratio"], 0.1);
    assert_eq!(scenario["load_transfer"], "uniform");
    assert_eq!(scenario["wheel_moments"], "included");
    assert_eq!(scenario["model"], "bekker");
    assert_eq!(scenario["gravity_m_s2"], 3.71);
    assert_eq!(json["samples"][0]["yaw_deg"], -5.0);
}

#[test]
fn a_list_of_speeds_gives_one_to_each_wheel() {
    let json = Place::new().json("traverse --duration-s 0.1 --rim-speed-m-s -0.06,-0.06,0.06,0.06");
    let speeds = json["inputs"]["scenario"]["drive"]["rim_speed_m_s"].clone();
    assert_eq!(speeds, serde_json::json!([-0.06, -0.06, 0.06, 0.06]));
    let wheels = &json["samples"][1]["wheels"];
    assert!(number(&wheels[0]["wheel_speed_rad_s"]) < 0.0);
    assert!(number(&wheels[3]["wheel_speed_rad_s"]) > 0.0);
}

// ---- Streams ----

#[test]
fn the_same_command_says_the_same_bytes() {
    let place = Place::new();
    for line in [
        "wheel-test --slip-angle-deg 0:90:10 --format json",
        "attitude --format json",
        "traverse --duration-s 5 --format json",
        "traverse spot-turn --format csv",
    ] {
        assert_eq!(place.results(line), place.results(line), "{line}");
    }
}

/// The escape codes themselves are looked for in every answer of every test.
#[test]
fn colours_are_for_terminals_that_want_them() {
    let place = Place::new();
    let plain = place.line("wheel-test --slip-ratio much");
    let mut command = place.command(&["wheel-test", "--slip-ratio", "much"]);
    let output = command.env("NO_COLOR", "1").env("CLICOLOR_FORCE", "1").output();
    let output = output.expect("the program starts");
    assert_eq!(String::from_utf8_lossy(&output.stderr), plain.stderr);
}

// ---- Folders ----

/// Runs a line with `--out`, then again from what it wrote.
fn check_repeats(line: &str, from_documents: &str, results: &str) {
    let place = Place::new();
    let printed = place.results(&format!("{line} --format json --out first"));
    assert_eq!(printed, place.read(&format!("first/{results}")), "{line}");
    let again = place.results(&format!("{from_documents} --format json"));
    let [first, second]: [Value; 2] =
        [&printed, &again].map(|text| serde_json::from_str(text).expect("JSON"));
    assert_eq!(first, second, "{line}");
    assert_eq!(place.names(), ["first"]);
}

#[test]
fn a_run_is_repeated_from_its_folder() {
    check_repeats(
        "traverse spot-turn --slope-deg 4 --duration-s 2 --load-transfer quasi-static-torque \
         --set soil.cohesion_kpa=0.2 --gravity-m-s2 moon --model bekker",
        "traverse first/scenario.toml",
        "traverse.json",
    );
    check_repeats(
        "attitude --soil simulant-2007 --rover hakuto-flight --slope-deg 3,6 --gravity-m-s2 mars \
         --load-transfer uniform --wheel-moments included --set wheel.radius_m=0.12",
        "attitude first/scenario.toml --slope-deg 3,6",
        "attitude.json",
    );
    check_repeats(
        "attitude --soil toyoura-uncertain --slope-deg 8 --uncertainty --samples 8 --seed 5 \
         --set soil.uncertainty.parameter.0.standard_deviation=2",
        "attitude first/scenario.toml --slope-deg 8 --uncertainty --samples 8 --seed 5",
        "attitude.json",
    );
    check_repeats(
        "wheel-test --soil lunar-nominal --wheel jfr-2007 --load-n 9 --set soil.cohesion_kpa=0.3 \
         --set soil.bulldozing.law=none --slip-angle-deg 5",
        "wheel-test --soil first/soil.toml --wheel first/wheel.toml --load-n 9 --slip-angle-deg 5",
        "wheel-test.json",
    );
}

/// Samples are a file of their own: they go along into the folder.
#[test]
fn samples_of_a_soil_are_repeated_too() {
    let place = Place::new();
    let soil = place.results("presets toyoura");
    fs::create_dir(place.file("soils")).expect("it can be made");
    place.write("soils/samples.csv", "friction_angle_deg,exit.ratio\n36,0.8\n38,1\n39.5,1.1\n");
    let uncertain = format!("{soil}\n[uncertainty]\nsamples = \"samples.csv\"\n");
    place.write("soils/sand.toml", uncertain);
    let flags = "--slope-deg 5,10 --uncertainty --samples 9";
    let first = place
        .results(&format!("attitude --soil soils/sand.toml {flags} --format json --out first"));
    place.results("wheel-test --soil soils/sand.toml --out wheel");
    place.results("traverse --soil soils/sand.toml --duration-s 0.1 --out run");
    fs::remove_dir_all(place.file("soils")).expect("it is ours");
    let again = place.results(&format!("attitude first/scenario.toml {flags} --format json"));
    // But for where the samples lie.
    assert_eq!(first.replace("soils/samples.csv", "first/soil-samples.csv"), again);
    place.results("check wheel/soil.toml run/scenario.toml");
}

#[test]
fn charts_of_an_uncertain_soil_are_drawn() {
    let place = Place::new();
    let printed = place.results(&format!("{UNCERTAIN} --format csv --out band"));
    assert_eq!(printed, place.read("band/attitude.csv"));
    for (file, words) in [("attitude", "95 % of all samples"), ("probability", "95 % interval")] {
        let svg = place.read(&format!("band/{file}.svg"));
        assert!(svg.contains(words) && svg.trim_end().ends_with("</svg>"), "{file}");
        assert!(!svg.contains("NaN"), "{file}");
    }
}

#[test]
fn a_soil_that_names_no_source_is_repeated_too() {
    let place = Place::new();
    let soil = changed_preset("soil", "toyoura", "source", "notes_of_old");
    let soil: String = soil
        .lines()
        .filter(|line| !line.starts_with("notes_of_old"))
        .collect::<Vec<_>>()
        .join("\n");
    place.write("sand.toml", soil);
    let first = place.results("wheel-test --soil sand.toml --format json --out first");
    let again =
        place.results("wheel-test --soil first/soil.toml --wheel first/wheel.toml --format json");
    assert_eq!(first, again);
}

#[test]
fn a_folder_holds_the_same_as_the_streams() {
    let place = Place::new();
    for command in ["wheel-test", "attitude", "traverse"] {
        let csv = place.results(&format!("{command} --format csv --out {command}"));
        assert_eq!(csv, place.read(&format!("{command}/{command}.csv")));
        let svg = place.read(&format!("{command}/{command}.svg"));
        assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>"));
    }
}

#[test]
fn old_files_stay_unless_forced() {
    let place = Place::new();
    place.results("wheel-test --slip-ratio 0.1 --out results");
    place.write("results/notes.txt", "mine");
    let before = place.read("results/wheel-test.csv");
    let refused = place.line("wheel-test --slip-ratio 0.2 --out results");
    assert_eq!(refused.code(), 2);
    assert!(refused.stderr.contains("--force"), "{}", refused.stderr);
    assert_eq!(refused.stdout, "");
    assert_eq!(before, place.read("results/wheel-test.csv"));

    place.results("wheel-test --slip-ratio 0.2 --out results --force");
    assert_ne!(before, place.read("results/wheel-test.csv"));
    assert_eq!(place.read("results/notes.txt"), "mine");
}

#[test]
fn an_empty_folder_is_taken_and_missing_ones_are_made() {
    let place = Place::new();
    fs::create_dir(place.file("empty")).expect("it can be made");
    place.results("wheel-test --out empty");
    place.results("wheel-test --out a/b/./c/");
    assert!(place.file("empty/wheel-test.csv").is_file());
    assert!(place.file("a/b/c/wheel-test.csv").is_file());
    assert_eq!(place.names(), ["a", "empty"]);
}

/// A new folder is for others to read as the umask says, as one made by `mkdir` is.
#[cfg(unix)]
#[test]
fn a_new_folder_has_the_usual_permissions() {
    use std::os::unix::fs::PermissionsExt as _;
    let place = Place::new();
    assert_eq!(place.shell("umask 022; grouser wheel-test --out results").code(), 0);
    let mode = fs::metadata(place.file("results")).expect("it is there").permissions().mode();
    assert_eq!(mode & 0o777, 0o755);
}

/// A reader that has seen enough does not keep the folder from being written.
#[cfg(unix)]
#[test]
fn a_reader_that_leaves_ends_nothing_but_the_printing() {
    let place = Place::new();
    let line = "{ grouser traverse --format csv --out run; echo code $? >&2; } | head -n 1";
    let answer = place.shell(line);
    assert_eq!(answer.stderr, "code 0\n");
    assert!(answer.stdout.starts_with("time_s,"));
    assert!(place.read("run/traverse.csv").lines().count() > 100);
    assert!(place.file("run/scenario.toml").is_file());
}

// ---- Reference numbers, through the program ----

/// A soil of the reference files, whose keys are in SI, as a document.
fn soil_document(soil: &Value) -> String {
    let mut text = String::from("schema = \"soil/1\"\nname = \"reference\"\n");
    let law = &soil["pressure_sinkage"];
    let peak = &soil["max_stress"];
    let modulus = &soil["shear_modulus"];
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "cohesion_kpa = {:?}\nfriction_angle_deg = {}\nconstant_volume_share = 0.0\ndensity_kg_m3 = {}\n\
         [pressure_sinkage]\nlaw = {}\nk_c = {}\nk_phi = {}\nn = {}\n\
         [stress_peak]\na0 = {}\na1 = {}\n\
         [shear]\nlaw = {}\nlongitudinal_m = {}\nlongitudinal_per_rad_m = {}\nlateral_m = {}\n\
         lateral_per_rad_m = {}\n[exit]\nratio = {}\n[bulldozing]\nlaw = {}\n",
        number(&soil["cohesion_pa"]) / 1000.0,
        soil["friction_angle_deg"],
        soil["density_kg_m3"],
        law["law"],
        law["k_c"],
        law["k_phi"],
        law["n"],
        peak["a0"],
        peak["a1"],
        soil["shear_law"],
        modulus["longitudinal_m"],
        modulus["longitudinal_per_rad_m"],
        modulus["lateral_m"],
        modulus["lateral_per_rad_m"],
        soil["exit_angle_ratio"],
        soil["bulldozing"],
    );
    text
}

fn wheel_document(wheel: &Value) -> String {
    let (radius, width) = (&wheel["radius_m"], &wheel["width_m"]);
    let text = format!("schema = \"wheel/1\"\nradius_m = {radius}\nwidth_m = {width}\n");
    let height = number(&wheel["grouser_height_m"]);
    if height == 0.0 {
        text
    } else {
        text + &format!("[grousers]\nheight_m = {height}\ncount = 24\n")
    }
}

fn reference(json: &str) -> Vec<Value> {
    let document: Value = serde_json::from_str(json).expect("the reference files are JSON");
    document["rows"].as_array().expect("they have rows").clone()
}

/// Every quantity to 1e-6 of its size, or of a thousandth of its scale, as in the library's tests.
#[test]
fn settled_wheels_of_the_reference_through_the_program() {
    let rows =
        reference(include_str!("../../../grouser/tests/it/reference/wheel_equilibrium.json"));
    let place = Place::new();
    let mut cases: Vec<(Value, Vec<&Value>)> = Vec::new();
    for row in &rows {
        let case =
            serde_json::json!([row["soil"], row["wheel"], row["gravity_m_s2"], row["load_n"]]);
        match cases.iter_mut().find(|(known, _)| *known == case) {
            Some((_, rows)) => rows.push(row),
            None => cases.push((case, vec![row])),
        }
    }
    let mut checked = 0;
    for (case, rows) in &cases {
        place.write("soil.toml", soil_document(&case[0]));
        place.write("wheel.toml", wheel_document(&case[1]));
        let list = |word: &str| {
            let mut values: Vec<String> = rows.iter().map(|row| row[word].to_string()).collect();
            values.sort();
            values.dedup();
            values.join(",")
        };
        let json = place.json(&format!(
            "wheel-test --soil soil.toml --wheel wheel.toml --gravity-m-s2 {} --load-n {} \
             --slip-ratio {} --slip-angle-deg {}",
            case[2],
            case[3],
            list("slip_ratio"),
            list("slip_angle_deg"),
        ));
        for expected in rows {
            let answers = json["rows"].as_array().expect("rows");
            let same = |word: &str, row: &Value| number(&row[word]) == number(&expected[word]);
            let row = answers
                .iter()
                .find(|row| same("slip_ratio", row) && same("slip_angle_deg", row))
                .expect("it was asked for");
            check_reference_row(expected, row);
            checked += 1;
        }
    }
    assert_eq!(checked, 140);
}

fn check_reference_row(expected: &Value, row: &Value) {
    let load = number(&expected["load_n"]);
    let wheel = &expected["wheel"];
    let radius = number(&wheel["radius_m"]) + number(&wheel["grouser_height_m"]);
    let degree = 1f64.to_radians();
    for (theirs, ours, factor, scale) in [
        ("sinkage_m", "sinkage_mm", 1e-3, radius),
        ("entry_angle_rad", "entry_angle_deg", degree, 1.0),
        ("max_stress_angle_rad", "max_stress_angle_deg", degree, 1.0),
        ("exit_angle_rad", "exit_angle_deg", degree, 1.0),
        ("drawbar_pull_n", "drawbar_pull_n", 1.0, load),
        ("side_force_n", "side_force_n", 1.0, load),
        ("side_force_from_shear_n", "side_force_from_shear_n", 1.0, load),
        ("bulldozing_integral_n", "bulldozing_load_n", 1.0, load),
        ("torque_nm", "torque_nm", 1.0, load * radius),
    ] {
        let (computed, right) = (number(&row[ours]) * factor, number(&expected[theirs]));
        let error = (computed - right).abs() / right.abs().max(1e-3 * scale);
        assert!(error < 1e-6, "{ours} is {computed}, not {right} ({error:.1e}): {expected}");
    }
}

#[test]
fn attitudes_of_the_reference_through_the_program() {
    let json =
        Place::new().json("attitude --load-transfer quasi-static --slope-deg 5,10,15,20 --nominal");
    let rows = json["rows"].as_array().expect("rows");
    let expected = reference(include_str!("../../../grouser/tests/it/reference/attitude.json"));
    assert_eq!(rows.len(), expected.len());
    for (row, expected) in rows.iter().zip(&expected) {
        assert_eq!(number(&row["slope_deg"]), number(&expected["slope_deg"]));
        let error = number(&row["yaw_deg"]) - number(&expected["yaw_deg"]);
        assert!(error.abs() < 0.02, "{row}");
    }
}

// ---- Reproduce ----

#[test]
fn the_report_is_one_page_that_needs_no_network_and_can_be_repeated() {
    let place = Place::new();
    place.results("reproduce --samples 2 --out study");
    let html = place.read("study/report.html");
    assert!(html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
    for address in html.match_indices("://").map(|(at, _)| address_around(&html, at)) {
        assert!(address.starts_with("http://www.w3.org/"), "{address}");
    }
    let lower = html.to_lowercase();
    for element in ["<script", "<link", "<img", "<iframe", "<object", "<embed", "@import"] {
        assert!(!lower.contains(element), "{element}");
    }
    // Within the page, a drawing may name its own parts.
    assert_eq!(lower.matches("url(").count(), lower.matches("url(#").count());
    for reference in [" src=", " href=\"http", "srcset"] {
        assert!(!lower.contains(reference), "{reference}");
    }
    let figures = html.matches("<figure>").count();
    assert!(figures >= 5, "{figures}");
    assert_eq!(html.matches("<svg").count(), figures);
    assert_eq!(html.matches("</svg>").count(), figures);
    let drawn = fs::read_dir(place.file("study/figures")).expect("a folder").count();
    assert_eq!(drawn, figures);
    for said in ["Assumptions in force", "How the numbers were made", env!("CARGO_PKG_VERSION")] {
        assert!(html.contains(said), "{said}");
    }

    // And it says how to have its numbers again.
    place.results("traverse study/scenario.toml --yaw-deg 0 --slope-deg 10 --out again");
    let told = place.read("study/data/traverse-10deg-nose-level.csv");
    assert_eq!(told, place.read("again/traverse.csv"));
}

fn address_around(text: &str, at: usize) -> &str {
    let ends = |c: char| c.is_whitespace() || "\"'<>()".contains(c);
    let start = text[..at].rfind(ends).map_or(0, |found| found + 1);
    let end = text[at..].find(ends).map_or(text.len(), |found| at + found);
    &text[start..end]
}

#[test]
fn reproduce_replaces_its_own_report_and_nothing_else() {
    let place = Place::new();
    place.results("reproduce --samples 2");
    let first = place.read("reproduction/report.html");
    place.write("reproduction/data/attitudes.csv", "spoilt");
    place.results("reproduce --samples 2");
    assert_eq!(first, place.read("reproduction/report.html"));
    assert_ne!(place.read("reproduction/data/attitudes.csv"), "spoilt");
    assert_eq!(place.names(), ["reproduction"]);
}

#[test]
fn reproduce_refuses_a_foreign_folder() {
    for foreign in ["thesis.txt", "report.html"] {
        let place = Place::new();
        fs::create_dir(place.file("reproduction")).expect("it can be made");
        place.write(&format!("reproduction/{foreign}"), "<html>mine</html>");
        let answer = place.line("reproduce --samples 2");
        assert_eq!(answer.code(), 2);
        assert!(answer.stderr.contains("--out DIR"), "{}", answer.stderr);
        assert_eq!(place.read(&format!("reproduction/{foreign}")), "<html>mine</html>");
        let left = fs::read_dir(place.file("reproduction")).expect("a folder").count();
        assert_eq!((left, place.names()), (1, vec!["reproduction".to_owned()]));
    }
}
