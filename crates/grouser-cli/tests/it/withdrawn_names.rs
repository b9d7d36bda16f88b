//! The paper's word for a command does what the present one does; withdrawn options are refused
//! with the present one.

use serde_json::Value;

use crate::program::Place;

/// `attitude` and `attitude-map` name themselves in what they print and write, and differ in
/// nothing else from `heading` and `heading-map`.
#[test]
fn the_papers_commands_are_the_present_ones() {
    let place = Place::new();
    for (papers, present, flags) in [
        ("attitude", "heading", "--slope-deg 5,25"),
        ("attitude-map", "heading-map", "--slope-deg 5,25 --course-deg 0 --rim-speed-m-s 0.05"),
    ] {
        let results = |command: &str| {
            let mut json = place.json(&format!("{command} {flags} --out {command}"));
            let schema = json["schema"].take();
            assert_eq!(schema, Value::from(format!("grouser.{command}.v1")));
            json
        };
        assert_eq!(results(papers), results(present), "{papers}");
        let csv = |command: &str| place.read(&format!("{command}/{command}.csv"));
        assert_eq!(csv(papers), csv(present));
    }
}

#[test]
fn a_withdrawn_option_is_refused_with_the_present_one() {
    let place = Place::new();
    for (line, hint) in [
        ("traverse --loads uniform", "'--load-transfer'"),
        ("heading --moments included", "'--wheel-moments'"),
        ("card --speed-m-s 0.05", "'--rim-speed-m-s'"),
        ("traverse --speed-m-s 0.05", "'--rim-speed-m-s', '--ground-speed-m-s'"),
        ("wheel-test --model extended", "\"small-wheel\""),
        ("heading --steering yaw", "none, crab"),
    ] {
        let refused = place.shell(&format!("grouser {line}"));
        assert!(refused.stderr.contains(hint), "{line}: {}", refused.stderr);
    }
}

#[test]
fn help_shows_present_names_only() {
    let place = Place::new();
    let help = place.shell("grouser --help; grouser traverse --help; grouser card --help").stdout;
    for withdrawn in ["attitude", "--loads", "--moments", " --speed-m-s", "extended"] {
        assert!(!help.contains(withdrawn), "{withdrawn} in: {help}");
    }
}
