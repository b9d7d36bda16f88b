//! Each command's happy path, its help, and what it says of nothing.
//!
//! Tables show four digits, which every machine's mathematics library agrees on; of JSON and CSV
//! the conversations keep the words and round the numbers.

use insta::assert_snapshot;
use serde_json::Value;

use crate::program::Place;

fn check_conversation(name: &str, line: &str) {
    check_rounded(name, line, |_, text| text.to_owned());
}

/// * `round`: makes numbers of the output short; told the line
fn check_rounded(name: &str, line: &str, round: fn(&str, &str) -> String) {
    let mut answer = Place::new().line(line);
    answer.stdout = round(line, &answer.stdout);
    assert_snapshot!(name, answer.conversation());
}

/// JSON with its numbers rounded to four digits.
fn rounded_json(line: &str, text: &str) -> String {
    let mut value = serde_json::from_str(text).unwrap_or_else(|error| panic!("{line}: {error}"));
    round_numbers(&mut value);
    format!("{value:#}\n")
}

fn round_numbers(value: &mut Value) {
    match value {
        Value::Number(number) => {
            if let Some(float) = number.as_f64().filter(|_| number.is_f64()) {
                *value = Value::from(rounded(float));
            }
        }
        Value::Array(values) => values.iter_mut().for_each(round_numbers),
        Value::Object(map) => map.values_mut().for_each(round_numbers),
        _ => {}
    }
}

/// Four digits; what is left over where terms cancel is zero.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-7 {
        return 0.0;
    }
    format!("{value:.3e}").parse().expect("a number was written")
}

fn rounded_csv(_: &str, text: &str) -> String {
    let cell = |cell: &str| match cell.parse::<f64>() {
        Ok(number) => rounded(number).to_string(),
        Err(_) => cell.to_owned(),
    };
    let line = |line: &str| line.split(',').map(cell).collect::<Vec<_>>().join(",") + "\n";
    text.lines().map(line).collect()
}

// ---- Help ----

#[test]
fn no_arguments_show_the_help() {
    check_conversation("nothing", "");
}

#[test]
fn help_of_the_program() {
    check_conversation("help", "--help");
    check_conversation("help-short", "-h");
    check_conversation("version", "--version");
}

#[test]
fn help_of_each_command() {
    for command in [
        "reproduce",
        "traverse",
        "wheel-test",
        "heading",
        "heading-map",
        "card",
        "forecast",
        "slip-from-current",
        "replay",
        "validate",
        "import",
        "check",
        "presets",
        "schema",
        "completions",
    ] {
        check_conversation(&format!("help-{command}"), &format!("{command} --help"));
    }
}

// ---- Results ----

#[test]
fn wheel_test_as_a_table() {
    check_conversation("wheel-test", "wheel-test");
    check_conversation(
        "wheel-test-of-two-loads-and-angles",
        "wheel-test --soil simulant-2007 --wheel jfr-2007 --load-n 10,20 --slip-ratio -0.5:0.5:0.5 \
         --slip-angle-deg 0,15 --gravity-m-s2 moon",
    );
    check_conversation(
        "wheel-test-that-the-soil-cannot-carry",
        "wheel-test --load-n 17,100000 --slip-ratio 0.2",
    );
}

#[test]
fn wheel_test_for_programs() {
    let line = "wheel-test --slip-ratio 0.2 --slip-angle-deg 5 --load-n 17,1e5";
    check_rounded("wheel-test-json", &format!("{line} --format json"), rounded_json);
    check_rounded("wheel-test-csv", &format!("{line} --format csv"), rounded_csv);
}

#[test]
fn heading_as_a_table() {
    check_conversation("heading", "heading");
    check_conversation("heading-on-too-steep-a-slope", "heading --slope-deg 0,10,25");
    check_conversation("heading-of-a-scenario", "heading moon-10-deg --slope-deg 10");
    check_conversation("heading-wheel-speeds", "heading --wheel-speeds --slope-deg 10,25");
}

#[test]
fn heading_for_programs() {
    let line = "heading --slope-deg 10,25";
    check_rounded("heading-json", &format!("{line} --format json"), rounded_json);
    check_rounded("heading-csv", &format!("{line} --format csv"), rounded_csv);
    let line = format!("{line} --wheel-speeds --format csv");
    check_rounded("heading-wheel-speeds-csv", &line, rounded_csv);
}

