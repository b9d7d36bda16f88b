//! Drawings of runs over ground with heights.

use grouser::document::{Overrides, Source, read_scenario};
use grouser::simulation::Run;
use grouser_draw::relief_of;

fn drawn(terrain: &str, start_yaw: f64) -> Option<String> {
    let text = format!(
        "schema = \"scenario/1\"\nname = \"s\"\nsimulation = \"quasi-steady\"\nduration_s = 30\nslope_deg = 0\n\
         [start]\nyaw_deg = {start_yaw:?}\n{terrain}"
    );
    let scenario = read_scenario(&Source::text("s", text), &Overrides::none()).expect("a scenario");
    let run = Run::new(&scenario.value).expect("a run").to_end().expect("an end");
    relief_of("over <ground> & sand", &scenario.value, &run.records)
}

const RIPPLE: &str = "[terrain]\nsurface = \"ripple\"\namplitude_m = 0.03\nwavelength_m = 1.0\nstart_m = [3e5, 200.0]\n";

#[test]
fn a_run_over_heights_has_a_drawing_and_one_on_a_plane_has_none() {
    assert_eq!(drawn("", 0.0), None);
    for yaw in [0.0, 90.0, -137.0] {
        let svg = drawn(RIPPLE, yaw).expect("a drawing");
        let tree = roxmltree::Document::parse(&svg).expect("it is XML");
        let view = tree.root_element().attribute("viewBox").expect("a size");
        let size: Vec<f64> = view.split(' ').map(|it| it.parse().expect("a number")).collect();
        assert!(size[2] == 180.0 && (90.0..260.0).contains(&size[3]), "{view}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "yaw {yaw}");
        assert!(svg.len() < 600_000, "{}", svg.len());
    }
}

/// Level ground has neither contours nor a height to be scaled by.
#[test]
fn level_ground_can_be_drawn() {
    let svg =
        drawn("[terrain]\nsurface = \"incline\"\nslope_deg = 0.0\n", 10.0).expect("a drawing");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}
