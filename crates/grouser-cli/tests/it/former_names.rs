//! Commands and flags of earlier versions do what they did.

use serde_json::Value;

use crate::program::Place;

/// The same results, for each pair of lines of which the first is written as for version 0.1.
#[test]
fn former_flags_are_those_of_today() {
    let place = Place::new();
    for (former, today) in [
        (
            "traverse --duration-s 0.2 --loads uniform --moments included --speed-m-s 0.05",
            "traverse --duration-s 0.2 --load-transfer uniform --wheel-moments included \
             --rim-speed-m-s 0.05",
        ),
        (
            "traverse --duration-s 0.2 --drive eq18 --speed-m-s 0.05",
            "traverse --duration-s 0.2 --drive eq18 --ground-speed-m-s 0.05",
        ),
        ("card --speed-m-s 0.05 --samples 2", "card --rim-speed-m-s 0.05 --samples 2"),
        (
            "wheel-test --model extended --soil cmu-direct90-smooth --wheel cmu-smooth",
            "wheel-test --model small-wheel --soil cmu-direct90-smooth --wheel cmu-smooth",
        ),
    ] {
        let results = |line: &str| place.json(line);
        assert_eq!(results(former), results(today), "{former}");
    }
}

/// `attitude` and `attitude-map` name themselves in what they print and write, and differ in nothing
/// else from `heading` and `heading-map`.
#[test]
fn former_commands_are_those_of_today() {
    let place = Place::new();
    for (former, today, flags) in [
        ("attitude", "heading", "--slope-deg 5,25"),
        ("attitude-map", "heading-map", "--slope-deg 5,25 --course-deg 0 --rim-speed-m-s 0.05"),
    ] {
        let results = |command: &str| {
            let mut json = place.json(&format!("{command} {flags} --out {command}"));
            let schema = json["schema"].take();
            assert_eq!(schema, Value::from(format!("grouser.{command}.v1")));
            json
        };
        assert_eq!(results(former), results(today), "{former}");
        let csv = |command: &str| place.read(&format!("{command}/{command}.csv"));
        assert_eq!(csv(former), csv(today));
    }
}

#[test]
fn help_shows_todays_names_only() {
    let place = Place::new();
    let help = place.shell("grouser --help; grouser traverse --help; grouser card --help").stdout;
    for former in ["attitude", "--loads", "--moments", " --speed-m-s", "extended"] {
        assert!(!help.contains(former), "{former} in: {help}");
    }
}