#[test]
fn heading_map_as_a_table_and_for_programs() {
    let line = "heading-map --course-deg -30,0,30 --slope-deg 10,20";
    check_conversation("heading-map", line);
    check_rounded("heading-map-csv", &format!("{line} --format csv"), rounded_csv);
}

#[test]
fn card_as_a_table_and_for_programs() {
    check_conversation("card", "card --samples 20");
    let line = "card --soil toyoura-uncertain --samples 20";
    check_conversation("card-with-bands", line);
    check_rounded("card-csv", &format!("{line} --format csv"), rounded_csv);
}

#[test]
fn quasi_steady_traverses_say_how_they_were_computed() {
    check_conversation("traverse-quasi-steady", "traverse --simulation quasi-steady");
    check_conversation(
        "traverse-that-fell-back",
        "traverse --simulation quasi-steady --slope-deg 25 --yaw-deg 90",
    );
}

#[test]
fn traverse_as_a_table() {
    check_conversation("traverse", "traverse");
    check_conversation("traverse-of-a-preset", "traverse spot-turn");
    check_conversation("traverse-that-does-not-complete", "traverse too-steep");
}

#[test]
fn traverse_for_programs() {
    let line = "traverse --duration-s 0.2 --set scenario.sample_interval_s=0.2";
    check_rounded("traverse-json", &format!("{line} --format json"), rounded_json);
    check_rounded("traverse-csv", &format!("{line} --format csv"), rounded_csv);
}

#[test]
fn every_ready_scenario_runs() {
    let place = Place::new();
    let list = place.json("presets --kind scenario");
    let names = list["rows"].as_array().expect("rows").iter();
    let ends: Vec<String> = names
        .map(|row| {
            let name = row["name"].as_str().expect("a name");
            let table = place.results(&format!("traverse {name}"));
            format!("{name}: {}", table.lines().last().unwrap_or_default())
        })
        .collect();
    assert_snapshot!("ready-scenarios", ends.join("\n"));
}

// ---- Documents ----

#[test]
fn presets_are_listed_and_printed() {
    check_conversation("presets", "presets");
    check_conversation("presets-json", "presets --kind rover --format json");
    check_conversation("presets-csv", "presets --kind wheel --format csv");
    check_conversation("presets-toyoura", "presets toyoura");
    check_conversation("presets-hakuto-rover", "presets hakuto --kind rover");
    check_conversation("presets-hakuto", "presets hakuto");
}

#[test]
fn schemas_are_listed_and_printed() {
    check_conversation("schema", "schema");
    check_conversation("schema-wheel", "schema wheel");
}

#[test]
fn good_documents_are_told_so() {
    let place = Place::new();
    for (file, line) in
        [("sand.toml", "presets toyoura"), ("rover.toml", "presets hakuto --kind rover")]
    {
        place.write(file, place.results(line));
    }
    assert_snapshot!("check", place.line("check sand.toml rover.toml").conversation());
}

/// The script itself is the parser's; that it knows our commands is what matters.
#[test]
fn completions_know_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = Place::new().results(&format!("completions {shell}"));
        for word in ["reproduce", "wheel-test", "slip-angle-deg", "reference-slip-ratio"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let place = Place::new();
    let program = place.results("man");
    assert!(program.contains(".TH grouser") && program.contains("heading"), "{program}");
    for (command, option) in [("heading", "slope\\-deg"), ("campaign run", "threads")] {
        let page = place.results(&format!("man {command}"));
        assert!(page.contains(".SH OPTIONS") && page.contains(option), "{command}: {page}");
    }
    check_conversation("man-misspelt", "man headin");
}

#[test]
fn reproduce_says_what_it_found_and_where_it_is() {
    let place = Place::new();
    assert_snapshot!("reproduce", place.line("reproduce --samples 2 --out study").conversation());
    let mut files = Vec::new();
    collect_files(&place.file("study"), "", &mut files);
    assert_snapshot!("reproduce-files", files.join("\n"));
}

fn collect_files(folder: &std::path::Path, prefix: &str, files: &mut Vec<String>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder)
        .expect("it can be listed")
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    entries.sort();
    for path in entries {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            collect_files(&path, &format!("{prefix}{name}/"), files);
        } else {
            files.push(format!("{prefix}{name}"));
        }
    }
}
