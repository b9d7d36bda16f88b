//! A word has one unit, wherever a table says it: in the library and in the documents. (The Python
//! package asks the library.)

use std::fs;
use std::path::Path;

use grouser::document::{UNITS, unit_of};

fn file_of_the_repository(path: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// A longer end that stood behind a shorter one would never be found.
#[test]
fn every_end_of_a_word_finds_its_own_unit() {
    for (end, expected) in UNITS {
        assert_eq!(unit_of(&format!("quantity{end}")), Some(expected), "{end}");
    }
}

/// The unit that a quantity has inside the library, by that in its name.
fn inside(unit: &str) -> String {
    if unit == "°C" {
        return unit.to_owned();
    }
    unit.replace('°', "rad").replace("kPa", "Pa").replace("mm", "m").replace("W·h", "J")
}

#[test]
fn the_conventions_have_the_units_of_the_names() {
    let text = file_of_the_repository("docs/conventions.md");
    let mut compared = 0;
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let line = line.replace("\\|", "");
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, words, _, written, ..] = cells[..] else { continue };
        if written == "–" || written.contains(',') {
            continue;
        }
        for word in words.split('`').skip(1).step_by(2) {
            let Some(unit) = unit_of(word) else { continue };
            assert_eq!(written, inside(unit.symbol), "{word}: {line}");
            compared += 1;
        }
    }
    assert!(compared > 40, "only {compared} words were compared");
}
