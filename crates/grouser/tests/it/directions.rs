//! A direction at the start is any angle: whole turns do not count.

use grouser::document::{Overrides, Source, read_mission, read_scenario};
use grouser::units::deg;

/// Angles as they are given, and less their turns [°].
const ANGLES: [(f64, f64); 8] = [
    (181.0, -179.0),
    (270.0, -90.0),
    (359.5, -0.5),
    (360.0, 0.0),
    (-190.0, 170.0),
    (725.25, 5.25),
    (-1e8, 80.0),
    (180.0, 180.0),
];

#[test]
fn a_yaw_of_a_scenario_is_any_angle() {
    for (given, reduced) in ANGLES {
        let scenario = |yaw: f64| {
            let settings = Overrides::parse([format!("scenario.start.yaw_deg={yaw}").as_str()]);
            let read = read_scenario(&Source::default_scenario(), &settings.expect("a setting"));
            read.expect("a scenario").value
        };
        let (one, other) = (scenario(given), scenario(reduced));
        assert_eq!(one, other, "{given}°");
        assert_eq!(one.start.yaw.to_bits(), deg(reduced).to_bits(), "{given}°");
    }
}

#[test]
fn a_yaw_of_a_leg_is_any_angle() {
    for (given, reduced) in ANGLES {
        let mission = |yaw: f64| {
            let text =
                format!("schema = \"mission/1\"\n[[leg]]\ndrive_m = 1.0\nyaw_deg = {yaw:.3}\n");
            let read = read_mission(&Source::text("a leg", text), &Overrides::none());
            read.expect("a mission").value.mission()
        };
        assert_eq!(mission(given), mission(reduced), "{given}°");
    }
}

#[test]
fn a_yaw_that_is_no_number_is_refused() {
    for yaw in ["nan", "inf", "-inf"] {
        let text = format!("schema = \"scenario/1\"\nstart = {{ yaw_deg = {yaw} }}\n");
        let read = read_scenario(&Source::text("a scenario", text), &Overrides::none());
        assert!(read.is_err(), "{yaw}");
    }
}
