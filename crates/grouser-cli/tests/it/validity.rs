//! Flags of validity in what the program prints and writes, and `--strict`.

use serde_json::Value;

use crate::program::{Place, changed_preset};

/// A line with an extrapolation, the flag that it raises, and the same line without.
const LINES: [(&str, &str, &str); 5] = [
    ("wheel-test --slip-ratio 0.1,0.99", "slip-outside", "wheel-test --slip-ratio 0.1"),
    ("heading --slope-deg 5,35", "slope-beyond-strength", "heading --slope-deg 5"),
    (
        "attitude-map --course-deg 0 --slope-deg 5 --gravity-m-s2 moon",
        "gravity-outside",
        "attitude-map --course-deg 0 --slope-deg 5",
    ),
    (
        "traverse --duration-s 0.2 --gravity-m-s2 moon",
        "gravity-outside",
        "traverse --duration-s 0.2 --slope-deg 5",
    ),
    (
        "validate --data cmu-single-wheel --where wheel=smooth --wheel cmu-smooth --soil toyoura",
        "radius-outside",
        "",
    ),
];

fn names(value: &Value) -> Vec<&str> {
    value.as_array().expect("a list").iter().map(|name| name.as_str().expect("a name")).collect()
}

/// The rows of an answer, whatever the command calls them.
fn rows(json: &Value) -> &Vec<Value> {
    let rows = ["cells", "rows", "samples"].iter().find_map(|key| json.get(*key)?.as_array());
    rows.expect("rows")
}

#[test]
fn json_has_a_list_of_flags_in_every_row() {
    let place = Place::new();
    for (line, flag, quiet) in LINES {
        // A file of measurements may have notes on the standard error.
        let answer = place.line(&format!("{line} --format json"));
        let json: Value = serde_json::from_str(&answer.stdout).expect("JSON");
        let flagged = rows(&json).iter().filter(|row| names(&row["flags"]).contains(&flag));
        assert!(flagged.count() > 0, "{line}");
        if !quiet.is_empty() {
            let json = place.json(quiet);
            assert!(rows(&json).iter().all(|row| names(&row["flags"]).is_empty()), "{quiet}");
        }
    }
}

#[test]
fn csv_joins_flags_by_semicolons() {
    let csv = Place::new().results("wheel-test --slip-ratio 0.99 --slip-angle-deg 50 --format csv");
    let mut lines = csv.lines();
    assert!(lines.next().expect("a header").ends_with(",flags"));
    assert!(lines.next().expect("a row").ends_with(",slip-outside;slip-angle-outside"), "{csv}");
}

#[test]
fn a_table_explains_its_flags_and_has_no_column_without_any() {
    let place = Place::new();
    let flagged = place.results("wheel-test --slip-ratio 0.2,0.99");
    assert!(flagged.lines().next().expect("a header").ends_with("flags"), "{flagged}");
    let note = "slip-outside: The slip ratio is outside the tests of the model or of the soil's \
                fit, or near 1.";
    assert_eq!(flagged.matches(note).count(), 1, "{flagged}");
    assert!(!place.results("wheel-test --slip-ratio 0.2").contains("flags"));
}

#[test]
fn bands_of_a_wheel_test_stand_beside_its_flags_and_the_probability_that_it_is_carried() {
    let place = Place::new();
    for model in ["", " --model all"] {
        let line = format!("wheel-test --slip-ratio 0.2,0.99 --uncertainty --samples 3{model}");
        let text = place.results(&line);
        let header = text.lines().next().expect("a header");
        let last: Vec<&str> = header.split_whitespace().rev().take(3).collect();
        assert_eq!(last, ["flags", "status", "probability_carried"], "{header}");
        assert_eq!(text.matches("\nslip-outside: ").count(), 1, "{text}");
    }
}

#[test]
fn a_run_has_its_flags_with_the_time_of_each() {
    let json = Place::new().json("traverse --duration-s 0.2 --gravity-m-s2 moon");
    assert!(names(&json["flags"]).contains(&"gravity-outside"));
    let raised = json["flags_raised"].as_array().expect("a list");
    assert_eq!(raised.len(), names(&json["flags"]).len());
    let first = raised.iter().find(|it| it["flag"] == "gravity-outside").expect("it was raised");
    assert_eq!(first["time_s"], 0.0);
}

#[test]
fn strictness_makes_flags_errors() {
    let place = Place::new();
    for (line, flag, quiet) in LINES {
        let answer = place.line(&format!("{line} --strict"));
        assert_eq!(answer.code(), 2, "{line}");
        let message = &answer.stderr;
        let named = message.lines().find(|line| line.contains(flag));
        let named = named.unwrap_or_else(|| panic!("{line}: {message}"));
        assert!(
            named.contains("row ") && named.contains(" is ") && named.contains("the domain is")
        );
        assert!(answer.stdout.is_empty(), "{line}");
        if !quiet.is_empty() {
            assert_eq!(place.line(&format!("{quiet} --strict")).code(), 0, "{quiet}");
        }
    }
}

#[test]
fn check_asks_about_moduli_and_says_what_the_soil_does_not_carry() {
    let place = Place::new();
    let sand = changed_preset("soil", "dry-sand", "k_phi = 1528.43e3", "k_phi = 1528.43");
    let soft = sand.replacen("k_c   = 0.99e3", "k_c   = 0.99", 1);
    assert_ne!(soft, sand);
    place.write("soft.toml", soft);
    let answer = place.line("check soft.toml");
    assert_eq!(answer.code(), 0);
    assert!(answer.stdout.contains("are the moduli in kN?"), "{}", answer.stdout);
    place.write(
        "heavy.toml",
        changed_preset("rover", "hakuto", "mass_kg = 5.24", "mass_kg = 900.0"),
    );
    let answer = place.line("check heavy.toml");
    assert!(answer.stdout.contains("the soil carries at most"), "{}", answer.stdout);
}
