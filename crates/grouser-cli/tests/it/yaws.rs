//! The yaw of a traverse: at its start, or over time.

use crate::bad_input::check_refused;
use crate::program::{Place, number};

const OVER_TIME: &str = "schema = \"scenario/1\"\n[drive]\nyaw_deg = [[0, 3.31], [20, 0.56]]\n";

fn with_scenarios() -> Place {
    let place = Place::new();
    place.write("course.toml", OVER_TIME);
    place.write("both.toml", format!("{OVER_TIME}[start]\nyaw_deg = 5\n"));
    place
}

#[test]
fn the_flag_of_the_yaw_stands_in_place_of_either_yaw_of_a_scenario() {
    let place = with_scenarios();
    let end = |line: &str| {
        let json = place.json(&format!("{line} --duration-s 1"));
        let [first, last] = [&json["samples"][0], &json["final"]];
        [first, last].map(|record| number(&record["yaw_deg"]))
    };
    assert_eq!(end("traverse --yaw-deg 5"), end("traverse course.toml --yaw-deg 5"));
    assert_eq!(end("traverse --yaw-deg 5"), end("traverse both.toml --yaw-deg 5"));
    let [first, last] = end("traverse both.toml --yaw-deg [[0,2],[2,0]]");
    assert!((first - 2.0).abs() < 1e-9 && (last - 1.0).abs() < 1e-9, "{first} {last}");
}

#[test]
fn yaws_that_contradict_each_other_or_turn_too_fast() {
    check_refused(
        "yaws",
        &with_scenarios(),
        &[
            &["traverse", "both.toml"],
            &["traverse", "course.toml", "--set", "scenario.start.yaw_deg=5"],
            &["traverse", "--yaw-deg", "[[0, 3.31], [0.001, 300]]"],
            &["traverse", "--yaw-deg", "[[0, 0], [2, 10], [3, -60]]"],
        ],
    );
}
