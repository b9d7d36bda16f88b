//! The page that every output folder has.

use crate::program::Place;

/// Commands with a folder, and words that their pages must have besides what all have.
const COMMANDS: [(&str, &[&str]); 8] = [
    ("wheel-test --slip-angle-deg 0,15", &["Drawbar pull", "Sinkage", "Torque", "Side force"]),
    (
        "traverse --duration-s 2",
        &["Path on the slope", "Slip ratio", "Aligning moment", "front-left"],
    ),
    ("traverse --duration-s 1 --model all", &["small-wheel", "rft", "Over time, by model"]),
    ("heading --slope-deg 5,10", &["Heading offset that holds the contour", "Yaw moment"]),
    ("heading-map --slope-deg 0,10 --course-deg 0,30", &["Yaw beyond the course", "Slip ratio"]),
    ("draw", &["entry angle", "side wall"]),
    (
        "mission back-out",
        &["Energy by leg", "What became of each leg", "slip ratio 0.66 over 0.5 m"],
    ),
    (
        "mission two-steps-forward --simulation quasi-steady",
        &["The alternatives, each from the same start", "backward"],
    ),
];

#[test]
fn every_folder_has_one_page_that_needs_nothing_from_outside() {
    for (command, words) in COMMANDS {
        let place = Place::new();
        place.results(&format!("{command} --out out"));
        let html = place.read("out/report.html");
        assert!(html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
        for word in words.iter().chain(&[env!("CARGO_PKG_VERSION")]) {
            assert!(html.contains(word), "{word} in the page of {command}");
        }
        let lower = html.to_lowercase();
        for element in ["<script", "<link", "<img", "<iframe", "@import", " src="] {
            assert!(!lower.contains(element), "{element} in the page of {command}");
        }
        let drawn = html.matches("<svg").count();
        assert!(drawn >= 2, "{command}: {drawn} drawings");
        // Each drawing says what it is to those who do not see it.
        assert!(html.matches("role=\"img\"").count() == drawn, "{command}");
        assert!(!html.contains("NaN"), "{command}");
    }
}

/// The verdict first, then why and what to do; every channel over time is folded, and on paper what
/// is folded is left out.
#[test]
fn a_page_folds_what_nobody_asked_for() {
    let place = Place::new();
    let line = "mission switchbacks-15-deg --simulation quasi-steady --samples 4";
    place.results(&format!("{line} --out out"));
    let html = place.read("out/report.html");
    let (seen, folded) = html.split_once("<details").expect("folded parts");
    let order = [
        "samples of soil and model",
        "The worst: Leg",
        "The path from above",
        "Validity",
        "What to do next",
    ];
    let places = order.map(|words| seen.find(words).unwrap_or_else(|| panic!("{words}")));
    assert!(places.is_sorted(), "{places:?}");
    assert_eq!(seen.matches("<svg").count(), 1, "the path");
    for title in ["The rover over time", "Each wheel over time", "To have it again"] {
        assert!(folded.contains(&format!("<summary>{title}</summary>")), "{title}");
    }
    assert!(html.contains(".rest:not([open]) { display: none; }"));
}

/// A document's path is the caller's own affair: a page that goes to others does not name it.
#[test]
fn no_page_names_a_place_of_the_machine() {
    let place = Place::new();
    std::fs::create_dir(place.file("mine")).expect("it can be made");
    place.write("mine/soil.toml", place.results("presets toyoura"));
    let soil = place.file("mine/soil.toml");
    let soil = soil.to_str().expect("a path in Unicode");
    let folder = place.file("mine");
    let folder = folder.to_str().expect("a path in Unicode");
    for command in ["wheel-test", "traverse --duration-s 1", "heading --slope-deg 5"] {
        place.results(&format!("{command} --soil {soil} --out out --force"));
        assert!(!place.read("out/report.html").contains(folder), "{command}");
    }
}

#[test]
fn the_command_of_a_page_gives_the_same_rows_again() {
    for (command, file) in [
        ("wheel-test --slip-ratio 0:0.4:0.2 --slip-angle-deg 5", "wheel-test.csv"),
        ("traverse --duration-s 1 --slope-deg 7 --yaw-deg 3", "traverse.csv"),
        ("heading --slope-deg 5,12 --soil lunar-nominal --gravity-m-s2 moon", "heading.csv"),
        ("heading-map --slope-deg 0,10 --course-deg 0,30", "heading-map.csv"),
        ("mission back-out --slope-deg 16", "records.csv"),
    ] {
        let place = Place::new();
        place.results(&format!("{command} --out out"));
        let html = place.read("out/report.html");
        let after = html.split_once("To have it again").expect("the section").1;
        let repeat = after.split_once("grouser ").and_then(|(_, rest)| rest.split_once("</pre>"));
        let repeat = repeat.expect("a command").0;
        // The documents are beside the page.
        let line: Vec<String> = repeat
            .split(' ')
            .map(|word| match word.trim_end() {
                word if word.contains(".toml") => format!("out/{word}"),
                word => word.to_owned(),
            })
            .collect();
        place.results(&format!("{} --out again", line.join(" ")));
        assert_eq!(
            place.read(&format!("out/{file}")),
            place.read(&format!("again/{file}")),
            "{command}: {repeat}"
        );
    }
}
